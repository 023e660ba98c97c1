// The terminal as the system describes it: screen_posix.cpp, screen_windows.cpp.
#pragma once

#include <cstddef>
#include <cstdio>

namespace cotan::app {

bool isTerminal(std::FILE* stream);

// The number of columns; 0: not a terminal, or unknown.
std::size_t terminalWidth(std::FILE* stream);

} // namespace cotan::app
