// Triangles, rays and packets of sixteen rays as Embree takes them.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#if COTAN_EMBREE_MAJOR == 3
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "bake/high_surface.hpp"

namespace cotan {

// ---- differences between Embree 3 and 4 -------------------------------------------------------

enum class Coherence { incoherent, coherent };

#if COTAN_EMBREE_MAJOR == 3

// Lets queries pass filters to the scene.
inline constexpr RTCSceneFlags kFiltersInQueries = RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;

// Arguments of a trace: the coherence of its rays, and a filter or null. `context` must be first: filters get its
// address.
struct RayQuery {
    RTCIntersectContext context;

    explicit RayQuery(Coherence coherence, RTCFilterFunctionN filter = nullptr)
    {
        rtcInitIntersectContext(&context);
        context.flags = coherence == Coherence::coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                                                         : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
        context.filter = filter;
    }
};

inline void intersect(RTCScene scene, RayQuery& query, RTCRayHit& ray) { rtcIntersect1(scene, &query.context, &ray); }
inline void intersect(const int* valid, RTCScene scene, RayQuery& query, RTCRayHit16& rays)
{
    rtcIntersect16(valid, scene, &query.context, &rays);
}
// Rays that hit something get a negative tfar.
inline void occluded(RTCScene scene, RayQuery& query, RTCRay& ray) { rtcOccluded1(scene, &query.context, &ray); }
inline void occluded(const int* valid, RTCScene scene, RayQuery& query, RTCRay16& rays)
{
    rtcOccluded16(valid, scene, &query.context, &rays);
}

#else

inline constexpr RTCSceneFlags kFiltersInQueries = RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS;

struct RayQuery {
    RTCRayQueryContext context;
    RTCRayQueryFlags flags;
    RTCFilterFunctionN filter;

    explicit RayQuery(Coherence coherence, RTCFilterFunctionN filter_ = nullptr) : filter(filter_)
    {
        rtcInitRayQueryContext(&context);
        const int order =
            coherence == Coherence::coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
        flags = RTCRayQueryFlags(order | (filter ? RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER : 0));
    }
    // RTCIntersectArguments or RTCOccludedArguments; init sets the remaining fields.
    template<class Arguments> Arguments arguments(void (*init)(Arguments*))
    {
        Arguments a;
        init(&a);
        a.flags = flags;
        a.filter = filter;
        a.context = &context;
        return a;
    }
};

inline void intersect(RTCScene scene, RayQuery& query, RTCRayHit& ray)
{
    RTCIntersectArguments arguments = query.arguments(rtcInitIntersectArguments);
    rtcIntersect1(scene, &ray, &arguments);
}
inline void intersect(const int* valid, RTCScene scene, RayQuery& query, RTCRayHit16& rays)
{
    RTCIntersectArguments arguments = query.arguments(rtcInitIntersectArguments);
    rtcIntersect16(valid, scene, &rays, &arguments);
}
inline void occluded(RTCScene scene, RayQuery& query, RTCRay& ray)
{
    RTCOccludedArguments arguments = query.arguments(rtcInitOccludedArguments);
    rtcOccluded1(scene, &ray, &arguments);
}
inline void occluded(const int* valid, RTCScene scene, RayQuery& query, RTCRay16& rays)
{
    RTCOccludedArguments arguments = query.arguments(rtcInitOccludedArguments);
    rtcOccluded16(valid, scene, &rays, &arguments);
}

#endif

// ---- triangles and rays -----------------------------------------------------------------------

// An Embree scene on a device of its own. The arrays that are added must outlive it.
struct EmbreeScene {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;

    EmbreeScene() = default;
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;
    ~EmbreeScene()
    {
        if (scene)
            rtcReleaseScene(scene);
        if (device)
            rtcReleaseDevice(device);
    }

    // threads: 0 for all.
    Status open(int threads, RTCSceneFlags flags)
    {
        device = rtcNewDevice(threads > 0 ? fmt::format("threads={}", threads).c_str() : nullptr);
        if (!device)
            return unavailableError("Embree: no device");
        scene = rtcNewScene(device);
        rtcSetSceneFlags(scene, flags);
        return Done{};
    }

