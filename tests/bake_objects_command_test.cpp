// `cotan bake` of several objects, and of files with another up axis, as a user runs it.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include <fmt/format.h>
#include <glm/ext/vector_int3.hpp>
#include <nlohmann/json.hpp>

#include "cotan/image.hpp"
#include "run_tool.hpp"

namespace cotan::test {
namespace {

using Words = std::vector<std::string>;

// A square of side 1 with its corner at x; `slope` tilts high meshes along x. Its uv fill the unit square.
std::string square(const std::string& name, double x, double slope, int first)
{
    std::string text = "o " + name + "\n";
    for (const auto& [u, v] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}})
        text += fmt::format("v {} {} {}\nvt {} {}\n", x + u, v, slope * (u - 0.5), u, v);
    return text + fmt::format("f {0}/{0} {1}/{1} {2}/{2} {3}/{3}\n", first, first + 1, first + 2, first + 3);
}

// Writes two objects with overlapping uv whose detail is tilted in opposite directions.
void writeTwo(const TemporaryFolder& folder)
{
    std::ofstream(folder / "low.obj") << square("left lid", 0, 0, 1) << square("right/lid", 3, 0, 5);
    std::ofstream(folder / "high.obj") << square("a", 0, 0.2, 1) << square("b", 3, -0.2, 5);
}

ToolRun bake(const TemporaryFolder& folder, const Words& more)
{
    Words words = {"bake", "--high", "high.obj", "--low", "low.obj", "--size", "16", "--overwrite"};
    words.insert(words.end(), more.begin(), more.end());
    return runTool(words, folder.path());
}

// Red of a texel in the middle: above 128 if the normal is tilted to +x.
int middleRed(const TemporaryFolder& folder, const std::string& file)
{
    const auto map = readImage(folder / file);
    if (!map || map->width != 16 || map->height != 16)
        return -1;
    return map->bytes8()[4 * (8 * 16 + 8)];
}

TEST(BakeObjects, pairsTilesAndMapsCombine)
{
    // Two pairs in one place, the second one on tile 1002; each high mesh has its colour.
    TemporaryFolder folder;
    std::string low = square("a_low", 0, 0, 1), other = square("b_low", 0, 0, 5);
    for (std::size_t at = 0; (at = other.find("vt ", at)) != std::string::npos; at += 3)
        other[at + 3] = char(other[at + 3] + 1); // u from 1 to 2
    std::ofstream(folder / "low.obj") << low << other;
    std::ofstream(folder / "high.mtl") << "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n";
    std::ofstream(folder / "high.obj") << "mtllib high.mtl\nusemtl red\n"
                                       << square("a_high", 0, 0, 1) << "usemtl blue\n"
                                       << square("b_high", 0, 0, 5);
    const ToolRun run = bake(folder,
                             {"--match-by-name", "--per-object", "--udim", "all", "--maps", "base-color,id", "-o",
                              "m_<MAP>_<UDIM>.png", "--json", "r.json"});
    ASSERT_EQ(run.code, 0) << run.err;
    for (const auto& [object, tile, color, id] :
         {std::tuple("a_low", "1001", 0, glm::ivec3(128, 0, 0)), {"b_low", "1002", 2, glm::ivec3(0, 128, 0)}}) {
        const auto map = readImage(folder / fmt::format("m_base-color_{}-{}.png", tile, object)),
                   ids = readImage(folder / fmt::format("m_id_{}-{}.png", tile, object));
        ASSERT_TRUE(map && ids) << object;
        for (int c = 0; c < 3; ++c) {
            EXPECT_EQ(map->bytes8()[4 * (8 * 16 + 8) + c], c == color ? 255 : 0);
            EXPECT_EQ(ids->bytes8()[4 * (8 * 16 + 8) + c], id[c]);
        }
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "m_id_1002-a_low.png")); // a_low has no triangles there
    EXPECT_EQ(nlohmann::json::parse(readWhole(folder / "r.json"))["objects"].size(), 2u);
}

TEST(BakeObjects, anObjectsMapIsThatOfTheObjectAlone)
{
    TemporaryFolder folder;
    writeTwo(folder);
    const ToolRun both = bake(folder, {"-o", "m.png"});
    ASSERT_EQ(both.code, 0) << both.err;
    EXPECT_NE(
        both.err.find(
            "256 of 256 covered texels, most of them around texel 1, 1, are shared by triangles that need normals 23 "
            "degrees apart on average; the first in the file won: give each its own texture coordinates "
            "(--per-object makes a map for each of the 2 objects, --object NAME one; --mask shows where)"),
        std::string::npos)
        << both.err;
    const ToolRun each = bake(folder, {"-o", "each.png", "--mask", "mask.png", "--per-object", "--json", "r.json"});
    ASSERT_EQ(each.code, 0) << each.err;
    EXPECT_EQ(each.err.find("shared"), std::string::npos) << each.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "each.png"));
    EXPECT_TRUE(std::filesystem::exists(folder / "mask-left_lid.png"));
    const int left = middleRed(folder, "each-left_lid.png"), right = middleRed(folder, "each-right_lid.png");
    EXPECT_NEAR(left, 128 - 127 * 0.196, 2); // the component of a normal with slope 0.2
    EXPECT_NEAR(right, 128 + 127 * 0.196, 2);
    const auto report = nlohmann::json::parse(readWhole(folder / "r.json"));
    ASSERT_EQ(report["objects"].size(), 2u);
    EXPECT_EQ(report["objects"][1]["object"], "right/lid");
    EXPECT_EQ(report["objects"][1]["output"], "each-right_lid.png");
    ASSERT_EQ(bake(folder, {"-o", "one.png", "--object", "right/lid"}).code, 0);
    EXPECT_EQ(readWhole(folder / "one.png"), readWhole(folder / "each-right_lid.png"));
}

