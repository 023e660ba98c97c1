#include "mip.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

#include "core/loops.hpp"
#include "cotan/portable.hpp"
#include "scene/texture_sample.hpp"

namespace cotan::reference {

namespace {

// sRGB to linear for every stored value of that many bits.
template<std::size_t Count> const std::array<float, Count>& linearTable()
{
    static const std::array<float, Count> table = [] {
        std::array<float, Count> t{};
        for (std::size_t i = 0; i < Count; ++i)
            t[i] = f32::cotan_srgb_to_linear(float(i) / float(Count - 1));
        return t;
    }();
    return table;
}

template<class Word> glm::vec4 srgbTexel(const Word* words, std::size_t at)
{
    constexpr std::size_t kCount = std::size_t(1) << (8 * sizeof(Word));
    constexpr float kScale = 1.0f / float(kCount - 1);
    const Word* w = words + at;
    const std::array<float, kCount>& linear = linearTable<kCount>();
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

// What is averaged: for normal maps the unit vector and 1, or zeros where there is none, otherwise the linear texel.
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

// The source texels that one target texel covers along an axis, and how much of each. Halving an
// odd size covers parts of up to three.
struct Taps {
    int first = 0, count = 0;
    std::array<float, 3> share{};
};

Taps tapsOf(int target, int targetSize, int sourceSize)
{
    double low = double(target) * sourceSize / targetSize;
    double high = double(target + 1) * sourceSize / targetSize;
    Taps taps;
    taps.first = int(low);
    for (int i = taps.first; i < sourceSize && i < high && taps.count < 3; ++i) {
        double part = std::min(high, i + 1.0) - std::max(low, double(i));
        taps.share[std::size_t(taps.count++)] = float(part / (high - low));
    }
    return taps;
}

// One level from the one before. `source(x, y)` gives what is averaged.
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
                        * (columns.share[std::size_t(i)] * rows.share[std::size_t(j)]);
            std::size_t at = std::size_t(y) * std::size_t(target.width) + std::size_t(x);
            averages[at] = sum;
            store(target, at, toStored(sum, chain, format));
        }
    });
}

} // namespace

MipChain makeMipChain(const Image& image, Content content, Convention stored, bool withLevels)
{
    MipChain chain{&image, content, {}};
    if (!withLevels)
        return chain;
    auto format = toFormat<f32::cotan_normal_format>(stored, image.type);
    format.green = 1; // as it is stored
    std::vector<glm::vec4> before, averages;
    int width = image.width, height = image.height;
    while (width > 1 || height > 1) {
        Image target = makeImage(std::max(1, width / 2), std::max(1, height / 2), image.type, image.name);
        if (before.empty()) {
            auto source = [&](int x, int y) { return toAverage(texel(chain, 0, x, y), content, format); };
            halve(chain, format, width, height, source, target, averages);
        } else {
            auto source = [&](int x, int y) { return before[std::size_t(y) * std::size_t(width) + std::size_t(x)]; };
            halve(chain, format, width, height, source, target, averages);
        }
        std::swap(before, averages);
        width = target.width;
        height = target.height;
        chain.smaller.push_back(std::move(target));
    }
    return chain;
}

glm::vec4 texel(const MipChain& chain, int level, int x, int y)
{
    const Image& image = chain.level(level);
    if (!isSrgb(chain)) {
        const glm::vec4 stored = storedComponents(image, x, y);
        // A texel of the file is one direction, whatever its alpha says.
        return level == 0 && chain.content == Content::normal ? glm::vec4(glm::vec3(stored), 1) : stored;
    }
    const std::size_t at = 4 * (std::size_t(y) * std::size_t(image.width) + std::size_t(x));
    return image.type == PixelType::unorm8 ? srgbTexel(image.bytes8(), at) : srgbTexel(image.words(), at);
}

} // namespace cotan::reference
