// docs/accuracy.csv must match what is measured. The random numbers are the same on every machine, so any change of a
// figure, for better or worse, means that the measured code changed. Record improvements with `cotan accuracy --csv
// docs/accuracy.csv`.
#include <gtest/gtest.h>

#include <cmath>

#include "report/measurements.hpp"
#include "run_tool.hpp"

namespace cotan {
namespace {

class CommittedAccuracy : public ::testing::TestWithParam<const char*> {};

// Degrees by which results may differ between compilers: sines, the order of sums, and the rounding of float and half.
double slackOf(const Measurement& m) { return m.arithmetic == "double" ? 2e-9 : m.arithmetic == "float" ? 1e-4 : 5e-3; }

TEST_P(CommittedAccuracy, isReproduced)
{
    const std::string name = GetParam();
    const auto committed =
        measurementsFromCsv(test::readWhole(COTAN_SOURCE_DIR "/docs/accuracy.csv"), "docs/accuracy.csv");
    ASSERT_TRUE(committed) << committed.error().message;
    AccuracySelection selection;
    if (name == "curved" || name == "facets")
        selection.scene = "spout"; // all surfaces take minutes in unoptimised builds
    std::vector<Measurement> before, now;
    for (const Measurement& m : *committed)
        if (m.table == name && selection.wantsScene(m.scene))
            before.push_back(m);
    for (const AccuracyTable& table : accuracyTables())
        if (table.name == name)
            now = table.measure(selection);
    ASSERT_GT(now.size(), 10u);
    ASSERT_EQ(now.size(), before.size());
    std::size_t failures = 0;
    for (std::size_t i = 0; i < now.size() && failures < 5; ++i) {
        const Measurement &a = before[i], &b = now[i];
        const std::string what = a.scene + ", " + a.setting + ", " + a.frame + ", " + a.truth + ", " + a.arithmetic;
        EXPECT_EQ(what, b.scene + ", " + b.setting + ", " + b.frame + ", " + b.truth + ", " + b.arithmetic);
        EXPECT_EQ(a.samples, b.samples) << what;
        const auto same = [&](const char* figure, double was, double is, double fraction) {
            if (std::abs(is - was) <= fraction * was + slackOf(a))
                return;
            ++failures;
            ADD_FAILURE() << what << ": " << figure << " was " << was << ", is " << is;
        };
        same("mean", a.mean, b.mean, 0.002);
        same("95 %", a.percentile95, b.percentile95, 0.005);
        same("maximum", a.maximum, b.maximum, a.arithmetic == "double" ? 0.005 : 0.05);
        if (std::abs(a.invalid - b.invalid) > 0.002) {
            ++failures;
            ADD_FAILURE() << what << ": not finite: was " << a.invalid << ", is " << b.invalid;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Accuracy, CommittedAccuracy,
                         ::testing::Values("flat", "foreshortening", "perspective", "views", "signs", "curved",
                                           "facets", "precision", "half", "degenerate", "procedural"),
                         [](const auto& each) { return std::string(each.param); });

} // namespace
} // namespace cotan
