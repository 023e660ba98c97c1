// Makes scenes cheaper to draw that have very many small parts, or triangles that lie exactly on one another.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "cotan/result.hpp"
#include "cotan/scene.hpp"
#include "cotan/view.hpp"

namespace cotan {

// If the scene has more than maxParts instances, joins parts of the same material: meshes of up to 256 triangles, with
// their vertices placed by the instances in float. Larger meshes, meshes with cotangents, and parts beyond 4 million
// joined triangles stay as they are. Instances with non-finite matrices are dropped, as are opaque duplicates (same
// mesh data, same matrix). Joined parts lose their names.
void joinParts(Scene& scene, std::size_t maxParts = 1000);

// Drops triangles of opaque meshes that have the same corners, in the same cyclic order, as an earlier triangle of
// their mesh; only the first is visible.
void dropRepeated(Scene& scene);

// The triangles with these numbers, with their vertices.
Mesh trianglesOfMesh(const Mesh& mesh, std::span<const std::uint32_t> triangles);

// About `triangles` triangles of the mesh, in evenly chosen runs of neighbours; all if it has no more.
Mesh partOfMesh(const Mesh& mesh, std::size_t triangles);

// Number of pixels covered by triangles that face the eye or are double-sided, counting all layers of depth. Plain
// translucent layers count half, translucent ones with further lobes (a coat or the like) more.
double pixelsCovered(const Scene& scene, const View& view);

// Prepares the scene for drawing `images` images of this view: applies dropRepeated if triangles cover the image more
// than 20 times, then checks limits before anything is drawn. The limits apply to all images together. Errors:
// ErrorKind::input if opaque triangles cover the image more than 64 times or translucent ones 16 times; if long edges
// of triangles fill it twice; or if lights times coverage exceeds 200. Scenes of many distinct positions may exceed the
// first three in proportion.
Status limitCoverage(Scene& scene, const View& view, std::size_t images = 1);

// ---- triangles that lie on others ------------------------------------------------------------

struct CornersOfTriangle {
    std::array<glm::vec3, 3> at{};
    std::int64_t key = 0; // further criterion for equality
};

// The corners of a triangle of a list.
inline CornersOfTriangle cornersOfTriangle(std::span<const glm::vec3> positions, std::span<const std::uint32_t> indices,
                                           std::size_t triangle, std::int64_t key = 0)
{
    const std::uint32_t* const c = &indices[3 * triangle];
    return {{positions[c[0]], positions[c[1]], positions[c[2]]}, key};
}

using TriangleCorners = std::function<CornersOfTriangle(std::size_t triangle)>;

// For each of `count` triangles: the number of earlier triangles with the same corners in the same order; 2 means 2 or
// more. Empty if a sample shows that few repeat, which saves the search. Queries that visit all triangles at a point
// take a thousand times as long where a thousand coincide.
std::vector<std::uint8_t> repeatedTriangles(std::size_t count, const TriangleCorners& triangle);

} // namespace cotan
