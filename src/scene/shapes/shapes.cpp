#include "cotan/scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "grid.hpp"

namespace cotan {

namespace {

// Adds one row of vertices and returns the index of its first.
std::uint32_t appendRow(Mesh& mesh, const Grid& grid, const Surface& surface, int row, bool pole)
{
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const double v = double(row) / grid.cellsV;
    const int count = pole ? grid.cellsU : grid.cellsU + 1;
    for (int i = 0; i < count; ++i) {
        const double u = (i + (pole ? 0.5 : 0.0)) / grid.cellsU;
        const ShapePoint point = surface(u, v);
        mesh.positions.emplace_back(point.position);
        mesh.normals.emplace_back(point.normal);
        mesh.texcoords[0].emplace_back(float(u), float(v));
    }
    return first;
}

Mesh namedMesh(const char* name)
{
    Mesh mesh;
    mesh.name = name;
    return mesh;
}

// A flat square: `corner` is its top left, `right` and `down` its sides, seen from outside.
Surface flatSurface(glm::dvec3 corner, glm::dvec3 right, glm::dvec3 down)
{
    const glm::dvec3 normal = glm::normalize(glm::cross(down, right));
    return [=](double u, double v) { return ShapePoint{corner + right * u + down * v, normal}; };
}

// A planar curve with a radius, and their derivatives.
struct TubePoint {
    glm::dvec2 centre, centre1, centre2; // by v
    double radius, radius1;
};

// The tube's centre line is a cubic Bezier curve from the open tip (v = 0) down to the base.
TubePoint spoutCurve(double v)
{
    const glm::dvec2 p[4] = {{0.50, 0.95}, {0.22, 0.72}, {0.42, 0.22}, {-0.10, 0.12}};
    const double r[4] = {0.045, 0.06, 0.12, 0.24};
    const double w = 1 - v;
    const double b[4] = {w * w * w, 3 * w * w * v, 3 * w * v * v, v * v * v};
    const double b1[3] = {3 * w * w, 6 * w * v, 3 * v * v};
    TubePoint t{{0, 0}, {0, 0}, {0, 0}, 0, 0};
    for (int i = 0; i < 4; ++i) {
        t.centre += p[i] * b[i];
        t.radius += r[i] * b[i];
    }
    for (int i = 0; i < 3; ++i) {
        t.centre1 += (p[i + 1] - p[i]) * b1[i];
        t.radius1 += (r[i + 1] - r[i]) * b1[i];
    }
    for (int i = 0; i < 2; ++i)
        t.centre2 += (p[i + 2] - 2.0 * p[i + 1] + p[i]) * (6 * (i == 0 ? w : v));
    return t;
}

ShapePoint spoutPoint(double u, double v)
{
    const TubePoint c = spoutCurve(v);
    // The frame of the cross section: `side` in the plane of the curve, z across it.
    const double speed = glm::length(c.centre1);
    const glm::dvec2 along = c.centre1 / speed;
    const glm::dvec3 side{-along.y, along.x, 0};
    const glm::dvec2 along1 = (c.centre2 - along * glm::dot(along, c.centre2)) / speed;
    const glm::dvec3 side1{-along1.y, along1.x, 0};

    const double angle = turns(u);
    const glm::dvec3 radial = side * std::cos(angle) + glm::dvec3(0, 0, std::sin(angle));
    const glm::dvec3 around = side * -std::sin(angle) + glm::dvec3(0, 0, std::cos(angle));
    const glm::dvec3 down = glm::dvec3(c.centre1, 0) + radial * c.radius1 + side1 * (c.radius * std::cos(angle));
    return {glm::dvec3(c.centre, 0) + radial * c.radius, glm::normalize(glm::cross(down, around))};
}

} // namespace

void appendGrid(Mesh& mesh, const Grid& grid, const Surface& surface)
{
    std::uint32_t above = appendRow(mesh, grid, surface, 0, grid.poleTop);
    for (int row = 1; row <= grid.cellsV; ++row) {
        const bool poleAbove = row == 1 && grid.poleTop;
        const bool poleBelow = row == grid.cellsV && grid.poleBottom;
        const std::uint32_t below = appendRow(mesh, grid, surface, row, poleBelow);
        for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(grid.cellsU); ++i) {
            const std::uint32_t a = above + i, b = a + 1, d = below + i, c = d + 1;
            if (!poleBelow)
                mesh.indices.insert(mesh.indices.end(), {a, d, c});
            if (poleBelow)
                mesh.indices.insert(mesh.indices.end(), {a, d, b});
            else if (!poleAbove)
                mesh.indices.insert(mesh.indices.end(), {a, c, b});
        }
        above = below;
    }
}

