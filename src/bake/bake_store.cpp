// Fills around the charts of a baked map, and stores it as an image.
#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include "bake/bake_surfaces.hpp"
#include "bake/lanes.hpp"
#include "bake/surface/nearest_texels.hpp"
#include "core/loops.hpp"
#include "maps/texels.hpp"
#include "scene/texture_sample.hpp"

namespace cotan {

namespace {

constexpr std::size_t kBatch = 64; // texels, whole periods of the pattern

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

// Writes a row of texels. The components of unorm are first converted in one loop, which the compiler vectorises.
void putRow(Image& image, int y, std::span<const glm::vec3> texels, bool dither)
{
    const std::size_t first = 4 * std::size_t(y) * std::size_t(image.width);
    const auto put = [&](auto* to, auto convert) {
        using Stored = std::remove_pointer_t<decltype(to)>;
        std::array<Stored, 3 * kBatch> components;
        for (std::size_t begin = 0; begin < texels.size(); begin += kBatch) {
            const std::size_t count = std::min(kBatch, texels.size() - begin);
            const float* const from = &texels[begin].x;
            for (std::size_t k = 0; k < 3 * count; ++k)
                components[k] = convert(from[k], k);
            for (std::size_t i = 0; i < count; ++i, to += 4) {
                std::copy_n(&components[3 * i], 3, to);
                to[3] = Stored(image.type == PixelType::float32 ? 1 : -1);
            }
        }
    };
    const auto unorm = [](float c) { return maps::settled(std::clamp(c, 0.0f, 1.0f)); };
    std::array<float, 3 * kBatch> offsets;
    for (std::size_t k = 0; k < offsets.size(); ++k)
        offsets[k] = dither ? bayer(int(k / 3 % 8), y) : 0.5f;
    if (image.type == PixelType::float32)
        put(image.floats() + first, [](float c, std::size_t) { return c; });
    else if (image.type == PixelType::unorm16)
        put(image.words() + first, [&](float c, std::size_t) { return std::uint16_t(int(unorm(c) * 65535 + 0.5f)); });
    else
        put(image.bytes8() + first,
            [&](float c, std::size_t k) { return std::uint8_t(std::min(int(unorm(c) * 255 + offsets[k]), 255)); });
}

// The texel from which each texel is filled: itself if it has a value, kNoTexel if there is none near enough.
std::vector<std::uint32_t> nearestFilled(const Baked& baked, const Baked& first, int radius)
{
    std::vector<std::uint32_t> owner(first.states.size(), kNoTexel);
    for (std::size_t i = 0; i < owner.size(); ++i)
        if ((first.states[i] & (texelCovered | texelTouched)) != 0 && baked.hasValue(first, i))
            owner[i] = std::uint32_t(i);
    propagateNearest(owner, baked.width, baked.height, TieBreak::above);
    const std::int64_t limit = std::int64_t(radius) * radius;
    for (std::size_t i = 0; i < owner.size() && radius > 0; ++i)
        if (owner[i] != kNoTexel && owner[i] != i && distance2(owner[i], std::uint32_t(i), baked.width) > limit)
            owner[i] = kNoTexel;
    return owner;
}

constexpr std::size_t kPart = 1 << 16; // texels

// Copies each of the texels from its owner, which stays as it is.
template<class Texel> void copyFrom(const std::vector<std::uint32_t>& owner, Texel* texels)
{
    parallelRanges(std::size_t(0), owner.size(), kPart, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            if (owner[i] != kNoTexel && owner[i] != i)
                texels[i] = texels[owner[i]];
    });
}

void fillFrom(const std::vector<std::uint32_t>& owner, Baked& baked)
{
    if (!baked.values.empty())
        copyFrom(owner, baked.values.data());
    else if (baked.image.type == PixelType::float32)
        copyFrom(owner, reinterpret_cast<std::array<float, 4>*>(baked.image.floats()));
    else if (baked.image.type == PixelType::unorm16)
        copyFrom(owner, reinterpret_cast<std::array<std::uint16_t, 4>*>(baked.image.words()));
    else
        copyFrom(owner, reinterpret_cast<std::array<std::uint8_t, 4>*>(baked.image.bytes8()));
    for (std::size_t i = 0; i < baked.states.size(); ++i)
        if (owner[i] != kNoTexel && owner[i] != i)
            baked.states[i] = std::uint8_t(baked.states[i] | texelPadded);
}

// Whether the texels with a value are those that are filled from themselves.
bool hasValuesIn(const Baked& baked, const Baked& first, const std::vector<std::uint32_t>& owner)
{
    std::atomic<bool> same{true};
    parallelRanges(std::size_t(0), owner.size(), kPart, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end && same; ++i)
            if (baked.hasValue(first, i) != (owner[i] == i))
                same = false;
    });
    return same;
}

} // namespace

