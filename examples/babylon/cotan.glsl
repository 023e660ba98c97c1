// Normal mapping, frame `cotangent` (total form), for GLSL ES 3.00 (WebGL 2).
// Written by cotan shader from the portable text of Cotan; MIT licence.
//
// Normal map: three channels, (255c - 128)/127, green against increasing v.
//
// Needs from the caller:
//   normal     interpolated surface normal; any space, the same for all vectors
//   position   camera-relative (world axes, origin at the eye), interpolated, NOT normalised;
//              normalising it first gives an error of 11 degrees at a grazing angle of 45 degrees
//   uv         those of the normal map
//   derivatives of position and uv: taken here by dFdx and dFdy. Interpolate both alike, not
//              at centroids; call it before any discard, if or loop that differs between pixels
//
// Call:
//   vec3 n = cotan_perturb_normal(normal, position, uv, texture(normal_map, uv).xyz);
// It returns the perturbed normal, unit, in the space of the arguments.
//
// Limits:
//   Total: no input gives NaN; where there is no frame (constant uv, no area, non-finite
//   differences) the result is the unit interpolated normal.
//   Right for y-up and y-down targets, both handednesses, mirrored uv and transforms, and back
//   faces, with no uniform and no front-face flag.
//   In float, the error is 0.002 degrees for footprints of 1e-3 of the distance to the eye, and
//   0.12 degrees for 1e-5.
//   On flat-shaded uv the frame is constant per triangle: on coarse curved meshes it steps at
//   edges (a sphere of 32 segments: 1.1 degrees in the mean).
//   The shader must say: precision highp float; precision highp int;
//
// After:
//   [2006] C. Schueler, Normal Mapping without Precomputed Tangents, ShaderX5, 2006
//   [2013] C. Schueler, Followup: Normal Mapping Without Precomputed Tangents, 2013

struct cotan_frame
{
    vec3 t; // cotangent: covector along grad u
    vec3 b; // cobitangent: covector along grad v
    vec3 n; // normal
};

// The four differences after checking: either all finite and scaled by powers of two so that the largest position
// component and the largest uv component lie in [1,2), or all zero.
struct cotan_differences
{
    vec3 dpdx;
    vec3 dpdy;
    vec2 duvdx;
    vec2 duvdy;
    float p_scale; // the factor applied to dpdx and dpdy
    float uv_scale; // the factor applied to duvdx and duvdy
};

// Returns the power of two s for which m*s lies in [1,2), after clamping m to [1e-37, 1e37]. Multiplying by s is exact,
// so formulas made of products give the same bits with scaled values, but no longer underflow or overflow.
// m: any magnitude (zero gives the largest scale), not NaN.
float cotan_power_of_two_scale(float m)
{
    m = min(max(m, 1e-37), 1e37);
    uint exponent = floatBitsToUint(m) & 0x7f800000u;
    return uintBitsToFloat((254u << 23) - exponent);
}

// The signed value of a stored component, in [-1,1].
float cotan_expand(float c)
{
    float x = c * (255.0 / 127.0) - (128.0 / 127.0);
    return max(x, -1.0);
}

// The decoded texel: normal along (+u, +v, outwards). Not unit in general.
// texel: as sampled; two-channel maps use x and y only.
vec3 cotan_decode(vec3 texel)
{
    float x = cotan_expand(texel.x);
    float y = cotan_expand(texel.y);
    float z = cotan_expand(texel.z);
    vec3 m = vec3(x, y, z);
    return vec3(m.x, -m.y, m.z);
}

float cotan_sum_abs(vec3 a)
{
    return abs(a.x) + abs(a.y) + abs(a.z);
}

float cotan_max_abs(vec3 a)
{
    return max(abs(a.x), max(abs(a.y), abs(a.z)));
}

// Returns -1 for x < 0, otherwise +1 (also for -0 and NaN).
float cotan_sign(float x)
{
    return x < 0.0 ? -1.0 : 1.0;
}

// Scales the differences (exactly, see cotan_power_of_two_scale) and zeroes unusable ones: all four if a component of
// dpdx or dpdy is not finite or exceeds 1e37; only duvdx and duvdy if a component of these does. Frames that do not
// depend on the common scale of positions or of uv are unchanged, bit for bit.
cotan_differences cotan_scale_differences(vec3 dpdx, vec3 dpdy, vec2 duvdx, vec2 duvdy)
{
    // A sum of magnitudes is NaN or infinite if one term is; max() would drop a NaN. Two comparisons of one kind with
    // the same number would become one with max() in OpenGL on Mesa, hence < and <=.
    bool p_usable = cotan_sum_abs(dpdx) + cotan_sum_abs(dpdy) < 1e37;
    bool uv_usable = p_usable && abs(duvdx.x) + abs(duvdx.y) + abs(duvdy.x) + abs(duvdy.y) <= 1e37;
    cotan_differences d;
    d.dpdx = p_usable ? dpdx : vec3(0.0, 0.0, 0.0);
    d.dpdy = p_usable ? dpdy : vec3(0.0, 0.0, 0.0);
    d.duvdx = uv_usable ? duvdx : vec2(0.0, 0.0);
    d.duvdy = uv_usable ? duvdy : vec2(0.0, 0.0);
    d.p_scale = cotan_power_of_two_scale(max(cotan_max_abs(d.dpdx), cotan_max_abs(d.dpdy)));
    d.uv_scale = cotan_power_of_two_scale(max(max(abs(d.duvdx.x), abs(d.duvdx.y)),
        max(abs(d.duvdy.x), abs(d.duvdy.y))));
    d.dpdx = d.dpdx * d.p_scale;
    d.dpdy = d.dpdy * d.p_scale;
    d.duvdx = d.duvdx * d.uv_scale;
    d.duvdy = d.duvdy * d.uv_scale;
    return d;
}

