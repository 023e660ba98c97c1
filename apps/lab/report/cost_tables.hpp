// The tables of `cotan cost`: markdown, which reads well as it is, JSON and CSV.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "cost/price.hpp"
#include "files/report/json.hpp"

namespace cotan {

// chart: name of the picture that costChart makes, as the text shall link it; empty: none.
std::string toMarkdown(const cost::CostReport& report, const std::string& chart = {});
Json toJson(const cost::CostReport& report);

// One number a line: row,source,device,driver,measure,value. Values are absolute, not over the
// floor.
std::string toCsv(const cost::CostReport& report);

// Cost of a triangle by the pixels it covers, for each of cost::choices() against stored tangents, as a whole SVG file
// that reads well on light and on dark. Of NAVI21, or else of the first device that says what it needs; nothing where
// none does.
std::optional<std::string> costChart(const cost::CostReport& report);

// Writes the tables. Where the file is there and has two marks, only what is between them is replaced. Errors: as
// writeFileWhole.
Status writeTables(const std::filesystem::path& file, const std::string& tables);

} // namespace cotan
