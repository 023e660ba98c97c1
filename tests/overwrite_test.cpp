// No command replaces its inputs or writes two outputs to one file unless --overwrite is given.
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cotan/image.hpp"
#include "files/output.hpp"
#include "quad_model.hpp"
#include "run_tool.hpp"

namespace cotan {
namespace {

using namespace test;
namespace fs = std::filesystem;
using Words = std::vector<std::string>;

// A map n.png, a model quad.gltf with quad.bin and waves.png, a mesh mesh.ply; links to n.png.
class Overwrite : public ::testing::Test {
protected:
    void SetUp() override
    {
        write(quad(2), folder.path());
        Image map = makeImage(16, 16, PixelType::unorm8);
        for (std::size_t i = 0; i < map.pixelCount(); ++i)
            for (std::size_t c = 0; c < 4; ++c)
                map.bytes8()[4 * i + c] = std::uint8_t(c == 2 ? 255 : c == 3 ? 255 : 100 + i % 40);
        ASSERT_TRUE(writeImage(folder / "n.png", map));
        fs::create_hard_link(folder / "n.png", folder / "hard.png");
        fs::create_symlink("n.png", folder / "soft.png");
        fs::create_directory(folder / "sub");
    }

    std::map<std::string, std::string> contents() const
    {
        std::map<std::string, std::string> all;
        for (const auto& entry : fs::recursive_directory_iterator(folder.path()))
            if (entry.is_regular_file())
                all[entry.path().string()] = readWhole(entry.path());
        return all;
    }

    // Expects exit code 1, a one-line error that names both and what helps, and no change of any file.
    void expectRefused(const Words& words, const std::string& a, const std::string& b,
                       const std::string& help = "; expected another name, or --overwrite\n")
    {
        const auto before = contents();
        const ToolRun run = runTool(words, folder.path());
        const std::string all = fmt::format("{}: {}", fmt::join(words, " "), run.err);
        EXPECT_EQ(run.code, 1) << all;
        EXPECT_EQ(lines(run.err), 1) << all;
        EXPECT_NE(run.err.find(a), std::string::npos) << all;
        EXPECT_NE(run.err.find(b), std::string::npos) << all;
        EXPECT_TRUE(run.err.ends_with(help)) << all;
        EXPECT_TRUE(contents() == before) << all;
    }

