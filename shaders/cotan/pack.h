// Cotan portable text: compact encodings of the vectors that frames are made from. Include lang.h first. For normal
// maps see normal.h.
//
//   cotan_pack_triangle      U and V of a triangle as six halfs, 12 bytes
//   cotan_pack_smooth8       t and b of a vertex, 8 bytes: four numbers, as a SNORM16x4 attribute
//   cotan_pack_smooth4       t and b of a vertex, 4 bytes
//   cotan_pack_tangent2      a MikkTSpace tangent and its sign, 2 bytes
//
// The last three use a basis that is derived from the normal. Unpacking therefore needs the same normal as packing, bit
// for bit: as stored, before it is transformed. Errors are angles of the unpacked directions, in float
// (docs/explanation/triangle.md has a table).

#ifndef COTAN_PACK_H
#define COTAN_PACK_H

// Two unit vectors that are perpendicular to each other and to the unit normal n; cross(x, y) = n.
// Source: T. Duff et al., Building an Orthonormal Basis, Revisited, JCGT 6(1), 2017.
struct cotan_basis {
    cotan_vec3 x;
    cotan_vec3 y;
};

COTAN_FUNCTION cotan_basis cotan_basis_of_normal(cotan_vec3 n)
{
    cotan_real s = n.z < cotan_real(0.0) ? cotan_real(-1.0) : cotan_real(1.0);
    cotan_real a = cotan_real(-1.0) / (s + n.z);
    cotan_real c = n.x * n.y * a;
    cotan_basis basis;
    basis.x = cotan_vec3(cotan_real(1.0) + s * n.x * n.x * a, s * c, -s * n.x);
    basis.y = cotan_vec3(c, s + n.y * n.y * a, -n.y);
    return basis;
}

// ---- a triangle in 12 bytes -------------------------------------------------------------------

// U and V of triangle.h in three words of two halfs each, the first in the low bits, as GLSL's packHalf2x16 stores
// them; the same in WGSL, MSL and HLSL. Rounding changes a normal by at most 0.03 degrees.
struct cotan_packed_triangle {
    cotan_uint a;
    cotan_uint b;
    cotan_uint c;
};

COTAN_FUNCTION cotan_packed_triangle cotan_pack_triangle(cotan_vec3 u, cotan_vec3 v)
{
    cotan_packed_triangle p;
    p.a = cotan_pack_half(cotan_vec2(u.x, u.y));
    p.b = cotan_pack_half(cotan_vec2(u.z, v.x));
    p.c = cotan_pack_half(cotan_vec2(v.y, v.z));
    return p;
}

COTAN_FUNCTION cotan_vec3 cotan_unpack_triangle_u(cotan_packed_triangle p)
{
    cotan_vec2 a = cotan_unpack_half(p.a);
    return cotan_vec3(a.x, a.y, cotan_unpack_half(p.b).x);
}

COTAN_FUNCTION cotan_vec3 cotan_unpack_triangle_v(cotan_packed_triangle p)
{
    cotan_vec2 c = cotan_unpack_half(p.c);
    return cotan_vec3(cotan_unpack_half(p.b).y, c.x, c.y);
}

// ---- `smooth` in 8 and in 4 bytes a vertex ----------------------------------------------------

// Two covectors in the plane of n.
struct cotan_covectors {
    cotan_vec3 t;
    cotan_vec3 b;
};

