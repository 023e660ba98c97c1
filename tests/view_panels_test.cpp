// The panels that `cotan view` draws over the image: their positions, their contents and clicks on them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "quad_model.hpp"
#include "view_window.hpp"

namespace cotan::test {
namespace {

// At a scale of 1 text is 15 pixels high, a line of the interface 21.
constexpr int kWide = 640, kHigh = 480, kLine = 21;

using Pixel = std::array<int, 3>;

Pixel pixelAt(const Image& image, int x, int y)
{
    const std::uint8_t* p = image.bytes8() + 4 * (std::size_t(y) * std::size_t(image.width) + std::size_t(x));
    return {p[0], p[1], p[2]};
}

bool isNear(const Pixel& a, const Pixel& b, int tolerance)
{
    return std::abs(a[0] - b[0]) <= tolerance && std::abs(a[1] - b[1]) <= tolerance
        && std::abs(a[2] - b[2]) <= tolerance;
}

int countWhere(const Image& image, const std::function<bool(int, int)>& holds)
{
    int count = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            count += holds(x, y);
    return count;
}

int countOf(const Image& image, const Pixel& color, int tolerance = 2)
{
    return countWhere(image, [&](int x, int y) { return isNear(pixelAt(image, x, y), color, tolerance); });
}

class ViewPanels : public ::testing::Test {
protected:
    TemporaryFolder folder;
    void SetUp() override
    {
        if (display().empty())
            GTEST_SKIP() << "no Xvfb to open a window on";
        write(quad(2), folder.path());
    }
    void show(const std::string& session, std::vector<std::string> words = {})
    {
        words.insert(words.begin(),
                     {"quad.gltf", "--size", fmt::format("{}x{}", kWide, kHigh), "--device", "reference", "--samples",
                      "1", "--ground", "off", "--camera", "1,0.5,3,1,0.5,0"});
        const ToolRun run = play(folder, "0 do scale 1\n0 wait\n" + session, words);
        ASSERT_EQ(run.code, 0) << run.err;
        out = run.out;
    }
    Image image(const std::string& name) const { return readImageFile(folder / name); }
    std::string report(const std::string& file, const std::string& line) const
    {
        return lineOf(readWhole(folder / file), line);
    }
    std::string out;
};

// Session lines for a click.
std::string clickAt(int x, int y) { return fmt::format("0 move {} {}\n0 press left\n0 release left\n0 wait\n", x, y); }

TEST_F(ViewPanels, theDividerShowsTheFirstLeftAndTheSecondRight)
{
    show("0 do toggle interface\n0 do second frame exact\n0 do show normal\n0 do divider 0.25\n0 wait\n"
         "0 do picture a.png\n0 do compare flip\n0 do flip\n0 wait\n0 do picture b.png\n"
         "0 do compare divider\n0 wait\n0 do window d.png\n0 do compare angle\n0 wait\n0 do window angle.png\n"
         "0 do picture angle-file.png\n");
    const Image a = image("a.png"), b = image("b.png"), d = image("d.png");
    ASSERT_GT(differentPixels(a, b), 1000u);
    EXPECT_EQ(countWhere(d, [&](int x, int y) { return pixelAt(d, x, y) != pixelAt(x < kWide / 4 ? a : b, x, y); }), 0);
    EXPECT_EQ(differentPixels(image("angle.png"), image("angle-file.png")), 0u);
}

TEST_F(ViewPanels, theBarScalesWithItsTextAndFollowsTheTheme)
{
    show("0 do toggle interface\n0 do window bare.png\n0 do toggle interface\n0 do window dark.png\n"
         "0 do scale 2\n0 do window large.png\n0 do scale 1\n0 do toggle look\n0 do window light.png\n"
         "0 do toggle look\n0 do window again.png\n");
    const Image bare = image("bare.png"), dark = image("dark.png");
    const auto barOf = [&](const Image& window) { // rows that differ at the right end, where no menu is
        int rows = 0;
        while (rows < kHigh && pixelAt(window, kWide - 5, rows) != pixelAt(bare, kWide - 5, rows))
            ++rows;
        return rows;
    };
    EXPECT_NEAR(barOf(dark), kLine, 1);
    EXPECT_NEAR(barOf(image("large.png")), 2 * kLine, 2);
    const auto bright = [](const Pixel& p) { return p[0] + p[1] + p[2]; };
    EXPECT_LT(bright(pixelAt(dark, kWide - 5, 5)), 200);
    EXPECT_GT(bright(pixelAt(image("light.png"), kWide - 5, 5)), 600);
    EXPECT_EQ(differentPixels(dark, image("again.png")), 0u);
    // Nothing covers the middle of the image.
    EXPECT_EQ(countWhere(dark,
                         [&](int x, int y) {
                             return y > 2 * kLine && y < kHigh - 4 * kLine
                                 && pixelAt(dark, x, y) != pixelAt(bare, x, y);
                         }),
              0);
}

TEST_F(ViewPanels, eachSliderSetsItsOwnSettingUpToBothEnds)
{
    const char* const names[] = {"exposure", "environment-rotation", "environment-intensity", "shadow-softness"};
    const char* const low[] = {"0.05", "-180", "0.05", "0"};
    const char* const high[] = {"20", "180", "20", "60"};
    const int left = kLine / 2 + 8, width = 9 * kLine; // padding of a panel
    std::string session = "0 do toggle settings\n0 wait\n0 do window sliders.png\n";
    for (int k = 0; k < 4; ++k) {
        const int y = 3 * kLine + 8 + k * (kLine + 4) + kLine / 2; // a title, and a gap between sliders
        session += clickAt(left + 2, y) + fmt::format("0 do report low{}.txt\n", k);
        session += clickAt(left + width - 2, y) + fmt::format("0 do report high{}.txt\n", k);
        session += clickAt(left + width / 2, y) + fmt::format("0 do report middle{}.txt\n", k);
    }
    show(session + clickAt(kWide - 40, kHigh / 2));
    for (int k = 0; k < 4; ++k) {
        EXPECT_EQ(report(fmt::format("low{}.txt", k), names[k]), low[k]);
        EXPECT_EQ(report(fmt::format("high{}.txt", k), names[k]), high[k]);
        const double middle = std::stod(report(fmt::format("middle{}.txt", k), names[k]));
        const double expected = k == 1 ? 0 : k == 3 ? 30 : 1; // the geometric mean of 0.05 and 20 is one
        EXPECT_NEAR(middle, expected, k == 1 ? 5 : k == 3 ? 1 : 0.1) << names[k];
        EXPECT_EQ(report(fmt::format("high{}.txt", k), "camera moved"),
                  "no"); // the panel consumes the click
    }
}

TEST_F(ViewPanels, theScaleOfDegreesHasItsColoursAtItsStops)
{
    show("0 do toggle card\n0 do compare angle\n0 do second frame exact\n0 wait\n0 do window angle.png\n");
    const Image angle = image("angle.png");
    const Pixel stops[] = {{0, 0, 0}, {20, 60, 200}, {30, 180, 80}, {250, 220, 40}, {220, 30, 20}, {255, 255, 255}};
    const int x = int(kWide - 4.5 * 15) + 7; // in the bar, whose left end is 4.5 text heights from the right
    for (int k = 0; k <= 5; ++k) {
        const int y = kHigh / 4 + (5 - k) * kHigh / 2 / 5 + (k == 5 ? 1 : k == 0 ? -1 : 0);
        EXPECT_TRUE(isNear(pixelAt(angle, x, y), stops[k], 12))
            << k << " " << ::testing::PrintToString(pixelAt(angle, x, y));
    }
    const Pixel between = pixelAt(angle, x, kHigh / 4 + kHigh / 20); // halfway between the last two
    EXPECT_TRUE(isNear(between, {237, 142, 137}, 12)) << ::testing::PrintToString(between);
}

// The card is next to the pointer, on the side that has enough space.
TEST_F(ViewPanels, theCardIsNextToThePointerAndArrowsAreDrawn)
{
    std::string session;
    const std::vector<glm::ivec2> positions = {{150, 160}, {490, 160}, {150, 320}, {490, 320}};
    for (std::size_t k = 0; k < positions.size(); ++k)
        session += fmt::format("0 move {} {}\n0 wait\n0 do window on{}.png\n0 do report r{}.txt\n", positions[k].x,
                               positions[k].y, k, k);
    session += "0 do toggle card\n0 wait\n0 do window off.png\n";
    show(session);
    const Image off = image("off.png");
    EXPECT_EQ(countOf(off, {242, 76, 64}), 0);
    for (std::size_t k = 0; k < positions.size(); ++k) {
        const Image on = image(fmt::format("on{}.png", k));
        EXPECT_NE(report(fmt::format("r{}.txt", k), "uv"), "no such line");
        int rightOf = 0, leftOf = 0, above = 0, below = 0; // out of reach of the arrows
        for (int y = kLine + 1; y < kHigh - 5 * kLine; ++y)
            for (int x = 0; x < kWide; ++x)
                if (pixelAt(on, x, y) != pixelAt(off, x, y)) {
                    rightOf += x > positions[k].x + 130;
                    leftOf += x < positions[k].x - 130;
                    above += y < positions[k].y - 90;
                    below += y > positions[k].y + 90;
                }
        const bool right = positions[k].x > 0.6 * kWide, low = positions[k].y > 0.6 * kHigh;
        EXPECT_EQ(rightOf > 100, !right) << k;
        EXPECT_EQ(leftOf > 100, right) << k;
        EXPECT_EQ(above > 100, low) << k;
        EXPECT_EQ(below > 100, !low) << k;
        EXPECT_GT(countOf(on, {242, 76, 64}), 30) << k; // t
        EXPECT_GT(countOf(on, {89, 217, 76}), 30) << k; // b
    }
}

TEST_F(ViewPanels, errorsKeysAndProblemAreasHaveTheirColours)
{
    std::ofstream(folder / "bad.glb") << "glTF nonsense";
    show("0 do toggle card\n0 do window before.png\n0 do toggle help\n0 do window keys.png\n0 do toggle help\n"
         "0 do toggle hot-spots\n0 wait\n0 do window spots.png\n"
         + clickAt(kWide - 60, 3 * kLine + 8 + 7) + "0 do report spot.txt\n0 do toggle hot-spots\n"
         + "0 drop bad.glb\n0 wait\n0 do window problem.png\n0 do toggle look\n0 drop bad.glb\n0 wait\n"
           "0 do window light.png\n");
    const Pixel problem{255, 140, 102}, onLight{191, 25, 0}, key{242, 191, 51};
    EXPECT_EQ(countOf(image("before.png"), problem, 8), 0);
    EXPECT_GT(countOf(image("problem.png"), problem, 8), 30);
    EXPECT_GT(countOf(image("light.png"), onLight, 12), 30);
    EXPECT_EQ(countOf(image("before.png"), key, 4), 0);
    EXPECT_GT(countOf(image("keys.png"), key, 4), 100);
    const Image before = image("before.png"), spots = image("spots.png");
    int changedLeft = 0, changedRight = 0;
    for (int y = 2 * kLine; y < kHigh / 2; ++y)
        for (int x = 0; x < kWide; ++x)
            (x < kWide / 3 ? changedLeft : changedRight) += pixelAt(spots, x, y) != pixelAt(before, x, y);
    EXPECT_EQ(changedLeft, 0);
    EXPECT_GT(changedRight, 500);
    EXPECT_EQ(report("spot.txt", "camera moved"), "yes");
}

// The options of the command line set the initial state of the session.
TEST_F(ViewPanels, commandLineOptionsSetBothSides)
{
    ASSERT_TRUE(writeImage(folder / "n.png", makeReliefMap(Relief::domes, 16)));
    show("0 do report r.txt\n0 key d\n0 wait\n0 do report off.txt\n",
         {"--frame", "smooth", "--second", "exact", "--tangents", "generated", "--normal-map", "n.png", "--convention",
          "directx", "--view", "normal", "--do", "divider 0.25", "--do", "toggle card", "--json", "end.json"});
    const std::vector<std::pair<const char*, const char*>> lines = {{"first", "smooth generated n.png directx"},
                                                                    {"second", "exact generated n.png directx"},
                                                                    {"compare", "divider"},
                                                                    {"divider", "0.250"},
                                                                    {"view", "normal"},
                                                                    {"size", "640x480"},
                                                                    {"loads", "1 failed 0"}};
    for (const auto& [name, value] : lines)
        EXPECT_EQ(report("r.txt", name), value) << name;
    EXPECT_EQ(report("r.txt", "degrees").find("first against second: mean "), 0u) << report("r.txt", "degrees");
    EXPECT_EQ(report("off.txt", "compare"), "off");
    const json end = json::parse(readWhole(folder / "end.json"));
    EXPECT_EQ(end["command"], "view");
    EXPECT_EQ(end["device"], "reference");
    EXPECT_EQ(end["loads"], 1);
    EXPECT_EQ(end["failed_loads"], 0);
    EXPECT_EQ(end["events_played"], 6);
    EXPECT_EQ(end["images_drawn"], 2); // with the divider, and without
    EXPECT_EQ(end["ended"], "last event");
    for (const char* what : {"window", "load", "first_image", "first_shown"})
        EXPECT_GT(end["seconds"][what].get<double>(), 0) << what;
}

TEST_F(ViewPanels, theClipboardReturnsTheCopiedText)
{
    show("0 do copy camera\n0 do paste\n0 wait\n0 do report pasted.txt\n");
    const std::string camera = out.substr(0, out.find('\n'));
    ASSERT_EQ(std::ranges::count(camera, ','), 6) << out; // eye, target, field of view
    EXPECT_NE(report("pasted.txt", "problem").find(camera), std::string::npos) << report("pasted.txt", "problem");
}

TEST_F(ViewPanels, theWheelZoomsOverTheImageAndScrollsOverAPanel)
{
    show("0 do toggle settings\n0 wait\n0 move 60 80\n0 scroll 0 2\n0 wait\n0 do report panel.txt\n"
         "0 move 420 240\n0 scroll 0 2\n0 wait\n0 do report image.txt\n0 scroll 0 -2\n0 wait\n0 do report back.txt\n");
    EXPECT_EQ(report("panel.txt", "camera moved"), "no");
    EXPECT_EQ(report("image.txt", "camera moved"), "yes");
    EXPECT_NE(report("image.txt", "eye"), report("panel.txt", "eye"));
    EXPECT_EQ(report("back.txt", "eye"), report("panel.txt", "eye"));
}

} // namespace
} // namespace cotan::test
