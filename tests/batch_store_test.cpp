// What a batch stores and how it recognises files: states of files, records, stores, and the results collected.
#include <gtest/gtest.h>

#include <chrono>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include "batch_fixture.hpp"

namespace cotan {
namespace {

using namespace app;
using namespace test;
namespace fs = std::filesystem;

TEST(BatchDigest, isThePublishedXxh3Of128Bits)
{
    // From xxHash's table of sanity checks: no input, seed 0.
    EXPECT_EQ(digestOf(""), "99aa06d3014798d86001c324468d497f");
    const TemporaryFolder folder;
    FileStates states(folder.path());
    for (const std::string& text : {std::string(), std::string(5 << 20, 'x')}) {
        write(folder / "file", text);
        EXPECT_EQ(states.of("file").digest, digestOf(text));
    }
}

TEST(BatchFileStates, holdTheSizeTimesAndInodeOfTheFile)
{
    const TemporaryFolder folder;
    write(folder / "a", "seven b");
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
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    for (const auto& [file, digest] :
         {std::pair("gone", "missing"), {".", "folder"}, {"/dev/null", "special"}, {"pipe", "special"}}) {
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

TEST(BatchFileStates, noticeAChangeEvenWithEqualSizeAndTime)
{
    const TemporaryFolder folder;
    write(folder / "a", "first");
    const auto time = fs::last_write_time(folder / "a");
    FileStates states(folder.path());
    const FileState before = states.of("a");
    EXPECT_TRUE(states.holds(before, nowNanoseconds()));
    write(folder / "a", "other");
    fs::last_write_time(folder / "a", time);
    EXPECT_FALSE(states.holds(before, nowNanoseconds()));
    write(folder / "a", "first"); // the same contents with another time
    EXPECT_TRUE(states.holds(before, nowNanoseconds()));
    fs::remove(folder / "a");
    EXPECT_FALSE(states.holds(before, nowNanoseconds()));
}

// From two seconds after a change on, the times suffice and the file is not read. A wrong digest shows whether it was.
TEST(BatchFileStates, areTrustedFromTwoSecondsAfterTheLastChange)
{
    const TemporaryFolder folder;
    write(folder / "a", "seven b");
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
const std::string kRecord =
    R"({"format":2,"version":"3","words":["x"],"state":"too slow","code":4,"signal":9,"runs":3,"reason":"a <why>",)"
    R"("said":"what\nelse\n","seconds":1.5,"processor_seconds":2.5,"megabytes":3.5,"at":77,)"
    R"("inputs":[{"file":"a","digest":"b","bytes":1,"modified":2,"changed":3,"number":4}],)"
    R"("outputs":[{"file":"c","digest":"d","bytes":5,"modified":6,"changed":7,"number":8},)"
    R"({"file":"e","digest":"missing","bytes":0,"modified":0,"changed":0,"number":0}],)"
    R"("degrees":{"mean":0.5,"of":"maps"},"thumbnail":{"width":6,"height":5,"jpeg":"AA"}})"
    "\n";

TEST(BatchRecord, hasEachFieldUnderItsName)
{
    const auto r = parseRecord(kRecord);
    ASSERT_TRUE(r);
    EXPECT_EQ(r->state, JobState::late);
    EXPECT_EQ(r->code, 4);
    EXPECT_EQ(r->signal, 9);
    EXPECT_EQ(r->runs, 3);
    EXPECT_EQ(r->reason, "a <why>");
    EXPECT_EQ(r->output, "what\nelse\n");
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
    ASSERT_EQ(r->outputs.size(), 2u);
    const auto text = [](const FileState& s) {
        return fmt::format("{} {} {} {} {} {}", s.file, s.digest, s.bytes, s.modified, s.changed, s.number);
    };
    EXPECT_EQ(text(r->inputs[0]), "a b 1 2 3 4");
    EXPECT_EQ(text(r->outputs[0]), "c d 5 6 7 8");
    EXPECT_EQ(toText(*r, {"x"}, "3"), kRecord);
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
    none.output = "no UTF-8: \xff";
    EXPECT_TRUE(parseRecord(toText(none, {}, "")));
}

TEST(BatchStore, truncatedAndForeignRecordsAreRefused)
{
    for (std::size_t size = 0; size + 2 < kRecord.size(); ++size)
        EXPECT_FALSE(parseRecord(kRecord.substr(0, size))) << size;
    std::string unknown = kRecord;
    unknown.replace(unknown.find("too slow"), 1, "?");
    for (const std::string& other : {unknown, std::string("[]"), std::string("{\"format\": 1}"),
                                     std::string("{\"format\": 2, \"state\": \"done\"}"), std::string("3")})
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
    const TemporaryFolder folder;
    fs::path work;
    {
        Store one = openStore(folder / "s", "1");
        const Store two = openStore(folder / "s", "2");
        ASSERT_TRUE(one.keep({"lint", "a"}, *parseRecord(kRecord)));
        const std::string key = digestOf(std::string("1\0lint\0a", 8));
        const fs::path file = folder / "s/results" / key.substr(0, 2) / (key.substr(2) + ".json");
        EXPECT_TRUE(fs::is_regular_file(file));
        EXPECT_TRUE(one.find({"lint", "a"}));
        EXPECT_TRUE(Store::openToRead(folder / "s", "1")->find({"lint", "a"}));
        EXPECT_FALSE(one.find({"linta"}));
        EXPECT_FALSE(one.find({"lint", "a", ""}));
        EXPECT_FALSE(two.find({"lint", "a"}));
        fs::resize_file(file, fs::file_size(file) / 2);
        EXPECT_FALSE(one.find({"lint", "a"}));
        const auto once = one.workFolder(), twice = one.workFolder();
        ASSERT_TRUE(once && twice);
        EXPECT_EQ(*once, *twice);
        work = *once;
        EXPECT_EQ(work.parent_path(), folder / "s/work");
        EXPECT_TRUE(fs::is_directory(work));
    }
    EXPECT_FALSE(fs::exists(work)) << "gone with its store";
    fs::create_directory(folder / "empty");
    for (const char* name : {"empty", "gone"}) {
        const auto none = Store::openToRead(folder / name, "1");
        ASSERT_FALSE(none);
        EXPECT_EQ(none.error().kind, ErrorKind::input);
        EXPECT_EQ(none.error().message, (folder / name).string() + ": expected a store of cotan batch; found none");
    }
}

TEST(BatchStore, aJobIsClaimedByOneProcessAtATime)
{
    const TemporaryFolder folder;
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
    const TemporaryFolder folder;
    fs::create_directories(folder / "s/work/killed/1");
    write(folder / "s/work/killed/lock", "");
    Store one = openStore(folder / "s"), two = openStore(folder / "s");
    const auto a = one.workFolder(), b = two.workFolder();
    ASSERT_TRUE(a && b);
    EXPECT_NE(*a, *b);
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

TEST(BatchCollect, takesTheNewestValidRecord)
{
    const TemporaryFolder folder;
    write(folder / "in", "x");
    FileStates states(folder.path());
    JobList list{folder.path(), {}};
    for (const char* name : {"both", "broken", "waits", "never"})
        addJob(list, {name}).name = name;
    list.jobs[1].outputs = {"b"};
    list.jobs[2].inputs = {"b"};
    const auto plan = planJobs(list);
    ASSERT_TRUE(plan);
    const auto open = [&](const Words& names) {
        std::vector<Store> stores;
        for (const std::string& name : names)
            stores.push_back(openStore(folder / name));
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
    for (const Words& names : {Words{"old", "new", "stale"}, {"stale", "new", "old"}}) {
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

} // namespace
} // namespace cotan
