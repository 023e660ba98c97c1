// Tangents and cotangents from a mesh: the frames `mikktspace`, `vertex` and `smooth`.
//
//     const cotan::MeshView mesh = {positions, normals, texcoords, indices};
//     const std::vector<cotan::packed::vec4> tangents = cotan::mikktspaceTangents(mesh); // one a corner
//     const cotan::Cotangents cotangents = cotan::smoothCotangents(mesh);                // two a vertex
//
// Common to all functions here: texcoords follow glTF, v downwards in the image. Vertices count as
// one where position, normal and texcoord are equal (-0 equals +0), whether or not they share an
// index; so the result does not depend on how the mesh is indexed. Time and memory grow linearly.
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

// A mesh as plain arrays. positions, normals and texcoords have one entry a vertex; normals are unit, or zero where
// unknown; indices are three a triangle, each smaller than the number of vertices. An array of another size or an index
// out of range makes every function here return an empty result.
struct MeshView {
    std::span<const packed::vec3> positions;
    std::span<const packed::vec3> normals;
    std::span<const packed::vec2> texcoords;
    std::span<const std::uint32_t> indices;
};

// MikkTSpace tangents, one per corner, in index order: xyz along increasing u, w = +-1 as glTF's
// TANGENT has it: cross(n, xyz) * w points up in the image, against increasing v.
// Corners that share a vertex may differ (mirrored texcoords): see splitVertices.
// xyz is perpendicular to the normal of the vertex, and unit as far as floats are; to be used as
// cotan_frame_mikktspace says, not normalised between the vertices.
// Degenerate input, as the source has it: a triangle with two equal positions takes its corners' tangents from
// the first sound triangle at the vertex. One with no area in uv takes part in its neighbours'; where there are
// none the tangent is (1,0,0), whatever the normal, and w = +1 (the source's -1; its v runs up). Where tangents
// cancel out, xyz is zero. Input that is not finite: as without neighbours.
// Source: M. Mikkelsen, Simulation of Wrinkled Surfaces Revisited (2008), and the behaviour of
// mikktspace.h with its default angular threshold of 180 degrees, fixed as in three.js 0.187: every shared
// edge joins its triangles, where mikktspace.c leaves the edges of the last vertex unsorted (BuildNeighborsFast)
// and so takes some for borders; corners at that vertex of few meshes differ.
// threads: how many to use for large meshes, 0: all cores; the result does not depend on it.
std::vector<packed::vec4> mikktspaceTangents(const MeshView& mesh, int threads = 0);

// The classic procedure: dP/du of every triangle from its edges, normalised, summed per vertex
// without weights, made perpendicular to the normal. Mirrored and unmirrored charts are kept apart.
// The result is laid out as for mikktspaceTangents.
// Degenerate input: triangles without area in space or uv add nothing; their corners get the
// tangent of the vertex. Where there is none: some unit vector perpendicular to the normal, w = +1.
std::vector<packed::vec4> vertexTangents(const MeshView& mesh);

// The tangents that a frame reads, which readsTangents(frame): one of the two above. Empty for other frames.
std::vector<packed::vec4> generateTangents(Frame frame, const MeshView& mesh, int threads = 0);

// A tangent as frames take it: w * cross(n, xyz) along increasing v. glTF's TANGENT, and what the functions above make,
// has it against increasing v. Its own inverse.
inline packed::vec4 tangentAlongV(packed::vec4 gltf) { return {gltf.x, gltf.y, gltf.z, -gltf.w}; }

// Gradients of u and v, per length unit of position. Covectors: transform them like normals.
struct Cotangents {
    std::vector<packed::vec3> u; // one per vertex of the given arrays
    std::vector<packed::vec3> v;
};

// Cotangents averaged at the vertices, for the frame `smooth`: the frame `gradient` of each
// triangle with the vertex's normal, weighted by the corner's angle seen along that normal.
// Neither unit nor perpendicular to each other: stretch and shear of the texcoords are kept.
// Continuous inside a chart. Mirrored and unmirrored charts are kept apart, except at a vertex that triangles of both
// kinds index: it gets the side with the larger angle, so split such vertices first (splitMirrored).
// Degenerate input: triangles without area in space or uv add nothing; a vertex with no other
// triangle gets zero, which the frame turns into the plain normal.
// threads: how many to use for large meshes, 0: all cores; the result does not depend on it.
Cotangents smoothCotangents(const MeshView& mesh, int threads = 0);

