#include "files/report/report_format.hpp"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <string>

namespace cotan {

namespace {

// A field may be added within a version. One that goes, is renamed, or changes its type or meaning, raises it.
struct ReportFormat {
    std::string_view name;
    int version = 1;
};

constexpr ReportFormat kFormats[] = {
    {"cotan-accuracy"},
    {"cotan-bake"},
    {"cotan-batch"},
    {"cotan-compare"},
    {"cotan-convert"},
    {"cotan-cost"},
    {"cotan-figures"},
    {"cotan-lint"},
    {"cotan-map-blend"},
    {"cotan-map-convert"},
    {"cotan-map-detect"},
    {"cotan-map-diff"},
    {"cotan-map-from-height"},
    {"cotan-map-info"},
    {"cotan-map-mips"},
    {"cotan-map-to-height"},
    {"cotan-render"},
    {"cotan-shader"},
    {"cotan-tangents"},
    {"cotan-view"},
    // Of the library, in C, Python and JavaScript.
    {"cotan-convert-result"},
    {"cotan-lint-result"},
    {"cotan-render-result"},
};

} // namespace

Json versioned(std::string_view format, const Json& report)
{
    const auto* const known = std::ranges::find(kFormats, format, &ReportFormat::name);
    assert(known != std::end(kFormats));
    Json all = {{"format", format}, {"version", known != std::end(kFormats) ? known->version : 1}};
    all.update(report);
    return all;
}

Json versioned(const Json& report)
{
    const auto& members = std::get<Json::Object>(report.value());
    const auto command = std::ranges::find(members, "command", &Json::Object::value_type::first);
    assert(command != members.end());
    std::string format = "cotan-" + std::get<std::string>(command->second.value()); // "cotan-map-detect"
    std::ranges::replace(format, ' ', '-');
    return versioned(format, report);
}

} // namespace cotan
