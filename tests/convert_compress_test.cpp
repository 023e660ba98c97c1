// `cotan convert --compress`: which maps become blocks, how the file names them, and what is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cotan/gltf.hpp"
#include "cotan/image.hpp"
#include "quad_model.hpp"
#include "run_tool.hpp"

namespace cotan::test {
namespace {

// A quad with a normal map of 128 x 128 and a coat with one of its own, of `side` texels; its colours read `colors`.
Made coatedQuad(const std::string& colors)
{
    Made m = quad(2);
    addCoat(m, {{"index", 1}});
    m.root["textures"].push_back({{"source", 2}});
    m.root["images"].push_back({{"uri", colors}});
    m.root["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 2;
    return m;
}

void writeCoated(const TemporaryFolder& folder, int side, const std::string& colors = "colors.png")
{
    write(coatedQuad(colors), folder.path());
    ASSERT_TRUE(writeImage(folder / "coat.png", makeReliefMap(Relief::domes, side)));
    ASSERT_TRUE(writeImage(folder / "colors.png", makeReliefMap(Relief::bricks, 32)));
}

json converted(const TemporaryFolder& folder, const std::string& compress, const std::string& output)
{
    const ToolRun run = runTool({"convert", "quad.gltf", "--keep-maps", "--compress", compress, "-o", output, "--json",
                                 "-", "--quiet", "--overwrite"},
                                folder.path());
    EXPECT_EQ(run.code, 0) << run.err;
    return json::parse(run.out, nullptr, false);
}

json rootOfFile(const std::filesystem::path& file) { return json::parse(readWhole(file), nullptr, false); }

// The maps of a bake as blocks are those of `map convert` from its pixels, and a model's are those of its map.
TEST(ConvertCompress, everyCommandMakesTheSameBlocksOfAMap)
{
    const TemporaryFolder folder;
    write(quad(2), folder.path());
    std::ofstream(folder / "high.obj") << "v 0 0 0\nv 2 0 0.2\nv 2 1 0.1\nv 0 1 0\nf 1 2 3\nf 1 3 4\n";
    const auto run = [&](std::vector<std::string> words) {
        words.insert(words.end(), {"--quiet", "--overwrite"});
        const ToolRun done = runTool(words, folder.path());
        EXPECT_EQ(done.code, 0) << done.err;
    };
    const std::vector<std::string> bake = {"bake", "--high", "high.obj", "--low", "quad.gltf", "--size", "40x36"};
    const auto bakeTo = [&](std::vector<std::string> more) {
        more.insert(more.begin(), bake.begin(), bake.end());
        run(more);
    };
    for (const std::string kind : {"normal", "object-normal"}) {
        bakeTo({"--kind", kind, "-o", "pixels.png"});
        for (const std::string word : {"bc5", "bc7", "uastc"})
            for (const std::string file : {"a.ktx2", "a.dds"}) {
                const bool mobile = word == "uastc";
                if ((mobile && file == "a.dds") || (kind != "normal" && word != "bc7" && word != "uastc"))
                    continue;
                const std::string stored = kind == "normal" ? "opengl" : "object,exact";
                bakeTo({"--kind", kind, "--compress", word, "-o", file});
                run({"map", "convert", "pixels.png", "--from", stored, "--to", stored, "--compress", word, "--mips",
                     "-o", "b" + file});
                EXPECT_TRUE(readWhole(folder / file) == readWhole(folder / ("b" + file))) << kind << word << file;
            }
    }
    bakeTo({"-o", "pixels.gltf"});
    bakeTo({"--compress", "uastc", "-o", "blocks.gltf"});
    const auto nameIn = [&](const char* file) { return rootOfFile(folder / file)["images"].back()["uri"]; };
    run({"map", "convert", nameIn("pixels.gltf"), "--from", "gltf", "--to", "gltf", "--compress", "uastc", "--mips",
         "-o", "model.ktx2"});
    EXPECT_TRUE(readWhole(folder / nameIn("blocks.gltf")) == readWhole(folder / "model.ktx2"));
    for (const auto& [words, message] :
         {std::pair(std::vector<std::string>{"--kind", "ao", "-o", "ao.dds"}, ".dds files hold maps of normals"),
          {{"--compress", "bc6", "-o", "a.dds"}, "--compress: expected one of none, bc3"},
          {{"--compress", "astc-4x4", "-o", "a.dds"}, "--compress: astc-4x4 is for .ktx2 files"},
          {{"--compress", "bc5", "-o", "a.png"}, "--compress: expected -o MODEL.glb or .gltf, or a map in .dds"}}) {
        std::vector<std::string> all = bake;
        all.insert(all.end(), words.begin(), words.end());
        const ToolRun done = runTool(all, folder.path());
        EXPECT_EQ(done.code, 1);
        EXPECT_NE(done.err.find(message), std::string::npos) << done.err;
    }
}

// The judge of the angles is `map diff` on the written files.
TEST(ConvertCompress, bothNormalMapsBecomeBlocksAndColoursStay)
{
    for (const auto& [word, extension] : {std::pair("uastc", "KHR_texture_basisu"), {"astc-6x6", "EXT_texture_astc"}}) {
        const TemporaryFolder folder;
        writeCoated(folder, 64);
        const json report = converted(folder, word, "out.gltf");
        const json root = rootOfFile(folder / "out.gltf");
        ASSERT_EQ(report["compressed"].size(), 2u) << word;
        for (std::size_t i = 0; i < 2; ++i) {
            const json& texture = root["textures"][i];
            EXPECT_FALSE(texture.contains("source")) << "a reader without the extension cannot read blocks";
            const std::size_t image = texture["extensions"][extension]["source"];
            const std::string uri = root["images"][image]["uri"];
            EXPECT_EQ(std::filesystem::path(uri).extension(), ".ktx2");
            const json& map = report["compressed"][i];
            const char* const original = i == 0 ? "waves.png" : "coat.png";
            EXPECT_EQ(map["name"], original);
            EXPECT_EQ(map["bytes_after"], readWhole(folder / uri).size());
            const ToolRun diff =
                runTool({"map", "diff", original, uri, "--from", "gltf", "--to", "gltf", "--json", "-"}, folder.path());
            const json angles = json::parse(diff.out)["angles"];
            EXPECT_NEAR(angles["mean_degrees"].get<double>(), map["mean_degrees"].get<double>(), 1e-6) << uri;
            EXPECT_GT(angles["mean_degrees"], 0) << uri;
            EXPECT_LT(angles["mean_degrees"], 3) << uri << ": the wrong map is tens of degrees away";
        }
        EXPECT_EQ(root["textures"][2]["source"], root["images"].size() - 1) << "which is colors.png";
        EXPECT_EQ(root["images"][2]["uri"], "colors.png");
        for (const char* list : {"extensionsUsed", "extensionsRequired"})
            EXPECT_NE(std::ranges::find(root[list], extension), root[list].end()) << list;
        EXPECT_TRUE(loadGltf(folder / "out.gltf")) << word;
    }
}

// Levels down to one texel, each half as large; packed with Zstandard as UASTC.
TEST(ConvertCompress, texturesHaveAllTheirLevels)
{
    const TemporaryFolder folder;
    writeCoated(folder, 64);
    for (const auto& [word, packing] : {std::pair("uastc", 2), {"astc-4x4", 0}}) {
        converted(folder, word, "out.gltf");
        std::vector<int> levels;
        const json root = rootOfFile(folder / "out.gltf");
        for (const json& image : root["images"]) {
            const std::string file = readWhole(folder / image["uri"].get<std::string>());
            if (!file.starts_with("\xabKTX 20\xbb"))
                continue;
            levels.push_back(file[40]);
            EXPECT_EQ(file[44], packing) << word;
        }
        EXPECT_EQ(levels, (std::vector{8, 7})) << word; // 128 and 64 texels
    }
}

// One side suffices.
TEST(ConvertCompress, aMapWhoseSidesAreNoMultiplesOfFourStaysUnderUastc)
{
    for (const auto& [width, height] : {std::pair(62, 62), {62, 64}, {64, 62}}) {
        const TemporaryFolder folder;
        writeCoated(folder, 64);
        Image coat = makeImage(width, height, PixelType::unorm8);
        const Image domes = makeReliefMap(Relief::domes, 64);
        for (int row = 0; row < height; ++row)
            std::copy_n(domes.bytes8() + 4 * 64 * row, 4 * width, coat.bytes8() + 4 * width * row);
        ASSERT_TRUE(writeImage(folder / "coat.png", coat));
        const json report = converted(folder, "uastc", "out.gltf");
        ASSERT_EQ(report["compressed"].size(), 1u) << width << " x " << height;
        EXPECT_EQ(report["compressed"][0]["name"], "waves.png");
        ASSERT_EQ(report["notes"].size(), 1u) << report["notes"];
        EXPECT_NE(report["notes"][0].get<std::string>().find(
                      fmt::format("coat.png: {} x {} texels; stays as it is", width, height)),
                  std::string::npos);
        EXPECT_EQ(rootOfFile(folder / "out.gltf")["textures"][1]["source"], 1);
        EXPECT_EQ(converted(folder, "astc-4x4", "astc.gltf")["compressed"].size(), 2u);
    }
}

// The colours read the image of the coat's map: that image stays, and a copy of the texture reads the blocks.
TEST(ConvertCompress, anImageThatColoursReadTooStaysForThem)
{
    const TemporaryFolder folder;
    writeCoated(folder, 64, "coat.png");
    Made m = coatedQuad("coat.png");
    m.root["images"].erase(2);
    m.root["textures"][2]["source"] = 1;
    write(m, folder.path());
    ASSERT_TRUE(writeImage(folder / "coat.png", makeReliefMap(Relief::domes, 64)));
    EXPECT_EQ(converted(folder, "uastc", "out.gltf")["compressed"].size(), 2u);
    const json root = rootOfFile(folder / "out.gltf");
    const json& material = root["materials"][0];
    const std::size_t colors = material["pbrMetallicRoughness"]["baseColorTexture"]["index"];
    const std::size_t coat = material["extensions"]["KHR_materials_clearcoat"]["clearcoatNormalTexture"]["index"];
    EXPECT_NE(colors, coat);
    EXPECT_EQ(root["images"][root["textures"][colors]["source"].get<std::size_t>()]["uri"], "coat.png");
    EXPECT_TRUE(root["textures"][coat]["extensions"].contains("KHR_texture_basisu"));
}

// Blocks are lost twice if they are compressed twice.
TEST(ConvertCompress, aSecondRunKeepsTheBlocks)
{
    const TemporaryFolder folder;
    writeCoated(folder, 64);
    converted(folder, "uastc", "one.glb");
    const ToolRun again =
        runTool({"convert", "one.glb", "--keep-maps", "--compress", "astc-8x8", "-o", "two.glb"}, folder.path());
    EXPECT_EQ(again.code, 0) << again.err;
    EXPECT_NE(again.err.find("is KTX2, and stays as it is"), std::string::npos) << again.err;
    EXPECT_NE(readWhole(folder / "two.glb").find("KHR_texture_basisu"), std::string::npos);
}

TEST(ConvertCompress, formatsThatNoExtensionNamesAreRefused)
{
    const TemporaryFolder folder;
    writeCoated(folder, 64);
    for (const char* word : {"bc7", "bc5", "eac-rg11", "nonsense"}) {
        const ToolRun run = runTool({"convert", "quad.gltf", "--compress", word, "-o", "no.glb"}, folder.path());
        EXPECT_EQ(run.code, 1) << word;
        EXPECT_EQ(lines(run.err), 1) << run.err;
        EXPECT_NE(run.err.find("--compress: expected one of none, uastc, astc-4x4"), std::string::npos) << run.err;
        EXPECT_FALSE(std::filesystem::exists(folder / "no.glb"));
    }
    const ToolRun vertices =
        runTool({"convert", "quad.gltf", "--provoking", "first", "--compress", "uastc", "-o", "no.glb"}, folder.path());
    EXPECT_EQ(vertices.code, 1);
    EXPECT_NE(vertices.err.find("--compress: applies to converted maps only"), std::string::npos) << vertices.err;
}

} // namespace
} // namespace cotan::test
