// Compares the analytic surfaces with finite differences of their positions.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "truth/patch.hpp"
#include "truth/tessellation.hpp"

namespace cotan {
namespace {

// Central differences with step h: error of order h^2 in the derivative, rounding of order 1e-16/h.
constexpr double kStep = 1e-5;

glm::dvec3 positionAt(const Surface& surface, double s, double t) { return surface.at({s, t}).position; }

TEST(TruthSurface, tangentsAndGradientsAreDualAndTangential)
{
    Random random(21);
    for (const Surface& surface : surfaces())
        for (int i = 0; i < 200; ++i) {
            const double s = random.range(0.01, 0.99), t = random.range(0.01, 0.99);
            const SurfacePoint p = surface.at({s, t});
            EXPECT_NEAR(glm::length(p.normal), 1, 1e-12);
            EXPECT_NEAR(glm::dot(p.gradU, p.dpdu), 1, 1e-10) << surface.name;
            EXPECT_NEAR(glm::dot(p.gradU, p.dpdv), 0, 1e-10) << surface.name;
            EXPECT_NEAR(glm::dot(p.gradV, p.dpdu), 0, 1e-10) << surface.name;
            EXPECT_NEAR(glm::dot(p.gradV, p.dpdv), 1, 1e-10) << surface.name;
            EXPECT_NEAR(glm::dot(p.gradU, p.normal), 0, 1e-10) << surface.name;
            const glm::dvec2 back = surface.parameters(p.uv);
            EXPECT_NEAR(back.x, s, 1e-12);
            EXPECT_NEAR(back.y, t, 1e-12);
        }
}

TEST(TruthSurface, derivativesAgreeWithFiniteDifferences)
{
    Random random(22);
    for (const Surface& surface : surfaces())
        for (int i = 0; i < 100; ++i) {
            const double s = random.range(0.05, 0.95), t = random.range(0.05, 0.95);
            const SurfacePoint p = surface.at({s, t});
            const glm::dvec3 ps = (positionAt(surface, s + kStep, t) - positionAt(surface, s - kStep, t)) / (2 * kStep);
            const glm::dvec3 nt = (surface.at({s, t + kStep}).normal - surface.at({s, t - kStep}).normal) / (2 * kStep);
            EXPECT_LT(glm::length(ps - p.ps), 1e-6) << surface.name; // third derivatives up to 250, h^2 = 1e-10
            EXPECT_LT(glm::length(nt - p.nt), 1e-6) << surface.name;
        }
}

TEST(TruthSurface, displacedNormalIsThatOfTheDisplacedSurface)
{
    Random random(23);
    const Waves waves;
    for (const Surface& surface : surfaces()) {
        const double scale = surface.unitsPerUv();
        auto displaced = [&](double s, double t) {
            const SurfacePoint p = surface.at({s, t});
            return p.position + p.normal * (waves.at(p.uv.x, p.uv.y).h * scale);
        };
        for (int i = 0; i < 100; ++i) {
            const double s = random.range(0.05, 0.95), t = random.range(0.05, 0.95);
            const SurfacePoint p = surface.at({s, t});
            glm::dvec3 n = glm::cross(displaced(s + kStep, t) - displaced(s - kStep, t),
                                      displaced(s, t + kStep) - displaced(s, t - kStep));
            if (surface.inward)
                n = -n;
            const glm::dvec3 exact = surface.displacedNormal(p, waves.at(p.uv.x, p.uv.y), scale);
            EXPECT_LT(degreesBetween(n, exact), 0.001) << surface.name; // (150 h)^2 / 6 of a radian
        }
    }
}

TEST(TruthSurface, reliefDerivativesAgreeWithFiniteDifferences)
{
    const Waves waves;
    Random random(24);
    for (int i = 0; i < 200; ++i) {
        const double u = random.unit(), v = random.unit();
        const ReliefSample r = waves.at(u, v);
        EXPECT_NEAR((waves.at(u + kStep, v).h - waves.at(u - kStep, v).h) / (2 * kStep), r.hu, 1e-5);
        EXPECT_NEAR((waves.at(u, v + kStep).h - waves.at(u, v - kStep).h) / (2 * kStep), r.hv, 1e-5);
    }
}

TEST(TruthSurface, outwardNormalsPointAwayFromTheAxis)
{
    Random random(25);
    for (const Surface& surface : surfaces()) {
        if (surface.name != "sphere" && surface.name != "mercator")
            continue;
        for (int i = 0; i < 50; ++i) {
            const SurfacePoint p = surface.at({random.unit(), random.unit()});
            EXPECT_LT(glm::length(p.normal - p.position), 1e-10) << surface.name; // a unit sphere
        }
    }
}

// The properties that surface.hpp states for each surface, by independent formulas.
TEST(TruthSurface, surfacesHaveTheirStatedShapeAndCoordinates)
{
    std::map<std::string, const Surface*> named;
    for (const Surface& surface : surfaces())
        named[surface.name] = &surface;
    ASSERT_EQ(named.size(), 4u);
    const double pi = std::acos(-1.0);
    Random random(4);
    for (int i = 0; i < 50; ++i) {
        const double s = random.unit(), t = random.unit(), around = 2 * pi * s;
        const glm::dvec3 ring(std::cos(around), std::sin(around), 0), up(0, 0, 1);
        const SurfacePoint sphere = named["sphere"]->at({s, t});
        const double latitude = (t - 0.5) * 150 * pi / 180;
        EXPECT_NEAR(glm::length(sphere.position - (ring * std::cos(latitude) + up * std::sin(latitude))), 0, 1e-12);
        EXPECT_NEAR(glm::length(sphere.normal - sphere.position), 0, 1e-9);
        EXPECT_NEAR(glm::length(sphere.dpdv), 2 * pi, 1e-9); // along meridians as at the equator
        const SurfacePoint mercator = named["mercator"]->at({s, t});
        EXPECT_NEAR(glm::length(mercator.position), 1, 1e-12);
        EXPECT_NEAR(std::atanh(mercator.position.z), 4 * (t - 0.5), 1e-9); // the inverse of Mercator's projection
        EXPECT_NEAR(glm::dot(glm::normalize(glm::dvec3(mercator.position.x, mercator.position.y, 0)), ring), 1, 1e-12);
        EXPECT_NEAR(glm::length(mercator.dpdu), glm::length(mercator.dpdv), 1e-9); // conformal
        EXPECT_NEAR(glm::dot(mercator.dpdu, mercator.dpdv), 0, 1e-9);
        const SurfacePoint torus = named["torus"]->at({s, t});
        const double tube = 2 * pi * t;
        EXPECT_NEAR(glm::length(torus.position - (ring * (1 + 0.4 * std::cos(tube)) + up * (0.4 * std::sin(tube)))), 0,
                    1e-12);
        EXPECT_NEAR(glm::length(torus.normal - (ring * std::cos(tube) + up * std::sin(tube))), 0, 1e-9);
        EXPECT_NEAR(glm::length(torus.dpdv), 2 * pi, 1e-9);
        // The spout is symmetric in y.
        const Surface& spout = *named["spout"];
        const glm::dvec3 here = spout.at({s, t}).position, there = spout.at({1 - s, t}).position;
        EXPECT_NEAR(glm::length(here - there * glm::dvec3(1, -1, 1)), 0, 1e-12);
        EXPECT_EQ(spout.uv({s, t}), glm::dvec2(s + t * 0.25, 1.5 * t));
    }
    // At 1/2 a cubic Bezier curve weighs its control points by 1/8, 3/8, 3/8 and 1/8.
    const Surface& spout = *named["spout"];
    const auto expectAt = [&](double s, double t, glm::dvec3 expected) {
        EXPECT_NEAR(glm::length(spout.at({s, t}).position - expected), 0, 1e-12) << s << " " << t;
    };
    const double height = 0.75 * 1.33; // of the half tube, relative to its radius
    expectAt(0, 0, {0, -0.6, 0});
    expectAt(1, 0, {0, 0.6, 0});
    expectAt(0.5, 0, {0.6 * 0.1 * height, 0, 0.6 * height});
    expectAt(0, 1, {1.8, -0.15, 1.1});
    expectAt(0.5, 1, {1.8 - 0.15 * 0.3 * height, 0, 1.1 + 0.15 * 0.95 * height});
    expectAt(0, 0.5, {(3 * 0.8 + 3 * 1.2 + 1.8) / 8, -(0.6 + 3 * 0.5 + 3 * 0.25 + 0.15) / 8, (0.3 + 2.7 + 1.1) / 8});
    const double outX = 0.06 - 3 * 0.15 - 3 * 0.2 - 0.045, outZ = 0.6 + 3 * 0.475 + 3 * 0.15 + 0.1425;
    expectAt(0.5, 0.5, {7.8 / 8 + height * outX / 8, 0, 4.1 / 8 + height * outZ / 8});
}

// A patch with reversed orientation whose uv gradients have the lengths 1 and 2; the longer one defines the units.
TEST(TruthSurface, flatPatchesFollowTheirMatrix)
{
    const Surface patch = patchSurface({"patch", 0, 1, 0.5, 0});
    const SurfacePoint p = patch.at({0.25, 0.75});
    EXPECT_EQ(p.position, glm::dvec3(0.75, 0.125, 0));
    EXPECT_EQ(p.normal, glm::dvec3(0, 0, 1)); // although uv have the opposite orientation
    EXPECT_NEAR(glm::length(p.gradU - glm::dvec3(0, 2, 0)), 0, 1e-12);
    EXPECT_NEAR(glm::length(p.gradV - glm::dvec3(1, 0, 0)), 0, 1e-12);
    EXPECT_NEAR(patch.unitsPerUv(), 0.5, 1e-12);
    const glm::dvec3 m(0.3, -0.4, 1); // s = 1/2: (0.3 * 2 / 2) along y, -0.4 / 2 along x
    EXPECT_NEAR(glm::length(truthS(p, m) - glm::normalize(glm::dvec3(-0.2, 0.3, 1))), 0, 1e-12);
}

TEST(Tessellation, trianglesFaceTheirNormalsAndCoverTheParameters)
{
    for (const Surface& surface : surfaces())
        for (bool irregular : {false, true}) {
            const Tessellation mesh = tessellate(surface, 16, irregular, false);
            double area = 0;
            for (std::size_t f = 0; f < mesh.triangleCount(); ++f) {
                const std::uint32_t* v = &mesh.indices[3 * f];
                const glm::vec3 n = glm::cross(mesh.positions[v[1]] - mesh.positions[v[0]],
                                               mesh.positions[v[2]] - mesh.positions[v[0]]);
                EXPECT_GT(glm::dot(n, mesh.normals[v[0]]), 0) << surface.name;
                const glm::dvec2 a = mesh.parameters[v[1]] - mesh.parameters[v[0]];
                const glm::dvec2 b = mesh.parameters[v[2]] - mesh.parameters[v[0]];
                area += std::abs(a.x * b.y - a.y * b.x) / 2;
            }
            EXPECT_NEAR(area, 1, 1e-9) << surface.name; // no triangles overlap
        }
}

} // namespace
} // namespace cotan
