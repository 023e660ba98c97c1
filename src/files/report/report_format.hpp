// What the JSON reports are called, and which version of their fields this program writes. docs/reference/json.md lists
// the fields; tests/json_fields_test.py holds it against what commands write.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "files/report/json.hpp"

namespace cotan {

// A field may be added within a version. One that goes, is renamed, or changes its type or meaning, raises it.
struct ReportFormat {
    std::string_view name; // "cotan-map-detect", of `cotan map detect`
    int version = 1;
};

// All that there are.
std::span<const ReportFormat> reportFormats();

// The name of a command's report: "cotan-map-detect" of "map detect".
std::string formatOfCommand(std::string_view command);

// The report with "format" and "version" before its own members. format: a name of reportFormats().
Json versioned(std::string_view format, const Json& report);

// The same for a command's, by its own member "command".
Json versioned(const Json& report);

} // namespace cotan
