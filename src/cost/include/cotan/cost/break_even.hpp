// When does a frame without stored tangents cost less than stored ones?
#pragma once

#include <limits>

namespace cotan::cost {

// Stored tangents cost `perVertex` more at every vertex than none; the frame without them
// `perPixel` more at every pixel. The frame without them wins while there are fewer pixels per
// vertex than the number returned: infinity where it costs nothing at the pixels, 0 where the
// vertices save nothing. Any unit, the same for both.
inline double pixelsPerVertex(double perVertex, double perPixel)
{
    if (perPixel <= 0)
        return std::numeric_limits<double>::infinity();
    return perVertex <= 0 ? 0 : perVertex / perPixel;
}

} // namespace cotan::cost
