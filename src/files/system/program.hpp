// How a program begins, and finds itself: program_posix.cpp, program_windows.cpp.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace cotan {

// For main(): returns the words that the program was called with, the program's name first, in UTF-8. Prepares what
// the system or the parent may have left otherwise: standard streams without conversions, a console that shows UTF-8,
// children whose end can be seen.
std::vector<std::string> beginProgram(int argc, char** argv);

// Replaces this process by another program with the same words, after beginProgram. Returns only on failure, with the
// system's reason.
std::string becomeProgram(const std::filesystem::path& program);

// The file of this program. Empty if unknown.
std::filesystem::path programFile();

// A name by which this very program can be started once more, even if its file has been replaced.
std::filesystem::path sameProgram();

} // namespace cotan