// Returns t and b in the basis of n, scaled so that the longer has length 1. Zero and non-finite input give zero.
COTAN_FUNCTION cotan_vec4 cotan_covectors_in_basis(cotan_vec3 n, cotan_vec3 t, cotan_vec3 b)
{
    cotan_basis basis = cotan_basis_of_normal(n);
    cotan_vec4 q = cotan_vec4(dot(t, basis.x), dot(t, basis.y), dot(b, basis.x), dot(b, basis.y));
    bool finite = abs(q.x) + abs(q.y) + abs(q.z) + abs(q.w) <= COTAN_HUGE;
    cotan_vec4 zero =
        cotan_vec4(cotan_real(0.0), cotan_real(0.0), cotan_real(0.0), cotan_real(0.0));
    q = finite ? q : zero;
    cotan_real largest = max(max(abs(q.x), abs(q.y)), max(abs(q.z), abs(q.w)));
    q = q * cotan_power_of_two_scale(largest);
    cotan_real longest2 = max(q.x * q.x + q.y * q.y, q.z * q.z + q.w * q.w);
    return q * cotan_inversesqrt(max(longest2, cotan_real(1e-12)));
}

// The inverse of cotan_covectors_in_basis; scales the longer covector to length 1 again.
COTAN_FUNCTION cotan_covectors cotan_covectors_of_basis(cotan_vec3 n, cotan_vec4 q)
{
    cotan_basis basis = cotan_basis_of_normal(n);
    cotan_real longest2 = max(q.x * q.x + q.y * q.y, q.z * q.z + q.w * q.w);
    q = q * cotan_inversesqrt(max(longest2, cotan_real(1e-12)));
    cotan_covectors c;
    c.t = basis.x * q.x + basis.y * q.y;
    c.b = basis.x * q.z + basis.y * q.w;
    return c;
}

// Maps x in [-1, 1] to an integer from 0 to 2 * zero, rounding to the nearest; `zero` is the code of 0.
COTAN_FUNCTION cotan_uint cotan_quantize(cotan_real x, cotan_real zero)
{
    x = min(max(x, cotan_real(-1.0)), cotan_real(1.0));
    return cotan_uint(x * zero + zero + cotan_real(0.5));
}

// Packs t and b into 8 bytes: four numbers in [-1, 1], to be stored as SNORM16x4. A vertex attribute of that format
// returns them to 1/32767.
//   n      the vertex normal, unit
//   t, b   perpendicular to n, with any common scale
COTAN_FUNCTION cotan_vec4 cotan_pack_smooth8(cotan_vec3 n, cotan_vec3 t, cotan_vec3 b)
{
    return cotan_covectors_in_basis(n, t, b);
}

COTAN_FUNCTION cotan_covectors cotan_unpack_smooth8(cotan_vec3 n, cotan_vec4 q)
{
    return cotan_covectors_of_basis(n, q);
}

// Packs t and b into 4 bytes. Up to a common scale they are three numbers: all four components are divided by the
// largest, which is then omitted. Bits 0 to 9, 10 to 19 and 20 to 28: the other components in order, as cotan_quantize
// returns them with the zeros 511, 511 and 255. Bit 29: the largest is negative. Bits 30 and 31: its index. t = b = 0
// cannot be encoded this way and is stored as 0xffffffff.
COTAN_FUNCTION cotan_uint cotan_pack_smooth4(cotan_vec3 n, cotan_vec3 t, cotan_vec3 b)
{
    cotan_vec4 q = cotan_covectors_in_basis(n, t, b);
    cotan_uint which = 0u;
    cotan_real largest = q.x;
    cotan_vec3 rest = cotan_vec3(q.y, q.z, q.w);
    if (abs(q.y) > abs(largest)) {
        which = 1u;
        largest = q.y;
        rest = cotan_vec3(q.x, q.z, q.w);
    }
    if (abs(q.z) > abs(largest)) {
        which = 2u;
        largest = q.z;
        rest = cotan_vec3(q.x, q.y, q.w);
    }
    if (abs(q.w) > abs(largest)) {
        which = 3u;
        largest = q.w;
        rest = cotan_vec3(q.x, q.y, q.z);
    }
    bool usable = abs(largest) > cotan_real(0.0);
    cotan_real scale = cotan_real(1.0) / (usable ? abs(largest) : cotan_real(1.0));
    cotan_uint word = cotan_quantize(rest.x * scale, cotan_real(511.0))
        | (cotan_quantize(rest.y * scale, cotan_real(511.0)) << 10u)
        | (cotan_quantize(rest.z * scale, cotan_real(255.0)) << 20u)
        | (largest < cotan_real(0.0) ? 0x20000000u : 0u) | (which << 30u);
    return usable ? word : 0xffffffffu;
}

