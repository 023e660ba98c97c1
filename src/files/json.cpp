#include "files/json.hpp"

#include <algorithm>

namespace cotan {

namespace {

// Version of all formats so far. Adding a field keeps the version. Removing or renaming a field, or changing its type
// or meaning, raises that report's version alone: the first such report gets its own number beside its name.
constexpr int kVersion = 1;

} // namespace

std::string toText(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

Json versioned(std::string_view format, const Json& report)
{
    Json all = {{"format", format}, {"version", kVersion}};
    all.update(report);
    return all;
}

Json versioned(const Json& report)
{
    std::string format = "cotan-" + report.at("command").get<std::string>(); // "cotan-map-detect"
    std::ranges::replace(format, ' ', '-');
    return versioned(format, report);
}

} // namespace cotan
