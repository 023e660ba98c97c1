#include "bake/high_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/format.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "bake/surface/surface_triangle.hpp"
#include "core/try.hpp"
#include "cotan/covector.hpp"
#include "curved_normals.hpp"
#include "packets.hpp"
#include "scene/geometry.hpp"
#include "scene/parts.hpp"

namespace cotan {

struct Part { // an instance in world space
    std::vector<glm::vec3> positions, normals;
    std::vector<std::uint32_t> indices;
    std::vector<std::uint8_t> repeated; // per triangle: not 0 if it coincides with an earlier one; empty: none does
    std::vector<std::uint32_t> embreeIndices; // for Embree, if some triangles are left out
    std::vector<ShapeOperator> shapes;        // per vertex; empty: not prepared
    Bounds box;
    float longestEdge = 0; // of all triangles
};

namespace {

// 1, or -1 if most triangles are wound against their normals. Files use either winding; the normals mark the outside.
float frontSign(const Part& part)
{
    double agreement = 0;
    for (std::size_t i = 0; i + 2 < part.indices.size(); i += 3) {
        const std::uint32_t* c = &part.indices[i];
        const glm::vec3 p = part.positions[c[0]];
        const glm::vec3 area = glm::cross(part.positions[c[1]] - p, part.positions[c[2]] - p);
        agreement += double(glm::dot(area, part.normals[c[0]] + part.normals[c[1]] + part.normals[c[2]]));
    }
    return agreement < 0 ? -1.0f : 1.0f;
}

Part inWorld(const Mesh& mesh, const glm::mat4& toWorld)
{
    Part part;
    const glm::mat3 linear(toWorld);
    const LinearMap<float> map(linear);
    const glm::mat3 covectors = map.planeMatrix();
    for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
        part.positions.push_back(glm::vec3(toWorld * glm::vec4(mesh.positions[v], 1)));
        const glm::vec3 n = covectors * mesh.normals[v];
        const float length = glm::length(n);
        part.normals.push_back(length > 0 ? n / length : n);
    }
    part.indices = mesh.indices;
    if (map.determinant() < 0)
        for (std::size_t i = 0; i + 2 < part.indices.size(); i += 3)
            std::swap(part.indices[i + 1], part.indices[i + 2]);
    return part;
}

// Finds triangles that coincide with earlier ones, of any instance.
void findRepeated(std::vector<Part>& parts)
{
    std::vector<std::size_t> first; // number of the first triangle of each part
    std::size_t count = 0;
    for (const Part& part : parts) {
        first.push_back(count);
        count += part.indices.size() / 3;
    }
    const std::vector<std::uint8_t> repeated = repeatedTriangles(count, [&](std::size_t i) {
        const auto n = std::size_t(std::upper_bound(first.begin(), first.end(), i) - first.begin()) - 1;
        return cornersOfTriangle(parts[n].positions, parts[n].indices, i - first[n]);
    });
    for (std::size_t n = 0; n < parts.size() && !repeated.empty(); ++n) {
        const auto from = repeated.begin() + std::ptrdiff_t(first[n]);
        parts[n].repeated.assign(from, from + std::ptrdiff_t(parts[n].indices.size() / 3));
    }
}

} // namespace

struct HighSurface::State {
    std::vector<Part> parts;
    std::vector<float> fronts; // of the parts: -1 if most triangles are wound against their vertex normals
    std::size_t triangles = 0;
    Bounds box;
    EmbreeScene embree; // shares the arrays of the parts

