// What fails a check, on hand-made reports, with each limit from both sides.
#include <gtest/gtest.h>

#include "cotan/lint.hpp"

namespace cotan {
namespace {

ValueSummary summaryAt(double percentile95) { return {100, percentile95 / 2, percentile95, 2 * percentile95}; }

// A primitive whose map was judged and has no problems.
PrimitiveLint passingPrimitive()
{
    PrimitiveLint p;
    p.mesh = "door";
    p.image = 0;
    p.triangles = 2;
    p.hasUv = true;
    p.uv.area = 1;
    p.readings = {{"cotangent", summaryAt(1)}, {"orthonormal", summaryAt(3)}};
    return p;
}

GreenEvidence greenAs(maps::Green green)
{
    GreenEvidence g{0, "bumps", true, {}};
    g.verdict.green = green;
    g.verdict.confidence = maps::Confidence::certain;
    return g;
}

LintReport reportOf(PrimitiveLint p, maps::Green green = maps::Green::up)
{
    LintReport report;
    report.primitives = {std::move(p)};
    report.maps = {greenAs(green)};
    return report;
}

std::vector<std::string> kindsOf(const LintCheck& check)
{
    std::vector<std::string> kinds;
    for (const LintFailure& f : check.failures)
        kinds.push_back(f.kind);
    return kinds;
}

using Kinds = std::vector<std::string>;

TEST(LintCheck, withoutALimitNothingIsChecked)
{
    PrimitiveLint p = passingPrimitive();
    p.unread = true;
    const LintCheck check = checkLimits(reportOf(p, maps::Green::down), {});
    EXPECT_FALSE(check.limits.any());
    EXPECT_TRUE(check.passed());
}

TEST(LintCheck, degreesAreThe95thPercentileWithTheRequestedFrame)
{
    const LintReport report = reportOf(passingPrimitive());
    EXPECT_TRUE(checkLimits(report, {.degrees = 1.01, .frame = "cotangent"}).passed());
    EXPECT_EQ(kindsOf(checkLimits(report, {.degrees = 0.99, .frame = "cotangent"})), Kinds{"reading"});
    EXPECT_TRUE(checkLimits(report, {.degrees = 3.01}).passed());
    const LintCheck over = checkLimits(report, {.degrees = 2.99}); // the error of orthonormal
    ASSERT_EQ(kindsOf(over), Kinds{"reading"});
    EXPECT_EQ(over.failures[0].where, "door");
    EXPECT_EQ(over.failures[0].value, 3);
    EXPECT_EQ(over.failures[0].limit, 2.99);
    EXPECT_EQ(over.failures[0].text, "door: 95th percentile of the error with orthonormal 3 degrees, limit 2.99");
    EXPECT_EQ(over.failures[0].mesh, "door");
    EXPECT_FALSE(over.failures[0].percent);
}

// The model's mean may be far below a limit that one primitive exceeds.
TEST(LintCheck, failureStatesTheMeansOfPrimitiveAndModel)
{
    LintReport report = reportOf(passingPrimitive());
    PrimitiveLint wall = passingPrimitive();
    wall.mesh = "wall";
    wall.uv.area = 9;
    wall.readings = {{"orthonormal", {100, 0.25, 0.5, 1}}};
    report.primitives.push_back(wall);
    const LintCheck check = checkLimits(report, {.degrees = 1});
    ASSERT_EQ(kindsOf(check), Kinds{"reading"});
    EXPECT_EQ(check.failures[0].beside,
              "the limit applies to each primitive; the mean of this one is 1.5, of the model 0.375");
}

TEST(LintCheck, mapsThatChangeTheLightFailUnderAnyLimit)
{
    using Kind = maps::Fault::Kind;
    for (const LintLimits& limits : {LintLimits{.degrees = 180}, LintLimits{.area = 100}}) {
        LintReport report = reportOf(passingPrimitive());
        GreenEvidence sound = report.maps[0];
        sound.name = "other";
        report.maps.push_back(sound);
        report.maps[0].faults = {{Kind::eightBitsIn16, "its 16-bit values are multiples"}};
        EXPECT_TRUE(checkLimits(report, limits).passed()); // larger than needed, but right
        report.maps[0].faults.push_back({Kind::twoChannels, "blue is the same everywhere"});
        const LintCheck check = checkLimits(report, limits);
        ASSERT_EQ(kindsOf(check), Kinds{"broken_map"});
        EXPECT_EQ(check.failures[0].where, "bumps");
        EXPECT_EQ(check.failures[0].map, "bumps");
        EXPECT_EQ(check.failures[0].text, "normal map bumps: blue is the same everywhere");
    }
}

TEST(LintCheck, areaLimitIsInPercent)
{
    PrimitiveLint p = passingPrimitive();
    p.uv.degenerate = 0.02;
    p.uv.overlappingMirrored = 0.03;
    p.stored.reversedW = 0.04;
    p.stored.rotated = 0.05;
    EXPECT_TRUE(checkLimits(reportOf(p), {.area = 5}).passed());
    EXPECT_EQ(kindsOf(checkLimits(reportOf(p), {.area = 1})),
              (Kinds{"degenerate_uv", "mirrored_overlap", "reversed_w", "rotated_tangents"}));
    EXPECT_EQ(kindsOf(checkLimits(reportOf(p), {.area = 4.5})), Kinds{"rotated_tangents"});
    EXPECT_TRUE(checkLimits(reportOf(p), {.degrees = 10}).passed());
}

TEST(LintCheck, reversedGreenFailsUnderAnyLimit)
{
    const LintReport report = reportOf(passingPrimitive(), maps::Green::down);
    for (const LintLimits& limits : {LintLimits{.degrees = 180}, LintLimits{.area = 100}}) {
        const LintCheck check = checkLimits(report, limits);
        ASSERT_EQ(kindsOf(check), Kinds{"reversed_green"});
        EXPECT_EQ(check.failures[0].where, "bumps");
        EXPECT_LT(check.failures[0].limit, 0);
    }
    EXPECT_TRUE(checkLimits(reportOf(passingPrimitive(), maps::Green::undecidable), {.degrees = 180}).passed());
    EXPECT_EQ(lintWarnings(report),
              std::vector<std::string>{"normal map bumps: green points opposite to what the file says (certain)"});
    EXPECT_TRUE(lintWarnings(reportOf(passingPrimitive())).empty());
}

TEST(LintCheck, unreadMapFailsAmongReadOnes)
{
    PrimitiveLint p = passingPrimitive();
    p.unread = true;
    p.notJudged = "door.ktx2 was not read";
    p.readings.clear();
    LintReport report = reportOf(passingPrimitive());
    report.primitives.push_back(p);
    EXPECT_EQ(kindsOf(checkLimits(report, {.degrees = 180})), Kinds{"not_judged"});
    EXPECT_TRUE(checkLimits(report, {.area = 100}).passed()); // uv and tangents were judged
}

// Limits in degrees ignore one primitive without uv area among several; if no primitive can be judged, the check fails.
TEST(LintCheck, unjudgedMapsDoNotPass)
{
    PrimitiveLint p = passingPrimitive();
    p.notJudged = "no uv";
    p.readings.clear();
    for (const double degrees : {0.0, 0.5, 180.0})
        EXPECT_EQ(kindsOf(checkLimits(reportOf(p), {.degrees = degrees})), Kinds{"not_judged"}) << degrees;
    LintReport both = reportOf(passingPrimitive());
    both.primitives.push_back(p);
    EXPECT_TRUE(checkLimits(both, {.degrees = 180}).passed());
    PrimitiveLint bare = passingPrimitive();
    bare.image = -1;
    bare.readings.clear();
    LintReport unmapped = reportOf(bare);
    unmapped.maps.clear();
    EXPECT_TRUE(checkLimits(unmapped, {.degrees = 180}).passed()); // there is no map to judge
}

} // namespace
} // namespace cotan
