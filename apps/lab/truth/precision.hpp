// One pixel of a triangle somewhere in a large world, as exact numbers and as float attributes
// that hardware interpolates: what is left of the differences.
#pragma once

#include "cotan/packed_only.hpp"
#include "truth/patch.hpp"

namespace cotan {

// Positions, uv and the eye are floats, held in double: that is the mesh whose picture is asked for.
struct PrecisionTrial {
    glm::dvec3 positions[3], eye, normal, texel;
    glm::dvec2 texcoords[3];
    glm::dvec2 barycentrics[3]; // of the pixel, its right and its upper neighbour
    Differences<double> exact;
};

struct PrecisionSetting {
    double offset = 0;       // of the triangle from the origin of the world, units
    double footprint = 1e-3; // size of a pixel on the triangle, units
    double texcoords = 1;    // uv lie between 0 and this, plus the triangle's own extent
    double side = 1;         // of the triangle, units; uv density about one per unit
};

PrecisionTrial makeTrial(Random& random, const PrecisionSetting& setting);

// Where the positions that are differentiated come from.
enum class PositionSource {
    world,              // interpolated world positions
    eyeOffsetPerVertex, // position minus eye, subtracted in float at the vertices ([2013]'s -V)
    eyeOffsetPerPixel,  // interpolated world position, minus eye in float at the pixel
    cameraRelative,     // position minus eye, subtracted exactly before it is rounded to float
};

// The differences that hardware measures: float barycentrics, two fused adds from corner 0.
Differences<float> measuredDifferences(const PrecisionTrial& trial, PositionSource source);

// The edges of the triangle from its float attributes, and exactly.
Differences<float> floatEdges(const PrecisionTrial& trial);
Differences<double> exactEdges(const PrecisionTrial& trial);

} // namespace cotan
