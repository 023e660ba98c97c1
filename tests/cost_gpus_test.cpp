// Statistics of GPUs: the meaning of drivers' names, the file that stores them, and drivers that crash.
#include <gtest/gtest.h>

#include <algorithm>

#include "cost/cards.hpp"
#include "in_child.hpp"
#include "run_tool.hpp"
#include "statistics.hpp"

namespace cotan::cost {
namespace {

StageCode named(std::vector<std::pair<std::string, double>> numbers)
{
    StageCode code;
    code.all = std::move(numbers);
    nameStatistics(code);
    return code;
}

TEST(CostStatistics, everyDriversInstructionsAreFound)
{
    for (const char* const name : {"Instructions", "Instruction Count", "Instruction count"})
        EXPECT_EQ(named({{"Code size", 656}, {name, 41}}).instructions, 41) << name;
    EXPECT_FALSE(named({{"No such number", 41}}).instructions);
}

TEST(CostStatistics, turnipNopsAreNotArithmetic)
{
    const StageCode code = named({{"Instruction Count", 44},
                                  {"NOPs Count", 5},
                                  {"cat2 instructions", 20},
                                  {"cat3 instructions", 17},
                                  {"cat4 instructions", 1}});
    EXPECT_EQ(code.instructions, 44);
    EXPECT_EQ(code.arithmetic, 38);
    EXPECT_FALSE(named({{"cat2 instructions", 20}, {"cat3 instructions", 17}}).arithmetic); // no total from one half
}

TEST(CostStatistics, inverseThroughputOnMaliAndAppleIsThatOfTheSlowestUnit)
{
    EXPECT_EQ(named({{"Cycles", 1.125}, {"FMA", 0.47}, {"Varying", 1.125}}).inverseThroughput, 1.125);
    EXPECT_EQ(named({{"ALU", 29}, {"FSCIB", 31}, {"IC", 8}}).inverseThroughput, 31);
    EXPECT_EQ(named({{"Inverse Throughput", 100}}).inverseThroughput, 100);
}

TEST(CostStatistics, cyclesOfNvkAreLatencyAndNotThroughput)
{
    const StageCode code = named({{"Instruction count", 62}, {"Static cycle count", 220}, {"Number of GPRs", 24}});
    EXPECT_EQ(code.latency, 220);
    EXPECT_EQ(code.registers, 24);
    EXPECT_FALSE(code.inverseThroughput);
}

DeviceCode sample()
{
    DeviceCode gpu;
    gpu.name = "Card, the \"first\"";
    gpu.maker = "AMD";
    gpu.driver = "radv, Mesa 26.2";
    gpu.family = "NAVI21";
    gpu.date = "2026-11-24";
    StageCode code;
    code.instructions = 49;
    code.inverseThroughput = 1.125;
    gpu.rows.push_back({"floor", code});
    code = {};
    code.failure = "the driver crashed (signal 11)";
    gpu.rows.push_back({"mikktspace", code});
    return gpu;
}

TEST(CostGpus, csvRoundTrips)
{
    DeviceCode silent;
    silent.name = "Other";
    silent.silence = "has no graphics queue";
    const std::string text = gpusToCsv({sample(), silent});
    const auto gpus = gpusFromCsv(text + gpusToCsv({sample()})); // two files concatenated
    ASSERT_TRUE(gpus) << gpus.error().message;
    ASSERT_EQ(gpus->size(), 3u);
    const DeviceCode& gpu = gpus->front();
    EXPECT_EQ(gpu.name, "Card, the \"first\"");
    EXPECT_EQ(gpu.driver, "radv, Mesa 26.2");
    EXPECT_EQ(fragmentCode(gpu, "floor").instructions, 49);
    EXPECT_EQ(fragmentCode(gpu, "floor").inverseThroughput, 1.125);
    EXPECT_FALSE(fragmentCode(gpu, "floor").registers);
    EXPECT_EQ(fragmentCode(gpu, "mikktspace").failure, "the driver crashed (signal 11)");
    EXPECT_FALSE(fragmentCode(gpu, "smooth").instructions); // missing in the file
    EXPECT_EQ((*gpus)[1].silence, "has no graphics queue");
    EXPECT_EQ((*gpus)[2].date, "2026-11-24");
}

TEST(CostGpus, onlyCellsThatNeedItAreQuoted)
{
    const std::string text = gpusToCsv({sample()});
    EXPECT_NE(text.find("AMD,NAVI21,\"Card, the \"\"first\"\"\",\"radv, Mesa 26.2\",2026-11-24,"), std::string::npos)
        << text;
    std::size_t quotes = 0;
    for (const char c : text)
        quotes += c == '"';
    EXPECT_EQ(quotes, 2 * (2 + 4 + 2)); // on each line: around name and driver, and doubled around "first"
}

TEST(CostGpus, invalidLinesAreReported)
{
    const std::string good = gpusToCsv({sample()});
    const auto error = [](const std::string& text) {
        const auto gpus = gpusFromCsv(text);
        return gpus ? std::string("none") : gpus.error().message;
    };
    EXPECT_EQ(error("nonsense\n").rfind("line 1: expected 'maker,card,", 0), 0u);
    EXPECT_EQ(error(good + "AMD,NAVI21\n"), "line 4: expected 14 cells, found 2");
    for (const char* const number : {"x", "-1", "1e30", "nan", "12 "})
        EXPECT_EQ(error(good + "AMD,B,B,radv,,fragment,floor," + number + ",,,,,,\n"),
                  std::string("line 4: expected a number, found '") + number + "'");
}

TEST(CostGpus, theCommandMakesTablesFromAFile)
{
    const test::TemporaryFolder folder;
    std::ofstream(folder / "cards.csv") << gpusToCsv({sample()});
    const test::ToolRun run =
        test::runTool({"cost", "--cards", "cards.csv", "-o", "cost.md", "--write-cards", "again.csv"}, folder.path());
    EXPECT_EQ(run.code, 0) << run.err;
    const std::string text = test::readWhole(folder / "cost.md");
    EXPECT_NE(text.find(" AMD | 2006 |"), std::string::npos); // the maker above the GPU
    EXPECT_NE(text.find("fragment mikktspace: not compiled: the driver crashed (signal 11)."), std::string::npos);
    const auto again = gpusFromCsv(test::readWhole(folder / "again.csv"));
    ASSERT_TRUE(again);
    EXPECT_EQ(fragmentCode(again->front(), "floor").instructions, 49);
}

TEST(CostGpus, theCommandReportsTheInvalidLineOfAFile)
{
    const test::TemporaryFolder folder;
    std::ofstream(folder / "cards.csv") << gpusToCsv({sample()}) << "AMD,NAVI21\n";
    const test::ToolRun run = test::runTool({"cost", "--cards", "cards.csv", "-o", "cost.md"}, folder.path());
    EXPECT_EQ(run.code, 2);
    EXPECT_NE(run.err.find("line 4: expected 14 cells, found 2"), std::string::npos) << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "cost.md"));
}

