// The steps of lintScene, each in a file of its own.
#pragma once

#include "bake/lint/map_fit.hpp"
#include "cotan/lint.hpp"

namespace cotan::lint {

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

// Whether the stored tangents contradict the uv and the maps do not make up for it; from primitives and maps.
bool distrustStored(const LintReport& report);

// Sets everything from `advice` on from primitives, maps and fits.
void recommend(LintReport& report);

double degreesBetween(glm::dvec3 a, glm::dvec3 b); // of unit vectors; stays exact near zero

} // namespace cotan::lint
