#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>

#include "parts.hpp"

namespace cotan::lint {

namespace {

constexpr double kMostCopies = 2e6; // of the image under all triangles together

// Calls use(texel, triangle) for every texel whose centre a triangle covers; uv repeat the image.
template<class Use> void forEachTexel(const UvRaster& raster, const Use& use)
{
    std::vector<std::pair<glm::ivec2, UvPlace>> covered;
    for (int block = 0; block < raster.blocks(); ++block) {
        raster.centres(block, covered);
        for (const auto& [texel, place] : covered)
            use(std::size_t(texel.y) * std::size_t(raster.width()) + std::size_t(texel.x), std::size_t(place.triangle));
    }
}

// How often a texel is used, up to 3, by each orientation.
struct Uses {
    std::uint8_t plain = 0, mirrored = 0;
};

struct Covered {
    std::uint32_t texels = 0, shared = 0, turned = 0;
};

void addOverlaps(const MappedSurface& s, const std::vector<Covered>& triangles, UvQuality& q)
{
    double several = 0, both = 0;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        if (triangles[i].texels == 0)
            continue;
        const double perTexel = areaOf(s, i) / double(triangles[i].texels);
        several += perTexel * double(triangles[i].shared);
        both += perTexel * double(triangles[i].turned);
    }
    const double whole = q.area > 0 ? q.area : std::numeric_limits<double>::quiet_NaN();
    q.overlapping = several / whole;
    q.overlappingMirrored = both / whole;
}

} // namespace

void countOverlaps(const std::vector<const MappedSurface*>& surfaces, const std::vector<UvQuality*>& qualities,
                   int side)
{
    if (std::ranges::all_of(surfaces, [](const MappedSurface* s) { return !s->hasUv(); }))
        return;
    double copies = 0;
    for (const MappedSurface* s : surfaces)
        copies += copiesUnder(*s);
    if (copies > kMostCopies) {
        for (UvQuality* q : qualities)
            q->overlapping = 1;
        return;
    }
    std::vector<UvRaster> rasters;
    std::vector<Uses> uses(std::size_t(side) * std::size_t(side));
    for (const MappedSurface* s : surfaces) {
        std::vector<bool> mirrored(s->triangleCount());
        for (std::size_t i = 0; i < mirrored.size(); ++i)
            mirrored[i] = orientationOf(*s, i) < 0;
        rasters.push_back(repeatedRaster(*s, side, side));
        forEachTexel(rasters.back(), [&](std::size_t texel, std::size_t triangle) {
            std::uint8_t& n = mirrored[triangle] ? uses[texel].mirrored : uses[texel].plain;
            n = std::uint8_t(std::min(n + 1, 3));
        });
    }
    for (std::size_t k = 0; k < surfaces.size(); ++k) {
        std::vector<Covered> triangles(surfaces[k]->triangleCount());
        forEachTexel(rasters[k], [&](std::size_t texel, std::size_t triangle) {
            Covered& c = triangles[triangle];
            ++c.texels;
            c.shared += uses[texel].plain + uses[texel].mirrored > 1;
            c.turned += uses[texel].plain > 0 && uses[texel].mirrored > 0;
        });
        addOverlaps(*surfaces[k], triangles, *qualities[k]);
    }
}

} // namespace cotan::lint
