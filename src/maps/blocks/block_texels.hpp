// Shared by the block encoders.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "block.hpp"
#include "core/loops.hpp"
#include "cotan/scene.hpp"

// Passing these vectors depends on the target's registers. They are never passed between object files, and those of
// eight lanes only to functions that are always inlined.
#if defined(__GNUC__)
#pragma GCC diagnostic ignored "-Wpsabi"
#endif

namespace cotan::maps {

// Sixteen texels as four vectors, since compilers do not vectorise strict float sums. The order of the sums is fixed,
// so the bytes are the same on all machines.
using Four = float __attribute__((vector_size(16)));
using FourInts = std::int32_t __attribute__((vector_size(16)));
using Values = std::array<Four, 4>;

inline float& at(Values& values, std::size_t i) { return reinterpret_cast<float*>(values.data())[i]; }
inline float at(const Values& values, std::size_t i) { return values[i / 4][i % 4]; }

template<class V> [[gnu::always_inline]] inline V maxOf(V a, V b) { return a > b ? a : b; }
template<class V> [[gnu::always_inline]] inline V minOf(V a, V b) { return a < b ? a : b; }
inline float maxOf(Four f) { return std::max(std::max(f[0], f[1]), std::max(f[2], f[3])); }
inline float minOf(Four f) { return std::min(std::min(f[0], f[1]), std::min(f[2], f[3])); }
inline float maxOf(const Values& v) { return maxOf(maxOf(maxOf(v[0], v[1]), maxOf(v[2], v[3]))); }
inline float minOf(const Values& v) { return minOf(minOf(minOf(v[0], v[1]), minOf(v[2], v[3]))); }
inline float sumOf(Four f) { return (f[0] + f[1]) + (f[2] + f[3]); }

template<class V> [[gnu::always_inline]] inline V rootOf(V f)
{
    V root;
    for (std::size_t k = 0; k < sizeof(V) / sizeof(float); ++k)
        root[k] = std::sqrt(f[k]);
    return root;
}

// Rounds to the nearest integer; values must be below 2^22, where the added constant leaves no bits for fractions.
template<class V> [[gnu::always_inline]] inline V rounded(V f)
{
    constexpr float kNoFractions = 12582912;
    return f + kNoFractions - kNoFractions;
}

inline constexpr Four kZero{};

// Loops over eight candidates at once, four or eight lanes at a time. Their sums have the same order for both, and no
// multiply-add is fused, so the bytes are the same on all machines.
using Eight = float __attribute__((vector_size(32)));
using EightInts = std::int32_t __attribute__((vector_size(32)));
inline constexpr std::size_t kCandidates = 8;
using CandidateValues = std::array<float, kCandidates>;

// The lowest of eight errors; the first one of equals.
inline std::size_t leastOf(const CandidateValues& errors)
{
    std::size_t least = 0;
    for (std::size_t k = 1; k < kCandidates; ++k)
        least = errors[k] < errors[least] ? k : least;
    return least;
}

template<class V> struct LaneInts;
template<> struct LaneInts<Four> {
    using Type = FourInts;
};
template<> struct LaneInts<Eight> {
    using Type = EightInts;
};

template<class V> [[gnu::always_inline]] inline void loadLanes(V& to, const CandidateValues& from, std::size_t first)
{
    std::memcpy(&to, from.data() + first, sizeof to);
}

template<class V> [[gnu::always_inline]] inline V lanesOf(const Values& values, std::size_t first)
{
    V lanes;
    std::memcpy(&lanes, reinterpret_cast<const float*>(values.data()) + first, sizeof lanes);
    return lanes;
}

template<class V> [[gnu::always_inline]] inline void storeLanes(Values& values, std::size_t first, V lanes)
{
    std::memcpy(reinterpret_cast<float*>(values.data()) + first, &lanes, sizeof lanes);
}

// Calls kernel.template operator()<V>(), which must be inlined, with the widest vectors that the processor has. Not on
// Windows, where GCC does not align variables of 32 bytes on the stack (its bug 54412).
#if defined(__x86_64__) && defined(__GNUC__) && !defined(_WIN32)
#define COTAN_EIGHT_LANES
#endif

#ifdef COTAN_EIGHT_LANES
// Whether runLanes takes eight lanes: if the processor has them. A test sets it, to compare both.
inline bool& eightLanes()
{
    static bool eight = __builtin_cpu_supports("avx2") != 0;
    return eight;
}

template<class Kernel> [[gnu::target("avx2")]] void runEight(const Kernel& kernel)
{
    kernel.template operator()<Eight>();
}
#endif

template<class Kernel> inline void runLanes(const Kernel& kernel)
{
#ifdef COTAN_EIGHT_LANES
    if (eightLanes())
        return runEight(kernel);
#endif
    kernel.template operator()<Four>();
}

// Texel i of a block; outside the map, the nearest texel of its edge.
inline const float* texelAt(const Image& map, int left, int top, int i)
{
    const int column = std::min(left + i % 4, map.width - 1), row = std::min(top + i / 4, map.height - 1);
    return map.floats() + 4 * (std::size_t(row) * std::size_t(map.width) + std::size_t(column));
}

// Red and green of a block as codes. none: the code of a stored 0. one: the difference to that of a stored 1. most: the
// highest code.
template<class V = Four>
[[gnu::always_inline]] inline void loadCodes(const Image& map, int left, int top, float none, float one, float most,
                                             Values& x, Values& y)
{
    constexpr std::size_t kWidth = sizeof(V) / sizeof(float);
    const V zero{};
    for (std::size_t first = 0; first < 16; first += kWidth) {
        V red, green;
        for (std::size_t k = 0; k < kWidth; ++k) {
            const float* const texel = texelAt(map, left, top, int(first + k));
            red[k] = texel[0];
            green[k] = texel[1];
        }
        storeLanes(x, first, minOf(maxOf(none + red * one, zero), zero + most));
        storeLanes(y, first, minOf(maxOf(none + green * one, zero), zero + most));
    }
}

// Angular error of a unit vector after a small change of x and y: the squared angle is dx^2 + dy^2 + (u dx + v dy)^2
// with u = x / z and v = y / z. Values are in codes, squared angles in squared codes.
struct NormalTexels {
    Values x, y, u, v, weightX, weightY;
};

template<class V = Four>
[[gnu::always_inline]] inline NormalTexels normalTexels(const Image& map, int left, int top, const CodeScale& scale,
                                                        float most = 255)
{
    constexpr float kMinZ = 0.08f; // near the horizon the angle grows with the square root of the change
    NormalTexels t;
    loadCodes<V>(map, left, top, scale.zero - scale.unit, 2 * scale.unit, most, t.x, t.y);
    const float inverse = 1 / scale.unit;
    for (std::size_t first = 0; first < 16; first += sizeof(V) / sizeof(float)) {
        const V nx = (lanesOf<V>(t.x, first) - scale.zero) * inverse,
                ny = (lanesOf<V>(t.y, first) - scale.zero) * inverse;
        const V z = rootOf(maxOf(1 - nx * nx - ny * ny, V{} + kMinZ * kMinZ)), u = nx / z, v = ny / z;
        storeLanes(t.u, first, u);
        storeLanes(t.v, first, v);
        storeLanes(t.weightX, first, 1 + u * u);
        storeLanes(t.weightY, first, 1 + v * v);
    }
    return t;
}

// Fills a block of 16 bytes, from the lowest bit of the first byte upwards.
class BlockBits {
public:
    explicit BlockBits(std::byte* to) : to_(to) { std::fill_n(to, 16, std::byte(0)); }
    void put(int value, int count)
    {
        for (int i = 0; i < count; ++i, ++at_)
            to_[at_ / 8] |= std::byte((value >> i & 1) << at_ % 8);
    }

private:
    std::byte* to_;
    std::size_t at_ = 0;
};

// Encodes one channel of a block as BC4, and as the alpha of BC3: 8 bytes. values: codes; weights: of their squared
// errors.
void encodeAlpha(const Values& values, const Values& weights, std::byte* to);

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

} // namespace cotan::maps
