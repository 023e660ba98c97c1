#include "cost/rows.hpp"

#include <algorithm>

#include "frag_cotangent_area_fused.h"
#include "frag_cotangent_facing.h"
#include "frag_cotangent_plain.h"
#include "frag_cotangent_seen.h"
#include "frag_floor.h"
#include "frag_gradient_plain.h"
#include "frag_orthonormal_plain.h"
#include "frag_triangle_halfs.h"
#include "frag_triangle_read.h"
#include "frag_triangle_scaled.h"
#include "shaders_of_frames.h"
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

namespace {

// What the vertex stage outputs for a frame, beside position, normal and uv.
Stored storedFor(Frame frame)
{
    return readsTangents(frame)       ? Stored::tangent
        : readsCotangents(frame)      ? Stored::cotangents
        : readsTriangleVectors(frame) ? Stored::triangle
                                      : Stored::nothing;
}

// Bytes that the fragment stage reads of the whole triangle for a frame: three indices, three positions, three uv.
int bytesReadFor(Frame frame)
{
    return info(frame).source == FrameSource::triangle && !readsTriangleVectors(frame) ? 3 * 4 + 3 * 12 + 3 * 8 : 0;
}

// The instruction counts that the chapter of 2006 gives for its four frames.
int instructionsOf2006(Frame frame)
{
    switch (frame) {
    case Frame::paperFull: return 46;
    case Frame::paperNodet: return 31;
    case Frame::paperTranspose: return 17;
    case Frame::paperOrthogonal: return 14;
    default: return 0;
    }
}

// Order: the baselines, then rows with additional vertex outputs, then the others; frames of the papers come last.
std::vector<Row> makeRows()
{
    using S = Stored;
#define COTAN_FUSED_false(enumerator, word, name, summary)
#define COTAN_FUSED_true(enumerator, word, name, summary)                                                              \
    {name "-fused", storedFor(Frame::enumerator), 0, summary ", frame and texel in one step", fused_##word},
#define COTAN_FRAME_ROW(number, enumerator, word, source, total, dependsOnView, normal, fused, after, name, summary)   \
    {name,                                                                                                             \
     storedFor(Frame::enumerator),                                                                                     \
     bytesReadFor(Frame::enumerator),                                                                                  \
     summary,                                                                                                          \
     frame_##word,                                                                                                     \
     Frame::enumerator,                                                                                                \
     instructionsOf2006(Frame::enumerator)},                                                                           \
        COTAN_FUSED_##fused(enumerator, word, name, summary)
    std::vector<Row> list = {
        {"floor", S::nothing, 0, "the interpolated normal and the texel, no frame", frag_floor},
#include "cotan/frames.inc"
        {"triangle-halfs", S::triangleHalfs, 0, "U and V of the triangle as six half floats", frag_triangle_halfs},
        {"triangle-read", S::nothing, 12, "six half floats of the triangle, read per pixel", frag_triangle_read},
        {"triangle-scaled", S::triangle, 0, "with the scale of cotangent", frag_triangle_scaled},
        {"cotangent-seen", S::nothing, 0, "n faces the viewer", frag_cotangent_seen},
        {"cotangent-area-fused", S::nothing, 0, "area-normalised scale", frag_cotangent_area_fused},
        {"cotangent-plain", S::nothing, 0, "the formula with sign and guard", frag_cotangent_plain},
        {"cotangent-facing", S::nothing, 0, "the sign left to gl_FrontFacing", frag_cotangent_facing},
        {"gradient-plain", S::nothing, 0, "the formula, unguarded", frag_gradient_plain},
        {"orthonormal-plain", S::nothing, 0, "the formula, guarded against uv without area", frag_orthonormal_plain},
    };
#undef COTAN_FUSED_false
#undef COTAN_FUSED_true
    std::erase_if(list, [](const Row& row) { return row.frame == Frame::areaWeighted; }); // the code of mikktspace
    std::ranges::stable_sort(list, {}, [](const Row& row) {
        return row.name == "floor"           ? 0
            : row.frame == Frame::mikktspace ? 1
            : row.stored != S::nothing       ? 2
            : !isHistorical(row)             ? 3
                                             : 4;
    });
    return list;
}

} // namespace

const std::vector<Row>& rows()
{
    static const std::vector<Row> list = makeRows();
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
