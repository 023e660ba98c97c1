#include "bake/low_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include <fmt/format.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "packets.hpp"
#include "scene/parts.hpp"

namespace cotan {

struct LowTree::State {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    std::vector<glm::vec3> positions; // and two more: one not finite, one as Embree reads 16 bytes at every vertex
    std::vector<std::uint32_t> indices;
    std::vector<std::uint32_t> seen; // indices as Embree has them, where some triangles are left out
    std::vector<glm::vec3> faces;
    std::vector<std::int64_t> shown;

    ~State()
    {
        if (scene)
            rtcReleaseScene(scene);
        if (device)
            rtcReleaseDevice(device);
    }
};

namespace {

struct Coordinates {
    float b1, b2;
};

// Of the point of a triangle nearest to p: by the regions of its plane (C. Ericson, Real-Time Collision Detection,
// 2005, 5.1.5).
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

// The indices with corners that are not finite, which Embree leaves out, for triangles that lie on earlier ones that
// show the same: of equally near ones the first counts. Empty where few do.
std::vector<std::uint32_t> indicesSeen(const std::vector<glm::vec3>& positions,
                                       const std::vector<std::uint32_t>& indices, std::span<const std::int64_t> shown,
                                       std::uint32_t notFinite)
{
    const std::vector<std::uint8_t> repeated = repeatedTriangles(indices.size() / 3, [&](std::size_t f) {
        const std::uint32_t* const c = &indices[3 * f];
        return CornersOfTriangle{{positions[c[0]], positions[c[1]], positions[c[2]]}, shown.empty() ? 0 : shown[f]};
    });
    if (repeated.empty())
        return {};
    std::vector<std::uint32_t> seen = indices;
    for (std::size_t f = 0; f < repeated.size(); ++f)
        if (repeated[f])
            std::fill_n(seen.begin() + std::ptrdiff_t(3 * f), 3, notFinite);
    return seen;
}

} // namespace

Result<LowTree> LowTree::make(std::vector<glm::vec3> positions, std::vector<std::uint32_t> indices,
                              std::vector<std::int64_t> shown, int threads)
{
    auto state = std::make_unique<State>();
    state->shown = std::move(shown);
    state->positions = std::move(positions);
    state->indices = std::move(indices);
    for (std::size_t i = 0; i + 2 < state->indices.size(); i += 3) {
        const glm::vec3 p = state->positions[state->indices[i]];
        const glm::vec3 area =
            glm::cross(state->positions[state->indices[i + 1]] - p, state->positions[state->indices[i + 2]] - p);
        const float length = glm::length(area);
        state->faces.push_back(length > 0 ? area / length : glm::vec3(0));
    }
    state->seen = indicesSeen(state->positions, state->indices, state->shown, std::uint32_t(state->positions.size()));
    state->positions.emplace_back(std::numeric_limits<float>::quiet_NaN());
    state->positions.emplace_back(0.0f);
    const std::vector<std::uint32_t>& seen = state->seen.empty() ? state->indices : state->seen;
    state->device = rtcNewDevice(threads > 0 ? fmt::format("threads={}", threads).c_str() : nullptr);
    if (!state->device)
        return unavailableError("Embree: no device");
    state->scene = rtcNewScene(state->device);
    rtcSetSceneFlags(state->scene, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = rtcNewGeometry(state->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, state->positions.data(), 0,
                               sizeof(glm::vec3), state->positions.size() - 1);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, seen.data(), 0,
                               3 * sizeof(std::uint32_t), seen.size() / 3);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(state->scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(state->scene);
    if (rtcGetDeviceError(state->device) != RTC_ERROR_NONE)
        return unavailableError(fmt::format("Embree: cannot hold {} triangles", state->indices.size() / 3));
    return LowTree(std::move(state));
}

LowTree::LowTree(std::unique_ptr<State> state) : state_(std::move(state)) {}
LowTree::LowTree(LowTree&&) noexcept = default;
LowTree& LowTree::operator=(LowTree&&) noexcept = default;
LowTree::~LowTree() = default;

LowTree::Nearest LowTree::nearestOf(glm::vec3 to, float radius, const void* accepts,
                                    bool (*call)(const void*, std::uint32_t)) const
{
    struct Question {
        const LowTree& tree;
        const void* accepts;
        bool (*call)(const void*, std::uint32_t);
        glm::vec3 to;
        Nearest best;
    } question{*this, accepts, call, to, {}};
    question.best.distance = radius;
    RTCPointQuery query{};
    query.x = to.x;
    query.y = to.y;
    query.z = to.z;
    query.radius = radius;
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(
        state_->scene, &query, &context,
        [](RTCPointQueryFunctionArguments* a) {
            Question& q = *static_cast<Question*>(a->userPtr);
            ++q.best.asked;
            if (!q.call(q.accepts, a->primID))
                return false;
            const State& state = *q.tree.state_;
            const std::uint32_t* const c = &state.indices[3 * std::size_t(a->primID)];
            const glm::vec3 p0 = state.positions[c[0]], p1 = state.positions[c[1]], p2 = state.positions[c[2]];
            const Coordinates on = nearestOn(p0, p1, p2, q.to);
            const glm::vec3 point = p0 * (1 - on.b1 - on.b2) + p1 * on.b1 + p2 * on.b2;
            const float distance = glm::length(point - q.to);
            Nearest& best = q.best;
            if (distance > best.distance || (best.found && distance == best.distance && a->primID > best.triangle))
                return false;
            best = {true, a->primID, on.b1, on.b2, point, distance, best.asked};
            // A little more than the distance, so that all that are equally near are asked about.
            a->query->radius = distance * 1.00001f;
            return true;
        },
        &question);
    return question.best;
}

LowTree::Met LowTree::first(const Ray& ray) const
{
    RayQuery query(Coherence::incoherent);
    RTCRayHit r = toEmbree(ray);
    intersect(state_->scene, query, r);
    if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return {};
    return {true, r.hit.primID, r.hit.u, r.hit.v, r.ray.tfar};
}

LowTree::Met LowTree::firstBeside(std::uint32_t triangle, Ray ray) const
{
    const std::vector<std::int64_t>& shown = state_->shown;
    Met met = first(ray);
    while (met.found && met.distance < ray.farthest && !shown.empty() && shown[triangle] >= 0
           && shown[met.triangle] >= 0 && shown[triangle] != shown[met.triangle]) {
        ray.nearest = std::nextafter(met.distance, ray.farthest);
        met = first(ray);
    }
    return met;
}

glm::vec3 LowTree::corner(std::uint32_t triangle, std::size_t i) const
{
    return state_->positions[state_->indices[3 * std::size_t(triangle) + i]];
}
glm::vec3 LowTree::face(std::uint32_t triangle) const { return state_->faces[triangle]; }
std::size_t LowTree::triangleCount() const { return state_->faces.size(); }

} // namespace cotan
