// All costs in one call.
#pragma once

#include <string>
#include <vector>

#include "cost/machine_code.hpp"
#include "cost/timing.hpp"
#include "cotan/result.hpp"

namespace cotan::cost {

struct PriceOptions {
    std::vector<std::string> frames;   // rows besides floor and mikktspace; empty: all
    std::vector<std::string> devices;  // devices whose name contains one of these; empty: all
    std::vector<std::string> families; // GPU families that Mesa's Radeon driver compiles for without the GPU; empty:
                                       // the usual ones, if `devices` is empty too
    std::string cards;                 // output of gpusToCsv; if not empty, no driver is queried and nothing is timed
    std::string name;                  // name of the device in tables; empty: its own name
    bool timing = true;
    bool timeCpuDevices = false;     // also time drivers that render on the CPU
    int repeats = 15;                // number of draws, whose median is taken
    std::filesystem::path program{}; // as for machineCodeOfDevices
    Progress progress{};
};

struct CostReport {
    std::string machine;          // the operating system and its processor architecture
    std::vector<const Row*> rows; // the floor first
    std::vector<DeviceCode> code;
    bool gpusRead = false; // `code` was read from a file, not queried here
    std::vector<DeviceTiming> timing;
    std::string timingSilence; // why there are no times at all
    std::string codeSilence;   // why no driver reported machine code; empty if one did
};

// Errors: ErrorKind::usage: "options.frames: ..." for an unknown row name; ErrorKind::input: "options.cards: line N:
// ..."; ErrorKind::stopped. A driver that cannot be queried is no error.
Result<CostReport> price(const PriceOptions& options);

} // namespace cotan::cost
