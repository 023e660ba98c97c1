#include "cotan/bake/high_surface.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "cotan/covector.hpp"
#include "curved_normals.hpp"

namespace cotan {

namespace {

struct Part { // one instance, in world space
    std::vector<glm::vec3> positions, normals;
    std::vector<std::uint32_t> indices;
    std::vector<ShapeOperator> shapes; // of the vertices; empty: not prepared
};

Part placed(const Mesh& mesh, const glm::mat4& toWorld)
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

RTCRayHit toEmbree(const Ray& ray)
{
    RTCRayHit r{};
    r.ray.org_x = ray.origin.x;
    r.ray.org_y = ray.origin.y;
    r.ray.org_z = ray.origin.z;
    r.ray.dir_x = ray.direction.x;
    r.ray.dir_y = ray.direction.y;
    r.ray.dir_z = ray.direction.z;
    r.ray.tnear = ray.nearest;
    r.ray.tfar = ray.farthest;
    r.ray.mask = ~0u;
    r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    return r;
}

// Rays carry the instance that they look for as their id.
void keepOnly(const RTCFilterFunctionNArguments* a)
{
    for (unsigned i = 0; i < a->N; ++i) {
        const std::uint32_t only = RTCRayN_id(a->ray, a->N, i);
        if (a->valid[i] && only != Probes::kAny && RTCHitN_geomID(a->hit, a->N, i) != only)
            a->valid[i] = 0;
    }
}

// A filter costs a call for each candidate; most scenes need none.
RTCIntersectContext contextFor(bool filtered)
{
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    context.filter = filtered ? keepOnly : nullptr;
    return context;
}

RTCIntersectContext contextFor(const Probes& probes)
{
    return contextFor(std::any_of(probes.only.begin(), probes.only.begin() + std::ptrdiff_t(probes.count),
                                  [](std::uint32_t only) { return only != Probes::kAny; }));
}

static_assert(Hits::kNothing == RTC_INVALID_GEOMETRY_ID && kLanes == 16);

struct Packet {
    Lanes<int> valid;
    RTCRayHit16 rays;

    // The rays from `offset` before each probe's point along direction * way.
    Packet(const Probes& probes, const Lanes<float>& offset, float way, const Lanes<float>& farthest)
    {
        RTCRay16& r = rays.ray;
        const int count = int(probes.count);
        for (int lane = 0; lane < int(kLanes); ++lane) {
            const auto i = std::size_t(lane);
            const glm::vec3 direction = probes.direction.at(i) * way,
                            origin = probes.point.at(i) - direction * offset[i];
            r.org_x[i] = origin.x;
            r.org_y[i] = origin.y;
            r.org_z[i] = origin.z;
            r.dir_x[i] = direction.x;
            r.dir_y[i] = direction.y;
            r.dir_z[i] = direction.z;
            r.tnear[i] = 0;
            r.tfar[i] = farthest[i];
            r.time[i] = 0;
            r.mask[i] = ~0u;
            r.id[i] = probes.only[i];
            r.flags[i] = 0;
            rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
            rays.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
            const bool looks = glm::dot(direction, direction) > 0 && farthest[i] > 0 && lane < count;
            valid[i] = looks ? -1 : 0;
        }
    }
    void trace(RTCScene scene, RTCIntersectContext& context) { rtcIntersect16(valid.data(), scene, &context, &rays); }
    bool found(std::size_t i) const { return rays.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID; } // never where not valid
};

// Of each lane `second` where all bits of the mask are set, `first` where none is. By bits, so that the compiler makes
// no branch of it.
template<class T> void pick(const Lanes<std::uint32_t>& masks, const T* first, const T* second, T* picked)
{
    for (std::size_t i = 0; i < kLanes; ++i) {
        const auto a = std::bit_cast<std::uint32_t>(first[i]), b = std::bit_cast<std::uint32_t>(second[i]);
        picked[i] = std::bit_cast<T>((a & ~masks[i]) | (b & masks[i]));
    }
}

void pick(const Lanes<std::uint32_t>& masks, const RTCHit16& first, const RTCHit16& second, Hits& hits)
{
    pick(masks, first.geomID, second.geomID, hits.instance.data());
    pick(masks, first.primID, second.primID, hits.triangle.data());
    pick(masks, first.u, second.u, hits.b1.data());
    pick(masks, first.v, second.v, hits.b2.data());
    pick(masks, first.Ng_x, second.Ng_x, hits.face.x);
    pick(masks, first.Ng_y, second.Ng_y, hits.face.y);
    pick(masks, first.Ng_z, second.Ng_z, hits.face.z);
}

} // namespace

struct HighSurface::State {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    std::vector<Part> parts;
    std::vector<std::string> names;
    std::size_t triangles = 0;
    glm::vec3 low{1e30f}, high{-1e30f};

