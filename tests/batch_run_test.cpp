// Runs of jobs that misbehave, of jobs with options of their own, and runs that are killed or share a store.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <map>
#include <thread>

#include <fmt/format.h>

#include "batch_fixture.hpp"
#include "files/sandbox/confine.hpp"

namespace cotan {
namespace {

using namespace app;
using namespace test;
namespace fs = std::filesystem;

TEST_F(BatchRun, jobsThatCrashHangOrExhaustMemoryDoNotEndTheRun)
{
    options.processes = 4;
    options.megabytes = 256;
    const std::pair<Words, JobState> cases[] = {
        {{"sh", "kill -SEGV $$"}, JobState::crashed},
        {{"sh", "kill -ABRT $$"}, JobState::crashed},
        {{"sh", "kill -KILL $$"}, JobState::crashed},
        {{"sh", "sleep 1000"}, JobState::late},
        {{"sh", "trap '' TERM; while :; do sleep 1; done"}, JobState::late},
        {{"eat"}, JobState::memory},
        {{"sh", "echo the beginning; yes 'and so on, and so on' | head -n 200000; echo the end"}, JobState::done},
        {{"sh", "sleep 1000 & :"}, JobState::done}, // its child keeps running and holds standard output open
        {{"fine"}, JobState::done}};
    for (const auto& [words, state] : cases) // on a busy machine, the others take longer than a second
        add(words).options.seconds = state == JobState::late ? 1 : 30;
    add({"sh", "echo cotan: error: a.glb: broken; exit 2"});
    add({"sh", "echo cotan: error: over 3 degrees; exit 5"});
    const auto results = run();
    ASSERT_EQ(results.size(), 11u);
    for (std::size_t i = 0; i < std::size(cases); ++i) {
        const std::string word = cases[i].first.back();
        if (kSanitized && word == "eat") // memory is not limited then
            continue;
        EXPECT_EQ(results[i].record.state, cases[i].second)
            << word << ": " << name(results[i].record.state) << ", " << results[i].record.reason;
        EXPECT_EQ(results[i].record.reason.empty(), cases[i].second == JobState::done) << word;
        const JobRecord& record = results[i].record;
        EXPECT_NE(record.code.has_value(), record.signal.has_value()) << word << " ended one way";
    }
    EXPECT_EQ(results[0].record.signal, SIGSEGV);
    EXPECT_EQ(results[3].record.signal, SIGTERM) << "too slow, and asked to end";
    EXPECT_EQ(results[4].record.signal, SIGKILL);
    const auto inUse = [&](std::size_t i) {
        return fmt::format(" with {:.0f} MiB in use", results[i].record.megabytes);
    };
    EXPECT_EQ(results[0].record.reason, "crashed (signal 11, Segmentation fault)" + inUse(0) + ": it printed nothing");
    EXPECT_EQ(results[2].record.reason, "was killed (signal 9)" + inUse(2) + ", perhaps out of memory");
    EXPECT_EQ(results[3].record.reason, "took longer than 1 s and was terminated");
    if (!kSanitized) {
        EXPECT_EQ(results[5].record.reason, "needed more memory than 256 MiB");
        EXPECT_LT(results[6].record.megabytes, 256) << "of a process that does little";
    }
    EXPECT_GT(results[6].record.megabytes, 1) << "of a process that does little";
    EXPECT_EQ(results[8].record.code, 0);
    EXPECT_EQ(results[9].record.state, JobState::failed);
    EXPECT_EQ(results[9].record.reason, "a.glb: broken");
    EXPECT_EQ(results[9].record.code, 2);
    EXPECT_EQ(results[10].record.state, JobState::limit);
    EXPECT_EQ(results[10].record.reason, "over 3 degrees");
    const std::string& output = results[6].record.output;
    EXPECT_TRUE(output.starts_with("the beginning\n") && output.ends_with("the end\n")) << output.substr(0, 50);
    EXPECT_LT(output.size(), 30000u);
    EXPECT_TRUE(fs::is_empty(folder / "store/work"));
}

TEST_F(BatchRun, aSecondRunRepeatsOnlyChangedJobs)
{
    for (const char* name : {"a", "b", "c"})
        write(folder / name, name);
    add({"copy", "a", "a1", "log"});
    add({"copy", "b", "b1", "log"});
    add({"copy", "b1", "b2", "log"});
    add({"copy", "c", "c1", "log"});
    add({"copy", "gone", "g1", "log"}); // fails because of its inputs: kept as well
    add({"sh", "kill -SEGV $$"});       // not because of its inputs: run again
    const auto ran = [&] {
        fs::remove(folder / "log");
        std::string names;
        for (const JobResult& result : run())
            if (!result.kept)
                names += list.jobs[result.job].words.back() == "log" ? list.jobs[result.job].words[2] + " " : "crash ";
        return names;
    };
    options.processes = 1;
    EXPECT_EQ(ran(), "a1 b1 b2 c1 g1 crash ");
    EXPECT_EQ(readWhole(folder / "log"), "a1\nb1\nc1\ng1\nb2\n"); // b2 became ready when b1 was done
    EXPECT_EQ(ran(), "crash ");
    EXPECT_EQ(readWhole(folder / "log"), "");
    write(folder / "b", "B"); // and with it the files made from it
    EXPECT_EQ(ran(), "b1 b2 crash ");
    EXPECT_EQ(readWhole(folder / "b2"), "B");
    fs::remove(folder / "c1");
    EXPECT_EQ(ran(), "c1 crash ");
    write(folder / "a1", "somebody else's");
    EXPECT_EQ(ran(), "a1 crash ");
    write(folder / "gone", "here");
    EXPECT_EQ(ran(), "g1 crash ");
    options.again = true;
    EXPECT_EQ(ran(), "a1 b1 b2 c1 g1 crash ");
}

// Nodes of a farm share a store, and their clocks differ.
TEST_F(BatchRun, aJobWaitsForNoResultOfAMachineWhoseClockIsAhead)
{
    write(folder / "a", "a");
    add({"copy", "a", "b"});
    add({"copy", "b", "c"});
    run();
    {
        const Store store = openStore(folder / "store");
        JobRecord record = *store.find(list.jobs[0].key());
        record.at += 3'600'000'000'000;
        ASSERT_TRUE(store.keep(list.jobs[0].key(), record));
    }
    fs::remove(folder / "c");
    const auto results = run();
    EXPECT_TRUE(results[0].kept);
    EXPECT_EQ(results[1].record.state, JobState::done);
}

TEST_F(BatchRun, dependentsOfAFailedJobAreSkippedAndTheRestRuns)
{
    write(folder / "a", "a");
    add({"copy", "c", "d"});
    add({"copy", "b", "c"});
    add({"copy", "nothere", "b"});
    add({"copy", "a", "a1"});
    const auto results = run();
    EXPECT_EQ(results[2].record.state, JobState::failed);
    EXPECT_EQ(results[1].record.state, JobState::skipped);
    EXPECT_EQ(results[1].record.reason, "waits for 'copy 2', which is not done");
    EXPECT_EQ(results[0].record.state, JobState::skipped);
    EXPECT_EQ(results[3].record.state, JobState::done);
    const auto plan = planJobs(list);
    const Store store = openStore(folder / "store");
    const auto merged = collect(list, *plan, std::span(&store, 1));
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_EQ(merged[i].record.state, results[i].record.state) << i;
}

TEST_F(BatchRun, aJobKilledWhileWritingLeavesNoPartialFile)
{
    fs::create_directory(folder / "out");
    add({"half", "out/a.png"});
    EXPECT_EQ(run()[0].record.state, JobState::crashed);
    EXPECT_TRUE(fs::is_empty(folder / "out"));
}

// Forks a copy of this process that can be killed.
pid_t runInAnotherProcess(const std::function<void()>& work)
{
    const pid_t child = ::fork();
    if (child == 0) {
        work();
        ::_exit(0);
    }
    return child;
}

TEST_F(BatchRun, aRunKilledAtAnyMomentIsContinuedWithoutLoss)
{
    write(folder / "a", "a");
    for (int i = 0; i < 40; ++i)
        add({"copy", "a", fmt::format("out {}/ü{}", i % 3, i), "log"});
    std::size_t done = 0;
    int kills = 0;
    for (; kills < 50 && done < 40; ++kills) {
        const pid_t child = runInAnotherProcess([&] { run(); });
        std::this_thread::sleep_for(std::chrono::milliseconds(15 + 7 * (kills % 5)));
        ::kill(child, kills % 2 ? SIGKILL : SIGINT);
        ::waitpid(child, nullptr, 0);
        const Store store = openStore(folder / "store");
        const auto merged = collect(list, *planJobs(list), std::span(&store, 1));
        const auto now =
            std::size_t(std::ranges::count(merged, JobState::done, [](const JobResult& r) { return r.record.state; }));
        EXPECT_GE(now, done) << "a result was lost";
        done = now;
    }
    EXPECT_GT(kills, 2) << "it was too quick to be killed";
    const auto results = run();
    for (const JobResult& result : results)
        EXPECT_EQ(result.record.state, JobState::done) << result.record.reason;
    std::size_t files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder.path()))
        if (entry.is_regular_file() && entry.path().string().find("/out ") != std::string::npos) {
            ++files;
            EXPECT_EQ(entry.path().filename().string().find(".part"), std::string::npos) << entry.path();
            EXPECT_EQ(readWhole(entry.path()), "a") << entry.path();
        }
    EXPECT_EQ(files, 40u);
    for (const auto& entry : fs::directory_iterator(folder / "store/work"))
        EXPECT_FALSE(fs::exists(entry.path() / "lock")) << "left of a run that was killed";
}

