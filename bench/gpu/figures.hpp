// The measurements of bench/on-gpu on one device, and their page.
#pragma once

#include <string>
#include <vector>

#include "cost/timing.hpp"
#include "pass_times.hpp"
#include "test_log.hpp"

namespace cotan::bench {

struct Figures {
    cost::DeviceTiming rows;
    std::size_t triangles = 0; // of the mesh that `passes` use
    std::vector<PassTimes> passes;
    std::vector<TestOutcome> tests;
    std::string date;    // such as 2026-11-22
    std::string machine; // operating system
};

// Returns why the figures must not be used, or an empty string if they may: all rows in all cases and all passes took
// time in every repetition, and `mikktspace` is among the rows.
std::string whyInvalid(const Figures& figures);

struct Middle {
    double median = 0;
    double spread = 0; // half the distance between the quartiles
};
Middle middleOf(std::vector<double> values);
// The ratio of a row to `mikktspace`, per repetition. Requires that whyInvalid(figures) is empty.
Middle ratioOf(const Figures& figures, const cost::TimedRow& row, std::size_t atCase);

// The text of docs/explanation/gpu.md. Without tables: how to measure, and that no GPU was found so far.
std::string page(const Figures& figures, bool tables);

} // namespace cotan::bench
