// Blocks of 4 x 4 texels for graphics processors: BC5 for two channels of normals, BC7 for three and alpha, BC4 for
// one.
#pragma once

#include <cstddef>
#include <vector>

#include "cotan/scene.hpp"

namespace cotan::maps {

// What a code of 0 to 255 stands for where a block is read: (code - zero) / unit.
struct CodeScale {
    float zero = 128, unit = 127;
};

// x and y of unit vectors, whose z is what their length leaves, as BC5: 16 bytes a block, rows of blocks from the top.
// Chosen is what decodes to the smallest angles, not to the closest codes. map: float32, red and green are (x + 1) / 2
// and (y + 1) / 2. The bytes do not depend on the number of threads.
std::vector<std::byte> encodeBc5(const Image& map, const CodeScale& scale);

// x, y and z of unit vectors, and alpha, as BC7: 16 bytes a block, of its mode 6 alone. Chosen is what decodes to the
// smallest angles and alphas; lengths: to the closest vectors, not only directions. map: float32, red, green and blue
// are (n + 1) / 2; where alpha is 1 in a block it stays so. The bytes do not depend on the number of threads.
std::vector<std::byte> encodeBc7(const Image& map, const CodeScale& scale, bool lengths = false);

// Red, 0 to 1, as BC4: 8 bytes a block, least squares. picture: float32.
std::vector<std::byte> encodeBc4(const Image& picture);

} // namespace cotan::maps
