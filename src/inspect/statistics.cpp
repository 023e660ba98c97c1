#include "inspect/statistics.hpp"

#include <cmath>

#include <fmt/format.h>

namespace cotan {

void AngleCounter::add(float degrees)
{
    if (!(degrees >= 0) || !std::isfinite(degrees))
        return;
    values_.add(double(degrees));
    over1_ += degrees > 1;
    over5_ += degrees > 5;
}

AngleStatistics AngleCounter::statistics()
{
    if (values_.count() == 0)
        return {};
    const double n = double(values_.count());
    return {.count = values_.count(),
            .mean = values_.mean(),
            .median = values_.percentile(0.5),
            .percentile95 = values_.percentile(0.95),
            .percentile99 = values_.percentile(0.99),
            .maximum = values_.maximum(),
            .over1 = double(over1_) / n,
            .over5 = double(over5_) / n};
}

AngleStatistics angleStatistics(const std::vector<float>& degrees)
{
    AngleCounter counter;
    for (float d : degrees)
        counter.add(d);
    return counter.statistics();
}

std::string toText(const AngleStatistics& s)
{
    if (s.count == 0)
        return "nothing was compared";
    return fmt::format("mean {:.3f}, median {:.3f}, 95 % {:.3f}, 99 % {:.3f}, max {:.2f} degrees; "
                       "over 1: {:.1f} %, over 5: {:.1f} %",
                       s.mean, s.median, s.percentile95, s.percentile99, s.maximum, s.over1 * 100, s.over5 * 100);
}

Json toJson(const AngleStatistics& s)
{
    return {{"pixels", s.count},
            {"mean_degrees", s.mean},
            {"median_degrees", s.median},
            {"percentile95_degrees", s.percentile95},
            {"percentile99_degrees", s.percentile99},
            {"max_degrees", s.maximum},
            {"share_over_1_degree", s.over1},
            {"share_over_5_degrees", s.over5}};
}

} // namespace cotan
