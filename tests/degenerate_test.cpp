// Bar D3: nineteen kinds of input, most of them degenerate, in float with denormals flushed as on GPUs. The result must
// be finite and of unit length, must be the unperturbed normal where no frame exists, and must match the unguarded form
// bit for bit on regular input.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <limits>
#include <vector>

#include "truth/degenerate.hpp"

namespace cotan {
namespace {

using f32::cotan_frame;

// The sign-corrected frame without guards, from its formula.
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
    ASSERT_EQ(degenerateCases().size(), 19u);
    FlushDenormals flush;
    for (Frame frame : kTotalFrames)
        for (const DegenerateCase& c : degenerateCases()) {
            Random random(91);
            for (int i = 0; i < 2000; ++i) {
                const PixelInput x = makeInput(random, c);
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
        for (const DegenerateCase& c : degenerateCases()) {
            if (!c.plainNormal)
                continue;
            Random random(92);
            for (int i = 0; i < 500; ++i) {
                const PixelInput x = makeInput(random, c);
                const glm::vec3 r = perturb(makeFrame(frame, Covector3f(x.n), x.d), x.m).raw();
                // float rounding of two normalisations: 1e-7 rad each, in degrees
                EXPECT_LT(degreesBetween(glm::dvec3(r), glm::normalize(glm::dvec3(x.n))), 3e-5)
                    << name(frame) << ": " << c.name;
            }
        }
}

TEST(FrameBarD3, guardsChangeNoBitOfARegularPixel)
{
    FlushDenormals flush;
    for (const DegenerateCase& c : degenerateCases()) {
        if (std::string_view(c.name) != "good" && std::string_view(c.name) != "mirrored uv")
            continue;
        Random random(93);
        for (int i = 0; i < 4000; ++i) {
            const PixelInput x = makeInput(random, c);
            const glm::vec3 n = x.n * (1 / std::sqrt(glm::dot(x.n, x.n)));
            const glm::vec3 plain = cotan_apply(unguarded(n, x.d), x.m);
            const glm::vec3 total = perturb(makeFrame(Frame::cotangent, Covector3f(x.n), x.d), x.m).raw();
            ASSERT_EQ(std::memcmp(&plain, &total, sizeof plain), 0) << c.name << ", pixel " << i;
        }
    }
}

TEST(FrameBarD3, unguardedFormGivesNanOnConstantUv)
{
    Random random(94); // the control: guards are needed
    PixelInput x = makeInput(random, degenerateCases().front());
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
            bits = std::array{0u,          0x7f800000u, 0x7fc00000u, 0x7f7fffffu,
                              0x00000001u, 0x80000000u, 0xff800000u, 0xff7fffffu}[(bits >> 8) & 7];
        std::memcpy(&f, &bits, 4);
        return f;
    };
    auto anyVector = [&] { return glm::vec3(anyFloat(), anyFloat(), anyFloat()); };
    for (int i = 0; i < 200000; ++i) {
        Differences<float> d{
            Vector3f(anyVector()), Vector3f(anyVector()), {anyFloat(), anyFloat()}, {anyFloat(), anyFloat()}};
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

TEST(Frame, zeroNormalIsReplacedByTheFaceNormal)
{
    Random random(96);
    PixelInput x = makeInput(random, degenerateCases().front());
    const auto f = makeFrame(Frame::cotangent, Covector3f{0, 0, 0}, x.d);
    const auto face = cross(x.d.dpdx, x.d.dpdy);
    EXPECT_LT(angle(f.n, face), 1e-6f);
    EXPECT_EQ(makeFrame(Frame::cotangent, Covector3f{0, 0, 0}, Differences<float>{}).n, (Covector3f{0, 0, 1}));
}

} // namespace
} // namespace cotan