    // Adds triangles; geometry ids count up from 0. Repeated triangles (repeatedTriangles) get NaN corners, which
    // Embree ignores, so that the others keep their numbers; embreeIndices then has the indices. Appends such a corner
    // to the positions, and one more element, because Embree reads 16 bytes at every vertex.
    void add(std::vector<glm::vec3>& positions, const std::vector<std::uint32_t>& indices,
             const std::vector<std::uint8_t>& repeated, std::vector<std::uint32_t>& embreeIndices)
    {
        if (!repeated.empty()) {
            embreeIndices = indices;
            for (std::size_t f = 0; f < repeated.size(); ++f)
                if (repeated[f])
                    std::fill_n(embreeIndices.begin() + std::ptrdiff_t(3 * f), 3, std::uint32_t(positions.size()));
            positions.emplace_back(std::numeric_limits<float>::quiet_NaN());
        }
        positions.emplace_back(0.0f);
        const std::vector<std::uint32_t>& shared = repeated.empty() ? indices : embreeIndices;
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, positions.data(), 0,
                                   sizeof(glm::vec3), positions.size() - 1);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, shared.data(), 0,
                                   3 * sizeof(std::uint32_t), shared.size() / 3);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene, geometry);
        rtcReleaseGeometry(geometry);
    }

    Status commit(std::size_t triangles)
    {
        rtcCommitScene(scene);
        if (rtcGetDeviceError(device) != RTC_ERROR_NONE)
            return unavailableError(fmt::format("Embree: cannot hold {} triangles", triangles));
        return Done{};
    }
};

// Embree clamps reciprocals of components below 1e-18 to the positive side, but sorts the rays of a coherent packet by
// their original signs: one lane with -1e-18 among lanes with +0.2 makes all of them lose their hits. Components of a
// unit vector that are this small do not move a hit by one unit in the last place.
inline float flushed(float component) { return std::abs(component) < 1e-12f ? 0.0f : component; }

inline RTCRayHit toEmbree(const Ray& ray)
{
    RTCRayHit r{};
    r.ray.org_x = ray.origin.x;
    r.ray.org_y = ray.origin.y;
    r.ray.org_z = ray.origin.z;
    r.ray.dir_x = flushed(ray.direction.x);
    r.ray.dir_y = flushed(ray.direction.y);
    r.ray.dir_z = flushed(ray.direction.z);
    r.ray.tnear = ray.nearest;
    r.ray.tfar = ray.farthest;
    r.ray.mask = ~0u;
    r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    return r;
}

// Data for the filters of a trace.
struct FilterContext {
    RayQuery query;              // must be first: Embree passes its address to filters
    const float* fronts;         // of the instances: 1, or -1 if triangles are wound against their normals
    const std::uint32_t* groups; // of the instances
    glm::vec3 normal{0};         // of the low surface, for keepFacing
};

// Rejects hits on instances outside the group that a ray looks for, which its id holds.
inline void keepOnly(const RTCFilterFunctionNArguments* a)
{
    const FilterContext& context = *reinterpret_cast<const FilterContext*>(a->context);
    for (unsigned i = 0; i < a->N; ++i) {
        const std::uint32_t only = RTCRayN_id(a->ray, a->N, i);
        if (a->valid[i] && only != Probes::kAny && context.groups[RTCHitN_geomID(a->hit, a->N, i)] != only)
            a->valid[i] = 0;
    }
}

// Whether the front of a triangle faces away from the origin of a ray or from the low surface's normal. Sides of
// upright parts do neither: they are perpendicular to the normal except for rounding.
inline bool facesAway(glm::vec3 front, glm::vec3 direction, glm::vec3 normal)
{
    constexpr float kUprightCosine = 1e-3f;
    const float off = glm::dot(front, normal);
    return glm::dot(front, direction) >= 0
        || (off < 0 && off * off > kUprightCosine * kUprightCosine * glm::dot(front, front));
}

// Rejects the same hits, and those of triangles that face away. For single rays.
inline void keepFacing(const RTCFilterFunctionNArguments* a)
{
    keepOnly(a);
    const FilterContext& context = *reinterpret_cast<const FilterContext*>(a->context);
    for (unsigned i = 0; i < a->N; ++i) {
        if (!a->valid[i])
            continue;
        const glm::vec3 front =
            glm::vec3(RTCHitN_Ng_x(a->hit, a->N, i), RTCHitN_Ng_y(a->hit, a->N, i), RTCHitN_Ng_z(a->hit, a->N, i))
            * context.fronts[RTCHitN_geomID(a->hit, a->N, i)];
        const glm::vec3 direction(RTCRayN_dir_x(a->ray, a->N, i), RTCRayN_dir_y(a->ray, a->N, i),
                                  RTCRayN_dir_z(a->ray, a->N, i));
        if (facesAway(front, direction, context.normal))
            a->valid[i] = 0;
    }
}

