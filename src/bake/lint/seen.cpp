// Finds the visible points of a surface, by depth buffers from the faces and corners of a cube.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <mutex>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "core/loops.hpp"
#include "lint_parts.hpp"

namespace cotan::lint {

namespace {

constexpr std::size_t kDirectionCount = 14, kMaxSide = 512, kMinSide = 16; // depth buffers, and their sides in pixels
constexpr double kMinCosine = 0.05;                                        // grazing faces show next to nothing
constexpr std::size_t kFewTriangles = 100'000;

struct DepthBuffer {
    glm::dvec3 across, up, toEye; // unit, perpendicular to one another
    glm::dvec3 middle;
    double pixel = 1;
    std::size_t side = 0;
    std::vector<float> depth; // from the middle; larger is nearer

    // x and y in pixels, the depth in units of the surface.
    glm::dvec3 projected(glm::dvec3 p) const
    {
        const double half = 0.5 * double(side);
        p -= middle;
        return {glm::dot(p, across) / pixel + half, glm::dot(p, up) / pixel + half, glm::dot(p, toEye)};
    }
    std::size_t at(double x, double y) const
    {
        const auto cell = [&](double c) { return std::size_t(std::clamp(c, 0.0, double(side - 1))); };
        return cell(y) * side + cell(x);
    }
    void put(double x, double y, double z)
    {
        float& d = depth[at(x, y)];
        d = std::max(d, float(z));
    }
};

// The normal of a face on the side of its vertices' normals; zero without area.
glm::dvec3 outwardNormal(const MappedSurface& s, std::size_t triangle)
{
    const std::size_t a = 3 * triangle;
    const TriangleEdges edges = edgesOf(s, triangle);
    const glm::dvec3 n = glm::cross(edges.p1, edges.p2);
    const double length = glm::length(n);
    if (!(length > 0))
        return glm::dvec3(0);
    return (glm::dot(n, s.normal(a) + s.normal(a + 1) + s.normal(a + 2)) < 0 ? -n : n) / length;
}

DepthBuffer depthBufferFrom(glm::dvec3 toEye, glm::dvec3 middle, double radius, std::size_t side)
{
    toEye = glm::normalize(toEye);
    const glm::dvec3 other = std::abs(toEye.y) > 0.8 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
    const glm::dvec3 across = glm::normalize(glm::cross(other, toEye)), up = glm::cross(toEye, across);
    const float nothing = -std::numeric_limits<float>::infinity();
    return {across, up, toEye, middle, 2 * radius / double(side), side, std::vector<float>(side * side, nothing)};
}

// Directions to the faces and the corners of a cube.
std::vector<glm::dvec3> directionsAround()
{
    std::vector<glm::dvec3> directions;
    directions.reserve(kDirectionCount);
    for (int i = 0; i < 27; ++i) {
        const glm::dvec3 direction(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
        if (const double squared = glm::dot(direction, direction); squared != 1 && squared != 3)
            continue; // the edges and the centre of the cube
        // Slightly askew, so that no wall of a house is seen exactly edge-on.
        directions.push_back(direction + glm::dvec3(0.05, 0.03, -0.04));
    }
    return directions;
}

// Draws all pixels whose centres the triangle covers, and the one that contains its middle.
void draw(const std::array<glm::dvec3, 3>& corners, DepthBuffer& buffer)
{
    const glm::dvec3 a = buffer.projected(corners[0]), b = buffer.projected(corners[1]),
                     c = buffer.projected(corners[2]);
    const glm::dvec3 middle = (a + b + c) / 3.0, ab = b - a, ac = c - a;
    buffer.put(middle.x, middle.y, middle.z);
    const double area = ab.x * ac.y - ab.y * ac.x;
    if (area == 0 || !std::isfinite(area))
        return;
    // The barycentric coordinates of b and c grow by x and y of these per pixel, that of a by what is left.
    const glm::dvec2 ofB = glm::dvec2(ac.y, -ac.x) / area, ofC = glm::dvec2(-ab.y, ab.x) / area, ofA = -ofB - ofC;
    const double slope = ofB.x * ab.z + ofC.x * ac.z; // of the depth along a row
    const auto first = [](double x, double y, double z) { return std::ceil(std::min({x, y, z}) - 0.5) + 0.5; };
    const double left = first(a.x, b.x, c.x), right = std::max({a.x, b.x, c.x}), top = std::max({a.y, b.y, c.y});
    for (double y = first(a.y, b.y, c.y); y <= top; ++y) {
        const double b0 = (left - a.x) * ofB.x + (y - a.y) * ofB.y, c0 = (left - a.x) * ofC.x + (y - a.y) * ofC.y;
        double begin = 0, end = right - left; // pixels from `left`
        for (const auto& [atLeft, growth] : {std::pair(b0, ofB.x), {c0, ofC.x}, {1 - b0 - c0, ofA.x}}) {
            if (growth > 0)
                begin = std::max(begin, std::ceil(-atLeft / growth));
            else if (growth < 0)
                end = std::min(end, -atLeft / growth);
            else if (atLeft < 0)
                end = -1;
        }
        for (double x = begin; x <= end; ++x)
            buffer.put(left + x, y, a.z + b0 * ab.z + c0 * ac.z + x * slope);
    }
}

// Eight pixels per point along each axis; fewer if hundreds of triangles overlap, so that drawing them stays within
// maxPixels. area: of all triangles.
std::size_t sideFor(std::size_t points, double area, double radius, double maxPixels)
{
    const double wanted = 8 * std::sqrt(double(points));
    const double drawn = 2 * double(kDirectionCount) * area / (4 * radius * radius); // pixels of boxes at side 1
    const double side = std::min(wanted, std::sqrt(maxPixels / drawn));
    return std::size_t(std::clamp(side, double(kMinSide), double(kMaxSide)));
}

// Whether a point is visible. The slack allows for the range of depths of an inclined face in a pixel.
bool isVisible(const DepthBuffer& buffer, glm::dvec3 position, double cosine)
{
    const glm::dvec3 p = buffer.projected(position);
    const double slack = buffer.pixel * 0.6 * (1 + std::sqrt(1 - std::min(cosine * cosine, 1.0)) / cosine);
    return p.z >= buffer.depth[buffer.at(p.x, p.y)] - slack;
}

} // namespace

std::vector<double> visibility(const MappedSurface& s, const std::vector<MeshPoint>& points, bool bothSides,
                               double maxPixels)
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
    const glm::dvec3 middle = (low + high) / 2.0;
    const std::size_t side = sideFor(points.size(), area, radius, maxPixels);
    const std::vector<glm::dvec3> directions = directionsAround();
    const auto cosineOf = [&](glm::dvec3 face, const DepthBuffer& buffer) {
        const double cosine = glm::dot(face, buffer.toEye);
        return bothSides ? std::abs(cosine) : cosine;
    };
    std::mutex mutex;
    const auto look = [&](std::size_t begin, std::size_t end) { // from these directions
        std::vector<DepthBuffer> buffers;
        for (std::size_t i = begin; i < end; ++i)
            buffers.push_back(depthBufferFrom(directions[i], middle, radius, side));
        for (std::size_t f = 0; f < s.triangleCount(); ++f) {
            const glm::dvec3 face = outwardNormal(s, f);
            const std::array<glm::dvec3, 3> corners{s.position(3 * f), s.position(3 * f + 1), s.position(3 * f + 2)};
            for (DepthBuffer& buffer : buffers)
                if (cosineOf(face, buffer) > 0)
                    draw(corners, buffer);
        }
        std::vector<std::uint8_t> seen(points.size(), 0);
        for (std::size_t k = 0; k < points.size(); ++k) {
            const std::size_t a = 3 * points[k].triangle;
            const glm::dvec3 face = outwardNormal(s, points[k].triangle), by = points[k].barycentric;
            const glm::dvec3 position = s.position(a) * by.x + s.position(a + 1) * by.y + s.position(a + 2) * by.z;
            for (const DepthBuffer& buffer : buffers)
                if (const double cosine = cosineOf(face, buffer);
                    cosine > kMinCosine && isVisible(buffer, position, cosine))
                    ++seen[k];
        }
        const std::lock_guard lock(mutex);
        for (std::size_t k = 0; k < points.size(); ++k)
            weights[k] += seen[k];
    };
    // Few triangles are gone through once for each direction, so that a buffer stays in the processor's cache; many
    // once for all directions of a thread.
    const std::size_t threads = std::min(threadsFor(points.size(), 1000), kDirectionCount);
    const std::size_t parts = s.triangleCount() < kFewTriangles ? kDirectionCount : threads;
    runTasks(parts, threads, [&](std::size_t i) {
        look(partBegin(kDirectionCount, i, parts), partBegin(kDirectionCount, i + 1, parts));
    });
    if (std::all_of(weights.begin(), weights.end(), [](double w) { return w == 0; }))
        std::fill(weights.begin(), weights.end(), 1); // inside out, or hidden by itself: all points count alike
    return weights;
}

} // namespace cotan::lint
