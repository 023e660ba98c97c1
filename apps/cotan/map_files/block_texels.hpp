// Shared by the block encoders.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "block.hpp"
#include "core/loops.hpp"
#include "cotan/scene.hpp"

// GCC notes that passing these vectors depends on the target's registers. They are never passed between object files.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wpsabi"
#endif

namespace cotan::app {

// Sixteen texels as four vectors, since compilers do not vectorise strict float sums. The order of the sums is fixed,
// so the bytes are the same on all machines.
using Four = float __attribute__((vector_size(16)));
using FourInts = std::int32_t __attribute__((vector_size(16)));
using Values = std::array<Four, 4>;

inline float& at(Values& values, std::size_t i) { return reinterpret_cast<float*>(values.data())[i]; }
inline float at(const Values& values, std::size_t i) { return values[i / 4][i % 4]; }

inline Four maxOf(Four a, Four b) { return a > b ? a : b; }
inline Four minOf(Four a, Four b) { return a < b ? a : b; }
inline float maxOf(Four f) { return std::max(std::max(f[0], f[1]), std::max(f[2], f[3])); }
inline float minOf(Four f) { return std::min(std::min(f[0], f[1]), std::min(f[2], f[3])); }
inline float maxOf(const Values& v) { return maxOf(maxOf(maxOf(v[0], v[1]), maxOf(v[2], v[3]))); }
inline float minOf(const Values& v) { return minOf(minOf(minOf(v[0], v[1]), minOf(v[2], v[3]))); }
inline float sumOf(Four f) { return (f[0] + f[1]) + (f[2] + f[3]); }

inline Four rootOf(Four f)
{
    const Four root{std::sqrt(f[0]), std::sqrt(f[1]), std::sqrt(f[2]), std::sqrt(f[3])};
    return root;
}

// Rounds to the nearest integer; values must be below 2^22, where the added constant leaves no bits for fractions.
inline Four rounded(Four f)
{
    constexpr float kNoFractions = 12582912;
    return f + kNoFractions - kNoFractions;
}

inline constexpr Four kZero{};

// Texel i of a block; outside the map, the nearest texel of its edge.
inline const float* texelAt(const Image& map, int left, int top, int i)
{
    const int column = std::min(left + i % 4, map.width - 1), row = std::min(top + i / 4, map.height - 1);
    return map.floats() + 4 * (std::size_t(row) * std::size_t(map.width) + std::size_t(column));
}

// Red and green of a block as codes. none: the code of a stored 0. one: the difference to that of a stored 1. most: the
// highest code.
inline void loadCodes(const Image& map, int left, int top, float none, float one, float most, Values& x, Values& y)
{
    for (int i = 0; i < 16; ++i) {
        const float* const texel = texelAt(map, left, top, i);
        at(x, std::size_t(i)) = none + texel[0] * one;
        at(y, std::size_t(i)) = none + texel[1] * one;
    }
    for (std::size_t i = 0; i < 4; ++i) {
        x[i] = minOf(maxOf(x[i], kZero), kZero + most);
        y[i] = minOf(maxOf(y[i], kZero), kZero + most);
    }
}

// Angular error of a unit vector after a small change of x and y: the squared angle is dx^2 + dy^2 + (u dx + v dy)^2
// with u = x / z and v = y / z. Values are in codes, squared angles in squared codes.
struct NormalTexels {
    Values x, y, u, v, weightX, weightY;
};

inline NormalTexels normalTexels(const Image& map, int left, int top, const CodeScale& scale, float most = 255)
{
    constexpr float kMinZ = 0.08f; // near the horizon the angle grows with the square root of the change
    NormalTexels t{};
    loadCodes(map, left, top, scale.zero - scale.unit, 2 * scale.unit, most, t.x, t.y);
    const float inverse = 1 / scale.unit;
    for (std::size_t i = 0; i < 4; ++i) {
        const Four nx = (t.x[i] - scale.zero) * inverse, ny = (t.y[i] - scale.zero) * inverse;
        const Four square = maxOf(1 - nx * nx - ny * ny, kZero + kMinZ * kMinZ);
        const Four z = rootOf(square);
        t.u[i] = nx / z;
        t.v[i] = ny / z;
        t.weightX[i] = 1 + t.u[i] * t.u[i];
        t.weightY[i] = 1 + t.v[i] * t.v[i];
    }
    return t;
}

// Encodes all blocks, in rows from the top. encode(left, top, to): writes the block whose first texel is (left, top).
template<class Encode> std::vector<std::byte> encodeBlocks(const Image& map, std::size_t bytes, const Encode& encode)
{
    const std::size_t across = std::size_t(map.width + 3) / 4, down = std::size_t(map.height + 3) / 4;
    std::vector<std::byte> blocks(across * down * bytes);
    parallelFor(std::size_t(0), down, [&](std::size_t row) {
        for (std::size_t column = 0; column < across; ++column)
            encode(int(column) * 4, int(row) * 4, blocks.data() + (row * across + column) * bytes);
    });
    return blocks;
}

} // namespace cotan::app
