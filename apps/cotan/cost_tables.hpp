// The tables of `cotan cost`: markdown, which reads well as it is, JSON and CSV.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "cotan/cost/machine_code.hpp"
#include "cotan/cost/scalar_count.hpp"
#include "cotan/cost/timing.hpp"

namespace cotan::app {

struct CostReport {
    std::string machine;
    std::vector<const cost::Row*> rows; // the floor first
    std::vector<cost::DeviceCode> code;
    std::vector<cost::DeviceTiming> timing;
    std::string timingSilence; // why there is none at all
};

std::string toMarkdown(const CostReport& report);
nlohmann::ordered_json toJson(const CostReport& report);

// One number a line: row,source,device,driver,measure,value. Values are absolute, not over the
// floor.
std::string toCsv(const CostReport& report);

} // namespace cotan::app
