// The direction of grooves on meshes of analytic surfaces, by every frame, compared with dP/du of the surface.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include <glm/mat2x2.hpp>

#include "truth/patch.hpp"
#include "truth/surface.hpp"
#include "truth/tessellation.hpp"

namespace cotan {
namespace {

using namespace f64;

struct GrooveError {
    double mean = 0, worst = 0;
};

cotan_frame frameAt(Frame frame, const Interpolated& x, const Differences<double>& screen)
{
    const glm::dvec3 n = glm::normalize(x.n);
    if (readsCotangents(frame))
        return evaluateCotangents(frame, n, x.cotangentU, x.cotangentV);
    if (readsTangents(frame)) {
        const glm::dvec4 t = x.tangents[std::size_t(frame)];
        return evaluateTangents(frame, frame == Frame::mikktspace ? x.n : n, glm::dvec3(t), t.w);
    }
    const Differences<double>& d = info(frame).source == FrameSource::triangle ? x.edges : screen;
    return evaluate(frame, n, d.dpdx.raw(), d.dpdy.raw(), d.duvdx, d.duvdy);
}

// Grooves have no sign.
double degreesBetweenLines(glm::dvec3 a, glm::dvec3 b)
{
    const double d = degreesBetween(a, b);
    return std::min(d, 180 - d);
}

GrooveError errorOfGrooves(const Surface& surface, Frame frame, int segments = 32)
{
    constexpr int kPoints = 1500;
    const Tessellation mesh = tessellate(surface, segments, false);
    Random random(101);
    GrooveError error;
    for (int i = 0; i < kPoints; ++i) {
        const Interpolated x = interpolate(mesh, randomPoint(random, mesh));
        const PixelCamera camera = PixelCamera::lookAt(x.position + x.plane.normal * 3.0 + random.direction(),
                                                       x.position, random.direction(), 800);
        const cotan_frame f = frameAt(frame, x, screenDifferences(camera, x.plane, x.position));
        const glm::dvec3 found = cotan_tangent_direction(f, glm::normalize(x.n), {1, 0});
        const double degrees = degreesBetweenLines(found, glm::normalize(surface.at(x.parameters).dpdu));
        error.mean += degrees / kPoints;
        error.worst = std::max(error.worst, degrees);
    }
    return error;
}

// A surface with other uv: turned by 30 degrees and sheared by 45, which also stretches them on a sphere.
Surface turned(Surface surface)
{
    const double c = std::cos(30 * kDegree), s = std::sin(30 * kDegree);
    surface.uvOfParameters = glm::dmat2({c, s}, {-s, c}) * glm::dmat2({1, 0}, {1, 1}) * surface.uvOfParameters;
    return surface;
}

Surface named(const char* name)
{
    return *std::ranges::find_if(surfaces(), [&](const Surface& s) { return s.name == name; });
}

// docs/how-to/beyond.md has these numbers, of meshes of 32 segments.
TEST(Grooves, everyFrameFindsThemAndSmoothAsWellAsStoredTangents)
{
    struct Row {
        const char* name;
        Surface surface;
        double pixel, smooth, mikktspace; // mean degrees; pixel: frames from differences or triangles
    };
    const Row rows[] = {{"sphere", named("sphere"), 1.5, 0.3, 0.2},
                        {"sphere, turned uv", turned(named("sphere")), 1.8, 0.4, 0.3},
                        {"torus", named("torus"), 1.8, 0.5, 0.4},
                        {"torus, turned uv", turned(named("torus")), 1.4, 0.5, 0.8},
                        {"sheared plane", patchSurface(kLayouts[3]), 0, 0, 0}};
    for (const Row& row : rows)
        for (const FrameInfo& frame : frames()) {
            // These shortcuts take differences as orthogonal, which they are not under perspective.
            if (frame.frame == Frame::nonperspective || frame.frame == Frame::paperOrthogonal)
                continue;
            const double expected = frame.frame == Frame::smooth ? row.smooth
                : readsTangents(frame.frame)                     ? row.mikktspace
                                                                 : row.pixel;
            // Others than `mikktspace` normalise in another order, or weight triangles in another way.
            const bool isOther = readsTangents(frame.frame) && frame.frame != Frame::mikktspace;
            const double tolerance = isOther ? 0.2 : 0.07;
            EXPECT_NEAR(errorOfGrooves(row.surface, frame.frame).mean, expected, tolerance)
                << row.name << ", " << frame.name;
        }
}

// The cause of the numbers: a direction that is constant on a triangle is wrong by its distance from the middle, and an
// interpolated one by the square of it.
TEST(Grooves, halfTheTrianglesSizeHalvesTheErrorAndQuartersThatOfSmooth)
{
    const Surface sphere = named("sphere");
    const auto ratio = [&](Frame frame) {
        return errorOfGrooves(sphere, frame, 32).mean / errorOfGrooves(sphere, frame, 64).mean;
    };
    EXPECT_NEAR(ratio(Frame::gradient), 2, 0.2);
    EXPECT_NEAR(ratio(Frame::triangle), 2, 0.2);
    EXPECT_GT(ratio(Frame::smooth), 2.5); // the seams and the rim, where averages have one side, are of first order
}

} // namespace
} // namespace cotan
