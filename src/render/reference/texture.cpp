#include "texture.hpp"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "scene/sample_places.hpp"
#include "scene/texture_sample.hpp"

namespace cotan::reference {

namespace {

constexpr int kMaxProbes = 8;

float usable(float x) { return std::abs(x) <= kFarthestUv ? x : 0.0f; }
glm::vec2 usable(glm::vec2 v) { return {usable(v.x), usable(v.y)}; }

glm::vec4 nearest(const MipChain& chain, int level, const Sampler& s, glm::vec2 uv)
{
    const Image& image = chain.level(level);
    return nearestTexel(image.width, image.height, s, uv, [&](int x, int y) { return texel(chain, level, x, y); });
}

glm::vec4 bilinear(const MipChain& chain, int level, const Sampler& s, glm::vec2 uv)
{
    const Image& image = chain.level(level);
    return bilinearTexel(image.width, image.height, s, uv, [&](int x, int y) { return texel(chain, level, x, y); });
}

glm::vec4 inLevel(const MipChain& chain, int level, const Sampler& s, Filter filter, glm::vec2 uv)
{
    return filter == Filter::linear ? bilinear(chain, level, s, uv) : nearest(chain, level, s, uv);
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

// How a pixel's footprint is read: that many probes along its longer axis, at that level.
struct Footprint {
    int probes = 1;
    glm::vec2 axis{0}; // uv, along the whole footprint
    float lod = 0;
};

Footprint footprintOf(const MipChain& chain, const Sampler& s, const UvDifferences& at)
{
    glm::vec2 size(chain.image->width, chain.image->height);
    glm::vec2 dx = usable(at.dx) * chain.apart, dy = usable(at.dy) * chain.apart;
    float alongX = glm::length(dx * size), alongY = glm::length(dy * size);
    float longer = std::max(alongX, alongY), shorter = std::min(alongX, alongY);
    Footprint f;
    if (!(longer > 0))
        return f;
    bool stretched = longer > 1 && s.mip != MipFilter::none && s.minify == Filter::linear;
    // Less a little, so that rounding does not make two probes of a square.
    if (stretched)
        f.probes = std::clamp(int(std::ceil(longer / std::max(shorter, 1e-3f * longer) - 1e-3f)), 1, kMaxProbes);
    f.axis = alongX >= alongY ? dx : dy;
    f.lod = std::log2(longer / float(f.probes));
    return f;
}

const MipChain* chainOf(TextureLibrary& library, const Scene& scene, const Texture& texture, Content content,
                        Convention format, bool withLevels, float apart)
{
    if (!texture.present() || std::size_t(texture.image) >= scene.images.size())
        return nullptr;
    const Image& image = scene.images[std::size_t(texture.image)];
    if (!hasPixels(image))
        return nullptr;
    const MipChain*& known = library.made[{texture.image, content, format.expansion, format.channels}];
    if (!known) {
        library.chains.push_back(makeMipChain(image, content, format, withLevels));
        library.chains.back().apart = apart;
        known = &library.chains.back();
    }
    return known;
}

} // namespace

glm::vec4 sample(const MipChain& chain, const Sampler& s, const UvDifferences& at, bool pointSampled)
{
    glm::vec2 uv = usable(at.uv);
    if (pointSampled)
        return nearest(chain, 0, s, uv);
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
    bool levels = !view.pointSampled, shaded = view.output == Output::shaded;
    const float apart = shaded && view.samples > kMaxSharedSamples ? kPlacesApart : 1;
    for (const Material& m : scene.materials) {
        auto get = [&](const Texture& texture, Content content, Convention format = {}) {
            return chainOf(library, scene, texture, content, format, levels, apart);
        };
        MaterialMaps maps;
        if (view.normalMaps)
            maps.normal = get(m.normalMap, Content::normal, m.normalFormat);
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
