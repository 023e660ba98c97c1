// Reports of lint and convert as JSON.
#pragma once

#include <string>
#include <vector>

#include "cotan/convert.hpp"
#include "cotan/lint.hpp"
#include "cotan/scene.hpp"
#include "files/json.hpp"

namespace cotan {

// The values of an empty set are written as null.
Json toJson(const ValueSummary& summary);

// Counts of a scene's parts, and its warnings.
Json countsOf(const Scene& scene);

// ---- lint -----------------------------------------------------------------------------------

// Whether green is as declared, with the confidence; or why the map cannot tell.
std::string greenVerdict(const GreenEvidence& g);

// {"passed", "limit", "limit_area", "frame", "failures": [{"kind", "where", "value", "limit", "text"}]}; null if no
// limit was set. A limit that was not set is null.
Json toJson(const LintCheck& check);

// The warnings of the file, then lintWarnings.
std::vector<std::string> warningsOf(const LintReport& report, std::vector<std::string> ofFile);

// The values of every primitive, map and fit: an object of three lists.
Json listsOf(const LintReport& report);

// ---- convert --------------------------------------------------------------------------------

// The result for a map.
Json toJson(const ConvertedMap& map);

// The frames that were chosen for primitives of the file, by options.choose; otherwise empty.
Json decisionsJson(const std::vector<PrimitiveDecision>& decisions);

// The results for tangents and for anisotropic highlights.
Json tangentsJson(const ConvertModelReport& report);

} // namespace cotan
