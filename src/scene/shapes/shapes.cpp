// The built-in shapes, and scenes made of them.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <utility>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "cotan/scene.hpp"
#include "cotan/view.hpp"

namespace cotan {

namespace {

// ---- grids: a parametric surface over the unit square, tessellated ---------------------------

struct ShapePoint {
    glm::dvec3 position{0};
    glm::dvec3 normal{0, 0, 1}; // unit, outwards
};

// A point of the surface at (u,v) in the unit square. Seen from outside, u runs to the right and v down, so that
// triangles are counter-clockwise and images are not mirrored.
using Surface = std::function<ShapePoint(double u, double v)>;

struct Grid {
    int cellsU = 1;
    int cellsV = 1;
    bool poleTop = false;    // the edge v = 0 is one point
    bool poleBottom = false; // the edge v = 1 is one point
};

// Appends a row of vertices and returns the index of the first.
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

// Appends the tessellated surface to a mesh, with texcoords set 0 = (u,v). Cells share vertices. At a pole, each column
// of cells has one triangle with its own pole vertex, whose u is the middle of the column.
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

Mesh gridMesh(const char* name, const Grid& grid, const Surface& surface)
{
    Mesh mesh;
    mesh.name = name;
    appendGrid(mesh, grid, surface);
    return mesh;
}

// Scales texcoords set 0.
void scaleTexcoords(Mesh& mesh, float u, float v)
{
    for (glm::vec2& uv : mesh.texcoords[0])
        uv = {uv.x * u, uv.y * v};
}

// Converts x turns to radians in [0, 2 pi). Whole turns are removed exactly: ends of closed surfaces are bitwise equal.
double turnsToRadians(double x) { return 2 * std::numbers::pi * (x - std::floor(x)); }

// A flat parallelogram: `corner` is its top left, `right` and `down` are its sides, seen from outside.
Surface flatSurface(glm::dvec3 corner, glm::dvec3 right, glm::dvec3 down)
{
    const glm::dvec3 normal = glm::normalize(glm::cross(down, right));
    return [=](double u, double v) { return ShapePoint{corner + right * u + down * v, normal}; };
}

} // namespace

Mesh makePlane(float side, int segments, float uvRepeat)
{
    segments = std::max(segments, 1);
    const double s = side;
    Mesh mesh = gridMesh("plane", {segments, segments}, flatSurface({-s / 2, 0, -s / 2}, {s, 0, 0}, {0, 0, s}));
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
    Mesh mesh;
    mesh.name = "cube";
    const double s = side;
    for (const auto& f : faces)
        appendGrid(mesh, {}, flatSurface((f.out - f.right - f.down) * (s / 2), f.right * s, f.down * s));
    scaleTexcoords(mesh, uvRepeat, uvRepeat);
    return mesh;
}

Mesh makeSphere(float radius, int segments)
{
    segments = std::max(segments, 3);
    const Grid grid{segments, std::max(segments / 2, 2), /*poleTop*/ true, /*poleBottom*/ true};
    return gridMesh("sphere", grid, [radius](double u, double v) {
        const double longitude = turnsToRadians(u + 0.5); // u = 1/2 faces +z
        const double colatitude = std::numbers::pi * v;
        // sin from the nearer pole, so that both poles are exactly on the axis
        const double ring = std::sin(std::numbers::pi * std::min(v, 1 - v));
        const glm::dvec3 n{ring * std::sin(longitude), std::cos(colatitude), ring * std::cos(longitude)};
        return ShapePoint{n * double(radius), n};
    });
}

Mesh makeTorus(float majorRadius, float minorRadius, int segments, float repeatU, float repeatV)
{
    segments = std::max(segments, 3);
    const Grid grid{segments, std::max(segments / 2, 3)};
    Mesh mesh = gridMesh("torus", grid, [=](double u, double v) {
        const double around = turnsToRadians(u + 0.5);
        const double section = turnsToRadians(0.25 - v); // v = 0 on top, 1/4 outermost
        const glm::dvec3 out{std::sin(around), 0, std::cos(around)};
        const glm::dvec3 n = out * std::cos(section) + glm::dvec3(0, std::sin(section), 0);
        return ShapePoint{out * double(majorRadius) + n * double(minorRadius), n};
    });
    scaleTexcoords(mesh, repeatU, repeatV);
    return mesh;
}

Mesh makePatch(float stretch, float shear, bool mirrored, int segments)
{
    segments = std::max(segments, 1);
    Mesh mesh = gridMesh("patch", {segments, segments}, flatSurface({-0.5, 0.5, 0}, {1, 0, 0}, {0, -1, 0}));
    // The grid's texcoords are p itself: rightwards and downwards from the top left corner.
    for (glm::vec2& p : mesh.texcoords[0]) {
        const float u = (p.x - shear * p.y) / stretch;
        p = {mirrored ? -u : u, p.y};
    }
    return mesh;
}

// ---- the Utah teapot -------------------------------------------------------------------------

namespace {

// Control points: Martin Newell, University of Utah, 1975; public domain, in the version with lid gap and bottom that
// has circulated since 1991. z is up; the pot rests on z = 0.

constexpr double kOriginalHeight = 3.15;

// A row of control points on a quarter of a circle about z: (radius, 0), (radius, bend), (bend, radius), (0, radius).
struct Ring {
    double radius, bend, z;
};
using Rings = std::array<Ring, 4>;

// Down the pot: the rim, and its wall in two parts.
constexpr std::array<Rings, 3> kPot = {{
    {{{1.4, 0.784, 2.4}, {1.3375, 0.749, 2.53125}, {1.4375, 0.805, 2.53125}, {1.5, 0.84, 2.4}}},
    {{{1.5, 0.84, 2.4}, {1.75, 0.98, 1.875}, {2, 1.12, 1.35}, {2, 1.12, 0.9}}},
    {{{2, 1.12, 0.9}, {2, 1.12, 0.45}, {1.5, 0.84, 0.225}, {1.5, 0.84, 0.15}}},
}};
// The knob, and the rest of the lid.
constexpr std::array<Rings, 2> kLid = {{
    {{{0, 0, 3.15}, {0.8, 0.45, 3.15}, {0, 0, 2.85}, {0.2, 0.112, 2.7}}},
    {{{0.2, 0.112, 2.7}, {0.4, 0.224, 2.55}, {1.3, 0.728, 2.55}, {1.3, 0.728, 2.4}}},
}};
constexpr Rings kBottom = {{{0, 0, 0}, {1.425, 0.798, 0}, {1.5, 0.84, 0.075}, {1.5, 0.84, 0.15}}};

// A row of control points on half of an arc that is symmetric about y = 0: from (x0, z0) to (x1, z1), to y = -width.
struct Bow {
    double x0, z0, x1, z1, width;
};

// Along the handle and along the spout, in two parts each.
constexpr std::array<std::array<Bow, 4>, 4> kHandleAndSpout = {{
    {{{-1.6, 2.025, -1.5, 2.25, 0.3},
      {-2.3, 2.025, -2.5, 2.25, 0.3},
      {-2.7, 2.025, -3, 2.25, 0.3},
      {-2.7, 1.8, -3, 1.8, 0.3}}},
    {{{-2.7, 1.8, -3, 1.8, 0.3},
      {-2.7, 1.575, -3, 1.35, 0.3},
      {-2.5, 1.125, -2.65, 0.9375, 0.3},
      {-2, 0.9, -1.9, 0.6, 0.3}}},
    {{{1.7, 1.425, 1.7, 0.6, 0.66},
      {2.6, 1.425, 3.1, 0.825, 0.66},
      {2.3, 2.1, 2.4, 2.025, 0.25},
      {2.7, 2.4, 3.3, 2.4, 0.25}}},
    {{{2.7, 2.4, 3.3, 2.4, 0.25},
      {2.8, 2.475, 3.525, 2.49375, 0.25},
      {2.9, 2.475, 3.45, 2.5125, 0.15},
      {2.8, 2.4, 3.2, 2.4, 0.15}}},
}};

using Patch = std::array<std::array<glm::dvec3, 4>, 4>;

// Returns a quarter of the surface of revolution, rotated by quarter turns about z. clockwise: as seen from above.
Patch quarterOf(const Rings& rings, int quarters, bool clockwise)
{
    Patch patch;
    for (std::size_t row = 0; row < 4; ++row) {
        const auto [radius, bend, z] = rings[row];
        const glm::dvec2 arc[] = {{radius, 0}, {radius, bend}, {bend, radius}, {0, radius}};
        for (std::size_t column = 0; column < 4; ++column) {
            glm::dvec2 p = arc[column];
            for (int i = 0; i < quarters; ++i)
                p = {-p.y, p.x};
            patch[row][column] = {p.x, clockwise ? -p.y : p.y, z};
        }
    }
    return patch;
}

// Returns one half of the handle or spout. Both halves run around in the same direction.
Patch halfOf(const std::array<Bow, 4>& bows, bool mirrored)
{
    Patch patch;
    for (std::size_t row = 0; row < 4; ++row) {
        const auto [x0, z0, x1, z1, width] = bows[row];
        patch[row] = {{{x0, 0, z0}, {x0, -width, z0}, {x1, -width, z1}, {x1, 0, z1}}};
        if (mirrored)
            patch[row] = {{{x1, 0, z1}, {x1, width, z1}, {x0, width, z0}, {x0, 0, z0}}};
    }
    return patch;
}

struct Cubic {
    double value[4]; // Bernstein polynomials
    double slope[4]; // their derivatives
};

Cubic cubic(double t)
{
    const double s = 1 - t;
    return {{s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t},
            {-3 * s * s, 3 * s * s - 6 * s * t, 6 * s * t - 3 * t * t, 3 * t * t}};
}

// Whether all control points of the first row coincide: the pole of a surface of revolution. No patch ends in a pole.
bool collapsed(const Patch& patch)
{
    return std::ranges::all_of(patch[0], [&](const glm::dvec3& p) { return p == patch[0][0]; });
}

// u runs against the columns and v along the rows: right and down seen from outside.
ShapePoint patchPoint(const Patch& patch, double u, double v)
{
    const Cubic across = cubic(1 - u), along = cubic(v);
    glm::dvec3 p(0), byColumn(0), byRow(0), byBoth(0);
    for (std::size_t row = 0; row < 4; ++row)
        for (std::size_t column = 0; column < 4; ++column) {
            const glm::dvec3& c = patch[row][column];
            p += c * (across.value[column] * along.value[row]);
            byColumn += c * (across.slope[column] * along.value[row]);
            byRow += c * (across.value[column] * along.slope[row]);
            byBoth += c * (across.slope[column] * along.slope[row]);
        }
    // At a collapsed edge the derivative along the edge vanishes; near it, that derivative is proportional to the mixed
    // one, which therefore gives the limit of the normal.
    if (v == 0 && collapsed(patch))
        byColumn = byBoth;
    const glm::dvec3 n = glm::normalize(glm::cross(byColumn, byRow));
    // z-up to y-up
    return {glm::dvec3(p.x, p.z, -p.y) / kOriginalHeight, glm::dvec3(n.x, n.z, -n.y)};
}

} // namespace

Mesh makeTeapot(int segmentsPerPatch)
{
    const int segments = std::max(segmentsPerPatch, 1);
    Mesh mesh;
    mesh.name = "teapot";
    const auto add = [&](const Patch& patch) {
        const Grid grid{segments, segments, collapsed(patch)};
        appendGrid(mesh, grid, [&patch](double u, double v) { return patchPoint(patch, u, v); });
    };
    const auto addRotated = [&](const Rings& rings, bool clockwise) {
        for (int quarters = 0; quarters < 4; ++quarters)
            add(quarterOf(rings, quarters, clockwise));
    };
    for (const Rings& rings : kPot)
        addRotated(rings, true);
    for (const auto& bows : kHandleAndSpout)
        for (const bool mirrored : {false, true})
            add(halfOf(bows, mirrored));
    for (const Rings& rings : kLid)
        addRotated(rings, true);
    addRotated(kBottom, false); // its rows run outwards
    return mesh;
}

// ---- built-in scenes -------------------------------------------------------------------------

namespace {

constexpr int kMapSide = 512;

struct Look {
    const char* name;
    std::optional<Relief> relief;
    glm::vec3 color; // linear
    float metallic, roughness;
};

// Adds a mesh with its own material and one instance: scaled, rotated by `degrees` about the vertical, then moved.
void addShape(Scene& scene, Mesh mesh, const Look& look, glm::vec3 position, float degrees = 0, float scale = 1)
{
    mesh.material = static_cast<int>(scene.materials.size());
    Material& material = scene.materials.emplace_back();
    material.name = look.name;
    material.baseColor = glm::vec4(look.color, 1);
    material.metallic = look.metallic;
    material.roughness = look.roughness;
    if (look.relief)
        material.normalMap.image = static_cast<int>(*look.relief); // images are in the order of Relief
    glm::mat4 toWorld = glm::translate(glm::mat4(1), position);
    toWorld = glm::rotate(toWorld, glm::radians(degrees), glm::vec3(0, 1, 0));
    toWorld = glm::scale(toWorld, glm::vec3(scale));
    scene.instances.push_back({mesh.name, static_cast<int>(scene.meshes.size()), toWorld});
    scene.meshes.push_back(std::move(mesh));
}

// A sphere whose right half (seen with u = 1/2 in front) shows the left half's texture mirrored, as artists do to save
// texture space. `segments` must be even, so that a column of vertices lies on the mirror line.
Mesh makeMirroredSphere(float radius, int segments, float repeatU, float repeatV)
{
    Mesh mesh = makeSphere(radius, segments);
    for (glm::vec2& uv : mesh.texcoords[0])
        uv.x = std::min(uv.x, 1 - uv.x);
    scaleTexcoords(mesh, repeatU, repeatV);
    return mesh;
}

// A still life without a table: the renderer's ground and backdrop take its place.
void addShapes(Scene& scene)
{
    Mesh teapot = makeTeapot(16);
    scaleTexcoords(teapot, 2, 2);
    addShape(scene, std::move(teapot), {"copper", Relief::domes, {0.90f, 0.45f, 0.30f}, 1, 0.36f}, {0, 0, 0.25f}, -24,
             1.45f);
    scene.materials.back().normalScale = 0.55f;
    scene.materials.back().doubleSided = true; // the spout is open
    Mesh panel = makePatch(2, 0.7f, /*mirrored*/ false, 1);
    scaleTexcoords(panel, 2, 2);
    addShape(scene, std::move(panel), {"teal tile", Relief::domes, {0.02f, 0.15f, 0.16f}, 0, 0.38f},
             {-1.35f, 0.95f, -1.35f}, 16, 1.9f);
    scene.materials.back().doubleSided = true; // an open sheet
    addShape(scene, makeCube(0.9f, 1), {"slate", Relief::bricks, {0.10f, 0.105f, 0.115f}, 0, 0.5f},
             {1.72f, 0.45f, -0.85f}, -30);
    addShape(scene, makeMirroredSphere(0.48f, 96, 4, 2), {"gold", Relief::domes, {1.0f, 0.76f, 0.33f}, 1, 0.40f},
             {1.72f, 1.38f, -0.85f}, -6);
    addShape(scene, makeTorus(0.42f, 0.18f, 96, 6, 2.5f),
             {"coral glaze", Relief::waves, {0.55f, 0.10f, 0.065f}, 0, 0.34f}, {-1.5f, 0.18f, 1.0f});
}

} // namespace

Scene builtinScene()
{
    Scene scene;
    scene.name = "built-in";
    for (const Relief kind : {Relief::domes, Relief::bricks, Relief::waves})
        scene.images.push_back(makeReliefMap(kind, kMapSide));
    addShapes(scene);
    const glm::vec3 fromUpperLeft = glm::normalize(glm::vec3(0.66f, -0.85f, -0.62f)); // and from the front
    scene.lights.push_back({.color = {1.0f, 0.985f, 0.96f}, .intensity = 3, .direction = fromUpperLeft});
    scene.cameras.push_back({.name = "front",
                             .verticalFieldOfView = glm::radians(19.0f),
                             .eye = {0.55f, 2.5f, 8.9f},
                             .target = {0.02f, 0.84f, 0}});
    return scene;
}

Scene shapeScene(const std::string& shape)
{
    Scene scene;
    scene.name = shape;
    Mesh mesh;
    if (shape == "sphere") {
        mesh = makeSphere(1, 128);
        scaleTexcoords(mesh, 2, 1); // texels about as wide as they are high
    } else if (shape == "torus") {
        mesh = makeTorus(0.8f, 0.35f, 128, 6, 2.5f);
    } else if (shape == "teapot") {
        mesh = makeTeapot(12);
    } else {
        mesh = makePatch(1, 0, /*mirrored*/ false, 1);
    }
    const float scale = shape == "sphere" || shape == "torus" ? 1 : 2;
    addShape(scene, std::move(mesh), {"white plastic", {}, glm::vec3(0.6f), 0, 0.4f}, glm::vec3(0), 0, scale);
    scene.materials.back().doubleSided = true; // plane and spout are open
    scene.instances.back().name = shape;
    return scene;
}

} // namespace cotan