    // Interpolates the normals of hits; the results have any length. Prefetches the corners of all hits before the
    // first is used, so that the memory latencies overlap.
    void interpolateNormals(std::size_t count, Hits& hits) const
    {
        Lanes<const std::uint32_t*> corners;
        Lanes<const glm::vec3*> normals;
        for (std::size_t i = 0; i < count; ++i) {
            const Part& part = parts[hits.found(i) ? hits.instance[i] : 0];
            corners[i] = &part.indices[hits.found(i) ? 3 * std::size_t(hits.triangle[i]) : 0];
            normals[i] = part.normals.data();
            __builtin_prefetch(corners[i]);
        }
        for (std::size_t i = 0; i < count; ++i)
            hits.normal.set(i, atVertices(normals[i], corners[i], hits.b1[i], hits.b2[i]));
    }
    // Returns zero if there is none.
    glm::vec3 curvedNormal(std::uint32_t instance, std::uint32_t triangle, float b1, float b2,
                           glm::vec3 direction) const
    {
        const Part& part = parts[instance];
        if (part.shapes.empty())
            return glm::vec3(0);
        const std::uint32_t* const v = &part.indices[3 * std::size_t(triangle)];
        const auto ofCorners = [v](const auto& values) { return std::array{values[v[0]], values[v[1]], values[v[2]]}; };
        return cotan::curvedNormal({ofCorners(part.positions), ofCorners(part.normals), ofCorners(part.shapes)}, b1, b2,
                                   direction);
    }
    // Sets the normals of hits whose other fields are set.
    void findNormals(const Probes& probes, HighNormals normals, Hits& hits) const
    {
        if (normals != HighNormals::face)
            interpolateNormals(probes.count, hits);
        // Minimum length of an interpolated normal that counts.
        const float least = normals == HighNormals::face ? std::numeric_limits<float>::infinity() : 1e-6f;
        // All lanes, so that the loop vectorises; the results of lanes without a hit are never read.
        runLanes([&] {
            for (std::size_t i = 0; i < kLanes; ++i) {
                const glm::vec3 n = hits.normal.at(i), face = glm::normalize(hits.face.at(i));
                const float length = glm::length(n);
                hits.normal.set(i, length > least ? n / length : face);
            }
        });
        if (normals == HighNormals::curved)
            for (std::size_t i = 0; i < probes.count; ++i)
                if (hits.found(i)) {
                    const glm::vec3 n = curvedNormal(hits.instance[i], hits.triangle[i], hits.b1[i], hits.b2[i],
                                                     probes.direction.at(i));
                    if (glm::dot(n, n) > 0)
                        hits.normal.set(i, n);
                }
    }
};

std::optional<Error> HighSurface::unavailable() { return std::nullopt; }

Result<HighSurface> HighSurface::make(const std::vector<Scene>& scenes, int threads, bool byInstance)
{
    auto state = std::make_shared<State>();
    for (const Scene& scene : scenes)
        for (const Instance& instance : scene.instances) {
            const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
            if (mesh.indices.empty())
                continue;
            state->parts.push_back(inWorld(mesh, instance.toWorld));
            state->fronts.push_back(frontSign(state->parts.back()));
            state->triangles += mesh.triangleCount();
            Part& part = state->parts.back();
            for (const glm::vec3& p : part.positions)
                part.box = {glm::min(part.box.low, p), glm::max(part.box.high, p)};
            for (std::size_t i = 0; i + 2 < part.indices.size(); i += 3)
                part.longestEdge = std::max(part.longestEdge, longestEdge(part.positions, &part.indices[i]));
            state->box = {glm::min(state->box.low, part.box.low), glm::max(state->box.high, part.box.high)};
        }
    if (state->triangles == 0)
        return inputError(fmt::format("{}: expected triangles; found none", scenes.empty() ? "" : scenes[0].name));
    // Robust: rays along an edge hit one of its two triangles. Filters: packets.hpp.
    COTAN_CHECK(state->embree.open(threads, RTC_SCENE_FLAG_ROBUST | kFiltersInQueries));
    if (!byInstance) // otherwise every instance needs its triangles
        findRepeated(state->parts);
    for (Part& part : state->parts)
        state->embree.add(part.positions, part.indices, part.repeated, part.embreeIndices);
    COTAN_CHECK(state->embree.commit(state->triangles));
    std::vector<std::uint32_t> groups(state->parts.size());
    std::iota(groups.begin(), groups.end(), 0);
    return HighSurface(std::move(state), std::move(groups));
}

void HighSurface::setGroups(std::vector<std::uint32_t> groups) { groups_ = std::move(groups); }
std::uint32_t HighSurface::groupOf(std::size_t instance) const { return groups_[instance]; }

