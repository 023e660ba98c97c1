// Mean, 95 % and maximum of many angles in little memory.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "cotan/lint.hpp"

namespace cotan::convert {

// Angles in degrees. The 95 % is right to 4 % of its value: it is the upper end of a bin, of 64 a decade
// from 1e-5 up.
class Tally {
public:
    void add(double degrees)
    {
        if (bins_.empty())
            bins_.resize(kBins);
        const double decades = std::log10(std::max(degrees, kLeast) / kLeast);
        ++bins_[std::min(std::size_t(decades * kPerDecade), kBins - 1)];
        ++count_;
        sum_ += degrees;
        maximum_ = std::max(maximum_, degrees);
    }

    // The other's counts; its sum is added too, so the order of calls matters to the last bit.
    void add(const Tally& other)
    {
        if (bins_.empty())
            bins_.resize(kBins);
        for (std::size_t i = 0; i < other.bins_.size(); ++i)
            bins_[i] += other.bins_[i];
        count_ += other.count_;
        sum_ += other.sum_;
        maximum_ = std::max(maximum_, other.maximum_);
    }

    Spread spread() const
    {
        Spread s;
        if (count_ == 0)
            return s;
        s.count = std::size_t(count_);
        s.mean = sum_ / double(count_);
        s.maximum = maximum_;
        std::uint64_t reached = 0;
        for (std::size_t i = 0; i < kBins && double(reached) < 0.95 * double(count_); ++i) {
            reached += bins_[i];
            s.percentile95 = std::min(kLeast * std::pow(10.0, double(i + 1) / kPerDecade), maximum_);
        }
        return s;
    }

private:
    static constexpr double kLeast = 1e-5;
    static constexpr double kPerDecade = 64;
    static constexpr std::size_t kBins = 480; // up to 316 degrees
    std::vector<std::uint64_t> bins_;
    std::uint64_t count_ = 0;
    double sum_ = 0, maximum_ = 0;
};

} // namespace cotan::convert
