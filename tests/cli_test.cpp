// The command line as a user meets it: right words, wrong words, exit codes, files.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sys/stat.h>

#include "cotan/image/file.hpp"
#include "run_tool.hpp"

namespace cotan {
namespace {

using namespace test;
using Words = std::vector<std::string>;

const Words kSmall = {"--device", "reference", "--size", "96x64"};

Words with(Words words, const Words& more)
{
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

TEST(CommandLine, helpNamesEveryCommandAndExitsZero)
{
    TemporaryFolder folder;
    const ToolRun run = runTool({"--help"}, folder.path());
    EXPECT_EQ(run.code, 0);
    for (const char* word : {"render", "compare", "Exit codes"})
        EXPECT_NE(run.out.find(word), std::string::npos) << word;
    EXPECT_EQ(runTool({"render", "--help"}, folder.path()).code, 0);
    EXPECT_NE(runTool({"--version"}, folder.path()).out.find("cotan"), std::string::npos);
}

TEST(CommandLine, wrongWordsExitOneWithOneLineAndNoFile)
{
    const std::vector<Words> wrong = {
        {},
        {"rendr"},
        {"render"},
        {"render", "-o", "a.png", "--frame", "tangent"},
        {"render", "-o", "a.png", "--size", "640"},
        {"render", "-o", "a.png", "--size", "0x10"},
        {"render", "-o", "a.png", "--size", "99999x10"},
        {"render", "-o", "a.png", "--camera", "1,2,3"},
        {"render", "-o", "a.png", "--camera", "1,2,3,1,2,3"},
        {"render", "-o", "a.png", "--camera", "7"},
        {"render", "-o", "a.png", "--view", "colour"},
        {"render", "-o", "a.png", "--samples", "3"},
        {"render", "-o", "a.png", "--threads", "-1"},
        {"render", "-o", "a.png", "--exposure", "nan"},
        {"render", "-o", "a.xyz"},
        {"render", "-o", "a.png", "--no-such-option"},
        {"compare", "-o", "a", "--frames", "cotangent"},
        {"compare", "-o", "a", "--frames", "cotangent,none"},
        {"compare"},
    };
    for (const Words& words : wrong) {
        TemporaryFolder folder;
        const ToolRun run = runTool(words.empty() ? words : with(words, {"--device", "reference"}), folder.path());
        const std::string all = ::testing::PrintToString(words);
        EXPECT_EQ(run.code, 1) << all << run.err;
        EXPECT_EQ(lines(run.err), 1) << all << run.err;
        EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << all;
    }
}

// As /dev/null would be: a file that took its place would be a surprise to everybody else.
TEST(CommandLine, aReportGoesIntoAPipeAndDoesNotReplaceIt)
{
    TemporaryFolder folder;
    const std::filesystem::path pipe = folder / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    const int reader = ::open(pipe.c_str(), O_RDWR); // writers wait for nobody
    ASSERT_GE(reader, 0);
    const ToolRun run = runTool(with({"render", "-o", "a.png", "--json", "pipe", "--quiet"}, kSmall), folder.path());
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_TRUE(std::filesystem::is_fifo(pipe));
    char first = 0;
    EXPECT_EQ(::fcntl(reader, F_SETFL, O_NONBLOCK), 0);
    EXPECT_EQ(::read(reader, &first, 1), 1);
    EXPECT_EQ(first, '{');
    ::close(reader);
}

TEST(CommandLine, missingModelExitsTwoAndNamesIt)
{
    TemporaryFolder folder;
    const ToolRun run = runTool({"render", "gone.glb", "-o", "a.png"}, folder.path());
    EXPECT_EQ(run.code, 2);
    EXPECT_NE(run.err.find("gone.glb"), std::string::npos);
    EXPECT_EQ(lines(run.err), 1);
}

TEST(CommandLine, unknownDeviceExitsThreeAndNamesIt)
{
    TemporaryFolder folder;
    const ToolRun run = runTool({"render", "-o", "a.png", "--device", "no such gpu"}, folder.path());
    EXPECT_EQ(run.code, 3);
    EXPECT_EQ(lines(run.err), 1);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(CommandLine, unwritableOutputExitsFourAndLeavesNothing)
{
    TemporaryFolder folder;
    const ToolRun run = runTool(with({"render", "-o", "no/such/folder/a.png"}, kSmall), folder.path());
    EXPECT_EQ(run.code, 4) << run.err;
    EXPECT_EQ(lines(run.err), 1) << run.err;
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(CommandLine, builtInSceneIsDrawnWithAReport)
{
    TemporaryFolder folder;
    const ToolRun run = runTool(with({"render", "-o", "a.png", "--json", "-"}, kSmall), folder.path());
    ASSERT_EQ(run.code, 0) << run.err;
    const auto report = nlohmann::json::parse(run.out);
    EXPECT_EQ(report["frame"], "cotangent");
    EXPECT_EQ(report["device"], "reference");
    EXPECT_EQ(report["size"], (nlohmann::json{96, 64}));
    EXPECT_GT(report["triangles"].get<int>(), 1000);
    const auto image = readImage(folder / "a.png");
    ASSERT_TRUE(image);
    EXPECT_EQ(image->width, 96);
    EXPECT_EQ(image->height, 64);
}

TEST(CommandLine, sameInputGivesTheSameBytesForAnyNumberOfThreads)
{
    TemporaryFolder folder;
    for (const char* n : {"1", "2", "5"})
        ASSERT_EQ(runTool(with({"render", "-o", std::string(n) + ".png", "--threads", n}, kSmall), folder.path()).code,
                  0);
    EXPECT_EQ(readWhole(folder / "1.png"), readWhole(folder / "2.png"));
    EXPECT_EQ(readWhole(folder / "1.png"), readWhole(folder / "5.png"));
}

TEST(CommandLine, exrKeepsUnitNormalsAsFloats)
{
    TemporaryFolder folder;
    ASSERT_EQ(runTool(with({"render", "-o", "n.exr", "--view", "normal"}, kSmall), folder.path()).code, 0);
    const auto image = readImage(folder / "n.exr");
    ASSERT_TRUE(image);
    ASSERT_EQ(image->type, PixelType::float32);
    int covered = 0;
    for (std::size_t i = 0; i < image->pixelCount(); ++i) {
        const float* p = image->floats() + i * 4;
        if (p[3] == 0)
            continue;
        ++covered;
        EXPECT_NEAR(p[0] * p[0] + p[1] * p[1] + p[2] * p[2], 1, 1e-4); // float normalisation
    }
    EXPECT_GT(covered, 96 * 64 / 4);
}

TEST(CommandLine, everyFrameAndViewDraws)
{
    TemporaryFolder folder;
    for (const char* frame :
         {"cotangent", "cotangent-2013", "nonperspective", "paper-full", "paper-nodet", "paper-transpose",
          "paper-orthogonal", "unit", "orthonormal", "gradient", "exact", "smooth", "vertex", "mikktspace"})
        EXPECT_EQ(runTool(with({"render", "-o", "f.png", "--frame", frame}, kSmall), folder.path()).code, 0) << frame;
    for (const char* view : {"shaded", "normal", "tangent", "bitangent", "uv", "depth", "error"})
        EXPECT_EQ(runTool(with({"render", "-o", "v.png", "--view", view}, kSmall), folder.path()).code, 0) << view;
}

TEST(CommandLine, compareOfAFrameWithItselfIsZeroDegrees)
{
    TemporaryFolder folder;
    const ToolRun run = runTool(
        with({"compare", "-o", "d", "--frames", "cotangent,cotangent", "--json", "r.json"}, kSmall), folder.path());
    ASSERT_EQ(run.code, 0) << run.err;
    const auto report = nlohmann::json::parse(readWhole(folder / "r.json"));
    EXPECT_EQ(report["normals"]["max_degrees"], 0);
    EXPECT_GT(report["normals"]["pixels"], 1000);
    for (const char* file : {"d/cotangent.png", "d/difference.png"})
        EXPECT_TRUE(std::filesystem::exists(folder / file)) << file;
}

} // namespace
} // namespace cotan
