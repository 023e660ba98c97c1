// Cotan portable text: the frame. Include lang.h first.
//
// A frame is three covectors t, b, n. With a decoded texel m of a normal map it gives the perturbed normal
// normalize(t*m.x + b*m.y + n*m.z).
//
// Every function cotan_frame_NAME takes the same arguments:
//   n             interpolated surface normal, of unit length unless the function says that it normalises. Any space,
//                 but the same as dpdx and dpdy; the frame is in this space too
//   dpdx, dpdy    differences of position along two directions. In a pixel shader these are the screen derivatives of a
//                 camera-relative position. Do not normalise the position first: that gives an error of 11 degrees at a
//                 grazing angle of 45 degrees (docs/explanation/theory.md). Pass position - eye: the negative,
//                 eye - position, reverses t and b
//   duvdx, duvdy  differences of texture coordinates along the same two directions
// The differences may come from screen derivatives, the edges of a triangle, or the rows and columns of a raster in uv
// space.
//
// t points along increasing u, b along increasing v (not "up"). The direction of the green channel is resolved earlier,
// when the texel is decoded: see normal.h.
//
// Sources: C. Schueler, Normal Mapping without Precomputed Tangents, ShaderX5 (2006), cited as [2006]; its follow-up of
// 2013, cited as [2013]; M. Mikkelsen, Surface Gradient Based Bump Mapping Framework, JCGT 9(3) 2020, cited as [2020].

#ifndef COTAN_FRAME_H
#define COTAN_FRAME_H

struct cotan_frame {
    cotan_vec3 t; // cotangent: covector along grad u
    cotan_vec3 b; // cobitangent: covector along grad v
    cotan_vec3 n; // normal
};

// ---- guards ---------------------------------------------------------------------------------

COTAN_FUNCTION cotan_real cotan_sum_abs(cotan_vec3 a) { return abs(a.x) + abs(a.y) + abs(a.z); }
COTAN_FUNCTION cotan_real cotan_max_abs(cotan_vec3 a)
{
    return max(abs(a.x), max(abs(a.y), abs(a.z)));
}

// Returns -1 for x < 0, otherwise +1 (also for -0 and NaN).
COTAN_FUNCTION cotan_real cotan_sign(cotan_real x)
{
    return x < cotan_real(0.0) ? cotan_real(-1.0) : cotan_real(1.0);
}

// The four differences after checking: either all finite and scaled by powers of two so that the largest position
// component and the largest uv component lie in [1,2), or all zero.
struct cotan_differences {
    cotan_vec3 dpdx;
    cotan_vec3 dpdy;
    cotan_vec2 duvdx;
    cotan_vec2 duvdy;
    cotan_real p_scale;  // the factor applied to dpdx and dpdy
    cotan_real uv_scale; // the factor applied to duvdx and duvdy
};

// Scales the differences (exactly, see cotan_power_of_two_scale) and zeroes unusable ones: all four if a component of
// dpdx or dpdy is not finite or exceeds 1e37; only duvdx and duvdy if a component of these does. Frames that do not
// depend on the common scale of positions or of uv are unchanged, bit for bit.
COTAN_FUNCTION cotan_differences cotan_scale_differences(
    cotan_vec3 dpdx, cotan_vec3 dpdy, cotan_vec2 duvdx, cotan_vec2 duvdy)
{
    // A sum of magnitudes is NaN or infinite if one term is; max() would drop a NaN. Two comparisons of one kind with
    // the same number would become one with max() in OpenGL on Mesa, hence < and <=.
    bool p_usable = cotan_sum_abs(dpdx) + cotan_sum_abs(dpdy) < COTAN_HUGE;
    bool uv_usable =
        p_usable && abs(duvdx.x) + abs(duvdx.y) + abs(duvdy.x) + abs(duvdy.y) <= COTAN_HUGE;
    cotan_differences d;
    d.dpdx = p_usable ? dpdx : cotan_vec3(cotan_real(0.0), cotan_real(0.0), cotan_real(0.0));
    d.dpdy = p_usable ? dpdy : cotan_vec3(cotan_real(0.0), cotan_real(0.0), cotan_real(0.0));
    d.duvdx = uv_usable ? duvdx : cotan_vec2(cotan_real(0.0), cotan_real(0.0));
    d.duvdy = uv_usable ? duvdy : cotan_vec2(cotan_real(0.0), cotan_real(0.0));
    d.p_scale = cotan_power_of_two_scale(max(cotan_max_abs(d.dpdx), cotan_max_abs(d.dpdy)));
    d.uv_scale = cotan_power_of_two_scale(
        max(max(abs(d.duvdx.x), abs(d.duvdx.y)), max(abs(d.duvdy.x), abs(d.duvdy.y))));
    d.dpdx = d.dpdx * d.p_scale;
    d.dpdy = d.dpdy * d.p_scale;
    d.duvdx = d.duvdx * d.uv_scale;
    d.duvdy = d.duvdy * d.uv_scale;
    return d;
}

