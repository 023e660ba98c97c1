// The frame `triangle` from arrays, and compact encodings of it, of `smooth` and of MikkTSpace tangents.
// shaders/cotan/triangle.h and pack.h define the numbers, and unpack them.
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

// Returns U and V of every triangle, in the order of the indices, in the space of the positions. texcoords as in glTF;
// t and b point along increasing u and v.
// Degenerate input: a triangle without area in space, constant uv, and non-finite numbers give u = v = 0, which shades
// with the plain normal.
// threads: 0 for all cores; the result does not depend on it.
std::vector<TriangleVectors> triangleVectors(const MeshView& mesh, int threads = 0);

// Packs each triangle into six halfs, 12 bytes: u.x u.y, u.z v.x, v.y v.z, the first of each pair in the low bits.
// Normals change by at most 0.03 degrees.
std::vector<std::array<std::uint32_t, 3>> packTriangles(std::span<const TriangleVectors> triangles);

// Scales the cotangents at each vertex so that the longer one has length 1, as cotan_perturb_smooth requires. Zero
// stays zero.
Cotangents unitCotangents(const Cotangents& cotangents);

// Packs `smooth` into 8 bytes per vertex: four SNORM16, for cotan_unpack_smooth8. Maximum error 0.003 degrees. normals:
// unit, one per cotangent, and exactly those that unpacking will use. Array sizes that do not match give an empty
// result, also in the next two functions.
std::vector<std::array<std::int16_t, 4>> packSmooth8(std::span<const packed::vec3> normals,
                                                     const Cotangents& cotangents);

// Packs `smooth` into 4 bytes per vertex, for cotan_unpack_smooth4. Maximum error 0.2 degrees, 0.02 in the mean.
std::vector<std::uint32_t> packSmooth4(std::span<const packed::vec3> normals, const Cotangents& cotangents);

// Packs tangents with their sign into 2 bytes per vertex, for cotan_unpack_tangent2. Of w only the sign is kept.
// Maximum error 0.0075 degrees.
std::vector<std::uint16_t> packTangents2(std::span<const packed::vec3> normals, std::span<const packed::vec4> tangents);

} // namespace cotan
