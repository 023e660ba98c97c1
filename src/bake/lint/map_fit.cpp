#include "bake/lint/map_fit.hpp"

#include <algorithm>
#include <utility>

#include <glm/geometric.hpp>

#include "lint_parts.hpp"

namespace cotan {

namespace {

constexpr std::size_t kMaxPoints = 65536; // over all uses of a map, but kMinEach for each
constexpr std::size_t kMinEach = 64;
constexpr std::size_t kMaxUses = kMaxPoints / kMinEach; // of more, evenly chosen ones are measured

// The normal that a frame makes of a map at a point.
glm::dvec3 normalOf(const Image& map, const MapUse& use, const Convention& stored, Frame frame, TangentOrigin tangents,
                    const MeshPoint& p)
{
    const auto format = toFormat<f64::cotan_normal_format>(stored, map.type, use.strength);
    const glm::dvec3 m = decodedAt(map, use.wrapU, use.wrapV, format, uvAt(use.surface, p.triangle, p.barycentric));
    const f64::cotan_frame f = frameAt(use.surface, frame, tangents, p.triangle, p.barycentric);
    return f64::cotan_normalize_or(f64::cotan_apply(f, m), f.n);
}

double mappedArea(const MappedSurface& s, std::size_t triangle)
{
    const TriangleEdges edges = edgesOf(s, triangle);
    return orientationOf(s, triangle, edges) != 0 ? areaOf(edges) : 0;
}

constexpr double kMinAlignment = 0.7071; // cosine of kMaxTangentAngle

// The frame that engines show with tangents: MikkTSpace of unit vectors. mikktspace.h requires interpolated vectors,
// but three.js and others normalise them; on coarse meshes that is a third of the error predicted here. Stored tangents
// within 45 degrees give the directions: on a mesh posed by bones they were made before it was posed.
f64::cotan_frame referenceFrame(const MappedSurface& s, const MeshPoint& p)
{
    f64::cotan_frame frame = frameAt(s, Frame::mikktspace, TangentOrigin::generated, p.triangle, p.barycentric);
    if (!s.hasStored() || !s.hasGenerated(Frame::mikktspace))
        return frame;
    glm::dvec4 t(0);
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec4 own = s.stored(3 * p.triangle + k), made = s.generated(Frame::mikktspace, 3 * p.triangle + k);
        const bool along = glm::dot(glm::dvec3(own), glm::dvec3(made))
            > kMinAlignment * glm::length(glm::dvec3(own)) * glm::length(glm::dvec3(made));
        t += p.barycentric[int(k)] * (along ? glm::dvec4(glm::dvec3(own), made.w) : made);
    }
    return f64::cotan_frame_mikktspace(f64::cotan_normalize_or(frame.n, frame.n),
                                       f64::cotan_normalize_or(glm::dvec3(t), glm::dvec3(0)), t.w);
}

} // namespace

