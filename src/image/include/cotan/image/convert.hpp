// Between component types.
#pragma once

#include "cotan/scene/image.hpp"

namespace cotan {

// The same picture at 8 bits: floats are clamped to [0,1] (NaN is 0), 16 bits rounded.
Image toUnorm8(const Image& image);

} // namespace cotan
