// Angles: how far two pictures of directions are apart, and numbers about a set of them.
#pragma once

#include <cstddef>
#include <vector>

#include "core/value_statistics.hpp"
#include "cotan/inspect.hpp"
#include "files/report/json.hpp"

namespace cotan {

// Per pixel the angle in degrees between two float32 pictures of directions of the same size, or -1
// where one of the two has no surface (alpha 0) or no direction (zero length).
std::vector<float> anglesBetween(const Image& a, const Image& b);

// Sets to -1 all pixels that touch, among their eight neighbours, one that is -1 already: what
// remains is interior, where coverage rules play no part. Keeps width*height entries.
void keepInterior(std::vector<float>& degrees, int width, int height);

// anglesBetween of the pixels that keepInterior leaves: for shapes that cover a little more or less.
std::vector<float> interiorAngles(const Image& a, const Image& b);

// Share of compared pixels where the two directions point away from each other (over 90 degrees); NaN
// where nothing was compared.
double shareOpposed(const std::vector<float>& degrees);

// A picture of the angles: black 0, blue 0.5, green 2, yellow 5, red 15, white 45 and more; grey
// where nothing was compared. unorm8.
Image heatMap(const std::vector<float>& degrees, int width, int height);

// A float picture of that kind as one of unorm8. Directions are n * 0.5 + 0.5 where there is surface, transparent
// elsewhere; of uv the fractional parts are red and green; of depths near is white, far is dark, over the range that
// occurs.
Image asColor(Output output, const Image& image);

// Counts angles one by one. Percentiles are those of core/value_statistics.hpp: exact up to 65,536 angles.
class AngleCounter {
public:
    void add(float degrees); // left out where it is negative or not finite
    AngleStatistics statistics();

private:
    ValueStatistics values_;
    std::size_t over1_ = 0, over5_ = 0;
};

AngleStatistics angleStatistics(const std::vector<float>& degrees);

// "pixels" is the count; the figures of an empty set are null when it is written.
Json toJson(const AngleStatistics& s);

} // namespace cotan