// Sets a filter only if a probe is limited to a group: a filter costs a call for each candidate.
inline FilterContext filterContextFor(const Probes& probes, const std::vector<float>& fronts,
                                      const std::vector<std::uint32_t>& groups,
                                      Coherence coherence = Coherence::coherent)
{
    const bool filtered = std::any_of(probes.only.begin(), probes.only.begin() + std::ptrdiff_t(probes.count),
                                      [](std::uint32_t only) { return only != Probes::kAny; });
    return {RayQuery(coherence, filtered ? keepOnly : nullptr), fronts.data(), groups.data()};
}

static_assert(Hits::kNothing == RTC_INVALID_GEOMETRY_ID && kLanes == 16);

struct Packet {
    Lanes<int> valid;
    Lanes<float> length;
    RTCRayHit16 rays;

    // Rays of length `farthest` that start `offset` before each probe's point, along direction * sign.
    Packet(const Probes& probes, const Lanes<float>& offset, float sign, const Lanes<float>& farthest)
    {
        RTCRay16& r = rays.ray;
        const int count = int(probes.count);
        for (int lane = 0; lane < int(kLanes); ++lane) {
            const auto i = std::size_t(lane);
            const glm::vec3 direction = probes.direction.at(i) * sign,
                            origin = probes.point.at(i) - direction * offset[i];
            r.org_x[i] = origin.x;
            r.org_y[i] = origin.y;
            r.org_z[i] = origin.z;
            r.dir_x[i] = flushed(direction.x);
            r.dir_y[i] = flushed(direction.y);
            r.dir_z[i] = flushed(direction.z);
            r.tnear[i] = 0;
            r.tfar[i] = length[i] = farthest[i];
            r.time[i] = 0;
            r.mask[i] = ~0u;
            r.id[i] = probes.only[i];
            r.flags[i] = 0;
            rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
            rays.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
            const bool active = glm::dot(direction, direction) > 0 && farthest[i] > 0 && lane < count;
            valid[i] = active ? -1 : 0;
        }
    }
    bool found(std::size_t i) const { return rays.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID; } // false for invalid lanes

    void trace(RTCScene scene, FilterContext context) { intersect(valid.data(), scene, context.query, rays); }

    // Traces one lane as a single ray. Keeps the lane's previous hit if that finds nothing.
    void traceAlone(std::size_t i, RTCScene scene, FilterContext context)
    {
        const RTCRay16& r = rays.ray;
        RTCRayHit one =
            toEmbree({{r.org_x[i], r.org_y[i], r.org_z[i]}, {r.dir_x[i], r.dir_y[i], r.dir_z[i]}, 0, length[i]});
        one.ray.id = r.id[i];
        intersect(scene, context.query, one);
        if (one.hit.geomID == RTC_INVALID_GEOMETRY_ID)
            return;
        rays.ray.tfar[i] = one.ray.tfar;
        rtcCopyHitToHitN(reinterpret_cast<RTCHitN*>(&rays.hit), &one.hit, kLanes, unsigned(i));
    }
    // Whether the lane hit a triangle that faces away.
    bool foundAway(std::size_t i, const std::vector<float>& fronts, glm::vec3 normal) const
    {
        const glm::vec3 face(rays.hit.Ng_x[i], rays.hit.Ng_y[i], rays.hit.Ng_z[i]);
        return found(i)
            && facesAway(face * fronts[rays.hit.geomID[i]], {rays.ray.dir_x[i], rays.ray.dir_y[i], rays.ray.dir_z[i]},
                         normal);
    }
};

// Selects for each lane `second` if all bits of the mask are set, `first` if none is. Bit operations prevent branches.
template<class T> void pick(const Lanes<std::uint32_t>& masks, const T* first, const T* second, T* picked)
{
    for (std::size_t i = 0; i < kLanes; ++i) {
        const auto a = std::bit_cast<std::uint32_t>(first[i]), b = std::bit_cast<std::uint32_t>(second[i]);
        picked[i] = std::bit_cast<T>((a & ~masks[i]) | (b & masks[i]));
    }
}

inline void pick(const Lanes<std::uint32_t>& masks, const RTCHit16& first, const RTCHit16& second, Hits& hits)
{
    pick(masks, first.geomID, second.geomID, hits.instance.data());
    pick(masks, first.primID, second.primID, hits.triangle.data());
    pick(masks, first.u, second.u, hits.b1.data());
    pick(masks, first.v, second.v, hits.b2.data());
    pick(masks, first.Ng_x, second.Ng_x, hits.face.x);
    pick(masks, first.Ng_y, second.Ng_y, hits.face.y);
    pick(masks, first.Ng_z, second.Ng_z, hits.face.z);
}

} // namespace cotan
