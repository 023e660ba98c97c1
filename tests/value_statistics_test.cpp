#include "core/value_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace cotan {
namespace {

ValueStatistics of(const std::vector<std::pair<double, double>>& weighted)
{
    ValueStatistics s;
    for (const auto& [value, weight] : weighted)
        s.add(value, weight);
    return s;
}

TEST(ValueStatistics, weighTheirValues)
{
    ValueStatistics s = of({{2, 2}, {1, 94}, {8, 4}});
    EXPECT_EQ(s.count(), 3u);
    EXPECT_EQ(s.mean(), 1.3); // (2 * 2 + 94 + 8 * 4) / 100
    EXPECT_EQ(s.maximum(), 8);
    EXPECT_EQ(s.percentile(0.94), 1);
    EXPECT_EQ(s.percentile(0.95), 2);
    EXPECT_EQ(s.percentile(0.96), 2);
    EXPECT_EQ(s.percentile(0.97), 8);
    EXPECT_EQ(s.percentile(1), 8);
    s.add(0.5, 100); // after percentile() has sorted the values
    EXPECT_EQ(s.percentile(0.5), 0.5);
    EXPECT_EQ(s.percentile(0.51), 1);
    EXPECT_EQ(s.percentile(0.01), 0.5);
}

TEST(ValueStatistics, ignoreInvalidValuesAndWeights)
{
    ValueStatistics s = of({{3, 1}, {100, 0}, {NAN, 5}, {5, -1}, {INFINITY, 1}, {1, NAN}, {1, INFINITY}});
    EXPECT_EQ(s.count(), 1u);
    EXPECT_EQ(s.mean(), 3);
    EXPECT_EQ(s.maximum(), 3);
    EXPECT_EQ(s.percentile(1), 3);
}

TEST(ValueStatistics, areNanIfEmptyAndZeroForZeros)
{
    ValueStatistics none, zeros;
    zeros.add(0);
    EXPECT_EQ(none.count(), 0u);
    for (double x : {none.mean(), none.maximum(), none.percentile(0.5)})
        EXPECT_TRUE(std::isnan(x));
    for (double x : {zeros.mean(), zeros.maximum(), zeros.percentile(0.5)})
        EXPECT_EQ(x, 0);
}

TEST(ValueStatistics, areAccurateToOneIn4096BeyondTheExactValues)
{
    constexpr std::size_t kCount = 3 * ValueStatistics::kExactValues;
    std::vector<double> sorted;
    ValueStatistics s;
    double sum = 0, total = 0;
    for (std::size_t i = 0; i < kCount; ++i) {
        const double value = std::exp(double(i * 7919 % 100003) / 10000 - 5);
        const int weight = 1 + int(i % 3);
        s.add(value, weight);
        sorted.insert(sorted.end(), std::size_t(weight), value);
        sum += value * weight;
        total += weight;
        if (i + 1 == ValueStatistics::kExactValues
            || i == ValueStatistics::kExactValues) { // the last exact one, and the next
            std::sort(sorted.begin(), sorted.end());
            const double exact = sorted[std::size_t(std::ceil(0.95 * total)) - 1];
            EXPECT_GE(s.percentile(0.95), exact);
            EXPECT_LE(s.percentile(0.95), exact * (i < ValueStatistics::kExactValues ? 1 : 1 + 1 / 4096.0));
        }
    }
    std::sort(sorted.begin(), sorted.end());
    EXPECT_EQ(s.count(), kCount);
    EXPECT_NEAR(s.mean() / (sum / total), 1, 1e-12);
    EXPECT_EQ(s.maximum(), sorted.back());
    for (double part : {0.001, 0.5, 0.95, 0.99}) {
        const double exact = sorted[std::size_t(std::ceil(part * total)) - 1];
        EXPECT_GE(s.percentile(part), exact) << part;
        EXPECT_LE(s.percentile(part), exact * (1 + 1 / 4096.0)) << part;
    }
    EXPECT_EQ(s.percentile(1), sorted.back());
}

TEST(ValueStatistics, medianOfManyZerosIsZero)
{
    ValueStatistics s;
    for (std::size_t i = 0; i < 2 * ValueStatistics::kExactValues; ++i)
        s.add(i % 100 == 0 ? 7 : 0);
    EXPECT_EQ(s.percentile(0.5), 0);
    EXPECT_EQ(s.percentile(0.995), 7);
    EXPECT_EQ(s.maximum(), 7);
}

} // namespace
} // namespace cotan
