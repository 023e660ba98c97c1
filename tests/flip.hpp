// Perceived difference between two images that alternate.
#pragma once

#include "cotan/scene.hpp"

namespace cotan::test {

// Mean error over the pixels marked in `counted` (of the images' size, rows from the top), by P. Andersson and others,
// FLIP: A Difference Evaluator for Alternating Images, 2020: 0 if equal, 1 at most. Their standard viewer sits 0.7 m
// from a screen 0.7 m wide with 3840 pixels. Alpha is ignored. reference, picture: unorm8, sRGB, of the same size.
double flipError(const Image& reference, const Image& candidate, const std::vector<bool>& counted);

} // namespace cotan::test
