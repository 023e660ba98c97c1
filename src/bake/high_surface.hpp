// The detailed surface, which rays hit.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "bake/lanes.hpp"
#include "cotan/bake.hpp"
#include "cotan/result.hpp"
#include "cotan/scene.hpp"

namespace cotan {

struct Ray {
    glm::vec3 origin, direction; // direction: unit
    float nearest = 0, farthest = 0;
};

struct Hit {
    bool found = false;
    float distance = 0;
    glm::vec3 faceNormal{0};    // unit, by the order of the corners, not flipped towards the ray
    glm::vec3 front{0};         // the same, on the side of most vertex normals of the instance
    std::uint32_t instance = 0; // counted over all scenes, without empty instances
    std::uint32_t triangle = 0; // of that instance
    float b1 = 0, b2 = 0;       // barycentric coordinates of its corners 1 and 2
};

// Up to kLanes lines, each through a point near which the surface is searched.
struct Probes {
    static constexpr std::uint32_t kAny = ~0u;

    std::size_t count = 0;       // number of lanes in use
    Lanes3 point, direction;     // direction: unit; zero: finds nothing
    Lanes3 normal;               // of the low surface at the point, unit; zero: no front faces away from it
    Lanes<float> before{};       // where rays start: distance in front of the point, along the direction
    Lanes<float> reach{};        // how far they extend behind the point; for nearest() on either side
    Lanes<std::uint32_t> only{}; // group of instances whose triangles count; kAny: all
};

// The hit of each probe.
struct Hits {
    static constexpr std::uint32_t kNothing = ~0u;

    Lanes<float> distance{};         // along the direction; negative behind the point
    Lanes3 normal;                   // unit, not flipped towards the ray
    Lanes3 shown;                    // the same, or that of the high surface's normal map; set by Baker::find
    Lanes3 face;                     // normal of the triangle hit, any length
    Lanes<std::uint32_t> instance{}; // counted over all scenes, without empty ones; kNothing: no hit
    Lanes<std::uint32_t> triangle{}; // of that instance
    Lanes<float> b1{}, b2{};         // barycentric coordinates of its corners 1 and 2
    Lanes<std::uint8_t> away{};      // 1: the front faces away, see outermost(). Not set by nearest()

    bool found(std::size_t i) const { return instance[i] != kNothing; }
};

// All instances of some scenes in world space, in Embree's acceleration structure. Copies share it, and have groups of
// their own.
class HighSurface {
public:
    // Why no surface can be made in this build: it lacks Embree. Lets callers fail before they read files.
    static std::optional<Error> unavailable();

    // `threads`: 0 for all. byInstance: probes may be limited to a group (Probes::only); otherwise rays see only the
    // first of many coincident triangles. Errors: ErrorKind::input for no triangle; ErrorKind::unavailable for too
    // little memory.
    static Result<HighSurface> make(const std::vector<Scene>& scenes, int threads, bool byInstance = false);

    // Sets the group of each instance; without it, each is its own.
    void setGroups(std::vector<std::uint32_t> groups);
    std::uint32_t groupOf(std::size_t instance) const;

    // Prepares curved normals: fits the shape operator of each vertex. Takes 24 bytes per vertex. `threads`: 0 for all.
    void curve(int threads);
    bool isCurved() const;
    // The mean curvature at a hit, 1 / length, positive where the surface is convex as seen from its normals: half the
    // trace of the shape operator, interpolated between vertices. Needs curve().
    float curvatureAt(const Hits& hits, std::size_t lane) const;
    // The unit normal at a hit, not flipped towards the ray. `direction`: of the ray, with either sign.
    glm::vec3 normalOf(const Hit& hit, HighNormals normals, glm::vec3 direction) const;

    // The nearest hit of a ray.
    Hit trace(const Ray& ray) const;
    // For each probe, the hit nearest to the point. Both rays start `lift` on the other side of the point, so that they
    // hit a surface through the point. Ignores Probes::before. A probe with zero `reach` finds nothing.
    void nearest(const Probes& probes, float lift, HighNormals normals, Hits& hits) const;
    // For each probe, the first hit of one ray, which starts `before` in front of the point and ends `reach` behind it.
    // Triangles that face away from the start or from the low surface's normal count only if there is no other.
    void outermost(const Probes& probes, HighNormals normals, Hits& hits) const;
    // Whether these rays hit anything, 1 or 0. spread: they run in all directions, as from one point.
    void anyBetween(const Probes& probes, Lanes<int>& any, bool spread = false) const;
    // Whether the ray hits anything.
    bool blocked(const Ray& ray) const;
    // How far these rays run until they hit anything; infinity if they do not. They may run in all directions.
    void distances(const Probes& probes, Lanes<float>& found) const;
    // The number of triangles that the ray crosses.
    std::size_t countHits(const Ray& ray) const;

    // One instance in world space.
    struct Triangles {
        std::span<const glm::vec3> positions, normals; // normals: unit, or zero if unknown
        std::span<const std::uint32_t> indices;
        std::span<const std::uint8_t> repeated; // per triangle: not 0 if rays skip it; empty: none is skipped
        Bounds box;
        float longestEdge = 0; // of all triangles
    };
    Triangles triangles(std::size_t instance) const;
    std::size_t instanceCount() const;
    std::size_t triangleCount() const;
    const Bounds& box() const; // of all instances

private:
    struct State;
    HighSurface(std::shared_ptr<State> state, std::vector<std::uint32_t> groups)
        : state_(std::move(state)), groups_(std::move(groups))
    {
    }
    std::shared_ptr<State> state_;
    std::vector<std::uint32_t> groups_; // of the instances
};

} // namespace cotan
