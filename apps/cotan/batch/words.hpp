// A command line as people read it.
#pragma once

#include <string>
#include <vector>

namespace cotan {

// The words as a shell takes them, on one line.
std::string commandLine(const std::vector<std::string>& words);

} // namespace cotan
