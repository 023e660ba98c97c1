// File extensions in capitals, as some systems write them, mean the same as in small letters.
#include <gtest/gtest.h>

#include "cotan/image.hpp"
#include "cotan/scene.hpp"
#include "quad_model.hpp"
#include "run_tool.hpp"

namespace cotan::test {
namespace {

// Runs the command, whose last word is a file name; returns the contents of that file.
std::string madeBy(const TemporaryFolder& folder, const std::vector<std::string>& command)
{
    const ToolRun run = runTool(command, folder.path());
    EXPECT_EQ(run.code, 0) << run.err;
    return readWhole(folder / command.back());
}

void expectTwins(const TemporaryFolder& folder, std::vector<std::string> command, const std::string& small,
                 const std::string& large)
{
    command.push_back("-o");
    command.push_back("a" + small);
    const std::string expected = madeBy(folder, command);
    command.back() = "A" + large;
    EXPECT_FALSE(expected.empty());
    EXPECT_TRUE(madeBy(folder, command) == expected) << command[0] << " " << large;
}

TEST(CapitalExtensions, renderKeepsFloats)
{
    TemporaryFolder folder;
    for (const auto& [small, large] :
         {std::pair(".exr", ".EXR"), {".tif", ".TIF"}, {".tiff", ".Tiff"}, {".hdr", ".HDR"}})
        expectTwins(folder, {"render", "--size", "24x16", "--view", "normal", "--device", "reference"}, small, large);
    EXPECT_EQ(readImage(folder / "A.EXR")->type, PixelType::float32);
    EXPECT_EQ(readImage(folder / "A.TIF")->type, PixelType::float32);
}

TEST(CapitalExtensions, renderWritesAnimations)
{
    TemporaryFolder folder;
    write(movingQuad(), folder.path());
    expectTwins(folder,
                {"render", "quad.gltf", "--animation", "low", "--frames", "0..2", "--size", "24x16", "--samples", "1",
                 "--device", "reference"},
                ".webp", ".WEBP");
}

TEST(CapitalExtensions, mapsKeepTheirBits)
{
    TemporaryFolder folder;
    ASSERT_TRUE(writeImage(folder / "map.png", makeReliefMap(Relief::waves, 16)));
    const std::vector<std::string> convert = {"map", "convert", "map.png", "--from", "gltf", "--to", "directx"};
    for (const auto& [small, large, bits] : {std::tuple(".exr", ".EXR", "half"),
                                             {".tif", ".TIF", "16"},
                                             {".tif", ".TIF", "float"},
                                             {".hdr", ".HDR", "auto"},
                                             {".png", ".PNG", "16"},
                                             {".dds", ".DDS", "8"},
                                             {".ktx2", ".KTX2", "8"}}) {
        std::vector<std::string> command = convert;
        command.insert(command.end(), {"--overwrite", "--bits", bits});
        expectTwins(folder, command, small, large);
    }
    std::vector<std::string> blocks = convert;
    blocks.insert(blocks.end(), {"--overwrite", "--compress", "bc5"});
    expectTwins(folder, blocks, ".ktx2", ".KTX2");
}

TEST(CapitalExtensions, modelsAreReadAndWritten)
{
    TemporaryFolder folder;
    write(quad(2), folder.path());
    expectTwins(folder, {"tangents", "quad.gltf"}, ".glb", ".GLB");
    std::filesystem::rename(folder / "A.GLB", folder / "M.GLB");
    expectTwins(folder, {"tangents", "M.GLB"}, ".glb", ".Glb");
    EXPECT_EQ(readWhole(folder / "A.Glb").substr(0, 4), "glTF");
}

TEST(CapitalExtensions, bakeKeepsBits)
{
    TemporaryFolder folder;
    write(quad(2), folder.path());
    expectTwins(folder, {"bake", "--high", "quad.gltf", "--low", "quad.gltf", "--size", "16x16", "--bits", "32"},
                ".exr", ".EXR");
    expectTwins(folder, {"bake", "--high", "quad.gltf", "--low", "quad.gltf", "--size", "16x16", "--bits", "16"},
                ".tif", ".TIF");
}

} // namespace
} // namespace cotan::test
