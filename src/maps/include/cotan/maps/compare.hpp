// How far two normal maps are apart.
#pragma once

#include <vector>

#include "cotan/convention.hpp"
#include "cotan/scene/image.hpp"

namespace cotan::maps {

// Per texel the angle in degrees between two maps of the same size, each read with its own
// convention; -1 where one of the two is not a direction (not finite, or of no length).
std::vector<float> anglesBetween(const Image& a, const Convention& conventionA, const Image& b,
                                 const Convention& conventionB);

} // namespace cotan::maps
