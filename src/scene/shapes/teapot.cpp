#include "teapot.hpp"

#include <algorithm>

#include <glm/geometric.hpp>

#include "cotan/scene.hpp"
#include "grid.hpp"

namespace cotan {

namespace {

constexpr double kOriginalHeight = 3.15;

glm::dvec3 controlPoint(const teapot::Patch& patch, int row, int column)
{
    const auto& p = teapot::kControlPoints[patch[std::size_t(row * 4 + column)]];
    return {p.x, p.y, p.z};
}

struct Cubic {
    double value[4]; // Bernstein polynomials
    double slope[4]; // their derivatives
};

Cubic cubic(double t)
{
    const double s = 1 - t;
    return {{s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t},
            {-3 * s * s, 3 * s * s - 6 * s * t, 6 * s * t - 3 * t * t, 3 * t * t}};
}

// Whether the four control points of the first row are one: there the pole of a surface of revolution lies on the edge.
// No patch ends in one.
bool collapsed(const teapot::Patch& patch)
{
    for (int column = 1; column < 4; ++column)
        if (controlPoint(patch, 0, column) != controlPoint(patch, 0, 0))
            return false;
    return true;
}

// u runs against the columns and v along the rows: u rightwards and v downwards seen from outside.
ShapePoint patchPoint(const teapot::Patch& patch, double u, double v)
{
    const Cubic across = cubic(1 - u), along = cubic(v);
    glm::dvec3 p(0), byColumn(0), byRow(0), byBoth(0);
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column) {
            const glm::dvec3 c = controlPoint(patch, row, column);
            p += c * (across.value[column] * along.value[row]);
            byColumn += c * (across.slope[column] * along.value[row]);
            byRow += c * (across.value[column] * along.slope[row]);
            byBoth += c * (across.slope[column] * along.slope[row]);
        }
    // At a collapsed edge the derivative along it vanishes, and next to the edge it is
    // proportional to the mixed derivative: that gives the limit of the normal.
    if (v == 0 && collapsed(patch))
        byColumn = byBoth;
    const glm::dvec3 n = glm::normalize(glm::cross(byColumn, byRow));
    // z up to y up
    return {glm::dvec3(p.x, p.z, -p.y) / kOriginalHeight, glm::dvec3(n.x, n.z, -n.y)};
}

} // namespace

Mesh makeTeapot(int segmentsPerPatch)
{
    const int segments = std::max(segmentsPerPatch, 1);
    Mesh mesh;
    mesh.name = "teapot";
    for (const teapot::Patch& patch : teapot::kPatches) {
        const Grid grid{segments, segments, collapsed(patch)};
        appendGrid(mesh, grid, [&patch](double u, double v) { return patchPoint(patch, u, v); });
    }
    return mesh;
}

} // namespace cotan
