// Which places of a surface show a texel of its map.
#pragma once

#include <cstdint>
#include <vector>

#include "cotan/convert/reencode.hpp"
#include "cotan/surface/uv_raster.hpp"

namespace cotan::convert {

// A place of a texel on one of the surfaces.
struct Place {
    std::uint32_t use = 0, triangle = 0;
    glm::dvec3 barycentric{1, 0, 0};
    bool covers = false; // the texel's centre; otherwise the triangle only touches the texel
};

// The texels of one use. A mirrored axis is drawn at twice the size and folded; along a clamped one, what
// lies outside the image shows the border only and is left out. The use must outlive it.
class UseRaster {
public:
    UseRaster(const MapUse& use, int width, int height);

    // Appends the places of row y to the lists of its texels, with the use's number.
    void addRow(int y, std::uint32_t number, std::vector<std::vector<Place>>& texels) const;

private:
    bool clampedAway(const Place& p) const;

    const MapUse* use_;
    int foldU_, foldV_, width_, height_;
    UvRaster raster_;
};

} // namespace cotan::convert
