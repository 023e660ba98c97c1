// A LintReport in lines, as `cotan lint` prints it, and words that other reports share.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "cotan/lint.hpp"
#include "files/report/json.hpp"

namespace cotan {

// "1 primitive", "2 primitives".
std::string counted(std::size_t number, const std::string& noun);

// "mean / 95 % / maximum"; "nothing to measure" for an empty set.
std::string toText(const ValueSummary& summary);

// The verdict: what the model is, what will be seen and how much, what is wrong, what to do. At most seven lines.
// run: the command that does it; empty if there is none.
std::vector<std::string> verdictLines(const std::string& model, const LintReport& report, const std::string& run);

// All that was measured: a few lines for each primitive, one for each map.
std::vector<std::string> detailLines(const LintReport& report);

// "passed" or what failed: the first `most` failures, one line each, the last with the number of those left out.
std::vector<std::string> checkLines(const LintCheck& check, std::size_t most);

// The first failure and how many more there are, without a line's beginning; empty where the check passed.
std::string summaryOf(const LintCheck& check);

// The failures as objects: {"kind", "mesh", "material", "map", "degrees", "percent", "limit", "text"}. Names are null
// where the failure is about something else or the file gives none; of degrees and percent the one that was measured is
// not null.
Json overLimits(const LintCheck& check);

} // namespace cotan
