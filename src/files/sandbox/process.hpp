// Child processes: any program's, and the parent's side of a sandboxed reader, which is started, asked, timed and
// ended.
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

// An open file of the system.
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

// A program to be started as a child process.
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

class ReaderProcess {
public:
    // Starts limits.sandbox.program, sends it the request and what `more` says, and awaits the first result.
    // Errors: ErrorKind::unavailable where it cannot be started; those of await().
    static Result<std::unique_ptr<ReaderProcess>> start(ReaderRequest request,
                                                        const std::function<void(WireOut&)>& more = {});

    ~ReaderProcess(); // kills it
    ReaderProcess(const ReaderProcess&) = delete;
    ReaderProcess& operator=(const ReaderProcess&) = delete;

    WireIn& answer() { return answer_; }
    WireOut& question() { return question_; } // where nobody listens, await() says why

    // Sends what is still held of the question, and waits for a result. Done: what follows in answer() is the value.
    // Errors: the reader's own; failure().
    Status await();

    // Gives it as much time again, from now.
    void restartClock();

    // Why answer() is not good. Ends the process.
    Error failure();

private:
    explicit ReaderProcess(const ReaderRequest& request);

    using Clock = std::chrono::steady_clock;

    void setDeadline();
    bool ready(short events);
    bool send(std::span<const std::byte> bytes);
    std::size_t receive(std::span<std::byte> bytes);
    void listen();           // takes what it says on standard error
    bool ended(int& status); // waits for the process within its time
    void kill();

    LoadLimits limits_;
    std::string name_, reader_; // the file, and "the reader of FBX files"
    std::size_t fileBytes_, decodedBytes_ = 0;
    pid_t process_ = -1; // -1: none, or waited for
    Descriptor socket_, messages_;
    std::string said_;
    Clock::time_point began_ = Clock::now(), deadline_;
    bool late_ = false;
    WireIn answer_;
    WireOut question_;
};

// A message of the other process, fit to be printed: one line, no control characters, not endless.
std::string printable(std::string text, std::size_t most);

} // namespace cotan
