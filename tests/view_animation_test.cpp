// `cotan view` with animated models.
#include <gtest/gtest.h>

#include "cotan/scene.hpp"
#include "quad_model.hpp"
#include "view_window.hpp"

namespace cotan::test {
namespace {

TEST(ViewAnimation, aMomentMatchesRenderAndLoadsTheFileOnce)
{
    COTAN_NEEDS_DISPLAY();
    TemporaryFolder folder;
    write(movingQuad(), folder.path());
    const ToolRun run = play(folder,
                             "0 wait\n0 do toggle interface\n0 do set exposure 1\n0 do set animation high\n"
                             "0 do set time 3\n0 do set time 1\n0 do set time 2.5\n0 wait\n0 do window window.png\n"
                             "0 do report r.txt\n",
                             {"quad.gltf", "--size", "160x120", "--camera", "0,1,6,0,1,0"});
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(lineOf(readWhole(folder / "r.txt"), "loads"), "1 failed 0");
    const ToolRun drawn = runTool({"render", "quad.gltf", "-o", "r.png", "--size", "160x120", "--camera", "0,1,6,0,1,0",
                                   "--exposure", "1", "--animation", "high", "--time", "2.5"},
                                  folder.path());
    ASSERT_EQ(drawn.code, 0) << drawn.err;
    EXPECT_EQ(differentPixels(readImageFile(folder / "window.png"), readImageFile(folder / "r.png")), 0u);
}

// Textures stay on the device from moment to moment, also those for another convention of the map. A different map of
// the same size does not reuse them.
TEST(ViewAnimation, texturesMatchRenderAtEveryMoment)
{
    COTAN_NEEDS_DISPLAY();
    TemporaryFolder folder;
    write(movingQuad(), folder.path());
    ASSERT_TRUE(writeImage(folder / "map.png", makeReliefMap(Relief::domes, 64)));
    ASSERT_TRUE(writeImage(folder / "other.png", makeReliefMap(Relief::waves, 64)));
    const std::vector<std::string> words = {"--size",       "160x120", "--camera",   "0,1,6,0,1,0",
                                            "--normal-map", "map.png", "--exposure", "1"};
    std::vector<std::string> seen = words;
    seen.insert(seen.begin(), "quad.gltf");
    const ToolRun run = play(folder,
                             "0 wait\n0 do set animation high\n0 do set time 1\n0 wait\n0 do picture v1.png\n"
                             "0 do set time 2\n0 wait\n0 do picture v2.png\n"
                             "0 do show normal-map\n0 do set time 3\n0 wait\n"
                             "0 do show shaded\n0 do convention directx\n0 wait\n0 do picture v3.png\n0 do convention\n"
                             "0 do normal-map other.png\n0 do set time 1\n0 wait\n0 do picture v4.png\n",
                             seen);
    ASSERT_EQ(run.code, 0) << run.err;
    for (const std::string name : {"v1.png", "v2.png", "v3.png", "v4.png"}) {
        std::filesystem::rename(folder / name, folder / ("window-" + name));
        const std::string command = runPrinted(folder, run.out, name);
        ASSERT_NE(command, "") << run.out;
        EXPECT_TRUE(readWhole(folder / name) == readWhole(folder / ("window-" + name))) << command;
    }
    EXPECT_GT(differentPixels(readImageFile(folder / "v1.png"), readImageFile(folder / "v4.png")), 100u);
}

TEST(ViewAnimation, playingChangesTheImageAndPausingHoldsIt)
{
    COTAN_NEEDS_DISPLAY();
    TemporaryFolder folder;
    write(movingQuad(), folder.path());
    const ToolRun run =
        play(folder,
             "0 wait\n0 do toggle interface\n0 do window a.png\n0 key space\n1.5 wait\n1.5 key space\n1.5 wait\n"
             "1.5 do window b.png\n9 wait\n9 do window c.png\n9 do report r.txt\n",
             {"quad.gltf", "--size", "160x120", "--camera", "0,1,6,0,1,0", "--ground", "off"});
    ASSERT_EQ(run.code, 0) << run.err;
    const Image a = readImageFile(folder / "a.png"), b = readImageFile(folder / "b.png");
    EXPECT_GT(differentPixels(a, b), 100u);
    EXPECT_EQ(differentPixels(b, readImageFile(folder / "c.png")), 0u);
    const std::string report = readWhole(folder / "r.txt");
    EXPECT_EQ(lineOf(report, "time"), "1.5");
    EXPECT_EQ(lineOf(report, "playing"), "no");
    EXPECT_EQ(lineOf(report, "loads"), "1 failed 0");
}

// The front camera frames the whole animation; otherwise it would move with the model, or the model leave the window.
TEST(ViewAnimation, theCameraFramesTheWholeAnimation)
{
    COTAN_NEEDS_DISPLAY();
    TemporaryFolder folder;
    write(movingQuad(), folder.path());
    const ToolRun run = play(folder,
                             "0 wait\n0 do report rest.txt\n0 do set animation high\n0 wait\n0 do report a.txt\n"
                             "0 do set time 3\n0 wait\n0 do report b.txt\n0 do picture a.png\n",
                             {"quad.gltf", "--size", "160x120"});
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_NE(lineOf(readWhole(folder / "rest.txt"), "eye"), lineOf(readWhole(folder / "a.txt"), "eye"));
    EXPECT_EQ(lineOf(readWhole(folder / "a.txt"), "eye"), lineOf(readWhole(folder / "b.txt"), "eye"));
    std::filesystem::rename(folder / "a.png", folder / "window.png");
    const std::string command = runPrinted(folder, run.out, "a.png");
    ASSERT_NE(command, "") << run.out;
    EXPECT_TRUE(readWhole(folder / "a.png") == readWhole(folder / "window.png")) << command;
}

TEST(ViewAnimation, missingAnimationsAreReported)
{
    COTAN_NEEDS_DISPLAY();
    TemporaryFolder folder;
    write(movingQuad(), folder.path());
    const ToolRun run = play(folder,
                             "0 wait\n0 do set animation low\n0 wait\n0 do set animation run\n0 wait\n"
                             "0 do report a.txt\n",
                             {"quad.gltf", "--size", "64x48"});
    ASSERT_EQ(run.code, 0) << run.err;
    const std::string report = readWhole(folder / "a.txt");
    EXPECT_EQ(lineOf(report, "animation"), "low");
    EXPECT_NE(lineOf(report, "problem").find("\"run\""), std::string::npos) << report;
}

} // namespace
} // namespace cotan::test
