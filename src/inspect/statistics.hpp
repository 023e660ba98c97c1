// Numbers about a set of angles.
#pragma once

#include <cstddef>
#include <vector>

#include "core/value_statistics.hpp"
#include "cotan/inspect.hpp"
#include "files/report/json.hpp"

namespace cotan {

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
