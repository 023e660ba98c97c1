#include "batch/plan.hpp"

#include <algorithm>
#include <charconv>
#include <unordered_map>

#include <fmt/format.h>

#include "core/groups.hpp"

namespace cotan {

namespace fs = std::filesystem;

namespace {

std::string pathOf(const JobList& list, const std::string& file)
{
    fs::path path = (list.folder / file).lexically_normal();
    return path.has_filename() ? path.string() : path.parent_path().string(); // strips a slash at the end
}

// The job that writes a file or a folder that contains it; null: none.
const std::size_t* writerOf(const std::unordered_map<std::string, std::size_t>& writers, fs::path path)
{
    for (;;) {
        if (const auto found = writers.find(path.string()); found != writers.end())
            return &found->second;
        if (!path.has_relative_path())
            return nullptr;
        path = path.parent_path();
    }
}

// The jobs of a dependency cycle; empty: none. A depth-first search without recursion.
std::vector<std::size_t> findCycle(const std::vector<std::vector<std::size_t>>& needs)
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
                std::vector<std::size_t> cycle;
                for (auto at = std::ranges::find(path, need, &std::pair<std::size_t, std::size_t>::first);
                     at != path.end(); ++at)
                    cycle.push_back(at->first);
                return cycle;
            }
        }
    }
    return {};
}

// The connected component of each job, numbered in the order of their first jobs.
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
            const auto [known, isNew] = writers.emplace(pathOf(list, output), i);
            if (!isNew && known->second != i)
                return inputError(fmt::format("line {}: writes {}, which line {} also writes", list.jobs[i].line,
                                              output, list.jobs[known->second].line));
        }
    Plan plan;
    plan.needs.resize(list.jobs.size());
    for (std::size_t i = 0; i < list.jobs.size(); ++i)
        for (const std::string& input : list.jobs[i].inputs) {
            const fs::path path = pathOf(list, input);
            const std::size_t* writer = writerOf(writers, path);
            if (!writer)
                continue;
            if (*writer == i && writers.contains(path.string()))
                return inputError(fmt::format("line {}: writes {}, which it also reads: a second run would start from "
                                              "the first one's result; expected another name",
                                              list.jobs[i].line, input));
            if (*writer != i && std::ranges::find(plan.needs[i], *writer) == plan.needs[i].end())
                plan.needs[i].push_back(*writer);
        }
    if (const auto cycle = findCycle(plan.needs); !cycle.empty()) {
        std::string lines;
        for (const std::size_t job : cycle)
            lines += fmt::format("line {} waits for ", list.jobs[job].line);
        return inputError(
            fmt::format("{}line {}: each reads what the next one writes", lines, list.jobs[cycle.front()].line));
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
