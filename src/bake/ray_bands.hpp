// Bands along hard edges in which rays bend, so that they leave no gap at the edge and are straight elsewhere.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "bake/surface/low_surface.hpp"

namespace cotan {

// Edges at which two triangles of an instance meet with different normals. Edge k of a triangle runs from its corner k
// to the next; index 3 * triangle + k.
struct HardEdges {
    static constexpr std::uint32_t kNone = ~0u;
    std::vector<std::uint32_t> of;     // per edge of a triangle: number of the hard edge, or kNone
    std::vector<std::uint32_t> beyond; // per edge of a triangle: the triangle beyond a smooth edge, or kNone
    std::uint32_t count = 0;
};

// groups: per vertex, equal for the vertices of an instance at one position.
HardEdges hardEdgesOf(const LowSurface& low, std::span<const std::uint32_t> groups);

// A side of a hard edge: that of one of its triangles.
struct EdgeSide {
    glm::vec3 from{0}, to{0};   // the edge
    glm::vec3 up{0}, out{0};    // unit: normal of the triangle's plane; in it, perpendicular to the edge, outwards
    float sine = 0, cosine = 0; // of the largest angle from `up` to the rays at the edge, seen along it; the sine is
                                // positive if they lean outwards, as at convex edges
};

// directions: of the rays at the vertices of the low surface. Without area `up` and `out` are zero.
EdgeSide sideOf(const LowSurface& low, std::span<const glm::vec3> directions, std::size_t edgeOfTriangle);

// The bands of a surface. A band reaches over smooth edges, but not over hard ones.
struct RayBands {
    struct Band {
        glm::vec3 from{0}, to{0};           // the edge
        glm::vec3 directions[2] = {{}, {}}; // of the rays at its ends
        float width = 0;
    };
    std::vector<Band> bands;
    std::vector<std::uint32_t> first; // per triangle, and one more: its first element of `lists`
    std::vector<std::uint32_t> lists; // numbers of the bands that reach a triangle

    // How far rays at a point of a triangle turn towards a direction: 1 on a hard edge, 0 outside all bands. Between
    // edges the direction is a mean of theirs in which the nearer one counts more.
    struct Bend {
        float amount = 0;
        glm::vec3 direction{0}; // unit unless the amount is 0 or the edges' cancel out
    };
    Bend bendAt(std::uint32_t triangle, glm::vec3 point) const;
};

// needs: for each hard edge the distance from it to the surface that its rays must show. A band is twice as wide as its
// rays then move sideways, so that they do not cross before.
RayBands makeBands(const LowSurface& low, const HardEdges& edges, std::span<const glm::vec3> directions,
                   std::span<const float> needs);

} // namespace cotan
