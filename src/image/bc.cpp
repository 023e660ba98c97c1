#include "image/bc.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "image/bc7_modes.hpp"
#include "image/block_rows.hpp"
#include "image/component_types.hpp"

namespace cotan {

namespace {

// Reads a block from the lowest bit of its first byte upwards.
class BcBits {
public:
    explicit BcBits(const std::byte* block) : block_(block) {}
    int take(int count)
    {
        int value = 0;
        for (int i = 0; i < count; ++i, ++at_)
            value |= (std::to_integer<int>(block_[at_ / 8]) >> at_ % 8 & 1) << i;
        return value;
    }

private:
    const std::byte* block_;
    std::size_t at_ = 0;
};

int average(int a, int b, int weightOfB, int parts)
{
    return ((parts - weightOfB) * a + weightOfB * b + parts / 2) / parts;
}

// Two colours of 5, 6 and 5 bits, and the two between them; or one, and transparent black, if `mayPunch` and the first
// is not the larger.
void decodeBcColors(const std::byte* block, bool mayPunch, BlockTexels& texels)
{
    BcBits bits(block);
    std::array<int, 2> stored{};
    std::array<glm::ivec4, 4> colors{};
    for (std::size_t i = 0; i < 2; ++i) {
        stored[i] = bits.take(16);
        colors[i] = {((stored[i] >> 11) * 527 + 23) >> 6, ((stored[i] >> 5 & 63) * 259 + 33) >> 6,
                     ((stored[i] & 31) * 527 + 23) >> 6, 255};
    }
    const bool punched = mayPunch && stored[0] <= stored[1];
    for (int c = 0; c < 3; ++c) {
        colors[2][c] = punched ? (colors[0][c] + colors[1][c] + 1) / 2 : average(colors[0][c], colors[1][c], 1, 3);
        colors[3][c] = punched ? 0 : average(colors[0][c], colors[1][c], 2, 3);
    }
    colors[2].w = 255;
    colors[3].w = punched ? 0 : 255;
    for (glm::ivec4& texel : texels)
        texel = colors[std::size_t(bits.take(2))];
}

// Two ends, and the values between them: six if the first end is larger, else four, the lowest and the highest.
void decodeBcChannel(const std::byte* block, bool isSigned, int channel, BlockTexels& texels)
{
    BcBits bits(block);
    std::array<int, 2> ends{bits.take(8), bits.take(8)};
    if (isSigned)
        for (int& end : ends)
            end = std::max(end < 128 ? end : end - 256, -127);
    const int parts = ends[0] > ends[1] ? 7 : 5;
    std::array<int, 8> values{};
    for (int i = 0; i <= parts; ++i) { // 0 and `parts` are the ends
        const int value = (parts - i) * ends[0] + i * ends[1];
        values[i == 0           ? 0u
                   : i == parts ? 1u
                                : std::size_t(i) + 1] =
            isSigned ? int(unormOfSigned(value, 127 * parts)) : (value + 1) / parts; // as OpenImageIO rounds
    }
    if (parts == 5) {
        values[6] = isSigned ? int(unormOfSigned(-1, 1)) : 0;
        values[7] = isSigned ? int(unormOfSigned(1, 1)) : 255;
    }
    for (glm::ivec4& texel : texels)
        texel[channel] = values[std::size_t(bits.take(3))];
}

void decodeBc7(const std::byte* block, BlockTexels& texels)
{
    BcBits bits(block);
    std::size_t number = 0;
    while (number < 8 && bits.take(1) == 0)
        ++number;
    texels.fill(glm::ivec4(0));
    if (number == 8)
        return;
    const bc7::Mode& mode = bc7::kModes[number];
    const int partition = bits.take(mode.partitionBits), rotation = bits.take(mode.rotationBits),
              selection = bits.take(mode.selectionBits);
    std::array<std::array<glm::ivec4, 2>, 3> ends{};
    const std::size_t subsets = std::size_t(mode.subsets);
    const auto bitsOf = [&](int c) { return c < 3 ? mode.colorBits : mode.alphaBits; };
    for (int c = 0; c < 4; ++c)
        for (std::size_t s = 0; s < subsets; ++s)
            for (glm::ivec4& end : ends[s])
                end[c] = bits.take(bitsOf(c));
    for (std::size_t s = 0; s < subsets; ++s) {
        int low = bits.take(mode.lowBits());
        for (std::size_t e = 0; e < 2; ++e) {
            if (e == 1 && mode.endBits > 0)
                low = bits.take(1);
            for (int c = 0; c < 4; ++c) {
                const int count = bitsOf(c) + mode.lowBits(), value = ends[s][e][c] << mode.lowBits() | low;
                ends[s][e][c] = bitsOf(c) == 0 ? 255 : value << (8 - count) | value >> (2 * count - 8);
            }
        }
    }
    std::array<int, 16> first{}, second{};
    std::array<int, 16> subset{};
    for (int i = 0; i < 16; ++i) {
        const int s = subset[std::size_t(i)] = bc7::subsetOf(mode.subsets, partition, i);
        first[std::size_t(i)] = bits.take(mode.indexBits - (i == bc7::anchorOf(mode.subsets, partition, s)));
    }
    for (std::size_t i = 0; i < 16; ++i)
        second[i] = mode.secondBits > 0 ? bits.take(mode.secondBits - (i == 0)) : first[i];
    int colorBits = mode.indexBits, alphaBits = mode.secondBits > 0 ? mode.secondBits : mode.indexBits;
    if (selection == 1) {
        std::swap(first, second);
        std::swap(colorBits, alphaBits);
    }
    const auto weightOf = [](int index, int count) {
        const int most = (1 << count) - 1;
        return (128 * index + most) / (2 * most);
    };
    for (std::size_t i = 0; i < 16; ++i) {
        const auto& [from, to] = ends[std::size_t(subset[i])];
        const int color = weightOf(first[i], colorBits), alpha = weightOf(second[i], alphaBits);
        for (int c = 0; c < 4; ++c)
            texels[i][c] = average(from[c], to[c], c < 3 ? color : alpha, 64);
        if (rotation > 0)
            std::swap(texels[i][rotation - 1], texels[i].w);
    }
}

void decodeBcBlock(BcCode code, const std::byte* block, BlockTexels& texels)
{
    switch (code) {
    case BcCode::bc1: return decodeBcColors(block, true, texels);
    case BcCode::bc2: {
        decodeBcColors(block + 8, false, texels);
        BcBits bits(block);
        for (glm::ivec4& texel : texels)
            texel.w = 17 * bits.take(4);
        return;
    }
    case BcCode::bc3: decodeBcColors(block + 8, false, texels); return decodeBcChannel(block, false, 3, texels);
    case BcCode::bc4:
    case BcCode::bc4Signed:
        decodeBcChannel(block, code == BcCode::bc4Signed, 0, texels);
        for (glm::ivec4& t : texels)
            t = {t.x, t.x, t.x, code == BcCode::bc4 ? 255 : 65535};
        return;
    case BcCode::bc5:
    case BcCode::bc5Signed:
        for (int c = 0; c < 2; ++c)
            decodeBcChannel(block + 8 * c, code == BcCode::bc5Signed, c, texels);
        for (glm::ivec4& t : texels)
            t = {t.x, t.y, code == BcCode::bc5 ? 128 : 32768, code == BcCode::bc5 ? 255 : 65535};
        return;
    case BcCode::bc7: return decodeBc7(block, texels);
    }
}

} // namespace

std::size_t bcBytes(BcCode code)
{
    return code == BcCode::bc1 || code == BcCode::bc4 || code == BcCode::bc4Signed ? 8 : 16;
}

void decodeBc(BcCode code, std::span<const std::byte> blocks, Image& image)
{
    const std::size_t bytes = bcBytes(code);
    decodeBlockRows(image, [&](std::size_t block, BlockTexels& texels) {
        decodeBcBlock(code, blocks.data() + block * bytes, texels);
    });
}

} // namespace cotan
