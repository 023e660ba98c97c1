// The tool's verdicts as users see them: lint and convert state what could not be judged, convert does what lint
// advises, and a converted .gltf has its images beside it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "cotan/model.hpp"
#include "ktx2_maker.hpp"
#include "quad_model.hpp"
#include "run_tool.hpp"
#include "test_data.hpp"

namespace cotan {
namespace {

using namespace test;
using nlohmann::json;

json jsonOf(std::vector<std::string> words, const std::filesystem::path& folder, int code = 0)
{
    words.insert(words.end(), {"--json", "-", "--quiet"});
    const ToolRun run = runTool(words, folder, 120);
    EXPECT_EQ(run.code, code) << fmt::format("{}\n", fmt::join(words, " ")) << run.err;
    return json::parse(run.out, nullptr, false);
}

bool says(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

// ---- samples between texel centres ----------------------------------------------------------

// A quad of 8 by 1 under a map of one row: u is half as dense as v, v runs from 0.05 to 0.3, and no texel centre is
// inside.
void writeOneRow(const std::filesystem::path& folder, float low = 0.05f, float high = 0.3f)
{
    Made m = quad(8);
    const std::vector<float> uv = {0, high, 1, high, 1, low, 0, high, 1, low, 0, low};
    std::memcpy(m.bytes.data() + (18 + 18 + 24) * sizeof(float), uv.data(), uv.size() * sizeof(float));
    write(m, folder);
    Image row = makeImage(64, 1, PixelType::unorm8, "row");
    for (int x = 0; x < 64; ++x) {
        const std::uint8_t texel[4] = {std::uint8_t(128 + x / 2), std::uint8_t(160 - x), 220, 255};
        std::copy_n(texel, 4, row.bytes8() + 4 * x);
    }
    ASSERT_TRUE(writeImage(folder / "waves.png", row));
}

TEST(Judgement, uvLineBetweenTexelCentresIsConvertedAndMeasured)
{
    TemporaryFolder folder;
    writeOneRow(folder.path());
    const json lint = jsonOf({"lint", "quad.gltf"}, folder.path());
    const double predicted = lint["primitives"][0]["read_with"]["cotangent"]["mean"];
    EXPECT_GT(predicted, 1);
    const json r =
        jsonOf({"convert", "quad.gltf", "--to", "cotangent", "--unsigned", "exact", "-o", "out.glb"}, folder.path());
    const json& map = r["maps"][0];
    EXPECT_FALSE(map["kept"].get<bool>());
    EXPECT_EQ(map["texels_covered"], 0);
    EXPECT_NEAR(map["degrees_unconverted"]["mean"].get<double>(), predicted, 0.01);
    EXPECT_GT(map["degrees_after_rounding"]["count"].get<int>(), 0);
    EXPECT_LT(map["degrees_after_rounding"]["mean"].get<double>(), 0.5); // 8 bits
    EXPECT_TRUE(map["disagreement_degrees"]["mean"].is_null());          // over no texel
}

TEST(Judgement, mapOnNoAreaIsNotJudged)
{
    TemporaryFolder folder;
    writeOneRow(folder.path(), 0.3f, 0.3f); // a line in uv
    const ToolRun run = runTool({"convert", "quad.gltf", "--to", "cotangent", "-o", "out.glb"}, folder.path());
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_TRUE(says(run.out, "not checked")) << run.out;
    EXPECT_FALSE(says(run.out, "0.00")) << run.out;
    const json map = jsonOf({"convert", "quad.gltf", "--to", "cotangent", "-o", "out.glb"}, folder.path())["maps"][0];
    EXPECT_TRUE(map["kept"].get<bool>());
    EXPECT_EQ(map["degrees_unconverted"]["count"], 0);
    EXPECT_TRUE(map["degrees_unconverted"]["mean"].is_null());
    const json lint = jsonOf({"lint", "quad.gltf"}, folder.path());
    EXPECT_EQ(lint["primitives"][0]["not_judged"], "no triangle has an area both in space and in uv");
    EXPECT_TRUE(lint["primitives"][0]["read_with"]["cotangent"]["mean"].is_null());
    EXPECT_EQ(runTool({"lint", "quad.gltf", "--limit", "5", "--quiet"}, folder.path()).code,
              5); // nothing judged proves nothing
    EXPECT_EQ(runTool({"lint", "quad.gltf", "--quiet"}, folder.path()).code, 0);
}

// A map for MikkTSpace that is read so once had an error, that of the frame `exact`. On sheared uv the two differ.
TEST(Judgement, errorsAreMeasuredAgainstTheFrameThatTheMapsAreFor)
{
    TemporaryFolder folder;
    for (const bool stored : {true, false}) {
        Made m = quad(2);
        if (!stored)
            m.root["meshes"][0]["primitives"][0]["attributes"].erase("TANGENT");
        write(m, folder.path());
        const auto errorOf = [&](const std::string& frame) {
            return jsonOf({"render", "quad.gltf", "--view", "error", "--frame", frame, "--device", "reference",
                           "--size", "64x48", "-o", "e.png"},
                          folder.path());
        };
        const json right = errorOf("mikktspace"), other = errorOf("cotangent");
        EXPECT_EQ(right["frame_error_against"], "mikktspace");
        EXPECT_EQ(right["frame_error"]["max_degrees"], 0) << stored;
        EXPECT_EQ(other["frame_error_against"], "mikktspace");
        EXPECT_GT(other["frame_error"]["mean_degrees"], 3) << stored; // slopes along u are half as steep
        m.root["materials"][0]["extras"]["cotanFrame"] = "cotangent";
        write(m, folder.path());
        EXPECT_EQ(errorOf("cotangent")["frame_error_against"], "exact");
        EXPECT_LT(errorOf("cotangent")["frame_error"]["max_degrees"], 0.01) << stored;
        EXPECT_EQ(errorOf("vertex")["frame_error_against"], "exact");
    }
    const json shape = jsonOf(
        {"render", "--shape", "sphere", "--view", "error", "--device", "reference", "--size", "64x48", "-o", "e.png"},
        folder.path());
    EXPECT_EQ(shape["frame_error_against"], "exact");
}

TEST(Judgement, comparisonsWithoutANormalMapHaveNoAverage)
{
    TemporaryFolder folder;
    Made m = quad(2);
    m.root["materials"][0].erase("normalTexture");
    write(m, folder.path());
    const std::vector<std::string> compare = {"compare",  "quad.gltf", "--frames", "cotangent,mikktspace",
                                              "--device", "reference", "--size",   "64x48",
                                              "-o",       "c"};
    const ToolRun run = runTool(compare, folder.path());
    EXPECT_TRUE(says(run.out, "nothing was compared: no normal map is drawn")) << run.out;
    const json r = jsonOf(compare, folder.path());
    EXPECT_EQ(r["normals"]["pixels"], 0);
    EXPECT_TRUE(r["normals"]["mean_degrees"].is_null());
    const json e =
        jsonOf({"render", "quad.gltf", "--view", "error", "--device", "reference", "--size", "64x48", "-o", "e.png"},
               folder.path());
    EXPECT_TRUE(e["frame_error"]["mean_degrees"].is_null());
    const json v =
        jsonOf({"convert", "quad.gltf", "--to", "smooth", "-o", "out.glb", "--verify", "v", "--device", "reference"},
               folder.path());
    EXPECT_EQ(v["verify"]["degrees"]["pixels"], 0);
    EXPECT_TRUE(v["verify"]["degrees"]["max_degrees"].is_null());
    const ToolRun said =
        runTool({"convert", "quad.gltf", "--to", "smooth", "-o", "out.glb", "--verify", "v", "--device", "reference"},
                folder.path());
    EXPECT_TRUE(says(said.err, "--verify compared nothing")) << said.err;
    const ToolRun absent = runTool({"convert", "quad.gltf", "--to", "smooth", "-o", "o.glb", "--verify", "v",
                                    "--device", "no such card", "--overwrite"},
                                   folder.path());
    EXPECT_EQ(absent.code, 3) << absent.err;
    EXPECT_TRUE(says(absent.err, "no such card")) << absent.err;
    write(quad(2), folder.path()); // the control
    EXPECT_GT(jsonOf(compare, folder.path())["normals"]["mean_degrees"].get<double>(), 1);
    std::vector<std::string> plain = compare;
    plain.push_back("--no-normal-maps");
    EXPECT_EQ(jsonOf(plain, folder.path())["normals"]["pixels"], 0);
}

// ---- advice is what the command does --------------------------------------------------------

// Runs the command that lint advises and compares the outcome with lint's prediction.
void runAdvice(const std::filesystem::path& folder, const std::string& model)
{
    const json lint = jsonOf({"lint", model}, folder);
    std::istringstream command(lint["run"].get<std::string>());
    std::vector<std::string> words;
    for (std::string word; command >> word && word != "--verify";)
        words.push_back(word);
    ASSERT_GT(words.size(), 2u);
    EXPECT_EQ(words[0], "cotan");
    words.erase(words.begin());
    const json r = jsonOf(words, folder);
    EXPECT_EQ(lint["run_would"]["primitives_dropping"], r["tangents"]["dropped_primitives"]);
    EXPECT_EQ(lint["run_would"]["primitives_keeping"],
              std::ranges::count_if(r["decisions"], [](const json& d) { return d["tangents_stay"].get<bool>(); }));
    EXPECT_EQ(lint["run_would"]["drops_tangents"].get<bool>(), r["tangents"]["dropped_primitives"].get<int>() > 0);
    EXPECT_GT(r["tangents"]["dropped_primitives"].get<int>(), 0) << "it does nothing";
}

TEST(Advice, commandWithoutEffectIsNotAdvised)
{
    TemporaryFolder folder;
    Made m = quad(1);
    m.root["meshes"][0]["primitives"][0]["attributes"].erase("TANGENT");
    write(m, folder.path());
    const json r = jsonOf({"lint", "quad.gltf"}, folder.path());
    EXPECT_EQ(r["run"], "");
    EXPECT_TRUE(says(r["recommendation"], "Nothing has to be changed")) << r["recommendation"];
    EXPECT_EQ(r["run_would"], json({{"primitives_dropping", 0}, {"primitives_keeping", 0}, {"drops_tangents", false}}));
    COTAN_NEEDS_DATA("models/BoomBox/BoomBox.gltf");
    const std::string boomBox = dataFile("models/BoomBox/BoomBox.gltf").string();
    const json b = jsonOf({"lint", boomBox}, folder.path());
    EXPECT_EQ(b["run"], "") << b["recommendation"];
}

TEST(Advice, convertDoesWhatLintPredicts)
{
    TemporaryFolder folder;
    write(quad(1), folder.path()); // tangents are removed, the map is kept
    runAdvice(folder.path(), "quad.gltf");
    // A mesh whose stored tangents are rotated by 11 degrees: no other frame shows what they show, so they stay.
    Made m = quad(1);
    for (std::size_t i = 0; i < 6; ++i) {
        const float rotated[2] = {std::cos(0.2f), std::sin(0.2f)};
        std::memcpy(m.bytes.data() + (18 + 18 + 4 * i) * sizeof(float), rotated, sizeof rotated);
    }
    write(m, folder.path());
    const json stays = jsonOf({"lint", "quad.gltf"}, folder.path());
    EXPECT_EQ(stays["run"], "");
    EXPECT_EQ(stays["run_would"],
              json({{"primitives_dropping", 0}, {"primitives_keeping", 1}, {"drops_tangents", false}}));
}

// ---- verdict first --------------------------------------------------------------------------

TEST(LintOutput, verdictHasAtMostTenLinesAndDetailsAreOptional)
{
    TemporaryFolder folder;
    Made m = quad(2);
    for (int i = 1; i < 30; ++i)
        m.root["meshes"][0]["primitives"].push_back(m.root["meshes"][0]["primitives"][0]);
    write(m, folder.path());
    const ToolRun verdict = runTool({"lint", "quad.gltf", "--limit", "0.0001"}, folder.path());
    EXPECT_LE(lines(verdict.out), 10) << verdict.out;
    EXPECT_TRUE(verdict.out.starts_with("quad.gltf: 30 primitives, 30 with a normal map, 30 with stored tangents\n"))
        << verdict.out;
    EXPECT_TRUE(says(verdict.out, "degrees on average"));
    EXPECT_TRUE(says(verdict.out, "\n  cotan convert quad.gltf ")) << verdict.out;
    EXPECT_TRUE(says(verdict.out, "--details adds")) << verdict.out;
    const ToolRun all = runTool({"lint", "quad.gltf", "--details"}, folder.path());
    EXPECT_GT(lines(all.out), 200);
    EXPECT_TRUE(says(all.out, "  made for MikkTSpace, read with cotangent: ")) << all.out;
    EXPECT_TRUE(all.out.starts_with(verdict.out.substr(0, verdict.out.find("check: failed")))) << all.out;
}

// ---- formats that are not read --------------------------------------------------------------

struct Foreign {
    const char *extension, *file, *name;
    std::string bytes;
};

const Foreign kForeign[] = {{"EXT_texture_avif", "waves.avif", "AVIF",
                             std::string("\0\0\0\x1c"
                                         "ftypavif and more",
                                         21)},
                            {"KHR_texture_basisu", "waves.ktx2", "KTX2 with BasisU",
                             makeKtx2({.format = 0, .levels = {{"some"}}, .colourModel = 167})}};

void writeForeign(const Foreign& f, const std::filesystem::path& folder)
{
    Made m = quad(2);
    m.root["extensionsUsed"] = m.root["extensionsRequired"] = {f.extension};
    m.root["textures"][0] = {{"extensions", {{f.extension, {{"source", 0}}}}}};
    m.root["images"][0] = {{"uri", f.file}};
    write(m, folder);
    std::ofstream(folder / f.file, std::ios::binary) << f.bytes;
}

TEST(ForeignMaps, lintJudgesUvAndTangentsAndNamesUnreadMaps)
{
    for (const Foreign& f : kForeign) {
        TemporaryFolder folder;
        writeForeign(f, folder.path());
        const json r = jsonOf({"lint", "quad.gltf"}, folder.path());
        const json& p = r["primitives"][0];
        EXPECT_NEAR(p["uv"]["stretch"]["mean"].get<double>(), 2, 1e-3) << f.name;
        EXPECT_EQ(p["stored_tangents"]["reversed_w"], 0);
        EXPECT_TRUE(says(p["not_judged"], f.name)) << p["not_judged"];
        EXPECT_FALSE(p.contains("read_with"));
        EXPECT_TRUE(says(r["warnings"].dump(), f.name)) << r["warnings"];
        EXPECT_TRUE(says(r["recommendation"], "could not be judged")) << r["recommendation"];
        EXPECT_FALSE(says(r["recommendation"], "can be dropped"));
        EXPECT_EQ(r["run"], "");
        const ToolRun strict = runTool({"lint", "quad.gltf", "--limit", "90", "--quiet"}, folder.path());
        EXPECT_EQ(strict.code, 5) << strict.err;
        EXPECT_TRUE(says(strict.err, "not judged")) << strict.err;
        EXPECT_EQ(runTool({"lint", "quad.gltf", "--limit-area", "5", "--quiet"}, folder.path()).code, 0);
    }
}

TEST(ForeignMaps, tangentsAreComparedAndWritten)
{
    for (const Foreign& f : kForeign) {
        TemporaryFolder folder;
        writeForeign(f, folder.path());
        EXPECT_EQ(jsonOf({"tangents", "quad.gltf"}, folder.path())["whole"]["verdict"], "equal") << f.name;
        EXPECT_EQ(jsonOf({"tangents", "quad.gltf", "--replace", "-o", "out.gltf"}, folder.path())["generated"], 1)
            << f.name;
        const json out = json::parse(readWhole(folder / "out.gltf"));
        EXPECT_EQ(out["images"][0]["uri"], f.file);
        EXPECT_EQ(out["extensionsRequired"][0], f.extension);
    }
}

TEST(ForeignMaps, convertKeepsForeignMapsAndTheirTangents)
{
    for (const Foreign& f : kForeign) {
        TemporaryFolder folder;
        writeForeign(f, folder.path());
        const json r = jsonOf({"convert", "quad.gltf", "--to", "cotangent", "-o", "out.glb"}, folder.path());
        EXPECT_TRUE(r["maps"].empty()) << f.name;
        EXPECT_TRUE(says(r["notes"].dump(), "TANGENT is kept")) << r["notes"];
        EXPECT_TRUE(says(r["notes"].dump(), fmt::format("{}: a normal map in {}", f.file, f.name))) << r["notes"];
        EXPECT_TRUE(says(r["notes"].dump(), "make it PNG")) << r["notes"];
        // Violates the specification but occurs in practice: the texture itself names such an image.
        Made m = quad(2);
        m.root["images"][0] = {{"uri", f.file}};
        write(m, folder.path());
        const json s = jsonOf({"convert", "quad.gltf", "--to", "cotangent", "-o", "out.glb"}, folder.path());
        EXPECT_TRUE(s["maps"].empty()) << f.name;
        EXPECT_TRUE(says(s["notes"].dump(), "TANGENT is kept")) << s["notes"];
    }
}

TEST(ForeignMaps, commandsThatNeedPixelsRefuse)
{
    TemporaryFolder folder;
    writeForeign(kForeign[0], folder.path());
    EXPECT_EQ(runTool({"render", "quad.gltf", "-o", "x.png", "--device", "reference", "--quiet"}, folder.path()).code,
              2);
    TemporaryFolder basis;
    writeForeign(kForeign[1], basis.path());
    const ToolRun refused =
        runTool({"render", "quad.gltf", "-o", "x.png", "--device", "reference", "--quiet"}, basis.path());
    EXPECT_EQ(refused.code, 3);
    EXPECT_TRUE(says(refused.err, "is not supported")) << refused.err;
    EXPECT_EQ(lines(refused.err), 1) << refused.err;
    std::ofstream(folder / "waves.avif") << "not an image";
    EXPECT_EQ(runTool({"lint", "quad.gltf", "--quiet"}, folder.path()).code, 2); // broken is not foreign
}

// ---- memory ---------------------------------------------------------------------------------

TEST(Memory, limitAndMessageAreTheSameInEveryCommand)
{
    TemporaryFolder folder;
    write(quad(2), folder.path());
    ASSERT_TRUE(writeImage(folder / "waves.png", makeImage(1024, 512, PixelType::unorm8, "large"))); // 2 MiB
    const std::vector<std::vector<std::string>> commands = {
        {"lint", "quad.gltf"},
        {"convert", "quad.gltf", "--to", "cotangent", "-o", "out.glb"},
        {"render", "quad.gltf", "-o", "out.png", "--device", "reference", "--size", "16x16"},
        {"compare", "quad.gltf", "-o", "c", "--device", "reference", "--size", "16x16"},
        {"bake", "--high", "quad.gltf", "--low", "quad.gltf", "--size", "8x8", "-o", "b.png"},
    };
    for (std::vector<std::string> words : commands) {
        words.insert(words.end(), {"--quiet", "--memory", "1"});
        const ToolRun refused = runTool(words, folder.path());
        EXPECT_EQ(refused.code, 2) << words[0] << refused.err;
        EXPECT_TRUE(says(refused.err, "the limit is 1048576 (--memory raises it)")) << words[0] << refused.err;
        words.back() = "2";
        EXPECT_EQ(runTool(words, folder.path()).code, 0) << words[0];
    }
    EXPECT_EQ(runTool({"tangents", "quad.gltf", "--quiet"}, folder.path()).code, 0); // needs no pixels
}

// ---- images beside a .gltf ------------------------------------------------------------------

TEST(ExternalImages, newMapsAreFilesNamedForTheModel)
{
    TemporaryFolder folder;
    write(quad(2), folder.path());
    const std::string old = readWhole(folder / "waves.png");
    const json r = jsonOf({"convert", "quad.gltf", "--to", "cotangent", "-o", "out.gltf"}, folder.path());
    const json out = json::parse(readWhole(folder / "out.gltf"));
    EXPECT_EQ(out["images"][0]["uri"], "out-waves.png");
    EXPECT_FALSE(out["images"][0].contains("bufferView"));
    EXPECT_EQ(readWhole(folder / "waves.png"), old);
    EXPECT_EQ(r["files"].size(), 3u) << r["files"];
    EXPECT_EQ(r["bytes_after"].get<std::size_t>(),
              std::filesystem::file_size(folder / "out.gltf") + std::filesystem::file_size(folder / "out.bin")
                  + std::filesystem::file_size(folder / "out-waves.png"));
    // The .gltf renders the same as the .glb.
    jsonOf({"convert", "quad.gltf", "--to", "cotangent", "-o", "out.glb"}, folder.path());
    const auto external = loadScene(folder / "out.gltf"), embedded = loadScene(folder / "out.glb");
    ASSERT_TRUE(external && embedded);
    EXPECT_EQ(external->images.at(0).data, embedded->images.at(0).data);
    // A second run replaces its own image.
    jsonOf({"convert", "quad.gltf", "--to", "cotangent", "--bits", "16", "-o", "out.gltf"}, folder.path());
    EXPECT_EQ(json::parse(readWhole(folder / "out.gltf"))["images"][0]["uri"], "out-waves.png");
    EXPECT_EQ(loadScene(folder / "out.gltf")->images.at(0).type, PixelType::unorm16);
    EXPECT_FALSE(std::filesystem::exists(folder / "out-waves-2.png"));
}

TEST(ExternalImages, unrelatedFilesAreNotOverwritten)
{
    TemporaryFolder folder;
    write(quad(2), folder.path());
    std::ofstream(folder / "out-waves.png") << "mine";
    jsonOf({"convert", "quad.gltf", "--to", "cotangent", "-o", "out.gltf"}, folder.path());
    EXPECT_EQ(readWhole(folder / "out-waves.png"), "mine");
    EXPECT_EQ(json::parse(readWhole(folder / "out.gltf"))["images"][0]["uri"], "out-waves-2.png");
    EXPECT_TRUE(loadScene(folder / "out.gltf"));
}

TEST(ExternalImages, namesAreSanitisedAndMadeUnique)
{
    TemporaryFolder folder;
    Made m = quad(2);
    m.root["images"][0]["name"] = "../a b/c";
    m.root["images"].push_back({{"uri", "copy.png"}, {"name", "../a b/c"}});
    m.root["textures"].push_back({{"source", 1}});
    m.root["materials"].push_back({{"normalTexture", {{"index", 1}}}});
    json second = m.root["meshes"][0]["primitives"][0];
    second["material"] = 1;
    m.root["meshes"][0]["primitives"].push_back(second);
    write(m, folder.path());
    std::filesystem::copy_file(folder / "waves.png", folder / "copy.png");
    jsonOf({"convert", "quad.gltf", "--to", "cotangent", "-o", "out.gltf"}, folder.path());
    const json out = json::parse(readWhole(folder / "out.gltf"));
    EXPECT_EQ(out["images"][0]["uri"], "out-_._a_b_c.png");
    EXPECT_EQ(out["images"][1]["uri"], "out-_._a_b_c-2.png");
    EXPECT_TRUE(loadScene(folder / "out.gltf"));
}

} // namespace
} // namespace cotan
