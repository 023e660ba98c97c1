// What the programs cotan and cotan-lab have in common: how a process begins and ends.
#pragma once

#include <string>
#include <vector>

#include "cotan/result.hpp"

namespace cotan::app {

// What main() of either returns. A reader of untrusted files and a job of a batch are this program, too; else
// `commandLine` gets the words behind the program's name and returns the exit code.
int runProgram(int argc, char** argv, int (*commandLine)(std::vector<std::string> words));

// The exit code of a command, once what it printed has arrived; prints its error.
int finish(const Status& status);

// Becomes the program cotan-lab, which lies beside this one, with the words that this one was started with. Returns
// only where that cannot be. Errors: ErrorKind::unavailable.
Status startLab();

} // namespace cotan::app
