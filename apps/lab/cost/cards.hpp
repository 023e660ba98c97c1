// Machine code of cards as a table in a file: what one machine asked, another makes documents of.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cost/machine_code.hpp"

namespace cotan::cost {

// A line for each stage of each card: maker,card,device,driver,date,stage,row, then instructions, arithmetic,
// registers, code bytes, inverse throughput and latency, empty where the driver gives none, then why it did not
// compile. A card that gave nothing has one line, stage `silence`.
std::string cardsToCsv(const std::vector<DeviceCode>& cards);

// Reads that again. Lines of one card stand together; rows and stages that this program does not know are left out,
// those that are missing are empty. Files may stand one behind the other, each with its header. Errors:
// ErrorKind::input: "line N: ...".
Result<std::vector<DeviceCode>> cardsFromCsv(std::string_view text);

} // namespace cotan::cost
