// Where the rays of a bake start: a cage that is measured.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "bake/high_surface.hpp"
#include "bake/low_tree.hpp"
#include "bake/surface/low_surface.hpp"

namespace cotan {

// Rays run along `directions`, interpolated over the triangle, from `distances`, interpolated as well, in front of the
// low surface inwards. At a point with the sum S of weighted directions and D of weighted distances a ray starts D |S|
// in front of it: the vertices moved by their distances enclose whatever they were measured from.
struct RayStarts {
    std::vector<glm::vec3> directions; // one a vertex: the mean of the normals at its position, weighted by the angles
                                       // of the corners. So rays turn steadily around hard edges, without gaps. The
                                       // vertex's own normal where the mean leans from it by more than 78 degrees
    bool bent = false;                 // some differ from the normals
    std::vector<float> distances;      // one a vertex, model units; equal at equal positions
    std::vector<std::uint8_t> crossed; // one a triangle: other triangles may stand before where its rays start
    std::optional<LowTree> tree;       // of the low surface and LowRest; none: rays start wherever they are told
    float farthest = 0;                // the largest distance
    float skip = 0;                    // parts of the low surface nearer than this to a point are the point itself
    float limit = 0;                   // surfaces further than this off, in front or behind, do not count
};

// Triangles that no map is baked for now, but that detail may belong to: the model's other materials.
struct LowRest {
    std::vector<glm::vec3> positions, normals; // world
    std::vector<std::uint32_t> indices;
    std::vector<std::uint32_t> triangleInstance; // of the scene, as in LowSurface
};

// Measures how far the high surface stands off. Each of its vertices (of more than 400,000 every second, third and so
// on; and points between, where its triangles are large) belongs to the nearest point of the low surface whose front it
// faces, at most the limit away; where that lies aside, to the point below it. The vertices of the triangle there get a
// distance that encloses it, and 5 % and 0.002 of the diagonal more. Where nothing belongs to a vertex, or its
// edges are shorter than twice the distance between those points, the outermost front within the limit on its own ray
// counts, too. Rays start no further out than another part of the low surface that shows the same detail: measured
// ones, not those with a given extrusion. The result does not depend on the number of threads. Errors: those of
// LowTree::make; ErrorKind::input where thousands of triangles of the low surface lie over one another at most points.
// options: extrusion is the distance of all vertices, 0 measures; maxDistance the limit, 0 for 10 % of the diagonal of
// the low surface's box, LowRest included; matched and threads.
Result<RayStarts> makeRayStarts(const LowSurface& low, const HighSurface& high, const BakeOptions& options,
                                const LowRest& rest = {});

// How far a ray may start in front of a point of `triangle`: `wanted`, or where another part of the low surface that
// shows the same detail stands in between, the distance to it; half of that, if one sees it from behind. `skip`: parts
// nearer than this are the surface itself.
float openDistance(const LowTree& tree, std::uint32_t triangle, glm::vec3 point, glm::vec3 direction, float skip,
                   float wanted);

// The instance of the high surface that each triangle shows, -1 for all: as LowTree::make asks for it. Empty where no
// instances are matched. matched: as in BakeOptions.
std::vector<std::int64_t> shownBy(std::span<const std::uint32_t> triangleInstance,
                                  std::span<const std::int64_t> matched);

} // namespace cotan
