// The guards of frame.h one by one, frames from vertex attributes, and the table of frames.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "truth/patch.hpp"

namespace cotan {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr std::array kUnusable = {kNan, kInf, -kInf, 3e38f, -3e38f};

// All numbers that a frame from differences takes.
struct Arguments {
    std::array<float, 13> numbers = {0.2f,  -0.1f, 0.9f,                    // n
                                     0.03f, 0.01f, 0,     -0.02f, 0.05f, 0, // dpdx, dpdy
                                     0.2f,  -0.1f, 0.05f, 0.3f};            // duvdx, duvdy

    glm::vec3 triple(std::size_t k) const { return {numbers[k], numbers[k + 1], numbers[k + 2]}; }
    glm::vec2 pair(std::size_t k) const { return {numbers[k], numbers[k + 1]}; }
    f32::cotan_frame frame(Frame kind) const
    {
        return evaluate(kind, triple(0), triple(3), triple(6), pair(9), pair(11));
    }
};

constexpr std::array kTotal = {Frame::cotangent, Frame::orthonormal, Frame::gradient, Frame::exact};

bool isFinite(glm::vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

void expectPlain(const f32::cotan_frame& f, const char* what, std::string_view frame, std::size_t k, float bad)
{
    EXPECT_EQ(f.t, glm::vec3(0)) << what << ' ' << frame << ' ' << k << ' ' << bad;
    EXPECT_EQ(f.b, glm::vec3(0)) << what << ' ' << frame << ' ' << k << ' ' << bad;
}

TEST(FrameGuards, anyUnusableDifferenceGivesThePlainNormal)
{
    const glm::vec3 n = glm::normalize(Arguments().triple(0));
    for (const Frame frame : kTotal)
        for (std::size_t k = 3; k < 13; ++k)
            for (const float bad : kUnusable) {
                Arguments a;
                a.numbers[k] = bad;
                const f32::cotan_frame f = a.frame(frame);
                expectPlain(f, "difference", name(frame), k, bad);
                EXPECT_LT(glm::length(f.n - n), 1e-6f) << name(frame) << ' ' << k << ' ' << bad;
            }
}

TEST(FrameGuards, nonFiniteNormalsAreReplacedByThatOfTheFootprint)
{
    for (const Frame frame : kTotal) {
        Arguments facing;
        facing.numbers[0] = facing.numbers[1] = 0;
        facing.numbers[2] = 1;
        const f32::cotan_frame expected = facing.frame(frame); // the footprint is in z = 0, counter-clockwise
        for (std::size_t k = 0; k < 3; ++k)
            for (const float bad : kUnusable) {
                Arguments a;
                a.numbers[k] = bad;
                const f32::cotan_frame f = a.frame(frame);
                EXPECT_LT(glm::length(f.n - glm::vec3(0, 0, 1)), 1e-6f) << name(frame) << ' ' << k << ' ' << bad;
                EXPECT_LT(glm::length(f.t - expected.t), 1e-6f * glm::length(expected.t)) << name(frame);
                EXPECT_LT(glm::length(f.b - expected.b), 1e-6f * glm::length(expected.b)) << name(frame);
            }
    }
}

TEST(FrameGuards, badUvDoNotInvalidateThePositions)
{
    // Without n, the positions still give the direction that the surface faces.
    for (const Frame frame : kTotal) {
        Arguments a;
        a.numbers[0] = a.numbers[1] = a.numbers[2] = 0;
        std::swap(a.numbers[3], a.numbers[6]);
        std::swap(a.numbers[4], a.numbers[7]); // clockwise now
        a.numbers[10] = kNan;
        const f32::cotan_frame f = a.frame(frame);
        expectPlain(f, "uv", name(frame), 10, kNan);
        EXPECT_LT(glm::length(f.n - glm::vec3(0, 0, -1)), 1e-6f) << name(frame);
    }
}

TEST(FrameGuards, zeroAndConstantInputsGiveThePlainNormal)
{
    for (const Frame frame : kTotal) {
        Arguments uv;
        for (std::size_t k = 9; k < 13; ++k)
            uv.numbers[k] = 0;
        expectPlain(uv.frame(frame), "constant uv", name(frame), 0, 0);
        Arguments p;
        for (std::size_t k = 3; k < 9; ++k)
            p.numbers[k] = 0;
        expectPlain(p.frame(frame), "one place", name(frame), 0, 0);
    }
    Arguments line; // collinear uv: no orthonormal frame; a footprint without area: no gradient
    line.numbers[11] = 2 * line.numbers[9];
    line.numbers[12] = 2 * line.numbers[10];
    expectPlain(line.frame(Frame::orthonormal), "uv along a line", "orthonormal", 0, 0);
    Arguments thin;
    for (std::size_t k = 0; k < 3; ++k)
        thin.numbers[6 + k] = 2 * thin.numbers[3 + k];
    expectPlain(thin.frame(Frame::gradient), "no area", "gradient", 0, 0);
    expectPlain(thin.frame(Frame::exact), "no area", "exact", 0, 0);
    Arguments edgeOn; // n lies in the plane of the footprint, along dpdx
    edgeOn.numbers = {0.6f, 0.8f, 0, 0.3f, 0.4f, 0, -0.4f, 0.3f, 0, 0.2f, -0.1f, 0.05f, 0.3f};
    expectPlain(edgeOn.frame(Frame::gradient), "n in the plane", "gradient", 0, 0);
}

TEST(FrameGuards, gradientHasNoFrameIfItsDivisionWouldOverflow)
{
    // `seen` is the fraction of the footprint's area that is visible along n: on both sides of the threshold of 1e-12.
    for (const float seen : {1e-13f, 1e-11f}) {
        Arguments a;
        a.numbers = {1, 0, seen, 1, 0, 0, 0, 1, 0, 0.5f, 0.25f, -0.5f, 1};
        const f32::cotan_frame f = a.frame(Frame::gradient);
        if (seen < 1e-12f)
            expectPlain(f, "nearly in the plane", "gradient", 0, seen);
        else
            EXPECT_NEAR(f.t.z * seen, -0.5f, 1e-6f); // t . n = 0 and t . dpdx = 0.5
        EXPECT_TRUE(isFinite(f.t) && isFinite(f.b));
    }
}

TEST(FrameGuards, scaleIsAPowerOfTwoThatNormalisesTheLargest)
{
    for (const auto& [m, s] : {std::pair(1.0f, 1.0f), std::pair(1.99f, 1.0f), std::pair(2.0f, 0.5f),
                               std::pair(3.5f, 0.5f), std::pair(0.75f, 2.0f), std::pair(0.03f, 64.0f)})
        EXPECT_EQ(f32::cotan_power_of_two_scale(m), s) << m;
    EXPECT_EQ(f64::cotan_power_of_two_scale(3.5), 0.5);
    for (const float m : {0.0f, 1e-37f, 1e-45f, 1e37f, 3e38f, kInf}) {
        const float s = f32::cotan_power_of_two_scale(m);
        EXPECT_TRUE(std::isfinite(s) && s > 0) << m;
    }
    const auto d = f32::cotan_scale_differences({0.3f, -5, 0}, {0.1f, 0, 2}, {0.01f, 0.02f}, {-0.06f, 0});
    EXPECT_EQ(d.p_scale, 0.25f);
    EXPECT_EQ(d.uv_scale, 32);
    EXPECT_EQ(d.dpdx, glm::vec3(0.075f, -1.25f, 0));
    EXPECT_EQ(d.dpdy, glm::vec3(0.025f, 0, 0.5f));
    EXPECT_EQ(d.duvdx, glm::vec2(0.32f, 0.64f));
    EXPECT_EQ(d.duvdy, glm::vec2(-1.92f, 0));
    // Any of the ten numbers may be the largest.
    for (std::size_t k = 3; k < 13; ++k) {
        Arguments a;
        a.numbers[k] = -24;
        const auto large = f32::cotan_scale_differences(a.triple(3), a.triple(6), a.pair(9), a.pair(11));
        EXPECT_EQ(k < 9 ? large.p_scale : large.uv_scale, 1 / 16.0f) << k;
    }
}

TEST(FrameGuards, normalizeOrReturnsTheFallbackOnlyIfItMust)
{
    const glm::vec3 v(2, -3, 6), other(0.1f, 0.2f, 0.3f);
    for (const float length : {1e-36f, 1e-20f, 1.0f, 1e10f, 1e35f})
        EXPECT_LT(glm::length(f32::cotan_normalize_or(v * length, other) - v / 7.0f), 1e-6f) << length;
    for (const glm::vec3 bad : {glm::vec3(0), glm::vec3(kNan, 1, 2), glm::vec3(1, kNan, 2), glm::vec3(1, 2, kNan),
                                glm::vec3(1, kInf, 0), glm::vec3(0, 0, 3e37f)})
        EXPECT_EQ(f32::cotan_normalize_or(bad, other), other) << bad.x << ' ' << bad.y << ' ' << bad.z;
    // Neither the normal nor the footprint is usable.
    EXPECT_EQ(f32::cotan_safe_normal({0, 0, 0}, {0, 0, 0}, {0, 0, 0}), glm::vec3(0, 0, 1));
    EXPECT_LT(glm::length(f32::cotan_safe_normal({0, 0, 0}, {0, 2, 0}, {0, 0, 3}) - glm::vec3(1, 0, 0)), 1e-6f);
}

TEST(FrameGuards, signsOfZeroAndNan)
{
    EXPECT_EQ(f32::cotan_sign(-2), -1);
    EXPECT_EQ(f32::cotan_sign(-0.0f), 1);
    EXPECT_EQ(f32::cotan_sign(kNan), 1);
    EXPECT_EQ(f32::cotan_copy_sign(3, -0.0f), -3);
    EXPECT_EQ(f32::cotan_copy_sign(3, 0), 3);
    EXPECT_EQ(f32::cotan_max_abs({-4, 3, 2}), 4);
    EXPECT_EQ(f32::cotan_max_abs({1, -3, 2}), 3);
    EXPECT_EQ(f32::cotan_max_abs({1, 3, -5}), 5);
    EXPECT_EQ(f32::cotan_sum_abs({1, -3, -5}), 9);
}

f32::cotan_frame skewed()
{
    f32::cotan_frame f;
    f.t = {1, 0.2f, 0.1f};
    f.b = {-0.3f, 0.5f, 0.4f};
    f.n = {0.1f, -0.2f, 2};
    return f;
}

TEST(FrameGuards, applyIsTheNormalisedSumOrN)
{
    const f32::cotan_frame f = skewed();
    const glm::vec3 m(0.3f, -0.5f, 0.7f);
    EXPECT_LT(glm::length(f32::cotan_apply(f, m) - glm::normalize(f.t * m.x + f.b * m.y + f.n * m.z)), 1e-6f);
    EXPECT_EQ(f32::cotan_apply(f, {0, 0, 0}), f.n); // unchanged, not normalised
    EXPECT_EQ(f32::cotan_apply(f, {1e-8f, 0, 0}), f.n);
    EXPECT_EQ(f32::cotan_apply(f, {kNan, 0, 1}), f.n);
    EXPECT_EQ(f32::cotan_apply(f, {0, kInf, 1}), f.n);
    EXPECT_EQ(f32::cotan_apply(f, {1e19f, 0, 1}), f.n); // its square exceeds 1e37
    f32::cotan_frame flat = f;
    flat.t = flat.b = glm::vec3(0);
    EXPECT_EQ(f32::cotan_apply(flat, {1, 0, 0}), f.n);
}

TEST(FrameGuards, encodeSolvesForTheTexelAndIsFlatForDependentAxes)
{
    const f32::cotan_frame f = skewed();
    for (const glm::vec3 m : {glm::vec3(2, -3, 6) / 7.0f, glm::vec3(-6, 2, 3) / 7.0f, glm::vec3(3, 6, -2) / 7.0f}) {
        EXPECT_LT(glm::length(f32::cotan_encode(f, f.t * m.x + f.b * m.y + f.n * m.z) - m), 2e-6f);
        f32::cotan_frame mirrored = f;
        mirrored.t = -f.t;
        EXPECT_LT(glm::length(f32::cotan_encode(mirrored, mirrored.t * m.x + f.b * m.y + f.n * m.z) - m), 2e-6f);
    }
    f32::cotan_frame dependent = f;
    dependent.t = {1, 0, 0};
    dependent.b = {2, 0, 0}; // axis-aligned, so that no rounding hides it
    for (const f32::cotan_frame& g : {dependent, f32::cotan_frame{{0, 0, 0}, {0, 0, 0}, {0, 0, 1}},
                                      f32::cotan_frame{{kNan, 0, 0}, {0, 1, 0}, {0, 0, 1}}})
        EXPECT_EQ(f32::cotan_encode(g, {0.6f, 0, 0.8f}), glm::vec3(0, 0, 1));
}

// ---- from vertex attributes ------------------------------------------------------------------

TEST(SmoothFrame, isProjectedOntoThePlaneOfNAndScaledByTheLonger)
{
    Random random(71);
    for (int k = 0; k < 300; ++k) {
        const glm::dvec3 unit = random.direction(), n = unit * random.range(0.2, 3);
        const double scale = std::pow(10, random.range(-20, 20));
        const glm::dvec3 t = random.direction() * random.range(0.2, 5) * scale,
                         b = random.direction() * random.range(0.2, 5) * scale;
        const glm::dvec3 tangential = t - unit * glm::dot(t, unit), other = b - unit * glm::dot(b, unit);
        const double longer = std::max(glm::length(tangential), glm::length(other));
        const f64::cotan_frame f = f64::cotan_frame_smooth(n, t, b);
        EXPECT_LT(glm::length(f.t - tangential / longer), 1e-12);
        EXPECT_LT(glm::length(f.b - other / longer), 1e-12);
        EXPECT_LT(glm::length(f.n - unit), 1e-12);
    }
}

TEST(SmoothFrame, anyUnusableNumberGivesThePlainNormal)
{
    const glm::vec3 n(0, 0.6f, 0.8f);
    for (std::size_t k = 0; k < 6; ++k)
        for (const float bad : kUnusable) {
            std::array<float, 6> v = {1, 0.5f, -0.2f, 0.3f, 2, 0.1f};
            v[k] = bad;
            const f32::cotan_frame f = f32::cotan_frame_smooth(n, {v[0], v[1], v[2]}, {v[3], v[4], v[5]});
            EXPECT_EQ(f.t, glm::vec3(0)) << k << ' ' << bad;
            EXPECT_EQ(f.b, glm::vec3(0)) << k << ' ' << bad;
            EXPECT_LT(glm::length(f.n - n), 1e-6f) << k << ' ' << bad;
        }
    // Lengths may differ by any factor.
    EXPECT_EQ(f32::cotan_frame_smooth({0, 0, 1}, {1e-20f, 0, 0}, {0, 1e20f, 0}).b, glm::vec3(0, 1, 0));
    EXPECT_EQ(f32::cotan_frame_smooth({0, 0, 1}, {1e20f, 0, 0}, {0, 1e-20f, 0}).t, glm::vec3(1, 0, 0));
    const f32::cotan_frame none = f32::cotan_frame_smooth(n, {0, 0, 0}, {0, 0, 0});
    EXPECT_EQ(none.t, glm::vec3(0));
    EXPECT_EQ(none.b, glm::vec3(0));
    for (const float bad : kUnusable)
        EXPECT_EQ(f32::cotan_frame_smooth({bad, 0, 0}, {1, 0, 0}, {0, 1, 0}).n, glm::vec3(0, 0, 1)) << bad;
}

TEST(VertexFrame, isMadeOrthonormalAgain)
{
    Random random(72);
    for (int k = 0; k < 300; ++k) {
        const glm::dvec3 unit = random.direction(), n = unit * random.range(0.2, 3);
        const glm::dvec3 t = random.direction() * std::pow(10, random.range(-20, 20)); // far from perpendicular
        const double handedness = k % 2 ? -1 : 1;
        const f64::cotan_frame f = f64::cotan_frame_vertex(n, t, handedness);
        const glm::dvec3 expected = glm::normalize(t - unit * glm::dot(t, unit));
        EXPECT_LT(glm::length(f.t - expected), 1e-9);
        EXPECT_LT(glm::length(f.b - glm::cross(unit, expected) * handedness), 1e-9);
        EXPECT_LT(glm::length(f.n - unit), 1e-12);
    }
}

TEST(VertexFrame, missingTangentsOrOnesAlongNGiveThePlainNormal)
{
    const glm::vec3 n(0, 0, 2);
    for (const glm::vec3 t : {glm::vec3(0), glm::vec3(0, 0, 3), glm::vec3(0, 0, -1e-30f), glm::vec3(kNan, 0, 0),
                              glm::vec3(0, kInf, 0), glm::vec3(0, 1, 3e38f)}) {
        const f32::cotan_frame f = f32::cotan_frame_vertex(n, t, -1);
        EXPECT_EQ(f.t, glm::vec3(0));
        EXPECT_EQ(f.b, glm::vec3(0));
        EXPECT_EQ(f.n, glm::vec3(0, 0, 1));
    }
}

TEST(MikktspaceFrame, usesInterpolatedVectorsUnchanged)
{
    const glm::vec3 n(0.1f, 0.2f, 0.7f), t(0.8f, -0.3f, 0.2f);
    for (const float handedness : {1.0f, -1.0f}) {
        const f32::cotan_frame f = f32::cotan_frame_mikktspace(n, t, handedness);
        EXPECT_EQ(f.n, n);
        EXPECT_EQ(f.t, t);
        EXPECT_EQ(f.b, glm::cross(n, t) * handedness);
    }
}

// ---- the table of frames -----------------------------------------------------------------------

TEST(FrameTable, onlyTotalFramesAreFiniteForZeroDifferences)
{
    for (const FrameInfo& f : frames()) {
        const f32::cotan_frame none =
            evaluate(f.frame, glm::vec3(0, 0, 1), glm::vec3(0), glm::vec3(0), glm::vec2(0), glm::vec2(0));
        EXPECT_EQ(isFinite(none.t) && isFinite(none.b), f.total) << f.name;
    }
}

// Compares a function of the portable text with the evaluation of the frame of that name, for the same arguments.
template<class Found, class Expected>
void expectSame(const Found& found, const Expected& expected, std::string_view name)
{
    static_assert(std::is_same_v<Found, Expected>);
    EXPECT_EQ(found.t, expected.t) << name;
    EXPECT_EQ(found.b, expected.b) << name;
    EXPECT_EQ(found.n, expected.n) << name;
}

// One frame of each source by hand; one macro generates the rows themselves.
TEST(FrameTable, evaluationCallsTheNamedFunctionInBothPrecisions)
{
    const Arguments a;
    const glm::vec3 n = a.triple(0), x = a.triple(3), y = a.triple(6);
    const glm::vec2 u = a.pair(9), v = a.pair(11);
    const glm::dvec3 nd(n), xd(x), yd(y);
    const glm::dvec2 ud(u), vd(v);
    expectSame(evaluate(Frame::cotangent2013, n, x, y, u, v), f32::cotan_frame_cotangent_2013(n, x, y, u, v), "f32");
    expectSame(evaluate(Frame::cotangent2013, nd, xd, yd, ud, vd), f64::cotan_frame_cotangent_2013(nd, xd, yd, ud, vd),
               "f64");
    expectSame(evaluate(Frame::exact, n, x, y, u, v), f32::cotan_frame_exact(n, x, y, u, v), "f32");
    expectSame(evaluate(Frame::exact, nd, xd, yd, ud, vd), f64::cotan_frame_exact(nd, xd, yd, ud, vd), "f64");
    expectSame(evaluateCotangents(Frame::smooth, n, x, y), f32::cotan_frame_smooth(n, x, y), "f32");
    expectSame(evaluateCotangents(Frame::smooth, nd, xd, yd), f64::cotan_frame_smooth(nd, xd, yd), "f64");
    expectSame(evaluateTangents(Frame::vertex, n, x, -1), f32::cotan_frame_vertex(n, x, -1), "f32");
    expectSame(evaluateTangents(Frame::mikktspace, nd, xd, -1), f64::cotan_frame_mikktspace(nd, xd, -1), "f64");
}

// Frames from vertices cannot be evaluated from differences, nor the reverse.
TEST(FrameTable, framesOfAnotherSourceGiveThePlainNormal)
{
    const Arguments a;
    for (const FrameInfo& f : frames()) {
        const glm::vec3 n = a.triple(0);
        const f32::cotan_frame plain{glm::vec3(0), glm::vec3(0), n};
        if (readsVertices(f.frame))
            expectSame(a.frame(f.frame), plain, f.name);
        if (!readsCotangents(f.frame))
            expectSame(evaluateCotangents(f.frame, n, a.triple(3), a.triple(6)), plain, f.name);
        if (!readsTangents(f.frame))
            expectSame(evaluateTangents(f.frame, n, a.triple(3), 1), plain, f.name);
    }
}

} // namespace
} // namespace cotan
