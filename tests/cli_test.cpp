// The command line from the user's side: valid and invalid words, exit codes, files.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sys/stat.h>

#include "cotan/image.hpp"
#include "run_tool.hpp"
#include "test_data.hpp"

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

TEST(CommandLine, invalidNumbersAreAnsweredWithTheExpectedRange)
{
    TemporaryFolder folder;
    const std::pair<Words, std::string> cases[] = {
        {{"render", "--samples", "x"}, "--samples: expected 1, 4 or 16; found 'x'"},
        {{"render", "--samples", "3"}, "--samples: expected 1, 4 or 16; found '3'"},
        {{"render", "--threads", "x"}, "--threads: expected a whole number from 0 to 1024; found 'x'"},
        {{"render", "--threads", "1e99"}, "--threads: expected a whole number from 0 to 1024; found '1e99'"},
        {{"render", "--time", "-1"}, "--time: expected a number from 0 to 1e+06; found '-1'"},
        {{"render", "--time", "nan"}, "--time: expected a number from 0 to 1e+06; found 'nan'"},
        {{"lint", "a.glb", "--distance", "x"}, "--distance: expected a number"},
    };
    for (const auto& [words, message] : cases) {
        const ToolRun run = runTool(words, folder.path());
        EXPECT_EQ(run.code, 1);
        EXPECT_EQ(lines(run.err), 1) << run.err;
        EXPECT_NE(run.err.find(message), std::string::npos) << run.err;
    }
}

TEST(CommandLine, wrongArgumentsExitOneWithOneLineAndNoFile)
{
    const std::vector<Words> wrong = {
        {},
        {"rendr"},
        {"render"},
        {"render", "-o", "a.png", "--frame", "tangent"},
        {"render", "-o", "a.png", "--size", "640x"},
        {"render", "-o", "a.png", "--size", "0x10"},
        {"render", "-o", "a.png", "--size", "99999x10"},
        {"render", "-o", "a.png", "--camera", "1,2,3"},
        {"render", "-o", "a.png", "--camera", "1,2,3,1,2,3"},
        {"render", "-o", "a.png", "--camera", "7"},
        {"render", "-o", "a.png", "--view", "colour"},
        {"render", "-o", "a.png", "--samples", "3"},
        {"render", "-o", "a.png", "--animation", "walk"}, // the built-in scene has none
        {"render", "-o", "a.png", "--time", "2"},
        {"render", "-o", "a.png", "--frames", "0..2"},
        {"render", "a.glb", "-o", "a.png", "--animation", "0", "--frames", "2..1"},
        {"render", "a.glb", "-o", "a.png", "--animation", "0", "--frames", "0-3"},
        {"render", "a.glb", "-o", "a.png", "--animation", "0", "--frames", "0..1000000"},
        {"render", "a.glb", "-o", "a.png", "--animation", "0", "--frames", "0..3", "--time", "1"},
        {"render", "-o", "a.webp"}, // an animation without --frames
        {"render", "a.glb", "-o", "a.gif", "--animation", "0", "--frames", "0..3", "--rate", "60"},
        {"render", "-o", "a.png", "--environment", "none", "--background", "blur"},
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

// A pipe stands for devices such as /dev/null: replacing one by a file would break it for all other programs.
TEST(CommandLine, aReportIsWrittenIntoAPipe)
{
    TemporaryFolder folder;
    const std::filesystem::path pipe = folder / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    const int reader = ::open(pipe.c_str(), O_RDWR); // so that writers do not block
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

TEST(CommandLine, aReportToStandardOutputMakesNoFileNamedDash)
{
    TemporaryFolder folder;
    std::filesystem::create_directory(folder / "-");
    const ToolRun run =
        runTool({"render", "--device", "reference", "--size", "16x16", "--samples", "1", "-o", "a.png", "--json", "-"},
                folder.path());
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_TRUE(run.out.starts_with("{")) << run.out.substr(0, 80);
    EXPECT_TRUE(std::filesystem::is_empty(folder / "-"));
}

TEST(CommandLine, anEqualsSignAfterAShortOptionIsSkipped)
{
    TemporaryFolder folder;
    ASSERT_EQ(runTool(with({"render", "-o=a.png"}, kSmall), folder.path()).code, 0);
    EXPECT_TRUE(std::filesystem::exists(folder / "a.png"));
    EXPECT_FALSE(std::filesystem::exists(folder / "=a.png"));
}

TEST(CommandLine, controlCharactersOfNamesAreEscaped)
{
    TemporaryFolder folder;
    const ToolRun run = runTool({"lint", "a\nb\x1b[31m\xc2\x9b\xc3\xa9.glb"}, folder.path());
    EXPECT_EQ(run.code, 2);
    EXPECT_NE(run.err.find("a\\nb\\x1b[31m\\x9b\xc3\xa9.glb"), std::string::npos) << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
}

// As a desktop does when a file is opened with the program or dropped on it.
TEST(CommandLine, aFileAloneIsShownInTheWindow)
{
    TemporaryFolder folder;
    for (const char* name : {"broken.glb", "broken.png"}) {
        std::ofstream(folder / name) << "neither of both";
        const ToolRun alone = runTool({name}, folder.path()), view = runTool({"view", name}, folder.path());
        EXPECT_EQ(alone.code, view.code) << name;
        EXPECT_EQ(alone.err, view.err) << name;
        EXPECT_EQ(alone.err.find("unknown command"), std::string::npos) << alone.err;
    }
    const ToolRun missing = runTool({"gone.glb"}, folder.path());
    EXPECT_EQ(missing.code, 1);
    EXPECT_NE(missing.err, runTool({"view", "gone.glb"}, folder.path()).err);
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

// A triangle that moves by 1 along x in one second. Its glTF JSON is written from the specification.
TEST(CommandLine, animationFramesAreNumberedImages)
{
    TemporaryFolder folder;
    const std::vector<float> numbers = {0, 0, 0, 1, 0, 0, 0, 1, 0, /*times*/ 0, 1, /*moves*/ 0, 0, 0, 1, 0, 0};
    std::ofstream(folder / "m.bin", std::ios::binary)
        .write(reinterpret_cast<const char*>(numbers.data()), std::streamsize(numbers.size() * 4));
    std::ofstream(folder / "m.gltf") << R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
        "nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
        "buffers":[{"uri":"m.bin","byteLength":68}],
        "bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":8},
                       {"buffer":0,"byteOffset":44,"byteLength":24}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
                     {"bufferView":1,"componentType":5126,"count":2,"type":"SCALAR","min":[0],"max":[1]},
                     {"bufferView":2,"componentType":5126,"count":2,"type":"VEC3"}],
        "animations":[{"name":"go","channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}],
                       "samplers":[{"input":1,"output":2}]}]})";
    const Words draw = with({"render", "m.gltf", "--camera", "0.5,0.5,3,0.5,0.5,0", "--view", "depth"}, kSmall);
    ASSERT_EQ(
        runTool(with(draw, {"--animation", "go", "--frames", "1..3", "--rate", "4", "-o", "m.png"}), folder.path())
            .code,
        0);
    EXPECT_FALSE(std::filesystem::exists(folder / "m.png"));
    EXPECT_FALSE(std::filesystem::exists(folder / "m-0000.png"));
    std::set<std::string> different;
    for (int i = 1; i <= 3; ++i) {
        const std::string single = "t" + std::to_string(i) + ".png";
        ASSERT_EQ(
            runTool(with(draw, {"--animation", "0", "--time", std::to_string(i / 4.0), "-o", single}), folder.path())
                .code,
            0);
        const std::string bytes = readWhole(folder / ("m-000" + std::to_string(i) + ".png"));
        EXPECT_EQ(bytes, readWhole(folder / single)) << i;
        different.insert(bytes);
    }
    EXPECT_EQ(different.size(), 3u);
    const ToolRun none = runTool(with(draw, {"--animation", "run", "-o", "n.png"}), folder.path());
    EXPECT_EQ(none.code, 1);
    EXPECT_NE(none.err.find("(go)"), std::string::npos) << none.err;
}

