// The modes of UASTC blocks, for reading and writing. Source: as uastc.hpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace cotan {

enum class UastcPatterns { none, two, merged, three }; // "merged": two subsets from three of BC7

struct UastcMode {
    std::uint8_t code, codeBits;
    std::uint8_t hintBits; // for transcoders, after the code
    UastcPatterns patterns;
    std::uint8_t planes;
    std::uint8_t channels; // of endpoints: 2 luminance and alpha, 3 RGB, 4 RGBA
    std::uint8_t levels;   // of a digit of an endpoint: 3 in trits, 5 in quints, 1 without digits
    std::uint8_t endpointBits;
    std::uint8_t weightBits;
};

inline constexpr int kSolidUastc = 8;

inline constexpr std::array<UastcMode, 19> kUastcModes{{{0x01, 4, 15, UastcPatterns::none, 1, 3, 3, 6, 4},
                                                        {0x35, 6, 15, UastcPatterns::none, 1, 3, 1, 8, 2},
                                                        {0x1d, 5, 15, UastcPatterns::two, 1, 3, 1, 4, 3},
                                                        {0x03, 5, 15, UastcPatterns::three, 1, 3, 3, 2, 2},
                                                        {0x13, 5, 15, UastcPatterns::two, 1, 3, 5, 3, 2},
                                                        {0x0b, 5, 15, UastcPatterns::none, 1, 3, 1, 8, 3},
                                                        {0x1b, 5, 15, UastcPatterns::none, 2, 3, 5, 5, 2},
                                                        {0x07, 5, 15, UastcPatterns::merged, 1, 3, 5, 3, 2},
                                                        {0x17, 5, 0, UastcPatterns::none, 0, 0, 0, 0, 0}, // one colour
                                                        {0x0f, 5, 23, UastcPatterns::two, 1, 4, 1, 4, 2},
                                                        {0x02, 3, 17, UastcPatterns::none, 1, 4, 3, 4, 4},
                                                        {0x00, 2, 17, UastcPatterns::none, 2, 4, 3, 4, 2},
                                                        {0x06, 3, 17, UastcPatterns::none, 1, 4, 3, 6, 3},
                                                        {0x1f, 5, 23, UastcPatterns::none, 2, 4, 1, 8, 1},
                                                        {0x0d, 5, 23, UastcPatterns::none, 1, 4, 1, 8, 2},
                                                        {0x05, 7, 23, UastcPatterns::none, 1, 2, 1, 8, 4},
                                                        {0x15, 6, 23, UastcPatterns::two, 1, 2, 1, 8, 2},
                                                        {0x25, 6, 23, UastcPatterns::none, 2, 2, 1, 8, 2},
                                                        {0x09, 4, 15, UastcPatterns::none, 1, 3, 1, 5, 5}}};

// The subset of texel i: bit i of two subsets, bits 2 i and 2 i + 1 of three. They are those of ASTC's partition
// function with certain seeds.
inline constexpr std::array<std::uint32_t, 30> kTwoSubsetsOfUastc{
    0xcccc, 0x8888, 0x1111, 0xecc8, 0x377f, 0xfeec, 0x0137, 0x137f, 0xc800, 0x0013,
    0xfe80, 0x17ff, 0x0017, 0x00ff, 0xfff0, 0x0fff, 0xff71, 0x8eff, 0x08ce, 0x008c,
    0x7310, 0xceff, 0x7331, 0x088c, 0xceef, 0x6666, 0xf00f, 0x5555, 0x0f0f, 0x36c9};
// An endpoint's value of 8 bits (ASTC, "Color Endpoint Unquantization"): `digit` of 3 or 5 levels and `low` bits.
inline int uastcEndpoint(int levels, int digit, int bits, int low)
{
    if (levels == 1)
        return bits == 8 ? low : bits == 5 ? low << 3 | low >> 2 : low * 17;
    const int invert = (low & 1) != 0 ? 0x1ff : 0, rest = low >> 1;
    int scale = 0, offset = 0;
    switch (bits) {
    case 2: scale = 93, offset = rest * 0x116; break;
    case 3: scale = 26, offset = rest << 7 | rest << 1 | rest >> 1; break;
    case 4: scale = 22, offset = rest << 6 | rest; break;
    case 5: scale = 6, offset = rest << 5 | rest >> 3; break;
    default: scale = 5, offset = rest << 4 | rest >> 4; break;
    }
    const int sum = (digit * scale + offset) ^ invert;
    return (invert & 0x80) | sum >> 2;
}

// Digits of endpoints are packed together: five trits in 8 bits, three quints in 7; fewer trits in the last group.
constexpr int uastcDigitsOfGroup(int levels) { return levels == 3 ? 5 : 3; }
constexpr int uastcBitsOfGroup(int levels, int digits)
{
    constexpr std::array<int, 6> kTritBits{0, 2, 4, 5, 7, 8};
    return levels == 3 ? kTritBits[std::size_t(digits)] : 7;
}

// A weight of 0 to 64.
inline int uastcWeight(int bits, int value)
{
    constexpr std::array<int, 6> kRepeated{0, 63, 21, 9, 0, 0};
    const int six = bits == 5 ? value << 1 | value >> 4
        : bits == 4           ? value << 2 | value >> 2
                              : value * kRepeated[std::size_t(bits)];
    return six > 32 ? six + 1 : six;
}

} // namespace cotan
