// What the JSON reports are called, and which version of their fields this program writes. docs/reference/json.md lists
// the fields; tests/json_fields_test.py holds it against what commands write.
#pragma once

#include <string_view>

#include "files/report/json.hpp"

namespace cotan {

// The report with "format" and "version" before its own members. format: a name of the
// list in report_format.cpp.
Json versioned(std::string_view format, const Json& report);

// The same for a command's, by its own member "command".
Json versioned(const Json& report);

} // namespace cotan
