// Which places of all surfaces show a texel of their map.
#pragma once

#include <cstdint>
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

    // The places of row y for each of its texels, in the order of the uses and triangles: those that cover the centre,
    // or else those that only touch the texel; no more than kMaxPlaces (kMaxAllPlaces), spread over all. From several
    // threads.
    void row(int y, std::vector<std::vector<Place>>& texels) const;

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
    void findRow(const Layer& layer, int y, std::vector<std::vector<Found>>& texels) const;

    std::span<const MapUse> uses_;
    int width_, height_;
    std::size_t most_; // of a texel
    std::vector<Layer> layers_;
};

} // namespace cotan::convert
