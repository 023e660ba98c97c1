// Three.js as an independent reference for predictions of `lint` (the error of normals if a model's maps are read
// without tangents) and for the maps that `convert` writes.
#include <gtest/gtest.h>

#include <cmath>

#include <fmt/format.h>

#include "cotan/lint.hpp"
#include "examples_browser.hpp"
#include "models.hpp"

namespace cotan::test {
namespace {

using nlohmann::json;

// Report of tests/three_judge.html.in on the cases; a string with the reason if the page cannot run.
json judged(const json& cases, int side)
{
    if (!std::filesystem::exists(COTAN_NPM "/node_modules/three"))
        return "three is not installed (see the test npm_packages)";
    TemporaryFolder folder;
    std::string page = readWhole(COTAN_SOURCE_DIR "/tests/three_judge.html.in");
    put(page, "MODULES_URL", "file://" COTAN_NPM "/node_modules");
    put(page, "SOURCES_URL", "file://" COTAN_SOURCE_DIR);
    put(page, "TESTS_URL", "file://" COTAN_SOURCE_DIR "/tests");
    put(page, "CASES", cases.dump());
    put(page, "SIZE", std::to_string(side));
    write(folder / "three_judge.html", page);
    const json found = showPages(folder, {"three_judge.html"}, 280);
    return found.value("three_judge", found);
}

std::string urlOf(const char* file) { return "file://" + std::filesystem::canonical(dataFile(file)).string(); }

// Mean error that lint predicts over all primitives, weighted by area and by the number of points that count.
double predicted(const LintReport& report, const std::string& frame)
{
    double sum = 0, area = 0;
    for (const PrimitiveLint& p : report.primitives)
        for (const Reading& r : p.readings)
            if (r.name == frame && r.error.count > 0) {
                const double seen = p.uv.area * double(r.error.count);
                area += seen;
                sum += seen * r.error.mean;
            }
    return sum / area;
}

struct Judged {
    const char* file;
    int side; // width and height of the page's images in pixels, smaller for models with many meshes
};

std::ostream& operator<<(std::ostream& out, const Judged& model) { return out << model.file; }

class ThreeJudge : public testing::TestWithParam<Judged> {};

// Prediction and measurement agree within a factor of 1.3. Below 0.05 degrees errors are invisible, and flat texels,
// which three.js decodes as 2c - 1, dominate them.
TEST_P(ThreeJudge, measuresWhatLintPredicts)
{
    const auto& [file, side] = GetParam();
    COTAN_NEEDS_DATA(file);
    const json pairs = json::parse(R"([["meant", "dropped"], ["meant", "orthonormal"]])");
    const json model = {{"name", "model"}, {"url", urlOf(file)}, {"pairs", pairs}};
    const json page = judged(json::array({model}), side);
    if (page.is_string())
        GTEST_SKIP() << page.get<std::string>();
    ASSERT_TRUE(page.contains("model") && !page["model"].contains("error")) << page.dump();
    const LintReport report = lintScene(loadModel(file));
    for (const auto& [frame, variant] : {std::pair("cotangent", "dropped"), std::pair("orthonormal", "orthonormal")}) {
        const json& seen = page["model"][std::string("meant / ") + variant];
        ASSERT_GT(seen["count"].get<int>(), 1000) << frame;
        const double measured = seen["mean"].get<double>(), expected = predicted(report, frame);
        std::printf("| %s | %s | %.3f | %.3f |\n", file, frame, expected, measured);
        if (measured < 0.05 && expected < 0.05)
            continue;
        EXPECT_GT(measured / expected, 1 / 1.3) << frame << ": predicted " << expected << ", measured " << measured;
        EXPECT_LT(measured / expected, 1.3) << frame << ": predicted " << expected << ", measured " << measured;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Models, ThreeJudge,
    testing::Values(Judged{"models/BoomBox/BoomBox.gltf", 192}, Judged{"models/ClearCoatTest/ClearCoatTest.glb", 256},
                    Judged{"models/FlightHelmet/FlightHelmet.gltf", 128},
                    Judged{"models/GlamVelvetSofa/GlamVelvetSofa.glb", 192},
                    Judged{"models/NormalTangentMirrorTest/NormalTangentMirrorTest.glb", 192},
                    Judged{"models/NormalTangentTest/NormalTangentTest.glb", 192},
                    Judged{"models/SketchfabCat/scene.gltf", 64}, Judged{"models/TwoSidedPlane/TwoSidedPlane.glb", 192},
                    Judged{"animated/lumberjack.glb", 192}, Judged{"compressed/chess_board_draco.glb", 96},
                    Judged{"synthetic/uv_cases.gltf", 48}, Judged{"synthetic/uv_cases_tangents.gltf", 48}),
    [](const auto& model) {
        return std::filesystem::path(model.param.file).parent_path().stem().string() + "_"
            + std::filesystem::path(model.param.file).stem().string();
    });

// Converted maps in an engine that decodes 2c - 1, compared with the original. Maps made for 2c - 1 are read more
// accurately than it; in others every flat texel is tilted by 0.45 degrees where green was inverted.
TEST(ThreeJudgeOfConvertedMaps, readsThemLikeTheOriginals)
{
    constexpr const char* kModel = "compressed/chess_board_draco.glb";
    COTAN_NEEDS_DATA(kModel);
    TemporaryFolder folder;
    json pairs = json::parse(R"([["meant", "dropped"]])");
    for (const char* expansion : {"biased", "exact"}) {
        const std::string file = std::string(expansion) + ".glb";
        const ToolRun made = runTool({"convert", dataFile(kModel).string(), "--to-frame", "cotangent", "--unsigned",
                                      expansion, "-o", file, "--quiet"},
                                     folder.path(), 120);
        ASSERT_EQ(made.code, 0) << made.err;
        pairs.push_back({"meant", "dropped of file://" + (folder / file).string()});
    }
    const json chess = {{"name", "chess"}, {"url", urlOf(kModel)}, {"pairs", pairs}};
    const json page = judged(json::array({chess}), 64);
    if (page.is_string())
        GTEST_SKIP() << page.get<std::string>();
    ASSERT_TRUE(page.contains("chess") && !page["chess"].contains("error")) << page.dump().substr(0, 400);
    const auto mean = [&](std::size_t k) {
        return page["chess"][pairs[k][0].get<std::string>() + " / " + pairs[k][1].get<std::string>()]["mean"]
            .get<double>();
    };
    if (isOriginal(kModel)) {        // whose new maps are PNG
        EXPECT_LT(mean(1), mean(0)); // otherwise converting would be pointless
        EXPECT_LT(mean(1), 0.14);
        EXPECT_GT(mean(2), 0.35); // JPEG keeps the flat texels of `exact`, and adds its own losses
    }
}

// Under nodes that mirror, three.js makes bitangents from a mirrored normal and a mirrored tangent, which inverts them.
// Its frame without tangents inverts the side there, as ours does.
TEST(ThreeJudgeOfMirroredNodes, isWrongOnlyWithTangents)
{
    COTAN_NEEDS_DATA("synthetic/uv_cases_tangents.gltf");
    json stock = {{"name", "stock"}, {"url", urlOf("synthetic/uv_cases_tangents.gltf")}};
    stock["pairs"] = json::parse(R"([["tangents", "dropped"]])");
    json fixed = stock;
    stock["mirrored"] = "as three has them";
    fixed["name"] = "fixed";
    const json page = judged(json::array({stock, fixed}), 48);
    if (page.is_string())
        GTEST_SKIP() << page.get<std::string>();
    ASSERT_TRUE(page.contains("fixed") && !page["stock"].contains("error")) << page.dump().substr(0, 400);
    int mirrored = 0;
    for (const json& mesh : page["stock"]["tangents / dropped"]["meshes"]) {
        const std::string name = mesh["mesh"];
        const bool square = name.find("sheared") == std::string::npos && name.find("stretched") == std::string::npos
            && name.find("nonuniform") == std::string::npos && name.find("tiny") == std::string::npos;
        if (name.find("negative") != std::string::npos) {
            ++mirrored;
            EXPECT_GT(mesh["mean"].get<double>(), 10) << name;
        } else if (square) {
            EXPECT_LT(mesh["mean"].get<double>(), 0.001) << name;
        }
    }
    EXPECT_EQ(mirrored, 2);
    for (const json& mesh : page["fixed"]["tangents / dropped"]["meshes"])
        if (mesh["mesh"].get<std::string>().find("negative") != std::string::npos) {
            EXPECT_LT(mesh["mean"].get<double>(), 0.001) << mesh["mesh"];
        }
}

// The directions of anisotropic highlights, stock three.js with the model's tangents being the judge. The discs are
// flat. On the spheres of 24 segments a direction that is constant on a triangle is wrong by degrees
// (grooves_test.cpp). Without tangents stock three.js takes v for upwards, which mirrors the directions of the discs'
// map: up to 90 degrees.
TEST(ThreeGrooves, areThoseOfStoredTangentsWithoutAny)
{
    const char* const files[] = {"materials/AnisotropyDiscTest.glb",
                                 "models/AnisotropyStrengthTest/AnisotropyStrengthTest.glb"};
    json cases = json::array();
    for (const char* file : files) {
        COTAN_NEEDS_DATA(file);
        cases.push_back({{"name", file}, {"url", urlOf(file)}});
    }
    if (!isOriginal(files[0]))
        GTEST_SKIP() << "discs that scripts/test-data makes have no tangents: stock three.js judges nothing";
    if (!std::filesystem::exists(COTAN_NPM "/node_modules/three"))
        GTEST_SKIP() << "three is not installed (see the test npm_packages)";
    TemporaryFolder folder;
    std::string page = readWhole(COTAN_SOURCE_DIR "/tests/three_grooves.html.in");
    put(page, "MODULES_URL", "file://" COTAN_NPM "/node_modules");
    put(page, "SOURCES_URL", "file://" COTAN_SOURCE_DIR);
    put(page, "TESTS_URL", "file://" COTAN_SOURCE_DIR "/tests");
    put(page, "CASES", cases.dump());
    write(folder / "grooves.html", page);
    const json all = showPages(folder, {"grooves.html"}, 280);
    if (all.is_string())
        GTEST_SKIP() << all.get<std::string>();
    const json found = all.value("grooves", all);
    for (const char* file : files) {
        ASSERT_TRUE(found.contains(file)) << found.dump();
        std::printf("%s: %s\n", file, found[file].dump().c_str());
        for (const char* way : {"dropped", "cotan", "smooth"})
            ASSERT_GT(found[file][way]["count"].get<int>(), 1000) << file << ", " << way;
        EXPECT_LT(found[file]["smooth"]["mean"].get<double>(), 0.1) << file;
        EXPECT_LT(found[file]["cotan"]["mean"].get<double>(), 2.5) << file;
    }
    EXPECT_LT(found[files[0]]["cotan"]["maximum"].get<double>(), 0.1);
    EXPECT_GT(found[files[0]]["dropped"]["maximum"].get<double>(), 45);
}

} // namespace
} // namespace cotan::test
