// V. Schuessler, E. Heitz, J. Hanika, C. Dachsbacher, Microfacet-based Normal Mapping for Robust Monte Carlo Path
// Tracing, 2017. Facet 0 has the turned normal p, facet 1 stands upright and leans against it, so that the mean of
// both, by area, is the surface's normal. A ray sees one of them, by the area that faces it, and goes from one to the
// other until it leaves: nothing is lost. The shadowing of NormalMapping::shadowed is that of A. Conty Estevez,
// P. Lecocq, C. Stein, A Microfacet-Based Shadowing Function to Solve the Bump Terminator Problem, 2019.
#include "facets.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "core/other_axis.hpp"
#include "facet_material.hpp"
#include "scene/environment_map.hpp"

namespace cotan::reference {

namespace {

constexpr int kWalks = 64, kBounces = 64;

// Three unit vectors at right angles.
struct Axes {
    glm::vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

    glm::vec3 enter(glm::vec3 d) const { return {glm::dot(x, d), glm::dot(y, d), glm::dot(z, d)}; }
    glm::vec3 leave(glm::vec3 d) const { return x * d.x + y * d.y + z * d.z; }
};

// x towards `towards`, as far as it is across z.
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

    // Of a facet, per area of the surface, what is seen along w.
    float seen(int facet, glm::vec3 w) const
    {
        return facet == 0 ? std::max(sine_ * w.x + cosine_ * w.z, 0.0f) / cosine_
                          : std::max(-w.x, 0.0f) * sine_ / cosine_;
    }

    // Whether facet 0 is the one that is met along w.
    float shareOfFirst(glm::vec3 w) const
    {
        const float first = seen(0, w), all = first + seen(1, w);
        return all > 0 ? first / all : 1.0f;
    }

    // Of what goes along w from a facet, the share that the other one lets pass.
    float leaves(int facet, glm::vec3 w) const
    {
        const float all = seen(0, w) + seen(1, w);
        return seen(facet, w) > 0 && w.z > 0 ? std::min(w.z / all, 1.0f) : 0.0f;
    }

private:
    float cosine_, sine_;
    Axes axes_[2];
};

// As light leaves a mirror that stands across x.
glm::vec3 mirrored(glm::vec3 w) { return {-w.x, w.y, w.z}; }

struct Walker {
    const FacetPoint& point;
    const View& view;
    const std::vector<ArrivingLight>& lights; // in the surface's axes
    Axes axes;                                // the surface's
    FacetMaterial material;
    Facets facets;
    std::uint32_t state;

    glm::vec3 around(glm::vec3 w) const
    {
        if (!view.environment)
            return glm::vec3(0);
        const glm::vec3 d = axes.leave(w);
        return point.surface.occlusion
            * (view.environmentMap ? radianceAlong(*view.environmentMap, d, 0) : f32::cotan_environment(d, 0));
    }

    glm::vec3 reflect(int facet, glm::vec3 v, glm::vec3 l) const
    {
        return material.reflect(facets.axes(facet).enter(v), facets.axes(facet).enter(l));
    }

    glm::vec3 sample(int facet, glm::vec3 v, glm::vec3& weight)
    {
        return facets.axes(facet).leave(material.sample(facets.axes(facet).enter(v), state, weight));
    }

    // Of light along w, what reaches a surface whose normal is only turned.
    float reaches(glm::vec3 w) const
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
            sum += light.irradiance * reflect(0, v, light.toLight) * reaches(light.toLight);
        const glm::vec3 w = sample(0, v, weight);
        const float share = reaches(w);
        return share > 0 && weight != glm::vec3(0) ? sum + weight * share * around(w) : sum;
    }

    // What lights give at a facet that is met along v, and where the second is a mirror also by way of that.
    glm::vec3 lit(int facet, glm::vec3 v) const
    {
        glm::vec3 sum(0);
        for (const ArrivingLight& light : lights) {
            const glm::vec3 l = light.toLight;
            sum += light.irradiance * reflect(facet, v, l) * facets.leaves(facet, l);
            if (view.normalMapping == NormalMapping::mirrorFacet && facets.leaves(1, l) > 0)
                sum += light.irradiance * reflect(0, v, mirrored(l)) * (1 - facets.leaves(0, mirrored(l)))
                    * facets.leaves(1, l);
        }
        return sum;
    }

    // first: in [0,1), says which facet is met first.
    glm::vec3 walk(glm::vec3 v, float first)
    {
        int facet = first < facets.shareOfFirst(v) ? 0 : 1;
        glm::vec3 sum(0), left(1);
        for (int bounce = 0; bounce < kBounces; ++bounce) {
            glm::vec3 w = -mirrored(v);
            if (facet == 0 || view.normalMapping != NormalMapping::mirrorFacet) {
                glm::vec3 weight(0);
                sum += left * lit(facet, v);
                w = sample(facet, v, weight);
                left *= weight;
                if (left == glm::vec3(0))
                    return sum;
            }
            if (nextRandom(state) < facets.leaves(facet, w))
                return sum + left * around(w);
            facet = 1 - facet;
            v = -w;
        }
        return sum;
    }
};

} // namespace

glm::vec3 radianceByRays(const FacetPoint& point, const View& view, const std::vector<ArrivingLight>& lights)
{
    const Axes axes = axesAround(point.normal, point.surface.n);
    std::vector<ArrivingLight> entered = lights;
    for (ArrivingLight& light : entered)
        light.toLight = axes.enter(light.toLight);
    glm::vec3 v = axes.enter(point.surface.v);
    v = glm::normalize(glm::vec3(v.x, v.y, std::max(v.z, 1e-3f)));
    Walker walker{
        point,     view, entered, axes, FacetMaterial(point.surface, point.gloss), Facets(axes.enter(point.surface.n)),
        point.seed};
    const bool classic = view.normalMapping == NormalMapping::rays || view.normalMapping == NormalMapping::shadowed;
    glm::vec3 sum(0);
    for (int i = 0; i < kWalks; ++i)
        sum += classic ? walker.classic(v) : walker.walk(v, (float(i) + nextRandom(walker.state)) / kWalks);
    return sum / float(kWalks);
}

} // namespace cotan::reference