void HighSurface::curve(int threads)
{
    for (Part& part : state_->parts) // positions have an extra element for Embree
        part.shapes = shapeOperators({part.positions.data(), part.normals.size()}, part.normals, part.indices, threads);
}

bool HighSurface::isCurved() const { return !state_->parts.front().shapes.empty(); }

float HighSurface::curvatureAt(const Hits& hits, std::size_t lane) const
{
    const Part& part = state_->parts[hits.instance[lane]];
    const std::uint32_t* const v = &part.indices[3 * std::size_t(hits.triangle[lane])];
    const auto mean = [&](std::uint32_t vertex) {
        const ShapeOperator& w = part.shapes[vertex];
        return (w[0] + w[3] + w[5]) / 2;
    };
    const float b1 = hits.b1[lane], b2 = hits.b2[lane];
    return (1 - b1 - b2) * mean(v[0]) + b1 * mean(v[1]) + b2 * mean(v[2]);
}

HighSurface::Triangles HighSurface::triangles(std::size_t instance) const
{
    const Part& part = state_->parts[instance];
    return {{part.positions.data(), part.normals.size()},
            part.normals,
            part.indices,
            part.repeated,
            part.box,
            part.longestEdge};
}

std::size_t HighSurface::instanceCount() const { return state_->parts.size(); }
std::size_t HighSurface::triangleCount() const { return state_->triangles; }
const Bounds& HighSurface::box() const { return state_->box; }

// ---- rays -----------------------------------------------------------------------------------

glm::vec3 HighSurface::normalOf(const Hit& hit, HighNormals normals, glm::vec3 direction) const
{
    Probes probe;
    probe.count = 1;
    probe.direction.set(0, direction);
    Hits hits;
    hits.instance[0] = hit.instance;
    hits.triangle[0] = hit.triangle;
    hits.b1[0] = hit.b1;
    hits.b2[0] = hit.b2;
    hits.face.set(0, hit.faceNormal);
    state_->findNormals(probe, normals, hits);
    return hits.normal.at(0);
}

Hit HighSurface::trace(const Ray& ray) const
{
    RayQuery query(Coherence::incoherent);
    RTCRayHit r = toEmbree(ray);
    intersect(state_->embree.scene, query, r);
    if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return {};
    const glm::vec3 face = glm::normalize(glm::vec3(r.hit.Ng_x, r.hit.Ng_y, r.hit.Ng_z));
    return {true, r.ray.tfar, face, face * state_->fronts[r.hit.geomID], r.hit.geomID, r.hit.primID, r.hit.u, r.hit.v};
}

void HighSurface::nearest(const Probes& probes, float lift, HighNormals normals, Hits& hits) const
{
    const FilterContext context = filterContextFor(probes, state_->fronts, groups_);
    Lanes<float> lifts, farthest;
    for (std::size_t i = 0; i < kLanes; ++i) {
        lifts[i] = lift;
        farthest[i] = probes.reach[i] > 0 ? probes.reach[i] + lift : 0;
    }
    Packet outwards(probes, lifts, 1, farthest);
    outwards.trace(state_->embree.scene, context);
    for (std::size_t i = 0; i < kLanes; ++i) { // search no further than the hit so far
        const float found = std::abs(outwards.rays.ray.tfar[i] - lift) + lift;
        farthest[i] = outwards.found(i) ? found : farthest[i];
    }
    Packet inwards(probes, lifts, -1, farthest);
    inwards.trace(state_->embree.scene, context);
    for (std::size_t i = 0; i < probes.count; ++i)
        if (inwards.valid[i] && !inwards.found(i) && !outwards.found(i)) {
            outwards.traceAlone(i, state_->embree.scene, context);
            inwards.traceAlone(i, state_->embree.scene, context);
        }
    Lanes<std::uint32_t> behind;
    for (std::size_t i = 0; i < kLanes; ++i) {
        const float out = outwards.rays.ray.tfar[i] - lift, in = inwards.rays.ray.tfar[i] - lift;
        const bool nearer = inwards.found(i) && (!outwards.found(i) || std::abs(in) < std::abs(out));
        behind[i] = nearer ? ~0u : 0u;
        hits.distance[i] = nearer ? -in : out;
    }
    pick(behind, outwards.rays.hit, inwards.rays.hit, hits);
    state_->findNormals(probes, normals, hits);
}

