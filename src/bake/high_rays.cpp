// Rays to the detailed surface.
#include <cmath>

#include "high_state.hpp"
#include "packets.hpp"

namespace cotan {

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
    intersect(state_->scene, query, r);
    if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return {};
    const glm::vec3 face = glm::normalize(glm::vec3(r.hit.Ng_x, r.hit.Ng_y, r.hit.Ng_z));
    return {true, r.ray.tfar, face, face * state_->fronts[r.hit.geomID], r.hit.geomID, r.hit.primID, r.hit.u, r.hit.v};
}

namespace {

// Lanes whose packet reports nothing, each by itself: nothing that is there is lost, whatever its neighbours do.
void traceMissedAlone(Packet& packet, std::size_t count, RTCScene scene, const Asked& context)
{
    for (std::size_t i = 0; i < count; ++i)
        if (packet.valid[i] && !packet.found(i))
            packet.traceAlone(i, scene, context);
}

} // namespace

void HighSurface::nearest(const Probes& probes, float lift, HighNormals normals, Hits& hits) const
{
    const Asked context = asked(state_->fronts, filterFor(probes));
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
    for (std::size_t i = 0; i < probes.count; ++i)
        if (inwards.valid[i] && !inwards.found(i) && !outwards.found(i)) {
            outwards.traceAlone(i, state_->scene, context);
            inwards.traceAlone(i, state_->scene, context);
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

void HighSurface::outermost(const Probes& probes, HighNormals normals, Hits& hits) const
{
    const RTCFilterFunctionN filter = filterFor(probes);
    Lanes<float> farthest;
    for (std::size_t i = 0; i < kLanes; ++i)
        farthest[i] = probes.before[i] + probes.reach[i];
    Packet packet(probes, probes.before, -1, farthest);
    packet.trace(state_->scene, asked(state_->fronts, filter));
    traceMissedAlone(packet, probes.count, state_->scene, asked(state_->fronts, filter));
    for (std::size_t i = 0; i < probes.count; ++i) {
        const glm::vec3 normal = probes.normal.at(i);
        hits.away[i] = packet.foundAway(i, state_->fronts, normal) ? 1 : 0;
        if (!hits.away[i])
            continue;
        Asked facing = asked(state_->fronts, keepFacing); // what faces the low surface counts where there is any
        facing.normal = normal;
        packet.traceAlone(i, state_->scene, facing);
        hits.away[i] = packet.foundAway(i, state_->fronts, normal) ? 1 : 0;
    }
    for (std::size_t i = 0; i < kLanes; ++i)
        hits.distance[i] = probes.before[i] - packet.rays.ray.tfar[i];
    pick({}, packet.rays.hit, packet.rays.hit, hits);
    state_->findNormals(probes, normals, hits);
}

void HighSurface::anyBetween(const Probes& probes, Lanes<int>& any) const
{
    Lanes<float> farthest;
    for (std::size_t i = 0; i < kLanes; ++i)
        farthest[i] = probes.before[i] + probes.reach[i];
    Packet packet(probes, probes.before, -1, farthest);
    Asked context = asked(state_->fronts, filterFor(probes));
    occluded(packet.valid.data(), state_->scene, context.query, packet.rays.ray);
    for (std::size_t i = 0; i < kLanes; ++i)
        any[i] = packet.valid[i] != 0 && packet.rays.ray.tfar[i] < 0; // Embree's mark for an occluded ray
}

std::size_t HighSurface::met(const Ray& ray) const
{
    struct Counting {
        RayQuery query; // first, as Embree hands it to filters
        std::size_t count = 0;
    } counting{RayQuery(Coherence::incoherent,
                        [](const RTCFilterFunctionNArguments* a) {
                            for (unsigned i = 0; i < a->N; ++i)
                                if (a->valid[i]) {
                                    ++reinterpret_cast<Counting*>(a->context)->count;
                                    a->valid[i] = 0; // and on
                                }
                        }),
               0};
    RTCRay r = toEmbree(ray).ray;
    occluded(state_->scene, counting.query, r);
    return counting.count;
}

bool HighSurface::blocked(const Ray& ray) const
{
    RayQuery query(Coherence::incoherent);
    RTCRay r = toEmbree(ray).ray;
    occluded(state_->scene, query, r);
    return r.tfar < 0;
}

} // namespace cotan
