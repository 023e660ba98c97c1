// Options of one job: limits, retries, priority, environment variables.
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>

#include <fmt/format.h>

#include "batch/report.hpp"
#include "batch/run.hpp"
#include "run_tool.hpp"

namespace cotan {
namespace {

using namespace test;

Result<JobList> listIn(const std::string& text)
{
    static const TemporaryFolder folder;
    std::ofstream(folder / "jobs.jsonl", std::ios::binary) << text;
    return readJobs(folder / "jobs.jsonl", [](Job&) { return Status(Done{}); });
}

TEST(BatchJobOptions, areReadFromTheLineElseAreTheDefaults)
{
    const auto list =
        listIn("{\"command\": [\"lint\"], \"limit-memory\": 2000, \"limit-time\": 1.5, "
               "\"limit-processor-time\": 0, \"retries\": 3, \"priority\": -2, "
               "\"env\": {\"A\": \"b=c\", \"B\": \"\"}}\n{\"command\": [\"lint\"], \"name\": \"other\"}\n");
    ASSERT_TRUE(list) << list.error().message;
    const JobOptions& options = list->jobs[0].options;
    EXPECT_EQ(options.megabytes, 2000u);
    EXPECT_EQ(options.seconds, 1.5);
    EXPECT_EQ(options.processorSeconds, 0);
    EXPECT_EQ(options.retries, 3);
    EXPECT_EQ(options.priority, -2);
    EXPECT_EQ(list->jobs[0].key(), (std::vector<std::string>{"A=b=c", "B=", "lint"}));
    const JobOptions& none = list->jobs[1].options;
    EXPECT_FALSE(none.megabytes || none.seconds || none.processorSeconds || none.retries);
    EXPECT_EQ(list->jobs[1].key(), std::vector<std::string>{"lint"});
}

TEST(BatchJobOptions, wrongOnesAreReportedWithWhatIsExpectedAndFound)
{
    const std::pair<std::string, std::string> cases[] = {
        {"\"limit-memory\": -1", "\"limit-memory\": expected a whole number from 0 to 16777216; found -1"},
        {"\"limit-memory\": 1.5", "found 1.5"},
        {"\"limit-memory\": \"2 GB\"", "found \"2 GB\""},
        {"\"limit-time\": 0", "\"limit-time\": expected a number from 0.001 to 1000000; found 0"},
        {"\"limit-time\": 1e999", "text that is not JSON"},
        {"\"limit-processor-time\": null", "found null"},
        {"\"retries\": 101", "from 0 to 100; found 101"},
        {"\"priority\": true", "\"priority\": expected a whole number"},
        {"\"priority\": 99999999999999999999", "\"priority\": expected a whole number"},
        {"\"env\": [\"A=b\"]", "\"env\": expected an object of strings such as"},
        {"\"env\": {\"A\": 1}", "quote numbers, too); found 1"},
        {"\"env\": {\"A=B\": \"1\"}", "expected names of variables; found \"A=B\""},
        {"\"env\": {\"\": \"1\"}", "expected names of variables"},
        {"\"memory\": 1",
         "expected name, command, inputs, outputs, limit-memory, limit-time, limit-processor-time, "
         "priority, retries, env; found \"memory\""},
    };
    for (const auto& [member, message] : cases) {
        const auto list = listIn("{\"command\": [\"lint\"], " + member + "}\n");
        ASSERT_FALSE(list) << member;
        EXPECT_NE(list.error().message.find(message), std::string::npos) << list.error().message;
        EXPECT_EQ(list.error().message.find('\n'), std::string::npos);
    }
}

class BatchJobOptionsRun : public ::testing::Test {
protected:
    Job& add(const std::vector<std::string>& words)
    {
        Job job;
        job.name = fmt::format("{} {}", words.front(), list.jobs.size());
        job.words = words;
        job.line = list.jobs.size() + 1;
        if (words.front() == "copy") {
            job.inputs = {words[1]};
            job.outputs = {words[2]};
        }
        return list.jobs.emplace_back(std::move(job));
    }

    std::vector<JobResult> run()
    {
        list.folder = folder.path();
        const auto plan = planJobs(list);
        EXPECT_TRUE(plan);
        std::vector<std::size_t> all(list.jobs.size());
        for (std::size_t i = 0; i < all.size(); ++i)
            all[i] = i;
        auto store = Store::open(folder / "store", "1");
        EXPECT_TRUE(store);
        const auto results = runJobs(list, *plan, all, *store, options, {});
        EXPECT_TRUE(results);
        return *results;
    }

