// The command `cotan tangents`: verdicts on tangents stored in models, and errors.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "expected_list.hpp"
#include "run_tool.hpp"

namespace cotan {
namespace {

using namespace test;
using nlohmann::json;

// The command's JSON report on a model of the test data.
json reportOn(const std::string& model, const std::vector<std::string>& options = {})
{
    TemporaryFolder folder;
    std::vector<std::string> words{"tangents", dataFile(model).string(), "--json", "-"};
    words.insert(words.end(), options.begin(), options.end());
    const ToolRun run = runTool(words, folder.path());
    EXPECT_EQ(run.code, 0) << run.err;
    return json::parse(run.out);
}

struct Verdict {
    const char* model;
    const char* verdict;
};

class TangentVerdicts : public ::testing::TestWithParam<Verdict> {};

// The expected verdicts come from the list that accompanies the models.
TEST_P(TangentVerdicts, matchTheKnownVerdicts)
{
    COTAN_NEEDS_DATA(GetParam().model);
    const json report = reportOn(GetParam().model);
    EXPECT_EQ(report["whole"]["verdict"], GetParam().verdict) << report["model_verdict"];
}

INSTANTIATE_TEST_SUITE_P(
    Models, TangentVerdicts,
    ::testing::Values(Verdict{"models/NormalTangentMirrorTest/NormalTangentMirrorTest.glb", "equal"},
                      Verdict{"models/ClearCoatTest/ClearCoatTest.glb", "equal"},
                      Verdict{"models/FlightHelmet/FlightHelmet.gltf", "off"},
                      Verdict{"models/SketchfabCat/scene.gltf", "w inverted"},
                      Verdict{"models/TwoSidedPlane/TwoSidedPlane.glb", "w inverted"},
                      Verdict{"models/MultiUVTest/MultiUVTest.glb", "half reversed"}),
    [](const auto& v) { return std::filesystem::path(v.param.model).parent_path().filename().string(); });

// Expected values from the model's description: median 0.35 degrees (rounded), 99 % within 10 degrees. The 99th
// percentile is 10.4 degrees here. scripts/test-data turns the tangents of its model by 0.35 degrees, some by 9.
TEST(TangentVerdicts, measureTheErrorOfFlightHelmet)
{
    COTAN_NEEDS_DATA("models/FlightHelmet/FlightHelmet.gltf");
    const json report = reportOn("models/FlightHelmet/FlightHelmet.gltf");
    EXPECT_NEAR(report["whole"]["directions"]["median_degrees"].get<double>(), 0.35, 0.005);
    EXPECT_LT(report["whole"]["directions"]["percentile99_degrees"].get<double>(), 11);
    EXPECT_LT(report["whole"]["w_different"].get<double>(), 0.001);
}

// A plane with perpendicular texture axes has a frame everywhere and no shear.
TEST(TangentsCommand, saysWhichPrimitivesNeedTheirTangentsAsConvertDecides)
{
    TemporaryFolder folder;
    for (const char* model : {"models/SketchfabCat/scene.gltf", "models/FlightHelmet/FlightHelmet.gltf"}) {
        COTAN_NEEDS_DATA(model);
        const json report = reportOn(model);
        const ToolRun converted = runTool({"convert", dataFile(model).string(), "-o", (folder / "out.glb").string(),
                                           "--overwrite", "--json", "-", "--quiet"},
                                          folder.path());
        ASSERT_EQ(converted.code, 0) << converted.err;
        ASSERT_GT(report["decisions"].size(), 3u);
        EXPECT_EQ(report["decisions"], json::parse(converted.out)["decisions"]) << model;
        const ToolRun said = runTool({"tangents", dataFile(model).string()}, folder.path());
        for (const json& d : report["decisions"])
            EXPECT_NE(said.out.find("its normal map: " + d["text"].get<std::string>()), std::string::npos) << d.dump();
    }
}

TEST(TangentsCommand, reportsOnSmoothCotangents)
{
    COTAN_NEEDS_DATA("models/TwoSidedPlane/TwoSidedPlane.glb");
    const json report = reportOn("models/TwoSidedPlane/TwoSidedPlane.glb", {"--frame", "smooth"});
    EXPECT_EQ(report["primitives"][0]["without_frame"], 0);
    // only rounding errors of float
    EXPECT_LT(report["primitives"][0]["shear"]["max_degrees"].get<double>(), 1e-3);
}

std::string triangleText()
{
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2}}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5126,"count":3,"type":"VEC3"},
{"bufferView":2,"componentType":5126,"count":3,"type":"VEC2"}],
"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":36},
{"buffer":0,"byteOffset":72,"byteLength":24}],
"buffers":[{"byteLength":96,"uri":"triangle.bin"}]})";
}

