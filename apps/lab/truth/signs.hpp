// All orientations in which a surface can be seen: handedness of the world, direction of the raster rows, facing,
// flipped normals, mirrored uv.
#pragma once

#include <string>
#include <vector>

#include "truth/patch.hpp"

namespace cotan {

struct SignCase {
    bool leftHanded, rowsDown, back, flippedNormal, mirrored;

    // Whether n . (dpdx x dpdy) is positive, with the cross product by its formula. The frame of 2013 as printed is
    // right exactly if it is.
    bool positive() const { return (leftHanded + rowsDown + (back && !flippedNormal)) % 2 == 0; }
    std::string name() const;
};

// All 24 cases: the normal of a front face is never flipped.
std::vector<SignCase> signCases();

// A random plane seen in one of these orientations.
struct SignTrial {
    AffinePatch patch;
    glm::dvec3 n; // near the plane's normal, possibly flipped
    Differences<double> d;
};
SignTrial makeSignTrial(Random& random, const SignCase& c);

// Whether a frame's t and b point along the gradients of u and v.
bool signsRight(Frame frame, const SignTrial& trial);

} // namespace cotan
