#include <algorithm>
#include <array>
#include <cmath>

#include "parts.hpp"

namespace cotan::lint {

namespace {

// Further out than this, uv are taken for a mistake and not drawn.
constexpr double kFarthest = 1e6;
// Texels that may be visited in all, by bounding boxes.
constexpr double kWork = 2e8;

// Twice the signed area of a, b, p, computed in the same order whichever way the edge is given, so
// that two triangles with a common edge agree on which one has a point.
double sideOf(glm::dvec2 a, glm::dvec2 b, glm::dvec2 p)
{
    const bool swapped = b.x < a.x || (b.x == a.x && b.y < a.y);
    if (swapped)
        std::swap(a, b);
    const double area = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
    return swapped ? -area : area;
}

// A point on an edge belongs to the triangle to the left of an upward or a leftward edge.
bool inside(double area, glm::dvec2 a, glm::dvec2 b)
{
    return area > 0 || (area == 0 && (b.y > a.y || (b.y == a.y && b.x < a.x)));
}

struct Box {
    double x0 = 0, y0 = 0, x1 = -1, y1 = -1; // texels, both ends included
    double cells() const { return std::max(x1 - x0 + 1, 0.0) * std::max(y1 - y0 + 1, 0.0); }
};

using Corners = std::array<glm::dvec2, 3>;

// A triangle in texels, anticlockwise; false if it is not to be drawn.
bool cornersOf(const MappedSurface& s, std::size_t triangle, int side, Corners& c)
{
    for (std::size_t k = 0; k < 3; ++k) {
        c[k] = s.uv[3 * triangle + k] * double(side);
        if (!(std::abs(c[k].x) <= kFarthest * side && std::abs(c[k].y) <= kFarthest * side))
            return false;
    }
    const double area = (c[1].x - c[0].x) * (c[2].y - c[0].y) - (c[1].y - c[0].y) * (c[2].x - c[0].x);
    if (area < 0)
        std::swap(c[1], c[2]);
    return area != 0;
}

Box boxOf(const Corners& c)
{
    const glm::dvec2 low = glm::min(c[0], glm::min(c[1], c[2])), high = glm::max(c[0], glm::max(c[1], c[2]));
    return {std::ceil(low.x - 0.5), std::ceil(low.y - 0.5), std::floor(high.x - 0.5), std::floor(high.y - 0.5)};
}

// Calls use(texel) for every texel whose centre the triangle covers; the plane is tiled.
template<class Use> void cover(const MappedSurface& s, std::size_t triangle, int side, const Use& use)
{
    Corners c;
    if (!cornersOf(s, triangle, side, c))
        return;
    const Box box = boxOf(c);
    for (double y = box.y0; y <= box.y1; ++y)
        for (double x = box.x0; x <= box.x1; ++x) {
            const glm::dvec2 p(x + 0.5, y + 0.5);
            if (inside(sideOf(c[0], c[1], p), c[0], c[1]) && inside(sideOf(c[1], c[2], p), c[1], c[2])
                && inside(sideOf(c[2], c[0], p), c[2], c[0])) {
                const auto column = std::size_t(x - std::floor(x / side) * side);
                const auto row = std::size_t(y - std::floor(y / side) * side);
                use(row * std::size_t(side) + column);
            }
        }
}

int boundedSide(const std::vector<const MappedSurface*>& surfaces, int side)
{
    for (; side > 16; side /= 2) {
        double cells = 0;
        for (const MappedSurface* s : surfaces)
            for (std::size_t i = 0; i < s->uv.size() / 3; ++i) {
                Corners c;
                if (cornersOf(*s, i, side, c))
                    cells += boxOf(c).cells();
            }
        if (cells <= kWork)
            return side;
    }
    return 0; // hopeless: the uv repeat the image millions of times
}

// How often a texel is used, up to 3, by each orientation.
struct Uses {
    std::uint8_t plain = 0, mirrored = 0;
};

} // namespace

void countOverlaps(const std::vector<const MappedSurface*>& surfaces, const std::vector<UvQuality*>& qualities,
                   int side)
{
    side = boundedSide(surfaces, side);
    if (side == 0) {
        for (UvQuality* q : qualities)
            q->overlapping = 1;
        return;
    }
    std::vector<Uses> uses(std::size_t(side) * std::size_t(side));
    for (const MappedSurface* s : surfaces)
        for (std::size_t i = 0; i < s->uv.size() / 3; ++i) {
            const bool mirrored = orientationOf(*s, i) < 0;
            cover(*s, i, side, [&](std::size_t texel) {
                std::uint8_t& n = mirrored ? uses[texel].mirrored : uses[texel].plain;
                n = std::uint8_t(std::min(n + 1, 3));
            });
        }
    for (std::size_t k = 0; k < surfaces.size(); ++k) {
        double several = 0, both = 0;
        for (std::size_t i = 0; i < surfaces[k]->uv.size() / 3; ++i) {
            std::size_t texels = 0, shared = 0, turned = 0;
            cover(*surfaces[k], i, side, [&](std::size_t texel) {
                ++texels;
                shared += uses[texel].plain + uses[texel].mirrored > 1;
                turned += uses[texel].plain > 0 && uses[texel].mirrored > 0;
            });
            if (texels == 0)
                continue;
            const double perTexel = areaOf(*surfaces[k], i) / double(texels);
            several += perTexel * double(shared);
            both += perTexel * double(turned);
        }
        const double whole = qualities[k]->area > 0 ? qualities[k]->area : 1;
        qualities[k]->overlapping = several / whole;
        qualities[k]->overlappingMirrored = both / whole;
    }
}

} // namespace cotan::lint
