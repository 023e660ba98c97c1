// The detailed surface that rays find.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "cotan/bake/lanes.hpp"
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
    glm::vec3 faceNormal{0};    // unit, not turned towards the ray
    std::uint32_t instance = 0; // of the scenes, counted on; empty ones left out
    std::uint32_t triangle = 0; // of that instance
    float b1 = 0, b2 = 0;       // barycentric coordinates of its corners 1 and 2
};

// Up to kLanes lines, each through a point: what lies on the line near the point, either way?
struct Probes {
    static constexpr std::uint32_t kAny = ~0u;

    std::size_t count = 0;       // of the lanes that look for something
    Lanes3 point, direction;     // direction unit; zero: finds nothing
    Lanes<float> reach{};        // how far either way; zero: finds nothing
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

    bool found(std::size_t i) const { return instance[i] != kNothing; }
};

// Which normals of the high surface count.
enum class HighNormals {
    smooth, // interpolated between vertices; those of the faces where they cancel out
    curved, // of the curved surface through the vertices and their normals, where the ray meets it: for meshes whose
            // triangles are larger than texels (src/bake/curved_normals.hpp). After curve(); smooth without, and where
            // a triangle is not nearly flat
    face,
};

// All instances of some scenes in world space, in Embree's acceleration structure.
class HighSurface {
public:
    // Why none can be made here, whatever the scenes are: not built with Embree. To be asked before files are read.
    static std::optional<Error> unavailable();

    // `threads`: 0 for all. Errors: ErrorKind::input where there is no triangle;
    // ErrorKind::unavailable where memory does not suffice.
    static Result<HighSurface> make(const std::vector<Scene>& scenes, int threads);

    HighSurface(HighSurface&&) noexcept;
    HighSurface& operator=(HighSurface&&) noexcept;
    ~HighSurface();

    // Prepares curved normals: fits how the normal turns around each vertex. 24 bytes a vertex. `threads`: 0 for all.
    void curve(int threads);
    // The normal at a hit, unit, not turned towards the ray. `direction`: of the ray, either way.
    glm::vec3 normalOf(const Hit& hit, HighNormals normals, glm::vec3 direction) const;

    // The nearest hit of a ray.
    Hit trace(const Ray& ray) const;
    // For each probe the hit nearest to the point. The two rays of each start `lift` on the other side of the point, so
    // that a surface through the point is found.
    void nearest(const Probes& probes, float lift, HighNormals normals, Hits& hits) const;
    // The same, but only one ray each, which starts `reach` in front of the point and is `length` long (0: ends as far
    // behind the point): the hit in front of all.
    void outermost(const Probes& probes, float length, HighNormals normals, Hits& hits) const;
    // Whether anything lies on the ray.
    bool blocked(const Ray& ray) const;

    // Names of the instances, in order, for matching.
    const std::vector<std::string>& names() const;
    std::size_t triangleCount() const;
    glm::vec3 low() const; // of the box around everything
    glm::vec3 high() const;

private:
    struct State;
    explicit HighSurface(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

} // namespace cotan
