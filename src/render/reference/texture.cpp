#include "texture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/loops.hpp"
#include "cotan/portable.hpp"
#include "scene/sample_positions.hpp"
#include "scene/texture_sample.hpp"

namespace cotan::reference {

namespace {

template<class Word> glm::vec4 srgbTexel(const Word* w)
{
    constexpr std::size_t kCount = std::size_t(1) << (8 * sizeof(Word));
    constexpr float kScale = 1.0f / float(kCount - 1);
    static const std::array<float, kCount> linear = [] { // for every stored value
        std::array<float, kCount> t{};
        for (std::size_t i = 0; i < kCount; ++i)
            t[i] = f32::cotan_srgb_to_linear(float(i) / float(kCount - 1));
        return t;
    }();
    return {linear[w[0]], linear[w[1]], linear[w[2]], float(w[3]) * kScale};
}

template<class Word> void storeUnorm(Word* words, glm::vec4 value)
{
    constexpr float kTop = float((1 << (8 * sizeof(Word))) - 1);
    for (int c = 0; c < 4; ++c)
        words[c] = Word(std::lround(std::clamp(value[c], 0.0f, 1.0f) * kTop));
}

void store(Image& image, std::size_t pixel, glm::vec4 value)
{
    switch (image.type) {
    case PixelType::unorm8: storeUnorm(image.bytes8() + 4 * pixel, value); break;
    case PixelType::unorm16: storeUnorm(image.words() + 4 * pixel, value); break;
    case PixelType::float32:
        for (int c = 0; c < 4; ++c)
            image.floats()[4 * pixel + std::size_t(c)] = value[c];
        break;
    }
}

bool isSrgb(const MipChain& chain)
{
    return chain.content == Content::color && chain.image->type != PixelType::float32;
}

// The linear texel of a level. Normals stay encoded; the fourth channel is 1 in level 0. x, y: inside the level.
glm::vec4 texel(const MipChain& chain, int level, int x, int y)
{
    const Image& image = chain.level(level);
    if (!isSrgb(chain)) {
        const glm::vec4 stored = storedComponents(image, x, y);
        // Each texel of the file is one direction, regardless of its alpha.
        return level == 0 && chain.content == Content::normal ? glm::vec4(glm::vec3(stored), 1) : stored;
    }
    const std::size_t at = 4 * (std::size_t(y) * std::size_t(image.width) + std::size_t(x));
    return image.type == PixelType::unorm8 ? srgbTexel(image.bytes8() + at) : srgbTexel(image.words() + at);
}

// The value to average: for normal maps the unit vector and 1, or zeros without a direction; otherwise the linear
// texel.
glm::vec4 toAverage(glm::vec4 value, Content content, const f32::cotan_normal_format& format)
{
    if (content != Content::normal)
        return value;
    const glm::vec3 unit = f32::cotan_normalize_or(f32::cotan_decode(glm::vec3(value), format), glm::vec3(0));
    return {unit, unit == glm::vec3(0) ? 0 : 1};
}

glm::vec4 toStored(glm::vec4 value, const MipChain& chain, const f32::cotan_normal_format& format)
{
    if (chain.content == Content::normal) {
        glm::vec3 m = f32::cotan_normalize_or(glm::vec3(value), glm::vec3(0, 0, 1));
        const float length = value.w > 0 ? glm::length(glm::vec3(value)) / value.w : 1;
        return {f32::cotan_encode_texel(m, format), length};
    }
    if (!isSrgb(chain))
        return value;
    return {f32::cotan_linear_to_srgb(value.x), f32::cotan_linear_to_srgb(value.y), f32::cotan_linear_to_srgb(value.z),
            value.w};
}

// The source texels that one target texel covers along an axis, with their fractions: at most three, for odd sizes.
struct Taps {
    int first = 0, count = 0;
    std::array<float, 3> weight{};
};

Taps tapsOf(int target, int targetSize, int sourceSize)
{
    double low = double(target) * sourceSize / targetSize;
    double high = double(target + 1) * sourceSize / targetSize;
    Taps taps;
    taps.first = int(low);
    for (int i = taps.first; i < sourceSize && i < high && taps.count < 3; ++i) {
        double fraction = std::min(high, i + 1.0) - std::max(low, double(i));
        taps.weight[std::size_t(taps.count++)] = float(fraction / (high - low));
    }
    return taps;
}

// Makes a level from the one before. source(x, y): returns the value to average.
template<class Source>
void halve(const MipChain& chain, const f32::cotan_normal_format& format, int width, int height, Source source,
           Image& target, std::vector<glm::vec4>& averages)
{
    averages.resize(target.pixelCount());
    parallelFor(0, target.height, [&](int y) {
        Taps rows = tapsOf(y, target.height, height);
        for (int x = 0; x < target.width; ++x) {
            Taps columns = tapsOf(x, target.width, width);
            glm::vec4 sum(0);
            for (int j = 0; j < rows.count; ++j)
                for (int i = 0; i < columns.count; ++i)
                    sum += source(columns.first + i, rows.first + j)
                        * (columns.weight[std::size_t(i)] * rows.weight[std::size_t(j)]);
            std::size_t at = std::size_t(y) * std::size_t(target.width) + std::size_t(x);
            averages[at] = sum;
            store(target, at, toStored(sum, chain, format));
        }
    });
}

// Builds the mip chain of a usable image. Colours are averaged as linear light, normals as decoded vectors, other data
// as numbers. Averaged normals are normalised and encoded again, with the length of the average in the fourth channel:
// 1 if all agree. Each texel is the average over the area that it covers in the level before, also for odd sizes.
// withLevels: false keeps only level 0.
MipChain makeMipChain(const Image& image, Content content, Convention stored, bool withLevels)
{
    MipChain chain{&image, content, {}};
    if (!withLevels)
        return chain;
    auto format = toFormat<f32::cotan_normal_format>(stored, image.type);
    format.green = 1; // as stored
    std::vector<glm::vec4> before, averages;
    int width = image.width, height = image.height;
    while (width > 1 || height > 1) {
        Image target = makeImage(std::max(1, width / 2), std::max(1, height / 2), image.type, image.name);
        const auto halveFrom = [&](const auto& source) {
            halve(chain, format, width, height, source, target, averages);
        };
        if (before.empty())
            halveFrom([&](int x, int y) { return toAverage(texel(chain, 0, x, y), content, format); });
        else
            halveFrom([&](int x, int y) { return before[std::size_t(y) * std::size_t(width) + std::size_t(x)]; });
        std::swap(before, averages);
        width = target.width;
        height = target.height;
        chain.smaller.push_back(std::move(target));
    }
    return chain;
}

constexpr int kMaxProbes = 8;

float usable(float x) { return std::abs(x) <= kFarthestUv ? x : 0.0f; }
glm::vec2 usable(glm::vec2 v) { return {usable(v.x), usable(v.y)}; }

glm::vec4 inLevel(const MipChain& chain, int level, const Sampler& s, Filter filter, glm::vec2 uv)
{
    const Image& image = chain.level(level);
    const auto at = [&](int x, int y) { return texel(chain, level, x, y); };
    return filter == Filter::linear ? bilinearTexel(image.width, image.height, s, uv, at)
                                    : nearestTexel(image.width, image.height, s, uv, at);
}

glm::vec4 atLod(const MipChain& chain, const Sampler& s, glm::vec2 uv, float lod)
{
    if (lod <= 0)
        return inLevel(chain, 0, s, s.magnify, uv);
    if (s.mip == MipFilter::none)
        return inLevel(chain, 0, s, s.minify, uv);
    float last = float(chain.levels() - 1);
    lod = std::min(lod, last);
    if (s.mip == MipFilter::nearest)
        return inLevel(chain, int(std::ceil(lod + 0.5f)) - 1, s, s.minify, uv);
    int finer = int(lod);
    float k = lod - float(finer);
    glm::vec4 a = inLevel(chain, finer, s, s.minify, uv);
    if (k == 0)
        return a;
    return glm::mix(a, inLevel(chain, finer + 1, s, s.minify, uv), k);
}

// How to read a pixel's footprint: the number of probes along its longer axis, and their level.
struct Footprint {
    int probes = 1;
    glm::vec2 axis{0}; // in uv, along the whole footprint
    float lod = 0;
};

Footprint footprintOf(const MipChain& chain, const Sampler& s, const UvDifferences& at)
{
    glm::vec2 size(chain.image->width, chain.image->height);
    glm::vec2 dx = usable(at.dx) * chain.footprintScale, dy = usable(at.dy) * chain.footprintScale;
    float alongX = glm::length(dx * size), alongY = glm::length(dy * size);
    float longer = std::max(alongX, alongY), shorter = std::min(alongX, alongY);
    Footprint f;
    if (!(longer > 0))
        return f;
    bool stretched = longer > 1 && s.mip != MipFilter::none && s.minify == Filter::linear;
    // The small margin keeps rounding from splitting a square footprint into two probes.
    if (stretched)
        f.probes = std::clamp(int(std::ceil(longer / std::max(shorter, 1e-3f * longer) - 1e-3f)), 1, kMaxProbes);
    f.axis = alongX >= alongY ? dx : dy;
    f.lod = std::log2(longer / float(f.probes));
    return f;
}

} // namespace

glm::vec4 sample(const MipChain& chain, const Sampler& s, const UvDifferences& at, bool pointSampled)
{
    glm::vec2 uv = usable(at.uv);
    if (pointSampled)
        return inLevel(chain, 0, s, Filter::nearest, uv);
    Footprint f = footprintOf(chain, s, at);
    if (f.probes == 1)
        return atLod(chain, s, uv, f.lod);
    glm::vec4 sum(0);
    for (int i = 1; i <= f.probes; ++i)
        sum += atLod(chain, s, uv + f.axis * (float(i) / float(f.probes + 1) - 0.5f), f.lod);
    return sum / float(f.probes);
}

TextureLibrary makeTextures(const Scene& scene, const View& view)
{
    TextureLibrary library;
    const bool shaded = view.output == Output::shaded;
    const float footprintScale = shaded && view.samples > kMaxSharedSamples ? kSampleSpacing : 1;
    std::map<std::tuple<int, Content, Expansion, Channels>, const MipChain*> made;
    const auto get = [&](const Texture& texture, Content content, Convention format = {}) -> const MipChain* {
        if (!texture.present() || std::size_t(texture.image) >= scene.images.size())
            return nullptr;
        const Image& image = scene.images[std::size_t(texture.image)];
        if (!hasPixels(image))
            return nullptr;
        const MipChain*& known = made[{texture.image, content, format.expansion, format.channels}];
        if (!known) {
            library.chains.push_back(makeMipChain(image, content, format, /*withLevels*/ !view.pointSampled));
            library.chains.back().footprintScale = footprintScale;
            known = &library.chains.back();
        }
        return known;
    };
    for (const Material& m : scene.materials) {
        MaterialMaps maps;
        if (view.normalMaps)
            maps.normal = get(m.normalMap, Content::normal, m.normalFormat);
        maps.height = get(m.heightMap.map, Content::linear);
        if (shaded || m.alphaMode != AlphaMode::opaque)
            maps.baseColor = get(m.baseColorMap, Content::color);
        if (shaded && !m.unlit) {
            maps.metallicRoughness = get(m.metallicRoughnessMap, Content::linear);
            maps.occlusion = get(m.occlusionMap, Content::linear);
            maps.emissive = get(m.emissiveMap, Content::color);
            maps.coat = get(m.coat.map, Content::linear);
            maps.coatRoughness = get(m.coat.roughnessMap, Content::linear);
            maps.coatNormal = view.normalMaps ? get(m.coat.normalMap, Content::normal, m.coat.normalFormat) : nullptr;
            maps.anisotropy = get(m.anisotropy.map, Content::linear);
            maps.specular = get(m.specular.map, Content::linear);
            maps.specularColor = get(m.specular.colorMap, Content::color);
            maps.sheenColor = get(m.sheen.colorMap, Content::color);
            maps.sheenRoughness = get(m.sheen.roughnessMap, Content::linear);
            maps.transmission = get(m.transmission.map, Content::linear);
        }
        library.materials.push_back(maps);
    }
    return library;
}

} // namespace cotan::reference
