// A normal map without order.
#pragma once

#include "cotan/scene.hpp"

namespace cotan {

// 256 x 256 texels of 8 bits: slopes that are sums of random ones, each as wide as three texels. reach: of the numbers
// that are summed, six for each texel, evenly from -reach to reach; 0.135 gives slopes of 11 degrees (root mean
// square).
Image makeGrain(double reach);

} // namespace cotan
