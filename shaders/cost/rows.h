// What `cotan cost` counts, as portable text: each function is the whole of perturbing a normal, from
// interpolated inputs and differences to the unit result. Include cotan/lang.h, frame.h, history.h and fused.h
// first. The fragment shaders (fragment.frag) and the operation counter (apps/lab/cost/scalar_count.cpp)
// call the same text.
//
// Inputs: n interpolated normal, not unit; the differences of a frame; m decoded texel; tangent as
// interpolated, w the sign with which cross(n, t) points along +v; cotangent_u and cotangent_v as
// interpolated; triangle_u and triangle_v the same at every pixel of a triangle.

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

// The floor: no frame (t = b = 0). The interpolated normal is normalised, as for any frame, and the
// texel applied; what every row pays.
COTAN_FUNCTION cotan_vec3 cost_floor(cost_inputs i) { return cost_unit(cost_unit(i.n) * i.m.z); }

// ---- stored at the vertices -----------------------------------------------------------------

COTAN_FUNCTION cotan_vec3 cost_mikktspace(cost_inputs i)
{
    cotan_vec3 t = cotan_vec3(i.tangent.x, i.tangent.y, i.tangent.z);
    return cost_sum(cotan_frame_mikktspace(i.n, t, i.tangent.w), i.m);
}

COTAN_FUNCTION cotan_vec3 cost_vertex(cost_inputs i)
{
    cotan_vec3 t = cotan_vec3(i.tangent.x, i.tangent.y, i.tangent.z);
    return cotan_apply(cotan_frame_vertex(i.n, t, i.tangent.w), i.m);
}

COTAN_FUNCTION cotan_vec3 cost_smooth(cost_inputs i)
{
    return cotan_apply(cotan_frame_smooth(i.n, i.cotangent_u, i.cotangent_v), i.m);
}

COTAN_FUNCTION cotan_vec3 cost_smooth_fused(cost_inputs i)
{
    return cotan_perturb_smooth(i.n, i.cotangent_u, i.cotangent_v, i.m);
}

// ---- from two vectors of the triangle ---------------------------------------------------------

COTAN_FUNCTION cotan_vec3 cost_triangle_fused(cost_inputs i)
{
    return cotan_perturb_triangle(i.n, i.triangle_u, i.triangle_v, i.m);
}
COTAN_FUNCTION cotan_vec3 cost_triangle_scaled(cost_inputs i)
{
    return cotan_perturb_triangle_scaled(i.n, i.triangle_u, i.triangle_v, i.m);
}
COTAN_FUNCTION cotan_vec3 cost_triangle(cost_inputs i)
{
    return cotan_apply(cotan_frame_of_triangle(i.n, i.triangle_u, i.triangle_v), i.m);
}

// ---- plain forms of the formulas, without totality ----------------------------------------

// [2013] with the sign of n . (dpdx x dpdy) and a guard under the root: what a careful reader types.
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

// The same without the sign: the fragment shader negates m.x and m.y on back faces (gl_FrontFacing),
// as engines do that leave it to the rasteriser's winding.
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

// The orthonormal basis of [2020], guarded against uv without area only.
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

// ---- fused.h ---------------------------------------------------------------------------------

COTAN_FUNCTION cotan_vec3 cost_cotangent_fused(cost_inputs i)
{
    return cotan_perturb_cotangent(i.n, i.dpdx, i.dpdy, i.duvdx, i.duvdy, i.m);
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
COTAN_FUNCTION cotan_vec3 cost_gradient_fused(cost_inputs i)
{
    return cotan_perturb_gradient(i.n, i.dpdx, i.dpdy, i.duvdx, i.duvdy, i.m);
}
COTAN_FUNCTION cotan_vec3 cost_orthonormal_fused(cost_inputs i)
{
    return cotan_perturb_orthonormal(i.n, i.dpdx, i.dpdy, i.duvdx, i.duvdy, i.m);
}

// ---- the total frames of frame.h: no input gives a NaN ---------------------------------------

COTAN_FUNCTION cotan_vec3 cost_cotangent(cost_inputs i)
{
    return cotan_apply(cotan_frame_cotangent(i.n, i.dpdx, i.dpdy, i.duvdx, i.duvdy), i.m);
}
COTAN_FUNCTION cotan_vec3 cost_gradient(cost_inputs i)
{
    return cotan_apply(cotan_frame_gradient(i.n, i.dpdx, i.dpdy, i.duvdx, i.duvdy), i.m);
}
COTAN_FUNCTION cotan_vec3 cost_orthonormal(cost_inputs i)
{
    return cotan_apply(cotan_frame_orthonormal(i.n, i.dpdx, i.dpdy, i.duvdx, i.duvdy), i.m);
}
COTAN_FUNCTION cotan_vec3 cost_exact(cost_inputs i)
{
    return cotan_apply(cotan_frame_exact(i.n, i.dpdx, i.dpdy, i.duvdx, i.duvdy), i.m);
}

// ---- the frames of history.h, which want n unit --------------------------------------------

COTAN_FUNCTION cotan_vec3 cost_cotangent_2013(cost_inputs i)
{
    return cost_sum(cotan_frame_cotangent_2013(cost_unit(i.n), i.dpdx, i.dpdy, i.duvdx, i.duvdy), i.m);
}
COTAN_FUNCTION cotan_vec3 cost_nonperspective(cost_inputs i)
{
    return cost_sum(cotan_frame_nonperspective(cost_unit(i.n), i.dpdx, i.dpdy, i.duvdx, i.duvdy), i.m);
}
COTAN_FUNCTION cotan_vec3 cost_paper_full(cost_inputs i)
{
    return cost_sum(cotan_frame_paper_full(cost_unit(i.n), i.dpdx, i.dpdy, i.duvdx, i.duvdy), i.m);
}
COTAN_FUNCTION cotan_vec3 cost_paper_nodet(cost_inputs i)
{
    return cost_sum(cotan_frame_paper_nodet(cost_unit(i.n), i.dpdx, i.dpdy, i.duvdx, i.duvdy), i.m);
}
COTAN_FUNCTION cotan_vec3 cost_paper_transpose(cost_inputs i)
{
    return cost_sum(cotan_frame_paper_transpose(cost_unit(i.n), i.dpdx, i.dpdy, i.duvdx, i.duvdy), i.m);
}
COTAN_FUNCTION cotan_vec3 cost_paper_orthogonal(cost_inputs i)
{
    return cost_sum(cotan_frame_paper_orthogonal(cost_unit(i.n), i.dpdx, i.dpdy, i.duvdx, i.duvdy), i.m);
}
COTAN_FUNCTION cotan_vec3 cost_unit_lengths(cost_inputs i)
{
    return cost_sum(cotan_frame_unit(cost_unit(i.n), i.dpdx, i.dpdy, i.duvdx, i.duvdy), i.m);
}

#endif
