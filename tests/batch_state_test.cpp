// What a batch stores and how it recognises files: states of files, records, stores, and the results collected.
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include "batch/job.hpp"
#include "batch/run.hpp"
#include "run_tool.hpp"

namespace cotan {
namespace {

using namespace test;
namespace fs = std::filesystem;
using Numbers = std::vector<std::size_t>;

TEST(BatchFileStates, holdTheSizeTimesAndInodeOfTheFile)
{
    const TemporaryFolder folder;
    std::ofstream(folder / "a") << "seven b";
    const timespec times[] = {{11, 22}, {5, 7}}; // access, modification
    ASSERT_EQ(::utimensat(AT_FDCWD, (folder / "a").c_str(), times, 0), 0);
    struct stat status {};
    ASSERT_EQ(::stat((folder / "a").c_str(), &status), 0);
    FileStates states(folder.path());
    const FileState state = states.of("a");
    EXPECT_EQ(state.file, "a");
    EXPECT_EQ(state.bytes, 7u);
    EXPECT_EQ(state.modified, 5'000'000'007);
    EXPECT_EQ(state.changed, std::int64_t(status.st_ctim.tv_sec) * 1'000'000'000 + status.st_ctim.tv_nsec);
    EXPECT_EQ(state.number, status.st_ino);
    EXPECT_EQ(state.digest, digestOf("seven b"));
    for (const auto& [file, digest] : {std::pair("gone", "missing"), {".", "folder"}, {"/dev/null", "special"}}) {
        const FileState none = states.of(file);
        EXPECT_EQ(none.digest, digest);
        EXPECT_EQ(none.file, file);
        EXPECT_EQ(none.bytes + std::uint64_t(none.modified) + std::uint64_t(none.changed) + none.number, 0u) << file;
        EXPECT_TRUE(states.holds(none, 1));
        EXPECT_FALSE(states.holds(FileState{.file = file, .digest = "00"}, 1)) << file;
    }
    const auto now =
        std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch())
            .count();
    for (const std::int64_t clock : {nowNanoseconds(), fileClockNanoseconds()})
        EXPECT_LT(std::abs(clock - now), 1'000'000'000);
}

// From two seconds after a change on, the times suffice and the file is not read. A wrong digest shows whether it was.
TEST(BatchFileStates, areTrustedFromTwoSecondsAfterTheLastChange)
{
    const TemporaryFolder folder;
    std::ofstream(folder / "a") << "seven b";
    FileStates states(folder.path());
    const FileState right = states.of("a");
    FileState wrong = right;
    wrong.digest = "00";
    const std::int64_t enough = right.changed + 2'000'000'001;
    EXPECT_TRUE(states.holds(wrong, enough));
    EXPECT_FALSE(states.holds(wrong, enough - 1));
    EXPECT_TRUE(states.holds(right, enough - 1));
    EXPECT_TRUE(states.holds(right, 0));
    for (const auto change : {+[](FileState& s) { ++s.modified; }, +[](FileState& s) { ++s.changed; },
                              +[](FileState& s) { ++s.number; }, +[](FileState& s) { ++s.bytes; }}) {
        FileState read = wrong, other = right;
        change(read);
        change(other);
        EXPECT_FALSE(states.holds(read, enough));
        EXPECT_EQ(states.holds(other, enough), other.bytes == right.bytes);
    }
}

// Every field has a distinct value, as in a store.
TEST(BatchRecord, hasEachFieldUnderItsName)
{
    const auto r = parseRecord(R"({"format": 2, "version": "3", "words": ["x"], "state": "too slow", "code": 4,
        "signal": 9, "runs": 3, "reason": "why", "said": "what", "seconds": 1.5, "processor_seconds": 2.5,
        "megabytes": 3.5, "at": 77, "inputs": [{"file": "a", "digest": "b", "bytes": 1, "modified": 2, "changed": 3,
        "number": 4}], "outputs": [{"file": "c", "digest": "d", "bytes": 5, "modified": 6, "changed": 7, "number": 8}],
        "degrees": {"mean": 0.5, "of": "maps"}, "thumbnail": {"width": 6, "height": 5, "jpeg": "AA"}})");
    ASSERT_TRUE(r);
    EXPECT_EQ(r->state, JobState::late);
    EXPECT_EQ(r->code, 4);
    EXPECT_EQ(r->signal, 9);
    EXPECT_EQ(r->runs, 3);
    EXPECT_EQ(r->reason, "why");
    EXPECT_EQ(r->output, "what");
    EXPECT_EQ(r->seconds, 1.5);
    EXPECT_EQ(r->processorSeconds, 2.5);
    EXPECT_EQ(r->megabytes, 3.5);
    EXPECT_EQ(r->at, 77);
    EXPECT_EQ(r->degrees->mean, 0.5);
    EXPECT_EQ(r->degrees->of, "maps");
    EXPECT_EQ(r->thumbnail.width, 6);
    EXPECT_EQ(r->thumbnail.height, 5);
    EXPECT_EQ(r->thumbnail.jpeg, "AA");
    ASSERT_EQ(r->inputs.size(), 1u);
    ASSERT_EQ(r->outputs.size(), 1u);
    const auto text = [](const FileState& s) {
        return fmt::format("{} {} {} {} {} {}", s.file, s.digest, s.bytes, s.modified, s.changed, s.number);
    };
    EXPECT_EQ(text(r->inputs[0]), "a b 1 2 3 4");
    EXPECT_EQ(text(r->outputs[0]), "c d 5 6 7 8");
    const std::string written = toText(*r, {"x"}, "3");
    EXPECT_TRUE(written.starts_with(R"({"format":2,"version":"3","words":["x"],"state":"too slow","code":4,"signal":9,)"
                                    R"("runs":3,"reason":"why","said":"what","seconds":1.5,"processor_seconds":2.5,)"
                                    R"("megabytes":3.5,"at":77,)"))
        << written;
    EXPECT_TRUE(written.ends_with("}\n"));
    JobRecord none;
    const std::string without = toText(none, {}, "");
    for (const char* part : {"\"code\":null", "\"signal\":null", "\"inputs\":[]", "\"outputs\":[]"})
        EXPECT_NE(without.find(part), std::string::npos) << part;
    for (const char* part : {"degrees", "thumbnail"})
        EXPECT_EQ(without.find(part), std::string::npos) << part;
    const auto back = parseRecord(without);
    ASSERT_TRUE(back);
    EXPECT_FALSE(back->code || back->signal || back->degrees);
    for (int i = 0; i < 8; ++i) {
        none.state = JobState(i);
        EXPECT_EQ(parseRecord(toText(none, {}, ""))->state, JobState(i));
    }
}

TEST(BatchStoreFiles, areNamedByVersionAndArguments)
{
    const TemporaryFolder folder;
    fs::path work;
    {
        auto store = Store::open(folder / "s", "7");
        ASSERT_TRUE(store);
        EXPECT_EQ(store->folder(), folder / "s");
        ASSERT_TRUE(store->keep({"lint", "a"}, {}));
        const std::string key = digestOf(std::string("7\0lint\0a", 8));
        EXPECT_TRUE(fs::is_regular_file(folder / "s/results" / key.substr(0, 2) / (key.substr(2) + ".json")));
        const auto once = store->workFolder(), twice = store->workFolder();
        ASSERT_TRUE(once && twice);
        EXPECT_EQ(*once, *twice);
        work = *once;
        EXPECT_EQ(work.parent_path(), folder / "s/work");
        EXPECT_TRUE(fs::is_directory(work));
        const auto other = Store::openToRead(folder / "s", "7");
        ASSERT_TRUE(other);
        EXPECT_TRUE(other->find({"lint", "a"}));
    }
    EXPECT_FALSE(fs::exists(work)) << "gone with its store";
    fs::create_directory(folder / "empty");
    for (const char* name : {"empty", "gone"}) {
        const auto none = Store::openToRead(folder / name, "7");
        ASSERT_FALSE(none);
        EXPECT_EQ(none.error().kind, ErrorKind::input);
        EXPECT_EQ(none.error().message, (folder / name).string() + ": expected a store of cotan batch; found none");
    }
}

TEST(BatchCollect, takesTheNewestValidRecord)
{
    const TemporaryFolder folder;
    std::ofstream(folder / "in") << "x";
    FileStates states(folder.path());
    JobList list{folder.path(), {}};
    for (const char* name : {"both", "broken", "waits", "never"}) {
        Job job;
        job.name = name;
        job.words = {name};
        list.jobs.push_back(job);
    }
    list.jobs[1].outputs = {"b"};
    list.jobs[2].inputs = {"b"};
    const auto plan = planJobs(list);
    ASSERT_TRUE(plan);
    using Names = std::vector<std::string>;
    const auto open = [&](const Names& names) {
        std::vector<Store> stores;
        for (const std::string& name : names)
            stores.push_back(std::move(*Store::open(folder / name, "1")));
        return stores;
    };
    const std::vector<Store> stores = open({"old", "new", "stale"});
    JobRecord record;
    record.state = JobState::done;
    const auto keep = [&](std::size_t store, const char* job, std::int64_t at, const std::string& reason) {
        record.at = at;
        record.reason = reason;
        ASSERT_TRUE(stores[store].keep({job}, record));
    };
    record.inputs = {states.of("in")};
    keep(0, "both", 10, "the old one");
    keep(1, "both", 20, "the new one");
    record.inputs[0].digest = "00"; // different contents
    record.inputs[0].bytes = 9;
    keep(2, "both", 30, "of other inputs");
    std::swap(record.inputs, record.outputs);
    keep(0, "never", 30, "of other outputs");
    record.inputs = record.outputs = {};
    record.state = JobState::failed;
    keep(2, "broken", 1, "it is broken");
    for (const Names& names : {Names{"old", "new", "stale"}, {"stale", "new", "old"}}) {
        const auto results = collect(list, *plan, open(names));
        ASSERT_EQ(results.size(), 4u);
        const std::pair<JobState, const char*> expected[] = {
            {JobState::done, "the new one"},
            {JobState::failed, "it is broken"},
            {JobState::skipped, "waits for 'broken', which is not done"},
            {JobState::notRun, "no store has a result for these inputs"}};
        for (std::size_t i = 0; i < 4; ++i) {
            EXPECT_EQ(results[i].job, i);
            EXPECT_EQ(results[i].record.state, expected[i].first) << i;
            EXPECT_EQ(results[i].record.reason, expected[i].second) << i;
            EXPECT_FALSE(results[i].kept);
        }
    }
}

JobList jobsWith(const std::vector<std::pair<std::vector<std::string>, std::vector<std::string>>>& files)
{
    JobList list{"/jobs", {}};
    for (const auto& [inputs, outputs] : files) {
        Job job;
        job.inputs = inputs;
        job.outputs = outputs;
        job.line = 10 + list.jobs.size();
        list.jobs.push_back(job);
    }
    return list;
}

TEST(BatchPlan, dependenciesAreUniqueAndAJobMayReadItsOutputFolder)
{
    const auto plan =
        planJobs(jobsWith({{{}, {"folder", "b", "b"}},
                           {{"folder/x", "b", "folder/y"}, {"c"}},
                           {{"out/deep/x"}, {"out"}}, // a job may read its own output folder; files in it may be older
                           {{"folders"}, {"d"}}}));
    ASSERT_TRUE(plan) << plan.error().message;
    EXPECT_EQ(plan->needs, (std::vector<Numbers>{{}, {0}, {}, {}}));
    EXPECT_EQ(plan->group, (Numbers{0, 0, 1, 2}));
    const auto own = planJobs(jobsWith({{{}, {"x"}}, {{"b"}, {"./b"}}}));
    ASSERT_FALSE(own);
    EXPECT_EQ(own.error().kind, ErrorKind::input);
    EXPECT_EQ(own.error().message,
              "line 11: writes b, which it also reads: a second run would start from the first one's "
              "result; expected another name");
    const auto circle = planJobs(jobsWith({{{}, {"z"}}, {{"a"}, {"b"}}, {{"b"}, {"a"}}}));
    ASSERT_FALSE(circle);
    EXPECT_EQ(circle.error().message,
              "line 11 waits for line 12 waits for line 11: each reads what the next one writes");
    // Jobs connected by a third job have the number of the first of them.
    const auto joined = planJobs(jobsWith({{{}, {"a"}}, {{}, {"b"}}, {{}, {"c"}}, {{"c", "a"}, {"d"}}, {{}, {"e"}}}));
    ASSERT_TRUE(joined);
    EXPECT_EQ(joined->group, (Numbers{0, 1, 0, 0, 2}));
    EXPECT_EQ(jobsOf(*joined, {1, 2}), (Numbers{0, 2, 3, 4}));
    EXPECT_EQ(jobsOf(*joined, {2, 2}), Numbers{1});
    EXPECT_EQ(jobsOf(*joined, {3, 3}), Numbers{4});
    EXPECT_EQ(jobsOf(*joined, {4, 4}), Numbers{});
    EXPECT_EQ(jobsOf(*joined, {}), (Numbers{0, 1, 2, 3, 4}));
    for (const char* whole : {"1/1", "8/8", "1/8"})
        EXPECT_TRUE(parseShard(whole)) << whole;
    const auto wrong = parseShard("9/8");
    ASSERT_FALSE(wrong);
    EXPECT_EQ(wrong.error().kind, ErrorKind::usage);
    EXPECT_EQ(wrong.error().message, "--shard: expected K/N with K from 1 to N, such as 3/8; found '9/8'");
}

} // namespace
} // namespace cotan