// Points in the triangles follow the sequence of the plastic number (R2).
std::vector<MeshPoint> pointsOver(const MappedSurface& s, std::size_t count, double* area)
{
    double total = 0;
    for (std::size_t i = 0; i < s.triangleCount(); ++i)
        total += mappedArea(s, i);
    if (area)
        *area = total;
    std::vector<MeshPoint> points;
    if (!(total > 0))
        return points;
    std::size_t triangle = 0;
    double upTo = mappedArea(s, 0); // area of this triangle and all before it
    for (std::size_t k = 0; k < count; ++k) {
        const double at = (double(k) + 0.5) / double(count) * total;
        while (triangle + 1 < s.triangleCount() && upTo <= at)
            upTo += mappedArea(s, ++triangle);
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

std::vector<ValueSummary> mapErrors(const Image& before, const Image& after, std::span<const MapUse> uses,
                                    std::span<const FramePair> frames, std::optional<Expansion> expansionAfter,
                                    std::size_t maxPoints)
{
    const std::size_t each = std::clamp(kMaxPoints / std::max<std::size_t>(uses.size(), 1), kMinEach, kPointsOfSurface);
    const std::size_t count = std::min(each, maxPoints);
    std::vector<ValueStatistics> errors(frames.size());
    const std::size_t step = (uses.size() + kMaxUses - 1) / kMaxUses;
    for (std::size_t k = 0; k < uses.size(); k += step) {
        const MapUse& use = uses[k];
        if (!(std::abs(use.strength) > kFlattened))
            continue;
        double area = 0;
        const std::vector<MeshPoint> points = pointsOver(use.surface, count, &area);
        Convention stored = use.stored; // of `after`
        stored.expansion = expansionAfter.value_or(stored.expansion);
        for (const MeshPoint& p : points)
            for (std::size_t i = 0; i < frames.size(); ++i)
                errors[i].add(
                    lint::degreesBetween(
                        normalOf(before, use, use.stored, frames[i].from, frames[i].fromTangents, p),
                        normalOf(after, use, stored, use.readWith.value_or(frames[i].to), frames[i].toTangents, p)),
                    area / double(count));
    }
    std::vector<ValueSummary> summaries;
    for (auto& of : errors)
        summaries.push_back(summaryOf(std::move(of)));
    return summaries;
}

std::size_t pointsOfEach(std::size_t surfaces)
{
    constexpr std::size_t kTotalPoints = 128 * kPointsOfSurface, kMinOfSurface = 16;
    return std::clamp(kTotalPoints / std::max<std::size_t>(surfaces, 1), kMinOfSurface, kPointsOfSurface);
}

ValueSummary directionTurn(const MappedSurface& surface, const std::vector<MeshPoint>& points, const FramePair& frames)
{
    ValueStatistics turns;
    for (const MeshPoint& p : points) {
        const auto axisOf = [&](Frame frame, TangentOrigin tangents) {
            const f64::cotan_frame f = frameAt(surface, frame, tangents, p.triangle, p.barycentric);
            const glm::dvec3 n = f64::cotan_normalize_or(f.n, glm::dvec3(0));
            return f64::cotan_direction_on_surface(n, f.t, f.b, {1, 0}, n);
        };
        const glm::dvec3 from = axisOf(frames.from, frames.fromTangents), to = axisOf(frames.to, frames.toTangents);
        if (from == glm::dvec3(0) || to == glm::dvec3(0))
            return {};
        turns.add(lint::degreesBetween(from, glm::dot(from, to) < 0 ? -to : to));
    }
    return summaryOf(std::move(turns));
}

FrameSet framesRead(const FramePair& frames, bool stored)
{
    FrameSet set;
    for (const auto& [frame, tangents] :
         {std::pair(frames.from, frames.fromTangents), {frames.to, frames.toTangents}}) {
        // Stored tangents need no preparation, unlike everything that is generated at the vertices.
        const bool ofFile = readsTangents(frame) && tangents == TangentOrigin::stored && stored;
        if (readsVertices(frame) && !ofFile)
            set.set(std::size_t(frame));
    }
    return set;
}

std::vector<Reading> lint::readings(const MappedSurface& s, const std::vector<MeshPoint>& points, Frame madeFor,
                                    const Material& material, const Image& map, double maxPixels)
{
    struct Reader {
        std::string name;
        Frame frame;
        TangentOrigin tangents;
        ValueStatistics errors;
    };
    std::vector<Reader> readers;
    for (Frame f : {Frame::cotangent, Frame::orthonormal, Frame::smooth, Frame::exact, Frame::triangle})
        readers.push_back({std::string(name(f)), f, TangentOrigin::generated, {}});
    if (s.hasGenerated(Frame::areaWeighted))
        readers.push_back({"area-weighted", Frame::areaWeighted, TangentOrigin::generated, {}});
    if (s.hasStored() && madeFor == Frame::mikktspace)
        readers.push_back({"stored", Frame::mikktspace, TangentOrigin::stored, {}});

    const auto format =
        toFormat<f64::cotan_normal_format>(material.normalFormat, map.type, double(material.normalScale));
    const Sampler& sampler = material.normalMap.sampler;
    const std::vector<double> weights = visibility(s, points, material.doubleSided, maxPixels);
    for (std::size_t k = 0; k < points.size(); ++k) {
        const MeshPoint& p = points[k];
        const glm::dvec3 m = decodedAt(map, sampler.wrapU, sampler.wrapV, format, uvAt(s, p.triangle, p.barycentric));
        const auto readBy = [&](Frame frame, TangentOrigin tangents) {
            return f64::cotan_apply(frameAt(s, frame, tangents, p.triangle, p.barycentric), m);
        };
        const glm::dvec3 generated = readBy(madeFor, TangentOrigin::generated);
        const glm::dvec3 reference =
            madeFor == Frame::mikktspace ? f64::cotan_apply(referenceFrame(s, p), m) : generated;
        for (Reader& r : readers)
            r.errors.add(degreesBetween(readBy(r.frame, r.tangents),
                                        r.tangents == TangentOrigin::stored ? generated : reference),
                         weights[k]);
    }
    std::vector<Reading> result;
    for (Reader& r : readers)
        result.push_back({r.name, summaryOf(std::move(r.errors))});
    return result;
}

} // namespace cotan
