// Cotan portable text: frame and texel in one step, for shaders where instructions count. Include lang.h first; no
// other file is needed.
//
//   cotan_perturb_NAME(n, dpdx, dpdy, duvdx, duvdy, m)  =  cotan_apply(cotan_frame_NAME(...), m)
//
// up to rounding, for well-conditioned input; frame.h has the definition and explains the arguments. n is the
// interpolated normal and need not be unit: its length cancels, which is cheaper than normalising it. m is the decoded
// texel. The result is unit.
//
// All but cotan_perturb_cotangent_seen carry the sign of n . (dpdx x dpdy) and need no front-face flag. None of them
// gives a NaN for constant uv, zero differences, a footprint without area or an empty texel (m = 0). Unlike the frames,
// they are not total. In float they agree with the frames in double to 0.01 degrees if
// - the input is finite, and the length of n is between 0.01 and 100;
// - the longest position difference and the longest uv difference lie between 1e-9 and 1e6, and their product between
//   1e-12 and 1e5. With metres and a map repeated every millimetre to every kilometre, this includes footprints of a
//   micrometre to a hundred metres;
// - the footprint is no sliver: its area is at least a tenth of its longest difference squared, in positions and in uv,
//   and n is at most 80 degrees from its normal. Down to a fiftieth the product must be at least 1e-11; thinner
//   footprints lose digits, as they do in the frames, and more of the range.
// Outside of these limits small input weakens or removes bumps, and large input overflows. Non-finite input and n
// shorter than 0.01 have no defined result (it may be NaN).
// Where a frame has t = b = 0 (constant uv), the result is n. Each function says what it returns where uv vary along
// one line only, or where the footprint has no area.

#ifndef COTAN_FUSED_H
#define COTAN_FUSED_H

// Added to m.z: too small to change a normal, but it gives n where all other terms vanish.
#define COTAN_FUSED_REST cotan_real(1e-12)

// `cotangent`, fused. Where uv vary along one line only, or for a footprint without area: like the frame (t parallel to
// b), except for the sign, which depends on rounding.
// Method: with t' and b' computed from the unnormalised n, t = t'/|n|. Multiplied by |n|, the sum is
// t' m.x |n|/L + b' m.y |n|/L + n m.z, where L is the length of the longer of t' and b'.
COTAN_FUNCTION cotan_vec3 cotan_perturb_cotangent(
    cotan_vec3 n, cotan_vec3 dpdx, cotan_vec3 dpdy, cotan_vec2 duvdx, cotan_vec2 duvdy, cotan_vec3 m)
{
    cotan_vec3 dpdy_perp = cross(dpdy, n);
    cotan_vec3 dpdx_perp = cross(n, dpdx);
    cotan_vec3 t = dpdy_perp * duvdx.x + dpdx_perp * duvdy.x;
    cotan_vec3 b = dpdy_perp * duvdx.y + dpdx_perp * duvdy.y;
    cotan_real n2 = dot(n, n);
    cotan_real longest2 = max(max(dot(t, t), dot(b, b)), cotan_real(1e-33));
    cotan_real scale = n2 * cotan_inversesqrt(n2 * longest2);
    scale = cotan_copy_sign(scale, dot(dpdx, dpdy_perp));
    cotan_vec3 v = t * (m.x * scale) + b * (m.y * scale) + n * (m.z + COTAN_FUSED_REST);
    return v * cotan_inversesqrt(dot(v, v));
}

