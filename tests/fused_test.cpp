// fused.h compared with frame.h: the fused forms in float give the same as the readable forms in double.
#include <gtest/gtest.h>

#include <array>

#include "truth/patch.hpp"

namespace cotan {
namespace {

using Fused = glm::vec3 (*)(glm::vec3, glm::vec3, glm::vec3, glm::vec2, glm::vec2, glm::vec3);
using Plain = f64::cotan_frame (*)(glm::dvec3, glm::dvec3, glm::dvec3, glm::dvec2, glm::dvec2);

// The frame `cotangent` with area-normalised scale, by its definition.
f64::cotan_frame areaFrame(glm::dvec3 n, glm::dvec3 dpdx, glm::dvec3 dpdy, glm::dvec2 duvdx, glm::dvec2 duvdy)
{
    f64::cotan_frame f = f64::cotan_frame_cotangent(n, dpdx, dpdy, duvdx, duvdy);
    const double scale = 1 / std::sqrt(glm::length(glm::cross(f.t, f.b)));
    f.t *= scale;
    f.b *= scale;
    return f;
}

// Passes the side for which n faces the viewer.
glm::vec3 perturbSeen(glm::vec3 n, glm::vec3 dpdx, glm::vec3 dpdy, glm::vec2 duvdx, glm::vec2 duvdy, glm::vec3 m)
{
    const float side = glm::dot(glm::dvec3(n), glm::cross(glm::dvec3(dpdx), glm::dvec3(dpdy))) < 0 ? -1.0f : 1.0f;
    return f32::cotan_perturb_cotangent_seen(n, dpdx, dpdy, duvdx, duvdy, m, side);
}

struct Pair {
    const char* name;
    Fused fused;
    Plain plain;
};

const std::array kPairs = {
    Pair{"cotangent", f32::cotan_perturb_cotangent, f64::cotan_frame_cotangent},
    Pair{"cotangent-area", f32::cotan_perturb_cotangent_area, areaFrame},
    Pair{"cotangent-seen", perturbSeen, f64::cotan_frame_triangle},
    Pair{"gradient", f32::cotan_perturb_gradient, f64::cotan_frame_gradient},
    Pair{"orthonormal", f32::cotan_perturb_orthonormal, f64::cotan_frame_orthonormal},
};

double degreesBetween(glm::dvec3 a, glm::dvec3 b)
{
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) / kDegree;
}

struct Input {
    glm::vec3 n, dpdx, dpdy, m;
    glm::vec2 duvdx, duvdy;
};

// Footprints with an area: the angle between position differences is at least 20 degrees, as is that between uv
// differences; n is tilted by up to 60 degrees and up to 40 % short.
Input soundInput(Random& random, bool mirrored, bool seenFromBehind, double scale)
{
    const auto polar = [&](double degrees, double length) {
        return glm::dvec2(std::cos(degrees * kDegree), std::sin(degrees * kDegree)) * length;
    };
    const glm::dvec3 face = random.direction();
    const glm::dvec3 x = glm::normalize(glm::cross(face, random.direction())), y = glm::cross(face, x);
    const double start = random.range(0, 360);
    const glm::dvec2 p0 = polar(start, random.range(0.3, 1)),
                     p1 = polar(start + random.range(20, 160), random.range(0.3, 1));
    const double uvStart = random.range(0, 360), side = mirrored ? -1 : 1;
    const double away = random.range(0, 60) * kDegree;
    const glm::dvec3 n = face * std::cos(away) + (x * p0.y - y * p0.x) / glm::length(p0) * std::sin(away);
    Input i;
    i.n = glm::vec3(n * random.range(0.6, 1) * (seenFromBehind ? -1.0 : 1.0));
    i.dpdx = glm::vec3((x * p0.x + y * p0.y) * scale);
    i.dpdy = glm::vec3((x * p1.x + y * p1.y) * scale);
    i.duvdx = glm::vec2(polar(uvStart, random.range(0.3, 1)) * scale);
    i.duvdy = glm::vec2(polar(uvStart + side * random.range(20, 160), random.range(0.3, 1)) * scale);
    i.m = glm::vec3(tiltedTexel(random, 60));
    return i;
}

glm::vec3 run(Fused f, const Input& i) { return f(i.n, i.dpdx, i.dpdy, i.duvdx, i.duvdy, i.m); }

// A gradient times a footprint is about one if uv differences are as long as position differences; both are scaled
// equally.
class FusedIsPlain : public testing::TestWithParam<double> {};

TEST_P(FusedIsPlain, upToRoundingOnRegularInput)
{
    // About thirty roundings of 6e-8, amplified by the conditioning of the input (1/sin 20 degrees for positions and
    // for uv, 1/cos 60 degrees for n and again for tilted m): 30 * 6e-8 * 3 * 3 * 2 * 2 rad = 4e-3 degrees in the worst
    // case.
    constexpr double kRounding = 4e-3;
    Random random(17);
    for (const Pair& pair : kPairs)
        for (int k = 0; k < 4000; ++k) {
            const Input i = soundInput(random, k & 1, k & 2, GetParam());
            const f64::cotan_frame f = pair.plain(i.n, i.dpdx, i.dpdy, i.duvdx, i.duvdy);
            const glm::dvec3 expected = f64::cotan_apply(f, i.m);
            const glm::vec3 found = run(pair.fused, i);
            ASSERT_LT(degreesBetween(expected, found), kRounding) << pair.name << " " << k;
            ASSERT_NEAR(glm::length(found), 1, 1e-6) << pair.name; // a few roundings
        }
}

TEST_P(FusedIsPlain, forTwoUvSetsItIsTheSumOfTheirGradients)
{
    constexpr double kStated = 0.01; // degrees, from fused.h
    Random random(19);
    for (int k = 0; k < 4000; ++k) {
        const Input i = soundInput(random, k & 1, k & 2, GetParam());
        Input other = soundInput(random, k & 4, k & 2, GetParam());
        other.duvdx *= 16; // a detail map with its own texel orientation
        other.duvdy *= 16;
        const auto gradientOf = [&](const Input& set) {
            const f64::cotan_frame f = f64::cotan_frame_cotangent(i.n, i.dpdx, i.dpdy, set.duvdx, set.duvdy);
            return f64::cotan_gradient_of_slope(f, f64::cotan_slope_of_texel(set.m));
        };
        const glm::dvec3 expected =
            f64::cotan_resolve_gradient(glm::normalize(glm::dvec3(i.n)), gradientOf(i) + gradientOf(other));
        const f32::cotan_footprint f = f32::cotan_footprint_of(i.n, i.dpdx, i.dpdy);
        const glm::vec3 found =
            f32::cotan_perturb_footprint(f,
                                         f32::cotan_footprint_slope(f, i.duvdx, i.duvdy, i.m)
                                             + f32::cotan_footprint_slope(f, other.duvdx, other.duvdy, other.m));
        ASSERT_LT(degreesBetween(expected, found), kStated) << k;
        ASSERT_NEAR(glm::length(found), 1, 1e-6);
        const glm::vec3 flat = f32::cotan_perturb_footprint(f, f32::cotan_footprint_slope(f, i.duvdx, i.duvdy, {}));
        ASSERT_LT(degreesBetween(glm::normalize(glm::dvec3(i.n)), flat), 1e-4) << "an empty texel";
        Input steep = i;
        steep.m.z = -steep.m.z; // below the horizon: clamped to the steepest slope
        const glm::vec3 held =
            f32::cotan_perturb_footprint(f, f32::cotan_footprint_slope(f, i.duvdx, i.duvdy, steep.m));
        const glm::dvec3 horizon = f64::cotan_resolve_gradient(glm::normalize(glm::dvec3(i.n)), gradientOf(steep));
        ASSERT_LT(degreesBetween(horizon, held), kStated) << "below the horizon";
    }
}

// Footprints of ten metres, a millimetre, and nearly the smallest area stated for `gradient`.
INSTANTIATE_TEST_SUITE_P(FromLargeToSmall, FusedIsPlain, testing::Values(10.0, 1e-3, 1e-4));

TEST(Fused, swappingTheDifferencesChangesNothing)
{
    // y-up against y-down targets, and any exchange of the two directions.
    Random random(18);
    for (const Pair& pair : kPairs)
        for (int k = 0; k < 1000; ++k) {
            Input i = soundInput(random, k & 1, k & 2, 1e-2);
            const glm::vec3 before = run(pair.fused, i);
            Input down = i;
            down.dpdy = -down.dpdy;
            down.duvdy = -down.duvdy;
            std::swap(i.dpdx, i.dpdy);
            std::swap(i.duvdx, i.duvdy);
            ASSERT_LT(degreesBetween(before, run(pair.fused, i)), 4e-3) << pair.name;
            ASSERT_LT(degreesBetween(before, run(pair.fused, down)), 4e-3) << pair.name;
        }
}

struct Degenerate {
    const char* name;
    void (*spoil)(Input&);
    bool plainNormal; // the result is n
};

const std::array kDegenerate = {
    Degenerate{"constant uv",
               [](Input& i) {
                   i.duvdx = i.duvdy = {0, 0};
               },
               true},
    Degenerate{"second difference zero",
               [](Input& i) {
                   i.dpdy = {0, 0, 0};
                   i.duvdy = {0, 0};
               },
               false},
    Degenerate{"all differences zero",
               [](Input& i) {
                   i.dpdx = i.dpdy = {0, 0, 0};
                   i.duvdx = i.duvdy = {0, 0};
               },
               true},
    Degenerate{"positions equal, uv differ",
               [](Input& i) {
                   i.dpdx = i.dpdy = {0, 0, 0};
               },
               true},
    Degenerate{"footprint without area",
               [](Input& i) {
                   i.dpdy = i.dpdx * 2.0f;
                   i.duvdy = i.duvdx * 2.0f;
               },
               false},
    Degenerate{"positions along a line, uv not", [](Input& i) { i.dpdy = i.dpdx * 2.0f; }, false},
    Degenerate{"uv along a line", [](Input& i) { i.duvdy = i.duvdx * 2.0f; }, false},
    Degenerate{"u constant", [](Input& i) { i.duvdx.x = i.duvdy.x = 0; }, false},
    Degenerate{"n in the surface", [](Input& i) { i.n = glm::normalize(i.dpdx); }, false},
    Degenerate{"empty texel",
               [](Input& i) {
                   i.m = {0, 0, 0};
               },
               true},
    Degenerate{"constant uv, horizontal texel",
               [](Input& i) {
                   i.duvdx = i.duvdy = {0, 0};
                   i.m = {1, 0, 0};
               },
               true},
};

TEST(Fused, degenerateInputGivesAUnitOrTheInterpolatedNormal)
{
    Random random(19);
    for (const Pair& pair : kPairs)
        for (const Degenerate& d : kDegenerate)
            for (int k = 0; k < 500; ++k) {
                Input i = soundInput(random, k & 1, k & 2, 1e-2);
                d.spoil(i);
                const glm::vec3 found = run(pair.fused, i);
                ASSERT_NEAR(glm::length(found), 1, 1e-6) << pair.name << ", " << d.name; // also fails for NaN
                if (d.plainNormal) {
                    // m.z is never negative here; the angle is a few roundings.
                    ASSERT_LT(degreesBetween(i.n, found), 1e-4) << pair.name << ", " << d.name;
                }
            }
}

TEST(Fused, orthonormalKeepsTheNormalIfUvHaveNoArea)
{
    // Like its frame, which has no t and b there. Doubling is exact, and so is the area of zero.
    Random random(23);
    for (int k = 0; k < 500; ++k) {
        Input i = soundInput(random, k & 1, k & 2, 1e-2);
        i.duvdy = i.duvdx * 2.0f;
        ASSERT_LT(degreesBetween(i.n, run(f32::cotan_perturb_orthonormal, i)), 1e-4);
    }
}

TEST(Fused, theScaleLimitsAreInTheStatedRange)
{
    // Products of the differences of 1e-12 and 1e5, the limits in fused.h; cotangent-seen and gradient have their own
    // limits.
    Random random(20);
    for (const Pair& pair : {kPairs[0], kPairs[1], kPairs[4]})
        for (const auto& [p, uv] :
             {std::pair(1e-6f, 1e-6f), std::pair(1e-9f, 1e-3f), std::pair(1e5f, 1.0f), std::pair(1e-1f, 1e6f)})
            for (int k = 0; k < 500; ++k) {
                Input i = soundInput(random, k & 1, k & 2, 1);
                const glm::vec3 before = run(pair.fused, i);
                // The longest difference in soundInput is between 0.3 and 1, so divide by 0.3 at the lower limit.
                const float up = p * uv < 1 ? 1 / 0.3f : 1.0f;
                i.dpdx *= p * up;
                i.dpdy *= p * up;
                i.duvdx *= uv * up;
                i.duvdy *= uv * up;
                ASSERT_LT(degreesBetween(before, run(pair.fused, i)), 4e-3) << pair.name << " " << p << " " << uv;
            }
}

TEST(Fused, areaScaleSteepensSlopesByTheStatedFactor)
{
    // uv stretched a:1 on a square footprint: sqrt(a). Sheared by the angle s: t = (1, 0), b = (-tan s, 1), so L^2 =
    // 1/cos^2 s and |t x b| = 1; the factor is the root of L^2 / |t x b|, 1/cos(s).
    const auto slope = [](Fused f, glm::vec2 duvdx, glm::vec2 duvdy) {
        const glm::vec3 v = f({0, 0, 1}, {0.01f, 0, 0}, {0, 0.01f, 0}, duvdx, duvdy, glm::vec3(0.3f, 0, 0.9f));
        return std::hypot(double(v.x), double(v.y)) / double(v.z);
    };
    const auto factor = [&](glm::vec2 duvdx, glm::vec2 duvdy) {
        return slope(f32::cotan_perturb_cotangent_area, duvdx, duvdy)
            / slope(f32::cotan_perturb_cotangent, duvdx, duvdy);
    };
    // Rounding of a dozen float operations.
    EXPECT_NEAR(factor({0.02f, 0}, {0, 0.02f}), 1, 1e-5);
    EXPECT_NEAR(factor({0, 0.02f}, {-0.02f, 0}), 1, 1e-5);
    EXPECT_NEAR(factor({0.06f, 0}, {0, 0.02f}), std::sqrt(3.0), 1e-5);
    EXPECT_NEAR(factor({0.02f, -0.02f}, {0, 0.02f}), std::sqrt(2.0), 1e-5);        // 45 degrees
    EXPECT_NEAR(factor({0.02f, -0.02f * std::sqrt(3.0f)}, {0, 0.02f}), 2.0, 1e-5); // 60 degrees
}

} // namespace
} // namespace cotan
