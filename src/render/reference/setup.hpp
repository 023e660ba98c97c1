// Scene setup: vertices relative to the eye, their projection to the raster, and triangles in tiles.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "cotan/view.hpp"
#include "raster.hpp"
#include "scene/geometry.hpp"
#include "texture.hpp"

namespace cotan::reference {

// toRaster transforms a position relative to the eye (world axes) to (x*w, y*w, z*w, w). x and y are pixels from the
// first corner of raster row 0. z is reversed depth: 1 at the near plane, decreasing with distance, linear over the
// image.
//     perspective   w is the distance along the view axis, z = near/w
//     orthographic  w = 1, z = 1 - distance/far
struct Projection : CameraAxes {
    glm::dmat4 toRaster{1};
    int width = 0; // pixels
    int height = 0;
    bool orthographic = false;
    bool rowsUpward = false;    // raster row 0 is the bottom of the image
    glm::dvec2 sampleOffset{0}; // pixels from a pixel's centre to the point it shows
};

// A bounding sphere.
struct Ball {
    glm::dvec3 centre{0};
    double radius = 1;
};

// The sphere around the bounding box of all finite vertex positions; a default one if there are none.
Ball boundingBall(const Scene& scene);

// The projection of the view's camera. The view must have passed checkView. The near plane is at 1e-4 of the distance
// to the far side of the ball, close enough not to cut most models seen from inside.
Projection cameraProjection(const View& view, const Ball& ball);

// The projection in which each pixel's centre shows what lies `offset` pixels from it in the raster.
Projection movedBy(Projection projection, glm::dvec2 offset);

// An orthographic projection of the ball along `direction` to a square map. Positions are relative to `eye`.
Projection shadowProjection(glm::dvec3 direction, const Ball& ball, glm::dvec3 eye, int texels);

// Unit direction, in the world, of the view ray through a raster position.
glm::vec3 rayDirection(const Projection& projection, double x, double y);

// Origin of this ray, relative to the eye.
glm::dvec3 rayOrigin(const Projection& projection, double x, double y);

// An instance of a mesh. Arrays are empty or have one entry per vertex. Pointers refer to the scene and its textures.
struct Draw {
    const Mesh* mesh = nullptr;
    const Material* material = nullptr;
    const MaterialMaps* maps = nullptr;
    Frame frame = Frame{};              // that the mesh is drawn with
    glm::mat3 vectors{1};               // transforms differences of mesh positions to the world
    bool mirrored = false;              // the matrix reverses orientation
    std::vector<glm::vec3> positions;   // relative to the eye, world axes
    std::vector<glm::vec3> normals;     // unit, or zero where unknown
    std::vector<glm::vec4> tangents;    // unit; w = handedness along +v
    std::vector<glm::vec3> cotangentsU; // any common scale
    std::vector<glm::vec3> cotangentsV;
};

// The draws of a scene: opaque and masked instances in the scene's order, then translucent ones, which are tested
// against all opaque depth and write none. Instances without a valid mesh or triangles are omitted. Only the
// attributes that the mesh's frame reads are computed. Views that are not shaded draw translucent materials as opaque
// ones, in the scene's order.
std::vector<Draw> makeDraws(const Scene& scene, const TextureLibrary& textures, glm::dvec3 eye, const View& view);

inline constexpr int kTileSize = 32; // pixels, even

// All visible triangles in drawing order, and for each tile those that may cover it.
struct TiledTriangles {
    std::vector<RasterTriangle> triangles;
    std::vector<std::vector<std::uint32_t>> tiles; // row by row; ascending indices into triangles
    int columns = 0;

    Rectangle area(std::size_t tile, int width, int height) const;
};

enum class Cull {
    backFaces, // unless the material is double-sided
    nothing,
};

// Clips, culls, projects, and sorts triangles into tiles. Omits triangles with indices out of range or non-finite
// corners, and those that are edge-on or outside the image.
TiledTriangles setUpTriangles(const std::vector<Draw>& draws, const Projection& projection, Cull cull);

} // namespace cotan::reference
