// `cotan view` with a bake: two models, masks and the turntable in sessions, and files that cannot be shown.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "quad_model.hpp"
#include "view_window.hpp"

namespace cotan::test {
namespace {

// A rectangle like quad(2), at z, and the upper half of it, nearer.
void writeHigh(const std::filesystem::path& file, double z)
{
    std::ofstream(file) << fmt::format(
        "v 0 0 {0}\nv 2 0 {0}\nv 2 1 {0}\nv 0 1 {0}\nv 0 0.5 {1}\nv 2 0.5 {1}\nv 2 1 {1}\nv 0 1 {1}\nvn 0 0 1\n"
        "f 1//1 2//1 3//1\nf 1//1 3//1 4//1\nf 5//1 6//1 7//1\nf 5//1 7//1 8//1\n",
        z, z + 0.2);
}

// Number of pixels that differ in the columns from `from` to `to`.
std::size_t differentColumns(const Image& a, const Image& b, int from, int to)
{
    std::size_t different = 0;
    for (int y = 0; y < a.height; ++y)
        for (int x = from; x < to; ++x) {
            const std::size_t at = 4 * (std::size_t(y) * std::size_t(a.width) + std::size_t(x));
            different += !std::equal(a.bytes8() + at, a.bytes8() + at + 3, b.bytes8() + at);
        }
    return different;
}

TEST(ViewBake, theDividerHasTheModelOnTheLeftAndItsDetailOnTheRightInEachView)
{
    COTAN_NEEDS_DISPLAY();
    TemporaryFolder folder;
    write(quad(2), folder.path());
    writeHigh(folder / "one.obj", 0.1);
    writeHigh(folder / "two.obj", -0.3);
    std::string session = "0 wait\n0 wait\n0 do report r.txt\n0 do toggle interface\n0 do orbit 20 15\n";
    for (const char* show : {"shaded", "clay", "gloss", "normal"})
        session += fmt::format("0 do show {0}\n0 do compare divider\n0 wait\n0 do window {0}.png\n0 do compare flip\n"
                               "0 wait\n0 do window {0}-low.png\n0 do flip\n0 wait\n0 do window {0}-high.png\n",
                               show);
    session += "0 do picture high.png\n";
    for (const char* high : {"one.obj", "two.obj"}) {
        const ToolRun run = play(folder, session, {"quad.gltf", "--high", high, "--size", "200x150", "--overwrite"});
        ASSERT_EQ(run.code, 0) << run.err;
        const std::string report = readWhole(folder / "r.txt");
        EXPECT_EQ(lineOf(report, "model"), "quad.gltf");
        EXPECT_EQ(lineOf(report, "high"), "4 triangles");
        EXPECT_EQ(lineOf(report, "compare"), "divider");
        for (const std::string show : {"shaded", "clay", "gloss", "normal"}) {
            const Image both = readImageFile(folder / (show + ".png"));
            const Image low = readImageFile(folder / (show + "-low.png")),
                        detail = readImageFile(folder / (show + "-high.png"));
            ASSERT_EQ(both.width, 200);
            EXPECT_EQ(differentColumns(both, low, 0, 99), 0u) << show;
            EXPECT_EQ(differentColumns(both, detail, 101, 200), 0u) << show;
            EXPECT_GT(differentPixels(low, detail), 500u) << show;
        }
        const std::string command = runPrinted(folder, run.out, "high.png --size 200x150 --view normal");
        EXPECT_NE(command.find(high), std::string::npos) << run.out;
        EXPECT_EQ(differentPixels(readImageFile(folder / "high.png"), readImageFile(folder / "normal-high.png")), 0u);
    }
}

TEST(ViewBake, badDetailIsOneLineAndTheLastStays)
{
    COTAN_NEEDS_DISPLAY();
    TemporaryFolder folder;
    write(quad(2), folder.path());
    writeHigh(folder / "one.obj", 0.1);
    std::ofstream(folder / "bad.glb") << "glTF nonsense";
    const ToolRun run = play(folder,
                             "0 wait\n0 wait\n0 do high bad.glb\n0 wait\n0 do report a.txt\n0 do high missing.obj\n"
                             "0 wait\n0 do report b.txt\n0 do high\n0 wait\n0 do report c.txt\n",
                             {"quad.gltf", "--high", "one.obj", "--size", "100x80"});
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(lines(run.err), 2) << run.err;
    for (const auto& [report, file] : {std::pair("a.txt", "bad.glb"), {"b.txt", "missing.obj"}}) {
        const std::string text = readWhole(folder / report);
        EXPECT_EQ(lineOf(text, "high"), "4 triangles");
        EXPECT_NE(lineOf(text, "problem").find(file), std::string::npos) << text;
    }
    EXPECT_EQ(lineOf(readWhole(folder / "c.txt"), "high"), "none");
    const ToolRun first =
        play(folder, "0 wait\n0 wait\n0 do report d.txt\n", {"quad.gltf", "--high", "bad.glb", "--size", "100x80"});
    ASSERT_EQ(first.code, 0) << first.err; // the model is shown
    EXPECT_EQ(lines(first.err), 1) << first.err;
    EXPECT_EQ(lineOf(readWhole(folder / "d.txt"), "high"), "none");
}

// The whole model is seen from the front; uv cover it once.
TEST(ViewBake, aMaskIsShownTexelByTexelAndABadOneIsOneLine)
{
    COTAN_NEEDS_DISPLAY();
    TemporaryFolder folder;
    write(quad(2), folder.path());
    const std::array<std::uint8_t, 3> kRed = {255, 0, 0}, kGreen = {0, 179, 0}, kYellow = {255, 255, 0};
    const auto writeMask = [&](const char* name, const std::array<std::uint8_t, 3>& left,
                               const std::array<std::uint8_t, 3>& right) {
        Image mask = makeImage(2, 1, PixelType::unorm8);
        std::copy(left.begin(), left.end(), mask.bytes8());
        std::copy(right.begin(), right.end(), mask.bytes8() + 4);
        mask.bytes8()[3] = mask.bytes8()[7] = 255;
        ASSERT_TRUE(writeImage(folder / name, mask));
    };
    writeMask("one.png", kRed, kGreen);
    writeMask("two.png", kGreen, kYellow);
    std::ofstream(folder / "bad.png") << "no image";
    const ToolRun run = play(folder,
                             "0 wait\n0 do camera 1,0.5,4,1,0.5,0,h1\n0 do set mask two.png\n0 wait\n"
                             "0 do picture two-shown.png\n0 do set mask bad.png\n0 wait\n0 wait\n0 do report r.txt\n"
                             "0 do set mask one.png\n0 wait\n0 do picture one-shown.png\n0 do show mask\n",
                             {"quad.gltf", "--size", "100x50"});
    ASSERT_EQ(run.code, 0) << run.err;
    const std::string report = readWhole(folder / "r.txt");
    EXPECT_EQ(lineOf(report, "view"), "mask");
    EXPECT_EQ(lineOf(report, "mask"), "two.png");
    EXPECT_NE(lineOf(report, "problem").find("bad.png"), std::string::npos) << report;
    for (const auto& [name, left, right] : {std::tuple("one", kRed, kGreen), {"two", kGreen, kYellow}}) {
        const std::string file = fmt::format("{}-shown.png", name);
        const Image shown = readImageFile(folder / file);
        for (const int x : {3, 25, 48, 52, 75, 97}) { // also beside the border of the texels
            const std::uint8_t* p = shown.bytes8() + 4 * (25 * 100 + x);
            const auto& expected = x < 50 ? left : right;
            EXPECT_TRUE(std::equal(expected.begin(), expected.end(), p)) << name << ' ' << x;
        }
        std::filesystem::rename(folder / file, folder / "window.png");
        EXPECT_NE(runPrinted(folder, run.out, file).find(fmt::format("--mask {}.png", name)), std::string::npos)
            << run.out;
        EXPECT_EQ(differentPixels(readImageFile(folder / file), readImageFile(folder / "window.png")), 0u);
    }
    EXPECT_EQ(play(folder, "0 wait\n0 do show mask\n", {"quad.gltf", "--size", "100x50"}).code, 2); // without a file
}

// 24 degrees per second; a played session has its own time.
TEST(ViewBake, theTurntableTurnsByTheTimeOfTheSession)
{
    COTAN_NEEDS_DISPLAY();
    TemporaryFolder folder;
    write(quad(2), folder.path());
    for (const int steps : {1, 50}) {
        std::string session = "0 wait\n0 do see front\n0 wait\n0 key t\n";
        for (int i = 1; i <= steps; ++i)
            session += fmt::format("{:.4f} move {} 5\n", 3.75 * i / steps, i % 2);
        session += "3.75 key t\n3.75 wait\n3.75 do report a.txt\n9 move 5 5\n9 wait\n9 do report b.txt\n";
        const ToolRun turned = play(folder, session, {"quad.gltf", "--size", "100x80"});
        ASSERT_EQ(turned.code, 0) << turned.err;
        const std::string a = readWhole(folder / "a.txt"), b = readWhole(folder / "b.txt");
        EXPECT_EQ(lineOf(a, "turning"), "no");
        EXPECT_EQ(lineOf(a, "eye"), lineOf(b, "eye"));
        float x = 0, y = 0, z = 0;
        ASSERT_EQ(std::sscanf(lineOf(a, "eye").c_str(), "%f %f %f", &x, &y, &z), 3);
        EXPECT_LT(x, -0.5f); // from +z to -x of the middle, (1, 0.5, 0)
        EXPECT_NEAR(y, 0.5f, 0.01f);
        EXPECT_NEAR(z, 0, 0.01f);
    }
}

} // namespace
} // namespace cotan::test
