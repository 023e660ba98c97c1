// What pages say of models, compared with what the tool prints of them now. Only published models have the numbers of
// pages.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "run_tool.hpp"
#include "test_data.hpp"

namespace cotan::test {
namespace {

namespace fs = std::filesystem;

// A page, or with whitespace folded, so that phrases are found across line breaks.
std::string pageOf(const char* file) { return readWhole(fs::path(COTAN_SOURCE_DIR) / file); }
std::string foldedPage(const char* file) { return std::regex_replace(pageOf(file), std::regex("\\s+"), " "); }

constexpr const char *kHelmet = "models/FlightHelmet/FlightHelmet.gltf", *kBox = "models/BoomBox/BoomBox.gltf",
                     *kCat = "models/SketchfabCat/scene.gltf", *kPlane = "models/TwoSidedPlane/TwoSidedPlane.glb",
                     *kMirror = "models/NormalTangentMirrorTest/NormalTangentMirrorTest.glb";

// The numbers of `cotan lint`: means over the area of all primitives.
struct Linted {
    double orthonormal = 0, cotangent = 0, reversedW = 0, steps = 0;
    double worstOrthonormal = 0; // of a primitive
    bool greenDecided = false, greenReversed = false;
    std::string choice; // the columns of a table: frames, primitives without tangents, the worst mean of these
};

// What lint decides for the primitives with a normal map.
std::string choiceOf(const nlohmann::json& decisions)
{
    std::set<std::string> frames;
    std::size_t all = 0, dropping = 0;
    double worst = 0;
    for (const auto& d : decisions) {
        if (d["reason"] == "no_map")
            continue;
        ++all;
        if (d["tangents_stay"])
            continue;
        ++dropping;
        frames.insert(d["frame"]);
        for (const auto& c : d["candidates"])
            if (c["frame"] == d["frame"] && !c["stored"])
                worst = std::max(worst, c["mean"].get<double>());
    }
    return fmt::format("{} | {} of {} | {:.2f}", fmt::join(frames, ", "), dropping, all, worst);
}

Linted lint(const std::string& model)
{
    const TemporaryFolder folder;
    const ToolRun run = runTool({"lint", dataFile(model).string(), "--quiet", "--json", "r.json"}, folder.path());
    EXPECT_EQ(run.code, 0) << run.err;
    const auto report = nlohmann::json::parse(readWhole(folder / "r.json"));
    Linted found;
    double area = 0;
    for (const auto& primitive : report["primitives"]) {
        if (!primitive.contains("read_with")) // has no normal map
            continue;
        const double weight = primitive["uv"]["area"], mean = primitive["read_with"]["orthonormal"]["mean"];
        area += weight;
        found.orthonormal += weight * mean;
        found.cotangent += weight * primitive["read_with"]["cotangent"]["mean"].get<double>();
        found.steps += weight * primitive["edge_steps"]["cotangent"]["percentile95"].get<double>();
        found.worstOrthonormal = std::max(found.worstOrthonormal, mean);
        if (primitive.contains("stored_tangents"))
            found.reversedW += weight * primitive["stored_tangents"]["reversed_w"].get<double>();
    }
    for (double* sum : {&found.orthonormal, &found.cotangent, &found.reversedW, &found.steps})
        *sum /= area;
    for (const auto& map : report["maps"]) {
        found.greenDecided = found.greenDecided || map["decided"].get<bool>();
        found.greenReversed = found.greenReversed || (map["decided"].get<bool>() && !map["as_declared"].get<bool>());
    }
    found.choice = choiceOf(report["decisions"]);
    return found;
}

void expectSays(const char* file, const std::string& phrase)
{
    EXPECT_NE(foldedPage(file).find(phrase), std::string::npos) << file << " should say: " << phrase;
}

TEST(DocumentsOfModels, pagesGiveTheNumbersThatLintPrints)
{
    COTAN_NEEDS_DATA("models");
    constexpr const char *kRemove = "docs/how-to/remove-tangents.md", *kBaking = "docs/explanation/baking.md";
    if (isOriginal(kHelmet)) {
        const Linted found = lint(kHelmet);
        expectSays(kRemove, fmt::format("| 1.0 degree from MikkTSpace | {} |", found.choice));
        expectSays(kBaking,
                   fmt::format("`lint` predicts {:.2f} for `orthonormal`, and {:.2f} for its MetalParts.",
                               found.orthonormal, found.worstOrthonormal));
    }
    if (isOriginal(kBox)) {
        const Linted found = lint(kBox);
        expectSays(kRemove, fmt::format("| none | {} |", found.choice));
        expectSays(kBaking,
                   fmt::format("`lint` predicts {:.2f} for `orthonormal` and {:.2f} for `cotangent`.",
                               found.orthonormal, found.cotangent));
    }
    if (isOriginal(kCat)) {
        const Linted found = lint(kCat);
        expectSays(kRemove, fmt::format("w inverted on 98.9 %, green reversed too | {} |", found.choice));
        expectSays(kBaking,
                   fmt::format("For `cotangent`, `lint` predicts {:.2f}, with steps of {:.0f} degrees", found.cotangent,
                               found.steps));
    }
    if (isOriginal(kPlane)) {
        expectSays(kRemove, fmt::format("| w inverted, green reversed too | {} |", lint(kPlane).choice));
    }
    if (isOriginal(kMirror)) {
        EXPECT_LT(lint(kMirror).orthonormal, 0.005);
        expectSays(kBaking, "`lint` predicts below 0.005 for `orthonormal`.");
    }
}

TEST(DocumentsOfModels, theTableOfThreeNamesTheFaultsThatLintFinds)
{
    COTAN_NEEDS_DATA("models");
    const std::string page = pageOf("examples/three/README.md");
    const std::pair<const char*, const char*> rows[] = {
        {"SketchfabCat", kCat},
        {"lumberjack", "animated/lumberjack.glb"},
        {"chess board", "compressed/chess_board_draco.glb"},
        {"jet fighter", "compressed/jet_fighter_draco_basisu.glb"},
        {"TwoSidedPlane", kPlane},
        {"NormalTangentMirrorTest", kMirror},
    };
    for (const auto& [name, file] : rows) {
        if (!isOriginal(file))
            continue;
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
