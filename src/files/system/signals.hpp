// The signals that end a program, or on Windows the events of its console: signals_posix.cpp, signals_windows.cpp.
#pragma once

#include <filesystem>

namespace cotan {

// Calls `handler` with the number of each signal that ends this program, unless it is ignored. The handler may call
// the functions below and nothing that locks or allocates.
void catchSignals(void (*handler)(int signal));

void removeInHandler(const std::filesystem::path::value_type* file);
void waitInHandler();         // 5 ms
void endBySignal(int signal); // ends the program so that its parent sees the cause

} // namespace cotan
