// A progress line on a terminal.
#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>

#include "cotan/result.hpp"

namespace cotan::app {

// Shows "rows of a.png: 45 %, about 20 s left" on standard error, on one line of at most 79 columns that is rewritten
// at most ten times a second, and wipes it at the end. The percentage never decreases. The remaining time is shown once
// it can be estimated, and is smoothed. Silent if `quiet` is set or standard error is not a terminal. All functions are
// thread-safe. Only one line may exist at a time.
class ProgressLine {
public:
    // total: the number of steps; 0: unknown, and only `what` is shown.
    ProgressLine(bool quiet, std::size_t total, std::string what);
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    void step() { add(1); }
    // For steps that report progress themselves: takes the fraction done of the current step; 0 starts the next step.
    // Always returns true, so the work is never stopped.
    Progress within();

private:
    void add(double steps);
    void at(double done);
    void draw(std::chrono::steady_clock::time_point now);

    const bool visible_;
    const double total_;
    const std::string what_;
    std::mutex mutex_;           // guards all members below
    double base_ = 0, done_ = 0; // completed steps, without and with the current one's fraction
    bool begun_ = false;         // the first step has started
    double left_ = -1;           // seconds, smoothed; negative: unknown yet
    std::chrono::steady_clock::time_point start_, drawn_;
};

// Wipes the line, if any, so that something else can be printed. The next step draws it again.
void wipeProgress();

} // namespace cotan::app
