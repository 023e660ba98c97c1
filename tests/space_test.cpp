// Vectors into texture space, and the direction of grooves, compared with analytic surfaces.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "truth/patch.hpp"
#include "truth/surface.hpp"

namespace cotan {
namespace {

using namespace f64;

cotan_frame unitFrame(const glm::dvec3& n, glm::dvec3 gradU, glm::dvec3 gradV)
{
    return cotan_frame_smooth(n, gradU, gradV);
}

TEST(TextureSpace, theInverseGivesTheVectorThatTheFrameTakesBack)
{
    Random random(61);
    for (int i = 0; i < 500; ++i) {
        const AffinePatch p = randomPatch(random, i & 1);
        // Gradients of any scale: an object of a millimetre and one of a kilometre.
        const double scale = std::pow(10.0, random.range(-4, 4));
        const cotan_frame f{p.gradU * scale, p.gradV * scale, p.normal};
        const glm::dvec3 v = random.direction(), m = cotan_to_texture_space(f, v);
        EXPECT_LT(glm::length(f.t * m.x + f.b * m.y + f.n * m.z - v), 1e-9);
        const glm::dvec3 texel = tiltedTexel(random, random.range(0, 80));
        EXPECT_LT(degreesBetween(cotan_to_texture_space(f, cotan_apply(f, texel)), texel), 1e-4);
    }
}

TEST(TextureSpace, theTransposeGivesTheChangesOfUvAndHeight)
{
    Random random(62);
    for (const Surface& s : surfaces()) {
        const SurfacePoint p = s.at({random.range(0.3, 0.7), random.range(0.3, 0.7)});
        const cotan_frame f{p.gradU, p.gradV, p.normal};
        const glm::dvec2 duv(random.range(-1, 1), random.range(-1, 1));
        const double dh = random.range(-1, 1);
        const glm::dvec3 travel = cotan_texture_travel(f, p.dpdu * duv.x + p.dpdv * duv.y + p.normal * dh);
        EXPECT_LT(glm::length(travel - glm::dvec3(duv, dh)), 1e-9) << s.name;
    }
}

// What a shader that lights in texture space gets wrong, in degrees.
struct SpaceErrors {
    double light = 0;     // mean error of the angle between the perturbed normal and the light
    double highlight = 0; // mean angle between a half vector and the perturbed normal that highlights it most
};
SpaceErrors spaceErrors(const Layout& layout, glm::dvec3 (*enter)(cotan_frame, glm::dvec3))
{
    Random random(63);
    const AffinePatch p = patchOf(layout);
    const cotan_frame f = unitFrame(p.normal, p.gradU, p.gradV);
    SpaceErrors sum;
    constexpr int kCases = 4000;
    for (int i = 0; i < kCases; ++i) {
        const glm::dvec3 m = tiltedTexel(random, random.range(0, 40)), n = cotan_apply(f, m);
        glm::dvec3 light = random.direction();
        light.z = std::abs(light.z);
        sum.light += std::abs(degreesBetween(m, enter(f, light)) - degreesBetween(n, light)) / kCases;
        sum.highlight += degreesBetween(cotan_apply(f, glm::normalize(enter(f, n))), n) / kCases;
    }
    return sum;
}

// docs/how-to/beyond.md has these numbers. The inverse keeps every highlight in place, as the chapter of 2006 says. For
// the angle to a light far from the normal neither is right, and the transpose is the nearer: light in world space.
TEST(TextureSpace, lightingThereIsWrongByTheStatedDegrees)
{
    struct Row {
        int layout;
        SpaceErrors transpose, inverse;
    };
    for (const Row& row : {Row{0, {0, 0}, {0, 0}}, Row{1, {5.5, 4.9}, {9.0, 0}}, Row{3, {6.3, 6.6}, {11.0, 0}},
                           Row{5, {0, 0}, {0, 0}}}) {
        const Layout& layout = kLayouts[std::size_t(row.layout)];
        const SpaceErrors transpose = spaceErrors(layout, cotan_texture_travel);
        const SpaceErrors inverse = spaceErrors(layout, cotan_to_texture_space);
        EXPECT_NEAR(transpose.light, row.transpose.light, 0.06) << layout.name;
        EXPECT_NEAR(transpose.highlight, row.transpose.highlight, 0.06) << layout.name;
        EXPECT_NEAR(inverse.light, row.inverse.light, 0.06) << layout.name;
        EXPECT_NEAR(inverse.highlight, 0, 1e-5) << layout.name;
    }
}

TEST(TextureSpace, degenerateFramesAndVectorsGiveNoNaN)
{
    const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    const glm::dvec3 n(0, 0, 1), x(1, 0, 0), zero(0);
    EXPECT_EQ(cotan_to_texture_space({zero, zero, n}, {3, 4, 5}), glm::dvec3(0, 0, 5));
    EXPECT_EQ(cotan_to_texture_space({x, x, n}, {3, 4, 5}), glm::dvec3(0, 0, 5));
    EXPECT_EQ(cotan_to_texture_space({x, {0, 1, 0}, n}, {nan, 0, 0}), zero);
    EXPECT_EQ(cotan_to_texture_space({x, {0, 1, 0}, n}, {0, inf, 1}), zero);
    EXPECT_EQ(cotan_to_texture_space({{nan, 0, 0}, {0, 1, 0}, n}, {3, 4, 5}), glm::dvec3(0, 0, 5));
    for (const cotan_frame& f : {cotan_frame{zero, zero, n}, cotan_frame{x, zero, n}, cotan_frame{{nan, 0, 0}, x, n}})
        for (const glm::dvec2 along : {glm::dvec2(1, 0), glm::dvec2(0, 0), glm::dvec2(nan, 1)}) {
            const glm::dvec3 d = cotan_tangent_direction(f, n, along);
            EXPECT_TRUE(d == zero || std::abs(glm::length(d) - 1) < 1e-9);
        }
    EXPECT_EQ(cotan_tangent_direction({x, {0, 1, 0}, n}, x, {1, 0}), zero) << "parallel to the perturbed normal";
}

// Grooves along u, and turned: as KHR_materials_anisotropy defines them, by dP/du and the perpendicular in the surface.
TEST(TangentDirection, isThatOfAnalyticSurfacesWithGradientsAndWithUnitFrames)
{
    Random random(64);
    std::vector<Surface> all = surfaces();
    for (const Layout& layout : kLayouts)
        all.push_back(patchSurface(layout));
    for (const Surface& s : all)
        for (int i = 0; i < 50; ++i) {
            const SurfacePoint p = s.at({random.range(0.2, 0.8), random.range(0.2, 0.8)});
            const glm::dvec3 along = glm::normalize(p.dpdu);
            glm::dvec3 across = glm::normalize(glm::cross(p.normal, along));
            across *= glm::dot(across, p.dpdv) < 0 ? -1.0 : 1.0;
            const double r = random.azimuth();
            const glm::dvec3 n = glm::normalize(p.normal + random.direction() * 0.3);
            glm::dvec3 truth = along * std::cos(r) - across * std::sin(r);
            truth = glm::normalize(truth - n * glm::dot(n, truth));
            for (const cotan_frame& f :
                 {cotan_frame{p.gradU, p.gradV, p.normal}, unitFrame(p.normal, p.gradU, p.gradV)}) {
                const glm::dvec3 d = cotan_tangent_direction(f, n, {std::cos(r), -std::sin(r)});
                EXPECT_LT(degreesBetween(d, truth), 1e-5) << s.name;
                EXPECT_LT(std::abs(glm::dot(d, n)), 1e-12);
            }
        }
}

// Why t itself is not the direction of the grooves.
TEST(TangentDirection, theCotangentIsFortyFiveDegreesOffOnAShearedPatch)
{
    const AffinePatch p = patchOf(kLayouts[3]); // shear 45
    const cotan_frame f = unitFrame(p.normal, p.gradU, p.gradV);
    EXPECT_NEAR(degreesBetween(f.t, cotan_tangent_direction(f, p.normal, {1, 0})), 45, 1e-5);
}

} // namespace
} // namespace cotan
