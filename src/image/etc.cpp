#include "image/etc.hpp"

#include <algorithm>
#include <cstdint>

#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "image/block_rows.hpp"
#include "image/component_types.hpp"

namespace cotan {

namespace {

// The bits of a block, whose first byte is the highest.
std::uint64_t bitsOf(const std::byte* block)
{
    std::uint64_t bits = 0;
    for (int i = 0; i < 8; ++i)
        bits = bits << 8 | std::uint64_t(block[i]);
    return bits;
}

// `count` bits, of which `lowest` is the lowest.
int field(std::uint64_t bits, int lowest, int count) { return int(bits >> lowest & ((1u << count) - 1)); }

// Texel i of the bits of a block is at column i / 4, row i % 4.
int placeOf(int i) { return i % 4 * 4 + i / 4; }

// Repeats the highest bits below the lowest, so that the largest value becomes 255.
int from4(int value) { return value * 17; }
int from5(int value) { return value << 3 | value >> 2; }
int from6(int value) { return value << 2 | value >> 4; }
int from7(int value) { return value << 1 | value >> 6; }

glm::ivec4 clamped(const glm::ivec3& color) { return {glm::clamp(color, 0, 255), 255}; }

// ---- colours --------------------------------------------------------------------------------

// A texel has an index of two bits: the high ones of all texels are bits 16 to 31, the low ones bits 0 to 15.
int indexOf(std::uint64_t bits, int i) { return field(bits, 16 + i, 1) << 1 | field(bits, i, 1); }

constexpr std::array<int, 8> kDistances{3, 6, 11, 16, 23, 32, 41, 64};
constexpr glm::ivec4 kTransparent{0, 0, 0, 0};

// Two halves, each of one colour that every texel makes lighter or darker.
void decodeHalves(std::uint64_t bits, const std::array<glm::ivec3, 2>& colors, bool opaque, BlockTexels& texels)
{
    const std::array<int, 2> tables{field(bits, 37, 3), field(bits, 34, 3)};
    const bool flipped = field(bits, 32, 1) != 0;
    for (int i = 0; i < 16; ++i) {
        const int half = (flipped ? i % 4 : i / 4) / 2, index = indexOf(bits, i);
        const auto& [small, large] = kEtcModifiers[std::size_t(tables[std::size_t(half)])];
        const int size = index % 2 != 0 ? large : opaque ? small : 0;
        texels[std::size_t(placeOf(i))] =
            !opaque && index == 2 ? kTransparent : clamped(colors[std::size_t(half)] + (index / 2 != 0 ? -size : size));
    }
}

void decodePaints(std::uint64_t bits, const std::array<glm::ivec3, 4>& paints, bool opaque, BlockTexels& texels)
{
    for (int i = 0; i < 16; ++i) {
        const int index = indexOf(bits, i);
        texels[std::size_t(placeOf(i))] = !opaque && index == 2 ? kTransparent : clamped(paints[std::size_t(index)]);
    }
}

glm::ivec3 rgb4(int red, int green, int blue) { return {from4(red), from4(green), from4(blue)}; }

// Modes "T" and "H" of ETC2: four colours from two.
void decodeT(std::uint64_t bits, bool opaque, BlockTexels& texels)
{
    const glm::ivec3 one = rgb4(field(bits, 59, 2) << 2 | field(bits, 56, 2), field(bits, 52, 4), field(bits, 48, 4));
    const glm::ivec3 other = rgb4(field(bits, 44, 4), field(bits, 40, 4), field(bits, 36, 4));
    const int distance = kDistances[std::size_t(field(bits, 34, 2) << 1 | field(bits, 32, 1))];
    decodePaints(bits, {one, other + distance, other, other - distance}, opaque, texels);
}

void decodeH(std::uint64_t bits, bool opaque, BlockTexels& texels)
{
    const std::array<int, 3> one{field(bits, 59, 4), field(bits, 56, 3) << 1 | field(bits, 52, 1),
                                 field(bits, 51, 1) << 3 | field(bits, 47, 3)};
    const std::array<int, 3> other{field(bits, 43, 4), field(bits, 39, 4), field(bits, 35, 4)};
    const int index = field(bits, 34, 1) << 2 | field(bits, 32, 1) << 1 | (one >= other ? 1 : 0);
    const int distance = kDistances[std::size_t(index)];
    const glm::ivec3 a = rgb4(one[0], one[1], one[2]), b = rgb4(other[0], other[1], other[2]);
    decodePaints(bits, {a + distance, a - distance, b + distance, b - distance}, opaque, texels);
}

// A plane through three colours: at the origin, four texels to the right, four below.
void decodePlanar(std::uint64_t bits, BlockTexels& texels)
{
    const glm::ivec3 origin{from6(field(bits, 57, 6)), from7(field(bits, 56, 1) << 6 | field(bits, 49, 6)),
                            from6(field(bits, 48, 1) << 5 | field(bits, 43, 2) << 3 | field(bits, 39, 3))};
    const glm::ivec3 right{from6(field(bits, 34, 5) << 1 | field(bits, 32, 1)), from7(field(bits, 25, 7)),
                           from6(field(bits, 19, 6))};
    const glm::ivec3 below{from6(field(bits, 13, 6)), from7(field(bits, 6, 7)), from6(field(bits, 0, 6))};
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) {
            const glm::ivec3 sum = x * (right - origin) + y * (below - origin) + 4 * origin + 2;
            texels[std::size_t(4 * y + x)] = clamped({sum.x >> 2, sum.y >> 2, sum.z >> 2});
        }
}

// punched: alpha is 0 or 1, and all colours are differences.
void decodeColors(std::uint64_t bits, bool punched, BlockTexels& texels)
{
    const bool flag = field(bits, 33, 1) != 0, opaque = !punched || flag;
    std::array<glm::ivec3, 2> colors;
    if (!punched && !flag) {
        for (int c = 0; c < 3; ++c) {
            colors[0][c] = from4(field(bits, 60 - 8 * c, 4));
            colors[1][c] = from4(field(bits, 56 - 8 * c, 4));
        }
        return decodeHalves(bits, colors, opaque, texels);
    }
    glm::ivec3 second;
    for (int c = 0; c < 3; ++c) {
        const int first = field(bits, 59 - 8 * c, 5), difference = field(bits, 56 - 8 * c, 3);
        second[c] = first + (difference >= 4 ? difference - 8 : difference);
        colors[0][c] = from5(first);
        colors[1][c] = from5(second[c] & 31);
    }
    const auto outside = [](int value) { return value < 0 || value > 31; }; // another mode of ETC2
    if (outside(second.x))
        decodeT(bits, opaque, texels);
    else if (outside(second.y))
        decodeH(bits, opaque, texels);
    else if (outside(second.z))
        decodePlanar(bits, texels);
    else
        decodeHalves(bits, colors, opaque, texels);
}

// ---- one channel ----------------------------------------------------------------------------

int modifierOf(std::uint64_t bits, int i)
{
    return kEacModifiers[std::size_t(field(bits, 48, 4))][std::size_t(field(bits, 45 - 3 * i, 3))];
}

enum class EacKind { alpha, eleven, signedEleven };

// Alpha of 8 bits, or another channel of 11 bits, which becomes one of 16.
void decodeChannel(std::uint64_t bits, EacKind kind, int channel, BlockTexels& texels)
{
    const int base = field(bits, 56, 8), factor = field(bits, 52, 4), step = factor > 0 ? 8 * factor : 1;
    for (int i = 0; i < 16; ++i) {
        const int modifier = modifierOf(bits, i);
        int value = 0;
        if (kind == EacKind::alpha) {
            value = std::clamp(base + modifier * factor, 0, 255);
        } else if (kind == EacKind::eleven) {
            value = (std::clamp(8 * base + 4 + modifier * step, 0, 2047) * 65535 + 1023) / 2047;
        } else { // a base of -128 is -127
            const int signedBase = std::max(base < 128 ? base : base - 256, -127);
            value = unormOfSigned(std::clamp(8 * signedBase + modifier * step, -1023, 1023), 1023);
        }
        texels[std::size_t(placeOf(i))][channel] = value;
    }
}

bool isSigned(EtcCode code) { return code == EtcCode::r11Signed || code == EtcCode::rg11Signed; }

void decodeBlock(EtcCode code, const std::byte* block, BlockTexels& texels)
{
    switch (code) {
    case EtcCode::rgb: return decodeColors(bitsOf(block), false, texels);
    case EtcCode::rgbPunchedAlpha: return decodeColors(bitsOf(block), true, texels);
    case EtcCode::rgba:
        decodeColors(bitsOf(block + 8), false, texels);
        return decodeChannel(bitsOf(block), EacKind::alpha, 3, texels);
    case EtcCode::r11:
    case EtcCode::r11Signed:
        decodeChannel(bitsOf(block), isSigned(code) ? EacKind::signedEleven : EacKind::eleven, 0, texels);
        for (glm::ivec4& t : texels)
            t = {t.x, t.x, t.x, 65535};
        return;
    case EtcCode::rg11:
    case EtcCode::rg11Signed:
        for (int c = 0; c < 2; ++c)
            decodeChannel(bitsOf(block + 8 * c), isSigned(code) ? EacKind::signedEleven : EacKind::eleven, c, texels);
        for (glm::ivec4& t : texels)
            t = {t.x, t.y, 32768, 65535};
        return;
    }
}

} // namespace

std::size_t etcBytes(EtcCode code)
{
    return code == EtcCode::rgba || code == EtcCode::rg11 || code == EtcCode::rg11Signed ? 16 : 8;
}

void decodeEtc(EtcCode code, std::span<const std::byte> blocks, Image& image)
{
    const std::size_t bytes = etcBytes(code);
    decodeBlockRows(image, [&](std::size_t block, BlockTexels& texels) {
        decodeBlock(code, blocks.data() + block * bytes, texels);
    });
}

} // namespace cotan
