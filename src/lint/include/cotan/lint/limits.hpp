// What of a report is over the limits that a caller sets.
#pragma once

#include <string>
#include <vector>

#include "cotan/lint/lint.hpp"

namespace cotan {

struct LintLimits {
    double degrees = -1; // 95 % of the error of reading with `frame`, and rounding; -1: no limit
    double area = -1; // % of a primitive's area: degenerate uv, uv overlapping mirrored, stored tangents against the uv
    std::string frame = "cotangent"; // a Reading::name
};

// What is over the limits, one sentence each. A limit in degrees does not hold for maps whose pixels were not read, nor
// where no map at all was judged.
std::vector<std::string> overLimits(const LintReport& report, const LintLimits& limits);

// "mesh, material NAME", with the placing where there are several.
std::string nameOf(const PrimitiveLint& primitive, std::size_t index);

} // namespace cotan
