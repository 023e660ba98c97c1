// The frame that a normal map was made for is kept from file to file.
#include <array>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cotan/image.hpp"
#include "cotan/scene.hpp"
#include "run_tool.hpp"

namespace cotan::test {
namespace {

namespace fs = std::filesystem;

class MapFrame : public ::testing::Test {
protected:
    void SetUp() override
    {
        Image map = makeReliefMap(Relief::waves, 16);
        ASSERT_TRUE(writeImage(folder / "plain.png", map));
        map.frame = "smooth";
        ASSERT_TRUE(writeImage(folder / "map.png", map));
    }

    // The frame stored in the file that the command writes, which is its last argument unless `file` names it.
    std::string after(std::vector<std::string> command, const std::string& file = {}) const
    {
        command.insert(command.begin(), "map");
        const ToolRun run = runTool(command, folder.path());
        EXPECT_EQ(run.code, 0) << run.err;
        const auto image = readImage(folder / (file.empty() ? command.back() : file));
        return image ? image->frame : image.error().message;
    }

    TemporaryFolder folder;
};

TEST_F(MapFrame, isPrintedByInfo)
{
    const ToolRun said = runTool({"map", "info", "map.png"}, folder.path());
    EXPECT_NE(said.out.find("made for the frame: smooth\n"), std::string::npos) << said.out;
    const auto report = nlohmann::json::parse(runTool({"map", "info", "map.png", "--json", "-"}, folder.path()).out);
    EXPECT_EQ(report["frame"], "smooth");
    const ToolRun nothing = runTool({"map", "info", "plain.png"}, folder.path());
    EXPECT_EQ(nothing.out.find("frame"), std::string::npos) << nothing.out;
}

TEST_F(MapFrame, staysWhenGreenChannelsBitsAndCompressionChange)
{
    const std::vector<std::string> convert = {"convert", "map.png", "--from", "gltf", "--to"};
    const auto converted = [&](std::vector<std::string> rest) {
        rest.insert(rest.begin(), convert.begin(), convert.end());
        return after(rest);
    };
    EXPECT_EQ(converted({"directx", "-o", "a.png"}), "smooth");
    EXPECT_EQ(converted({"gltf,orthographic", "-o", "a.exr"}), "smooth");
    EXPECT_EQ(converted({"gltf", "--bits", "half", "-o", "b.exr"}), "smooth");
    EXPECT_EQ(converted({"gltf", "-o", "a.ktx2"}), "smooth");
    EXPECT_EQ(converted({"gltf", "--compress", "bc5", "-o", "b.ktx2"}), "smooth");
    EXPECT_EQ(converted({"gltf", "--compress", "bc7", "-o", "c.ktx2"}), "smooth");
    EXPECT_EQ(converted({"gltf", "-o", "a.tif"}), ""); // the format cannot store it
    EXPECT_EQ(after({"convert", "plain.png", "--from", "gltf", "--to", "directx", "-o", "d.png"}), "");
}

TEST_F(MapFrame, staysInMipLevelsAndUnderADetail)
{
    EXPECT_EQ(after({"mips", "map.png", "-o", "m.png"}, "m_0.png"), "smooth");
    EXPECT_EQ(readImage(folder / "m_3.png")->frame, "smooth");
    EXPECT_EQ(readImage(folder / "m_roughness_0.png")->frame, "");
    EXPECT_EQ(after({"mips", "map.png", "-o", "m.ktx2"}), "smooth");
    EXPECT_EQ(after({"mips", "map.png", "--compress", "bc5", "-o", "n.ktx2"}), "smooth");
    EXPECT_EQ(readImage(folder / "n_roughness.ktx2")->frame, "");
    EXPECT_EQ(after({"blend", "map.png", "plain.png", "-o", "b.png"}), "smooth");
    EXPECT_EQ(after({"blend", "plain.png", "map.png", "-o", "c.png"}), "");
}

TEST_F(MapFrame, isDroppedInObjectSpaceAndSetByConversionBack)
{
    std::ofstream(folder / "quad.obj")
        << "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n";
    EXPECT_EQ(after({"convert", "map.png", "--from", "gltf", "--to", "object", "--mesh", "quad.obj", "--frame",
                     "orthonormal", "-o", "o.png"}),
              "");
    EXPECT_EQ(after({"convert", "o.png", "--from", "object", "--to", "gltf", "--mesh", "quad.obj", "--frame",
                     "orthonormal", "-o", "t.png"}),
              "orthonormal");
}

// Two channels cannot store directions into the surface; these are counted and reported.
TEST_F(MapFrame, directionsBelowTheSurfaceAreCountedForTwoChannels)
{
    std::ofstream(folder / "quad.obj")
        << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n";
    Image map = makeImage(4, 4, PixelType::unorm8, "object");
    for (std::size_t i = 0; i < 16; ++i) {
        const bool behind =
            i % 4 == 0; // (0.6, 0, -0.8) in the space of the quad, whose normal is z; else (0.6, 0, 0.8)
        const std::array<int, 4> texel{204, 128, behind ? 26 : 230, 255};
        for (std::size_t k = 0; k < 4; ++k)
            map.data[4 * i + k] = std::byte(texel[k]);
    }
    ASSERT_TRUE(writeImage(folder / "object.png", map));
    for (const auto& [to, said] : {std::pair("gltf,xy", "4 texels are steeper than "), {"gltf", ""}}) {
        const ToolRun run = runTool({"map", "convert", "object.png", "--from", "object", "--to", to, "--mesh",
                                     "quad.obj", "--frame", "orthonormal", "-o", "t.png"},
                                    folder.path());
        ASSERT_EQ(run.code, 0) << run.err;
        EXPECT_EQ(run.err.find("steeper than") != std::string::npos, *said != 0) << to << run.err;
        EXPECT_NE(run.err.find(said), std::string::npos) << to << run.err;
    }
}

} // namespace
} // namespace cotan::test