    TemporaryFolder folder;
    JobList list;
    RunOptions options{.processes = 2, .seconds = 30, .megabytes = 0, .program = BATCH_CHILD};
};

TEST_F(BatchJobOptionsRun, processorTimeEndsBusyJobsButNotWaitingOnes)
{
    options.processorSeconds = 0.5; // rounded up to 1
    add({"spin", "100"});
    add({"wait", "2"}); // longer than any limit here by the clock, as on a busy machine
    add({"spin", "101"}).options.seconds = 0.2;
    const auto results = run();
    EXPECT_EQ(results[0].record.state, JobState::late);
    EXPECT_EQ(results[0].record.signal, SIGXCPU);
    EXPECT_EQ(results[0].record.reason, "took more than 1 s of processor time and was terminated");
    EXPECT_EQ(results[1].record.state, JobState::done) << results[1].record.reason;
    EXPECT_GT(results[1].record.seconds, 1.9);
    EXPECT_EQ(results[2].record.reason, "took longer than 0.2 s and was terminated");
}

TEST_F(BatchJobOptionsRun, aJobsOwnLimitsTakePrecedence)
{
    options.seconds = 0.3;
    options.processorSeconds = 1;
    add({"wait", "1"}).options.seconds = 20;
    add({"wait", "1.1"});             // different words, because equal words share a result
    Job& free = add({"spin", "1.5"}); // seconds of processor time
    free.options.processorSeconds = 0;
    free.options.seconds = 25;
    const auto results = run();
    EXPECT_EQ(results[0].record.state, JobState::done);
    EXPECT_EQ(results[1].record.state, JobState::late);
    EXPECT_EQ(results[2].record.state, JobState::done) << results[2].record.reason;
}

TEST_F(BatchJobOptionsRun, transientFailuresAreRetriedAndWrongInputIsNot)
{
    options.retries = 1;
    add({"flaky", "once", "1"});
    add({"flaky", "thrice", "3"}).options.retries = 5;
    add({"flaky", "never", "9"});
    add({"flaky", "off", "1"}).options.retries = 0;
    add({"fail", "2", "a.glb: broken"});
    const auto results = run();
    const std::pair<JobState, int> expected[] = {{JobState::done, 2},
                                                 {JobState::done, 4},
                                                 {JobState::crashed, 2},
                                                 {JobState::crashed, 1},
                                                 {JobState::failed, 1}};
    for (std::size_t i = 0; i < std::size(expected); ++i) {
        EXPECT_EQ(results[i].record.state, expected[i].first) << i << results[i].record.reason;
        EXPECT_EQ(results[i].record.runs, expected[i].second) << i;
    }
}

TEST_F(BatchJobOptionsRun, priorityOrdersJobsAndIsPassedToTheJobsTheyNeed)
{
    options.processes = 1;
    std::ofstream(folder / "a") << "a";
    add({"copy", "a", "plain", "log"});
    add({"copy", "a", "last", "log"}).options.priority = -1;
    add({"copy", "a", "needed", "log"});
    add({"copy", "a", "soon", "log"}).options.priority = 1;
    add({"copy", "needed", "first", "log"}).options.priority = 2;
    run();
    EXPECT_EQ(readWhole(folder / "log"), "needed\nfirst\nsoon\nplain\nlast\n");
}

TEST_F(BatchJobOptionsRun, variablesReachTheJobAndChangeItsResultKey)
{
    ::setenv("COTAN_TEST_OURS", "ours", 1);
    add({"variables", "out", "COTAN_TEST_OURS", "COTAN_TEST_OWN"}).options.environment = {{"COTAN_TEST_OWN", "1"}};
    const auto ran = [&] {
        const auto results = run();
        return readWhole(folder / "out") + (results[0].kept ? "kept" : "ran");
    };
    EXPECT_EQ(ran(), "ours\n1\nran");
    EXPECT_EQ(ran(), "ours\n1\nkept");
    list.jobs[0].options.environment = {{"COTAN_TEST_OWN", "2"}, {"COTAN_TEST_OURS", "theirs"}};
    EXPECT_EQ(ran(), "theirs\n2\nran");
}

TEST(BatchReportOrder, jobsOverTheirLimitComeBeforeFailedOnes)
{
    std::vector<JobResult> results;
    for (const JobState state : {JobState::done, JobState::failed, JobState::limit, JobState::skipped, JobState::notRun,
                                 JobState::late, JobState::crashed, JobState::memory, JobState::limit}) {
        results.push_back({results.size(), {}, false});
        results.back().record.state = state;
        if (state == JobState::limit)
            results.back().record.degrees = Degrees{double(results.size()), ""};
    }
    EXPECT_EQ(worstFirst(results), (std::vector<std::size_t>{6, 7, 5, 8, 2, 1, 3, 4, 0}));
}

} // namespace
} // namespace cotan