// For every vertex the first one that counts as the same. Arrays of other sizes, or an index out of range, give an
// empty result.
std::vector<std::uint32_t> firstEqualVertices(const MeshView& mesh);

// The same triangles over more vertices: the old ones in their order, then copies.
struct VertexSplit {
    std::vector<std::uint32_t> sources; // per new vertex: the old vertex whose attributes it copies
    std::vector<std::uint32_t> indices; // as many as before, into the new vertices
};

// Copies vertices until all corners that share one have the same value, so that per-corner
// tangents can be stored per vertex: tangents[split.indices[i]] = corners[i].
// corners: one per index; vertexCount: over all indices. Sizes that do not match or an index out
// of range give an empty split.
VertexSplit splitVertices(std::size_t vertexCount, std::span<const std::uint32_t> indices,
                          std::span<const packed::vec4> corners);

// Copies the vertices that mirrored and unmirrored triangles share. Triangles without area in space
// or uv go with the unmirrored ones where there are both.
VertexSplit splitMirrored(const MeshView& mesh);

// An attribute of the old vertices, given to the new ones. Empty stays empty.
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

// Both steps to the frame `smooth`: the mesh with mirrored and unmirrored triangles apart, and its cotangents.
struct SplitCotangents {
    VertexSplit split;
    Cotangents cotangents; // one per new vertex
};
SplitCotangents splitSmoothCotangents(const MeshView& mesh, int threads = 0);

// ---- with progress -------------------------------------------------------------------------

// Tangents and cotangents of large meshes, with progress, a way to stop, and the reason where there are none.

// What mikktspaceTangents(mesh, threads) and smoothCotangents(mesh, threads) return, to the bit. progress is told from
// any of the threads, at least after each step (a hundred milliseconds for a million triangles) and after each 65536
// vertices of the last one.
// Errors: ErrorKind::usage with the array of MeshView, what was expected of it and what was found;
// ErrorKind::stopped where `progress` said so.
Result<std::vector<packed::vec4>> mikktspaceTangents(const MeshView& mesh, int threads, const Progress& progress);
Result<Cotangents> smoothCotangents(const MeshView& mesh, int threads, const Progress& progress);

// ---- compared ------------------------------------------------------------------------------

// Stored tangents against generated ones, corner by corner, and what the difference means.

// What was found at the corners of one or several meshes. Degenerate corners, of triangles without
// area in uv or with two equal positions, or where one of the two tangents has no length, are
// counted and not compared: there any tangent is as good as another.
struct TangentDifference {
    std::vector<float> degrees; // between the directions, one per compared corner
    std::size_t corners = 0;    // all
    std::size_t degenerate = 0;
    std::size_t handedness = 0; // compared corners whose w differs in sign
};

// Directions up to this many degrees apart are equal: another implementation's rounding moves a tangent by some
// thousandths of a degree.
inline constexpr float kEqualTangents = 0.05f;

// stored: one per vertex; generated: one per corner, as mikktspaceTangents gives them. Indices that point outside the
// arrays are the caller's to avoid.
TangentDifference tangentDifference(const MeshView& mesh, std::span<const packed::vec4> stored,
                                    std::span<const packed::vec4> generated);

// Adds the corners of another mesh.
void append(TangentDifference& to, const TangentDifference& more);

// Shares of the compared corners, in [0,1]; 0 where none was compared.
double turnedShare(const TangentDifference& difference);   // directions over 90 degrees apart
double invertedShare(const TangentDifference& difference); // w of the other sign

enum class TangentVerdict {
    nothing,  // no corner could be compared
    equal,    // directions within kEqualTangents, all w equal
    inverted, // w differs on at least 90 % of the corners
    turned,   // 40 to 60 % of the directions point the other way (over 90 degrees)
    off,      // anything else
};

TangentVerdict verdictOf(const TangentDifference& difference);

} // namespace cotan
