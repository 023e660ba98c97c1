#include <cmath>
#include <numbers>

#include "meshes.hpp"

Mesh tube(std::uint32_t around, std::uint32_t along)
{
    Mesh mesh;
    for (std::uint32_t j = 0; j <= along; ++j)
        for (std::uint32_t i = 0; i <= around; ++i) {
            const double turn = 2 * std::numbers::pi * (i % around) / around, v = kTubeHeight * j / along;
            const glm::dvec3 out(std::sin(turn), 0, std::cos(turn));
            mesh.positions.emplace_back(out * kTubeRadius + glm::dvec3(0, kTubeHeight / 2 - v, 0));
            mesh.normals.emplace_back(out);
            mesh.texcoords.emplace_back(2 * std::numbers::pi * kTubeRadius * i / around, v);
        }
    for (std::uint32_t j = 0; j < along; ++j)
        for (std::uint32_t i = 0; i < around; ++i) {
            const std::uint32_t p = j * (around + 1) + i, q = p + 1, s = p + around + 1, r = s + 1;
            mesh.indices.insert(mesh.indices.end(), {p, s, r, p, r, q});
        }
    return mesh;
}
