#include "cotan/lint/spread.hpp"

#include <algorithm>
#include <cmath>

namespace cotan {

Spread spreadOf(std::vector<std::pair<double, double>> weighted)
{
    std::erase_if(weighted, [](const auto& p) { return !(p.second > 0) || !std::isfinite(p.first * p.second); });
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

} // namespace cotan
