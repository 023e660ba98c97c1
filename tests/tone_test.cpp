// Compares tone.h with the published formulas, implemented independently with matrices and in double.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vector_relational.hpp>

#include "scene/render_text.hpp"

namespace cotan {
namespace {

using glm::dmat3;
using glm::dvec3;

// Colours of several hues and strengths from 0 to 100.
std::vector<dvec3> colors()
{
    std::vector<dvec3> all;
    for (const double strength : {0.0, 1e-4, 0.01, 0.07, 0.09, 0.3, 0.75, 0.81, 1.0, 3.0, 20.0, 100.0})
        for (const dvec3 hue : {dvec3(1, 1, 1), dvec3(1, 0, 0), dvec3(0, 1, 0), dvec3(0, 0, 1), dvec3(1, 0.5, 0.1),
                                dvec3(0.2, 0.9, 1), dvec3(1, 0.3, 0.8)})
            all.push_back(hue * strength);
    return all;
}

void expectNear(dvec3 found, dvec3 expected, double tolerance, dvec3 of)
{
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(found[c], expected[c], tolerance) << of.x << " " << of.y << " " << of.z;
}

// Section "Tone mapping function" of the Khronos PBR Neutral specification, with its names.
dvec3 khronosNeutral(dvec3 c)
{
    const double F90 = 0.04, ks = 0.8 - F90, kd = 0.15;
    const double x = std::min({c.x, c.y, c.z});
    const double f = x <= 2 * F90 ? x - x * x / (4 * F90) : 0.04;
    const double p = std::max({c.x, c.y, c.z}) - f;
    const dvec3 base = c - f;
    if (p <= ks)
        return base;
    const double pn = 1 - (1 - ks) * (1 - ks) / (p + 1 - 2 * ks);
    const double g = 1 / (kd * (p - pn) + 1);
    return base * (pn / p) * g + dvec3(pn) * (1 - g);
}

TEST(Tone, neutralIsTheKhronosFormula)
{
    for (const dvec3& c : colors()) {
        expectNear(f64::cotan_tone_neutral(c), khronosNeutral(c), 1e-12, c);
        expectNear(dvec3(f32::cotan_tone_neutral(glm::vec3(c))), khronosNeutral(c), 2e-6, c); // rounding of float
    }
}

// With a channel at 0, the reflection of white light by a dielectric, which the curve subtracts, is 0.
TEST(Tone, neutralKeepsColoursBelowItsStartExactly)
{
    for (float r = 0; r < 0.76f; r += 0.0371f)
        for (float g = 0; g < 0.76f; g += 0.0293f) {
            EXPECT_EQ(f32::cotan_tone_neutral({r, g, 0}), glm::vec3(r, g, 0));
            EXPECT_EQ(f32::cotan_tone_neutral({0, r, g}), glm::vec3(0, r, g));
        }
    // Other colours lose the same from each channel: 0.04 if the darkest has at least 0.08.
    expectNear(f64::cotan_tone_neutral({0.5, 0.3, 0.08}), {0.46, 0.26, 0.04}, 1e-15, {});
}

// Sobotka's AgX as in Filament, with matrices by columns; the two pairs are inverse of each other within their digits.
dvec3 agx(dvec3 c)
{
    const dmat3 toWide({0.6274, 0.0691, 0.0164}, {0.3293, 0.9195, 0.0880}, {0.0433, 0.0113, 0.8956});
    const dmat3 fromWide({1.6605, -0.1246, -0.0182}, {-0.5876, 1.1329, -0.1006}, {-0.0728, -0.0083, 1.1187});
    const dmat3 inset({0.856627153315983, 0.137318972929847, 0.11189821299995},
                      {0.0951212405381588, 0.761241990602591, 0.0767994186031903},
                      {0.0482516061458583, 0.101439036467562, 0.811302368396859});
    const dmat3 outset({1.1271005818144368, -0.1413297634984383, -0.14132976349843826},
                       {-0.11060664309660323, 1.157823702216272, -0.11060664309660294},
                       {-0.016493938717834573, -0.016493938717834257, 1.2519364065950405});
    dvec3 v = inset * (toWide * c);
    const double polynomial[] = {-0.00232, 0.1191, 0.4298, -6.868, 31.96, -40.14, 15.5};
    for (int i = 0; i < 3; ++i) {
        const double x = std::clamp((std::log2(std::max(v[i], 1e-10)) + 12.47393) / (4.026069 + 12.47393), 0.0, 1.0);
        double y = 0;
        for (int k = 6; k >= 0; --k)
            y = y * x + polynomial[k];
        v[i] = y;
    }
    v = outset * v;
    for (int i = 0; i < 3; ++i)
        v[i] = std::pow(std::max(v[i], 0.0), 2.2);
    v = fromWide * v;
    return {std::clamp(v.x, 0.0, 1.0), std::clamp(v.y, 0.0, 1.0), std::clamp(v.z, 0.0, 1.0)};
}

TEST(Tone, agxIsFilamentsMatricesAroundWrenschsPolynomial)
{
    for (const dvec3& c : colors()) {
        expectNear(f64::cotan_tone_agx(c), agx(c), 1e-12, c);
        expectNear(dvec3(f32::cotan_tone_agx(glm::vec3(c))), agx(c), 1e-5, c); // terms of 40 x^5 cancel: 1e-7 of them
    }
}

TEST(Tone, everyCurveRisesFromBlackToAtMostWhite)
{
    for (const int curve : {COTAN_TONE_NONE, COTAN_TONE_ACES, COTAN_TONE_NEUTRAL, COTAN_TONE_AGX}) {
        EXPECT_EQ(f32::cotan_tone_of(curve, glm::vec3(0)), glm::vec3(0)) << curve;
        float before = 0;
        for (float x = 1e-5f; x < 1e4f; x *= 1.03f) {
            const glm::vec3 grey = f32::cotan_tone_of(curve, glm::vec3(x));
            EXPECT_GE(grey.y, before - 1e-6f) << curve << " at " << x;
            before = grey.y;
            for (const dvec3& c : colors()) {
                const glm::vec3 t = f32::cotan_tone_of(curve, glm::vec3(c) * x);
                EXPECT_TRUE(glm::all(glm::greaterThanEqual(t, glm::vec3(0)))) << curve;
                EXPECT_TRUE(glm::all(glm::lessThanEqual(t, glm::vec3(1)))) << curve;
            }
        }
        EXPECT_GT(before, 0.98f) << curve;
    }
}

TEST(Tone, numbersSelectTheCurves)
{
    const glm::vec3 c(0.2f, 1.4f, 0.05f);
    EXPECT_EQ(f32::cotan_tone_of(COTAN_TONE_NONE, c), glm::vec3(0.2f, 1, 0.05f));
    EXPECT_EQ(f32::cotan_tone_of(COTAN_TONE_ACES, c), f32::cotan_tone_map(c));
    EXPECT_EQ(f32::cotan_tone_of(COTAN_TONE_NEUTRAL, c), f32::cotan_tone_neutral(c));
    EXPECT_EQ(f32::cotan_tone_of(COTAN_TONE_AGX, c), f32::cotan_tone_agx(c));
}

} // namespace
} // namespace cotan
