// The compute passes of examples/deforming, by the clock of the device.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace cotan::bench {

struct PassTimes {
    std::string name, makes;
    std::vector<double> nanoseconds; // of a million triangles, each repetition
};

// Derives frames of a tube of `around` x `along` x 2 triangles, posed, all passes in turn. `device` is set to the name
// of the device that did it. Throws std::exception where there is none.
std::vector<PassTimes> timePasses(std::uint32_t around, std::uint32_t along, int repeats, std::string& device);

} // namespace cotan::bench
