// Dependencies: a job that reads what another one writes runs after it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "batch/job.hpp"
#include "cotan/result.hpp"

namespace cotan {

struct Plan {
    std::vector<std::vector<std::size_t>> needs; // for each job: the jobs it depends on
    std::vector<std::size_t> group;              // for each job: its connected component, from 0
};

// Plans by the files that are known before jobs run. Errors (ErrorKind::input): two jobs that write the same file, jobs
// that wait for each other, a job that writes a file it reads.
Result<Plan> planJobs(const JobList& list);

// Part `number` of `of` parts of a batch.
struct Shard {
    std::size_t number = 1, of = 1;
};

// Parses "3/8". Errors: ErrorKind::usage.
Result<Shard> parseShard(const std::string& text);

// The jobs of a shard, in order. Shards get whole connected components in turn; every job is in exactly one shard.
std::vector<std::size_t> jobsOf(const Plan& plan, const Shard& shard);

} // namespace cotan
