// A weighted set of numbers, in short.
#pragma once

#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace cotan {

// Of an empty set, or one without weight, the count is 0 and the rest NaN: no comparison with a limit holds.
struct Spread {
    std::size_t count = 0; // of the values that count
    double mean = std::numeric_limits<double>::quiet_NaN();
    double percentile95 =
        std::numeric_limits<double>::quiet_NaN(); // the smallest value that 95 % of the weight does not exceed
    double maximum = std::numeric_limits<double>::quiet_NaN();
};

// The spread of pairs (value, weight). Pairs whose weight is not above 0 or whose value is not finite
// are left out.
Spread spreadOf(std::vector<std::pair<double, double>> weighted);

} // namespace cotan
