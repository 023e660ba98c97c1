// Mean, percentiles and maximum of many values, each with its weight: for angles in degrees, and ratios.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace cotan {

// Values come one by one. Up to kExactValues everything is exact. Beyond that a percentile is the upper end of one of
// 4096 bins an octave, so too large by 1/4096 at most, and never above the maximum; an octave with values takes 32 KiB.
class ValueStatistics {
public:
    static constexpr std::size_t kExactValues = 1 << 16;

    // value: not below 0. Left out where it is not finite, or where its weight is not above 0.
    void add(double value, double weight = 1);

    std::size_t count() const { return count_; }

    // Of no values, these three are NaN: no comparison with a limit holds.
    double mean() const;
    double maximum() const;
    // The smallest value that a share `part`, in (0,1], of the weight does not exceed. Sorts what was added.
    double percentile(double part);

private:
    void addToBin(double value, double weight);

    std::vector<std::pair<double, double>> exact_;
    std::vector<std::vector<double>> octaves_; // weights by bin, or nothing; empty while `exact_` holds everything
    std::size_t count_ = 0;
    double total_ = 0, sum_ = 0, maximum_ = 0;
};

} // namespace cotan
