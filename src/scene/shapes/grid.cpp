#include "grid.hpp"

#include <cmath>
#include <numbers>

namespace cotan {

namespace {

// Adds one row of vertices and returns the index of its first.
std::uint32_t appendRow(Mesh& mesh, const Grid& grid, const Surface& surface, int row, bool pole)
{
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const double v = double(row) / grid.cellsV;
    const int count = pole ? grid.cellsU : grid.cellsU + 1;
    for (int i = 0; i < count; ++i) {
        const double u = (i + (pole ? 0.5 : 0.0)) / grid.cellsU;
        const ShapePoint point = surface(u, v);
        mesh.positions.emplace_back(point.position);
        mesh.normals.emplace_back(point.normal);
        mesh.texcoords[0].emplace_back(float(u), float(v));
    }
    return first;
}

} // namespace

void appendGrid(Mesh& mesh, const Grid& grid, const Surface& surface)
{
    std::uint32_t above = appendRow(mesh, grid, surface, 0, grid.poleTop);
    for (int row = 1; row <= grid.cellsV; ++row) {
        const bool poleAbove = row == 1 && grid.poleTop;
        const bool poleBelow = row == grid.cellsV && grid.poleBottom;
        const std::uint32_t below = appendRow(mesh, grid, surface, row, poleBelow);
        for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(grid.cellsU); ++i) {
            const std::uint32_t a = above + i, b = a + 1, d = below + i, c = d + 1;
            if (!poleBelow)
                mesh.indices.insert(mesh.indices.end(), {a, d, c});
            if (poleBelow)
                mesh.indices.insert(mesh.indices.end(), {a, d, b});
            else if (!poleAbove)
                mesh.indices.insert(mesh.indices.end(), {a, c, b});
        }
        above = below;
    }
}

void scaleTexcoords(Mesh& mesh, float u, float v)
{
    for (glm::vec2& uv : mesh.texcoords[0])
        uv = {uv.x * u, uv.y * v};
}

double turns(double x) { return 2 * std::numbers::pi * (x - std::floor(x)); }

} // namespace cotan
