// What bench/on-gpu has measured on one device, and the page of it.
#pragma once

#include <string>
#include <vector>

#include "cost/timing.hpp"
#include "pass_times.hpp"
#include "test_log.hpp"

namespace cotan::bench {

struct Figures {
    cost::DeviceTiming rows;
    std::size_t triangles = 0; // of the mesh of `passes`
    std::vector<PassTimes> passes;
    std::vector<TestOutcome> tests;
    std::string date;    // as 2026-11-22
    std::string machine; // its system
};

// Why the figures must not be believed, in a line; empty where they may: all rows in all cases and all passes have
// taken time, in every repetition, and `mikktspace` is among the rows.
std::string unsound(const Figures& figures);

struct Middle {
    double median = 0;
    double spread = 0; // half of the distance between the quartiles
};
Middle middleOf(std::vector<double> values);
// Of a row to `mikktspace`, repetition by repetition. The figures must be sound.
Middle ratioOf(const Figures& figures, const cost::TimedRow& row, std::size_t atCase);

// docs/explanation/gpu.md. Without tables: how to run it, and that no GPU was met.
std::string page(const Figures& figures, bool tables);

} // namespace cotan::bench