TEST_F(BatchRun, concurrentRunsOnOneStoreShareTheJobs)
{
    write(folder / "a", "a");
    for (int i = 0; i < 60; ++i)
        add({"copy", "a", fmt::format("o{}", i), "log"});
    const pid_t other = runInAnotherProcess([&] { run(); });
    const auto results = run();
    ::waitpid(other, nullptr, 0);
    for (const JobResult& result : results)
        EXPECT_EQ(result.record.state, JobState::done);
    std::istringstream lines(readWhole(folder / "log"));
    std::map<std::string, int> times;
    for (std::string line; std::getline(lines, line);)
        ++times[line];
    EXPECT_EQ(times.size(), 60u);
    for (const auto& [name, count] : times)
        EXPECT_EQ(count, 1) << name << " ran twice";
    EXPECT_GT(std::ranges::count_if(results, &JobResult::kept), 0) << "the other one did nothing";
}

TEST_F(BatchRun, anInputThatChangesDuringTheJobInvalidatesItsResult)
{
    write(folder / "a", "x");
    add({"copy", "a", "b", "a"}); // it writes its log into its own input
    for (int i = 0; i < 30; ++i)  // even within one step of the file system's clock
        EXPECT_FALSE(run()[0].kept) << i;
}

TEST_F(BatchRun, processorTimeEndsBusyJobsButNotWaitingOnes)
{
    options.processorSeconds = 0.5; // rounded up to 1
    add({"spin", "100"});
    add({"sh", "sleep 2"}); // longer than any limit here by the clock, as on a busy machine
    add({"spin", "101"}).options.seconds = 0.2;
    const auto results = run();
    EXPECT_EQ(results[0].record.state, JobState::late);
    EXPECT_EQ(results[0].record.signal, SIGXCPU);
    EXPECT_EQ(results[0].record.reason, "took more than 1 s of processor time and was terminated");
    EXPECT_EQ(results[1].record.state, JobState::done) << results[1].record.reason;
    EXPECT_GT(results[1].record.seconds, 1.9);
    EXPECT_EQ(results[2].record.reason, "took longer than 0.2 s and was terminated");
}

