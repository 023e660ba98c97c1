#include "core/value_statistics.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace cotan {

namespace {

// Bins by the exponent and the first 12 bits of the fraction of a float: positive floats are ordered like their bits.
constexpr int kDropped = 23 - 12;
constexpr std::size_t kOctaves = 256, kBins = 1 << 12; // bins per octave
constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

// The first bin contains zero and values below 1e-41.
double upperEnd(std::size_t bin)
{
    return bin == 0 ? 0 : double(std::bit_cast<float>(std::uint32_t((bin + 1) << kDropped)));
}

} // namespace

void ValueStatistics::addToBin(double value, double weight)
{
    const std::size_t at = std::bit_cast<std::uint32_t>(float(std::abs(value))) >> kDropped;
    std::vector<double>& bins = octaves_[at / kBins];
    bins.resize(kBins);
    bins[at % kBins] += weight;
}

void ValueStatistics::add(double value, double weight)
{
    if (!(weight > 0) || !std::isfinite(value * weight))
        return;
    ++count_;
    total_ += weight;
    sum_ += value * weight;
    maximum_ = std::max(maximum_, value);
    if (!octaves_.empty())
        return addToBin(value, weight);
    exact_.emplace_back(value, weight);
    if (exact_.size() <= kExactValues)
        return;
    octaves_.resize(kOctaves);
    for (const auto& [v, w] : exact_)
        addToBin(v, w);
    exact_ = {};
}

double ValueStatistics::mean() const { return count_ > 0 ? sum_ / total_ : kNothing; }

double ValueStatistics::maximum() const { return count_ > 0 ? maximum_ : kNothing; }

double ValueStatistics::percentile(double fraction)
{
    if (count_ == 0)
        return kNothing;
    std::sort(exact_.begin(), exact_.end());
    double reached = 0;
    for (const auto& [value, weight] : exact_)
        if (reached += weight; reached >= fraction * total_)
            return value;
    for (std::size_t octave = 0; octave < octaves_.size(); ++octave)
        for (std::size_t i = 0; i < octaves_[octave].size(); ++i)
            if (reached += octaves_[octave][i]; reached >= fraction * total_)
                return std::min(upperEnd(octave * kBins + i), maximum_);
    return maximum_; // rounding made the sum in this order smaller than total_
}

} // namespace cotan
