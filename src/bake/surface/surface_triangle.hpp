// Triangles in arrays of vertices: corners, edges and interpolation.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "cotan/packed_only.hpp"

namespace cotan {

// Interpolates values of the corners. at: the indices of the three values; weights: their sum is 1.
template<class Vec, class Indices> auto atCorners(const std::vector<Vec>& values, const Indices& at, glm::dvec3 weights)
{
    using Wide = glm::vec<Vec::length(), double>;
    return Wide(values[at[0]]) * weights.x + Wide(values[at[1]]) * weights.y + Wide(values[at[2]]) * weights.z;
}

// The same in the type of the values. v: the indices of the corners' vertices; b1, b2: weights of the last two.
template<class Values> auto atVertices(const Values& values, const std::uint32_t* v, float b1, float b2)
{
    return values[v[0]] * (1 - b1 - b2) + values[v[1]] * b1 + values[v[2]] * b2;
}

// From a triangle's first corner to the two others, in space and in uv: the input of every frame of a triangle.
struct TriangleEdges {
    glm::dvec3 p1{0}, p2{0};
    glm::dvec2 uv1{0}, uv2{0};

    // Twice the area in uv, positive if the corners are counter-clockwise in uv with v up.
    double uvArea2() const { return uv1.x * uv2.y - uv1.y * uv2.x; }
};

// The longest edge of a triangle. v: the indices of its vertices.
template<class Positions> float longestEdge(const Positions& positions, const std::uint32_t* v)
{
    const glm::vec3 a = positions[v[0]], b = positions[v[1]], c = positions[v[2]];
    return std::sqrt(std::max({glm::dot(b - a, b - a), glm::dot(c - b, c - b), glm::dot(a - c, a - c)}));
}

} // namespace cotan