// Returns the unit vector along v. Returns `otherwise`, unchanged, if v is zero, shorter than about 1e-43 (1e-6 times
// the lower clamp of cotan_power_of_two_scale), or not finite.
COTAN_FUNCTION cotan_vec3 cotan_normalize_or(cotan_vec3 v, cotan_vec3 otherwise)
{
    bool usable = cotan_sum_abs(v) <= COTAN_HUGE;
    v = usable ? v : cotan_vec3(cotan_real(0.0), cotan_real(0.0), cotan_real(0.0));
    v = v * cotan_power_of_two_scale(cotan_max_abs(v));
    cotan_real length2 = dot(v, v);
    cotan_vec3 unit = v * cotan_inversesqrt(max(length2, cotan_real(1e-12)));
    return length2 > cotan_real(1e-12) ? unit : otherwise;
}

// Returns the interpolated normal as a unit vector. If it is zero (normals cancelled out) or not finite: the normal of
// the plane of dpdx and dpdy, and (0,0,1) if that is degenerate too. The sign of the plane normal is that of dpdx x
// dpdy; such a pixel has no better information.
// n: any length. dpdx, dpdy: finite, as cotan_scale_differences returns them.
COTAN_FUNCTION cotan_vec3 cotan_safe_normal(cotan_vec3 n, cotan_vec3 dpdx, cotan_vec3 dpdy)
{
    cotan_vec3 z = cotan_vec3(cotan_real(0.0), cotan_real(0.0), cotan_real(1.0));
    return cotan_normalize_or(n, cotan_normalize_or(cross(dpdx, dpdy), z));
}

// ---- applying a frame -----------------------------------------------------------------------

// Returns the perturbed normal normalize(t*m.x + b*m.y + n*m.z). If that sum is shorter than 1e-6 or not finite (an
// unfilled texel, m = 0; a horizontal m where t = b = 0), returns f.n unchanged: unit, or as long as the caller passed
// it.
// m: decoded texel, along (+u, +v, outwards); any length.
COTAN_FUNCTION cotan_vec3 cotan_apply(cotan_frame f, cotan_vec3 m)
{
    cotan_vec3 v = f.t * m.x + f.b * m.y + f.n * m.z;
    cotan_real length2 = dot(v, v);
    bool usable = length2 > cotan_real(1e-12) && length2 <= COTAN_HUGE;
    cotan_vec3 unit = v * cotan_inversesqrt(usable ? length2 : cotan_real(1.0));
    return usable ? unit : f.n;
}

// The inverse of cotan_apply, for baking: the unit m for which cotan_apply(f, m) gives `target`. Exact for any
// independent t, b, n; the transpose would be exact only for orthonormal frames. m.z <= 0 means that the target is
// below the horizon of the frame; it is returned as is, and the caller counts or clamps it.
// Degenerate input: three dependent (or zero) covectors give (0,0,1).
// Source: the adjugate of [t b n]; compare the remarks on decoding and encoding in MikkTSpace.
COTAN_FUNCTION cotan_vec3 cotan_encode(cotan_frame f, cotan_vec3 target)
{
    cotan_vec3 bn = cross(f.b, f.n);
    cotan_vec3 nt = cross(f.n, f.t);
    cotan_vec3 tb = cross(f.t, f.b);
    cotan_real determinant = dot(f.t, bn);
    cotan_real s = cotan_sign(determinant);
    cotan_vec3 m = cotan_vec3(dot(target, bn), dot(target, nt), dot(target, tb)) * s;
    cotan_vec3 flat_m = cotan_vec3(cotan_real(0.0), cotan_real(0.0), cotan_real(1.0));
    bool usable = abs(determinant) > cotan_real(0.0) && abs(determinant) <= COTAN_HUGE;
    cotan_vec3 unit = cotan_normalize_or(m, flat_m);
    return usable ? unit : flat_m;
}

