// Cotan portable text: the language.
//
// The same files compile as GLSL 4.50, GLSL ES 3.00, HLSL and C++20. The includer says which by
// defining exactly one of the macros below; nothing is guessed from what a compiler predefines.
// No file of the portable text includes another, so that it also works where shader sources are
// simply joined. Order: lang.h first, then normal.h, frame.h (or fused.h alone), history.h, gradient.h, blend.h,
// light.h, sheen.h as needed.
//
//   COTAN_LANG_GLSL   GLSL 4.50 and GLSL ES 3.00
//   COTAN_LANG_HLSL   HLSL, shader model 5 and later
//   COTAN_LANG_CPP    C++20 over GLM; COTAN_CPP_REAL names the scalar type. Included through
//                     <cotan/portable.hpp>, once per scalar type, inside a namespace. It asks for
//                     cotan_inverse_power_of_two of that type, cotan_pack_half and
//                     cotan_unpack_half, as portable.hpp has them.
//   COTAN_LANG_GODOT  for `cotan shader` alone, which has Godot's words: floats without access to their bits
//
// What the text may use: scalars and vectors of two to four components, structs, functions,
// selects. What it may not: matrices (row and column order differ between the languages),
// derivatives and texture reads (they belong to the caller), swizzles, loops over data.

#ifndef COTAN_LANG_H
#define COTAN_LANG_H

#if defined(COTAN_LANG_GLSL)

#define COTAN_FUNCTION
#define cotan_real float
#define cotan_vec2 vec2
#define cotan_vec3 vec3
#define cotan_vec4 vec4
#define cotan_inversesqrt inversesqrt
#define cotan_mix mix
#define cotan_float_bits(x) floatBitsToUint(x)
#define cotan_bits_float(x) uintBitsToFloat(x)
#define cotan_uint uint
#define cotan_real_of(x) float(x)
#define cotan_pack_half(v) packHalf2x16(v)
#define cotan_unpack_half(word) unpackHalf2x16(word)

#elif defined(COTAN_LANG_HLSL)

#define COTAN_FUNCTION
#define cotan_real float
#define cotan_vec2 float2
#define cotan_vec3 float3
#define cotan_vec4 float4
#define cotan_inversesqrt rsqrt
#define cotan_mix lerp
#define cotan_float_bits(x) asuint(x)
#define cotan_bits_float(x) asfloat(x)
#define cotan_uint uint
#define cotan_real_of(x) float(x)
#define cotan_pack_half(v) (f32tof16((v).x) | (f32tof16((v).y) << 16))
#define cotan_unpack_half(word) float2(f16tof32((word) & 0xffffu), f16tof32((word) >> 16))

#elif defined(COTAN_LANG_CPP)

#define COTAN_FUNCTION inline
using cotan_real = COTAN_CPP_REAL;
using cotan_uint = std::uint32_t;
using cotan_vec2 = glm::vec<2, cotan_real, glm::packed_highp>;
using cotan_vec3 = glm::vec<3, cotan_real, glm::packed_highp>;
using cotan_vec4 = glm::vec<4, cotan_real, glm::packed_highp>;
using glm::cross;
using glm::dot;
using glm::max;
using glm::min;
using glm::mix;
using std::abs;
using std::copysign;
using std::exp2;
using std::pow;
using std::sqrt;
inline cotan_real cotan_inversesqrt(cotan_real x) { return cotan_real(1) / sqrt(x); }
inline cotan_real cotan_mix(cotan_real a, cotan_real b, cotan_real k) { return a + (b - a) * k; }
inline cotan_vec3 cotan_mix(cotan_vec3 a, cotan_vec3 b, cotan_real k) { return a + (b - a) * k; }
inline cotan_real cotan_real_of(cotan_uint x) { return cotan_real(x); }

#else
#error "cotan: define COTAN_LANG_GLSL, COTAN_LANG_HLSL or COTAN_LANG_CPP before including lang.h"
#endif

// The largest magnitude that counts as finite, in every precision. Anything above, an infinity
// or a NaN fails the comparison  abs(x) <= COTAN_HUGE.
#define COTAN_HUGE cotan_real(1e37)

// A power of two s such that m*s lies in [1,2), for m in [1e-37, 1e37]; m outside that range is
// clamped into it first. Multiplying by s is exact, so a formula of products gives the same bits
// before and after, except that it no longer under- or overflows.
// m: any magnitude (zero gives the largest scale), not NaN.
#if defined(COTAN_LANG_CPP)
inline cotan_real cotan_power_of_two_scale(cotan_real m)
{
    m = min(max(m, cotan_real(1e-37)), COTAN_HUGE);
    return cotan_inverse_power_of_two(m);
}
#elif defined(COTAN_LANG_GODOT)
// Without access to bits: as near to a power of two as exp2 is.
COTAN_FUNCTION cotan_real cotan_power_of_two_scale(cotan_real m)
{
    return exp2(-floor(log2(min(max(m, cotan_real(1e-37)), COTAN_HUGE))));
}
#else
COTAN_FUNCTION cotan_real cotan_power_of_two_scale(cotan_real m)
{
    m = min(max(m, cotan_real(1e-37)), COTAN_HUGE);
    cotan_uint exponent = cotan_float_bits(m) & 0x7f800000u;
    return cotan_bits_float((254u << 23) - exponent);
}
#endif

// x with the sign bit of s. x: not negative. s: any; -0 counts as negative.
#if defined(COTAN_LANG_CPP)
inline cotan_real cotan_copy_sign(cotan_real x, cotan_real s) { return copysign(x, s); }
#elif defined(COTAN_LANG_GODOT)
// Without access to bits: -0 counts as positive.
COTAN_FUNCTION cotan_real cotan_copy_sign(cotan_real x, cotan_real s)
{
    return s < cotan_real(0.0) ? -x : x;
}
#else
COTAN_FUNCTION cotan_real cotan_copy_sign(cotan_real x, cotan_real s)
{
    return cotan_bits_float((cotan_float_bits(s) & 0x80000000u) | cotan_float_bits(x));
}
#endif

#endif
