#include "bake/ray_measuring.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "bake/surface/surface_triangle.hpp"
#include "core/loops.hpp"
#include "core/try.hpp"
#include "cotan/vector.hpp"

namespace cotan {

namespace {

constexpr float kMargin = 0.002f;            // of the diagonal
constexpr float kDistanceFactor = 1.05f;     // on measured distances
constexpr float kMinSlope = 0.3f;            // minimum cosine that distances are divided by, which bounds the cage
constexpr float kMinFacing = 0.1f;           // minimum cosine between surfaces that face the same way
constexpr float kAside = 0.35f;              // cosine below which the nearest point lies sideways
constexpr std::size_t kMaxVertices = 400000; // that are measured; of more, every second, third and so on
constexpr double kMaxVisits = 2e7;           // triangles that all points together may visit
constexpr std::size_t kTried = 256;          // triangles that the visits of a point are estimated from
constexpr std::size_t kCrowded = 2000;       // maximum number of visits by the median point
constexpr int kMaxCuts = 64;                 // of an edge of a large triangle
constexpr int kMaxEdgeRays = 64;             // from a hard edge

// The nearest point found for a thread's previous point; that for the next point is often close to it.
struct LastNearest {
    bool known = false;
    std::uint32_t triangle = 0;
    glm::vec3 point{0};
};

class Measuring {
public:
    Measuring(const LowSurface& low, const HighSurface& high, const BakeOptions& options, const LowBody& body,
              const VertexGroups& groups, const RayStarts& starts, const HardEdges& edges)
        : low_(low), high_(high), options_(options), body_(body), groups_(groups), starts_(starts), edges_(edges),
          distances_(groups.count, 0), reached_(groups.count, 0),
          needs_(edges.count, std::bit_cast<std::uint32_t>(kMargin * body.diagonal))
    {
        for (const std::uint32_t i : low.indices)
            near_ = {glm::min(near_.low, low.positions[i]), glm::max(near_.high, low.positions[i])};
        const glm::vec3 margin(1.001f * starts.limit);
        near_ = {near_.low - margin, near_.high + margin};
    }

    // Whether anything of the low surface may be within the limit of the box.
    bool reaches(const Bounds& box) const
    {
        return box.low == glm::min(box.low, near_.high) && box.high == glm::max(box.high, near_.low);
    }

    // Whether a triangle faces the same way as a point of the high surface with this normal, and shows this instance.
    auto accepting(glm::vec3 normal, std::uint32_t instance) const
    {
        return [this, normal, instance](std::uint32_t triangle) {
            return glm::dot(body_.outwardNormals[triangle], normal) > kMinFacing && shows(triangle, instance);
        };
    }

    // The number of triangles that the search for a point visits.
    std::size_t trianglesVisited(glm::vec3 point, glm::vec3 normal, std::uint32_t instance) const
    {
        return body_.tree->nearest(point, starts_.limit, accepting(normal, instance)).visited;
    }

    // Adds one point of the high surface with its normal.
    void add(glm::vec3 point, glm::vec3 normal, std::uint32_t instance, LastNearest& last)
    {
        if (!reaches({point, point}) || !(glm::dot(normal, normal) > 0))
            return;
        const auto accepts = accepting(normal, instance);
        float radius = starts_.limit;
        if (last.known && accepts(last.triangle)) // the nearest point is not further than the last one
            radius = std::min(radius, glm::length(point - last.point) * 1.0001f + 1e-7f * body_.diagonal);
        const LowTree::Nearest nearest = body_.tree->nearest(point, radius, std::cref(accepts));
        if (!nearest.found)
            return;
        last = {true, nearest.triangle, nearest.point};
        if (nearest.triangle >= low_.triangleCount())
            return;
        const glm::vec3 off = point - nearest.point;
        if (edges_.count > 0)
            addBeyondEdges(nearest, off);
        const std::uint32_t* const v = &low_.indices[3 * std::size_t(nearest.triangle)];
        const glm::vec3 sum = atVertices(starts_.directions, v, nearest.b1, nearest.b2), direction = unitOr(sum, sum);
        const float along = glm::dot(off, direction);
        if (nearest.distance <= 1e-6f * body_.diagonal || along <= 0)
            return raise(nearest.triangle, nearest.b1, nearest.b2, 0, direction);
        if (along >= kAside * nearest.distance)
            return raise(nearest.triangle, nearest.b1, nearest.b2, nearest.distance, off / nearest.distance);
        const LowTree::TreeHit below = body_.tree->first({point, -normal, 0, starts_.limit});
        if (below.found && below.triangle < low_.triangleCount() && accepts(below.triangle))
            raise(below.triangle, below.b1, below.b2, below.distance, normal);
    }

