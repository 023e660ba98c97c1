// Cotan portable text: the frames of the papers and of ports of them, for comparison. Include lang.h and frame.h first.
// Arguments, results and sources are those of frame.h.
//
// None of these frames is total: degenerate input gives NaN. Only paper-full and cotangent-2013 are exact for
// anisotropic uv, and cotangent-2013 only where n . (dpdx x dpdy) > 0.

#ifndef COTAN_HISTORY_H
#define COTAN_HISTORY_H

// `cotangent-2013`: as printed in 2013. Correct only where n . (dpdx x dpdy) > 0; elsewhere t and b are both reversed.
// n must be unit. Constant uv or zero area give NaN or infinities.
// Source: [2013] 'cotangent_frame'.
COTAN_FUNCTION cotan_frame cotan_frame_cotangent_2013(
    cotan_vec3 n, cotan_vec3 dpdx, cotan_vec3 dpdy, cotan_vec2 duvdx, cotan_vec2 duvdy)
{
    cotan_vec3 dpdy_perp = cross(dpdy, n);
    cotan_vec3 dpdx_perp = cross(n, dpdx);
    cotan_vec3 t = dpdy_perp * duvdx.x + dpdx_perp * duvdy.x;
    cotan_vec3 b = dpdy_perp * duvdx.y + dpdx_perp * duvdy.y;
    cotan_real scale = cotan_inversesqrt(max(dot(t, t), dot(b, b)));
    cotan_frame f;
    f.t = t * scale;
    f.b = b * scale;
    f.n = n;
    return f;
}

// `nonperspective`: the shortcut of [2013] that uses the edges themselves as the edge perpendiculars. Exact only where
// the surface faces the camera; foreshortening, with or without perspective, breaks it (9.8 degrees in the mean at 45
// degrees of tilt). View dependent, so no map can be baked for it. n must be unit. Constant uv give NaN.
// Source: [2013] 'Non-perspective optimization'.
COTAN_FUNCTION cotan_frame cotan_frame_nonperspective(
    cotan_vec3 n, cotan_vec3 dpdx, cotan_vec3 dpdy, cotan_vec2 duvdx, cotan_vec2 duvdy)
{
    cotan_vec3 t = dpdx * duvdx.x + dpdy * duvdy.x;
    cotan_vec3 b = dpdx * duvdx.y + dpdy * duvdy.y;
    cotan_real scale = cotan_inversesqrt(max(dot(t, t), dot(b, b)));
    cotan_frame f;
    f.t = t * scale;
    f.b = b * scale;
    f.n = n;
    return f;
}

// Returns the adjugate of the matrix with rows r0, r1, r2 times the column (x, y, 0). Divided by the determinant, this
// is the solution of the linear system of [2006].
COTAN_FUNCTION cotan_vec3 cotan_adjugate_times(
    cotan_vec3 r0, cotan_vec3 r1, cotan_vec3 r2, cotan_vec2 column)
{
    cotan_vec3 c0 = cotan_vec3(r0.x, r1.x, r2.x);
    cotan_vec3 c1 = cotan_vec3(r0.y, r1.y, r2.y);
    cotan_vec3 c2 = cotan_vec3(r0.z, r1.z, r2.z);
    cotan_vec3 a = cross(c1, c2);
    cotan_vec3 b = cross(c2, c0);
    cotan_vec3 c = cross(c0, c1);
    return cotan_vec3(a.x * column.x + a.y * column.y, b.x * column.x + b.y * column.y,
        c.x * column.x + c.y * column.y);
}

// `paper-full`: the general solution of [2006], a full 3x3 inverse. t and b lie in the plane of dpdx and dpdy and are
// divided by the longer length. n must be unit. Degenerate input gives NaN.
// Source: [2006] 'compute_tangent_frame'.
COTAN_FUNCTION cotan_frame cotan_frame_paper_full(
    cotan_vec3 n, cotan_vec3 dpdx, cotan_vec3 dpdy, cotan_vec2 duvdx, cotan_vec2 duvdy)
{
    cotan_vec3 face = cross(dpdx, dpdy);
    cotan_real determinant = dot(face, face);
    cotan_vec3 t =
        cotan_adjugate_times(dpdx, dpdy, face, cotan_vec2(duvdx.x, duvdy.x)) / determinant;
    cotan_vec3 b =
        cotan_adjugate_times(dpdx, dpdy, face, cotan_vec2(duvdx.y, duvdy.y)) / determinant;
    cotan_real longest = sqrt(max(dot(t, t), dot(b, b)));
    cotan_frame f;
    f.t = t / longest;
    f.b = b / longest;
    f.n = n;
    return f;
}

