#include "setup.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/loops.hpp"
#include "cotan/covector.hpp"
#include "cotan/frame.hpp"
#include "cotan/vector.hpp"

namespace cotan::reference {

namespace {

constexpr double kShortest = 1e-30; // minimum length of a vector with a direction

// Each row is multiplied by (x, y, z, 1).
glm::dmat4 fromRows(glm::dvec4 x, glm::dvec4 y, glm::dvec4 z, glm::dvec4 w)
{
    return glm::transpose(glm::dmat4(x, y, z, w));
}

// Offset of a raster position from the raster's centre: in the plane at distance 1, or across an orthographic view.
glm::dvec3 offsetFromCentre(const Projection& p, double x, double y)
{
    // The first two rows are axis * pixels + forward * half, so their dot products with the axes give the scales.
    glm::dmat4 rows = glm::transpose(p.toRaster);
    double pixelsX = glm::dot(glm::dvec3(rows[0]), p.right);
    double pixelsY = glm::dot(glm::dvec3(rows[1]), p.up);
    return p.right * ((x + p.sampleOffset.x - 0.5 * p.width) / pixelsX)
        + p.up * ((y + p.sampleOffset.y - 0.5 * p.height) / pixelsY);
}

// The inverse transpose up to a positive factor, which transforms covectors.
glm::dmat3 covectorMatrix(const LinearMap<double>& map)
{
    const glm::dmat3 covectors = map.planeMatrix();
    double largest = 0;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            largest = std::max(largest, std::abs(covectors[column][row]));
    return largest > 0 && std::isfinite(largest) ? covectors / largest : glm::dmat3(0.0);
}

glm::vec3 unitOrZero(glm::vec3 v) { return f32::cotan_normalize_or(v, glm::vec3(0)); }

// Converts stored tangents to our frames. Written separately from tangentAlongV, so that the reference does not share
// its sign. glTF has bitangent = cross(n, t) * w along the map's green, which points up the image, against +v, since v
// increases downwards. Our b points along +v, hence the minus. A mirroring matrix reverses cross products.
glm::vec4 storedTangent(const Draw& draw, glm::vec4 tangent)
{
    float handedness = -tangent.w * (draw.mirrored ? -1.0f : 1.0f);
    return {unitOrZero(draw.vectors * glm::vec3(tangent)), handedness};
}

template<class In, class Out, class Function>
void transformAll(const std::vector<In>& in, std::size_t count, std::vector<Out>& out, Function function)
{
    if (in.size() < count)
        return; // absent
    out.resize(count);
    parallelRanges<std::size_t>(0, count, 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            out[i] = function(in[i]);
    });
}

// Sets everything except the material and its maps.
Draw makeDraw(const Mesh& mesh, const glm::mat4& toWorld, glm::dvec3 eye, Frame frame)
{
    const LinearMap<double> map{glm::dmat3(toWorld)};
    const glm::dmat3 covectors = covectorMatrix(map);
    const glm::vec3 translation(glm::dvec3(toWorld[3]) - eye);
    const auto covector = [&](glm::vec3 v) { return glm::vec3(covectors * glm::dvec3(v)); };
    std::size_t count = mesh.vertexCount();
    Draw draw;
    draw.mesh = &mesh;
    draw.frame = frame;
    draw.vectors = glm::mat3(toWorld);
    draw.mirrored = map.determinant() < 0;
    transformAll(mesh.positions, count, draw.positions, [&](glm::vec3 p) { return draw.vectors * p + translation; });
    transformAll(mesh.normals, count, draw.normals, [&](glm::vec3 n) { return unitOrZero(covector(n)); });
    if (readsTangents(frame))
        transformAll(mesh.tangents, count, draw.tangents, [&](glm::vec4 t) { return storedTangent(draw, t); });
    if (readsCotangents(frame)) {
        transformAll(mesh.cotangentsU, count, draw.cotangentsU, covector);
        transformAll(mesh.cotangentsV, count, draw.cotangentsV, covector);
    }
    return draw;
}

constexpr std::size_t kChunkTriangles = 2048;

// A range of triangles of one draw, set up by one task.
struct Chunk {
    std::uint32_t draw = 0;
    std::size_t first = 0, last = 0;
    std::vector<RasterTriangle> result;
};

std::vector<Chunk> chunksOf(const std::vector<Draw>& draws)
{
    std::vector<Chunk> chunks;
    for (std::size_t d = 0; d < draws.size(); ++d) {
        std::size_t count = draws[d].mesh->triangleCount();
        for (std::size_t first = 0; first < count; first += kChunkTriangles)
            chunks.push_back({std::uint32_t(d), first, std::min(count, first + kChunkTriangles), {}});
    }
    return chunks;
}

// Computes the weight of each vertex divided by w as linear functions over the raster: the rows of the inverse of the
// matrix whose columns are (x, y, w) of the corners (Olano and Greer, Triangle Scan Conversion using 2D Homogeneous
// Coordinates, 1997). They exist even if corners lie behind the eye. Returns false for an edge-on triangle.
bool makePlanes(const std::array<glm::dvec4, 3>& corner, RasterTriangle& triangle, double& orientation)
{
    std::array<glm::dvec3, 3> p;
    for (std::size_t i = 0; i < 3; ++i)
        p[i] = {corner[i].x, corner[i].y, corner[i].w};
    orientation = glm::dot(p[0], glm::cross(p[1], p[2]));
    if (orientation == 0 || !std::isfinite(orientation))
        return false;
    triangle.z = {};
    for (std::size_t i = 0; i < 3; ++i) {
        glm::dvec3 row = glm::cross(p[(i + 1) % 3], p[(i + 2) % 3]) / orientation;
        triangle.weight[i] = {row.x, row.y, row.z};
        triangle.z.x += row.x * corner[i].z;
        triangle.z.y += row.y * corner[i].z;
        triangle.z.constant += row.z * corner[i].z;
    }
    return std::isfinite(triangle.z.x) && std::isfinite(triangle.z.y) && std::isfinite(triangle.z.constant);
}

glm::ivec2 snap(glm::dvec4 corner)
{
    return {int(std::lround(corner.x / corner.w * kSubPixels)), int(std::lround(corner.y / corner.w * kSubPixels))};
}

std::int64_t doubledArea(const std::array<glm::ivec2, 3>& c)
{
    return std::int64_t(c[1].x - c[0].x) * (c[2].y - c[0].y) - std::int64_t(c[1].y - c[0].y) * (c[2].x - c[0].x);
}

// Adds a clipped triangle as a fan. Inner edges are shared exactly, so no sample is covered twice.
void addPieces(const Polygon& polygon, RasterTriangle triangle, const Projection& projection,
               std::vector<RasterTriangle>& result)
{
    Rectangle image{0, 0, projection.width, projection.height};
    for (int i = 1; i + 1 < polygon.count; ++i) {
        triangle.corner = {snap(polygon.corner[0]), snap(polygon.corner[std::size_t(i)]),
                           snap(polygon.corner[std::size_t(i + 1)])};
        std::int64_t area = doubledArea(triangle.corner);
        if (area == 0)
            continue;
        if (area < 0)
            std::swap(triangle.corner[1], triangle.corner[2]);
        Rectangle bounds = boundsOf(triangle, image);
        if (bounds.x0 < bounds.x1 && bounds.y0 < bounds.y1)
            result.push_back(triangle);
    }
}

void setUp(const std::vector<Draw>& draws, const Projection& projection, Cull cull, Chunk& chunk)
{
    const Draw& draw = draws[chunk.draw];
    const std::vector<std::uint32_t>& indices = draw.mesh->indices;
    bool culling = cull == Cull::backFaces && !draw.material->doubleSided;
    for (std::size_t t = chunk.first; t < chunk.last; ++t) {
        RasterTriangle triangle;
        triangle.draw = chunk.draw;
        triangle.vertex = {indices[3 * t], indices[3 * t + 1], indices[3 * t + 2]};
        if (*std::ranges::max_element(triangle.vertex) >= draw.positions.size())
            continue;
        std::array<glm::dvec4, 3> corner;
        for (std::size_t i = 0; i < 3; ++i)
            corner[i] = projection.toRaster * glm::dvec4(draw.positions[triangle.vertex[i]], 1);
        double orientation = 0;
        if (!makePlanes(corner, triangle, orientation))
            continue;
        // Front faces are counterclockwise in an upright image, which is a positive orientation if rows run upward. A
        // mirroring instance does not exchange front and back.
        triangle.front = ((orientation > 0) == projection.rowsUpward) != draw.mirrored;
        if (culling && !triangle.front)
            continue;
        addPieces(clip(corner, projection.width, projection.height), triangle, projection, chunk.result);
    }
}

void sortIntoTiles(TiledTriangles& tiled, const Projection& projection)
{
    tiled.columns = (projection.width + kTileSize - 1) / kTileSize;
    const int rows = (projection.height + kTileSize - 1) / kTileSize;
    tiled.tiles.resize(std::size_t(tiled.columns) * std::size_t(rows));
    Rectangle image{0, 0, projection.width, projection.height};
    for (std::size_t i = 0; i < tiled.triangles.size(); ++i) {
        const Rectangle b = boundsOf(tiled.triangles[i], image);
        const std::array<Edge, 3> edges = edgesOf(tiled.triangles[i]);
        for (int row = b.y0 / kTileSize; row <= (b.y1 - 1) / kTileSize; ++row)
            for (int column = b.x0 / kTileSize; column <= (b.x1 - 1) / kTileSize; ++column) {
                const int x = column * kTileSize, y = row * kTileSize;
                if (mayCover(edges, {x, y, x + kTileSize, y + kTileSize}))
                    tiled.tiles[std::size_t(row) * std::size_t(tiled.columns) + std::size_t(column)].push_back(
                        std::uint32_t(i));
            }
    }
}

} // namespace

