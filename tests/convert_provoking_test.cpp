// `cotan convert --provoking` as a user runs it: its report, what it combines with, and how much models grow.
#include <gtest/gtest.h>

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cotan/gpu_meshes.hpp"
#include "cotan/scene.hpp"
#include "quad_model.hpp"
#include "run_tool.hpp"
#include "test_data.hpp"

namespace cotan {
namespace {

using namespace test;
using nlohmann::json;

json provoke(const std::filesystem::path& folder, std::vector<std::string> words)
{
    words.insert(words.begin(), "convert");
    words.insert(words.end(), {"--json", "-", "--quiet"});
    const ToolRun run = runTool(words, folder, 120);
    EXPECT_EQ(run.code, 0) << run.err;
    return json::parse(run.out, nullptr, false);
}

// Formats 6036 as "6,036".
std::string withCommas(std::size_t n)
{
    std::string digits = std::to_string(n);
    for (std::size_t at = digits.size(); at > 3; at -= 3)
        digits.insert(at - 3, ",");
    return digits;
}

// Expects this row in the table of docs/explanation/triangle.md.
void expectDocumented(const std::string& name, std::size_t triangles, std::size_t before, std::size_t after)
{
    const std::string row = fmt::format("| {} | {} | {} | {} | {:.2f} |", name, withCommas(triangles),
                                        withCommas(before), withCommas(after), double(after) / double(before));
    EXPECT_NE(readWhole(COTAN_SOURCE_DIR "/docs/explanation/triangle.md").find(row), std::string::npos)
        << "docs/explanation/triangle.md should say: " << row;
}

TEST(ConvertProvoking, aloneChangesNeitherMapsNorTangentsNorTheRender)
{
    TemporaryFolder folder;
    write(quad(2), folder.path());
    const json r = provoke(folder.path(), {"quad.gltf", "--provoking", "last", "-o", "out.glb"});
    EXPECT_EQ(r["provoking"]["vertex"], "last");
    EXPECT_EQ(r["provoking"]["triangles"], 2);
    EXPECT_EQ(r["provoking"]["vertices_before"], 6);
    EXPECT_EQ(r["provoking"]["vertices_after"], 6);
    EXPECT_EQ(r["provoking"]["growth"], 1);
    EXPECT_EQ(r["provoking"]["primitives"].size(), 1u);
    EXPECT_TRUE(r["maps"].empty());
    EXPECT_FALSE(r.contains("to"));
    // Without the ground, whose shadow is rounded depending on the order of a triangle's corners.
    for (const std::string model : {"quad.gltf", "out.glb"})
        ASSERT_EQ(runTool({"render", model, "-o", model + ".png", "--frame", "mikktspace", "--size", "64x64",
                           "--device", "reference", "--ground", "off", "--quiet"},
                          folder.path())
                      .code,
                  0);
    EXPECT_EQ(readWhole(folder / "quad.gltf.png"), readWhole(folder / "out.glb.png"));
}

TEST(ConvertProvoking, worksTogetherWithAConversionOfTheMaps)
{
    TemporaryFolder folder;
    write(quad(2), folder.path());
    const json r = provoke(folder.path(),
                           {"quad.gltf", "--to-frame", "triangle", "--provoking", "first", "-o", "out.glb", "--verify",
                            "v", "--device", "reference"});
    EXPECT_EQ(r["provoking"]["vertices_after"], 6);
    EXPECT_FALSE(r["maps"][0]["kept"].get<bool>());
    EXPECT_EQ(r["tangents"]["vertices"], 6);                               // dropped
    EXPECT_LT(r["verify"]["degrees"]["mean_degrees"].get<double>(), 0.25); // 8-bit maps
}

TEST(ConvertProvoking, wrongArgumentsGetOneClearLine)
{
    TemporaryFolder folder;
    write(quad(2), folder.path());
    const std::pair<std::vector<std::string>, const char*> cases[] = {
        {{"--provoking", "middle"}, "expected first or last; found 'middle'"},
        {{"--provoking", "first", "--bits", "16"}, "--bits: applies to converted maps only"},
        {{"--provoking", "first", "--verify", "v"}, "--verify: applies to converted maps only"},
        {{"--provoking", "first", "--keep-tangents"}, "--keep-tangents: applies to converted maps only"},
        {{"--provoking", "first", "--from-frame", "smooth"}, "--from-frame: applies to converted maps only"},
        {{"--provoking", "first", "--tangents", "generated"}, "--tangents: applies to converted maps only"},
        {{"--provoking", "first", "--max-degrees", "1"}, "--max-degrees: applies to frames that are chosen"}};
    for (const auto& [words, message] : cases) {
        std::vector<std::string> all = {"convert", "quad.gltf", "-o", "out.glb"};
        all.insert(all.end(), words.begin(), words.end());
        const ToolRun run = runTool(all, folder.path());
        EXPECT_EQ(run.code, 1) << run.err;
        EXPECT_EQ(lines(run.err), 1) << run.err;
        EXPECT_NE(run.err.find(message), std::string::npos) << run.err;
        EXPECT_FALSE(std::filesystem::exists(folder / "out.glb"));
    }
}

// A torus has twice as many triangles as vertices, except for the seams of its uv.
TEST(ConvertProvoking, aClosedShapeGetsAboutOneVertexPerTriangle)
{
    const Mesh torus = makeTorus(1, 0.4f, 48, 4, 2), teapot = makeTeapot(12);
    for (const Mesh* mesh : {&torus, &teapot})
        for (const auto provoking : {ProvokingVertex::first, ProvokingVertex::last}) {
            const std::size_t triangles = mesh->indices.size() / 3;
            const std::size_t after = provokingMesh(mesh->indices, mesh->positions.size(), provoking).sources.size();
            EXPECT_GE(after, triangles);
            EXPECT_LE(after, triangles + triangles / 50);
        }
    expectDocumented("teapot, 12 segments a patch", teapot.indices.size() / 3, teapot.positions.size(),
                     provokingMesh(teapot.indices, teapot.positions.size(), ProvokingVertex::first).sources.size());
}

TEST(ConvertProvoking, modelsGrowAsInTheTableAndPassKhronosValidator)
{
    const std::filesystem::path npm = COTAN_NPM;
    for (const std::string name : {"BoomBox/BoomBox.gltf", "FlightHelmet/FlightHelmet.gltf"}) {
        COTAN_NEEDS_DATA("models/" + name);
        const std::string file = dataFile("models/" + name).string();
        TemporaryFolder folder;
        const json r = provoke(folder.path(), {file, "--provoking", "first", "-o", "out.glb"});
        const json& p = r["provoking"];
        EXPECT_LE(p["vertices_after"].get<std::size_t>(), p["triangles"].get<std::size_t>() * 51 / 50);
        if (isOriginal("models/" + name))
            expectDocumented(name.substr(0, name.find('/')), p["triangles"], p["vertices_before"], p["vertices_after"]);
        if (!std::filesystem::exists(npm / "installed-lock.json"))
            continue; // scripts/npm-packages could not install gltf-validator
        const std::string command = "node '" COTAN_SOURCE_DIR "/tests/npm/validate.mjs' '"
            + (npm / "node_modules").string() + "' '" + (folder / "out.glb").string() + "' > '"
            + (folder / "log").string() + "' 2>&1";
        EXPECT_EQ(std::system(command.c_str()), 0) << readWhole(folder / "log");
    }
}

} // namespace
} // namespace cotan
