// Runs jobs, each in a process of its own, and keeps what becomes of them.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "batch/child.hpp"
#include "batch/plan.hpp"
#include "batch/store.hpp"
#include "cotan/result.hpp"

namespace cotan {

// For all jobs; JobOptions of a job come before them.
struct RunOptions {
    std::size_t processes = 1;   // at a time
    int threads = 1;             // of each, where its words do not say how many
    double seconds = 3600;       // on the clock, of each
    double processorSeconds = 0; // of each, its threads together; whole seconds count, rounded up. 0: no limit
    std::size_t megabytes = 0;   // MiB of each; 0: no limit
    int retries = 0;             // how often each runs again that ended by a limit, a signal or what is missing here
    bool again = false;          // also what is kept
    Thumbnails thumbnails = Thumbnails::pictures;
    std::string program = "/proc/self/exe"; // one that begins with isJobProcess
};

// A job and what became of it.
struct JobResult {
    std::size_t job = 0; // its number in the list
    JobRecord record;
    bool kept = false; // it did not have to run
};

// Runs those of the jobs whose results are not kept, or not with these inputs; the others wait for nothing. A job that
// fails is a result like another one; those that wait for it are skipped. `chosen`: numbers of jobs, all that hang
// together or none. Jobs that another process runs on the same store are waited for. The results are in the order of
// `chosen`.
// Errors: stoppedError; ErrorKind::output where the store takes nothing any more: what was kept until then stays.
Result<std::vector<JobResult>> runJobs(const JobList& list, const Plan& plan, std::span<const std::size_t> chosen,
                                       Store& store, const RunOptions& options, const Progress& progress);

// What stores hold of all jobs, running nothing: the newest record of each that is still good, by its inputs and
// outputs. Jobs without one are JobState::notRun.
std::vector<JobResult> collect(const JobList& list, const Plan& plan, std::span<const Store> stores);

} // namespace cotan
