// The variants that `cotan cost` measures, as portable text: each function does all the work of perturbing a normal,
// from interpolated inputs and differences to the unit result. Include cotan/lang.h, frame.h, history.h and fused.h
// first. The fragment shaders (fragment.frag) and the operation counter (apps/lab/cost/scalar_count.cpp) call the same
// text. The table of frames defines cost_frame_WORD for each frame, and cost_fused_WORD for each one with a fused form.
//
// Inputs: n: interpolated normal, not unit; the differences of a frame; m: decoded texel; tangent: as interpolated, w:
// the sign with which cross(n, t) points along +v; cotangent_u and cotangent_v: as interpolated; triangle_u and
// triangle_v: constant over a triangle.

#ifndef COTAN_COST_ROWS_H
#define COTAN_COST_ROWS_H

struct cost_inputs {
    cotan_vec3 n;
    cotan_vec3 dpdx;
    cotan_vec3 dpdy;
    cotan_vec2 duvdx;
    cotan_vec2 duvdy;
    cotan_vec4 tangent;
    cotan_vec3 cotangent_u;
    cotan_vec3 cotangent_v;
    cotan_vec3 triangle_u;
    cotan_vec3 triangle_v;
    cotan_vec3 m;
};

COTAN_FUNCTION cotan_vec3 cost_unit(cotan_vec3 v) { return v * cotan_inversesqrt(dot(v, v)); }

COTAN_FUNCTION cotan_vec3 cost_sum(cotan_frame f, cotan_vec3 m)
{
    return cost_unit(f.t * m.x + f.b * m.y + f.n * m.z);
}

// The baseline: no frame (t = b = 0). The interpolated normal is normalised, as for any frame, and the texel applied.
// Every row has at least this cost.
COTAN_FUNCTION cotan_vec3 cost_floor(cost_inputs i) { return cost_unit(cost_unit(i.n) * i.m.z); }

// ---- the frames, and their fused forms --------------------------------------------------------

// By who normalises the normal. For `nobody` the texel is applied to the unnormalised normal.
#define COST_NORMAL_frame(n) n
#define COST_NORMAL_caller(n) cost_unit(n)
#define COST_NORMAL_nobody(n) n
#define COST_APPLY_frame cotan_apply
#define COST_APPLY_caller cost_sum
#define COST_APPLY_nobody cost_sum
// By the source of the frame. A frame from the triangle that has a fused form is built from u and v.
#define COST_FROM_differences(word, fused, n) cotan_frame_##word(n, i.dpdx, i.dpdy, i.duvdx, i.duvdy)
#define COST_FROM_cotangents(word, fused, n) cotan_frame_##word(n, i.cotangent_u, i.cotangent_v)
#define COST_FROM_tangents(word, fused, n) \
    cotan_frame_##word(n, cotan_vec3(i.tangent.x, i.tangent.y, i.tangent.z), i.tangent.w)
#define COST_FROM_triangle(word, fused, n) COST_FROM_triangle_##fused(word, n)
#define COST_FROM_triangle_false(word, n) cotan_frame_##word(n, i.dpdx, i.dpdy, i.duvdx, i.duvdy)
#define COST_FROM_triangle_true(word, n) cotan_frame_of_##word(n, i.triangle_u, i.triangle_v)
#define COST_FUSED_differences(word) cotan_perturb_##word(i.n, i.dpdx, i.dpdy, i.duvdx, i.duvdy, i.m)
#define COST_FUSED_cotangents(word) cotan_perturb_##word(i.n, i.cotangent_u, i.cotangent_v, i.m)
#define COST_FUSED_triangle(word) cotan_perturb_##word(i.n, i.triangle_u, i.triangle_v, i.m)
#define COST_FUSED_ROW_false(word, source)
#define COST_FUSED_ROW_true(word, source) \
    COTAN_FUNCTION cotan_vec3 cost_fused_##word(cost_inputs i) { return COST_FUSED_##source(word); }

#define COTAN_FRAME_ROW(number, enumerator, word, source, total, dependsOnView, normal, fused, after, name, summary) \
    COTAN_FUNCTION cotan_vec3 cost_frame_##word(cost_inputs i)                                                       \
    {                                                                                                                \
        return COST_APPLY_##normal(COST_FROM_##source(word, fused, COST_NORMAL_##normal(i.n)), i.m);                 \
    }                                                                                                                \
    COST_FUSED_ROW_##fused(word, source)
#include "cotan/frames.inc"

// ---- other fused forms ------------------------------------------------------------------------