// ---- the frames -----------------------------------------------------------------------------

// `cotangent`. The cotangent frame of [2013] with two differences:
// - It carries the sign of n . (dpdx x dpdy), so it is correct for y-up and y-down targets, both world handednesses,
//   mirrored transforms, back faces and uv-space rasters alike. [2013] is correct only where that sign is positive.
// - It is total: no input gives a NaN or an infinity.
// t and b keep their relative lengths and skew. The longer of the two has length one, so bumps do not depend on the
// scale of the object (truth S of docs/explanation/theory.md). View independent. t and b are perpendicular to n. n need
// not be unit; f.n is.
// Degenerate input: constant uv, zero or non-finite differences give t = b = 0, so that cotan_apply returns n. The same
// holds where uv vary by less than about 1e-6 of the footprint's length: the frame fades to the plain normal there.
// Where uv vary along one line only, t is parallel to b.
// Source: [2013] 'cotangent_frame'; the sign and the guards are ours.
COTAN_FUNCTION cotan_frame cotan_frame_cotangent(
    cotan_vec3 n, cotan_vec3 dpdx, cotan_vec3 dpdy, cotan_vec2 duvdx, cotan_vec2 duvdy)
{
    cotan_differences d = cotan_scale_differences(dpdx, dpdy, duvdx, duvdy);
    cotan_frame f;
    f.n = cotan_safe_normal(n, d.dpdx, d.dpdy);
    cotan_vec3 dpdy_perp = cross(d.dpdy, f.n);
    cotan_vec3 dpdx_perp = cross(f.n, d.dpdx);
    cotan_vec3 t = dpdy_perp * d.duvdx.x + dpdx_perp * d.duvdy.x;
    cotan_vec3 b = dpdy_perp * d.duvdx.y + dpdx_perp * d.duvdy.y;
    cotan_real longest2 = max(dot(t, t), dot(b, b));
    cotan_real scale = cotan_inversesqrt(max(longest2, cotan_real(1e-12)));
    scale = scale * cotan_sign(dot(d.dpdx, dpdy_perp));
    f.t = t * scale;
    f.b = b * scale;
    return f;
}

// `orthonormal`: t along dP/du in the plane of n, b = +-n x t. The best frame without stored tangents for maps that
// were baked for MikkTSpace. Exact where uv are conformal; a constant error where they are anisotropic. Total, like
// `cotangent`; n need not be unit, f.n is.
// Degenerate input: uv without area (constant, or along one line), zero or non-finite differences give t = b = 0.
// Source: [2020], the basis built from derivatives.
COTAN_FUNCTION cotan_frame cotan_frame_orthonormal(
    cotan_vec3 n, cotan_vec3 dpdx, cotan_vec3 dpdy, cotan_vec2 duvdx, cotan_vec2 duvdy)
{
    cotan_differences d = cotan_scale_differences(dpdx, dpdy, duvdx, duvdy);
    cotan_frame f;
    f.n = cotan_safe_normal(n, d.dpdx, d.dpdy);
    cotan_vec3 sigma_x = d.dpdx - f.n * dot(d.dpdx, f.n);
    cotan_vec3 sigma_y = d.dpdy - f.n * dot(d.dpdy, f.n);
    cotan_real side = cotan_sign(dot(d.dpdy, cross(f.n, d.dpdx)));
    cotan_real determinant = d.duvdx.x * d.duvdy.y - d.duvdx.y * d.duvdy.x;
    cotan_real s = cotan_sign(determinant);
    cotan_vec3 t = (sigma_x * d.duvdy.y - sigma_y * d.duvdx.y) * s;
    cotan_vec3 zero = cotan_vec3(cotan_real(0.0), cotan_real(0.0), cotan_real(0.0));
    f.t = abs(determinant) > cotan_real(0.0) ? cotan_normalize_or(t, zero) : zero;
    f.b = cross(f.n, f.t) * (s * side);
    return f;
}

