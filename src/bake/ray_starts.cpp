#include "bake/ray_starts.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "bake/ray_measuring.hpp"
#include "bake/surface/surface_triangle.hpp"
#include "core/loops.hpp"
#include "core/try.hpp"
#include "cotan/vector.hpp"
#include "scene/texture_sample.hpp"

namespace cotan {

namespace {

constexpr float kLimit = 0.1f;              // of the diagonal
constexpr float kMinDirectionCosine = 0.2f; // between a vertex's normal and its direction
constexpr float kSkip = 1e-4f;              // of the diagonal

VertexGroups groupsOf(const LowSurface& low)
{
    std::vector<std::uint32_t> instance(low.positions.size(), 0), order(low.positions.size());
    for (std::size_t i = 0; i < low.indices.size(); ++i)
        instance[low.indices[i]] = low.triangleInstance[i / 3];
    std::iota(order.begin(), order.end(), 0u);
    const auto key = [&](std::uint32_t v) {
        const glm::vec3 p = low.positions[v];
        return std::tuple(instance[v], p.x, p.y, p.z);
    };
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    VertexGroups groups;
    groups.of.resize(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (i > 0 && key(order[i]) != key(order[i - 1]))
            ++groups.count;
        groups.of[order[i]] = groups.count;
    }
    ++groups.count;
    return groups;
}

void findDirections(const LowSurface& low, const VertexGroups& groups, RayStarts& starts)
{
    std::vector<glm::vec3> sums(groups.count, glm::vec3(0)), first(groups.count);
    std::vector<std::uint8_t> seen(groups.count, 0); // 1: all normals are equal, 2: they differ
    for (std::size_t v = 0; v < low.normals.size(); ++v) {
        const std::uint32_t g = groups.of[v];
        if (!seen[g]) {
            seen[g] = 1;
            first[g] = low.normals[v];
        } else if (first[g] != low.normals[v]) {
            seen[g] = 2;
        }
    }
    for (std::size_t i = 0; i < low.indices.size(); ++i) {
        const std::size_t f = i / 3 * 3;
        const std::uint32_t v = low.indices[i];
        const glm::vec3 corner = low.positions[v];
        const float angle = angleBetween(low.positions[low.indices[f + (i + 1) % 3]] - corner,
                                         low.positions[low.indices[f + (i + 2) % 3]] - corner);
        sums[groups.of[v]] += low.normals[v] * angle;
    }
    starts.directions = low.normals;
    for (std::size_t v = 0; v < low.normals.size(); ++v) {
        const std::uint32_t g = groups.of[v];
        const float length = glm::length(sums[g]);
        if (seen[g] < 2 || !(length > 0) || glm::dot(sums[g], low.normals[v]) < kMinDirectionCosine * length)
            continue;
        starts.directions[v] = sums[g] / length;
        starts.directionsDiffer = starts.directionsDiffer || starts.directions[v] != low.normals[v];
    }
}

// Unites the low surface and the rest.
Result<LowBody> bodyOf(const LowSurface& low, const LowRest& rest, const BakeOptions& options)
{
    LowBody body;
    std::vector<glm::vec3> positions = low.positions, normals = low.normals;
    std::vector<std::uint32_t> indices = low.indices;
    std::vector<std::uint32_t> instances = low.triangleInstance;
    const auto base = std::uint32_t(positions.size());
    positions.insert(positions.end(), rest.positions.begin(), rest.positions.end());
    normals.insert(normals.end(), rest.normals.begin(), rest.normals.end());
    for (const std::uint32_t i : rest.indices)
        indices.push_back(base + i);
    instances.insert(instances.end(), rest.triangleInstance.begin(), rest.triangleInstance.end());
    body.highGroups = highGroups(instances, options.matched);
    glm::vec3 from(1e30f), to(-1e30f);
    for (const std::uint32_t i : indices) {
        from = glm::min(from, positions[i]);
        to = glm::max(to, positions[i]);
    }
    body.diagonal = glm::length(to - from);
    double area = 0;
    for (std::size_t i = 0; i < indices.size(); i += 3) {
        const glm::vec3 p = positions[indices[i]];
        const glm::vec3 n = glm::cross(positions[indices[i + 1]] - p, positions[indices[i + 2]] - p);
        const float length = glm::length(n);
        area += double(length) / 2;
        const glm::vec3 side = normals[indices[i]] + normals[indices[i + 1]] + normals[indices[i + 2]];
        body.outwardNormals.push_back(length > 0 ? n / (glm::dot(n, side) < 0 ? -length : length) : glm::vec3(0));
    }
    body.edge = float(1.5 * std::sqrt(area / double(body.outwardNormals.size())));
    COTAN_TRY(tree, LowTree::make(std::move(positions), std::move(indices), body.highGroups, options.threads));
    body.tree = std::move(*tree);
    return body;
}

// Whether some rays of a triangle would start behind another triangle.
bool isObstructed(const LowSurface& low, const RayStarts& starts, std::size_t triangle, float diagonal)
{
    constexpr int kMinSteps = 3, kMaxSteps = 12;
    const std::uint32_t* v = &low.indices[3 * triangle];
    const float wantedSteps = longestEdge(low.positions, v) / (4 * kRaySpacing * diagonal);
    const int steps = std::max(kMinSteps, int(std::min(wantedSteps, float(kMaxSteps))));
    for (int i = 0; i <= steps; ++i)
        for (int j = 0; j <= steps - i; ++j) {
            // Slightly inside the edges.
            const float b1 = (float(i) + 0.1f) / (float(steps) + 0.3f), b2 = (float(j) + 0.1f) / (float(steps) + 0.3f);
            const glm::vec3 point = atVertices(low.positions, v, b1, b2);
            const RayStart ray = rayStartAt(low, starts, std::uint32_t(triangle), b1, b2, point);
            if (glm::dot(ray.direction, ray.direction) > 0
                && openDistance(*starts.tree, std::uint32_t(triangle), point, ray.direction, starts.skip, ray.before)
                    < ray.before)
                return true;
        }
    return false;
}

// How straight rays at a point are, 0 to 1, as the mask says.
float straightnessAt(const LowSurface& low, const RayStarts& starts, const std::uint32_t* v, float b1, float b2)
{
    if (!starts.mask)
        return low.reds.empty() ? 1 : glm::clamp(atVertices(low.reds, v, b1, b2), 0.0f, 1.0f);
    const Image& mask = *starts.mask;
    const glm::vec2 uv = glm::clamp(atVertices(low.texcoords, v, b1, b2), -kFarthestUv, kFarthestUv);
    const auto texel = [&](int x, int y) { return storedComponents(mask, x, y); };
    return glm::clamp(bilinearTexel(mask.width, mask.height, {}, uv, texel).x, 0.0f, 1.0f);
}

} // namespace

std::vector<std::int64_t> highGroups(std::span<const std::uint32_t> triangleInstance,
                                     std::span<const std::int64_t> matched)
{
    std::vector<std::int64_t> highGroups;
    if (!matched.empty())
        for (const std::uint32_t instance : triangleInstance)
            highGroups.push_back(matched[instance]);
    return highGroups;
}

float openDistance(const LowTree& tree, std::uint32_t triangle, glm::vec3 point, glm::vec3 direction, float skip,
                   float wanted)
{
    if (!(wanted > skip))
        return wanted;
    const LowTree::TreeHit hit = tree.firstBeside(triangle, {point, direction, skip, wanted});
    if (!hit.found)
        return wanted;
    return glm::dot(tree.face(hit.triangle), direction) > 0 ? hit.distance / 2 : hit.distance;
}

RayStart rayStartAt(const LowSurface& low, const RayStarts& starts, std::uint32_t triangle, float b1, float b2,
                    glm::vec3 point)
{
    const std::uint32_t* const v = &low.indices[3 * std::size_t(triangle)];
    const glm::vec3 sum = atVertices(starts.directions, v, b1, b2);
    const float length = std::sqrt(glm::dot(sum, sum)), distance = atVertices(starts.distances, v, b1, b2);
    if (!(length > 0))
        return {};
    const RayStart averaged{sum / length, length * distance};
    if (starts.bands.bands.empty() && !starts.masked)
        return averaged;
    const glm::vec3 normal = unitOr(atVertices(low.normals, v, b1, b2), averaged.direction);
    const float slope = glm::dot(averaged.direction, normal);
    if (slope < kMinDirectionCosine)
        return averaged;
    const RayBands::Bend bend = starts.masked
        ? RayBands::Bend{1 - straightnessAt(low, starts, v, b1, b2), averaged.direction}
        : starts.bands.bendAt(triangle, point);
    const glm::vec3 direction = unitOr(glm::mix(normal, bend.direction, bend.amount), normal);
    const float cosine = glm::dot(direction, normal);
    if (!starts.tree) // a given distance
        return {direction, distance * glm::mix(1.0f, length, bend.amount)};
    return {direction, averaged.before * slope / std::max(cosine, kMinDirectionCosine)};
}

Result<RayStarts> makeRayStarts(const LowSurface& low, const HighSurface& high, const BakeOptions& options,
                                const LowRest& rest)
{
    RayStarts starts;
    const VertexGroups groups = groupsOf(low);
    if (options.rays == BakeRays::straight)
        starts.directions = low.normals;
    else
        findDirections(low, groups, starts);
    starts.mask = options.raysMask;
    starts.masked = starts.mask || options.rays == BakeRays::vertexColor;
    HardEdges edges;
    if (options.rays == BakeRays::automatic && !starts.masked && starts.directionsDiffer)
        edges = hardEdgesOf(low, groups.of);
    COTAN_TRY(body, bodyOf(low, rest, options));
    starts.skip = kSkip * body->diagonal;
    starts.limit = options.maxDistance > 0 ? options.maxDistance : kLimit * body->diagonal;
    (options.extrusion > 0 ? starts.passed : starts.tree) = body->tree;
    const Status measured = withThreads(options.threads, [&]() -> Status {
        COTAN_TRY(found, measureStandOff(low, high, options, *body, groups, starts, edges));
        starts.distances = std::move(found->distances);
        if (edges.count > 0)
            starts.bands = makeBands(low, edges, starts.directions, found->needs);
        // With more points left out it is so crowded that the bake tests the rays of all triangles.
        starts.obstructed.assign(low.triangleCount(), starts.tree && found->every > 1 ? 1 : 0);
        if (starts.tree && found->every == 1)
            parallelFor(std::size_t(0), low.triangleCount(), [&](std::size_t f) {
                starts.obstructed[f] = isObstructed(low, starts, f, body->diagonal) ? 1 : 0;
            });
        return Done{};
    });
    if (!measured)
        return measured.error();
    starts.farthest = *std::max_element(starts.distances.begin(), starts.distances.end());
    return starts;
}

} // namespace cotan
