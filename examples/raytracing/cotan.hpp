// Normal mapping, frame `exact` (total form), for C++17.
// Written by cotan shader from the portable text of Cotan; MIT licence.
//
// Normal map: three channels, (255c - 128)/127, green against increasing v.
//
// Needs from the caller:
//   normal     interpolated surface normal; any space, the same for all vectors
//   p0 p1 p2, uv0 uv1 uv2  the triangle's corners; no screen derivatives
//
// Call:
//   cotan_shader::cotan_vec3 n = cotan_shader::cotan_perturb_normal_from_edges(normal, p1 - p0, p2 - p0, uv1 - uv0, uv2 - uv0, texel);
// It returns the perturbed normal, unit, in the space of the arguments.
//
// Limits:
//   Total: no input gives NaN; where there is no frame (constant uv, no area, non-finite
//   differences) the result is the unit interpolated normal.
//   Change cotan_real to double for double precision.
//
// After:
//   [2006] C. Schueler, Normal Mapping without Precomputed Tangents, ShaderX5, 2006
//   [2013] C. Schueler, Followup: Normal Mapping Without Precomputed Tangents, 2013

#include <cmath>
#include <cstdint>
#include <cstring>

namespace cotan_shader {

using cotan_real = float; // or double
using cotan_uint = std::uint32_t;

struct cotan_vec2 { cotan_real x, y; };
struct cotan_vec3 { cotan_real x, y, z; };
struct cotan_vec4 { cotan_real x, y, z, w; };

inline cotan_vec3 operator+(cotan_vec3 a, cotan_vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline cotan_vec3 operator-(cotan_vec3 a, cotan_vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline cotan_vec3 operator*(cotan_vec3 a, cotan_vec3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
inline cotan_vec3 operator*(cotan_vec3 a, cotan_real k) { return {a.x * k, a.y * k, a.z * k}; }
inline cotan_vec3 operator/(cotan_vec3 a, cotan_vec3 b) { return {a.x / b.x, a.y / b.y, a.z / b.z}; }
inline cotan_vec3 operator/(cotan_vec3 a, cotan_real k) { return {a.x / k, a.y / k, a.z / k}; }
inline cotan_vec2 operator+(cotan_vec2 a, cotan_vec2 b) { return {a.x + b.x, a.y + b.y}; }
inline cotan_vec2 operator*(cotan_vec2 a, cotan_real k) { return {a.x * k, a.y * k}; }
inline cotan_vec2 operator-(cotan_vec2 a, cotan_vec2 b) { return {a.x - b.x, a.y - b.y}; }
inline cotan_vec4 operator*(cotan_vec4 a, cotan_real k) { return {a.x * k, a.y * k, a.z * k, a.w * k}; }
inline cotan_real dot(cotan_vec2 a, cotan_vec2 b) { return a.x * b.x + a.y * b.y; }
inline cotan_real dot(cotan_vec3 a, cotan_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline cotan_vec3 cross(cotan_vec3 a, cotan_vec3 b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline cotan_real max(cotan_real a, cotan_real b) { return a < b ? b : a; }
inline cotan_real min(cotan_real a, cotan_real b) { return b < a ? b : a; }
using std::abs;
using std::copysign;
using std::exp2;
using std::floor;
using std::log2;
using std::pow;
using std::sqrt;

// 1 / 2^e for 2^e <= m < 2^(e+1), from the bits of m's exponent. m: in [1e-37, 1e37].
inline float cotan_inverse_power_of_two(float m)
{
    std::uint32_t bits;
    std::memcpy(&bits, &m, sizeof m);
    bits = 0x7f000000u - (bits & 0x7f800000u);
    std::memcpy(&m, &bits, sizeof m);
    return m;
}
inline double cotan_inverse_power_of_two(double m)
{
    std::uint64_t bits;
    std::memcpy(&bits, &m, sizeof m);
    bits = 0x7fe0000000000000u - (bits & 0x7ff0000000000000u);
    std::memcpy(&m, &bits, sizeof m);
    return m;
}

struct cotan_frame
{
    cotan_vec3 t; // cotangent: covector along grad u
    cotan_vec3 b; // cobitangent: covector along grad v
    cotan_vec3 n; // normal
};

// The four differences after checking: either all finite and scaled by powers of two so that the largest position
// component and the largest uv component lie in [1,2), or all zero.
struct cotan_differences
{
    cotan_vec3 dpdx;
    cotan_vec3 dpdy;
    cotan_vec2 duvdx;
    cotan_vec2 duvdy;
    cotan_real p_scale; // the factor applied to dpdx and dpdy
    cotan_real uv_scale; // the factor applied to duvdx and duvdy
};

inline cotan_real cotan_inversesqrt(cotan_real x)
{
    return cotan_real(1) / sqrt(x);
}

// Returns the power of two s for which m*s lies in [1,2), after clamping m to [1e-37, 1e37]. Multiplying by s is exact,
// so formulas made of products give the same bits with scaled values, but no longer underflow or overflow.
// m: any magnitude (zero gives the largest scale), not NaN.
inline cotan_real cotan_power_of_two_scale(cotan_real m)
{
    m = min(max(m, cotan_real(1e-37)), cotan_real(1e37));
    return cotan_inverse_power_of_two(m);
}

// The signed value of a stored component, in [-1,1].
inline cotan_real cotan_expand(cotan_real c)
{
    cotan_real x = c * cotan_real(255.0 / 127.0) - cotan_real(128.0 / 127.0);
    return max(x, cotan_real(-1.0));
}

// The decoded texel: normal along (+u, +v, outwards). Not unit in general.
// texel: as sampled; two-channel maps use x and y only.
inline cotan_vec3 cotan_decode(cotan_vec3 texel)
{
    cotan_real x = cotan_expand(texel.x);
    cotan_real y = cotan_expand(texel.y);
    cotan_real z = cotan_expand(texel.z);
    cotan_vec3 m = cotan_vec3{x, y, z};
    return cotan_vec3{m.x, -m.y, m.z};
}

inline cotan_real cotan_sum_abs(cotan_vec3 a)
{
    return abs(a.x) + abs(a.y) + abs(a.z);
}

inline cotan_real cotan_max_abs(cotan_vec3 a)
{
    return max(abs(a.x), max(abs(a.y), abs(a.z)));
}

// Scales the differences (exactly, see cotan_power_of_two_scale) and zeroes unusable ones: all four if a component of
// dpdx or dpdy is not finite or exceeds 1e37; only duvdx and duvdy if a component of these does. Frames that do not
// depend on the common scale of positions or of uv are unchanged, bit for bit.
inline cotan_differences cotan_scale_differences(cotan_vec3 dpdx, cotan_vec3 dpdy,
    cotan_vec2 duvdx, cotan_vec2 duvdy)
{
    // A sum of magnitudes is NaN or infinite if one term is; max() would drop a NaN. Two comparisons of one kind with
    // the same number would become one with max() in OpenGL on Mesa, hence < and <=.
    bool p_usable = cotan_sum_abs(dpdx) + cotan_sum_abs(dpdy) < cotan_real(1e37);
    bool uv_usable = p_usable && abs(duvdx.x) + abs(duvdx.y) + abs(duvdy.x)
        + abs(duvdy.y) <= cotan_real(1e37);
    cotan_differences d;
    d.dpdx = p_usable ? dpdx : cotan_vec3{cotan_real(0.0), cotan_real(0.0), cotan_real(0.0)};
    d.dpdy = p_usable ? dpdy : cotan_vec3{cotan_real(0.0), cotan_real(0.0), cotan_real(0.0)};
    d.duvdx = uv_usable ? duvdx : cotan_vec2{cotan_real(0.0), cotan_real(0.0)};
    d.duvdy = uv_usable ? duvdy : cotan_vec2{cotan_real(0.0), cotan_real(0.0)};
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
inline cotan_vec3 cotan_normalize_or(cotan_vec3 v, cotan_vec3 otherwise)
{
    bool usable = cotan_sum_abs(v) <= cotan_real(1e37);
    v = usable ? v : cotan_vec3{cotan_real(0.0), cotan_real(0.0), cotan_real(0.0)};
    v = v * cotan_power_of_two_scale(cotan_max_abs(v));
    cotan_real length2 = dot(v, v);
    cotan_vec3 unit = v * cotan_inversesqrt(max(length2, cotan_real(1e-12)));
    return length2 > cotan_real(1e-12) ? unit : otherwise;
}

// Returns the interpolated normal as a unit vector. If it is zero (normals cancelled out) or not finite: the normal of
// the plane of dpdx and dpdy, and (0,0,1) if that is degenerate too. The sign of the plane normal is that of dpdx x
// dpdy; such a pixel has no better information.
// n: any length. dpdx, dpdy: finite, as cotan_scale_differences returns them.
inline cotan_vec3 cotan_safe_normal(cotan_vec3 n, cotan_vec3 dpdx, cotan_vec3 dpdy)
{
    cotan_vec3 z = cotan_vec3{cotan_real(0.0), cotan_real(0.0), cotan_real(1.0)};
    return cotan_normalize_or(n, cotan_normalize_or(cross(dpdx, dpdy), z));
}

// Returns the perturbed normal normalize(t*m.x + b*m.y + n*m.z). If that sum is shorter than 1e-6 or not finite (an
// unfilled texel, m = 0; a horizontal m where t = b = 0), returns f.n unchanged: unit, or as long as the caller passed
// it.
// m: decoded texel, along (+u, +v, outwards); any length.
inline cotan_vec3 cotan_apply(cotan_frame f, cotan_vec3 m)
{
    cotan_vec3 v = f.t * m.x + f.b * m.y + f.n * m.z;
    cotan_real length2 = dot(v, v);
    bool usable = length2 > cotan_real(1e-12) && length2 <= cotan_real(1e37);
    cotan_vec3 unit = v * cotan_inversesqrt(usable ? length2 : cotan_real(1.0));
    return usable ? unit : f.n;
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
inline cotan_frame cotan_frame_exact(cotan_vec3 n, cotan_vec3 dpdx, cotan_vec3 dpdy,
    cotan_vec2 duvdx, cotan_vec2 duvdy)
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

// The perturbed normal, unit.
// normal: interpolated at the shaded point.
// dpdx, dpdy: the triangle's edges p1 - p0 and p2 - p0, in normal's space.
// duvdx, duvdy: uv1 - uv0 and uv2 - uv0.
// texel: the normal map as sampled.
inline cotan_vec3 cotan_perturb_normal_from_edges(cotan_vec3 normal, cotan_vec3 dpdx,
    cotan_vec3 dpdy, cotan_vec2 duvdx, cotan_vec2 duvdy, cotan_vec3 texel)
{
    cotan_vec3 m = cotan_decode(texel);
    cotan_frame frame = cotan_frame_exact(normal, dpdx, dpdy, duvdx, duvdy);
    return cotan_apply(frame, m);
}

} // namespace cotan_shader
