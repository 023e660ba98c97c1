// `cotan lint` as users run it: models of known layout, exit codes, one-line errors.
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "quad_model.hpp"
#include "run_tool.hpp"
#include "test_data.hpp"

namespace cotan {
namespace {

using namespace test;
using nlohmann::json;

json lintJson(const std::string& file)
{
    TemporaryFolder folder;
    const ToolRun run = runTool({"lint", dataFile(file).string(), "--json", "-", "--quiet"}, folder.path());
    EXPECT_EQ(run.code, 0) << run.err;
    return json::parse(run.out, nullptr, false);
}

const json& named(const json& report, const std::string& mesh)
{
    for (const json& p : report["primitives"])
        if (p["mesh"].get<std::string>().find(mesh) != std::string::npos)
            return p;
    ADD_FAILURE() << "no primitive " << mesh;
    return report;
}

TEST(LintCommand, reportMatchesTheUvCases)
{
    COTAN_NEEDS_DATA("synthetic/uv_cases.gltf");
    const json r = lintJson("synthetic/uv_cases.gltf");
    ASSERT_EQ(r["primitives"].size(), 16u);
    const auto uv = [&](const char* mesh, const char* what) { return named(r, mesh)["uv"][what].get<double>(); };
    for (const char* mirrored : {"mirrored_u", "mirrored_v", "node_negative_x"})
        EXPECT_NEAR(uv(mirrored, "mirrored"), 1, 1e-9) << mirrored;
    for (const char* plain : {"identity", "rotated30", "mirrored_both", "tiled3", "node_rotated"})
        EXPECT_EQ(uv(plain, "mirrored"), 0) << plain;
    for (const char* degenerate : {"degenerate_line", "degenerate_point"})
        EXPECT_NEAR(uv(degenerate, "degenerate"), 1, 1e-9) << degenerate;
    EXPECT_NEAR(named(r, "stretched4")["uv"]["stretch"]["mean"].get<double>(), 4, 1e-3);
    EXPECT_NEAR(uv("sheared", "sheared"), 1, 1e-9);
    EXPECT_EQ(uv("stretched4", "sheared"), 0);
    EXPECT_LT(named(r, "identity")["read_with"]["cotangent"]["maximum"].get<double>(), 1e-3);
    EXPECT_GT(named(r, "stretched4")["read_with"]["cotangent"]["mean"].get<double>(), 5);
    EXPECT_TRUE(r["maps"][0]["decided"].get<bool>());
    EXPECT_TRUE(r["maps"][0]["as_declared"].get<bool>()); // the map has the convention that the file declares
}

// w is wrong almost everywhere, and green of the maps points down.
TEST(LintCommand, sketchfabCatHasReversedHandednessAndGreenThatCancelOut)
{
    COTAN_NEEDS_DATA("models/SketchfabCat/scene.gltf");
    const json r = lintJson("models/SketchfabCat/scene.gltf");
    for (const json& p : r["primitives"])
        if (p.contains("stored_tangents") && p["uv"]["degenerate"] == 0) {
            EXPECT_GT(p["stored_tangents"]["reversed_w"].get<double>(), 0.9) << p["mesh"];
        }
    for (const json& m : r["maps"])
        EXPECT_TRUE(m["decided"].get<bool>() && !m["as_declared"].get<bool>()) << m.dump();
    EXPECT_NE(r["recommendation"].get<std::string>().find("together they cancel out"), std::string::npos);
    EXPECT_EQ(r["run"].get<std::string>().find("generated"), std::string::npos);
}

// Its TANGENTs are those of MikkTSpace; its quads are mirrored.
TEST(LintCommand, normalTangentMirrorTestAgreesWithItsStoredTangents)
{
    COTAN_NEEDS_DATA("models/NormalTangentMirrorTest/NormalTangentMirrorTest.glb");
    const json r = lintJson("models/NormalTangentMirrorTest/NormalTangentMirrorTest.glb");
    const json& p = r["primitives"][0];
    EXPECT_LT(p["read_with"]["stored"]["maximum"].get<double>(), 0.002);
    EXPECT_EQ(p["stored_tangents"]["reversed_w"].get<double>(), 0);
    EXPECT_GT(p["uv"]["mirrored"].get<double>(), 0.1);
    EXPECT_NE(r["recommendation"].get<std::string>().find("orthonormal"), std::string::npos);
}

TEST(LintCommand, flightHelmetAndBoomBoxNeedNoConversion)
{
    for (const char* file : {"models/FlightHelmet/FlightHelmet.gltf", "models/BoomBox/BoomBox.gltf"}) {
        COTAN_NEEDS_DATA(file);
        const json r = lintJson(file);
        EXPECT_NE(r["recommendation"].get<std::string>().find("frame orthonormal"), std::string::npos) << file;
        for (const json& m : r["maps"])
            EXPECT_TRUE(!m["decided"].get<bool>() || m["as_declared"].get<bool>()) << m.dump();
    }
}

// Without a normalTexture, glTF requires them in any case.
TEST(LintCommand, anisotropyKeepsTangentsOfAnotherDirection)
{
    for (const auto& [elsewhere, mapped] : {std::pair(false, false), {false, true}, {true, false}, {true, true}}) {
        TemporaryFolder folder;
        Made m = quad(1);
        m.root["extensionsUsed"] = {"KHR_materials_anisotropy"};
        if (!mapped)
            m.root["materials"][0].erase("normalTexture");
        m.root["materials"][0]["extensions"]["KHR_materials_anisotropy"]["anisotropyStrength"] = 1;
        if (elsewhere)
            rotateTangents(m, 30);
        write(m, folder.path());
        const std::string text =
            json::parse(runTool({"lint", "quad.gltf", "--json", "-"}, folder.path()).out)["recommendation"];
        EXPECT_EQ(text.find("for them: relief (KHR_materials_anisotropy)") != std::string::npos, elsewhere || !mapped)
            << text;
        EXPECT_EQ(text.find("can be dropped"), std::string::npos) << text;
    }
}

// The map of a clear coat counts among those that `convert` would change.
TEST(LintCommand, aCoatsMapIsJudgedToo)
{
    TemporaryFolder folder;
    Made m = quad(2);
    addCoat(m, {{"index", 1}});
    m.root["materials"][0].erase("normalTexture");
    write(m, folder.path());
    const json alone = json::parse(runTool({"lint", "quad.gltf", "--json", "-"}, folder.path()).out);
    EXPECT_NE(alone["recommendation"].get<std::string>().find("Only clear coats"), std::string::npos) << alone;
    m.root["materials"][0]["normalTexture"] = {{"index", 0}};
    write(m, folder.path());
    const json both = json::parse(runTool({"lint", "quad.gltf", "--json", "-"}, folder.path()).out);
    ASSERT_EQ(both["fits"].size(), 2u) << both;
    EXPECT_EQ(both["fits"][0]["cotangent"], both["fits"][1]["cotangent"]);
}

TEST(LintCommand, exceededLimitExitsWith5)
{
    COTAN_NEEDS_DATA("synthetic/uv_cases.gltf");
    const std::string model = dataFile("synthetic/uv_cases.gltf").string();
    TemporaryFolder folder;
    const ToolRun over = runTool({"lint", model, "--limit", "1", "--frame", "cotangent", "--quiet"}, folder.path());
    EXPECT_EQ(over.code, 5);
    EXPECT_EQ(lines(over.err), 1) << over.err;
    EXPECT_NE(over.err.find("limit 1"), std::string::npos) << over.err;
    EXPECT_EQ(
        runTool({"lint", model, "--strict", "--limit", "1", "--frame", "cotangent", "--quiet"}, folder.path()).code, 5);
    EXPECT_EQ(runTool({"lint", model, "--limit", "60", "--quiet"}, folder.path()).code, 0);
    // `sheared` reads like a square with orthonormal; `tiny` covers 4e-8 of the map, and its rounding is 0.8.
    EXPECT_EQ(runTool({"lint", model, "--limit", "1", "--quiet"}, folder.path()).code, 0); // orthonormal is the default
    EXPECT_EQ(runTool({"lint", model, "--limit-area", "5", "--quiet"}, folder.path()).code, 5);
    EXPECT_EQ(runTool({"lint", model, "--quiet"}, folder.path()).code, 0);
}

TEST(LintCommand, reportOfACheckListsFailuresWithValues)
{
    TemporaryFolder folder;
    write(quad(2), folder.path());
    const auto checked = [&](std::vector<std::string> words, int code) {
        words.insert(words.begin(), {"lint", "quad.gltf", "--json", "-", "--quiet"});
        const ToolRun run = runTool(words, folder.path());
        EXPECT_EQ(run.code, code) << run.err;
        return json::parse(run.out);
    };
    EXPECT_TRUE(checked({}, 0)["check"].is_null());
    const json passed = checked({"--limit", "90"}, 0)["check"];
    EXPECT_EQ(passed,
              (json{{"passed", true},
                    {"limit", 90.0},
                    {"limit_area", nullptr},
                    {"frame", "orthonormal"},
                    {"failures", json::array()}}));
    const json report = checked({"--limit", "1", "--limit-area", "3", "--frame", "cotangent"}, 5);
    const json failed = report["check"], over = report["over_limit"];
    ASSERT_EQ(over.size(), 1u) << over;
    EXPECT_EQ(over[0]["mesh"], "quad");
    EXPECT_GT(over[0]["degrees"].get<double>(), 1);
    EXPECT_EQ(over[0]["limit"], 1.0);
    EXPECT_TRUE(over[0]["percent"].is_null() && over[0]["map"].is_null()) << over;
    EXPECT_FALSE(failed["passed"].get<bool>());
    EXPECT_EQ(failed["limit_area"], 3.0);
    ASSERT_EQ(failed["failures"].size(), 1u) << failed; // stretch 2: cotangent differs, the uv are valid
    EXPECT_EQ(failed["failures"][0]["kind"], "reading");
    EXPECT_GT(failed["failures"][0]["value"].get<double>(), 1);
    EXPECT_EQ(failed["failures"][0]["limit"], 1.0);
}

TEST(LintCommand, reversedGreenWarnsAndFailsACheck)
{
    TemporaryFolder folder;
    write(quad(1), folder.path());
    ASSERT_EQ(runTool({"lint", "quad.gltf", "--limit", "5", "--quiet"}, folder.path()).code, 0);
    ASSERT_EQ(
        runTool({"map", "convert", "waves.png", "--from", "gltf", "--to", "directx", "-o", "down.png"}, folder.path())
            .code,
        0);
    std::filesystem::rename(folder.path() / "down.png", folder.path() / "waves.png");
    const ToolRun plain = runTool({"lint", "quad.gltf", "--json", "-", "--quiet"}, folder.path());
    EXPECT_EQ(plain.code, 0) << plain.err;
    const json warnings = json::parse(plain.out)["warnings"];
    ASSERT_EQ(warnings.size(), 1u) << warnings;
    EXPECT_NE(warnings[0].get<std::string>().find("green points opposite to"), std::string::npos) << warnings;
    for (const char* limit : {"--limit", "--limit-area"}) {
        const ToolRun run = runTool({"lint", "quad.gltf", limit, "50", "--quiet"}, folder.path());
        EXPECT_EQ(run.code, 5) << limit;
        EXPECT_NE(run.err.find("green points opposite to"), std::string::npos) << run.err;
    }
}

// Mean over the pixels of one view of the degrees between MikkTSpace and `frame`. Sampled at nearest texels, since lint
// looks at the map itself.
double measured(const std::string& model, const std::string& frame, const std::filesystem::path& folder)
{
    const ToolRun run = runTool({"compare", model, "--frames", "mikktspace," + frame, "--tangents", "generated",
                                 "--point-sampled", "--samples", "1", "--no-shadows", "--size", "160x160", "--device",
                                 "reference", "-o", "seen", "--json", "-", "--quiet"},
                                folder, 120);
    EXPECT_EQ(run.code, 0) << run.err;
    return json::parse(run.out)["normals"]["mean_degrees"].get<double>();
}

TEST(LintCommand, predictionForAFlatPatchEqualsCompare)
{
    TemporaryFolder folder;
    write(quad(2), folder.path());
    const ToolRun run = runTool({"lint", "quad.gltf", "--json", "-", "--quiet"}, folder.path());
    const double predicted = json::parse(run.out)["primitives"][0]["read_with"]["cotangent"]["mean"].get<double>();
    // The whole quad is seen at one distance: the mean over 4096 points equals that over about 10^4 pixels.
    EXPECT_NEAR(measured("quad.gltf", "cotangent", folder.path()) / predicted, 1, 0.03);
}

// One view sees only a part of a model, foreshortened: a factor of two either way, three where half of the model is
// only seen from behind. The errors of these models range over a factor of 80.
TEST(LintCommand, predictionsForModelsAgreeWithCompare)
{
    const struct {
        const char *file, *frame;
        double factor;
    } cases[] = {{"models/FlightHelmet/FlightHelmet.gltf", "orthonormal", 2},
                 {"models/BoomBox/BoomBox.gltf", "cotangent", 2},
                 {"models/BoomBox/BoomBox.gltf", "triangle", 2},
                 {"models/SketchfabCat/scene.gltf", "cotangent", 2},
                 {"models/NormalTangentMirrorTest/NormalTangentMirrorTest.glb", "cotangent", 3}};
    for (const auto& [file, frame, factor] : cases) {
        COTAN_NEEDS_DATA(file);
        double area = 0, sum = 0;
        const json report = lintJson(file);
        for (const json& p : report["primitives"])
            if (p.contains("read_with") && !p["read_with"][frame]["mean"].is_null()) {
                area += p["uv"]["area"].get<double>();
                sum += p["uv"]["area"].get<double>() * p["read_with"][frame]["mean"].get<double>();
            }
        TemporaryFolder folder;
        const double ratio = measured(dataFile(file).string(), frame, folder.path()) / (sum / area);
        EXPECT_GT(ratio, 1 / factor) << file;
        EXPECT_LT(ratio, factor) << file;
        RecordProperty(file, fmt::format("{:.3f}", ratio));
    }
}

TEST(LintCommand, badInputGetsOneClearLine)
{
    TemporaryFolder folder;
    const std::string model = dataFile("synthetic/uv_cases.gltf").string();
    const struct {
        std::vector<std::string> words;
        int code;
    } cases[] = {
        {{"lint"}, 1},
        {{"lint", "missing.gltf"}, 2},
        {{"lint", model, "--strict"}, 1},
        {{"lint", model, "--distance", "-1"}, 1},
        {{"lint", model, "--distance", "nan"}, 1},
        {{"lint", model, "--limit", "inf"}, 1},
        {{"lint", model, "--limit-area", "101"}, 1},
        {{"lint", model, "-o", "out"}, 1},
        {{"lint", model, "--quiet", "--json", "no/such/folder/r.json"}, 4},
    };
    for (const auto& c : cases) {
        if (c.words.size() > 1 && c.words[1] == model && !std::filesystem::exists(model))
            continue;
        const ToolRun run = runTool(c.words, folder.path());
        EXPECT_EQ(run.code, c.code) << fmt::format("{}", fmt::join(c.words, " ")) << run.err;
        EXPECT_EQ(lines(run.err), 1) << run.err;
    }
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

} // namespace
} // namespace cotan
