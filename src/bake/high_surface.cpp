#include "cotan/bake/high_surface.hpp"

#include <algorithm>
#include <cmath>

#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

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
    const float side = glm::determinant(linear) < 0 ? -1.0f : 1.0f;
    const glm::mat3 cofactors = glm::mat3(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                                          glm::cross(linear[0], linear[1])) * side;
    for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
        part.positions.push_back(glm::vec3(toWorld * glm::vec4(mesh.positions[v], 1)));
        const glm::vec3 n = cofactors * mesh.normals[v];
        const float length = glm::length(n);
        part.normals.push_back(length > 0 ? n / length : n);
    }
    part.indices = mesh.indices;
    if (side < 0)
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
constexpr std::uint32_t kAny = ~0u;

void keepOnly(const RTCFilterFunctionNArguments* a)
{
    for (unsigned i = 0; i < a->N; ++i) {
        const std::uint32_t only = RTCRayN_id(a->ray, a->N, i);
        if (a->valid[i] && only != kAny && RTCHitN_geomID(a->hit, a->N, i) != only)
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

struct Packet {
    alignas(64) int valid[HighSurface::kPacket];
    RTCRayHit16 rays;

    // The ray from `offset` before the probe's point along direction * way.
    void set(std::size_t i, const Probe& probe, float offset, float way, float farthest)
    {
        const glm::vec3 direction = probe.direction * way, origin = probe.point - direction * offset;
        RTCRay16& r = rays.ray;
        r.org_x[i] = origin.x;
        r.org_y[i] = origin.y;
        r.org_z[i] = origin.z;
        r.dir_x[i] = direction.x;
        r.dir_y[i] = direction.y;
        r.dir_z[i] = direction.z;
        r.tnear[i] = 0;
        r.tfar[i] = farthest;
        r.time[i] = 0;
        r.mask[i] = ~0u;
        r.id[i] = probe.only < 0 ? kAny : std::uint32_t(probe.only);
        r.flags[i] = 0;
        rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
        rays.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
        valid[i] = glm::dot(direction, direction) > 0 && farthest > 0 ? -1 : 0;
    }
    void fill(std::size_t from)
    {
        for (std::size_t i = from; i < HighSurface::kPacket; ++i)
            set(i, {}, 0, 1, 0);
    }
    bool found(std::size_t i) const { return valid[i] && rays.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID; }
};

bool anyOnly(std::span<const Probe> probes)
{
    return std::any_of(probes.begin(), probes.end(), [](const Probe& p) { return p.only >= 0; });
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

    Hit hit(std::uint32_t instance, std::uint32_t triangle, float b1, float b2, glm::vec3 face, float distance) const
    {
        const Part& part = parts[instance];
        const std::uint32_t* v = &part.indices[3 * std::size_t(triangle)];
        Hit h;
        h.found = true;
        h.distance = distance;
        h.instance = instance;
        h.triangle = triangle;
        h.b1 = b1;
        h.b2 = b2;
        h.faceNormal = glm::normalize(face);
        const glm::vec3 n = part.normals[v[0]] * (1 - b1 - b2) + part.normals[v[1]] * b1 + part.normals[v[2]] * b2;
        const float length = glm::length(n);
        h.normal = length > 1e-6f ? n / length : h.faceNormal;
        return h;
    }
    Hit hit(const RTCRayHit16& r, std::size_t i, float distance) const
    {
        return hit(r.hit.geomID[i], r.hit.primID[i], r.hit.u[i], r.hit.v[i],
                   {r.hit.Ng_x[i], r.hit.Ng_y[i], r.hit.Ng_z[i]}, distance);
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
    // Robust: rays along edges find one of the two triangles. The filter is that of a match by name, where there is one.
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

glm::vec3 HighSurface::curvedNormal(const Hit& hit, glm::vec3 direction) const
{
    const Part& part = state_->parts[hit.instance];
    if (part.shapes.empty())
        return hit.normal;
    CurvedTriangle triangle;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t v = part.indices[3 * std::size_t(hit.triangle) + i];
        triangle.positions[i] = part.positions[v];
        triangle.normals[i] = part.normals[v];
        triangle.shapes[i] = part.shapes[v];
    }
    const glm::vec3 n = cotan::curvedNormal(triangle, hit.b1, hit.b2, direction);
    return glm::dot(n, n) > 0 ? n : hit.normal;
}

Hit HighSurface::trace(const Ray& ray) const
{
    RTCIntersectContext context = contextFor(false);
    RTCRayHit r = toEmbree(ray);
    rtcIntersect1(state_->scene, &context, &r);
    if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return {};
    return state_->hit(r.hit.geomID, r.hit.primID, r.hit.u, r.hit.v, {r.hit.Ng_x, r.hit.Ng_y, r.hit.Ng_z}, r.ray.tfar);
}

void HighSurface::nearest(std::span<const Probe> probes, float lift, std::span<Hit> hits) const
{
    RTCIntersectContext context = contextFor(anyOnly(probes));
    Packet outwards, inwards;
    for (std::size_t i = 0; i < probes.size(); ++i)
        outwards.set(i, probes[i], lift, 1, probes[i].reach > 0 ? probes[i].reach + lift : 0);
    outwards.fill(probes.size());
    rtcIntersect16(outwards.valid, state_->scene, &context, &outwards.rays);
    for (std::size_t i = 0; i < probes.size(); ++i) {
        // Nothing further away than what is found already.
        const float left = outwards.found(i) ? std::abs(outwards.rays.ray.tfar[i] - lift) : probes[i].reach;
        inwards.set(i, probes[i], lift, -1, probes[i].reach > 0 ? left + lift : 0);
    }
    inwards.fill(probes.size());
    rtcIntersect16(inwards.valid, state_->scene, &context, &inwards.rays);
    for (std::size_t i = 0; i < probes.size(); ++i) {
        const float out = outwards.rays.ray.tfar[i] - lift, in = inwards.rays.ray.tfar[i] - lift;
        if (inwards.found(i) && (!outwards.found(i) || std::abs(in) < std::abs(out)))
            hits[i] = state_->hit(inwards.rays, i, -in);
        else
            hits[i] = outwards.found(i) ? state_->hit(outwards.rays, i, out) : Hit{};
    }
}

void HighSurface::outermost(std::span<const Probe> probes, std::span<Hit> hits) const
{
    RTCIntersectContext context = contextFor(anyOnly(probes));
    Packet packet;
    for (std::size_t i = 0; i < probes.size(); ++i)
        packet.set(i, probes[i], probes[i].reach, -1, 2 * probes[i].reach);
    packet.fill(probes.size());
    rtcIntersect16(packet.valid, state_->scene, &context, &packet.rays);
    for (std::size_t i = 0; i < probes.size(); ++i)
        hits[i] = packet.found(i) ? state_->hit(packet.rays, i, probes[i].reach - packet.rays.ray.tfar[i]) : Hit{};
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
