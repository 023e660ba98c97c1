// GGX reflectance of uniform white light, compared with a sum over all light directions.
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

#include "scene/environment/prefilter.hpp"

namespace cotan {
namespace {

// Directional albedo of GGX with the height-correlated Smith term and Schlick's Fresnel: y for f0 = 0, x what f0 = 1
// adds. Textbook integral of D G F / (4 nv) over the hemisphere of light directions, by the midpoint rule.
glm::dvec2 summed(double nv, double roughness)
{
    const double alpha2 = std::pow(roughness, 4);
    const glm::dvec3 v(std::sqrt(1 - nv * nv), 0, nv);
    const auto lambda = [&](double cosine) { return (std::sqrt(alpha2 / (cosine * cosine) + 1 - alpha2) - 1) / 2; };
    glm::dvec2 sum(0);
    constexpr int kUp = 600, kAround = 1200;
    for (int i = 0; i < kUp; ++i)
        for (int k = 0; k < kAround; ++k) {
            const double nl = (i + 0.5) / kUp, phi = 2 * std::numbers::pi * (k + 0.5) / kAround; // equal solid angles
            const double sine = std::sqrt(1 - nl * nl);
            const glm::dvec3 h = glm::normalize(v + glm::dvec3(sine * std::cos(phi), sine * std::sin(phi), nl));
            const double below = h.z * h.z * (alpha2 - 1) + 1;
            const double d = alpha2 / (std::numbers::pi * below * below);
            const double g = 1 / (1 + lambda(nv) + lambda(nl));
            const double fresnel = std::pow(1 - glm::dot(v, h), 5);
            sum += d * g / (4 * nv) * glm::dvec2(1 - fresnel, fresnel);
        }
    return sum * (2 * std::numbers::pi / (kUp * kAround));
}

TEST(Albedo, isTheSumOverAllLights)
{
    // 64 samples of a low-discrepancy set have an error of about 1/64 at most.
    for (const double roughness : {0.5, 0.7, 1.0})
        for (const double nv : {0.15, 0.3, 0.6, 0.95}) {
            const glm::dvec2 found = environment::albedoFactors(nv, roughness), right = summed(nv, roughness);
            EXPECT_NEAR(found.x, right.x, 0.016) << nv << ' ' << roughness;
            EXPECT_NEAR(found.y, right.y, 0.016) << nv << ' ' << roughness;
        }
}

} // namespace
} // namespace cotan
