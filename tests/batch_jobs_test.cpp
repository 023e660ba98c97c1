// Job files, the options of a job, and the dependencies between jobs.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include <fmt/format.h>

#include "batch_fixture.hpp"

namespace cotan {
namespace {

using namespace app;
using namespace test;
using Numbers = std::vector<std::size_t>;

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
    write(folder / "jobs.jsonl", text);
    return readJobs(folder / "jobs.jsonl", splitWords);
}

JobList listOf(const std::vector<Words>& jobs)
{
    JobList list{"/jobs", {}};
    for (const Words& words : jobs)
        EXPECT_TRUE(splitWords(addJob(list, words)));
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
    EXPECT_EQ(list->jobs[0].inputs, Words{"a b"});
    EXPECT_EQ(list->jobs[0].outputs, Words{"c"});
    EXPECT_EQ(list->jobs[1].name, "ü <b>");
    EXPECT_EQ(list->jobs[1].line, 4u);
    EXPECT_EQ(list->jobs[1].inputs, Words{"x"});
    EXPECT_EQ(list->jobs[1].outputs, Words{"y"});
}

TEST(BatchJobOptions, areReadFromTheLineElseAreTheDefaults)
{
    const auto list = read("{\"command\": [\"lint\"], \"limit-memory\": 2000, \"limit-time\": 1.5, "
                           "\"limit-processor-time\": 0, \"retries\": 3, \"priority\": -2, "
                           "\"env\": {\"A\": \"b=c\", \"B\": \"\"}}\n{\"command\": [\"lint\"], \"name\": \"other\"}\n");
    ASSERT_TRUE(list) << list.error().message;
    const JobOptions& options = list->jobs[0].options;
    EXPECT_EQ(options.megabytes, 2000u);
    EXPECT_EQ(options.seconds, 1.5);
    EXPECT_EQ(options.processorSeconds, 0);
    EXPECT_EQ(options.retries, 3);
    EXPECT_EQ(options.priority, -2);
    EXPECT_EQ(list->jobs[0].key(), (Words{"A=b=c", "B=", "lint"}));
    const JobOptions& none = list->jobs[1].options;
    EXPECT_FALSE(none.megabytes || none.seconds || none.processorSeconds || none.retries);
    EXPECT_EQ(list->jobs[1].key(), Words{"lint"});
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
    const auto with = [](const std::string& member) { return "{\"command\": [\"copy\"], " + member + "}"; };
    const std::pair<std::string, std::string> cases[] = {
        {"{\"command\": [\"copy\"]", "text that is not JSON"},
        {"[\"copy\"]", "expected a JSON object"},
        {"{}", "\"command\": expected a list of strings"},
        {"{\"command\": []}", "found none"},
        {"{\"command\": \"lint a.glb\"}", "found \"lint a.glb\""},
        {"{\"command\": [\"copy\", 4]}", "quote numbers, too); found 4"},
        {"{\"command\": [\"a\\u0000b\"]}", "without the character 0"},
        {with("\"input\": [\"a\"]"), "found \"input\""},
        {with("\"inputs\": \"a\""), "\"inputs\": expected a list"},
        {with("\"name\": 3"), "\"name\": expected a string"},
        {with("\"name\": \"\""), "\"name\": expected a string"},
        {with("\"name\": \"" + std::string(1001, 'n') + "\""), "a string of 1 to 1000 bytes"},
        {"{\"command\": [\"bad\"]}", "there is no command 'bad'"},
        {std::string(100000, '['), "text that is not JSON"},
        {"{\"command\": [" + deep('[', ']') + "]}", "\"command\": expected strings only"}, // once overflowed the stack
        {"{\"command\": " + deep('{', '}') + "}", "found an object"},
        {with("\"name\": " + deep('[', ']')), "\"name\": expected a string"},
        {std::string("\0\0\0", 3), "text that is not JSON"},
        {"{\"name\": \"ok\", \"command\": [\"copy\", \"other\"]}", "is also the name of line 1"},
        {with("\"limit-memory\": -1"), "\"limit-memory\": expected a whole number from 0 to 16777216; found -1"},
        {with("\"limit-memory\": 1.5"), "found 1.5"},
        {with("\"limit-memory\": \"2 GB\""), "found \"2 GB\""},
        {with("\"limit-time\": 0"), "\"limit-time\": expected a number from 0.001 to 1000000; found 0"},
        {with("\"limit-time\": 1e999"), "text that is not JSON"},
        {with("\"limit-processor-time\": null"), "found null"},
        {with("\"retries\": 101"), "from 0 to 100; found 101"},
        {with("\"priority\": true"), "\"priority\": expected a whole number"},
        {with("\"priority\": 99999999999999999999"), "\"priority\": expected a whole number"},
        {with("\"env\": [\"A=b\"]"), "\"env\": expected an object of strings such as"},
        {with("\"env\": {\"A\": 1}"), "quote numbers, too); found 1"},
        {with("\"env\": {\"A=B\": \"1\"}"), "expected names of variables; found \"A=B\""},
        {with("\"env\": {\"\": \"1\"}"), "expected names of variables"},
        {with("\"memory\": 1"),
         "expected name, command, inputs, outputs, limit-memory, limit-time, "
         "limit-processor-time, priority, retries, env; found \"memory\""},
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
    EXPECT_TRUE(read("\xef\xbb\xbf\n" + with("\"name\": \"" + std::string(1000, 'n') + "\"") + "\n"));
    for (const auto& [member, least, most, under, over] :
         {std::tuple("limit-memory", "0", "16777216", "-1", "16777217"),
          {"limit-time", "0.001", "1000000", "0.0009", "1000000.1"},
          {"limit-processor-time", "0", "1000000", "-0.001", "1000000.1"},
          {"retries", "0", "100", "-1", "101"},
          {"priority", "-1000000", "1000000", "-1000001", "1000001"}}) {
        const auto takes = [member = member, &with](const char* value) {
            return bool(read(with(fmt::format("\"{}\": {}", member, value))));
        };
        EXPECT_TRUE(takes(least) && takes(most)) << member;
        EXPECT_FALSE(takes(under) || takes(over)) << member;
    }
}

TEST(BatchJobs, damagedJobFilesDoNotCrash)
{
    const std::string good = "{\"name\": \"a\", \"command\": [\"copy\", \"a\", \">\", \"b\"], \"inputs\": [\"x\"]}\n"
                             "{\"command\": [\"copy\", \"\\u00fc\", \">\", \"c\"]}\n";
    std::mt19937 random(7);
    int accepted = 0, refused = 0;
    for (int i = 0; i < 1500; ++i) {
        std::string text = good;
        for (unsigned k = 0; k <= random() % 3; ++k)
            switch (random() % 3) {
            case 0: text[random() % text.size()] = char(random()); break;
            case 1: text.erase(random() % text.size(), 1 + random() % 9); break;
            default: text.insert(random() % text.size(), 1 + random() % 4, "{}[]\",:\\\n"[random() % 9]);
            }
        const auto list = read(text);
        ++(list ? accepted : refused);
        EXPECT_TRUE(list || list.error().message.find('\n') == std::string::npos);
    }
    EXPECT_GT(accepted, 25);
    EXPECT_GT(refused, 250);
}

// A job reads what is before '>' and writes what is behind it. A job may read its own output folder; files in it may be
// older. The group of connected jobs has the number of the first of them.
TEST(BatchPlan, aJobRunsAfterThoseWhoseFilesItReads)
{
    struct Row {
        std::vector<Words> jobs;
        std::vector<Numbers> needs;
        Numbers group;
    };
    const Row rows[] = {
        {{{"c", "./maps/../maps/a.png", ">", "b.png"},
          {"c", "raw", ">", "maps/a.png"},
          {"c", "folder/deep/x", ">", "d"},
          {"c", "raw", ">", "folder/"},
          {"c", "/jobs/b.png", "maps/a.png", ">", "e"},
          {"c", "raw"}},
         {{1}, {}, {3}, {}, {0, 1}, {}},
         {0, 0, 1, 1, 0, 2}},
        {{{"c", ">", "folder", "b", "b"},
          {"c", "folder/x", "b", "folder/y", ">", "c"},
          {"c", "out/deep/x", ">", "out"},
          {"c", "folders", ">", "d"}},
         {{}, {0}, {}, {}},
         {0, 0, 1, 2}},
        {{{"c", ">", "a"}, {"c", ">", "b"}, {"c", ">", "c"}, {"c", "c", "a", ">", "d"}, {"c", ">", "e"}},
         {{}, {}, {}, {2, 0}, {}},
         {0, 1, 0, 0, 2}},
        // * stands for what only the job finds out
        {{{"c", "t.1002.png", "o/x-lid-1.exr", "t.a/b.png", ">", "a"},
          {"c", ">", "t.*.png", "t.exr"},
          {"c", ">", "o/x-*-*.exr"},
          {"c", "t.png", "o/x-lid.exr", "o/x", ">", "b"},
          {"c", ">", "t.a/b.png"}},
         {{1, 2, 4}, {}, {}, {}, {}},
         {0, 0, 0, 1, 0}},
    };
    for (const Row& row : rows) {
        const auto plan = planJobs(listOf(row.jobs));
        ASSERT_TRUE(plan) << plan.error().message;
        EXPECT_EQ(plan->needs, row.needs);
        EXPECT_EQ(plan->group, row.group);
    }
    const auto joined = planJobs(listOf(rows[2].jobs));
    EXPECT_EQ(jobsOf(*joined, {1, 2}), (Numbers{0, 2, 3, 4}));
    EXPECT_EQ(jobsOf(*joined, {2, 2}), Numbers{1});
    EXPECT_EQ(jobsOf(*joined, {3, 3}), Numbers{4});
    EXPECT_EQ(jobsOf(*joined, {4, 4}), Numbers{});
    EXPECT_EQ(jobsOf(*joined, {}), (Numbers{0, 1, 2, 3, 4}));
}

TEST(BatchPlan, cyclesAndDuplicateOutputsAreRefusedWithTheirLines)
{
    const std::pair<std::vector<Words>, std::string> cases[] = {
        {{{"c", "z", ">", "a"}, {"c", "z", ">", "./a"}}, "line 2: writes ./a, which line 1 also writes"},
        {{{"c", ">", "t.*.png"}, {"c", ">", "x"}, {"c", ">", "t.1002.png"}},
         "line 3: writes t.1002.png, which line 1 also writes"},
        {{{"c", ">", "t.1002.png"}, {"c", ">", "t.*.png"}}, "line 2: writes t.1002.png, which line 1 also writes"},
        {{{"c", "a", ">", "a"}},
         "line 1: writes a, which it also reads: a second run would start from the first one's result; expected "
         "another "
         "name"},
        {{{"c", ">", "x"}, {"c", "b", ">", "./b"}}, "line 2: writes b, which it also reads"},
        {{{"c", "a", ">", "b"}, {"c", "b", ">", "a"}},
         "line 1 waits for line 2 waits for line 1: each reads what the next one writes"},
        {{{"c", ">", "x"}, {"c", "x", "d", ">", "b"}, {"c", "b", ">", "c"}, {"c", "c", ">", "d"}},
         "line 2 waits for line 4 waits for line 3 waits for line 2"},
        {{{"c", "b", ">", "x"}, {"c", "a", ">", "b"}, {"c", "b", ">", "a"}},
         "line 2 waits for line 3 waits for line 2"},
    };
    for (const auto& [jobs, message] : cases) {
        const auto plan = planJobs(listOf(jobs));
        ASSERT_FALSE(plan) << message;
        EXPECT_EQ(plan.error().kind, ErrorKind::input);
        EXPECT_TRUE(plan.error().message.starts_with(message)) << plan.error().message;
    }
}

TEST(BatchPlan, aChainOf100000JobsIsPlannedWithoutRecursion)
{
    JobList list{"/jobs", {}};
    for (int i = 100000; i > 0; --i) {
        Job& job = list.jobs.emplace_back();
        job.inputs = {std::to_string(i - 1)};
        job.outputs = {std::to_string(i)};
    }
    const auto plan = planJobs(list);
    ASSERT_TRUE(plan);
    EXPECT_EQ(plan->needs.front(), Numbers{1});
    EXPECT_EQ(plan->order.front(), 99999u);
    EXPECT_EQ(plan->order.back(), 0u);
    EXPECT_EQ(plan->group.front(), plan->group.back());
}

TEST(BatchPlan, everyJobIsInOneShardTogetherWithDependentJobs)
{
    std::mt19937 random(3);
    std::vector<Words> jobs;
    for (int i = 0; i < 200; ++i)
        jobs.push_back(i > 0 && random() % 3 == 0
                           ? Words{"c", fmt::format("f{}", random() % unsigned(i)), ">", fmt::format("f{}", i)}
                           : Words{"c", ">", fmt::format("f{}", i)});
    const auto plan = planJobs(listOf(jobs));
    ASSERT_TRUE(plan);
    for (std::size_t of : {1u, 2u, 3u, 7u, 300u}) {
        Numbers shardOf(jobs.size(), 0);
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
    for (const char* whole : {"1/1", "8/8", "1/8"})
        EXPECT_TRUE(parseShard(whole)) << whole;
    for (const char* wrong : {"", "3", "/", "0/8", "9/8", "3/", "/8", "3/8x", "x3/8", "-1/8", "3/8/9", "1.5/2",
                              "99999999999999999999999/1"}) {
        const auto none = parseShard(wrong);
        ASSERT_FALSE(none) << wrong;
        EXPECT_EQ(none.error().kind, ErrorKind::usage);
        EXPECT_EQ(none.error().message,
                  fmt::format("--shard: expected K/N with K from 1 to N, such as 3/8; found '{}'", wrong));
    }
}

} // namespace
} // namespace cotan
