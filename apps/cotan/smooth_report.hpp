// Statistics of the cotangents that the frame `smooth` derives, in texts and reports.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "cotan/report/smooth_statistics.hpp"

namespace cotan::app {

// Adds the figures to `row` and returns them as one line.
std::string reportSmooth(const SmoothStatistics& statistics, nlohmann::ordered_json& row);

} // namespace cotan::app
