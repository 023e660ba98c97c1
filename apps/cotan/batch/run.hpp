// Runs jobs, each in a process of its own, and stores their results.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "batch/child.hpp"
#include "batch/job.hpp"
#include "batch/store.hpp"
#include "cotan/result.hpp"
#include "files/system/program.hpp"

namespace cotan::app {

// Defaults for all jobs; the JobOptions of a job override them.
struct RunOptions {
    std::size_t processes = 1;   // maximum number at a time
    int threads = 1;             // per job, unless its words set the number
    double seconds = 3600;       // wall-clock limit per job
    double processorSeconds = 0; // limit per job of all threads together, rounded up to whole seconds; 0: none
    std::size_t megabytes = 0;   // memory limit per job in MiB; 0: none
    int retries = 0;             // further runs of a job ended by a limit, a signal or a missing resource
    bool again = false;          // also run jobs with a stored result
    Thumbnails thumbnails = Thumbnails::pictures;
    std::filesystem::path program = sameProgram(); // a program that begins with isJobProcess
};

// A job and its result.
struct JobResult {
    std::size_t job = 0; // index in the list
    JobRecord record;
    bool kept = false; // taken from the store without a run
};

// Runs the chosen jobs that have no stored result for their present inputs. A job that fails has a result like any
// other; jobs that wait for it are skipped. `chosen`: indices of jobs, whole connected components only. Jobs that
// another process runs on the same store are waited for. The results are in the order of `chosen`.
// Errors: stoppedError; ErrorKind::output if the store cannot be written; earlier results stay stored.
Result<std::vector<JobResult>> runJobs(const JobList& list, const Plan& plan, std::span<const std::size_t> chosen,
                                       Store& store, const RunOptions& options, const Progress& progress);

// Collects results from stores without running anything: for each job the newest record whose inputs and outputs are
// unchanged. Jobs without one are JobState::notRun.
std::vector<JobResult> collect(const JobList& list, const Plan& plan, std::span<const Store> stores);

} // namespace cotan::app
