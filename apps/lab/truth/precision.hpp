// One pixel of a triangle anywhere in a large world, with exact values and with interpolated float attributes: the
// precision that remains in its differences.
#pragma once

#include "truth/patch.hpp"

namespace cotan {

// Positions, uv and eye are float values held in double: the mesh itself is exact, only its rendering is rounded.
struct PrecisionTrial {
    glm::dvec3 positions[3], eye, normal, texel;
    glm::dvec2 texcoords[3];
    glm::dvec2 barycentrics[3]; // of the pixel, and of its right and upper neighbours
    Differences<double> exact;
};

struct PrecisionSetting {
    double offset = 0;       // distance of the triangle from the world's origin, units
    double footprint = 1e-3; // size of a pixel on the triangle, units
    double texcoords = 1;    // uv are between 0 and this, plus the extent of the triangle
    double side = 1;         // size of the triangle, units; uv density is about one per unit
};

PrecisionTrial makeTrial(Random& random, const PrecisionSetting& setting);

// How the positions that are differentiated are computed.
enum class PositionSource {
    world,              // interpolated world positions
    eyeOffsetPerVertex, // position minus eye, subtracted in float per vertex ([2013]'s -V)
    eyeOffsetPerPixel,  // interpolated world position, minus eye in float per pixel
    cameraRelative,     // position minus eye, subtracted exactly before rounding to float
};

// The differences as hardware computes them: float barycentrics, two fused multiply-adds from corner 0.
Differences<float> measuredDifferences(const PrecisionTrial& trial, PositionSource source);

// The edges of the triangle, from float attributes or exactly.
Differences<float> floatEdges(const PrecisionTrial& trial);
Differences<double> exactEdges(const PrecisionTrial& trial);

} // namespace cotan
