// Encoders for blocks of 4 x 4 texels: BC5, BC3 and EAC for two channels of normals, BC7 for three and alpha, BC4 for
// one channel.
#pragma once

#include <cstddef>
#include <vector>

#include "cotan/scene.hpp"

namespace cotan::maps {

// A code c of 0 to 255 is decoded to (c - zero) / unit.
struct CodeScale {
    float zero = 128, unit = 127;
};

// Encodes x and y of unit vectors, from which z follows, as BC5: 16 bytes per block, rows of blocks from the top.
// Minimises decoded angles, not code differences. map: float32; red and green are (x + 1) / 2 and (y + 1) / 2. The
// bytes do not depend on the number of threads.
std::vector<std::byte> encodeBc5(const Image& map, const CodeScale& scale);

// The same as BC5_SNORM, whose codes -127 to 127 are -1 to 1: one scale, and an exact zero.
std::vector<std::byte> encodeBc5Signed(const Image& map);

// Encodes x, y and z of unit vectors, and alpha, as BC7: 16 bytes per block, all modes but 2. Minimises errors of
// angles and alpha or, with `lengths`, of vectors and alpha. map: float32; red, green and blue are (n + 1) / 2. Blocks
// whose alpha is 1 keep it exactly. The bytes do not depend on the number of threads.
std::vector<std::byte> encodeBc7(const Image& map, const CodeScale& scale, bool lengths = false);

// The same as BC3 with x in alpha and y in green, "DXT5nm": red and blue are 1. Green has 6 bits and four steps, so
// this is less exact than BC5.
std::vector<std::byte> encodeBc3(const Image& map, const CodeScale& scale);

// Encodes x, y and z of unit vectors as UASTC: 16 bytes per block. Minimises errors of angles or, with `lengths`, of
// vectors. map: float32, as for encodeBc7; alpha becomes 1. The bytes do not depend on the number of threads.
std::vector<std::byte> encodeUastc(const Image& map, const CodeScale& scale, bool lengths = false);

// As encodeBc5, as EAC RG11: the codes of `scale` are those of 11 bits, 0 to 2047.
std::vector<std::byte> encodeEacRg11(const Image& map, const CodeScale& scale);

// Encodes red, 0 to 1, as EAC R11: 8 bytes per block, least squares. image: float32.
std::vector<std::byte> encodeEacR11(const Image& image);

// Encodes red, 0 to 1, as BC4: 8 bytes per block, least squares. image: float32.
std::vector<std::byte> encodeBc4(const Image& image);

} // namespace cotan::maps
