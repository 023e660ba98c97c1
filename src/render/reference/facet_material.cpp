// One bounce by GGX; the rest is scattered so that white loses nothing and light and eye may change places (C. Kulla,
// A. Conty, Revisiting Physically Based Shading at Imageworks, 2017).
#include "facet_material.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace cotan::reference {

namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr int kSide = 32; // of the table of albedos

// The half vector that v sees at a point of the unit square (J. Dupuy, A. Benyoub, Sampling Visible GGX Normals with
// Spherical Caps, 2023).
glm::vec3 seenHalfVector(glm::vec3 v, float alpha, glm::vec2 u)
{
    const glm::vec3 stretched = glm::normalize(glm::vec3(alpha * v.x, alpha * v.y, v.z));
    const float z = (1 - u.y) * (1 + stretched.z) - stretched.z, side = std::sqrt(std::max(1 - z * z, 0.0f));
    const glm::vec3 cap = stretched + glm::vec3(side * std::cos(2 * kPi * u.x), side * std::sin(2 * kPi * u.x), z);
    return glm::normalize(glm::vec3(alpha * cap.x, alpha * cap.y, std::max(cap.z, 1e-7f)));
}

// Of the directions that these half vectors mirror, by solid angle.
float densityOfMirrored(glm::vec3 v, glm::vec3 l, float alpha)
{
    const glm::vec3 h = f32::cotan_half_vector(l, v);
    const float alpha2 = alpha * alpha, sine2 = h.x * h.x + h.y * h.y;
    const float d = sine2 + h.z * h.z * alpha2, distribution = alpha2 / (kPi * d * d);
    return distribution / (2 * (v.z + std::sqrt(alpha2 * (v.x * v.x + v.y * v.y) + v.z * v.z)));
}

// Cosines lie closer towards grazing.
float cosineOf(float row) { return std::max(row * row / float((kSide - 1) * (kSide - 1)), 1e-4f); }

using AlbedoTable = std::array<std::array<glm::vec2, kSide>, kSide>; // by roughness, by cosine

AlbedoTable makeAlbedos()
{
    constexpr int kSteps = 32;
    AlbedoTable table{};
    for (int i = 0; i < kSide; ++i)
        for (int j = 0; j < kSide; ++j) {
            const float roughness = std::max(float(i) / (kSide - 1), 0.045f), nv = cosineOf(float(j));
            const glm::vec3 v(std::sqrt(std::max(1 - nv * nv, 0.0f)), 0, nv);
            glm::vec2 sum(0);
            for (int k = 0; k < kSteps * kSteps; ++k) {
                const glm::vec2 u((float(k % kSteps) + 0.5f) / kSteps, (float(k / kSteps) + 0.5f) / kSteps);
                const glm::vec3 h = seenHalfVector(v, roughness * roughness, u);
                const glm::vec3 l = 2 * glm::dot(v, h) * h - v;
                const float density = densityOfMirrored(v, l, roughness * roughness);
                if (!(l.z > 0 && density > 0))
                    continue;
                const float share = f32::cotan_ggx(glm::vec3(0, 0, 1), v, l, roughness) * l.z / density;
                const float grazing = f32::cotan_grazing(f32::cotan_saturate(glm::dot(v, h)));
                sum += share * glm::vec2(1 - grazing, grazing);
            }
            table[std::size_t(i)][std::size_t(j)] = sum / float(kSteps * kSteps);
        }
    return table;
}

} // namespace

float nextRandom(std::uint32_t& state) // M. O'Neill's PCG, RXS-M-XS
{
    state = state * 747796405u + 2891336453u;
    const std::uint32_t word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return float(((word >> 22u) ^ word) >> 8u) * 0x1p-24f;
}

