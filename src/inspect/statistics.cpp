#include "inspect/statistics.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <numeric>

#include <fmt/format.h>
namespace cotan {

namespace {

double percentile(std::vector<float>& values, double q)
{
    const auto rank = std::ptrdiff_t(q * double(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + rank, values.end());
    return values[std::size_t(rank)];
}

double shareOver(const std::vector<float>& values, float limit)
{
    const auto n = std::count_if(values.begin(), values.end(), [&](float v) { return v > limit; });
    return double(n) / double(values.size());
}

} // namespace

AngleStatistics statisticsOf(std::vector<float> degrees)
{
    AngleStatistics s;
    s.count = degrees.size();
    if (degrees.empty())
        return s;
    s.mean = std::accumulate(degrees.begin(), degrees.end(), 0.0) / double(degrees.size());
    s.median = percentile(degrees, 0.5);
    s.percentile95 = percentile(degrees, 0.95);
    s.percentile99 = percentile(degrees, 0.99);
    s.maximum = *std::max_element(degrees.begin(), degrees.end());
    s.over1 = shareOver(degrees, 1);
    s.over5 = shareOver(degrees, 5);
    return s;
}

AngleHistogram::AngleHistogram() : counts_(std::size_t(1) << 20) {}

void AngleHistogram::add(float degrees)
{
    if (!(degrees >= 0))
        return;
    ++counts_[std::bit_cast<std::uint32_t>(degrees) << 1 >> 12]; // bits of positive floats sort as the floats do
    ++count_;
    over1_ += degrees > 1;
    over5_ += degrees > 5;
    sum_ += double(degrees);
    maximum_ = std::max(maximum_, degrees);
}

double AngleHistogram::percentile(double q) const
{
    const auto rank = std::size_t(q * double(count_ - 1));
    std::size_t below = 0;
    for (std::size_t i = 0; i < counts_.size(); ++i)
        if (below += counts_[i]; below > rank)
            return double(std::bit_cast<float>(std::uint32_t(i) << 11));
    return double(maximum_);
}

AngleStatistics AngleHistogram::statistics() const
{
    AngleStatistics s;
    s.count = count_;
    if (count_ == 0)
        return s;
    const double n = double(count_);
    s.mean = sum_ / n;
    s.median = percentile(0.5);
    s.percentile95 = percentile(0.95);
    s.percentile99 = percentile(0.99);
    s.maximum = double(maximum_);
    s.over1 = double(over1_) / n;
    s.over5 = double(over5_) / n;
    return s;
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