// `paper-nodet`: [2006] without the determinant; t and b each have unit length. Anisotropic uv give the error of an
// orthonormal frame (2:1: 9.5 degrees in the mean), sheared uv a smaller one. n must be unit. Degenerate input gives
// NaN.
// Source: [2006] 'compute_tangent_frame_01'.
COTAN_FUNCTION cotan_frame cotan_frame_paper_nodet(
    cotan_vec3 n, cotan_vec3 dpdx, cotan_vec3 dpdy, cotan_vec2 duvdx, cotan_vec2 duvdy)
{
    cotan_vec3 face = cross(dpdx, dpdy);
    cotan_vec3 t = cotan_adjugate_times(dpdx, dpdy, face, cotan_vec2(duvdx.x, duvdy.x));
    cotan_vec3 b = cotan_adjugate_times(dpdx, dpdy, face, cotan_vec2(duvdx.y, duvdy.y));
    cotan_frame f;
    f.t = t * cotan_inversesqrt(dot(t, t));
    f.b = b * cotan_inversesqrt(dot(b, b));
    f.n = n;
    return f;
}

// `paper-transpose`: paper-nodet with the inverse transpose written out as two cross products; the values are the same.
// n must be unit. Degenerate input gives NaN.
// Source: [2006] 'compute_tangent_frame_02'.
COTAN_FUNCTION cotan_frame cotan_frame_paper_transpose(
    cotan_vec3 n, cotan_vec3 dpdx, cotan_vec3 dpdy, cotan_vec2 duvdx, cotan_vec2 duvdy)
{
    cotan_vec3 face = cross(dpdx, dpdy);
    cotan_vec3 r0 = cross(dpdy, face);
    cotan_vec3 r1 = cross(face, dpdx);
    cotan_vec3 t = r0 * duvdx.x + r1 * duvdy.x;
    cotan_vec3 b = r0 * duvdx.y + r1 * duvdy.y;
    cotan_frame f;
    f.t = t * cotan_inversesqrt(dot(t, t));
    f.b = b * cotan_inversesqrt(dot(b, b));
    f.n = n;
    return f;
}

// `paper-orthogonal`: paper-transpose under the assumption that dpdx and dpdy are orthogonal and equally long. Fails
// under foreshortening like `nonperspective`. n must be unit. Degenerate input gives NaN.
// Source: [2006] 'compute_tangent_frame_03'.
COTAN_FUNCTION cotan_frame cotan_frame_paper_orthogonal(
    cotan_vec3 n, cotan_vec3 dpdx, cotan_vec3 dpdy, cotan_vec2 duvdx, cotan_vec2 duvdy)
{
    cotan_vec3 t = dpdx * duvdx.x + dpdy * duvdy.x;
    cotan_vec3 b = dpdx * duvdx.y + dpdy * duvdy.y;
    cotan_frame f;
    f.t = t * cotan_inversesqrt(dot(t, t));
    f.b = b * cotan_inversesqrt(dot(b, b));
    f.n = n;
    return f;
}

// `unit`: cotangents, each divided by its own length, as ports of [2013] do. Wrong for anisotropic uv (2:1: 9.5 degrees
// in the mean, 17.9 at most). Unlike those ports it carries the sign of n . (dpdx x dpdy) instead of a platform switch.
// n must be unit. Constant u or v gives NaN.
COTAN_FUNCTION cotan_frame cotan_frame_unit(
    cotan_vec3 n, cotan_vec3 dpdx, cotan_vec3 dpdy, cotan_vec2 duvdx, cotan_vec2 duvdy)
{
    cotan_vec3 dpdy_perp = cross(dpdy, n);
    cotan_vec3 dpdx_perp = cross(n, dpdx);
    cotan_vec3 t = dpdy_perp * duvdx.x + dpdx_perp * duvdy.x;
    cotan_vec3 b = dpdy_perp * duvdx.y + dpdx_perp * duvdy.y;
    cotan_real s = cotan_sign(dot(dpdx, dpdy_perp));
    cotan_frame f;
    f.t = t * (s * cotan_inversesqrt(dot(t, t)));
    f.b = b * (s * cotan_inversesqrt(dot(b, b)));
    f.n = n;
    return f;
}

#endif