TEST(BakeObjects, objectsOfOneNameInFilesGetAMapEach)
{
    for (const auto& [first, second, firstFile, secondFile] : {std::tuple("a b", "a_b", "m-a_b-2.png", "m-a_b.png"),
                                                               {"a/b", "a:b", "m-a_b.png", "m-a_b-2.png"},
                                                               {"Lid", "lid", "m-Lid.png", "m-lid-2.png"},
                                                               {"..", "__", "m-__-2.png", "m-__.png"}}) {
        TemporaryFolder folder;
        std::ofstream(folder / "low.obj") << square(first, 0, 0, 1) << square(second, 3, 0, 5);
        std::ofstream(folder / "high.obj") << square("a", 0, 0.2, 1) << square("b", 3, -0.2, 5);
        const ToolRun run = runTool({"bake", "--high", "high.obj", "--low", "low.obj", "--size", "16", "--per-object",
                                     "-o", "m.png", "--json", "r.json"},
                                    folder.path());
        ASSERT_EQ(run.code, 0) << run.err;
        EXPECT_LT(middleRed(folder, firstFile), 110) << first;
        EXPECT_GT(middleRed(folder, secondFile), 146) << second;
        EXPECT_NE(run.err.find("is that of another one in file names: its files are named"), std::string::npos)
            << run.err;
        const auto report = nlohmann::json::parse(readWhole(folder / "r.json"));
        EXPECT_EQ(report["objects"][0]["object"], first);
        EXPECT_EQ(report["objects"][0]["output"], firstFile);
        EXPECT_EQ(report["objects"][1]["output"], secondFile);
    }
}

TEST(BakeObjects, anObjectCannotLeaveTheFolderOfItsImages)
{
    TemporaryFolder folder;
    std::filesystem::create_directory(folder / "views");
    std::ofstream(folder / "low.obj") << square("..", 0, 0, 1);
    std::ofstream(folder / "high.obj") << square("a", 0, 0.2, 1);
    const ToolRun run = bake(folder, {"-o", "m.png", "--per-object", "--verify", "views/all", "--device", "reference"});
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_TRUE(std::filesystem::exists(folder / "views" / "all" / "__"));
    for (const auto& entry : std::filesystem::directory_iterator(folder / "views"))
        EXPECT_EQ(entry.path().filename(), "all");
}

TEST(BakeObjects, twoOutputsAreNeverOneFile)
{
    TemporaryFolder folder;
    writeTwo(folder);
    for (const Words& overwrite : {Words{}, {"--overwrite"}}) {
        Words words{"bake", "--high", "high.obj", "--low",  "low.obj", "--size",
                    "16",   "-o",     "m.png",    "--mask", "./m.png"};
        words.insert(words.end(), overwrite.begin(), overwrite.end());
        const ToolRun run = runTool(words, folder.path());
        EXPECT_EQ(run.code, 1);
        EXPECT_NE(run.err.find("-o m.png and --mask ./m.png are the same file; expected different names\n"),
                  std::string::npos)
            << run.err;
        EXPECT_FALSE(std::filesystem::exists(folder / "m.png"));
    }
}

TEST(BakeObjects, wrongNamesAndContradictoryOptionsGetOneLine)
{
    TemporaryFolder folder;
    writeTwo(folder);
    const std::tuple<Words, int, std::string> cases[] = {
        {{"-o", "m.png", "--object", "lid"}, 2, "low.obj has no object 'lid'; expected one of 'left lid', 'right/lid'"},
        {{"-o", "m.glb", "--object", "left lid"}, 1, "expected an image with --object"},
        {{"-o", "m.glb", "--per-object"}, 1, "expected an image with --per-object"},
        {{"-o", "m.png", "--per-object", "--object", "left lid"}, 1, "expected no --object"},
        {{"-o", "m.png", "--per-object", "--cage", "low.obj"}, 1, "no --cage"},
        {{"-o", "m.png", "--size", "16x"}, 1, "--size: expected WxH, or one number for both"},
        {{"-o", "m.png", "--up", "x"}, 1, "--up"},
    };
    for (const auto& [words, code, message] : cases) {
        Words all = {"bake", "--high", "high.obj", "--quiet"};
        if (std::ranges::find(words, "--low") == words.end())
            all.insert(all.end(), {"--low", "low.obj"});
        all.insert(all.end(), words.begin(), words.end());
        const ToolRun run = runTool(all, folder.path());
        EXPECT_EQ(run.code, code) << ::testing::PrintToString(words) << run.err;
        EXPECT_EQ(lines(run.err), 1) << run.err;
        EXPECT_NE(run.err.find(message), std::string::npos) << run.err;
    }
}

