// The text of --help and -h.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "terminal/command_help.hpp"

namespace cotan {

enum class HelpLength {
    brief, // usage, the main options, examples
    full,
};

// path: the commands from the tool to the one that is asked about; the first is the tool. width: columns that no line
// exceeds, unless one word does; at least 40 are used.
std::string helpText(const std::vector<const CommandHelp*>& path, HelpLength length, std::size_t width);

// Columns of the terminal that standard output is, else those of the variable COLUMNS, else 80; from 40 to 120, since
// longer lines are hard to read.
std::size_t helpWidth();

} // namespace cotan
