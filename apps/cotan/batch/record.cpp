#include "batch/record.hpp"

#include <algorithm>
#include <array>

#include <nlohmann/json.hpp>

namespace cotan {

namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr int kFormat = 2;

constexpr std::array<std::string_view, 8> kStates = {"done",   "over limit", "not run",       "skipped",
                                                     "failed", "too slow",   "out of memory", "crashed"};

ordered_json toJson(const FileState& state)
{
    return {{"file", state.file},         {"digest", state.digest},   {"bytes", state.bytes},
            {"modified", state.modified}, {"changed", state.changed}, {"number", state.number}};
}

ordered_json toJson(const std::vector<FileState>& states)
{
    auto list = ordered_json::array();
    for (const FileState& state : states)
        list.push_back(toJson(state));
    return list;
}

ordered_json orNull(const std::optional<int>& number) { return number ? ordered_json(*number) : ordered_json(nullptr); }

std::optional<int> numberIn(const json& j) { return j.is_null() ? std::nullopt : std::optional(j.get<int>()); }

std::vector<FileState> statesIn(const json& list)
{
    std::vector<FileState> states;
    for (const json& j : list)
        states.push_back(
            {j.at("file"), j.at("digest"), j.at("bytes"), j.at("modified"), j.at("changed"), j.at("number")});
    return states;
}

} // namespace

std::string_view name(JobState state) { return kStates[std::size_t(state)]; }

bool repeatable(const JobRecord& record)
{
    constexpr int kUsage = 1, kInput = 2;
    return record.state == JobState::done || record.state == JobState::limit
        || (record.state == JobState::failed && (record.code == kUsage || record.code == kInput));
}

std::string toText(const JobRecord& r, const std::vector<std::string>& words, const std::string& version)
{
    ordered_json j = {{"format", kFormat},
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
                      {"inputs", toJson(r.inputs)},
                      {"outputs", toJson(r.outputs)}};
    if (r.degrees)
        j["degrees"] = {{"mean", r.degrees->mean}, {"of", r.degrees->of}};
    if (!r.thumbnail.jpeg.empty())
        j["thumbnail"] = {{"width", r.thumbnail.width}, {"height", r.thumbnail.height}, {"jpeg", r.thumbnail.jpeg}};
    return j.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::optional<JobRecord> parseRecord(std::string_view text)
{
    try {
        const json j = json::parse(text);
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
        r.at = j.at("at");
        r.inputs = statesIn(j.at("inputs"));
        r.outputs = statesIn(j.at("outputs"));
        if (j.contains("degrees"))
            r.degrees = Degrees{j["degrees"].at("mean"), j["degrees"].at("of")};
        if (j.contains("thumbnail"))
            r.thumbnail = {j["thumbnail"].at("width"), j["thumbnail"].at("height"), j["thumbnail"].at("jpeg")};
        return r;
    } catch (const json::exception&) { // a truncated or foreign file
        return std::nullopt;
    }
}

} // namespace cotan
