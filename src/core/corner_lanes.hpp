// The contributions of triangle corners to the cotangents of their vertices, for several corners at a time.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "corner_groups.hpp"
#include "tangents_mesh.hpp"

namespace cotan::tangents {

// The edges at a corner of a triangle, and the normal of its vertex.
struct CornerEdges {
    glm::vec3 dp1, dp2; // to the next corner and to the previous one
    glm::vec2 duv1, duv2;
    glm::vec3 normal, unit; // as given, and normalised
};

struct CornerGradients {
    glm::vec3 u, v; // of the triangle, multiplied by `weight`
    float weight;   // the corner's angle as seen along the normal
    bool mirrored;
    bool usual; // false: the other members are invalid
};

inline int isUsual(float squared) { return int(squared > 1e-12f) & int(squared < 1e12f); }

// Equals sideAt and addCorner, to the bit, for corners of triangles that are neither thin nor tiny nor huge in space or
// uv: it omits only scaling by powers of two, which changes no sign. Branch-free, so that compilers vectorise it.
[[gnu::always_inline]] inline CornerGradients gradientsOf(const CornerEdges& e)
{
    constexpr float kThin = 1e-6f; // of a squared sine; its sign is reliable in floats from 1e-12
    const float p1 = glm::dot(e.dp1, e.dp1), p2 = glm::dot(e.dp2, e.dp2);
    const float uv1 = glm::dot(e.duv1, e.duv1), uv2 = glm::dot(e.duv2, e.duv2);
    const glm::vec3 acrossNext = glm::cross(e.dp2, e.unit), acrossPrevious = glm::cross(e.unit, e.dp1);
    const float facing = glm::dot(e.dp1, acrossNext), uvArea = e.duv1.x * e.duv2.y - e.duv1.y * e.duv2.x;
    const float longer = std::max(p1, p2);
    // Like projectedAngle, without the branch for lengths that need double precision.
    const glm::vec3 a = e.dp1 - e.normal * glm::dot(e.normal, e.dp1), b = e.dp2 - e.normal * glm::dot(e.normal, e.dp2);
    const float aa = glm::dot(a, a), bb = glm::dot(b, b);
    const int usual = isUsual(p1) & isUsual(p2) & isUsual(uv1) & isUsual(uv2) & int(aa > 1e-15f) & int(aa < 1e15f)
        & int(bb > 1e-15f) & int(bb < 1e15f) & int(facing * facing > kThin * std::max(p1 * p2, kThin * longer * longer))
        & int(uvArea * uvArea > kThin * uv1 * uv2);
    const float weight = fastArcCosine(glm::dot(a, b) / std::sqrt(aa * bb)), scale = 1 / facing;
    return {(acrossNext * e.duv1.x + acrossPrevious * e.duv2.x) * scale * weight,
            (acrossNext * e.duv1.y + acrossPrevious * e.duv2.y) * scale * weight, weight, (facing > 0) == (uvArea > 0),
            usual != 0};
}

// Corners side by side, one per lane.
struct CornerLanes {
    static constexpr std::size_t kLanes = 256;
    using Lane = float[kLanes];

    std::size_t count = 0;
    Lane dp1[3], dp2[3], duv1[2], duv2[2], normal[3], unit[3];
    Lane u[3], v[3], weight;
    std::int32_t mirrored[kLanes], usual[kLanes];

    void put(std::size_t lane, const CornerEdges& e)
    {
        tangents::put(dp1, lane, e.dp1);
        tangents::put(dp2, lane, e.dp2);
        tangents::put(normal, lane, e.normal);
        tangents::put(unit, lane, e.unit);
        duv1[0][lane] = e.duv1.x;
        duv1[1][lane] = e.duv1.y;
        duv2[0][lane] = e.duv2.x;
        duv2[1][lane] = e.duv2.y;
    }
    CornerEdges edges(std::size_t lane) const
    {
        return {
            vectorAt(dp1, lane),    vectorAt(dp2, lane), {duv1[0][lane], duv1[1][lane]}, {duv2[0][lane], duv2[1][lane]},
            vectorAt(normal, lane), vectorAt(unit, lane)};
    }
    void put(std::size_t lane, const CornerGradients& g)
    {
        tangents::put(u, lane, g.u);
        tangents::put(v, lane, g.v);
        weight[lane] = g.weight;
        mirrored[lane] = g.mirrored;
        usual[lane] = g.usual;
    }
    // Returns the common side of the corners from `begin` to `end` if all of them are usual; otherwise none.
    Side sideOf(std::size_t begin, std::size_t end) const
    {
        std::int32_t all = 1, flipped = 0;
        for (std::size_t lane = begin; lane < end; ++lane) {
            all &= usual[lane];
            flipped += mirrored[lane];
        }
        if (all == 0 || begin == end)
            return Side::none;
        return flipped == 0 ? Side::unmirrored : std::size_t(flipped) == end - begin ? Side::mirrored : Side::none;
    }
    CornerGradients gradients(std::size_t lane) const
    {
        return {vectorAt(u, lane), vectorAt(v, lane), weight[lane], mirrored[lane] != 0, usual[lane] != 0};
    }
};

// Applies gradientsOf to all lanes in use.
void deriveGradients(CornerLanes& lanes);

} // namespace cotan::tangents
