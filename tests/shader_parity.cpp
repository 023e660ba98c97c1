#include "shader_parity.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "truth/patch.hpp"

namespace cotan::test {
namespace {

// About thirty roundings of 6e-8 each (square roots and inverse square roots count twice), amplified by the
// conditioning of the vectors: 1/sin 30 degrees for positions and again for uv, 1/cos 50 for n, 1/cos 55 for m. In the
// worst case: 30 * 6e-8 * 2 * 2 * 1.6 * 1.7 rad = 1.1e-3 degrees.
constexpr double kFloatDegrees = 1.2e-3;
// Fused forms add 1e-12 to m.z (fused.h), 6e-11 degrees; `gradient` adds 1e-15 to m.z times the area of the footprint,
// which is at least about 1e-5 here: 6e-9 degrees.
constexpr double kDoubleFusedDegrees = 1e-8;

// Maximum error in units of `Case::allowance`, the change by one rounding of the result and one of each input: a stable
// evaluation in float is exact for inputs a few roundings away. The loosest function is pow, if the driver computes it
// by exp2 and log2: Vulkan allows log2 an absolute error of 2^-21, 5.5 roundings of the base, and exp2(-9.28) an error
// of 22 units in the last place, 44 roundings. About twenty multiplications and additions follow.
constexpr double kFloatRoundings = 64;
constexpr double kDoubleRoundings = 1e-6; // 2^-29 of a float's roundings, with reserve for kinks

// Differences between interpolated values of drawn pixels. An interpolator that accumulates from the corner of the
// target adds up to 32 rounded differences: a relative error of 32 * 6e-8 for both of each pair. Amplified as above: 2
// * 1.9e-6 * 2 * 2 * 1.6 * 1.7 rad = 2.4e-3 degrees, in addition to kFloatDegrees.
constexpr double kDrawnDegrees = 3.6e-3;

} // namespace

const std::vector<Case>& allCases()
{
    static const std::vector<Case> all = cases();
    return all;
}

const std::vector<Sample>& allSamples()
{
    static const std::vector<Sample> all = samples();
    return all;
}

namespace {

// WGSL may assume that no number is NaN or infinite, and GLSL ES 3.00 requires support for neither. The printed text
// says so; nothing is promised there.
Kind hardest(const Case& c, const std::string& language)
{
    const bool finiteOnly = language == "wgsl" || language == "essl";
    return finiteOnly && c.last == Kind::nonFinite ? Kind::degenerate : c.last;
}

} // namespace

double degreesApart(glm::dvec3 a, glm::dvec3 b)
{
    const double d = degreesBetween(a, b);
    const bool unit = std::abs(glm::length(a) - 1) < 1e-5; // a few roundings
    return std::isfinite(d) && unit ? d : 180;
}

namespace {

double worst(const Case& c, const Results& r, std::size_t index)
{
    double largest = 0;
    for (std::size_t s = 0; s < allSamples().size(); ++s)
        if (allSamples()[s].kind <= hardest(c, r.language))
            largest = std::max(largest, degreesApart(r.values[index][s], c.expected(allSamples()[s].v)));
    return largest;
}

// The largest angle from the result before the transform, moved with the object.
double worstMoved(const Case& c, const Results& r, std::size_t index)
{
    double largest = 0;
    for (std::size_t k = 0; k < allSamples().size(); ++k) {
        const Sample& s = allSamples()[k];
        if (s.kind == Kind::moved && s.source == c.moves && (c.anyScale || s.scale == 1))
            largest = std::max(
                largest, degreesApart(r.values[index][k], glm::dvec3(s.mirrored ? -1 : 1, 1, 1) * c.expected(s.from)));
    }
    return largest;
}

struct LightError {
    double relative = 0;  // relative to the largest channel, for roughness of at least kRough
    double glossy = 0;    // the same for lower roughness, where highlights amplify the roundings of n and h
    double roundings = 0; // see kFloatRoundings
};
constexpr float kRough = 0.25f;

LightError worstLight(const Case& c, const Results& r, std::size_t index)
{
    LightError largest;
    for (std::size_t s = 0; s < allSamples().size(); ++s) {
        if (allSamples()[s].kind != Kind::light)
            continue;
        const glm::dvec3 expected = c.expected(allSamples()[s].v), allowed = c.allowance(allSamples()[s].v);
        for (int k = 0; k < 3; ++k) {
            const double error = std::abs(r.values[index][s][k] - expected[k]);
            const double size = std::max({std::abs(expected.x), std::abs(expected.y), std::abs(expected.z)});
            if (error == 0)
                continue;
            // The comparison makes a NaN count as large.
            double& relative = allSamples()[s].v.duvdx.y < kRough ? largest.glossy : largest.relative;
            relative = error / size <= relative ? relative : error / size;
            largest.roundings = error / allowed[k] <= largest.roundings ? largest.roundings : error / allowed[k];
        }
    }
    return largest;
}

void expectLight(const Case& c, const Results& r, std::size_t index)
{
    const LightError largest = worstLight(c, r, index);
    fmt::print("| {:24} | {:10} | {:.1e} relative, glossy {:.1e}, {:.1f} roundings |\n", c.name, r.language,
               largest.relative, largest.glossy, largest.roundings);
    EXPECT_LT(largest.roundings, r.language == "cpp double" ? kDoubleRoundings : kFloatRoundings)
        << r.language << ", " << c.name;
}

} // namespace

void expectParity(const Results& r, const std::vector<Case>& run)
{
    if (!r.skipped.empty())
        GTEST_SKIP() << r.language << ": " << r.skipped;
    ASSERT_EQ(r.values.size(), run.size());
    for (std::size_t k = 0; k < run.size(); ++k) {
        const Case& c = run[k];
        const bool fused = std::string(c.name).ends_with(", fused");
        const double limit = c.halfs     ? 0.03
            : r.language != "cpp double" ? kFloatDegrees
            : fused                      ? kDoubleFusedDegrees
                                         : kDoubleDegrees;
        if (c.light) {
            expectLight(c, r, k);
            continue;
        }
        const double largest = worst(c, r, k);
        fmt::print("| {:24} | {:10} | {:.1e} |\n", c.name, r.language, largest);
        EXPECT_LT(largest, limit) << r.language << ", " << c.name;
        EXPECT_LT(worstMoved(c, r, k), limit) << r.language << ", " << c.name << ": scaled or mirrored";
    }
}

namespace {

bool alongRows(const Results& r, bool flipped)
{
    return !flipped != (r.language == "wgsl" || r.language == "hlsl, Direct3D");
}

} // namespace

double worstDrawn(const Case& c, const Results& r, std::size_t index, bool flipped)
{
    static const std::vector<Vectors> drawnTiles = tiles();
    const bool along = alongRows(r, flipped);
    double largest = 0;
    for (int row = 0; row < kTarget; ++row)
        for (int column = 0; column < kTarget; ++column) {
            const int tileRow = (along ? row : kTarget - 1 - row) / kTile;
            Vectors v = drawnTiles[static_cast<std::size_t>(tileRow * kTiles + column / kTile)];
            v.dpdy = along ? v.dpdy : -v.dpdy;
            v.duvdy = along ? v.duvdy : -v.duvdy;
            const std::size_t pixel = static_cast<std::size_t>((int(flipped) * kTarget + row) * kTarget + column);
            largest = std::max(largest, degreesApart(r.values[index][pixel], c.expected(v)));
        }
    return largest;
}

void expectDrawn(const Results& r)
{
    if (!r.skipped.empty())
        GTEST_SKIP() << r.language << ": " << r.skipped;
    const std::vector<Case> drawn = drawnCases();
    ASSERT_EQ(r.values.size(), drawn.size());
    for (std::size_t k = 0; k < drawn.size(); ++k)
        for (const bool flipped : {false, true}) {
            const double largest = worstDrawn(drawn[k], r, k, flipped);
            fmt::print("| {:24} | {:10} | {:.1e} | drawn, y {} |\n", drawn[k].name, r.language, largest,
                       alongRows(r, flipped) ? "along" : "against");
            EXPECT_LT(largest, kDrawnDegrees)
                << r.language << ", " << drawn[k].name << ", along: " << alongRows(r, flipped);
        }
}

} // namespace cotan::test
