// `cotan view` in a window, on a display in memory: played sessions.
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <optional>
#include <random>

#include <fmt/format.h>

#include "cotan/image/file.hpp"
#include "cotan/shapes/shapes.hpp"
#include "quad_model.hpp"
#include "run_tool.hpp"

namespace cotan::test {
namespace {

// Xvfb on a free display.
class Display {
public:
    Display()
    {
        int ends[2];
        if (::pipe(ends) != 0)
            return;
        child_ = ::fork();
        if (child_ == 0) {
            ::close(ends[0]);
            const std::string number = std::to_string(ends[1]);
            ::dup2(::open("/dev/null", O_WRONLY), 2);
            ::execlp("Xvfb", "Xvfb", "-displayfd", number.c_str(), "-screen", "0", "1600x1000x24", "-nolisten", "tcp",
                     nullptr);
            ::_exit(127);
        }
        ::close(ends[1]);
        for (char c; ::read(ends[0], &c, 1) == 1 && c != '\n';)
            name_ += c;
        ::close(ends[0]);
        if (!name_.empty())
            name_ = ":" + name_;
    }
    ~Display()
    {
        if (child_ > 0) {
            ::kill(child_, SIGTERM);
            ::waitpid(child_, nullptr, 0);
        }
    }
    const std::string& name() const { return name_; } // empty: there is no Xvfb

private:
    pid_t child_ = -1;
    std::string name_;
};

const std::string& display()
{
    static const Display one;
    return one.name();
}

// Plays a session; words: of the command line before --play.
ToolRun play(const TemporaryFolder& folder, const std::string& session, std::vector<std::string> words = {})
{
    std::ofstream(folder / "session.txt") << session;
    words.insert(words.begin(), "view");
    words.insert(words.end(), {"--play", "session.txt", "--validate"});
    ::setenv("DISPLAY", display().c_str(), 1);
    ::unsetenv("WAYLAND_DISPLAY");
    return runTool(words, folder.path(), 120);
}

#define COTAN_NEEDS_DISPLAY()                                                                                          \
    if (display().empty())                                                                                             \
    GTEST_SKIP() << "no Xvfb to open a window on"

Image readPicture(const std::filesystem::path& file)
{
    auto image = readImage(file);
    EXPECT_TRUE(image) << image.error().message;
    return image ? *image : Image();
}

// Of red, green and blue; a window has no alpha.
std::size_t differentPixels(const Image& a, const Image& b)
{
    if (a.width != b.width || a.height != b.height)
        return std::max(a.pixelCount(), b.pixelCount());
    std::size_t different = 0;
    for (std::size_t i = 0; i < a.pixelCount(); ++i)
        different += !std::equal(a.bytes8() + 4 * i, a.bytes8() + 4 * i + 3, b.bytes8() + 4 * i);
    return different;
}

std::string lineOf(const std::string& report, const std::string& name)
{
    const std::size_t start = ("\n" + report).find("\n" + name + ": ");
    if (start == std::string::npos)
        return "no such line";
    const std::size_t from = start + name.size() + 2;
    return report.substr(from, report.find('\n', from) - from);
}

TEST(ViewWindow, showsThePictureThatRenderWritesToTheByte)
{
    COTAN_NEEDS_DISPLAY();
    TemporaryFolder folder;
    write(quad(2), folder.path());
    for (const std::vector<std::string>& options : std::vector<std::vector<std::string>>{
             {"--size", "320x180"},
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
        EXPECT_EQ(differentPixels(readPicture(folder / "window.png"), readPicture(folder / "render.png")), 0u)
            << ::testing::PrintToString(options);
    }
}

TEST(ViewWindow, theCommandThatItWritesDrawsTheSamePicture)
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
    EXPECT_EQ(differentPixels(readPicture(folder / "window.png"), readPicture(folder / "a.png")), 0u);
    for (const std::string name : {"a.png", "b.png", "c.exr"}) {
        std::filesystem::rename(folder / name, folder / ("viewer-" + name));
        const std::size_t start = seen.out.find("cotan render -o " + name);
        ASSERT_NE(start, std::string::npos) << seen.out;
        const std::string command = seen.out.substr(start + 6, seen.out.find('\n', start) - start - 6);
        const std::string shell =
            fmt::format("cd {} && {} {} > /dev/null", folder.path().string(), COTAN_TOOL, command);
        ASSERT_EQ(std::system(shell.c_str()), 0) << command;
        EXPECT_TRUE(readWhole(folder / name) == readWhole(folder / ("viewer-" + name))) << command;
    }
}

TEST(ViewWindow, noDisplayIsExitCodeThreeAndOneLine)
{
    TemporaryFolder folder;
    ::unsetenv("DISPLAY");
    ::unsetenv("WAYLAND_DISPLAY");
    for (const char* name : {"", ":77"}) { // none, and one that is not there
        if (*name)
            ::setenv("DISPLAY", name, 1);
        const ToolRun run = runTool({"view", "--forget"}, folder.path());
        EXPECT_EQ(run.code, 3);
        EXPECT_EQ(lines(run.err), 1) << run.err;
        EXPECT_NE(run.err.find("display"), std::string::npos) << run.err;
    }
}

TEST(ViewWindow, dragsAndKeysDoTheSameEveryTime)
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

TEST(ViewWindow, aMenuIsOpenedAndChosenFromByThePointer)
{
    COTAN_NEEDS_DISPLAY();
    TemporaryFolder folder;
    // The third menu, which has room below the bar, and one of its first entries.
    const ToolRun run =
        play(folder,
             "0 do scale 1\n0 wait\n0 move 137 10\n0 press left\n0 release left\n0 wait\n0 do window menu.png\n"
             "0 move 150 80\n0 press left\n0 release left\n0 wait\n0 do report r.txt\n",
             {"--shape", "plane", "--size", "640x600"});
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(lineOf(readWhole(folder / "r.txt"), "first"), "triangle stored - -");
    EXPECT_EQ(lineOf(readWhole(folder / "r.txt"), "camera moved"),
              "no"); // what the menu takes the picture does not get
}

TEST(ViewWindow, aBadFileSaysSoAndTheLastModelStays)
{
    COTAN_NEEDS_DISPLAY();
    TemporaryFolder folder;
    write(quad(2), folder.path());
    std::ofstream(folder / "bad.glb") << "glTF nonsense";
    const ToolRun run = play(folder,
                             "0 wait\n0 drop bad.glb\n0 wait\n0 do report a.txt\n0 drop missing.obj\n0 wait\n"
                             "0 do report b.txt\n0 do window w.png\n",
                             {"quad.gltf", "--size", "200x150"});
    EXPECT_EQ(run.code, 0) << run.err;
    const std::string a = readWhole(folder / "a.txt");
    EXPECT_EQ(lineOf(a, "model"), "quad.gltf");
    EXPECT_EQ(lineOf(a, "loads"), "1 failed 1");
    EXPECT_NE(lineOf(a, "problem").find("bad.glb"), std::string::npos);
    EXPECT_EQ(lineOf(readWhole(folder / "b.txt"), "loads"), "1 failed 2");
}

TEST(ViewWindow, aModelThatChangesIsReadAgainAndTheCameraStays)
{
    COTAN_NEEDS_DISPLAY();
    TemporaryFolder folder;
    write(quad(2), folder.path());
    const ToolRun run =
        play(folder, "0 wait\n0 do orbit 20 10\n0 wait\n0 do report a.txt\n0 key f5\n0 wait\n0 do report b.txt\n",
             {"quad.gltf", "--size", "200x150"});
    ASSERT_EQ(run.code, 0) << run.err;
    const std::string a = readWhole(folder / "a.txt"), b = readWhole(folder / "b.txt");
    EXPECT_EQ(lineOf(b, "loads"), "2 failed 0");
    EXPECT_EQ(lineOf(a, "eye"), lineOf(b, "eye"));
}

TEST(ViewWindow, sizesSurfacesAndMinimisingAreLivedThrough)
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
    EXPECT_EQ(readPicture(folder / "w.png").width, 300);
}

TEST(ViewWindow, whatIsRecordedIsDoneAgain)
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

TEST(ViewWindow, aLightThatIsDroppedLightsAndABadOneIsLeft)
{
    COTAN_NEEDS_DISPLAY();
    TemporaryFolder folder;
    Image sky = makeImage(16, 8, PixelType::float32);
    std::fill_n(sky.floats(), 4 * sky.pixelCount(), 0.5f);
    ASSERT_TRUE(writeImage(folder / "sky.hdr", sky));
    std::ofstream(folder / "bad.hdr") << "#?RADIANCE nonsense";
    const ToolRun run = play(folder,
                             "0 wait\n0 drop sky.hdr\n0 wait\n0 do report a.txt\n0 drop bad.hdr\n0 wait\n0 wait\n"
                             "0 do report b.txt\n",
                             {"--shape", "sphere", "--size", "100x80"});
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(lineOf(readWhole(folder / "a.txt"), "environment"), "sky.hdr");
    EXPECT_EQ(lineOf(readWhole(folder / "b.txt"), "environment"), "sky.hdr");
    EXPECT_NE(lineOf(readWhole(folder / "b.txt"), "problem").find("bad.hdr"), std::string::npos);
}

TEST(ViewWindow, aMapAloneStandsOnAShapeAndTheDialogOpensAModel)
{
    COTAN_NEEDS_DISPLAY();
    TemporaryFolder folder;
    write(quad(2), folder.path());
    ASSERT_TRUE(writeImage(folder / "map.png", makeReliefMap(Relief::domes, 64)));
    std::ofstream(folder / "zenity") << "#!/bin/sh\necho " << (folder / "quad.gltf").string() << "\n";
    std::filesystem::permissions(folder / "zenity", std::filesystem::perms::owner_all);
    const std::string path = std::getenv("PATH");
    ::setenv("PATH", (folder.path().string() + ":" + path).c_str(), 1);
    const ToolRun run = play(folder,
                             "0 wait\n0 do report a.txt\n0 do set shape torus\n0 wait\n0 do report b.txt\n"
                             "0 key ctrl+o\n0 wait\n0 do report c.txt\n",
                             {"map.png", "--size", "100x80"});
    ::setenv("PATH", path.c_str(), 1);
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(lineOf(readWhole(folder / "a.txt"), "model"), "plane");
    EXPECT_NE(lineOf(readWhole(folder / "a.txt"), "first").find("map.png"), std::string::npos);
    EXPECT_EQ(lineOf(readWhole(folder / "b.txt"), "model"), "torus");
    EXPECT_EQ(lineOf(readWhole(folder / "c.txt"), "model"), "quad.gltf");
}

// COTAN_VIEW_EVENTS and COTAN_VIEW_SEED make it longer, or another; COTAN_VIEW_KEEP is a folder that gets it.
TEST(ViewWindow, randomEventsAreLivedThrough)
{
    COTAN_NEEDS_DISPLAY();
    TemporaryFolder folder;
    write(quad(2), folder.path());
    std::ofstream(folder / "bad.glb") << "glTF nonsense";
    ASSERT_TRUE(writeImage(folder / "map.png", makeReliefMap(Relief::domes, 64)));
    const auto numberOf = [](const char* name, int usual) {
        const char* text = std::getenv(name);
        return text ? std::atoi(text) : usual;
    };
    std::mt19937 random(unsigned(numberOf("COTAN_VIEW_SEED", 1)));
    const auto below = [&](int n) { return int(random() % unsigned(n)); };
    const std::vector<std::string> keys = {"1",
                                           "2",
                                           "3",
                                           "4",
                                           "5",
                                           "6",
                                           "7",
                                           "8",
                                           "9",
                                           "shift+1",
                                           "shift+2",
                                           "shift+4",
                                           "shift+9",
                                           "alt+1",
                                           "alt+2",
                                           "alt+7",
                                           "alt+9",
                                           "v",
                                           "d",
                                           "f",
                                           "g",
                                           "x",
                                           "i",
                                           "l",
                                           "n",
                                           "w",
                                           "m",
                                           "tab",
                                           "s",
                                           "h",
                                           "p",
                                           "e",
                                           ".",
                                           ",",
                                           "a",
                                           "o",
                                           "r",
                                           "kp1",
                                           "kp7",
                                           "ctrl+kp7",
                                           "=",
                                           "-",
                                           "left",
                                           "up",
                                           "down",
                                           "[",
                                           "]",
                                           "space",
                                           "home",
                                           "f5",
                                           "pagedown",
                                           "ctrl+c",
                                           "ctrl+shift+c",
                                           "ctrl+v",
                                           "escape",
                                           "enter",
                                           "q",
                                           "ctrl+a"};
    std::string session;
    const int count = numberOf("COTAN_VIEW_EVENTS", 400);
    for (int i = 0; i < count; ++i) {
        session += fmt::format("{:.3f} ", i * 0.01);
        switch (below(16)) {
        case 0:
        case 1:
        case 2:
        case 3: session += fmt::format("move {} {}", below(400) - 20, below(300) - 20); break;
        case 4:
        case 5:
        case 6:
            session += fmt::format("{} {}{}", below(2) ? "press" : "release",
                                   below(4)       ? ""
                                       : below(2) ? "shift+"
                                                  : "ctrl+",
                                   std::vector<std::string>{"left", "right", "middle"}[std::size_t(below(3))]);
            break;
        case 7: session += fmt::format("scroll {} {}", below(3) - 1, below(21) - 10); break;
        case 8: session += fmt::format("keyup {}", keys[std::size_t(below(int(keys.size())))]); break;
        case 9:
            session += below(8) ? fmt::format("text {}", char('a' + below(26)))
                                : fmt::format("resize {} {}", 40 + below(300), 30 + below(200));
            break;
        case 10:
            session += below(6) ? "key v"
                                : "drop "
                    + std::vector<std::string>{"bad.glb", "quad.gltf", "map.png", "gone.hdr"}[std::size_t(below(4))];
            break;
        case 11: session += below(10) ? "key g" : below(2) ? "wait" : "do lose-surface"; break;
        default: session += "key " + keys[std::size_t(below(int(keys.size())))]; break;
        }
        session += '\n';
    }
    if (const char* kept = std::getenv("COTAN_VIEW_KEEP")) // a folder, to look at a finding
        std::filesystem::copy(folder.path(), kept,
                              std::filesystem::copy_options::overwrite_existing
                                  | std::filesystem::copy_options::recursive),
            std::ofstream(std::filesystem::path(kept) / "session.txt") << session;
    const ToolRun run = play(folder, session + "9999 wait\n9999 do report r.txt\n", {"quad.gltf", "--size", "160x120"});
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_NE(lineOf(readWhole(folder / "r.txt"), "model"), "no such line");
}

TEST(ViewWindow, reloadsTakeNoMoreAndMoreMemory)
{
    COTAN_NEEDS_DISPLAY();
    TemporaryFolder folder;
    write(quad(2), folder.path());
    const auto megabytesOf = [&](int reloads) {
        std::string session = "0 wait\n";
        for (int i = 0; i < reloads; ++i)
            session += "0 key f5\n0 wait\n";
        const ToolRun run = play(folder, session, {"quad.gltf", "--size", "64x48", "--environment", "none"});
        EXPECT_EQ(run.code, 0) << run.err;
        return run.megabytes;
    };
    const double few = megabytesOf(20), many = megabytesOf(80);
    EXPECT_LT(many, few + 12); // 60 more of 0.2 MB a reload would be more; drivers' pools move by some
}

TEST(ViewWindow, wrongWordsEndAtOnce)
{
    COTAN_NEEDS_DISPLAY();
    TemporaryFolder folder;
    struct Case {
        std::vector<std::string> words;
        int code;
    };
    std::ofstream(folder / "broken.txt") << "0 wiat\n";
    ::setenv("DISPLAY", display().c_str(), 1);
    for (const Case& c : {Case{{"--frame", "none"}, 1},
                          {{"--play", "missing.txt"}, 2},
                          {{"--play", "broken.txt"}, 2},
                          {{"--do", "nonsense"}, 1},
                          {{"--size", "0x0"}, 1},
                          {{"-o", "x.png"}, 1}}) {
        std::vector<std::string> words = c.words;
        words.insert(words.begin(), "view");
        const ToolRun run = runTool(words, folder.path());
        EXPECT_EQ(run.code, c.code) << ::testing::PrintToString(c.words) << run.err;
        EXPECT_EQ(lines(run.err), 1) << run.err;
    }
    const ToolRun run = play(folder, "0 do frame none\n");
    EXPECT_EQ(run.code, 2) << run.err;
}

} // namespace
} // namespace cotan::test
