#include "batch/plan.hpp"

#include <algorithm>
#include <charconv>
#include <unordered_map>

#include <fmt/format.h>

#include "core/groups.hpp"

namespace cotan {

namespace fs = std::filesystem;

namespace {

std::string placeOf(const JobList& list, const std::string& file)
{
    fs::path place = (list.folder / file).lexically_normal();
    return place.has_filename() ? place.string() : place.parent_path().string(); // folders with a slash at the end
}

// Who writes a file: itself, or a folder that it is in.
const std::size_t* writerOf(const std::unordered_map<std::string, std::size_t>& writers, fs::path place)
{
    for (;;) {
        if (const auto found = writers.find(place.string()); found != writers.end())
            return &found->second;
        if (!place.has_relative_path())
            return nullptr;
        place = place.parent_path();
    }
}

// A line of jobs that ends where it began, empty where there is none. Depth first, without recursion.
std::vector<std::size_t> findCircle(const std::vector<std::vector<std::size_t>>& needs)
{
    enum class Mark { fresh, open, done };
    std::vector<Mark> marks(needs.size(), Mark::fresh);
    for (std::size_t start = 0; start < needs.size(); ++start) {
        std::vector<std::pair<std::size_t, std::size_t>> path; // a job, and how many of its needs were followed
        if (marks[start] == Mark::fresh)
            path.emplace_back(start, 0);
        while (!path.empty()) {
            auto& [job, next] = path.back();
            marks[job] = Mark::open;
            if (next == needs[job].size()) {
                marks[job] = Mark::done;
                path.pop_back();
                continue;
            }
            const std::size_t need = needs[job][next++];
            if (marks[need] == Mark::fresh) {
                path.emplace_back(need, 0);
            } else if (marks[need] == Mark::open) {
                std::vector<std::size_t> circle;
                for (auto at = std::ranges::find(path, need, &std::pair<std::size_t, std::size_t>::first);
                     at != path.end(); ++at)
                    circle.push_back(at->first);
                return circle;
            }
        }
    }
    return {};
}

// Numbers for what hangs together, in the order of the first job of each.
std::vector<std::size_t> groupsOf(const std::vector<std::vector<std::size_t>>& needs)
{
    JoinedGroups joined(needs.size());
    for (std::size_t job = 0; job < needs.size(); ++job)
        for (const std::size_t need : needs[job])
            joined.join(std::uint32_t(job), std::uint32_t(need));
    std::vector<std::size_t> group(needs.size());
    std::size_t count = 0;
    for (std::size_t job = 0; job < needs.size(); ++job) {
        const std::size_t first = joined.find(std::uint32_t(job));
        group[job] = first == job ? count++ : group[first];
    }
    return group;
}

} // namespace

Result<Plan> planJobs(const JobList& list)
{
    std::unordered_map<std::string, std::size_t> writers;
    for (std::size_t i = 0; i < list.jobs.size(); ++i)
        for (const std::string& output : list.jobs[i].outputs) {
            const auto [known, isNew] = writers.emplace(placeOf(list, output), i);
            if (!isNew && known->second != i)
                return inputError(fmt::format("line {}: writes {}, which line {} writes, too", list.jobs[i].line,
                                              output, list.jobs[known->second].line));
        }
    Plan plan;
    plan.needs.resize(list.jobs.size());
    for (std::size_t i = 0; i < list.jobs.size(); ++i)
        for (const std::string& input : list.jobs[i].inputs) {
            const fs::path place = placeOf(list, input);
            const std::size_t* writer = writerOf(writers, place);
            if (!writer)
                continue;
            if (*writer == i && writers.contains(place.string()))
                return inputError(fmt::format("line {}: writes {}, which it reads: a second run would begin from what "
                                              "the first one left; expected another name",
                                              list.jobs[i].line, input));
            if (*writer != i && std::ranges::find(plan.needs[i], *writer) == plan.needs[i].end())
                plan.needs[i].push_back(*writer);
        }
    if (const auto circle = findCircle(plan.needs); !circle.empty()) {
        std::string lines;
        for (const std::size_t job : circle)
            lines += fmt::format("line {} waits for ", list.jobs[job].line);
        return inputError(
            fmt::format("{}line {}: each reads what the next one writes", lines, list.jobs[circle.front()].line));
    }
    plan.group = groupsOf(plan.needs);
    return plan;
}

Result<Shard> parseShard(const std::string& text)
{
    const auto wrong = [&] {
        return usageError("--shard: expected K/N with K from 1 to N, such as 3/8; found '" + text + "'");
    };
    const std::size_t slash = text.find('/');
    if (slash == std::string::npos)
        return wrong();
    const auto number = [&](std::size_t from, std::size_t to, std::size_t& value) {
        const auto [end, error] = std::from_chars(text.data() + from, text.data() + to, value);
        return error == std::errc() && end == text.data() + to;
    };
    Shard shard;
    if (!number(0, slash, shard.number) || !number(slash + 1, text.size(), shard.of) || shard.number < 1
        || shard.number > shard.of)
        return wrong();
    return shard;
}

std::vector<std::size_t> jobsOf(const Plan& plan, const Shard& shard)
{
    std::vector<std::size_t> jobs;
    for (std::size_t job = 0; job < plan.group.size(); ++job)
        if (plan.group[job] % shard.of == shard.number - 1)
            jobs.push_back(job);
    return jobs;
}

} // namespace cotan
