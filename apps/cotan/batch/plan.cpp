#include <algorithm>
#include <functional>
#include <unordered_map>

#include <fmt/format.h>

#include "batch/job.hpp"
#include "core/groups.hpp"
#include "core/parse_number.hpp"

namespace cotan::app {

namespace fs = std::filesystem;

namespace {

std::string pathOf(const JobList& list, const std::string& file)
{
    fs::path path = (list.folder / file).lexically_normal();
    return path.has_filename() ? path.string() : path.parent_path().string(); // strips a slash at the end
}

using Writers = std::unordered_map<std::string, std::size_t>;
using Patterns = std::vector<std::pair<std::string, std::size_t>>; // outputs with *, and the job that writes them

const std::size_t* writerOf(const Patterns& patterns, const std::string& file)
{
    const auto found = std::ranges::find_if(patterns, [&](const auto& one) { return matches(one.first, file); });
    return found != patterns.end() ? &found->second : nullptr;
}

// The job that writes a file or a folder that contains it; null: none.
const std::size_t* writerOf(const Writers& writers, const Patterns& patterns, fs::path path)
{
    if (const std::size_t* writer = writers.contains(path.string()) ? nullptr : writerOf(patterns, path.string()))
        return writer;
    for (;; path = path.parent_path()) {
        if (const auto found = writers.find(path.string()); found != writers.end())
            return &found->second;
        if (!path.has_relative_path())
            return nullptr;
    }
}

// Sets plan.order. Returns the jobs of a dependency cycle; empty: none.
std::vector<std::size_t> orderJobs(Plan& plan)
{
    std::vector<std::size_t> open(plan.needs.size()); // per job: number of needs that are not yet in the order
    std::vector<std::vector<std::size_t>> users(plan.needs.size());
    for (std::size_t job = 0; job < plan.needs.size(); ++job) {
        for (const std::size_t need : plan.needs[job])
            users[need].push_back(job);
        if ((open[job] = plan.needs[job].size()) == 0)
            plan.order.push_back(job);
    }
    for (std::size_t i = 0; i < plan.order.size(); ++i)
        for (const std::size_t user : users[plan.order[i]])
            if (--open[user] == 0)
                plan.order.push_back(user);
    if (plan.order.size() == plan.needs.size())
        return {};
    // Every remaining job needs another one that remains, so a walk along these needs comes back to a job on its path.
    std::size_t job = std::size_t(std::ranges::find_if(open, std::identity()) - open.begin());
    std::vector<std::size_t> path,
        position(plan.needs.size()); // position: where a job is on the path, from 1; 0: nowhere
    while (position[job] == 0) {
        path.push_back(job);
        position[job] = path.size();
        job = *std::ranges::find_if(plan.needs[job], [&](std::size_t need) { return open[need] > 0; });
    }
    return {path.begin() + std::ptrdiff_t(position[job] - 1), path.end()};
}

} // namespace

bool matches(std::string_view pattern, std::string_view path)
{
    const std::size_t first = pattern.find('*'), last = pattern.rfind('*');
    if (first == std::string_view::npos)
        return pattern == path;
    if (std::ranges::count(pattern, '/') != std::ranges::count(path, '/'))
        return false;
    const std::string_view tail = pattern.substr(last + 1);
    if (path.size() < first + tail.size() || !path.starts_with(pattern.substr(0, first)) || !path.ends_with(tail))
        return false;
    path = path.substr(first, path.size() - first - tail.size());
    for (std::size_t at = first; at != last;) { // the texts between two * in order, each where it first occurs
        const std::size_t next = pattern.find('*', at + 1);
        const std::string_view part = pattern.substr(at + 1, next - at - 1);
        const std::size_t found = path.find(part);
        if (found == std::string_view::npos)
            return false;
        path.remove_prefix(found + part.size());
        at = next;
    }
    return true;
}

Result<Plan> planJobs(const JobList& list)
{
    Writers writers;
    Patterns patterns;
    const auto collision = [&](std::size_t job, const std::string& output, std::size_t other) {
        return inputError(fmt::format("line {}: writes {}, which line {} also writes", list.jobs[job].line, output,
                                      list.jobs[other].line));
    };
    for (std::size_t i = 0; i < list.jobs.size(); ++i)
        for (const std::string& output : list.jobs[i].outputs) {
            const auto [known, isNew] = writers.emplace(pathOf(list, output), i);
            if (!isNew && known->second != i)
                return collision(i, output, known->second);
            if (isNew && isPattern(output))
                patterns.emplace_back(known->first, i);
        }
    for (std::size_t i = 0; i < list.jobs.size() && !patterns.empty(); ++i)
        for (const std::string& output : list.jobs[i].outputs)
            if (const std::size_t* other = writerOf(patterns, pathOf(list, output)); other && *other != i)
                return collision(std::max(i, *other), output, std::min(i, *other));
    Plan plan;
    plan.needs.resize(list.jobs.size());
    for (std::size_t i = 0; i < list.jobs.size(); ++i)
        for (const std::string& input : list.jobs[i].inputs) {
            const fs::path path = pathOf(list, input);
            const std::size_t* writer = writerOf(writers, patterns, path);
            if (!writer)
                continue;
            if (*writer == i && writers.contains(path.string()))
                return inputError(fmt::format("line {}: writes {}, which it also reads: a second run would start from "
                                              "the first one's result; expected another name",
                                              list.jobs[i].line, input));
            if (*writer != i && std::ranges::find(plan.needs[i], *writer) == plan.needs[i].end())
                plan.needs[i].push_back(*writer);
        }
    if (const auto cycle = orderJobs(plan); !cycle.empty()) {
        std::string lines;
        for (const std::size_t job : cycle)
            lines += fmt::format("line {} waits for ", list.jobs[job].line);
        return inputError(
            fmt::format("{}line {}: each reads what the next one writes", lines, list.jobs[cycle.front()].line));
    }
    JoinedGroups joined(list.jobs.size());
    for (const std::size_t job : plan.order)
        for (const std::size_t need : plan.needs[job])
            joined.join(std::uint32_t(job), std::uint32_t(need));
    std::size_t count = 0; // of groups, numbered in the order of their first jobs
    for (std::size_t job = 0; job < list.jobs.size(); ++job) {
        const std::size_t first = joined.find(std::uint32_t(job));
        plan.group.push_back(first == job ? count++ : plan.group[first]);
    }
    return plan;
}

Result<Shard> parseShard(const std::string& text)
{
    const std::string_view all = text;
    const std::size_t slash = all.find('/');
    Shard shard;
    if (slash == std::string::npos || !parseNumber(all.substr(0, slash), shard.number)
        || !parseNumber(all.substr(slash + 1), shard.of) || shard.number < 1 || shard.number > shard.of)
        return usageError("--shard: expected K/N with K from 1 to N, such as 3/8; found '" + text + "'");
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

} // namespace cotan::app
