// MikkTSpace, and its first step, which is implemented in mikktspace_triangles.cpp.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "large_array.hpp"
#include "tangents_mesh.hpp"

namespace cotan::mikktspace {

using tangents::kNone;

// Compute the mikktspaceTangents and areaWeightedTangents of a usable mesh in `out`. Return false if the listener stops
// them.
bool makeTangents(const MeshView& mesh, int threads, const Listener& listener, std::vector<glm::vec4>& out);
bool makeAreaWeighted(const MeshView& mesh, int threads, const Listener& listener, std::vector<glm::vec4>& out);

// ---- first step: the contribution of every triangle to the tangents at its corners -----------

// The state of a triangle, one byte.
enum Flag : std::uint8_t {
    kPreserving = 1, // positive signed area in uv (v upwards or downwards, as given)
    kJoinsAny = 2,   // no valid direction: joins the first group that reaches it
    kDegenerate = 4, // two equal positions: takes no part in averages
    kTaken = 8,      // its first corner is in a group; 16: its second, 32: its third
};

// The range of the vertices that a block of triangles uses.
struct VertexRange {
    std::uint32_t minimum = 0, maximum = 0;
};
constexpr std::size_t kBlock = 1024; // triangles: their corners fit into the L1 cache

// What a triangle weighs at a corner: its angle there, or this times the lengths of both sides, projected along the
// normal.
enum class Weight { angle, area };

struct Triangles {
    const MeshView& mesh;
    Weight weight = Weight::angle;
    std::size_t count = 0;
    const std::uint32_t* vertices = nullptr; // three per triangle, welded; the mesh's own if no vertices are equal
    LargeArray<std::uint32_t> welded;
    LargeArray<std::uint8_t> flags;  // Flag bits, per triangle
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

// Derives all triangles. firstVertex: per vertex the first vertex that equals it. contributions: set for every corner
// to the unit dP/du in the plane of its normal, times the weight of the triangle there.
Triangles makeTriangles(const MeshView& mesh, Weight weight, LargeArray<std::uint32_t> firstVertex, std::size_t threads,
                        std::span<glm::vec4> contributions);

// Returns the unit dP/du of a triangle, or zero.
glm::vec3 alongU(const Triangles& t, std::size_t triangle);

} // namespace cotan::mikktspace
