// A command line for display.
#pragma once

#include <string>
#include <vector>

namespace cotan {

// The words quoted for a shell, on one line.
std::string commandLine(const std::vector<std::string>& words);

} // namespace cotan