// `cotangent` with an area-normalised scale, cheaper: t and b are divided by sqrt(|t x b|), the geometric mean of their
// lengths if they are perpendicular, instead of by the longer length. frame.h has no frame of this name. All slopes are
// those of `cotangent` times
//     k = sqrt(L^2 / |t x b|)  >=  1,    where L is the longer of |t| and |b|,
// with direction, skew and relative lengths unchanged. On conformal uv (square texels, any rotation or mirroring) k = 1
// and nothing changes. On uv stretched a:1, k = sqrt(a) (2:1: slopes are 1.41 times as steep); sheared by an angle s,
// k = 1/cos(s) (45 degrees: 1.41). Like `cotangent` it does not depend on the size of the object or of the pixel. Read
// a map only with the scale that it was made for. Where uv vary along one line only, or the footprint has no area, k
// grows without bound, and the result tends towards a normal in the surface. An additional limit: the product of the
// differences times |n| is at most 1e5.
COTAN_FUNCTION cotan_vec3 cotan_perturb_cotangent_area(
    cotan_vec3 n, cotan_vec3 dpdx, cotan_vec3 dpdy, cotan_vec2 duvdx, cotan_vec2 duvdy, cotan_vec3 m)
{
    cotan_vec3 dpdy_perp = cross(dpdy, n);
    cotan_vec3 dpdx_perp = cross(n, dpdx);
    cotan_real m_x = duvdx.x * m.x + duvdx.y * m.y;
    cotan_real m_y = duvdy.x * m.x + duvdy.y * m.y;
    cotan_real determinant = dot(dpdx, dpdy_perp);
    cotan_real uv_area = duvdx.x * duvdy.y - duvdx.y * duvdy.x;
    // t' x b' = n * determinant * uv_area, for t' and b' computed from the unnormalised n.
    cotan_real area = abs(determinant * uv_area) * cotan_inversesqrt(dot(n, n));
    cotan_real scale = cotan_inversesqrt(max(area, cotan_real(1e-27)));
    scale = cotan_copy_sign(scale, determinant);
    cotan_vec3 v = dpdy_perp * (m_x * scale) + dpdx_perp * (m_y * scale)
        + n * (m.z + COTAN_FUSED_REST);
    return v * cotan_inversesqrt(dot(v, v));
}

// `cotangent` without its sign and with the scale of `triangle`: the cheapest function that handles stretch and shear.
// n must be on the visible side of the surface: flipped on back faces, as for lighting.
//   side   +1 if cross(dpdx, dpdy) of visible surfaces points towards the viewer, otherwise -1; one constant for
//          everything drawn. In right-handed spaces -1 where rows of pixels run down (Vulkan, Direct3D, Metal, WebGPU),
//          +1 where they run up (OpenGL, WebGL); the opposite in left-handed spaces and in mirrored views
// Equal to the frame of triangle.h with that n: cotan_frame_triangle(n, dpdx, dpdy, duvdx, duvdy). Where n is at an
// angle a to the triangle's own normal, slopes are those of `cotangent` times a factor between cos(a) and 1. With n on
// the other side, bumps become dents.
// Method: n x U and n x V are combined into one cross product, of their sum, and the length of n cancels. Multiplying
// m.z by the scale, instead of dividing m.x and m.y by it, needs no guard. An additional limit: the longest position
// difference times the longest uv difference times m.z is at least 1e-11.
COTAN_FUNCTION cotan_vec3 cotan_perturb_cotangent_seen(cotan_vec3 n, cotan_vec3 dpdx, cotan_vec3 dpdy,
    cotan_vec2 duvdx, cotan_vec2 duvdy, cotan_vec3 m, cotan_real side)
{
    cotan_vec3 u = dpdx * duvdy.x - dpdy * duvdx.x;
    cotan_vec3 v = dpdx * duvdy.y - dpdy * duvdx.y;
    cotan_real longest = sqrt(max(dot(u, u), dot(v, v)));
    cotan_vec3 r = n * (m.z * longest + cotan_real(2e-17)) // like COTAN_FUSED_REST, for smaller sums
        + cross(n, u * (m.x * side) + v * (m.y * side));
    return r * cotan_inversesqrt(dot(r, r));
}

// `gradient`, fused; the final normalisation replaces the division by the determinant. A footprint without area gives a
// normal in the surface, the limit of its slope; the frame gives n.
// An additional limit: the footprint's area |dpdx x dpdy| times |n| times m.z is at least 1e-10, in units of the
// positions; below that, bumps fade.
COTAN_FUNCTION cotan_vec3 cotan_perturb_gradient(
    cotan_vec3 n, cotan_vec3 dpdx, cotan_vec3 dpdy, cotan_vec2 duvdx, cotan_vec2 duvdy, cotan_vec3 m)
{
    cotan_vec3 dpdy_perp = cross(dpdy, n);
    cotan_vec3 dpdx_perp = cross(n, dpdx);
    cotan_real determinant = dot(dpdx, dpdy_perp);
    cotan_real scale = cotan_copy_sign(sqrt(dot(n, n)), determinant);
    cotan_real m_x = duvdx.x * m.x + duvdx.y * m.y;
    cotan_real m_y = duvdy.x * m.x + duvdy.y * m.y;
    cotan_vec3 v = dpdy_perp * (m_x * scale) + dpdx_perp * (m_y * scale)
        + n * (m.z * abs(determinant) + cotan_real(1e-15)); // like COTAN_FUSED_REST, for smaller sums
    return v * cotan_inversesqrt(dot(v, v));
}

