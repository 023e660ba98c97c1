// From draws to triangles in tiles.
#pragma once

#include <cstdint>
#include <vector>

#include "projection.hpp"
#include "raster.hpp"
#include "reference_geometry.hpp"

namespace cotan::reference {

inline constexpr int kTileSize = 32; // pixels, even

// Every visible triangle in drawing order, and for each tile the ones that may touch it.
struct TiledTriangles {
    std::vector<RasterTriangle> triangles;
    std::vector<std::vector<std::uint32_t>> tiles; // rows first; indices into triangles, ascending
    int columns = 0;
    int rows = 0;

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
