// Meshlets with the ring of triangles around them: what a mesh shader needs to make the frame `smooth` itself, with no
// frame stored and from positions that change in every picture. examples/triangle has the shader.
#pragma once

#include <cstdint>
#include <vector>

#include "cotan/tangents.hpp"

namespace cotan {

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
//   mostVertices   of a meshlet, 3 to 256
//   mostTriangles  of a meshlet, at least 1
// Linear in time and memory. Arrays of other sizes, an index or a limit out of range give an empty result.
RingMeshlets ringMeshlets(const MeshView& mesh, std::uint32_t mostVertices = 64, std::uint32_t mostTriangles = 124);

} // namespace cotan
