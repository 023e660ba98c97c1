#include "image/uastc.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

#include <fmt/format.h>

#include "image/uastc_modes.hpp"

namespace cotan {

namespace {

using UastcTexel = std::array<std::uint8_t, 4>;
using UastcTexels = std::array<UastcTexel, 16>; // by rows

// A block of 128 bits, taken from the lowest bit of the first byte upwards.
class UastcBits {
public:
    explicit UastcBits(const std::byte* block)
    {
        for (int i = 7; i >= 0; --i) {
            low_ = low_ << 8 | std::uint64_t(block[i]);
            high_ = high_ << 8 | std::uint64_t(block[8 + i]);
        }
    }

    int peek(int count) const { return int(low_ & ((std::uint64_t(1) << count) - 1)); }

    // count: at most 31.
    int take(int count)
    {
        if (count == 0)
            return 0;
        const int value = peek(count);
        low_ = low_ >> count | high_ << (64 - count);
        high_ >>= count;
        return value;
    }

private:
    std::uint64_t low_ = 0, high_ = 0;
};

// The same for subsets of which two are merged, and for three.
constexpr std::array<std::uint32_t, 19> kMergedSubsets{0x00f0, 0x4444, 0x0133, 0xcc80, 0xf0ff, 0x2222, 0xffc8,
                                                       0xccce, 0x3c03, 0x00ee, 0x7700, 0x3003, 0x00ce, 0xff80,
                                                       0x6fff, 0x1333, 0x11ff, 0x136c, 0x00ef};
constexpr std::array<std::uint32_t, 11> kThreeSubsets{0xa5a50000, 0xaa005555, 0xaa000055, 0x0000aa55,
                                                      0x25252525, 0x94949494, 0x58585858, 0x56560202,
                                                      0x92929292, 0x55aa0055, 0xa05050a0};

// Mode by the lowest 7 bits of a block; -1: none.
constexpr std::array<std::int8_t, 128> kModeOfBits = [] {
    std::array<std::int8_t, 128> modes{};
    for (int bits = 0; bits < 128; ++bits) {
        modes[std::size_t(bits)] = -1;
        for (int mode = 0; mode < int(kUastcModes.size()); ++mode)
            if ((bits & ((1 << kUastcModes[std::size_t(mode)].codeBits) - 1)) == kUastcModes[std::size_t(mode)].code)
                modes[std::size_t(bits)] = std::int8_t(mode);
    }
    return modes;
}();

// The partition of a block. Returns false if its number has none.
bool takeSubsets(UastcBits& bits, UastcPatterns patterns, std::array<int, 16>& subsets)
{
    subsets = {};
    if (patterns == UastcPatterns::none)
        return true;
    const bool three = patterns == UastcPatterns::three;
    const std::span<const std::uint32_t> table = patterns == UastcPatterns::two
        ? std::span<const std::uint32_t>(kTwoSubsetsOfUastc)
        : three ? std::span<const std::uint32_t>(kThreeSubsets)
                : std::span<const std::uint32_t>(kMergedSubsets);
    const auto number = std::size_t(bits.take(three ? 4 : 5));
    if (number >= table.size())
        return false;
    for (int i = 0; i < 16; ++i)
        subsets[std::size_t(i)] = three ? int(table[number] >> 2 * i & 3) : int(table[number] >> i & 1);
    return true;
}

// Endpoints by subset, end and channel.
using UastcEndpoints = std::array<std::array<std::array<int, 4>, 2>, 3>;

UastcEndpoints takeEndpoints(UastcBits& bits, const UastcMode& mode, int subsets)
{
    const int count = 2 * mode.channels * subsets;
    std::array<int, 18> digits{};
    const int group = uastcDigitsOfGroup(mode.levels);
    for (int first = 0; mode.levels > 1 && first < count; first += group) {
        int packed = bits.take(uastcBitsOfGroup(mode.levels, std::min(group, count - first)));
        for (int i = first; i < std::min(first + group, count); ++i, packed /= mode.levels)
            digits[std::size_t(i)] = packed % mode.levels;
    }
    UastcEndpoints ends{};
    int i = 0;
    for (int s = 0; s < subsets; ++s) {
        auto& [first, second] = ends[std::size_t(s)];
        first[3] = second[3] = 255;
        for (std::size_t c = 0; c < mode.channels; ++c)
            for (auto* end : {&first, &second}) {
                const int value = uastcEndpoint(mode.levels, digits[std::size_t(i++)], mode.endpointBits,
                                                bits.take(mode.endpointBits));
                (*end)[mode.channels == 2 && c == 1 ? 3 : c] = value;
            }
        if (mode.channels == 2) // luminance
            for (auto* end : {&first, &second})
                (*end)[1] = (*end)[2] = (*end)[0];
    }
    return ends;
}

bool decodeUastcBlock(UastcBits bits, UastcTexels& texels)
{
    const int number = kModeOfBits[std::size_t(bits.peek(7))];
    if (number < 0)
        return false;
    const UastcMode& mode = kUastcModes[std::size_t(number)];
    bits.take(mode.codeBits);
    if (number == kSolidUastc) {
        UastcTexel color{};
        for (std::uint8_t& c : color)
            c = std::uint8_t(bits.take(8));
        texels.fill(color);
        return true;
    }
    bits.take(mode.hintBits);
    std::array<int, 16> subsets{};
    if (!takeSubsets(bits, mode.patterns, subsets))
        return false;
    // The channel that the second plane of weights interpolates.
    const int own = mode.planes == 1 ? -1 : mode.channels == 2 ? 3 : bits.take(2);
    const UastcEndpoints ends = takeEndpoints(bits, mode, 1 + *std::ranges::max_element(subsets));
    int anchors = 0; // subsets whose first texel was met: the highest bit of its weight is 0 and not stored
    for (std::size_t i = 0; i < 16; ++i) {
        const int bit = 1 << subsets[i], stored = mode.weightBits - ((anchors & bit) == 0 ? 1 : 0);
        anchors |= bit;
        const int weight = uastcWeight(mode.weightBits, bits.take(stored));
        const int ownWeight = own < 0 ? weight : uastcWeight(mode.weightBits, bits.take(stored));
        const auto& [first, second] = ends[std::size_t(subsets[i])];
        for (std::size_t c = 0; c < 4; ++c) {
            const int w = int(c) == own ? ownWeight : weight;
            texels[i][c] = std::uint8_t((257 * first[c] * (64 - w) + 257 * second[c] * w + 32) >> 6 >> 8);
        }
    }
    return true;
}

} // namespace

Status decodeUastc(std::span<const std::byte> blocks, Image& image)
{
    const int across = (image.width + 3) / 4, down = (image.height + 3) / 4;
    UastcTexels texels{};
    for (int row = 0; row < down; ++row)
        for (int column = 0; column < across; ++column) {
            const std::size_t block = std::size_t(row) * std::size_t(across) + std::size_t(column);
            if (!decodeUastcBlock(UastcBits(blocks.data() + 16 * block), texels))
                return inputError(
                    fmt::format("UASTC: block {}, {} has no mode or no partition pattern that exists", column, row));
            for (int y = 0; y < std::min(4, image.height - 4 * row); ++y)
                for (int x = 0; x < std::min(4, image.width - 4 * column); ++x) {
                    const std::size_t at =
                        std::size_t(4 * row + y) * std::size_t(image.width) + std::size_t(4 * column + x);
                    std::copy_n(texels[std::size_t(4 * y + x)].data(), 4, image.bytes8() + 4 * at);
                }
        }
    return Done{};
}

} // namespace cotan
