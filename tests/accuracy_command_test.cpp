// `cotan accuracy` as a user runs it.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "report/measurements.hpp"
#include "run_tool.hpp"

namespace cotan::test {
namespace {

TEST(AccuracyCommand, printsTheRequestedTables)
{
    TemporaryFolder folder;
    const ToolRun r =
        runTool({"accuracy", "--tables", "foreshortening", "--frames", "cotangent,nonperspective"}, folder.path());
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_NE(r.out.find("## foreshortening"), std::string::npos);
    EXPECT_NE(r.out.find("| nonperspective |"), std::string::npos);
    EXPECT_EQ(r.out.find("| unit |"), std::string::npos);
    EXPECT_EQ(r.err, "");
}

TEST(AccuracyCommand, figuresDoNotDependOnThreads)
{
    TemporaryFolder folder;
    for (const char* threads : {"1", "3"}) {
        const ToolRun r = runTool({"accuracy", "--tables", "views,signs,half", "--threads", threads, "--csv",
                                   std::string(threads) + ".csv", "--quiet"},
                                  folder.path());
        ASSERT_EQ(r.code, 0) << r.err;
    }
    EXPECT_GT(readWhole(folder / "1.csv").size(), 1000u);
    EXPECT_EQ(readWhole(folder / "1.csv"), readWhole(folder / "3.csv"));
}

TEST(AccuracyCommand, aWorseFigureExitsFive)
{
    TemporaryFolder folder;
    const std::vector<std::string> words{"accuracy", "--tables", "procedural", "--frames", "gradient"};
    auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), words.begin(), words.end());
        return runTool(more, folder.path());
    };
    ASSERT_EQ(with({"--csv", "figures.csv", "--quiet"}).code, 0);
    const ToolRun same = with({"--against", "figures.csv"});
    EXPECT_EQ(same.code, 0) << same.err;
    EXPECT_NE(same.out.find("none is worse"), std::string::npos);
    // Lower one recorded error to 0.01 degrees, so that the present result counts as worse.
    std::string text = readWhole(folder / "figures.csv");
    const std::size_t row = text.find("fine derivatives,4 pixels a wave,gradient,E,double,6000,");
    ASSERT_NE(row, std::string::npos);
    const std::size_t number = text.find("6000,", row) + 5;
    text.replace(number, text.find(',', number) - number, "0.01");
    std::ofstream(folder / "figures.csv") << text;
    const ToolRun worse = with({"--against", "figures.csv"});
    EXPECT_EQ(worse.code, 5);
    EXPECT_NE(worse.err.find("worse: procedural, fine derivatives, 4 pixels a wave, gradient"), std::string::npos)
        << worse.err;
}

TEST(AccuracyCommand, wrongArgumentsGetOneLineAndTheirExitCode)
{
    TemporaryFolder folder;
    std::ofstream(folder / "not.csv") << "hello\n";
    const std::pair<std::vector<std::string>, int> runs[] = {
        {{"accuracy", "--tables", "flatt"}, 1},
        {{"accuracy", "--frames", "cotan"}, 1},
        {{"accuracy", "--frames", "smooth,"}, 1},
        {{"accuracy", "--tables", "views", "--scene", "nowhere"}, 1},
        {{"accuracy", "--tables", "views", "--against", "missing.csv"}, 2},
        {{"accuracy", "--tables", "views", "--against", "not.csv"}, 2},
        {{"accuracy", "--tables", "views", "--csv", "no/such/folder/a.csv", "--quiet"}, 4},
    };
    for (const auto& [words, code] : runs) {
        const ToolRun r = runTool(words, folder.path());
        EXPECT_EQ(r.code, code) << words.back();
        EXPECT_EQ(std::count(r.err.begin(), r.err.end(), '\n'), 1) << r.err;
    }
}

// Bars B1 to B4 for rendered images: the GPU draws and the normals are read back. Without a Vulkan device the reference
// renderer draws and must satisfy the same bars.
TEST(AccuracyCommand, barsOfCurvedSurfacesHoldOnTheDevice)
{
    TemporaryFolder folder;
    const ToolRun r = runTool({"accuracy", "--tables", "rendered", "--scene", "sphere", "--frames",
                               "cotangent,exact,smooth,gradient,mikktspace", "--csv", "r.csv", "--quiet"},
                              folder.path(), 240);
    ASSERT_EQ(r.code, 0) << r.err;
    const auto rows = measurementsFromCsv(readWhole(folder / "r.csv"), "r.csv");
    ASSERT_TRUE(rows) << rows.error().message;
    auto mean = [&](const char* segments, const char* frame) {
        for (const Measurement& m : *rows)
            if (m.setting == segments && m.frame == frame)
                return m.mean;
        ADD_FAILURE() << "no row " << segments << ", " << frame;
        return 0.0;
    };
    for (const char* frame : {"cotangent", "exact"}) {
        EXPECT_LT(mean("16", frame), 2.4);
        EXPECT_LT(mean("32", frame), 1.15);
        EXPECT_LT(mean("64", frame), 0.57);
        EXPECT_GT(mean("32", frame) / mean("64", frame), 1.9);
    }
    EXPECT_LT(mean("32", "smooth"), 0.30);
    EXPECT_LT(mean("64", "smooth"), 0.09);
    EXPECT_LT(mean("64", "gradient"), 0.90);
    EXPECT_GT(mean("64", "mikktspace"), 2); // the control; pixels weigh the poles less than area does
    for (const Measurement& m : *rows) {
        EXPECT_EQ(m.invalid, 0) << m.frame;
        EXPECT_GT(m.samples, 50000u); // three images of 384 x 384
    }
}

TEST(AccuracyCommand, flatPatchesOnTheDeviceAreExactUpToMapFiltering)
{
    TemporaryFolder folder;
    for (const char* layout : {"stretch 2:1", "shear 45", "mirrored"}) {
        const ToolRun r = runTool({"accuracy", "--tables", "rendered", "--scene", layout, "--frames",
                                   "cotangent,paper-full,exact,smooth,orthonormal", "--csv", "r.csv", "--quiet"},
                                  folder.path(), 240);
        ASSERT_EQ(r.code, 0) << r.err;
        const auto rows = measurementsFromCsv(readWhole(folder / "r.csv"), "r.csv");
        ASSERT_TRUE(rows) << rows.error().message;
        ASSERT_EQ(rows->size(), 5u);
        for (const Measurement& m : *rows)
            if (m.frame == "orthonormal" && m.scene != "mirrored") {
                EXPECT_GT(m.mean, 5) << m.scene;
            } else {
                EXPECT_LT(m.mean, 0.03) << m.scene << ", " << m.frame;
                EXPECT_LT(m.maximum, 0.1) << m.scene << ", " << m.frame;
            }
    }
}

} // namespace
} // namespace cotan::test