void scaleTexcoords(Mesh& mesh, float u, float v)
{
    for (glm::vec2& uv : mesh.texcoords[0])
        uv = {uv.x * u, uv.y * v};
}

double turns(double x) { return 2 * std::numbers::pi * (x - std::floor(x)); }

Mesh makePlane(float side, int segments, float uvRepeat)
{
    segments = std::max(segments, 1);
    Mesh mesh = namedMesh("plane");
    const double s = side;
    appendGrid(mesh, {segments, segments}, flatSurface({-s / 2, 0, -s / 2}, {s, 0, 0}, {0, 0, s}));
    scaleTexcoords(mesh, uvRepeat, uvRepeat);
    return mesh;
}

Mesh makeCube(float side, float uvRepeat)
{
    const glm::dvec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
    const struct {
        glm::dvec3 out, right, down;
    } faces[6] = {
        {z, x, -y}, {x, -z, -y}, {-z, -x, -y}, {-x, z, -y}, {y, x, z}, {-y, x, -z},
    };
    Mesh mesh = namedMesh("cube");
    const double s = side;
    for (const auto& f : faces)
        appendGrid(mesh, {}, flatSurface((f.out - f.right - f.down) * (s / 2), f.right * s, f.down * s));
    scaleTexcoords(mesh, uvRepeat, uvRepeat);
    return mesh;
}

Mesh makeSphere(float radius, int segments)
{
    segments = std::max(segments, 3);
    Mesh mesh = namedMesh("sphere");
    const Grid grid{segments, std::max(segments / 2, 2), /*poleTop*/ true, /*poleBottom*/ true};
    appendGrid(mesh, grid, [radius](double u, double v) {
        const double longitude = turns(u + 0.5); // u = 1/2 faces +z
        const double colatitude = std::numbers::pi * v;
        // sin by the nearer pole, so that both poles are exactly on the axis
        const double ring = std::sin(std::numbers::pi * std::min(v, 1 - v));
        const glm::dvec3 n{ring * std::sin(longitude), std::cos(colatitude), ring * std::cos(longitude)};
        return ShapePoint{n * double(radius), n};
    });
    return mesh;
}

Mesh makeTorus(float majorRadius, float minorRadius, int segments, float repeatU, float repeatV)
{
    segments = std::max(segments, 3);
    Mesh mesh = namedMesh("torus");
    const Grid grid{segments, std::max(segments / 2, 3)};
    appendGrid(mesh, grid, [=](double u, double v) {
        const double around = turns(u + 0.5);
        const double section = turns(0.25 - v); // v = 0 on top, 1/4 outermost
        const glm::dvec3 out{std::sin(around), 0, std::cos(around)};
        const glm::dvec3 n = out * std::cos(section) + glm::dvec3(0, std::sin(section), 0);
        return ShapePoint{out * double(majorRadius) + n * double(minorRadius), n};
    });
    scaleTexcoords(mesh, repeatU, repeatV);
    return mesh;
}

Mesh makeSpout(int segments)
{
    segments = std::max(segments, 3);
    Mesh mesh = namedMesh("spout");
    appendGrid(mesh, {segments, segments}, spoutPoint);
    return mesh;
}

Mesh makePatch(float stretch, float shear, bool mirrored, int segments)
{
    segments = std::max(segments, 1);
    Mesh mesh = namedMesh("patch");
    appendGrid(mesh, {segments, segments}, flatSurface({-0.5, 0.5, 0}, {1, 0, 0}, {0, -1, 0}));
    // The grid's texcoords are p itself: rightwards and downwards from the top left corner.
    for (glm::vec2& p : mesh.texcoords[0]) {
        const float u = (p.x - shear * p.y) / stretch;
        p = {mirrored ? -u : u, p.y};
    }
    return mesh;
}

} // namespace cotan
