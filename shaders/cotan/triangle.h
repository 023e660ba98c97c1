// Cotan portable text: the frame of a triangle. Include lang.h and frame.h first.
//
// Texture coordinates are linear on a triangle, so what the screen differences of `cotangent` find is
// the same at every pixel of it. With the edges e1 = p1 - p0, e2 = p2 - p0 and d1 = uv1 - uv0,
// d2 = uv2 - uv0, the two vectors
//     U = e1 d2.u - e2 d1.u        V = e1 d2.v - e2 d1.v
// give  t = n x U  and  b = n x V:  exactly the t and b of `cotangent`, up to one sign and one scale
// that both share. Both are put into U and V. They are made once for each triangle, in the vertex,
// mesh or compute stage or when the mesh is loaded, and handed to its pixels without interpolation.
// The pixel's part is cotan_perturb_triangle of fused.h.
//
// Source: [2013], whose dp2perp and dp1perp are cross products with n of differences; here the sum
// over the differences is taken before the product. Sign, scale and guards are ours.

#ifndef COTAN_TRIANGLE_H
#define COTAN_TRIANGLE_H

// U and V of one triangle: vectors in its plane. The longer one has length 1. U = V = 0 where there
// is no frame.
struct cotan_triangle {
    cotan_vec3 u;
    cotan_vec3 v;
};

// u and v scaled by one factor, so that the longer has length 1, and by `sign`: +1, -1, or 0 for U = V = 0.
// u, v: finite. Both zero, or shorter than 1e-6 of the clamp range of cotan_power_of_two_scale, gives 0.
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

// U and V from edges.
//   dp1, dp2      p1 - p0 and p2 - p0, in the space of the frame
//   duv1, duv2    uv1 - uv0 and uv2 - uv0
//   normals       the sum of the three vertex normals, of any length, in the same space. It says which
//                 side of the triangle is outside, so that meshes wound against their normals come
//                 out right. Zero or not finite: the winding decides, counterclockwise is outside
// The sign is folded in. So  n x U  points along increasing u wherever n is on the side of `normals`.
// Total: a triangle without area, constant uv, non-finite input give U = V = 0. uv along one line
// give U parallel to V.
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

// The same for sound input, for stages that run for every vertex of every picture. Equal to the function
// above to rounding, where
// - the input is finite; the longest edge and the longest uv difference lie between 1e-9 and 1e6, and
//   their product between 1e-12 and 1e5;
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

// U and V from the three vertices: positions, texture coordinates and normals in the order of the
// index buffer. Which of the three comes first does not matter, except for rounding.
COTAN_FUNCTION cotan_triangle cotan_triangle_of_vertices(
    cotan_vec3 p0, cotan_vec3 p1, cotan_vec3 p2, cotan_vec2 uv0, cotan_vec2 uv1, cotan_vec2 uv2,
    cotan_vec3 n0, cotan_vec3 n1, cotan_vec3 n2)
{
    return cotan_triangle_of_edges(p1 - p0, p2 - p0, uv1 - uv0, uv2 - uv0, n0 + n1 + n2);
}

// U and V that were made in model space, taken to another space by the 3x3 matrix M of a model
// transform, given by its rows. Exact for every M that can be inverted: directions are edges, and
// edges go with M; the scale is made new, as for a stretched triangle. The side is that of model space: the
// frame made anew from moved edges would differ only where a normal leans from its triangle by more
// than 90 degrees before or after, but not both.
//   side   +1, or -1 where M mirrors (its determinant is negative). The normal that goes with it is
//          the one of the inverse transpose, not turned
// Total: what is not finite, or too small, gives U = V = 0.
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

// `triangle`: the frame of U and V at a pixel. The same directions as `cotangent`; the scale is that of
// the triangle, not of the pixel. So where n leans from the triangle's own normal by an angle a, slopes
// are those of `cotangent` times a factor between cos(a) and 1. View independent.
//   n      interpolated normal, any length, on the side that U and V were made for; f.n is unit.
//          On back faces give the normal as interpolated and turn the result, or negate m.z instead:
//          with a turned n, t and b come out reversed
//   u, v   U and V in the space of n
// Total: non-finite U and V give t = b = 0.
// Source: [2013], with the sum taken before the product; see the head of this file.
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

// The same in one step, from the edges of the triangle. n also says which side is outside, so it may be
// turned on back faces. Equal to U and V of the vertices wherever n leans by less than 90 degrees from
// the triangle's own normal.
//   n             interpolated normal at the shaded point, any length; f.n is unit
//   dpdx, dpdy    edges p1 - p0 and p2 - p0
//   duvdx, duvdy  uv1 - uv0 and uv2 - uv0
// Total: a triangle without area, constant uv, non-finite input give t = b = 0.
COTAN_FUNCTION cotan_frame cotan_frame_triangle(
    cotan_vec3 n, cotan_vec3 dpdx, cotan_vec3 dpdy, cotan_vec2 duvdx, cotan_vec2 duvdy)
{
    cotan_differences d = cotan_scale_differences(dpdx, dpdy, duvdx, duvdy);
    cotan_vec3 unit = cotan_safe_normal(n, d.dpdx, d.dpdy);
    cotan_triangle vectors = cotan_triangle_of_edges(dpdx, dpdy, duvdx, duvdy, unit);
    return cotan_frame_of_triangle(unit, vectors.u, vectors.v);
}

#endif
