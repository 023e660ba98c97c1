// Mean, percentiles and maximum of many weighted values: angles in degrees, and ratios.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace cotan {

// Accepts values one by one. Up to kExactValues values the results are exact. Beyond that a percentile is the upper end
// of one of 4096 bins per octave, so it is too large by at most 1/4096, but never above the maximum. An octave with
// values takes 32 KiB.
class ValueStatistics {
public:
    static constexpr std::size_t kExactValues = 1 << 16;

    // value: not negative. Ignored if it is not finite, or if its weight is not above 0.
    void add(double value, double weight = 1);

    std::size_t count() const { return count_; }

    // These three are NaN if there are no values; comparisons with a limit are then false.
    double mean() const;
    double maximum() const;
    // Returns the smallest value that a fraction `fraction`, in (0,1], of the weight does not exceed. Sorts the values.
    double percentile(double fraction);

private:
    void addToBin(double value, double weight);

    std::vector<std::pair<double, double>> exact_;
    std::vector<std::vector<double>> octaves_; // weights by bin, or empty; no octaves while `exact_` holds everything
    std::size_t count_ = 0;
    double total_ = 0, sum_ = 0, maximum_ = 0;
};

} // namespace cotan
