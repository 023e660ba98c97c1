// Images from blocks of 4 x 4 texels.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include <glm/vec4.hpp>

#include "cotan/scene.hpp"

namespace cotan {

using BlockTexels = std::array<glm::ivec4, 16>; // by rows; of 8 or 16 bits, as the image

// Fills an image of unorm8 or unorm16 from blocks in rows from the top. decode(k, texels): decodes block k.
template<class Decode> void decodeBlockRows(Image& image, const Decode& decode)
{
    const auto fill = [&]<class T>(T* to) {
        const int across = (image.width + 3) / 4, down = (image.height + 3) / 4;
        BlockTexels texels{};
        for (int row = 0; row < down; ++row)
            for (int column = 0; column < across; ++column) {
                decode(std::size_t(row) * std::size_t(across) + std::size_t(column), texels);
                for (int y = 0; y < std::min(4, image.height - 4 * row); ++y)
                    for (int x = 0; x < std::min(4, image.width - 4 * column); ++x) {
                        const std::size_t at =
                            std::size_t(4 * row + y) * std::size_t(image.width) + std::size_t(4 * column + x);
                        for (int c = 0; c < 4; ++c)
                            to[4 * at + std::size_t(c)] = T(texels[std::size_t(4 * y + x)][c]);
                    }
            }
    };
    if (image.type == PixelType::unorm16)
        fill(image.words());
    else
        fill(image.bytes8());
}

} // namespace cotan
