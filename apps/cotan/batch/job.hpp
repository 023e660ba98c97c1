// The jobs of a batch: command lines of ours, one in each line of a file.
//
//     {"name": "rock 7", "command": ["bake", "--high", "rock7.obj", "--low", "rock7_low.obj", "-o", "rock7.png"]}
//     {"command": ["lint", "city.glb"], "limit-memory": 8000, "limit-time": 600, "priority": 1, "retries": 2}
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cotan/result.hpp"

namespace cotan {

// What one job asks for, in place of what the batch has for all.
struct JobOptions {
    std::optional<std::size_t> megabytes;           // MiB that a process of it may take; 0: no limit
    std::optional<double> seconds;                  // on the clock
    std::optional<double> processorSeconds;         // of its process, all threads together; 0: no limit
    std::optional<int> retries;                     // how often it runs again where that may help
    int priority = 0;                               // of jobs that could begin, the one with the largest does
    std::map<std::string, std::string> environment; // variables that it gets besides ours
};

struct Job {
    std::string name;               // unique; the command line where none was given
    std::vector<std::string> words; // of the command line, without the program
    // What is known before it runs: files by its words and as stated, as they are written, relative to the folder of
    // the jobs. Outputs may be folders.
    std::vector<std::string> inputs, outputs;
    std::string json;     // where its words send the command's report; empty: nowhere
    bool threads = false; // its words say how many
    std::size_t line = 0; // in the file, from 1
    JobOptions options;

    // What its result is kept under: its words, behind its variables as in a shell, "NAME=VALUE" each.
    std::vector<std::string> key() const;
};

struct JobList {
    std::filesystem::path folder; // absolute: where the jobs run, and what their files are relative to
    std::vector<Job> jobs;
};

// Checks the words of a job and fills in its files. Errors: what is wrong with them.
using CheckWords = std::function<Status(Job&)>;

// Reads a file of jobs; empty lines count as lines only. Errors (ErrorKind::input): lines that are no job, with the
// number of the first and how many more there are; two jobs of one name; no job at all.
Result<JobList> readJobs(const std::filesystem::path& file, const CheckWords& check);

} // namespace cotan
