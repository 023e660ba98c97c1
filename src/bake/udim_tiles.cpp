// Which tiles of the texture coordinates a surface covers.
#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "bake/bake_surfaces.hpp"

namespace cotan {

namespace {

constexpr int kColumns = 10, kRows = 100; // numbers from 1001 to 1999, and 2000, which is none
constexpr float kInset = 1e-4f;           // of a tile: triangles that only touch its border are not on it
constexpr float kFarthestDrawn = 1e6f;    // as for UvRaster, which draws no others

// Whether a triangle overlaps a square: no line along a side of either separates them.
bool overlap(const std::array<glm::vec2, 3>& triangle, glm::vec2 low, glm::vec2 high)
{
    const glm::vec2 corners[] = {low, {high.x, low.y}, high, {low.x, high.y}};
    const auto separates = [&](glm::vec2 axis) {
        float from = 1e30f, to = -1e30f, squareFrom = 1e30f, squareTo = -1e30f;
        for (const glm::vec2 p : triangle) {
            from = std::min(from, glm::dot(axis, p));
            to = std::max(to, glm::dot(axis, p));
        }
        for (const glm::vec2 p : corners) {
            squareFrom = std::min(squareFrom, glm::dot(axis, p));
            squareTo = std::max(squareTo, glm::dot(axis, p));
        }
        return to <= squareFrom || squareTo <= from;
    };
    for (std::size_t i = 0; i < 3; ++i)
        if (const glm::vec2 side = triangle[(i + 1) % 3] - triangle[i]; separates({-side.y, side.x}))
            return false;
    return !separates({1, 0}) && !separates({0, 1});
}

} // namespace

std::vector<int> tilesOf(const LowSurface& low, std::size_t* outside)
{
    std::set<int> tiles;
    std::size_t away = 0;
    for (std::size_t f = 0; f < low.triangleCount(); ++f) {
        std::array<glm::vec2, 3> corners;
        bool usable = true;
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::vec2 uv = low.texcoords[low.indices[3 * f + k]];
            usable = usable && std::abs(uv.x) <= kFarthestDrawn && std::abs(uv.y) <= kFarthestDrawn;
            corners[k] = {uv.x, 1 - uv.y}; // tiles are numbered upwards
        }
        const glm::dvec2 side1 = glm::dvec2(corners[1]) - glm::dvec2(corners[0]);
        const glm::dvec2 side2 = glm::dvec2(corners[2]) - glm::dvec2(corners[0]);
        if (!usable || side1.x * side2.y - side1.y * side2.x == 0)
            continue;
        const glm::vec2 from = glm::min(glm::min(corners[0], corners[1]), corners[2]) + kInset;
        const glm::vec2 to = glm::max(glm::max(corners[0], corners[1]), corners[2]) - kInset;
        if (from.x < 0 || from.y < 0 || to.x > kColumns || to.y > kRows)
            ++away;
        const auto add = [&](int column, int row) {
            if (const int tile = 1001 + column + kColumns * row;
                column >= 0 && column < kColumns && row >= 0 && row < kRows && tile < 2000)
                tiles.insert(tile);
        };
        if (from.x < to.x && from.y < to.y) {
            const glm::ivec2 first(glm::clamp(glm::floor(from), glm::vec2(0), glm::vec2(kColumns, kRows)));
            const glm::ivec2 last(glm::clamp(glm::floor(to), glm::vec2(-1), glm::vec2(kColumns - 1, kRows - 1)));
            for (int row = first.y; row <= last.y; ++row)
                for (int column = first.x; column <= last.x; ++column)
                    if (overlap(corners, glm::vec2(column, row) + kInset, glm::vec2(column + 1, row + 1) - kInset))
                        add(column, row);
        }
        const glm::vec2 middle = glm::floor((corners[0] + corners[1] + corners[2]) / 3.0f); // of thin ones too
        add(int(middle.x), int(middle.y));
    }
    if (outside)
        *outside = away;
    return {tiles.begin(), tiles.end()};
}

} // namespace cotan