void padCharts(Baked& baked, int radius) { fillFrom(nearestFilled(baked, baked, radius), baked); }

void padCharts(std::vector<Baked>& maps, int radius)
{
    const Baked& first = maps.front();
    const std::vector<std::uint32_t> owner = nearestFilled(first, first, radius);
    for (Baked& map : maps)
        if (hasValuesIn(map, first, owner))
            fillFrom(owner, map);
        else
            fillFrom(nearestFilled(map, first, radius), map);
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

    void row(std::span<const glm::vec3> values, std::span<glm::vec3> texels) const
    {
        if (holdsDirections(kind_))
            encode(values, texels, format_);
        const glm::vec3 none = empty();
        for (std::size_t i = 0; i < values.size(); ++i)
            if (values[i] == glm::vec3(0))
                texels[i] = none;
            else if (!holdsDirections(kind_))
                texels[i] = of(values[i]);
    }

private:
    // Inlines the portable text into the loop, which the compiler otherwise does not vectorise.
    [[gnu::flatten]] static void encode(std::span<const glm::vec3> directions, std::span<glm::vec3> texels,
                                        f32::cotan_normal_format format)
    {
        Lanes3 in, out;
        for (std::size_t first = 0; first < directions.size(); first += kLanes) {
            const std::size_t count = std::min(kLanes, directions.size() - first);
            for (std::size_t i = 0; i < count; ++i)
                in.set(i, directions[first + i]);
            for (std::size_t i = 0; i < kLanes; ++i)
                out.set(i, f32::cotan_encode_texel(in.at(i), format));
            for (std::size_t i = 0; i < count; ++i)
                texels[first + i] = out.at(i);
        }
    }

    // Of a map that holds no directions.
    glm::vec3 of(glm::vec3 v) const
    {
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

StoreRow rowStore(const Baked& baked, BakeKind kind, const StoredAs& as)
{
    return [stored = StoredValue(baked, kind, as), dither = as.dither](int y, std::span<const glm::vec3> values,
                                                                       Image& image) {
        std::vector<glm::vec3> row(values.size());
        stored.row(values, row);
        putRow(image, y, row, dither);
    };
}

Image storeBaked(const Baked& baked, BakeKind kind, const StoredAs& as)
{
    Image image = makeImage(baked.width, baked.height, as.type);
    const StoreRow store = rowStore(baked, kind, as);
    const auto width = static_cast<std::size_t>(baked.width);
    parallelRanges<int>(0, baked.height, 1 + (1 << 14) / baked.width, [&](int begin, int end) {
        for (int y = begin; y != end; ++y)
            store(y, {&baked.values[std::size_t(y) * width], width}, image);
    });
    return image;
}

Image packMaps(const std::vector<Baked>& maps, const std::vector<BakeKind>& kinds, const PackedMap& packed,
               const StoredAs& as)
{
    Image image = makeImage(maps.front().width, maps.front().height, as.type);
    const std::size_t size = bytesPerComponent(as.type);
    for (std::size_t channel = 0; channel < 4; ++channel) {
        Image source;
        if (const std::optional<BakeKind> kind = packed.kinds[channel]) {
            const Baked& map = maps[std::size_t(std::ranges::find(kinds, *kind) - kinds.begin())];
            source = map.values.empty() ? map.image : storeBaked(map, *kind, as);
        }
        const float constant = packed.constants[channel];
        const auto eight = std::uint8_t(constant * 255 + 0.5f);
        const auto sixteen = std::uint16_t(constant * 65535 + 0.5f);
        const void* const stored = as.type == PixelType::unorm8 ? static_cast<const void*>(&eight)
            : as.type == PixelType::unorm16                     ? static_cast<const void*>(&sixteen)
                                                                : &constant;
        const bool isConstant = source.data.empty();
        const auto* from = isConstant ? static_cast<const std::byte*>(stored) : source.data.data();
        for (std::size_t i = 0; i < image.pixelCount(); ++i)
            std::memcpy(&image.data[(4 * i + channel) * size], from + (isConstant ? 0 : 4 * i * size), size);
    }
    return image;
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
    const auto color = [](std::uint8_t state) {
        const auto first =
            std::ranges::find_if(maskColors(), [state](const MaskColor& c) { return (state & c.state) != 0; });
        return first == maskColors().end() ? glm::vec3(0) : first->color;
    };
    Image image = makeImage(baked.width, baked.height, PixelType::unorm8);
    std::vector<glm::vec3> row(static_cast<std::size_t>(baked.width));
    for (int y = 0; y < baked.height; ++y) {
        for (std::size_t x = 0; x < row.size(); ++x)
            row[x] = color(baked.states[std::size_t(y) * row.size() + x]);
        putRow(image, y, row, false);
    }
    return image;
}

} // namespace cotan
