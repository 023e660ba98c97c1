#include "clip.hpp"

#include <glm/geometric.hpp>

#include "cotan/vector.hpp"

namespace cotan::reference {

namespace {

// The corner on the edge, computed from the inside to the outside whichever way round the edge is
// walked: so neighbours agree.
glm::dvec4 crossing(glm::dvec4 inside, double insideDistance, glm::dvec4 outside, double outsideDistance)
{
    double k = insideDistance / (insideDistance - outsideDistance);
    return inside + (outside - inside) * k;
}

Polygon cut(const Polygon& polygon, glm::dvec4 plane)
{
    Polygon result;
    for (int i = 0; i < polygon.count; ++i) {
        glm::dvec4 a = polygon.corner[std::size_t(i)];
        glm::dvec4 b = polygon.corner[std::size_t((i + 1) % polygon.count)];
        double da = glm::dot(plane, a), db = glm::dot(plane, b);
        if (da >= 0)
            result.corner[std::size_t(result.count++)] = a;
        bool leaves = da >= 0 && db < 0, enters = da < 0 && db >= 0;
        if (result.count == int(result.corner.size()))
            break; // rounding made the polygon concave; the lost sliver is below a sub-pixel
        if (leaves)
            result.corner[std::size_t(result.count++)] = crossing(a, da, b, db);
        if (enters)
            result.corner[std::size_t(result.count++)] = crossing(b, db, a, da);
        if (result.count == int(result.corner.size()))
            break;
    }
    return result;
}

} // namespace

Polygon clip(const std::array<glm::dvec4, 3>& triangle, int width, int height)
{
    Polygon polygon;
    for (const glm::dvec4& v : triangle) {
        if (!isFinite(v))
            return {};
        polygon.corner[std::size_t(polygon.count++)] = v;
    }
    const std::array<glm::dvec4, 5> planes = {{
        {0, 0, -1, 1},
        {1, 0, 0, kGuardBand},
        {-1, 0, 0, width + kGuardBand},
        {0, 1, 0, kGuardBand},
        {0, -1, 0, height + kGuardBand},
    }};
    for (const glm::dvec4& plane : planes) {
        bool allInside = true;
        for (int i = 0; i < polygon.count; ++i)
            allInside = allInside && glm::dot(plane, polygon.corner[std::size_t(i)]) >= 0;
        if (!allInside)
            polygon = cut(polygon, plane);
    }
    return polygon;
}

} // namespace cotan::reference
