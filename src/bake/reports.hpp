// What lint and convert report, as JSON.
#pragma once

#include <string>
#include <vector>

#include "cotan/convert.hpp"
#include "cotan/lint.hpp"
#include "cotan/scene.hpp"
#include "files/report/json.hpp"

namespace cotan {

// The figures of an empty set are null when it is written.
Json toJson(const ValueSummary& summary);

// What a scene has, and the warnings of loading it.
Json countsOf(const Scene& scene);

// ---- lint -----------------------------------------------------------------------------------

// Whether green is as declared, and how sure that is; or why it cannot be told.
std::string greenVerdict(const GreenEvidence& g);

// {"passed", "limit", "limit_area", "frame", "failures": [{"kind", "where", "value", "limit", "text"}]}; null where no
// limit was set, limits that were not set are null.
Json toJson(const LintCheck& check);

// Those of the file as it was read, then lintWarnings.
std::vector<std::string> warningsOf(const LintReport& report, std::vector<std::string> ofFile);

// The figures of every primitive, map and fit: an object of three lists.
Json listsOf(const LintReport& report);

// ---- convert --------------------------------------------------------------------------------

// What became of a map.
Json toJson(const ConvertedMap& map);

// What became of the tangents, and of highlights that are stretched along them.
Json tangentsJson(const ConvertModelReport& report);

} // namespace cotan
