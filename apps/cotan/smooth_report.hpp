// Statistics of the cotangents that the frame `smooth` derives.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "cotan/tangents.hpp"

namespace cotan::app {

// Adds the figures to `row` and returns them as one line: vertices after mirrored charts are kept
// apart, vertices without a frame, how far the two cotangents are from perpendicular (shear,
// degrees) and the ratio of the longer to the shorter one (stretch).
std::string reportSmooth(const MeshView& mesh, nlohmann::ordered_json& row);

} // namespace cotan::app
