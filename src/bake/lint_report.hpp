// A LintReport as JSON.
#pragma once

#include <string>
#include <vector>

#include "cotan/lint.hpp"
#include "files/report/json.hpp"

namespace cotan {

// Whether green is as declared, and how sure that is; or why it cannot be told.
std::string greenVerdict(const GreenEvidence& g);

// A failure with what is beside the value.
std::string sentenceOf(const LintFailure& f);

// The first failure and how many more there are, without a line's beginning; empty where the check passed.
std::string summaryOf(const LintCheck& check);

// {"passed", "limit", "limit_area", "frame", "failures": [{"kind", "where", "value", "limit", "text"}]}; null where no
// limit was set, limits that were not set are null.
Json toJson(const LintCheck& check);

// Those of the file as it was read, then lintWarnings.
std::vector<std::string> warningsOf(const LintReport& report, std::vector<std::string> ofFile);

// The figures of every primitive, map and fit: an object of three lists.
Json listsOf(const LintReport& report);

} // namespace cotan
