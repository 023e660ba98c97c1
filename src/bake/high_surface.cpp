#include "cotan/bake/high_surface.hpp"

#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace cotan {

namespace {

struct Part { // one instance, in world space
    std::vector<glm::vec3> positions, normals;
    std::vector<std::uint32_t> indices;
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

// The intersection context of rays that look for one instance only.
struct Context {
    RTCIntersectContext embree;
    std::int64_t only;
};

void keepOnly(const RTCFilterFunctionNArguments* a)
{
    const auto* context = reinterpret_cast<const Context*>(a->context);
    if (context->only >= 0 && RTCHitN_geomID(a->hit, a->N, 0) != std::uint32_t(context->only))
        a->valid[0] = 0;
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

    void attach(Part& part)
    {
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        // Embree reads 16 bytes at every vertex: one more at the end is needed.
        part.positions.emplace_back(0.0f);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, part.positions.data(), 0,
                                   sizeof(glm::vec3), part.positions.size() - 1);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, part.indices.data(), 0,
                                   3 * sizeof(std::uint32_t), part.indices.size() / 3);
        rtcSetGeometryIntersectFilterFunction(geometry, keepOnly);
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
    // Robust: rays along edges find one of the two triangles.
    rtcSetSceneFlags(state->scene, RTC_SCENE_FLAG_ROBUST);
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

Hit HighSurface::trace(const Ray& ray, std::int64_t only) const
{
    Context context;
    rtcInitIntersectContext(&context.embree);
    context.embree.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    context.only = only;
    RTCRayHit r = toEmbree(ray);
    rtcIntersect1(state_->scene, &context.embree, &r);
    Hit hit;
    if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return hit;
    const Part& part = state_->parts[r.hit.geomID];
    const std::uint32_t* v = &part.indices[3 * std::size_t(r.hit.primID)];
    hit.found = true;
    hit.distance = r.ray.tfar;
    hit.instance = r.hit.geomID;
    hit.triangle = r.hit.primID;
    hit.b1 = r.hit.u;
    hit.b2 = r.hit.v;
    hit.faceNormal = glm::normalize(glm::vec3(r.hit.Ng_x, r.hit.Ng_y, r.hit.Ng_z));
    const glm::vec3 n = part.normals[v[0]] * (1 - r.hit.u - r.hit.v) + part.normals[v[1]] * r.hit.u
        + part.normals[v[2]] * r.hit.v;
    const float length = glm::length(n);
    hit.normal = length > 1e-6f ? n / length : hit.faceNormal;
    return hit;
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
