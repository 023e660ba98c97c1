// Finds the visible points of a surface, by depth buffers from the faces and corners of a cube.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <glm/geometric.hpp>

#include "lint_parts.hpp"

namespace cotan::lint {

namespace {

constexpr std::size_t kDirectionCount = 14, kMaxSide = 512, kMinSide = 16; // depth buffers, and their sides in pixels
constexpr double kMinCosine = 0.05;                                        // grazing faces show next to nothing

struct DepthBuffer {
    glm::dvec3 across, up, toEye; // unit, perpendicular to one another
    glm::dvec2 low;
    double pixel = 1;
    std::size_t side = 0;
    std::vector<double> depth; // larger is nearer

    // x and y in pixels, the depth in units of the surface.
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
    const glm::dvec2 low = glm::dvec2(glm::dot(middle, across), glm::dot(middle, up)) - radius;
    const double nothing = -std::numeric_limits<double>::infinity();
    return {across, up, toEye, low, 2 * radius / double(side), side, std::vector<double>(side * side, nothing)};
}

// Depth buffers from the faces and the corners of a cube.
std::vector<DepthBuffer> depthBuffersAround(glm::dvec3 middle, double radius, std::size_t side)
{
    std::vector<DepthBuffer> buffers;
    buffers.reserve(kDirectionCount);
    for (int i = 0; i < 27; ++i) {
        const glm::dvec3 direction(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
        if (const double squared = glm::dot(direction, direction); squared != 1 && squared != 3)
            continue; // the edges and the centre of the cube
        // Slightly askew, so that no wall of a house is seen exactly edge-on.
        buffers.push_back(depthBufferFrom(direction + glm::dvec3(0.05, 0.03, -0.04), middle, radius, side));
    }
    return buffers;
}

// Draws all pixels whose centres the triangle covers, and the one that contains its middle.
void draw(const std::array<glm::dvec3, 3>& corners, DepthBuffer& buffer)
{
    const glm::dvec3 a = buffer.projected(corners[0]), b = buffer.projected(corners[1]),
                     c = buffer.projected(corners[2]);
    const glm::dvec3 middle = (a + b + c) / 3.0;
    buffer.put(middle.x, middle.y, middle.z);
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
                buffer.put(x, y, a.z + wb * (b.z - a.z) + wc * (c.z - a.z));
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
    std::vector<DepthBuffer> buffers =
        depthBuffersAround((low + high) / 2.0, radius, sideFor(points.size(), area, radius, maxPixels));
    const auto cosineOf = [&](glm::dvec3 face, const DepthBuffer& buffer) {
        const double cosine = glm::dot(face, buffer.toEye);
        return bothSides ? std::abs(cosine) : cosine;
    };
    for (std::size_t f = 0; f < s.triangleCount(); ++f) { // into all buffers at once, so that triangles are not stored
        const glm::dvec3 face = outwardNormal(s, f);
        const std::array<glm::dvec3, 3> corners{s.position(3 * f), s.position(3 * f + 1), s.position(3 * f + 2)};
        for (DepthBuffer& buffer : buffers)
            if (cosineOf(face, buffer) > 0)
                draw(corners, buffer);
    }
    for (std::size_t k = 0; k < points.size(); ++k) {
        const std::size_t a = 3 * points[k].triangle;
        const glm::dvec3 face = outwardNormal(s, points[k].triangle), by = points[k].barycentric;
        const glm::dvec3 position = s.position(a) * by.x + s.position(a + 1) * by.y + s.position(a + 2) * by.z;
        for (const DepthBuffer& buffer : buffers)
            if (const double cosine = cosineOf(face, buffer); cosine > kMinCosine)
                weights[k] += isVisible(buffer, position, cosine) ? 1 : 0;
    }
    if (std::all_of(weights.begin(), weights.end(), [](double w) { return w == 0; }))
        std::fill(weights.begin(), weights.end(), 1); // inside out, or hidden by itself: all points count alike
    return weights;
}

} // namespace cotan::lint
