// Embree 3 or 4, whichever COTAN_EMBREE_MAJOR says: the only text of the baker in which the two differ.
#pragma once

#if COTAN_EMBREE_MAJOR == 3
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif

namespace cotan {

enum class Coherence { incoherent, coherent };

#if COTAN_EMBREE_MAJOR == 3

// Lets scenes take filters from a query.
inline constexpr RTCSceneFlags kFiltersInQueries = RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;

// What a trace is given beside its rays: how they lie to one another, and a filter or null. Filters find the context at
// the start of it.
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
// Rays that meet something have a negative tfar then.
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
    // RTCIntersectArguments or RTCOccludedArguments, of which init sets the rest.
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

} // namespace cotan
