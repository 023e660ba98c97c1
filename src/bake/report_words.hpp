// Words that reports share.
#pragma once

#include <cstddef>
#include <string>

#include "cotan/lint.hpp"
#include "cotan/scene.hpp"
#include "files/report/json.hpp"

namespace cotan {

// "1 primitive", "2 primitives".
std::string counted(std::size_t number, const std::string& noun);

// "mean / 95 % / maximum"; "nothing to measure" for an empty set.
std::string toText(const ValueSummary& summary);
// The figures of an empty set are null when it is written.
Json toJson(const ValueSummary& summary);

// What a scene has, and the warnings of loading it.
Json countsOf(const Scene& scene);

} // namespace cotan
