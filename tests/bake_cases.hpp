// Pairs of low and high meshes that distinguish bakers: parts that stand off, thin parts, parts in front of others.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "bake_scene.hpp"

namespace cotan {

struct Axes { // a plane's normal and two directions in it, right-handed
    glm::vec3 n, u, v;
};

inline const std::array<Axes, 6>& sides()
{
    static const std::array<Axes, 6> all = {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                             {{-1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
                                             {{0, 1, 0}, {0, 0, 1}, {1, 0, 0}},
                                             {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}},
                                             {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}},
                                             {{0, 0, -1}, {0, 1, 0}, {1, 0, 0}}}};
    return all;
}

// Adds a convex polygon with its normals and, if given, the uv of its corners.
inline void addPolygon(Mesh& mesh, const std::vector<glm::vec3>& points, const std::vector<glm::vec3>& normals,
                       const std::vector<glm::vec2>& uv = {})
{
    const auto base = std::uint32_t(mesh.positions.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        mesh.positions.push_back(points[i]);
        mesh.normals.push_back(normals.size() == 1 ? normals[0] : normals[i]);
        mesh.texcoords[0].push_back(uv.empty() ? glm::vec2(0) : uv[i]);
    }
    for (std::uint32_t i = 1; i + 1 < points.size(); ++i)
        mesh.indices.insert(mesh.indices.end(), {base, base + i, base + i + 1});
}

// An n by n grid of cells in uv, each with a margin.
struct Atlas {
    int n = 1, next = 0;

    std::vector<glm::vec2> cell()
    {
        const glm::vec2 corner(float(next % n) / float(n), float(next / n) / float(n));
        ++next;
        const float a = 0.04f / float(n), b = 0.96f / float(n);
        return {corner + glm::vec2(a, b), corner + glm::vec2(b, b), corner + glm::vec2(b, a), corner + glm::vec2(a, a)};
    }
};

