#include "cost/stages.hpp"

#include "beyond_both.h"
#include "beyond_curvature.h"
#include "beyond_floor.h"
#include "beyond_length.h"
#include "beyond_offset.h"
#include "beyond_relief.h"
#include "mesh_plain.h"
#include "mesh_tangent.h"
#include "mesh_triangle.h"
#include "mesh_triangle_halfs.h"
#include "mesh_varyings_plain.h"
#include "mesh_varyings_tangent.h"
#include "mesh_varyings_triangle.h"
#include "mesh_varyings_triangle_halfs.h"
#include "pass_normals.h"
#include "pass_smooth.h"
#include "pass_tangents.h"
#include "pass_triangles.h"
#include "resolve_cotangent_fused.h"
#include "resolve_floor.h"
#include "resolve_mikktspace.h"
#include "resolve_orthonormal_edges.h"
#include "resolve_smooth_fused.h"
#include "resolve_triangle_fused.h"
#include "resolve_triangle_read.h"

namespace cotan::cost {

const std::vector<Stage>& otherStages()
{
    using K = StageKind;
    constexpr int kPosition = 12, kNormal = 12, kUv = 8, kIndices = 3 * 4, kHalfs = 12;
    constexpr int kVertex = kPosition + kNormal + kUv;
    // Triangles: two triangles share a vertex.
    constexpr int kDerived = kIndices + kVertex / 2 + kHalfs;
    // Vertices: two triangles, six corners, and the offsets of the corners and of the vertices of a group.
    constexpr int kAdjacency = 2 * kIndices + 6 * 4 + 4 + 4 + 4;
    constexpr int kSmoothBytes = kAdjacency + kVertex + 8, kNormalBytes = kAdjacency + kPosition + kNormal;
    // Pixels: the triangle's index and three vertices.
    constexpr int kPixel = 4 + kIndices + 3 * kVertex;
    static const std::vector<Stage> list = {
        {K::mesh, "no tangent", 0, 0, 0, mesh_plain, mesh_varyings_plain},
        {K::mesh, "tangent", 16, 0, 0, mesh_tangent, mesh_varyings_tangent},
        {K::mesh, "triangle, six floats", 0, 24, 0, mesh_triangle, mesh_varyings_triangle},
        {K::mesh, "triangle, six halfs", 0, 12, 0, mesh_triangle_halfs, mesh_varyings_triangle_halfs},
        {K::pass, "triangle, six halfs", 0, kDerived, 0, pass_triangles, {}},
        {K::pass, "two cotangents in 8 bytes", kSmoothBytes, 0, 0, pass_smooth, {}},
        {K::pass, "tangents as MikkTSpace's", kSmoothBytes, 0, 0, pass_tangents, {}},
        {K::pass, "normals", kNormalBytes, 0, 0, pass_normals, {}},
        {K::resolve, "floor", 0, 0, kPixel, resolve_floor, {}},
        {K::resolve, "mikktspace", 0, 0, kPixel + 3 * 16, resolve_mikktspace, {}},
        {K::resolve, "smooth-fused", 0, 0, kPixel + 3 * 24, resolve_smooth_fused, {}},
        {K::resolve, "triangle-read", 0, 0, kPixel + kHalfs, resolve_triangle_read, {}},
        {K::resolve, "triangle-fused", 0, 0, kPixel, resolve_triangle_fused, {}},
        {K::resolve, "cotangent-fused", 0, 0, kPixel, resolve_cotangent_fused, {}},
        {K::resolve, "orthonormal-edges", 0, 0, kPixel, resolve_orthonormal_edges, {}},
        {K::beyond, "floor", 0, 0, 1, beyond_floor, {}},
        {K::beyond, "curvature", 0, 0, 1, beyond_curvature, {}},
        {K::beyond, "stored length", 0, 0, 1, beyond_length, {}},
        {K::beyond, "curvature and stored length", 0, 0, 1, beyond_both, {}},
        {K::beyond, "parallax offset", 0, 0, 2, beyond_offset, {}},
        {K::beyond, "relief", 0, 0, 16 + 6 + 1, beyond_relief, {}},
    };
    return list;
}

} // namespace cotan::cost
