#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "core/groups.hpp"
#include "cotan/tangents.hpp"
#include "cotan/vector.hpp"
#include "lint_parts.hpp"

namespace cotan {

namespace {

// The ratio of the singular values of the gradients of u and v, at least 1; 0 if the smaller is below 1e-4 of the
// larger: uv along a line, or at one point.
double stretchOf(glm::dvec3 u, glm::dvec3 v)
{
    const double uu = glm::dot(u, u), vv = glm::dot(v, v), uv = glm::dot(u, v);
    const double mean = (uu + vv) / 2;
    const double radius = std::sqrt((uu - vv) * (uu - vv) / 4 + uv * uv);
    const double large = mean + radius;
    // The smaller eigenvalue is taken from the determinant, since a difference would cancel.
    const glm::dvec3 crossed = glm::cross(u, v);
    const double small = large > 0 ? glm::dot(crossed, crossed) / large : 0;
    return small > 1e-8 * large ? std::sqrt(large / small) : 0;
}

} // namespace

TriangleUv triangleUv(const MappedSurface& surface, std::size_t triangle, const TriangleEdges& edges)
{
    TriangleUv t;
    const glm::dvec3 face = glm::cross(edges.p1, edges.p2);
    const double area2 = glm::dot(face, face);
    t.usable = area2 > 0;
    if (!t.usable)
        return t;
    // The gradients of u and v in the plane of the triangle, per unit of length.
    const glm::dvec3 r1 = glm::cross(edges.p2, face) / area2, r2 = glm::cross(face, edges.p1) / area2;
    const glm::dvec3 u = r1 * edges.uv1.x + r2 * edges.uv2.x, v = r1 * edges.uv1.y + r2 * edges.uv2.y;
    t.stretch = stretchOf(u, v);
    t.degenerate = !(t.stretch > 0);
    t.gradient = std::max(glm::length(u), glm::length(v));
    t.density = std::sqrt(glm::length(glm::cross(u, v)));
    if (t.degenerate)
        return t;
    t.shear = std::abs(90 - lint::degreesBetween(u, v));
    t.orientation = orientationOf(surface, triangle, edges);
    return t;
}

std::array<StoredCorner, 3> storedCorners(const MappedSurface& s, std::size_t triangle, const TriangleEdges& edges)
{
    std::array<StoredCorner, 3> corners;
    if (!s.hasStored() || orientationOf(s, triangle, edges) == 0)
        return corners;
    for (std::size_t k = 0; k < 3; ++k) {
        StoredCorner& result = corners[k];
        const std::size_t corner = 3 * triangle + k;
        // The frame's t is along dP/du, its b on the side of +v.
        const f64::cotan_frame f = frameOf(spotOf(edges, s.normal(corner)), Frame::orthonormal);
        if (f.t == glm::dvec3(0))
            continue;
        const glm::dvec4 stored = s.stored(corner);
        const glm::dvec3 t =
            f64::cotan_normalize_or(glm::dvec3(stored) - f.n * glm::dot(glm::dvec3(stored), f.n), glm::dvec3(0));
        const double expected = glm::dot(glm::cross(f.n, f.t), f.b) < 0 ? -1 : 1;
        result.compared = true;
        result.reversed = stored.w * expected < 0;
        result.degrees = t == glm::dvec3(0) ? 180 : lint::degreesBetween(t, f.t);
    }
    return corners;
}

UvQuality lint::uvQuality(const MappedSurface& s)
{
    UvQuality q;
    ValueStatistics stretch, shear, gradient;
    for (std::size_t i = 0; i < s.triangleCount(); ++i) {
        const TriangleEdges edges = edgesOf(s, i);
        const double area = areaOf(edges);
        q.area += area;
        if (!s.hasUv())
            continue;
        for (std::size_t k = 0; k < 3; ++k)
            q.largestUv = std::max({q.largestUv, std::abs(s.uv(3 * i + k).x), std::abs(s.uv(3 * i + k).y)});
        const TriangleUv t = triangleUv(s, i, edges);
        if (!t.usable)
            continue;
        if (t.degenerate) {
            q.degenerate += area;
            continue;
        }
        q.mirrored += t.orientation < 0 ? area : 0;
        q.stretched += t.stretch > kStretched ? area : 0;
        q.sheared += t.shear > kSheared ? area : 0;
        stretch.add(t.stretch, area);
        shear.add(t.shear, area);
        gradient.add(t.gradient, 1);
    }
    const double whole = q.area > 0 ? q.area : std::numeric_limits<double>::quiet_NaN();
    for (double* const part : {&q.degenerate, &q.mirrored, &q.stretched, &q.sheared})
        *part /= whole;
    q.stretch = summaryOf(std::move(stretch));
    q.shear = summaryOf(std::move(shear));
    q.gradient = gradient.count() > 0 ? gradient.percentile(0.5) : 0;
    return q;
}

StoredTangents lint::storedTangents(const MappedSurface& s)
{
    StoredTangents result;
    result.present = s.hasStored();
    if (!result.present || !s.hasUv())
        return result;
    double compared = 0;
    ValueStatistics angles;
    for (std::size_t i = 0; i < s.triangleCount(); ++i) {
        const TriangleEdges edges = edgesOf(s, i);
        const double third = areaOf(edges) / 3;
        for (const StoredCorner& corner : storedCorners(s, i, edges)) {
            if (!corner.compared)
                continue;
            compared += third;
            result.reversedW += corner.reversed ? third : 0;
            result.rotated += corner.degrees > kMaxTangentAngle ? third : 0;
            angles.add(corner.degrees, third);
        }
    }
    result.reversedW /= compared; // NaN if nothing was compared
    result.rotated /= compared;
    result.angle = summaryOf(std::move(angles));
    return result;
}

// ---- steps at edges ---------------------------------------------------------------------------

namespace {

// One triangle's side of an edge between welded vertices.
struct Side {
    std::uint32_t high = 0;   // the edge's vertex with the larger index
    std::uint32_t corner = 0; // the edge's first corner in its triangle
    std::size_t triangle() const { return corner / 3; }
};

// Calls use(a, b) for every edge that exactly two triangles share, in the order of the edges' smaller vertex indices.
template<class Use> void eachSharedEdge(const MappedSurface& s, const Use& use)
{
    const Mesh& mesh = *s.shared->mesh;
    const auto first = firstEqualVertices({mesh.positions, mesh.normals, s.shared->uv, mesh.indices});
    if (first.empty())
        return;
    const auto endsOf = [&](std::uint32_t corner) { // vertices of the edge that begins there: smaller, larger
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

// The middle of an edge in barycentric coordinates of its triangle.
glm::dvec3 middle(const Side& side)
{
    glm::dvec3 weights(0);
    weights[int(side.corner % 3)] = 0.5;
    weights[int((side.corner + 1) % 3)] = 0.5;
    return weights;
}

constexpr int kDirections = 8;

// Texels tilted by kTestTilt in kDirections directions.
std::array<glm::dvec3, kDirections> tilted()
{
    std::array<glm::dvec3, kDirections> texels;
    const double tilt = glm::radians(kTestTilt);
    for (int k = 0; k < kDirections; ++k) {
        const double azimuth = 2 * std::numbers::pi * k / kDirections;
        texels[std::size_t(k)] = {std::sin(tilt) * std::cos(azimuth), std::sin(tilt) * std::sin(azimuth),
                                  std::cos(tilt)};
    }
    return texels;
}

// Arc sine of x in [0,0.5], to double precision: a rational function instead of a call, since an edge takes sixteen.
// Source: fdlibm, e_asin.c.
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

// Degrees between two vectors, from the chord between their unit vectors; accurate near zero.
double degreesByChord(glm::dvec3 a, glm::dvec3 b)
{
    const double aa = glm::dot(a, a), bb = glm::dot(b, b);
    const glm::dvec3 difference = a * (1 / std::sqrt(aa)) - b * (1 / std::sqrt(bb));
    const double half = std::sqrt(glm::dot(difference, difference)) / 2;
    return half <= 0.5 ? glm::degrees(2 * arcSine(half)) : lint::degreesBetween(a, b); // also if one has no direction
}

void addSteps(const std::array<glm::dvec3, kDirections>& texels, const f64::cotan_frame& a, const f64::cotan_frame& b,
              double weight, ValueStatistics& steps)
{
    for (const glm::dvec3& m : texels)
        steps.add(degreesByChord(a.t * m.x + a.b * m.y + a.n * m.z, b.t * m.x + b.b * m.y + b.n * m.z), weight);
}

} // namespace

double lint::degreesBetween(glm::dvec3 a, glm::dvec3 b) { return glm::degrees(angleBetween(a, b)); }

EdgeSteps lint::edgeSteps(const MappedSurface& s, std::size_t maxEdges)
{
    EdgeSteps result;
    if (!s.hasUv())
        return result;
    std::vector<std::int8_t> orientations(s.triangleCount());
    for (std::size_t i = 0; i < orientations.size(); ++i)
        orientations[i] = std::int8_t(orientationOf(s, i));
    const std::size_t edges = s.triangleCount() * 3 / 2; // of a closed mesh; others have fewer
    const std::size_t every = std::max<std::size_t>((edges + maxEdges - 1) / maxEdges, 1);
    const std::array<glm::dvec3, kDirections> texels = tilted();
    ValueStatistics cotangent, orthonormal;
    eachSharedEdge(s, [&](const Side& a, const Side& b) {
        const int orientation = orientations[a.triangle()];
        if (orientation == 0 || orientation != orientations[b.triangle()])
            return;
        if (result.edges++ % every != 0)
            return;
        const SurfaceSpot atA = spotAt(s, a.triangle(), middle(a)), atB = spotAt(s, b.triangle(), middle(b));
        const double weight = (areaOf(atA.edges) + areaOf(atB.edges)) / (3.0 * kDirections);
        addSteps(texels, frameOf(atA, Frame::cotangent), frameOf(atB, Frame::cotangent), weight, cotangent);
        addSteps(texels, frameOf(atA, Frame::orthonormal), frameOf(atB, Frame::orthonormal), weight, orthonormal);
    });
    result.cotangent = summaryOf(std::move(cotangent));
    result.orthonormal = summaryOf(std::move(orthonormal));
    return result;
}

// ---- overlaps ---------------------------------------------------------------------------------

namespace {

constexpr double kMaxRows = 1e7; // of texels under all triangles; with more the raster is coarser
constexpr int kCoarsest = 16;

// For each texel: the number of texels before it in its row that are covered more than once, and in both orientations.
// With such prefix sums a triangle needs two lookups in each of its rows. begins: for each texel, how many more
// triangles cover it than the texel before it in its row: plain, mirrored; `width` per row.
std::vector<glm::uvec2> coversBefore(const std::vector<glm::ivec2>& begins, std::size_t width)
{
    std::vector<glm::uvec2> covers(begins.size());
    for (std::size_t start = 0; start < begins.size(); start += width) {
        glm::ivec2 n(0); // plain, mirrored
        for (std::size_t x = start; x + 1 < start + width; ++x) {
            n += begins[x];
            covers[x + 1] = covers[x] + glm::uvec2(n.x + n.y > 1, n.x > 0 && n.y > 0);
        }
    }
    return covers;
}

struct Covered {
    std::uint32_t texels = 0;
    glm::uvec2 again{0}; // of those: covered more than once, and in both orientations
};

void addOverlaps(const MappedSurface& s, const std::vector<Covered>& triangles, UvQuality& q)
{
    glm::dvec2 again(0);
    for (std::size_t i = 0; i < triangles.size(); ++i)
        if (triangles[i].texels > 0)
            again += areaOf(s, i) / double(triangles[i].texels) * glm::dvec2(triangles[i].again);
    const double whole = q.area > 0 ? q.area : std::numeric_limits<double>::quiet_NaN();
    q.overlapping = again.x / whole;
    q.overlappingMirrored = again.y / whole;
}

} // namespace

void lint::countOverlaps(const std::vector<const MappedSurface*>& surfaces, const std::vector<UvQuality*>& qualities,
                         int side)
{
    if (std::ranges::all_of(surfaces, [](const MappedSurface* s) { return !s->hasUv(); }))
        return;
    const auto rowsAt = [&](int height) {
        double rows = 0;
        for (const MappedSurface* s : surfaces)
            rows += rowsUnder(*s, height);
        return rows;
    };
    while (side > kCoarsest && rowsAt(side) > kMaxRows)
        side /= 2;
    if (rowsAt(side) > kMaxRows) {
        for (UvQuality* q : qualities)
            q->overlapping = 1;
        return;
    }
    std::vector<UvRaster> rasters;
    const std::size_t width = std::size_t(side) + 1; // of a row of begins: one more than the texels
    std::vector<glm::ivec2> begins(width * std::size_t(side));
    for (const MappedSurface* s : surfaces) {
        std::vector<bool> mirrored(s->triangleCount());
        for (std::size_t i = 0; i < mirrored.size(); ++i)
            mirrored[i] = orientationOf(*s, i) < 0;
        rasters.push_back(repeatedRaster(*s, side, side));
        rasters.back().eachSpan([&](const UvSpan& span) {
            glm::ivec2* const row = &begins[std::size_t(span.y) * width];
            ++row[span.first][mirrored[span.triangle]];
            --row[span.last + 1][mirrored[span.triangle]];
        });
    }
    const std::vector<glm::uvec2> covers = coversBefore(begins, width);
    for (std::size_t k = 0; k < surfaces.size(); ++k) {
        std::vector<Covered> triangles(surfaces[k]->triangleCount());
        rasters[k].eachSpan([&](const UvSpan& span) {
            const std::size_t row = std::size_t(span.y) * width;
            const std::size_t first = row + std::size_t(span.first), after = row + std::size_t(span.last) + 1;
            Covered& c = triangles[span.triangle];
            c.texels += std::uint32_t(after - first);
            c.again += covers[after] - covers[first];
        });
        addOverlaps(*surfaces[k], triangles, *qualities[k]);
    }
}

} // namespace cotan
