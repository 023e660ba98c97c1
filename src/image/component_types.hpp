// Between component types.
#pragma once

#include "cotan/scene.hpp"

namespace cotan {

// The same picture at 8 bits: floats are clamped to [0,1] (NaN is 0), 16 bits rounded.
Image toUnorm8(const Image& image);

// Gives normals of two channels their third. Where blue is the middle and alpha 1 everywhere, as readers of BC5 and
// other two-channel pictures leave them, blue becomes what the length 1 leaves; other pictures stay.
void completeNormals(Image& image);

} // namespace cotan
