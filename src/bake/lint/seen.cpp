// Which points of a surface can be seen: depth pictures of it from the faces and corners of a cube.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <glm/geometric.hpp>

#include "lint_parts.hpp"

namespace cotan::lint {

namespace {

constexpr std::size_t kWays = 14, kMaxSide = 512, kMinSide = 16; // depth pictures, and their pixels
constexpr double kMinCosine = 0.05;                              // flatter faces show next to nothing

struct DepthPicture {
    glm::dvec3 across, up, toEye; // unit, at right angles
    glm::dvec2 low;
    double pixel = 1;
    std::size_t side = 0;
    std::vector<double> depth; // largest: nearest

    // In pixels, with the depth in units of the surface.
    glm::dvec3 projected(glm::dvec3 p) const
    {
        return {(glm::dot(p, across) - low.x) / pixel, (glm::dot(p, up) - low.y) / pixel, glm::dot(p, toEye)};
    }
    std::size_t at(double x, double y) const
    {
        const auto cell = [&](double c) { return std::size_t(std::clamp(c, 0.0, double(side - 1))); };
        return cell(y) * side + cell(x);
    }
    void put(double x, double y, double z)
    {
        double& d = depth[at(x, y)];
        d = std::max(d, z);
    }
};

// The normal of a face on the side that its vertices' normals are on; zero without area.
glm::dvec3 outwards(const MappedSurface& s, std::size_t triangle)
{
    const std::size_t a = 3 * triangle;
    const TriangleEdges edges = edgesOf(s, triangle);
    const glm::dvec3 n = glm::cross(edges.p1, edges.p2);
    const double length = glm::length(n);
    if (!(length > 0))
        return glm::dvec3(0);
    return (glm::dot(n, s.normal(a) + s.normal(a + 1) + s.normal(a + 2)) < 0 ? -n : n) / length;
}

DepthPicture pictureFrom(glm::dvec3 toEye, glm::dvec3 middle, double radius, std::size_t side)
{
    toEye = glm::normalize(toEye);
    const glm::dvec3 other = std::abs(toEye.y) > 0.8 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
    const glm::dvec3 across = glm::normalize(glm::cross(other, toEye)), up = glm::cross(toEye, across);
    const glm::dvec2 low = glm::dvec2(glm::dot(middle, across), glm::dot(middle, up)) - radius;
    const double nothing = -std::numeric_limits<double>::infinity();
    return {across, up, toEye, low, 2 * radius / double(side), side, std::vector<double>(side * side, nothing)};
}

// From the faces and the corners of a cube.
std::vector<DepthPicture> picturesAround(glm::dvec3 middle, double radius, std::size_t side)
{
    std::vector<DepthPicture> pictures;
    pictures.reserve(kWays);
    for (int i = 0; i < 27; ++i) {
        const glm::dvec3 way(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
        if (const double squared = glm::dot(way, way); squared != 1 && squared != 3)
            continue; // the edges of the cube
        // A little askew, so that no wall of a house is seen exactly from its edge.
        pictures.push_back(pictureFrom(way + glm::dvec3(0.05, 0.03, -0.04), middle, radius, side));
    }
    return pictures;
}

// All pixels whose centres the triangle covers, and the one that its middle is in.
void draw(const std::array<glm::dvec3, 3>& corners, DepthPicture& picture)
{
    const glm::dvec3 a = picture.projected(corners[0]), b = picture.projected(corners[1]),
                     c = picture.projected(corners[2]);
    const glm::dvec3 middle = (a + b + c) / 3.0;
    picture.put(middle.x, middle.y, middle.z);
    const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (area == 0 || !std::isfinite(area))
        return;
    const auto first = [](double x, double y, double z) { return std::ceil(std::min({x, y, z}) - 0.5) + 0.5; };
    const double right = std::max({a.x, b.x, c.x}), top = std::max({a.y, b.y, c.y});
    for (double y = first(a.y, b.y, c.y); y <= top; ++y)
        for (double x = first(a.x, b.x, c.x); x <= right; ++x) {
            const double wb = ((x - a.x) * (c.y - a.y) - (y - a.y) * (c.x - a.x)) / area;
            const double wc = ((b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x)) / area;
            if (wb >= 0 && wc >= 0 && wb + wc <= 1)
                picture.put(x, y, a.z + wb * (b.z - a.z) + wc * (c.z - a.z));
        }
}

// Eight pixels for a point along each axis; fewer where triangles lie on one another by the hundred, so that drawing
// them stays within maxPixels. area: of all triangles.
std::size_t sideFor(std::size_t points, double area, double radius, double maxPixels)
{
    const double wanted = 8 * std::sqrt(double(points));
    const double drawn = 2 * double(kWays) * area / (4 * radius * radius); // pixels of their boxes at side 1
    const double side = std::min(wanted, std::sqrt(maxPixels / drawn));
    return std::size_t(std::clamp(side, double(kMinSide), double(kMaxSide)));
}

// A face that leans meets several depths in a pixel.
bool shows(const DepthPicture& picture, glm::dvec3 position, double cosine)
{
    const glm::dvec3 p = picture.projected(position);
    const double slack = picture.pixel * 0.6 * (1 + std::sqrt(1 - std::min(cosine * cosine, 1.0)) / cosine);
    return p.z >= picture.depth[picture.at(p.x, p.y)] - slack;
}

} // namespace

std::vector<double> seen(const MappedSurface& s, const std::vector<MeshPoint>& points, bool bothSides, double maxPixels)
{
    std::vector<double> weights(points.size(), 0);
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
    double area = 0;
    for (std::size_t f = 0; f < s.triangleCount(); ++f)
        area += areaOf(s, f);
    for (std::size_t corner = 0; corner < 3 * s.triangleCount(); ++corner) {
        const glm::dvec3 p = s.position(corner);
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const double radius = glm::length(high - low) / 2 * 1.01;
    if (!(radius > 0) || !std::isfinite(radius))
        return std::vector<double>(points.size(), 1);
    std::vector<DepthPicture> pictures =
        picturesAround((low + high) / 2.0, radius, sideFor(points.size(), area, radius, maxPixels));
    const auto cosineOf = [&](glm::dvec3 face, const DepthPicture& picture) {
        const double cosine = glm::dot(face, picture.toEye);
        return bothSides ? std::abs(cosine) : cosine;
    };
    for (std::size_t f = 0; f < s.triangleCount(); ++f) { // into all pictures at once, so that nothing is kept of it
        const glm::dvec3 face = outwards(s, f);
        const std::array<glm::dvec3, 3> corners{s.position(3 * f), s.position(3 * f + 1), s.position(3 * f + 2)};
        for (DepthPicture& picture : pictures)
            if (cosineOf(face, picture) > 0)
                draw(corners, picture);
    }
    for (std::size_t k = 0; k < points.size(); ++k) {
        const std::size_t a = 3 * points[k].triangle;
        const glm::dvec3 face = outwards(s, points[k].triangle), by = points[k].barycentric;
        const glm::dvec3 position = s.position(a) * by.x + s.position(a + 1) * by.y + s.position(a + 2) * by.z;
        for (const DepthPicture& picture : pictures)
            if (const double cosine = cosineOf(face, picture); cosine > kMinCosine)
                weights[k] += shows(picture, position, cosine) ? 1 : 0;
    }
    if (std::all_of(weights.begin(), weights.end(), [](double w) { return w == 0; }))
        std::fill(weights.begin(), weights.end(), 1); // inside out, or hidden in itself: all of it counts alike
    return weights;
}

} // namespace cotan::lint
