// `cotan render` with a turntable, with named sides and sizes, and without a background.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "cotan/image.hpp"
#include "run_tool.hpp"

namespace cotan {
namespace {

using namespace test;
using Words = std::vector<std::string>;

const Words kTeapot = {"render", "--shape", "teapot", "--size", "64x48", "--environment", "none", "--samples", "1"};

ToolRun draw(const Words& words, const TemporaryFolder& folder)
{
    Words all = kTeapot;
    all.insert(all.end(), words.begin(), words.end());
    return runTool(all, folder.path());
}

std::size_t count(const std::string& text, const std::string& part)
{
    std::size_t found = 0;
    for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; ++at)
        ++found;
    return found;
}

// Number of pixels with alpha above 0: at the edges of the image, and in total.
std::pair<int, int> seen(const Image& image)
{
    int edge = 0, all = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            if (image.bytes8()[4 * (y * image.width + x) + 3] > 0) {
                edge += x == 0 || y == 0 || x == image.width - 1 || y == image.height - 1;
                ++all;
            }
    return {edge, all};
}

double meanDifference(const Image& a, const Image& b)
{
    double sum = 0;
    const int size = 4 * a.width * a.height;
    for (int i = 0; i < size; ++i)
        sum += std::abs(a.bytes8()[i] - b.bytes8()[i]);
    return sum / size;
}

TEST(RenderTurntable, fileContainsAllImagesOfTheTurn)
{
    TemporaryFolder folder;
    for (const std::string file : {"turn.gif", "turn.webp"}) {
        const ToolRun run = draw({"--device", "reference", "--turntable", "5", "-o", file}, folder);
        ASSERT_EQ(run.code, 0) << run.err;
        EXPECT_EQ(run.err, ""); // the default rate suits the format
        EXPECT_EQ(lines(run.out), 1) << run.out;
        const std::string bytes = readWhole(folder / file);
        // Graphic control extensions, and ANMF chunks.
        EXPECT_EQ(count(bytes, file == "turn.gif" ? std::string("\x21\xf9\x04", 3) : "ANMF"), 5u) << file;
    }
}

TEST(RenderTurntable, imagesDifferFitAndAgreeOnBothRenderers)
{
    TemporaryFolder folder;
    const Words turn = {"--turntable", "4", "--background", "none", "--ground", "off"};
    const auto with = [&](Words more) {
        more.insert(more.begin(), turn.begin(), turn.end());
        return more;
    };
    ASSERT_EQ(draw(with({"--device", "reference", "-o", "r.png"}), folder).code, 0);
    ASSERT_EQ(draw(with({"-o", "v.png"}), folder).code, 0); // Vulkan if there is a device
    std::set<std::string> different;
    for (int i = 0; i < 4; ++i) {
        const std::string number = "-000" + std::to_string(i) + ".png";
        const auto reference = readImage(folder / ("r" + number)), device = readImage(folder / ("v" + number));
        ASSERT_TRUE(reference && device);
        const auto [edge, all] = seen(*reference);
        EXPECT_EQ(edge, 0) << i;
        EXPECT_GT(all, 64 * 48 / 8) << i;
        EXPECT_LT(meanDifference(*reference, *device), 1.5) << i; // of 255: edges, one sample per pixel
        different.insert(readWhole(folder / ("r" + number)));
    }
    EXPECT_EQ(different.size(), 4u);
    EXPECT_FALSE(std::filesystem::exists(folder / "r.png"));
}

TEST(RenderTurntable, oppositeCameraSeesTheHalfTurn)
{
    // `facing` is independent of light: turning the model by 180 degrees equals turning the camera by 180 degrees.
    TemporaryFolder folder;
    ASSERT_EQ(
        draw({"--device", "reference", "--view", "facing", "--camera", "orbit:0,20", "--turntable", "2", "-o", "t.png"},
             folder)
            .code,
        0);
    ASSERT_EQ(draw({"--device", "reference", "--view", "facing", "--camera", "orbit:180,20", "--turntable", "2", "-o",
                    "b.png"},
                   folder)
                  .code,
              0);
    const auto rotated = readImage(folder / "t-0001.png"), behind = readImage(folder / "b-0000.png");
    ASSERT_TRUE(rotated && behind);
    EXPECT_LT(meanDifference(*rotated, *behind), 0.2);
    EXPECT_GT(meanDifference(*rotated, *readImage(folder / "t-0000.png")), 1);
}

TEST(RenderTurntable, badOptionsAreRefusedInOneLineAndNothingIsWritten)
{
    const std::pair<Words, std::string> cases[] = {
        {{"--turntable", "1", "-o", "a.gif"}, "--turntable: expected a whole number from 2 to 3600; found '1'"},
        {{"--turntable", "4", "--frames", "0..2", "-o", "a.gif"}, "expected neither --frames nor --json"},
        {{"--turntable", "4", "--json", "r.json", "-o", "a.gif"}, "expected neither --frames nor --json"},
        {{"--turntable", "4", "--rate", "60", "-o", "a.gif"},
         "a.gif: expected at most 50 images per second in such a file; found 60"},
        {{"-o", "a.gif"}, "hold the images of --turntable or --frames"},
        {{"--background", "none", "--turntable", "4", "-o", "a.gif"},
         "--background none: .gif files keep no transparency; expected .png"},
        {{"--background", "none", "-o", "a.jpg"}, "--background none: .jpg files keep no transparency"},
        {{"--camera", "orbit:10", "-o", "a.png"}, "--camera: expected orbit:AZ,EL"},
        {{"--camera", "orbit:361,0", "-o", "a.png"}, "--camera: expected orbit:AZ,EL"},
        {{"--camera", "orbit:0,-91", "-o", "a.png"}, "--camera: expected orbit:AZ,EL"},
        {{"--camera", "orbit:nan,0", "-o", "a.png"}, "--camera: expected orbit:AZ,EL"},
        {{"--camera", "sideways", "-o", "a.png"}, "--camera: expected front, left, right, top, bottom, back, fit"},
    };
    for (const auto& [words, message] : cases) {
        TemporaryFolder folder;
        const ToolRun run = draw(words, folder);
        EXPECT_EQ(run.code, 1) << message;
        EXPECT_EQ(lines(run.err), 1) << run.err;
        EXPECT_NE(run.err.find(message), std::string::npos) << run.err;
        EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << message;
    }
    TemporaryFolder folder;
    const ToolRun run = runTool({"render", "--size", "huge", "-o", "a.png"}, folder.path());
    EXPECT_EQ(run.code, 1);
    EXPECT_NE(run.err.find("thumbnail, 720p"), std::string::npos) << run.err;
}

TEST(RenderTurntable, sizesMayBeNamed)
{
    TemporaryFolder folder;
    const ToolRun run = runTool({"render", "--shape", "plane", "--size", "thumbnail", "--device", "reference",
                                 "--environment", "none", "--samples", "1", "-o", "a.png"},
                                folder.path());
    ASSERT_EQ(run.code, 0) << run.err;
    const auto image = readImage(folder / "a.png");
    ASSERT_TRUE(image);
    EXPECT_EQ(image->width, 320);
    EXPECT_EQ(image->height, 180);
}

} // namespace
} // namespace cotan
