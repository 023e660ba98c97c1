// The surface that a map belongs to, in the world: its points, and one named frame at each. In float, as a baker needs
// many points of it fast. For one mesh with all frames in double see mapped_surface.hpp.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "bake/surface/surface_triangle.hpp"
#include "cotan/frame.hpp"
#include "cotan/result.hpp"
#include "cotan/scene.hpp"
#include "cotan/view.hpp"

namespace cotan {

// Triangles in world space with what their frame needs. Texture coordinates are those that the map is
// read with (KHR_texture_transform applied), v downwards.
struct LowSurface {
    Frame frame = Frame::cotangent;
    std::vector<glm::vec3> positions, normals;
    std::vector<glm::vec2> texcoords;
    std::vector<std::uint32_t> indices;
    std::vector<glm::vec4> tangents;                 // one a corner, as tangentAlongV; empty if the frame reads none
    std::vector<glm::vec3> cotangentsU, cotangentsV; // one a vertex; empty if the frame reads none
    std::vector<std::uint32_t> triangleInstance;     // which of the instances each triangle is of

    std::size_t triangleCount() const { return indices.size() / 3; }
};

// Gathers the instances whose material is `material` (-1: all) into one surface and derives what the
// frame needs. uv are those of the material's normal map, or uv set 0 where it has none.
// Errors: ErrorKind::input where there is no triangle or a mesh has no uv; ErrorKind::usage for a
// frame that depends on the view, for which no map can be made.
// instances: of the scene's meshes; all of the scene's own unless given.
Result<LowSurface> makeLowSurface(const Scene& scene, int material, Frame frame, TangentOrigin tangents,
                                  std::span<const Instance> instances);
inline Result<LowSurface> makeLowSurface(const Scene& scene, int material, Frame frame, TangentOrigin tangents)
{
    return makeLowSurface(scene, material, frame, tangents, scene.instances);
}

// One point of it.
struct LowPoint {
    glm::dvec3 position, normal; // world; the normal unit as interpolated, or zero where unknown
    CotangentFrame<double> frame;
};

TriangleEdges edgesOf(const LowSurface& surface, std::size_t triangle);

// The differences that the frame of a triangle is made from: those of a raster in uv, one step along +u,
// one along +v; for a frame of the whole triangle its edges. A triangle without area in uv, which a raster never shows,
// gives its edges. Unused by frames that read the vertices.
Differences<double> differencesOf(const LowSurface& surface, std::uint32_t triangle);

// The point of a triangle at barycentric coordinates b1, b2 (of corners 1 and 2). Many at once, in float:
// bake/low_points.hpp.
LowPoint pointOf(const LowSurface& surface, std::uint32_t triangle, double b1, double b2);

} // namespace cotan
