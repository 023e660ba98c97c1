// Small meshes for tests of tangents and cotangents.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>

#include "cotan/tangents.hpp"

namespace cotan::test {

struct Arrays {
    std::vector<glm::vec3> positions, normals;
    std::vector<glm::vec2> texcoords;
    std::vector<std::uint32_t> indices;

    MeshView view() const { return {positions, normals, texcoords, indices}; }

    std::uint32_t add(glm::vec3 p, glm::vec3 n, glm::vec2 t)
    {
        positions.push_back(p);
        normals.push_back(n);
        texcoords.push_back(t);
        return static_cast<std::uint32_t>(positions.size() - 1);
    }
};

struct Vertex {
    glm::vec3 position, normal;
    glm::vec2 texcoord;
};

// A grid of n x n cells; x and y of `at` run from 0 to 1, to the right and down as seen from outside.
inline Arrays gridOf(std::uint32_t n, const std::function<Vertex(float x, float y)>& at)
{
    Arrays a;
    for (std::uint32_t j = 0; j <= n; ++j)
        for (std::uint32_t i = 0; i <= n; ++i) {
            const Vertex v = at(float(i) / float(n), float(j) / float(n));
            a.add(v.position, v.normal, v.texcoord);
        }
    for (std::uint32_t j = 0; j < n; ++j)
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t p = j * (n + 1) + i, q = p + 1, s = p + n + 1, r = s + 1;
            a.indices.insert(a.indices.end(), {p, s, r, p, r, q});
        }
    return a;
}

// A square in xy that faces +z, with u = uRow . (x, y) and v = vRow . (x, y), y downwards.
inline Arrays flatGrid(std::uint32_t n, glm::vec2 uRow, glm::vec2 vRow)
{
    return gridOf(n, [=](float x, float y) {
        const glm::vec2 p(x, y);
        return Vertex{{x, -y, 0}, {0, 0, 1}, {glm::dot(uRow, p), glm::dot(vRow, p)}};
    });
}

// A third of the unit sphere between 60 degrees north and south; u increases to the east, v to the south.
inline Arrays sphereGrid(std::uint32_t n)
{
    return gridOf(n, [](float x, float y) {
        const double longitude = 2 * std::numbers::pi / 3 * double(x);
        const double latitude = 2 * std::numbers::pi / 3 * (0.5 - double(y));
        const glm::vec3 p(glm::dvec3(std::cos(latitude) * std::sin(longitude), std::sin(latitude),
                                     std::cos(latitude) * std::cos(longitude)));
        return Vertex{p, p, {x, y}};
    });
}

// The same triangles without shared vertices.
inline Arrays unindexed(const Arrays& a)
{
    Arrays b;
    for (const std::uint32_t i : a.indices)
        b.indices.push_back(b.add(a.positions[i], a.normals[i], a.texcoords[i]));
    return b;
}

inline double degreesBetween(glm::dvec3 a, glm::dvec3 b)
{
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180 / std::numbers::pi;
}

} // namespace cotan::test
