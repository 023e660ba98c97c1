// Normal mapping, frame `triangle` (fused), for Godot 3.2 and later and Godot 4.
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
//   u, v       two vectors of each triangle (triangleVectors of cotan/triangle.hpp), at all three
//              of its vertices, which belong to it alone
//              as six floats with the mesh, not compressed: in Godot 3 the arrays of tangents and of
//              colours, in Godot 4 those of CUSTOM0 and CUSTOM1. No stored tangents otherwise
//
// Call:
//   vec3 n = cotan_perturb_normal_on_triangle(normal, u, v, texture(normal_map, uv).xyz);
// It returns the perturbed normal, unit, in the space of the arguments.
//
// Limits:
//   No NaN for constant uv, zero edges or empty texels: the result is then the interpolated normal.
//   Undefined for non-finite input and normals shorter than 0.01. Matches the frame to 0.03 degrees,
//   the error of half floats, for (longest edge) * (longest uv difference) within 1e-12 .. 1e5, each
//   within 1e-9 .. 1e6, and triangles that are not slivers (area a tenth of the longest edge squared).
//   Slopes are those of `cotangent` times a factor between cos(a) and 1, where the normal is at an
//   angle a to the triangle's own.
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
varying float cotan_side;
varying vec3 cotan_u;
varying vec3 cotan_v;

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

// `triangle`, fused: U and V of triangle.h are the same at all pixels of the triangle. The length of n cancels, so n is
// not normalised.
//   u, v   U and V in the space of n, as cotan_triangle_of_edges returns them
vec3 cotan_perturb_triangle(vec3 n, vec3 u, vec3 v, vec3 m)
{
    vec3 w = u * m.x + v * m.y;
    // cross(n, w), written out and added last, so that compilers fold it into multiply-adds and latency is shorter.
    vec3 r = n * (m.z + 1e-12) + vec3(n.y, n.z, n.x) * vec3(w.z, w.x, w.y) - vec3(n.z, n.x, n.y)
        * vec3(w.y, w.z, w.x);
    return r * inversesqrt(dot(r, r));
}

// The perturbed normal, unit.
// normal: interpolated. On back faces leave it as it is and negate the result.
// u, v: the vectors of the triangle, the same at every pixel of it, in normal's space.
// texel: the normal map as sampled.
vec3 cotan_perturb_normal_on_triangle(vec3 normal, vec3 u, vec3 v, vec3 texel)
{
    return cotan_perturb_triangle(normal, u, v, cotan_decode(texel));
}

void vertex()
{
    vec3 x = MODELVIEW_MATRIX[0].xyz;
    vec3 y = MODELVIEW_MATRIX[1].xyz;
    vec3 z = MODELVIEW_MATRIX[2].xyz;
    float side = dot(cross(x, y), z) < 0.0 ? -1.0 : 1.0; // -1: it mirrors
    vec3 n = cross(y, z) * NORMAL.x + cross(z, x) * NORMAL.y + cross(x, y) * NORMAL.z;
    cotan_normal = normalize(n * side);
    cotan_side = side;
    // In Godot 4: CUSTOM0.xyz and CUSTOM1.xyz. For transforms with uniform scale.
    cotan_u = (MODELVIEW_MATRIX * vec4(TANGENT, 0.0)).xyz * side;
    cotan_v = (MODELVIEW_MATRIX * vec4(COLOR.rgb, 0.0)).xyz * side;
}

void fragment()
{
    // FRONT_FACING is inverted where the transform mirrors.
    float side = FRONT_FACING ? cotan_side : -cotan_side;
    NORMAL = cotan_perturb_normal_on_triangle(cotan_normal, cotan_u, cotan_v, texture(normal_map, UV).xyz) * side;
}
