// Makes the statistics of a weighted set of numbers.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "cotan/lint.hpp"

namespace cotan {

// The spread of pairs (value, weight). Pairs whose weight is not above 0 or whose value is not finite
// are left out.
Spread spreadOf(std::vector<std::pair<double, double>> weighted);

// The same for any number of values, which come one by one, in a few MiB at most. Up to kExactValues it is exact;
// beyond that percentiles are the upper end of one of 512 bins an octave, so too large by 0.2 % at most, and never
// above the maximum.
class SpreadCounter {
public:
    static constexpr std::size_t kExactValues = 1 << 16;

    // value: not below 0.
    void add(double value, double weight);
    Spread spread() const;
    // The value in the middle of all that count, their weights apart: half of them, rounded up, are not above it. 0 of
    // an empty set.
    double middle() const;

private:
    struct Bin {
        double weight = 0;
        std::size_t count = 0;
    };
    void addToBins(double value, double weight);

    std::vector<std::pair<double, double>> exact_;
    std::vector<Bin> bins_; // empty while `exact_` holds everything
    std::size_t count_ = 0;
    double total_ = 0, sum_ = 0, maximum_ = 0;
};

} // namespace cotan
