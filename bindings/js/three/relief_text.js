// Written by scripts/three-shader-text from what `cotan shader` prints. Not to be edited.
export const essl = `// Normal mapping, frame \`gradient\` (total form), for GLSL ES 3.00 (WebGL 2).
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

// A search along a ray through the relief.
struct cotan_relief
{
    vec2 uv; // where to read the height next; after the last reading, the result
    vec2 origin; // where the ray enters
    vec2 travel; // change of uv over the whole ray
    float at; // of the next reading: 0 where the ray enters, 1 at its end
    float step; // to the next reading
    float begin; // stored height of the ray where it enters
    float climb; // change of its stored height over the whole ray
    float found; // 1 once a reading was inside the relief, otherwise 0
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

// \`gradient\`: the true, metric surface gradients of u and v: |t| is the change of u per unit of length. Bumps have a
// fixed height in world units, so they fade as the object grows (truth E of docs/explanation/theory.md). t/|t| is that
// of \`cotangent\`; only the scale differs: 1 / (n . (dpdx x dpdy)). Total; n need not be unit, f.n is.
// Degenerate input: zero area, n in the plane of the face (where the division would overflow), constant uv or
// non-finite differences give t = b = 0.
// Source: [2020] section 3, after Blinn 1978, keeping the sign of the determinant.
cotan_frame cotan_frame_gradient(vec3 n, vec3 dpdx, vec3 dpdy, vec2 duvdx, vec2 duvdy)
{
    cotan_differences d = cotan_scale_differences(dpdx, dpdy, duvdx, duvdy);
    cotan_frame f;
    f.n = cotan_safe_normal(n, d.dpdx, d.dpdy);
    vec3 dpdy_perp = cross(d.dpdy, f.n);
    vec3 dpdx_perp = cross(f.n, d.dpdx);
    float determinant = dot(d.dpdx, dpdy_perp);
    bool usable = abs(determinant) > 1e-12;
    // Undoes both scales with one factor: gradients scale with uv / position.
    float scale = d.p_scale / (usable ? determinant : 1.0) / d.uv_scale;
    usable = usable && abs(scale) <= 1e37;
    scale = usable ? scale : 0.0;
    f.t = (dpdy_perp * d.duvdx.x + dpdx_perp * d.duvdy.x) * scale;
    f.b = (dpdy_perp * d.duvdx.y + dpdx_perp * d.duvdy.y) * scale;
    return f;
}

// Returns the change of (u, v) per unit of height along a ray. Total.
// f: \`gradient\`. direction: away from the surface, to the eye or to a light; any length.
// Degenerate input: rays within 2.9 degrees of the surface (n . direction < 0.05) are taken as at 2.9 degrees, with a
// factor that falls to zero at the horizon; rays from below, and frames or directions that are not finite, give zero.
vec2 cotan_uv_per_height(cotan_frame f, vec3 direction)
{
    vec3 zero = vec3(0.0, 0.0, 0.0);
    vec3 d = cotan_normalize_or(direction, zero);
    float lowest = 0.05;
    float up = dot(f.n, d);
    float k = up >= lowest ? 1.0 / up : max(up, 0.0) / (lowest * lowest);
    vec2 travel = vec2(dot(f.t, d) * k, dot(f.b, d) * k);
    bool usable = abs(travel.x) + abs(travel.y) <= 1e37;
    return usable ? travel : vec2(0.0, 0.0);
}

// Returns the offset of uv for one height that is taken as constant around the point: the cheapest form, for shallow
// maps. height: in the unit of the positions, negative below the surface: (h - 1) * depth of a stored h.
// Source: Kaneko 2001, equation 4, with gradients.
vec2 cotan_parallax_offset(cotan_frame f, vec3 to_eye, float height)
{
    return cotan_uv_per_height(f, to_eye) * height;
}

// Returns the search along the line of sight, from the surface down to \`depth\` below it.
// f: \`gradient\`. to_eye: to the eye, any length. uv: interpolated. depth: in the unit of positions; zero, negative or
// not finite leaves uv as they are. steps: readings before the search halves its step; less than 1 counts as 1.
// Source: [2005] section 4.
cotan_relief cotan_relief_start(cotan_frame f, vec3 to_eye, vec2 uv, float depth, float steps)
{
    bool usable = depth > 0.0 && depth <= 1e37;
    vec2 travel = cotan_uv_per_height(f, to_eye) * (usable ? -depth : 0.0);
    bool finite = abs(travel.x) + abs(travel.y) <= 1e37;
    cotan_relief r;
    r.origin = uv;
    r.travel = finite ? travel : vec2(0.0, 0.0);
    r.step = 1.0 / (steps >= 1.0 ? steps : 1.0);
    r.at = r.step;
    r.begin = 1.0;
    r.climb = -1.0;
    r.found = 0.0;
    r.uv = r.origin + r.travel * r.at;
    return r;
}

// Returns the search after a reading at r.uv. height: stored, 0 to 1; a NaN counts as outside the relief.
cotan_relief cotan_relief_next(cotan_relief r, float height)
{
    bool inside = height >= r.begin + r.climb * r.at;
    r.found = inside ? 1.0 : r.found;
    r.step = r.found > 0.5 ? r.step * 0.5 : r.step;
    r.at = min(max(r.at + (inside ? -r.step : r.step), 0.0), 1.0);
    r.uv = r.origin + r.travel * r.at;
    return r;
}

// Returns the distance along the line of sight from the surface to the point that was found, in units of \`depth\`: add
// it to the distance of the pixel for a depth that meets other objects where the relief does (gl_FragDepth).
// r: after the last reading. depth, to_eye: as for cotan_relief_start. It fades at grazing views as the relief does;
// views from below give zero.
float cotan_relief_distance(cotan_relief r, cotan_frame f, vec3 to_eye, float depth)
{
    vec3 zero = vec3(0.0, 0.0, 0.0);
    bool usable = depth > 0.0 && depth <= 1e37;
    float lowest = 0.05;
    float up = dot(f.n, cotan_normalize_or(to_eye, zero));
    float k = up >= lowest ? 1.0 / up : max(up, 0.0) / (lowest * lowest);
    float distance = r.at * depth * k;
    return usable && distance <= 1e37 ? distance : 0.0;
}

// Returns the search for the relief's own shadow: from a point of the relief up to the surface, towards a light. Run it
// with cotan_relief_next for \`steps\` readings; the point is in shadow if r.found is 1. A light behind the surface finds
// nothing: n . l shades that.
// uv, height: of the point that was found, the height as stored. to_light: any length.
cotan_relief cotan_relief_shadow(cotan_frame f, vec3 to_light, vec2 uv, float height, float depth,
    float steps)
{
    float h = min(max(height, 0.0), 1.0);
    cotan_relief r = cotan_relief_start(f, to_light, uv, depth * (1.0 - h), steps);
    r.travel = r.travel * -1.0;
    // Starts half an 8-bit step above the point, which otherwise shadows itself.
    r.begin = h + (0.5 / 255.0);
    r.climb = 1.0 - h;
    r.uv = r.origin + r.travel * r.at;
    return r;
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
    cotan_frame frame = cotan_frame_gradient(normal, dpdx, dpdy, duvdx, duvdy);
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
`;
export const wgsl = `// Normal mapping, frame \`gradient\` (total form), for WGSL.
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

// A search along a ray through the relief.
struct cotan_relief {
    uv: vec2f, // where to read the height next; after the last reading, the result
    origin: vec2f, // where the ray enters
    travel: vec2f, // change of uv over the whole ray
    at: f32, // of the next reading: 0 where the ray enters, 1 at its end
    step: f32, // to the next reading
    begin: f32, // stored height of the ray where it enters
    climb: f32, // change of its stored height over the whole ray
    found: f32, // 1 once a reading was inside the relief, otherwise 0
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

// \`gradient\`: the true, metric surface gradients of u and v: |t| is the change of u per unit of length. Bumps have a
// fixed height in world units, so they fade as the object grows (truth E of docs/explanation/theory.md). t/|t| is that
// of \`cotangent\`; only the scale differs: 1 / (n . (dpdx x dpdy)). Total; n need not be unit, f.n is.
// Degenerate input: zero area, n in the plane of the face (where the division would overflow), constant uv or
// non-finite differences give t = b = 0.
// Source: [2020] section 3, after Blinn 1978, keeping the sign of the determinant.
fn cotan_frame_gradient(n: vec3f, dpdx: vec3f, dpdy: vec3f, duvdx: vec2f, duvdy: vec2f)
    -> cotan_frame {
    let d = cotan_scale_differences(dpdx, dpdy, duvdx, duvdy);
    var f: cotan_frame;
    f.n = cotan_safe_normal(n, d.dpdx, d.dpdy);
    let dpdy_perp = cross(d.dpdy, f.n);
    let dpdx_perp = cross(f.n, d.dpdx);
    let determinant = dot(d.dpdx, dpdy_perp);
    var usable = abs(determinant) > 1e-12;
    // Undoes both scales with one factor: gradients scale with uv / position.
    var scale = d.p_scale / (select(1.0, determinant, usable)) / d.uv_scale;
    usable = usable && abs(scale) <= 1e37;
    scale = select(0.0, scale, usable);
    f.t = (dpdy_perp * d.duvdx.x + dpdx_perp * d.duvdy.x) * scale;
    f.b = (dpdy_perp * d.duvdx.y + dpdx_perp * d.duvdy.y) * scale;
    return f;
}

// Returns the change of (u, v) per unit of height along a ray. Total.
// f: \`gradient\`. direction: away from the surface, to the eye or to a light; any length.
// Degenerate input: rays within 2.9 degrees of the surface (n . direction < 0.05) are taken as at 2.9 degrees, with a
// factor that falls to zero at the horizon; rays from below, and frames or directions that are not finite, give zero.
fn cotan_uv_per_height(f: cotan_frame, direction: vec3f) -> vec2f {
    let zero = vec3f(0.0, 0.0, 0.0);
    let d = cotan_normalize_or(direction, zero);
    let lowest = 0.05;
    let up = dot(f.n, d);
    let k = select(max(up, 0.0) / (lowest * lowest), 1.0 / up, up >= lowest);
    let travel = vec2f(dot(f.t, d) * k, dot(f.b, d) * k);
    let usable = abs(travel.x) + abs(travel.y) <= 1e37;
    return select(vec2f(0.0, 0.0), travel, usable);
}

// Returns the offset of uv for one height that is taken as constant around the point: the cheapest form, for shallow
// maps. height: in the unit of the positions, negative below the surface: (h - 1) * depth of a stored h.
// Source: Kaneko 2001, equation 4, with gradients.
fn cotan_parallax_offset(f: cotan_frame, to_eye: vec3f, height: f32) -> vec2f {
    return cotan_uv_per_height(f, to_eye) * height;
}

// Returns the search along the line of sight, from the surface down to \`depth\` below it.
// f: \`gradient\`. to_eye: to the eye, any length. uv: interpolated. depth: in the unit of positions; zero, negative or
// not finite leaves uv as they are. steps: readings before the search halves its step; less than 1 counts as 1.
// Source: [2005] section 4.
fn cotan_relief_start(f: cotan_frame, to_eye: vec3f, uv: vec2f, depth: f32, steps: f32)
    -> cotan_relief {
    let usable = depth > 0.0 && depth <= 1e37;
    let travel = cotan_uv_per_height(f, to_eye) * (select(0.0, -depth, usable));
    let finite = abs(travel.x) + abs(travel.y) <= 1e37;
    var r: cotan_relief;
    r.origin = uv;
    r.travel = select(vec2f(0.0, 0.0), travel, finite);
    r.step = 1.0 / (select(1.0, steps, steps >= 1.0));
    r.at = r.step;
    r.begin = 1.0;
    r.climb = -1.0;
    r.found = 0.0;
    r.uv = r.origin + r.travel * r.at;
    return r;
}

// Returns the search after a reading at r.uv. height: stored, 0 to 1; a NaN counts as outside the relief.
fn cotan_relief_next(r_in: cotan_relief, height: f32) -> cotan_relief {
    var r = r_in;
    let inside = height >= r.begin + r.climb * r.at;
    r.found = select(r.found, 1.0, inside);
    r.step = select(r.step, r.step * 0.5, r.found > 0.5);
    r.at = min(max(r.at + (select(r.step, -r.step, inside)), 0.0), 1.0);
    r.uv = r.origin + r.travel * r.at;
    return r;
}

// Returns the distance along the line of sight from the surface to the point that was found, in units of \`depth\`: add
// it to the distance of the pixel for a depth that meets other objects where the relief does (gl_FragDepth).
// r: after the last reading. depth, to_eye: as for cotan_relief_start. It fades at grazing views as the relief does;
// views from below give zero.
fn cotan_relief_distance(r: cotan_relief, f: cotan_frame, to_eye: vec3f, depth: f32) -> f32 {
    let zero = vec3f(0.0, 0.0, 0.0);
    let usable = depth > 0.0 && depth <= 1e37;
    let lowest = 0.05;
    let up = dot(f.n, cotan_normalize_or(to_eye, zero));
    let k = select(max(up, 0.0) / (lowest * lowest), 1.0 / up, up >= lowest);
    let distance = r.at * depth * k;
    return select(0.0, distance, usable && distance <= 1e37);
}

// Returns the search for the relief's own shadow: from a point of the relief up to the surface, towards a light. Run it
// with cotan_relief_next for \`steps\` readings; the point is in shadow if r.found is 1. A light behind the surface finds
// nothing: n . l shades that.
// uv, height: of the point that was found, the height as stored. to_light: any length.
fn cotan_relief_shadow(f: cotan_frame, to_light: vec3f, uv: vec2f, height: f32, depth: f32,
    steps: f32) -> cotan_relief {
    let h = min(max(height, 0.0), 1.0);
    var r = cotan_relief_start(f, to_light, uv, depth * (1.0 - h), steps);
    r.travel = r.travel * -1.0;
    // Starts half an 8-bit step above the point, which otherwise shadows itself.
    r.begin = h + (0.5 / 255.0);
    r.climb = 1.0 - h;
    r.uv = r.origin + r.travel * r.at;
    return r;
}

// The perturbed normal, unit.
// normal: interpolated.
// dpdx, dpdy: differences of position along any two directions, in normal's space.
// duvdx, duvdy: differences of uv along the same two.
// texel: the normal map as sampled.
fn cotan_perturb_normal_from_differences(normal: vec3f, dpdx: vec3f, dpdy: vec3f, duvdx: vec2f,
    duvdy: vec2f, texel: vec3f) -> vec3f {
    let m = cotan_decode(texel);
    let frame = cotan_frame_gradient(normal, dpdx, dpdy, duvdx, duvdy);
    return cotan_apply(frame, m);
}

// The same, taking the screen derivatives itself: call it in uniform control flow, before any
// branch or discard that differs within a 2x2 quad.
// position: camera-relative, interpolated, not normalised.
fn cotan_perturb_normal(normal: vec3f, position: vec3f, uv: vec2f, texel: vec3f) -> vec3f {
    return cotan_perturb_normal_from_differences(normal, dpdxFine(position), dpdyFine(position),
        dpdxFine(uv), dpdyFine(uv), texel);
}
`;
