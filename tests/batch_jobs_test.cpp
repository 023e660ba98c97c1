// Job files, and the dependencies between jobs.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <numeric>
#include <random>
#include <set>

#include <fmt/format.h>

#include "batch/job.hpp"
#include "run_tool.hpp"

namespace cotan {
namespace {

using namespace test;

// Splits words "IN... > OUT..." into inputs and outputs, like the table of a command.
Status splitWords(Job& job)
{
    bool out = false;
    for (std::size_t i = 1; i < job.words.size(); ++i)
        if (job.words[i] == ">")
            out = true;
        else
            (out ? job.outputs : job.inputs).push_back(job.words[i]);
    return job.words[0] == "bad" ? Status(usageError("there is no command 'bad'")) : Status(Done{});
}

Result<JobList> read(const std::string& text)
{
    static const TemporaryFolder folder;
    std::ofstream(folder / "jobs.jsonl", std::ios::binary) << text;
    return readJobs(folder / "jobs.jsonl", splitWords);
}

JobList listOf(const std::vector<std::vector<std::string>>& jobs)
{
    JobList list{"/jobs", {}};
    for (const auto& words : jobs) {
        Job job;
        job.name = fmt::format("job {}", list.jobs.size());
        job.words = words;
        job.line = list.jobs.size() + 1;
        EXPECT_TRUE(splitWords(job));
        list.jobs.push_back(job);
    }
    return list;
}

TEST(BatchJobs, eachLineIsAJobNamedByItselfOrItsCommandLine)
{
    const auto list =
        read("\xef\xbb\xbf{\"command\": [\"copy\", \"a b\", \">\", \"c\"]}\r\n\n  \n"
             "{\"name\": \"ü <b>\", \"command\": [\"copy\"], \"inputs\": [\"x\"], \"outputs\": [\"y\", \"y\"]}");
    ASSERT_TRUE(list) << list.error().message;
    ASSERT_EQ(list->jobs.size(), 2u);
    EXPECT_EQ(list->jobs[0].name, "copy 'a b' '>' c");
    EXPECT_EQ(list->jobs[0].inputs, std::vector<std::string>{"a b"});
    EXPECT_EQ(list->jobs[0].outputs, std::vector<std::string>{"c"});
    EXPECT_EQ(list->jobs[1].name, "ü <b>");
    EXPECT_EQ(list->jobs[1].line, 4u);
    EXPECT_EQ(list->jobs[1].inputs, std::vector<std::string>{"x"});
    EXPECT_EQ(list->jobs[1].outputs, std::vector<std::string>{"y"});
}

// Lists in lists, or objects in objects, nested far deeper than a stack allows.
std::string deep(char open, char close)
{
    std::string text;
    for (int i = 0; i < 200000; ++i)
        (text += open) += open == '{' ? "\"a\":" : "";
    return text + "1" + std::string(200000, close);
}

TEST(BatchJobs, invalidLinesAreReportedWithWhatIsExpectedAndFound)
{
    const std::pair<std::string, std::string> cases[] = {
        {"{\"command\": [\"copy\"]", "text that is not JSON"},
        {"[\"copy\"]", "expected a JSON object"},
        {"{}", "\"command\": expected a list of strings"},
        {"{\"command\": []}", "found none"},
        {"{\"command\": \"lint a.glb\"}", "found \"lint a.glb\""},
        {"{\"command\": [\"copy\", 4]}", "quote numbers, too); found 4"},
        {"{\"command\": [\"a\\u0000b\"]}", "without the character 0"},
        {"{\"command\": [\"copy\"], \"input\": [\"a\"]}", "found \"input\""},
        {"{\"command\": [\"copy\"], \"inputs\": \"a\"}", "\"inputs\": expected a list"},
        {"{\"command\": [\"copy\"], \"name\": 3}", "\"name\": expected a string"},
        {"{\"command\": [\"copy\"], \"name\": \"\"}", "\"name\": expected a string"},
        {"{\"command\": [\"copy\"], \"name\": \"" + std::string(1001, 'n') + "\"}", "a string of 1 to 1000 bytes"},
        {"{\"command\": [\"bad\"]}", "there is no command 'bad'"},
        {std::string(100000, '['), "text that is not JSON"},
        {"{\"command\": [" + deep('[', ']') + "]}", "\"command\": expected strings only"}, // once overflowed the stack
        {"{\"command\": " + deep('{', '}') + "}", "found an object"},
        {"{\"name\": " + deep('[', ']') + ", \"command\": [\"copy\"]}", "\"name\": expected a string"},
        {std::string("\0\0\0", 3), "text that is not JSON"},
        {"{\"name\": \"ok\", \"command\": [\"copy\", \"other\"]}", "is also the name of line 1"},
    };
    for (const auto& [line, message] : cases) {
        const auto list = read("{\"name\": \"ok\", \"command\": [\"copy\"]}\n" + line + "\n");
        ASSERT_FALSE(list) << line.substr(0, 80);
        EXPECT_EQ(list.error().kind, ErrorKind::input);
        EXPECT_NE(list.error().message.find("jobs.jsonl:2: "), std::string::npos) << list.error().message;
        EXPECT_NE(list.error().message.find(message), std::string::npos) << list.error().message;
        EXPECT_EQ(list.error().message.find('\n'), std::string::npos);
        EXPECT_LT(list.error().message.size(), 400u);
    }
    const auto several = read("x\n{\"command\": [\"copy\"]}\ny\nz\n");
    ASSERT_FALSE(several);
    EXPECT_NE(several.error().message.find("jobs.jsonl:1: "), std::string::npos);
    EXPECT_NE(several.error().message.find("(and 2 more lines are wrong)"), std::string::npos);
    EXPECT_FALSE(read("\n\n"));
    EXPECT_TRUE(read("\xef\xbb\xbf\n{\"command\": [\"copy\"], \"name\": \"" + std::string(1000, 'n') + "\"}\n"));
}

TEST(BatchJobs, damagedJobFilesDoNotCrash)
{
    const std::string good = "{\"name\": \"a\", \"command\": [\"copy\", \"a\", \">\", \"b\"], \"inputs\": [\"x\"]}\n"
                             "{\"command\": [\"copy\", \"\\u00fc\", \">\", \"c\"]}\n";
    std::mt19937 random(7);
    int read_ = 0, refused = 0;
    for (int i = 0; i < 1500; ++i) {
        std::string text = good;
        for (unsigned k = 0; k <= random() % 3; ++k)
            switch (random() % 3) {
            case 0: text[random() % text.size()] = char(random()); break;
            case 1: text.erase(random() % text.size(), 1 + random() % 9); break;
            default: text.insert(random() % text.size(), 1 + random() % 4, "{}[]\",:\\\n"[random() % 9]);
            }
        const auto list = read(text);
        ++(list ? read_ : refused);
        if (!list) {
            EXPECT_EQ(list.error().message.find('\n'), std::string::npos);
        }
    }
    EXPECT_GT(read_, 25);
    EXPECT_GT(refused, 250);
}

TEST(BatchPlan, aJobRunsAfterThoseWhoseFilesItReads)
{
    const auto plan = planJobs(listOf({{"c", "./maps/../maps/a.png", ">", "b.png"},
                                       {"c", "raw", ">", "maps/a.png"},
                                       {"c", "folder/deep/x", ">", "d"},
                                       {"c", "raw", ">", "folder/"},
                                       {"c", "/jobs/b.png", "maps/a.png", ">", "e"},
                                       {"c", "raw"}}));
    ASSERT_TRUE(plan) << plan.error().message;
    using Jobs = std::vector<std::size_t>;
    EXPECT_EQ(plan->needs[0], Jobs{1});
    EXPECT_EQ(plan->needs[1], Jobs{});
    EXPECT_EQ(plan->needs[2], Jobs{3});
    EXPECT_EQ(plan->needs[4], (Jobs{0, 1}));
    EXPECT_EQ(plan->group, (Jobs{0, 0, 1, 1, 0, 2}));
}

TEST(BatchPlan, cyclesAndDuplicateOutputsAreRefusedWithTheirLines)
{
    const std::pair<std::vector<std::vector<std::string>>, std::string> cases[] = {
        {{{"c", "z", ">", "a"}, {"c", "z", ">", "./a"}}, "line 2: writes ./a, which line 1 also writes"},
        {{{"c", "a", ">", "a"}}, "line 1: writes a, which it also reads"},
        {{{"c", "a", ">", "b"}, {"c", "b", ">", "a"}}, "line 1 waits for line 2 waits for line 1"},
        {{{"c", ">", "x"}, {"c", "x", "d", ">", "b"}, {"c", "b", ">", "c"}, {"c", "c", ">", "d"}},
         "line 2 waits for line 4 waits for line 3 waits for line 2"},
        {{{"c", "b", ">", "x"}, {"c", "a", ">", "b"}, {"c", "b", ">", "a"}}, "line 2 waits for line 3 waits for line 2"},
    };
    for (const auto& [jobs, message] : cases) {
        const auto plan = planJobs(listOf(jobs));
        ASSERT_FALSE(plan) << message;
        EXPECT_TRUE(plan.error().message.starts_with(message)) << plan.error().message;
    }
}

TEST(BatchPlan, aChainOf100000JobsIsPlannedWithoutRecursion)
{
    JobList list{"/jobs", {}};
    for (int i = 0; i < 100000; ++i) {
        Job job;
        job.inputs = {std::to_string(i)};
        job.outputs = {std::to_string(i + 1)};
        list.jobs.push_back(job);
    }
    std::reverse(list.jobs.begin(), list.jobs.end());
    const auto plan = planJobs(list);
    ASSERT_TRUE(plan);
    EXPECT_EQ(plan->needs.front(), std::vector<std::size_t>{1});
    EXPECT_EQ(plan->group.front(), plan->group.back());
}

TEST(BatchPlan, everyJobIsInOneShardTogetherWithDependentJobs)
{
    std::mt19937 random(3);
    std::vector<std::vector<std::string>> jobs;
    for (int i = 0; i < 200; ++i)
        jobs.push_back(
            i > 0 && random() % 3 == 0
                ? std::vector<std::string>{"c", fmt::format("f{}", random() % unsigned(i)), ">", fmt::format("f{}", i)}
                : std::vector<std::string>{"c", ">", fmt::format("f{}", i)});
    const auto plan = planJobs(listOf(jobs));
    ASSERT_TRUE(plan);
    for (std::size_t of : {1u, 2u, 3u, 7u, 300u}) {
        std::vector<std::size_t> shardOf(jobs.size(), 0);
        for (std::size_t number = 1; number <= of; ++number)
            for (const std::size_t job : jobsOf(*plan, {number, of})) {
                EXPECT_EQ(shardOf[job], 0u) << "twice";
                shardOf[job] = number;
            }
        for (std::size_t job = 0; job < jobs.size(); ++job) {
            EXPECT_NE(shardOf[job], 0u) << "lost";
            for (const std::size_t need : plan->needs[job])
                EXPECT_EQ(shardOf[job], shardOf[need]);
        }
    }
}

TEST(BatchPlan, aShardIsANumberAndACount)
{
    const auto shard = parseShard("3/8");
    ASSERT_TRUE(shard);
    EXPECT_EQ(shard->number, 3u);
    EXPECT_EQ(shard->of, 8u);
    for (const char* wrong : {"", "3", "/", "0/8", "9/8", "3/", "/8", "3/8x", "x3/8", "-1/8", "3/8/9", "1.5/2",
                              "99999999999999999999999/1"})
        EXPECT_FALSE(parseShard(wrong)) << wrong;
}

} // namespace
} // namespace cotan