    // Shoots rays from vertices that nothing belongs to, and from vertices whose edges are all shorter than twice the
    // spacing of points on large triangles, as in any evenly tessellated mesh: a surface underneath may belong to them
    // while no point of the one above does. Uses every `every`-th of these vertices.
    void addRays(float spacing, std::size_t every)
    {
        std::vector<float> longest(groups_.count, 0); // per group: longest edge at the vertex, squared
        for (std::size_t i = 0; i < low_.indices.size(); ++i) {
            const std::uint32_t a = low_.indices[i], b = low_.indices[i % 3 == 2 ? i - 2 : i + 1];
            const glm::vec3 edge = low_.positions[b] - low_.positions[a];
            for (const std::uint32_t g : {groups_.of[a], groups_.of[b]})
                longest[g] = std::max(longest[g], glm::dot(edge, edge));
        }
        std::vector<std::uint32_t> open;
        std::vector<std::uint8_t> queued(groups_.count, 0);
        const auto isOpen = [&](std::uint32_t g) { return !reached_[g] || longest[g] < 4 * spacing * spacing; };
        for (std::size_t i = 0; i < low_.indices.size(); ++i)
            if (const std::uint32_t g = groups_.of[low_.indices[i]]; !queued[g] && isOpen(g)) {
                queued[g] = 1;
                open.push_back(std::uint32_t(i));
            }
        parallelRanges<std::size_t>(0, (open.size() + every - 1) / every, 64, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i != end; ++i)
                addRay(open[i * every]);
        });
    }

    // Shoots rays from hard edges. distances: of the vertices.
    void addRaysFromEdges(const std::vector<float>& distances)
    {
        std::vector<std::uint32_t> sides; // one of each edge
        std::vector<std::uint8_t> seen(edges_.count, 0);
        for (std::size_t i = 0; i < edges_.of.size(); ++i)
            if (const std::uint32_t edge = edges_.of[i]; edge != HardEdges::kNone && !std::exchange(seen[edge], 1))
                sides.push_back(std::uint32_t(i));
        parallelRanges<std::size_t>(0, sides.size(), 16, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i != end; ++i)
                addRaysFromEdge(sides[i], distances);
        });
    }

    // The distance from each hard edge to what its rays must show.
    std::vector<float> needs() const
    {
        std::vector<float> all;
        for (const std::uint32_t bits : needs_)
            all.push_back(std::bit_cast<float>(bits));
        return all;
    }

    // The distance of each vertex of the low surface.
    std::vector<float> distances() const
    {
        std::vector<float> all(low_.positions.size());
        for (std::size_t v = 0; v < all.size(); ++v) {
            all[v] = std::bit_cast<float>(distances_[groups_.of[v]]) * kDistanceFactor + kMargin * body_.diagonal;
            all[v] = options_.maxDistance > 0 ? std::min(all[v], options_.maxDistance) : all[v];
        }
        return all;
    }

