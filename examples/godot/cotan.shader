// Normal mapping, frame `cotangent` (fused), for Godot 3.2 and later and Godot 4.
// Written by cotan shader from the portable text of Cotan; MIT licence.
//
// Normal map: two channels, z = sqrt(1 - x^2 - y^2), (255c - 128)/127, green against increasing v.
//
// A complete material shader. To use it in your own, copy what is between shader_type and
// fragment() and the lines of fragment(). In Godot 4 use the functions alone (option
// --functions) as a .gdshaderinc.
//
// Needs:
//   normal_map the values of the file: imported without sRGB. Green up, as Godot expects
//   VERTEX     the position in view space, as it is in fragment(); not normalised
//   dFdx, dFdy In Godot 3 the driver GLES3: GLES2 has none. The frames triangle and smooth need none
//              with --differences caller
//   No tangents: disable them in the import of the mesh. Do not write NORMALMAP (NORMAL_MAP in
//   Godot 4), which uses stored tangents.
//   For ANISOTROPY, after NORMAL = ...:   TANGENT = cotan_direction_of_u(NORMAL, VERTEX, UV);
//                                         BINORMAL = cross(NORMAL, TANGENT);
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
//   GLES2 on phones may compute with 16 bits, which is too little for positions: use GLES3 there.
//   Whether guards against non-finite input hold is up to the driver.
//
// After:
//   [2006] C. Schueler, Normal Mapping without Precomputed Tangents, ShaderX5, 2006
//   [2013] C. Schueler, Followup: Normal Mapping Without Precomputed Tangents, 2013

shader_type spatial;
render_mode cull_disabled;

uniform sampler2D normal_map : hint_normal;
varying vec3 cotan_normal;

// Returns x with the sign bit of s. x: not negative. s: any value; -0 counts as negative.
// Without access to the bits, -0 counts as positive.
float cotan_copy_sign(float x, float s)
{
    return s < 0.0 ? -x : x;
}

// The signed value of a stored component, in [-1,1].
float cotan_expand(float c)
{
    float x = c * (255.0 / 127.0) - (128.0 / 127.0);
    return max(x, -1.0);
}

// Returns z of a unit vector from x and y; 0 where x^2 + y^2 > 1. Without this clamp, 6.9 % of 8-bit texels tilted by
// 60 to 90 degrees would give NaN.
float cotan_orthographic_z(vec2 xy)
{
    return sqrt(max(1.0 - dot(xy, xy), 0.0));
}

// The decoded texel: normal along (+u, +v, outwards). Not unit in general.
// texel: as sampled; two-channel maps use x and y only.
vec3 cotan_decode(vec3 texel)
{
    float x = cotan_expand(texel.x);
    float y = cotan_expand(texel.y);
    vec2 xy = vec2(x, y);
    vec3 m = vec3(x, y, cotan_orthographic_z(xy));
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

// The direction along increasing u on the surface, unit, perpendicular to n; zero for constant uv. For ANISOTROPY.
// n: the perturbed normal. position, uv: as above.
vec3 cotan_direction_of_u(vec3 n, vec3 position, vec2 uv)
{
    vec2 duvdx = dFdx(uv);
    vec2 duvdy = dFdy(uv);
    vec3 u = dFdx(position) * duvdy.y - dFdy(position) * duvdx.y;
    vec3 along = u - n * dot(n, u);
    float scale = inversesqrt(max(dot(along, along), 1e-36));
    return along * cotan_copy_sign(scale, duvdx.x * duvdy.y - duvdx.y * duvdy.x);
}

void vertex()
{
    vec3 x = MODELVIEW_MATRIX[0].xyz;
    vec3 y = MODELVIEW_MATRIX[1].xyz;
    vec3 z = MODELVIEW_MATRIX[2].xyz;
    float side = dot(cross(x, y), z) < 0.0 ? -1.0 : 1.0; // -1: it mirrors
    vec3 n = cross(y, z) * NORMAL.x + cross(z, x) * NORMAL.y + cross(x, y) * NORMAL.z;
    cotan_normal = normalize(n * side);
}

void fragment()
{
    // Seen from behind? FRONT_FACING is inverted in Godot 3 where the transform mirrors.
    vec3 seen = cross(dFdx(VERTEX), dFdy(VERTEX));
    vec3 away = mix(VERTEX, vec3(0.0, 0.0, -1.0), PROJECTION_MATRIX[3][3]); // from the eye
    float side = dot(cotan_normal, seen) * dot(seen, away) > 0.0 ? -1.0 : 1.0;
    NORMAL = cotan_perturb_normal(cotan_normal, VERTEX, UV, texture(normal_map, UV).xyz) * side;
}
