#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "bake/lint/triangle_uv.hpp"
#include "cotan/vector.hpp"
#include "lint_parts.hpp"

namespace cotan {

namespace {

// Gradients of u and v in the plane of a triangle, per unit of length.
struct Gradients {
    glm::dvec3 u{0}, v{0};
    bool usable = false;
};

Gradients gradientsOf(const TriangleEdges& e)
{
    const glm::dvec3 face = glm::cross(e.p1, e.p2);
    const double area2 = glm::dot(face, face);
    if (!(area2 > 0))
        return {};
    const glm::dvec3 r1 = glm::cross(e.p2, face) / area2, r2 = glm::cross(face, e.p1) / area2;
    return {r1 * e.uv1.x + r2 * e.uv2.x, r1 * e.uv1.y + r2 * e.uv2.y, true};
}

// The ratio of the two singular values of (grad u, grad v), at least 1; 0 where the smaller is below
// 1e-4 of the larger: uv along a line, or one point.
double stretchOf(const Gradients& g)
{
    const double uu = glm::dot(g.u, g.u), vv = glm::dot(g.v, g.v), uv = glm::dot(g.u, g.v);
    const double mean = (uu + vv) / 2;
    const double radius = std::sqrt((uu - vv) * (uu - vv) / 4 + uv * uv);
    const double large = mean + radius;
    // The smaller eigenvalue from the determinant: the difference would cancel out.
    const glm::dvec3 crossed = glm::cross(g.u, g.v);
    const double small = large > 0 ? glm::dot(crossed, crossed) / large : 0;
    return small > 1e-8 * large ? std::sqrt(large / small) : 0;
}

double shearOf(const Gradients& g)
{
    const double angle = glm::degrees(angleBetween(g.u, g.v));
    return std::abs(90 - angle);
}

} // namespace

TriangleUv triangleUv(const MappedSurface& surface, std::size_t triangle, const TriangleEdges& edges)
{
    const Gradients g = gradientsOf(edges);
    TriangleUv t;
    t.usable = g.usable;
    if (!g.usable)
        return t;
    t.stretch = stretchOf(g);
    t.degenerate = !(t.stretch > 0);
    t.gradient = std::max(glm::length(g.u), glm::length(g.v));
    t.density = std::sqrt(glm::length(glm::cross(g.u, g.v)));
    if (t.degenerate)
        return t;
    t.shear = shearOf(g);
    t.orientation = orientationOf(surface, triangle, edges);
    return t;
}

UvQuality lint::uvQuality(const MappedSurface& s)
{
    UvQuality q;
    ValueStatistics stretch, shear, gradient;
    for (std::size_t i = 0; i < s.triangleCount(); ++i) {
        const TriangleEdges edges = edgesOf(s, i);
        const double area = areaOf(edges);
        q.area += area;
        if (!s.hasUv())
            continue;
        for (std::size_t k = 0; k < 3; ++k)
            q.largestUv = std::max({q.largestUv, std::abs(s.uv(3 * i + k).x), std::abs(s.uv(3 * i + k).y)});
        const TriangleUv t = triangleUv(s, i, edges);
        if (!t.usable)
            continue;
        if (t.degenerate) {
            q.degenerate += area;
            continue;
        }
        q.mirrored += t.orientation < 0 ? area : 0;
        q.stretched += t.stretch > kStretched ? area : 0;
        q.sheared += t.shear > kSheared ? area : 0;
        stretch.add(t.stretch, area);
        shear.add(t.shear, area);
        gradient.add(t.gradient, 1);
    }
    const double whole = q.area > 0 ? q.area : std::numeric_limits<double>::quiet_NaN();
    q.degenerate /= whole;
    q.mirrored /= whole;
    q.stretched /= whole;
    q.sheared /= whole;
    q.stretch = summaryOf(std::move(stretch));
    q.shear = summaryOf(std::move(shear));
    q.gradient = gradient.count() > 0 ? gradient.percentile(0.5) : 0;
    return q;
}

} // namespace cotan
