// The mesh for timing tangent generators.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "cotan/tangents.hpp"

namespace cotan::bench {

struct Grid {
    std::vector<glm::vec3> positions, normals;
    std::vector<glm::vec2> texcoords;
    std::vector<std::uint32_t> indices;
    MeshView view() const { return {positions, normals, texcoords, indices}; }
};

// A square of side * side quads with waves along u.
inline Grid makeGrid(int side)
{
    Grid g;
    for (int j = 0; j <= side; ++j)
        for (int i = 0; i <= side; ++i) {
            const float u = float(i) / float(side), v = float(j) / float(side);
            g.positions.emplace_back(u, v, 0.1f * std::sin(20 * u));
            const float slope = 2 * std::cos(20 * u);
            const float length = std::sqrt(1 + slope * slope);
            g.normals.emplace_back(-slope / length, 0.0f, 1 / length);
            g.texcoords.emplace_back(u, 1 - v);
        }
    const auto row = std::uint32_t(side + 1);
    for (std::uint32_t j = 0; j < std::uint32_t(side); ++j)
        for (std::uint32_t i = 0; i < std::uint32_t(side); ++i) {
            const std::uint32_t a = j * row + i;
            for (std::uint32_t k : {a, a + 1, a + row + 1, a, a + row + 1, a + row})
                g.indices.push_back(k);
        }
    return g;
}

// Returns the same grid with separate vertices for every corner.
inline Grid unindexed(const Grid& grid)
{
    Grid g;
    for (const std::uint32_t i : grid.indices) {
        g.indices.push_back(std::uint32_t(g.positions.size()));
        g.positions.push_back(grid.positions[i]);
        g.normals.push_back(grid.normals[i]);
        g.texcoords.push_back(grid.texcoords[i]);
    }
    return g;
}

} // namespace cotan::bench