// `orthonormal`, fused. uv without area give n, like the frame. A footprint without area: like the frame, except for
// the sign of b, which depends on rounding.
// Method: b' = n x (dP/du), t' = b' x n; |t'| = |n| |b'|.
COTAN_FUNCTION cotan_vec3 cotan_perturb_orthonormal(
    cotan_vec3 n, cotan_vec3 dpdx, cotan_vec3 dpdy, cotan_vec2 duvdx, cotan_vec2 duvdy, cotan_vec3 m)
{
    cotan_vec3 b = cross(n, dpdx * duvdy.y - dpdy * duvdx.y);
    cotan_vec3 t = cross(b, n);
    cotan_real uv_area = duvdx.x * duvdy.y - duvdx.y * duvdy.x;
    cotan_real side = dot(n, cross(dpdx, dpdy));
    cotan_real scale = cotan_inversesqrt(max(dot(b, b), cotan_real(1e-36)));
    scale = abs(uv_area) > cotan_real(0.0) ? scale : cotan_real(0.0);
    cotan_real m_x = m.x * cotan_copy_sign(scale, uv_area);
    cotan_real m_y = m.y * sqrt(dot(n, n)) * cotan_copy_sign(scale, side);
    cotan_vec3 v = t * m_x + b * m_y + n * (m.z + COTAN_FUSED_REST);
    return v * cotan_inversesqrt(dot(v, v));
}

// ---- over several uv sets -----------------------------------------------------------------------
//
// `cotangent` for maps over several uv sets, whose bumps add as surface gradients. Equal to cotan_resolve_gradient of
// the sum of cotan_gradient_of_slope (gradient.h) up to rounding, within the limits above:
//     cotan_footprint f = cotan_footprint_of(n, dpdx, dpdy);
//     cotan_vec2 slopes = cotan_footprint_slope(f, duv0dx, duv0dy, m0) + cotan_footprint_slope(f, duv1dx, duv1dy, m1);
//     cotan_vec3 r = cotan_perturb_footprint(f, slopes);
// Method: t = along_x duvdx.u + along_y duvdy.u, and b likewise with v. The sets differ only in the lengths of t and b,
// which follow from three dot products of along_x and along_y, computed once.

struct cotan_footprint {
    cotan_vec3 n;
    cotan_vec3 along_x;
    cotan_vec3 along_y;
    cotan_real xx; // dot(along_x, along_x)
    cotan_real xy; // twice dot(along_x, along_y)
    cotan_real yy; // dot(along_y, along_y)
    cotan_real scale; // the length of n, with the sign of n . (dpdx x dpdy)
};

// Returns the part that all uv sets share.
//   n            interpolated normal, any length
//   dpdx, dpdy   differences of position, in the space of n
COTAN_FUNCTION cotan_footprint cotan_footprint_of(cotan_vec3 n, cotan_vec3 dpdx, cotan_vec3 dpdy)
{
    cotan_footprint f;
    f.n = n;
    f.along_x = cross(dpdy, n);
    f.along_y = cross(n, dpdx);
    f.xx = dot(f.along_x, f.along_x);
    f.xy = cotan_real(2.0) * dot(f.along_x, f.along_y);
    f.yy = dot(f.along_y, f.along_y);
    f.scale = cotan_copy_sign(sqrt(dot(n, n)), dot(dpdx, f.along_x));
    return f;
}

