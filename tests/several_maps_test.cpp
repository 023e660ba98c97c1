// Several maps on one surface: blends of texels and sums of gradients, compared with the surface that is displaced by
// the sum of the heights.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <glm/mat2x2.hpp>

#include "truth/patch.hpp"
#include "truth/relief.hpp"
#include "truth/surface.hpp"

namespace cotan {
namespace {

using namespace f64;

struct Degrees {
    double mean = 0, worst = 0;
};

// The angle between a blend of two maps and the normal of the summed heights, over a grid of both maps. slope: the
// steepest of each map, about.
Degrees errorOfBlend(double slope, glm::dvec3 (*blend)(glm::dvec3 base, glm::dvec3 detail))
{
    constexpr int kSteps = 200;
    const Waves broad{slope, 3}, fine{slope, 11};
    Degrees error;
    for (int i = 0; i < kSteps * kSteps; ++i) {
        const glm::dvec2 uv((i % kSteps + 0.5) / kSteps, (i / kSteps + 0.5) / kSteps);
        const ReliefSample a = broad.at(uv.x, uv.y), b = fine.at(uv.x, uv.y);
        const double d = degreesBetween(blend(texelOf(a), texelOf(b)), texelOf({0, a.hu + b.hu, a.hv + b.hv}));
        error.mean += d / (kSteps * kSteps);
        error.worst = std::max(error.worst, d);
    }
    return error;
}

glm::dvec3 sumOfGradients(glm::dvec3 base, glm::dvec3 detail)
{
    const cotan_frame f{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    return cotan_resolve_gradient(f.n,
                                  cotan_gradient_of_slope(f, cotan_slope_of_texel(base))
                                      + cotan_gradient_of_slope(f, cotan_slope_of_texel(detail)));
}

// docs/how-to/beyond.md has these numbers. `slopes` and the sum of gradients are exact: slopes of heights add. The
// others rotate, or add parts of unit vectors.
TEST(SeveralMaps, onlySlopesAndGradientsGiveTheSumOfTheHeights)
{
    struct Row {
        const char* name;
        glm::dvec3 (*blend)(glm::dvec3, glm::dvec3);
        Degrees gentle, steep;
    };
    const auto slopes = [](glm::dvec3 a, glm::dvec3 b) { return cotan_blend_slopes(a, b, 1, 1); };
    for (const Row& row : {Row{"gradients", sumOfGradients, {0, 0}, {0, 0}}, Row{"slopes", slopes, {0, 0}, {0, 0}},
                           Row{"whiteout", cotan_blend_whiteout, {0.07, 0.4}, {3.6, 9.7}},
                           Row{"reoriented", cotan_blend_reoriented, {0.09, 0.8}, {5.4, 26.2}},
                           Row{"udn", cotan_blend_udn, {0.04, 0.3}, {2.4, 12.4}},
                           Row{"linear", cotan_blend_linear, {4.50, 10.4}, {16.0, 23.6}}}) {
        const Degrees gentle = errorOfBlend(0.2, row.blend), steep = errorOfBlend(1, row.blend);
        EXPECT_NEAR(gentle.mean, row.gentle.mean, 0.006) << row.name;
        EXPECT_NEAR(gentle.worst, row.gentle.worst, 0.06) << row.name;
        EXPECT_NEAR(steep.mean, row.steep.mean, 0.06) << row.name;
        EXPECT_NEAR(steep.worst, row.steep.worst, 0.06) << row.name;
    }
}

// A detail on a second uv set, turned by 30 degrees, stretched and sheared against the first. Its gradients come from
// screen differences of its own uv.
TEST(SeveralMaps, aDetailOnOtherUvAddsAsItsHeightsDoAndInTheFirstFrameItIsTurned)
{
    Random random(91);
    const double c = std::cos(30 * kDegree), s = std::sin(30 * kDegree);
    const glm::dmat2 second = glm::dmat2({c, s}, {-s, c}) * glm::dmat2({2, 0}, {1, 1}); // uv of the first to the second
    const Waves broad{0.3, 3}, fine{0.3, 8};
    std::vector<Surface> all = surfaces();
    for (const Layout& layout : kLayouts)
        all.push_back(patchSurface(layout));
    for (const Surface& surface : all) {
        const double scale = surface.unitsPerUv();
        Degrees gradients, blended;
        constexpr int kPoints = 400;
        for (int i = 0; i < kPoints; ++i) {
            const SurfacePoint p = surface.at({random.range(0.2, 0.8), random.range(0.2, 0.8)});
            const glm::dvec2 uv2 = second * p.uv;
            const ReliefSample a = broad.at(p.uv.x, p.uv.y), b = fine.at(uv2.x, uv2.y);
            const glm::dvec2 sum = glm::dvec2(a.hu, a.hv) + glm::transpose(second) * glm::dvec2(b.hu, b.hv);
            const glm::dvec3 truth = surface.displacedNormal(p, {a.h + b.h, sum.x, sum.y}, scale);
            // A pixel that sees the surface from some side.
            const glm::dvec2 dx(random.range(-1, 1), random.range(-1, 1)), dy(-dx.y + 0.2, dx.x);
            const auto frameOf = [&](const glm::dmat2& m) {
                return cotan_frame_gradient(p.normal, p.dpdu * dx.x + p.dpdv * dx.y, p.dpdu * dy.x + p.dpdv * dy.y,
                                            m * dx, m * dy);
            };
            const cotan_frame first = frameOf(glm::dmat2(1)), own = frameOf(second);
            const glm::dvec2 slopeA = cotan_slope_of_texel(texelOf(a, scale)),
                             slopeB = cotan_slope_of_texel(texelOf(b, scale));
            const glm::dvec3 g = cotan_gradient_of_slope(first, slopeA);
            const auto add = [&](Degrees& d, const cotan_frame& f) {
                const double angle =
                    degreesBetween(cotan_resolve_gradient(p.normal, g + cotan_gradient_of_slope(f, slopeB)), truth);
                d.mean += angle / kPoints;
                d.worst = std::max(d.worst, angle);
            };
            add(gradients, own);
            add(blended, first);
        }
        // Exact on planes. On curved surfaces a height h bends the surface by h over the radius, which is no gradient.
        const bool isFlat = glm::length(surface.at({0.5, 0.5}).ns) + glm::length(surface.at({0.5, 0.5}).nt) == 0;
        EXPECT_LT(gradients.worst, isFlat ? 1e-5 : 6) << surface.name;
        EXPECT_LT(gradients.mean, 0.15 * blended.mean) << surface.name;
        EXPECT_GT(blended.mean, 3) << surface.name;
    }
}

} // namespace
} // namespace cotan
