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
// Missing:
//   A mesh without u and v has no bumps. With --differences shader it is drawn with
//   another frame.
//   In Godot 3 no shader can tell them from stored tangents in a mesh that has colours, too
//   (dark ones): its bumps are wrong.
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

// Returns the power of two s for which m*s lies in [1,2), after clamping m to [1e-37, 1e37]. Multiplying by s is exact,
// so formulas made of products give the same bits with scaled values, but no longer underflow or overflow.
// m: any magnitude (zero gives the largest scale), not NaN.
// Without access to the bits, the result is a power of two only to the precision of exp2.
float cotan_power_of_two_scale(float m)
{
    return exp2(-floor(log2(min(max(m, 1e-37), 1e37))));
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

// Scales u and v by one factor, so that the longer has length 1, and by `sign`: +1, -1, or 0 for U = V = 0.
// u, v: finite. If both are shorter than about 1e-43, U = V = 0.
void cotan_triangle_unit(vec3 u, vec3 v, float sign, out vec3 result_u, out vec3 result_v)
{
    float rescale = cotan_power_of_two_scale(max(cotan_max_abs(u), cotan_max_abs(v)));
    u = u * rescale;
    v = v * rescale;
    float longest2 = max(dot(u, u), dot(v, v));
    bool usable = longest2 > 1e-12;
    float scale = inversesqrt(usable ? longest2 : 1.0);
    scale = usable ? scale * sign : 0.0;
    result_u = u * scale;
    result_v = v * scale;
}

// Transforms U and V from model space to another space by the 3x3 matrix M of a model transform, given by its rows.
// Exact for every invertible M: U and V transform like edges, by M, and the scale is recomputed as for the transformed
// triangle. The outer side is that of model space. A frame made from the transformed edges differs only where a normal
// is more than 90 degrees from its triangle's normal either before or after the transform, but not both.
//   side   +1, or -1 if M mirrors (negative determinant). Use it with the normal transformed by the inverse transpose,
//          not flipped
// Total: non-finite or too small vectors give U = V = 0.
void cotan_triangle_transformed(vec3 object_u, vec3 object_v, vec3 row0, vec3 row1, vec3 row2,
    float side, out vec3 result_u, out vec3 result_v)
{
    vec3 u = vec3(dot(row0, object_u), dot(row1, object_u), dot(row2, object_u));
    vec3 v = vec3(dot(row0, object_v), dot(row1, object_v), dot(row2, object_v));
    bool finite = cotan_sum_abs(u) + cotan_sum_abs(v) <= 1e37;
    vec3 zero = vec3(0.0, 0.0, 0.0);
    cotan_triangle_unit(finite ? u : zero, finite ? v : zero, side, result_u, result_v);
}

// U and V in view space, for vertex(). Exact for every transform that has an inverse.
// u, v: as the mesh stores them: the longer has length 1. Anything else counts as missing and gives 0, such as
// zeros, or the white that a mesh without colours has.
// x, y, z: the columns MODELVIEW_MATRIX[0].xyz, MODELVIEW_MATRIX[1].xyz, MODELVIEW_MATRIX[2].xyz.
void cotan_triangle_in_view(vec3 u, vec3 v, vec3 x, vec3 y, vec3 z, out vec3 result_u,
    out vec3 result_v)
{
    float longest2 = max(dot(u, u), dot(v, v));
    float given = abs(longest2 - 1.0) < 0.01 ? 1.0 : 0.0;
    vec3 object_u;
    vec3 object_v;
    object_u = u * given;
    object_v = v * given;
    cotan_triangle_transformed(object_u, object_v, vec3(x.x, y.x, z.x), vec3(x.y, y.y, z.y),
        vec3(x.z, y.z, z.z), cotan_sign(dot(cross(x, y), z)), result_u, result_v);
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
    // In Godot 4: CUSTOM0.xyz and CUSTOM1.xyz.
    vec3 u;
    vec3 v;
    cotan_triangle_in_view(TANGENT, COLOR.rgb, MODELVIEW_MATRIX[0].xyz, MODELVIEW_MATRIX[1].xyz,
        MODELVIEW_MATRIX[2].xyz, u, v);
    cotan_u = u;
    cotan_v = v;
}

void fragment()
{
    // FRONT_FACING is inverted where the transform mirrors.
    float side = FRONT_FACING ? cotan_side : -cotan_side;
    NORMAL = cotan_perturb_normal_on_triangle(cotan_normal, cotan_u, cotan_v, texture(normal_map, UV).xyz) * side;
}
