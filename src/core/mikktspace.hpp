// MikkTSpace, and the first of its steps, which has a file of its own: mikktspace_triangles.cpp.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "large_array.hpp"
#include "tangents_mesh.hpp"

namespace cotan::mikktspace {

using tangents::kNone;

// mikktspaceTangents of a usable mesh, into `out`. Returns false where the listener has said to stop.
bool makeTangents(const MeshView& mesh, int threads, const Listener& listener, std::vector<glm::vec4>& out);

// ---- first step: what every triangle gives by itself to the tangents at its corners ----------

// One byte of state a triangle.
enum Flag : std::uint8_t {
    kPreserving = 1, // positive signed area in uv (v upwards or downwards, as given)
    kJoinsAny = 2,   // no usable direction: joins the first group that reaches it
    kDegenerate = 4, // two equal positions: takes part in nothing
    kTaken = 8,      // its first corner is in a group; 16: its second, 32: its third
};

// The vertices of a block of triangles.
struct VertexRange {
    std::uint32_t least = 0, most = 0;
};
constexpr std::size_t kBlock = 1024; // triangles: their corners stay in the first cache

struct Triangles {
    const MeshView& mesh;
    std::size_t count = 0;
    const std::uint32_t* vertices = nullptr; // three a triangle, welded: the mesh's where none are equal
    LargeArray<std::uint32_t> welded;
    LargeArray<std::uint8_t> flags;  // of Flag, one a triangle
    LargeArray<glm::vec3> alongV;    // per triangle: unit dP/dv, or zero
    std::vector<VertexRange> ranges; // per block

    std::size_t corners() const { return 3 * count; }
    bool has(std::size_t triangle, int flag) const { return (flags[triangle] & flag) != 0; }
    glm::vec3 position(std::size_t corner) const { return mesh.positions[vertices[corner]]; }
    glm::vec3 normal(std::size_t corner) const { return mesh.normals[vertices[corner]]; }
    glm::vec2 texcoord(std::size_t corner) const { return mesh.texcoords[vertices[corner]]; }
};

constexpr std::size_t nextCorner(std::size_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }
constexpr std::size_t previousCorner(std::size_t corner) { return corner % 3 == 0 ? corner + 2 : corner - 1; }

// firstVertex: of every vertex the first one that equals it. contributions gets for every corner dP/du in the
// plane of its normal, unit, times the angle with which the triangle counts there.
Triangles makeTriangles(const MeshView& mesh, LargeArray<std::uint32_t> firstVertex, std::size_t threads,
                        std::span<glm::vec4> contributions);

// Unit dP/du of a triangle, or zero.
glm::vec3 alongU(const Triangles& t, std::size_t triangle);

} // namespace cotan::mikktspace
