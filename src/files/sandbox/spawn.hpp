// A program started as a child process.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <sys/types.h>

namespace cotan {

struct SpawnRequest {
    std::string program;
    std::vector<std::string> words;                   // behind the program's name
    int input = -1;                                   // standard input; -1: nothing is there
    int output = -1;                                  // standard output and error
    std::filesystem::path folder{};                   // it runs in; empty: ours
    std::map<std::string, std::string> environment{}; // variables besides ours, or in their place
};

// Starts it with these descriptors and no others, in a process group of its own, with no signal blocked or ignored:
// Ctrl-C is for us. Returns 0 or the errno.
int spawn(const SpawnRequest& request, pid_t& process);

} // namespace cotan
