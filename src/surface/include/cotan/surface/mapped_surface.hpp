// A mesh as its normal map sees it: with the uv that the map is read with, and every frame at every
// point. In double, per corner; made once, asked often. For one frame in the world, as it is baked, see
// low_surface.hpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/mat3x3.hpp>

#include "cotan/frame.hpp"
#include "cotan/scene/scene.hpp"
#include "cotan/surface/triangle.hpp"
#include "cotan/surface/uv_raster.hpp"
#include "cotan/surface/vertex_frames.hpp"

namespace cotan {

// Arrays have one entry per corner, three a triangle. Space: the mesh's, moved by the linear map
// that makeSurface was given.
struct MappedSurface {
    std::vector<glm::dvec3> positions;
    std::vector<glm::dvec3> normals; // unit, or zero where unknown
    std::vector<glm::dvec2> uv;      // of the normal map, transformed; empty if the mesh has none
    std::vector<glm::dvec4> stored;  // as tangentAlongV: xyz along +u; w * cross(n, xyz) along +v. Empty if none
    std::array<std::vector<glm::dvec4>, kFrameCount> generated; // likewise; of the frames that read tangents
    std::vector<glm::dvec3> cotangentsU, cotangentsV;
    bool ofCoat = false; // uv of another map than the vertices' frames: `smooth` is `cotangent` here

    std::size_t triangleCount() const { return positions.size() / 3; }
    static Corners cornersOf(std::size_t triangle) { return {3 * triangle, 3 * triangle + 1, 3 * triangle + 2}; }
};

// map: whose uv set and transform are used; with no image the first uv set as it is. linear: moves
// positions and vectors, covectors by its inverse transpose; singular maps leave normals zero.
// Tangents and cotangents are generated in the mesh's own space and moved, as viewers do.
// Degenerate input: a mesh without triangles or uv gives a surface without them; uv that are not
// finite are taken as 0, and tangents and cotangents stay as their generators say.
MappedSurface makeSurface(const Mesh& mesh, const Texture& map, const glm::dmat3& linear = glm::dmat3(1));

// The same as the normal map of a clear coat over it sees it, as both renderers do: tangents are those of the surface's
// own map, and where the uv are others `smooth` is `cotangent`.
MappedSurface makeCoatSurface(const Mesh& mesh, const Texture& surfaceMap, const Texture& coatMap,
                              const glm::dmat3& linear = glm::dmat3(1));

// The frame at a point of a triangle. barycentric: weights of its three corners. Frames that are
// made of differences take the triangle's edges, which gives the same as a pixel's differences.
// Degenerate input: as for the functions cotan_frame_NAME; no uv, or no tangents, give t = b = 0.
f64::cotan_frame frameAt(const MappedSurface& surface, Frame frame, TangentOrigin tangents, std::size_t triangle,
                         glm::dvec3 barycentric);

// A value per corner at a point of a triangle.
template<class T> T atPoint(const std::vector<T>& corners, std::size_t triangle, glm::dvec3 barycentric)
{
    return atCorners(corners, MappedSurface::cornersOf(triangle), barycentric);
}

TriangleEdges edgesOf(const MappedSurface& surface, std::size_t triangle);

// Which triangles the texels of its image show, the image repeated. copies: that many of the image count as one, along
// each axis.
UvRaster repeatedRaster(const MappedSurface& surface, int width, int height, glm::ivec2 copies = {1, 1});

// Half the length of the cross product of two edges.
double areaOf(const MappedSurface& surface, std::size_t triangle);

// The sign of a triangle's uv: +1 where increasing u turned towards increasing v (which runs down
// the image) goes clockwise seen from outside, as on an unmirrored chart; -1 mirrored; 0 without area.
int orientationOf(const MappedSurface& surface, std::size_t triangle);

} // namespace cotan
