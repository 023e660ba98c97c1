// Statistics of the cotangents that the frame `smooth` derives.
#pragma once

#include <cstddef>

#include "cotan/tangents.hpp"
#include "inspect/angles.hpp"

namespace cotan {

struct SmoothStatistics {
    std::size_t vertices = 0; // after mirrored charts are kept apart
    std::size_t added = 0;    // of these: copies
    std::size_t without = 0;  // ... and those without a frame, which count below nowhere
    AngleStatistics shear;    // how far the two cotangents are from perpendicular, degrees
    double stretchMedian = kOfNothing, stretchMaximum = kOfNothing; // the longer over the shorter one, at least 1
};

// Derives the cotangents of a mesh with normals and texture coordinates, as a renderer does when it loads the mesh.
SmoothStatistics smoothStatistics(const MeshView& mesh);

// One line, and the same for reports.
std::string toText(const SmoothStatistics& statistics);
Json toJson(const SmoothStatistics& statistics);

} // namespace cotan
