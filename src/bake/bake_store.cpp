// Fills around the charts of a baked map, and stores it as an image.
#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
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

using Offsets = std::array<float, 3 * kBatch>; // that integers of 8 bits are rounded down after

constexpr Offsets kHalves = [] {
    Offsets halves{};
    halves.fill(0.5f);
    return halves;
}();

// Stores up to kBatch texels; at(i): index in the image of the ith. The components of unorm are first converted in one
// loop, which the compiler vectorises.
template<class At> void putTexels(Image& image, std::span<const glm::vec3> texels, const At& at, const Offsets& offsets)
{
    const auto put = [&](auto* to, auto convert) {
        using Stored = std::remove_pointer_t<decltype(to)>;
        std::array<Stored, 3 * kBatch> components;
        const float* const from = &texels[0].x;
        runLanes([&] {
            for (std::size_t k = 0; k < 3 * texels.size(); ++k)
                components[k] = convert(from[k], k);
        });
        for (std::size_t i = 0; i < texels.size(); ++i) {
            const Stored* const c = &components[3 * i];
            const std::array<Stored, 4> stored{c[0], c[1], c[2], Stored(image.type == PixelType::float32 ? 1 : -1)};
            std::copy_n(stored.data(), 4, to + 4 * at(i));
        }
    };
    const auto unorm = [](float c) { return maps::settled(std::clamp(c, 0.0f, 1.0f)); };
    if (image.type == PixelType::float32)
        put(image.floats(), [](float c, std::size_t) { return c; });
    else if (image.type == PixelType::unorm16)
        put(image.words(), [&](float c, std::size_t) { return std::uint16_t(int(unorm(c) * 65535 + 0.5f)); });
    else
        put(image.bytes8(),
            [&](float c, std::size_t k) { return std::uint8_t(std::min(int(unorm(c) * 255 + offsets[k]), 255)); });
}

void putRow(Image& image, int y, std::span<const glm::vec3> texels, bool dither)
{
    Offsets offsets = kHalves;
    for (std::size_t k = 0; k < offsets.size() && dither; ++k)
        offsets[k] = bayer(int(k / 3 % 8), y);
    for (std::size_t begin = 0; begin < texels.size(); begin += kBatch) {
        const std::size_t first = std::size_t(y) * std::size_t(image.width) + begin;
        putTexels(
            image, texels.subspan(begin, std::min(kBatch, texels.size() - begin)),
            [first](std::size_t i) { return first + i; }, offsets);
    }
}

// The texel from which each texel is filled: itself if it has a value, kNoTexel if there is none near enough.
std::vector<std::uint32_t> nearestFilled(const Baked& baked, const Baked& first, int radius)
{
    std::vector<std::uint32_t> owner(first.states.size(), kNoTexel);
    for (std::size_t i = 0; i < owner.size(); ++i)
        if ((first.states[i] & (texelCovered | texelTouched)) != 0 && baked.hasValue(first, i))
            owner[i] = std::uint32_t(i);
    propagateNearest(owner, baked.width, baked.height, TieBreak::above, radius);
    return owner;
}

constexpr std::size_t kPart = 1 << 14; // texels

struct Filled {
    std::uint32_t texel, owner;
};

template<class Texel> void copyFrom(std::span<const Filled> filled, Texel* texels)
{
    for (const Filled& f : filled)
        texels[f.texel] = texels[f.owner];
}

void copyFrom(std::span<const Filled> filled, Baked& baked)
{
    if (!baked.values.empty())
        copyFrom(filled, baked.values.data());
    else if (baked.image.type == PixelType::float32)
        copyFrom(filled, reinterpret_cast<std::array<float, 4>*>(baked.image.floats()));
    else if (baked.image.type == PixelType::unorm16)
        copyFrom(filled, reinterpret_cast<std::array<std::uint16_t, 4>*>(baked.image.words()));
    else
        copyFrom(filled, reinterpret_cast<std::array<std::uint8_t, 4>*>(baked.image.bytes8()));
    for (std::size_t i = 0; i < filled.size() && !baked.states.empty(); ++i)
        baked.states[filled[i].texel] = std::uint8_t(baked.states[filled[i].texel] | texelPadded);
}