private:
    bool shows(std::uint32_t triangle, std::uint32_t instance) const
    {
        return body_.highGroups.empty() || body_.highGroups[triangle] < 0
            || body_.highGroups[triangle] == std::int64_t(high_.groupOf(instance));
    }
    // Raises the distances at the corners until they enclose the plane across `direction` at `distance`.
    void raise(std::uint32_t triangle, float b1, float b2, float distance, glm::vec3 direction)
    {
        const float weights[3] = {1 - b1 - b2, b1, b2};
        for (std::size_t i = 0; i < 3; ++i) {
            if (weights[i] < 1e-6f)
                continue;
            const std::uint32_t v = low_.indices[3 * std::size_t(triangle) + i];
            raiseVertex(v, distance / std::max(kMinSlope, glm::dot(starts_.directions[v], direction)));
        }
    }
    void raiseVertex(std::uint32_t v, float distance)
    {
        const std::uint32_t group = groups_.of[v];
        std::atomic_ref<std::uint8_t>(reached_[group]).store(1, std::memory_order_relaxed);
        raiseTo(distance, distances_[group]);
    }
    // bits: of a float.
    static void raiseTo(float distance, std::uint32_t& bits)
    {
        // Non-negative floats are ordered like their bits.
        std::atomic_ref<std::uint32_t> kept(bits);
        const auto wanted = std::bit_cast<std::uint32_t>(distance);
        std::uint32_t now = kept.load(std::memory_order_relaxed);
        while (now < wanted && !kept.compare_exchange_weak(now, wanted, std::memory_order_relaxed))
            ;
    }
    // Raises the needs of hard edges that a point lies beyond: between the normal at the edge and the rays from there.
    void addBeyondEdges(const LowTree::Nearest& nearest, glm::vec3 off)
    {
        const float weights[3] = {1 - nearest.b1 - nearest.b2, nearest.b1, nearest.b2};
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t i = 3 * std::size_t(nearest.triangle) + k;
            if (edges_.of[i] == HardEdges::kNone || weights[(k + 2) % 3] > 1e-3f)
                continue;
            const EdgeSide side = sideOf(low_, starts_.directions, i);
            const float height = glm::dot(off, side.up), across = glm::dot(off, side.out);
            const bool beyond =
                height * side.sine > 0 && across > 0 && across * side.cosine <= 1.05f * std::abs(side.sine * height);
            if (beyond)
                raiseTo(std::sqrt(height * height + across * across), needs_[edges_.of[i]]);
        }
    }
    // Raises the need of an edge to what rays from there hit; at concave edges to where they start, because straight
    // rays beside the edge would meet what stands on its other side.
    void addRaysFromEdge(std::size_t edge, const std::vector<float>& distances)
    {
        const std::uint32_t a = low_.indices[edge], b = low_.indices[edge % 3 == 2 ? edge - 2 : edge + 1],
                            triangle = std::uint32_t(edge / 3);
        const glm::vec3 from = low_.positions[a], along = low_.positions[b] - from;
        const bool concave = sideOf(low_, starts_.directions, edge).sine < 0;
        const float length = glm::length(along);
        const int rays = int(glm::clamp(length / (4 * kRaySpacing * body_.diagonal), 1.0f, float(kMaxEdgeRays)));
        for (int i = 0; i < rays; ++i) {
            const float t = (float(i) + 0.5f) / float(rays);
            const glm::vec3 sum = glm::mix(starts_.directions[a], starts_.directions[b], t), point = from + along * t;
            const float norm = glm::length(sum);
            if (!(norm > 0) || !(length > 0))
                continue;
            const glm::vec3 direction = sum / norm;
            float before = norm * glm::mix(distances[a], distances[b], t);
            if (starts_.tree)
                before = openDistance(*starts_.tree, triangle, point, direction, starts_.skip, before);
            const std::optional<float> off = outermost(triangle, point, direction, before, starts_.limit);
            const float need = std::max(std::abs(off.value_or(0)), concave ? before : 0);
            raiseTo(need * glm::length(glm::cross(direction, along / length)), needs_[edges_.of[edge]]);
        }
    }
    // How far in front of a point of a triangle, along a direction, the outermost front lies.
    std::optional<float> outermost(std::uint32_t triangle, glm::vec3 point, glm::vec3 direction, float before,
                                   float behind) const
    {
        constexpr int kMaxLayers = 16;
        const float lift = 1e-5f * body_.diagonal, whole = before + behind;
        float passed = 0;
        for (int layer = 0; layer < kMaxLayers && passed < whole; ++layer) {
            const Hit hit = high_.trace({point + direction * (before - passed), -direction, 0, whole - passed});
            if (!hit.found)
                return std::nullopt;
            passed += hit.distance + lift;
            if (shows(triangle, hit.instance) && glm::dot(hit.front, direction) > kMinFacing)
                return before - passed;
        }
        return std::nullopt;
    }
    void addRay(std::uint32_t index)
    {
        const std::uint32_t v = low_.indices[index], triangle = index / 3;
        const glm::vec3 direction = starts_.directions[v], point = low_.positions[v];
        if (!(glm::dot(direction, direction) > 0))
            return;
        const float from = openDistance(*body_.tree, triangle, point, direction, starts_.skip, starts_.limit);
        if (const auto off = outermost(triangle, point, direction, from, 0))
            raiseVertex(v, std::max(0.0f, *off));
    }

    const LowSurface& low_;
    const HighSurface& high_;
    const BakeOptions& options_;
    const LowBody& body_;
    const VertexGroups& groups_;
    const RayStarts& starts_;
    const HardEdges& edges_;
    Bounds near_;                          // of the low surface and all within the limit
    std::vector<std::uint32_t> distances_; // bits of floats, per group
    std::vector<std::uint8_t> reached_;    // something belongs to the group
    std::vector<std::uint32_t> needs_;     // bits of floats, per hard edge
};