inline void addSquare(Mesh& mesh, const Axes& side, glm::vec3 centre, glm::vec2 half, std::vector<glm::vec2> uv = {})
{
    std::vector<glm::vec3> points;
    for (const glm::vec2 c : {glm::vec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
        points.push_back(centre + side.u * (c.x * half.x) + side.v * (c.y * half.y));
    addPolygon(mesh, points, {side.n}, uv);
}

// Adds a box with flat sides that face outwards or inwards; `open` is the index of a side that is left out.
inline void addBox(Mesh& mesh, glm::vec3 from, glm::vec3 to, bool inwards, Atlas* atlas, int open = -1)
{
    const glm::vec3 centre = (from + to) * 0.5f, half = (to - from) * 0.5f;
    for (int i = 0; i < 6; ++i) {
        if (i == open)
            continue;
        Axes side = sides()[std::size_t(i)];
        const glm::vec3 middle = centre + side.n * half;
        glm::vec2 size(std::abs(glm::dot(side.u, half)), std::abs(glm::dot(side.v, half)));
        if (inwards) {
            std::swap(side.u, side.v);
            std::swap(size.x, size.y);
            side.n = -side.n;
        }
        addSquare(mesh, side, middle, size, atlas ? atlas->cell() : std::vector<glm::vec2>{});
    }
}

// Adds half a ball on a plane, or the same as a bowl in the plane.
inline void addDome(Mesh& mesh, const Axes& side, glm::vec3 centre, float radius, bool bowl = false)
{
    constexpr int kColumns = 24, kRows = 12;
    const auto at = [&](int i, int j) {
        const double a = 2 * std::numbers::pi * i / kColumns, b = std::numbers::pi / 2 * j / kRows;
        return side.u * float(std::cos(a) * std::cos(b)) + side.v * float(std::sin(a) * std::cos(b))
            + side.n * float(bowl ? -std::sin(b) : std::sin(b));
    };
    for (int i = 0; i < kColumns; ++i)
        for (int j = 0; j < kRows; ++j) {
            std::vector<glm::vec3> d{at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
            if (bowl)
                std::swap(d[1], d[3]);
            std::vector<glm::vec3> points, normals;
            for (const glm::vec3& x : d) {
                points.push_back(centre + x * radius);
                normals.push_back(bowl ? -x : x);
            }
            addPolygon(mesh, points, normals);
        }
}

// Adds a closed cylinder from `bottom` to `top` above `centre`.
inline void addCylinder(Mesh& mesh, const Axes& side, glm::vec3 centre, float radius, float bottom, float top)
{
    constexpr int kColumns = 48;
    const glm::vec3 low = centre + side.n * bottom, high = centre + side.n * top;
    for (int i = 0; i < kColumns; ++i) {
        const double a = 2 * std::numbers::pi * i / kColumns, b = 2 * std::numbers::pi * (i + 1) / kColumns;
        const glm::vec3 p = side.u * float(std::cos(a)) + side.v * float(std::sin(a)),
                        q = side.u * float(std::cos(b)) + side.v * float(std::sin(b));
        addPolygon(mesh, {low + p * radius, low + q * radius, high + q * radius, high + p * radius}, {p, q, q, p});
        addPolygon(mesh, {high + p * radius, high + q * radius, high}, {side.n});
        addPolygon(mesh, {low + q * radius, low + p * radius, low}, {-side.n});
    }
}

// Adds a cube of side 2 `half` with rounded edges and corners: all points at distance `bevel` from a smaller cube.
inline void addBevelledCube(Mesh& mesh, float half, float bevel)
{
    constexpr int kCells = 24;
    const float inner = half - bevel;
    // Grid coordinates on each side: the flat inner square, then the rounded rim in steps of an eighth of 45 degrees.
    std::vector<double> steps;
    for (int i = 0; i <= kCells; ++i) {
        const int k = kCells / 3;
        steps.push_back(i <= k           ? -std::numbers::pi / 4 * (k - i) / k
                            : i >= 2 * k ? std::numbers::pi / 4 * (i - 2 * k) / k
                                         : 0);
    }
    for (const Axes& side : sides()) {
        const auto at = [&](int i, int j) {
            const int k = kCells / 3;
            const float u = float(std::clamp(i, k, 2 * k) - k) / float(k) * 2 - 1,
                        v = float(std::clamp(j, k, 2 * k) - k) / float(k) * 2 - 1;
            const glm::vec3 n = glm::normalize(side.n + side.u * float(std::tan(steps[std::size_t(i)]))
                                               + side.v * float(std::tan(steps[std::size_t(j)])));
            return std::pair(side.n * inner + side.u * (inner * u) + side.v * (inner * v) + n * bevel, n);
        };
        for (int i = 0; i < kCells; ++i)
            for (int j = 0; j < kCells; ++j) {
                const auto [a, na] = at(i, j);
                const auto [b, nb] = at(i + 1, j);
                const auto [c, nc] = at(i + 1, j + 1);
                const auto [d, nd] = at(i, j + 1);
                addPolygon(mesh, {a, b, c, d}, {na, nb, nc, nd});
            }
    }
}

struct BakeCase {
    Mesh low, high;
};

inline const Axes kUpwards = {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}};

// A cube of one metre; four cylinders stand in front of its side +x, from 3 to 7 cm away.
inline constexpr float kBolt = 0.06f, kBoltOffset = 0.25f, kBoltTop = 0.07f;
inline BakeCase bolts()
{
    BakeCase pair;
    Atlas atlas{3};
    addBox(pair.low, glm::vec3(-0.5f), glm::vec3(0.5f), false, &atlas);
    addBevelledCube(pair.high, 0.5f, 0.03f);
    for (const float y : {-kBoltOffset, kBoltOffset})
        for (const float z : {-kBoltOffset, kBoltOffset})
            addCylinder(pair.high, sides()[0], {0.5f, y, z}, kBolt, 0.03f, kBoltTop);
    return pair;
}

// A plate 0.02 thick; the low plane is slightly below its middle.
inline BakeCase plate()
{
    BakeCase pair;
    Atlas atlas{1};
    addSquare(pair.low, kUpwards, {0, 0, -0.001f}, {0.5f, 0.5f}, atlas.cell());
    addBox(pair.high, {-0.5f, -0.5f, -0.01f}, {0.5f, 0.5f, 0.01f}, false, nullptr);
    return pair;
}

// An open box whose walls are 0.02 thick, with domes of 0.05 inside and outside.
inline BakeCase thinWalls()
{
    BakeCase pair;
    Atlas atlas{4};
    for (Mesh* mesh : {&pair.low, &pair.high}) {
        addBox(*mesh, {-0.5f, -0.5f, 0}, {0.5f, 0.5f, 0.5f}, false, mesh == &pair.low ? &atlas : nullptr, 4);
        addBox(*mesh, {-0.48f, -0.48f, 0.02f}, {0.48f, 0.48f, 0.5f}, true, mesh == &pair.low ? &atlas : nullptr, 4);
    }
    for (const float y : {-0.25f, 0.0f, 0.25f}) {
        addDome(pair.high, sides()[0], {0.5f, y, 0.25f}, 0.05f);
        addDome(pair.high, sides()[1], {0.48f, y + 0.1f, 0.25f}, 0.05f);
    }
    return pair;
}

// Three fingers, 0.02 apart, with domes of 0.06 above and of 0.009 in the gaps.
inline BakeCase fingers()
{
    BakeCase pair;
    Atlas atlas{5};
    for (const float x : {-0.22f, 0.0f, 0.22f}) {
        for (Mesh* mesh : {&pair.low, &pair.high})
            addBox(*mesh, {x - 0.1f, -0.5f, -0.1f}, {x + 0.1f, 0.5f, 0.1f}, false,
                   mesh == &pair.low ? &atlas : nullptr);
        for (const float y : {-0.3f, -0.1f, 0.1f, 0.3f}) {
            addDome(pair.high, kUpwards, {x, y, 0.1f}, 0.06f);
            addDome(pair.high, sides()[0], {x + 0.1f, y, 0}, 0.009f);
            addDome(pair.high, sides()[1], {x - 0.1f, y, 0}, 0.009f);
        }
    }
    return pair;
}

// A block with a pocket 0.4 wide and deep; domes on the pocket's floor and walls, cylinders that float around its rim.
inline BakeCase pocket()
{
    BakeCase pair;
    Atlas atlas{4};
    for (Mesh* mesh : {&pair.low, &pair.high}) {
        Atlas* uv = mesh == &pair.low ? &atlas : nullptr;
        addBox(*mesh, {-0.5f, -0.5f, -0.5f}, {0.5f, 0.5f, 0.1f}, false, uv, 4);
        addBox(*mesh, {-0.2f, -0.2f, -0.3f}, {0.2f, 0.2f, 0.1f}, true, uv, 4);
        for (const auto& [centre, half] : {std::pair(glm::vec3(0, -0.35f, 0.1f), glm::vec2(0.5f, 0.15f)),
                                           {{0, 0.35f, 0.1f}, {0.5f, 0.15f}},
                                           {{-0.35f, 0, 0.1f}, {0.15f, 0.2f}},
                                           {{0.35f, 0, 0.1f}, {0.15f, 0.2f}}})
            addSquare(*mesh, kUpwards, centre, half, uv ? uv->cell() : std::vector<glm::vec2>{});
    }
    addDome(pair.high, kUpwards, {0, 0, -0.3f}, 0.08f);
    addDome(pair.high, sides()[1], {0.2f, 0, -0.1f}, 0.06f);
    addDome(pair.high, sides()[0], {-0.2f, 0, -0.1f}, 0.06f);
    for (const float x : {-0.35f, 0.35f})
        for (const float y : {-0.35f, 0.35f})
            addCylinder(pair.high, kUpwards, {x, y, 0.1f}, 0.06f, 0.03f, 0.09f);
    return pair;
}

// A closed shell with another one 0.03 below it, and a dome of 0.1 on it.
inline BakeCase shells()
{
    BakeCase pair;
    Atlas atlas{3};
    addBox(pair.low, glm::vec3(-0.5f), glm::vec3(0.5f), false, &atlas);
    addBevelledCube(pair.high, 0.5f, 0.05f);
    addBevelledCube(pair.high, 0.47f, 0.05f);
    addDome(pair.high, sides()[0], {0.5f, 0.1f, 0.1f}, 0.1f);
    return pair;
}

// A plane with a bowl of 0.15 in it; in front of the bowl floats a disc of 0.08, from 0.04 to 0.06.
inline BakeCase hollow()
{
    BakeCase pair;
    Atlas atlas{1};
    addSquare(pair.low, kUpwards, glm::vec3(0), {0.5f, 0.5f}, atlas.cell());
    constexpr int kColumns = 24;
    const auto at = [](int i, bool rim) {
        const double a = 2 * std::numbers::pi * i / kColumns;
        const glm::vec2 d(float(std::cos(a)), float(std::sin(a)));
        return glm::vec3(d * (rim ? 0.15f : 0.5f / std::max(std::abs(d.x), std::abs(d.y))), 0);
    };
    for (int i = 0; i < kColumns; ++i)
        addPolygon(pair.high, {at(i, true), at(i, false), at(i + 1, false), at(i + 1, true)}, {kUpwards.n});
    addDome(pair.high, kUpwards, glm::vec3(0), 0.15f, true);
    addCylinder(pair.high, kUpwards, glm::vec3(0), 0.08f, 0.04f, 0.06f);
    return pair;
}

} // namespace cotan
