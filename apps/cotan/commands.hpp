// The commands, each in a file of its own.
#pragma once

#include "common.hpp"

namespace cotan::app {

Command addRenderCommand(CLI::App& app);
Command addCompareCommand(CLI::App& app);
Command addAccuracyCommand(CLI::App& app);
Command addLintCommand(CLI::App& app);
Command addTangentsCommand(CLI::App& app);

} // namespace cotan::app
