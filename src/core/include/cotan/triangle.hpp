// The frame `triangle` from arrays, and small forms of it, of `smooth` and of MikkTSpace tangents.
// What the numbers mean stands in shaders/cotan/triangle.h and pack.h, which unpack them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cotan/tangents.hpp"

namespace cotan {

// U and V of one triangle: t = cross(n, u), b = cross(n, v).
struct TriangleVectors {
    packed::vec3 u;
    packed::vec3 v;
};

// U and V of every triangle, in the order of the indices, in the space of the positions. texcoords as
// glTF has them; t and b point along increasing u and v.
// Degenerate input: a triangle without area in space, constant uv, numbers that are not finite give
// u = v = 0, which shades with the plain normal.
// threads: 0 for all cores; the result does not depend on it.
std::vector<TriangleVectors> triangleVectors(const MeshView& mesh, int threads = 0);

// Six halfs a triangle, 12 bytes: u.x u.y, u.z v.x, v.y v.z, the first of each pair in the low bits.
// Normals turn by 0.03 degrees at most.
std::vector<std::array<std::uint32_t, 3>> packTriangles(std::span<const TriangleVectors> triangles);

// The cotangents scaled at each vertex so that the longer one has length 1, as cotan_perturb_smooth wants
// them. Zero stays zero.
Cotangents unitCotangents(const Cotangents& cotangents);

// `smooth` in 8 bytes a vertex: four SNORM16, for cotan_unpack_smooth8. 0.003 degrees at most.
// normals: unit, as many as cotangents, and exactly those that unpacking will see. Arrays of other sizes
// give an empty result; so for the next two.
std::vector<std::array<std::int16_t, 4>> packSmooth8(std::span<const packed::vec3> normals,
                                                     const Cotangents& cotangents);

// `smooth` in 4 bytes a vertex, for cotan_unpack_smooth4. 0.2 degrees at most, 0.02 in the mean.
std::vector<std::uint32_t> packSmooth4(std::span<const packed::vec3> normals, const Cotangents& cotangents);

// Tangents with their sign in 2 bytes a vertex, for cotan_unpack_tangent2. w keeps its sign, whatever it
// means. 0.0075 degrees at most.
std::vector<std::uint16_t> packTangents2(std::span<const packed::vec3> normals, std::span<const packed::vec4> tangents);

} // namespace cotan
