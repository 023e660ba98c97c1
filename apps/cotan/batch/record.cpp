#include "batch/record.hpp"

#include <array>
#include <cmath>

#include "files/json.hpp"

namespace cotan::app {

// JSON of the parts of a record, which the library finds by these names.
static void to_json(Json& j, const FileState& s)
{
    j = {{"file", s.file},         {"digest", s.digest},   {"bytes", s.bytes},
         {"modified", s.modified}, {"changed", s.changed}, {"number", s.number}};
}

static void from_json(const Json& j, FileState& s)
{
    s = {j.at("file"), j.at("digest"), j.at("bytes"), j.at("modified"), j.at("changed"), j.at("number")};
}

namespace {

constexpr int kFormat = 2;

constexpr std::array<std::string_view, 8> kStates = {"done",   "over limit", "not run",       "skipped",
                                                     "failed", "too slow",   "out of memory", "crashed"};

Json orNull(const std::optional<int>& number) { return number ? Json(*number) : Json(nullptr); }

std::optional<int> numberIn(const Json& j) { return j.is_null() ? std::nullopt : std::optional(j.get<int>()); }

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
double valueAt(const Json& j, std::string_view path)
{
    if (path.empty())
        return j.is_number() ? j.get<double>() : NAN;
    const std::size_t slash = std::min(path.find('/'), path.size());
    std::string_view names = path.substr(0, slash);
    const std::string_view rest = path.substr(std::min(slash + 1, path.size()));
    double found = NAN;
    if (names == "*") {
        for (const Json& item : j.is_array() ? j : Json::array())
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

std::string_view name(JobState state) { return kStates[std::size_t(state)]; }

bool repeatable(const JobRecord& record)
{
    constexpr int kUsage = 1, kInput = 2;
    return isGood(record) || (record.state == JobState::failed && (record.code == kUsage || record.code == kInput));
}

std::string toText(const JobRecord& r, const std::vector<std::string>& words, const std::string& version)
{
    Json j = {{"format", kFormat},
              {"version", version},
              {"words", words},
              {"state", name(r.state)},
              {"code", orNull(r.code)},
              {"signal", orNull(r.signal)},
              {"runs", r.runs},
              {"reason", r.reason},
              {"said", r.output},
              {"seconds", r.seconds},
              {"processor_seconds", r.processorSeconds},
              {"megabytes", r.megabytes},
              {"at", r.at},
              {"inputs", r.inputs},
              {"outputs", r.outputs}};
    if (r.degrees)
        j["degrees"] = {{"mean", r.degrees->mean}, {"of", r.degrees->of}};
    if (!r.thumbnail.jpeg.empty())
        j["thumbnail"] = {{"width", r.thumbnail.width}, {"height", r.thumbnail.height}, {"jpeg", r.thumbnail.jpeg}};
    return j.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::optional<JobRecord> parseRecord(std::string_view text)
{
    try {
        const Json j = Json::parse(text);
        const auto state = std::ranges::find(kStates, j.at("state").get<std::string>());
        if (j.at("format") != kFormat || state == kStates.end())
            return std::nullopt;
        JobRecord r;
        r.state = JobState(state - kStates.begin());
        r.code = numberIn(j.at("code"));
        r.signal = numberIn(j.at("signal"));
        r.runs = j.at("runs");
        r.reason = j.at("reason");
        r.output = j.at("said");
        r.seconds = j.at("seconds");
        r.processorSeconds = j.at("processor_seconds");
        r.megabytes = j.at("megabytes");
        r.inputs = j.at("inputs");
        r.outputs = j.at("outputs");
        r.at = j.at("at");
        if (j.contains("degrees"))
            r.degrees = Degrees{j["degrees"].at("mean"), j["degrees"].at("of")};
        if (j.contains("thumbnail"))
            r.thumbnail = {j["thumbnail"].at("width"), j["thumbnail"].at("height"), j["thumbnail"].at("jpeg")};
        return r;
    } catch (const Json::exception&) { // a truncated or foreign file
        return std::nullopt;
    }
}

std::optional<Degrees> degreesIn(std::string_view report)
{
    const Json j = Json::parse(report, nullptr, /*allow_exceptions*/ false);
    if (!j.is_object() || !j.contains("command") || !j["command"].is_string())
        return std::nullopt;
    const std::string command = j["command"];
    for (const DegreesPath& entry : kDegreesPaths)
        if (command == entry.command)
            if (const double degrees = valueAt(j, entry.path); std::isfinite(degrees))
                return Degrees{degrees, entry.of};
    return std::nullopt;
}

} // namespace cotan::app
