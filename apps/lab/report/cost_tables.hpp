// The results of `cotan cost` as readable markdown tables, JSON and CSV.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "cost/price.hpp"
#include "files/json.hpp"

namespace cotan {

// chart: file name of the chart from costChart, for a link in the text; empty: no link.
std::string toMarkdown(const cost::CostReport& report, const std::string& chart = {});
Json toJson(const cost::CostReport& report);

// One number per line: row,source,device,driver,measure,value. Values are absolute, not relative to the floor.
std::string toCsv(const cost::CostReport& report);

// An SVG file, readable on light and dark backgrounds: cost of a triangle by the pixels it covers, for each of
// cost::choices(), relative to stored tangents. Shows NAVI21, or else the first device with the necessary numbers;
// nothing if there is none.
std::optional<std::string> costChart(const cost::CostReport& report);

// Writes the tables. If the file exists and contains the two marks, replaces only the text between them. Errors: those
// of writeFileWhole.
Status writeTables(const std::filesystem::path& file, const std::string& tables);

} // namespace cotan
