// Which job waits for which: a job that reads what another one writes comes after it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "batch/job.hpp"
#include "cotan/result.hpp"

namespace cotan {

struct Plan {
    std::vector<std::vector<std::size_t>> needs; // for each job those before it
    std::vector<std::size_t> group;              // for each job: a number that all that hang together share, from 0
};

// By the files that are known before jobs run. Errors (ErrorKind::input): two jobs that write one file, jobs that wait
// for each other, a job that writes what it reads.
Result<Plan> planJobs(const JobList& list);

// Part K of N of a batch.
struct Shard {
    std::size_t number = 1, of = 1;
};

// "3/8". Errors: ErrorKind::usage.
Result<Shard> parseShard(const std::string& text);

// The jobs of a shard, in their order. Groups are dealt out whole, one after the other: every job is in one shard.
std::vector<std::size_t> jobsOf(const Plan& plan, const Shard& shard);

} // namespace cotan
