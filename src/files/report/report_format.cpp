#include "files/report/report_format.hpp"

#include <algorithm>
#include <cassert>
#include <iterator>

namespace cotan {

namespace {

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

std::span<const ReportFormat> reportFormats() { return kFormats; }

std::string formatOfCommand(std::string_view command)
{
    std::string name = "cotan-" + std::string(command);
    std::ranges::replace(name, ' ', '-');
    return name;
}

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
    return versioned(formatOfCommand(std::get<std::string>(command->second.value())), report);
}

} // namespace cotan
