// A LintReport in texts and as JSON.
#pragma once

#include <string>
#include <vector>

#include "cotan/lint/lint.hpp"
#include "cotan/report/json.hpp"

namespace cotan {

// The verdict: what the model is, what will be seen and how much, what is wrong, what to do. At most seven lines.
// run: the command that does it; empty if there is none.
std::vector<std::string> verdictLines(const std::string& model, const LintReport& report, const std::string& run);

// All that was measured: a few lines for each primitive, one for each map.
std::vector<std::string> detailLines(const LintReport& report);

// The figures of every primitive, map and fit: an object of three lists.
Json listsOf(const LintReport& report);

} // namespace cotan
