// Fills around the charts of a baked map, and stores it as an image.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "bake/bake_surfaces.hpp"
#include "bake/surface/nearest_texels.hpp"
#include "core/loops.hpp"
#include "maps/texels.hpp"
#include "scene/texture_sample.hpp"

namespace cotan {

namespace {

// An 8x8 ordered dither pattern (B. Bayer 1973) in [0,1), fixed to the image.
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
            const float v = maps::settled(std::clamp(channels[k], 0.0f, 1.0f));
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

namespace {

// The texel from which each texel is filled: itself if it has a value, kNoTexel if there is none near enough.
std::vector<std::uint32_t> nearestFilled(const Baked& baked, int radius)
{
    std::vector<std::uint32_t> owner(baked.values.size(), kNoTexel);
    for (std::size_t i = 0; i < owner.size(); ++i)
        if ((baked.states[i] & (texelCovered | texelTouched)) != 0 && baked.values[i] != glm::vec3(0))
            owner[i] = std::uint32_t(i);
    propagateNearest(owner, baked.width, baked.height, TieBreak::above);
    const std::int64_t limit = radius > 0 ? std::int64_t(radius) * radius : std::numeric_limits<std::int64_t>::max();
    for (std::size_t i = 0; i < owner.size(); ++i)
        if (owner[i] != kNoTexel && owner[i] != i && distance2(owner[i], std::uint32_t(i), baked.width) > limit)
            owner[i] = kNoTexel;
    return owner;
}

void fillFrom(const std::vector<std::uint32_t>& owner, Baked& baked)
{
    for (std::size_t i = 0; i < owner.size(); ++i)
        if (owner[i] != kNoTexel && owner[i] != i) {
            baked.values[i] = baked.values[owner[i]];
            baked.states[i] = std::uint8_t(baked.states[i] | texelPadded);
        }
}

bool haveValuesInTheSameTexels(const Baked& a, const Baked& b)
{
    return std::equal(a.values.begin(), a.values.end(), b.values.begin(),
                      [](glm::vec3 x, glm::vec3 y) { return (x == glm::vec3(0)) == (y == glm::vec3(0)); });
}

} // namespace

void padCharts(Baked& baked, int radius) { fillFrom(nearestFilled(baked, radius), baked); }

void padCharts(std::vector<Baked>& maps, int radius)
{
    const std::vector<std::uint32_t> owner = nearestFilled(maps.front(), radius);
    for (std::size_t m = maps.size(); m-- > 0;) // the first one last, since the others are compared with it
        if (haveValuesInTheSameTexels(maps[m], maps.front()))
            fillFrom(owner, maps[m]);
        else
            padCharts(maps[m], radius);
}

namespace {
bool isInWorld(BakeKind kind) { return kind == BakeKind::objectNormal || kind == BakeKind::objectBentNormal; }
} // namespace

Convention storedFormat(BakeKind kind, Convention format)
{
    if (isInWorld(kind)) // the mesh's three axes, unchanged
        format = {MapKind::objectSpace, format.expansion, Channels::xyz, true, VDirection::up};
    return format;
}

namespace {

// What an image stores for the value of a texel that has one.
class StoredValue {
public:
    StoredValue(const Baked& baked, BakeKind kind, const StoredAs& as)
        : kind_(kind), isFloat_(as.type == PixelType::float32), unit_(baked.unit), box_(baked.box),
          format_(toFormat<f32::cotan_normal_format>(storedFormat(kind, as.format), as.type))
    {
        if (kind != BakeKind::height || isFloat_)
            return;
        float lowest = 1e30f, highest = -1e30f;
        for (const glm::vec3 v : baked.values)
            if (v.z != 0) {
                lowest = std::min(lowest, v.x);
                highest = std::max(highest, v.x);
            }
        low_ = lowest;
        scale_ = highest > lowest ? 1 / (highest - lowest) : 0;
    }

    glm::vec3 operator()(glm::vec3 v) const
    {
        if (v == glm::vec3(0))
            return empty();
        if (holdsDirections(kind_))
            return f32::cotan_encode_texel(v, format_);
        if (kind_ == BakeKind::position)
            return isFloat_ ? box_.low + (v - 1.0f) * (box_.high - box_.low) : v - 1.0f;
        if (holdsColors(kind_))
            return stored(v - 1.0f);
        if (kind_ == BakeKind::id)
            return stored(linearColor(std::uint32_t(v.x)));
        if (kind_ == BakeKind::roughnessMetallic)
            return v;
        if (kind_ == BakeKind::curvature && !isFloat_)
            return glm::vec3(0.5f + 0.5f * v.x * unit_); // clamped as all integers
        if (kind_ == BakeKind::thickness && !isFloat_)
            return glm::vec3(v.x / unit_);
        return glm::vec3((v.x - low_) * scale_);
    }

private:
    glm::vec3 stored(glm::vec3 linear) const
    {
        const auto of = [](float x) { return f32::cotan_linear_to_srgb(std::clamp(x, 0.0f, 1.0f)); };
        return isFloat_ ? linear : glm::vec3(of(linear.x), of(linear.y), of(linear.z));
    }
    glm::vec3 empty() const
    {
        if (!holdsDirections(kind_))
            return glm::vec3(kind_ == BakeKind::curvature && !isFloat_ ? 0.5f : 0);
        return isInWorld(kind_) ? glm::vec3(f32::cotan_compress(0, format_.expansion))
                                : f32::cotan_encode_texel(glm::vec3(0, 0, 1), format_);
    }

    BakeKind kind_;
    bool isFloat_;
    float unit_, low_ = 0, scale_ = 1;
    Bounds box_;
    f32::cotan_normal_format format_;
};

} // namespace

Image storeBaked(const Baked& baked, BakeKind kind, const StoredAs& as)
{
    Writer writer{makeImage(baked.width, baked.height, as.type), as.dither};
    const StoredValue stored(baked, kind, as);
    parallelRanges<std::size_t>(0, baked.values.size(), 1 << 14, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i != end; ++i)
            writer.put(i, stored(baked.values[i]));
    });
    return std::move(writer.image);
}

std::span<const MaskColor> maskColors()
{
    static constexpr MaskColor kColors[] = {{texelMissed, {1, 0, 0}, "no detail found"},
                                            {texelNegative, {0, 0.3f, 1}, "points into the surface"},
                                            {texelOverlapped, {1, 1, 0}, "shared by triangles that differ"},
                                            {texelCovered, {0, 0.7f, 0}, "baked"},
                                            {texelTouched, {0, 0.35f, 0}, "baked, beside a chart"}};
    return kColors;
}

Image maskOf(const Baked& baked)
{
    Writer writer{makeImage(baked.width, baked.height, PixelType::unorm8), false};
    for (std::size_t i = 0; i < baked.states.size(); ++i) {
        const auto first =
            std::ranges::find_if(maskColors(), [&](const MaskColor& c) { return (baked.states[i] & c.state) != 0; });
        writer.put(i, first == maskColors().end() ? glm::vec3(0) : first->color);
    }
    return std::move(writer.image);
}

} // namespace cotan
