#include "files/json.hpp"

#include <algorithm>

#include "files/old_fields.hpp"

namespace cotan {

namespace {

// Adding a field keeps the version of a report. Removing or renaming a field, or changing its type or meaning, raises
// that report's version alone.
int versionOf(std::string_view format) { return format.starts_with("cotan-lint") ? 2 : 1; }

} // namespace

std::string toText(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

Json versioned(std::string_view format, const Json& report)
{
    Json all = {{"format", format}, {"version", versionOf(format)}};
    all.update(report);
    addOldFields(all);
    return all;
}

Json versioned(const Json& report)
{
    std::string format = "cotan-" + report.at("command").get<std::string>(); // "cotan-map-detect"
    std::ranges::replace(format, ' ', '-');
    return versioned(format, report);
}

} // namespace cotan
