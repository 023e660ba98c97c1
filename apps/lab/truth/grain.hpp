// A normal map of random grain.
#pragma once

#include "cotan/scene.hpp"

namespace cotan {

// Returns 256 x 256 texels of 8 bits. Each slope is a sum of random numbers, smoothed over three texels. reach: each
// texel sums six uniform numbers from -reach to reach; 0.135 gives slopes of 11 degrees (root mean square).
Image makeGrain(double reach);

} // namespace cotan
