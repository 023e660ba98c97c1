// How a normal map of a picture is stored, for the portable text.
#pragma once

#include "cotan/convention.hpp"
#include "cotan/scene.hpp"

namespace cotan {

// Format: f32:: or f64::cotan_normal_format. type: of the components that are read or written; zero lies at
// the middle of its range. strength: factor on the slopes.
template<class Format> Format toFormat(const Convention& c, PixelType type, double strength = 1)
{
    return toFormat<Format>(c, strength, bitsPerComponent(type));
}

// The convention of a map that is used in a scene, where v runs down: green up and down are those of the picture.
constexpr Convention inScene(Convention c)
{
    c.v = VDirection::down;
    return c;
}

} // namespace cotan
