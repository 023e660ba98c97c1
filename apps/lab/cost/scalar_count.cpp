#include "cost/scalar_count.hpp"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "cotan/portable.hpp"
#include "counted_real.hpp"

namespace cotan::cost {

// The shaders' source, compiled with a number type that counts operations.
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

#define COTAN_FUSED_false(word, name)
#define COTAN_FUSED_true(word, name) {name "-fused", counted::cost_fused_##word},
#define COTAN_FRAME_ROW(number, enumerator, word, source, total, dependsOnView, normal, fused, after, name, summary)   \
    {name, counted::cost_frame_##word}, COTAN_FUSED_##fused(word, name)
constexpr RowFunction kRows[] = {
    {"floor", counted::cost_floor},
#include "cotan/frames.inc"
    {"triangle-halfs", counted::cost_fused_triangle},
    {"triangle-read", counted::cost_fused_triangle},
    {"triangle-scaled", counted::cost_triangle_scaled},
    {"cotangent-seen", counted::cost_cotangent_seen},
    {"cotangent-area-fused", counted::cost_cotangent_area_fused},
    {"cotangent-plain", counted::cost_cotangent_plain},
    {"cotangent-facing", counted::cost_cotangent_facing},
    {"gradient-plain", counted::cost_gradient_plain},
    {"orthonormal-plain", counted::cost_orthonormal_plain},
};
#undef COTAN_FUSED_false
#undef COTAN_FUSED_true

struct FrameFunction {
    std::string_view name;
    counted::cotan_frame (*run)(cotan_vec3, cotan_vec3, cotan_vec3, cotan_vec2, cotan_vec2);
};

// The frames that are built from differences.
constexpr FrameFunction kFrames[] = {
#define COTAN_ROW_differences(name, word) {name, counted::cotan_frame_##word},
#define COTAN_ROW_triangle(name, word) {name, counted::cotan_frame_##word},
#define COTAN_ROW_cotangents(name, word)
#define COTAN_ROW_tangents(name, word)
#define COTAN_FRAME_ROW(number, enumerator, word, source, total, dependsOnView, normal, fused, after, name, summary)   \
    COTAN_ROW_##source(name, word)
#include "cotan/frames.inc"
};

// A well-conditioned fragment. No branch of the code skips work, so every other fragment gives the same counts.
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