// Returns the unit vector along v. Returns `otherwise`, unchanged, if v is zero, shorter than about 1e-43 (1e-6 times
// the lower clamp of cotan_power_of_two_scale), or not finite.
vec3 cotan_normalize_or(vec3 v, vec3 otherwise)
{
    bool usable = cotan_sum_abs(v) <= 1e37;
    v = usable ? v : vec3(0.0, 0.0, 0.0);
    v = v * cotan_power_of_two_scale(cotan_max_abs(v));
    float length2 = dot(v, v);
    vec3 unit = v * inversesqrt(max(length2, 1e-12));
    return length2 > 1e-12 ? unit : otherwise;
}

// Returns the interpolated normal as a unit vector. If it is zero (normals cancelled out) or not finite: the normal of
// the plane of dpdx and dpdy, and (0,0,1) if that is degenerate too. The sign of the plane normal is that of dpdx x
// dpdy; such a pixel has no better information.
// n: any length. dpdx, dpdy: finite, as cotan_scale_differences returns them.
vec3 cotan_safe_normal(vec3 n, vec3 dpdx, vec3 dpdy)
{
    vec3 z = vec3(0.0, 0.0, 1.0);
    return cotan_normalize_or(n, cotan_normalize_or(cross(dpdx, dpdy), z));
}

// Returns the perturbed normal normalize(t*m.x + b*m.y + n*m.z). If that sum is shorter than 1e-6 or not finite (an
// unfilled texel, m = 0; a horizontal m where t = b = 0), returns f.n unchanged: unit, or as long as the caller passed
// it.
// m: decoded texel, along (+u, +v, outwards); any length.
vec3 cotan_apply(cotan_frame f, vec3 m)
{
    vec3 v = f.t * m.x + f.b * m.y + f.n * m.z;
    float length2 = dot(v, v);
    bool usable = length2 > 1e-12 && length2 <= 1e37;
    vec3 unit = v * inversesqrt(usable ? length2 : 1.0);
    return usable ? unit : f.n;
}

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
cotan_frame cotan_frame_cotangent(vec3 n, vec3 dpdx, vec3 dpdy, vec2 duvdx, vec2 duvdy)
{
    cotan_differences d = cotan_scale_differences(dpdx, dpdy, duvdx, duvdy);
    cotan_frame f;
    f.n = cotan_safe_normal(n, d.dpdx, d.dpdy);
    vec3 dpdy_perp = cross(d.dpdy, f.n);
    vec3 dpdx_perp = cross(f.n, d.dpdx);
    vec3 t = dpdy_perp * d.duvdx.x + dpdx_perp * d.duvdy.x;
    vec3 b = dpdy_perp * d.duvdx.y + dpdx_perp * d.duvdy.y;
    float longest2 = max(dot(t, t), dot(b, b));
    float scale = inversesqrt(max(longest2, 1e-12));
    scale = scale * cotan_sign(dot(d.dpdx, dpdy_perp));
    f.t = t * scale;
    f.b = b * scale;
    return f;
}

// The perturbed normal, unit.
// normal: interpolated.
// dpdx, dpdy: differences of position along any two directions, in normal's space.
// duvdx, duvdy: differences of uv along the same two.
// texel: the normal map as sampled.
vec3 cotan_perturb_normal_from_differences(vec3 normal, vec3 dpdx, vec3 dpdy, vec2 duvdx,
    vec2 duvdy, vec3 texel)
{
    vec3 m = cotan_decode(texel);
    cotan_frame frame = cotan_frame_cotangent(normal, dpdx, dpdy, duvdx, duvdy);
    return cotan_apply(frame, m);
}

// The same, taking the screen derivatives itself: call it in uniform control flow, before any
// branch or discard that differs within a 2x2 quad.
// position: camera-relative, interpolated, not normalised.
vec3 cotan_perturb_normal(vec3 normal, vec3 position, vec2 uv, vec3 texel)
{
    return cotan_perturb_normal_from_differences(normal, dFdx(position), dFdy(position), dFdx(uv),
        dFdy(uv), texel);
}