// Numbers of pixels that are not transparent: at the edges of an image without background, and inside.
std::pair<int, int> coveredPixels(const std::filesystem::path& file)
{
    const auto image = readImage(file);
    if (!image)
        return {-1, 0};
    int edge = 0, inside = 0;
    for (int y = 0; y < image->height; ++y)
        for (int x = 0; x < image->width; ++x) {
            const bool outer = x == 0 || y == 0 || x == image->width - 1 || y == image->height - 1;
            (outer ? edge : inside) += image->bytes8()[4 * (y * image->width + x) + 3] > 0;
        }
    return {edge, inside};
}

TEST(CommandLine, oneCameraFramesTheWholeAnimation)
{
    COTAN_NEEDS_DATA("animated/Fox.glb");
    const std::string model = dataFile("animated/Fox.glb").string();
    TemporaryFolder folder;
    for (const char* camera : {"front", "fit"}) {
        const Words draw = {"render",       model,    "--animation", "Run",      "--background",  "none",
                            "--ground",     "off",    "--size",      "120x90",   "--samples",     "1",
                            "--camera",     camera,   "--exposure",  "1",        "--environment", "none",
                            "--no-shadows", "--rate", "24",          "--device", "reference"};
        ASSERT_EQ(runTool(with(draw, {"--frames", "0..16", "-o", "f.png"}), folder.path()).code, 0);
        double covered = 0;
        for (int i = 0; i <= 16; ++i) {
            const auto [edge, inside] =
                coveredPixels(folder / ((i < 10 ? "f-000" : "f-00") + std::to_string(i) + ".png"));
            EXPECT_EQ(edge, 0) << camera << " " << i;
            covered += inside / 17.0;
        }
        EXPECT_GT(covered, 120 * 90 / 20) << camera; // nor is it tiny; `fit` uses a sphere around the whole motion
        // A single moment is drawn with the camera of the whole animation.
        ASSERT_EQ(runTool(with(draw, {"--time", "0.5", "-o", "t.png"}), folder.path()).code, 0);
        EXPECT_EQ(readWhole(folder / "t.png"), readWhole(folder / "f-0012.png"));
    }
}

TEST(CommandLine, everyFrameAndViewIsDrawn)
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

TEST(Tool, images_of_an_animation_go_into_one_file)
{
    COTAN_NEEDS_DATA("animated/Fox.glb");
    const std::string model = dataFile("animated/Fox.glb").string();
    TemporaryFolder folder;
    const ToolRun run = runTool({"render", model, "-o", "fox.webp", "--animation", "Walk", "--frames", "3..5", "--size",
                                 "48x32", "--device", "reference", "--environment", "none"},
                                folder.path());
    EXPECT_EQ(run.code, 0) << run.err;
    const std::string bytes = readWhole(folder / "fox.webp");
    EXPECT_EQ(bytes.substr(8, 4), "WEBP");
    int images = 0;
    for (std::size_t at = 0; (at = bytes.find("ANMF", at)) != std::string::npos; ++at)
        ++images;
    EXPECT_EQ(images, 3);
    const auto files = std::filesystem::directory_iterator(folder.path());
    EXPECT_EQ(std::distance(begin(files), end(files)), 1);
}

} // namespace
} // namespace cotan
