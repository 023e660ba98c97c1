// Written by scripts/three-shader-text from what `cotan shader` prints. Not to be edited.
export const essl = {
cotangent: `// Normal mapping, frame \`cotangent\` (total form), for GLSL ES 3.00 (WebGL 2).
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

// Returns the unit vector along v. Returns \`otherwise\`, unchanged, if v is zero, shorter than about 1e-43 (1e-6 times
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

// \`cotangent\`. The cotangent frame of [2013] with two differences:
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
`,
orthonormal: `// Normal mapping, frame \`orthonormal\` (total form), for GLSL ES 3.00 (WebGL 2).
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
//   edges.
//   The shader must say: precision highp float; precision highp int;
//
// After:
//   [2006] C. Schueler, Normal Mapping without Precomputed Tangents, ShaderX5, 2006
//   [2013] C. Schueler, Followup: Normal Mapping Without Precomputed Tangents, 2013
//   [2020] M. Mikkelsen, Surface Gradient Based Bump Mapping Framework, JCGT 9(3), 2020

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

// Returns the unit vector along v. Returns \`otherwise\`, unchanged, if v is zero, shorter than about 1e-43 (1e-6 times
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

// \`orthonormal\`: t along dP/du in the plane of n, b = +-n x t. The best frame without stored tangents for maps that
// were baked for MikkTSpace. Exact where uv are conformal; a constant error where they are anisotropic. Total, like
// \`cotangent\`; n need not be unit, f.n is.
// Degenerate input: uv without area (constant, or along one line), zero or non-finite differences give t = b = 0.
// Source: [2020], the basis built from derivatives.
cotan_frame cotan_frame_orthonormal(vec3 n, vec3 dpdx, vec3 dpdy, vec2 duvdx, vec2 duvdy)
{
    cotan_differences d = cotan_scale_differences(dpdx, dpdy, duvdx, duvdy);
    cotan_frame f;
    f.n = cotan_safe_normal(n, d.dpdx, d.dpdy);
    vec3 sigma_x = d.dpdx - f.n * dot(d.dpdx, f.n);
    vec3 sigma_y = d.dpdy - f.n * dot(d.dpdy, f.n);
    float side = cotan_sign(dot(d.dpdy, cross(f.n, d.dpdx)));
    float determinant = d.duvdx.x * d.duvdy.y - d.duvdx.y * d.duvdy.x;
    float s = cotan_sign(determinant);
    vec3 t = (sigma_x * d.duvdy.y - sigma_y * d.duvdx.y) * s;
    vec3 zero = vec3(0.0, 0.0, 0.0);
    f.t = abs(determinant) > 0.0 ? cotan_normalize_or(t, zero) : zero;
    f.b = cross(f.n, f.t) * (s * side);
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
    cotan_frame frame = cotan_frame_orthonormal(normal, dpdx, dpdy, duvdx, duvdy);
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
`,
smooth: `// Normal mapping, frame \`smooth\` (total form), for GLSL ES 3.00 (WebGL 2).
// Written by cotan shader from the portable text of Cotan; MIT licence.
//
// Normal map: three channels, (255c - 128)/127, green against increasing v.
//
// Needs from the caller:
//   normal     interpolated surface normal; any space, the same for all vectors
//   the vertex attributes named at the function below, interpolated
//
// Missing:
//   Most programs fill in zeros or a constant for a mesh without these attributes. Zeros give the
//   normal without bumps, a constant gives wrong bumps. Draw such a mesh with the text of \`cotangent\`.
//
// Call:
//   vec3 n = cotan_perturb_normal_from_vertices(normal, cotangent, cobitangent, texture(normal_map, uv).xyz);
// It returns the perturbed normal, unit, in the space of the arguments.
//
// Limits:
//   Total: no input gives NaN; where there is no frame (constant uv, no area, non-finite
//   differences) the result is the unit interpolated normal.
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

// Returns the unit vector along v. Returns \`otherwise\`, unchanged, if v is zero, shorter than about 1e-43 (1e-6 times
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

// \`smooth\`: from cotangents averaged at the vertices and interpolated, then projected onto the plane of n; the longer
// of t and b has length one. Total; n need not be unit, f.n is.
//   t, b   interpolated covectors, any common scale, same space as n
// Degenerate input: t = b = 0 where both vanish.
cotan_frame cotan_frame_smooth(vec3 n, vec3 t, vec3 b)
{
    vec3 zero = vec3(0.0, 0.0, 0.0);
    cotan_frame f;
    f.n = cotan_safe_normal(n, zero, zero);
    bool finite = cotan_sum_abs(t) + cotan_sum_abs(b) <= 1e37;
    t = finite ? t : vec3(0.0, 0.0, 0.0);
    b = finite ? b : vec3(0.0, 0.0, 0.0);
    float rescale = cotan_power_of_two_scale(max(cotan_max_abs(t), cotan_max_abs(b)));
    t = t * rescale;
    b = b * rescale;
    t = t - f.n * dot(t, f.n);
    b = b - f.n * dot(b, f.n);
    float longest2 = max(dot(t, t), dot(b, b));
    float scale = inversesqrt(max(longest2, 1e-12));
    f.t = t * scale;
    f.b = b * scale;
    return f;
}

// The perturbed normal, unit.
// normal: interpolated.
// cotangent, cobitangent: covectors averaged at the vertices, interpolated, in normal's space.
// Any common scale.
// texel: the normal map as sampled.
vec3 cotan_perturb_normal_from_vertices(vec3 normal, vec3 cotangent, vec3 cobitangent, vec3 texel)
{
    vec3 m = cotan_decode(texel);
    cotan_frame frame = cotan_frame_smooth(normal, cotangent, cobitangent);
    return cotan_apply(frame, m);
}
`,
triangle: `// Normal mapping, frame \`triangle\` (total form), for GLSL ES 3.00 (WebGL 2).
// Written by cotan shader from the portable text of Cotan; MIT licence.
//
// Normal map: three channels, (255c - 128)/127, green against increasing v.
//
// Needs from the caller:
//   normal     interpolated surface normal; any space, the same for all vectors
//   p0 p1 p2, uv0 uv1 uv2, n0 n1 n2  the triangle's corners, in the vertex stage (at the provoking
//              vertex), the mesh stage, or in one stage with all the rest; no screen derivatives
//
// Call:
//   vec3 n = cotan_perturb_normal_from_edges(normal, p1 - p0, p2 - p0, uv1 - uv0, uv2 - uv0, texture(normal_map, uv).xyz);
// It returns the perturbed normal, unit, in the space of the arguments.
//
// Limits:
//   Total: no input gives NaN; where there is no frame (constant uv, no area, non-finite
//   differences) the result is the unit interpolated normal.
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

// U and V of one triangle: vectors in its plane. The longer one has length 1. U = V = 0 if there is no frame.
struct cotan_triangle
{
    vec3 u;
    vec3 v;
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

// Returns the unit vector along v. Returns \`otherwise\`, unchanged, if v is zero, shorter than about 1e-43 (1e-6 times
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

// Scales u and v by one factor, so that the longer has length 1, and by \`sign\`: +1, -1, or 0 for U = V = 0.
// u, v: finite. If both are shorter than about 1e-43, U = V = 0.
cotan_triangle cotan_triangle_unit(vec3 u, vec3 v, float sign)
{
    float rescale = cotan_power_of_two_scale(max(cotan_max_abs(u), cotan_max_abs(v)));
    u = u * rescale;
    v = v * rescale;
    float longest2 = max(dot(u, u), dot(v, v));
    bool usable = longest2 > 1e-12;
    float scale = inversesqrt(usable ? longest2 : 1.0);
    scale = usable ? scale * sign : 0.0;
    cotan_triangle result;
    result.u = u * scale;
    result.v = v * scale;
    return result;
}

// Returns U and V from edges, including the sign: n x U  points along increasing u for every n on the side of
// \`normals\`.
//   dp1, dp2      p1 - p0 and p2 - p0, in the space of the frame
//   duv1, duv2    uv1 - uv0 and uv2 - uv0
//   normals       the sum of the three vertex normals, of any length, in the same space. It determines the outer side
//                 of the triangle, so that meshes wound against their normals are handled. If it is zero or not finite,
//                 the winding decides: the triangle is counterclockwise as seen from outside
// Total: a triangle without area, constant uv and non-finite input give U = V = 0. Where uv vary along one line only, U
// is parallel to V.
cotan_triangle cotan_triangle_of_edges(vec3 dp1, vec3 dp2, vec2 duv1, vec2 duv2, vec3 normals)
{
    cotan_differences d = cotan_scale_differences(dp1, dp2, duv1, duv2);
    vec3 u = d.dpdx * d.duvdy.x - d.dpdy * d.duvdx.x;
    vec3 v = d.dpdx * d.duvdy.y - d.dpdy * d.duvdx.y;
    vec3 face = cross(d.dpdx, d.dpdy);
    float side = cotan_sign(dot(face, cotan_normalize_or(normals, face)));
    return cotan_triangle_unit(u, v, dot(face, face) > 0.0 ? side : 0.0);
}

// \`triangle\`: the frame of U and V at a pixel. t and b have the directions of \`cotangent\`, but the scale of the
// triangle, not of the pixel: where n is at an angle a to the triangle's own normal, slopes are those of \`cotangent\`
// times a factor between cos(a) and 1. View independent.
//   n      interpolated normal, any length, on the side that U and V were made for; f.n is unit. On back faces pass the
//          normal as interpolated and negate the result, or negate m.z instead: a flipped n reverses t and b
//   u, v   U and V in the space of n
// Total: non-finite U and V give t = b = 0.
// Source: [2013], summing before the cross product; see the head of this file.
cotan_frame cotan_frame_of_triangle(vec3 n, vec3 u, vec3 v)
{
    vec3 zero = vec3(0.0, 0.0, 0.0);
    bool finite = cotan_sum_abs(u) + cotan_sum_abs(v) <= 1e37;
    cotan_frame f;
    f.n = cotan_safe_normal(n, zero, zero);
    f.t = cross(f.n, finite ? u : zero);
    f.b = cross(f.n, finite ? v : zero);
    return f;
}

// \`triangle\` in one step, from the edges of the triangle. n also determines the outer side, so it may be flipped on
// back faces. Equal to the frame from the vertices wherever n is less than 90 degrees from the triangle's own normal.
//   n             interpolated normal at the shaded point, any length; f.n is unit
//   dpdx, dpdy    edges p1 - p0 and p2 - p0
//   duvdx, duvdy  uv1 - uv0 and uv2 - uv0
// Total: a triangle without area, constant uv and non-finite input give t = b = 0.
cotan_frame cotan_frame_triangle(vec3 n, vec3 dpdx, vec3 dpdy, vec2 duvdx, vec2 duvdy)
{
    cotan_differences d = cotan_scale_differences(dpdx, dpdy, duvdx, duvdy);
    vec3 unit = cotan_safe_normal(n, d.dpdx, d.dpdy);
    cotan_triangle vectors = cotan_triangle_of_edges(dpdx, dpdy, duvdx, duvdy, unit);
    return cotan_frame_of_triangle(unit, vectors.u, vectors.v);
}

// The perturbed normal, unit.
// normal: interpolated at the shaded point.
// dpdx, dpdy: the triangle's edges p1 - p0 and p2 - p0, in normal's space.
// duvdx, duvdy: uv1 - uv0 and uv2 - uv0.
// texel: the normal map as sampled.
vec3 cotan_perturb_normal_from_edges(vec3 normal, vec3 dpdx, vec3 dpdy, vec2 duvdx, vec2 duvdy,
    vec3 texel)
{
    vec3 m = cotan_decode(texel);
    cotan_frame frame = cotan_frame_triangle(normal, dpdx, dpdy, duvdx, duvdy);
    return cotan_apply(frame, m);
}
`,
};
export const wgsl = {
cotangent: `// Normal mapping, frame \`cotangent\` (total form), for WGSL.
// Written by cotan shader from the portable text of Cotan; MIT licence.
//
// Normal map: three channels, (255c - 128)/127, green against increasing v.
//
// Needs from the caller:
//   normal     interpolated surface normal; any space, the same for all vectors
//   position   camera-relative (world axes, origin at the eye), interpolated, NOT normalised;
//              normalising it first gives an error of 11 degrees at a grazing angle of 45 degrees
//   uv         those of the normal map
//   derivatives of position and uv: taken here by dpdxFine and dpdyFine. Interpolate both alike, not
//              at centroids; call it before any discard, if or loop that differs between pixels
//
// Call:
//   let n = cotan_perturb_normal(normal, position, uv, textureSample(normal_map, map_sampler, uv).xyz);
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
//   WGSL lets an implementation assume that no number is NaN or infinite: the guards against
//   non-finite input may then not hold. Those against zeros and empty areas do.
//
// After:
//   [2006] C. Schueler, Normal Mapping without Precomputed Tangents, ShaderX5, 2006
//   [2013] C. Schueler, Followup: Normal Mapping Without Precomputed Tangents, 2013

struct cotan_frame {
    t: vec3f, // cotangent: covector along grad u
    b: vec3f, // cobitangent: covector along grad v
    n: vec3f, // normal
}

// The four differences after checking: either all finite and scaled by powers of two so that the largest position
// component and the largest uv component lie in [1,2), or all zero.
struct cotan_differences {
    dpdx: vec3f,
    dpdy: vec3f,
    duvdx: vec2f,
    duvdy: vec2f,
    p_scale: f32, // the factor applied to dpdx and dpdy
    uv_scale: f32, // the factor applied to duvdx and duvdy
}

// Returns the power of two s for which m*s lies in [1,2), after clamping m to [1e-37, 1e37]. Multiplying by s is exact,
// so formulas made of products give the same bits with scaled values, but no longer underflow or overflow.
// m: any magnitude (zero gives the largest scale), not NaN.
fn cotan_power_of_two_scale(m_in: f32) -> f32 {
    var m = m_in;
    m = min(max(m, 1e-37), 1e37);
    let exponent = bitcast<u32>(m) & 0x7f800000u;
    return bitcast<f32>((254u << 23) - exponent);
}

// The signed value of a stored component, in [-1,1].
fn cotan_expand(c: f32) -> f32 {
    let x = c * (255.0 / 127.0) - (128.0 / 127.0);
    return max(x, -1.0);
}

// The decoded texel: normal along (+u, +v, outwards). Not unit in general.
// texel: as sampled; two-channel maps use x and y only.
fn cotan_decode(texel: vec3f) -> vec3f {
    let x = cotan_expand(texel.x);
    let y = cotan_expand(texel.y);
    let z = cotan_expand(texel.z);
    let m = vec3f(x, y, z);
    return vec3f(m.x, -m.y, m.z);
}

fn cotan_sum_abs(a: vec3f) -> f32 {
    return abs(a.x) + abs(a.y) + abs(a.z);
}

fn cotan_max_abs(a: vec3f) -> f32 {
    return max(abs(a.x), max(abs(a.y), abs(a.z)));
}

// Returns -1 for x < 0, otherwise +1 (also for -0 and NaN).
fn cotan_sign(x: f32) -> f32 {
    return select(1.0, -1.0, x < 0.0);
}

// Scales the differences (exactly, see cotan_power_of_two_scale) and zeroes unusable ones: all four if a component of
// dpdx or dpdy is not finite or exceeds 1e37; only duvdx and duvdy if a component of these does. Frames that do not
// depend on the common scale of positions or of uv are unchanged, bit for bit.
fn cotan_scale_differences(dpdx: vec3f, dpdy: vec3f, duvdx: vec2f, duvdy: vec2f)
    -> cotan_differences {
    // A sum of magnitudes is NaN or infinite if one term is; max() would drop a NaN. Two comparisons of one kind with
    // the same number would become one with max() in OpenGL on Mesa, hence < and <=.
    let p_usable = cotan_sum_abs(dpdx) + cotan_sum_abs(dpdy) < 1e37;
    let uv_usable = p_usable && abs(duvdx.x) + abs(duvdx.y) + abs(duvdy.x) + abs(duvdy.y) <= 1e37;
    var d: cotan_differences;
    d.dpdx = select(vec3f(0.0, 0.0, 0.0), dpdx, p_usable);
    d.dpdy = select(vec3f(0.0, 0.0, 0.0), dpdy, p_usable);
    d.duvdx = select(vec2f(0.0, 0.0), duvdx, uv_usable);
    d.duvdy = select(vec2f(0.0, 0.0), duvdy, uv_usable);
    d.p_scale = cotan_power_of_two_scale(max(cotan_max_abs(d.dpdx), cotan_max_abs(d.dpdy)));
    d.uv_scale = cotan_power_of_two_scale(max(max(abs(d.duvdx.x), abs(d.duvdx.y)),
        max(abs(d.duvdy.x), abs(d.duvdy.y))));
    d.dpdx = d.dpdx * d.p_scale;
    d.dpdy = d.dpdy * d.p_scale;
    d.duvdx = d.duvdx * d.uv_scale;
    d.duvdy = d.duvdy * d.uv_scale;
    return d;
}

// Returns the unit vector along v. Returns \`otherwise\`, unchanged, if v is zero, shorter than about 1e-43 (1e-6 times
// the lower clamp of cotan_power_of_two_scale), or not finite.
fn cotan_normalize_or(v_in: vec3f, otherwise: vec3f) -> vec3f {
    var v = v_in;
    let usable = cotan_sum_abs(v) <= 1e37;
    v = select(vec3f(0.0, 0.0, 0.0), v, usable);
    v = v * cotan_power_of_two_scale(cotan_max_abs(v));
    let length2 = dot(v, v);
    let unit = v * inverseSqrt(max(length2, 1e-12));
    return select(otherwise, unit, length2 > 1e-12);
}

// Returns the interpolated normal as a unit vector. If it is zero (normals cancelled out) or not finite: the normal of
// the plane of dpdx and dpdy, and (0,0,1) if that is degenerate too. The sign of the plane normal is that of dpdx x
// dpdy; such a pixel has no better information.
// n: any length. dpdx, dpdy: finite, as cotan_scale_differences returns them.
fn cotan_safe_normal(n: vec3f, dpdx: vec3f, dpdy: vec3f) -> vec3f {
    let z = vec3f(0.0, 0.0, 1.0);
    return cotan_normalize_or(n, cotan_normalize_or(cross(dpdx, dpdy), z));
}

// Returns the perturbed normal normalize(t*m.x + b*m.y + n*m.z). If that sum is shorter than 1e-6 or not finite (an
// unfilled texel, m = 0; a horizontal m where t = b = 0), returns f.n unchanged: unit, or as long as the caller passed
// it.
// m: decoded texel, along (+u, +v, outwards); any length.
fn cotan_apply(f: cotan_frame, m: vec3f) -> vec3f {
    let v = f.t * m.x + f.b * m.y + f.n * m.z;
    let length2 = dot(v, v);
    let usable = length2 > 1e-12 && length2 <= 1e37;
    let unit = v * inverseSqrt(select(1.0, length2, usable));
    return select(f.n, unit, usable);
}

// \`cotangent\`. The cotangent frame of [2013] with two differences:
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
fn cotan_frame_cotangent(n: vec3f, dpdx: vec3f, dpdy: vec3f, duvdx: vec2f, duvdy: vec2f)
    -> cotan_frame {
    let d = cotan_scale_differences(dpdx, dpdy, duvdx, duvdy);
    var f: cotan_frame;
    f.n = cotan_safe_normal(n, d.dpdx, d.dpdy);
    let dpdy_perp = cross(d.dpdy, f.n);
    let dpdx_perp = cross(f.n, d.dpdx);
    let t = dpdy_perp * d.duvdx.x + dpdx_perp * d.duvdy.x;
    let b = dpdy_perp * d.duvdx.y + dpdx_perp * d.duvdy.y;
    let longest2 = max(dot(t, t), dot(b, b));
    var scale = inverseSqrt(max(longest2, 1e-12));
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
fn cotan_perturb_normal_from_differences(normal: vec3f, dpdx: vec3f, dpdy: vec3f, duvdx: vec2f,
    duvdy: vec2f, texel: vec3f) -> vec3f {
    let m = cotan_decode(texel);
    let frame = cotan_frame_cotangent(normal, dpdx, dpdy, duvdx, duvdy);
    return cotan_apply(frame, m);
}

// The same, taking the screen derivatives itself: call it in uniform control flow, before any
// branch or discard that differs within a 2x2 quad.
// position: camera-relative, interpolated, not normalised.
fn cotan_perturb_normal(normal: vec3f, position: vec3f, uv: vec2f, texel: vec3f) -> vec3f {
    return cotan_perturb_normal_from_differences(normal, dpdxFine(position), dpdyFine(position),
        dpdxFine(uv), dpdyFine(uv), texel);
}
`,
orthonormal: `// Normal mapping, frame \`orthonormal\` (total form), for WGSL.
// Written by cotan shader from the portable text of Cotan; MIT licence.
//
// Normal map: three channels, (255c - 128)/127, green against increasing v.
//
// Needs from the caller:
//   normal     interpolated surface normal; any space, the same for all vectors
//   position   camera-relative (world axes, origin at the eye), interpolated, NOT normalised;
//              normalising it first gives an error of 11 degrees at a grazing angle of 45 degrees
//   uv         those of the normal map
//   derivatives of position and uv: taken here by dpdxFine and dpdyFine. Interpolate both alike, not
//              at centroids; call it before any discard, if or loop that differs between pixels
//
// Call:
//   let n = cotan_perturb_normal(normal, position, uv, textureSample(normal_map, map_sampler, uv).xyz);
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
//   edges.
//   WGSL lets an implementation assume that no number is NaN or infinite: the guards against
//   non-finite input may then not hold. Those against zeros and empty areas do.
//
// After:
//   [2006] C. Schueler, Normal Mapping without Precomputed Tangents, ShaderX5, 2006
//   [2013] C. Schueler, Followup: Normal Mapping Without Precomputed Tangents, 2013
//   [2020] M. Mikkelsen, Surface Gradient Based Bump Mapping Framework, JCGT 9(3), 2020

struct cotan_frame {
    t: vec3f, // cotangent: covector along grad u
    b: vec3f, // cobitangent: covector along grad v
    n: vec3f, // normal
}

// The four differences after checking: either all finite and scaled by powers of two so that the largest position
// component and the largest uv component lie in [1,2), or all zero.
struct cotan_differences {
    dpdx: vec3f,
    dpdy: vec3f,
    duvdx: vec2f,
    duvdy: vec2f,
    p_scale: f32, // the factor applied to dpdx and dpdy
    uv_scale: f32, // the factor applied to duvdx and duvdy
}

// Returns the power of two s for which m*s lies in [1,2), after clamping m to [1e-37, 1e37]. Multiplying by s is exact,
// so formulas made of products give the same bits with scaled values, but no longer underflow or overflow.
// m: any magnitude (zero gives the largest scale), not NaN.
fn cotan_power_of_two_scale(m_in: f32) -> f32 {
    var m = m_in;
    m = min(max(m, 1e-37), 1e37);
    let exponent = bitcast<u32>(m) & 0x7f800000u;
    return bitcast<f32>((254u << 23) - exponent);
}

// The signed value of a stored component, in [-1,1].
fn cotan_expand(c: f32) -> f32 {
    let x = c * (255.0 / 127.0) - (128.0 / 127.0);
    return max(x, -1.0);
}

// The decoded texel: normal along (+u, +v, outwards). Not unit in general.
// texel: as sampled; two-channel maps use x and y only.
fn cotan_decode(texel: vec3f) -> vec3f {
    let x = cotan_expand(texel.x);
    let y = cotan_expand(texel.y);
    let z = cotan_expand(texel.z);
    let m = vec3f(x, y, z);
    return vec3f(m.x, -m.y, m.z);
}

fn cotan_sum_abs(a: vec3f) -> f32 {
    return abs(a.x) + abs(a.y) + abs(a.z);
}

fn cotan_max_abs(a: vec3f) -> f32 {
    return max(abs(a.x), max(abs(a.y), abs(a.z)));
}

// Returns -1 for x < 0, otherwise +1 (also for -0 and NaN).
fn cotan_sign(x: f32) -> f32 {
    return select(1.0, -1.0, x < 0.0);
}

// Scales the differences (exactly, see cotan_power_of_two_scale) and zeroes unusable ones: all four if a component of
// dpdx or dpdy is not finite or exceeds 1e37; only duvdx and duvdy if a component of these does. Frames that do not
// depend on the common scale of positions or of uv are unchanged, bit for bit.
fn cotan_scale_differences(dpdx: vec3f, dpdy: vec3f, duvdx: vec2f, duvdy: vec2f)
    -> cotan_differences {
    // A sum of magnitudes is NaN or infinite if one term is; max() would drop a NaN. Two comparisons of one kind with
    // the same number would become one with max() in OpenGL on Mesa, hence < and <=.
    let p_usable = cotan_sum_abs(dpdx) + cotan_sum_abs(dpdy) < 1e37;
    let uv_usable = p_usable && abs(duvdx.x) + abs(duvdx.y) + abs(duvdy.x) + abs(duvdy.y) <= 1e37;
    var d: cotan_differences;
    d.dpdx = select(vec3f(0.0, 0.0, 0.0), dpdx, p_usable);
    d.dpdy = select(vec3f(0.0, 0.0, 0.0), dpdy, p_usable);
    d.duvdx = select(vec2f(0.0, 0.0), duvdx, uv_usable);
    d.duvdy = select(vec2f(0.0, 0.0), duvdy, uv_usable);
    d.p_scale = cotan_power_of_two_scale(max(cotan_max_abs(d.dpdx), cotan_max_abs(d.dpdy)));
    d.uv_scale = cotan_power_of_two_scale(max(max(abs(d.duvdx.x), abs(d.duvdx.y)),
        max(abs(d.duvdy.x), abs(d.duvdy.y))));
    d.dpdx = d.dpdx * d.p_scale;
    d.dpdy = d.dpdy * d.p_scale;
    d.duvdx = d.duvdx * d.uv_scale;
    d.duvdy = d.duvdy * d.uv_scale;
    return d;
}

// Returns the unit vector along v. Returns \`otherwise\`, unchanged, if v is zero, shorter than about 1e-43 (1e-6 times
// the lower clamp of cotan_power_of_two_scale), or not finite.
fn cotan_normalize_or(v_in: vec3f, otherwise: vec3f) -> vec3f {
    var v = v_in;
    let usable = cotan_sum_abs(v) <= 1e37;
    v = select(vec3f(0.0, 0.0, 0.0), v, usable);
    v = v * cotan_power_of_two_scale(cotan_max_abs(v));
    let length2 = dot(v, v);
    let unit = v * inverseSqrt(max(length2, 1e-12));
    return select(otherwise, unit, length2 > 1e-12);
}

// Returns the interpolated normal as a unit vector. If it is zero (normals cancelled out) or not finite: the normal of
// the plane of dpdx and dpdy, and (0,0,1) if that is degenerate too. The sign of the plane normal is that of dpdx x
// dpdy; such a pixel has no better information.
// n: any length. dpdx, dpdy: finite, as cotan_scale_differences returns them.
fn cotan_safe_normal(n: vec3f, dpdx: vec3f, dpdy: vec3f) -> vec3f {
    let z = vec3f(0.0, 0.0, 1.0);
    return cotan_normalize_or(n, cotan_normalize_or(cross(dpdx, dpdy), z));
}

// Returns the perturbed normal normalize(t*m.x + b*m.y + n*m.z). If that sum is shorter than 1e-6 or not finite (an
// unfilled texel, m = 0; a horizontal m where t = b = 0), returns f.n unchanged: unit, or as long as the caller passed
// it.
// m: decoded texel, along (+u, +v, outwards); any length.
fn cotan_apply(f: cotan_frame, m: vec3f) -> vec3f {
    let v = f.t * m.x + f.b * m.y + f.n * m.z;
    let length2 = dot(v, v);
    let usable = length2 > 1e-12 && length2 <= 1e37;
    let unit = v * inverseSqrt(select(1.0, length2, usable));
    return select(f.n, unit, usable);
}

// \`orthonormal\`: t along dP/du in the plane of n, b = +-n x t. The best frame without stored tangents for maps that
// were baked for MikkTSpace. Exact where uv are conformal; a constant error where they are anisotropic. Total, like
// \`cotangent\`; n need not be unit, f.n is.
// Degenerate input: uv without area (constant, or along one line), zero or non-finite differences give t = b = 0.
// Source: [2020], the basis built from derivatives.
fn cotan_frame_orthonormal(n: vec3f, dpdx: vec3f, dpdy: vec3f, duvdx: vec2f, duvdy: vec2f)
    -> cotan_frame {
    let d = cotan_scale_differences(dpdx, dpdy, duvdx, duvdy);
    var f: cotan_frame;
    f.n = cotan_safe_normal(n, d.dpdx, d.dpdy);
    let sigma_x = d.dpdx - f.n * dot(d.dpdx, f.n);
    let sigma_y = d.dpdy - f.n * dot(d.dpdy, f.n);
    let side = cotan_sign(dot(d.dpdy, cross(f.n, d.dpdx)));
    let determinant = d.duvdx.x * d.duvdy.y - d.duvdx.y * d.duvdy.x;
    let s = cotan_sign(determinant);
    let t = (sigma_x * d.duvdy.y - sigma_y * d.duvdx.y) * s;
    let zero = vec3f(0.0, 0.0, 0.0);
    f.t = select(zero, cotan_normalize_or(t, zero), abs(determinant) > 0.0);
    f.b = cross(f.n, f.t) * (s * side);
    return f;
}

// The perturbed normal, unit.
// normal: interpolated.
// dpdx, dpdy: differences of position along any two directions, in normal's space.
// duvdx, duvdy: differences of uv along the same two.
// texel: the normal map as sampled.
fn cotan_perturb_normal_from_differences(normal: vec3f, dpdx: vec3f, dpdy: vec3f, duvdx: vec2f,
    duvdy: vec2f, texel: vec3f) -> vec3f {
    let m = cotan_decode(texel);
    let frame = cotan_frame_orthonormal(normal, dpdx, dpdy, duvdx, duvdy);
    return cotan_apply(frame, m);
}

// The same, taking the screen derivatives itself: call it in uniform control flow, before any
// branch or discard that differs within a 2x2 quad.
// position: camera-relative, interpolated, not normalised.
fn cotan_perturb_normal(normal: vec3f, position: vec3f, uv: vec2f, texel: vec3f) -> vec3f {
    return cotan_perturb_normal_from_differences(normal, dpdxFine(position), dpdyFine(position),
        dpdxFine(uv), dpdyFine(uv), texel);
}
`,
smooth: `// Normal mapping, frame \`smooth\` (total form), for WGSL.
// Written by cotan shader from the portable text of Cotan; MIT licence.
//
// Normal map: three channels, (255c - 128)/127, green against increasing v.
//
// Needs from the caller:
//   normal     interpolated surface normal; any space, the same for all vectors
//   the vertex attributes named at the function below, interpolated
//
// Missing:
//   Most programs fill in zeros or a constant for a mesh without these attributes. Zeros give the
//   normal without bumps, a constant gives wrong bumps. Draw such a mesh with the text of \`cotangent\`.
//
// Call:
//   let n = cotan_perturb_normal_from_vertices(normal, cotangent, cobitangent, textureSample(normal_map, map_sampler, uv).xyz);
// It returns the perturbed normal, unit, in the space of the arguments.
//
// Limits:
//   Total: no input gives NaN; where there is no frame (constant uv, no area, non-finite
//   differences) the result is the unit interpolated normal.
//   WGSL lets an implementation assume that no number is NaN or infinite: the guards against
//   non-finite input may then not hold. Those against zeros and empty areas do.
//
// After:
//   [2006] C. Schueler, Normal Mapping without Precomputed Tangents, ShaderX5, 2006
//   [2013] C. Schueler, Followup: Normal Mapping Without Precomputed Tangents, 2013

struct cotan_frame {
    t: vec3f, // cotangent: covector along grad u
    b: vec3f, // cobitangent: covector along grad v
    n: vec3f, // normal
}

// Returns the power of two s for which m*s lies in [1,2), after clamping m to [1e-37, 1e37]. Multiplying by s is exact,
// so formulas made of products give the same bits with scaled values, but no longer underflow or overflow.
// m: any magnitude (zero gives the largest scale), not NaN.
fn cotan_power_of_two_scale(m_in: f32) -> f32 {
    var m = m_in;
    m = min(max(m, 1e-37), 1e37);
    let exponent = bitcast<u32>(m) & 0x7f800000u;
    return bitcast<f32>((254u << 23) - exponent);
}

// The signed value of a stored component, in [-1,1].
fn cotan_expand(c: f32) -> f32 {
    let x = c * (255.0 / 127.0) - (128.0 / 127.0);
    return max(x, -1.0);
}

// The decoded texel: normal along (+u, +v, outwards). Not unit in general.
// texel: as sampled; two-channel maps use x and y only.
fn cotan_decode(texel: vec3f) -> vec3f {
    let x = cotan_expand(texel.x);
    let y = cotan_expand(texel.y);
    let z = cotan_expand(texel.z);
    let m = vec3f(x, y, z);
    return vec3f(m.x, -m.y, m.z);
}

fn cotan_sum_abs(a: vec3f) -> f32 {
    return abs(a.x) + abs(a.y) + abs(a.z);
}

fn cotan_max_abs(a: vec3f) -> f32 {
    return max(abs(a.x), max(abs(a.y), abs(a.z)));
}

// Returns the unit vector along v. Returns \`otherwise\`, unchanged, if v is zero, shorter than about 1e-43 (1e-6 times
// the lower clamp of cotan_power_of_two_scale), or not finite.
fn cotan_normalize_or(v_in: vec3f, otherwise: vec3f) -> vec3f {
    var v = v_in;
    let usable = cotan_sum_abs(v) <= 1e37;
    v = select(vec3f(0.0, 0.0, 0.0), v, usable);
    v = v * cotan_power_of_two_scale(cotan_max_abs(v));
    let length2 = dot(v, v);
    let unit = v * inverseSqrt(max(length2, 1e-12));
    return select(otherwise, unit, length2 > 1e-12);
}

// Returns the interpolated normal as a unit vector. If it is zero (normals cancelled out) or not finite: the normal of
// the plane of dpdx and dpdy, and (0,0,1) if that is degenerate too. The sign of the plane normal is that of dpdx x
// dpdy; such a pixel has no better information.
// n: any length. dpdx, dpdy: finite, as cotan_scale_differences returns them.
fn cotan_safe_normal(n: vec3f, dpdx: vec3f, dpdy: vec3f) -> vec3f {
    let z = vec3f(0.0, 0.0, 1.0);
    return cotan_normalize_or(n, cotan_normalize_or(cross(dpdx, dpdy), z));
}

// Returns the perturbed normal normalize(t*m.x + b*m.y + n*m.z). If that sum is shorter than 1e-6 or not finite (an
// unfilled texel, m = 0; a horizontal m where t = b = 0), returns f.n unchanged: unit, or as long as the caller passed
// it.
// m: decoded texel, along (+u, +v, outwards); any length.
fn cotan_apply(f: cotan_frame, m: vec3f) -> vec3f {
    let v = f.t * m.x + f.b * m.y + f.n * m.z;
    let length2 = dot(v, v);
    let usable = length2 > 1e-12 && length2 <= 1e37;
    let unit = v * inverseSqrt(select(1.0, length2, usable));
    return select(f.n, unit, usable);
}

// \`smooth\`: from cotangents averaged at the vertices and interpolated, then projected onto the plane of n; the longer
// of t and b has length one. Total; n need not be unit, f.n is.
//   t, b   interpolated covectors, any common scale, same space as n
// Degenerate input: t = b = 0 where both vanish.
fn cotan_frame_smooth(n: vec3f, t_in: vec3f, b_in: vec3f) -> cotan_frame {
    var t = t_in;
    var b = b_in;
    let zero = vec3f(0.0, 0.0, 0.0);
    var f: cotan_frame;
    f.n = cotan_safe_normal(n, zero, zero);
    let finite = cotan_sum_abs(t) + cotan_sum_abs(b) <= 1e37;
    t = select(vec3f(0.0, 0.0, 0.0), t, finite);
    b = select(vec3f(0.0, 0.0, 0.0), b, finite);
    let rescale = cotan_power_of_two_scale(max(cotan_max_abs(t), cotan_max_abs(b)));
    t = t * rescale;
    b = b * rescale;
    t = t - f.n * dot(t, f.n);
    b = b - f.n * dot(b, f.n);
    let longest2 = max(dot(t, t), dot(b, b));
    let scale = inverseSqrt(max(longest2, 1e-12));
    f.t = t * scale;
    f.b = b * scale;
    return f;
}

// The perturbed normal, unit.
// normal: interpolated.
// cotangent, cobitangent: covectors averaged at the vertices, interpolated, in normal's space.
// Any common scale.
// texel: the normal map as sampled.
fn cotan_perturb_normal_from_vertices(normal: vec3f, cotangent: vec3f, cobitangent: vec3f,
    texel: vec3f) -> vec3f {
    let m = cotan_decode(texel);
    let frame = cotan_frame_smooth(normal, cotangent, cobitangent);
    return cotan_apply(frame, m);
}
`,
triangle: `// Normal mapping, frame \`triangle\` (total form), for WGSL.
// Written by cotan shader from the portable text of Cotan; MIT licence.
//
// Normal map: three channels, (255c - 128)/127, green against increasing v.
//
// Needs from the caller:
//   normal     interpolated surface normal; any space, the same for all vectors
//   p0 p1 p2, uv0 uv1 uv2, n0 n1 n2  the triangle's corners, in the vertex stage (at the provoking
//              vertex), the mesh stage, or in one stage with all the rest; no screen derivatives
//
// Call:
//   let n = cotan_perturb_normal_from_edges(normal, p1 - p0, p2 - p0, uv1 - uv0, uv2 - uv0, textureSample(normal_map, map_sampler, uv).xyz);
// It returns the perturbed normal, unit, in the space of the arguments.
//
// Limits:
//   Total: no input gives NaN; where there is no frame (constant uv, no area, non-finite
//   differences) the result is the unit interpolated normal.
//   WGSL lets an implementation assume that no number is NaN or infinite: the guards against
//   non-finite input may then not hold. Those against zeros and empty areas do.
//
// After:
//   [2006] C. Schueler, Normal Mapping without Precomputed Tangents, ShaderX5, 2006
//   [2013] C. Schueler, Followup: Normal Mapping Without Precomputed Tangents, 2013

struct cotan_frame {
    t: vec3f, // cotangent: covector along grad u
    b: vec3f, // cobitangent: covector along grad v
    n: vec3f, // normal
}

// The four differences after checking: either all finite and scaled by powers of two so that the largest position
// component and the largest uv component lie in [1,2), or all zero.
struct cotan_differences {
    dpdx: vec3f,
    dpdy: vec3f,
    duvdx: vec2f,
    duvdy: vec2f,
    p_scale: f32, // the factor applied to dpdx and dpdy
    uv_scale: f32, // the factor applied to duvdx and duvdy
}

// U and V of one triangle: vectors in its plane. The longer one has length 1. U = V = 0 if there is no frame.
struct cotan_triangle {
    u: vec3f,
    v: vec3f,
}

// Returns the power of two s for which m*s lies in [1,2), after clamping m to [1e-37, 1e37]. Multiplying by s is exact,
// so formulas made of products give the same bits with scaled values, but no longer underflow or overflow.
// m: any magnitude (zero gives the largest scale), not NaN.
fn cotan_power_of_two_scale(m_in: f32) -> f32 {
    var m = m_in;
    m = min(max(m, 1e-37), 1e37);
    let exponent = bitcast<u32>(m) & 0x7f800000u;
    return bitcast<f32>((254u << 23) - exponent);
}

// The signed value of a stored component, in [-1,1].
fn cotan_expand(c: f32) -> f32 {
    let x = c * (255.0 / 127.0) - (128.0 / 127.0);
    return max(x, -1.0);
}

// The decoded texel: normal along (+u, +v, outwards). Not unit in general.
// texel: as sampled; two-channel maps use x and y only.
fn cotan_decode(texel: vec3f) -> vec3f {
    let x = cotan_expand(texel.x);
    let y = cotan_expand(texel.y);
    let z = cotan_expand(texel.z);
    let m = vec3f(x, y, z);
    return vec3f(m.x, -m.y, m.z);
}

fn cotan_sum_abs(a: vec3f) -> f32 {
    return abs(a.x) + abs(a.y) + abs(a.z);
}

fn cotan_max_abs(a: vec3f) -> f32 {
    return max(abs(a.x), max(abs(a.y), abs(a.z)));
}

// Returns -1 for x < 0, otherwise +1 (also for -0 and NaN).
fn cotan_sign(x: f32) -> f32 {
    return select(1.0, -1.0, x < 0.0);
}

// Scales the differences (exactly, see cotan_power_of_two_scale) and zeroes unusable ones: all four if a component of
// dpdx or dpdy is not finite or exceeds 1e37; only duvdx and duvdy if a component of these does. Frames that do not
// depend on the common scale of positions or of uv are unchanged, bit for bit.
fn cotan_scale_differences(dpdx: vec3f, dpdy: vec3f, duvdx: vec2f, duvdy: vec2f)
    -> cotan_differences {
    // A sum of magnitudes is NaN or infinite if one term is; max() would drop a NaN. Two comparisons of one kind with
    // the same number would become one with max() in OpenGL on Mesa, hence < and <=.
    let p_usable = cotan_sum_abs(dpdx) + cotan_sum_abs(dpdy) < 1e37;
    let uv_usable = p_usable && abs(duvdx.x) + abs(duvdx.y) + abs(duvdy.x) + abs(duvdy.y) <= 1e37;
    var d: cotan_differences;
    d.dpdx = select(vec3f(0.0, 0.0, 0.0), dpdx, p_usable);
    d.dpdy = select(vec3f(0.0, 0.0, 0.0), dpdy, p_usable);
    d.duvdx = select(vec2f(0.0, 0.0), duvdx, uv_usable);
    d.duvdy = select(vec2f(0.0, 0.0), duvdy, uv_usable);
    d.p_scale = cotan_power_of_two_scale(max(cotan_max_abs(d.dpdx), cotan_max_abs(d.dpdy)));
    d.uv_scale = cotan_power_of_two_scale(max(max(abs(d.duvdx.x), abs(d.duvdx.y)),
        max(abs(d.duvdy.x), abs(d.duvdy.y))));
    d.dpdx = d.dpdx * d.p_scale;
    d.dpdy = d.dpdy * d.p_scale;
    d.duvdx = d.duvdx * d.uv_scale;
    d.duvdy = d.duvdy * d.uv_scale;
    return d;
}

// Returns the unit vector along v. Returns \`otherwise\`, unchanged, if v is zero, shorter than about 1e-43 (1e-6 times
// the lower clamp of cotan_power_of_two_scale), or not finite.
fn cotan_normalize_or(v_in: vec3f, otherwise: vec3f) -> vec3f {
    var v = v_in;
    let usable = cotan_sum_abs(v) <= 1e37;
    v = select(vec3f(0.0, 0.0, 0.0), v, usable);
    v = v * cotan_power_of_two_scale(cotan_max_abs(v));
    let length2 = dot(v, v);
    let unit = v * inverseSqrt(max(length2, 1e-12));
    return select(otherwise, unit, length2 > 1e-12);
}

// Returns the interpolated normal as a unit vector. If it is zero (normals cancelled out) or not finite: the normal of
// the plane of dpdx and dpdy, and (0,0,1) if that is degenerate too. The sign of the plane normal is that of dpdx x
// dpdy; such a pixel has no better information.
// n: any length. dpdx, dpdy: finite, as cotan_scale_differences returns them.
fn cotan_safe_normal(n: vec3f, dpdx: vec3f, dpdy: vec3f) -> vec3f {
    let z = vec3f(0.0, 0.0, 1.0);
    return cotan_normalize_or(n, cotan_normalize_or(cross(dpdx, dpdy), z));
}

// Returns the perturbed normal normalize(t*m.x + b*m.y + n*m.z). If that sum is shorter than 1e-6 or not finite (an
// unfilled texel, m = 0; a horizontal m where t = b = 0), returns f.n unchanged: unit, or as long as the caller passed
// it.
// m: decoded texel, along (+u, +v, outwards); any length.
fn cotan_apply(f: cotan_frame, m: vec3f) -> vec3f {
    let v = f.t * m.x + f.b * m.y + f.n * m.z;
    let length2 = dot(v, v);
    let usable = length2 > 1e-12 && length2 <= 1e37;
    let unit = v * inverseSqrt(select(1.0, length2, usable));
    return select(f.n, unit, usable);
}

// Scales u and v by one factor, so that the longer has length 1, and by \`sign\`: +1, -1, or 0 for U = V = 0.
// u, v: finite. If both are shorter than about 1e-43, U = V = 0.
fn cotan_triangle_unit(u_in: vec3f, v_in: vec3f, sign: f32) -> cotan_triangle {
    var u = u_in;
    var v = v_in;
    let rescale = cotan_power_of_two_scale(max(cotan_max_abs(u), cotan_max_abs(v)));
    u = u * rescale;
    v = v * rescale;
    let longest2 = max(dot(u, u), dot(v, v));
    let usable = longest2 > 1e-12;
    var scale = inverseSqrt(select(1.0, longest2, usable));
    scale = select(0.0, scale * sign, usable);
    var result: cotan_triangle;
    result.u = u * scale;
    result.v = v * scale;
    return result;
}

// Returns U and V from edges, including the sign: n x U  points along increasing u for every n on the side of
// \`normals\`.
//   dp1, dp2      p1 - p0 and p2 - p0, in the space of the frame
//   duv1, duv2    uv1 - uv0 and uv2 - uv0
//   normals       the sum of the three vertex normals, of any length, in the same space. It determines the outer side
//                 of the triangle, so that meshes wound against their normals are handled. If it is zero or not finite,
//                 the winding decides: the triangle is counterclockwise as seen from outside
// Total: a triangle without area, constant uv and non-finite input give U = V = 0. Where uv vary along one line only, U
// is parallel to V.
fn cotan_triangle_of_edges(dp1: vec3f, dp2: vec3f, duv1: vec2f, duv2: vec2f, normals: vec3f)
    -> cotan_triangle {
    let d = cotan_scale_differences(dp1, dp2, duv1, duv2);
    let u = d.dpdx * d.duvdy.x - d.dpdy * d.duvdx.x;
    let v = d.dpdx * d.duvdy.y - d.dpdy * d.duvdx.y;
    let face = cross(d.dpdx, d.dpdy);
    let side = cotan_sign(dot(face, cotan_normalize_or(normals, face)));
    return cotan_triangle_unit(u, v, select(0.0, side, dot(face, face) > 0.0));
}

// \`triangle\`: the frame of U and V at a pixel. t and b have the directions of \`cotangent\`, but the scale of the
// triangle, not of the pixel: where n is at an angle a to the triangle's own normal, slopes are those of \`cotangent\`
// times a factor between cos(a) and 1. View independent.
//   n      interpolated normal, any length, on the side that U and V were made for; f.n is unit. On back faces pass the
//          normal as interpolated and negate the result, or negate m.z instead: a flipped n reverses t and b
//   u, v   U and V in the space of n
// Total: non-finite U and V give t = b = 0.
// Source: [2013], summing before the cross product; see the head of this file.
fn cotan_frame_of_triangle(n: vec3f, u: vec3f, v: vec3f) -> cotan_frame {
    let zero = vec3f(0.0, 0.0, 0.0);
    let finite = cotan_sum_abs(u) + cotan_sum_abs(v) <= 1e37;
    var f: cotan_frame;
    f.n = cotan_safe_normal(n, zero, zero);
    f.t = cross(f.n, select(zero, u, finite));
    f.b = cross(f.n, select(zero, v, finite));
    return f;
}

// \`triangle\` in one step, from the edges of the triangle. n also determines the outer side, so it may be flipped on
// back faces. Equal to the frame from the vertices wherever n is less than 90 degrees from the triangle's own normal.
//   n             interpolated normal at the shaded point, any length; f.n is unit
//   dpdx, dpdy    edges p1 - p0 and p2 - p0
//   duvdx, duvdy  uv1 - uv0 and uv2 - uv0
// Total: a triangle without area, constant uv and non-finite input give t = b = 0.
fn cotan_frame_triangle(n: vec3f, dpdx: vec3f, dpdy: vec3f, duvdx: vec2f, duvdy: vec2f)
    -> cotan_frame {
    let d = cotan_scale_differences(dpdx, dpdy, duvdx, duvdy);
    let unit = cotan_safe_normal(n, d.dpdx, d.dpdy);
    let vectors = cotan_triangle_of_edges(dpdx, dpdy, duvdx, duvdy, unit);
    return cotan_frame_of_triangle(unit, vectors.u, vectors.v);
}

// The perturbed normal, unit.
// normal: interpolated at the shaded point.
// dpdx, dpdy: the triangle's edges p1 - p0 and p2 - p0, in normal's space.
// duvdx, duvdy: uv1 - uv0 and uv2 - uv0.
// texel: the normal map as sampled.
fn cotan_perturb_normal_from_edges(normal: vec3f, dpdx: vec3f, dpdy: vec3f, duvdx: vec2f,
    duvdy: vec2f, texel: vec3f) -> vec3f {
    let m = cotan_decode(texel);
    let frame = cotan_frame_triangle(normal, dpdx, dpdy, duvdx, duvdy);
    return cotan_apply(frame, m);
}
`,
};
