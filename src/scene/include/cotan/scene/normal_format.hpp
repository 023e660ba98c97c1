// How a normal map is stored, for the portable text.
#pragma once

#include "cotan/convention.hpp"
#include "cotan/scene/scene.hpp"

namespace cotan {

// Format: f32:: or f64::cotan_normal_format. type: of the components that are read or written; zero lies at
// the middle of its range. strength: factor on the slopes.
template<class Format> Format toFormat(const NormalMapFormat& f, PixelType type, double strength = 1)
{
    using Real = decltype(Format::strength);
    return {expansionFor(f.expansion, bitsPerComponent(type)), f.channels, f.greenAlongV ? Real(1) : Real(-1), Real(strength)};
}

} // namespace cotan
