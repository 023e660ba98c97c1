// A line on a terminal that says how far a long command is.
#pragma once

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>

#include "common.hpp"

namespace cotan::app {

// Shows "3 of 11 tables, about 20 s left" on standard error, on one line that is rewritten, and
// wipes it at the end. Silent under --quiet and where standard error is not a terminal.
// step() may be called from several threads.
class Progress {
public:
    Progress(const CommonOptions& options, std::size_t total, std::string what);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    void step();

private:
    void show(std::size_t done);

    bool visible_;
    std::size_t total_;
    std::string what_;
    std::atomic<std::size_t> done_ = 0;
    std::mutex printing_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

} // namespace cotan::app
