// Measures the draw time of the rows on devices with timestamps.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "cost/rows.hpp"
#include "cotan/result.hpp"

namespace cotan::cost {

// A square of pixels, covered by one draw call.
struct TimingCase {
    int leg = 16;    // pixels: legs of right-angled triangles, two of which form a square
    int samples = 1; // per pixel: 1, 2, 4, 8
    int layers = 1;  // how many times each pixel is shaded; there is no depth test
    int side = 1024; // pixels, a multiple of leg
};

struct TimedRow {
    std::string_view row;
    std::vector<double> nanosecondsPerMillionPixels; // medians, one per case; a pixel counts once per layer
    std::vector<std::vector<double>> repeats;        // all measurements per case; entry r of all rows is from one round
    // Vertices of the mesh drawn, per case; more if triangles own their provoking vertices (cotan/gpu_meshes.hpp).
    std::vector<std::uint32_t> vertices;
};

struct SkippedCase {
    TimingCase what;
    std::string why;
};

struct DeviceTiming {
    std::string name;
    std::string driver;
    bool cpu = false;    // draws on the CPU: says little about a GPU
    std::string silence; // why there are no numbers; empty if there are
    std::vector<TimingCase> cases;
    std::vector<SkippedCase> skipped;
    std::vector<TimedRow> rows;
};

// Legs, in pixels, of right-angled triangles of which two form a square.
const std::vector<int>& triangleLegs();
// One case per triangle size.
std::vector<TimingCase> usualCases();

struct TimingOptions {
    std::vector<std::string> devices; // as for machineCodeOfDevices
    bool cpuDevices = false;          // time CPU devices too
    int repeats = 15;                 // number of measurements, whose median is taken
    std::vector<TimingCase> cases = usualCases();
    double seconds = std::numeric_limits<double>::infinity();         // cases that would end later are skipped
    std::size_t maxDevices = std::numeric_limits<std::size_t>::max(); // only the first ones are timed
};

// Draws each case with every row. Each repeat draws all rows once, so that clock drift affects all rows equally.
// Errors: ErrorKind::unavailable if Vulkan cannot be used.
Result<std::vector<DeviceTiming>> timeRows(const std::vector<const Row*>& rows, const TimingOptions& options);

} // namespace cotan::cost
