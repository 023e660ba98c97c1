// What the tangent generators share: checks, welding, small vector helpers.
#pragma once

#include <bit>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <glm/geometric.hpp>

#include "cotan/tangents.hpp"

namespace cotan::tangents {

inline constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

// Whether the arrays fit together and every index is in range.
bool usable(const MeshView& mesh);

// The bits of x; -0 and +0 have the same.
inline std::uint32_t bitsOf(float x) { return std::bit_cast<std::uint32_t>(x + 0.0f); }

// For every i < count the smallest j that has the same key. `key(i)` returns an array of
// std::uint32_t of even length. Linear: a hash table with open addressing.
template<class KeyOf> std::vector<std::uint32_t> firstEqual(std::uint32_t count, const KeyOf& key)
{
    std::vector<std::uint32_t> table(std::bit_ceil(std::size_t(count) * 3 / 2 + 1), kNone);
    const std::size_t mask = table.size() - 1;
    std::vector<std::uint32_t> first(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto k = key(i);
        std::uint64_t hash = 0;
        for (std::size_t j = 0; j < k.size(); j += 2) {
            hash = (hash ^ (k[j] | std::uint64_t(k[j + 1]) << 32)) * 0x9e3779b97f4a7c15u;
            hash ^= hash >> 32;
        }
        std::size_t slot = hash & mask;
        while (table[slot] != kNone && key(table[slot]) != k)
            slot = (slot + 1) & mask;
        if (table[slot] == kNone)
            table[slot] = i;
        first[i] = table[slot];
    }
    return first;
}

// For every vertex the first vertex that equals it in position, normal and texcoord.
std::vector<std::uint32_t> weld(const MeshView& mesh);

// A unit vector perpendicular to n; n may be zero or not finite.
glm::vec3 anyPerpendicular(glm::vec3 n);

inline bool isZero(glm::vec3 v)
{
    return !(std::abs(v.x) > FLT_MIN || std::abs(v.y) > FLT_MIN || std::abs(v.z) > FLT_MIN);
}

// Squared in double: the square of a short float vector would vanish.
inline glm::vec3 normalizeOrZero(glm::vec3 v)
{
    const glm::dvec3 d(v);
    return isZero(v) ? glm::vec3(0) : v * static_cast<float>(1 / std::sqrt(glm::dot(d, d)));
}

// v without its part along n, as a unit vector; zero if nothing is left.
inline glm::vec3 projectedUnit(glm::vec3 v, glm::vec3 n)
{
    return normalizeOrZero(v - n * glm::dot(n, v));
}

// The angle of a triangle at `corner`, between the projections of its sides along n; radians.
float projectedAngle(glm::vec3 corner, glm::vec3 previous, glm::vec3 next, glm::vec3 n);

} // namespace cotan::tangents