COTAN_FUNCTION cotan_covectors cotan_unpack_smooth4(cotan_vec3 n, cotan_uint word)
{
    cotan_real x = cotan_real_of(word & 1023u) / cotan_real(511.0) - cotan_real(1.0);
    cotan_real y = cotan_real_of((word >> 10u) & 1023u) / cotan_real(511.0) - cotan_real(1.0);
    cotan_real z = cotan_real_of((word >> 20u) & 511u) / cotan_real(255.0) - cotan_real(1.0);
    cotan_real largest = (word & 0x20000000u) != 0u ? cotan_real(-1.0) : cotan_real(1.0);
    cotan_uint which = word >> 30u;
    cotan_vec4 q = cotan_vec4(largest, x, y, z);
    if (which == 1u)
        q = cotan_vec4(x, largest, y, z);
    if (which == 2u)
        q = cotan_vec4(x, y, largest, z);
    if (which == 3u)
        q = cotan_vec4(x, y, z, largest);
    q = word == 0xffffffffu ? q * cotan_real(0.0) : q;
    return cotan_covectors_of_basis(n, q);
}

// ---- a MikkTSpace tangent in 2 bytes a vertex -------------------------------------------------

// Packs a tangent into 2 bytes. Bits 0 to 14: its direction in the basis of n; bit 15: the handedness is negative. The
// direction is a position on the square |x| + |y| = 1 in 32768 steps, so no sine is needed. The maximum error is 0.007
// degrees. For assets that must stay MikkTSpace.
//   n            the vertex normal, unit
//   t            the tangent, perpendicular to n, of any length. Zero or non-finite tangents are stored as basis.x
//   handedness   only its sign is kept
COTAN_FUNCTION cotan_uint cotan_pack_tangent2(cotan_vec3 n, cotan_vec3 t, cotan_real handedness)
{
    cotan_basis basis = cotan_basis_of_normal(n);
    cotan_real x = dot(t, basis.x);
    cotan_real y = dot(t, basis.y);
    cotan_real sum = abs(x) + abs(y);
    x = sum > cotan_real(0.0) && sum <= COTAN_HUGE ? x / sum : cotan_real(1.0);
    // From 0 to 2 over the half with y >= 0, from 2 to 4 over the other half.
    cotan_real position = y < cotan_real(0.0) ? cotan_real(3.0) + x : cotan_real(1.0) - x;
    cotan_uint steps = cotan_uint(position * cotan_real(8192.0) + cotan_real(0.5)) & 0x7fffu;
    return steps | (handedness < cotan_real(0.0) ? 0x8000u : 0u);
}

// Returns the unit tangent in xyz and the handedness, +1 or -1, in w.
COTAN_FUNCTION cotan_vec4 cotan_unpack_tangent2(cotan_vec3 n, cotan_uint word)
{
    cotan_basis basis = cotan_basis_of_normal(n);
    cotan_real position = cotan_real_of(word & 0x7fffu) / cotan_real(8192.0);
    cotan_real x = position > cotan_real(2.0) ? position - cotan_real(3.0) : cotan_real(1.0) - position;
    cotan_real y = cotan_real(1.0) - abs(x);
    y = position > cotan_real(2.0) ? -y : y;
    cotan_vec3 t = basis.x * x + basis.y * y;
    t = t * cotan_inversesqrt(dot(t, t));
    return cotan_vec4(t.x, t.y, t.z, (word & 0x8000u) != 0u ? cotan_real(-1.0) : cotan_real(1.0));
}

#endif
