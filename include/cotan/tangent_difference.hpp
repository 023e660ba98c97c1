// Stored tangents against generated ones, corner by corner, and what the difference means.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "cotan/tangents.hpp"

namespace cotan {

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
