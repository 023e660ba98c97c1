// How different two pictures look to an eye that flips between them.
#pragma once

#include "cotan/scene.hpp"

namespace cotan::test {

// The mean over the pixels of `counted` (not 0 there; of the pictures' size, rows from the top) of the error of P.
// Andersson and others, FLIP: A Difference Evaluator for Alternating Images, 2020: 0 the same, 1 as black and white.
// Their standard viewer: 0.7 m from a screen 0.7 m wide of 3840 pixels. Alpha is not read. reference, picture: unorm8,
// sRGB, of one size.
double flipError(const Image& reference, const Image& picture, const std::vector<bool>& counted);

} // namespace cotan::test
