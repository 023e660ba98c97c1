// Cotan portable text: the frame of a triangle. Include lang.h and frame.h first.
//
// Texture coordinates are linear on a triangle, so the gradients that `cotangent` derives from screen differences are
// the same at every pixel of it. With the edges e1 = p1 - p0, e2 = p2 - p0 and d1 = uv1 - uv0, d2 = uv2 - uv0, the two
// vectors
//     U = e1 d2.u - e2 d1.u        V = e1 d2.v - e2 d1.v
// give  t = n x U  and  b = n x V:  exactly the t and b of `cotangent`, up to a common sign and a common scale, which
// are both included in U and V. U and V are computed once per triangle, in the vertex, mesh or compute stage or when
// the mesh is loaded, and passed to the pixels without interpolation. The pixel stage calls cotan_perturb_triangle of
// fused.h.
//
// Source: [2013], whose dp2perp and dp1perp are cross products of the differences with n; here the differences are
// summed before the cross product. Sign, scale and guards are ours.

#ifndef COTAN_TRIANGLE_H
#define COTAN_TRIANGLE_H

// U and V of one triangle: vectors in its plane. The longer one has length 1. U = V = 0 if there is no frame.
struct cotan_triangle {
    cotan_vec3 u;
    cotan_vec3 v;
};

// Scales u and v by one factor, so that the longer has length 1, and by `sign`: +1, -1, or 0 for U = V = 0.
// u, v: finite. If both are shorter than about 1e-43, U = V = 0.
COTAN_FUNCTION cotan_triangle cotan_triangle_unit(cotan_vec3 u, cotan_vec3 v, cotan_real sign)
{
    cotan_real rescale = cotan_power_of_two_scale(max(cotan_max_abs(u), cotan_max_abs(v)));
    u = u * rescale;
    v = v * rescale;
    cotan_real longest2 = max(dot(u, u), dot(v, v));
    bool usable = longest2 > cotan_real(1e-12);
    cotan_real scale = cotan_inversesqrt(usable ? longest2 : cotan_real(1.0));
    scale = usable ? scale * sign : cotan_real(0.0);
    cotan_triangle result;
    result.u = u * scale;
    result.v = v * scale;
    return result;
}

// Returns U and V from edges, including the sign: n x U  points along increasing u for every n on the side of
// `normals`.
//   dp1, dp2      p1 - p0 and p2 - p0, in the space of the frame
//   duv1, duv2    uv1 - uv0 and uv2 - uv0
//   normals       the sum of the three vertex normals, of any length, in the same space. It determines the outer side
//                 of the triangle, so that meshes wound against their normals are handled. If it is zero or not finite,
//                 the winding decides: the triangle is counterclockwise as seen from outside
// Total: a triangle without area, constant uv and non-finite input give U = V = 0. Where uv vary along one line only, U
// is parallel to V.
COTAN_FUNCTION cotan_triangle cotan_triangle_of_edges(
    cotan_vec3 dp1, cotan_vec3 dp2, cotan_vec2 duv1, cotan_vec2 duv2, cotan_vec3 normals)
{
    cotan_differences d = cotan_scale_differences(dp1, dp2, duv1, duv2);
    cotan_vec3 u = d.dpdx * d.duvdy.x - d.dpdy * d.duvdx.x;
    cotan_vec3 v = d.dpdx * d.duvdy.y - d.dpdy * d.duvdx.y;
    cotan_vec3 face = cross(d.dpdx, d.dpdy);
    cotan_real side = cotan_sign(dot(face, cotan_normalize_or(normals, face)));
    return cotan_triangle_unit(u, v, dot(face, face) > cotan_real(0.0) ? side : cotan_real(0.0));
}

// A faster cotan_triangle_of_edges for well-conditioned input, for stages that run for every vertex of every frame.
// Equal up to rounding if
// - the input is finite; the longest edge and the longest uv difference lie between 1e-9 and 1e6, and their product
//   between 1e-12 and 1e5;
// - the triangle is no sliver: its area is at least a tenth of its longest edge squared.
// Zero edges and constant uv give U = V = 0. A triangle without area can give U parallel to V, but no NaN.
COTAN_FUNCTION cotan_triangle cotan_triangle_of_sound_edges(
    cotan_vec3 dp1, cotan_vec3 dp2, cotan_vec2 duv1, cotan_vec2 duv2, cotan_vec3 normals)
{
    cotan_triangle result;
    result.u = dp1 * duv2.x - dp2 * duv1.x;
    result.v = dp1 * duv2.y - dp2 * duv1.y;
    cotan_real longest2 =
        max(max(dot(result.u, result.u), dot(result.v, result.v)), cotan_real(1e-33));
    cotan_real scale =
        cotan_copy_sign(cotan_inversesqrt(longest2), dot(cross(dp1, dp2), normals));
    result.u = result.u * scale;
    result.v = result.v * scale;
    return result;
}