// Copies texels of maps from their owners, which stay as they are.
void fillFrom(const std::vector<std::uint32_t>& owner, std::span<Baked* const> maps)
{
    parallelRanges(std::size_t(0), owner.size(), kPart, [&](std::size_t begin, std::size_t end) {
        std::vector<Filled> filled; // of a part whose list stays in the cache
        for (std::size_t part = begin; part < end; part += kPart) {
            filled.clear();
            for (std::size_t i = part; i < std::min(part + kPart, end); ++i)
                if (owner[i] != kNoTexel && owner[i] != i)
                    filled.push_back({std::uint32_t(i), owner[i]});
            for (Baked* const map : maps)
                copyFrom(filled, *map);
        }
    });
}

// Whether the texels with a value are those that are filled from themselves.
bool hasValuesIn(const Baked& baked, const Baked& first, const std::vector<std::uint32_t>& owner)
{
    if (baked.values.empty() && first.values.empty()) // known by first.found alone
        return baked.cancelled == first.cancelled;
    std::atomic<bool> same{true};
    parallelRanges(std::size_t(0), owner.size(), kPart, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end && same; ++i)
            if (baked.hasValue(first, i) != (owner[i] == i))
                same = false;
    });
    return same;
}

} // namespace

void padCharts(Baked& baked, int radius) { fillFrom(nearestFilled(baked, baked, radius), std::array{&baked}); }

