// Sentences that commands print beside numbers are true for these numbers: drawn at random, each sentence is right, and
// appears for some numbers and not for others.
#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "convert_lines.hpp"
#include "cotan/convert.hpp"
#include "cotan/lint.hpp"
#include "cotan/tangents.hpp"
#include "lint_lines.hpp"
#include "tangents_report.hpp"

namespace cotan {

using namespace app;
namespace lint {
void recommend(LintReport& report); // bake/lint/lint_parts.hpp
}
namespace {

struct Draw {
    std::mt19937 engine;
    double operator()(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine); }
    double magnitude(double low, double high) { return std::exp((*this)(std::log(low), std::log(high))); }
    // Mean <= 95 % <= maximum.
    ValueSummary error()
    {
        const double mean = magnitude(0.01, 20), percentile95 = mean * (*this)(1, 8);
        return {100, mean, percentile95, percentile95 * (*this)(1, 10)};
    }
};

bool says(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

TEST(SentencesBesideNumbers, keptMapsAreComparedWithRounding)
{
    constexpr double kOfRounding = 0.3; // degrees on 95 % of the area: 8 bits give 0.17 on average and 0.4 at most
    Draw draw{std::mt19937(1)};
    int within = 0;
    for (int i = 0; i < 1000; ++i) {
        ConvertedMap map;
        map.name = "bark";
        map.surfaces = 3;
        map.greenReversed = i % 2 == 1;
        map.kept = !map.greenReversed;
        map.figures.unconverted = map.figures.error = {100, 45, 90, 180}; // of the other kind
        (map.kept ? map.figures.unconverted : map.figures.error) = draw.error();
        const ValueSummary& shown = map.kept ? map.figures.unconverted : map.figures.error;
        const std::vector<std::string> lines = mapLines(map, "orthonormal");
        ASSERT_EQ(lines.size(), 1u);
        EXPECT_TRUE(says(lines[0], toText(shown))) << lines[0];
        EXPECT_EQ(says(lines[0], "no more than that of rounding"), shown.percentile95 <= kOfRounding) << lines[0];
        EXPECT_EQ(says(lines[0], "unchanged"), map.kept) << lines[0];
        EXPECT_EQ(says(lines[0], "green is reversed"), map.greenReversed) << lines[0];
        within += shown.percentile95 <= kOfRounding;
    }
    EXPECT_GT(within, 100);
    EXPECT_LT(within, 900);
}

TEST(SentencesBesideNumbers, theVerdictAndTheRecommendedLimitAreOfOneMind)
{
    Draw draw{std::mt19937(2)};
    int invisible = 0;
    for (int i = 0; i < 2000; ++i) {
        LintReport report;
        const int count = 1 + i % 4;
        double worstMean = 0, worst95 = 0;
        for (int k = 0; k < count; ++k) {
            PrimitiveLint p;
            p.mesh = fmt::format("part {}", k);
            p.image = 0;
            p.hasUv = true;
            p.triangles = 10;
            p.uv.area = draw.magnitude(0.001, 1000);
            ValueSummary error = draw.error();
            error.mean /= 10;
            error.percentile95 /= 10;
            p.readings = {{"cotangent", draw.error()}, {"orthonormal", error}};
            worstMean = std::max(worstMean, error.mean);
            worst95 = std::max(worst95, error.percentile95);
            report.primitives.push_back(p);
        }
        lint::recommend(report);
        const bool unseen = worstMean <= 0.3 && worst95 <= 3; // docs/explanation/degrees.md
        EXPECT_EQ(says(report.seen, "the difference is invisible"), unseen) << report.seen;
        EXPECT_EQ(report.worst.empty(), unseen) << report.worst;
        const LintCheck check = checkLimits(report, {.degrees = 3});
        EXPECT_EQ(check.passed(), worst95 <= 3);
        EXPECT_TRUE(check.passed() || !says(report.seen, "invisible")) << report.seen;
        const std::vector<std::string> lines = verdictLines("model.glb", report, "");
        EXPECT_EQ(std::ranges::any_of(lines, [&](const std::string& line) { return says(line, "The largest error"); }),
                  !unseen);
        invisible += unseen;
    }
    EXPECT_GT(invisible, 200);
    EXPECT_LT(invisible, 1800);
}

TEST(SentencesBesideNumbers, tangentsAreEqualUpToRounding)
{
    Draw draw{std::mt19937(3)};
    int equal = 0;
    for (int i = 0; i < 500; ++i) {
        TangentDifference difference;
        difference.corners = 40;
        double largest = 0;
        for (int k = 0; k < 40; ++k) {
            difference.degrees.push_back(float(draw.magnitude(1e-4, i % 2 == 0 ? 0.06 : 180)));
            largest = std::max(largest, double(difference.degrees.back()));
        }
        difference.handedness = i % 3 == 0 ? 40 : 0;
        const std::string line = toText(difference, "MikkTSpace");
        const bool same = largest <= 0.05 && difference.handedness == 0; // rounding, cotan/tangents.hpp
        EXPECT_EQ(line.starts_with("equal to MikkTSpace"), same) << line << " " << largest;
        equal += same;
    }
    EXPECT_GT(equal, 50);
    EXPECT_LT(equal, 450);
}

} // namespace
} // namespace cotan
