// A child process with a connection to it: child_posix.cpp, child_windows.cpp. And its end of the connection.
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "files/sandbox/request.hpp"

namespace cotan {

// How a child process ended.
struct ChildEnd {
    enum Kind {
        unknown, // it did not end in time, or other code of this process waited for it
        exited,  // with `code`
        tooLong, // it took more processor time than allowed
        killed,
        crashed,
    };
    Kind kind = unknown;
    int code = 0;
    std::string cause{}; // of crashed and killed: "signal 11, Segmentation fault"
};

struct ChildProgram {
    std::filesystem::path program;
    std::vector<std::string> arguments;
    std::map<std::string, std::string> environment{}; // variables that are added to ours or replace them
    // Windows: no processes of its own, no access to the clipboard and to other programs' windows. Elsewhere a child
    // confines itself.
    bool confined = true;
};

// The parent's side. The child ends with this object, and with the thread that started it or the whole process.
class Child {
public:
    using Clock = std::chrono::steady_clock;

    Child();
    ~Child(); // kills it
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    // Starts the program with nothing open but the connection and a pipe for its messages. Returns the system's reason
    // on failure, otherwise an empty text.
    std::string start(const ChildProgram& program);

    // Until when send, receive and end() wait, and what the child may use. Where a child cannot limit itself, it is
    // ended here when it uses more.
    void setLimits(Clock::time_point deadline, const ReaderBudget& budget, const ReaderBudget& maximum);
    bool timedOut() const; // the deadline passed in one of them

    bool send(std::span<const std::byte> bytes);     // all; false if the child is gone or the deadline has passed
    std::size_t receive(std::span<std::byte> bytes); // some; 0: likewise
    ChildEnd end();                                  // waits for it
    void kill();
    std::string messages() const; // the first of its standard error

private:
    struct System;
    std::unique_ptr<System> system_;
};

inline constexpr std::size_t kMaxMessages = 4096; // bytes of standard error that are kept

// The child's side.
class ParentConnection {
public:
    // Takes the connection over from standard input, which libraries then find empty. Returns nothing if this process
    // was not started by Child::start.
    static std::optional<ParentConnection> take();

    bool send(std::span<const std::byte> bytes) const;
    std::size_t receive(std::span<std::byte> bytes) const; // 0: the parent is gone

private:
    std::intptr_t in_ = -1, out_ = -1;
};

} // namespace cotan
