// The Utah teapot.
#include <algorithm>
#include <array>

#include <glm/geometric.hpp>

#include "cotan/scene.hpp"
#include "grid.hpp"

namespace cotan {

namespace {

// Its control points: Martin Newell, University of Utah, 1975; public domain, in the arrangement with lid gap and
// bottom that has circulated since 1991. z up, resting on z = 0.

constexpr double kOriginalHeight = 3.15;

// A row of control points on a quarter of a circle about z: (radius, 0), (radius, bend), (bend, radius), (0, radius).
struct Ring {
    double radius, bend, z;
};
using Rings = std::array<Ring, 4>;

// Down the pot: the rim, and its wall in two parts.
constexpr std::array<Rings, 3> kPot = {{
    {{{1.4, 0.784, 2.4}, {1.3375, 0.749, 2.53125}, {1.4375, 0.805, 2.53125}, {1.5, 0.84, 2.4}}},
    {{{1.5, 0.84, 2.4}, {1.75, 0.98, 1.875}, {2, 1.12, 1.35}, {2, 1.12, 0.9}}},
    {{{2, 1.12, 0.9}, {2, 1.12, 0.45}, {1.5, 0.84, 0.225}, {1.5, 0.84, 0.15}}},
}};
// The knob, and the rest of the lid.
constexpr std::array<Rings, 2> kLid = {{
    {{{0, 0, 3.15}, {0.8, 0.45, 3.15}, {0, 0, 2.85}, {0.2, 0.112, 2.7}}},
    {{{0.2, 0.112, 2.7}, {0.4, 0.224, 2.55}, {1.3, 0.728, 2.55}, {1.3, 0.728, 2.4}}},
}};
constexpr Rings kBottom = {{{0, 0, 0}, {1.425, 0.798, 0}, {1.5, 0.84, 0.075}, {1.5, 0.84, 0.15}}};

// A row of control points on half of a bow that is symmetric about y = 0: from (x0, z0) to (x1, z1), and -width in y.
struct Bow {
    double x0, z0, x1, z1, width;
};

// Along the handle and along the spout, in two parts each.
constexpr std::array<std::array<Bow, 4>, 4> kHandleAndSpout = {{
    {{{-1.6, 2.025, -1.5, 2.25, 0.3},
      {-2.3, 2.025, -2.5, 2.25, 0.3},
      {-2.7, 2.025, -3, 2.25, 0.3},
      {-2.7, 1.8, -3, 1.8, 0.3}}},
    {{{-2.7, 1.8, -3, 1.8, 0.3},
      {-2.7, 1.575, -3, 1.35, 0.3},
      {-2.5, 1.125, -2.65, 0.9375, 0.3},
      {-2, 0.9, -1.9, 0.6, 0.3}}},
    {{{1.7, 1.425, 1.7, 0.6, 0.66},
      {2.6, 1.425, 3.1, 0.825, 0.66},
      {2.3, 2.1, 2.4, 2.025, 0.25},
      {2.7, 2.4, 3.3, 2.4, 0.25}}},
    {{{2.7, 2.4, 3.3, 2.4, 0.25},
      {2.8, 2.475, 3.525, 2.49375, 0.25},
      {2.9, 2.475, 3.45, 2.5125, 0.15},
      {2.8, 2.4, 3.2, 2.4, 0.15}}},
}};

using Patch = std::array<std::array<glm::dvec3, 4>, 4>;

// The rings turned by quarters: clockwise as seen from above, or counter-clockwise.
Patch quarterOf(const Rings& rings, int quarters, bool clockwise)
{
    Patch patch;
    for (std::size_t row = 0; row < 4; ++row) {
        const auto [radius, bend, z] = rings[row];
        const glm::dvec2 arc[] = {{radius, 0}, {radius, bend}, {bend, radius}, {0, radius}};
        for (std::size_t column = 0; column < 4; ++column) {
            glm::dvec2 p = arc[column];
            for (int i = 0; i < quarters; ++i)
                p = {-p.y, p.x};
            patch[row][column] = {p.x, clockwise ? -p.y : p.y, z};
        }
    }
    return patch;
}

// Each half goes around in the same direction.
Patch halfOf(const std::array<Bow, 4>& bows, bool mirrored)
{
    Patch patch;
    for (std::size_t row = 0; row < 4; ++row) {
        const auto [x0, z0, x1, z1, width] = bows[row];
        patch[row] = {{{x0, 0, z0}, {x0, -width, z0}, {x1, -width, z1}, {x1, 0, z1}}};
        if (mirrored)
            patch[row] = {{{x1, 0, z1}, {x1, width, z1}, {x0, width, z0}, {x0, 0, z0}}};
    }
    return patch;
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

// Whether the control points of the first row are one: there the pole of a surface of revolution lies on the edge.
// No patch ends in one.
bool collapsed(const Patch& patch)
{
    return std::ranges::all_of(patch[0], [&](const glm::dvec3& p) { return p == patch[0][0]; });
}

// u runs against the columns and v along the rows: u rightwards and v downwards seen from outside.
ShapePoint patchPoint(const Patch& patch, double u, double v)
{
    const Cubic across = cubic(1 - u), along = cubic(v);
    glm::dvec3 p(0), byColumn(0), byRow(0), byBoth(0);
    for (std::size_t row = 0; row < 4; ++row)
        for (std::size_t column = 0; column < 4; ++column) {
            const glm::dvec3& c = patch[row][column];
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
    const auto add = [&](const Patch& patch) {
        const Grid grid{segments, segments, collapsed(patch)};
        appendGrid(mesh, grid, [&patch](double u, double v) { return patchPoint(patch, u, v); });
    };
    const auto addTurned = [&](const Rings& rings, bool clockwise) {
        for (int quarters = 0; quarters < 4; ++quarters)
            add(quarterOf(rings, quarters, clockwise));
    };
    for (const Rings& rings : kPot)
        addTurned(rings, true);
    for (const auto& bows : kHandleAndSpout)
        for (const bool mirrored : {false, true})
            add(halfOf(bows, mirrored));
    for (const Rings& rings : kLid)
        addTurned(rings, true);
    addTurned(kBottom, false); // its rows run outwards
    return mesh;
}

} // namespace cotan
