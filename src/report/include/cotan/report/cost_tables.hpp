// The tables of `cotan cost`: markdown, which reads well as it is, JSON and CSV.
#pragma once

#include <filesystem>
#include <string>

#include "cotan/cost/price.hpp"
#include "cotan/report/json.hpp"

namespace cotan {

std::string toMarkdown(const cost::CostReport& report);
Json toJson(const cost::CostReport& report);

// One number a line: row,source,device,driver,measure,value. Values are absolute, not over the
// floor.
std::string toCsv(const cost::CostReport& report);

// Writes the tables. Where the file is there and has two marks, only what is between them is replaced. Errors: as
// writeFileWhole.
Status writeTables(const std::filesystem::path& file, const std::string& tables);

} // namespace cotan
