// GPU machine code statistics as CSV: collected on one machine, turned into documents on another.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cost/machine_code.hpp"

namespace cotan::cost {

// Returns one line per stage of each GPU: maker,card,device,driver,date,stage,row, then instructions, arithmetic,
// registers, code bytes, inverse throughput and latency, each empty if the driver does not report it, then why
// compilation failed. A GPU without any numbers has one line, with the stage `silence`.
std::string gpusToCsv(const std::vector<DeviceCode>& gpus);

// Parses the output of gpusToCsv. The lines of one GPU must be consecutive. Unknown rows and stages are ignored;
// missing ones stay empty. Several such files may be concatenated, each with its header. Errors: ErrorKind::input:
// "line N: ...".
Result<std::vector<DeviceCode>> gpusFromCsv(std::string_view text);

} // namespace cotan::cost
