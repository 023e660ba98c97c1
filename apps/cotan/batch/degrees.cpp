#include <algorithm>
#include <cmath>
#include <string>

#include <nlohmann/json.hpp>

#include "batch/record.hpp"

namespace cotan {

namespace {

using nlohmann::json;

// Where the JSON report of a command has its degrees. "*" is every item of a list, and the worst counts; names between
// bars are alternatives, and the best counts.
struct DegreesPath {
    const char *command, *path, *of;
};

// The first entry with a number in the report counts.
constexpr DegreesPath kDegreesPaths[] = {
    {"lint", "fits/*/orthonormal|cotangent|smooth/mean", "read without tangents"},
    {"bake", "verify/all/mean_degrees", "against the detailed mesh"},
    {"bake", "objects/*/verify/all/mean_degrees", "against the detailed mesh"},
    {"convert", "verify/degrees/mean_degrees", "drawn, against the original"},
    {"convert", "maps/*/degrees_after_rounding|degrees_unconverted/mean", "read with the new frame"},
    {"compare", "normals/mean_degrees", "between the frames"},
    {"map diff", "angles/mean_degrees", "between the maps"},
    {"tangents", "whole/directions/mean_degrees", "stored tangents"},
};

// The number at `path`; NaN: none.
double valueAt(const json& j, std::string_view path)
{
    if (path.empty())
        return j.is_number() ? j.get<double>() : NAN;
    const std::size_t slash = std::min(path.find('/'), path.size());
    std::string_view names = path.substr(0, slash);
    const std::string_view rest = path.substr(std::min(slash + 1, path.size()));
    double found = NAN;
    if (names == "*") {
        for (const json& item : j.is_array() ? j : json::array())
            found = std::fmax(found, valueAt(item, rest)); // fmax prefers numbers to NaN
        return found;
    }
    while (!names.empty()) {
        const std::size_t bar = std::min(names.find('|'), names.size());
        const std::string member(names.substr(0, bar));
        if (j.is_object() && j.contains(member))
            found = std::fmin(found, valueAt(j[member], rest));
        names.remove_prefix(std::min(bar + 1, names.size()));
    }
    return found;
}

} // namespace

std::optional<Degrees> degreesIn(std::string_view report)
{
    const json j = json::parse(report, nullptr, /*allow_exceptions*/ false);
    if (!j.is_object() || !j.contains("command") || !j["command"].is_string())
        return std::nullopt;
    const std::string command = j["command"];
    for (const DegreesPath& entry : kDegreesPaths)
        if (command == entry.command)
            if (const double degrees = valueAt(j, entry.path); std::isfinite(degrees))
                return Degrees{degrees, entry.of};
    return std::nullopt;
}

} // namespace cotan
