// Positions of a pixel's samples that are shaded one by one, and storing the resulting image.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "cotan/packed_only.hpp"
#include "cotan/scene.hpp"
#include "scene/render_text.hpp"

namespace cotan {

// Up to this number, samples of a pixel share one shading result; beyond, each is shaded at its own position.
inline constexpr int kMaxSharedSamples = 4;
inline constexpr int kSampleCount = 16;
// Factor on texture footprints, for samples that are shaded one by one.
inline constexpr float kSampleSpacing = 0.25f;

// Offset of a sample from the pixel's centre, in pixels of the raster. Each sixteenth of the pixel contains one sample,
// whether it is cut into 1 x 16, 2 x 8, 4 x 4, 8 x 2 or 16 x 1 parts: a (0,4,2)-net (H. Niederreiter, Random Number
// Generation and Quasi-Monte Carlo Methods, 1992). Among these nets this one has the maximum distance between samples,
// including those of neighbouring pixels: 0.198 pixels.
inline glm::dvec2 samplePosition(int index)
{
    constexpr std::array<int, kSampleCount> kRows = {2, 12, 5, 8, 0, 11, 6, 15, 3, 9, 13, 4, 1, 10, 14, 7};
    return (glm::dvec2(index, kRows[std::size_t(index)]) + 0.5) / double(kSampleCount) - 0.5;
}

// Stores a pixel in the image's type: float32 unchanged, unorm8 quantised as in quantise.h.
// value: linear, colours premultiplied by alpha. x, y: pixel of the upright image.
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
