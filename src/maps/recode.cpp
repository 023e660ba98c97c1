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

// Values that a rounding error away from a step are that step: dithering must not make noise of
// what is exact, such as the flat texel.
float dithered(float value, float most, float noise)
{
    const float scaled = value * most, nearest = std::round(scaled);
    return std::abs(scaled - nearest) < 1e-3f ? value : (scaled + noise) / most;
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
                if (s.dither && most > 0)
                    for (int c = 0; c < 3; ++c)
                        texels[x][c] = dithered(texels[x][c], most,
                                                ditherNoise(std::uint32_t(x), std::uint32_t(y), std::uint32_t(c)));
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
