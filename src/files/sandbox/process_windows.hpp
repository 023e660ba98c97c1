// Starting child processes. Windows.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/windows.hpp"

namespace cotan {

class Handle {
public:
    Handle() = default;
    explicit Handle(HANDLE handle) : handle_(handle) {}
    Handle(Handle&& other) noexcept : handle_(std::exchange(other.handle_, nullptr)) {}
    Handle& operator=(Handle&& other) noexcept
    {
        std::swap(handle_, other.handle_);
        return *this;
    }
    ~Handle() { close(); }
    HANDLE get() const { return handle_; }
    void close()
    {
        if (handle_ != nullptr && handle_ != INVALID_HANDLE_VALUE)
            ::CloseHandle(handle_);
        handle_ = nullptr;
    }

private:
    HANDLE handle_ = nullptr;
};

// The system's reason for the last failure.
std::string lastReason();

// A pipe of which a child inherits one end.
struct Pipe {
    Handle ours, childs;

    bool open(bool childReads);
};

// Some bytes; 0: the other end is closed.
std::size_t readPipe(HANDLE pipe, std::span<std::byte> bytes);

// A program to start as a child process.
struct SpawnRequest {
    std::filesystem::path program;
    std::vector<std::string> arguments;               // after the program's name, in UTF-8
    HANDLE input{}, output{}, error{};                // its standard streams, and all that it inherits; null: none
    HANDLE job{};                                     // that it belongs to
    std::filesystem::path folder{};                   // working folder; empty: ours
    std::map<std::string, std::string> environment{}; // variables that are added to ours or replace them
};

// A job whose processes end with its last handle.
Handle endingJob();

// Times and memory of a process, also after its end; a job's greatest process.
double processorSeconds(HANDLE process);
double megabytesOf(HANDLE process);
double peakMegabytesOf(HANDLE job);

// Starts the program without a console. Returns an empty text, or the system's reason.
std::string spawn(const SpawnRequest& request, Handle& process);

} // namespace cotan