FacetMaterial::FacetMaterial(const f32::cotan_surface& s, const f32::cotan_gloss& gloss)
    : roughness_(std::max(s.roughness, 0.045f))
{
    Lobe &dielectric = lobes_[0], &metal = lobes_[1];
    dielectric.f0 = gloss.f0;
    dielectric.f90 = gloss.f90;
    dielectric.weight = 1 - s.metallic;
    dielectric.tint = s.base_color * (1 - gloss.transmission);
    dielectric.white = std::max({gloss.f0.x, gloss.f0.y, gloss.f0.z});
    metal.f0 = s.base_color;
    metal.weight = s.metallic;
    constexpr int kSteps = 32;
    for (int i = 0; i < kSteps; ++i)
        for (Lobe& lobe : lobes_) {
            const float nv = (float(i) + 0.5f) / kSteps;
            lobe.mean += 2 * nv * albedo(lobe, factors(nv)) / kSteps;
        }
    const glm::vec3 once = metal.f0 + (1.0f - metal.f0) / 21.0f; // Schlick's term, its mean over the cosine
    metal.tint = once * once * metal.mean / (1.0f - once * (1 - metal.mean));
}

glm::vec3 FacetMaterial::reflect(glm::vec3 v, glm::vec3 l) const
{
    if (!(l.z > 0 && v.z > 0))
        return glm::vec3(0);
    const float highlight = f32::cotan_ggx(glm::vec3(0, 0, 1), v, l, roughness_);
    const float grazing = f32::cotan_grazing(f32::cotan_saturate(glm::dot(v, f32::cotan_half_vector(l, v))));
    const glm::vec2 ofV = factors(v.z), ofL = factors(l.z);
    glm::vec3 sum(0);
    for (const Lobe& lobe : lobes_) {
        const float left = (1 - albedo(lobe, ofV)) * (1 - albedo(lobe, ofL)) / (kPi * std::max(1 - lobe.mean, 1e-4f));
        sum += lobe.weight * ((lobe.f0 + (lobe.f90 - lobe.f0) * grazing) * highlight + lobe.tint * left);
    }
    return sum * l.z;
}

glm::vec3 FacetMaterial::sample(glm::vec3 v, std::uint32_t& state, glm::vec3& weight) const
{
    const float alpha = roughness_ * roughness_;
    const glm::vec2 ofV = factors(v.z);
    float share = 0; // of the microfacets: as they reflect, but rough ones mirror too much below the facet
    for (const Lobe& lobe : lobes_)
        share += lobe.weight * albedo(lobe, ofV) * (1 - alpha * alpha);
    share = std::clamp(share, 0.02f, 0.98f);
    const bool mirrored = nextRandom(state) < share;
    const float turn = nextRandom(state), height = nextRandom(state);
    glm::vec3 l;
    if (mirrored) {
        const glm::vec3 h = seenHalfVector(v, alpha, {turn, height});
        l = 2 * glm::dot(v, h) * h - v;
    } else {
        const float side = std::sqrt(height);
        l = {side * std::cos(2 * kPi * turn), side * std::sin(2 * kPi * turn), std::sqrt(std::max(1 - height, 1e-7f))};
    }
    const float density = (1 - share) * std::max(l.z, 0.0f) / kPi + share * densityOfMirrored(v, l, alpha);
    weight = l.z > 0 && density > 0 ? reflect(v, l) / density : glm::vec3(0);
    return l;
}

float FacetMaterial::albedo(const Lobe& lobe, glm::vec2 factors)
{
    return std::min(lobe.white * factors.x + lobe.f90 * factors.y, 1.0f);
}

glm::vec2 FacetMaterial::factors(float nv) const
{
    static const AlbedoTable table = makeAlbedos();
    const float row = roughness_ * (kSide - 1), column = std::sqrt(f32::cotan_saturate(nv)) * (kSide - 1);
    const int i = std::clamp(int(row), 0, kSide - 2), j = std::clamp(int(column), 0, kSide - 2);
    const float ki = row - float(i);
    const float low = cosineOf(float(j)), kj = std::clamp((nv - low) / (cosineOf(float(j + 1)) - low), 0.0f, 1.0f);
    const auto between = [&](int at) {
        const auto& line = table[std::size_t(at)];
        return line[std::size_t(j)] + (line[std::size_t(j + 1)] - line[std::size_t(j)]) * kj;
    };
    return between(i) + (between(i + 1) - between(i)) * ki;
}

} // namespace cotan::reference
