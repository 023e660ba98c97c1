// Surface gradients and blends compared with their definitions.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "truth/patch.hpp"

namespace cotan {
namespace {

using namespace f64;

glm::dvec3 texel(Random& random, double degrees) { return tiltedTexel(random, random.range(0, degrees)); }

TEST(Gradient, resolvingASlopeEqualsApplyingItsTexel)
{
    Random random(51);
    for (int i = 0; i < 500; ++i) {
        const AffinePatch p = randomPatch(random, i & 1);
        const auto d =
            screenDifferences(PixelCamera::lookAt(p.normal * 3.0, {0, 0, 0}, random.direction(), 800), p, {0, 0, 0});
        const auto f = cotan_frame_gradient(p.normal, d.dpdx.raw(), d.dpdy.raw(), d.duvdx, d.duvdy);
        const glm::dvec3 m = texel(random, 80);
        const glm::dvec3 resolved =
            cotan_resolve_gradient(p.normal, cotan_gradient_of_slope(f, cotan_slope_of_texel(m)));
        EXPECT_LT(degreesBetween(resolved, cotan_apply(f, m)), 1e-10);
    }
}

TEST(Gradient, gradientsOfTwoUvSetsAddUpToTheSumOfTheirHeights)
{
    Random random(52);
    for (int i = 0; i < 200; ++i) {
        // Two layouts on one plane, with heights linear in their uv, so that grad h is known exactly.
        AffinePatch a = randomPatch(random, false), b = randomPatch(random, true);
        b.normal = a.normal;
        b.gradU -= a.normal * glm::dot(a.normal, b.gradU);
        b.gradV -= a.normal * glm::dot(a.normal, b.gradV);
        const glm::dvec2 ha(random.range(-1, 1), random.range(-1, 1)), hb(random.range(-1, 1), random.range(-1, 1));
        const PixelCamera camera =
            PixelCamera::lookAt(a.normal * 3.0 + random.direction(), {0, 0, 0}, random.direction(), 800);
        auto gradient = [&](const AffinePatch& p, glm::dvec2 slope) {
            const auto d = screenDifferences(camera, p, {0, 0, 0});
            return cotan_gradient_of_slope(cotan_frame_gradient(p.normal, d.dpdx.raw(), d.dpdy.raw(), d.duvdx, d.duvdy),
                                           slope);
        };
        const glm::dvec3 truth = a.gradU * ha.x + a.gradV * ha.y + b.gradU * hb.x + b.gradV * hb.y;
        EXPECT_LT(glm::length(gradient(a, ha) + gradient(b, hb) - truth), 1e-9 * (1 + glm::length(truth)));
    }
}

TEST(Gradient, theGradientOfANormalResolvesToThatNormal)
{
    Random random(53);
    for (int i = 0; i < 500; ++i) {
        const glm::dvec3 n = random.direction(), v = random.direction();
        if (glm::dot(n, v) < 0.01)
            continue;
        EXPECT_LT(degreesBetween(cotan_resolve_gradient(n, cotan_gradient_of_normal(n, v * 3.0)), v), 1e-9);
    }
    // At the horizon and below it: steep, finite, of unit length.
    for (glm::dvec3 v : {glm::dvec3(1, 0, 0), {0.6, 0, -0.8}, {0, 0, -1}}) {
        const glm::dvec3 r = cotan_resolve_gradient({0, 0, 1}, cotan_gradient_of_normal({0, 0, 1}, v));
        EXPECT_NEAR(glm::length(r), 1, 1e-12);
    }
}

TEST(Gradient, heightDifferencesGiveTheGradientInAnyDirection)
{
    Random random(54);
    for (int i = 0; i < 200; ++i) {
        const AffinePatch p = randomPatch(random, false);
        const auto d = screenDifferences(
            PixelCamera::lookAt(random.direction() * 3.0 + p.normal, {0, 0, 0}, random.direction(), 800), p, {0, 0, 0});
        // h = u, so its differences are those of u.
        const glm::dvec3 g = cotan_gradient_of_height(p.normal, d.dpdx.raw(), d.dpdy.raw(), d.duvdx.x, d.duvdy.x);
        EXPECT_LT(glm::length(g - p.gradU), 1e-9 * glm::length(p.gradU));
        const glm::dvec3 swapped = cotan_gradient_of_height(p.normal, d.dpdy.raw(), d.dpdx.raw(), d.duvdy.x, d.duvdx.x);
        EXPECT_LT(glm::length(swapped - p.gradU), 1e-9 * glm::length(p.gradU));
    }
    EXPECT_EQ(cotan_gradient_of_height({0, 0, 1}, {1, 0, 0}, {2, 0, 0}, 1, 2), glm::dvec3(0));
}

TEST(Gradient, triplanarMapsOfOneHeightGiveItsGradient)
{
    // h = a . p: each plane's map has the slopes along its two coordinates.
    const glm::dvec3 a(0.3, -0.2, 0.5);
    for (int side = 0; side < 6; ++side) {
        glm::dvec3 n(0);
        n[side / 2] = side % 2 ? -1 : 1;
        const glm::dvec3 w = cotan_triplanar_weights(n);
        EXPECT_EQ(w, glm::abs(n));
        const glm::dvec3 g = cotan_gradient_triplanar(n, w, {a.z, a.y}, {a.x, a.z}, {a.x, a.y});
        EXPECT_LT(glm::length(g - (a - n * glm::dot(n, a))), 1e-15);
    }
    EXPECT_NEAR(cotan_triplanar_weights(glm::normalize(glm::dvec3(1, 2, -3))).x
                    + cotan_triplanar_weights(glm::normalize(glm::dvec3(1, 2, -3))).y
                    + cotan_triplanar_weights(glm::normalize(glm::dvec3(1, 2, -3))).z,
                1, 1e-15);
}

TEST(Gradient, slopesAreClampedTo128)
{
    EXPECT_NEAR(cotan_slope_of_texel({1, 0, 0}).x, -128, 1e-9);
    EXPECT_NEAR(cotan_slope_of_texel({0, -0.6, -0.8}).y, 128, 1e-9);
    EXPECT_EQ(cotan_slope_of_texel({0, 0, 0}), glm::dvec2(0));
}

TEST(Gradient, noInputResolvesToNan)
{
    const double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
    for (double bad : {inf, -inf, nan, 1e300})
        EXPECT_EQ(cotan_resolve_gradient({0, 0, 1}, {bad, 0, 0}), glm::dvec3(0, 0, 1));
    EXPECT_EQ(cotan_resolve_gradient({0, 0, 1}, {0, 0, 1}), glm::dvec3(0, 0, 1));
}

// The shortest rotation from z to b, by Rodrigues' formula.
glm::dvec3 rotateZTo(glm::dvec3 b, glm::dvec3 v)
{
    const glm::dvec3 axis = glm::cross(glm::dvec3(0, 0, 1), b);
    const double c = b.z;
    return v * c + glm::cross(axis, v) + axis * (glm::dot(axis, v) / (1 + c));
}

TEST(Blend, reorientedIsTheShortestRotation)
{
    Random random(55);
    for (int i = 0; i < 500; ++i) {
        const glm::dvec3 base = texel(random, 80), detail = texel(random, 80);
        EXPECT_LT(degreesBetween(cotan_blend_reoriented(base, detail), rotateZTo(base, detail)), 1e-9);
    }
}

TEST(Blend, slopesAddAsHeightsDo)
{
    Random random(56);
    for (int i = 0; i < 500; ++i) {
        const glm::dvec3 base = texel(random, 80), detail = texel(random, 80);
        const glm::dvec2 sum = cotan_slope_of_texel(base) * 0.7 + cotan_slope_of_texel(detail) * 1.5;
        EXPECT_LT(degreesBetween(cotan_blend_slopes(base, detail, 0.7, 1.5), {-sum.x, -sum.y, 1}), 1e-9);
    }
}

TEST(Blend, aFlatDetailLeavesTheBaseAndAFlatBaseTheDetail)
{
    Random random(57);
    const glm::dvec3 flat(0, 0, 1);
    for (int i = 0; i < 100; ++i) {
        const glm::dvec3 m = texel(random, 80);
        const std::array both = {cotan_blend_reoriented(m, flat),   cotan_blend_reoriented(flat, m),
                                 cotan_blend_whiteout(m, flat),     cotan_blend_whiteout(flat, m),
                                 cotan_blend_slopes(m, flat, 1, 1), cotan_blend_slopes(flat, m, 1, 1),
                                 cotan_blend_udn(m, flat)};
        for (const glm::dvec3& r : both)
            EXPECT_LT(degreesBetween(r, m), 1e-9);
        // The other two modes differ: UDN keeps the base's height, linear halves both tilts.
        EXPECT_GE(cotan_blend_udn(flat, m).z, m.z - 1e-12);
        EXPECT_NEAR(degreesBetween(cotan_blend_linear(m, flat), flat), degreesBetween(m, flat) / 2, 1e-6);
    }
}

TEST(Blend, oppositeAndZeroTexelsGiveTheBase)
{
    EXPECT_EQ(cotan_blend_linear({0, 0, 1}, {0, 0, -1}), glm::dvec3(0, 0, 1));
    EXPECT_EQ(cotan_blend_slopes({0, 0, 1}, {0, 0, 0}, 1, 1), glm::dvec3(0, 0, 1));
}

} // namespace
} // namespace cotan