static Lanes<float> lengthsOf(const Probes& probes)
{
    Lanes<float> lengths;
    for (std::size_t i = 0; i < kLanes; ++i)
        lengths[i] = probes.before[i] + probes.reach[i];
    return lengths;
}

void HighSurface::outermost(const Probes& probes, HighNormals normals, Hits& hits) const
{
    const FilterContext context = filterContextFor(probes, state_->fronts, groups_);
    Packet packet(probes, probes.before, -1, lengthsOf(probes));
    packet.trace(state_->embree.scene, context);
    for (std::size_t i = 0; i < probes.count; ++i) // a packet may lose a hit because of its other rays
        if (packet.valid[i] && !packet.found(i))
            packet.traceAlone(i, state_->embree.scene, context);
    for (std::size_t i = 0; i < probes.count; ++i) {
        const glm::vec3 normal = probes.normal.at(i);
        hits.away[i] = packet.foundAway(i, state_->fronts, normal) ? 1 : 0;
        if (!hits.away[i])
            continue;
        // Surfaces that face the low surface are preferred.
        const FilterContext facing{RayQuery(Coherence::coherent, keepFacing), state_->fronts.data(), groups_.data(),
                                   normal};
        packet.traceAlone(i, state_->embree.scene, facing);
        hits.away[i] = packet.foundAway(i, state_->fronts, normal) ? 1 : 0;
    }
    for (std::size_t i = 0; i < kLanes; ++i)
        hits.distance[i] = probes.before[i] - packet.rays.ray.tfar[i];
    pick({}, packet.rays.hit, packet.rays.hit, hits);
    state_->findNormals(probes, normals, hits);
}

void HighSurface::anyBetween(const Probes& probes, Lanes<int>& any, bool spread) const
{
    Packet packet(probes, probes.before, -1, lengthsOf(probes));
    FilterContext context =
        filterContextFor(probes, state_->fronts, groups_, spread ? Coherence::incoherent : Coherence::coherent);
    occluded(packet.valid.data(), state_->embree.scene, context.query, packet.rays.ray);
    for (std::size_t i = 0; i < kLanes; ++i)
        any[i] = packet.valid[i] != 0 && packet.rays.ray.tfar[i] < 0; // Embree's mark for an occluded ray
}

void HighSurface::distances(const Probes& probes, Lanes<float>& found) const
{
    Packet packet(probes, probes.before, -1, lengthsOf(probes));
    packet.trace(state_->embree.scene, filterContextFor(probes, state_->fronts, groups_, Coherence::incoherent));
    for (std::size_t i = 0; i < kLanes; ++i)
        found[i] = packet.found(i) ? packet.rays.ray.tfar[i] : std::numeric_limits<float>::infinity();
}

std::size_t HighSurface::countHits(const Ray& ray) const
{
    struct Counting {
        RayQuery query; // must be first: Embree passes its address to filters
        std::size_t count = 0;
    } counting{RayQuery(Coherence::incoherent,
                        [](const RTCFilterFunctionNArguments* a) {
                            for (unsigned i = 0; i < a->N; ++i)
                                if (a->valid[i]) {
                                    ++reinterpret_cast<Counting*>(a->context)->count;
                                    a->valid[i] = 0; // rejects the hit, so that the ray goes on
                                }
                        }),
               0};
    RTCRay r = toEmbree(ray).ray;
    occluded(state_->embree.scene, counting.query, r);
    return counting.count;
}

bool HighSurface::blocked(const Ray& ray) const
{
    RayQuery query(Coherence::incoherent);
    RTCRay r = toEmbree(ray).ray;
    occluded(state_->embree.scene, query, r);
    return r.tfar < 0;
}

} // namespace cotan
