// Meshes as GPUs read them: every triangle with a vertex of its own, meshlets with the triangles around them, and which
// triangles meet at which vertices. For frames that are made in vertex, mesh and compute shaders.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cotan/tangents.hpp"

namespace cotan {

// ---- adjacency -----------------------------------------------------------------------------

// Which triangles meet at which vertices, for meshes whose positions change: made once, when the mesh is
// loaded, it lets a compute shader derive vertex frames anew for every picture. One invocation a group
// gathers from the group's corners and writes to the group's vertices, without atomics.
// examples/deforming has the shaders.

// Vertices that share a frame, and the corners that it is averaged from: the groups of smoothCotangents.
// Plain arrays, to be copied to buffers as they are. With T triangles, V vertices and G groups (at most V)
// 12 T + 4 V + 8 G + 8 bytes, besides the indices of the mesh.
struct Adjacency {
    // The group's vertices: vertices[vertexBegin[g]] up to and without vertices[vertexBegin[g + 1]]. Every
    // vertex is in one group; several are in one where position, normal and texcoord are equal.
    std::vector<std::uint32_t> vertexBegin;
    std::vector<std::uint32_t> vertices;
    // Its corners alike, as places in the mesh's indices: c is a corner of triangle c / 3. All are on one
    // side, mirrored or not. Triangles that have no area in space or uv are in no group; a group of
    // vertices that only these or none use has no corners, and its frame is zero.
    std::vector<std::uint32_t> cornerBegin;
    std::vector<std::uint32_t> corners;
    // Groups from this one on are mirrored: the sign w of glTF's TANGENT is -1 there.
    std::uint32_t firstMirrored = 0;

    std::uint32_t groups() const
    {
        return vertexBegin.empty() ? 0 : static_cast<std::uint32_t>(vertexBegin.size() - 1);
    }
};

// From the mesh as it is loaded, in its rest pose. Linear in time and memory.
// What is decided here holds for all poses:
// - vertices that are equal at rest move together;
// - a triangle keeps its side. It changes sides only where it turns over against its normals;
// - a triangle without area at rest adds nothing later.
// A vertex that triangles of both sides index goes with the larger angle: split such vertices first
// (splitMirrored), and make the adjacency of the result.
// Arrays of other sizes, or an index out of range, give an empty result.
Adjacency makeAdjacency(const MeshView& mesh);

// The same for normals, which do not stop at the seams of texcoords: groups of equal position and normal, with
// the corners of all their triangles that have area at rest; texcoords play no part. Groups from
// firstMirrored on have triangles wound against their normals: turn the sum of the face normals there.
Adjacency makeNormalAdjacency(const MeshView& mesh);

// ---- meshlets ------------------------------------------------------------------------------

// Meshlets with the ring of triangles around them: what a mesh shader needs to make the frame `smooth` itself, with no
// frame stored and from positions that change in every picture. examples/triangle has the shader.

// A part of a mesh that one work group draws.
struct RingMeshlet {
    std::uint32_t firstVertex = 0, vertexCount = 0;     // in RingMeshlets::vertices
    std::uint32_t firstTriangle = 0, triangleCount = 0; // in RingMeshlets::triangles
};

// Plain arrays, to be copied to buffers as they are.
struct RingMeshlets {
    std::vector<RingMeshlet> meshlets;
    std::vector<std::uint32_t> vertices; // of the mesh, by meshlet
    // Three places among the meshlet's vertices a triangle, the first in the low 8 bits. In the order of the indices,
    // all meshlets together; with their winding.
    std::vector<std::uint32_t> triangles;
    // The corners that the frame of vertices[i] is averaged from: corners[ringBegin[i]] up to and without
    // corners[ringBegin[i + 1]], as places in the mesh's indices; c is a corner of triangle c / 3. They are those of
    // Adjacency: of this meshlet's triangles and of the ring around them.
    std::vector<std::uint32_t> ringBegin;
    std::vector<std::uint32_t> corners;
};

// Cuts the triangles in their order: reorder them for the vertex cache first. What Adjacency says of poses, sides and
// triangles without area holds here, too: split vertices that mirrored and unmirrored triangles share (splitMirrored).
//   maxVertices   of a meshlet, 3 to 256
//   maxTriangles  of a meshlet, at least 1
// Linear in time and memory. Arrays of other sizes, an index or a limit out of range give an empty result.
RingMeshlets ringMeshlets(const MeshView& mesh, std::uint32_t maxVertices = 64, std::uint32_t maxTriangles = 124);

// ---- provoking vertices --------------------------------------------------------------------

// An index buffer in which every triangle owns a vertex, so that the vertex shader can hand something on
// that belongs to the triangle: U and V of the frame `triangle`.
//
// A graphics API takes values that are not interpolated from one vertex of a triangle, its provoking vertex. In an
// ordinary mesh several triangles share it. Here vertices are numbered so that triangle f has vertex number f as its
// provoking vertex and shares it with no triangle that would need it for the same. A vertex shader that is given the
// number k < triangles reads the three corners 3k, 3k + 1 and 3k + 2 of `corners`, the mesh's own vertices, from
// storage buffers. Nothing else is stored, and it follows every deformation.
// The idea is that of meshopt_generateProvokingIndexBuffer (meshoptimizer, A. Kapoulkine), which
// does not number by triangle.

// Which of the three provokes: the first in Vulkan, Direct3D, Metal and WebGPU; the last in OpenGL and
// WebGL, where glProvokingVertex does not say otherwise.
enum class ProvokingVertex { first, last };

struct ProvokingMesh {
    // Per new vertex the mesh's vertex that it is a copy of. The first `triangles` of them provoke the
    // triangle of their number; behind them stand those that provoke none.
    std::vector<std::uint32_t> sources;
    // Three a triangle, of new vertices. The triangles stay in their order, and so does the winding.
    std::vector<std::uint32_t> indices;
    // Three a triangle, of the mesh's vertices, turned so that the provoking one comes first.
    std::vector<std::uint32_t> corners;
};

// Numbers anew. Each vertex of the mesh provokes at least one triangle where that can be had, so that
// few are left over: a closed mesh, which has twice as many triangles as vertices, comes out with about
// as many vertices as triangles.
//   indices       three a triangle; triangles that repeat a vertex are kept as they are
//   vertexCount   all indices are below it. A vertex that no triangle uses is left out
// An index out of range, a number of indices that is not a multiple of three, or 2^31 indices and more
// give an empty result. Linear in time and memory.
ProvokingMesh provokingMesh(std::span<const std::uint32_t> indices, std::size_t vertexCount, ProvokingVertex provoking);

// Triangles from a strip or a fan, wound alike, for the function above. restart: the index that ends a
// strip or fan and begins the next (0xff, 0xffff or 0xffffffff by the width of the indices). Left over
// corners make no triangle. Triangles that repeat a vertex, as strips use to turn a corner, are dropped.
std::vector<std::uint32_t> trianglesOfStrip(std::span<const std::uint32_t> indices,
                                            std::uint32_t restart = 0xffffffffu);
std::vector<std::uint32_t> trianglesOfFan(std::span<const std::uint32_t> indices, std::uint32_t restart = 0xffffffffu);

} // namespace cotan
