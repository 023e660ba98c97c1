// Blocks of ETC1, ETC2 and EAC: 4 x 4 texels in 8 or 16 bytes.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "cotan/scene.hpp"

namespace cotan {

enum class EtcCode {
    rgb,             // ETC2, and ETC1, which is a part of it; 8 bytes
    rgbPunchedAlpha, // alpha is 0 or 1; 8 bytes
    rgba,            // 16 bytes
    r11,             // EAC, 11 bits, unsigned; 8 bytes
    rg11,            // 16 bytes
    r11Signed,       // EAC, 11 bits, signed: read as unormOfSigned carries it; 8 bytes
    rg11Signed       // 16 bytes
};

// What a texel adds to or subtracts from the colour of its half: the smaller and the larger, by the number of a table.
inline constexpr std::array<std::array<int, 2>, 8> kEtcModifiers{
    {{2, 8}, {5, 17}, {9, 29}, {13, 42}, {18, 60}, {24, 80}, {33, 106}, {47, 183}}};

// Modifiers of a channel: a table by its number, a modifier by a texel's index.
inline constexpr std::array<std::array<int, 8>, 16> kEacModifiers{{{-3, -6, -9, -15, 2, 5, 8, 14},
                                                                   {-3, -7, -10, -13, 2, 6, 9, 12},
                                                                   {-2, -5, -8, -13, 1, 4, 7, 12},
                                                                   {-2, -4, -6, -13, 1, 3, 5, 12},
                                                                   {-3, -6, -8, -12, 2, 5, 7, 11},
                                                                   {-3, -7, -9, -11, 2, 6, 8, 10},
                                                                   {-4, -7, -8, -11, 3, 6, 7, 10},
                                                                   {-3, -5, -8, -11, 2, 4, 7, 10},
                                                                   {-2, -6, -8, -10, 1, 5, 7, 9},
                                                                   {-2, -5, -8, -10, 1, 4, 7, 9},
                                                                   {-2, -4, -8, -10, 1, 3, 7, 9},
                                                                   {-2, -5, -7, -10, 1, 4, 6, 9},
                                                                   {-3, -4, -7, -10, 2, 3, 6, 9},
                                                                   {-1, -2, -3, -10, 0, 1, 2, 9},
                                                                   {-4, -6, -8, -9, 3, 5, 7, 8},
                                                                   {-3, -5, -7, -9, 2, 4, 6, 8}}};

std::size_t etcBytes(EtcCode code); // per block

// Decodes blocks in rows from the top: ceil(width / 4) * ceil(height / 4) of them, which the caller checks. Every block
// is valid. EAC without RGB needs an image of unorm16, the others unorm8; grey and blue are as in other files of one
// and two channels. Source: Khronos Data Format Specification 1.3, chapters 20 and 21.
void decodeEtc(EtcCode code, std::span<const std::byte> blocks, Image& image);

} // namespace cotan
