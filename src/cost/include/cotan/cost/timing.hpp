// How long the rows take, on devices with timestamps.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cotan/cost/rows.hpp"
#include "cotan/result.hpp"

namespace cotan::cost {

struct TimedRow {
    std::string_view row;
    std::vector<double> nanosecondsPerMillionPixels; // medians, one per triangle size
    // As many: of the mesh that is drawn. More where every triangle owns its provoking vertex (cotan/provoking.hpp).
    std::vector<std::uint32_t> vertices;
};

struct DeviceTiming {
    std::string name;
    std::string driver;
    bool cpu = false;    // draws on the processor: says little about a GPU
    std::string silence; // why there are no numbers; empty where there are
    std::vector<TimedRow> rows;
};

struct TimingOptions {
    std::vector<std::string> devices; // as for machineCodeOfDevices
    bool cpuDevices = false;          // time those too
    int repeats = 15;                 // of which the median is taken
};

// Right-angled triangles with legs of these many pixels, two to a square.
const std::vector<int>& triangleLegs();

// Draws a square of 1024 x 1024 pixels with every row, all rows once per repeat, so that a drift of
// the clock meets all alike. Errors: ErrorKind::unavailable where Vulkan cannot be used.
Result<std::vector<DeviceTiming>> timeRows(const std::vector<const Row*>& rows, const TimingOptions& options);

} // namespace cotan::cost
