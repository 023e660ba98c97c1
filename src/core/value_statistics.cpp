#include "core/value_statistics.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace cotan {

namespace {

// Bins by the exponent and the first 12 bits of the fraction of a float: positive floats sort as their bits do.
constexpr int kDropped = 23 - 12;
constexpr std::size_t kBins = std::size_t(0x80000000u) >> kDropped;
constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

std::size_t binOf(double value) { return std::bit_cast<std::uint32_t>(float(std::abs(value))) >> kDropped; }

// The first bin is that of zero, and of what is below 1e-41.
double upperEnd(std::size_t bin)
{
    return bin == 0 ? 0 : double(std::bit_cast<float>(std::uint32_t((bin + 1) << kDropped)));
}

} // namespace

void ValueStatistics::add(double value, double weight)
{
    if (!(weight > 0) || !std::isfinite(value * weight))
        return;
    ++count_;
    total_ += weight;
    sum_ += value * weight;
    maximum_ = std::max(maximum_, value);
    if (!bins_.empty()) {
        bins_[binOf(value)] += weight;
        return;
    }
    exact_.emplace_back(value, weight);
    sorted_ = false;
    if (exact_.size() <= kExactValues)
        return;
    bins_.resize(kBins);
    for (const auto& [v, w] : exact_)
        bins_[binOf(v)] += w;
    exact_ = {};
}

double ValueStatistics::mean() const { return count_ > 0 ? sum_ / total_ : kNothing; }

double ValueStatistics::maximum() const { return count_ > 0 ? maximum_ : kNothing; }

double ValueStatistics::percentile(double part)
{
    if (count_ == 0)
        return kNothing;
    if (!sorted_)
        std::sort(exact_.begin(), exact_.end());
    sorted_ = true;
    double reached = 0;
    for (const auto& [value, weight] : exact_)
        if (reached += weight; reached >= part * total_)
            return value;
    for (std::size_t i = 0; i < bins_.size(); ++i)
        if (reached += bins_[i]; reached >= part * total_)
            return std::min(upperEnd(i), maximum_);
    return maximum_; // the sum in this order is less than the total, by rounding
}

} // namespace cotan
