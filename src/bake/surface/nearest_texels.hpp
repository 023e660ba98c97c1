// Finds, for each texel that shows nothing, the nearest one that shows something.
#pragma once

#include <cstdint>
#include <span>

namespace cotan {

inline constexpr std::uint32_t kNoTexel = 0xffffffffu;

// Which of several texels that are equally near counts: that of the neighbour which is asked first.
enum class AskFirst {
    above,  // above, then the corners, then beside
    beside, // beside, then the corner, above, the other corner
};

// owner: row by row, width * height of them, fewer than kNoTexel: its own number for a texel that shows something,
// kNoTexel for others. Afterwards every texel has the number of one nearby that shows something. Two sweeps, down and
// up, pass the nearest on to the eight neighbours (P.-E. Danielsson, Euclidean distance mapping, 1980); `first` is for
// the sweep down, the other asks the opposite neighbours in that order. Off by a fraction of a texel at times. The
// image's borders do not join. All stay kNoTexel where nothing is shown.
void spreadNearest(std::span<std::uint32_t> owner, int width, int height, AskFirst first);

// The square of the distance of two texels of a picture, in texels.
std::int64_t distance2(std::uint32_t a, std::uint32_t b, int width);

} // namespace cotan
