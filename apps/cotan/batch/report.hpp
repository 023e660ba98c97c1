// What became of a batch: a page for people, JSON for programs.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "batch/run.hpp"
#include "files/report/json.hpp"

namespace cotan {

// The numbers of results, worst first: what crashed, took too much memory or time, what is over its limit, what was
// refused, what did not run; then by degrees; the order of the jobs decides the rest.
std::vector<std::size_t> worstFirst(const std::vector<JobResult>& results);

// How many jobs are in each state.
using StateCounts = std::array<std::size_t, std::size_t(JobState::crashed) + 1>;
StateCounts countsOf(const std::vector<JobResult>& results);

// "9 jobs: 7 done (5 kept), 1 over limit, 1 crashed".
std::string summaryOf(const std::vector<JobResult>& results);

// One HTML file that needs no other and no network: rows that are in view only, a filter, sorting, thumbnails. Links to
// outputs are relative to `folder`, where the page will be. Of more than `maxRows` jobs it has the worst.
std::string batchPage(const JobList& list, const std::vector<JobResult>& results, const std::string& title,
                      const std::string& footer, const std::filesystem::path& folder, std::size_t maxRows);

// The jobs, worst first: name, state, reason, degrees, seconds, memory, files.
Json batchJson(const JobList& list, const std::vector<JobResult>& results);

} // namespace cotan
