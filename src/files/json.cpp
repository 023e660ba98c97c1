#include "files/json.hpp"

#include <algorithm>
#include <cassert>
#include <iterator>

namespace cotan {

namespace {

// Names of all report formats. The last three are those of the library in C, Python and JavaScript.
constexpr std::string_view kFormats[] = {
    "cotan-accuracy",        "cotan-bake",        "cotan-batch",        "cotan-compare",
    "cotan-convert",         "cotan-cost",        "cotan-figures",      "cotan-lint",
    "cotan-map-blend",       "cotan-map-convert", "cotan-map-detect",   "cotan-map-diff",
    "cotan-map-from-height", "cotan-map-info",    "cotan-map-mips",     "cotan-map-to-height",
    "cotan-render",          "cotan-shader",      "cotan-tangents",     "cotan-view",
    "cotan-convert-result",  "cotan-lint-result", "cotan-render-result"};

// Version of all formats so far. Adding a field keeps the version. Removing or renaming a field, or changing its type
// or meaning, raises that report's version alone: the first such report gets its own number beside its name.
constexpr int kVersion = 1;

} // namespace

std::string toText(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

Json versioned(std::string_view format, const Json& report)
{
    [[maybe_unused]] const bool known = std::ranges::find(kFormats, format) != std::end(kFormats);
    assert(known);
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
