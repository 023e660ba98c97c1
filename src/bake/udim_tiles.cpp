// Which tiles of the texture coordinates a surface covers.
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "bake/bake_surfaces.hpp"
#include "bake/surface/uv_raster.hpp"

namespace cotan {

namespace {

constexpr int kRows = (kLastUdim - kFirstUdim) / kUdimColumns + 1; // the last one lacks its last tile
constexpr double kInset = 1e-4; // of a tile: triangles that only touch its border are not on it

struct Range {
    double from = std::numeric_limits<double>::infinity(), to = -from;

    void add(double x)
    {
        from = std::min(from, x);
        to = std::max(to, x);
    }
};

// The x of the part of a triangle between two heights.
Range betweenHeights(const glm::dvec2 (&triangle)[3], double low, double high)
{
    Range range;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec2 a = triangle[i], b = triangle[(i + 1) % 3];
        if (a.y >= low && a.y <= high)
            range.add(a.x);
        for (const double y : {low, high})
            if ((a.y < y) != (b.y < y))
                range.add(a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)));
    }
    return range;
}

} // namespace

std::vector<int> tilesOf(const LowSurface& low, std::size_t* outside)
{
    std::set<int> tiles;
    std::size_t away = 0;
    const auto add = [&](double column, double row) {
        if (column >= 0 && column < kUdimColumns && row >= 0 && row < kRows)
            if (const int tile = kFirstUdim + int(column) + kUdimColumns * int(row); tile <= kLastUdim)
                tiles.insert(tile);
    };
    glm::dvec2 corners[3];
    double area = 0;
    for (std::size_t f = 0; f < low.triangleCount(); ++f) {
        if (!cornersOf({low.texcoords, low.indices}, std::uint32_t(f), corners, area))
            continue;
        Range x, y;
        for (glm::dvec2& corner : corners) {
            corner.y = 1 - corner.y; // tiles are numbered upwards
            x.add(corner.x);
            y.add(corner.y);
        }
        if (x.from < -kInset || y.from < -kInset || x.to > kUdimColumns + kInset || y.to > kRows + kInset)
            ++away;
        const glm::dvec2 middle = (corners[0] + corners[1] + corners[2]) / 3.0; // for triangles thinner than the inset
        add(std::floor(middle.x), std::floor(middle.y));
        const double lastRow = std::min(std::floor(y.to - kInset), kRows - 1.0);
        for (double row = std::max(std::floor(y.from + kInset), 0.0); row <= lastRow; ++row) {
            const Range part = betweenHeights(corners, row + kInset, row + 1 - kInset);
            const double lastColumn = std::min(std::floor(part.to - kInset), kUdimColumns - 1.0);
            for (double column = std::max(std::floor(part.from + kInset), 0.0); column <= lastColumn; ++column)
                add(column, row);
        }
    }
    if (outside)
        *outside = away;
    return {tiles.begin(), tiles.end()};
}

} // namespace cotan
