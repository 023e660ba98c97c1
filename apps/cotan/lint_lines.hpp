// The lines of a LintReport that `cotan lint` prints, and texts that other reports share.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "cotan/lint.hpp"
#include "files/json.hpp"

namespace cotan::app {

// "1 primitive", "2 primitives".
std::string counted(std::size_t number, const std::string& noun);

// "mean / 95 % / maximum"; "nothing to measure" for an empty set.
std::string toText(const ValueSummary& summary);

// The verdict in at most seven lines: the model, the visible error, the defects, the advice. run: the command that
// follows the advice; empty if there is none.
std::vector<std::string> verdictLines(const std::string& model, const LintReport& report, const std::string& run);

// All measurements: a few lines per primitive, one per map.
std::vector<std::string> detailLines(const LintReport& report);

// "passed", or the first `most` failures, one line each; the last line also has the number of omitted ones.
std::vector<std::string> checkLines(const LintCheck& check, std::size_t most);

// The first failure and the number of others, without a prefix; empty if the check passed.
std::string summaryOf(const LintCheck& check);

// The failures as objects: {"kind", "mesh", "material", "map", "degrees", "percent", "limit", "text"}. Names are null
// if they do not apply or the file gives none. Of degrees and percent, only the measured one is not null.
Json overLimits(const LintCheck& check);

} // namespace cotan::app
