// Stored tangents against generated ones, corner by corner, and what the difference means.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <glm/vec4.hpp>
#include <nlohmann/json_fwd.hpp>

#include "cotan/report/statistics.hpp"
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

// stored: one per vertex; generated: one per corner.
TangentDifference tangentDifference(const MeshView& mesh, std::span<const glm::vec4> stored,
                                    std::span<const glm::vec4> generated);

void append(TangentDifference& to, const TangentDifference& more);

enum class TangentVerdict {
    nothing,  // no corner could be compared
    equal,    // directions within 0.05 degrees, all w equal
    inverted, // w differs on at least 90 % of the corners
    turned,   // 40 to 60 % of the directions point the other way (over 90 degrees)
    off,      // anything else
};

TangentVerdict verdictOf(const TangentDifference& difference);

// One line for users. reference: what the stored tangents were compared with, "MikkTSpace".
std::string toText(const TangentDifference& difference, const std::string& reference);
nlohmann::ordered_json toJson(const TangentDifference& difference);

} // namespace cotan
