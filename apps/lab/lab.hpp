// The commands of cotan-lab. The cotan tool declares their options.
#pragma once

#include "lab_options.hpp"

namespace cotan::app {

Status runAccuracy(const AccuracyCommandOptions& options);
Status runFigures(const FiguresCommandOptions& options);
Status runCost(const CostCommandOptions& options);

} // namespace cotan::app
