// The commands of cotan-lab. The cotan tool declares their options.
#pragma once

#include "lab_options.hpp"

namespace cotan::app {

Status runAccuracy(const AccuracyCommandOptions& options);
Status runFigures(const FiguresCommandOptions& options);
#ifdef COTAN_WITH_COST
Status runCost(const CostCommandOptions& options);
#else
constexpr Status (*runCost)(const CostCommandOptions&) = nullptr; // the command says what is missing
#endif

} // namespace cotan::app
