// The steps of lintScene. Problem areas are drawn from the same values.
#pragma once

#include <array>
#include <cstddef>

#include "bake/lint/map_fit.hpp"
#include "cotan/lint.hpp"

namespace cotan {

// ---- one triangle -----------------------------------------------------------------------------

// How one triangle maps to its texture coordinates.
struct TriangleUv {
    bool usable = false;     // has area in space; otherwise all else is 0
    bool degenerate = false; // uv along a line, or at one point; stretch is then 0
    double stretch = 0;      // ratio of the singular values of the uv gradients, at least 1
    double shear = 0;        // degrees by which the angle between the gradients of u and v differs from 90
    double gradient = 0;     // the longer of these two gradients, per unit of length
    double density = 0;      // uv per unit of length: square root of the area in uv over that in space
    int orientation = 0;     // as orientationOf: -1 mirrored
};

// Analyses a triangle. edges: edgesOf it. surface: with uv.
TriangleUv triangleUv(const MappedSurface& surface, std::size_t triangle, const TriangleEdges& edges);

// A stored tangent at one corner of a triangle, compared with the texture coordinates.
struct StoredCorner {
    bool compared = false; // there is a tangent and a dP/du to compare it with
    bool reversed = false; // w points against +v
    double degrees = 0;    // from dP/du, in the plane of the normal; 180 if the tangent has no direction there
};

// Compares all corners of such a triangle; none if its uv have no area.
std::array<StoredCorner, 3> storedCorners(const MappedSurface& surface, std::size_t triangle,
                                          const TriangleEdges& edges);

// ---- a whole surface --------------------------------------------------------------------------

namespace lint {

// Everything in UvQuality except the two overlaps.
UvQuality uvQuality(const MappedSurface& surface);

// Sets the two overlaps of surfaces that read the same image, by counting how often each texel of a raster is covered.
// Triangles that cover no texel centre do not count. side: of the raster. If very many triangles cover much of it, it
// is coarser, down to 16; beyond that everything counts as overlapping.
void countOverlaps(const std::vector<const MappedSurface*>& surfaces, const std::vector<UvQuality*>& qualities,
                   int side = 512);

// If there are more than maxEdges, evenly chosen ones are measured.
EdgeSteps edgeSteps(const MappedSurface& surface, std::size_t maxEdges = kMaxEdges);

StoredTangents storedTangents(const MappedSurface& surface);

// For each point: from how many of 14 directions it is visible on the surface alone; 1 for all if no point is visible.
// bothSides: whether back faces are drawn. maxPixels: that all triangles may be drawn to in all directions together; if
// there are more, the depth buffers are smaller. Takes at most 28 MiB.
inline constexpr double kMaxPixels = 2e8; // takes 0.3 s
std::vector<double> visibility(const MappedSurface& surface, const std::vector<MeshPoint>& points, bool bothSides,
                               double maxPixels = kMaxPixels);

// Decodes the map at the points (pointsOver), reads it with each frame and weights the errors by visibility
// (`visibility`). Errors are angles to the frame that the map was made for, with generated tangents; for a MikkTSpace
// map, to what the file's tangents show if they point along u, with the sign of the uv. "stored" is compared with
// generated MikkTSpace.
std::vector<Reading> readings(const MappedSurface& surface, const std::vector<MeshPoint>& points, Frame madeFor,
                              const Material& material, const Image& map, double maxPixels = kMaxPixels);

// The mean over the whole model of the reading with that frame, by area; NaN if no primitive was judged.
double meanOfReading(const LintReport& report, const std::string& frame);

// Whether the stored tangents contradict the uv and the maps do not compensate for it. Reads primitives and maps.
bool distrustStored(const LintReport& report);

// Sets all fields from `advice` on. Reads primitives, maps and fits.
void recommend(LintReport& report);

// The name of a map in sentences.
std::string mapName(const GreenEvidence& map);

double degreesBetween(glm::dvec3 a, glm::dvec3 b); // of any lengths; accurate near zero

} // namespace lint

} // namespace cotan