    ~State()
    {
        if (scene)
            rtcReleaseScene(scene);
        if (device)
            rtcReleaseDevice(device);
    }

    // The interpolated normals of hits, of any length. Where the corners are is asked for all before the first is used,
    // so that the waits for memory overlap.
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
        for (std::size_t i = 0; i < count; ++i) {
            const float b1 = hits.b1[i], b2 = hits.b2[i];
            const std::uint32_t* c = corners[i];
            const glm::vec3* n = normals[i];
            hits.normal.set(i, n[c[0]] * (1 - b1 - b2) + n[c[1]] * b1 + n[c[2]] * b2);
        }
    }
    // Zero where there is none.
    glm::vec3 curvedNormal(std::uint32_t instance, std::uint32_t triangle, float b1, float b2,
                           glm::vec3 direction) const
    {
        const Part& part = parts[instance];
        if (part.shapes.empty())
            return glm::vec3(0);
        CurvedTriangle corners;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t v = part.indices[3 * std::size_t(triangle) + i];
            corners.positions[i] = part.positions[v];
            corners.normals[i] = part.normals[v];
            corners.shapes[i] = part.shapes[v];
        }
        return cotan::curvedNormal(corners, b1, b2, direction);
    }
    // The normals of hits that are complete otherwise.
    void findNormals(const Probes& probes, HighNormals normals, Hits& hits) const
    {
        if (normals != HighNormals::face)
            interpolateNormals(probes.count, hits);
        // Longer than this, the interpolated normal counts.
        const float least = normals == HighNormals::face ? std::numeric_limits<float>::infinity() : 1e-6f;
        // All lanes, so that they go side by side: nobody reads those where nothing was found.
        for (std::size_t i = 0; i < kLanes; ++i) {
            const glm::vec3 n = hits.normal.at(i), face = glm::normalize(hits.face.at(i));
            const float length = glm::length(n);
            hits.normal.set(i, length > least ? n / length : face);
        }
        if (normals == HighNormals::curved)
            for (std::size_t i = 0; i < probes.count; ++i)
                if (hits.found(i)) {
                    const glm::vec3 n = curvedNormal(hits.instance[i], hits.triangle[i], hits.b1[i], hits.b2[i],
                                                     probes.direction.at(i));
                    if (glm::dot(n, n) > 0)
                        hits.normal.set(i, n);
                }
    }

    void attach(Part& part)
    {
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        // Embree reads 16 bytes at every vertex: one more at the end is needed.
        part.positions.emplace_back(0.0f);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, part.positions.data(), 0,
                                   sizeof(glm::vec3), part.positions.size() - 1);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, part.indices.data(), 0,
                                   3 * sizeof(std::uint32_t), part.indices.size() / 3);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene, geometry); // ids count up from 0
        rtcReleaseGeometry(geometry);
    }
};

std::optional<Error> HighSurface::unavailable() { return std::nullopt; }

