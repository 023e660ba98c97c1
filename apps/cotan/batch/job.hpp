// The jobs of a batch: a file with one cotan command line per line.
//
//     {"name": "rock 7", "command": ["bake", "--high", "rock7.obj", "--low", "rock7_low.obj", "-o", "rock7.png"]}
//     {"command": ["render", "city.glb", "-o", "city.png"], "limit-memory": 8000, "priority": 1, "retries": 2}
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cotan/result.hpp"

namespace cotan::app {

// Options of one job, which override those of the batch.
struct JobOptions {
    std::optional<std::size_t> megabytes;           // memory limit of its process in MiB; 0: none
    std::optional<double> seconds;                  // wall-clock limit
    std::optional<double> processorSeconds;         // processor time limit of all threads together; 0: none
    std::optional<int> retries;                     // maximum number of further runs, if they may help
    int priority = 0;                               // of the jobs that are ready, the one with the highest starts first
    std::map<std::string, std::string> environment; // added to the environment
};

struct Job {
    std::string name;               // unique; defaults to the command line, for sh
    std::vector<std::string> words; // of the command line, without the program
    // Files known before the job runs, from its words and from the job file, as written there: relative to the folder
    // of the jobs. Outputs may be folders; * in their names stands for what only the job finds out.
    std::vector<std::string> inputs, outputs;
    std::string json;     // where its words send the JSON report; empty: nowhere
    bool threads = false; // its words set the number of threads
    std::size_t line = 0; // in the job file, from 1
    JobOptions options;

    // The key of its result in a store: its environment variables as "NAME=VALUE", then its words.
    std::vector<std::string> key() const;
};

struct JobList {
    std::filesystem::path folder; // absolute: where the jobs run; their files are relative to it
    std::vector<Job> jobs;
};

// Checks the words of a job and sets its files. Errors: what is wrong with the words.
using CheckWords = std::function<Status(Job&)>;

// Reads a job file; empty lines are skipped but counted. Errors (ErrorKind::input): lines that are not jobs, with the
// first line number and how many more there are; two jobs with the same name; no job at all.
Result<JobList> readJobs(const std::filesystem::path& file, const CheckWords& check);

// Dependencies: a job that reads what another one writes runs after it.
struct Plan {
    std::vector<std::vector<std::size_t>> needs; // for each job: the jobs it depends on
    std::vector<std::size_t> order;              // all jobs, each after those it depends on
    std::vector<std::size_t> group;              // for each job: its connected component, from 0
};

// Plans by the files that are known before jobs run. Errors (ErrorKind::input): two jobs that write the same file, jobs
// that wait for each other, a job that writes a file it reads.
Result<Plan> planJobs(const JobList& list);

// Whether a path has a *, which stands for any text without a slash.
inline bool isPattern(std::string_view path) { return path.find('*') != std::string_view::npos; }
bool matches(std::string_view pattern, std::string_view path);

// Part `number` of `of` parts of a batch.
struct Shard {
    std::size_t number = 1, of = 1;
};

// Parses "3/8". Errors: ErrorKind::usage.
Result<Shard> parseShard(const std::string& text);

// The jobs of a shard, in order. Shards get whole connected components in turn; every job is in exactly one shard.
std::vector<std::size_t> jobsOf(const Plan& plan, const Shard& shard);

} // namespace cotan::app
