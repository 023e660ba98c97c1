// The text of --help and -h.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "terminal/command_help.hpp"

namespace cotan::app {

enum class HelpLength {
    brief, // usage, the main options, examples
    full,
};

// path: the commands from the tool to the requested one; the first is the tool. width: the maximum number of columns,
// at least 40; only longer words exceed it.
std::string helpText(const std::vector<const CommandHelp*>& path, HelpLength length, std::size_t width);

// Columns of the terminal on standard output, else of the variable COLUMNS, else 80; clamped to 40 to 120, since longer
// lines are hard to read.
std::size_t helpWidth();

} // namespace cotan::app
