// The analytic surfaces against finite differences of their own positions.
#include <gtest/gtest.h>

#include <cmath>

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
            EXPECT_NEAR(area, 1, 1e-9) << surface.name; // no triangle folds over
        }
}

} // namespace
} // namespace cotan
