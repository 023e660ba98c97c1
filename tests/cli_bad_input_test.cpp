// Runs the tool on every malformed and hostile file of the test data and checks what EXPECTED.tsv asks for: at
// most five seconds and one GiB, one clear line, and no output for rejected files.
#include <gtest/gtest.h>

#include "expected_list.hpp"
#include "run_tool.hpp"

namespace cotan {
namespace {

using namespace test;

constexpr double kMegabytes = 1024;

// A model with the image as its normal map, which is how the tool reads an image file.
std::filesystem::path modelAround(const std::filesystem::path& imageFile, const TemporaryFolder& folder)
{
    std::filesystem::copy_file(imageFile, folder / "picture.png");
    // one triangle: positions, normals and uv as floats
    const char* text = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2},"material":0}]}],
"materials":[{"normalTexture":{"index":0}}],"textures":[{"source":0}],"images":[{"uri":"picture.png"}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5126,"count":3,"type":"VEC3"},
{"bufferView":2,"componentType":5126,"count":3,"type":"VEC2"}],
"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":36},
{"buffer":0,"byteOffset":72,"byteLength":24}],
"buffers":[{"byteLength":96,"uri":"triangle.bin"}]})";
    std::ofstream(folder / "model.gltf") << text;
    const float data[24] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
    std::ofstream(folder / "triangle.bin", std::ios::binary).write(reinterpret_cast<const char*>(data), sizeof data);
    return folder / "model.gltf";
}

// Checks what must hold whatever a command does with the file.
void checkRun(const ToolRun& run, const Expected& row, const TemporaryFolder& folder)
{
    EXPECT_LT(run.seconds, kBadInputSeconds);
    EXPECT_LT(run.megabytes, kMegabytes);
    EXPECT_TRUE(run.code == 0 || run.code == 2) << run.code << " " << run.err;
    if (row.verdict == "reject") {
        EXPECT_EQ(run.code, 2) << run.err;
    }
    if (row.verdict == "accept") {
        EXPECT_EQ(run.code, 0) << run.err;
    }
    if (row.verdict == "warn") {
        EXPECT_NE(run.err, "");
    }
    if (run.code != 0) {
        EXPECT_EQ(lines(run.err), 1) << run.err;
        EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
    }
}

void check(const Expected& row)
{
    SCOPED_TRACE(row.file.string());
    TemporaryFolder folder, model;
    const bool imageFile = row.file.extension() == ".png";
    const auto input = imageFile ? modelAround(row.file, model) : row.file;
    const ToolRun run = runTool({"render", input.string(), "-o", "out.png", "--device", "reference", "--size", "64x64"},
                                folder.path(), unsigned(4 * kBadInputSeconds));
    checkRun(run, row, folder);
    if (run.code == 0) {
        EXPECT_TRUE(std::filesystem::exists(folder / "out.png"));
    }
}

// Whether drawing, not reading, is slow: a million instances; 25,000 overlapping triangles that each cover the image
// and the shadow map.
bool isLeftOut(const std::filesystem::path& file)
{
    return file.filename() == "million_instances.glb" || file.filename() == "25000_groups.obj";
}

class BadInput : public ::testing::TestWithParam<const char*> {};

TEST_P(BadInput, getsTheListedResult)
{
    COTAN_NEEDS_DATA("bad/EXPECTED.tsv");
    const auto rows = expectedFor(GetParam());
    ASSERT_FALSE(rows.empty());
    for (const Expected& row : rows)
        if (!isLeftOut(row.file))
            check(row);
}

INSTANTIATE_TEST_SUITE_P(Files, BadInput, ::testing::Values(".gltf", ".glb", ".obj", ".ply", ".png"),
                         [](const auto& extension) { return std::string(extension.param + 1); });

// ---- every command that reads the kind of file ------------------------------------------------

using Words = std::vector<std::string>;

std::vector<Words> modelCommands(const std::string& model)
{
    std::vector<Words> commands = {
        {"lint", model},
        {"bake", "--high", model, "--low", model, "-o", "out.png", "--size", "16x16"},
    };
    if (model.ends_with(".glb")) {
        commands.push_back({"tangents", model});
        commands.push_back({"tangents", model, "-o", "out.glb"});
        commands.push_back({"convert", model, "--from", "mikktspace", "--to", "cotangent", "-o", "out.glb"});
    }
    return commands;
}

