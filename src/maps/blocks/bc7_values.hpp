// Shared by the fits of BC7: stored values, levels, angles and least squares.
#pragma once

#include <array>

#include "block_texels.hpp"

namespace cotan::maps::bc7 {

inline constexpr int kRounds = 2;        // of least squares
inline constexpr float kImproved = 0.7f; // of a limit: first fits with more error are not improved

inline constexpr float kRadian = 127; // in codes

// The value of 8 bits of a stored one of `bits`.
template<class Int> Int expanded(Int stored, int bits)
{
    return bits >= 8 ? stored : stored << (8 - bits) | stored >> (2 * bits - 8);
}

// Rounds half up, as decoders do; not negative.
template<class V> [[gnu::always_inline]] inline V wholeOf(V f)
{
    return __builtin_convertvector(__builtin_convertvector(f + 0.5f, typename LaneInts<V>::Type), V);
}

// The weight of the second end, in 64ths.
template<class V> [[gnu::always_inline]] inline V weightOf(V index, int indexBits)
{
    return rounded(index * (64.0f / float((1 << indexBits) - 1)));
}

// The stored value nearest to a code; low: its lowest bit, if this is shared.
template<class V>
[[gnu::always_inline]] inline typename LaneInts<V>::Type nearestStored(V code, int bits, bool lowBits, int low)
{
    using Ints = typename LaneInts<V>::Type;
    const V zero{};
    const float highest = float((1 << bits) - 1);
    const V value = minOf(maxOf(code * (highest / 255), zero), zero + highest);
    if (!lowBits)
        return __builtin_convertvector(value + 0.5f, Ints);
    const V half = minOf(maxOf((value - float(low)) * 0.5f + 0.5f, zero), zero + float(1 << (bits - 1)) - 0.5f);
    return __builtin_convertvector(half, Ints) * 2 + low;
}

// Squared angles, from the dot products of vectors with normals and their squared lengths.
template<class V> [[gnu::always_inline]] inline V squaredAngle(V along, V square)
{
    const V back = maxOf(along, -along);
    return (kRadian * kRadian) * (1 - along * back / square);
}

// Sums of texels in an order that does not depend on the number of lanes.
template<class V> struct TexelSums {
    static constexpr std::size_t kWidth = sizeof(V) / sizeof(float);
    std::array<V, 8 / kWidth> sums{};

    [[gnu::always_inline]] void add(std::size_t first, V more) { sums[first / kWidth % sums.size()] += more; }
    [[gnu::always_inline]] float total() const
    {
        Four low, high;
        std::memcpy(&low, sums.data(), sizeof low);
        std::memcpy(&high, reinterpret_cast<const std::byte*>(sums.data()) + sizeof low, sizeof high);
        return sumOf(low + high);
    }
};

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