void padCharts(std::vector<Baked>& maps, int radius)
{
    const Baked& first = maps.front();
    const std::vector<std::uint32_t> owner = nearestFilled(first, first, radius);
    std::vector<Baked*> alike;
    for (Baked& map : maps)
        if (&map == &first || hasValuesIn(map, first, owner))
            alike.push_back(&map);
        else
            fillFrom(nearestFilled(map, first, radius), std::array{&map});
    fillFrom(owner, alike);
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

    void convert(std::span<const glm::vec3> values, std::span<glm::vec3> texels) const
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

    // For texels without one.
    glm::vec3 empty() const
    {
        if (!holdsDirections(kind_))
            return glm::vec3(kind_ == BakeKind::curvature && !isFloat_ ? 0.5f : 0);
        return isInWorld(kind_) ? glm::vec3(f32::cotan_compress(0, format_.expansion))
                                : f32::cotan_encode_texel(glm::vec3(0, 0, 1), format_);
    }

private:
    // Inlines the portable text into the loop, which the compiler vectorises only if the format is a constant there.
    template<int kChannels, int kExpansion>
    static void encodeLanes(const Lanes3& in, Lanes3& out, const f32::cotan_normal_format& format)
    {
        runLanes([&] {
            f32::cotan_normal_format f = format;
            f.channels = kChannels < 0 ? f.channels : kChannels;
            f.expansion = kExpansion < 0 ? f.expansion : kExpansion;
            for (std::size_t i = 0; i < kLanes; ++i)
                out.set(i, f32::cotan_encode_texel(in.at(i), f));
        });
    }
    static auto encoderOf(const f32::cotan_normal_format& format)
    {
        constexpr int kXyz = COTAN_CHANNELS_XYZ;
        return format.channels != kXyz                 ? encodeLanes<-1, -1>
            : format.expansion == COTAN_EXPAND_EXACT   ? encodeLanes<kXyz, COTAN_EXPAND_EXACT>
            : format.expansion == COTAN_EXPAND_EXACT16 ? encodeLanes<kXyz, COTAN_EXPAND_EXACT16>
            : format.expansion == COTAN_EXPAND_BIASED  ? encodeLanes<kXyz, COTAN_EXPAND_BIASED>
                                                       : encodeLanes<kXyz, COTAN_EXPAND_SIGNED>;
    }
    static void encode(std::span<const glm::vec3> directions, std::span<glm::vec3> texels,
                       const f32::cotan_normal_format& format)
    {
        const auto encodeAll = encoderOf(format);
        Lanes3 in, out;
        for (std::size_t first = 0; first < directions.size(); first += kLanes) {
            const std::size_t count = std::min(kLanes, directions.size() - first);
            for (std::size_t i = 0; i < count; ++i)
                in.set(i, directions[first + i]);
            encodeAll(in, out, format);
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
    BakeKind kind_;
    bool isFloat_;
    float unit_, low_ = 0, scale_ = 1;
    Bounds box_;
    f32::cotan_normal_format format_;
};

} // namespace

Image emptyImage(const Baked& baked, BakeKind kind, const StoredAs& as)
{
    Image image = makeImage(baked.width, baked.height, as.type);
    putRow(image, 0, std::vector(std::size_t(baked.width), StoredValue(baked, kind, as).empty()), false);
    const auto row = std::ptrdiff_t(image.data.size()) / baked.height;
    for (int y = 1; y < baked.height; ++y)
        std::copy_n(image.data.begin(), row, image.data.begin() + y * row);
    return image;
}

StoreTexels texelStore(const Baked& baked, BakeKind kind, const StoredAs& as)
{
    return [stored = StoredValue(baked, kind, as)](std::span<const std::uint32_t> texels,
                                                   std::span<const glm::vec3> values, Image& image) {
        std::array<glm::vec3, kBatch> batch;
        for (std::size_t begin = 0; begin < texels.size(); begin += kBatch) {
            const std::size_t count = std::min(kBatch, texels.size() - begin);
            stored.convert(values.subspan(begin, count), batch);
            putTexels(
                image, {batch.data(), count}, [&](std::size_t i) { return std::size_t(texels[begin + i]); }, kHalves);
        }
    };
}

Image storeBaked(const Baked& baked, BakeKind kind, const StoredAs& as)
{
    Image image = makeImage(baked.width, baked.height, as.type);
    const StoredValue stored(baked, kind, as);
    const auto width = static_cast<std::size_t>(baked.width);
    parallelRanges<int>(0, baked.height, 1 + (1 << 14) / baked.width, [&](int begin, int end) {
        std::vector<glm::vec3> row(width);
        for (int y = begin; y != end; ++y) {
            stored.convert({&baked.values[std::size_t(y) * width], width}, row);
            putRow(image, y, row, as.dither);
        }
    });
    return image;
}

namespace {

// Sets a channel of an image to the red of another one, or without one to a constant.
template<class Component> void setChannel(Component* to, const Component* red, Component constant, std::size_t texels)
{
    parallelRanges(std::size_t(0), texels, kPart, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            to[4 * i] = red ? red[4 * i] : constant;
    });
}

} // namespace

Image packMaps(const std::vector<Baked>& maps, const std::vector<BakeKind>& kinds, const PackedMap& packed,
               const StoredAs& as)
{
    Image image = makeImage(maps.front().width, maps.front().height, as.type), made;
    for (std::size_t channel = 0; channel < 4; ++channel) {
        const Image* source = nullptr;
        if (const std::optional<BakeKind> kind = packed.kinds[channel]) {
            const Baked& map = maps[std::size_t(std::ranges::find(kinds, *kind) - kinds.begin())];
            source = map.values.empty() ? &map.image : &(made = storeBaked(map, *kind, as));
        }
        const float c = packed.constants[channel];
        const std::size_t texels = image.pixelCount();
        if (as.type == PixelType::unorm8)
            setChannel(image.bytes8() + channel, source ? source->bytes8() : nullptr, std::uint8_t(c * 255 + 0.5f),
                       texels);
        else if (as.type == PixelType::unorm16)
            setChannel(image.words() + channel, source ? source->words() : nullptr, std::uint16_t(c * 65535 + 0.5f),
                       texels);
        else
            setChannel(image.floats() + channel, source ? source->floats() : nullptr, c, texels);
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
