#include "cotan/lint/map_fit.hpp"

#include <algorithm>
#include <cmath>

#include "cotan/lint/texel.hpp"
#include "cotan/scene/normal_format.hpp"
#include "parts.hpp"

namespace cotan {

namespace {

constexpr std::size_t kMostPoints = 65536; // over all uses of a map, while each has kLeast
constexpr std::size_t kMost = 4096, kLeast = 64;

// The normal that a frame makes of a map at a place.
glm::dvec3 normalAt(const Image& map, const MapUse& use, const Convention& stored, Frame frame, TangentOrigin tangents,
                    const SurfacePoint& p)
{
    Texture texture;
    texture.sampler.wrapU = use.wrapU;
    texture.sampler.wrapV = use.wrapV;
    const auto format = toFormat<f64::cotan_normal_format>(stored, map.type, use.strength);
    const glm::dvec3 m = decodedAt(map, texture, format, atPoint(use.surface.uv, p.triangle, p.barycentric));
    const f64::cotan_frame f = frameAt(use.surface, frame, tangents, p.triangle, p.barycentric);
    return f64::cotan_normalize_or(f64::cotan_apply(f, m), f.n);
}

// Of the triangles that have area in uv.
double mappedArea(const MappedSurface& s)
{
    double area = 0;
    for (std::size_t i = 0; i < s.triangleCount(); ++i)
        area += orientationOf(s, i) != 0 ? areaOf(s, i) : 0;
    return area;
}

} // namespace

// In the triangles by the sequence of the plastic number (R2).
std::vector<SurfacePoint> pointsOver(const MappedSurface& s, std::size_t count)
{
    std::vector<double> upTo;
    double total = 0;
    for (std::size_t i = 0; i < s.triangleCount(); ++i)
        upTo.push_back(total += orientationOf(s, i) != 0 ? areaOf(s, i) : 0);
    std::vector<SurfacePoint> points;
    if (!(total > 0))
        return points;
    std::size_t triangle = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const double at = (double(k) + 0.5) / double(count) * total;
        while (triangle + 1 < upTo.size() && upTo[triangle] <= at)
            ++triangle;
        double a = std::fmod(0.5 + 0.7548776662466927 * double(k), 1.0);
        double b = std::fmod(0.5 + 0.5698402909980532 * double(k), 1.0);
        if (a + b > 1) {
            a = 1 - a;
            b = 1 - b;
        }
        points.push_back({triangle, glm::dvec3(1 - a - b, a, b)});
    }
    return points;
}

Spread mapError(const Image& before, const Image& after, const std::vector<const MapUse*>& uses,
                const FramePair& frames, std::optional<Expansion> expansionAfter)
{
    const std::size_t count = std::clamp(kMostPoints / std::max<std::size_t>(uses.size(), 1), kLeast, kMost);
    std::vector<std::pair<double, double>> errors;
    for (const MapUse* use : uses) {
        if (!(std::abs(use->strength) > kFlattened))
            continue;
        const std::vector<SurfacePoint> points = pointsOver(use->surface, count);
        const double weight = mappedArea(use->surface) / double(count);
        Convention stored = use->stored;
        stored.expansion = expansionAfter.value_or(stored.expansion);
        for (const SurfacePoint& p : points)
            errors.emplace_back(
                lint::degreesBetween(normalAt(before, *use, use->stored, frames.from, frames.fromTangents, p),
                                     normalAt(after, *use, stored, frames.to, frames.toTangents, p)),
                weight);
    }
    return spreadOf(std::move(errors));
}

Spread directionTurn(const MappedSurface& surface, const FramePair& frames)
{
    std::vector<std::pair<double, double>> turns;
    for (const SurfacePoint& p : pointsOver(surface, kMost)) {
        const auto way = [&](Frame frame, TangentOrigin tangents) {
            const f64::cotan_frame f = frameAt(surface, frame, tangents, p.triangle, p.barycentric);
            const glm::dvec3 n = f64::cotan_normalize_or(f.n, glm::dvec3(0));
            return f64::cotan_direction_on_surface(n, f.t, f.b, {1, 0}, n);
        };
        const glm::dvec3 from = way(frames.from, frames.fromTangents), to = way(frames.to, frames.toTangents);
        if (from == glm::dvec3(0) || to == glm::dvec3(0))
            return {};
        turns.emplace_back(lint::degreesBetween(from, glm::dot(from, to) < 0 ? -to : to), 1);
    }
    return spreadOf(std::move(turns));
}

bool directionStays(const Spread& turn) { return turn.percentile95 <= kTurnedDirection; }

bool fitsAsItIs(const Spread& off) { return !(off.percentile95 > kAsRounding); }

} // namespace cotan
