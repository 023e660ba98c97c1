// Groups of corners that are averaged together: those of equal vertices, mirrored and unmirrored charts separately.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "cotan/tangents.hpp"
#include "large_array.hpp"
#include "loops.hpp"
#include "tangents_mesh.hpp"

namespace cotan::tangents {

// The edges of a triangle in space and in uv, from one of its corners.
struct Edges {
    glm::dvec3 dp1, dp2;
    glm::dvec2 duv1, duv2;

    double uvArea() const { return duv1.x * duv2.y - duv1.y * duv2.x; }
};

// Returns the edges from corner k of triangle f to the next and to the previous corner.
Edges edgesAt(const MeshView& mesh, std::size_t f, std::size_t k);

// Whether a triangle's texture is mirrored with respect to the vertex normal. Unmirrored: (dP/du, dP/dv, normal) is
// left-handed, as for an image seen from outside with v downwards.
enum class Side : std::uint8_t { unmirrored = 0, mirrored = 1, none = 2 };

// Returns `none` if the triangle has no area in space, in uv, or as seen along the normal.
Side sideAt(const Edges& e, glm::vec3 normal);
std::vector<Side> cornerSides(const MeshView& mesh, std::size_t threads = 1);

inline std::size_t slot(std::uint32_t vertex, Side side) { return 2 * std::size_t(vertex) + std::size_t(side); }

// Returns `side`, or for a corner without a side that of the vertex, if it has any.
Side sideOrNearest(Side side, std::uint32_t vertex, const auto& isEmpty)
{
    if (side != Side::none)
        return side;
    return isEmpty(slot(vertex, Side::unmirrored)) && !isEmpty(slot(vertex, Side::mirrored)) ? Side::mirrored
                                                                                             : Side::unmirrored;
}

struct CornerGroups {
    LargeArray<std::uint32_t> first; // per vertex: the first vertex that equals it
    std::vector<Side> sides;         // per vertex: the side whose corners its cotangents are averaged from
};

// The output of groupCorners.
struct Averages {
    Cotangents* cotangents = nullptr; // of all vertices, including copies; null: none
    // For vertices that both sides use and that have a copy, per vertex: the side that keeps the vertex, and the copy
    // or kNone. Empty: such a vertex takes the side with the larger weight.
    std::span<const Side> keepers;
    std::span<const std::uint32_t> copies;
};

// Groups the corners of a usable mesh and averages their cotangents. The result does not depend on the number of
// threads. If the listener stops it, `first` is empty. sideTask: runs once before averages are stored, perhaps
// concurrently.
CornerGroups groupCorners(const MeshView& mesh, std::size_t threads = 1, const Averages& averages = {},
                          const Listener& listener = {}, const Task& sideTask = {});

// Computes the smoothCotangents of a usable mesh in `made`. Returns false if the listener stops it.
bool averageCotangents(const MeshView& mesh, int threads, const Listener& listener, Cotangents& made);

} // namespace cotan::tangents
