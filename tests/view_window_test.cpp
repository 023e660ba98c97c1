// `cotan view` in a window: its exact image, the pointer and the keys.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "quad_model.hpp"
#include "view_window.hpp"

namespace cotan::test {
namespace {

TEST(ViewWindow, showsExactlyTheImageOfRender)
{
    COTAN_NEEDS_DISPLAY();
    TemporaryFolder folder;
    write(quad(2), folder.path());
    for (const std::vector<std::string>& options : std::vector<std::vector<std::string>>{
             {"--size", "320x180"},
             {"--size", "1000x700", "--environment", "none"}, // drawn in bands
             {"quad.gltf", "--size", "301x203", "--frame", "smooth"},
             {"quad.gltf", "--size", "200x150", "--view", "normal", "--frame", "mikktspace"},
             {"--shape", "torus", "--size", "240x160", "--environment", "evening", "--device", "reference"},
             {"--size", "160x120", "--samples", "1", "--ground", "off", "--tone-mapping", "agx", "--camera",
              "1,2,6,0,0.5,0,h3"}}) {
        const ToolRun seen = play(folder, "0 do toggle interface\n0 wait\n0 do window window.png\n", options);
        ASSERT_EQ(seen.code, 0) << seen.err;
        std::vector<std::string> words = options;
        words.insert(words.begin(), "render");
        words.insert(words.end(), {"-o", "render.png", "--overwrite"});
        const ToolRun drawn = runTool(words, folder.path());
        ASSERT_EQ(drawn.code, 0) << drawn.err;
        EXPECT_EQ(differentPixels(readImageFile(folder / "window.png"), readImageFile(folder / "render.png")), 0u)
            << ::testing::PrintToString(options);
    }
}

TEST(ViewWindow, framesStayOnTheDeviceUntilAPictureIsAskedFor)
{
    COTAN_NEEDS_DISPLAY();
    TemporaryFolder folder;
    const std::string frames = "0 wait\n0 do orbit 20 5\n0 wait\n0 do compare divider\n0 wait\n"
                               "0 do show checker\n0 wait\n0 do show shaded\n0 wait\n0 do toggle interface\n0 wait\n";
    const auto imagesRead = [&](const std::string& session, const std::vector<std::string>& more) {
        std::vector<std::string> words{"--shape", "torus",  "--size",      "160x120", "--exposure",       "1",
                                       "--json",  "j.json", "--overwrite", "--do",    "toggle statistics"};
        words.insert(words.end(), more.begin(), more.end());
        const ToolRun run = play(folder, session, words);
        EXPECT_EQ(run.code, 0) << run.err;
        const std::string report = readWhole(folder / "j.json"), name = "\"images_read\": ";
        return std::stoi(report.substr(report.find(name) + name.size()));
    };
    EXPECT_EQ(imagesRead(frames, {}), 0);
    EXPECT_EQ(imagesRead(frames + "0 do window w.png\n0 do picture p.png\n", {}), 2);
    EXPECT_GT(imagesRead(frames, {"--view", "normal"}), 0); // colours of values are made by the host
}

// Both halves are drawn by one renderer, one after the other.
TEST(ViewWindow, theDividerShowsTheImagesOfBothFrames)
{
    COTAN_NEEDS_DISPLAY();
    TemporaryFolder folder;
    write(quad(2), folder.path());
    const std::vector<std::string> options{"quad.gltf", "--size", "200x120", "--exposure", "1"};
    std::vector<std::string> words = options;
    words.insert(words.end(), {"--frame", "cotangent", "--second", "paper-nodet"});
    const ToolRun run = play(folder, "0 wait\n0 do toggle interface\n0 do window w.png\n", words);
    ASSERT_EQ(run.code, 0) << run.err;
    const Image window = readImageFile(folder / "w.png");
    ASSERT_EQ(window.width, 200);
    std::array<Image, 2> sides;
    for (const auto& [frame, side] : {std::pair("cotangent", 0), {"paper-nodet", 1}}) {
        std::vector<std::string> render = options;
        render.insert(render.begin(), "render");
        render.insert(render.end(), {"--frame", frame, "-o", "r.png", "--overwrite"});
        ASSERT_EQ(runTool(render, folder.path()).code, 0);
        sides[std::size_t(side)] = readImageFile(folder / "r.png");
    }
    EXPECT_GT(differentPixels(sides[0], sides[1]), 100u);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < window.pixelCount(); ++i) {
        const Image& side = sides[i % 200 < 100 ? 0 : 1];
        wrong += !std::equal(window.bytes8() + 4 * i, window.bytes8() + 4 * i + 3, side.bytes8() + 4 * i);
    }
    EXPECT_EQ(wrong, 0u);
}

TEST(ViewWindow, thePrintedCommandDrawsTheSameImage)
{
    COTAN_NEEDS_DISPLAY();
    TemporaryFolder folder;
    const ToolRun seen =
        play(folder,
             "0 wait\n0 do orbit 33.3 7\n0 do zoom 0.7\n0 do pan 11 -7\n0 do frame exact\n"
             "0 do set environment overcast\n0 do set shadow-softness 3\n0 wait\n0 do toggle interface\n"
             "0 do picture a.png\n0 do window window.png\n0 do orthographic\n0 do see top\n0 wait\n"
             "0 do picture b.png\n0 do picture c.exr 60 40\n",
             {"--size", "160x120"});
    ASSERT_EQ(seen.code, 0) << seen.err;
    EXPECT_EQ(differentPixels(readImageFile(folder / "window.png"), readImageFile(folder / "a.png")), 0u);
    for (const std::string name : {"a.png", "b.png", "c.exr"}) {
        std::filesystem::rename(folder / name, folder / ("viewer-" + name));
        const std::string command = runPrinted(folder, seen.out, name);
        ASSERT_NE(command, "") << seen.out;
        EXPECT_TRUE(readWhole(folder / name) == readWhole(folder / ("viewer-" + name))) << command;
    }
}

TEST(ViewWindow, noDisplayGivesExitCodeThreeAndOneLine)
{
    TemporaryFolder folder;
    ::unsetenv("DISPLAY");
    ::unsetenv("WAYLAND_DISPLAY");
    for (const char* name : {"", ":40777"}) { // none, and one that does not exist
        if (*name)
            ::setenv("DISPLAY", name, 1);
        const ToolRun run = runTool({"view", "--forget"}, folder.path());
        EXPECT_EQ(run.code, 3);
        EXPECT_EQ(lines(run.err), 1) << run.err;
        EXPECT_NE(run.err.find("display"), std::string::npos) << run.err;
    }
}

TEST(ViewWindow, dragsAndKeysAreDeterministic)
{
    COTAN_NEEDS_DISPLAY();
    TemporaryFolder folder;
    const std::string session = "0 wait\n0.1 move 100 100\n0.1 press left\n0.2 move 130 90\n0.3 release left\n"
                                "0.4 scroll 0 2\n0.5 key 4\n0.5 key d\n0.6 move 160 60\n0.6 press left\n"
                                "0.7 move 200 60\n0.7 release left\n0.8 wait\n0.8 do report {}.txt\n"
                                "0.8 do window {}.png\n";
    for (const std::string name : {"one", "two"}) {
        const ToolRun run = play(folder, fmt::format(fmt::runtime(session), name, name),
                                 {"--size", "320x180", "--device", "reference"});
        ASSERT_EQ(run.code, 0) << run.err;
    }
    const std::string report = readWhole(folder / "one.txt");
    EXPECT_EQ(report, readWhole(folder / "two.txt"));
    EXPECT_TRUE(readWhole(folder / "one.png") == readWhole(folder / "two.png"));
    EXPECT_EQ(lineOf(report, "first"), "smooth stored - -");
    EXPECT_EQ(lineOf(report, "compare"), "divider");
    EXPECT_EQ(lineOf(report, "divider"), "0.625");
    EXPECT_EQ(lineOf(report, "camera moved"), "yes");
    EXPECT_EQ(lineOf(report, "problem"), "none");
}

TEST(ViewWindow, thePointerOpensMenusAndChoosesEntries)
{
    COTAN_NEEDS_DISPLAY();
    TemporaryFolder folder;
    // The fourth menu, which fits below the bar, and one of its first entries.
    const ToolRun run =
        play(folder,
             "0 do scale 1\n0 wait\n0 move 240 10\n0 press left\n0 release left\n0 wait\n0 do window menu.png\n"
             "0 move 255 80\n0 press left\n0 release left\n0 wait\n0 do report r.txt\n",
             {"--shape", "plane", "--size", "640x600"});
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(lineOf(readWhole(folder / "r.txt"), "first"), "triangle stored - -");
    EXPECT_EQ(lineOf(readWhole(folder / "r.txt"), "camera moved"),
              "no"); // the menu consumes the click
}

// Exit code 0 does not tell a complete session from one that chose Quit early.
TEST(ViewWindow, theReportSaysHowASessionEnded)
{
    COTAN_NEEDS_DISPLAY();
    TemporaryFolder folder;
    const std::string quitInAMenu = "0 do scale 1\n0 wait\n0 move 20 10\n0 press left\n0 release left\n0 wait\n" // File
                                    "0 move 25 270\n0 press left\n0 release left\n0 wait\n"; // its last entry
    for (const auto& [session, by] : std::vector<std::pair<std::string, std::string>>{{"0 wait\n", "last event"},
                                                                                      {quitInAMenu, "menu"},
                                                                                      {"0 key ctrl+q\n", "key"},
                                                                                      {"0 close\n", "close button"},
                                                                                      {"0 do quit\n", "command"}}) {
        const ToolRun run =
            play(folder, session + "0 wait\n0 do report r.txt\n",
                 {"--shape", "plane", "--size", "640x600", "--device", "reference", "--json", "end.json"});
        ASSERT_EQ(run.code, 0) << run.err;
        const std::string end = readWhole(folder / "end.json");
        EXPECT_NE(end.find(fmt::format(R"("ended": "{}")", by)), std::string::npos) << end;
        EXPECT_EQ(std::filesystem::remove(folder / "r.txt"), by == "last event") << by;
    }
}

TEST(ViewWindow, survivesResizingAndLostSurfaces)
{
    COTAN_NEEDS_DISPLAY();
    TemporaryFolder folder;
    const ToolRun run = play(folder,
                             "0 wait\n0 resize 333 211\n0 wait\n0 do lose-surface\n0 wait\n0 do size 90 500\n0 wait\n"
                             "0 do lose-surface\n0 do size 300 200\n0 wait\n0 do toggle interface\n0 do window w.png\n"
                             "0 do report r.txt\n",
                             {"--size", "200x150"});
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(lineOf(readWhole(folder / "r.txt"), "size"), "300x200");
    const ToolRun drawn = runTool(
        {"render", "-o", "r.png", "--size", "300x200", "--exposure", lineOf(readWhole(folder / "r.txt"), "metered")},
        folder.path());
    ASSERT_EQ(drawn.code, 0) << drawn.err;
    EXPECT_EQ(readImageFile(folder / "w.png").width, 300);
}

TEST(ViewWindow, recordedSessionsReplayIdentically)
{
    COTAN_NEEDS_DISPLAY();
    TemporaryFolder folder;
    const std::string session = "0 wait\n0.1 move 100 60\n0.1 press left\n0.2 move 130 90\n0.3 release left\n"
                                "0.4 scroll 0 -1\n0.5 key 3\n0.6 do toggle look\n";
    const ToolRun first =
        play(folder, session + "9 do report a.txt\n", {"--size", "160x120", "--record", "recorded.txt"});
    ASSERT_EQ(first.code, 0) << first.err;
    const std::string recorded = readWhole(folder / "recorded.txt");
    const ToolRun second = play(folder, recorded.substr(0, recorded.find("9.000 do report")) + "9 do report b.txt\n",
                                {"--size", "160x120"});
    ASSERT_EQ(second.code, 0) << second.err << recorded;
    EXPECT_EQ(readWhole(folder / "a.txt"), readWhole(folder / "b.txt"));
    EXPECT_EQ(lineOf(readWhole(folder / "b.txt"), "camera moved"), "yes");
    const ToolRun nowhere = play(folder, "0 wait\n", {"--size", "64x48", "--record", "no/such/folder.txt"});
    EXPECT_EQ(nowhere.code, 4) << nowhere.err;
}

} // namespace
} // namespace cotan::test
