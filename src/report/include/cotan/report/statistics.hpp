// Numbers about a set of angles.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "cotan/report/json.hpp"

namespace cotan {

// What a statistic of nothing is: no number, so that no comparison with a limit holds.
inline constexpr double kOfNothing = std::numeric_limits<double>::quiet_NaN();

// All in degrees; `over1` and `over5` are shares in [0,1]. All but `count` are NaN for an empty set.
struct AngleStatistics {
    std::size_t count = 0;
    double mean = kOfNothing;
    double median = kOfNothing;
    double percentile95 = kOfNothing;
    double percentile99 = kOfNothing;
    double maximum = kOfNothing;
    double over1 = kOfNothing;
    double over5 = kOfNothing;
};

// The statistics of a list of finite angles. A percentile q is the value at rank
// floor(q * (count - 1)) of the sorted list. The list is taken by value: it is reordered.
AngleStatistics statisticsOf(std::vector<float> degrees);

// The same for more angles than memory holds: percentiles are known to 1/4096 of themselves (rounded down),
// all else as above. Takes 8 MiB.
class AngleHistogram {
public:
    AngleHistogram();
    void add(float degrees); // negative ones are left out
    AngleStatistics statistics() const;

private:
    double percentile(double q) const;
    std::vector<std::size_t> counts_; // by sign-free exponent and the first 12 bits of the fraction
    std::size_t count_ = 0, over1_ = 0, over5_ = 0;
    double sum_ = 0;
    float maximum_ = 0;
};

// "mean 0.17, median 0.12, 95 % 0.41, 99 % 0.62, max 0.88 degrees; over 1: 0.0 %, over 5: 0.0 %";
// "nothing was compared" for an empty set.
std::string toText(const AngleStatistics& s);
// "pixels" is the count; the figures of an empty set are null when it is written.
Json toJson(const AngleStatistics& s);

} // namespace cotan
