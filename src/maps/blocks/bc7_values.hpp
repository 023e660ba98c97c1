// Shared by the fits of BC7: stored values, levels, angles and least squares.
#pragma once

#include <array>

#include "block_texels.hpp"

namespace cotan::maps::bc7 {

inline constexpr int kRounds = 2; // of least squares

inline constexpr float kRadian = 127; // in codes

// The value of 8 bits of a stored one of `bits`.
template<class Int> Int expanded(Int stored, int bits)
{
    return bits >= 8 ? stored : stored << (8 - bits) | stored >> (2 * bits - 8);
}

// Rounds half up, as decoders do; not negative.
[[gnu::always_inline]] inline Four wholeOf(Four f)
{
    return __builtin_convertvector(__builtin_convertvector(f + 0.5f, FourInts), Four);
}

// The weight of the second end, in 64ths.
[[gnu::always_inline]] inline Four weightOf(Four index, int indexBits)
{
    return rounded(index * (64.0f / float((1 << indexBits) - 1)));
}

// The stored value nearest to a code; low: its lowest bit, if this is shared.
[[gnu::always_inline]] inline FourInts nearestStored(Four code, int bits, bool lowBits, int low)
{
    const float highest = float((1 << bits) - 1);
    const Four value = minOf(maxOf(code * (highest / 255), kZero), kZero + highest);
    if (!lowBits)
        return __builtin_convertvector(value + 0.5f, FourInts);
    const Four half = minOf(maxOf((value - float(low)) * 0.5f + 0.5f, kZero), kZero + float(1 << (bits - 1)) - 0.5f);
    return __builtin_convertvector(half, FourInts) * 2 + low;
}

// Squared angles, from the dot products of vectors with normals and their squared lengths.
[[gnu::always_inline]] inline Four squaredAngle(Four along, Four square)
{
    const Four back = along > 0.0f ? along : -along;
    return (kRadian * kRadian) * (1 - along * back / square);
}

// Weighted least squares of values on a line whose positions are known. Sums of the weights of both ends.
struct LeastSquares {
    Values first, second;
    float aa = 0, ab = 0, bb = 0, determinant = 0;

    LeastSquares(const Values& weights, const Values& indices, int indexBits)
    {
        Four aa4{}, ab4{}, bb4{};
        for (std::size_t i = 0; i < 4; ++i) {
            const Four b = weightOf(indices[i], indexBits) * (1.0f / 64), a = 1 - b;
            first[i] = weights[i] * a;
            second[i] = weights[i] * b;
            aa4 += first[i] * a;
            ab4 += first[i] * b;
            bb4 += second[i] * b;
        }
        aa = sumOf(aa4);
        ab = sumOf(ab4);
        bb = sumOf(bb4);
        determinant = aa * bb - ab * ab;
    }
    bool solvable() const { return determinant > 1e-4f * aa * bb; }
    void solve(const Values& values, float& from, float& to) const
    {
        Four av4{}, bv4{};
        for (std::size_t i = 0; i < 4; ++i) {
            av4 += first[i] * values[i];
            bv4 += second[i] * values[i];
        }
        const float av = sumOf(av4), bv = sumOf(bv4);
        from = (bb * av - ab * bv) / determinant;
        to = (aa * bv - ab * av) / determinant;
    }
};

// By how much the vector to v may be longer until a code leaves its range.
inline float growthOf(float v, float zero) { return v > 0 ? (255 - zero) / v : v < 0 ? zero / -v : 1e9f; }

} // namespace cotan::maps::bc7