Ball boundingBall(const Scene& scene)
{
    const Bounds box = bounds(scene);
    if (box.empty())
        return {};
    const glm::dvec3 low(box.low), high(box.high);
    return {low * 0.5 + high * 0.5, std::max(glm::length(high * 0.5 - low * 0.5), 1e-30)};
}

Projection cameraProjection(const View& view, const Ball& ball)
{
    const Camera& camera = view.camera;
    Projection p{cameraAxes(camera)};
    p.width = view.width;
    p.height = view.height;
    p.orthographic = camera.orthographic;
    p.rowsUpward = view.rowsUpward;

    double reach = glm::length(ball.centre - p.eye) + ball.radius;
    double halfWidth = 0.5 * view.width, halfHeight = 0.5 * view.height;
    double pixels; // per unit of slope or length
    glm::dvec4 z, w;
    if (camera.orthographic) {
        pixels = view.height / double(camera.verticalExtent);
        z = glm::dvec4(-p.forward / (reach * 1.01), 1);
        w = {0, 0, 0, 1};
    } else {
        double angle = std::min(double(camera.verticalFieldOfView), 3.1);
        pixels = halfHeight / std::tan(0.5 * angle);
        z = {0, 0, 0, 1e-4 * reach};
        w = glm::dvec4(p.forward, 0);
    }
    double down = view.rowsUpward ? 1.0 : -1.0;
    p.toRaster = fromRows(glm::dvec4(p.right * pixels, 0) + w * halfWidth,
                          glm::dvec4(p.up * (pixels * down), 0) + w * halfHeight, z, w);
    return p;
}

