// What pages say of models, compared with what the tool prints of them now. Skipped without the models.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <regex>
#include <sstream>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "run_tool.hpp"

namespace cotan::test {
namespace {

namespace fs = std::filesystem;

const fs::path kSources = COTAN_SOURCE_DIR, kData = COTAN_SHARED_DATA;

// A page with whitespace folded, so that phrases are found across line breaks.
std::string pageOf(const char* file) { return std::regex_replace(readWhole(kSources / file), std::regex("\\s+"), " "); }

// The numbers of `cotan lint`: means over the area of all primitives.
struct Linted {
    double orthonormal = 0, cotangent = 0, reversedW = 0;
    double worstOrthonormal = 0; // of a primitive
    bool greenDecided = false, greenReversed = false;
    std::string recommendation;
};

Linted lint(const std::string& model)
{
    const TemporaryFolder folder;
    const ToolRun run = runTool({"lint", (kData / model).string(), "--quiet", "--json", "r.json"}, folder.path());
    EXPECT_EQ(run.code, 0) << run.err;
    const auto report = nlohmann::json::parse(readWhole(folder / "r.json"));
    Linted found;
    double area = 0;
    for (const auto& primitive : report["primitives"]) {
        const double weight = primitive["uv"]["area"], mean = primitive["read_with"]["orthonormal"]["mean"];
        area += weight;
        found.orthonormal += weight * mean;
        found.cotangent += weight * primitive["read_with"]["cotangent"]["mean"].get<double>();
        found.worstOrthonormal = std::max(found.worstOrthonormal, mean);
        if (primitive["stored_tangents"].is_object())
            found.reversedW += weight * primitive["stored_tangents"]["reversed_w"].get<double>();
    }
    for (double* sum : {&found.orthonormal, &found.cotangent, &found.reversedW})
        *sum /= area;
    for (const auto& map : report["maps"]) {
        found.greenDecided = found.greenDecided || map["decided"].get<bool>();
        found.greenReversed = found.greenReversed || (map["decided"].get<bool>() && !map["as_declared"].get<bool>());
    }
    found.recommendation = report["recommendation"];
    return found;
}

void expectSays(const char* file, const std::string& phrase)
{
    EXPECT_NE(pageOf(file).find(phrase), std::string::npos) << file << " should say: " << phrase;
}

TEST(DocumentsOfModels, pagesGiveTheNumbersThatLintPrints)
{
    if (!fs::exists(kData / "models"))
        GTEST_SKIP() << "no models in " << kData;
    constexpr const char *kRemove = "docs/how-to/remove-tangents.md", *kBaking = "docs/explanation/baking.md";
    const Linted helmet = lint("models/FlightHelmet/FlightHelmet.gltf"), box = lint("models/BoomBox/BoomBox.gltf"),
                 cat = lint("models/SketchfabCat/scene.gltf"),
                 mirror = lint("models/NormalTangentMirrorTest/NormalTangentMirrorTest.glb");
    expectSays(kRemove, fmt::format("| 1.0 degree from MikkTSpace | orthonormal {:.2f} |", helmet.orthonormal));
    expectSays(kRemove, fmt::format("| none | orthonormal {:.2f} |", box.orthonormal));
    EXPECT_LT(mirror.orthonormal, 0.005);
    expectSays(kRemove, "| equal | orthonormal below 0.005 |");
    expectSays(kBaking,
               fmt::format("`lint` predicts {:.2f} for `orthonormal`, and {:.2f} for its MetalParts.",
                           helmet.orthonormal, helmet.worstOrthonormal));
    expectSays(kBaking,
               fmt::format("`lint` predicts {:.2f} for `orthonormal` and {:.2f} for `cotangent`.", box.orthonormal,
                           box.cotangent));
    std::smatch steps;
    ASSERT_TRUE(std::regex_search(cat.recommendation, steps, std::regex("steps of (\\d+) degrees")))
        << cat.recommendation;
    expectSays(kRemove, fmt::format("green reversed too; steps of {} |", steps[1].str()));
    expectSays(kBaking,
               fmt::format("For `cotangent`, `lint` predicts {:.2f}, with steps of {} degrees", cat.cotangent,
                           steps[1].str()));
}

TEST(DocumentsOfModels, theTableOfThreeNamesTheFaultsThatLintFinds)
{
    if (!fs::exists(kData / "models"))
        GTEST_SKIP() << "no models in " << kData;
    const std::string page = readWhole(kSources / "examples/three/README.md");
    for (const auto& [name, file] :
         {std::pair("SketchfabCat", "models/SketchfabCat/scene.gltf"),
          {"lumberjack", "animated/lumberjack.glb"},
          {"chess board", "compressed/chess_board_draco.glb"},
          {"jet fighter", "compressed/jet_fighter_draco_basisu.glb"},
          {"TwoSidedPlane", "models/TwoSidedPlane/TwoSidedPlane.glb"},
          {"NormalTangentMirrorTest", "models/NormalTangentMirrorTest/NormalTangentMirrorTest.glb"}}) {
        const Linted found = lint(file);
        const std::string fault = found.reversedW < 0.9 ? "stored"
            : found.greenReversed                       ? "stored, w and green reversed"
            : found.greenDecided                        ? "stored, w reversed, green as declared"
                                                        : "stored, w reversed, green undecidable";
        EXPECT_NE(page.find(fmt::format("\n| {} | {} |", name, fault)), std::string::npos) << name << ": " << fault;
    }
}

} // namespace
} // namespace cotan::test
