// Starting child processes. POSIX.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <sys/types.h>

namespace cotan {

// Owns a file descriptor.
class Descriptor {
public:
    Descriptor() = default;
    explicit Descriptor(int number) : number_(number) {}
    Descriptor(Descriptor&& other) noexcept : number_(other.number_) { other.number_ = -1; }
    Descriptor& operator=(Descriptor&& other) noexcept
    {
        std::swap(number_, other.number_);
        return *this;
    }
    ~Descriptor() { close(); }
    int get() const { return number_; }
    void close();

private:
    int number_ = -1;
};

// A program to start as a child process.
struct SpawnRequest {
    std::string program;
    std::vector<std::string> arguments;               // arguments after the program's name
    int input = -1;                                   // standard input; -1: /dev/null
    int output = -1;                                  // standard output and error
    std::filesystem::path folder{};                   // working folder; empty: ours
    std::map<std::string, std::string> environment{}; // variables that are added to ours or replace them
};

// Starts the program with only these descriptors, in its own process group (so that Ctrl-C reaches only us), with no
// signal blocked or ignored. Returns 0 or the errno.
int spawn(const SpawnRequest& request, pid_t& process);

} // namespace cotan
