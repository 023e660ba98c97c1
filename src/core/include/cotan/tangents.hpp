// Tangents and cotangents from a mesh: the frames `mikktspace`, `area-weighted`, `vertex` and `smooth`.
//
//     const cotan::MeshView mesh = {positions, normals, texcoords, indices};
//     const std::vector<cotan::packed::vec4> tangents = cotan::mikktspaceTangents(mesh); // one per corner
//     const cotan::Cotangents cotangents = cotan::smoothCotangents(mesh);                // two per vertex
//
// For all functions here: texcoords follow glTF, v downwards in the image. Vertices with equal position, normal and
// texcoord (-0 equals +0) count as one, whether or not they share an index, so results do not depend on the indexing.
// Time and memory grow linearly.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cotan/frame.hpp"
#include "cotan/packed.hpp"
#include "cotan/result.hpp"

namespace cotan {

// ---- from a mesh ---------------------------------------------------------------------------

// A mesh as plain arrays. positions, normals and texcoords have one entry per vertex; normals are unit, or zero where
// unknown; there are three indices per triangle, each smaller than the number of vertices. An array of another size or
// an index out of range makes every function here return an empty result.
struct MeshView {
    std::span<const packed::vec3> positions;
    std::span<const packed::vec3> normals;
    std::span<const packed::vec2> texcoords;
    std::span<const std::uint32_t> indices;
};

// Returns MikkTSpace tangents, one per corner, in the order of the indices: xyz along increasing u, w = +-1 as in
// glTF's TANGENT: cross(n, xyz) * w points up in the image, against increasing v. Corners that share a vertex may
// differ (mirrored texcoords): see splitVertices.
// xyz is perpendicular to the normal of the vertex, and unit to float precision. Use it as cotan_frame_mikktspace
// describes; do not normalise it after interpolation.
// Degenerate input is handled as in the source. The corners of a triangle with two equal positions get the tangents of
// the first valid triangle at their vertex. A triangle without area in uv shares the tangents of its neighbours;
// without neighbours the tangent is (1,0,0), whatever the normal, and w = +1 (-1 in the source, whose v runs up). Where
// tangents cancel out, xyz is zero, as in the source. glTF requires unit length: setGltfTangents (cotan/gltf.hpp)
// writes (1,0,0) there, and so must you if you write the file. Non-finite tangents become those of a triangle without
// neighbours. Source: M. Mikkelsen, Simulation of Wrinkled Surfaces Revisited (2008), and the behaviour of mikktspace.h
// with its default angular threshold of 180 degrees, fixed as in three.js 0.187: every shared edge connects its
// triangles. mikktspace.c leaves the edges of the last vertex unsorted (BuildNeighborsFast) and treats some as borders;
// corners at that vertex differ in a few meshes. threads: the number to use for large meshes, 0: all cores; the result
// does not depend on it.
std::vector<packed::vec4> mikktspaceTangents(const MeshView& mesh, int threads = 0);

// The same with other weights, as meshoptimizer makes them by default, and engines that took it over: a triangle counts
// by its angle times the lengths of both sides at the corner. Slivers then hardly turn the tangents of their
// neighbours. Maps that were baked for MikkTSpace are read wrongly with them, most beside long thin triangles, such as
// bevels. Differences to the source, whose degenerate triangles join groups of neighbours: corners of triangles without
// area, or connected through them only, may differ. Where tangents cancel out, xyz is zero; the source has (1,0,0).
// Source: meshoptimizer 1.3, meshopt_generateTangents without meshopt_TangentCompatible; its arc cosine is an
// approximation, so tangents differ by up to 0.03 degrees.
std::vector<packed::vec4> areaWeightedTangents(const MeshView& mesh, int threads = 0);

// The classic method: dP/du of every triangle, from its edges, is normalised, summed per vertex without weights, and
// made perpendicular to the normal. Mirrored and unmirrored charts are kept apart. The result is laid out as for
// mikktspaceTangents.
// Degenerate input: triangles without area in space or uv add nothing; their corners get the tangent of the vertex. If
// there is none: some unit vector perpendicular to the normal, w = +1.
std::vector<packed::vec4> vertexTangents(const MeshView& mesh);

// Returns the tangents for a frame with readsTangents(frame): those above. Empty for other frames.
std::vector<packed::vec4> generateTangents(Frame frame, const MeshView& mesh, int threads = 0);

// Converts a tangent of glTF, or of the functions above, to the form that frames take: w * cross(n, xyz) along
// increasing v instead of against it. Its own inverse.
inline packed::vec4 tangentAlongV(packed::vec4 gltf) { return {gltf.x, gltf.y, gltf.z, -gltf.w}; }

// Gradients of u and v, per unit of position. They are covectors: transform them like normals.
struct Cotangents {
    std::vector<packed::vec3> u; // one per vertex of the given arrays
    std::vector<packed::vec3> v;
};

// Returns cotangents averaged at the vertices, for the frame `smooth`: the frame `gradient` of each triangle with the
// vertex's normal, weighted by the corner's angle as seen along that normal. Neither unit nor perpendicular to each
// other: stretch and shear of the texcoords are kept. Continuous inside a chart. Mirrored and unmirrored charts are
// kept apart, except at a vertex that triangles of both kinds use: it gets the side with the larger angle, so split
// such vertices first (splitMirrored).
// Degenerate input: triangles without area in space or uv add nothing; a vertex without other triangles gets zero,
// which gives the plain normal.
// threads: the number to use for large meshes, 0: all cores; the result does not depend on it.
Cotangents smoothCotangents(const MeshView& mesh, int threads = 0);

// Returns for every vertex the first vertex that counts as equal. Array sizes that do not match, or an index out of
// range, give an empty result.
std::vector<std::uint32_t> firstEqualVertices(const MeshView& mesh);

// The same triangles with more vertices: the old ones in their order, then copies.
struct VertexSplit {
    std::vector<std::uint32_t> sources; // per new vertex: the old vertex whose attributes it copies
    std::vector<std::uint32_t> indices; // as many as before; indices of new vertices
};

// Copies vertices until all corners that share one have the same value, so that per-corner tangents can be stored per
// vertex: tangents[split.indices[i]] = corners[i].
// corners: one per index. vertexCount: greater than all indices. Sizes that do not match or an index out of range give
// an empty split.
VertexSplit splitVertices(std::size_t vertexCount, std::span<const std::uint32_t> indices,
                          std::span<const packed::vec4> corners);

// Copies the vertices that mirrored and unmirrored triangles share. There, triangles without area in space or uv are
// assigned to the unmirrored ones.
VertexSplit splitMirrored(const MeshView& mesh);

// Returns an attribute of the old vertices for the new ones. Empty attributes stay empty.
template<class T> std::vector<T> gathered(std::span<const T> values, const VertexSplit& split)
{
    std::vector<T> result;
    if (values.empty())
        return result;
    result.reserve(split.sources.size());
    for (const std::uint32_t source : split.sources)
        result.push_back(values[source]);
    return result;
}

// Both steps of the frame `smooth`: the mesh with mirrored and unmirrored triangles apart, and its cotangents.
struct SplitCotangents {
    VertexSplit split;
    Cotangents cotangents; // one per new vertex
};
SplitCotangents splitSmoothCotangents(const MeshView& mesh, int threads = 0);

// ---- with progress -------------------------------------------------------------------------

// Tangents and cotangents of large meshes, with progress, cancellation and error messages.

// Return the results of the functions above with the same name, to the bit. `progress`
// is called from any of the threads, at least after each step (100 ms for a million triangles) and, in the last step,
// after each 65536 vertices.
// Errors: ErrorKind::usage with the array of MeshView, what was expected and what was found; ErrorKind::stopped if
// `progress` stops the work.
Result<std::vector<packed::vec4>> mikktspaceTangents(const MeshView& mesh, int threads, const Progress& progress);
Result<std::vector<packed::vec4>> areaWeightedTangents(const MeshView& mesh, int threads, const Progress& progress);
Result<Cotangents> smoothCotangents(const MeshView& mesh, int threads, const Progress& progress);

// ---- compared ------------------------------------------------------------------------------

// Comparison of stored tangents with generated ones, corner by corner, and its interpretation.

// The differences at the corners of one or several meshes. Degenerate corners (of triangles without area in uv or with
// two equal positions, or with a tangent of zero length) are counted but not compared: any tangent is equally good
// there.
struct TangentDifference {
    std::vector<float> degrees; // between the directions, per compared corner
    std::size_t corners = 0;    // including degenerate ones
    std::size_t degenerate = 0;
    std::size_t handedness = 0; // compared corners whose w differs in sign
};

// Directions up to this many degrees apart count as equal: the rounding of another implementation changes tangents by
// some thousandths of a degree.
inline constexpr float kEqualTangents = 0.05f;

// stored: one per vertex; generated: one per corner, as mikktspaceTangents returns them. The caller must ensure that
// all indices are inside the arrays.
TangentDifference tangentDifference(const MeshView& mesh, std::span<const packed::vec4> stored,
                                    std::span<const packed::vec4> generated);

// Appends the corners of another mesh.
void append(TangentDifference& to, const TangentDifference& more);

// Fractions of the compared corners, in [0,1]; 0 if none was compared.
double reversedFraction(const TangentDifference& difference); // directions over 90 degrees apart
double invertedFraction(const TangentDifference& difference); // w has the other sign

enum class TangentVerdict {
    nothing,  // no corner could be compared
    equal,    // directions within kEqualTangents, all w equal
    inverted, // w differs on at least 90 % of the corners
    turned,   // 40 to 60 % of the directions are reversed (over 90 degrees apart)
    off,      // anything else
};

TangentVerdict verdictOf(const TangentDifference& difference);

} // namespace cotan
