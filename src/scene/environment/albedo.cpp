#include "albedo.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "cotan/portable.hpp"

namespace cotan::environment {

namespace {

constexpr unsigned kSamples = 64;

// A microfacet normal as often as it is seen along v; n = z.
glm::dvec3 visibleNormal(glm::dvec3 v, double alpha, glm::dvec2 u)
{
    const glm::dvec3 stretched = glm::normalize(glm::dvec3(alpha * v.x, alpha * v.y, v.z));
    const double flat = stretched.x * stretched.x + stretched.y * stretched.y;
    const glm::dvec3 t =
        flat > 1e-12 ? glm::dvec3(-stretched.y, stretched.x, 0) / std::sqrt(flat) : glm::dvec3(1, 0, 0);
    const glm::dvec3 b = glm::cross(stretched, t);
    const double r = std::sqrt(u.x), phi = 2 * std::numbers::pi * u.y;
    const double x = r * std::cos(phi);
    const double s = (1 + stretched.z) / 2;
    const double y = (1 - s) * std::sqrt(std::max(1 - x * x, 0.0)) + s * r * std::sin(phi);
    const glm::dvec3 h = x * t + y * b + std::sqrt(std::max(1 - x * x - y * y, 0.0)) * stretched;
    return glm::normalize(glm::dvec3(alpha * h.x, alpha * h.y, std::max(h.z, 1e-9)));
}

// The point of a low-discrepancy set (Hammersley).
glm::dvec2 hammersley(unsigned index, unsigned count)
{
    unsigned bits = index;
    bits = (bits << 16) | (bits >> 16);
    bits = ((bits & 0x55555555u) << 1) | ((bits & 0xaaaaaaaau) >> 1);
    bits = ((bits & 0x33333333u) << 2) | ((bits & 0xccccccccu) >> 2);
    bits = ((bits & 0x0f0f0f0fu) << 4) | ((bits & 0xf0f0f0f0u) >> 4);
    bits = ((bits & 0x00ff00ffu) << 8) | ((bits & 0xff00ff00u) >> 8);
    return {(index + 0.5) / count, bits * 0x1p-32 + 0x1p-33};
}

} // namespace

glm::dvec2 albedoFactors(double nv, double roughness)
{
    nv = std::max(nv, 1e-4);
    const double alpha = std::max(roughness, 0.045) * std::max(roughness, 0.045), alpha2 = alpha * alpha;
    const glm::dvec3 v(std::sqrt(std::max(1 - nv * nv, 0.0)), 0, nv);
    const double rootV = std::sqrt(alpha2 + (1 - alpha2) * nv * nv);
    glm::dvec2 sum(0);
    for (unsigned i = 0; i < kSamples; ++i) {
        const glm::dvec3 h = visibleNormal(v, alpha, hammersley(i, kSamples));
        const double vh = std::max(glm::dot(v, h), 0.0);
        const double nl = 2 * vh * h.z - v.z;
        if (nl <= 0)
            continue;
        // Smith's term for both directions over the one for the eye, which the sampling has in it.
        const double rootL = std::sqrt(alpha2 + (1 - alpha2) * nl * nl);
        const double share = nl * (nv + rootV) / (nl * rootV + nv * rootL);
        const double fresnel = f64::cotan_grazing(std::min(vh, 1.0));
        sum += share * glm::dvec2(1 - fresnel, fresnel);
    }
    return sum / double(kSamples);
}

} // namespace cotan::environment
