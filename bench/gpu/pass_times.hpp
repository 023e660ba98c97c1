// Times the compute passes of examples/deforming with GPU timestamps.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace cotan::bench {

struct PassTimes {
    std::string name, makes;
    std::vector<double> nanoseconds; // per million triangles, one entry per repetition
};

// Derives frames of a posed tube of `around` x `along` x 2 triangles, running all passes in turn. `device` receives the
// name of the device. Throws std::exception if there is none.
std::vector<PassTimes> timePasses(std::uint32_t around, std::uint32_t along, int repeats, std::string& device);

} // namespace cotan::bench