// Writes a slanted strip 1 wide, 3 high and 0.4 deep, which no rotation maps to itself; zUp: with z up.
void writeStrip(const std::filesystem::path& file, bool zUp)
{
    std::string text;
    for (const auto& [u, v] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
        const double y = 3 * v + 1, z = 0.4 * v;
        text += zUp ? fmt::format("v {} {} {}\n", u, -z, y) : fmt::format("v {} {} {}\n", u, y, z);
        text += fmt::format("vt {} {}\n", u, v);
    }
    std::ofstream(file) << text << "f 1/1 2/2 3/3 4/4\n";
}

TEST(BakeUp, zUpFilesGiveTheSameMapAndMixedOnesAWarning)
{
    TemporaryFolder folder;
    writeStrip(folder / "low.obj", false);
    writeStrip(folder / "high.obj", false);
    writeStrip(folder / "low_z.obj", true);
    writeStrip(folder / "high_z.obj", true);
    const auto baked = [&](const std::string& high, const std::string& low, const Words& more) {
        Words words = {"bake", "--high", high, "--low", low, "--size", "16", "-o", "m.png", "--overwrite"};
        words.insert(words.end(), more.begin(), more.end());
        const ToolRun run = runTool(words, folder.path());
        EXPECT_EQ(run.code, 0) << run.err;
        return std::pair(readWhole(folder / "m.png"), run.err);
    };
    const auto [right, quiet] = baked("high.obj", "low.obj", {});
    EXPECT_EQ(quiet, "");
    const std::tuple<std::string, std::string, Words, std::string> wrong[] = {
        {"high_z.obj", "low.obj", {}, "try --high-up z"},
        {"high.obj", "low_z.obj", {}, "try --up z --high-up y"},
        {"high_z.obj", "low.obj", {"--up", "z"}, "try --up y --high-up z"},
        {"high.obj", "low.obj", {"--high-up", "z"}, "try --up y"},
    };
    for (const auto& [high, low, given, advice] : wrong) {
        const std::string warning = baked(high, low, given).second;
        const std::size_t at = warning.find("would if one were rotated by 90 degrees: it probably has z up; ");
        ASSERT_NE(at, std::string::npos) << high << " " << low << warning;
        EXPECT_NE(warning.find(advice + "\n"), std::string::npos) << warning;
    }
    EXPECT_EQ(baked("high_z.obj", "low_z.obj", {"--up", "z"}).first, right);
    EXPECT_EQ(baked("high_z.obj", "low.obj", {"--high-up", "z"}).first, right);
    EXPECT_EQ(baked("high.obj", "low_z.obj", {"--up", "z", "--high-up", "y"}), std::pair(right, std::string()));
}

TEST(BakeUp, upAppliesInEveryCommandThatReadsModels)
{
    TemporaryFolder folder;
    writeStrip(folder / "y.obj", false);
    writeStrip(folder / "z.obj", true);
    const auto same = [&](const Words& command, const std::string& option) {
        for (const std::string up : {"y", "z"}) {
            Words words = command;
            words.insert(words.end(), {option, up + ".obj", "--up", up, "-o", up + ".png"});
            if (option.empty())
                words.erase(std::ranges::find(words, ""));
            EXPECT_EQ(runTool(words, folder.path()).code, 0) << command[0];
        }
        EXPECT_EQ(readWhole(folder / "y.png"), readWhole(folder / "z.png")) << command[0];
    };
    same({"render", "--size", "32", "--device", "reference", "--overwrite"}, "");
    ASSERT_EQ(runTool({"render", "--size", "8", "--view", "normal", "--device", "reference", "-o", "n.png", "--quiet"},
                      folder.path())
                  .code,
              0);
    same({"map", "convert", "n.png", "--from", "opengl", "--to", "object", "--overwrite"}, "--mesh");
    const auto spots = [&](const std::string& up) {
        const ToolRun run = runTool({"lint", up + ".obj", "--up", up, "--json", "-"}, folder.path());
        return nlohmann::json::parse(run.out)["problem_areas"].at(0).at("camera").dump();
    };
    EXPECT_EQ(spots("y"), spots("z"));
    const ToolRun none = runTool({"render", "--up", "z", "-o", "a.png"}, folder.path());
    EXPECT_EQ(none.code, 1);
    EXPECT_NE(none.err.find("--up: expected a model; found the built-in scene"), std::string::npos) << none.err;
}

} // namespace
} // namespace cotan::test
