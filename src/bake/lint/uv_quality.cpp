#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <glm/geometric.hpp>

#include "lint_parts.hpp"

namespace cotan {

namespace {

// The ratio of the two singular values of the gradients of u and v, at least 1; 0 where the smaller is below 1e-4 of
// the larger: uv along a line, or one point.
double stretchOf(glm::dvec3 u, glm::dvec3 v)
{
    const double uu = glm::dot(u, u), vv = glm::dot(v, v), uv = glm::dot(u, v);
    const double mean = (uu + vv) / 2;
    const double radius = std::sqrt((uu - vv) * (uu - vv) / 4 + uv * uv);
    const double large = mean + radius;
    // The smaller eigenvalue from the determinant: the difference would cancel out.
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
        // Tangent first: t along dP/du, b on the side of +v.
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
    q.degenerate /= whole;
    q.mirrored /= whole;
    q.stretched /= whole;
    q.sheared /= whole;
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
            result.turned += corner.degrees > kTurned ? third : 0;
            angles.add(corner.degrees, third);
        }
    }
    result.reversedW /= compared; // of nothing: NaN
    result.turned /= compared;
    result.angle = summaryOf(std::move(angles));
    return result;
}

// ---- overlaps ---------------------------------------------------------------------------------

namespace {

constexpr double kMaxRows = 1e7; // of texels under all triangles; where there are more the raster is coarser
constexpr int kCoarsest = 16;

// For each texel, whether its centre is covered more than once, and whether by both orientations; as sums along each
// row, so that a triangle asks once in each of its rows.
struct Covers {
    std::vector<std::uint32_t> shared, turned; // `width` a row: how many of the texels before it

    // begins: how many more triangles cover a texel than the one before it in its row: plain, mirrored.
    Covers(const std::vector<glm::ivec2>& begins, std::size_t width) : shared(begins.size()), turned(begins.size())
    {
        for (std::size_t start = 0; start < begins.size(); start += width) {
            glm::ivec2 n(0); // plain, mirrored
            for (std::size_t x = start; x + 1 < start + width; ++x) {
                n += begins[x];
                shared[x + 1] = shared[x] + (n.x + n.y > 1);
                turned[x + 1] = turned[x] + (n.x > 0 && n.y > 0);
            }
        }
    }
};

struct Covered {
    std::uint32_t texels = 0, shared = 0, turned = 0;
};

void addOverlaps(const MappedSurface& s, const std::vector<Covered>& triangles, UvQuality& q)
{
    double several = 0, both = 0;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        if (triangles[i].texels == 0)
            continue;
        const double perTexel = areaOf(s, i) / double(triangles[i].texels);
        several += perTexel * double(triangles[i].shared);
        both += perTexel * double(triangles[i].turned);
    }
    const double whole = q.area > 0 ? q.area : std::numeric_limits<double>::quiet_NaN();
    q.overlapping = several / whole;
    q.overlappingMirrored = both / whole;
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
    const std::size_t width = std::size_t(side) + 1; // of a row of begins, one behind the last texel
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
    const Covers covers(begins, width);
    for (std::size_t k = 0; k < surfaces.size(); ++k) {
        std::vector<Covered> triangles(surfaces[k]->triangleCount());
        rasters[k].eachSpan([&](const UvSpan& span) {
            const std::size_t row = std::size_t(span.y) * width;
            const std::size_t first = row + std::size_t(span.first), after = row + std::size_t(span.last) + 1;
            Covered& c = triangles[span.triangle];
            c.texels += std::uint32_t(after - first);
            c.shared += covers.shared[after] - covers.shared[first];
            c.turned += covers.turned[after] - covers.turned[first];
        });
        addOverlaps(*surfaces[k], triangles, *qualities[k]);
    }
}

} // namespace cotan
