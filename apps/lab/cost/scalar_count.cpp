#include "cost/scalar_count.hpp"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "cotan/portable.hpp"
#include "counted_real.hpp"

namespace cotan::cost {

// The text that the shaders compile, over numbers that count.
namespace counted {
#define COTAN_LANG_CPP
#define COTAN_CPP_REAL CountedReal
#include "cotan/portable_text.inc"
#define COTAN_FUNCTION inline
#include "cost/rows.h"
#undef COTAN_FUNCTION
#undef COTAN_CPP_REAL
#undef COTAN_LANG_CPP
} // namespace counted

namespace {

using counted::cotan_vec2;
using counted::cotan_vec3;
using counted::cotan_vec4;

struct RowFunction {
    std::string_view name;
    cotan_vec3 (*run)(counted::cost_inputs);
};

constexpr RowFunction kRows[] = {
    {"floor", counted::cost_floor},
    {"mikktspace", counted::cost_mikktspace},
    {"vertex", counted::cost_vertex},
    {"smooth", counted::cost_smooth},
    {"smooth-fused", counted::cost_smooth_fused},
    {"triangle-halfs", counted::cost_triangle_fused},
    {"triangle-fused", counted::cost_triangle_fused},
    {"triangle-read", counted::cost_triangle_fused},
    {"triangle-scaled", counted::cost_triangle_scaled},
    {"triangle", counted::cost_triangle},
    {"cotangent-fused", counted::cost_cotangent_fused},
    {"cotangent-seen", counted::cost_cotangent_seen},
    {"cotangent-area-fused", counted::cost_cotangent_area_fused},
    {"gradient-fused", counted::cost_gradient_fused},
    {"orthonormal-fused", counted::cost_orthonormal_fused},
    {"cotangent-plain", counted::cost_cotangent_plain},
    {"cotangent-facing", counted::cost_cotangent_facing},
    {"gradient-plain", counted::cost_gradient_plain},
    {"orthonormal-plain", counted::cost_orthonormal_plain},
    {"cotangent", counted::cost_cotangent},
    {"gradient", counted::cost_gradient},
    {"orthonormal", counted::cost_orthonormal},
    {"exact", counted::cost_exact},
    {"cotangent-2013", counted::cost_cotangent_2013},
    {"nonperspective", counted::cost_nonperspective},
    {"unit", counted::cost_unit_lengths},
    {"paper-full", counted::cost_paper_full},
    {"paper-nodet", counted::cost_paper_nodet},
    {"paper-transpose", counted::cost_paper_transpose},
    {"paper-orthogonal", counted::cost_paper_orthogonal},
};

struct FrameFunction {
    std::string_view name;
    counted::cotan_frame (*run)(cotan_vec3, cotan_vec3, cotan_vec3, cotan_vec2, cotan_vec2);
};

// Of the frames that are built from differences.
constexpr FrameFunction kFrames[] = {
#define COTAN_ROW_differences(name, word) {name, counted::cotan_frame_##word},
#define COTAN_ROW_triangle(name, word) {name, counted::cotan_frame_##word},
#define COTAN_ROW_cotangents(name, word)
#define COTAN_ROW_tangents(name, word)
#define COTAN_FRAME_ROW(number, enumerator, word, source, total, dependsOnView, fused, name, summary)                  \
    COTAN_ROW_##source(name, word)
#include "cotan/frames.inc"
};

// A sound fragment. The text has no branches that skip work, so any other counts the same.
counted::cost_inputs exampleInputs()
{
    counted::cost_inputs i;
    i.n = cotan_vec3(0.1, 0.2, 0.95);
    i.dpdx = cotan_vec3(0.01, 0.002, -0.001);
    i.dpdy = cotan_vec3(-0.003, 0.012, 0.002);
    i.duvdx = cotan_vec2(0.02, 0.001);
    i.duvdy = cotan_vec2(-0.004, 0.03);
    i.tangent = cotan_vec4(0.9, 0.1, -0.1, 1.0);
    i.cotangent_u = cotan_vec3(0.9, 0.1, -0.1);
    i.cotangent_v = cotan_vec3(-0.1, 1.1, -0.2);
    i.triangle_u = cotan_vec3(0.9, 0.1, -0.1);
    i.triangle_v = cotan_vec3(-0.1, 0.8, -0.2);
    i.m = cotan_vec3(0.2, -0.3, 0.9);
    return i;
}

template<class Run> Operations count(const Run& run)
{
    Operations operations;
    counting = &operations;
    run();
    counting = nullptr;
    return operations;
}

} // namespace

Operations operationsOfRow(std::string_view row)
{
    const counted::cost_inputs i = exampleInputs();
    for (const RowFunction& f : kRows)
        if (f.name == row)
            return count([&] { f.run(i); });
    return {};
}

Operations operationsOfFrame(std::string_view frame)
{
    const counted::cost_inputs i = exampleInputs();
    for (const FrameFunction& f : kFrames)
        if (f.name == frame)
            return count([&] { f.run(i.n, i.dpdx, i.dpdy, i.duvdx, i.duvdy); });
    return {};
}

Operations operationsOfTriangleVectors(bool total)
{
    const counted::cost_inputs i = exampleInputs();
    const auto run = total ? counted::cotan_triangle_of_edges : counted::cotan_triangle_of_sound_edges;
    return count([&] { run(i.dpdx, i.dpdy, i.duvdx, i.duvdy, i.n); });
}

Operations operationsOfSafeNormal()
{
    const counted::cost_inputs i = exampleInputs();
    return count([&] { counted::cotan_safe_normal(i.n, i.dpdx, i.dpdy); });
}

} // namespace cotan::cost