std::vector<Words> imageCommands(const std::string& imageFile)
{
    return {{"map", "info", imageFile},
            {"map", "detect", imageFile},
            {"map", "convert", imageFile, "--from", "gltf", "--to", "directx", "-o", "out.png"},
            {"map", "from-height", imageFile, "-o", "out.png"},
            {"map", "mips", imageFile, "-o", "out.dds"}};
}

// A command refuses a model that lacks what it needs (texture coordinates, a normal map). For files that may be drawn,
// only the bounds are checked and that the command prints something.
TEST(FoundInput, everyCommandHandlesItWithinBounds)
{
    COTAN_NEEDS_DATA("found/EXPECTED.tsv");
    std::size_t files = 0;
    for (const char* const extension : {".glb", ".obj", ".ply", ".exr", ".jpg", ".tif", ".dds"})
        for (Expected row : expectedFor(extension)) {
            if (row.file.parent_path().filename() != "found" || row.file.filename() == "million_instances.glb")
                continue;
            ++files;
            const std::string kind = extension;
            const bool model = kind == ".glb" || kind == ".obj" || kind == ".ply";
            if (model && row.verdict != "reject")
                row.verdict = "either";
            for (const Words& words : model ? modelCommands(row.file) : imageCommands(row.file)) {
                SCOPED_TRACE(words[0] + " " + words[1]);
                TemporaryFolder folder;
                checkRun(runTool(words, folder.path(), unsigned(4 * kBadInputSeconds)), row, folder);
            }
        }
    EXPECT_GT(files, 5u);
}

// A million instances of 4,000 vertices: 3.9 billion triangles, and 4 billion vertices for the bounding box.
TEST(HugeModels, renderersRefuseAMillionInstancesAndLintChecksThem)
{
    COTAN_NEEDS_DATA("found/million_instances.glb");
    const std::string model = dataFile("found/million_instances.glb").string();
    TemporaryFolder folder;
    const std::vector<std::vector<std::string>> calls = {
        {"render", model, "-o", "out.png", "--size", "64x64", "--device", "reference"},
        {"render", model, "-o", "out.png", "--size", "64x64"},
        {"compare", model, "-o", "out", "--size", "64x64", "--frames", "cotangent,exact"},
        {"lint", model, "--quiet"}};
    for (const auto& call : calls) {
        SCOPED_TRACE(call[0]);
        const ToolRun run = runTool(call, folder.path(), unsigned(4 * kBadInputSeconds));
        EXPECT_LT(run.seconds, kBadInputSeconds);
        EXPECT_LT(run.megabytes, kMegabytes);
        if (call[0] == "lint") {
            EXPECT_EQ(run.code, 0) << run.err;
            continue;
        }
        EXPECT_EQ(run.code, 2);
        EXPECT_EQ(run.err,
                  "cotan: error: million_instances: 1000000 instances draw 3900000000 triangles: expected at most "
                  "100000000\n");
        EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
    }
}

// The message has the position and the text there, not the parser's own message.
TEST(CommandLine, invalidJsonIsReportedByLineAndColumn)
{
    TemporaryFolder folder;
    const std::pair<std::string, std::string> cases[] = {
        {"{\"asset\": x}", "line 1, column 11: expected valid JSON; found '\"asset\": x'"},
        {"{\"a\": [1,\n 2,,3]}", "line 2, column 4: expected valid JSON; found '2,,'"},
        {"{", "line 1, column 2: expected more; found the end of the file"},
        {"{\"a\": 1e999}", "line 1, column 11: expected a number in the range of double; found '1e999'"},
        {"{}\x01\xff", "line 1, column 3: expected valid JSON; found "},
    };
    for (const auto& [text, message] : cases) {
        std::ofstream(folder / "bad.gltf") << text;
        const ToolRun run = runTool({"lint", "bad.gltf"}, folder.path());
        EXPECT_EQ(run.code, 2);
        EXPECT_EQ(lines(run.err), 1) << run.err;
        EXPECT_NE(run.err.find("bad.gltf: JSON: " + message), std::string::npos) << run.err;
        EXPECT_EQ(run.err.find("exception"), std::string::npos) << run.err;
    }
}

} // namespace
} // namespace cotan
