// Jobs for tests of batches, and a fixture that runs them in a folder of their own.
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <numeric>

#include <fmt/format.h>

#include "batch/run.hpp"
#include "run_tool.hpp"

namespace cotan::test {

using namespace app;

using Words = std::vector<std::string>;

inline void write(const std::filesystem::path& file, const std::string& text)
{
    std::ofstream(file, std::ios::binary) << text;
}

inline Store openStore(const std::filesystem::path& folder, const std::string& version = "1")
{
    auto store = Store::open(folder, version);
    EXPECT_TRUE(store) << store.error().message;
    return std::move(*store);
}

// Adds a job of batch_child, whose files are the ones that it names.
inline Job& addJob(JobList& list, const Words& words)
{
    Job job;
    job.name = fmt::format("{} {}", words.front(), list.jobs.size());
    job.words = words;
    job.line = list.jobs.size() + 1;
    if (words.front() == "copy") {
        job.inputs = {words[1]};
        job.outputs = {words[2]};
    }
    if (words.front() == "half")
        job.outputs = {words[1]};
    return list.jobs.emplace_back(std::move(job));
}

class BatchRun : public ::testing::Test {
protected:
    Job& add(const Words& words) { return addJob(list, words); }

    Result<std::vector<JobResult>> tryToRun(const Progress& progress = {})
    {
        list.folder = folder.path();
        const auto plan = planJobs(list);
        EXPECT_TRUE(plan);
        std::vector<std::size_t> all(list.jobs.size());
        std::iota(all.begin(), all.end(), std::size_t(0));
        Store store = openStore(folder / "store");
        return runJobs(list, *plan, all, store, options, progress);
    }

    std::vector<JobResult> run()
    {
        auto results = tryToRun();
        EXPECT_TRUE(results) << results.error().message;
        return results ? *std::move(results) : std::vector<JobResult>(list.jobs.size());
    }

    TemporaryFolder folder;
    JobList list;
    RunOptions options{.processes = 2, .seconds = 30, .megabytes = 0, .program = BATCH_CHILD};
};

} // namespace cotan::test
