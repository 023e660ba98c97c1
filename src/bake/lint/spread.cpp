#include "cotan/lint.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "bake/lint/spread.hpp"

namespace cotan {

namespace {

// Bins by the exponent and the first bits of the mantissa of a float.
constexpr int kDropped = 23 - 9;
constexpr std::size_t kBins = std::size_t(0x80000000u) >> kDropped;

std::size_t binOf(double value) { return std::bit_cast<std::uint32_t>(float(std::abs(value))) >> kDropped; }

double upperEnd(std::size_t bin) { return double(std::bit_cast<float>(std::uint32_t((bin + 1) << kDropped))); }

bool counts(double value, double weight) { return weight > 0 && std::isfinite(value * weight); }

} // namespace

Spread spreadOf(std::vector<std::pair<double, double>> weighted)
{
    std::erase_if(weighted, [](const auto& p) { return !counts(p.first, p.second); });
    Spread s;
    if (weighted.empty())
        return s;
    s.count = weighted.size();
    std::sort(weighted.begin(), weighted.end());
    double total = 0, sum = 0;
    for (const auto& [value, weight] : weighted) {
        total += weight;
        sum += value * weight;
    }
    double reached = 0;
    for (const auto& [value, weight] : weighted) {
        reached += weight;
        s.percentile95 = value;
        if (reached >= 0.95 * total)
            break;
    }
    s.mean = sum / total;
    s.maximum = weighted.back().first;
    return s;
}

void SpreadCounter::add(double value, double weight)
{
    if (!counts(value, weight))
        return;
    if (bins_.empty()) {
        if (exact_.size() < kExactValues) {
            exact_.emplace_back(value, weight);
            return;
        }
        bins_.resize(kBins);
        for (const auto& [v, w] : exact_)
            addToBins(v, w);
        exact_ = {};
    }
    addToBins(value, weight);
}

void SpreadCounter::addToBins(double value, double weight)
{
    Bin& bin = bins_[binOf(value)];
    bin.weight += weight;
    ++bin.count;
    ++count_;
    total_ += weight;
    sum_ += value * weight;
    maximum_ = std::max(maximum_, value);
}

Spread SpreadCounter::spread() const
{
    if (bins_.empty())
        return spreadOf(exact_);
    Spread s{count_, sum_ / total_, maximum_, maximum_};
    double reached = 0;
    for (std::size_t i = 0; i < bins_.size(); ++i) {
        reached += bins_[i].weight;
        if (reached >= 0.95 * total_) {
            s.percentile95 = std::min(upperEnd(i), maximum_);
            break;
        }
    }
    return s;
}

double SpreadCounter::middle() const
{
    if (bins_.empty()) {
        std::vector<double> values;
        for (const auto& [value, weight] : exact_)
            values.push_back(value);
        if (values.empty())
            return 0;
        const auto at = values.begin() + std::ptrdiff_t(values.size() / 2);
        std::nth_element(values.begin(), at, values.end());
        return *at;
    }
    std::size_t reached = 0;
    for (std::size_t i = 0; i < bins_.size(); ++i) {
        reached += bins_[i].count;
        if (reached > count_ / 2)
            return std::min(upperEnd(i), maximum_);
    }
    return maximum_;
}

} // namespace cotan
