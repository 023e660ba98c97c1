#include <algorithm>
#include <functional>
#include <limits>

#include "lint_parts.hpp"

namespace cotan::lint {

namespace {

constexpr double kMaxRows = 1e7; // of texels under all triangles; where there are more the raster is coarser
constexpr int kCoarsest = 16;

// For each texel, whether its centre is covered more than once, and whether by both orientations; as sums along each
// row, so that a triangle asks once in each of its rows.
struct Covers {
    std::vector<std::uint32_t> shared, turned; // `width` a row: how many of the texels before it

    // begins: how many more triangles cover a texel than the one before it in its row: plain, mirrored.
    Covers(const std::vector<glm::ivec2>& begins, std::size_t width) : shared(begins.size()), turned(begins.size())
    {
        for (std::size_t start = 0; start < begins.size(); start += width) {
            glm::ivec2 n(0); // plain, mirrored
            for (std::size_t x = start; x + 1 < start + width; ++x) {
                n += begins[x];
                shared[x + 1] = shared[x] + (n.x + n.y > 1);
                turned[x + 1] = turned[x] + (n.x > 0 && n.y > 0);
            }
        }
    }
};

void eachSpan(const UvRaster& raster, const std::function<void(const UvSpan&)>& use)
{
    for (int block = 0; block < raster.blocks(); ++block)
        raster.eachSpan(block, use);
}

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
    const auto rowsAt = [&](int height) {
        double rows = 0;
        for (const MappedSurface* s : surfaces)
            rows += rowsUnder(*s, height);
        return rows;
    };
    while (side > kCoarsest && rowsAt(side) > kMaxRows)
        side /= 2;
    if (rowsAt(side) > kMaxRows) {
        for (UvQuality* q : qualities)
            q->overlapping = 1;
        return;
    }
    std::vector<UvRaster> rasters;
    const std::size_t width = std::size_t(side) + 1; // of a row of begins, one behind the last texel
    std::vector<glm::ivec2> begins(width * std::size_t(side));
    for (const MappedSurface* s : surfaces) {
        std::vector<bool> mirrored(s->triangleCount());
        for (std::size_t i = 0; i < mirrored.size(); ++i)
            mirrored[i] = orientationOf(*s, i) < 0;
        rasters.push_back(repeatedRaster(*s, side, side));
        eachSpan(rasters.back(), [&](const UvSpan& span) {
            glm::ivec2* const row = &begins[std::size_t(span.y) * width];
            ++row[span.first][mirrored[span.triangle]];
            --row[span.last + 1][mirrored[span.triangle]];
        });
    }
    const Covers covers(begins, width);
    for (std::size_t k = 0; k < surfaces.size(); ++k) {
        std::vector<Covered> triangles(surfaces[k]->triangleCount());
        eachSpan(rasters[k], [&](const UvSpan& span) {
            const std::size_t row = std::size_t(span.y) * width;
            const std::size_t first = row + std::size_t(span.first), after = row + std::size_t(span.last) + 1;
            Covered& c = triangles[span.triangle];
            c.texels += std::uint32_t(after - first);
            c.shared += covers.shared[after] - covers.shared[first];
            c.turned += covers.turned[after] - covers.turned[first];
        });
        addOverlaps(*surfaces[k], triangles, *qualities[k]);
    }
}

} // namespace cotan::lint
