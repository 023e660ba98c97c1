// The simple surface for nearest-point and ray queries.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include <glm/vec3.hpp>

#include "bake/high_surface.hpp"
#include "cotan/result.hpp"

namespace cotan {

// Triangles in Embree's acceleration structure, for single queries from several threads. Copies share them.
class LowTree {
public:
    // positions, indices: of the triangles, copied. highGroups: for each triangle the group of the high surface
    // that it shows, -1 for all; empty: all triangles show all. threads: 0 for all. Errors: ErrorKind::unavailable if
    // memory does not suffice, or without Embree.
    static Result<LowTree> make(std::vector<glm::vec3> positions, std::vector<std::uint32_t> indices,
                                std::vector<std::int64_t> highGroups, int threads);

    struct TreeHit {
        bool found = false;
        std::uint32_t triangle = 0;
        float b1 = 0, b2 = 0; // barycentric coordinates of its corners 1 and 2
        float distance = 0;
    };
    struct Nearest : TreeHit {
        glm::vec3 point{0};
        std::size_t visited = 0; // number of triangles visited
    };
    // The nearest point within `radius` on the triangles that `accepts` takes; of equally near ones that of the first
    // triangle.
    Nearest nearest(glm::vec3 to, float radius, const std::function<bool(std::uint32_t triangle)>& accepts) const;

    // The first triangle that a ray hits.
    TreeHit first(const Ray& ray) const;
    // The same among triangles that show something that `triangle` shows too.
    TreeHit firstBeside(std::uint32_t triangle, Ray ray) const;

    // The unit normal by the order of the corners; zero without area.
    glm::vec3 face(std::uint32_t triangle) const;

private:
    struct State;
    explicit LowTree(std::shared_ptr<const State> state) : state_(std::move(state)) {}
    std::shared_ptr<const State> state_;
};

} // namespace cotan
