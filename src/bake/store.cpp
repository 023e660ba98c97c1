#include "bake/bake_surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bake/surface/nearest_texels.hpp"
#include "core/loops.hpp"
#include "scene/texture_sample.hpp"

namespace cotan {

namespace {

// An 8x8 ordered pattern (B. Bayer 1973) in [0,1): the same for the same place.
float bayer(int x, int y)
{
    unsigned v = 0;
    for (int bit = 0; bit < 3; ++bit) {
        const unsigned a = unsigned(x >> bit) & 1u, b = unsigned(y >> bit) & 1u;
        v = (v << 2) | ((a ^ b) << 1) | b;
    }
    return (float(v) + 0.5f) / 64;
}

struct Writer {
    Image image;
    bool dither;

    void put(std::size_t i, glm::vec3 c)
    {
        const float channels[4] = {c.x, c.y, c.z, 1};
        const int x = int(i % std::size_t(image.width)), y = int(i / std::size_t(image.width));
        const float offset = dither && image.type == PixelType::unorm8 ? bayer(x, y) : 0.5f;
        for (std::size_t k = 0; k < 4; ++k) {
            const float v = std::clamp(channels[k], 0.0f, 1.0f);
            if (image.type == PixelType::float32)
                image.floats()[4 * i + k] = channels[k];
            else if (image.type == PixelType::unorm16)
                image.words()[4 * i + k] = std::uint16_t(v * 65535 + 0.5f);
            else
                image.bytes8()[4 * i + k] =
                    std::uint8_t(std::min(std::floor(v * 255 + (k < 3 ? offset : 0.5f)), 255.0f));
        }
    }
};

} // namespace

void padCharts(Baked& baked, int radius)
{
    std::vector<std::uint32_t> owner(baked.values.size(), kNoTexel);
    for (std::size_t i = 0; i < owner.size(); ++i)
        if ((baked.states[i] & (texelCovered | texelTouched)) != 0 && baked.values[i] != glm::vec3(0))
            owner[i] = std::uint32_t(i);
    spreadNearest(owner, baked.width, baked.height, AskFirst::above);
    const std::int64_t limit = radius > 0 ? std::int64_t(radius) * radius : std::numeric_limits<std::int64_t>::max();
    for (std::size_t i = 0; i < owner.size(); ++i) {
        if (owner[i] == kNoTexel || owner[i] == i || distance2(owner[i], std::uint32_t(i), baked.width) > limit)
            continue;
        baked.values[i] = baked.values[owner[i]];
        baked.states[i] = std::uint8_t(baked.states[i] | texelPadded);
    }
}

Convention storedFormat(BakeKind kind, Convention format)
{
    if (kind == BakeKind::objectNormal) // three axes of a mesh, as they are
        format = {MapKind::objectSpace, format.expansion, Channels::xyz, true, VDirection::up};
    return format;
}

Image storeBaked(const Baked& baked, BakeKind kind, const StoredAs& as)
{
    Writer writer{makeImage(baked.width, baked.height, as.type), as.dither};
    const bool direction = showsNormals(kind);
    float low = 0, scale = 1;
    if (kind == BakeKind::height && as.type != PixelType::float32) {
        float least = 1e30f, most = -1e30f;
        for (std::size_t i = 0; i < baked.values.size(); ++i)
            if (baked.values[i].z != 0) {
                least = std::min(least, baked.values[i].x);
                most = std::max(most, baked.values[i].x);
            }
        low = least;
        scale = most > least ? 1 / (most - least) : 0;
    }
    const f32::cotan_normal_format portableFormat =
        toFormat<f32::cotan_normal_format>(storedFormat(kind, as.format), as.type);
    const glm::vec3 empty = !direction   ? glm::vec3(0)
        : kind == BakeKind::objectNormal ? glm::vec3(f32::cotan_compress(0, portableFormat.expansion))
                                         : f32::cotan_encode_texel(glm::vec3(0, 0, 1), portableFormat);
    const auto stored = [&](glm::vec3 v) {
        if (direction)
            return v == glm::vec3(0) ? empty : f32::cotan_encode_texel(v, portableFormat);
        return v.z != 0 ? glm::vec3((v.x - low) * scale) : empty;
    };
    parallelRanges<std::size_t>(0, baked.values.size(), 1 << 14, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i != end; ++i)
            writer.put(i, stored(baked.values[i]));
    });
    return std::move(writer.image);
}

Image maskOf(const Baked& baked)
{
    Writer writer{makeImage(baked.width, baked.height, PixelType::unorm8), false};
    for (std::size_t i = 0; i < baked.states.size(); ++i) {
        const std::uint8_t s = baked.states[i];
        writer.put(i,
                   s & texelMissed         ? glm::vec3(1, 0, 0)
                       : s & texelNegative ? glm::vec3(0, 0.3f, 1)
                       : s & texelTwice    ? glm::vec3(1, 1, 0)
                       : s & texelCovered  ? glm::vec3(0, 0.7f, 0)
                       : s & texelTouched  ? glm::vec3(0, 0.35f, 0)
                                           : glm::vec3(0));
    }
    return std::move(writer.image);
}

} // namespace cotan
