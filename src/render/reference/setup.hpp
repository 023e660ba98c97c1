// From a scene to vertices in world space, relative to the eye, and to triangles in tiles.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "cotan/view.hpp"
#include "projection.hpp"
#include "raster.hpp"

namespace cotan::reference {

// One instance of a mesh. Arrays are empty or have one entry a vertex.
struct Draw {
    const Mesh* mesh = nullptr;
    int material = 0;
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
std::vector<Draw> makeDraws(const Scene& scene, glm::dvec3 eye, Frame frame, bool blending);

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
TiledTriangles setUpTriangles(const Scene& scene, const std::vector<Draw>& draws, const Projection& projection,
                              Cull cull);

} // namespace cotan::reference
