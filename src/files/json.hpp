// JSON of files and reports. Objects keep the order in which members were added.
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace cotan {

using Json = nlohmann::ordered_json;

// Serialises indented by two columns, with a final newline. Non-finite numbers become null; bad UTF-8 is replaced.
std::string toText(const Json& json);

// Returns the report with "format" and "version" before its own members: its name, and the version of its fields that
// this program writes. docs/reference/json.md lists the formats and their fields; tests/json_fields_test.py compares it
// with the output of commands.
Json versioned(std::string_view format, const Json& report);

// Likewise for a command's report, whose format follows from its member "command".
Json versioned(const Json& report);

} // namespace cotan