TEST_F(BatchRun, aJobsOwnLimitsTakePrecedence)
{
    options.seconds = 0.3;
    options.processorSeconds = 1;
    add({"sh", "sleep 1"}).options.seconds = 20;
    add({"sh", "sleep 1.1"});         // different words, because equal words share a result
    Job& free = add({"spin", "1.5"}); // seconds of processor time
    free.options.processorSeconds = 0;
    free.options.seconds = 25;
    const auto results = run();
    EXPECT_EQ(results[0].record.state, JobState::done);
    EXPECT_EQ(results[1].record.state, JobState::late);
    EXPECT_EQ(results[2].record.state, JobState::done) << results[2].record.reason;
}

TEST_F(BatchRun, transientFailuresAreRetriedAndWrongInputIsNot)
{
    options.retries = 1;
    const auto addFlaky = [&](const std::string& file, int times) -> Job& { // crashes at first
        const std::string count = fmt::format("n=$(cat {0} || echo 0); echo $((n + 1)) > {0}; ", file);
        return add({"sh", count + fmt::format("[ $n -ge {} ] || kill -KILL $$", times)});
    };
    addFlaky("once", 1);
    addFlaky("thrice", 3).options.retries = 5;
    addFlaky("never", 9);
    addFlaky("off", 1).options.retries = 0;
    add({"sh", "exit 2"});
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

TEST_F(BatchRun, priorityOrdersJobsAndIsPassedToTheJobsTheyNeed)
{
    options.processes = 1;
    write(folder / "a", "a");
    add({"copy", "a", "plain", "log"});
    add({"copy", "a", "last", "log"}).options.priority = -1;
    add({"copy", "a", "needed", "log"});
    add({"copy", "a", "soon", "log"}).options.priority = 1;
    add({"copy", "needed", "first", "log"}).options.priority = 2;
    run();
    EXPECT_EQ(readWhole(folder / "log"), "needed\nfirst\nsoon\nplain\nlast\n");
}

TEST_F(BatchRun, variablesReachTheJobAndChangeItsResultKey)
{
    ::setenv("COTAN_TEST_OURS", "ours", 1);
    add({"sh", "printf '%s\n' $COTAN_TEST_OURS $COTAN_TEST_OWN > out"}).options.environment = {{"COTAN_TEST_OWN", "1"}};
    const auto ran = [&] {
        const auto results = run();
        return readWhole(folder / "out") + (results[0].kept ? "kept" : "ran");
    };
    EXPECT_EQ(ran(), "ours\n1\nran");
    EXPECT_EQ(ran(), "ours\n1\nkept");
    list.jobs[0].options.environment = {{"COTAN_TEST_OWN", "2"}, {"COTAN_TEST_OURS", "theirs"}};
    EXPECT_EQ(ran(), "theirs\n2\nran");
}

} // namespace
} // namespace cotan
