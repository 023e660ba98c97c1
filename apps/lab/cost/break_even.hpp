// Break-even points: when does a frame without stored tangents cost less than one with them?
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace cotan::cost {

// Returns the number of pixels per vertex below which the frame without stored tangents is cheaper. Stored tangents
// cost `perVertex` more per vertex; the frame without them costs `perPixel` more per pixel. Infinity if it costs
// nothing per pixel, 0 if it saves nothing per vertex. Both arguments are in the same, arbitrary unit.
inline double pixelsPerVertex(double perVertex, double perPixel)
{
    if (perPixel <= 0)
        return std::numeric_limits<double>::infinity();
    return perVertex <= 0 ? 0 : perVertex / perPixel;
}

// Returns the mean number of pixels shaded for a triangle that covers `pixels` >= 0 pixels, averaged over its position.
// The triangle is right-angled with two equal legs along the axes, as in the timing grid. GPUs shade whole quads of 2 x
// 2 pixels, so a quad is shaded if one of its four centres is inside: the mean number of quads is a quarter of the area
// covered by four copies of the triangle, shifted by 0 or 1 along x and y. From two pixels on the result is pixels + 2
// sqrt(2 pixels); a triangle below half a pixel shades four pixels for each one it hits.
inline double shadedPixels(double pixels)
{
    const double leg = std::sqrt(2 * pixels);
    // The intersections of the copies are smaller triangles of the same shape.
    const auto area = [&](double less) { return std::pow(std::max(leg - less, 0.0), 2) / 2; };
    return 4 * area(0) - 4 * area(1) + area(2);
}

// Cost of a drawing method per triangle and per shaded pixel, in any unit.
struct TrianglePrice {
    double fixed = 0;
    double perPixel = 0;
    double of(double pixels) const { return fixed + perPixel * shadedPixels(pixels); }
};

// The triangle sizes, in covered pixels, at which `a` costs less than `b`: between the two numbers. (0, infinity) means
// always, (0, 0) never.
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
