// When does a frame without stored tangents cost less than stored ones?
#pragma once

#include <algorithm>
#include <cmath>
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

// Pixels that are shaded for a triangle that covers so many, in the mean over where it lies. Pixels are shaded in
// quads of 2 x 2, all four where one is covered. The triangle is right-angled with two equal legs along the axes, as
// the timing grid has them. A quad is touched where one of its four centres is inside. So the mean number of quads is a
// quarter of the area that four copies of the triangle cover together, moved by 0 or 1 both ways. pixels >= 0. From
// two pixels on it is pixels + 2 sqrt(2 pixels); a triangle below half a pixel shades four for each that it hits.
inline double shadedPixels(double pixels)
{
    const double leg = std::sqrt(2 * pixels);
    // What copies share are smaller triangles of the same shape.
    const auto area = [&](double less) { return std::pow(std::max(leg - less, 0.0), 2) / 2; };
    return 4 * area(0) - 4 * area(1) + area(2);
}

// What a way to draw costs for each triangle and for each pixel that is shaded, in any unit.
struct TrianglePrice {
    double fixed = 0;
    double perPixel = 0;
    double of(double pixels) const { return fixed + perPixel * shadedPixels(pixels); }
};

// Where a costs less than b, by the pixels a triangle covers: between the two numbers. (0, infinity): everywhere; two
// zeros: nowhere.
struct PixelRange {
    double above = 0;
    double below = 0;
};
inline PixelRange cheaperRange(const TrianglePrice& a, const TrianglePrice& b)
{
    constexpr double kEverywhere = std::numeric_limits<double>::infinity();
    const double fixed = a.fixed - b.fixed, perPixel = a.perPixel - b.perPixel;
    if (fixed <= 0 && perPixel <= 0 && (fixed < 0 || perPixel < 0))
        return {0, kEverywhere};
    if (fixed >= 0 && perPixel >= 0)
        return {};
    double low = 0, high = 1; // shadedPixels grows without bound
    const double shaded = -fixed / perPixel;
    while (shadedPixels(high) < shaded)
        high *= 2;
    for (int i = 0; i < 60; ++i)
        (shadedPixels((low + high) / 2) < shaded ? low : high) = (low + high) / 2;
    return perPixel < 0 ? PixelRange{high, kEverywhere} : PixelRange{0, high};
}

} // namespace cotan::cost
