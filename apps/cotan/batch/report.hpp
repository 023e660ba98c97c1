// The report of a batch: a page for people, JSON for programs.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "batch/run.hpp"
#include "files/json.hpp"

namespace cotan::app {

// Indices of results, worst first: crashed, out of memory, too slow, over limit, failed, skipped, not run, done; then
// by degrees; ties keep the order of the jobs.
std::vector<std::size_t> worstFirst(const std::vector<JobResult>& results);

// Number of jobs in each state.
using StateCounts = std::array<std::size_t, std::size_t(JobState::crashed) + 1>;
StateCounts countsOf(const std::vector<JobResult>& results);

// "9 jobs: 7 done, 1 over limit, 1 crashed; 5 kept from before".
std::string summaryOf(const std::vector<JobResult>& results);

// One self-contained HTML file that needs no network, with virtual scrolling, a filter, sorting and thumbnails. Links
// to outputs are relative to `folder`, where the page will be. Only the worst `maxRows` jobs are included.
std::string batchPage(const JobList& list, const std::vector<JobResult>& results, const std::string& title,
                      const std::string& footer, const std::filesystem::path& folder, std::size_t maxRows);

// The jobs, worst first: name, state, reason, degrees, seconds, memory, files.
Json batchJson(const JobList& list, const std::vector<JobResult>& results);

} // namespace cotan::app
