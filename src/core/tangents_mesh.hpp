// Shared code of the tangent generators: checks, welding, vector helpers.
#pragma once

#include <algorithm>
#include <bit>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <tuple>
#include <vector>

#include <glm/geometric.hpp>

#include "cotan/tangents.hpp"
#include "large_array.hpp"
#include "loops.hpp"

namespace cotan::tangents {

inline constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

// Whether the array sizes match and every index is in range.
bool usable(const MeshView& mesh, std::size_t threads = 1);

// Returns the bits of x; those of +0 for -0.
inline std::uint32_t bitsOf(float x) { return std::bit_cast<std::uint32_t>(x + 0.0f); }

template<class Key> std::uint32_t hashOf(const Key& key)
{
    std::uint64_t hash = 0;
    static_assert(std::tuple_size_v<Key> % 2 == 0, "the loop reads pairs");
    for (std::size_t j = 0; j < key.size(); j += 2) {
        hash = (hash ^ (key[j] | std::uint64_t(key[j + 1]) << 32)) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 32;
    }
    return static_cast<std::uint32_t>(hash);
}

// Prefetches the memory.
inline void prefetch([[maybe_unused]] const void* memory)
{
#ifdef __GNUC__
    __builtin_prefetch(memory);
#endif
}

// A callback that is called once. A plain pointer, because std::function is too heavy here.
struct Task {
    void (*run)(void* context) = nullptr;
    void* context = nullptr;

    void operator()() const
    {
        if (run)
            run(context);
    }
};

// Returns for every i < count the smallest j with the same key. `key(i)` returns an array of std::uint32_t of even
// length. Linear time: one hash table with open addressing per thread; equal keys have equal hashes, so they meet in
// one table. sideTask: runs once, perhaps concurrently.
template<class KeyOf>
LargeArray<std::uint32_t> firstEqual(std::uint32_t count, const KeyOf& key, std::size_t threads = 1,
                                     const Task& sideTask = {})
{
    const LargeArray<std::uint32_t> hashes = makeLargeArray<std::uint32_t>(count);
    runParts(count, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            hashes[i] = hashOf(key(static_cast<std::uint32_t>(i)));
    });
    const std::size_t parts = std::max<std::size_t>(threads - 1, 1); // one thread runs the side task
    const auto partOf = [&](std::uint32_t i) { return std::size_t(std::uint64_t(hashes[i]) * parts >> 32); };
    std::vector<std::size_t> begins(parts + 1, 0); // of the tables of the parts
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
            sideTask();
            return;
        }
        const std::span<std::uint32_t> table(&tables[begins[part]], begins[part + 1] - begins[part]);
        std::fill(table.begin(), table.end(), kNone);
        const auto homeSlot = [&](std::uint32_t i) { // distributes the hashes of the part over its table
            return std::size_t(std::uint64_t(std::uint32_t(hashes[i] * parts)) * table.size() >> 32);
        };
        constexpr std::uint32_t kAhead = 16; // most slots are not cached
        for (std::uint32_t i = 0; i < count; ++i) {
            if (i + kAhead < count)
                prefetch(&table[homeSlot(i + kAhead)]);
            if (partOf(i) != part)
                continue;
            std::size_t slot = homeSlot(i);
            // The hashes distinguish most keys.
            while (table[slot] != kNone && (hashes[table[slot]] != hashes[i] || key(table[slot]) != key(i)))
                slot = slot + 1 < table.size() ? slot + 1 : 0;
            if (table[slot] == kNone)
                table[slot] = i;
            first[i] = table[slot];
        }
    });
    return first;
}

// Returns for every vertex the first one with equal position, normal and texcoord. sideTask: as in firstEqual.
LargeArray<std::uint32_t> weld(const MeshView& mesh, std::size_t threads = 1, const Task& sideTask = {});

// Vectors in arrays by axis, one vector per lane.
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

// Whether a length can be squared, and its square multiplied by another, in float.
inline bool isSafeToSquare(float squaredLength) { return squaredLength > 1e-15f && squaredLength < 1e15f; }

// Uses double precision if the squared length is too large or too small for float.
inline glm::vec3 normalizeOrZero(glm::vec3 v)
{
    if (const float squared = glm::dot(v, v); isSafeToSquare(squared))
        return v * (1 / std::sqrt(squared));
    const glm::dvec3 d(v);
    return isZero(v) ? glm::vec3(0) : v * static_cast<float>(1 / std::sqrt(glm::dot(d, d)));
}

// Returns v without its part along n, normalised; zero if nothing remains.
inline glm::vec3 projectedUnit(glm::vec3 v, glm::vec3 n) { return normalizeOrZero(v - n * glm::dot(n, v)); }

// Returns the arc cosine of x, which is clamped to [-1,1]; maximum error 5e-7 radians. Several times faster than
// std::acos, which is not inlined. Source: Abramowitz and Stegun, Handbook of Mathematical Functions, 4.4.46.
inline float fastArcCosine(float x)
{
    const float a = std::min(std::abs(x), 1.0f);
    const float low = 1.5707963050f + a * (-0.2145988016f + a * (0.0889789874f - a * 0.0501743046f));
    const float high = 0.0308918810f + a * (-0.0170881256f + a * (0.0066700901f - a * 0.0012624911f));
    const float squared = a * a;
    const float angle = std::sqrt(1.0f - a) * (low + squared * squared * high);
    return x < 0 ? 3.14159265f - angle : angle;
}

// Returns the angle of a triangle at `corner`, in radians, between its sides projected along n. A right angle if a side
// vanishes.
inline float projectedAngle(glm::vec3 corner, glm::vec3 previous, glm::vec3 next, glm::vec3 n)
{
    const glm::vec3 toPrevious = previous - corner, toNext = next - corner;
    const glm::vec3 a = toPrevious - n * glm::dot(n, toPrevious);
    const glm::vec3 b = toNext - n * glm::dot(n, toNext);
    float cosine = 0;
    if (const float aa = glm::dot(a, a), bb = glm::dot(b, b); isSafeToSquare(aa) && isSafeToSquare(bb)) {
        cosine = glm::dot(a, b) / std::sqrt(aa * bb);
    } else if (!isZero(a) && !isZero(b)) {
        const glm::dvec3 p(a), q(b);
        cosine = static_cast<float>(glm::dot(p, q) / std::sqrt(glm::dot(p, p) * glm::dot(q, q)));
    }
    return fastArcCosine(cosine);
}

// Returns the product of the lengths of these two sides.
inline float projectedSides(glm::vec3 corner, glm::vec3 previous, glm::vec3 next, glm::vec3 n)
{
    const glm::dvec3 toPrevious = previous - corner, toNext = next - corner, along(n);
    return static_cast<float>(glm::length(toPrevious - along * glm::dot(along, toPrevious))
                              * glm::length(toNext - along * glm::dot(along, toNext)));
}

} // namespace cotan::tangents
