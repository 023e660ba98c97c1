// Stores, and runs of jobs that misbehave.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <map>
#include <thread>

#include <fmt/format.h>
#include <sys/stat.h>

#include "batch/report.hpp"
#include "batch/run.hpp"
#include "files/sandbox/confine.hpp"
#include "run_tool.hpp"

namespace cotan {
namespace {

using namespace test;
namespace fs = std::filesystem;

Store openStore(const fs::path& folder, const std::string& version = "1")
{
    auto store = Store::open(folder, version);
    EXPECT_TRUE(store) << store.error().message;
    return std::move(*store);
}

class BatchRun : public ::testing::Test {
protected:
    // Adds a job of batch_child. The files of a "copy" job are the ones it names.
    void add(const std::vector<std::string>& words)
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
        list.jobs.push_back(job);
    }

    std::vector<JobResult> run()
    {
        list.folder = folder.path();
        const auto plan = planJobs(list);
        EXPECT_TRUE(plan);
        std::vector<std::size_t> all(list.jobs.size());
        for (std::size_t i = 0; i < all.size(); ++i)
            all[i] = i;
        Store store = openStore(folder / "store");
        const auto results = runJobs(list, *plan, all, store, options, {});
        EXPECT_TRUE(results);
        return *results;
    }

    std::string log() const { return readWhole(folder / "log"); }
    void write(const std::string& name, const std::string& text) { std::ofstream(folder / name) << text; }