// `gradient`: the true, metric surface gradients of u and v: |t| is the change of u per unit of length. Bumps have a
// fixed height in world units, so they fade as the object grows (truth E of docs/explanation/theory.md). t/|t| is that
// of `cotangent`; only the scale differs: 1 / (n . (dpdx x dpdy)). Total; n need not be unit, f.n is.
// Degenerate input: zero area, n in the plane of the face (where the division would overflow), constant uv or
// non-finite differences give t = b = 0.
// Source: [2020] section 3, after Blinn 1978, keeping the sign of the determinant.
COTAN_FUNCTION cotan_frame cotan_frame_gradient(
    cotan_vec3 n, cotan_vec3 dpdx, cotan_vec3 dpdy, cotan_vec2 duvdx, cotan_vec2 duvdy)
{
    cotan_differences d = cotan_scale_differences(dpdx, dpdy, duvdx, duvdy);
    cotan_frame f;
    f.n = cotan_safe_normal(n, d.dpdx, d.dpdy);
    cotan_vec3 dpdy_perp = cross(d.dpdy, f.n);
    cotan_vec3 dpdx_perp = cross(f.n, d.dpdx);
    cotan_real determinant = dot(d.dpdx, dpdy_perp);
    bool usable = abs(determinant) > cotan_real(1e-12);
    // Undoes both scales with one factor: gradients scale with uv / position.
    cotan_real scale = d.p_scale / (usable ? determinant : cotan_real(1.0)) / d.uv_scale;
    usable = usable && abs(scale) <= COTAN_HUGE;
    scale = usable ? scale : cotan_real(0.0);
    f.t = (dpdy_perp * d.duvdx.x + dpdx_perp * d.duvdy.x) * scale;
    f.b = (dpdy_perp * d.duvdx.y + dpdx_perp * d.duvdy.y) * scale;
    return f;
}

// `exact`: gradients of u and v over a whole triangle, from its edges instead of screen derivatives, projected
// orthogonally onto the plane of n; the longer of t and b has length one. More accurate than differences over a small
// pixel wherever vertex data can be fetched: 2.7e-6 degrees in float at every distance and footprint. Total; n need not
// be unit, f.n is.
//   n             interpolated normal at the shaded point
//   dpdx, dpdy    edges p1 - p0 and p2 - p0
//   duvdx, duvdy  uv1 - uv0 and uv2 - uv0
// Degenerate input: a triangle without area, constant uv, non-finite input give t = b = 0.
// Source: [2006], the equation of the tangent frame applied to the triangle instead of the pixel; the projection is
// ours.
COTAN_FUNCTION cotan_frame cotan_frame_exact(
    cotan_vec3 n, cotan_vec3 dpdx, cotan_vec3 dpdy, cotan_vec2 duvdx, cotan_vec2 duvdy)
{
    cotan_differences d = cotan_scale_differences(dpdx, dpdy, duvdx, duvdy);
    cotan_frame f;
    f.n = cotan_safe_normal(n, d.dpdx, d.dpdy);
    cotan_vec3 face = cross(d.dpdx, d.dpdy);
    cotan_vec3 r0 = cross(d.dpdy, face);
    cotan_vec3 r1 = cross(face, d.dpdx);
    cotan_vec3 t = r0 * d.duvdx.x + r1 * d.duvdy.x;
    cotan_vec3 b = r0 * d.duvdx.y + r1 * d.duvdy.y;
    t = t - f.n * dot(t, f.n);
    b = b - f.n * dot(b, f.n);
    cotan_real largest = max(cotan_max_abs(t), cotan_max_abs(b));
    cotan_real rescale = cotan_power_of_two_scale(largest);
    t = t * rescale;
    b = b * rescale;
    cotan_real longest2 = max(dot(t, t), dot(b, b));
    bool usable = longest2 > cotan_real(1e-12);
    cotan_real scale = cotan_inversesqrt(usable ? longest2 : cotan_real(1.0));
    scale = usable ? scale : cotan_real(0.0);
    f.t = t * scale;
    f.b = b * scale;
    return f;
}

