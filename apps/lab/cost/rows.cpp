#include "cost/rows.hpp"

#include "frag_cotangent.h"
#include "frag_cotangent_2013.h"
#include "frag_cotangent_area_fused.h"
#include "frag_cotangent_facing.h"
#include "frag_cotangent_fused.h"
#include "frag_cotangent_plain.h"
#include "frag_cotangent_seen.h"
#include "frag_exact.h"
#include "frag_floor.h"
#include "frag_gradient.h"
#include "frag_gradient_fused.h"
#include "frag_gradient_plain.h"
#include "frag_mikktspace.h"
#include "frag_nonperspective.h"
#include "frag_orthonormal.h"
#include "frag_orthonormal_fused.h"
#include "frag_orthonormal_plain.h"
#include "frag_paper_full.h"
#include "frag_paper_nodet.h"
#include "frag_paper_orthogonal.h"
#include "frag_paper_transpose.h"
#include "frag_smooth.h"
#include "frag_smooth_fused.h"
#include "frag_triangle.h"
#include "frag_triangle_fused.h"
#include "frag_triangle_halfs.h"
#include "frag_triangle_read.h"
#include "frag_triangle_scaled.h"
#include "frag_unit_lengths.h"
#include "frag_vertex.h"
#include "varyings_cotangents.h"
#include "varyings_plain.h"
#include "varyings_tangent.h"
#include "varyings_triangle.h"
#include "varyings_triangle_halfs.h"
#include "vert_cotangents.h"
#include "vert_cotangents4.h"
#include "vert_cotangents8.h"
#include "vert_plain.h"
#include "vert_tangent.h"
#include "vert_tangent2.h"
#include "vert_triangle.h"
#include "vert_triangle_halfs.h"

namespace cotan::cost {

const std::vector<Row>& rows()
{
    using S = Stored;
    using G = Group;
    // Three indices, three positions, three uv.
    constexpr int kTriangleBytes = 3 * 4 + 3 * 12 + 3 * 8;
    static const std::vector<Row> list = {
        {"floor", G::floor, S::nothing, 0, 0, "the interpolated normal and the texel, no frame", frag_floor},
        {"mikktspace", G::stored, S::tangent, 0, 0, "stored tangents, bitangent per pixel", frag_mikktspace},
        {"vertex", G::stored, S::tangent, 0, 0, "stored tangents, orthonormal again per pixel; total", frag_vertex},
        {"smooth", G::stored, S::cotangents, 0, 0, "cotangents averaged at the vertices; total", frag_smooth},
        {"smooth-fused", G::stored, S::cotangents, 0, 0, "cotangents averaged at the vertices, as interpolated",
         frag_smooth_fused},
        {"triangle-halfs", G::triangle, S::triangleHalfs, 0, 0, "U and V of the triangle as six halfs",
         frag_triangle_halfs},
        {"triangle-fused", G::triangle, S::triangle, 0, 0, "U and V of the triangle as six floats",
         frag_triangle_fused},
        {"triangle-read", G::triangle, S::nothing, 0, 12, "six halfs of the triangle, read per pixel",
         frag_triangle_read},
        {"triangle-scaled", G::triangle, S::triangle, 0, 0, "with the scale of cotangent", frag_triangle_scaled},
        {"triangle", G::triangle, S::triangle, 0, 0, "no input gives NaN", frag_triangle},
        {"cotangent-fused", G::fused, S::nothing, 0, 0, "sign and guard", frag_cotangent_fused},
        {"cotangent-seen", G::fused, S::nothing, 0, 0, "n on the side that is seen", frag_cotangent_seen},
        {"cotangent-area-fused", G::fused, S::nothing, 0, 0, "area-normalised scale", frag_cotangent_area_fused},
        {"gradient-fused", G::fused, S::nothing, 0, 0, "surface gradient, metric", frag_gradient_fused},
        {"orthonormal-fused", G::fused, S::nothing, 0, 0, "orthonormal basis", frag_orthonormal_fused},
        {"cotangent-plain", G::plain, S::nothing, 0, 0, "the formula with sign and guard", frag_cotangent_plain},
        {"cotangent-facing", G::plain, S::nothing, 0, 0, "the sign left to gl_FrontFacing", frag_cotangent_facing},
        {"gradient-plain", G::plain, S::nothing, 0, 0, "the formula, unguarded", frag_gradient_plain},
        {"orthonormal-plain", G::plain, S::nothing, 0, 0, "the formula, guarded against uv without area",
         frag_orthonormal_plain},
        {"cotangent", G::total, S::nothing, 0, 0, "no input gives NaN", frag_cotangent},
        {"gradient", G::total, S::nothing, 0, 0, "no input gives NaN", frag_gradient},
        {"orthonormal", G::total, S::nothing, 0, 0, "no input gives NaN", frag_orthonormal},
        {"exact", G::total, S::nothing, 0, kTriangleBytes, "from the triangle's vertices, read per pixel", frag_exact},
        {"cotangent-2013", G::papers, S::nothing, 0, 0, "as printed in 2013", frag_cotangent_2013},
        {"nonperspective", G::papers, S::nothing, 0, 0, "shortcut of 2013", frag_nonperspective},
        {"unit", G::papers, S::nothing, 0, 0, "t and b each of unit length", frag_unit_lengths},
        {"paper-full", G::papers, S::nothing, 46, 0, "2006, full inverse", frag_paper_full},
        {"paper-nodet", G::papers, S::nothing, 31, 0, "2006, without determinant", frag_paper_nodet},
        {"paper-transpose", G::papers, S::nothing, 17, 0, "2006, as cross products", frag_paper_transpose},
        {"paper-orthogonal", G::papers, S::nothing, 14, 0, "2006, orthogonal differences", frag_paper_orthogonal},
    };
    return list;
}

const Row* rowFromName(std::string_view name)
{
    for (const Row& row : rows())
        if (row.name == name)
            return &row;
    return nullptr;
}

const std::vector<VertexStage>& vertexStages()
{
    static const std::vector<VertexStage> list = {
        {Stored::nothing, "no tangent", 0, vert_plain, varyings_plain},
        {Stored::tangent, "tangent", 16, vert_tangent, varyings_tangent},
        {Stored::cotangents, "two cotangents", 24, vert_cotangents, varyings_cotangents},
        {Stored::cotangents8, "two cotangents in 8 bytes", 8, vert_cotangents8, varyings_cotangents},
        {Stored::cotangents4, "two cotangents in 4 bytes", 4, vert_cotangents4, varyings_cotangents},
        {Stored::tangent2, "tangent in 2 bytes", 2, vert_tangent2, varyings_tangent},
        {Stored::triangle, "triangle, six floats", 0, vert_triangle, varyings_triangle},
        {Stored::triangleHalfs, "triangle, six halfs", 0, vert_triangle_halfs, varyings_triangle_halfs},
    };
    return list;
}

const VertexStage& vertexStage(Stored stored) { return vertexStages()[std::size_t(stored)]; }

std::string_view spirvCompiler() { return COTAN_SPIRV_COMPILER; }

} // namespace cotan::cost