std::string writeTriangle(const TemporaryFolder& folder)
{
    std::ofstream(folder / "model.gltf") << triangleText();
    const float data[24] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
    std::ofstream(folder / "triangle.bin", std::ios::binary).write(reinterpret_cast<const char*>(data), sizeof data);
    return (folder / "model.gltf").string();
}

TEST(TangentsCommand, errorsAreOneLineWithTheirExitCode)
{
    TemporaryFolder folder;
    const std::string model = writeTriangle(folder);
    std::ofstream(folder / "model.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    const std::vector<std::pair<std::vector<std::string>, int>> cases = {
        {{model, "--frame", "smooth", "-o", "out.glb"}, 1},
        {{model, "--frame", "gradient"}, 1},
        {{model, "--replace"}, 1},
        {{model, "-o", "out.obj"}, 1},
        {{"missing.gltf"}, 2},
        {{"model.obj"}, 1}, // its content is not parsed as JSON
        {{model, "-o", "no-such-folder/out.glb"}, 4},
    };
    for (auto [words, code] : cases) {
        words.insert(words.begin(), "tangents");
        const ToolRun run = runTool(words, folder.path());
        EXPECT_EQ(run.code, code) << run.err;
        EXPECT_EQ(lines(run.err), 1) << run.err;
        EXPECT_FALSE(std::filesystem::exists(folder / "out.glb"));
        EXPECT_EQ(run.err.find("json.exception"), std::string::npos) << run.err;
    }
}

TEST(TangentsCommand, acceptsUppercaseExtensions)
{
    TemporaryFolder folder;
    std::filesystem::rename(writeTriangle(folder), folder / "MODEL.GLTF");
    const ToolRun run = runTool({"tangents", "MODEL.GLTF"}, folder.path());
    EXPECT_EQ(run.code, 0) << run.err;
}

TEST(TangentsCommand, bytesDoNotDependOnTheNumberOfThreads)
{
    COTAN_NEEDS_DATA("models/AnisotropyStrengthTest/AnisotropyStrengthTest.glb");
    const auto model = dataFile("models/AnisotropyStrengthTest/AnisotropyStrengthTest.glb");
    TemporaryFolder folder;
    for (const char* const threads : {"1", "2", "7"}) {
        const ToolRun run = runTool(
            {"tangents", model.string(), "--replace", "--threads", threads, "-o", std::string(threads) + ".glb"},
            folder.path());
        EXPECT_EQ(run.code, 0) << run.err;
    }
    EXPECT_EQ(readWhole(folder / "1.glb"), readWhole(folder / "2.glb"));
    EXPECT_EQ(readWhole(folder / "1.glb"), readWhole(folder / "7.glb"));
}

class TangentsBadInput : public ::testing::TestWithParam<const char*> {};

// Malformed and hostile files give one clear line and no output, or a written model.
TEST_P(TangentsBadInput, givesTheListedVerdict)
{
    COTAN_NEEDS_DATA("bad/EXPECTED.tsv");
    const auto rows = expectedFor(GetParam());
    for (const Expected& row : rows) {
        SCOPED_TRACE(row.file.string());
        TemporaryFolder folder;
        const ToolRun run = runTool({"tangents", row.file.string(), "-o", "out.glb", "--replace"}, folder.path(),
                                    unsigned(4 * kBadInputSeconds));
        EXPECT_TRUE(run.code == 0 || run.code == 2) << run.code << " " << run.err;
        if (row.verdict == "reject") {
            EXPECT_EQ(run.code, 2);
        }
        if (row.verdict == "accept") {
            EXPECT_EQ(run.code, 0) << run.err;
        }
        if (run.code != 0) {
            EXPECT_EQ(lines(run.err), 1) << run.err;
        }
        EXPECT_EQ(std::filesystem::exists(folder / "out.glb"), run.code == 0);
        EXPECT_TRUE(run.code == 0 || std::filesystem::is_empty(folder.path()));
        EXPECT_LT(run.seconds, kBadInputSeconds);
        EXPECT_LT(run.megabytes, 1024.0);
    }
}

INSTANTIATE_TEST_SUITE_P(Files, TangentsBadInput, ::testing::Values(".gltf", ".glb"),
                         [](const auto& extension) { return std::string(extension.param + 1); });

} // namespace
} // namespace cotan