    TemporaryFolder folder;
};

TEST_F(Overwrite, everyMapCommandRefusesItsInputUnderAnyPath)
{
    const std::vector<Words> commands = {{"convert", "n.png", "--from", "directx", "--to", "opengl"},
                                         {"from-height", "n.png"},
                                         {"to-height", "n.png"},
                                         {"blend", "n.png", "n.png"},
                                         {"diff", "n.png", "n.png"}};
    for (const Words& command : commands)
        for (const char* name : {"n.png", "./n.png", "sub/../n.png", "hard.png", "soft.png"}) {
            Words words = {"map"};
            words.insert(words.end(), command.begin(), command.end());
            words.insert(words.end(), {"-o", name});
            expectRefused(words, fmt::format("-o {}", name), "n.png, which is an input");
        }
    expectRefused({"map", "mips", "hard.png", "-o", "hard.png", "--json", "./n.png"}, "--json ./n.png",
                  "hard.png, which is an input");
    expectRefused({"map", "info", "n.png", "--json", "soft.png"}, "--json soft.png", "n.png, which is an input");
    expectRefused({"map", "detect", "n.png", "--json", "n.png"}, "--json n.png", "n.png, which is an input");
}

TEST_F(Overwrite, everyFileOfAModelIsProtected)
{
    const Words small = {"--device", "reference", "--size", "32x32"};
    const auto with = [&](Words words) {
        words.insert(words.end(), small.begin(), small.end());
        return words;
    };
    expectRefused(with({"render", "quad.gltf", "-o", "waves.png"}), "-o waves.png", "waves.png, which is an input");
    expectRefused(with({"render", "quad.gltf", "-o", "a.png", "--json", "quad.bin"}), "--json quad.bin",
                  "quad.bin, which is an input");
    expectRefused(with({"compare", "quad.gltf", "-o", "d", "--json", "sub/../quad.gltf"}), "--json sub/../quad.gltf",
                  "quad.gltf, which is an input");
    expectRefused({"lint", "quad.gltf", "--json", "quad.bin"}, "--json quad.bin", "quad.bin, which is an input");
    expectRefused({"tangents", "quad.gltf", "-o", "./quad.gltf"}, "-o ./quad.gltf", "quad.gltf, which is an input");
    expectRefused({"convert", "quad.gltf", "--to", "cotangent", "-o", "quad.gltf"}, "-o quad.gltf",
                  "quad.gltf, which is an input");
    expectRefused({"bake", "--high", "quad.gltf", "--low", "quad.gltf", "--size", "8x8", "-o", "waves.png"},
                  "-o waves.png", "waves.png, which is an input");
}

TEST_F(Overwrite, imagesOfAModelAreProtectedFromAnOutputFolder)
{
    fs::rename(folder / "waves.png", folder / "difference.png");
    std::string model = readWhole(folder / "quad.gltf");
    model.replace(model.find("waves.png"), 9, "difference.png");
    std::ofstream(folder / "quad.gltf") << model;
    expectRefused({"compare", "quad.gltf", "-o", ".", "--device", "reference", "--size", "32x32"},
                  "-o ./difference.png", "difference.png, which is an input");
}

// One of two outputs would be lost, whether or not --overwrite is given.
TEST_F(Overwrite, equalOutputPathsAreRefusedBeforeWork)
{
    const auto expectTwoNames = [&](Words words, const std::string& a, const std::string& b) {
        expectRefused(words, a, b, " are the same file; expected different names\n");
        words.push_back("--overwrite");
        expectRefused(words, a, b, " are the same file; expected different names\n");
    };
    expectTwoNames({"render", "-o", "a.png", "--json", "sub/../a.png"}, "-o a.png", "--json sub/../a.png");
    expectTwoNames({"compare", "-o", "new", "--json", "new/difference.png"}, "-o new/difference.png",
                   "--json new/difference.png");
    expectTwoNames({"accuracy", "-o", "a.md", "--csv", "./a.md"}, "-o a.md", "--csv ./a.md");
    expectTwoNames({"shader", "--lang", "glsl", "--frame", "cotangent", "-o", "a.glsl", "--json", "a.glsl"},
                   "-o a.glsl", "--json a.glsl");
    expectTwoNames({"figures", "-o", "new", "--json", "new/index.html"}, "-o new/index.html", "--json new/index.html");
    expectTwoNames({"bake", "--high", "quad.gltf", "--low", "quad.gltf", "-o", "a.png", "--mask", "a.png"}, "-o a.png",
                   "--mask a.png");
    expectTwoNames({"map", "convert", "n.png", "--from", "directx", "--to", "opengl", "-o", "a.png", "--json", "a.png"},
                   "-o a.png", "--json a.png");
}

TEST_F(Overwrite, overwriteOptionReplacesTheInput)
{
    ASSERT_EQ(
        runTool({"map", "convert", "n.png", "--from", "directx", "--to", "opengl", "-o", "good.png"}, folder.path())
            .code,
        0);
    const ToolRun run =
        runTool({"map", "convert", "n.png", "--from", "directx", "--to", "opengl", "-o", "n.png", "--overwrite"},
                folder.path());
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(readWhole(folder / "n.png"), readWhole(folder / "good.png"));
    EXPECT_NE(readWhole(folder / "hard.png"), readWhole(folder / "good.png")) << "the other name lost its picture";
    const ToolRun model =
        runTool({"tangents", "quad.gltf", "-o", "quad.gltf", "--replace", "--overwrite"}, folder.path());
    EXPECT_EQ(model.code, 0) << model.err;
    EXPECT_EQ(runTool({"tangents", "quad.gltf"}, folder.path()).code, 0);
}

TEST_F(Overwrite, derivedOutputNamesAreAccepted)
{
    EXPECT_EQ(runTool({"map", "mips", "n.png", "-o", "n.png"}, folder.path()).code,
              0); // n_0.png, n_roughness_0.png, ...
    EXPECT_EQ(runTool({"map", "info", "n.png", "--json", "n.json"}, folder.path()).code, 0);
    EXPECT_EQ(runTool({"map", "info", "n.png", "--json", "n.json"}, folder.path()).code, 0)
        << "an old report is replaced";
}

TEST_F(Overwrite, unwritableReportsAreNoticedBeforeTheMainOutput)
{
    for (const char* report : {"no/such/r.json", "sub", "n.png/r.json"}) {
        const auto before = contents();
        const ToolRun run =
            runTool({"map", "convert", "n.png", "--from", "directx", "--to", "opengl", "-o", "a.png", "--json", report},
                    folder.path());
        EXPECT_EQ(run.code, 4) << report;
        EXPECT_EQ(lines(run.err), 1) << run.err;
        EXPECT_NE(run.err.find(report), std::string::npos) << run.err;
        EXPECT_TRUE(contents() == before) << report;
    }
}

TEST_F(Overwrite, leftoverTemporaryFilesAreReportedByTheNextRun)
{
    const pid_t child = ::fork();
    if (child == 0) {
        const auto half = OutputFile::begin(folder / "half.png");
        ::_exit(half && writeBytes(*half, {}) ? 0 : 1); // exits without removing the temporary file
    }
    ASSERT_EQ(::waitpid(child, nullptr, 0), child);
    std::string part;
    for (const auto& entry : fs::directory_iterator(folder.path()))
        if (entry.path().filename().string().starts_with(fmt::format(".cotan-{}-", child)))
            part = entry.path().filename();
    ASSERT_FALSE(part.empty());
    const ToolRun run =
        runTool({"map", "convert", "n.png", "--from", "directx", "--to", "opengl", "-o", "a.png"}, folder.path());
    EXPECT_EQ(run.code, 0);
    EXPECT_NE(run.err.find(part), std::string::npos) << run.err;
    EXPECT_TRUE(fs::exists(folder / part)) << "it may be of another machine";
}

} // namespace
} // namespace cotan
