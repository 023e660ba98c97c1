// Child processes in general, and the parent's side of a sandboxed reader: start, data exchange, time limit and end.
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <sys/types.h>

#include "files/sandbox/request.hpp"

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

class ReaderProcess {
public:
    // Starts limits.sandbox.program, sends it the request and what `more` writes, and awaits the first result.
    // Errors: ErrorKind::unavailable if it cannot be started; those of await().
    static Result<std::unique_ptr<ReaderProcess>> start(ReaderRequest request,
                                                        const std::function<void(WireOut&)>& more = {});

    ~ReaderProcess(); // kills it
    ReaderProcess(const ReaderProcess&) = delete;
    ReaderProcess& operator=(const ReaderProcess&) = delete;

    WireIn& answer() { return answer_; }
    WireOut& question() { return question_; } // write errors are reported by await()

    // Sends what is still buffered of the question, and waits for a result. On success the value follows in answer().
    // Errors: the reader's own; failure().
    Status await();

    // Restarts the time limit.
    void restartClock();

    // Returns why answer() is not good. Ends the process.
    Error failure();

private:
    explicit ReaderProcess(const ReaderRequest& request);

    using Clock = std::chrono::steady_clock;

    void setDeadline();
    bool ready(short events);
    bool send(std::span<const std::byte> bytes);
    std::size_t receive(std::span<std::byte> bytes);
    void readStderr();       // reads from the child's standard error
    bool ended(int& status); // waits for the process until the deadline
    void kill();

    LoadLimits limits_;
    std::string name_, reader_; // the file, and "the reader of FBX files"
    std::size_t fileBytes_, decodedBytes_ = 0;
    pid_t process_ = -1; // -1: none, or already reaped
    Descriptor socket_, messages_;
    std::string log_;
    Clock::time_point began_ = Clock::now(), deadline_;
    bool timedOut_ = false;
    WireIn answer_;
    WireOut question_;
};

} // namespace cotan
