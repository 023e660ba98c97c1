// Which triangles meet at which vertices, for meshes whose positions change: made once, when the mesh is
// loaded, it lets a compute shader derive vertex frames anew for every picture. One invocation a group
// gathers from the group's corners and writes to the group's vertices, without atomics.
// examples/deforming has the shaders.
#pragma once

#include <cstdint>
#include <vector>

#include "cotan/tangents.hpp"

namespace cotan {

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

} // namespace cotan