Projection movedBy(Projection p, glm::dvec2 offset)
{
    glm::dmat4 rows = glm::transpose(p.toRaster);
    rows[0] -= rows[3] * offset.x;
    rows[1] -= rows[3] * offset.y;
    p.toRaster = glm::transpose(rows);
    p.sampleOffset = offset;
    return p;
}

Projection shadowProjection(glm::dvec3 direction, const Ball& ball, glm::dvec3 eye, int texels)
{
    Projection p{axesAlong(unitOr(direction, {0, -1, 0}, kShortest), {0, 1, 0})};
    p.eye = eye;
    p.width = p.height = texels;
    p.orthographic = true;
    // One texel of margin keeps the filter inside the map.
    double pixels = 0.5 * (texels - 2) / ball.radius;
    double depth = 0.5 / (ball.radius * 1.01);
    glm::dvec3 c = ball.centre - eye;
    double half = 0.5 * texels;
    p.toRaster = fromRows(glm::dvec4(p.right * pixels, half - glm::dot(p.right, c) * pixels),
                          glm::dvec4(p.up * -pixels, half + glm::dot(p.up, c) * pixels),
                          glm::dvec4(-p.forward * depth, 0.5 + glm::dot(p.forward, c) * depth), {0, 0, 0, 1});
    return p;
}

glm::vec3 rayDirection(const Projection& p, double x, double y)
{
    return glm::vec3(p.orthographic ? p.forward : unitOr(p.forward + offsetFromCentre(p, x, y), p.forward, kShortest));
}

glm::dvec3 rayOrigin(const Projection& p, double x, double y)
{
    return p.orthographic ? offsetFromCentre(p, x, y) : glm::dvec3(0);
}

std::vector<Draw> makeDraws(const Scene& scene, const TextureLibrary& textures, glm::dvec3 eye, const View& view)
{
    std::vector<Draw> draws;
    for (const Instance& instance : scene.instances) {
        const Mesh* mesh = meshPlacedBy(scene, instance);
        if (!mesh || mesh->material < 0 || std::size_t(mesh->material) >= scene.materials.size()
            || mesh->triangleCount() == 0)
            continue;
        const Frame frame = frameOf(*mesh, view.frame, view.framesOfMeshes);
        Draw& draw = draws.emplace_back(makeDraw(*mesh, instance.toWorld, eye, frame));
        draw.material = &scene.materials[std::size_t(mesh->material)];
        draw.maps = &textures.materials[std::size_t(mesh->material)];
    }
    if (view.output == Output::shaded)
        std::stable_partition(draws.begin(), draws.end(), [](const Draw& d) { return !d.material->translucent(); });
    return draws;
}

Rectangle TiledTriangles::area(std::size_t tile, int width, int height) const
{
    int x = int(tile % std::size_t(columns)) * kTileSize;
    int y = int(tile / std::size_t(columns)) * kTileSize;
    return {x, y, std::min(width, x + kTileSize), std::min(height, y + kTileSize)};
}

TiledTriangles setUpTriangles(const std::vector<Draw>& draws, const Projection& projection, Cull cull)
{
    std::vector<Chunk> chunks = chunksOf(draws);
    parallelFor(std::size_t(0), chunks.size(), [&](std::size_t i) { setUp(draws, projection, cull, chunks[i]); });
    TiledTriangles tiled;
    for (Chunk& chunk : chunks) {
        tiled.triangles.insert(tiled.triangles.end(), chunk.result.begin(), chunk.result.end());
        chunk.result = {};
    }
    sortIntoTiles(tiled, projection);
    return tiled;
}

} // namespace cotan::reference
