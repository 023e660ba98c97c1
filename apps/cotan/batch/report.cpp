#include "batch/report.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <tuple>

#include <fmt/format.h>

namespace cotan::app {

namespace {

// Rank in badness. Jobs that exceed a measured limit are worse than failed ones, which say nothing about the model.
int rankOf(JobState state)
{
    constexpr JobState kGoodFirst[] = {JobState::done,  JobState::notRun, JobState::skipped, JobState::failed,
                                       JobState::limit, JobState::late,   JobState::memory,  JobState::crashed};
    return int(std::ranges::find(kGoodFirst, state) - std::begin(kGoodFirst));
}

} // namespace

std::vector<std::size_t> worstFirst(const std::vector<JobResult>& results)
{
    std::vector<std::size_t> order(results.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    const auto badness = [&](std::size_t i) {
        const JobRecord& record = results[i].record;
        return std::tuple(rankOf(record.state), record.degrees ? record.degrees->mean : -1.0);
    };
    std::ranges::stable_sort(order, std::greater<>(), badness);
    return order;
}

StateCounts countsOf(const std::vector<JobResult>& results)
{
    StateCounts counts{};
    for (const JobResult& result : results)
        ++counts[std::size_t(result.record.state)];
    return counts;
}

std::string summaryOf(const std::vector<JobResult>& results)
{
    const StateCounts counts = countsOf(results);
    const auto kept = std::ranges::count_if(results, &JobResult::kept);
    std::string text = fmt::format("{} job{}", results.size(), results.size() == 1 ? "" : "s");
    const char* before = ": ";
    for (std::size_t state = 0; state < counts.size(); ++state)
        if (counts[state] > 0) {
            text += fmt::format("{}{} {}", before, counts[state], name(JobState(state)));
            before = ", ";
        }
    return text + (kept > 0 ? fmt::format("; {} from an earlier run", kept) : "");
}

Json batchJson(const JobList& list, const std::vector<JobResult>& results)
{
    const auto names = [](const std::vector<FileState>& states) {
        Json files = Json::array();
        for (const FileState& state : states)
            files.push_back(state.file);
        return files;
    };
    Json counts = Json::object();
    const StateCounts numbers = countsOf(results);
    for (std::size_t state = 0; state < numbers.size(); ++state)
        counts[name(JobState(state))] = numbers[state];
    Json jobs = Json::array();
    for (const std::size_t i : worstFirst(results)) {
        const JobRecord& r = results[i].record;
        const Job& job = list.jobs[results[i].job];
        jobs.push_back({{"name", job.name},
                        {"line", job.line},
                        {"command", job.words},
                        {"state", name(r.state)},
                        {"code", r.code ? Json(*r.code) : Json()},
                        {"signal", r.signal ? Json(*r.signal) : Json()},
                        {"runs", r.runs},
                        {"reason", r.reason},
                        {"kept", results[i].kept},
                        {"degrees", r.degrees ? Json(r.degrees->mean) : Json()},
                        {"degrees_of", r.degrees ? Json(r.degrees->of) : Json()},
                        {"seconds", r.seconds},
                        {"processor_seconds", r.processorSeconds},
                        {"megabytes", r.megabytes},
                        {"inputs", names(r.inputs)},
                        {"outputs", names(r.outputs)}});
    }
    return {{"command", "batch"}, {"counts", counts}, {"jobs", jobs}};
}

} // namespace cotan::app
