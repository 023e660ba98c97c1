// Bar D3: nineteen kinds of input, most of them degenerate, in float with denormals flushed as
// GPUs do. No NaN or infinity, unit length, the plain normal where no frame exists, and the same
// bits as the unguarded form on good input.
#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <limits>
#include <vector>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#include "patches.hpp"

namespace cotan {
namespace {

using namespace test;
using f32::cotan_frame;

// Flushes denormals while it lives.
class FlushDenormals {
public:
#if defined(__SSE2__)
    FlushDenormals() : saved_(_mm_getcsr()) { _mm_setcsr(saved_ | 0x8040); }
    ~FlushDenormals() { _mm_setcsr(saved_); }

private:
    unsigned saved_;
#endif
};

struct Input {
    glm::vec3 n; // as interpolated, not unit
    Differences<float> d;
    glm::vec3 m;
};

struct Case {
    const char* name;
    std::function<void(Random&, Input&)> spoil;
    bool plainNormal = false; // the answer is the plain normal to rounding
    double leanDegrees = 10;  // of n from the face
    bool mirrored = false;
};

Input goodInput(Random& random, double leanDegrees, bool mirrored)
{
    const AffinePatch p = randomPatch(random, mirrored);
    const glm::dvec3 e = glm::normalize(glm::cross(p.normal, random.direction()));
    glm::dvec3 view;
    do
        view = random.direction();
    while (glm::dot(view, p.normal) < 0.25);
    const auto d = screenDifferences(
        PixelCamera::lookAt(view * 3.0, {0, 0, 0}, random.direction(), 1000), p, e * 0.3);
    const glm::dvec3 away = glm::normalize(glm::cross(p.normal, random.direction()));
    const double a = leanDegrees * kDegree;
    const glm::dvec3 n = p.normal * std::cos(a) + away * std::sin(a);
    return {glm::vec3(n * random.range(0.6, 1)), toFloat(d), glm::vec3(tiltedTexel(random, 35))};
}

const std::vector<Case>& cases()
{
    using F = float;
    static const std::vector<Case> list = {
        {"good", [](Random&, Input&) {}},
        {"mirrored uv", [](Random&, Input&) {}, false, 10, true},
        {"constant uv", [](Random&, Input& x) { x.d.duvdx = x.d.duvdy = {0, 0}; }, true},
        {"collinear uv", [](Random& r, Input& x) { x.d.duvdy = x.d.duvdx * F(r.range(-2, 2)); }},
        {"u constant, v varies", [](Random&, Input& x) { x.d.duvdx.x = x.d.duvdy.x = 0; }},
        {"zero-area pixel triangle", [](Random& r, Input& x) {
             const F k = F(r.range(-2, 2));
             x.d.dpdy = x.d.dpdx * k;
             x.d.duvdy = x.d.duvdx * k;
         }},
        {"second difference zero", [](Random&, Input& x) {
             x.d.dpdy = {};
             x.d.duvdy = {0, 0};
         }, true},
        {"all differences zero", [](Random&, Input& x) { x.d = {}; }, true},
        {"n 80 degrees off the face", [](Random&, Input&) {}, false, 80},
        {"n 89.9 degrees off the face", [](Random&, Input&) {}, false, 89.9},
        {"n in the face plane", [](Random&, Input& x) { x.n = x.d.dpdx.raw(); }},
        {"n zero", [](Random&, Input& x) { x.n = {0, 0, 0}; }},
        {"tiny: everything x 1e-12", [](Random&, Input& x) {
             x.d.dpdx = x.d.dpdx * 1e-12f;
             x.d.dpdy = x.d.dpdy * 1e-12f;
             x.d.duvdx *= 1e-12f;
             x.d.duvdy *= 1e-12f;
         }},
        {"huge: dp x 1e16, uv x 1e8", [](Random&, Input& x) {
             x.d.dpdx = x.d.dpdx * 1e16f;
             x.d.dpdy = x.d.dpdy * 1e16f;
             x.d.duvdx *= 1e8f;
             x.d.duvdy *= 1e8f;
         }},
        {"uneven: dp x 1e10, uv x 1e-14", [](Random&, Input& x) {
             x.d.dpdx = x.d.dpdx * 1e10f;
             x.d.dpdy = x.d.dpdy * 1e10f;
             x.d.duvdx *= 1e-14f;
             x.d.duvdy *= 1e-14f;
         }},
        {"helper lane beyond the horizon", [](Random& r, Input& x) {
             const F k = F(-r.range(5, 500));
             x.d.dpdy = x.d.dpdy * k + x.d.dpdx * 0.3f;
             x.d.duvdy = x.d.duvdy * k + x.d.duvdx * 0.3f;
         }},
        {"one difference infinite or NaN", [](Random& r, Input& x) {
             const F bad = r.unit() < 0.5 ? std::numeric_limits<F>::infinity()
                                          : std::numeric_limits<F>::quiet_NaN();
             (r.unit() < 0.5 ? x.d.dpdy.x : x.d.duvdx.x) = bad;
         }, true},
        {"constant uv and a horizontal texel", [](Random&, Input& x) {
             x.d.duvdx = x.d.duvdy = {0, 0};
             x.m = {1, 0, 0};
         }, true},
        {"empty texel", [](Random&, Input& x) { x.m = {0, 0, 0}; }, true},
    };
    return list;
}

// The sign-corrected frame without a guard, from its formula.
cotan_frame unguarded(glm::vec3 n, const Differences<float>& d)
{
    const glm::vec3 a = glm::cross(d.dpdy.raw(), n), b = glm::cross(n, d.dpdx.raw());
    const glm::vec3 t = a * d.duvdx.x + b * d.duvdy.x, c = a * d.duvdx.y + b * d.duvdy.y;
    float r = 1 / std::sqrt(std::max(glm::dot(t, t), glm::dot(c, c)));
    if (glm::dot(d.dpdx.raw(), a) < 0)
        r = -r;
    cotan_frame f;
    f.t = t * r;
    f.b = c * r;
    f.n = n;
    return f;
}

constexpr std::array kTotalFrames = {Frame::cotangent, Frame::orthonormal, Frame::gradient, Frame::exact};

TEST(FrameBarD3, totalFramesGiveFiniteUnitNormalsInAll19Cases)
{
    ASSERT_EQ(cases().size(), 19u);
    FlushDenormals flush;
    for (Frame frame : kTotalFrames)
        for (const Case& c : cases()) {
            Random random(91);
            for (int i = 0; i < 2000; ++i) {
                Input x = goodInput(random, c.leanDegrees, c.mirrored);
                c.spoil(random, x);
                const auto f = makeFrame(frame, Covector3f(x.n), x.d);
                const glm::vec3 r = perturb(f, x.m).raw();
                ASSERT_TRUE(std::isfinite(r.x) && std::isfinite(r.y) && std::isfinite(r.z))
                    << name(frame) << ": " << c.name;
                ASSERT_NEAR(glm::length(r), 1, 1e-5) << name(frame) << ": " << c.name;
                for (const auto& v : {f.t, f.b, f.n})
                    ASSERT_TRUE(std::isfinite(length(v))) << name(frame) << ": " << c.name;
            }
        }
}

TEST(FrameBarD3, degenerateInputReturnsThePlainNormal)
{
    FlushDenormals flush;
    for (Frame frame : kTotalFrames)
        for (const Case& c : cases()) {
            if (!c.plainNormal)
                continue;
            Random random(92);
            for (int i = 0; i < 500; ++i) {
                Input x = goodInput(random, c.leanDegrees, c.mirrored);
                c.spoil(random, x);
                const glm::vec3 r = perturb(makeFrame(frame, Covector3f(x.n), x.d), x.m).raw();
                // float rounding of two normalisations: 1e-7 rad each, in degrees
                EXPECT_LT(degreesBetween(glm::dvec3(r), glm::normalize(glm::dvec3(x.n))), 3e-5)
                    << name(frame) << ": " << c.name;
            }
        }
}

TEST(FrameBarD3, guardsChangeNoBitOfAGoodPixel)
{
    FlushDenormals flush;
    for (const Case& c : cases()) {
        if (std::string_view(c.name) != "good" && std::string_view(c.name) != "mirrored uv")
            continue;
        Random random(93);
        for (int i = 0; i < 4000; ++i) {
            const Input x = goodInput(random, c.leanDegrees, c.mirrored);
            const glm::vec3 n = x.n * (1 / std::sqrt(glm::dot(x.n, x.n)));
            const glm::vec3 plain = cotan_apply(unguarded(n, x.d), x.m);
            const glm::vec3 total = perturb(makeFrame(Frame::cotangent, Covector3f(x.n), x.d), x.m).raw();
            ASSERT_EQ(std::memcmp(&plain, &total, sizeof plain), 0) << c.name << ", pixel " << i;
        }
    }
}

TEST(FrameBarD3, theUnguardedFormGivesNanOnConstantUv)
{
    Random random(94); // the control: the guards are needed
    Input x = goodInput(random, 10, false);
    x.d.duvdx = x.d.duvdy = {0, 0};
    EXPECT_TRUE(std::isnan(unguarded(x.n, x.d).t.x));
}

TEST(Frame, noFiniteOrNonFiniteBitPatternGivesANan)
{
    FlushDenormals flush;
    Random random(95);
    auto anyFloat = [&] {
        float f;
        std::uint32_t bits = std::uint32_t(random.bits());
        if ((bits & 7) == 0) // one in eight: zero, infinity, NaN, largest, smallest
            bits = std::array{0u, 0x7f800000u, 0x7fc00000u, 0x7f7fffffu, 0x00000001u, 0x80000000u,
                              0xff800000u, 0xff7fffffu}[(bits >> 8) & 7];
        std::memcpy(&f, &bits, 4);
        return f;
    };
    auto anyVector = [&] { return glm::vec3(anyFloat(), anyFloat(), anyFloat()); };
    for (int i = 0; i < 200000; ++i) {
        Differences<float> d{Vector3f(anyVector()), Vector3f(anyVector()), {anyFloat(), anyFloat()},
                             {anyFloat(), anyFloat()}};
        const Covector3f n(anyVector());
        const glm::vec3 m = tiltedTexel(random, 60);
        const glm::vec3 t = anyVector(), b = anyVector();
        std::vector<cotan_frame> made;
        for (Frame frame : kTotalFrames)
            made.push_back(detail::toText(makeFrame(frame, n, d)));
        made.push_back(f32::cotan_frame_smooth(n.raw(), t, b));
        made.push_back(f32::cotan_frame_vertex(n.raw(), t, -1.0f));
        for (std::size_t k = 0; k < made.size(); ++k) {
            const glm::vec3 r = cotan_apply(made[k], m);
            ASSERT_NEAR(glm::length(r), 1, 1e-5) << "frame " << k << ", input " << i;
            const glm::vec3 e = cotan_encode(made[k], r);
            ASSERT_NEAR(glm::length(e), 1, 1e-5) << "frame " << k << ", input " << i;
        }
    }
}

TEST(Frame, normalThatCancelledOutIsReplacedByTheFaceNormal)
{
    Random random(96);
    Input x = goodInput(random, 10, false);
    const auto f = makeFrame(Frame::cotangent, Covector3f{0, 0, 0}, x.d);
    const auto face = cross(x.d.dpdx, x.d.dpdy);
    EXPECT_LT(angle(f.n, face), 1e-6f);
    EXPECT_EQ(makeFrame(Frame::cotangent, Covector3f{0, 0, 0}, Differences<float>{}).n, (Covector3f{0, 0, 1}));
}

} // namespace
} // namespace cotan
