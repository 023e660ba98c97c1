// A mesh as its normal map sees it: with the uv that the map is read with, and every frame at every point. In double;
// made once, asked often. For one frame in the world, as it is baked, see low_surface.hpp.
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

// Frames, by number.
using FrameSet = std::bitset<kFrameCount>;
inline const FrameSet kAllFrames = FrameSet().set();

// Where corners have their value: at the number of their vertex, but for some.
class CornerPlaces {
public:
    // corners in rising order; vertices: of the mesh.
    void add(std::size_t corner, std::uint32_t vertex, std::uint32_t place, std::size_t vertices);
    std::size_t of(std::size_t corner, std::uint32_t vertex) const;

private:
    struct Elsewhere {
        std::uint32_t corner, place;
    };
    std::vector<bool> several_; // by vertex: not all of its corners have theirs there; empty: of none
    std::vector<Elsewhere> elsewhere_;
};

// What was derived for the corners of a mesh, once for those of a vertex that have the same.
template<class Values> struct OfCorners {
    Values values;
    CornerPlaces places;
};
using CornerTangents = OfCorners<std::vector<glm::vec4>>; // as glTF has them
using CornerCotangents = OfCorners<Cotangents>;           // gradients of u and v

// What all placings of a mesh share, in the mesh's own space.
struct SurfaceMesh {
    std::shared_ptr<const Mesh> mesh;
    std::vector<glm::vec2> uv; // of the map, transformed, one a vertex; empty if the mesh has none
    std::array<CornerTangents, kFrameCount> generated; // of the frames that read tangents; empty where not asked for
    CornerCotangents cotangents;                       // likewise
    bool ofCoat = false; // uv of another map than the vertices' frames: `smooth` is `cotangent` here
};

// The mesh moved by a linear map. Corners are numbered three a triangle. It holds what it needs, and copies share it.
struct MappedSurface {
    std::shared_ptr<const SurfaceMesh> shared; // null: no triangles
    LinearMap<double> linear{glm::dmat3(1)};
    glm::dmat3 planes{1}; // linear.planeMatrix()

    std::size_t triangleCount() const { return shared ? shared->mesh->triangleCount() : 0; }
    bool hasUv() const { return shared && !shared->uv.empty(); }
    bool hasStored() const; // a tangent for every vertex, in the file

    std::uint32_t vertexOf(std::size_t corner) const { return shared->mesh->indices[corner]; }
    glm::dvec3 position(std::size_t corner) const
    {
        return linear(Vector3d(glm::dvec3(shared->mesh->positions[vertexOf(corner)]))).raw();
    }
    glm::dvec3 normal(std::size_t corner) const // unit, or zero where unknown
    {
        return f64::cotan_normalize_or(movedNormal(corner), glm::dvec3(0));
    }
    glm::dvec3 movedNormal(std::size_t corner) const // the same of any length
    {
        const std::vector<glm::vec3>& normals = shared->mesh->normals;
        const std::uint32_t vertex = vertexOf(corner);
        return vertex < normals.size() ? planes * glm::dvec3(normals[vertex]) : glm::dvec3(0);
    }
    glm::dvec2 uv(std::size_t corner) const { return glm::dvec2(shared->uv[vertexOf(corner)]); } // where there are any
    // Of the file, as tangentAlongV: xyz along +u; w * cross(n, xyz) along +v. Where there are any.
    glm::dvec4 stored(std::size_t corner) const;
    // Of a frame that reads tangents, likewise.
    bool hasGenerated(Frame frame) const { return shared && !shared->generated[std::size_t(frame)].values.empty(); }
    glm::dvec4 generated(Frame frame, std::size_t corner) const;
};

