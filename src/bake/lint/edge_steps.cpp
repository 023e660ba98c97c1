#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "core/list_by_group.hpp"
#include "cotan/tangents.hpp"
#include "cotan/vector.hpp"
#include "lint_parts.hpp"

namespace cotan::lint {

namespace {

// One triangle's side of an edge between welded vertices.
struct Side {
    std::uint32_t high = 0;   // the edge's vertex with the larger number
    std::uint32_t corner = 0; // the edge's first corner in its triangle
    std::size_t triangle() const { return corner / 3; }
};

// Calls use(a, b) for every edge that exactly two triangles share, its sides listed by its vertex with the smaller
// number.
template<class Use> void eachSharedEdge(const MappedSurface& s, const Use& use)
{
    const Mesh& mesh = *s.shared->mesh;
    const auto first = firstEqualVertices({mesh.positions, mesh.normals, s.shared->uv, mesh.indices});
    if (first.empty())
        return;
    const auto endsOf = [&](std::uint32_t corner) { // of the edge that begins there: smaller, larger
        return std::minmax(first[mesh.indices[corner]], first[mesh.indices[corner / 3 * 3 + (corner + 1) % 3]]);
    };
    const auto eachSide = [&](const auto& add) {
        for (std::uint32_t c = 0; c < mesh.indices.size(); ++c)
            if (const auto [low, high] = endsOf(c); low != high)
                add(low, c);
    };
    std::vector<std::uint32_t> begin, corners;
    listByGroup(first.size(), eachSide, begin, corners);
    std::vector<Side> sides;
    for (std::size_t low = 0; low < first.size(); ++low) {
        sides.clear();
        for (std::uint32_t i = begin[low]; i < begin[low + 1]; ++i)
            sides.push_back({endsOf(corners[i]).second, corners[i]});
        std::ranges::sort(sides, {}, [](const Side& side) { return std::pair(side.high, side.corner); });
        for (std::size_t i = 0; i < sides.size();) {
            std::size_t end = i + 1;
            while (end < sides.size() && sides[end].high == sides[i].high)
                ++end;
            if (end == i + 2)
                use(sides[i], sides[i + 1]);
            i = end;
        }
    }
}

// The middle of an edge in its triangle.
glm::dvec3 middle(const Side& side)
{
    glm::dvec3 weights(0);
    weights[int(side.corner % 3)] = 0.5;
    weights[int((side.corner + 1) % 3)] = 0.5;
    return weights;
}

constexpr int kDirections = 8;

// Texels tilted by kTestTilt.
const std::array<glm::dvec3, kDirections>& tilted()
{
    static const auto texels = [] {
        std::array<glm::dvec3, kDirections> made;
        const double tilt = glm::radians(kTestTilt);
        for (int k = 0; k < kDirections; ++k) {
            const double azimuth = 2 * std::numbers::pi * k / kDirections;
            made[std::size_t(k)] = {std::sin(tilt) * std::cos(azimuth), std::sin(tilt) * std::sin(azimuth),
                                    std::cos(tilt)};
        }
        return made;
    }();
    return texels;
}

// The arc sine of x from 0 to 0.5, as exact as a double: a rational function instead of a call, since an edge takes
// sixteen. Source: fdlibm, e_asin.c.
double arcSine(double x)
{
    const double t = x * x;
    const double p = t
        * (1.66666666666666657415e-01
           + t
               * (-3.25565818622400915405e-01
                  + t
                      * (2.01212532134862925881e-01
                         + t
                             * (-4.00555345006794114027e-02
                                + t * (7.91534994289814532176e-04 + t * 3.47933107596021167570e-05)))));
    const double q = 1
        + t
            * (-2.40339491173441421878e+00
               + t * (2.02094576023350569471e+00 + t * (-6.88283971605453293030e-01 + t * 7.70381505559019352791e-02)));
    return x + x * (p / q);
}

// Degrees between two vectors, by the chord between them at length one; exact near zero, too.
double degreesByChord(glm::dvec3 a, glm::dvec3 b)
{
    const double aa = glm::dot(a, a), bb = glm::dot(b, b);
    const glm::dvec3 difference = a * (1 / std::sqrt(aa)) - b * (1 / std::sqrt(bb));
    const double half = std::sqrt(glm::dot(difference, difference)) / 2;
    return half <= 0.5 ? glm::degrees(2 * arcSine(half)) : degreesBetween(a, b); // also where one has no direction
}

void addSteps(const f64::cotan_frame& a, const f64::cotan_frame& b, double weight, ValueStatistics& steps)
{
    for (const glm::dvec3& m : tilted())
        steps.add(degreesByChord(a.t * m.x + a.b * m.y + a.n * m.z, b.t * m.x + b.b * m.y + b.n * m.z), weight);
}

} // namespace

double degreesBetween(glm::dvec3 a, glm::dvec3 b) { return glm::degrees(angleBetween(a, b)); }

EdgeSteps edgeSteps(const MappedSurface& s, std::size_t maxEdges)
{
    EdgeSteps result;
    if (!s.hasUv())
        return result;
    std::vector<std::int8_t> orientations(s.triangleCount());
    for (std::size_t i = 0; i < orientations.size(); ++i)
        orientations[i] = std::int8_t(orientationOf(s, i));
    const std::size_t edges = s.triangleCount() * 3 / 2; // of a closed mesh; others have fewer pairs
    const std::size_t every = std::max<std::size_t>((edges + maxEdges - 1) / maxEdges, 1);
    ValueStatistics cotangent, orthonormal;
    eachSharedEdge(s, [&](const Side& a, const Side& b) {
        const int orientation = orientations[a.triangle()];
        if (orientation == 0 || orientation != orientations[b.triangle()])
            return;
        if (result.edges++ % every != 0)
            return;
        const SurfaceSpot atA = spotAt(s, a.triangle(), middle(a)), atB = spotAt(s, b.triangle(), middle(b));
        const double weight = (areaOf(atA.edges) + areaOf(atB.edges)) / (3.0 * kDirections);
        addSteps(frameOf(atA, Frame::cotangent), frameOf(atB, Frame::cotangent), weight, cotangent);
        addSteps(frameOf(atA, Frame::orthonormal), frameOf(atB, Frame::orthonormal), weight, orthonormal);
    });
    result.cotangent = summaryOf(std::move(cotangent));
    result.orthonormal = summaryOf(std::move(orthonormal));
    return result;
}

} // namespace cotan::lint
