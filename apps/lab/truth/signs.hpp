// Every way round that a surface can be seen: world handedness, direction of the raster's rows,
// facing, which way the normal was turned, mirrored uv.
#pragma once

#include <string>
#include <vector>

#include "cotan/packed_only.hpp"
#include "truth/patch.hpp"

namespace cotan {

struct SignCase {
    bool leftHanded, rowsDown, back, flippedNormal, mirrored;

    // The sign of n . (dpdx x dpdy), the cross product taken by its formula: the frame of 2013 as
    // printed is right exactly where it is positive.
    bool positive() const { return (leftHanded + rowsDown + (back && !flippedNormal)) % 2 == 0; }
    std::string name() const;
};

// All 24: a front face's normal is never turned.
std::vector<SignCase> signCases();

// A random plane seen that way.
struct SignTrial {
    AffinePatch patch;
    glm::dvec3 n; // leaning a little from the plane's normal, perhaps turned round
    Differences<double> d;
};
SignTrial makeSignTrial(Random& random, const SignCase& c);

// Whether a frame's t and b point along the gradients of u and v.
bool signsRight(Frame frame, const SignTrial& trial);

} // namespace cotan
