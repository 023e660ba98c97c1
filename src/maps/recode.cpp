#include "cotan/maps.hpp"

#include <array>
#include <atomic>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "maps/texels.hpp"

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

// Per-component lookup tables, for conversions between 8-bit maps that treat each component independently.
struct Tables {
    std::array<std::array<std::uint8_t, 256>, 3> stored{};
    std::array<std::array<float, 256>, 3> square{}; // of the decoded component
};

bool byComponent(const Image& map, const RecodeSettings& s)
{
    return map.type == PixelType::unorm8 && s.type == PixelType::unorm8 && s.from.channels == Channels::xyz
        && s.to.channels == Channels::xyz && s.strength == 1.0f && !s.normalise && !s.dither;
}

// Fills the tables with decodeTexel and encodeTexel. The other components keep the vector's length from 0.
Tables tablesOf(const RecodeSettings& s)
{
    Tables t;
    Image out = makeImage(256, 1, PixelType::unorm8);
    std::vector<glm::vec4> row(std::size_t(out.width));
    for (int k = 0; k < 3; ++k) {
        for (int code = 0; code < 256; ++code) {
            glm::vec4 texel(0, 0, 0, 1);
            texel[k] = float(code) * (1.0f / 255);
            const float value = decodeTexel(texel, s.from, PixelType::unorm8)[k];
            glm::vec3 normal(k == 2 ? 1.0f : 0.0f, 0, 1);
            normal[k] = value;
            row[std::size_t(code)] = encodeTexel(normal, s.to, PixelType::unorm8, true);
            t.square[std::size_t(k)][std::size_t(code)] = value * value;
        }
        storeRow(out, 0, row);
        for (std::size_t code = 0; code < 256; ++code)
            t.stored[std::size_t(k)][code] = out.bytes8()[4 * code + std::size_t(k)];
    }
    return t;
}

Image recodeByComponent(const Image& map, const RecodeSettings& s, RecodeCounts& counts)
{
    const Tables t = tablesOf(s);
    Image flatTexel = makeImage(1, 1, PixelType::unorm8);
    const glm::vec4 encoded = encodeTexel(glm::vec3(0), s.to, PixelType::unorm8, true);
    storeRow(flatTexel, 0, std::span(&encoded, 1));
    const std::uint8_t* f = flatTexel.bytes8();
    const std::array<std::uint8_t, 3> flat{f[0], f[1], f[2]};
    Image out = makeImage(map.width, map.height, s.type, map.name);
    std::atomic<std::size_t> invalid = 0;
    forRowBands(map.width, map.height, [&](int first, int last) {
        const std::size_t width = std::size_t(map.width), start = 4 * std::size_t(first) * width;
        const std::uint8_t* from = map.bytes8() + start;
        std::uint8_t* to = out.bytes8() + start;
        std::size_t here = 0;
        for (std::size_t i = 0; i < std::size_t(last - first) * width; ++i, from += 4, to += 4) {
            const bool valid = t.square[0][from[0]] + t.square[1][from[1]] + t.square[2][from[2]] >= 1e-6f;
            here += !valid;
            for (std::size_t k = 0; k < 3; ++k)
                to[k] = valid ? t.stored[k][from[k]] : flat[k];
            to[3] = from[3];
        }
        invalid += here;
    });
    counts = {invalid, 0};
    return out;
}

// Noise in [-0.5,0.5) for a component of a texel, the same in every run.
float ditherNoise(std::uint32_t x, std::uint32_t y, std::uint32_t component)
{
    std::uint32_t h = x * 0x9e3779b1u ^ y * 0x85ebca77u ^ component * 0xc2b2ae3du;
    h = (h ^ (h >> 15)) * 0x2c1b3c6du;
    h = (h ^ (h >> 12)) * 0x297a2d39u;
    h ^= h >> 15;
    return float(h >> 8) * (1.0f / 16777216.0f) - 0.5f;
}

} // namespace

void ditherRow(std::span<glm::vec4> texels, PixelType type, int y)
{
    if (type != PixelType::unorm8 && type != PixelType::unorm16)
        return;
    const float steps = type == PixelType::unorm8 ? 255.0f : 65535.0f; // steps per unit of a stored component
    for (std::size_t x = 0; x < texels.size(); ++x)
        for (int c = 0; c < 3; ++c) {
            const float scaled = texels[x][c] * steps;
            if (std::abs(scaled - std::round(scaled)) >= 1e-3f)
                texels[x][c] = (scaled + ditherNoise(std::uint32_t(x), std::uint32_t(y), std::uint32_t(c))) / steps;
        }
}

Image recode(const Image& map, const RecodeSettings& s, RecodeCounts& counts)
{
    if (byComponent(map, s))
        return recodeByComponent(map, s, counts);
    Image out = makeImage(map.width, map.height, s.type, map.name);
    const bool keepAlpha = s.from.channels == Channels::xyz && s.to.channels == Channels::xyz;
    std::atomic<std::size_t> invalid = 0, clamped = 0;
    forRowBands(map.width, map.height, [&](int first, int last) {
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
                // A changed strength also changes the length, so the result is normalised.
                const bool keepLength = !s.normalise && s.strength == 1.0f && s.from.channels == Channels::xyz;
                const float alpha = keepAlpha ? texels[x].w : 1.0f;
                texels[x] = encodeTexel(n, s.to, s.type, keepLength);
                texels[x].w = alpha;
            }
            if (s.dither)
                ditherRow(texels, s.type, s.firstRow + y);
            storeRow(out, y, texels);
        }
        invalid += badHere;
        clamped += clampedHere;
    });
    counts = {invalid, clamped};
    return out;
}

Result<Convention> conventionOf(const StatedConvention& stated, const std::string& file, int channels,
                                const std::string& option)
{
    if (channels == 1)
        return inputError(file + ": expected a normal map of two or three channels; found one (grey)");
    Convention convention = stated.convention;
    if (channels != 2 || convention.channels != Channels::xyz)
        return convention;
    if (stated.channels)
        return about(option,
                     usageError(file + " stores two channels; found "
                                + (convention.kind == MapKind::objectSpace ? "object, which needs three"
                                                                           : "xyz, which needs three; leave it out")));
    convention.channels = Channels::orthographic;
    return convention;
}

Result<Convention> makeReadable(Image& image, const StatedConvention& stated, const std::string& file,
                                const std::string& option)
{
    auto convention = conventionOf(stated, file, image.channels, option);
    if (convention && convention->channels != Channels::xyz)
        unswizzle(image, swizzleOf(image));
    if (convention)
        undo(stated.damage, image);
    return convention;
}

void undo(const Damage& damage, Image& image)
{
    if (!damage.any())
        return;
    changeTexels(image, [&](glm::vec4& t) {
        for (int c = 0; c < 3; ++c)
            if (damage.curve == Damage::Curve::srgb)
                t[c] = f32::cotan_srgb_to_linear(t[c]);
            else if (damage.curve == Damage::Curve::linearised)
                t[c] = f32::cotan_linear_to_srgb(t[c]);
        if (damage.order == Damage::Order::bgr)
            std::swap(t.x, t.z);
        else if (damage.order == Damage::Order::grb)
            std::swap(t.x, t.y);
    });
}

} // namespace cotan::maps
