// Angles between images of directions, and their statistics.
#pragma once

#include <cstddef>
#include <vector>

#include "core/value_statistics.hpp"
#include "cotan/inspect.hpp"
#include "files/json.hpp"

namespace cotan {

// Returns for each pixel the angle in degrees between two float32 images of directions of the same size, or -1 if
// either has no surface (alpha 0) or no direction (zero length).
std::vector<float> anglesBetween(const Image& a, const Image& b);

// Sets all pixels to -1 that have a -1 among their eight neighbours or are at the border of the image. The remaining
// pixels are interior, so that coverage rules do not affect them. `degrees` has width*height entries.
void keepInterior(std::vector<float>& degrees, int width, int height);

// anglesBetween of interior pixels only (keepInterior), for shapes with slightly different coverage.
std::vector<float> interiorAngles(const Image& a, const Image& b);

// The fraction of compared pixels whose directions differ by more than 90 degrees; NaN if nothing was compared.
double shareOpposed(const std::vector<float>& degrees);

// Colours the angles: black 0, blue 0.5, green 2, yellow 5, red 15, white 45 and more; grey: not compared. unorm8.
Image heatMap(const std::vector<float>& degrees, int width, int height);

// Converts a float image of `output` to unorm8. Directions become n * 0.5 + 0.5 on surfaces and are transparent
// elsewhere. uv become their fractional parts in red and green. Depths become white (nearest) to dark grey (farthest)
// over the range of the image.
Image asColor(Output output, const Image& image);

// Accumulates angles. Percentiles as in core/value_statistics.hpp: exact up to 65,536 angles.
class AngleCounter {
public:
    void add(float degrees); // ignores negative and non-finite values
    AngleStatistics statistics();

private:
    ValueStatistics values_;
    std::size_t over1_ = 0, over5_ = 0;
};

AngleStatistics angleStatistics(const std::vector<float>& degrees);

// "pixels" is the count; the statistics of an empty set are written as null.
Json toJson(const AngleStatistics& s);

} // namespace cotan
