#include "cotan/maps/recode.hpp"

#include <atomic>
#include <cmath>

#include <glm/geometric.hpp>

#include "cotan/maps/texels.hpp"

namespace cotan::maps {

namespace {

bool holds(const glm::vec3& n, Channels channels)
{
    switch (channels) {
    case Channels::xyz: return true;
    case Channels::orthographic: return n.z >= 0;
    case Channels::stereographic: return n.z > -0.01f * glm::length(n);
    case Channels::slope: return std::abs(n.x) <= n.z && std::abs(n.y) <= n.z;
    }
    return true;
}

// Steps per unit of a stored component.
float steps(PixelType type)
{
    return type == PixelType::unorm8 ? 255.0f : type == PixelType::unorm16 ? 65535.0f : 0.0f;
}

} // namespace

float ditherNoise(std::uint32_t x, std::uint32_t y, std::uint32_t component)
{
    std::uint32_t h = x * 0x9e3779b1u ^ y * 0x85ebca77u ^ component * 0xc2b2ae3du;
    h = (h ^ (h >> 15)) * 0x2c1b3c6du;
    h = (h ^ (h >> 12)) * 0x297a2d39u;
    h ^= h >> 15;
    return float(h >> 8) * (1.0f / 16777216.0f) - 0.5f;
}

glm::vec4 dithered(glm::vec4 texel, float steps, int x, int y)
{
    for (int c = 0; c < 3 && steps > 0; ++c) {
        const float scaled = texel[c] * steps;
        if (std::abs(scaled - std::round(scaled)) >= 1e-3f)
            texel[c] = (scaled + ditherNoise(std::uint32_t(x), std::uint32_t(y), std::uint32_t(c))) / steps;
    }
    return texel;
}

Image recode(const Image& map, const RecodeSettings& s, RecodeCounts& counts)
{
    Image out = makeImage(map.width, map.height, s.type, map.name);
    const bool keepAlpha = s.from.channels == Channels::xyz && s.to.channels == Channels::xyz;
    const float most = steps(s.type);
    std::atomic<std::size_t> invalid = 0, clamped = 0;
    forRowBands(map.height, [&](int first, int last) {
        const std::size_t width = std::size_t(map.width);
        std::vector<glm::vec4> texels(width);
        std::vector<glm::vec3> normals(width);
        std::size_t badHere = 0, clampedHere = 0;
        for (int y = first; y < last; ++y) {
            loadRow(map, y, texels);
            decodeRow(map, y, s.from, normals);
            for (std::size_t x = 0; x < width; ++x) {
                glm::vec3 n = normals[x];
                n.x *= s.strength;
                n.y *= s.strength;
                badHere += n == glm::vec3(0);
                clampedHere += !holds(n, s.to.channels);
                // A change of strength changes the length too; what was unit is unit again.
                const bool keepLength = !s.normalise && s.strength == 1.0f && s.from.channels == Channels::xyz;
                const float alpha = keepAlpha ? texels[x].w : 1.0f;
                texels[x] = encodeTexel(n, s.to, keepLength);
                texels[x].w = alpha;
                if (s.dither)
                    texels[x] = dithered(texels[x], most, int(x), s.firstRow + y);
            }
            storeRow(out, y, texels);
        }
        invalid += badHere;
        clamped += clampedHere;
    });
    counts = {invalid, clamped};
    return out;
}

} // namespace cotan::maps
