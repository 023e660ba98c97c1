// V. Schuessler, E. Heitz, J. Hanika, C. Dachsbacher, Microfacet-based Normal Mapping for Robust Monte Carlo Path
// Tracing, 2017. Facet 0 has the perturbed normal p; facet 1 is perpendicular to the surface. Their area-weighted
// mean normal is the surface's normal. A ray meets one of them with a probability given by the visible areas, and is
// reflected between both until it leaves, which conserves energy. The shadowing of NormalMapping::shadowed: A. Conty
// Estevez, P. Lecocq, C. Stein, A Microfacet-Based Shadowing Function to Solve the Bump Terminator Problem, 2019.
#include "pixel.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include <glm/geometric.hpp>

#include "core/other_axis.hpp"
#include "scene/environment_map.hpp"

namespace cotan::reference {

namespace {

constexpr int kWalks = 64, kBounces = 64;
constexpr float kPi = std::numbers::pi_v<float>;
constexpr int kEntries = 32; // of the albedo table, per axis

// Samples a half vector that is visible from v, for a point u of the unit square (J. Dupuy, A. Benyoub, Sampling
// Visible GGX Normals with Spherical Caps, 2023).
glm::vec3 visibleHalfVector(glm::vec3 v, float alpha, glm::vec2 u)
{
    const glm::vec3 stretched = glm::normalize(glm::vec3(alpha * v.x, alpha * v.y, v.z));
    const float z = (1 - u.y) * (1 + stretched.z) - stretched.z, side = std::sqrt(std::max(1 - z * z, 0.0f));
    const glm::vec3 cap = stretched + glm::vec3(side * std::cos(2 * kPi * u.x), side * std::sin(2 * kPi * u.x), z);
    return glm::normalize(glm::vec3(alpha * cap.x, alpha * cap.y, std::max(cap.z, 1e-7f)));
}

// Probability density, over solid angle, of the direction l that such a half vector reflects v to.
float densityOfReflection(glm::vec3 v, glm::vec3 l, float alpha)
{
    const glm::vec3 h = f32::cotan_half_vector(l, v);
    const float alpha2 = alpha * alpha, sine2 = h.x * h.x + h.y * h.y;
    const float d = sine2 + h.z * h.z * alpha2, distribution = alpha2 / (kPi * d * d);
    return distribution / (2 * (v.z + std::sqrt(alpha2 * (v.x * v.x + v.y * v.y) + v.z * v.z)));
}

// Cosine of a table entry. Entries are denser towards grazing angles.
float cosineOf(float row) { return std::max(row * row / float((kEntries - 1) * (kEntries - 1)), 1e-4f); }

using AlbedoTable = std::array<std::array<glm::vec2, kEntries>, kEntries>; // [roughness][cosine]

AlbedoTable makeAlbedos()
{
    constexpr int kSteps = 32;
    AlbedoTable table{};
    for (int i = 0; i < kEntries; ++i)
        for (int j = 0; j < kEntries; ++j) {
            const float roughness = std::max(float(i) / (kEntries - 1), 0.045f), nv = cosineOf(float(j));
            const glm::vec3 v(std::sqrt(std::max(1 - nv * nv, 0.0f)), 0, nv);
            glm::vec2 sum(0);
            for (int k = 0; k < kSteps * kSteps; ++k) {
                const glm::vec2 u((float(k % kSteps) + 0.5f) / kSteps, (float(k / kSteps) + 0.5f) / kSteps);
                const glm::vec3 h = visibleHalfVector(v, roughness * roughness, u);
                const glm::vec3 l = 2 * glm::dot(v, h) * h - v;
                const float density = densityOfReflection(v, l, roughness * roughness);
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

// The next number in [0,1) of a random sequence.
float nextRandom(std::uint32_t& state) // M. O'Neill's PCG, RXS-M-XS
{
    state = state * 747796405u + 2891336453u;
    const std::uint32_t word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return float(((word >> 22u) ^ word) >> 8u) * 0x1p-24f;
}

// Seeds by position, so that images of the same view are equal.
std::uint32_t seedOf(glm::vec3 position)
{
    std::uint32_t seed = 0;
    for (int i = 0; i < 3; ++i) {
        seed = (seed ^ std::bit_cast<std::uint32_t>(position[i])) * 0x9e3779b1u;
        seed = (seed ^ seed >> 15) * 0x85ebca77u;
    }
    return seed ^ seed >> 13;
}

// Metallic-roughness that conserves energy over several bounces: GGX for one bounce, and a diffuse term for the
// remaining energy, which makes white lossless and keeps the material reciprocal (C. Kulla, A. Conty, Revisiting
// Physically Based Shading at Imageworks, 2017). All directions are unit, in axes with the facet's normal as z.
class FacetMaterial {
public:
    FacetMaterial(const f32::cotan_surface& s, const f32::cotan_gloss& gloss)
        : roughness_(std::max(s.roughness, 0.045f)), lobes_{{.f0 = gloss.f0,
                                                             .f90 = gloss.f90,
                                                             .weight = 1 - s.metallic,
                                                             .tint = s.base_color * (1 - gloss.transmission),
                                                             .maxF0 = std::max({gloss.f0.x, gloss.f0.y, gloss.f0.z})},
                                                            {.f0 = s.base_color, .weight = s.metallic}}
    {
        constexpr int kSteps = 32;
        for (int i = 0; i < kSteps; ++i)
            for (Lobe& lobe : lobes_) {
                const float nv = (float(i) + 0.5f) / kSteps;
                lobe.mean += 2 * nv * albedo(lobe, factors(nv)) / kSteps;
            }
        Lobe& metal = lobes_[1];
        const glm::vec3 once = metal.f0 + (1.0f - metal.f0) / 21.0f; // mean of Schlick's term, weighted by the cosine
        metal.tint = once * once * metal.mean / (1.0f - once * (1 - metal.mean));
    }

    // Reflectance times the cosine of l; reciprocal except for that cosine.
    glm::vec3 reflect(glm::vec3 v, glm::vec3 l) const
    {
        if (!(l.z > 0 && v.z > 0))
            return glm::vec3(0);
        const float highlight = f32::cotan_ggx(glm::vec3(0, 0, 1), v, l, roughness_);
        const float grazing = f32::cotan_grazing(f32::cotan_saturate(glm::dot(v, f32::cotan_half_vector(l, v))));
        const glm::vec2 ofV = factors(v.z), ofL = factors(l.z);
        glm::vec3 sum(0);
        for (const Lobe& lobe : lobes_) {
            const float left =
                (1 - albedo(lobe, ofV)) * (1 - albedo(lobe, ofL)) / (kPi * std::max(1 - lobe.mean, 1e-4f));
            sum += lobe.weight * ((lobe.f0 + (lobe.f90 - lobe.f0) * grazing) * highlight + lobe.tint * left);
        }
        return sum * l.z;
    }

    // Samples a direction of incident light. weight: reflectance over density; 0 if it is below the facet.
    glm::vec3 sample(glm::vec3 v, std::uint32_t& state, glm::vec3& weight) const
    {
        const float alpha = roughness_ * roughness_;
        const glm::vec2 ofV = factors(v.z);
        float share = 0; // probability of GGX: by albedo, reduced for rough facets, which often reflect below the facet
        for (const Lobe& lobe : lobes_)
            share += lobe.weight * albedo(lobe, ofV) * (1 - alpha * alpha);
        share = std::clamp(share, 0.02f, 0.98f);
        const bool mirrored = nextRandom(state) < share;
        const float u1 = nextRandom(state), u2 = nextRandom(state);
        glm::vec3 l;
        if (mirrored) {
            const glm::vec3 h = visibleHalfVector(v, alpha, {u1, u2});
            l = 2 * glm::dot(v, h) * h - v;
        } else {
            const float side = std::sqrt(u2);
            l = {side * std::cos(2 * kPi * u1), side * std::sin(2 * kPi * u1), std::sqrt(std::max(1 - u2, 1e-7f))};
        }
        const float density = (1 - share) * std::max(l.z, 0.0f) / kPi + share * densityOfReflection(v, l, alpha);
        weight = l.z > 0 && density > 0 ? reflect(v, l) / density : glm::vec3(0);
        return l;
    }

private:
    // GGX, plus a diffuse term for the energy that one bounce does not reflect.
    struct Lobe {
        glm::vec3 f0{0};
        float f90 = 1;
        float weight = 0;
        glm::vec3 tint{0}; // of the diffuse term
        float maxF0 = 1;   // scalar f0 of the albedo
        float mean = 0;    // mean of the albedo, weighted by the cosine
    };

    static float albedo(const Lobe& lobe, glm::vec2 factors)
    {
        return std::min(lobe.maxF0 * factors.x + lobe.f90 * factors.y, 1.0f);
    }

    // The factors of f0 and f90 in the albedo, as albedoFactors of src/scene/environment.
    glm::vec2 factors(float nv) const
    {
        static const AlbedoTable table = makeAlbedos();
        const float row = roughness_ * (kEntries - 1), column = std::sqrt(f32::cotan_saturate(nv)) * (kEntries - 1);
        const int i = std::clamp(int(row), 0, kEntries - 2), j = std::clamp(int(column), 0, kEntries - 2);
        const float ki = row - float(i);
        const float low = cosineOf(float(j)), kj = std::clamp((nv - low) / (cosineOf(float(j + 1)) - low), 0.0f, 1.0f);
        const auto between = [&](int at) {
            const auto& line = table[std::size_t(at)];
            return line[std::size_t(j)] + (line[std::size_t(j + 1)] - line[std::size_t(j)]) * kj;
        };
        return between(i) + (between(i + 1) - between(i)) * ki;
    }

    float roughness_ = 1;
    Lobe lobes_[2]; // dielectric and metal
};

// An orthonormal basis.
struct Axes {
    glm::vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

    glm::vec3 toLocal(glm::vec3 d) const { return {glm::dot(x, d), glm::dot(y, d), glm::dot(z, d)}; }
    glm::vec3 toWorld(glm::vec3 d) const { return x * d.x + y * d.y + z * d.z; }
};

// Axes around z, whose x is as close to `towards` as possible.
Axes axesAround(glm::vec3 z, glm::vec3 towards)
{
    const glm::vec3 other = otherAxis(z);
    const glm::vec3 spare = glm::normalize(other - z * glm::dot(z, other));
    const glm::vec3 across = towards - z * glm::dot(z, towards);
    const glm::vec3 x = glm::dot(across, across) > 1e-10f ? glm::normalize(across) : spare;
    return {x, glm::cross(z, x), z};
}

// ---- the two facets, in axes with the surface's normal as z and p in the plane of x and z ----

class Facets {
public:
    explicit Facets(glm::vec3 p) // unit, p.y = 0
        : cosine_(std::clamp(p.z, 0.01f, 1.0f)),
          sine_(std::sqrt(1 - cosine_ * cosine_)), axes_{axesAround({sine_, 0, cosine_}, {1, 0, 0}),
                                                         axesAround({-1, 0, 0}, {0, 0, 1})}
    {
    }

    const Axes& axes(int facet) const { return axes_[facet]; }

    // Projected area of a facet visible from w, per area of the surface.
    float visibleArea(int facet, glm::vec3 w) const
    {
        return facet == 0 ? std::max(sine_ * w.x + cosine_ * w.z, 0.0f) / cosine_
                          : std::max(-w.x, 0.0f) * sine_ / cosine_;
    }

    // Probability that a ray from w meets facet 0.
    float firstProbability(glm::vec3 w) const
    {
        const float first = visibleArea(0, w), all = first + visibleArea(1, w);
        return all > 0 ? first / all : 1.0f;
    }

    // Probability that light which leaves the facet along w is not blocked by the other one.
    float escapeProbability(int facet, glm::vec3 w) const
    {
        const float all = visibleArea(0, w) + visibleArea(1, w);
        return visibleArea(facet, w) > 0 && w.z > 0 ? std::min(w.z / all, 1.0f) : 0.0f;
    }

private:
    float cosine_, sine_;
    Axes axes_[2];
};

// Reflects w by a mirror perpendicular to x.
glm::vec3 mirrored(glm::vec3 w) { return {-w.x, w.y, w.z}; }

struct Walker {
    const f32::cotan_surface& surface;
    const View& view;
    const std::vector<ArrivingLight>& lights; // in the surface's axes
    Axes axes;                                // of the surface
    FacetMaterial material;
    Facets facets;
    std::uint32_t state;

    glm::vec3 environmentAlong(glm::vec3 w) const
    {
        if (!view.environment)
            return glm::vec3(0);
        const glm::vec3 d = axes.toWorld(w);
        return surface.occlusion
            * (view.environmentMap ? radianceAlong(*view.environmentMap, d, 0) : f32::cotan_environment(d, 0));
    }

    glm::vec3 reflect(int facet, glm::vec3 v, glm::vec3 l) const
    {
        return material.reflect(facets.axes(facet).toLocal(v), facets.axes(facet).toLocal(l));
    }

    glm::vec3 sample(int facet, glm::vec3 v, glm::vec3& weight)
    {
        return facets.axes(facet).toWorld(material.sample(facets.axes(facet).toLocal(v), state, weight));
    }

    // Fraction of the light from w that reaches a surface with only a perturbed normal.
    float shadowing(glm::vec3 w) const
    {
        if (!(w.z > 0))
            return 0;
        if (view.normalMapping != NormalMapping::shadowed)
            return 1;
        const glm::vec3 p = facets.axes(0).z;
        const float alpha2 = std::min((p.x * p.x) / (p.z * p.z) / 8, 1.0f);
        return 2 / (1 + std::sqrt(1 + alpha2 * (w.x * w.x + w.y * w.y) / (w.z * w.z)));
    }

    glm::vec3 classic(glm::vec3 v)
    {
        glm::vec3 sum(0), weight(0);
        for (const ArrivingLight& light : lights)
            sum += light.irradiance * reflect(0, v, light.toLight) * shadowing(light.toLight);
        const glm::vec3 w = sample(0, v, weight);
        const float share = shadowing(w);
        return share > 0 && weight != glm::vec3(0) ? sum + weight * share * environmentAlong(w) : sum;
    }

    // Light from lamps at a facet seen from v; for NormalMapping::mirrorFacet also by way of the second facet.
    glm::vec3 lit(int facet, glm::vec3 v) const
    {
        glm::vec3 sum(0);
        for (const ArrivingLight& light : lights) {
            const glm::vec3 l = light.toLight;
            sum += light.irradiance * reflect(facet, v, l) * facets.escapeProbability(facet, l);
            if (view.normalMapping == NormalMapping::mirrorFacet && facets.escapeProbability(1, l) > 0)
                sum += light.irradiance * reflect(0, v, mirrored(l)) * (1 - facets.escapeProbability(0, mirrored(l)))
                    * facets.escapeProbability(1, l);
        }
        return sum;
    }

    // first: in [0,1), selects the first facet.
    glm::vec3 walk(glm::vec3 v, float first)
    {
        int facet = first < facets.firstProbability(v) ? 0 : 1;
        glm::vec3 sum(0), throughput(1);
        for (int bounce = 0; bounce < kBounces; ++bounce) {
            glm::vec3 w = -mirrored(v);
            if (facet == 0 || view.normalMapping != NormalMapping::mirrorFacet) {
                glm::vec3 weight(0);
                sum += throughput * lit(facet, v);
                w = sample(facet, v, weight);
                throughput *= weight;
                if (throughput == glm::vec3(0))
                    return sum;
            }
            if (nextRandom(state) < facets.escapeProbability(facet, w))
                return sum + throughput * environmentAlong(w);
            facet = 1 - facet;
            v = -w;
        }
        return sum;
    }
};

} // namespace

glm::vec3 radianceByRays(const f32::cotan_surface& surface, const f32::cotan_gloss& gloss, const LitPoint& point,
                         const View& view, const std::vector<ArrivingLight>& lights)
{
    const Axes axes = axesAround(point.normal, surface.n);
    std::vector<ArrivingLight> localLights = lights;
    for (ArrivingLight& light : localLights)
        light.toLight = axes.toLocal(light.toLight);
    glm::vec3 v = axes.toLocal(surface.v);
    v = glm::normalize(glm::vec3(v.x, v.y, std::max(v.z, 1e-3f)));
    Walker walker{surface,
                  view,
                  localLights,
                  axes,
                  FacetMaterial(surface, gloss),
                  Facets(axes.toLocal(surface.n)),
                  seedOf(point.position)};
    const bool classic = view.normalMapping == NormalMapping::rays || view.normalMapping == NormalMapping::shadowed;
    glm::vec3 sum(0);
    for (int i = 0; i < kWalks; ++i)
        sum += classic ? walker.classic(v) : walker.walk(v, (float(i) + nextRandom(walker.state)) / kWalks);
    return sum / float(kWalks);
}

} // namespace cotan::reference
