// A mesh as its normal map sees it: the uv that the map is read with, and every frame at every point. In double; made
// once, queried often. For one frame in world space, as it is baked, see low_surface.hpp.
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <glm/mat3x3.hpp>

#include "bake/surface/surface_triangle.hpp"
#include "bake/surface/uv_raster.hpp"
#include "cotan/covector.hpp"
#include "cotan/frame.hpp"
#include "cotan/scene.hpp"
#include "cotan/tangents.hpp"
#include "cotan/view.hpp"

namespace cotan {

// A set of frames, by number.
using FrameSet = std::bitset<kFrameCount>;
inline const FrameSet kAllFrames = FrameSet().set();

// Where corners have their value: at the index of their vertex, with exceptions.
class CornerSlots {
public:
    // Adds an exception. Corners must come in rising order; vertices: their number in the mesh.
    void add(std::size_t corner, std::uint32_t vertex, std::uint32_t slot, std::size_t vertices);
    std::size_t of(std::size_t corner, std::uint32_t vertex) const;

private:
    struct Exception {
        std::uint32_t corner, slot;
    };
    std::vector<bool> split_; // vertices of corners with an exception; empty: none
    std::vector<Exception> exceptions_;
};

// Values derived for the corners of a mesh, stored once for the corners of a vertex that share them.
template<class Values> struct OfCorners {
    Values values;
    CornerSlots slots;
};
using CornerTangents = OfCorners<std::vector<glm::vec4>>; // as in glTF
using CornerCotangents = OfCorners<Cotangents>;           // gradients of u and v

// Data that all placings of a mesh share, in the mesh's own space.
struct SurfaceMesh {
    std::shared_ptr<const Mesh> mesh;
    std::vector<glm::vec2> uv; // of the map, transformed, per vertex; empty if the mesh has none
    std::array<CornerTangents, kFrameCount> generated; // of the frames that read tangents; empty if not requested
    CornerCotangents cotangents;                       // likewise
    bool ofCoat = false; // uv of another map than the vertices' frames: these are `cotangent` and `orthonormal`
};

// The mesh moved by a linear map. Triangle i has the corners 3 i, 3 i + 1 and 3 i + 2. Copies share the mesh.
struct MappedSurface {
    std::shared_ptr<const SurfaceMesh> shared; // null: no triangles
    LinearMap<double> linear{glm::dmat3(1)};
    glm::dmat3 planes{1}; // linear.planeMatrix()

    std::size_t triangleCount() const { return shared ? shared->mesh->triangleCount() : 0; }
    bool hasUv() const { return shared && !shared->uv.empty(); }
    bool hasStored() const; // every vertex has a tangent in the file

