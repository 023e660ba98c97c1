// Bar D1: float, camera-relative, uv in [0,1): the error at a pixel footprint and a distance from
// the origin, against exact arithmetic on the same stored mesh.
#include <gtest/gtest.h>

#include <cmath>

#include "patches.hpp"

namespace cotan {
namespace {

using namespace test;

struct Trial {
    glm::dvec3 p[3], camera, m;
    glm::dvec2 uv[3], bary[3]; // bary of the pixel and its two neighbours
    glm::dvec3 normal;
    Differences<double> exact;
};

template<class V> V at(glm::dvec2 b, V a0, V a1, V a2) { return a0 + (a1 - a0) * b.x + (a2 - a0) * b.y; }

// A triangle of side one, `offset` from the origin, seen so that a pixel covers `footprint` units.
// Positions, uv and the eye are floats: that is the mesh whose picture is asked for.
Trial makeTrial(Random& random, double offset, double footprint)
{
    Trial t;
    const glm::dvec3 origin = random.direction() * offset;
    // uv density about one per unit, stretched by up to two, a little skewed
    AffinePatch q;
    q.normal = random.direction();
    const glm::dvec3 e = glm::normalize(glm::cross(q.normal, random.direction()));
    const glm::dvec3 h = glm::cross(q.normal, e);
    const double turn = random.azimuth();
    q.gradU = e * std::cos(turn) + h * std::sin(turn);
    q.gradV = (h * std::cos(turn) - e * std::sin(turn)) / random.range(1, 2)
        + q.gradU * random.range(-0.3, 0.3);
    const glm::dvec2 base{random.unit(), random.unit()};
    for (int k = 0; k < 3; ++k) {
        const double z = 2 * std::numbers::pi * k / 3 + random.range(-0.3, 0.3);
        const glm::dvec3 local = e * std::cos(z) + h * std::sin(z);
        t.p[k] = glm::dvec3(glm::vec3(origin + local));
        t.uv[k] = glm::dvec2(glm::vec2(base + q.uvAt(local)));
    }
    t.normal = glm::normalize(glm::cross(t.p[1] - t.p[0], t.p[2] - t.p[0]));
    glm::dvec3 view;
    do
        view = random.direction();
    while (glm::dot(view, t.normal) < 0.35);
    const glm::dvec3 centre = at(glm::dvec2(random.range(0.2, 0.4), random.range(0.2, 0.4)), t.p[0], t.p[1], t.p[2]);
    const PixelCamera c = PixelCamera::lookAt(centre + view * (footprint * 1000), centre, random.direction(), 1000);
    t.camera = glm::dvec3(glm::vec3(c.eye));
    auto barycentric = [&](glm::dvec3 x) {
        const glm::dvec3 a = t.p[1] - t.p[0], b = t.p[2] - t.p[0], r = x - t.p[0];
        const double aa = glm::dot(a, a), ab = glm::dot(a, b), bb = glm::dot(b, b);
        const double ra = glm::dot(r, a), rb = glm::dot(r, b), det = aa * bb - ab * ab;
        return glm::dvec2((ra * bb - rb * ab) / det, (rb * aa - ra * ab) / det);
    };
    const glm::dvec2 pixels[3] = {{0, 0}, {1, 0}, {0, 1}};
    for (int k = 0; k < 3; ++k)
        t.bary[k] = barycentric(c.meet(pixels[k], centre, t.normal));
    auto difference = [&](int k) {
        return at(t.bary[k], t.p[0], t.p[1], t.p[2]) - at(t.bary[0], t.p[0], t.p[1], t.p[2]);
    };
    auto uvDifference = [&](int k) {
        return at(t.bary[k], t.uv[0], t.uv[1], t.uv[2]) - at(t.bary[0], t.uv[0], t.uv[1], t.uv[2]);
    };
    t.exact = {Vector3d(difference(1)), Vector3d(difference(2)), uvDifference(1), uvDifference(2)};
    t.m = tiltedTexel(random, 35);
    return t;
}

// Interpolates as hardware does: float barycentrics, two fused adds from corner 0.
float interpolate(float a, float b, float c, glm::dvec2 w)
{
    return std::fma(float(w.y), c - a, std::fma(float(w.x), b - a, a));
}
glm::vec3 interpolate(const glm::vec3* p, glm::dvec2 w)
{
    return {interpolate(p[0].x, p[1].x, p[2].x, w), interpolate(p[0].y, p[1].y, p[2].y, w),
            interpolate(p[0].z, p[1].z, p[2].z, w)};
}
glm::vec2 interpolate(const glm::vec2* p, glm::dvec2 w)
{
    return {interpolate(p[0].x, p[1].x, p[2].x, w), interpolate(p[0].y, p[1].y, p[2].y, w)};
}

struct Error {
    double mean = 0;
    int notFinite = 0;
};

Error meanError(double offset, double footprint, bool cameraRelative, bool triangleEdges = false)
{
    Random random(81);
    Error error;
    constexpr int kTrials = 3000;
    for (int i = 0; i < kTrials; ++i) {
        const Trial t = makeTrial(random, offset, footprint);
        glm::vec3 p[3];
        glm::vec2 uv[3];
        for (int k = 0; k < 3; ++k) {
            p[k] = glm::vec3(cameraRelative ? t.p[k] - t.camera : t.p[k]);
            uv[k] = glm::vec2(t.uv[k]);
        }
        Differences<float> d;
        Differences<double> truth = t.exact;
        if (triangleEdges) {
            // Pixel differences in double at 1e6 would lose more digits than `exact` does in float.
            truth = {Vector3d(t.p[1] - t.p[0]), Vector3d(t.p[2] - t.p[0]), t.uv[1] - t.uv[0], t.uv[2] - t.uv[0]};
            d = {Vector3f(p[1] - p[0]), Vector3f(p[2] - p[0]), uv[1] - uv[0], uv[2] - uv[0]};
        } else {
            const glm::vec3 p0 = interpolate(p, t.bary[0]);
            const glm::vec2 uv0 = interpolate(uv, t.bary[0]);
            d = {Vector3f(interpolate(p, t.bary[1]) - p0), Vector3f(interpolate(p, t.bary[2]) - p0),
                 interpolate(uv, t.bary[1]) - uv0, interpolate(uv, t.bary[2]) - uv0};
        }
        const Frame frame = triangleEdges ? Frame::exact : Frame::cotangent;
        const auto f = makeFrame(frame, Covector3f(glm::vec3(t.normal)), d);
        const double e = degreesBetween(glm::dvec3(perturb(f, glm::vec3(t.m)).raw()),
                                        shade(Frame::cotangent, t.normal, truth, t.m));
        if (std::isfinite(e))
            error.mean += e / kTrials;
        else
            ++error.notFinite;
    }
    return error;
}

TEST(FrameBarD1, cameraRelativePositionsMakeTheDistanceFromTheOriginIrrelevant)
{
    for (auto [footprint, bar] : {std::pair(1e-3, 0.002), std::pair(1e-5, 0.12)}) {
        const Error near = meanError(0, footprint, true);
        EXPECT_EQ(near.notFinite, 0);
        EXPECT_LT(near.mean, bar) << footprint;
        for (double offset : {1e3, 1e6}) {
            const Error far = meanError(offset, footprint, true);
            EXPECT_EQ(far.notFinite, 0);
            EXPECT_NEAR(far.mean, near.mean, 0.1 * near.mean) << footprint << " at " << offset;
        }
    }
}

TEST(FrameBarD1, interpolatedWorldPositionsAreUnusableFarFromTheOrigin)
{
    EXPECT_GT(meanError(1e5, 1e-3, false).mean, 10); // the control; measured 24
}

TEST(FrameBarD1, exactGradientsHoldAtEveryFootprint)
{
    for (double footprint : {1e-6, 1e-4, 1e-2})
        for (double offset : {0.0, 1e6}) {
            const Error e = meanError(offset, footprint, false, true);
            EXPECT_EQ(e.notFinite, 0);
            EXPECT_LT(e.mean, 1e-4) << footprint << " at " << offset; // measured 2.9e-6
        }
}

} // namespace
} // namespace cotan
