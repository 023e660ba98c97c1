// Where `cotan map` stores two channels, and how it chooses a format by degrees.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <span>
#include <tuple>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cotan/gltf.hpp"
#include "cotan/image.hpp"
#include "cotan/scene.hpp"
#include "image/codecs.hpp"
#include "map_files/choose.hpp"
#include "maps/textures/texel_code.hpp"
#include "run_tool.hpp"
#include "scene_of_maps.hpp"
#include "test_data.hpp"

namespace cotan::test {
namespace {

using nlohmann::json;

json done(std::vector<std::string> words, const TemporaryFolder& folder)
{
    words.insert(words.end(), {"--json", "-", "--quiet", "--overwrite"});
    const ToolRun run = runTool(words, folder.path());
    EXPECT_EQ(run.code, 0) << run.err;
    return json::parse(run.out, nullptr, false);
}

std::string refusal(const std::vector<std::string>& words, const TemporaryFolder& folder, int code)
{
    const ToolRun run = runTool(words, folder.path());
    EXPECT_EQ(run.code, code) << run.err;
    EXPECT_EQ(lines(run.err), 1) << run.err;
    return run.err;
}

TemporaryFolder& reliefs()
{
    static TemporaryFolder folder;
    static const bool made = writeImage(folder / "waves.png", makeReliefMap(Relief::waves, 64))
        && writeImage(folder / "domes.png", makeReliefMap(Relief::domes, 64));
    EXPECT_TRUE(made);
    return folder;
}

// The components of a PNG or TGA of 8 bits are those of the map, moved. The map has 127.5 as zero, as unity has, so
// that no code changes.
TEST(MapChoice, swizzlePutsXAndYWhereItsWordSays)
{
    const TemporaryFolder& folder = reliefs();
    for (const char* map : {"waves.png", "domes.png"}) {
        const auto original = readImage(folder / map);
        ASSERT_TRUE(original);
        for (const char* file : {"out.png", "out.tga"})
            for (const auto& [word, order] : std::map<std::string, std::array<int, 4>>{
                     // For red, green, blue and alpha: 0 x, 1 y, 2 anything, 3 white.
                     {"auto", {0, 1, 2, 3}},
                     {"rg", {0, 1, 2, 3}},
                     {"ra", {0, 0, 0, 1}},
                     {"rrrg", {0, 0, 0, 1}},
                     {"ag", {3, 1, 3, 0}}}) {
                done({"map", "convert", map, "--from", "gltf", "--to", "gltf,xy", "--swizzle", word, "-o", file},
                     folder);
                const auto moved = readImage(folder / file);
                ASSERT_TRUE(moved && moved->type == PixelType::unorm8) << file;
                std::size_t wrong = 0;
                for (std::size_t i = 0; i < moved->pixelCount(); ++i)
                    for (std::size_t c = 0; c < 4; ++c) {
                        const int from = order[c], found = moved->bytes8()[4 * i + c];
                        const int expected = from == 3 ? 255 : original->bytes8()[4 * i + std::size_t(from)];
                        wrong += from != 2 && std::abs(found - expected) > 1; // z is rebuilt, then normalised: one step
                    }
                EXPECT_EQ(wrong, 0u) << map << ' ' << file << ' ' << word;
            }
    }
}

// OpenImageIO reads the DDS, our own reader the KTX2. A BC3 block has six bits and four steps for green and eight bits
// and eight steps for alpha, where BC5 has the latter for both.
TEST(MapChoice, bc3HasXInAlphaAndYInGreen)
{
    const TemporaryFolder& folder = reliefs();
    for (const char* map : {"waves.png", "domes.png"}) {
        const auto cost = [&](const std::string& compress, const std::string& file) {
            done({"map", "convert", map, "--from", "gltf", "--to", "gltf,xy", "--compress", compress, "-o", file},
                 folder);
            return done({"map", "diff", map, file, "--from", "gltf", "--to", "gltf,xy"},
                        folder)["angles"]["mean_degrees"]
                .get<double>();
        };
        const double two = cost("bc5", "a.dds"), old = cost("bc3", "b.dds");
        EXPECT_GT(old, two) << map;
        EXPECT_LT(old, 4 * two) << map; // green alone has less than four times the error of eight steps and eight bits
        const auto dds = readImage(folder / "b.dds");
        ASSERT_TRUE(dds);
        for (std::size_t i = 0; i < dds->pixelCount(); ++i)
            ASSERT_TRUE(dds->bytes8()[4 * i] == 255 && dds->bytes8()[4 * i + 2] == 255) << i;
        EXPECT_NEAR(cost("bc3", "b.ktx2"), old, 0.05 * old) << "whose decoder rounds otherwise";
    }
}

TEST(MapChoice, aSwizzleThatAFormatCannotHaveIsRefused)
{
    const TemporaryFolder& folder = reliefs();
    const auto said = [&](const char* to, const char* compress, const char* swizzle, const char* file) {
        return refusal({"map", "convert", "waves.png", "--from", "gltf", "--to", to, "--compress", compress,
                        "--swizzle", swizzle, "-o", file},
                       folder, 1);
    };
    for (const char* command : {"convert", "mips"}) {
        const std::string err = refusal({"map", command, "waves.png", "--from", "gltf", "--to", "gltf,xy", "--compress",
                                         "bc5", "--swizzle", "ag", "-o", "no.dds"},
                                        folder, 1);
        EXPECT_NE(err.find("--swizzle: expected one of auto, rg, as bc5 has; found 'ag'"), std::string::npos) << err;
    }
    EXPECT_NE(said("gltf,xy", "astc-4x4", "rg", "no.ktx2").find("expected one of auto, ra, ag, rrrg, as astc-4x4 has"),
              std::string::npos);
    EXPECT_NE(said("gltf,xy", "none", "ag", "no.jpg").find("expected one of auto, rg, as .jpg has"), std::string::npos);
    EXPECT_NE(said("gltf", "none", "ag", "no.png").find("the map has three channels"), std::string::npos);
}

// A level's roughness has a file of its own where alpha holds a direction.
TEST(MapChoice, mipsWithASwizzleHaveTheirRoughnessBeside)
{
    const TemporaryFolder& folder = reliefs();
    for (const char* file : {"m.dds", "m.ktx2"})
        for (const char* compress : {"none", "bc3"}) {
            done({"map", "mips", "domes.png", "--from", "gltf", "--to", "gltf,xy", "--roughness", "0.4", "--swizzle",
                  "ag", "--compress", compress, "-o", file},
                 folder);
            const auto angles =
                done({"map", "diff", "domes.png", file, "--from", "gltf", "--to", "gltf,xy"}, folder)["angles"];
            EXPECT_LT(angles["mean_degrees"], 3.0) << file << compress; // exchanged x and y: over 10 degrees
            const auto roughness = readImage(folder / (std::string("m_roughness") + std::string(file).substr(1)));
            ASSERT_TRUE(roughness) << file << compress;
            const int red = roughness->type == PixelType::unorm8 ? roughness->bytes8()[0] : roughness->words()[0] / 257;
            EXPECT_NEAR(red, 0.4 * 255, 1.01) << "the first level needs no more roughness than the material has";
        }
}

// The judge is `map diff` on files that --compress writes.
TEST(MapChoice, theChosenFormatIsTheSmallestWithinTheLimit)
{
    const TemporaryFolder& folder = reliefs();
    std::map<std::string, int> chosen;
    std::map<std::string, double> costs;
    for (const char* map : {"waves.png", "domes.png"})
        for (const auto& [device, to] :
             {std::pair("mobile", "gltf"), {"mobile", "gltf,xy"}, {"desktop", "gltf"}, {"desktop", "gltf,xy"}})
            for (const double limit : {2.0, 0.6, 0.3}) {
                const json report = done({"map", "convert", map, "--from", "gltf", "--to", to, "--max-degrees",
                                          fmt::format("{}", limit), "--for", device, "-o", "out.ktx2"},
                                         folder);
                const std::string where = fmt::format("{} {} {} {}", map, device, to, limit);
                const std::string word = report["bits"] == "8 bit" ? "none" : report["bits"].get<std::string>();
                ++chosen[word];
                ASSERT_FALSE(report["tried"].empty()) << where;
                double taken = 0, mean = 1e9;
                for (const json& tried : report["tried"]) {
                    const std::string compress = tried["compress"];
                    auto [known, isNew] = costs.emplace(fmt::format("{} {} {}", map, to, compress), 0);
                    if (isNew) {
                        done({"map", "convert", map, "--from", "gltf", "--to", to, "--compress", compress, "-o",
                              "one.ktx2"},
                             folder);
                        known->second = done({"map", "diff", map, "one.ktx2", "--from", "gltf", "--to", to},
                                             folder)["angles"]["mean_degrees"];
                    }
                    // The tool compares with the map before it is stored; the file has 8 bits: 0.1 degrees or less.
                    EXPECT_NEAR(tried["mean_degrees"].get<double>(), known->second, 0.1) << where << compress;
                    if (compress == word) {
                        taken = tried["bits_per_texel"];
                        mean = tried["mean_degrees"];
                        EXPECT_LE(mean, limit) << where;
                        EXPECT_LE(tried["percentile99_degrees"], 10 * limit) << where;
                    }
                }
                for (const json& tried : report["tried"]) {
                    const bool within = tried["mean_degrees"] <= limit && tried["percentile99_degrees"] <= 10 * limit;
                    if (tried["compress"] != word) {
                        EXPECT_TRUE(!within || (tried["bits_per_texel"] == taken && tried["mean_degrees"] >= mean))
                            << where << tried;
                    }
                }
            }
    EXPECT_GE(chosen.size(), 4u) << "the limits tell formats apart";
}

TEST(MapChoice, whereNoBlocksOfThreeChannelsAreWithinTheLimitThoseOfTwoAreNamed)
{
    const TemporaryFolder& folder = reliefs();
    for (const char* map : {"waves.png", "domes.png"})
        for (const auto& [to, limit, named] :
             {std::tuple("gltf", "0.1", true), {"gltf", "60", false}, {"gltf,xy", "0.1", false}}) {
            const ToolRun run = runTool({"map", "convert", map, "--from", "gltf", "--to", to, "--max-degrees", limit,
                                         "--for", "mobile", "-o", "named.ktx2", "--overwrite"},
                                        folder.path());
            EXPECT_EQ(run.code, 0) << run.err;
            EXPECT_EQ(run.out.find("--to WORDS,xy") != std::string::npos, named) << to << limit << run.out;
        }
}

TEST(MapChoice, limitsThatNothingMeetsAndOptionsThatContradictAreRefused)
{
    const TemporaryFolder& folder = reliefs();
    const auto said = [&](const std::vector<std::string>& more, int code) {
        std::vector<std::string> words{"map", "convert", "waves.png", "--from", "gltf", "--to", "gltf,xy"};
        words.insert(words.end(), more.begin(), more.end());
        return refusal(words, folder, code);
    };
    EXPECT_NE(said({"--max-degrees", "0.000001", "--for", "mobile", "-o", "no.ktx2"}, 5)
                  .find("--max-degrees: expected a format within 1e-06 degrees on average"),
              std::string::npos);
    EXPECT_NE(said({"--max-degrees", "1", "-o", "no.ktx2"}, 1).find("--max-degrees needs --for"), std::string::npos);
    EXPECT_NE(said({"--for", "mobile", "-o", "no.ktx2"}, 1).find("--for needs --max-degrees"), std::string::npos);
    EXPECT_NE(said({"--max-degrees", "1", "--for", "mobile", "-o", "no.png"}, 1).find("expected a .dds or .ktx2 file"),
              std::string::npos);
    EXPECT_NE(said({"--max-degrees", "1", "--for", "mobile", "-o", "no.dds"}, 1).find("is for .ktx2 files"),
              std::string::npos);
    EXPECT_NE(said({"--max-degrees", "1", "--for", "mobile", "--compress", "bc5", "-o", "no.ktx2"}, 1)
                  .find("--max-degrees: chooses the format; found bc5 as well"),
              std::string::npos);
    EXPECT_NE(said({"--max-degrees", "1", "--for", "console", "-o", "no.ktx2"}, 1).find("--for: expected"),
              std::string::npos);
    for (const char* file : {"no.ktx2", "no.png", "no.dds"})
        EXPECT_FALSE(std::filesystem::exists(folder / file)) << file;
}

// The judge is `map convert` and `map diff` of the same map. A sample of a quarter of a periodic relief is within two
// fifths of it.
TEST(MapChoice, lintNamesWhatBlocksWouldCost)
{
    const TemporaryFolder folder;
    for (const int side : {64, 400}) {
        ASSERT_TRUE(writeImage(folder / "waves.png", makeReliefMap(Relief::waves, side)));
        ASSERT_TRUE(writeImage(folder / "domes.png", makeReliefMap(Relief::domes, side)));
        Scene scene;
        for (const char* map : {"waves.png", "domes.png"})
            addPlaneWith(*readImage(folder / map), map, scene);
        auto document = gltfDocumentOf(scene);
        ASSERT_TRUE(document);
        ASSERT_TRUE(writeGltf(*document, folder / "two.glb"));
        const json report = done({"lint", "two.glb", "--details"}, folder);
        std::size_t seen = 0;
        for (const json& cost : report["as_blocks"]) {
            const std::string map = cost["map"].get<std::string>().substr(0, 5) + ".png", compress = cost["compress"];
            done({"map", "convert", map, "--from", "gltf", "--to", "gltf", "--compress", compress, "-o", "one.ktx2"},
                 folder);
            const double mean = done({"map", "diff", map, "one.ktx2", "--from", "gltf", "--to", "gltf"},
                                     folder)["angles"]["mean_degrees"];
            EXPECT_NEAR(cost["mean_degrees"].get<double>(), mean, side == 64 ? 1e-6 + 0.02 * mean : 0.4 * mean + 0.02)
                << map << compress;
            ++seen;
        }
        EXPECT_EQ(seen, 2u * 6) << report["as_blocks"];
    }
}

// The truth is the angle to the map before it was compressed, which the estimate does not see. Maps that are flat but
// for a few lines are the worst: there it may be 0.2 degrees off.
TEST(MapChoice, whatBlocksHaveCostIsEstimatedFromThemWithinAThird)
{
    const TemporaryFolder folder;
    int seen = 0;
    for (const char* const name :
         {"cube_normal_gl.png", "ornament_normal_gl.png", "sofa_normal_gl.png", "mesh_wire_normal.png"}) {
        if (!hasData(std::string("textures/") + name))
            continue;
        const auto whole = readImage(dataFile(std::string("textures/") + name));
        ASSERT_TRUE(whole) << name;
        Image map = makeImage(128, 128, whole->type);
        const std::size_t bytes = whole->data.size() / whole->pixelCount(), row = 128 * bytes;
        for (std::size_t y = 0; y < 128; ++y)
            std::copy_n(whole->data.data() + y * std::size_t(whole->width) * bytes, row, map.data.data() + y * row);
        ASSERT_TRUE(writeImage(folder / "map.png", map));
        for (const std::string word : {"bc5", "bc7", "uastc", "astc-6x5"}) {
            const json report = done(
                {"map", "convert", "map.png", "--from", "gltf", "--to", "gltf", "--compress", word, "-o", "map.ktx2"},
                folder);
            const std::string text = readWhole(folder / "map.ktx2");
            const auto file = std::as_bytes(std::span(text));
            const auto image = decodeImage(file, word);
            ASSERT_TRUE(image) << word;
            EXPECT_EQ(image->blocks, word);
            const auto found = app::costBefore(*image, {.expansion = Expansion::biased});
            ASSERT_TRUE(found) << word;
            const double truth = report["mean_degrees"], lost = found->meanDegrees, off = lost / truth;
            EXPECT_TRUE((off > 0.66 && off < 1.34) || std::abs(lost - truth) < 0.2)
                << name << ' ' << word << ": " << lost << " instead of " << truth;
            ++seen;
        }
    }
    if (seen == 0)
        GTEST_SKIP() << "no test data: run scripts/test-data";
}

// Headers of files of others: the old names of DDS, the codes of sRGB, and what no word names.
TEST(MapChoice, blocksAreKnownByTheHeaderOfTheirFile)
{
    const auto found = [](std::string file) { return blockName(std::as_bytes(std::span(file))); };
    const auto with = [](std::string file, std::size_t at, std::uint32_t number) {
        for (std::size_t i = 0; i < 4; ++i)
            file.at(at + i) = char(number >> 8 * i & 0xff);
        return file;
    };
    std::string ktx2("\xabKTX 20\xbb\r\n\x1a\n", 12), dds = "DDS ";
    ktx2.resize(160);
    dds.resize(160);
    for (const auto& [vulkan, word] :
         std::map<std::uint32_t, std::string>{{37, ""},          {131, "bc1"},       {137, "bc3"},
                                              {138, "bc3"},      {139, ""},          {140, ""},
                                              {141, "bc5"},      {142, "bc5-snorm"}, {143, ""},
                                              {145, "bc7"},      {146, "bc7"},       {147, "etc2"},
                                              {153, ""},         {155, "eac-rg11"},  {156, ""},
                                              {157, "astc-4x4"}, {158, "astc-4x4"},  {166, "astc-6x6"},
                                              {171, "astc-8x8"}, {173, ""},          {0, ""}})
        EXPECT_EQ(found(with(ktx2, 12, vulkan)), word) << vulkan;
    EXPECT_EQ(found(with(with(ktx2, 48, 104), 116, 166)), "uastc");
    EXPECT_EQ(found(with(with(ktx2, 48, 104), 116, 163)), "etc1s");
    EXPECT_EQ(found(with(ktx2, 48, 0xfffffffc)), "") << "which lies outside";
    for (const auto& [letters, word] : std::map<std::string, std::string>{
             {"DXT5", "bc3"}, {"DXT1", "bc1"}, {"ATI2", "bc5"}, {"BC5U", "bc5"}, {"BC5S", "bc5-snorm"}, {"DX10", ""}})
        EXPECT_EQ(found(std::string(dds).replace(84, 4, letters)), word) << letters;
    for (const auto& [dxgi, word] :
         std::map<std::uint32_t, std::string>{{77, "bc3"}, {83, "bc5"}, {84, "bc5-snorm"}, {98, "bc7"}, {71, "bc1"}})
        EXPECT_EQ(found(with(std::string(dds).replace(84, 4, "DX10"), 128, dxgi)), word) << dxgi;
    EXPECT_EQ(found(""), "");
    EXPECT_EQ(found("DDS "), "");
}

// The angle that `convert` has measured, and an estimate of it from the model that it has written.
TEST(MapChoice, lintNamesWhatTheBlocksOfAModelHaveCost)
{
    const TemporaryFolder folder;
    Scene scene;
    addPlaneWith(makeReliefMap(Relief::waves, 64), "waves", scene);
    addPlaneWith(makeReliefMap(Relief::domes, 64), "domes", scene);
    auto document = gltfDocumentOf(scene);
    ASSERT_TRUE(document);
    ASSERT_TRUE(writeGltf(*document, folder / "two.glb"));
    EXPECT_TRUE(done({"lint", "two.glb", "--details"}, folder)["lost_before"].empty());
    for (const std::string word : {"uastc"}) {
        const json made = done({"convert", "two.glb", "--keep-maps", "--compress", word, "-o", "blocks.glb"}, folder);
        const json report = done({"lint", "blocks.glb", "--details"}, folder);
        ASSERT_EQ(report["lost_before"].size(), 2u) << word;
        for (std::size_t i = 0; i < 2; ++i) {
            const double truth = made["compressed"][i]["mean_degrees"];
            const json& lost = report["lost_before"][i];
            EXPECT_EQ(lost["compress"], word);
            EXPECT_NEAR(lost["mean_degrees"].get<double>(), truth, 0.34 * truth + 0.05) << word << i;
        }
        EXPECT_TRUE(done({"lint", "blocks.glb"}, folder)["lost_before"].empty()) << "which takes time";
    }
}

} // namespace
} // namespace cotan::test
