#include <utility>

#include <glm/geometric.hpp>

#include "bake/lint/triangle_uv.hpp"
#include "lint_parts.hpp"

namespace cotan {

std::array<StoredCorner, 3> storedCorners(const MappedSurface& s, std::size_t triangle, const TriangleEdges& edges)
{
    std::array<StoredCorner, 3> corners;
    if (!s.hasStored() || orientationOf(s, triangle, edges) == 0)
        return corners;
    for (std::size_t k = 0; k < 3; ++k) {
        StoredCorner& result = corners[k];
        const std::size_t corner = 3 * triangle + k;
        // Tangent first: t along dP/du, b on the side of +v.
        const f64::cotan_frame f = frameOf(spotOf(edges, s.normal(corner)), Frame::orthonormal);
        if (f.t == glm::dvec3(0))
            continue;
        const glm::dvec4 stored = s.stored(corner);
        const glm::dvec3 t =
            f64::cotan_normalize_or(glm::dvec3(stored) - f.n * glm::dot(glm::dvec3(stored), f.n), glm::dvec3(0));
        const double expected = glm::dot(glm::cross(f.n, f.t), f.b) < 0 ? -1 : 1;
        result.compared = true;
        result.reversed = stored.w * expected < 0;
        result.degrees = t == glm::dvec3(0) ? 180 : lint::degreesBetween(t, f.t);
    }
    return corners;
}

StoredTangents lint::storedTangents(const MappedSurface& s)
{
    StoredTangents result;
    result.present = s.hasStored();
    if (!result.present || !s.hasUv())
        return result;
    double compared = 0;
    ValueStatistics angles;
    for (std::size_t i = 0; i < s.triangleCount(); ++i) {
        const TriangleEdges edges = edgesOf(s, i);
        const double third = areaOf(edges) / 3;
        for (const StoredCorner& corner : storedCorners(s, i, edges)) {
            if (!corner.compared)
                continue;
            compared += third;
            result.reversedW += corner.reversed ? third : 0;
            result.turned += corner.degrees > kTurned ? third : 0;
            angles.add(corner.degrees, third);
        }
    }
    result.reversedW /= compared; // of nothing: NaN
    result.turned /= compared;
    result.angle = summaryOf(std::move(angles));
    return result;
}

} // namespace cotan
