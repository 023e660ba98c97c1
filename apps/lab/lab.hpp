// The commands of cotan-lab. The cotan tool declares their options.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lab_options.hpp"

namespace cotan::app {

Status runAccuracy(const AccuracyCommandOptions& options);
Status runFigures(const FiguresCommandOptions& options);
#ifdef COTAN_WITH_COST
Status runCost(const CostCommandOptions& options);
std::optional<int> runCostChild(const std::vector<std::string>& words); // cost::runChild
#else
constexpr Status (*runCost)(const CostCommandOptions&) = nullptr; // the command says what is missing
inline std::optional<int> runCostChild(const std::vector<std::string>&) { return std::nullopt; }
#endif

} // namespace cotan::app
