// All prices in one call.
#pragma once

#include <string>
#include <vector>

#include "cost/machine_code.hpp"
#include "cost/timing.hpp"
#include "cotan/result.hpp"

namespace cotan::cost {

struct PriceOptions {
    std::vector<std::string> frames;   // rows besides floor and mikktspace; empty: all
    std::vector<std::string> devices;  // those with one of these in their name; empty: all
    std::vector<std::string> families; // cards that Mesa's Radeon driver compiles for without the card; empty: the
                                       // usual ones, where `devices` is empty too
    std::string cards;                 // text that cardsToCsv wrote; not empty: no driver is asked, nothing is timed
    std::string name;                  // what tables call a device, where there is one: empty: by its own name
    bool timing = true;
    bool timeCpuDevices = false; // take times also where a driver draws on the processor
    int repeats = 15;            // draws of which the median is taken
    Progress progress{};
};

struct CostReport {
    std::string machine;          // the system and its processor
    std::vector<const Row*> rows; // the floor first
    std::vector<DeviceCode> code;
    bool cardsRead = false; // `code` was read, not asked for here
    std::vector<DeviceTiming> timing;
    std::string timingSilence; // why there is none at all
    std::string codeSilence;   // why no driver said anything of machine code; empty where one did
};

// Errors: ErrorKind::usage: "options.frames: ..." for a name that is no row's; ErrorKind::input: "options.cards: line
// N: ..."; ErrorKind::stopped. A driver that cannot be asked is no error.
Result<CostReport> price(const PriceOptions& options);

} // namespace cotan::cost
