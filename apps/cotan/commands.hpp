// The commands, each in a file of its own.
#pragma once

#include "common.hpp"

namespace cotan::app {

Command addRenderCommand(CLI::App& app);
Command addCompareCommand(CLI::App& app);
Command addAccuracyCommand(CLI::App& app);
Command addBakeCommand(CLI::App& app);
Command addTangentsCommand(CLI::App& app);
Command addLintCommand(CLI::App& app);
Command addConvertCommand(CLI::App& app);
Command addFiguresCommand(CLI::App& app);
Command addShaderCommand(CLI::App& app);
Command addMapCommand(CLI::App& app);
Command addCostCommand(CLI::App& app);

} // namespace cotan::app