// The number of pieces of a triangle's edges for points about `spacing` apart; 0 if it is small, or rays skip it.
int cutsOf(const HighSurface::Triangles& part, std::size_t triangle, float spacing)
{
    if (!part.repeated.empty() && part.repeated[triangle])
        return 0;
    const float longest = longestEdge(part.positions, &part.indices[3 * triangle]);
    return longest > spacing ? int(std::min(std::ceil(longest / spacing), float(kMaxCuts))) : 0;
}

// Calls add(point, normal) for points between the corners of a triangle, about `spacing` apart.
template<class Add>
void pointsBetween(const HighSurface::Triangles& part, std::size_t triangle, float spacing, const Add& add)
{
    const int cuts = cutsOf(part, triangle, spacing);
    if (cuts == 0)
        return;
    const std::uint32_t* c = &part.indices[3 * triangle];
    for (int i = 0; i <= cuts; ++i)
        for (int j = 0; j <= cuts - i; ++j) {
            const float b1 = float(i) / float(cuts), b2 = float(j) / float(cuts);
            const glm::vec3 n = atVertices(part.normals, c, b1, b2);
            const float length = glm::length(n);
            if (length > 0)
                add(atVertices(part.positions, c, b1, b2), n / length);
        }
}

// The step through triangles and vertices: 1 uses all, 2 every second. Where many triangles overlap, a point visits
// many of them and fewer points are used. An error if the median point visits far too many. vertices: their number.
Result<std::size_t> stepFor(const HighSurface& high, std::size_t vertices, float spacing, const Measuring& measuring)
{
    std::size_t between = 0;
    for (std::size_t instance = 0; instance < high.instanceCount(); ++instance) {
        const HighSurface::Triangles part = high.triangles(instance);
        for (std::size_t f = 0; part.longestEdge > spacing && f < part.indices.size() / 3; ++f)
            if (const auto cuts = std::size_t(cutsOf(part, f, spacing)))
                between += (cuts + 1) * (cuts + 2) / 2;
    }
    const std::size_t every = 1 + high.triangleCount() / kTried;
    std::vector<std::size_t> visited;
    std::size_t next = 0; // index in the instance's triangles
    for (std::uint32_t instance = 0; instance < high.instanceCount(); ++instance) {
        const HighSurface::Triangles part = high.triangles(instance);
        for (; next < part.indices.size() / 3; next += every) {
            const std::uint32_t* const c = &part.indices[3 * next];
            glm::vec3 point = part.positions[c[0]];
            if (visited.size() % 2 == 1)
                point = (point + part.positions[c[1]] + part.positions[c[2]]) / 3.0f;
            visited.push_back(measuring.trianglesVisited(point, part.normals[c[0]], instance));
        }
        next -= part.indices.size() / 3;
    }
    const auto middle = visited.begin() + std::ptrdiff_t(visited.size() / 2);
    std::nth_element(visited.begin(), middle, visited.end());
    if (*middle > kCrowded)
        return inputError(fmt::format("low: about {} of its triangles overlap at each point; expected at most {}: "
                                      "remove hidden triangles",
                                      *middle, kCrowded));
    const double mean = double(std::reduce(visited.begin(), visited.end())) / double(visited.size());
    const double work = double(std::min(vertices, kMaxVertices) + between) * mean;
    return 1 + std::size_t(work / kMaxVisits);
}