// map: whose uv set and transform are used; with no image the first uv set as it is. linear: moves
// positions and vectors, covectors by its inverse transpose; singular maps leave normals zero.
// Tangents and cotangents are generated in the mesh's own space and moved, as viewers do. frames: which of those that
// read vertices are wanted: others have t = b = 0, but for tangents of the file.
// Degenerate input: a mesh without triangles or uv gives a surface without them; uv that are not
// finite are taken as 0, and tangents and cotangents stay as their generators say.
MappedSurface makeSurface(const Mesh& mesh, const Texture& map, const glm::dmat3& linear = glm::dmat3(1),
                          const FrameSet& frames = kAllFrames);

// The same without a copy of the mesh.
MappedSurface makeSurface(std::shared_ptr<const Mesh> mesh, const Texture& map, const glm::dmat3& linear,
                          const FrameSet& frames);

// About how many bytes a surface takes besides its mesh, and how many more for a moment while it is made.
struct SurfaceBytes {
    std::size_t kept = 0, making = 0;
};
SurfaceBytes surfaceBytes(std::size_t vertices, std::size_t triangles, const FrameSet& frames);

// The same as the normal map of a clear coat over it sees it, as both renderers do: tangents are those of the surface's
// own map, and where the uv are others `smooth` is `cotangent`.
MappedSurface makeCoatSurface(std::shared_ptr<const Mesh> mesh, const Texture& surfaceMap, const Texture& coatMap,
                              const FrameSet& frames);

// The surface moved by another linear map instead; takes no memory.
MappedSurface placedBy(const MappedSurface& surface, const glm::dmat3& linear);

// The frame at a point of a triangle. barycentric: weights of its three corners. Frames that are
// made of differences take the triangle's edges, which gives the same as a pixel's differences.
// Degenerate input: as for the functions cotan_frame_NAME; no uv, or no tangents, give t = b = 0.
f64::cotan_frame frameAt(const MappedSurface& surface, Frame frame, TangentOrigin tangents, std::size_t triangle,
                         glm::dvec3 barycentric);

// What frames that read no vertices are made of, at a point of a triangle: for several frames there.
struct SurfaceSpot {
    TriangleEdges edges;
    glm::dvec3 interpolated{0}, normal{0}; // the same, unit; the triangle's where there is none
};
SurfaceSpot spotAt(const MappedSurface& surface, std::size_t triangle, glm::dvec3 barycentric);
SurfaceSpot spotOf(const TriangleEdges& edges, glm::dvec3 interpolated); // the normal there, of any length
f64::cotan_frame frameOf(const SurfaceSpot& spot, Frame frame);

// What lies at a point of a triangle, of its three corners. normal: as interpolated, not unit.
glm::dvec3 normalAt(const MappedSurface& surface, std::size_t triangle, glm::dvec3 barycentric);
glm::dvec2 uvAt(const MappedSurface& surface, std::size_t triangle, glm::dvec3 barycentric);
glm::dvec4 storedAt(const MappedSurface& surface, std::size_t triangle, glm::dvec3 barycentric);

TriangleEdges edgesOf(const MappedSurface& surface, std::size_t triangle);

// Which triangles the texels of its image show, the image repeated, at that size. The surface's mesh must outlive it.
UvRaster repeatedRaster(const MappedSurface& surface, int width, int height);

// About how many bytes a triangle such a raster takes where triangles are as large as texels.
inline constexpr std::size_t kRasterBytes = 20;

// rowsUnder of such a raster of so many texels.
double rowsUnder(const MappedSurface& surface, int height);

// Half the length of the cross product of two edges; 0 where that is not finite.
double areaOf(const TriangleEdges& edges);
double areaOf(const MappedSurface& surface, std::size_t triangle);

// The sign of a triangle's uv: +1 where increasing u turned towards increasing v (which runs down
// the image) goes clockwise seen from outside, as on an unmirrored chart; -1 mirrored; 0 without area.
int orientationOf(const MappedSurface& surface, std::size_t triangle);
int orientationOf(const MappedSurface& surface, std::size_t triangle, const TriangleEdges& edges); // edgesOf it

} // namespace cotan
