// Normal mapping, frame `cotangent` (fused), for GLSL 3.30 and later.
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
//   No NaN for constant uv, zero differences, footprints without area or empty texels: the
//   result is then the interpolated normal, or as the function says. Undefined for
//   non-finite input and normals shorter than 0.01. Matches the frame to 0.01 degrees for (longest
//   position difference) * (longest uv difference) within 1e-12 .. 1e5, each within
//   1e-9 .. 1e6, and footprints that are not slivers (area a tenth of the longest squared).
//   Right for y-up and y-down targets, both handednesses, mirrored uv and transforms, and back
//   faces, with no uniform and no front-face flag.
//   In float, the error is 0.002 degrees for footprints of 1e-3 of the distance to the eye, and
//   0.12 degrees for 1e-5.
//   On flat-shaded uv the frame is constant per triangle: on coarse curved meshes it steps at
//   edges (a sphere of 32 segments: 1.1 degrees in the mean).
//
// After:
//   [2006] C. Schueler, Normal Mapping without Precomputed Tangents, ShaderX5, 2006
//   [2013] C. Schueler, Followup: Normal Mapping Without Precomputed Tangents, 2013

// Returns x with the sign bit of s. x: not negative. s: any value; -0 counts as negative.
float cotan_copy_sign(float x, float s)
{
    return uintBitsToFloat((floatBitsToUint(s) & 0x80000000u) | floatBitsToUint(x));
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

// `cotangent`, fused. Where uv vary along one line only, or for a footprint without area: like the frame (t parallel to
// b), except for the sign, which depends on rounding.
// Method: with t' and b' computed from the unnormalised n, t = t'/|n|. Multiplied by |n|, the sum is
// t' m.x |n|/L + b' m.y |n|/L + n m.z, where L is the length of the longer of t' and b'.
vec3 cotan_perturb_cotangent(vec3 n, vec3 dpdx, vec3 dpdy, vec2 duvdx, vec2 duvdy, vec3 m)
{
    vec3 dpdy_perp = cross(dpdy, n);
    vec3 dpdx_perp = cross(n, dpdx);
    vec3 t = dpdy_perp * duvdx.x + dpdx_perp * duvdy.x;
    vec3 b = dpdy_perp * duvdx.y + dpdx_perp * duvdy.y;
    float n2 = dot(n, n);
    float longest2 = max(max(dot(t, t), dot(b, b)), 1e-33);
    float scale = n2 * inversesqrt(n2 * longest2);
    scale = cotan_copy_sign(scale, dot(dpdx, dpdy_perp));
    vec3 v = t * (m.x * scale) + b * (m.y * scale) + n * (m.z + 1e-12);
    return v * inversesqrt(dot(v, v));
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
    return cotan_perturb_cotangent(normal, dpdx, dpdy, duvdx, duvdy, m);
}

// The same, taking the screen derivatives itself: call it in uniform control flow, before any
// branch or discard that differs within a 2x2 quad.
// position: camera-relative, interpolated, not normalised.
vec3 cotan_perturb_normal(vec3 normal, vec3 position, vec2 uv, vec3 texel)
{
    return cotan_perturb_normal_from_differences(normal, dFdx(position), dFdy(position), dFdx(uv),
        dFdy(uv), texel);
}
