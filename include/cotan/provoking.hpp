// An index buffer in which every triangle owns a vertex, so that the vertex shader can hand something on
// that belongs to the triangle: U and V of the frame `triangle`.
//
// A graphics API takes values that are not interpolated from one vertex of a triangle, its provoking
// vertex. In an ordinary mesh several triangles share it. Here vertices are numbered so that
// triangle f has vertex number f as its provoking vertex and shares it with no triangle that would
// need it for the same. A vertex shader that is given the number k < triangles reads the three corners
// 3k, 3k + 1 and 3k + 2 of `corners`, the mesh's own vertices, from storage buffers. Nothing else is
// stored, and it follows every deformation.
// The idea is that of meshopt_generateProvokingIndexBuffer (meshoptimizer, A. Kapoulkine), which
// does not number by triangle.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cotan {

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
