// The surface that a map belongs to, in world space, with one frame at each point. In float, since a baker needs many
// points fast. For one mesh with all frames in double see mapped_surface.hpp.
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

// Triangles in world space with the attributes of their frame. Texture coordinates are those that the map is read with
// (KHR_texture_transform applied), v downwards.
struct LowSurface {
    Frame frame = Frame::cotangent;
    std::vector<glm::vec3> positions, normals;
    std::vector<glm::vec2> texcoords;
    std::vector<std::uint32_t> indices;
    std::vector<float> reds;                         // per vertex, of the vertex colours: 1 without; empty: all are 1
    std::vector<glm::vec4> tangents;                 // per corner, as tangentAlongV; empty if the frame reads none
    std::vector<glm::vec3> cotangentsU, cotangentsV; // per vertex; empty if the frame reads none
    std::vector<std::uint32_t> triangleInstance;     // instance that each triangle is of

    std::size_t triangleCount() const { return indices.size() / 3; }
};

// Gathers the instances whose material is `material` (-1: all) into one surface and derives the attributes of the
// frame. uv are those of the material's normal map, or set 0 without one. instances: of the scene's meshes; by default
// the scene's own. Errors: ErrorKind::input if there is no triangle or a mesh has no uv; ErrorKind::usage for a frame
// that depends on the view, for which no map can be made.
Result<LowSurface> makeLowSurface(const Scene& scene, int material, Frame frame, TangentOrigin tangents,
                                  std::span<const Instance> instances);
inline Result<LowSurface> makeLowSurface(const Scene& scene, int material, Frame frame, TangentOrigin tangents)
{
    return makeLowSurface(scene, material, frame, tangents, scene.instances);
}

// A point of the surface.
struct LowPoint {
    glm::dvec3 position, normal; // world; the normal unit as interpolated, or zero if unknown
    CotangentFrame<double> frame;
};

TriangleEdges edgesOf(const LowSurface& surface, std::size_t triangle);

// The differences that the frame of a triangle is made from: steps along +u and +v, as a raster in uv has them; the
// edges for a frame of the whole triangle, and for one without area in uv, which no raster covers. Not for frames of
// vertices.
Differences<double> differencesOf(const LowSurface& surface, std::uint32_t triangle);

// The point of a triangle at barycentric coordinates b1, b2 (of corners 1 and 2). For many points: bake/low_points.hpp.
LowPoint pointOf(const LowSurface& surface, std::uint32_t triangle, double b1, double b2);

} // namespace cotan
