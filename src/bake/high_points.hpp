// Points on the triangles of the detailed surface.
#pragma once

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "bake/high_surface.hpp"
#include "bake/surface/surface_triangle.hpp"

namespace cotan {

inline constexpr int kMaxCuts = 64; // of an edge of a large triangle

// Into how many parts the edges of a triangle are cut for points about `spacing` apart; 0 of a small one, and of one
// that nothing sees.
inline int cutsOf(const HighSurface::Triangles& part, std::size_t triangle, float spacing)
{
    if (!part.repeated.empty() && part.repeated[triangle])
        return 0;
    const std::uint32_t* c = &part.indices[3 * triangle];
    const glm::vec3 p0 = part.positions[c[0]], p1 = part.positions[c[1]], p2 = part.positions[c[2]];
    const float longest =
        std::sqrt(std::max({glm::dot(p1 - p0, p1 - p0), glm::dot(p2 - p1, p2 - p1), glm::dot(p0 - p2, p0 - p2)}));
    return longest > spacing ? int(std::min(std::ceil(longest / spacing), float(kMaxCuts))) : 0;
}

// Calls add(point, normal) for points between the corners of a triangle, about `spacing` apart.
template<class Add>
void pointsBetween(const HighSurface::Triangles& part, std::size_t triangle, float spacing, const Add& add)
{
    const int cuts = cutsOf(part, triangle, spacing);
    if (cuts == 0)
        return;
    const std::uint32_t* c = &part.indices[3 * triangle];
    for (int i = 0; i <= cuts; ++i)
        for (int j = 0; j <= cuts - i; ++j) {
            const float b1 = float(i) / float(cuts), b2 = float(j) / float(cuts);
            const glm::vec3 n = atVertices(part.normals, c, b1, b2);
            const float length = glm::length(n);
            if (length > 0)
                add(atVertices(part.positions, c, b1, b2), n / length);
        }
}

} // namespace cotan