// Returns the slope of one map along the two vectors of the footprint; slopes of several maps add. Clamped to 128, as
// in cotan_slope_of_texel.
//   duvdx, duvdy   differences of this uv set
//   m              decoded texel of its map, any length; m = 0 gives 0
COTAN_FUNCTION cotan_vec2 cotan_footprint_slope(cotan_footprint f, cotan_vec2 duvdx, cotan_vec2 duvdy, cotan_vec3 m)
{
    cotan_real t2 = duvdx.x * (f.xx * duvdx.x + f.xy * duvdy.x) + f.yy * duvdy.x * duvdy.x;
    cotan_real b2 = duvdx.y * (f.xx * duvdx.y + f.xy * duvdy.y) + f.yy * duvdy.y * duvdy.y;
    cotan_real z = max(m.z, max(abs(m.x), abs(m.y)) * cotan_real(1.0 / 128.0));
    cotan_real scale = cotan_inversesqrt(max(max(t2, b2) * (z * z), cotan_real(1e-33)));
    return cotan_vec2(duvdx.x * m.x + duvdx.y * m.y, duvdy.x * m.x + duvdy.y * m.y) * scale;
}

// Returns the perturbed normal, unit, for the sum of the slopes.
COTAN_FUNCTION cotan_vec3 cotan_perturb_footprint(cotan_footprint f, cotan_vec2 slopes)
{
    cotan_vec3 v = f.n + (f.along_x * slopes.x + f.along_y * slopes.y) * f.scale;
    return v * cotan_inversesqrt(dot(v, v));
}

// ---- from vectors that a triangle or its vertices hold ---------------------------------------
//
// Without differences: another stage makes U and V, so only the pixel's part is here. Valid for n of length 0.01 to
// 100, and for U and V (t and b) of length at most 1000. m = 0 gives n. On back faces leave n as interpolated and
// negate m.z; the result then points to the visible side.

// `triangle`, fused: U and V of triangle.h are the same at all pixels of the triangle. The length of n cancels, so n is
// not normalised.
//   u, v   U and V in the space of n, as cotan_triangle_of_edges returns them
COTAN_FUNCTION cotan_vec3 cotan_perturb_triangle(
    cotan_vec3 n, cotan_vec3 u, cotan_vec3 v, cotan_vec3 m)
{
    cotan_vec3 w = u * m.x + v * m.y;
    // cross(n, w), written out and added last, so that compilers fold it into multiply-adds and latency is shorter.
    cotan_vec3 r = n * (m.z + COTAN_FUSED_REST) + cotan_vec3(n.y, n.z, n.x) * cotan_vec3(w.z, w.x, w.y)
        - cotan_vec3(n.z, n.x, n.y) * cotan_vec3(w.y, w.z, w.x);
    return r * cotan_inversesqrt(dot(r, r));
}

// `triangle` with the scale of `cotangent`: divided by the longer of t and b at the pixel. Equal to
// cotan_perturb_cotangent also where n is far from the triangle's own normal. U and V may have any common length from
// 1e-6 to 1000.
COTAN_FUNCTION cotan_vec3 cotan_perturb_triangle_scaled(
    cotan_vec3 n, cotan_vec3 u, cotan_vec3 v, cotan_vec3 m)
{
    cotan_vec3 t = cross(n, u);
    cotan_vec3 b = cross(n, v);
    cotan_real n2 = dot(n, n);
    cotan_real longest2 = max(max(dot(t, t), dot(b, b)), cotan_real(1e-20));
    cotan_real scale = n2 * cotan_inversesqrt(n2 * longest2);
    cotan_vec3 r = t * (m.x * scale) + b * (m.y * scale) + n * (m.z + COTAN_FUSED_REST);
    return r * cotan_inversesqrt(dot(r, r));
}

// `smooth`, fused: uses t, b and n as interpolated, without making them perpendicular or unit again. The vertices must
// hold unit normals, and t and b scaled so that the longer has length 1. Second-order accurate like the total form; its
// error is up to 1.4 times that of the total form.
COTAN_FUNCTION cotan_vec3 cotan_perturb_smooth(
    cotan_vec3 n, cotan_vec3 t, cotan_vec3 b, cotan_vec3 m)
{
    cotan_vec3 r = t * m.x + b * m.y + n * (m.z + COTAN_FUSED_REST);
    return r * cotan_inversesqrt(dot(r, r));
}

#endif
