// A weighted set of numbers, in short.
#pragma once

#include <utility>
#include <vector>

namespace cotan {

// All zero for an empty set or one without weight.
struct Spread {
    double mean = 0;
    double percentile95 = 0; // the smallest value that 95 % of the weight does not exceed
    double maximum = 0;
};

// The spread of pairs (value, weight). Pairs whose weight is not above 0 or whose value is not finite
// are left out.
Spread spreadOf(std::vector<std::pair<double, double>> weighted);

} // namespace cotan
