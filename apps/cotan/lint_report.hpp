// A LintReport in texts and as JSON.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "cotan/lint/lint.hpp"

namespace cotan::app {

// "mesh, material NAME", with the placing where there are several.
std::string nameOf(const PrimitiveLint& primitive, std::size_t index);

// The verdict: what the model is, what will be seen and how much, what is wrong, what to do. At most seven lines.
// run: the command that does it; empty if there is none.
std::vector<std::string> verdictLines(const std::string& model, const LintReport& report, const std::string& run);

// All that was measured: a few lines for each primitive, one for each map.
std::vector<std::string> detailLines(const LintReport& report);

nlohmann::ordered_json toJson(const PrimitiveLint& primitive);
nlohmann::ordered_json toJson(const GreenEvidence& green);
nlohmann::ordered_json toJson(const MapFit& fit);

} // namespace cotan::app