// Returns U and V from three vertices: positions, texture coordinates and normals in the order of the index buffer. The
// choice of the first vertex does not matter, except for rounding.
COTAN_FUNCTION cotan_triangle cotan_triangle_of_vertices(
    cotan_vec3 p0, cotan_vec3 p1, cotan_vec3 p2, cotan_vec2 uv0, cotan_vec2 uv1, cotan_vec2 uv2,
    cotan_vec3 n0, cotan_vec3 n1, cotan_vec3 n2)
{
    return cotan_triangle_of_edges(p1 - p0, p2 - p0, uv1 - uv0, uv2 - uv0, n0 + n1 + n2);
}

// Transforms U and V from model space to another space by the 3x3 matrix M of a model transform, given by its rows.
// Exact for every invertible M: U and V transform like edges, by M, and the scale is recomputed as for the transformed
// triangle. The outer side is that of model space. A frame made from the transformed edges differs only where a normal
// is more than 90 degrees from its triangle's normal either before or after the transform, but not both.
//   side   +1, or -1 if M mirrors (negative determinant). Use it with the normal transformed by the inverse transpose,
//          not flipped
// Total: non-finite or too small vectors give U = V = 0.
COTAN_FUNCTION cotan_triangle cotan_triangle_transformed(
    cotan_triangle object, cotan_vec3 row0, cotan_vec3 row1, cotan_vec3 row2, cotan_real side)
{
    cotan_vec3 u =
        cotan_vec3(dot(row0, object.u), dot(row1, object.u), dot(row2, object.u));
    cotan_vec3 v =
        cotan_vec3(dot(row0, object.v), dot(row1, object.v), dot(row2, object.v));
    bool finite = cotan_sum_abs(u) + cotan_sum_abs(v) <= COTAN_HUGE;
    cotan_vec3 zero = cotan_vec3(cotan_real(0.0), cotan_real(0.0), cotan_real(0.0));
    return cotan_triangle_unit(finite ? u : zero, finite ? v : zero, side);
}

// `triangle`: the frame of U and V at a pixel. t and b have the directions of `cotangent`, but the scale of the
// triangle, not of the pixel: where n is at an angle a to the triangle's own normal, slopes are those of `cotangent`
// times a factor between cos(a) and 1. View independent.
//   n      interpolated normal, any length, on the side that U and V were made for; f.n is unit. On back faces pass the
//          normal as interpolated and negate the result, or negate m.z instead: a flipped n reverses t and b
//   u, v   U and V in the space of n
// Total: non-finite U and V give t = b = 0.
// Source: [2013], summing before the cross product; see the head of this file.
COTAN_FUNCTION cotan_frame cotan_frame_of_triangle(cotan_vec3 n, cotan_vec3 u, cotan_vec3 v)
{
    cotan_vec3 zero = cotan_vec3(cotan_real(0.0), cotan_real(0.0), cotan_real(0.0));
    bool finite = cotan_sum_abs(u) + cotan_sum_abs(v) <= COTAN_HUGE;
    cotan_frame f;
    f.n = cotan_safe_normal(n, zero, zero);
    f.t = cross(f.n, finite ? u : zero);
    f.b = cross(f.n, finite ? v : zero);
    return f;
}

// `triangle` in one step, from the edges of the triangle. n also determines the outer side, so it may be flipped on
// back faces. Equal to the frame from the vertices wherever n is less than 90 degrees from the triangle's own normal.
//   n             interpolated normal at the shaded point, any length; f.n is unit
//   dpdx, dpdy    edges p1 - p0 and p2 - p0
//   duvdx, duvdy  uv1 - uv0 and uv2 - uv0
// Total: a triangle without area, constant uv and non-finite input give t = b = 0.
COTAN_FUNCTION cotan_frame cotan_frame_triangle(
    cotan_vec3 n, cotan_vec3 dpdx, cotan_vec3 dpdy, cotan_vec2 duvdx, cotan_vec2 duvdy)
{
    cotan_differences d = cotan_scale_differences(dpdx, dpdy, duvdx, duvdy);
    cotan_vec3 unit = cotan_safe_normal(n, d.dpdx, d.dpdy);
    cotan_triangle vectors = cotan_triangle_of_edges(dpdx, dpdy, duvdx, duvdy, unit);
    return cotan_frame_of_triangle(unit, vectors.u, vectors.v);
}

#endif