COTAN_FUNCTION cotan_vec3 cost_triangle_scaled(cost_inputs i)
{
    return cotan_perturb_triangle_scaled(i.n, i.triangle_u, i.triangle_v, i.m);
}
COTAN_FUNCTION cotan_vec3 cost_cotangent_area_fused(cost_inputs i)
{
    return cotan_perturb_cotangent_area(i.n, i.dpdx, i.dpdy, i.duvdx, i.duvdy, i.m);
}
COTAN_FUNCTION cotan_vec3 cost_cotangent_seen(cost_inputs i)
{
    return cotan_perturb_cotangent_seen(
        i.n, i.dpdx, i.dpdy, i.duvdx, i.duvdy, i.m, cotan_real(-1.0));
}

// ---- plain forms of the formulas, without guards for all inputs ---------------------------

// [2013] with the sign of n . (dpdx x dpdy) and a guard for the root, as a careful reader would implement it.
COTAN_FUNCTION cotan_vec3 cost_cotangent_plain(cost_inputs i)
{
    cotan_vec3 n = cost_unit(i.n);
    cotan_vec3 dpdy_perp = cross(i.dpdy, n);
    cotan_vec3 dpdx_perp = cross(n, i.dpdx);
    cotan_vec3 t = dpdy_perp * i.duvdx.x + dpdx_perp * i.duvdy.x;
    cotan_vec3 b = dpdy_perp * i.duvdx.y + dpdx_perp * i.duvdy.y;
    cotan_real longest2 = max(dot(t, t), dot(b, b));
    cotan_real scale = cotan_inversesqrt(max(longest2, cotan_real(1e-30)));
    scale = scale * cotan_sign(dot(i.dpdx, dpdy_perp));
    cotan_frame f;
    f.t = t * scale;
    f.b = b * scale;
    f.n = n;
    return cost_sum(f, i.m);
}

// The same without the sign: the fragment shader negates m.x and m.y on back faces (gl_FrontFacing), as in engines that
// rely on the rasteriser's winding.
COTAN_FUNCTION cotan_vec3 cost_cotangent_facing(cost_inputs i)
{
    cotan_vec3 n = cost_unit(i.n);
    cotan_vec3 dpdy_perp = cross(i.dpdy, n);
    cotan_vec3 dpdx_perp = cross(n, i.dpdx);
    cotan_vec3 t = dpdy_perp * i.duvdx.x + dpdx_perp * i.duvdy.x;
    cotan_vec3 b = dpdy_perp * i.duvdx.y + dpdx_perp * i.duvdy.y;
    cotan_real longest2 = max(dot(t, t), dot(b, b));
    cotan_real scale = cotan_inversesqrt(max(longest2, cotan_real(1e-30)));
    cotan_frame f;
    f.t = t * scale;
    f.b = b * scale;
    f.n = n;
    return cost_sum(f, i.m);
}

// The surface gradients of [2020], unguarded.
COTAN_FUNCTION cotan_vec3 cost_gradient_plain(cost_inputs i)
{
    cotan_vec3 n = cost_unit(i.n);
    cotan_vec3 dpdy_perp = cross(i.dpdy, n);
    cotan_vec3 dpdx_perp = cross(n, i.dpdx);
    cotan_real scale = cotan_real(1.0) / dot(i.dpdx, dpdy_perp);
    cotan_frame f;
    f.t = (dpdy_perp * i.duvdx.x + dpdx_perp * i.duvdy.x) * scale;
    f.b = (dpdy_perp * i.duvdx.y + dpdx_perp * i.duvdy.y) * scale;
    f.n = n;
    return cost_sum(f, i.m);
}

// The orthonormal basis of [2020], guarded only against uv without area.
COTAN_FUNCTION cotan_vec3 cost_orthonormal_plain(cost_inputs i)
{
    cotan_vec3 n = cost_unit(i.n);
    cotan_vec3 sigma_x = i.dpdx - n * dot(i.dpdx, n);
    cotan_vec3 sigma_y = i.dpdy - n * dot(i.dpdy, n);
    cotan_real side = cotan_sign(dot(i.dpdy, cross(n, i.dpdx)));
    cotan_real determinant = i.duvdx.x * i.duvdy.y - i.duvdx.y * i.duvdy.x;
    cotan_real s = cotan_sign(determinant);
    cotan_vec3 t = (sigma_x * i.duvdy.y - sigma_y * i.duvdx.y) * s;
    cotan_frame f;
    f.t = abs(determinant) > cotan_real(0.0) ? cost_unit(t) : t;
    f.b = cross(n, f.t) * (s * side);
    f.n = n;
    return cost_sum(f, i.m);
}

#endif
