#include "baker.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "core/other_axis.hpp"
#include "core/try.hpp"

namespace cotan {

namespace {

constexpr float kNearestDistance = 0.05f;              // of the diagonal of the high surface
constexpr float kLift = 1e-5f;                         // of the same diagonal
constexpr float kThickness = 0.5f, kCurvature = 0.01f; // of the same diagonal
constexpr float kEndless = 1e30f;                      // of rays
constexpr double kGoldenAngle = 2.399963229728653;     // radians

float diagonalOf(const HighSurface& high) { return glm::length(high.box().high - high.box().low); }

void copyHit(const Hits& from, std::size_t i, Hits& to)
{
    to.distance[i] = from.distance[i];
    to.normal.set(i, from.normal.at(i));
    to.face.set(i, from.face.at(i));
    to.instance[i] = from.instance[i];
    to.triangle[i] = from.triangle[i];
    to.b1[i] = from.b1[i];
    to.b2[i] = from.b2[i];
    to.away[i] = from.away[i];
}

// Marks the lines on which any surface lies within farthest(i) of the point, on either side; lines with a negative
// farthest(i) are skipped. Returns the number of rays.
template<class Farthest>
std::size_t anyAround(const HighSurface& high, const Probes& probes, Lanes<int>& any, const Farthest& farthest)
{
    any.fill(0);
    Lanes<float> lengths;
    std::size_t rays = 0;
    for (std::size_t i = 0; i < probes.count; ++i) {
        lengths[i] = farthest(i);
        rays += lengths[i] < 0 ? 0 : 1;
    }
    if (rays == 0) // nearly always, where all rays hit something
        return 0;
    Probes lines = probes;
    for (std::size_t i = 0; i < probes.count; ++i)
        if (lengths[i] < 0)
            lines.direction.set(i, glm::vec3(0));
        else
            lines.before[i] = lines.reach[i] = lengths[i];
    high.anyBetween(lines, any);
    return rays;
}

} // namespace

Status measureRayStarts(const LowSurface& low, const HighSurface& high, BakeOptions& options, const LowRest& rest)
{
    if (options.starts || !options.cage.empty() || options.search != BakeSearch::first)
        return Done{};
    COTAN_TRY(starts, makeRayStarts(low, high, options, rest));
    options.starts = std::make_shared<const RayStarts>(std::move(*starts));
    return Done{};
}

Baker::Baker(const LowSurface& low, const HighSurface& high, const BakeOptions& options)
    : low_(low), high_(high), options_(options)
{
    diagonal_ = diagonalOf(high);
    distance_ = options.maxDistance > 0 ? options.maxDistance
        : measured()                    ? options.starts->limit
                                        : kNearestDistance * diagonal_;
    lift_ = kLift * diagonal_;
    const int rays = std::max(options.occlusionRays, options.samples * options.samples);
    for (int i = 0; i < rays; ++i) {
        const double r2 = (i + 0.5) / rays, a = i * kGoldenAngle;
        around_.emplace_back(std::sqrt(r2) * std::cos(a), std::sqrt(r2) * std::sin(a), std::sqrt(1 - r2));
    }
}

void Baker::aim(const LowPoints& points, std::span<const UvSample> samples, Probes& probes) const
{
    probes.count = samples.size();
    probes.point = points.position;
    probes.direction = probes.normal = points.normal;
    probes.before.fill(0);
    probes.reach.fill(distance_);
    probes.only.fill(Probes::kAny);
    if (!options_.matched.empty())
        for (std::size_t i = 0; i < samples.size(); ++i) // -1 becomes Probes::kAny
            probes.only[i] = std::uint32_t(options_.matched[low_.triangleInstance[samples[i].triangle]]);
    if (!options_.cage.empty())
        for (std::size_t i = 0; i < samples.size(); ++i)
            aimFromCage(samples[i], i, probes);
    else if (measured())
        for (std::size_t i = 0; i < samples.size(); ++i)
            aimFromStart(points, samples[i], i, probes);
}

void Baker::aimFromCage(const UvSample& sample, std::size_t i, Probes& probes) const
{
    const std::uint32_t* v = &low_.indices[3 * std::size_t(sample.triangle)];
    const glm::vec3 toCage = atVertices(options_.cage, v, sample.b1, sample.b2) - probes.point.at(i);
    const float before = glm::length(toCage);
    probes.before[i] = before;
    probes.reach[i] = options_.cageReach > 0 && before > 0 ? options_.cageReach - before : before;
    probes.direction.set(i, before > 0 ? toCage / before : glm::vec3(0));
}

void Baker::aimFromStart(const LowPoints& points, const UvSample& sample, std::size_t i, Probes& probes) const
{
    const RayStarts& starts = *options_.starts;
    if (starts.directionsDiffer) {
        const RayStart ray = rayStartAt(low_, starts, sample.triangle, sample.b1, sample.b2, probes.point.at(i));
        if (ray.direction != glm::vec3(0))
            probes.direction.set(i, ray.direction);
        probes.before[i] = ray.before;
    } else {
        const glm::vec3 sum = points.from.raw.at(i); // of normals
        const std::uint32_t* v = &low_.indices[3 * std::size_t(sample.triangle)];
        probes.before[i] = std::sqrt(glm::dot(sum, sum)) * atVertices(starts.distances, v, sample.b1, sample.b2);
    }
    if (starts.obstructed[sample.triangle])
        probes.before[i] = openDistance(*starts.tree, sample.triangle, probes.point.at(i), probes.direction.at(i),
                                        starts.skip, probes.before[i]);
}

std::size_t Baker::find(std::span<const UvSample> samples, const Probes& probes, Hits& hits) const
{
    std::size_t rays = probes.count;
    if (options_.cage.empty() && options_.search == BakeSearch::nearest) {
        high_.nearest(probes, lift_, options_.highNormals, hits);
        rays += probes.count;
    } else {
        high_.outermost(probes, options_.highNormals, hits);
        if (measured())
            rays += findFromFurtherOut(samples, probes, hits);
    }
    hits.shown = hits.normal;
    if (options_.highMaps)
        for (std::size_t i = 0; i < probes.count; ++i)
            if (hits.found(i))
                hits.shown.set(i,
                               options_.highMaps->normalAt(hits.instance[i], hits.triangle[i], double(hits.b1[i]),
                                                           double(hits.b2[i]), hits.normal.at(i)));
    return rays;
}

// Probes that hit nothing, or only surfaces that face away, are traced again from the full search distance.
std::size_t Baker::findFromFurtherOut(std::span<const UvSample> samples, const Probes& probes, Hits& hits) const
{
    Probes further;
    std::size_t rays = 0;
    for (std::size_t i = 0; i < probes.count; ++i) {
        if ((hits.found(i) && !hits.away[i]) || !(distance_ > probes.before[i]))
            continue;
        if (rays++ == 0) {
            further = probes;
            further.direction = {};
        }
        further.direction.set(i, probes.direction.at(i));
        further.before[i] = options_.starts->tree
            ? openDistance(*options_.starts->tree, samples[i].triangle, probes.point.at(i), probes.direction.at(i),
                           options_.starts->skip, distance_)
            : distance_;
    }
    if (rays == 0)
        return 0;
    Hits found;
    high_.outermost(further, options_.highNormals, found);
    for (std::size_t i = 0; i < probes.count; ++i)
        if (found.found(i) && (!hits.found(i) || !found.away[i]))
            copyHit(found, i, hits);
    return rays;
}

std::size_t Baker::findNearer(const Probes& probes, const Hits& hits, Lanes<int>& nearer) const
{
    if (!measured()) {
        nearer.fill(0);
        return 0;
    }
    // A hit behind the low surface needs no check: its ray started further out and met nothing before.
    return anyAround(high_, probes, nearer, [&](std::size_t i) {
        const float off = hits.distance[i], skip = std::max(4 * lift_, 1e-3f * off);
        return hits.found(i) && off > 2 * skip ? off - skip : -1;
    });
}

bool Baker::anyFarInFront(const Hits& hits) const
{
    bool any = false;
    for (std::size_t i = 0; measured() && i < kLanes; ++i)
        any = any || (hits.found(i) && hits.distance[i] > 0.15f * distance_);
    return any;
}

std::size_t Baker::findFurther(const Probes& probes, const Hits& hits, Lanes<int>& further) const
{
    const glm::vec3 middle = high_.box().centre();
    return anyAround(high_, probes, further, [&](std::size_t i) {
        return hits.found(i) ? -1 : glm::length(middle - probes.point.at(i)) + diagonalOf(high_);
    });
}

float Baker::unitOf(BakeKind kind) const
{
    if (kind == BakeKind::thickness)
        return options_.thicknessDistance > 0 ? options_.thicknessDistance : kThickness * diagonal_;
    if (kind == BakeKind::curvature)
        return options_.curvatureRadius > 0 ? options_.curvatureRadius : kCurvature * diagonal_;
    return 0;
}

void Baker::valuesOf(BakeKind kind, const LowPoints& points, const Probes& probes, const Hits& hits,
                     const Around& around, const MaterialValues& materials, Lanes3& values) const
{
    const auto setAll = [&](const auto& valueOf) {
        for (std::size_t i = 0; i < kLanes; ++i)
            values.set(i, valueOf(i));
    };
    switch (kind) {
    case BakeKind::normal: encode(points, hits.shown, values); break;
    case BakeKind::objectNormal: values = hits.shown; break;
    case BakeKind::bentNormal: encode(points, around.open, values); break;
    case BakeKind::objectBentNormal: values = around.open; break;
    case BakeKind::occlusion: setAll([&](std::size_t i) { return glm::vec3(around.openness[i], 0, 1); }); break;
    case BakeKind::thickness: setAll([&](std::size_t i) { return glm::vec3(around.thickness[i], 0, 1); }); break;
    case BakeKind::height:
        setAll([&](std::size_t i) {
            const bool leans = measured() && options_.starts->directionsDiffer;
            const float slope = leans ? glm::dot(probes.direction.at(i), points.normal.at(i)) : 1;
            return glm::vec3(hits.distance[i] * slope, 0, 1);
        });
        break;
    case BakeKind::curvature:
        setAll([&](std::size_t i) { return glm::vec3(hits.found(i) ? high_.curvatureAt(hits, i) : 0, 0, 1); });
        break;
    case BakeKind::position: {
        const Bounds box = high_.box();
        const glm::vec3 size = glm::max(box.high - box.low, glm::vec3(1e-30f));
        setAll([&](std::size_t i) {
            const glm::vec3 where = probes.point.at(i) + probes.direction.at(i) * hits.distance[i];
            return 1.0f + glm::clamp((where - box.low) / size, 0.0f, 1.0f);
        });
        break;
    }
    case BakeKind::baseColor: setAll([&](std::size_t i) { return 1.0f + materials.baseColor.at(i); }); break;
    case BakeKind::emissive: setAll([&](std::size_t i) { return 1.0f + materials.emissive.at(i); }); break;
    case BakeKind::roughness: setAll([&](std::size_t i) { return glm::vec3(materials.surface.y[i], 0, 1); }); break;
    case BakeKind::metallic: setAll([&](std::size_t i) { return glm::vec3(materials.surface.z[i], 0, 1); }); break;
    case BakeKind::roughnessMetallic: values = materials.surface; break;
    case BakeKind::id: setAll([&](std::size_t i) { return glm::vec3(materials.id[i], 0, 1); }); break;
    }
}

// For each hit: cosine-weighted directions on a golden-ratio spiral around the normal, times `side`, rotated by an
// angle that depends on the texel. The nth of a texel's samples has every such direction whose number is n modulo their
// number. Calls see(lane, rays from the hit), which run against Probes::direction, and returns the number of rays.
template<class See>
std::size_t Baker::look(const Probes& probes, const Hits& hits, std::span<const glm::ivec2> rasterTexels, float side,
                        const See& see) const
{
    const int axis = options_.samples, samples = axis * axis, all = int(around_.size());
    std::size_t count = 0;
    Probes rays;
    rays.reach.fill(kEndless);
    for (std::size_t lane = 0; lane < rasterTexels.size(); ++lane) {
        if (!hits.found(lane))
            continue;
        const glm::vec3 where = probes.point.at(lane) + probes.direction.at(lane) * hits.distance[lane];
        const glm::ivec2 texel = rasterTexels[lane] / axis, within = rasterTexels[lane] - texel * axis;
        const std::uint32_t pattern = std::uint32_t(texel.x) * 7919u + std::uint32_t(texel.y) * 104729u;
        // Outwards is the side that the ray came from.
        const glm::vec3 out = probes.direction.at(lane);
        const auto towards = [&](glm::vec3 v) { return (glm::dot(v, out) < 0 ? -v : v) * side; };
        const glm::vec3 face = towards(hits.face.at(lane)), n = towards(hits.normal.at(lane));
        const glm::vec3 t = glm::normalize(glm::cross(otherAxis(n), n)), b = glm::cross(n, t);
        const double rotation = double(pattern * 2654435769u) / 4294967296.0 * 2 * std::numbers::pi;
        const float cosine = float(std::cos(rotation)), sine = float(std::sin(rotation));
        const glm::vec3 u = t * cosine + b * sine, v = b * cosine - t * sine;
        const float length = glm::length(face);
        const glm::vec3 origin = where + (length > 0 ? face / length : n) * lift_;
        rays.only.fill(options_.occluders == Occluders::matched ? probes.only[lane] : Probes::kAny);
        for (std::size_t i = 0; i < kLanes; ++i)
            rays.point.set(i, origin);
        const int first = within.y * axis + within.x;
        for (int i = first; i < all; i += samples) {
            const glm::vec3& d = around_[std::size_t(i)];
            rays.direction.set(rays.count++, -(u * d.x + v * d.y + n * d.z));
            if (rays.count < kLanes && i + samples < all)
                continue;
            see(lane, rays);
            count += rays.count;
            rays.count = 0;
        }
    }
    return count;
}

std::size_t Baker::lookOut(const Probes& probes, const Hits& hits, std::span<const glm::ivec2> rasterTexels,
                           Around& around) const
{
    Lanes<int> looks{}, open{}, any{};
    Lanes3 sums;
    const std::size_t count = look(probes, hits, rasterTexels, 1, [&](std::size_t lane, const Probes& rays) {
        high_.anyBetween(rays, any, true);
        looks[lane] += int(rays.count);
        for (std::size_t i = 0; i < rays.count; ++i)
            if (any[i] == 0) {
                ++open[lane];
                sums.set(lane, sums.at(lane) - rays.direction.at(i));
            }
    });
    for (std::size_t i = 0; i < kLanes; ++i) {
        around.openness[i] = float(open[i]) / float(std::max(looks[i], 1));
        const float length = glm::length(sums.at(i));
        const glm::vec3 n = hits.normal.at(i);
        around.open.set(i, length > 1e-3f ? sums.at(i) / length : glm::dot(n, probes.direction.at(i)) < 0 ? -n : n);
    }
    return count;
}

std::size_t Baker::lookIn(const Probes& probes, const Hits& hits, std::span<const glm::ivec2> rasterTexels,
                          Around& around) const
{
    Lanes<int> looks{};
    Lanes<double> lengths{};
    Lanes<float> found{};
    const double longest = unitOf(BakeKind::thickness);
    const std::size_t count = look(probes, hits, rasterTexels, -1, [&](std::size_t lane, const Probes& rays) {
        high_.distances(rays, found);
        looks[lane] += int(rays.count);
        for (std::size_t i = 0; i < rays.count; ++i)
            lengths[lane] += std::min(found[i] + double(lift_), longest);
    });
    for (std::size_t i = 0; i < kLanes; ++i)
        around.thickness[i] = float(lengths[i] / std::max(looks[i], 1));
    return count;
}

} // namespace cotan
