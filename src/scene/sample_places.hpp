// Where the samples of a pixel lie that are lit one by one, and the picture that they make together.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "cotan/packed_only.hpp"
#include "cotan/scene.hpp"
#include "scene/picture_text.hpp"

namespace cotan {

// More samples than these are not parts of one pixel's light, but lit at a place of their own.
inline constexpr int kMaxSharedSamples = 4;
inline constexpr int kPlaces = 16;
// Textures are read as finely as pixels of a quarter of the size would.
inline constexpr float kPlacesApart = 0.25f;

// From the middle of the pixel, in pixels of the raster. Every sixteenth of the pixel, cut into 1 x 16, 2 x 8, 4 x 4, 8
// x 2 or 16 x 1 parts, has one (a (0,4,2)-net: H. Niederreiter, Random Number Generation and Quasi-Monte Carlo Methods,
// 1992); of these nets one whose places are farthest apart, also from those of the pixels beside it: 0.198 of a pixel.
inline glm::dvec2 samplePlace(int index)
{
    constexpr std::array<int, kPlaces> kRows = {2, 12, 5, 8, 0, 11, 6, 15, 3, 9, 13, 4, 1, 10, 14, 7};
    return (glm::dvec2(index, kRows[std::size_t(index)]) + 0.5) / double(kPlaces) - 0.5;
}

// Writes a pixel as the image's type: float32 as it is; unorm8 as the levels of quantise.h.
// value: linear, colours times alpha. x, y: of the picture, upright.
inline void storePixel(Image& image, int x, int y, glm::vec4 value, bool dither)
{
    const std::size_t at = 4 * (std::size_t(y) * std::size_t(image.width) + std::size_t(x));
    if (image.type == PixelType::unorm8)
        value = f32::cotan_levels_of_pixel(value, std::uint32_t(x), std::uint32_t(y), dither);
    for (int c = 0; c < 4; ++c)
        if (image.type == PixelType::unorm8)
            image.bytes8()[at + std::size_t(c)] = std::uint8_t(value[c]);
        else
            image.floats()[at + std::size_t(c)] = value[c];
}

} // namespace cotan
