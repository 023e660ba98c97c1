// What of a report is over the limits that a caller sets: the verdict of a check.
#pragma once

#include <string>
#include <vector>

#include "cotan/lint/lint.hpp"

namespace cotan {

struct LintLimits {
    double degrees = -1; // that the error with `frame` may exceed on 5 % of the area; -1: no limit
    double area = -1; // % of a primitive's area: degenerate uv, uv overlapping mirrored, stored tangents against the uv
    std::string frame = "orthonormal"; // a Reading::name

    // Whether anything is to be checked.
    bool any() const { return degrees >= 0 || area >= 0; }
};

// One reason why a model fails.
struct LintFailure {
    // reading, rounding, degenerate_uv, mirrored_overlap, reversed_w, turned_tangents: a value over its limit.
    // reversed_green, not_judged: there is no limit that would allow them.
    std::string kind;
    std::string where;            // nameOf(primitive), or the name of the map; empty: the whole model
    double value = 0, limit = -1; // in degrees or % of the area; limit -1: it has none
    std::string text;             // one sentence, names included
    // What it is about, as the file names it; empty where it is about something else, or the file gives no name.
    std::string mesh = {}, material = {}, map = {};
    bool percent = false;    // value and limit are % of the primitive's area, not degrees
    std::string beside = {}; // what else helps to read the value: the means beside it; empty if nothing does
};

// A check passes where nothing fails. Without any limit nothing is checked, and it passes.
struct LintCheck {
    LintLimits limits;
    std::vector<LintFailure> failures;

    bool passed() const { return failures.empty(); }
};

// Each primitive is held to the limits by itself, not the model as a whole.
// Every check, whichever limit it has, fails for a map whose green points the other way than the file says. One in
// degrees fails also for a map whose pixels were not read, and where there are maps and none was judged. A primitive's
// area in % is compared with limits.area, its degrees with limits.degrees.
LintCheck checkLimits(const LintReport& report, const LintLimits& limits);

// The names that LintLimits::frame may have: those of all readings.
const std::vector<std::string>& readingNames();

// What is wrong with the file as it is, one line each: maps whose green points the other way than it says.
std::vector<std::string> lintWarnings(const LintReport& report);

// "mesh, material NAME", with the placing where there are several.
std::string nameOf(const PrimitiveLint& primitive, std::size_t index);

} // namespace cotan
