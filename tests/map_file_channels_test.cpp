// The storage that a map's file states is believed; requests that contradict it are named.
#include <gtest/gtest.h>

#include <algorithm>

#include <nlohmann/json.hpp>

#include "cotan/image.hpp"
#include "cotan/scene.hpp"
#include "ktx2_maker.hpp"
#include "png_maker.hpp"
#include "quad_model.hpp"
#include "run_tool.hpp"

namespace cotan::test {
namespace {

using namespace std::string_literals;

// BC5 of unit vectors on this relief: 64 levels between a block's endpoints, which span up to a sixth of the range.
constexpr double kBlockDegrees = 1;

class MapFileChannels : public ::testing::Test {
protected:
    void SetUp() override
    {
        ASSERT_TRUE(writeImage(folder / "map.png", makeReliefMap(Relief::waves, 64)));
        for (const char* file : {"bc5.ktx2", "bc5.dds"})
            ASSERT_EQ(
                tool({"convert", "map.png", "--from", "gltf", "--to", "gltf", "--compress", "bc5", "-o", file}).code,
                0);
        // The texels of the map as grey and alpha.
        const Image map = makeReliefMap(Relief::waves, 64);
        Png png{.width = 64, .height = 64, .colour = 4, .rows = {}};
        for (std::size_t i = 0; i < map.pixelCount(); ++i) {
            if (i % 64 == 0)
                png.rows += '\0';
            png.rows += char(map.bytes8()[4 * i]);
            png.rows += char(map.bytes8()[4 * i + 1]);
        }
        const Bytes bytes = makePng(png);
        writeWhole("grey-alpha.png", {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    }

    ToolRun tool(std::vector<std::string> words) const
    {
        words.insert(words.begin(), "map");
        return runTool(words, folder.path());
    }

    void writeWhole(const std::string& name, const std::string& bytes) const
    {
        std::ofstream(folder / name, std::ios::binary) << bytes;
    }

    double meanBetween(const std::string& a, const std::string& b, const std::vector<std::string>& more = {}) const
    {
        std::vector<std::string> words = {"diff", a, b, "--json", "-"};
        words.insert(words.end(), more.begin(), more.end());
        const ToolRun run = tool(words);
        EXPECT_EQ(run.code, 0) << run.err;
        return run.code == 0 ? nlohmann::json::parse(run.out)["angles"]["mean_degrees"].get<double>() : 180;
    }

    TemporaryFolder folder;
};

TEST_F(MapFileChannels, twoChannelFilesAreReadAsTwoChannels)
{
    for (const char* file : {"bc5.ktx2", "bc5.dds"}) {
        EXPECT_LT(meanBetween("map.png", file), kBlockDegrees) << file;
        EXPECT_LT(meanBetween(file, "map.png"), kBlockDegrees) << file;
        EXPECT_EQ(meanBetween("map.png", file), meanBetween("map.png", file, {"--to", "gltf,exact,xy"})) << file;
    }
    // x and y are stored unchanged; z is rounded in the map, and computed from x and y here: under half a code apart.
    EXPECT_LT(meanBetween("map.png", "grey-alpha.png"), 0.5);
}

TEST_F(MapFileChannels, presetSetsGreenOfTwoChannelFiles)
{
    ASSERT_EQ(
        tool({"convert", "map.png", "--from", "gltf", "--to", "unreal", "--compress", "bc5", "-o", "u.ktx2"}).code, 0);
    EXPECT_LT(meanBetween("map.png", "u.ktx2", {"--to", "unreal"}), kBlockDegrees);
    EXPECT_GT(meanBetween("map.png", "u.ktx2"), 10);
}

TEST_F(MapFileChannels, reportsStateTheConventionRead)
{
    const auto report = nlohmann::json::parse(tool({"diff", "map.png", "bc5.ktx2", "--json", "-"}).out);
    EXPECT_NE(report["convention_a"].get<std::string>().find("xyz"), std::string::npos) << report;
    EXPECT_NE(report["convention_b"].get<std::string>().find("two channels"), std::string::npos) << report;
    const ToolRun info = tool({"info", "bc5.ktx2"});
    EXPECT_NE(info.out.find("the file stores two channels\n"), std::string::npos) << info.out;
    EXPECT_EQ(tool({"info", "map.png"}).out.find("two channels"), std::string::npos);
}

TEST_F(MapFileChannels, everyCommandReadsTwoChannelFiles)
{
    ASSERT_EQ(tool({"convert", "bc5.ktx2", "--from", "gltf", "--to", "gltf", "-o", "c.png"}).code, 0);
    EXPECT_LT(meanBetween("map.png", "c.png"), kBlockDegrees);
    ASSERT_EQ(tool({"blend", "bc5.ktx2", "bc5.dds", "--strength", "0", "--to", "gltf", "-o", "b.png"}).code, 0);
    EXPECT_LT(meanBetween("map.png", "b.png"), kBlockDegrees);
    ASSERT_EQ(tool({"mips", "bc5.ktx2", "--to", "gltf", "-o", "m.png"}).code, 0);
    EXPECT_LT(meanBetween("map.png", "m_0.png"), kBlockDegrees);
    ASSERT_EQ(tool({"mips", "bc5.ktx2", "-o", "same.png"}).code, 0); // like the source: two channels
    EXPECT_LT(meanBetween("map.png", "same_0.png", {"--to", "gltf,exact,xy"}), kBlockDegrees);
    ASSERT_EQ(tool({"to-height", "bc5.ktx2", "-o", "h.exr"}).code, 0);
    ASSERT_EQ(tool({"to-height", "map.png", "-o", "h0.exr"}).code, 0);
    const auto h = readImage(folder / "h.exr"), h0 = readImage(folder / "h0.exr");
    double largest = 0, range = 0;
    for (std::size_t i = 0; i < h->pixelCount(); ++i) {
        largest = std::max(largest, double(std::abs(h->floats()[4 * i] - h0->floats()[4 * i])));
        range = std::max(range, double(std::abs(h0->floats()[4 * i])));
    }
    EXPECT_LT(largest, 0.05 * range); // an error of a sixtieth in every slope adds up to far less
}

TEST_F(MapFileChannels, contradictingOptionsAreRefusedInOneLine)
{
    const struct {
        std::vector<std::string> words;
        std::string line;
    } cases[] = {
        {{"diff", "map.png", "bc5.ktx2", "--to", "gltf,xyz"},
         "--to: bc5.ktx2 stores two channels; found xyz, which needs three; leave it out"},
        {{"diff", "bc5.dds", "map.png", "--from", "gltf,xyz"},
         "--from: bc5.dds stores two channels; found xyz, which needs three; leave it out"},
        {{"convert", "bc5.ktx2", "--from", "gltf,xyz", "--to", "gltf", "-o", "out.png"}, "--from: bc5.ktx2 stores two"},
        {{"convert", "grey-alpha.png", "--from", "gltf,xyz", "--to", "gltf", "-o", "out.png"},
         "--from: grey-alpha.png stores two"},
        {{"blend", "map.png", "bc5.ktx2", "--detail-from", "gltf,xyz", "-o", "out.png"},
         "--detail-from: bc5.ktx2 stores two"},
        {{"mips", "bc5.ktx2", "--from", "xyz", "-o", "out.png"}, "--from: bc5.ktx2 stores two"},
        {{"to-height", "bc5.ktx2", "--from", "xyz", "-o", "out.png"}, "--from: bc5.ktx2 stores two"},
    };
    for (const auto& c : cases) {
        const ToolRun run = tool(c.words);
        EXPECT_EQ(run.code, 1) << run.err;
        EXPECT_EQ(lines(run.err), 1) << run.err;
        EXPECT_NE(run.err.find(c.line), std::string::npos) << run.err;
    }
}

TEST_F(MapFileChannels, oneChannelFileIsNoNormalMap)
{
    const Bytes bytes = makePng({.width = 2, .height = 1, .colour = 0, .rows = "\0\x80\x90"s});
    writeWhole("grey.png", {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    writeWhole("r.ktx2", makeKtx2({.format = 9, .width = 2, .levels = {{"\x80\x90"}}}));
    for (const std::string file : {"grey.png", "r.ktx2"})
        for (const std::vector<std::string>& words :
             {std::vector<std::string>{"diff", file, file},
              {"convert", file, "--from", "gltf", "--to", "directx", "-o", "out.png"},
              {"mips", file, "-o", "out.png"},
              {"to-height", file, "-o", "out.png"}}) {
            const ToolRun run = tool(words);
            EXPECT_EQ(run.code, 2) << run.err;
            EXPECT_EQ(lines(run.err), 1) << run.err;
            EXPECT_NE(run.err.find("expected a normal map of two or three channels; found one (grey)"),
                      std::string::npos)
                << run.err;
        }
}

TEST_F(MapFileChannels, swizzleWithoutBlueIsATwoChannelFile)
{
    const Image map = makeReliefMap(Relief::waves, 64);
    std::string texels;
    for (std::size_t i = 0; i < map.pixelCount(); ++i)
        texels += {char(map.bytes8()[4 * i]), char(map.bytes8()[4 * i + 1]), '\7', '\7'};
    writeWhole("rg.ktx2", makeKtx2({.width = 64, .height = 64, .levels = {{texels}}, .keys = {"KTXswizzle\0rg01\0"s}}));
    EXPECT_LT(meanBetween("map.png", "rg.ktx2"), 0.5);
}

TEST(MapPresets, unityUnrealAndGodotGetRealBlue)
{
    TemporaryFolder folder;
    const Image map = makeReliefMap(Relief::domes, 32);
    ASSERT_TRUE(writeImage(folder / "map.png", map));
    for (const std::string to : {"unity", "unreal", "godot"}) {
        ASSERT_EQ(runTool({"map", "convert", "map.png", "--from", "gltf", "--to", to, "-o", "out.png", "--overwrite"},
                          folder.path())
                      .code,
                  0);
        const auto out = readImage(folder / "out.png");
        for (std::size_t i = 0; i < map.pixelCount(); ++i) {
            EXPECT_EQ(out->bytes8()[4 * i], map.bytes8()[4 * i]) << to;
            EXPECT_EQ(out->bytes8()[4 * i + 1],
                      to == "unreal" ? 255 - map.bytes8()[4 * i + 1] : map.bytes8()[4 * i + 1])
                << to;
            EXPECT_EQ(out->bytes8()[4 * i + 2], map.bytes8()[4 * i + 2]) << to; // was 128 everywhere
        }
        ASSERT_EQ(
            runTool({"map", "convert", "map.png", "--from", "gltf", "--to", to + ",xy", "-o", "two.png", "--overwrite"},
                    folder.path())
                .code,
            0);
        const auto two = readImage(folder / "two.png");
        EXPECT_EQ(int(two->bytes8()[2]), 128) << to; // shaders on the GPU ignore blue
        EXPECT_EQ(two->bytes8()[0], out->bytes8()[0]) << to;
    }
}

// A flat surface baked onto itself: (128, 128, 255).
TEST(MapPresets, bakedMapsHaveRealBlueToo)
{
    TemporaryFolder folder;
    write(quad(2), folder.path());
    for (const auto& [convention, blue] :
         {std::pair("unity", 255), {"unreal", 255}, {"godot", 255}, {"unity,xy", 128}}) {
        const ToolRun run = runTool({"bake", "--high", "quad.gltf", "--low", "quad.gltf", "--size", "16x16",
                                     "--convention", convention, "-o", "out.png", "--overwrite"},
                                    folder.path());
        ASSERT_EQ(run.code, 0) << run.err;
        const auto out = readImage(folder / "out.png");
        for (int c = 0; c < 3; ++c)
            EXPECT_EQ(int(out->bytes8()[4 * (8 * 16 + 8) + std::size_t(c)]), c == 2 ? blue : 128) << convention;
    }
}

} // namespace
} // namespace cotan::test
