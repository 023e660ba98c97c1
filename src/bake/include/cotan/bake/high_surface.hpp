// The detailed surface that rays find.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "cotan/result.hpp"
#include "cotan/scene/scene.hpp"

namespace cotan {

struct Ray {
    glm::vec3 origin, direction; // direction unit
    float nearest = 0, farthest = 0;
};

struct Hit {
    bool found = false;
    float distance = 0;
    glm::vec3 normal{0};         // unit, smooth (interpolated), not turned towards the ray
    glm::vec3 faceNormal{0};     // unit
    std::uint32_t instance = 0;  // of the scenes, counted on; empty ones left out
    std::uint32_t triangle = 0;  // of that instance
    float b1 = 0, b2 = 0;        // barycentric coordinates of its corners 1 and 2
};

// A line through a point: what lies nearest to the point on it, either way?
struct Probe {
    glm::vec3 point, direction; // direction unit; zero: finds nothing
    float reach = 0;            // how far either way
    std::int64_t only = -1;     // only triangles of this instance count; -1: all
};

// All instances of some scenes in world space, in Embree's acceleration structure.
class HighSurface {
public:
    // `threads`: 0 for all. Errors: ErrorKind::input where there is no triangle;
    // ErrorKind::unavailable where memory does not suffice.
    static Result<HighSurface> make(const std::vector<Scene>& scenes, int threads);

    HighSurface(HighSurface&&) noexcept;
    HighSurface& operator=(HighSurface&&) noexcept;
    ~HighSurface();

    // Prepares curvedNormal(): fits how the normal turns around each vertex. 24 bytes a vertex.
    // `threads`: 0 for all.
    void curve(int threads);
    // The normal of the curved surface through the vertices and their normals where the ray of this hit meets it
    // (src/bake/curved_normals.hpp). Without curve(), and where the triangle is not nearly flat: the interpolated one.
    glm::vec3 curvedNormal(const Hit& hit, glm::vec3 direction) const;

    // The nearest hit of a ray.
    Hit trace(const Ray& ray) const;
    // For up to kPacket probes at once the hit nearest to the point; its distance is negative behind it. The two rays
    // of each start `lift` on the other side of the point, so that a surface through the point is found.
    static constexpr std::size_t kPacket = 16;
    void nearest(std::span<const Probe> probes, float lift, std::span<Hit> hits) const;
    // The same, but only one ray each, from `reach` in front of the point to as far behind it: the hit in front of all.
    void outermost(std::span<const Probe> probes, std::span<Hit> hits) const;
    // Whether anything lies on the ray.
    bool blocked(const Ray& ray) const;

    // Names of the instances, in order, for matching.
    const std::vector<std::string>& names() const;
    std::size_t triangleCount() const;
    glm::vec3 low() const;  // of the box around everything
    glm::vec3 high() const;

private:
    struct State;
    explicit HighSurface(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

} // namespace cotan
