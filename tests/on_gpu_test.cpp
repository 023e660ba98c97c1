// bench/on-gpu: the page that it writes, and that its packed program runs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <sstream>

#include "figures.hpp"
#include "run_tool.hpp"

namespace cotan::bench {
namespace {

Figures validFigures()
{
    Figures f;
    f.rows.name = "Device";
    f.rows.cases = {{1, 1, 1, 64}, {16, 1, 1, 64}};
    f.rows.rows = {{"floor", {100, 10}, {{90, 100, 110}, {10, 10, 10}}, {}},
                   {"mikktspace", {200, 20}, {{180, 200, 220}, {20, 20, 20}}, {}},
                   {"triangle-halfs", {150, 30}, {{270, 150, 110}, {30, 30, 30}}, {}}};
    f.triangles = 2;
    f.passes = {{"triangles.comp", "U and V", {5, 6, 7}}};
    return f;
}

TEST(OnGpu, middleIsTheMedianAndHalfTheInterquartileRange)
{
    const Middle m = middleOf({9, 1, 5, 3, 7});
    EXPECT_EQ(m.median, 5);
    EXPECT_EQ(m.spread, 2);
    EXPECT_EQ(middleOf({4}).median, 4);
    EXPECT_EQ(middleOf({4}).spread, 0);
}

TEST(OnGpu, ratiosAreFormedWithinARepetition)
{
    // The ratio of the medians is 0.75; the ratios of each repetition are 1.5, 0.75 and 0.5.
    const Middle m = ratioOf(validFigures(), validFigures().rows.rows[2], 0);
    EXPECT_EQ(m.median, 0.75);
    EXPECT_EQ(ratioOf(validFigures(), validFigures().rows.rows[0], 0).median, 0.5);
    EXPECT_EQ(m.spread, (1.5 - 0.75) / 2); // for three values the quartiles are the second and the third
}

TEST(OnGpu, zeroTimesAreNamedAndMakeNoPage)
{
    EXPECT_EQ(whyInvalid(validFigures()), "");
    Figures zero = validFigures();
    zero.rows.rows[2].repeats[1][0] = 0;
    EXPECT_NE(whyInvalid(zero).find("triangle-halfs, legs of 16 px"), std::string::npos) << whyInvalid(zero);
    Figures missing = validFigures();
    missing.rows.rows[0].repeats.pop_back();
    EXPECT_NE(whyInvalid(missing).find("floor"), std::string::npos);
    Figures pass = validFigures();
    pass.passes[0].nanoseconds[1] = std::nan("");
    EXPECT_NE(whyInvalid(pass).find("triangles.comp"), std::string::npos);
    Figures nothing = validFigures();
    nothing.rows.cases.clear();
    EXPECT_NE(whyInvalid(nothing), "");
    Figures without = validFigures();
    without.rows.rows.erase(without.rows.rows.begin() + 1);
    EXPECT_NE(whyInvalid(without), "");
}

TEST(OnGpu, failedAndUnfinishedTestsAreReported)
{
    std::istringstream log("[ RUN      ] A.one\n"
                           "| cotangent                | glsl       | 1.2e-04 |\n"
                           "| smooth, total            | glsl       | 3.0e-04 |\n"
                           "[       OK ] A.one (12 ms)\n"
                           "[ RUN      ] A.two\n[  SKIPPED ] A.two (0 ms)\n"
                           "[ RUN      ] A/b.three/x\n[  FAILED  ] A/b.three/x, where GetParam() = 1 (5 ms)\n"
                           "[ RUN      ] A.four\nSegmentation fault\n");
    const std::vector<TestOutcome> all = readTestLog(log);
    ASSERT_EQ(all.size(), 4u);
    EXPECT_EQ(all[0].result, "passed");
    EXPECT_EQ(all[0].cases, 2u);
    EXPECT_EQ(all[0].worst, 3e-4);
    EXPECT_EQ(all[0].worstCase, "smooth, total");
    EXPECT_EQ(all[1].result, "skipped");
    EXPECT_EQ(all[2].result, "failed");
    EXPECT_EQ(all[2].name, "A/b.three/x");
    EXPECT_EQ(all[3].result, "failed");
}

struct ShellRun {
    int code = -1;
    std::string out, err;
};
ShellRun runShell(const std::string& line)
{
    test::TemporaryFolder folder;
    const std::string f = folder.path().string();
    const int status = std::system(("(" + line + ") >'" + f + "/out' 2>'" + f + "/err'").c_str());
    return {WEXITSTATUS(status), test::readWhole(f + "/out"), test::readWhole(f + "/err")};
}

TEST(OnGpuProgram, reportsTimeAndRatioForEveryRow)
{
    test::TemporaryFolder folder;
    const std::string file = (folder / "gpu.md").string();
    const ShellRun run = runShell(COTAN_ON_GPU " --quick --tables -o '" + file + "'");
    if (run.code == 3 && run.err.find("found no usable ICD") != std::string::npos)
        GTEST_SKIP() << run.err;
    ASSERT_EQ(run.code, 0) << run.err;
    const std::string page = test::readWhole(file);
    const std::regex cell(R"(\| (\d+); (\d+\.\d\d) ± \d+\.\d\d )");
    std::size_t tables = 0, rows = 0;
    std::istringstream lines(page);
    for (std::string line; std::getline(lines, line);) {
        tables += line == "| legs of the triangles | 1 px | 16 px |";
        const auto name = line.find("| `") == 0 ? line.substr(3, line.find('`', 3) - 3) : "";
        if (!cost::rowFromName(name))
            continue;
        ++rows;
        std::size_t cells = 0;
        for (std::sregex_iterator c(line.begin(), line.end(), cell), end; c != end; ++c, ++cells) {
            EXPECT_GT(std::stod((*c)[1]), 0) << line;
            EXPECT_GT(std::stod((*c)[2]), 0) << line;
            EXPECT_TRUE(name != "mikktspace" || (*c)[2] == "1.00") << line;
        }
        EXPECT_EQ(cells, 2u) << line;
    }
    EXPECT_EQ(tables, 4u);
    EXPECT_EQ(rows, 4 * cost::rows().size());
    for (const char* pass : {"triangles.comp", "smooth.comp", "tangents.comp", "normals.comp"})
        EXPECT_TRUE(std::regex_search(page, std::regex("`" + std::string(pass) + R"(` \| .* \| [1-9]\d* ± \d+ \|)")))
            << pass;
}

TEST(OnGpuProgram, refusesBadOptionsInOneLine)
{
    EXPECT_EQ(runShell(COTAN_ON_GPU " --rumour").code, 1);
    const ShellRun none = runShell("VK_DRIVER_FILES=/no/such.json VK_ICD_FILENAMES=/no/such.json " COTAN_ON_GPU);
    EXPECT_EQ(none.code, 3);
    EXPECT_EQ(std::count(none.err.begin(), none.err.end(), '\n'), 1) << none.err;
    const ShellRun late = runShell(COTAN_ON_GPU " --quick --seconds -1");
    EXPECT_EQ(late.code, 3) << late.err;
}

// Runs the measuring program alone; the packed tests are run by this suite anyway.
TEST(OnGpuPack, packedProgramRunsAlone)
{
    test::TemporaryFolder folder;
    std::filesystem::create_directories(folder / "build/tests");
    std::filesystem::create_symlink(COTAN_ON_GPU, folder / "build/tests/on_gpu");
    const std::string pack = (folder / "pack").string();
    const ShellRun packed = runShell("ON_GPU_BUILD='" + (folder / "build").string()
                                     + "' '" COTAN_SOURCE_DIR "/bench/on-gpu' pack '" + pack + "'");
    ASSERT_EQ(packed.code, 0) << packed.err;
    EXPECT_NE(packed.err.find("has no shader_test"), std::string::npos) << packed.err;
    const ShellRun none = runShell("VK_DRIVER_FILES=/no/such.json VK_ICD_FILENAMES=/no/such.json '" + pack + "/run'");
    EXPECT_EQ(none.code, 3);
    EXPECT_EQ(std::count(none.err.begin(), none.err.end(), '\n'), 1) << none.err;
    EXPECT_EQ(runShell("'" + pack + "/run' a b").code, 1);
    const ShellRun run = runShell("'" + pack + "/run' --quick '" + pack + "/page.md'");
    if (run.code == 3)
        GTEST_SKIP() << run.err;
    EXPECT_EQ(run.code, 0) << run.err;
    const std::string page = test::readWhole(pack + "/page.md");
    EXPECT_NE(page.find("No figures yet"), std::string::npos) << page;
    EXPECT_EQ(page.find("| `"), std::string::npos);
}

TEST(OnGpuPack, buildWithoutTheProgramIsNamed)
{
    test::TemporaryFolder folder;
    std::filesystem::create_directories(folder / "build/tests");
    const ShellRun packed =
        runShell("ON_GPU_BUILD='" + (folder / "build").string() + "' '" COTAN_SOURCE_DIR "/bench/on-gpu' pack '"
                 + (folder / "pack").string() + "'");
    EXPECT_EQ(packed.code, 3);
    EXPECT_EQ(packed.err, "on-gpu: " + (folder / "build").string() + " has no on_gpu\n");
}

} // namespace
} // namespace cotan::bench
