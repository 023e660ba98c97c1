#include "bake/low_tree.hpp"

#include <cmath>

#include <glm/geometric.hpp>

#include "core/try.hpp"
#include "packets.hpp"
#include "scene/parts.hpp"

namespace cotan {

struct LowTree::State {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices, embreeIndices; // embreeIndices: if some triangles are left out
    std::vector<glm::vec3> faces;
    std::vector<std::int64_t> highGroups;
    EmbreeScene embree; // shares these arrays
};

namespace {

struct Coordinates {
    float b1, b2;
};

// Barycentric coordinates of the point of a triangle nearest to p, by Voronoi regions (C. Ericson, Real-Time Collision
// Detection, 2005, 5.1.5).
Coordinates nearestOn(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 p)
{
    const glm::vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
    const float d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
    if (d1 <= 0 && d2 <= 0)
        return {0, 0};
    const float d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
    if (d3 >= 0 && d4 <= d3)
        return {1, 0};
    const float vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0)
        return {d1 > d3 ? d1 / (d1 - d3) : 0, 0};
    const float d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
    if (d6 >= 0 && d5 <= d6)
        return {0, 1};
    const float vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0)
        return {0, d2 > d6 ? d2 / (d2 - d6) : 0};
    const float va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
        const float across = (d4 - d3) + (d5 - d6), w = across > 0 ? (d4 - d3) / across : 0;
        return {1 - w, w};
    }
    const float sum = va + vb + vc;
    return sum > 0 ? Coordinates{vb / sum, vc / sum} : Coordinates{0, 0};
}

} // namespace

Result<LowTree> LowTree::make(std::vector<glm::vec3> positions, std::vector<std::uint32_t> indices,
                              std::vector<std::int64_t> highGroups, int threads)
{
    auto state = std::make_shared<State>();
    state->highGroups = std::move(highGroups);
    state->positions = std::move(positions);
    state->indices = std::move(indices);
    for (std::size_t i = 0; i + 2 < state->indices.size(); i += 3) {
        const glm::vec3 p = state->positions[state->indices[i]];
        const glm::vec3 area =
            glm::cross(state->positions[state->indices[i + 1]] - p, state->positions[state->indices[i + 2]] - p);
        const float length = glm::length(area);
        state->faces.push_back(length > 0 ? area / length : glm::vec3(0));
    }
    // Of equally near triangles the first counts, so triangles on earlier ones that show the same can be left out.
    const std::vector<std::uint8_t> repeated = repeatedTriangles(state->faces.size(), [&](std::size_t f) {
        return cornersOfTriangle(state->positions, state->indices, f,
                                 state->highGroups.empty() ? 0 : state->highGroups[f]);
    });
    COTAN_CHECK(state->embree.open(threads, RTC_SCENE_FLAG_ROBUST));
    state->embree.add(state->positions, state->indices, repeated, state->embreeIndices);
    COTAN_CHECK(state->embree.commit(state->faces.size()));
    return LowTree(std::move(state));
}

LowTree::Nearest LowTree::nearest(glm::vec3 to, float radius,
                                  const std::function<bool(std::uint32_t triangle)>& accepts) const
{
    struct NearestQuery {
        const State& state;
        const std::function<bool(std::uint32_t)>& accepts;
        glm::vec3 to;
        Nearest best;
    } nearestQuery{*state_, accepts, to, {}};
    nearestQuery.best.distance = radius;
    RTCPointQuery query{};
    query.x = to.x;
    query.y = to.y;
    query.z = to.z;
    query.radius = radius;
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(
        state_->embree.scene, &query, &context,
        [](RTCPointQueryFunctionArguments* a) {
            NearestQuery& q = *static_cast<NearestQuery*>(a->userPtr);
            ++q.best.visited;
            if (!q.accepts(a->primID))
                return false;
            const std::uint32_t* const c = &q.state.indices[3 * std::size_t(a->primID)];
            const std::vector<glm::vec3>& p = q.state.positions;
            const glm::vec3 p0 = p[c[0]], p1 = p[c[1]], p2 = p[c[2]];
            const Coordinates on = nearestOn(p0, p1, p2, q.to);
            const glm::vec3 point = p0 * (1 - on.b1 - on.b2) + p1 * on.b1 + p2 * on.b2;
            const float distance = glm::length(point - q.to);
            Nearest& best = q.best;
            if (distance > best.distance || (best.found && distance == best.distance && a->primID > best.triangle))
                return false;
            best = {{true, a->primID, on.b1, on.b2, distance}, point, best.visited};
            // A little larger than the distance, so that all equally near triangles are visited.
            a->query->radius = distance * 1.00001f;
            return true;
        },
        &nearestQuery);
    return nearestQuery.best;
}

LowTree::TreeHit LowTree::first(const Ray& ray) const
{
    RayQuery query(Coherence::incoherent);
    RTCRayHit r = toEmbree(ray);
    intersect(state_->embree.scene, query, r);
    if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return {};
    return {true, r.hit.primID, r.hit.u, r.hit.v, r.ray.tfar};
}

LowTree::TreeHit LowTree::firstBeside(std::uint32_t triangle, Ray ray) const
{
    const std::vector<std::int64_t>& highGroups = state_->highGroups;
    TreeHit hit = first(ray);
    while (hit.found && hit.distance < ray.farthest && !highGroups.empty() && highGroups[triangle] >= 0
           && highGroups[hit.triangle] >= 0 && highGroups[triangle] != highGroups[hit.triangle]) {
        ray.nearest = std::nextafter(hit.distance, ray.farthest);
        hit = first(ray);
    }
    return hit;
}

glm::vec3 LowTree::face(std::uint32_t triangle) const { return state_->faces[triangle]; }

} // namespace cotan
