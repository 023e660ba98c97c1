// Statistics of the cotangents of the frame `smooth`.
#pragma once

#include <cstddef>

#include "cotan/tangents.hpp"
#include "inspect/angles.hpp"

namespace cotan::app {

struct SmoothStatistics {
    std::size_t vertices = 0; // after splitting at mirrored charts
    std::size_t added = 0;    // copies made by the split
    std::size_t without = 0;  // vertices without a frame, which the figures below exclude
    AngleStatistics shear;    // deviation of the two cotangents from perpendicular, in degrees
    double stretchMedian = kEmptyStatistics,
           stretchMaximum = kEmptyStatistics; // length of the longer over the shorter one
};

// Derives the cotangents of a mesh with normals and texture coordinates, as a renderer does when it loads the mesh.
SmoothStatistics smoothStatistics(const MeshView& mesh);

// The statistics as one line, and for reports.
std::string toText(const SmoothStatistics& statistics);
Json toJson(const SmoothStatistics& statistics);

} // namespace cotan::app
