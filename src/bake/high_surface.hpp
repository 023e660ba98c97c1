// The detailed surface that rays find.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "bake/lanes.hpp"
#include "cotan/bake.hpp"
#include "cotan/result.hpp"
#include "cotan/scene.hpp"

namespace cotan {

struct Ray {
    glm::vec3 origin, direction; // direction unit
    float nearest = 0, farthest = 0;
};

struct Hit {
    bool found = false;
    float distance = 0;
    glm::vec3 faceNormal{0};    // unit, by the order of the corners, not turned towards the ray
    glm::vec3 front{0};         // the same, turned to the side that most vertex normals of the instance are on
    std::uint32_t instance = 0; // of the scenes, counted on; empty ones left out
    std::uint32_t triangle = 0; // of that instance
    float b1 = 0, b2 = 0;       // barycentric coordinates of its corners 1 and 2
};

// Up to kLanes lines, each through a point: what lies on the line near the point?
struct Probes {
    static constexpr std::uint32_t kAny = ~0u;

    std::size_t count = 0;       // of the lanes that look for something
    Lanes3 point, direction;     // direction unit; zero: finds nothing
    Lanes3 normal;               // of the low surface at the point, unit; zero: no front faces away from it
    Lanes<float> before{};       // where rays start, along the direction in front of the point
    Lanes<float> reach{};        // how far they look behind the point; nearest(): either way
    Lanes<std::uint32_t> only{}; // only triangles of this instance count; kAny: all
};

// What each of them found.
struct Hits {
    static constexpr std::uint32_t kNothing = ~0u;

    Lanes<float> distance{};         // along the direction; negative behind the point
    Lanes3 normal;                   // unit, not turned towards the ray
    Lanes3 face;                     // normal of the triangle hit, any length
    Lanes<std::uint32_t> instance{}; // of the scenes, counted on; kNothing where nothing was found
    Lanes<std::uint32_t> triangle{}; // of that instance
    Lanes<float> b1{}, b2{};         // barycentric coordinates of its corners 1 and 2
    Lanes<std::uint8_t> away{};      // 1: its front faces away, see outermost(). 0 by nearest()

    bool found(std::size_t i) const { return instance[i] != kNothing; }
};

// All instances of some scenes in world space, in Embree's acceleration structure. Copies share it.
class HighSurface {
public:
    // Why none can be made here, whatever the scenes are: not built with Embree. To be asked before files are read.
    static std::optional<Error> unavailable();

    // `threads`: 0 for all. byInstance: probes ask for triangles of one instance (Probes::only); else, of many
    // triangles that lie on one another, the first is seen. Errors: ErrorKind::input where there is no triangle;
    // ErrorKind::unavailable where memory does not suffice.
    static Result<HighSurface> make(const std::vector<Scene>& scenes, int threads, bool byInstance = false);

    // Prepares curved normals: fits how the normal turns around each vertex. 24 bytes a vertex. `threads`: 0 for all.
    void curve(int threads);
    // The normal at a hit, unit, not turned towards the ray. `direction`: of the ray, either way.
    glm::vec3 normalOf(const Hit& hit, HighNormals normals, glm::vec3 direction) const;

    // The nearest hit of a ray.
    Hit trace(const Ray& ray) const;
    // For each probe the hit nearest to the point. The two rays of each start `lift` on the other side of the point, so
    // that a surface through the point is found. Probes::before is not read. Zero `reach`: finds nothing.
    void nearest(const Probes& probes, float lift, HighNormals normals, Hits& hits) const;
    // For each probe the first hit of one ray, which starts `before` in front of the point and ends `reach` behind it.
    // Triangles that face away from the start or from the low surface's normal count only where there is no other.
    void outermost(const Probes& probes, HighNormals normals, Hits& hits) const;
    // Whether anything at all lies on those rays, 1 or 0.
    void anyBetween(const Probes& probes, Lanes<int>& any) const;
    // Whether anything lies on the ray.
    bool blocked(const Ray& ray) const;
    // How many triangles the ray meets, one behind the other.
    std::size_t met(const Ray& ray) const;

    // One instance in world space.
    struct Triangles {
        std::span<const glm::vec3> positions, normals; // normals unit, or zero where unknown
        std::span<const std::uint32_t> indices;
        std::span<const std::uint8_t> repeated; // one a triangle: not 0 where nothing sees it; empty: all are seen
    };
    Triangles triangles(std::size_t instance) const;
    // Names of the instances, in order, for matching.
    const std::vector<std::string>& names() const;
    std::size_t triangleCount() const;
    const Bounds& box() const; // around everything

private:
    struct State;
    explicit HighSurface(std::shared_ptr<State> state) : state_(std::move(state)) {}
    std::shared_ptr<State> state_;
};

} // namespace cotan