    TemporaryFolder folder;
    JobList list;
    RunOptions options{.processes = 2, .seconds = 30, .megabytes = 0, .program = BATCH_CHILD};
};

TEST(BatchDigest, isThePublishedXxh3Of128Bits)
{
    // From xxHash's table of sanity checks: no input, seed 0.
    EXPECT_EQ(digestOf(""), "99aa06d3014798d86001c324468d497f");
    TemporaryFolder folder;
    std::ofstream(folder / "empty");
    std::ofstream(folder / "long") << std::string(5 << 20, 'x');
    FileStates states(folder.path());
    EXPECT_EQ(states.of("empty").digest, digestOf(""));
    EXPECT_EQ(states.of("long").digest, digestOf(std::string(5 << 20, 'x')));
    EXPECT_EQ(states.of("nothere").digest, "missing");
    EXPECT_EQ(states.of(".").digest, "folder");
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    EXPECT_EQ(states.of("pipe").digest, "special");
}

TEST(BatchDigest, aChangeIsNoticedEvenWithEqualSizeAndTime)
{
    TemporaryFolder folder;
    std::ofstream(folder / "a") << "first";
    const auto time = fs::last_write_time(folder / "a");
    FileStates states(folder.path());
    const FileState before = states.of("a");
    EXPECT_TRUE(states.holds(before, nowNanoseconds()));
    std::ofstream(folder / "a") << "other";
    fs::last_write_time(folder / "a", time);
    EXPECT_FALSE(states.holds(before, nowNanoseconds()));
    std::ofstream(folder / "a") << "first"; // the same contents with another time
    EXPECT_TRUE(states.holds(before, nowNanoseconds()));
    fs::remove(folder / "a");
    EXPECT_FALSE(states.holds(before, nowNanoseconds()));
}

JobRecord fullRecord()
{
    JobRecord r;
    r.state = JobState::limit;
    r.code = 5;
    r.signal = 15;
    r.reason = "over <the> limit";
    r.output = "line\nline \xff\n";
    r.seconds = 1.5;
    r.megabytes = 20;
    r.degrees = Degrees{0.25, "read without tangents"};
    r.thumbnail = {2, 3, "AAAA"};
    r.inputs = {{"a.glb", "00", 5, 6, 7, 8}};
    r.outputs = {{"b.png", "11", 5, 6, 7, 8}, {"c", "missing"}};
    r.at = 9;
    return r;
}

TEST(BatchStore, recordsRoundTripAndTruncatedOnesAreRefused)
{
    const std::string text = toText(fullRecord(), {"lint", "a.glb"}, "1");
    const auto back = parseRecord(text);
    ASSERT_TRUE(back);
    EXPECT_EQ(toText(*back, {"lint", "a.glb"}, "1"), text);
    EXPECT_EQ(back->degrees->of, "read without tangents");
    EXPECT_EQ(back->inputs.at(0).changed, 7);
    for (std::size_t size = 0; size + 2 < text.size(); ++size)
        EXPECT_FALSE(parseRecord(text.substr(0, size))) << size;
    std::string unknown = text;
    const std::string state = "\"state\":\"";
    unknown[unknown.find(state) + state.size()] = '?';
    EXPECT_FALSE(parseRecord(unknown));
    for (const char* other : {"[]", "{\"format\": 1}", "{\"format\": 2, \"state\": \"done\"}", "null", "3"})
        EXPECT_FALSE(parseRecord(other)) << other;
}

TEST(BatchStore, onlyResultsDeterminedByTheInputsAreRepeatable)
{
    const auto again = [](JobState state, int code) {
        JobRecord record;
        record.state = state;
        record.code = code;
        return repeatable(record);
    };
    EXPECT_TRUE(again(JobState::done, 0));
    EXPECT_TRUE(again(JobState::limit, 5));
    EXPECT_TRUE(again(JobState::failed, 1)); // wrong options
    EXPECT_TRUE(again(JobState::failed, 2)); // wrong input
    for (const int code : {3, 4, 70})        // missing device or library, full disk, crash
        EXPECT_FALSE(again(JobState::failed, code)) << code;
    for (const JobState state :
         {JobState::notRun, JobState::skipped, JobState::late, JobState::memory, JobState::crashed})
        EXPECT_FALSE(again(state, 2)) << name(state);
}

TEST(BatchStore, findsByArgumentsAndVersionAndIgnoresDamagedRecords)
{
    TemporaryFolder folder;
    const Store one = openStore(folder / "s", "1"), two = openStore(folder / "s", "2");
    ASSERT_TRUE(one.keep({"lint", "a"}, fullRecord()));
    EXPECT_TRUE(one.find({"lint", "a"}));
    EXPECT_FALSE(one.find({"linta"}));
    EXPECT_FALSE(one.find({"lint", "a", ""}));
    EXPECT_FALSE(two.find({"lint", "a"}));
    for (const auto& entry : fs::recursive_directory_iterator(folder / "s"))
        if (entry.path().extension() == ".json")
            fs::resize_file(entry.path(), entry.file_size() / 2);
    EXPECT_FALSE(one.find({"lint", "a"}));
    EXPECT_FALSE(Store::openToRead(folder / "nothere", "1"));
}

TEST(BatchStore, aJobIsClaimedByOneProcessAtATime)
{
    TemporaryFolder folder;
    const Store one = openStore(folder / "s"), two = openStore(folder / "s");
    auto claim = one.claim({"a"});
    ASSERT_TRUE(claim);
    EXPECT_FALSE(two.claim({"a"}));
    EXPECT_TRUE(two.claim({"b"}));
    claim.reset();
    EXPECT_TRUE(two.claim({"a"}));
}

TEST(BatchStore, onlyWorkFoldersOfKilledProcessesAreRemoved)
{
    TemporaryFolder folder;
    fs::create_directories(folder / "s/work/killed/1");
    std::ofstream(folder / "s/work/killed/lock");
    Store one = openStore(folder / "s"), two = openStore(folder / "s");
    const auto a = one.workFolder(), b = two.workFolder();
    ASSERT_TRUE(a && b);
    EXPECT_NE(*a, *b);
    EXPECT_TRUE(fs::exists(*a));
    EXPECT_FALSE(fs::exists(folder / "s/work/killed"));

    // Folders without a lock are kept for a minute: their process may be about to create it.
    fs::create_directories(folder / "s/work/young");
    fs::create_directories(folder / "s/work/old");
    fs::last_write_time(folder / "s/work/old", fs::file_time_type::clock::now() - std::chrono::minutes(2));
    const Store three = openStore(folder / "s");
    EXPECT_TRUE(fs::exists(*a) && fs::exists(*b));
    EXPECT_TRUE(fs::exists(folder / "s/work/young"));
    EXPECT_FALSE(fs::exists(folder / "s/work/old"));
}

TEST_F(BatchRun, jobsThatCrashHangOrExhaustMemoryDoNotEndTheRun)
{
    options.processes = 4;
    options.seconds = 1;
    options.megabytes = 256;
    const std::pair<std::string, JobState> cases[] = {
        {"crash", JobState::crashed}, {"abort", JobState::crashed}, {"killed", JobState::crashed},
        {"hang", JobState::late},     {"stubborn", JobState::late}, {"eat", JobState::memory},
        {"loud", JobState::done},     {"leave", JobState::done},    {"fine", JobState::done}};
    for (const auto& [word, state] : cases)
        add({word});
    add({"fail", "2", "a.glb: broken"});
    add({"fail", "5", "over 3 degrees"});
    const auto results = run();
    ASSERT_EQ(results.size(), 11u);
    for (std::size_t i = 0; i < std::size(cases); ++i) {
        if (kSanitized && cases[i].first == "eat") // memory is not limited then
            continue;
        EXPECT_EQ(results[i].record.state, cases[i].second)
            << cases[i].first << ": " << name(results[i].record.state) << ", " << results[i].record.reason;
        EXPECT_EQ(results[i].record.reason.empty(), cases[i].second == JobState::done) << cases[i].first;
        const JobRecord& record = results[i].record;
        EXPECT_NE(record.code.has_value(), record.signal.has_value()) << cases[i].first << " ended one way";
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
        write(name, name);
    add({"copy", "a", "a1", "log"});
    add({"copy", "b", "b1", "log"});
    add({"copy", "b1", "b2", "log"});
    add({"copy", "c", "c1", "log"});
    add({"copy", "gone", "g1", "log"}); // fails because of its inputs: kept as well
    add({"crash"});                     // not because of its inputs: run again
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
    EXPECT_EQ(log(), "a1\nb1\nc1\ng1\nb2\n"); // b2 became ready when b1 was done
    EXPECT_EQ(ran(), "crash ");
    EXPECT_EQ(log(), "");
    write("b", "B"); // and with it the files made from it
    EXPECT_EQ(ran(), "b1 b2 crash ");
    EXPECT_EQ(readWhole(folder / "b2"), "B");
    fs::remove(folder / "c1");
    EXPECT_EQ(ran(), "c1 crash ");
    write("a1", "somebody else's");
    EXPECT_EQ(ran(), "a1 crash ");
    write("gone", "here");
    EXPECT_EQ(ran(), "g1 crash ");
    options.again = true;
    EXPECT_EQ(ran(), "a1 b1 b2 c1 g1 crash ");
}

TEST_F(BatchRun, dependentsOfAFailedJobAreSkippedAndTheRestRuns)
{
    write("a", "a");
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
    write("a", "a");
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
    write("a", "a");
    for (int i = 0; i < 60; ++i)
        add({"copy", "a", fmt::format("o{}", i), "log"});
    const pid_t other = runInAnotherProcess([&] { run(); });
    const auto results = run();
    ::waitpid(other, nullptr, 0);
    for (const JobResult& result : results)
        EXPECT_EQ(result.record.state, JobState::done);
    std::istringstream lines(log());
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
    write("a", "x");
    add({"copy", "a", "b", "a"}); // it writes its log into its own input
    for (int i = 0; i < 30; ++i)  // even within one step of the file system's clock
        EXPECT_FALSE(run()[0].kept) << i;
}

TEST(BatchReport, sortsTheWorstFirstAndEscapesTextOfJobs)
{
    JobList list{"/jobs", {}};
    std::vector<JobResult> results;
    const auto add = [&](const std::string& name, JobState state, double degrees) {
        Job job;
        job.name = name;
        job.words = {"lint", "</script><script>alert(1)</script>"};
        list.jobs.push_back(job);
        JobResult result{list.jobs.size() - 1, {}, false};
        result.record.state = state;
        result.record.reason = "<img src=x onerror=alert(2)>";
        result.record.output = "<!--<script>";
        if (degrees >= 0)
            result.record.degrees = Degrees{degrees, "<i>"};
        result.record.outputs = {{"/out/\"><script>%20 ü", "00"}};
        results.push_back(result);
    };
    add("good", JobState::done, 0.5);
    add("worse", JobState::done, 7);
    add("unknown", JobState::done, -1);
    add("<b>crash</b>", JobState::crashed, -1);
    add("limit", JobState::limit, 3);
    add("late", JobState::late, -1);
    EXPECT_EQ(worstFirst(results), (std::vector<std::size_t>{3, 5, 4, 1, 0, 2}));
    const std::string page = batchPage(list, results, "</title><script>", "<footer>", "/report", 100);
    const auto count = [&](const std::string& what) {
        std::size_t n = 0;
        for (std::size_t at = 0; (at = page.find(what, at)) != std::string::npos; ++at)
            ++n;
        return n;
    };
    // The column headings, from left to right.
    std::size_t at = page.find("class=\"row head\"");
    for (const char* const head : {">Job<", ">State<", ">Degrees<", ">Seconds<", ">MiB<", "id=\"list\""}) {
        ASSERT_NE(at = page.find(head, at), std::string::npos) << head;
    }
    EXPECT_EQ(count("<script"), 2u);
    EXPECT_EQ(count("</script>"), 2u);
    EXPECT_EQ(count("<img"), 0u);
    EXPECT_EQ(count("<b>"), 0u);
    EXPECT_EQ(count("<!--"), 0u);
    EXPECT_NE(page.find("\"../out/%22%3E%3Cscript%3E%2520%20%C3%BC\""), std::string::npos);
    const std::string two = batchPage(list, results, "t", "f", "/report", 2);
    EXPECT_NE(two.find("the worst 2 of 6; f"), std::string::npos);
    EXPECT_NE(two.find("crash"), std::string::npos);
    EXPECT_EQ(two.find("\"unknown\""), std::string::npos);
    EXPECT_EQ(summaryOf(results), "6 jobs: 3 done, 1 over limit, 1 too slow, 1 crashed");
}

TEST(BatchDegrees, areOfTheWorstMapOrMeasuredInRenders)
{
    const auto lint = degreesIn(R"({"command": "lint", "fits": [
        {"orthonormal": {"mean": 4}, "cotangent": {"mean": 3}, "smooth": {"mean": 2}},
        {"orthonormal": {"mean": 1}, "cotangent": {"mean": 9}, "smooth": {"mean": 9}}]})");
    ASSERT_TRUE(lint);
    EXPECT_EQ(lint->mean, 2);
    const auto convert = degreesIn(R"({"command": "convert", "maps": [{"degrees_unconverted": {"mean": 5}}],
        "verify": {"degrees": {"mean_degrees": 0.5}}})");
    ASSERT_TRUE(convert);
    EXPECT_EQ(convert->mean, 0.5);
    const auto objects = degreesIn(R"({"command": "bake", "objects": [{"verify": {"all": {"mean_degrees": 1}}},
        {"verify": {"all": {"mean_degrees": 3}}}, {"verify": {"all": {"mean_degrees": null}}}]})");
    ASSERT_TRUE(objects);
    EXPECT_EQ(objects->mean, 3);
    for (const char* none : {"", "{", "[]", "{\"command\": \"lint\"}", "{\"command\": \"lint\", \"fits\": []}",
                             "{\"command\": 3}", "{\"command\": \"lint\", \"fits\": {\"orthonormal\": 1}}",
                             "{\"command\": \"compare\", \"normals\": {\"mean_degrees\": null}}"})
        EXPECT_FALSE(degreesIn(none)) << none;
}

} // namespace
} // namespace cotan
