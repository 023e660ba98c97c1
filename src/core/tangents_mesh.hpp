// What the tangent generators share: checks, welding, small vector helpers.
#pragma once

#include <algorithm>
#include <bit>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

#include <glm/geometric.hpp>

#include "cotan/tangents.hpp"
#include "large_array.hpp"
#include "parallel.hpp"

namespace cotan::tangents {

inline constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

// Whether the arrays fit together and every index is in range.
bool usable(const MeshView& mesh, std::size_t threads = 1);

// The bits of x; -0 and +0 have the same.
inline std::uint32_t bitsOf(float x) { return std::bit_cast<std::uint32_t>(x + 0.0f); }

template<class Key> std::uint32_t hashOf(const Key& key)
{
    std::uint64_t hash = 0;
    for (std::size_t j = 0; j < key.size(); j += 2) {
        hash = (hash ^ (key[j] | std::uint64_t(key[j + 1]) << 32)) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 32;
    }
    return static_cast<std::uint32_t>(hash);
}

// Has the memory there fetched meanwhile.
inline void fetch([[maybe_unused]] const void* memory)
{
#ifdef __GNUC__
    __builtin_prefetch(memory);
#endif
}

// Something that is called once; a plain pointer, since std::function weighs more than what it is for here.
struct Task {
    void (*run)(void* what) = nullptr;
    void* what = nullptr;

    void operator()() const
    {
        if (run)
            run(what);
    }
};

// For every i < count the smallest j that has the same key. `key(i)` returns an array of std::uint32_t of even length.
// Linear: hash tables with open addressing, one a thread; equal keys have equal hashes and so meet in one table.
// beside: something that one thread may do meanwhile; called once.
template<class KeyOf>
LargeArray<std::uint32_t> firstEqual(std::uint32_t count, const KeyOf& key, std::size_t threads = 1,
                                     const Task& beside = {})
{
    const LargeArray<std::uint32_t> hashes = makeLargeArray<std::uint32_t>(count);
    runParts(count, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            hashes[i] = hashOf(key(static_cast<std::uint32_t>(i)));
    });
    const std::size_t parts = std::max<std::size_t>(threads - 1, 1); // beside the one that is busy with something else
    const auto partOf = [&](std::uint32_t i) { return std::size_t(std::uint64_t(hashes[i]) * parts >> 32); };
    std::vector<std::size_t> begins(parts + 1, 0); // of the parts' tables
    runTasks(parts, threads, [&](std::size_t part) {
        std::size_t keys = parts == 1 ? count : 0;
        for (std::uint32_t i = 0; i < count && parts > 1; ++i)
            keys += partOf(i) == part;
        begins[part + 1] = keys + keys / 2 + 1;
    });
    std::partial_sum(begins.begin(), begins.end(), begins.begin());
    const LargeArray<std::uint32_t> tables = makeLargeArray<std::uint32_t>(begins.back());
    LargeArray<std::uint32_t> first = makeLargeArray<std::uint32_t>(count);
    runTasks(parts + 1, threads, [&](std::size_t part) {
        if (part == parts) {
            beside();
            return;
        }
        const std::span<std::uint32_t> table(&tables[begins[part]], begins[part + 1] - begins[part]);
        std::fill(table.begin(), table.end(), kNone);
        const auto home = [&](std::uint32_t i) { // spreads the part's hashes over its table
            return std::size_t(std::uint64_t(std::uint32_t(hashes[i] * parts)) * table.size() >> 32);
        };
        constexpr std::uint32_t kAhead = 16; // most slots are not in a cache
        for (std::uint32_t i = 0; i < count; ++i) {
            if (i + kAhead < count)
                fetch(&table[home(i + kAhead)]);
            if (partOf(i) != part)
                continue;
            std::size_t slot = home(i);
            // Most keys that differ are told apart by their hashes.
            while (table[slot] != kNone && (hashes[table[slot]] != hashes[i] || key(table[slot]) != key(i)))
                slot = slot + 1 < table.size() ? slot + 1 : 0;
            if (table[slot] == kNone)
                table[slot] = i;
            first[i] = table[slot];
        }
    });
    return first;
}

// For every vertex the first vertex that equals it in position, normal and texcoord. beside: as firstEqual has it.
LargeArray<std::uint32_t> weld(const MeshView& mesh, std::size_t threads = 1, const Task& beside = {});

// Vectors side by side, one a lane, as arrays by axis.
template<std::size_t kLanes> inline glm::vec3 vectorAt(const float (&axes)[3][kLanes], std::size_t lane)
{
    return {axes[0][lane], axes[1][lane], axes[2][lane]};
}
template<std::size_t kLanes> inline void put(float (&axes)[3][kLanes], std::size_t lane, glm::vec3 v)
{
    axes[0][lane] = v.x;
    axes[1][lane] = v.y;
    axes[2][lane] = v.z;
}

inline bool isZero(glm::vec3 v)
{
    return !(std::abs(v.x) > FLT_MIN || std::abs(v.y) > FLT_MIN || std::abs(v.z) > FLT_MIN);
}

// Lengths that can be squared, and the squares multiplied, in float.
inline bool isMiddling(float squaredLength) { return squaredLength > 1e-15f && squaredLength < 1e15f; }

// Where floats cannot hold the square, it is taken in double.
inline glm::vec3 normalizeOrZero(glm::vec3 v)
{
    if (const float squared = glm::dot(v, v); isMiddling(squared))
        return v * (1 / std::sqrt(squared));
    const glm::dvec3 d(v);
    return isZero(v) ? glm::vec3(0) : v * static_cast<float>(1 / std::sqrt(glm::dot(d, d)));
}

// v without its part along n, as a unit vector; zero if nothing is left.
inline glm::vec3 projectedUnit(glm::vec3 v, glm::vec3 n) { return normalizeOrZero(v - n * glm::dot(n, v)); }

// Arc cosine of x, taken into [-1,1]; off by 5e-7 radians at most. Several times as fast here as the
// library's, which is a call. Source: Abramowitz and Stegun, Handbook of Mathematical Functions,
// 4.4.46.
inline float fastArcCosine(float x)
{
    const float a = std::min(std::abs(x), 1.0f);
    const float low = 1.5707963050f + a * (-0.2145988016f + a * (0.0889789874f - a * 0.0501743046f));
    const float high = 0.0308918810f + a * (-0.0170881256f + a * (0.0066700901f - a * 0.0012624911f));
    const float squared = a * a;
    const float angle = std::sqrt(1.0f - a) * (low + squared * squared * high);
    return x < 0 ? 3.14159265f - angle : angle;
}

// The angle of a triangle at `corner`, between the projections of its sides along n; radians. A
// right one where a side vanishes.
inline float projectedAngle(glm::vec3 corner, glm::vec3 previous, glm::vec3 next, glm::vec3 n)
{
    const glm::vec3 toPrevious = previous - corner, toNext = next - corner;
    const glm::vec3 a = toPrevious - n * glm::dot(n, toPrevious);
    const glm::vec3 b = toNext - n * glm::dot(n, toNext);
    float cosine = 0;
    if (const float aa = glm::dot(a, a), bb = glm::dot(b, b); isMiddling(aa) && isMiddling(bb)) {
        cosine = glm::dot(a, b) / std::sqrt(aa * bb);
    } else if (!isZero(a) && !isZero(b)) {
        const glm::dvec3 p(a), q(b);
        cosine = static_cast<float>(glm::dot(p, q) / std::sqrt(glm::dot(p, p) * glm::dot(q, q)));
    }
    return fastArcCosine(cosine);
}

} // namespace cotan::tangents
