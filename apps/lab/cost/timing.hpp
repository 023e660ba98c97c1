// How long the rows take, on devices with timestamps.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "cost/rows.hpp"
#include "cotan/result.hpp"

namespace cotan::cost {

// A square of pixels, drawn in one draw.
struct TimingCase {
    int leg = 16;    // pixels: of right-angled triangles, two to a square
    int samples = 1; // a pixel: 1, 2, 4, 8
    int layers = 1;  // how often every pixel is shaded: nothing hides what is beneath
    int side = 1024; // pixels, a multiple of leg
};

struct TimedRow {
    std::string_view row;
    std::vector<double> nanosecondsPerMillionPixels; // medians, one per case; a pixel counts once per layer
    std::vector<std::vector<double>> repeats;        // per case what the median is of: entry r of all rows is one turn
    // One per case: of the mesh that is drawn. More where triangles own their provoking vertices
    // (cotan/gpu_meshes.hpp).
    std::vector<std::uint32_t> vertices;
};

struct SkippedCase {
    TimingCase what;
    std::string why;
};

struct DeviceTiming {
    std::string name;
    std::string driver;
    bool cpu = false;    // draws on the processor: says little about a GPU
    std::string silence; // why there are no numbers; empty where there are
    std::vector<TimingCase> cases;
    std::vector<SkippedCase> skipped;
    std::vector<TimedRow> rows;
};

// Right-angled triangles with legs of these many pixels, two to a square.
const std::vector<int>& triangleLegs();
// One case for each.
std::vector<TimingCase> usualCases();

struct TimingOptions {
    std::vector<std::string> devices; // as for machineCodeOfDevices
    bool cpuDevices = false;          // time those too
    int repeats = 15;                 // of which the median is taken
    std::vector<TimingCase> cases = usualCases();
    double seconds = std::numeric_limits<double>::infinity();   // cases that would end later are skipped
    std::size_t most = std::numeric_limits<std::size_t>::max(); // devices: the first ones
};

// Draws each case with every row, all rows once per repeat, so that a drift of the clock meets all alike.
// Errors: ErrorKind::unavailable where Vulkan cannot be used.
Result<std::vector<DeviceTiming>> timeRows(const std::vector<const Row*>& rows, const TimingOptions& options);

} // namespace cotan::cost
