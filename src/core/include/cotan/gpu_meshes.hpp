// Meshes laid out for GPUs: a provoking vertex of its own for every triangle, meshlets with the surrounding triangles,
// and the triangles at each vertex. For frames that are made in vertex, mesh and compute shaders.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cotan/tangents.hpp"

namespace cotan {

// ---- adjacency -----------------------------------------------------------------------------

// The triangles at each vertex, for meshes whose positions change. Made once, when the mesh is loaded, it lets a
// compute shader derive vertex frames again for every rendered image. One invocation per group reads the group's
// corners and writes to the group's vertices, without atomics. examples/deforming has the shaders.

// Groups of vertices that share a frame, and the corners that it is averaged from, as in smoothCotangents. Plain
// arrays, ready to be copied to buffers. With T triangles, V vertices and G groups (at most V): 12 T + 4 V + 8 G + 8
// bytes, besides the indices of the mesh.
struct Adjacency {
    // The vertices of group g are vertices[vertexBegin[g]] up to, but excluding, vertices[vertexBegin[g + 1]]. Every
    // vertex is in exactly one group; vertices with equal position, normal and texcoord can share a group.
    std::vector<std::uint32_t> vertexBegin;
    std::vector<std::uint32_t> vertices;
    // The corners of each group, likewise, as indices into the mesh's indices: c is a corner of triangle c / 3. All are
    // on one side, mirrored or not. Triangles without area in space or uv are in no group. A group whose vertices are
    // used by no other triangles has no corners, and its frame is zero.
    std::vector<std::uint32_t> cornerBegin;
    std::vector<std::uint32_t> corners;
    // Groups from this one on are mirrored: w of glTF's TANGENT is -1 there.
    std::uint32_t firstMirrored = 0;

    std::uint32_t groups() const
    {
        return vertexBegin.empty() ? 0 : static_cast<std::uint32_t>(vertexBegin.size() - 1);
    }
};

// Makes the adjacency of a mesh in its rest pose. Linear in time and memory. It is valid for all poses if
// - vertices that are equal at rest move together;
// - a triangle keeps its side, which it changes only by turning over against its normals.
// A triangle without area at rest adds nothing later.
// A vertex that triangles of both sides use goes to the side with the larger angle: split such vertices first
// (splitMirrored), and make the adjacency of the result.
// Array sizes that do not match, or an index out of range, give an empty result.
Adjacency makeAdjacency(const MeshView& mesh);

// Makes the adjacency for normals, which are continuous across uv seams: groups have equal position and normal, with
// the corners of all their triangles that have area at rest; texcoords are ignored. In groups from firstMirrored on,
// triangles are wound against their normals: negate the sum of the face normals there.
Adjacency makeNormalAdjacency(const MeshView& mesh);

// ---- meshlets ------------------------------------------------------------------------------

// Meshlets with the ring of triangles around them, from which a mesh shader can make the frame `smooth` by itself,
// without stored frames and for positions that change in every rendered image. examples/triangle has the shader.

// A part of a mesh that one work group draws.
struct RingMeshlet {
    std::uint32_t firstVertex = 0, vertexCount = 0;     // in RingMeshlets::vertices
    std::uint32_t firstTriangle = 0, triangleCount = 0; // in RingMeshlets::triangles
};

// Plain arrays, ready to be copied to buffers.
struct RingMeshlets {
    std::vector<RingMeshlet> meshlets;
    std::vector<std::uint32_t> vertices; // vertices of the mesh, by meshlet
    // Three 8-bit indices per triangle into the vertices of its meshlet, the first in the low bits. The triangles of
    // all meshlets keep the order of the mesh's indices, and the winding.
    std::vector<std::uint32_t> triangles;
    // The frame of vertices[i] is averaged from the corners corners[ringBegin[i]] up to, but excluding,
    // corners[ringBegin[i + 1]]: indices into the mesh's indices, as in Adjacency; c is a corner of triangle c / 3.
    // They belong to triangles of this meshlet and of the ring around it.
    std::vector<std::uint32_t> ringBegin;
    std::vector<std::uint32_t> corners;
};

// Cuts the triangles into meshlets in their order: first reorder them for the vertex cache. The remarks on poses, sides
// and triangles without area at makeAdjacency apply here, too: first split vertices that mirrored and unmirrored
// triangles share (splitMirrored).
//   maxVertices   per meshlet, 3 to 256
//   maxTriangles  per meshlet, at least 1
// Linear in time and memory. Array sizes that do not match, and indices or limits out of range, give an empty result.
RingMeshlets ringMeshlets(const MeshView& mesh, std::uint32_t maxVertices = 64, std::uint32_t maxTriangles = 124);

// ---- provoking vertices --------------------------------------------------------------------

// An index buffer in which every triangle owns a vertex, so that the vertex shader can pass on values of the triangle:
// U and V of the frame `triangle`.
//
// Graphics APIs take flat, not interpolated values from one vertex of a triangle, its provoking vertex. In an ordinary
// mesh several triangles share it. Here the provoking vertex of triangle f is vertex f, and no other triangle has the
// same one. A vertex shader with vertex number k < triangles reads the three corners 3k, 3k + 1 and 3k + 2 of
// `corners`, the mesh's own vertices, from storage buffers. Nothing else is stored, and deformation is followed.
// The idea is that of meshopt_generateProvokingIndexBuffer (meshoptimizer, A. Kapoulkine), which does not number
// vertices by triangle.

// Which of the three vertices provokes: the first in Vulkan, Direct3D, Metal and WebGPU; the last in OpenGL and WebGL,
// unless glProvokingVertex changes it.
enum class ProvokingVertex { first, last };

struct ProvokingMesh {
    // Per new vertex: the vertex of the mesh that it is a copy of. The first `triangles` new vertices provoke the
    // triangle of the same number; the vertices after these provoke none.
    std::vector<std::uint32_t> sources;
    // Three new vertices per triangle. The triangles keep their order and winding.
    std::vector<std::uint32_t> indices;
    // Three vertices of the mesh per triangle, rotated so that the provoking one comes first.
    std::vector<std::uint32_t> corners;
};

// Renumbers the vertices. If possible, each vertex of the mesh provokes at least one triangle, so that few extra copies
// are needed: a closed mesh, which has twice as many triangles as vertices, gets about as many vertices as triangles.
//   indices       three per triangle; triangles that repeat a vertex are kept as they are
//   vertexCount   all indices are below it. Vertices that no triangle uses are left out
// An index out of range, a number of indices that is not a multiple of three, or 2^31 or more indices give an empty
// result. Linear in time and memory.
ProvokingMesh provokingMesh(std::span<const std::uint32_t> indices, std::size_t vertexCount, ProvokingVertex provoking);

// Return the triangles of a strip or a fan, with its winding, for provokingMesh. restart: the index that ends a strip
// or fan and begins the next (0xff, 0xffff or 0xffffffff, depending on the index type). Incomplete triangles, and those
// that repeat a vertex (strips use them to turn corners), are dropped.
std::vector<std::uint32_t> trianglesOfStrip(std::span<const std::uint32_t> indices,
                                            std::uint32_t restart = 0xffffffffu);
std::vector<std::uint32_t> trianglesOfFan(std::span<const std::uint32_t> indices, std::uint32_t restart = 0xffffffffu);

} // namespace cotan
