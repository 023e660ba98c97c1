// Measures where the rays of a bake start, as an automatic cage.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "bake/high_surface.hpp"
#include "bake/low_tree.hpp"
#include "bake/ray_bands.hpp"
#include "bake/surface/low_surface.hpp"

namespace cotan {

// Rays start in front of the low surface and run inwards along `directions`, interpolated over the triangle; outside
// `bands`, if there are any, along the interpolated normal. At a point with the weighted sum S of directions and D of
// `distances`, a ray along S starts D |S| in front of the surface, so that the vertices moved by their distances
// enclose the points that they were measured from; a ray in another direction starts at the same height.
struct RayStarts {
    std::vector<glm::vec3> directions;    // per vertex: mean of the normals at its position, weighted by the corners'
                                          // angles. So rays turn continuously around hard edges, without gaps. The
                                          // vertex's own normal if it differs from the mean by more than 78 degrees,
                                          // and for BakeRays::straight
    bool directionsDiffer = false;        // some directions differ from the normals
    bool masked = false;                  // rays turn between normals and directions by `mask`, else by the low
                                          // surface's `reds`; there are no bands then
    std::shared_ptr<const Image> mask;    // as BakeOptions::raysMask
    RayBands bands;                       // along hard edges; none: rays follow the directions everywhere
    std::vector<float> distances;         // per vertex, model units; equal at equal positions of an instance
    std::vector<std::uint8_t> obstructed; // per triangle: other triangles may lie between it and where its rays start
    std::optional<LowTree> tree;          // of the low surface and LowRest; none: rays start at the full distance
    std::optional<LowTree> passed;        // the same surfaces, if rays start at the full distance
    float farthest = 0;                   // maximum of `distances`
    float skip = 0;                       // parts of the low surface nearer than this to a point are ignored
    float limit = 0;                      // surfaces further away than this, in front or behind, do not count
};

// Triangles that are not baked now but that detail may belong to: other materials and other meshes of the model.
struct LowRest {
    std::vector<glm::vec3> positions, normals; // world
    std::vector<std::uint32_t> indices;
    std::vector<std::uint32_t> triangleInstance; // of the scene, as in LowSurface
};

// The ray through a point of the surface.
struct RayStart {
    glm::vec3 direction{0}; // outwards, unit; zero where unknown
    float before = 0;       // how far in front of the surface it starts, if nothing is in between
};

// point: that of the triangle at barycentric coordinates b1, b2 (of corners 1 and 2).
RayStart rayStartAt(const LowSurface& low, const RayStarts& starts, std::uint32_t triangle, float b1, float b2,
                    glm::vec3 point);

// Measures how far the high surface stands off. Each of its vertices (above 400,000 every second, third and so on), and
// points between them on large triangles, belong to the nearest point of the low surface whose front they face, at most
// the limit away; if that point lies sideways, to the point below. The vertices of the low triangle there get a
// distance that encloses the high point, plus 5 % and 0.002 of the diagonal. If nothing belongs to a vertex, or its
// edges are shorter than twice the spacing of the points, the outermost front within the limit on its own ray counts
// too. A band along a hard edge is as wide as the points beyond the edge and the hits of rays from the edge need it.
// Measured rays start no further out than another part of the low surface that shows the same detail; rays with a
// given extrusion may. The result does not depend on the number of threads. Errors: those of LowTree::make;
// ErrorKind::input if thousands of triangles of the low surface overlap at most points. options: extrusion is the
// distance of all vertices, 0: measure; maxDistance is the limit, 0: 10 % of the diagonal of the bounding box of the
// low surface and LowRest; matched, rays and threads.
Result<RayStarts> makeRayStarts(const LowSurface& low, const HighSurface& high, const BakeOptions& options,
                                const LowRest& rest = {});

// The distance in front of a point of `triangle` at which a ray may start: `wanted`, or the distance to another part of
// the low surface in between that shows the same detail; half of that if the point sees the part's back. `skip`: parts
// nearer than this are the surface itself.
float openDistance(const LowTree& tree, std::uint32_t triangle, glm::vec3 point, glm::vec3 direction, float skip,
                   float wanted);

// For each triangle the group of the high surface that it shows, -1 for all, as LowTree::make takes it. Empty if no
// instances are matched. matched: as in BakeOptions.
std::vector<std::int64_t> highGroups(std::span<const std::uint32_t> triangleInstance,
                                     std::span<const std::int64_t> matched);

} // namespace cotan
