// The steps of lintScene, and what pictures show of them.
#pragma once

#include <array>
#include <cstddef>

#include "bake/lint/map_fit.hpp"
#include "cotan/lint.hpp"

namespace cotan {

// ---- one triangle -----------------------------------------------------------------------------

// How one triangle stretches its texture coordinates.
struct TriangleUv {
    bool usable = false;     // it has an area in space; all else is 0 without
    bool degenerate = false; // uv along a line, or one point; stretch is 0 then
    double stretch = 0;      // the longer axis of uv's unit circle over the shorter: at least 1
    double shear = 0;        // degrees between the gradients of u and v and a right angle
    double gradient = 0;     // the longer of the two, per unit of length
    double density = 0;      // uv per unit of length: the root of the area in uv over that in space
    int orientation = 0;     // as orientationOf: -1 mirrored
};

// Of a triangle with these edges (edgesOf). surface: with uv.
TriangleUv triangleUv(const MappedSurface& surface, std::size_t triangle, const TriangleEdges& edges);

// A stored tangent at one corner of a triangle, against the texture coordinates.
struct StoredCorner {
    bool compared = false; // there is a tangent and a dP/du to hold it against
    bool reversed = false; // w points against +v
    double degrees = 0;    // from dP/du, in the plane of the normal; 180 where the tangent has no direction there
};

// All corners of such a triangle. Nothing is compared where its uv have no area.
std::array<StoredCorner, 3> storedCorners(const MappedSurface& surface, std::size_t triangle,
                                          const TriangleEdges& edges);

// ---- a whole surface --------------------------------------------------------------------------

namespace lint {

// Everything of UvQuality but the two overlaps.
UvQuality uvQuality(const MappedSurface& surface);

// The two overlaps, for surfaces that read the same image: by counting how often each texel of a
// raster is used. Triangles that cover no texel centre do not count. side: of the raster; where very many triangles
// cover much of it, it is coarser, down to 16, and beyond that all counts as overlapping.
void countOverlaps(const std::vector<const MappedSurface*>& surfaces, const std::vector<UvQuality*>& qualities,
                   int side = 512);

// maxEdges: of more, evenly chosen ones are measured.
EdgeSteps edgeSteps(const MappedSurface& surface, std::size_t maxEdges = kMaxEdges);

StoredTangents storedTangents(const MappedSurface& surface);

// Of how many of 14 directions the surface, alone, shows each point; where it shows none of them, all alike.
// bothSides: whether back faces are drawn. maxPixels: that all triangles may be drawn to in all directions together;
// where there are more, pictures are smaller. Takes 28 MiB, whatever the surface.
inline constexpr double kMaxPixels = 2e8; // 0.3 s
std::vector<double> seen(const MappedSurface& surface, const std::vector<MeshPoint>& points, bool bothSides,
                         double maxPixels = kMaxPixels);

// The map decoded at the points (pointsOver) and read with each frame, weighted by what is seen of them (`seen`).
// Angles to the frame that it was made for, with generated tangents; of a map for MikkTSpace to what the tangents of
// the file show where they point along u, with the sign of the uv. Of "stored" to generated MikkTSpace.
std::vector<Reading> readings(const MappedSurface& surface, const std::vector<MeshPoint>& points, Frame madeFor,
                              const Material& material, const Image& map, double maxPixels = kMaxPixels);

// The mean over the whole model of reading with that frame, by area; NaN where no primitive was judged.
double meanOfReading(const LintReport& report, const std::string& frame);

// Whether the stored tangents contradict the uv and the maps do not make up for it; from primitives and maps.
bool distrustStored(const LintReport& report);

// Sets everything from `advice` on from primitives, maps and fits.
void recommend(LintReport& report);

double degreesBetween(glm::dvec3 a, glm::dvec3 b); // lengths do not count; stays exact near zero

} // namespace lint

} // namespace cotan
