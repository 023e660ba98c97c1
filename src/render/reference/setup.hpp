// From a scene to vertices in world space, relative to the eye, from there to the raster, and to triangles in tiles.
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

// toRaster takes a position relative to the eye (world axes) to (x*w, y*w, z*w, w), where x and
// y are pixels from the first raster row's first corner and z is reversed depth: 1 at the near plane,
// falling with distance, linear over the picture.
//   perspective   w is the distance along the view axis, z = near/w
//   orthographic  w = 1, z = 1 - distance/far
struct Projection : CameraAxes {
    glm::dmat4 toRaster{1};
    int width = 0; // pixels
    int height = 0;
    bool orthographic = false;
    bool rowsUpward = false; // raster row 0 is the bottom of the picture
    glm::dvec2 moved{0};     // pixels: what the middle of one sees lies there
};

// The sphere around a scene.
struct Ball {
    glm::dvec3 centre{0};
    double radius = 1;
};

// The sphere around the box of all finite vertex positions; the default one if there are none.
Ball boundingBall(const Scene& scene);

// The view's camera; checkView has passed the view. The near plane lies at 1e-4 of the distance to the far side of the
// ball, so that models seen from inside are cut as late as possible.
Projection cameraProjection(const View& view, const Ball& ball);

// The same with the middle of each pixel seeing what lies `place` pixels from it in the raster.
Projection movedBy(Projection projection, glm::dvec2 place);

// A square map of that many texels that looks along `direction` at the whole ball. Positions stay relative to `eye`.
Projection shadowProjection(glm::dvec3 direction, const Ball& ball, glm::dvec3 eye, int texels);

// The unit direction, in the world, of the view ray through a raster position.
glm::vec3 rayDirection(const Projection& projection, double x, double y);

// Where that ray starts, relative to the eye.
glm::dvec3 rayOrigin(const Projection& projection, double x, double y);

// One instance of a mesh. Arrays are empty or have one entry a vertex. Pointers are into the scene and its textures.
struct Draw {
    const Mesh* mesh = nullptr;
    const Material* material = nullptr;
    const MaterialMaps* maps = nullptr;
    glm::mat3 vectors{1};               // takes differences of mesh positions to the world
    bool mirrored = false;              // the matrix reverses orientation
    std::vector<glm::vec3> positions;   // relative to the eye, world axes
    std::vector<glm::vec3> normals;     // unit, or zero where unknown
    std::vector<glm::vec4> tangents;    // unit; w = handedness along +v
    std::vector<glm::vec3> cotangentsU; // any common scale
    std::vector<glm::vec3> cotangentsV;
};

// The draws of a scene: opaque and masked instances in the scene's order, then translucent ones likewise:
// these can be tested against all that hides them, and keep no depth themselves. Instances without a valid mesh or
// triangles are left out. frame: only the attributes that it reads are made. blending: false draws translucent
// materials as opaque ones, in the scene's order.
std::vector<Draw> makeDraws(const Scene& scene, const TextureLibrary& textures, glm::dvec3 eye, Frame frame,
                            bool blending);

inline constexpr int kTileSize = 32; // pixels, even

// Every visible triangle in drawing order, and for each tile the ones that may touch it.
struct TiledTriangles {
    std::vector<RasterTriangle> triangles;
    std::vector<std::vector<std::uint32_t>> tiles; // rows first; indices into triangles, ascending
    int columns = 0;

    Rectangle area(std::size_t tile, int width, int height) const;
};

enum class Cull {
    backFaces, // unless the material is double-sided
    nothing,
};

// Clips, culls, projects and sorts into tiles. Left out: triangles with indices out of range,
// with non-finite corners, edge-on, or outside the picture.
TiledTriangles setUpTriangles(const std::vector<Draw>& draws, const Projection& projection, Cull cull);

} // namespace cotan::reference
