// From one way of storing a normal map to another.
#pragma once

#include <cstdint>

#include <glm/vec4.hpp>

#include "cotan/convention.hpp"
#include "cotan/packed_only.hpp"
#include "cotan/scene/image.hpp"

namespace cotan::maps {

struct RecodeSettings {
    Convention from{}, to{};
    PixelType type = PixelType::unorm8; // of the result
    float strength = 1;                 // factor on the slopes; not 0
    bool normalise = false;             // three channels to three: otherwise lengths are kept
    bool dither = false;                // half a step of noise before rounding; flat stays flat
    int firstRow = 0;                   // where the rows lie in the picture, for the noise
};

// What could not be kept.
struct RecodeCounts {
    std::size_t invalid = 0; // not finite or without length: written as flat
    std::size_t clamped = 0; // slopes over 1, or directions below the horizon that the form cannot hold
};

// The map in the other form. Alpha is kept where both have three channels. Signed values need float32.
// Where nothing but the green channel changes and no length is touched, unorm values map one to one.
Image recode(const Image& map, const RecodeSettings& settings, RecodeCounts& counts);

// A number in [-0.5,0.5) for a component of a texel, the same on every run: for dithering.
float ditherNoise(std::uint32_t x, std::uint32_t y, std::uint32_t component);

// A texel with that noise, in steps of 1/steps, on its first three components; those that are a step
// already (within 0.001) stay: dithering must not make noise of what is exact, such as flat. steps 0: as it is.
glm::vec4 dithered(glm::vec4 texel, float steps, int x, int y);

} // namespace cotan::maps
