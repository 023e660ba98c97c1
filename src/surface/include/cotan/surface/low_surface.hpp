// The surface that a map belongs to: its points, and the named frame at each.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "cotan/cotangent_frame.hpp"
#include "cotan/result.hpp"
#include "cotan/scene/scene.hpp"

namespace cotan {

// Triangles in world space with what every frame needs. Texture coordinates are those that the map is
// read with (KHR_texture_transform applied), v downwards.
struct LowSurface {
    std::vector<glm::vec3> positions, normals;
    std::vector<glm::vec2> texcoords;
    std::vector<std::uint32_t> indices;
    std::vector<glm::vec4> tangents;                  // one a corner, as glTF's TANGENT; empty if the frame needs none
    std::vector<glm::vec3> cotangentsU, cotangentsV;  // one a vertex; empty if the frame needs none
    std::vector<std::uint32_t> triangleInstance;      // which instance of the scene each triangle is of

    std::size_t triangleCount() const { return indices.size() / 3; }
};

// Where tangents for the frames `vertex` and `mikktspace` come from.
enum class TangentSource { stored, generated }; // stored: generated where the file has none

// Gathers the instances whose material is `material` (-1: all) into one surface and derives what the
// frame needs. uv are those of the material's normal map, or uv set 0 where it has none.
// Errors: ErrorKind::input where there is no triangle or a mesh has no uv; ErrorKind::usage for a
// frame that depends on the view, for which nothing can be baked.
Result<LowSurface> makeLowSurface(const Scene& scene, int material, Frame frame, TangentSource source);

// One point of it.
struct LowPoint {
    glm::dvec3 position, normal; // world; the normal unit as interpolated, or zero where unknown
    CotangentFrame<double> frame;
};

// The differences that the frame of a triangle is made from: those of a raster in uv, one step along +u,
// one along +v; for `exact` its edges. A triangle without area in uv, which a raster never shows, gives its
// edges. Unused by frames from vertex attributes.
Differences<double> differencesOf(const LowSurface& surface, Frame frame, std::uint32_t triangle);

// The point of a triangle at barycentric coordinates b1, b2 (of corners 1 and 2). Many at once, in float: low_points.hpp.
LowPoint pointOf(const LowSurface& surface, Frame frame, std::uint32_t triangle, double b1, double b2);

} // namespace cotan
