// The corners that are averaged together: those of equal vertices, mirrored and unmirrored charts apart.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "cotan/tangents.hpp"
#include "large_array.hpp"
#include "parallel.hpp"
#include "tangents_mesh.hpp"

namespace cotan::tangents {

// The edges of a triangle in space and in uv, from one of its corners.
struct Edges {
    glm::dvec3 dp1, dp2;
    glm::dvec2 duv1, duv2;

    double uvArea() const { return duv1.x * duv2.y - duv1.y * duv2.x; }
};

// From corner k of triangle f to the next and to the previous one.
Edges edgesAt(const MeshView& mesh, std::size_t f, std::size_t k);

// On which side of its vertices' tangent plane a triangle's image reads: unmirrored where (dP/du,
// dP/dv, normal) is left-handed, as it is for an image that is seen from outside with v downwards.
enum class Side : std::uint8_t { unmirrored = 0, mirrored = 1, none = 2 };

// `none` where the triangle has no area in space, none in uv, or none seen along the normal.
Side sideAt(const Edges& e, glm::vec3 normal);
std::vector<Side> cornerSides(const MeshView& mesh, std::size_t threads = 1);

inline std::size_t slot(std::uint32_t vertex, Side side) { return 2 * std::size_t(vertex) + std::size_t(side); }

// What a corner without a side of its own takes: that of the vertex, where it has any.
Side sideOrNearest(Side side, std::uint32_t vertex, const auto& isEmpty)
{
    if (side != Side::none)
        return side;
    return isEmpty(slot(vertex, Side::unmirrored)) && !isEmpty(slot(vertex, Side::mirrored)) ? Side::mirrored
                                                                                             : Side::unmirrored;
}

struct CornerGroups {
    LargeArray<std::uint32_t> first; // per vertex the first that equals it
    std::vector<Side> sides;         // per vertex: of which corners of the equal ones it takes the cotangents
};

// Where averages go.
struct Averages {
    Cotangents* cotangents = nullptr; // of all vertices, copies included; null: nowhere
    // Where vertices that both sides index have a copy for one of them, per vertex: the side that keeps it, and the
    // copy or kNone. Empty: such a vertex takes the side with more to say.
    std::span<const Side> keepers;
    std::span<const std::uint32_t> copies;
};

// mesh: usable. The result does not depend on the number of threads. Without `first` where the listener has said to
// stop. beside: something that has to be done before averages are stored, once; one thread may do it meanwhile.
CornerGroups groupCorners(const MeshView& mesh, std::size_t threads = 1, const Averages& averages = {},
                          const Listener& listener = {}, const Task& beside = {});

// smoothCotangents of a usable mesh, into `made`. Returns false where the listener has said to stop.
bool averageCotangents(const MeshView& mesh, int threads, const Listener& listener, Cotangents& made);

} // namespace cotan::tangents
