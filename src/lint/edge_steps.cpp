#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "cotan/angle.hpp"
#include "parts.hpp"

namespace cotan::lint {

namespace {

using Key = std::array<double, 8>;

Key keyOf(const MappedSurface& s, std::size_t corner)
{
    const glm::dvec3 p = s.positions[corner], n = s.normals[corner];
    const glm::dvec2 uv = s.uv[corner];
    Key key{p.x, p.y, p.z, n.x, n.y, n.z, uv.x, uv.y};
    for (double& x : key)
        x = std::isfinite(x) ? x + 0.0 : 0.0; // -0 becomes +0
    return key;
}

// Per corner the number of its vertex: corners with equal position, normal and uv have the same.
std::vector<std::uint32_t> weld(const MappedSurface& s)
{
    std::vector<Key> keys(s.positions.size());
    for (std::size_t i = 0; i < keys.size(); ++i)
        keys[i] = keyOf(s, i);
    std::vector<std::uint32_t> order(keys.size()), vertex(keys.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return keys[a] < keys[b]; });
    std::uint32_t next = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (i > 0 && keys[order[i]] != keys[order[i - 1]])
            ++next;
        vertex[order[i]] = next;
    }
    return vertex;
}

struct Side {
    std::uint32_t low = 0, high = 0; // welded vertices
    std::uint32_t corner = 0;        // the edge's first corner in its triangle
    std::size_t triangle() const { return corner / 3; }
};

std::vector<Side> sidesOf(const MappedSurface& s)
{
    const std::vector<std::uint32_t> vertex = weld(s);
    std::vector<Side> sides;
    sides.reserve(vertex.size());
    for (std::uint32_t c = 0; c < vertex.size(); ++c) {
        const std::uint32_t a = vertex[c], b = vertex[c / 3 * 3 + (c + 1) % 3];
        if (a != b)
            sides.push_back({std::min(a, b), std::max(a, b), c});
    }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
        return std::array{a.low, a.high, a.corner} < std::array{b.low, b.high, b.corner};
    });
    return sides;
}

// The middle of an edge in its triangle.
glm::dvec3 middle(const Side& side)
{
    glm::dvec3 weights(0);
    weights[int(side.corner % 3)] = 0.5;
    weights[int((side.corner + 1) % 3)] = 0.5;
    return weights;
}

void addSteps(const MappedSurface& s, Frame frame, const Side& a, const Side& b,
              std::vector<std::pair<double, double>>& steps)
{
    constexpr int kDirections = 8;
    const f64::cotan_frame fa = frameAt(s, frame, TangentOrigin::generated, a.triangle(), middle(a));
    const f64::cotan_frame fb = frameAt(s, frame, TangentOrigin::generated, b.triangle(), middle(b));
    const double tilt = glm::radians(kTestTilt);
    const double weight = (areaOf(s, a.triangle()) + areaOf(s, b.triangle())) / (3.0 * kDirections);
    for (int k = 0; k < kDirections; ++k) {
        const double azimuth = 2 * std::numbers::pi * k / kDirections;
        const glm::dvec3 m(std::sin(tilt) * std::cos(azimuth), std::sin(tilt) * std::sin(azimuth), std::cos(tilt));
        steps.emplace_back(degreesBetween(f64::cotan_apply(fa, m), f64::cotan_apply(fb, m)), weight);
    }
}

} // namespace

double degreesBetween(glm::dvec3 a, glm::dvec3 b) { return glm::degrees(angleBetween(a, b)); }

EdgeSteps edgeSteps(const MappedSurface& s)
{
    EdgeSteps result;
    if (s.uv.empty())
        return result;
    const std::vector<Side> sides = sidesOf(s);
    std::vector<std::pair<double, double>> cotangent, orthonormal;
    for (std::size_t i = 0; i < sides.size();) {
        std::size_t end = i + 1;
        while (end < sides.size() && sides[end].low == sides[i].low && sides[end].high == sides[i].high)
            ++end;
        const int orientation = orientationOf(s, sides[i].triangle());
        if (end == i + 2 && orientation != 0 && orientation == orientationOf(s, sides[i + 1].triangle())) {
            ++result.edges;
            addSteps(s, Frame::cotangent, sides[i], sides[i + 1], cotangent);
            addSteps(s, Frame::orthonormal, sides[i], sides[i + 1], orthonormal);
        }
        i = end;
    }
    result.cotangent = spreadOf(std::move(cotangent));
    result.orthonormal = spreadOf(std::move(orthonormal));
    return result;
}

} // namespace cotan::lint
