// shaders/cotan/blend.h and gradient.h compared with asymmetric cases that were worked out by hand.
#include <gtest/gtest.h>

#include <cmath>

#include <glm/geometric.hpp>

#include "cotan/portable.hpp"

namespace cotan {
namespace {

using namespace f64;

constexpr double kDouble = 1e-14;

void expectDirection(const glm::dvec3& found, const glm::dvec3& expected)
{
    const glm::dvec3 e = glm::normalize(expected);
    for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(found[k], e[k], kDouble) << "component " << k;
}

const glm::dvec3 kBase(0.48, 0.6, 0.64), kDetail(-0.36, 0.48, 0.8);

TEST(BlendFormula, whiteoutAddsTiltsAndMultipliesHeights)
{
    expectDirection(cotan_blend_whiteout(kBase, kDetail), {0.12, 1.08, 0.512});
}

TEST(BlendFormula, udnKeepsTheHeightOfTheBase)
{
    expectDirection(cotan_blend_udn(kBase, kDetail), {0.12, 1.08, 0.64});
    expectDirection(cotan_blend_udn(kDetail, kBase), {0.12, 1.08, 0.8}); // and not the height of the detail
}

TEST(BlendFormula, linearIsTheSum) { expectDirection(cotan_blend_linear(kBase, kDetail), {0.12, 1.08, 1.44}); }

TEST(BlendFormula, slopesAddWithTheirOwnWeights)
{
    // Slopes m.xy / m.z: base (0.75, 0.9375), detail (-0.45, 0.6).
    expectDirection(cotan_blend_slopes(kBase, kDetail, 1, 1), {0.3, 1.5375, 1});
    expectDirection(cotan_blend_slopes(kBase, kDetail, 0.5, 2), {-0.525, 1.66875, 1});
}

TEST(BlendFormula, reorientedRotatesTheDetailLikeTheBaseFromFlat)
{
    // The rotation from z to the base, by Rodrigues' formula: axis z x base, cosine base.z.
    const glm::dvec3 axis(-kBase.y, kBase.x, 0);
    const glm::dvec3 rotated =
        kDetail * kBase.z + glm::cross(axis, kDetail) + axis * (glm::dot(axis, kDetail) / (1 + kBase.z));
    expectDirection(cotan_blend_reoriented(kBase, kDetail), rotated);
    expectDirection(cotan_blend_reoriented({0, 0, 1}, kDetail), kDetail);
}

TEST(BlendFormula, reorientedClampsABaseThatPointsStraightDown)
{
    // t = (0, 0, 0.001), u = (0.36, -0.48, 0.8): t (t.u)/t.z - u = (-0.36, 0.48, -0.7992).
    expectDirection(cotan_blend_reoriented({0, 0, -1}, kDetail), {-0.36, 0.48, -0.7992});
    // Beyond the limit nothing is clamped: z = -0.6.
    const glm::dvec3 t(0.64, 0.48, 0.4), u(0.36, -0.48, 0.8);
    expectDirection(cotan_blend_reoriented({0.64, 0.48, -0.6}, kDetail), t * (glm::dot(t, u) / 0.4) - u);
}

TEST(GradientFormula, slopesOfATexelAreMinusItsTiltOverItsHeight)
{
    const glm::dvec2 s = cotan_slope_of_texel(kBase);
    EXPECT_NEAR(s.x, -0.75, kDouble);
    EXPECT_NEAR(s.y, -0.9375, kDouble);
    // The longer component is clamped to 128; smaller slopes are unchanged.
    EXPECT_NEAR(cotan_slope_of_texel({0.1, -1, 1.0 / 127}).y, 127, 1e-10);
    EXPECT_NEAR(cotan_slope_of_texel({0.1, -1, 1.0 / 129}).y, 128, 1e-10);
    EXPECT_NEAR(cotan_slope_of_texel({1, 0.1, 1.0 / 127}).x, -127, 1e-10);
    EXPECT_NEAR(cotan_slope_of_texel({1, 0.1, -1}).x, -128, 1e-10);
    EXPECT_NEAR(cotan_slope_of_texel({1, 0.1, -1}).y, -12.8, 1e-10);
}

TEST(GradientFormula, aSlopeIsTakenAlongTAndB)
{
    cotan_frame f;
    f.t = {2, 0, 0}, f.b = {0, -3, 1}, f.n = {0, 0, 1};
    const glm::dvec3 g = cotan_gradient_of_slope(f, {0.5, 0.25});
    EXPECT_EQ(g, glm::dvec3(1, -0.75, 0.25));
}

TEST(GradientFormula, resolvingSubtracts)
{
    expectDirection(cotan_resolve_gradient({0, 0.6, 0.8}, {0.5, 0.25, -0.125}), {-0.5, 0.35, 0.925});
}

TEST(GradientFormula, aBackfacingNormalUsesTheAbsoluteCosine)
{
    const glm::dvec3 front = cotan_gradient_of_normal({0, 0, 1}, {0.36, 0.48, 0.8});
    EXPECT_NEAR(front.x, -0.45, kDouble);
    EXPECT_NEAR(front.y, -0.6, kDouble);
    const glm::dvec3 behind = cotan_gradient_of_normal({0, 0, 1}, {0.36, 0.48, -0.8});
    EXPECT_NEAR(behind.x, -0.45, kDouble);
    EXPECT_NEAR(behind.y, -0.6, kDouble);
    EXPECT_NEAR(cotan_gradient_of_normal({0, 0, 1}, {0, 1, 0}).y, -1e6, 1e-6);
}

TEST(GradientFormula, theGradientOfAVolumeIsProjectedOntoTheSurface)
{
    const glm::dvec3 g = cotan_gradient_of_volume({0, 0.6, 0.8}, {1, 2, 3});
    EXPECT_NEAR(g.x, 1, kDouble);
    EXPECT_NEAR(g.y, 2 - 0.6 * 3.6, kDouble); // (1,2,3) . n = 3.6
    EXPECT_NEAR(g.z, 3 - 0.8 * 3.6, kDouble);
}

TEST(GradientFormula, heightGradientIsRightOnShearedFootprints)
{
    // h = 0.3 x - 0.7 y on the plane z = 0; differences (2,1) and (-1,3): dh = -0.1 and -2.4.
    const glm::dvec3 g = cotan_gradient_of_height({0, 0, 1}, {2, 1, 0}, {-1, 3, 0}, -0.1, -2.4);
    EXPECT_NEAR(g.x, 0.3, kDouble);
    EXPECT_NEAR(g.y, -0.7, kDouble);
    const glm::dvec3 mirrored = cotan_gradient_of_height({0, 0, 1}, {2, 1, 0}, {1, -3, 0}, -0.1, 2.4);
    EXPECT_NEAR(mirrored.x, 0.3, kDouble);
    EXPECT_NEAR(mirrored.y, -0.7, kDouble);
}

TEST(GradientFormula, triplanarWeightsAreCubesOfTheExcessOverAFifth)
{
    const glm::dvec3 w = cotan_triplanar_weights({-0.6, 0.8, 0}); // 0.4^3 : 0.6^3 = 8 : 27
    EXPECT_NEAR(w.x, 8.0 / 35, kDouble);
    EXPECT_NEAR(w.y, 27.0 / 35, kDouble);
    EXPECT_EQ(w.z, 0);
    EXPECT_EQ(cotan_triplanar_weights({0.19, 0.98, 0}).x, 0); // below a fifth
    EXPECT_GT(cotan_triplanar_weights({0.21, 0.97, 0}).x, 0);
    EXPECT_NEAR(cotan_triplanar_weights({0, 0, 0}).y, 1.0 / 3, kDouble);
}

TEST(GradientFormula, triplanarSlopesFollowTheirCoordinates)
{
    // Planes: x at (z,y), y at (x,z), z at (x,y). With n = z the third component drops out.
    const glm::dvec3 g = cotan_gradient_triplanar({0, 0, 1}, {0.5, 0.3, 0.2}, {1, 2}, {4, 8}, {16, 32});
    EXPECT_NEAR(g.x, 0.2 * 16 + 0.3 * 4, kDouble);
    EXPECT_NEAR(g.y, 0.2 * 32 + 0.5 * 2, kDouble);
    EXPECT_NEAR(g.z, 0, kDouble);
    const glm::dvec3 h = cotan_gradient_triplanar({1, 0, 0}, {0.5, 0.3, 0.2}, {1, 2}, {4, 8}, {16, 32});
    EXPECT_NEAR(h.z, 0.5 * 1 + 0.3 * 8, kDouble);
}

} // namespace
} // namespace cotan
