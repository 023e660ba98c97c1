// Parallax compared with rays against displaced surfaces.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <string>

#include "truth/patch.hpp"
#include "truth/surface.hpp"

namespace cotan {
namespace {

using namespace f64;

// Low waves whose stored height stays between 0.2 and 1.
double storedHeight(glm::dvec2 uv)
{
    return 0.6 + 0.25 * std::sin(2 * std::numbers::pi * 3 * uv.x) + 0.15 * std::cos(2 * std::numbers::pi * 2 * uv.y);
}

cotan_frame metric(const SurfacePoint& p) { return {p.gradU, p.gradV, p.normal}; }

glm::dvec3 viewOf(Random& random, const SurfacePoint& p, double degrees)
{
    const glm::dvec3 side = glm::normalize(glm::cross(p.normal, random.direction()));
    return p.normal * std::cos(degrees * kDegree) + side * std::sin(degrees * kDegree);
}

cotan_relief search(const cotan_frame& f, glm::dvec3 v, glm::dvec2 uv, double depth, int steps, int halvings)
{
    cotan_relief r = cotan_relief_start(f, v, uv, depth, steps);
    for (int i = 0; i < steps + halvings; ++i)
        r = cotan_relief_next(r, storedHeight(r.uv));
    return r;
}

TEST(ParallaxOffset, isExactOnAnyPlane)
{
    Random random(81);
    for (const Layout& layout : kLayouts)
        for (int i = 0; i < 50; ++i) {
            const SurfacePoint p = patchSurface(layout).at({0.5, 0.5});
            const glm::dvec3 v = viewOf(random, p, random.range(0, 86));
            const double height = random.range(-0.3, 0.3);
            const glm::dvec2 offset = cotan_parallax_offset(metric(p), v * 7.0, height);
            // Moved on the plane by the offset and up by the height, the point is on the line of sight again.
            const glm::dvec3 moved = p.dpdu * offset.x + p.dpdv * offset.y + p.normal * height;
            EXPECT_LT(glm::length(glm::cross(moved, v)), 1e-9) << layout.name;
        }
}

// What other engines do: v by a matrix of unit tangents, height in uv, on this patch chosen so that u is right.
glm::dvec2 usualOffset(const SurfacePoint& p, glm::dvec3 v, double height)
{
    const glm::dvec3 t = glm::normalize(p.dpdu);
    const double w = glm::dot(glm::cross(p.normal, t), p.dpdv) < 0 ? -1 : 1;
    const glm::dvec3 local(glm::dot(t, v), glm::dot(glm::cross(p.normal, t), v) * w, glm::dot(p.normal, v));
    return glm::dvec2(local) / local.z * (height / glm::length(p.dpdu));
}

// docs/how-to/beyond.md has these numbers: texels of a map of 512, heights of 0.05, views of 60 degrees.
TEST(ParallaxOffset, theUsualFormIsWrongByTheStatedTexels)
{
    const std::map<std::string, double> stated = {{"square", 0},
                                                  {"stretch 2:1", 14.2},
                                                  {"stretch 4:1", 21.3},
                                                  {"shear 45", 28.4},
                                                  {"stretch 2:1 and shear 45", 20.1},
                                                  {"mirrored", 0},
                                                  {"scale 3", 0}};
    for (const Layout& layout : kLayouts) {
        Random random(82);
        const SurfacePoint p = patchSurface(layout).at({0.5, 0.5});
        double mean = 0;
        for (int i = 0; i < 1000; ++i) {
            const glm::dvec3 v = viewOf(random, p, 60);
            mean += glm::length(usualOffset(p, v, 0.05) - cotan_parallax_offset(metric(p), v, 0.05)) * 512 / 1000;
        }
        EXPECT_NEAR(mean, stated.at(layout.name), 0.06) << layout.name;
    }
}

// The nearest crossing of the line of sight with the displaced plane, by small steps.
double firstCrossing(const std::function<double(double)>& rayMinusSurface, double end, int steps)
{
    double before = rayMinusSurface(0);
    for (int i = 1; i <= steps; ++i) {
        const double at = end * i / steps, now = rayMinusSurface(at);
        if (now <= 0)
            return end * (i - 1 + before / (before - now)) / steps;
        before = now;
    }
    return end;
}

TEST(Relief, meetsTheDisplacedPlaneWhereTheRayDoes)
{
    Random random(83);
    constexpr double kDepth = 0.1;
    for (const Layout& layout : kLayouts)
        for (int i = 0; i < 60; ++i) {
            const SurfacePoint p = patchSurface(layout).at({random.unit(), random.unit()});
            const glm::dvec3 v = viewOf(random, p, random.range(0, 60));
            const double toBottom = kDepth / glm::dot(p.normal, v);
            auto above = [&](double distance) { // of the ray over the relief, in space
                const glm::dvec3 q = p.position - v * distance;
                const glm::dvec2 uv =
                    p.uv + glm::dvec2(glm::dot(p.gradU, q - p.position), glm::dot(p.gradV, q - p.position));
                return glm::dot(p.normal, q - p.position) - (storedHeight(uv) - 1) * kDepth;
            };
            const double truth = firstCrossing(above, toBottom, 4000);
            const cotan_frame f = metric(p);
            const cotan_relief r = search(f, v, p.uv, kDepth, 64, 6);
            // The last interval is 1/64 of the depth, halved 6 times.
            const double unit = toBottom / 64 / 64;
            EXPECT_NEAR(cotan_relief_distance(r, f, v, kDepth), truth, 2 * unit) << layout.name;
            const glm::dvec2 uv = p.uv - glm::dvec2(glm::dot(p.gradU, v), glm::dot(p.gradV, v)) * truth;
            EXPECT_LT(glm::length(r.uv - uv), 2 * unit * (glm::length(p.gradU) + glm::length(p.gradV))) << layout.name;
        }
}

// On a curved surface the search runs along a straight line in uv, from the plane of the point.
TEST(Relief, isOffOnASphereByTheStatedPartOfTheDepthOverTheRadius)
{
    Random random(84);
    const Surface& sphere = surfaces().front();
    ASSERT_EQ(sphere.name, "sphere");
    for (const double depth : {0.02, 0.01}) {
        double worst = 0, mean = 0;
        constexpr int kRays = 200;
        for (int i = 0; i < kRays; ++i) {
            const SurfacePoint p = sphere.at({random.range(0.2, 0.8), random.range(0.4, 0.6)});
            const glm::dvec3 v = viewOf(random, p, 45);
            // The radius is 1: heights and uv of any point in space are known.
            auto uvOf = [&](glm::dvec3 q) {
                glm::dvec2 s = p.parameters;
                for (int k = 0; k < 6; ++k) { // Newton's steps to the point below q
                    const SurfacePoint at = sphere.at(s);
                    const glm::dvec3 d = glm::normalize(q) - at.position;
                    s = sphere.parameters(at.uv + glm::dvec2(glm::dot(at.gradU, d), glm::dot(at.gradV, d)));
                }
                return sphere.uv(s);
            };
            auto above = [&](double distance) {
                const glm::dvec3 q = p.position - v * distance;
                return glm::length(q) - 1 - (storedHeight(uvOf(q)) - 1) * depth;
            };
            const double truth = firstCrossing(above, depth * 2, 400);
            const cotan_relief r = search(metric(p), v, p.uv, depth, 64, 6);
            const double error = glm::length(r.uv - uvOf(p.position - v * truth)) / glm::length(r.uv - p.uv + 1e-9);
            worst = std::max(worst, error);
            mean += error / kRays;
        }
        EXPECT_LT(mean, 0.9 * depth) << "in parts of the offset";
        EXPECT_LT(worst, 1.5 * depth);
    }
}

TEST(ReliefShadow, isFoundWhereTheRayToTheLightMeetsTheReliefAndNowhereElse)
{
    Random random(85);
    constexpr double kDepth = 0.4;
    int dark = 0, bright = 0;
    for (const Layout& layout : kLayouts)
        for (int i = 0; i < 100; ++i) {
            const SurfacePoint p = patchSurface(layout).at({random.unit(), random.unit()});
            const glm::dvec3 light = viewOf(random, p, random.range(20, 75));
            const cotan_frame f = metric(p);
            const double height = storedHeight(p.uv);
            const glm::dvec2 rate(glm::dot(f.t, light), glm::dot(f.b, light));
            const double top = (1 - height) * kDepth / glm::dot(f.n, light);
            // Of 4800 places along the ray: those inside the relief, and those that the search may count as inside.
            int inside = 0, near = 0;
            for (int k = 1; k <= 4800; ++k) {
                const double ray = height + (1 - height) * k / 4800;
                const double above = ray - storedHeight(p.uv + rate * (top * k / 4800));
                inside += above < -0.002;
                near += above < 0.002;
            }
            const bool shadowed = inside > 200; // longer than two of the 48 steps: no reading pattern misses it
            if (!shadowed && near > 100)        // grazing: decided by where the readings fall
                continue;
            cotan_relief r = cotan_relief_shadow(f, light, p.uv, height, kDepth, 48);
            for (int k = 0; k < 48; ++k)
                r = cotan_relief_next(r, storedHeight(r.uv));
            EXPECT_EQ(r.found > 0.5, shadowed) << layout.name << ", inside for " << inside / 48 << " %";
            (shadowed ? dark : bright)++;
        }
    EXPECT_GT(dark, 30);
    EXPECT_GT(bright, 30);
}

// A search ends a little inside the relief. Its point must not shadow itself, even near the surface: steps are small
// there.
TEST(ReliefShadow, aPointJustInsideAFlatReliefIsLit)
{
    const cotan_frame f{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (const double height : {0.3, 0.97, 1.0}) {
        cotan_relief r = cotan_relief_shadow(f, {1, 0, 1}, {0.5, 0.5}, height - 0.001, 0.1, 48);
        for (int k = 0; k < 48; ++k)
            r = cotan_relief_next(r, height);
        EXPECT_EQ(r.found, 0) << height;
    }
}

// Also where the relief fades: the distance belongs to the coordinates. It was 20 times the depth there once.
TEST(Relief, itsDistanceLeadsAlongTheLineOfSightToItsDepth)
{
    const cotan_frame f{{2, 0, 0}, {1, 1, 0}, {0, 0, 1}};
    for (const double degrees : {0.0, 50.0, 80.0, 86.0, 88.0, 89.9, 90.0, 120.0}) {
        const glm::dvec3 v(std::sin(degrees * kDegree), 0, std::cos(degrees * kDegree));
        cotan_relief r = cotan_relief_start(f, v * 3.0, {0, 0}, 0.2, 4);
        for (int k = 0; k < 4 + 20; ++k)
            r = cotan_relief_next(r, 0.375);
        const double distance = cotan_relief_distance(r, f, v * 3.0, 0.2);
        const glm::dvec3 found = -v * distance;
        EXPECT_LT(glm::length(r.uv - glm::dvec2(glm::dot(f.t, found), glm::dot(f.b, found))), 1e-6) << degrees;
        if (degrees < 87)
            EXPECT_NEAR(found.z, (0.375 - 1) * 0.2, 1e-6) << degrees;
        else
            EXPECT_LE(distance, degrees < 89 ? 0.2 * 20 : 0.2 * 20 * 0.05) << degrees;
        EXPECT_EQ(distance > 1e-9, degrees < 89.95) << degrees;
    }
}

TEST(Parallax, brokenAndExtremeInputLeavesTheCoordinates)
{
    const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    const cotan_frame f{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const glm::dvec2 uv(0.25, 0.75), none(0);
    for (const glm::dvec3 v : {glm::dvec3(0), glm::dvec3(nan, 0, 1), glm::dvec3(inf, 0, 1), glm::dvec3(1, 0, -0.1)}) {
        EXPECT_EQ(cotan_uv_per_height(f, v), none);
        EXPECT_EQ(cotan_relief_start(f, v, uv, 0.1, 8).uv, uv);
    }
    for (const double depth : {0.0, -1.0, nan, inf})
        EXPECT_EQ(cotan_relief_next(cotan_relief_start(f, {1, 1, 1}, uv, depth, 8), 0.5).uv, uv) << depth;
    EXPECT_EQ(cotan_uv_per_height({{nan, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {1, 1, 1}), none);
    // Towards the horizon the offset does not jump and ends at zero.
    double before = glm::length(cotan_uv_per_height(f, {1, 0, 0.06}));
    for (double z = 0.06; z >= 0; z -= 0.0001) {
        const double now = glm::length(cotan_uv_per_height(f, {1, 0, z}));
        EXPECT_LT(std::abs(now - before), 0.05);
        before = now;
    }
    EXPECT_EQ(cotan_uv_per_height(f, {1, 0, 0}), none);
    // Steps below 1 and heights that are not numbers end at the bottom of the relief.
    cotan_relief r = cotan_relief_start(f, {0, 0, 1}, uv, 0.1, nan);
    for (int i = 0; i < 4; ++i)
        r = cotan_relief_next(r, nan);
    EXPECT_EQ(r.uv, uv);
    EXPECT_EQ(r.at, 1);
}

} // namespace
} // namespace cotan
