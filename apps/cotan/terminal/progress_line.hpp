// A line on a terminal that says how far a long command is.
#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>

#include "cotan/result.hpp"

namespace cotan {

// Shows "rows of a.png: 45 %, about 20 s left" on standard error, on one line of at most 80 columns that is rewritten
// at most ten times a second, and wipes it at the end. The share never goes back; the time is shown once it has
// something to go by and follows changes slowly. Silent where it is quiet and where standard error is not a terminal.
// All functions may be called from several threads. One at a time.
class ProgressLine {
public:
    // total: of steps; 0: nobody knows how many, and only `what` is shown.
    ProgressLine(bool quiet, std::size_t total, std::string what);
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    void step() { add(1); }
    // Steps that are themselves done bit by bit: takes the share of the present one, up to 1; 0 begins the next. It
    // never stops the work.
    Progress within();

private:
    void add(double steps);
    void at(double done);
    void draw(std::chrono::steady_clock::time_point now);

    const bool visible_;
    const double total_;
    const std::string what_;
    std::mutex mutex_;           // of all below
    double base_ = 0, done_ = 0; // steps that are done, and with the part of the present one
    bool begun_ = false;         // the present one
    double left_ = -1;           // seconds, smoothed; below 0: not known yet
    std::chrono::steady_clock::time_point start_, drawn_;
};

// Wipes the line, if there is one, so that something else can be printed. It comes back with the next step.
void wipeProgress();

} // namespace cotan
