// The KTX2 files of `cotan map` as ktx-parse, the loader of three.js, reads them.
#include <gtest/gtest.h>

#include <cstdlib>

#include <nlohmann/json.hpp>

#include "cotan/image.hpp"
#include "cotan/scene.hpp"
#include "run_tool.hpp"

namespace cotan::test {
namespace {

using nlohmann::json;

json readByKtxParse(const std::filesystem::path& file)
{
    const std::string line =
        "node '" COTAN_SOURCE_DIR "/tests/npm/ktx2.mjs' '" COTAN_NPM "/node_modules' '" + file.string() + "'";
    EXPECT_EQ(std::system(line.c_str()), 0);
    return json::parse(readWhole(file.string() + ".json"), nullptr, false);
}

// Values required by the specifications: VkFormat, colour model and channels of the Khronos Data Format, bytes of a
// pixel or block, and the side of a block in pixels.
struct Expected {
    std::string compress, file;
    int format, model;
    std::vector<int> channels;
    std::size_t bytes;
    int side;
};

TEST(MapKtx2, ktxParseReadsFormatDescriptorAndLevels)
{
    if (!std::filesystem::exists(COTAN_NPM "/installed-lock.json"))
        GTEST_SKIP() << "scripts/npm-packages could not install three in " << COTAN_NPM;
    TemporaryFolder folder;
    ASSERT_TRUE(writeImage(folder / "map.png", makeReliefMap(Relief::waves, 44)));
    for (const Expected& e :
         {Expected{"none", "x", 37, 1, {0, 1, 2, 15}, 4, 1}, Expected{"bc7", "x", 145, 134, {0}, 16, 4},
          Expected{"bc3", "x", 137, 130, {15, 0}, 16, 4}, Expected{"bc5", "x", 141, 132, {0, 1}, 16, 4},
          Expected{"bc5", "x_roughness", 139, 131, {0}, 8, 4}}) {
        for (const char* extension : {".ktx2", ".dds"})
            ASSERT_EQ(runTool({"map", "mips", "map.png", "--compress", e.compress, "-o", std::string("x") + extension,
                               "--overwrite"},
                              folder.path())
                          .code,
                      0);
        const json k = readByKtxParse(folder / (e.file + ".ktx2"));
        EXPECT_EQ(k["format"], e.format);
        EXPECT_EQ(k["typeSize"], 1);
        EXPECT_EQ(k["size"], json({44, 44, 0}));
        EXPECT_EQ(k["layers"], 0);
        EXPECT_EQ(k["faces"], 1);
        EXPECT_EQ(k["packing"], 0);
        EXPECT_EQ(k["keys"]["KTXorientation"], "rd");
        ASSERT_EQ(k["descriptor"].size(), 1u);
        const json& d = k["descriptor"][0];
        EXPECT_EQ(d["colorModel"], e.model);
        EXPECT_EQ(d["transferFunction"], 1); // linear: normals are not colours
        EXPECT_EQ(d["texelBlockDimension"], json({e.side - 1, e.side - 1, 0, 0}));
        EXPECT_EQ(d["bytesPlane"][0], e.bytes);
        ASSERT_EQ(d["samples"].size(), e.channels.size());
        for (std::size_t c = 0; c < e.channels.size(); ++c) {
            const std::size_t bits = 8 * e.bytes / e.channels.size();
            EXPECT_EQ(d["samples"][c]["channelType"], e.channels[c]);
            EXPECT_EQ(d["samples"][c]["bitOffset"], c * bits);
            EXPECT_EQ(d["samples"][c]["bitLength"], bits - 1);
            EXPECT_EQ(d["samples"][c]["sampleLower"], 0);
            EXPECT_EQ(d["samples"][c]["sampleUpper"], e.side == 4 ? 0xffffffffu : 255u);
        }
        // The same levels as in the DDS file, which OpenImageIO reads in another test.
        const std::string dds = readWhole(folder / (e.file + ".dds"));
        EXPECT_TRUE(dds.substr(e.side == 4 && e.compress != "bc3" ? 148 : 128)
                    == readWhole(folder / (e.file + ".ktx2.levels")))
            << e.compress;
        ASSERT_EQ(k["levels"].size(), 6u); // 44, 22, 11, 5, 2, 1
        for (std::size_t level = 0; level < 6; ++level) {
            const std::size_t width = 44u >> level, across = (width + std::size_t(e.side) - 1) / std::size_t(e.side);
            EXPECT_EQ(k["levels"][level]["bytes"], across * across * e.bytes) << level;
            EXPECT_EQ(k["levels"][level]["plain"], across * across * e.bytes) << level;
            EXPECT_EQ(k["levels"][level]["from"].get<std::size_t>() % std::max<std::size_t>(e.bytes, 4), 0u);
        }
    }
}

} // namespace
} // namespace cotan::test
