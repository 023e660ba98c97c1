// Cotan portable text: the language.
//
// The same files compile as GLSL 4.50, GLSL ES 3.00, HLSL and C++20. The including file selects one language by
// defining exactly one of the macros below; predefined compiler macros are not consulted. No file of the portable text
// includes another, so the files also work where shader sources are simply concatenated. Order: lang.h first, then
// normal.h, frame.h (or fused.h alone), history.h, gradient.h, blend.h, light.h, sheen.h, space.h, mapping.h,
// parallax.h as needed.
//
//   COTAN_LANG_GLSL   GLSL 4.50 and GLSL ES 3.00
//   COTAN_LANG_HLSL   HLSL, shader model 5 and later
//   COTAN_LANG_CPP    C++20 with GLM; COTAN_CPP_REAL names the scalar type. <cotan/portable.hpp> includes the text once
//                     per scalar type, each time inside a namespace. It needs cotan_inverse_power_of_two of that type,
//                     cotan_pack_half and cotan_unpack_half; portable.hpp defines them
//   COTAN_LANG_GODOT  only for `cotan shader`, which supplies Godot's names: no access to the bits of floats
//
// The text uses scalars, vectors of two to four components, structs, functions and selects. It must not use matrices
// (row and column order differ between the languages), derivatives and texture reads (they belong to the caller),
// swizzles, or loops over data.

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
#define cotan_unpack_half(word) float2(f16tof32((word) & 0xffffu), f16tof32((word) >> 16))
// Rounds to nearest itself: f32tof16 may cut off, as FXC does with constants.
uint cotan_pack_half(float2 v)
{
    uint2 w = f32tof16(asfloat((asuint(v) + 0x1000u) & 0xffffe000u));
    return w.x | (w.y << 16u);
}

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
using std::floor;
using std::pow;
using std::sqrt;
inline cotan_real cotan_inversesqrt(cotan_real x) { return cotan_real(1) / sqrt(x); }
inline cotan_real cotan_mix(cotan_real a, cotan_real b, cotan_real k) { return a + (b - a) * k; }
inline cotan_vec3 cotan_mix(cotan_vec3 a, cotan_vec3 b, cotan_real k) { return a + (b - a) * k; }
inline cotan_real cotan_real_of(cotan_uint x) { return cotan_real(x); }

#else
#error "cotan: define COTAN_LANG_GLSL, COTAN_LANG_HLSL or COTAN_LANG_CPP before including lang.h"
#endif

// The largest magnitude that counts as finite, in every precision. Larger values, infinities and NaN fail the
// comparison  abs(x) <= COTAN_HUGE.
#define COTAN_HUGE cotan_real(1e37)

// Returns the power of two s for which m*s lies in [1,2), after clamping m to [1e-37, 1e37]. Multiplying by s is exact,
// so formulas made of products give the same bits with scaled values, but no longer underflow or overflow.
// m: any magnitude (zero gives the largest scale), not NaN.
#if defined(COTAN_LANG_CPP)
inline cotan_real cotan_power_of_two_scale(cotan_real m)
{
    m = min(max(m, cotan_real(1e-37)), COTAN_HUGE);
    return cotan_inverse_power_of_two(m);
}
#elif defined(COTAN_LANG_GODOT)
// Without access to the bits, the result is a power of two only to the precision of exp2.
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

// Returns x with the sign bit of s. x: not negative. s: any value; -0 counts as negative.
#if defined(COTAN_LANG_CPP)
inline cotan_real cotan_copy_sign(cotan_real x, cotan_real s) { return copysign(x, s); }
#elif defined(COTAN_LANG_GODOT)
// Without access to the bits, -0 counts as positive.
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
