// A base map and a detail map as one.
#pragma once

#include <cstddef>

#include "cotan/convention.hpp"
#include "cotan/scene/image.hpp"

namespace cotan::maps {

enum class BlendMode { reoriented, whiteout, udn, slopes, linear }; // cotan/blend.h says what each does

struct BlendSettings {
    Convention base{}, detail{}, to{};
    BlendMode mode = BlendMode::reoriented;
    float strength = 1;          // factor on the detail's slopes
    int tilesX = 1, tilesY = 1;  // how often the detail repeats over the base; at least 1
    const Image* mask = nullptr; // red times this much of the strength; any size; none: everywhere
    PixelType type = PixelType::unorm8;
    bool dither = false;
    int firstRow = 0, pictureHeight = 0; // the base is these rows of a picture of that height; 0: all of it
};

// The blend, of the base's size. The detail is filtered bilinearly and repeats; where it is shrunk it
// is averaged over the texel's footprint first, as vectors. invalid: texels where either is no direction;
// there the other one counts alone.
Image blend(const Image& base, const Image& detail, const BlendSettings& settings, std::size_t& invalid);

} // namespace cotan::maps
