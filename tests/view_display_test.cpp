// `cotan view` on displays with fewer features than usual, and under a window manager.
#include <gtest/gtest.h>

#include <cstdlib>

#include <fmt/format.h>

#include "quad_model.hpp"
#include "view_window.hpp"

namespace cotan::test {
namespace {

// Like a display on another machine, which shares no memory with the tool.
TEST(ViewDisplay, theImageIsTheSameWithoutSharedMemory)
{
    const Display far({"-extension", "MIT-SHM"});
    if (far.name().empty())
        GTEST_SKIP() << "no Xvfb to open a window on";
    TemporaryFolder folder;
    for (const auto& [on, name] : {std::pair(far.name(), "far"), {display(), "near"}}) {
        const ToolRun run = play(
            folder, fmt::format("0 wait\n0 resize 333 211\n0 wait\n0 do toggle interface\n0 do window {}.png\n", name),
            {"--size", "200x150"}, on);
        ASSERT_EQ(run.code, 0) << run.err;
    }
    EXPECT_EQ(readImageFile(folder / "far.png").width, 333);
    EXPECT_EQ(differentPixels(readImageFile(folder / "far.png"), readImageFile(folder / "near.png")), 0u);
}

// Drivers of Vulkan present on screens whose pixels store colours, and not on those whose pixels index a palette.
TEST(ViewDisplay, noPresentingDeviceGivesExitCodeThreeAndOneLine)
{
    const Display palette({"-screen", "0", "640x480x8"});
    if (palette.name().empty())
        GTEST_SKIP() << "no Xvfb to open a window on";
    TemporaryFolder folder;
    const ToolRun run = play(folder, "0 wait\n", {}, palette.name());
    EXPECT_EQ(run.code, 3);
    EXPECT_EQ(lines(run.err), 1) << run.err;
    EXPECT_NE(run.err.find("present"), std::string::npos) << run.err;
    ::setenv("VK_DRIVER_FILES", "/nowhere.json", 1);
    ::setenv("VK_ICD_FILENAMES", "/nowhere.json", 1);
    const ToolRun none = play(folder, "0 wait\n");
    ::unsetenv("VK_DRIVER_FILES");
    ::unsetenv("VK_ICD_FILENAMES");
    EXPECT_EQ(none.code, 3);
    EXPECT_EQ(lines(none.err), 1) << none.err;
    EXPECT_NE(none.err.find("Vulkan"), std::string::npos) << none.err;
}

// A window manager unmaps a window to minimise it. Keys and pointer are those of the display here.
TEST(ViewDisplay, windowsHandleMinimisingResizingAndKeys)
{
    COTAN_NEEDS_DISPLAY();
    if (std::system("command -v xdotool > /dev/null") != 0)
        GTEST_SKIP() << "no xdotool to move a window with";
    TemporaryFolder folder;
    write(quad(2), folder.path());
    std::ofstream(folder / "session.sh")
        << "export DISPLAY=" << display() << "\n"
        << COTAN_TOOL << " view quad.gltf --size 300x200 --forget --record recorded.txt --json times.json &\n"
        << "window=$(timeout 20 xdotool search --sync --onlyvisible --name quad.gltf | head -1)\n"
           "xdotool mousemove --sync 150 100 windowunmap --sync $window sleep 0.5 windowmap --sync $window\n"
           "xdotool windowsize $window 1 1 sleep 0.3 windowsize $window 260 180 sleep 0.5\n"
           "xdotool key 4 sleep 0.3 mousemove 130 90 mousedown 1 mousemove 150 95 mouseup 1 sleep 0.3 key ctrl+q\n"
           "wait $!\n";
    EXPECT_EQ(std::system(("cd " + folder.path().string() + " && timeout 60 sh session.sh").c_str()), 0);
    const std::string recorded = readWhole(folder / "recorded.txt");
    for (const char* word : {" key 4\n", " press left\n", " release left\n", " key ctrl+q\n"})
        EXPECT_NE(recorded.find(word), std::string::npos) << word << " in:\n" << recorded;
    EXPECT_TRUE(std::filesystem::exists(folder / "times.json"));
}

// In a window there is someone to read the error and to fix it: the file is loaded as soon as it exists.
TEST(ViewDisplay, windowsLoadAMissingFirstModelOnceItExists)
{
    COTAN_NEEDS_DISPLAY();
    if (std::system("command -v xdotool > /dev/null") != 0)
        GTEST_SKIP() << "no xdotool to send keys with";
    TemporaryFolder folder;
    write(quad(2), folder.path());
    std::filesystem::rename(folder / "quad.gltf", folder / "later.gltf");
    std::ofstream(folder / "session.sh")
        << "export DISPLAY=" << display() << "\n"
        << COTAN_TOOL << " view first.gltf --size 300x200 --forget --json times.json 2> said.txt &\n"
        << "timeout 20 xdotool search --sync --onlyvisible --name '^cotan view$' > /dev/null\n"
           "sleep 0.5; mv later.gltf first.gltf\n"
           "timeout 20 xdotool search --sync --onlyvisible --name first.gltf mousemove 150 100 > /dev/null\n"
           "xdotool key ctrl+q\n"
           "wait $!\n";
    EXPECT_EQ(std::system(("cd " + folder.path().string() + " && timeout 60 sh session.sh").c_str()), 0);
    EXPECT_EQ(lines(readWhole(folder / "said.txt")), 1) << readWhole(folder / "said.txt");
    EXPECT_NE(readWhole(folder / "times.json").find("\"loads\": 1"), std::string::npos);
}

} // namespace
} // namespace cotan::test
