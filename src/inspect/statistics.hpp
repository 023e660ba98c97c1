// Numbers about a set of angles.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "cotan/inspect.hpp"
#include "files/report/json.hpp"

namespace cotan {

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

// "pixels" is the count; the figures of an empty set are null when it is written.
Json toJson(const AngleStatistics& s);

} // namespace cotan
