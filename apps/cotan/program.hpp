// Shared by the programs cotan and cotan-lab: how a process starts and ends.
#pragma once

#include <string>
#include <vector>

#include "cotan/result.hpp"

namespace cotan::app {

// The main() of both programs. They also serve as reader processes for untrusted files and as job processes of a batch;
// otherwise `commandLine` gets the words after the program's name and returns the exit code.
int runProgram(int argc, char** argv, int (*commandLine)(std::vector<std::string> words));

// Prints the error of a command, if any, and flushes its output. Returns the exit code.
int finish(const Status& status);

// Replaces this process by the program cotan-lab in the same folder, with the same arguments. Returns only on failure.
// Errors: ErrorKind::unavailable.
Status startLab();

} // namespace cotan::app
