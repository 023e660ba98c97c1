// Error bars and controls that the tables of `cotan accuracy` must satisfy: A2, A4, B1 to B4 and D1 to D4 of
// docs/project/testing.md. A1, A3 and the details of D3 have their own tests beside those of the frames.
#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "truth/measurement.hpp"

namespace cotan {
namespace {

std::vector<Measurement> measure(const char* table, AccuracySelection selection = {})
{
    for (const AccuracyTable& t : accuracyTables())
        if (t.name == table)
            return t.measure(selection);
    ADD_FAILURE() << "no table " << table;
    return {};
}

// Returns the only row with these names. Unless exactly one row matches, fails the test and returns zeros.
Measurement only(const std::vector<Measurement>& rows, const char* setting, const char* frame,
                 const char* arithmetic = "double", const char* truth = "S")
{
    Measurement found;
    int count = 0;
    for (const Measurement& m : rows)
        if (m.setting == setting && m.frame == frame && m.arithmetic == arithmetic && m.truth == truth) {
            found = m;
            ++count;
        }
    EXPECT_EQ(count, 1) << setting << ", " << frame << ", " << arithmetic << ", " << truth;
    return found;
}

AccuracySelection scene(const char* name) { return {{}, name}; }

TEST(AccuracyBarA2, squarePatchFramesAreWrongOnStretchedAndShearedUv)
{
    const char* domes = "domes, frontal";
    // Figures of an independent program for the same domes; the tolerance allows for its different samples.
    const auto stretched = measure("flat", scene("stretch 2:1"));
    for (const char* frame : {"paper-transpose", "unit", "orthonormal", "vertex", "mikktspace"})
        for (const char* arithmetic : {"double", "float"})
            EXPECT_NEAR(only(stretched, domes, frame, arithmetic).mean, 9.47, 0.1) << frame;
    const auto stretched4 = measure("flat", scene("stretch 4:1"));
    for (const char* frame : {"paper-transpose", "unit", "orthonormal", "vertex", "mikktspace"})
        EXPECT_NEAR(only(stretched4, domes, frame).mean, 14.91, 0.15) << frame;
    const auto sheared = measure("flat", scene("shear 45"));
    for (const char* frame : {"orthonormal", "vertex", "mikktspace"})
        EXPECT_NEAR(only(sheared, domes, frame).mean, 16.3, 0.2) << frame;
    EXPECT_NEAR(only(sheared, domes, "paper-transpose").mean, 5.32, 0.1);
    // Frames that preserve lengths and skew are exact on all of these scenes under truth S.
    for (const auto* rows : {&stretched, &stretched4, &sheared})
        for (const char* frame : {"cotangent", "exact", "smooth", "paper-full"})
            EXPECT_LT(only(*rows, domes, frame).maximum, frame == std::string("smooth") ? 1e-5 : 1e-9)
                << frame; // "smooth" has float attributes
}

TEST(AccuracyBarA2, onlyTheGradientFrameIsExactUnderShearAndScale)
{
    const char* domes = "domes, frontal";
    const auto sheared = measure("flat", scene("shear 45")), larger = measure("flat", scene("scale 3"));
    EXPECT_NEAR(only(sheared, domes, "cotangent", "double", "E").mean, 8.0, 0.2);
    EXPECT_NEAR(only(larger, domes, "cotangent", "double", "E").mean, 21.3, 0.3);
    EXPECT_LT(only(sheared, domes, "gradient", "double", "E").maximum, 1e-9);
    EXPECT_LT(only(larger, domes, "gradient", "double", "E").maximum, 1e-9);
    EXPECT_LT(only(larger, domes, "gradient", "float", "E").maximum, 1e-4);
}

TEST(AccuracyBarA2, shortcutsFailOnForeshorteningWithoutPerspective)
{
    const auto rows = measure("foreshortening");
    EXPECT_NEAR(only(rows, "tilt 45", "nonperspective").mean, 9.8, 0.3);
    EXPECT_NEAR(only(rows, "tilt 60", "nonperspective").mean, 15.8, 0.4);
    EXPECT_NEAR(only(rows, "tilt 45", "paper-orthogonal").mean, 6.5, 0.3);
    EXPECT_NEAR(only(rows, "tilt 60", "paper-orthogonal").mean, 12.5, 0.4);
    EXPECT_LT(only(rows, "tilt 0", "nonperspective").maximum, 1e-9);
    for (const Measurement& m : rows)
        if (m.frame != "nonperspective" && m.frame != "paper-orthogonal" && m.arithmetic == "double"
            && m.frame != "gradient") {
            EXPECT_LT(m.maximum, 1e-9) << m.frame << ", " << m.setting;
        }
}

TEST(AccuracyBarA4, everySignCombinationIsExactExceptForCotangent2013)
{
    int reversed = 0, rows = 0;
    for (const Measurement& m : measure("signs")) {
        if (m.setting != "square, face on")
            continue;
        ++rows;
        if (m.frame == "cotangent-2013") {
            // The tilt of 35 degrees points the opposite way: an error of 70 degrees.
            EXPECT_TRUE(m.maximum < 1e-4 || std::abs(m.mean - 70) < 1e-4) << m.scene;
            reversed += m.maximum > 1;
        } else {
            EXPECT_LT(m.maximum, m.arithmetic == "double" ? 1e-9 : 1e-4) << m.scene << ", " << m.frame;
        }
    }
    EXPECT_EQ(rows, 24 * 12 * 2);
    EXPECT_EQ(reversed, 12 * 2);
}

TEST(AccuracyBarA4, greenIsRightOnlyWithTheRightFlag)
{
    int right = 0, wrong = 0;
    for (const Measurement& m : measure("signs")) {
        if (m.setting == "flag right") {
            ++right;
            EXPECT_LT(m.maximum, m.arithmetic == "double" ? 1e-9 : 1e-4) << m.scene;
        }
        if (m.setting == "flag wrong") {
            ++wrong;
            EXPECT_GT(m.mean, 10) << m.scene; // slopes up to 0.4: a mean of about 22 degrees
        }
    }
    EXPECT_EQ(right, 8);
    EXPECT_EQ(wrong, 8);
}

// ---- B: curved surfaces. The bars hold in double and in float. --------------------------------

constexpr const char* kBoth[] = {"double", "float"};

TEST(AccuracyBarB1, cotangentErrorIsFirstOrderAndSmall)
{
    const auto sphere = measure("curved", {{Frame::cotangent, Frame::exact}, "sphere"});
    for (const char* arithmetic : kBoth)
        for (const char* frame : {"cotangent", "exact"}) {
            auto mean = [&](const char* setting) { return only(sphere, setting, frame, arithmetic).mean; };
            EXPECT_LT(mean("16"), 2.4) << frame;
            EXPECT_LT(mean("32"), 1.15) << frame;
            EXPECT_LT(mean("64"), 0.57) << frame;
            EXPECT_LT(mean("128"), 0.29) << frame;
            EXPECT_GT(mean("32") / mean("64"), 1.9) << frame;
            EXPECT_GT(mean("64") / mean("128"), 1.9) << frame;
            EXPECT_LT(only(sphere, "32", frame, arithmetic).percentile95, 3.4) << frame;
        }
    const std::tuple<const char*, double> others[] = {{"torus", 1.3}, {"spout", 0.33}, {"mercator", 1.75}};
    for (auto [surface, bar] : others) {
        const auto rows = measure("curved", {{Frame::cotangent}, surface});
        for (const char* arithmetic : kBoth)
            EXPECT_LT(only(rows, "32", "cotangent", arithmetic).mean, bar) << surface;
    }
}

TEST(AccuracyBarB1, triangleIsWithinTwoPercentOfCotangent)
{
    for (const char* surface : {"sphere", "torus", "spout", "mercator"}) {
        const auto rows = measure("curved", {{Frame::cotangent, Frame::triangle}, surface});
        for (const char* arithmetic : kBoth)
            for (const char* segments : {"32", "64", "128", "256"}) {
                const double cotangent = only(rows, segments, "cotangent", arithmetic).mean;
                EXPECT_NEAR(only(rows, segments, "triangle", arithmetic).mean, cotangent, 0.02 * cotangent)
                    << surface << ", " << segments;
            }
    }
}

TEST(AccuracyBarB2, smoothFusedIsSecondOrderAndWithin40PercentOfItsTotalForm)
{
    for (const char* surface : {"sphere", "torus"}) {
        const auto rows = measure("curved", {{Frame::smooth}, surface});
        auto fused = [&](const char* segments) { return only(rows, segments, "(smooth, fused)").mean; };
        for (const char* segments : {"16", "32", "64", "128"})
            EXPECT_LT(fused(segments), 1.4 * only(rows, segments, "smooth").mean) << surface << ", " << segments;
        EXPECT_GT(fused("16") / fused("32"), 3) << surface;
        EXPECT_GT(fused("32") / fused("64"), 3) << surface;
        EXPECT_GT(fused("64") / fused("128"), 3) << surface;
    }
}

TEST(AccuracyBarB2, smoothErrorIsSecondOrderWithoutFacets)
{
    const auto rows = measure("curved", {{Frame::smooth}, "sphere"});
    for (const char* arithmetic : kBoth) {
        auto mean = [&](const char* setting) { return only(rows, setting, "smooth", arithmetic).mean; };
        EXPECT_LT(mean("32"), 0.30);
        EXPECT_LT(mean("64"), 0.09);
        EXPECT_GT(mean("16") / mean("32"), 3);
        EXPECT_GT(mean("32") / mean("64"), 3);
        EXPECT_GT(mean("32 irregular") / mean("64 irregular"), 1.9);
    }
    for (const Measurement& m : measure("facets", {{Frame::smooth}, "sphere"}))
        if (m.truth == "across the edge") {
            EXPECT_LT(m.maximum, m.arithmetic == "double" ? 1e-6 : 1e-4) << m.setting;
        }
}

TEST(AccuracyBarB3, mikktspaceConvergesOnlyOnConformalUv)
{
    const auto mercator = measure("curved", {{Frame::mikktspace}, "mercator"});
    EXPECT_LT(only(mercator, "32", "mikktspace").mean, 0.21);
    EXPECT_LT(only(mercator, "32", "mikktspace", "float").mean, 0.21);
    const auto sphere = measure("curved", {{Frame::mikktspace}, "sphere"});
    EXPECT_NEAR(only(sphere, "64", "mikktspace").mean, 3.8, 0.2);
    EXPECT_NEAR(only(sphere, "256", "mikktspace").mean, 3.8, 0.2);
}

TEST(AccuracyBarB4, gradientErrorAgainstTheMetricNormalIsSmall)
{
    for (auto [surface, bar] : {std::pair("spout", 0.23), std::pair("sphere", 0.90)}) {
        const auto rows = measure("curved", {{Frame::gradient}, surface});
        for (const char* arithmetic : kBoth)
            EXPECT_LT(only(rows, "64", "gradient", arithmetic, "E").mean, bar) << surface;
    }
}

TEST(AccuracyControls, wrongFramesOnASphereAreWrongByTheirKnownAmounts)
{
    // Figures of an independent program with other random samples; the two differ by up to 3 %.
    const auto rows = measure("curved", scene("sphere"));
    EXPECT_NEAR(only(rows, "32", "(no map)").mean, 21.8, 0.7);
    EXPECT_NEAR(only(rows, "32", "nonperspective").mean, 8.83, 0.27);
    EXPECT_NEAR(only(rows, "32", "paper-transpose").mean, 3.99, 0.2);
    EXPECT_NEAR(only(rows, "32", "paper-full").mean, 1.08, 0.05);
    EXPECT_NEAR(only(rows, "32", "(interpolated normal)", "double", "smooth normal").mean, 0.12, 0.01);
    EXPECT_NEAR(only(rows, "32", "(Blinn, analytic)", "double", "E").mean, 0.18, 0.01);
}

TEST(AccuracyBarD1, errorOfLargeUvIsTheirRoundingOverTheFootprint)
{
    const auto rows = measure("precision", {{Frame::cotangent}, "large uv"});
    auto mean = [&](const char* setting) { return only(rows, setting, "cotangent", "float", "exact arithmetic").mean; };
    // One degree times uv x 1e-6 / footprint, within a factor of two: the rounding of a float.
    EXPECT_NEAR(mean("uv up to 16, footprint 0.0001"), 0.123, 0.06);
    EXPECT_NEAR(mean("uv up to 256, footprint 0.001"), 0.196, 0.1);
    EXPECT_NEAR(mean("uv up to 4096, footprint 0.01"), 0.311, 0.15);
    for (const Measurement& m : rows)
        EXPECT_EQ(m.invalid, 0) << m.setting;
}

TEST(AccuracyBarD2, halfPrecisionIsAccurateOnlyAfterScalingInFloat)
{
    const auto scaled = measure("half", scene("scaled in float, frame in half"));
    for (const char* frame : {"cotangent", "orthonormal"})
        for (const char* setting : {"footprint 0.0001", "footprint 0.001", "footprint 0.01", "footprint 0.1"})
            EXPECT_LT(only(scaled, setting, frame, "half", "exact arithmetic").mean, 0.03) << frame << setting;
    for (const Measurement& m : scaled)
        EXPECT_EQ(m.invalid, 0) << m.frame << ", " << m.setting;
    const auto plain = measure("half", scene("all in half"));
    EXPECT_EQ(only(plain, "footprint 0.001", "cotangent-2013", "half", "exact arithmetic").invalid, 1);
    EXPECT_NEAR(only(plain, "footprint 0.01", "cotangent-2013", "half", "exact arithmetic").invalid, 0.79, 0.03);
}

TEST(AccuracyBarD3, onlyTotalFramesAreFiniteInAll19Cases)
{
    std::size_t total = 0;
    bool othersFail = false;
    for (const Measurement& m : measure("degenerate")) {
        const FrameInfo& f = info(*frameFromName(m.frame));
        total += f.total;
        if (f.total) {
            EXPECT_EQ(m.invalid, 0) << m.frame << ": " << m.scene;
        } else {
            othersFail = othersFail || (m.scene == "constant uv" && m.invalid == 1);
        }
    }
    EXPECT_EQ(total, 19u * 5u);
    EXPECT_TRUE(othersFail);
}

TEST(AccuracyBarD4, proceduralUvErrorIsBelowOneDegreeAt64PixelsPerWave)
{
    const auto fine = measure("procedural", scene("fine derivatives"));
    EXPECT_LT(only(fine, "64 pixels a wave", "cotangent").mean, 0.9);
    // First order in the footprint: a wave over a quarter of the pixels has four times the error.
    EXPECT_NEAR(only(fine, "64 pixels a wave", "cotangent").mean / only(fine, "256 pixels a wave", "cotangent").mean, 4,
                0.2);
    const auto analytic = measure("procedural", scene("analytic Jacobian"));
    for (const char* setting : {"64 pixels a wave", "4 pixels a wave"})
        EXPECT_LT(only(analytic, setting, "cotangent").maximum, 1e-6);
}

TEST(Accuracy, rowsDoNotDependOnTheSelection)
{
    const auto all = measure("foreshortening");
    const auto few = measure("foreshortening", {{Frame::unit, Frame::paperOrthogonal}, ""});
    ASSERT_EQ(few.size(), 9u * 2 * 2);
    for (const Measurement& m : few) {
        const auto same = std::find_if(all.begin(), all.end(), [&](const Measurement& o) {
            return o.setting == m.setting && o.frame == m.frame && o.arithmetic == m.arithmetic;
        });
        ASSERT_NE(same, all.end());
        EXPECT_EQ(same->mean, m.mean);
        EXPECT_EQ(same->maximum, m.maximum);
    }
}

TEST(Accuracy, collectorCountsNonFiniteValuesSeparately)
{
    AngleCollector angles;
    for (double d : {3.0, 1.0, 2.0, double(NAN), double(INFINITY)})
        angles.add(d);
    const Measurement m = angles.finish({});
    EXPECT_EQ(m.samples, 5u);
    EXPECT_DOUBLE_EQ(m.mean, 2);
    EXPECT_DOUBLE_EQ(m.maximum, 3);
    EXPECT_DOUBLE_EQ(m.percentile95, 3); // two samples of three are less than 95 %
    EXPECT_DOUBLE_EQ(m.invalid, 0.4);
}

} // namespace
} // namespace cotan
