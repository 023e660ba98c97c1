// For texels that no triangle covers: which covered one is nearest.
#pragma once

#include <cstdint>
#include <vector>

namespace cotan::convert {

inline constexpr std::uint32_t kNoTexel = 0xffffffffu;

// owner: row by row, its own number for a covered texel, kNoTexel for others. Afterwards every texel has
// the number of a covered one nearby: two sweeps that pass the nearest on to the eight neighbours, exact
// up to a fraction of a texel. The image's borders do not join. All stay kNoTexel where nothing is covered.
void spread(std::vector<std::uint32_t>& owner, int width, int height);

} // namespace cotan::convert