// ---- frames from vertex attributes ----------------------------------------------------------

// `smooth`: from cotangents averaged at the vertices and interpolated, then projected onto the plane of n; the longer
// of t and b has length one. Total; n need not be unit, f.n is.
//   t, b   interpolated covectors, any common scale, same space as n
// Degenerate input: t = b = 0 where both vanish.
COTAN_FUNCTION cotan_frame cotan_frame_smooth(cotan_vec3 n, cotan_vec3 t, cotan_vec3 b)
{
    cotan_vec3 zero = cotan_vec3(cotan_real(0.0), cotan_real(0.0), cotan_real(0.0));
    cotan_frame f;
    f.n = cotan_safe_normal(n, zero, zero);
    bool finite = cotan_sum_abs(t) + cotan_sum_abs(b) <= COTAN_HUGE;
    t = finite ? t : cotan_vec3(cotan_real(0.0), cotan_real(0.0), cotan_real(0.0));
    b = finite ? b : cotan_vec3(cotan_real(0.0), cotan_real(0.0), cotan_real(0.0));
    cotan_real rescale = cotan_power_of_two_scale(max(cotan_max_abs(t), cotan_max_abs(b)));
    t = t * rescale;
    b = b * rescale;
    t = t - f.n * dot(t, f.n);
    b = b - f.n * dot(b, f.n);
    cotan_real longest2 = max(dot(t, t), dot(b, b));
    cotan_real scale = cotan_inversesqrt(max(longest2, cotan_real(1e-12)));
    f.t = t * scale;
    f.b = b * scale;
    return f;
}

// `vertex`: classic tangent space. The per-vertex tangent and normal are interpolated and made orthonormal again in
// every pixel; the bitangent is alongV * n x t. Total; n need not be unit, f.n is.
//   t        interpolated tangent, any length
//   alongV   +1 or -1, chosen so that alongV * n x t points along +v. For a glTF TANGENT pass -w: there w * n x t
//            points up the image, and v runs down
// Degenerate input: a tangent that is zero or parallel to n gives t = b = 0.
COTAN_FUNCTION cotan_frame cotan_frame_vertex(cotan_vec3 n, cotan_vec3 t, cotan_real alongV)
{
    cotan_vec3 zero = cotan_vec3(cotan_real(0.0), cotan_real(0.0), cotan_real(0.0));
    cotan_frame f;
    f.n = cotan_safe_normal(n, zero, zero);
    t = cotan_normalize_or(t, zero);
    f.t = cotan_normalize_or(t - f.n * dot(t, f.n), zero);
    f.b = cross(f.n, f.t) * alongV;
    return f;
}

// `mikktspace`: uses tangents as MikkTSpace specifies: interpolated n and t are not renormalised, and the bitangent is
// alongV * n x t in every pixel. cotan_apply normalises the result.
//   n, t     interpolated, not normalised
//   alongV   as in cotan_frame_vertex: -w of a glTF TANGENT
// Degenerate input: zero tangents give t = b = 0; cotan_apply then returns n as given.
// Source: M. Mikkelsen, mikktspace.h.
COTAN_FUNCTION cotan_frame cotan_frame_mikktspace(cotan_vec3 n, cotan_vec3 t, cotan_real alongV)
{
    cotan_frame f;
    f.t = t;
    f.b = cross(n, t) * alongV;
    f.n = n;
    return f;
}

// `area_weighted`: the same with the tangents of meshoptimizer, which weight triangles by their area too.
COTAN_FUNCTION cotan_frame cotan_frame_area_weighted(cotan_vec3 n, cotan_vec3 t, cotan_real alongV)
{
    return cotan_frame_mikktspace(n, t, alongV);
}

#endif
