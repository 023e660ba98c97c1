// Finds the surface points that show each texel of a map.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "bake/convert/reencode.hpp"
#include "bake/surface/uv_raster.hpp"

namespace cotan::convert {

// A surface point that shows a texel.
struct SurfacePoint {
    std::uint32_t use = 0, triangle = 0;
    glm::dvec3 barycentric{1, 0, 0};
    bool covers = false; // covers the texel's centre; otherwise the triangle only touches the texel
};

// Rasterises all uses of a map. A mirrored axis is rasterised at twice the size and folded; along a clamped axis,
// everything outside the image shows only the border and is left out. Uses of one surface are rasterised once; uses
// that flatten the map are left out. The uses must outlive it.
class PointFinder {
public:
    PointFinder(std::span<const MapUse> uses, int width, int height);

    // Calls work(y, row) for each row y from `first` to `last`, with the points of each texel in the order of the uses:
    // those that cover the centre, otherwise those that only touch the texel; at most kMaxPointsPerTexel
    // (kMaxPointsPerMap), evenly chosen. May be called from several threads; a block of rows takes little longer than
    // one row.
    using RowWork = std::function<void(int y, const SamplesOfRow<SurfacePoint>& row)>;
    void rows(int first, int last, const RowWork& work) const;

private:
    struct Part { // a surface among the triangles of a layer
        std::size_t firstTriangle = 0;
        std::vector<std::uint32_t> uses;
    };
    struct Layer { // surfaces that wrap the map in the same way
        Wrap wrapU = Wrap::repeat, wrapV = Wrap::repeat;
        std::vector<Part> parts;
        std::vector<glm::vec2> texcoords;
        std::vector<std::uint32_t> indices;
        std::optional<UvRaster> raster; // of these triangles
    };
    struct Found { // a point for all uses of a part
        const Part* part = nullptr;
        std::uint32_t order = 0; // order of discovery
        SurfacePoint point;
    };

    void addTo(Layer& layer, std::uint32_t use);
    UvLimits limitsOf(const Layer& layer) const;
    // Appends what the raster of a layer found in a texel's column, and in the column that mirrors it.
    void addFound(const Layer& layer, const UvRow& row, int x, std::vector<Found>& found) const;
    void choose(std::vector<Found>& found, std::vector<SurfacePoint>& points) const;

    std::span<const MapUse> uses_;
    int width_, height_;
    std::size_t maxPerTexel_;
    std::vector<Layer> layers_;
};

} // namespace cotan::convert
