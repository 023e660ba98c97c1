// Which places of all surfaces show a texel of their map.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "bake/convert/reencode.hpp"
#include "bake/surface/uv_raster.hpp"

namespace cotan::convert {

// A place of a texel on one of the surfaces.
struct Place {
    std::uint32_t use = 0, triangle = 0;
    glm::dvec3 barycentric{1, 0, 0};
    bool covers = false; // the texel's centre; otherwise the triangle only touches the texel
};

// The texels of all uses of a map. A mirrored axis is drawn at twice the size and folded; along a clamped one, what
// lies outside the image shows the border only and is left out. Uses of one surface are drawn once; uses that flatten
// the map are left out. The uses must outlive it.
class PlaceFinder {
public:
    PlaceFinder(std::span<const MapUse> uses, int width, int height);

    // Calls work(y, row) for each row y from `first` to `last`, with the places of each of its texels in the order of
    // the uses: those that cover the centre, or else those that only touch the texel; at most kMaxPlaces
    // (kMaxAllPlaces), spread over all. For several threads; a block of rows takes little longer than one row.
    using RowWork = std::function<void(int y, const PlacesOfRow<Place>& row)>;
    void rows(int first, int last, const RowWork& work) const;

private:
    struct Part { // a surface among the triangles of a layer
        std::size_t firstTriangle = 0;
        std::vector<std::uint32_t> uses;
    };
    struct Layer { // surfaces that repeat the map in the same way
        Wrap wrapU = Wrap::repeat, wrapV = Wrap::repeat;
        std::vector<Part> parts;
        std::vector<glm::vec2> texcoords;
        std::vector<std::uint32_t> indices;
        std::optional<UvRaster> raster; // of these triangles
    };
    struct Found { // a place for all uses of a part
        const Part* part = nullptr;
        std::uint32_t order = 0; // among those of the part
        Place place;
    };

    void addTo(Layer& layer, std::uint32_t use);
    UvFew wantedOf(const Layer& layer) const;
    // What the raster of a layer found in a row of a texel's column, and in the column that mirrors it.
    void addFound(const Layer& layer, const UvRow& row, int x, std::vector<Found>& found) const;
    void choose(std::vector<Found>& found, std::vector<Place>& places) const;

    std::span<const MapUse> uses_;
    int width_, height_;
    std::size_t most_; // of a texel
    std::vector<Layer> layers_;
};

} // namespace cotan::convert