// Runs a command of the shell whose standard input leads to the parent.
std::string shell(const std::string& command, const std::function<void(std::string_view)>& line, int seconds = 60)
{
    return inChild(seconds, {"/bin/sh", {"-c", command}, {{"WORD", "well"}}}, line);
}

TEST(CostChild, outputBeforeACrashIsReceived)
{
    std::vector<std::string> lines;
    const auto keep = [&](std::string_view line) { lines.emplace_back(line); };
    EXPECT_EQ(shell("printf 'first\\nsecond\\nhalf' >&0; echo noise >&2; kill -SEGV $$", keep),
              "crashed (signal 11, Segmentation fault)");
    EXPECT_EQ(lines, (std::vector<std::string>{"first", "second"}));
    EXPECT_EQ(shell("echo $WORD >&0", keep), "");
    EXPECT_EQ(lines.back(), "well");
    EXPECT_EQ(shell("exit 7", keep), "ended with 7");
    EXPECT_EQ(inChild(60, {"/no/such/program", {}}, keep), "could not be started: No such file or directory");
}

TEST(CostChild, aHangingOneIsEnded)
{
    EXPECT_EQ(shell(
                  "exec sleep 3600", [](std::string_view) {}, 1),
              "took more than 1 s");
}

TEST(CostChild, isStartedByAParentOnly)
{
    const std::string child = std::string("'") + COTAN_LAB + "' " + std::string(kChildWord) + " 1 </dev/null";
    std::string line;
    EXPECT_EQ(shell("exec 3>&0; " + child + " 2>&1 | cat >&3", [&](std::string_view printed) { line = printed; }), "");
    EXPECT_EQ(line, std::string(kChildWord) + " is internal: another process starts it");
    EXPECT_EQ(shell(child, [](std::string_view) {}), "ended with 1");
    EXPECT_FALSE(runChild(std::vector<std::string>{"cost"}));
    EXPECT_FALSE(runChild({}));
}

} // namespace
} // namespace cotan::cost