// Adds all points to `measuring`. Returns the step of stepFor.
Result<std::size_t> measure(const HighSurface& high, float spacing, Measuring& measuring)
{
    std::size_t vertices = 0;
    for (std::size_t instance = 0; instance < high.instanceCount(); ++instance)
        vertices += high.triangles(instance).positions.size();
    COTAN_TRY(fitting, stepFor(high, vertices, spacing, measuring));
    const std::size_t every = *fitting, step = std::max(1 + vertices / kMaxVertices, every);
    std::size_t before = 0; // triangles of earlier instances
    for (std::uint32_t instance = 0; instance < high.instanceCount(); ++instance) {
        const HighSurface::Triangles part = high.triangles(instance);
        const std::size_t first = std::exchange(before, before + part.indices.size() / 3);
        if (!measuring.reaches(part.box))
            continue;
        parallelRanges<std::size_t>(0, (part.positions.size() + step - 1) / step, 4096,
                                    [&](std::size_t begin, std::size_t end) {
                                        LastNearest last;
                                        for (std::size_t i = begin * step; i < end * step; i += step)
                                            if (i < part.positions.size())
                                                measuring.add(part.positions[i], part.normals[i], instance, last);
                                    });
        const std::size_t large = part.longestEdge > spacing ? part.indices.size() / 3 : 0;
        parallelRanges<std::size_t>(0, large, 1024, [&](std::size_t begin, std::size_t end) {
            LastNearest last;
            for (std::size_t f = begin; f != end; ++f)
                if ((first + f) % every == 0)
                    pointsBetween(part, f, spacing,
                                  [&](glm::vec3 p, glm::vec3 n) { measuring.add(p, n, instance, last); });
        });
    }
    measuring.addRays(spacing, every);
    return every;
}

} // namespace

Result<StandOff> measureStandOff(const LowSurface& low, const HighSurface& high, const BakeOptions& options,
                                 const LowBody& body, const VertexGroups& groups, const RayStarts& starts,
                                 const HardEdges& edges)
{
    StandOff found;
    Measuring measuring(low, high, options, body, groups, starts, edges);
    if (options.extrusion > 0) {
        found.distances.assign(low.positions.size(), options.extrusion);
    } else {
        COTAN_TRY(every, measure(high, std::max(body.edge, kRaySpacing * body.diagonal), measuring));
        found.every = *every;
        found.distances = measuring.distances();
    }
    if (edges.count > 0)
        measuring.addRaysFromEdges(found.distances);
    found.needs = measuring.needs();
    return found;
}

} // namespace cotan