Result<HighSurface> HighSurface::make(const std::vector<Scene>& scenes, int threads)
{
    auto state = std::make_unique<State>();
    for (const Scene& scene : scenes)
        for (const Instance& instance : scene.instances) {
            const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
            if (mesh.indices.empty())
                continue;
            state->parts.push_back(placed(mesh, instance.toWorld));
            state->names.push_back(!instance.name.empty() ? instance.name : mesh.name);
            state->triangles += mesh.triangleCount();
            for (const glm::vec3& p : state->parts.back().positions) {
                state->low = glm::min(state->low, p);
                state->high = glm::max(state->high, p);
            }
        }
    if (state->triangles == 0)
        return inputError(fmt::format("{}: expected triangles; found none", scenes.empty() ? "" : scenes[0].name));
    state->device = rtcNewDevice(threads > 0 ? fmt::format("threads={}", threads).c_str() : nullptr);
    if (!state->device)
        return unavailableError("Embree: no device");
    state->scene = rtcNewScene(state->device);
    // Robust: rays along edges find one of the two triangles. The filter is that of a match by name, where there is
    // one.
    rtcSetSceneFlags(state->scene, RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
    for (Part& part : state->parts)
        state->attach(part);
    rtcCommitScene(state->scene);
    if (rtcGetDeviceError(state->device) != RTC_ERROR_NONE)
        return unavailableError(fmt::format("Embree: cannot hold {} triangles", state->triangles));
    return HighSurface(std::move(state));
}

HighSurface::HighSurface(std::unique_ptr<State> state) : state_(std::move(state)) {}
HighSurface::HighSurface(HighSurface&&) noexcept = default;
HighSurface& HighSurface::operator=(HighSurface&&) noexcept = default;
HighSurface::~HighSurface() = default;

void HighSurface::curve(int threads)
{
    for (Part& part : state_->parts) // behind the positions is one more, for Embree
        part.shapes = shapeOperators({part.positions.data(), part.normals.size()}, part.normals, part.indices, threads);
}

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
    RTCIntersectContext context = contextFor(false);
    RTCRayHit r = toEmbree(ray);
    rtcIntersect1(state_->scene, &context, &r);
    if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return {};
    return {true,         r.ray.tfar,   glm::normalize(glm::vec3(r.hit.Ng_x, r.hit.Ng_y, r.hit.Ng_z)),
            r.hit.geomID, r.hit.primID, r.hit.u,
            r.hit.v};
}

void HighSurface::nearest(const Probes& probes, float lift, HighNormals normals, Hits& hits) const
{
    RTCIntersectContext context = contextFor(probes);
    Lanes<float> lifts, farthest;
    for (std::size_t i = 0; i < kLanes; ++i) {
        lifts[i] = lift;
        farthest[i] = probes.reach[i] > 0 ? probes.reach[i] + lift : 0;
    }
    Packet outwards(probes, lifts, 1, farthest);
    outwards.trace(state_->scene, context);
    for (std::size_t i = 0; i < kLanes; ++i) { // nothing further away than what is found already
        const float found = std::abs(outwards.rays.ray.tfar[i] - lift) + lift;
        farthest[i] = outwards.found(i) ? found : farthest[i];
    }
    Packet inwards(probes, lifts, -1, farthest);
    inwards.trace(state_->scene, context);
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

void HighSurface::outermost(const Probes& probes, float length, HighNormals normals, Hits& hits) const
{
    RTCIntersectContext context = contextFor(probes);
    Lanes<float> farthest;
    for (std::size_t i = 0; i < kLanes; ++i)
        farthest[i] = length > 0 && probes.reach[i] > 0 ? length : 2 * probes.reach[i];
    Packet packet(probes, probes.reach, -1, farthest);
    packet.trace(state_->scene, context);
    for (std::size_t i = 0; i < kLanes; ++i)
        hits.distance[i] = probes.reach[i] - packet.rays.ray.tfar[i];
    pick({}, packet.rays.hit, packet.rays.hit, hits);
    state_->findNormals(probes, normals, hits);
}

bool HighSurface::blocked(const Ray& ray) const
{
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay r = toEmbree(ray).ray;
    rtcOccluded1(state_->scene, &context, &r);
    return r.tfar < 0; // Embree's mark for an occluded ray
}

const std::vector<std::string>& HighSurface::names() const { return state_->names; }
std::size_t HighSurface::triangleCount() const { return state_->triangles; }
glm::vec3 HighSurface::low() const { return state_->low; }
glm::vec3 HighSurface::high() const { return state_->high; }

} // namespace cotan
