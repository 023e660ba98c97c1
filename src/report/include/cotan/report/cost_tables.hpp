// The tables of `cotan cost`: markdown, which reads well as it is, JSON and CSV.
#pragma once

#include <string>

#include "cotan/cost/price.hpp"
#include "cotan/report/json.hpp"

namespace cotan {

std::string toMarkdown(const cost::CostReport& report);
Json toJson(const cost::CostReport& report);

// One number a line: row,source,device,driver,measure,value. Values are absolute, not over the
// floor.
std::string toCsv(const cost::CostReport& report);

// A text with new tables between its two marks; where it has none, the tables alone.
std::string withTables(const std::string& text, const std::string& tables);

} // namespace cotan
