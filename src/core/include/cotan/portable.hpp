// The portable text of shaders/cotan/ as C++: once over float in cotan::f32, once over double in cotan::f64. The names
// are those of the shaders: cotan::f32::cotan_frame_cotangent and so on. For other scalar types (half, an operation
// counter) include the text the same way, with a cotan_inverse_power_of_two for that type, and with cotan_pack_half
// from here.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/packing.hpp>

#include "cotan/packed.hpp"

#define COTAN_LANG_CPP

namespace cotan {

// Returns 1 / 2^e for 2^e <= m < 2^(e+1), from the bits of m's exponent. m: positive, at least 2^-125 and less than
// 2^127 (double: 2^-1021, 2^1023).
inline float cotan_inverse_power_of_two(float m)
{
    return std::bit_cast<float>(0x7f000000u - (std::bit_cast<std::uint32_t>(m) & 0x7f800000u));
}
inline double cotan_inverse_power_of_two(double m)
{
    constexpr std::uint64_t kExponent = 0x7ff0000000000000u, kTwiceOne = 0x7fe0000000000000u;
    return std::bit_cast<double>(kTwiceOne - (std::bit_cast<std::uint64_t>(m) & kExponent));
}

// Pack two halfs into a word, the first in the low bits, rounding to the nearest, and unpack them.
inline std::uint32_t cotan_pack_half(packed::vec2 v) { return glm::packHalf2x16(v); }
inline packed::vec2 cotan_unpack_half(std::uint32_t word) { return glm::unpackHalf2x16(word); }

} // namespace cotan

namespace cotan::f32 {
#define COTAN_CPP_REAL float
#include "cotan/portable_text.inc"
#undef COTAN_CPP_REAL
} // namespace cotan::f32

namespace cotan::f64 {
#define COTAN_CPP_REAL double
#include "cotan/portable_text.inc"
#undef COTAN_CPP_REAL
} // namespace cotan::f64

#undef COTAN_LANG_CPP