    std::uint32_t vertexOf(std::size_t corner) const { return shared->mesh->indices[corner]; }
    glm::dvec3 position(std::size_t corner) const
    {
        return linear(Vector3d(glm::dvec3(shared->mesh->positions[vertexOf(corner)]))).raw();
    }
    glm::dvec3 normal(std::size_t corner) const // unit, or zero if unknown
    {
        return f64::cotan_normalize_or(movedNormal(corner), glm::dvec3(0));
    }
    glm::dvec3 movedNormal(std::size_t corner) const // the same, of any length
    {
        const std::vector<glm::vec3>& normals = shared->mesh->normals;
        const std::uint32_t vertex = vertexOf(corner);
        return vertex < normals.size() ? planes * glm::dvec3(normals[vertex]) : glm::dvec3(0);
    }
    glm::dvec2 uv(std::size_t corner) const { return glm::dvec2(shared->uv[vertexOf(corner)]); } // only if hasUv()
    // The file's tangent, as tangentAlongV: xyz along +u; w * cross(n, xyz) along +v. Only if hasStored().
    glm::dvec4 stored(std::size_t corner) const;
    // The generated tangent of a frame that reads tangents, in the same form.
    bool hasGenerated(Frame frame) const { return shared && !shared->generated[std::size_t(frame)].values.empty(); }
    glm::dvec4 generated(Frame frame, std::size_t corner) const;
};

// map: its uv set and transform are used; without an image the first uv set as it is. linear: moves positions and
// vectors, and covectors by its inverse transpose; a singular map leaves normals zero. Tangents and cotangents are
// generated in the mesh's own space and moved, as in viewers. frames: which frames that read vertices are prepared;
// others have t = b = 0, except with tangents of the file. Degenerate input: a mesh without triangles or uv gives a
// surface without them; uv that are not finite become 0; tangents and cotangents are what their generators return.
MappedSurface makeSurface(const Mesh& mesh, const Texture& map, const glm::dmat3& linear = glm::dmat3(1),
                          const FrameSet& frames = kAllFrames);

// The same without copying the mesh.
MappedSurface makeSurface(std::shared_ptr<const Mesh> mesh, const Texture& map, const glm::dmat3& linear,
                          const FrameSet& frames);

// About the number of bytes that a surface takes besides its mesh, and the additional number while it is made.
struct SurfaceBytes {
    std::size_t kept = 0, making = 0;
};
SurfaceBytes surfaceBytes(std::size_t vertices, std::size_t triangles, const FrameSet& frames);

// The same as the normal map of a clear coat sees it, as in both renderers: vertices have the frames of the surface's
// own map. If the uv differ, `smooth` is `cotangent`, and frames that read tangents are `orthonormal`.
MappedSurface makeCoatSurface(std::shared_ptr<const Mesh> mesh, const Texture& surfaceMap, const Texture& coatMap,
                              const FrameSet& frames);

// The surface moved by another linear map instead; copies nothing.
MappedSurface placedBy(const MappedSurface& surface, const glm::dmat3& linear);

// The frame at a point of a triangle. barycentric: weights of its three corners. Frames that are made from differences
// use the triangle's edges, which give the same as a pixel's differences. Degenerate input: as for the functions
// cotan_frame_NAME; without uv or tangents t = b = 0.
f64::cotan_frame frameAt(const MappedSurface& surface, Frame frame, TangentOrigin tangents, std::size_t triangle,
                         glm::dvec3 barycentric);

// Input of frames that read no vertices, at a point of a triangle; several frames can share it.
struct SurfaceSpot {
    TriangleEdges edges;
    glm::dvec3 interpolated{0}, normal{0}; // unit; the triangle's if `interpolated` has no direction
};
SurfaceSpot spotAt(const MappedSurface& surface, std::size_t triangle, glm::dvec3 barycentric);
SurfaceSpot spotOf(const TriangleEdges& edges, glm::dvec3 interpolated); // interpolated: of any length
f64::cotan_frame frameOf(const SurfaceSpot& spot, Frame frame);

// Values interpolated at a point of a triangle from its three corners. The normal is not unit.
glm::dvec3 normalAt(const MappedSurface& surface, std::size_t triangle, glm::dvec3 barycentric);
glm::dvec2 uvAt(const MappedSurface& surface, std::size_t triangle, glm::dvec3 barycentric);
glm::dvec4 storedAt(const MappedSurface& surface, std::size_t triangle, glm::dvec3 barycentric);
// xyz along +u, w as tangentAlongV: the stored tangent, or the one that the frame reads; (0, 0, 0, 1) without tangents.
glm::dvec4 tangentAt(const MappedSurface& surface, Frame frame, TangentOrigin tangents, std::size_t triangle,
                     glm::dvec3 barycentric);

TriangleEdges edgesOf(const MappedSurface& surface, std::size_t triangle);

// The triangles in the texels of an image of that size, which repeats. The surface's mesh must outlive the raster.
UvRaster repeatedRaster(const MappedSurface& surface, int width, int height);

// About the bytes per triangle of such a raster if triangles are as large as texels.
inline constexpr std::size_t kRasterBytes = 20;

// rowsUnder of such a raster, `height` texels high.
double rowsUnder(const MappedSurface& surface, int height);

// Half the length of the cross product of two edges; 0 if that is not finite.
double areaOf(const TriangleEdges& edges);
double areaOf(const MappedSurface& surface, std::size_t triangle);

// Orientation of a triangle's uv: +1 if the rotation from increasing u to increasing v (which runs down the image) is
// clockwise seen from outside, as on an unmirrored chart; -1 if mirrored; 0 without area.
int orientationOf(const MappedSurface& surface, std::size_t triangle);
int orientationOf(const MappedSurface& surface, std::size_t triangle, const TriangleEdges& edges); // edges: edgesOf it

} // namespace cotan
