// The tasks of the menu "Check and fix", without a window.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <fstream>

#include <fmt/format.h>

#include "cotan/image.hpp"
#include "cotan/maps.hpp"
#include "maps/texels.hpp"
#include "quad_model.hpp"
#include "tasks.hpp"
#include "tool_process.hpp"
#include "viewer_session.hpp"

namespace cotan::viewer {
namespace {

struct TaskSession : HeadlessSession {
    TaskSession() { options.program = COTAN_TOOL; }

    // Performs a task until it has ended.
    void perform(const std::string& name)
    {
        ASSERT_TRUE(ask(request::RunTask{name})) << state().problem;
        EXPECT_NE(state().task, "");
        for (int i = 0; i < 6000 && parts.tool.running(); ++i) { // at most a minute
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
            (void)carryOutRequests(parts);
        }
        ASSERT_FALSE(parts.tool.running());
        EXPECT_EQ(state().task, "");
        work([&] { return !parts.loader.busy(); });
    }
    std::string lines() const { return fmt::format("{}\n", fmt::join(parts.state.result.lines, "\n")); }
};

// Waves whose green points up or down.
Image waves(bool up, double steep)
{
    Image image = makeImage(96, 64, PixelType::unorm8);
    for (int y = 0; y < 64; ++y) {
        std::vector<glm::vec4> row(96);
        for (int x = 0; x < 96; ++x) {
            const double one = steep * std::cos(0.4 * x - 0.3 * y), other = steep * std::cos(0.2 * x + 0.5 * y);
            const double right = 0.8 * one + 0.37 * other, above = 0.6 * one - 0.93 * other; // along the gradients
            row[std::size_t(x)] = maps::encodeTexel(glm::vec3(-right, up ? -above : above, 1), {}, PixelType::unorm8);
        }
        maps::storeRow(image, y, row);
    }
    return image;
}

TEST(ViewerTasks, canRunWithWhatIsOpen)
{
    const auto usable = [](const State& s) {
        std::string names;
        for (const TaskEntry& entry : taskEntries())
            if (entry.name && entry.usable(s))
                names += std::string(entry.name) + " ";
        return names;
    };
    State state;
    EXPECT_EQ(usable(state), "");
    state.a.normalMap = "a.png";
    EXPECT_EQ(usable(state), "detect info fix-opengl fix-directx blocks-desktop blocks-mobile blocks-web ");
    state.picture.model = "low.glb";
    EXPECT_EQ(
        usable(state),
        "check-model detect info fix-opengl fix-directx blocks-desktop blocks-mobile blocks-web convert tangents ");
    state.a.normalMap.clear();
    state.high = {"high.obj"};
    EXPECT_EQ(usable(state), "check-model convert tangents bake bake-maps ");
    state.picture.model = "low.obj"; // tangents are those of glTF
    EXPECT_EQ(usable(state), "check-model bake bake-maps ");
}

TEST(ViewerTasks, thatCannotRunSayWhatTheyNeed)
{
    TaskSession at;
    EXPECT_FALSE(at.ask(request::RunTask{"bake"}));
    EXPECT_EQ(at.state().problem, "run bake: expected an open model and its high model; found 'none'");
    EXPECT_FALSE(at.ask(request::RunTask{"nonsense"}));
    EXPECT_NE(at.state().problem.find("run: expected one of check-model, detect"), std::string::npos);
    EXPECT_TRUE(at.ask(request::StopTask{})); // nothing runs
    EXPECT_EQ(at.state().task, "");
}

// Two models with different findings.
TEST(ViewerTasks, checkAModelAsTheCommandDoes)
{
    TaskSession at;
    std::vector<std::string> results;
    for (const auto& [folder, stretch] : {std::pair("one", 2.0f), {"two", 8.0f}}) {
        fs::create_directory(at.folder / folder);
        test::write(test::quad(stretch), at.folder / folder);
        const std::string model = at.in(folder) + "/quad.gltf";
        at.load(model);
        at.perform("check-model");
        const test::ToolRun run = test::runTool({"lint", model}, at.folder.path());
        EXPECT_EQ(run.code, 0);
        EXPECT_EQ(at.lines().substr(0, run.out.size()), run.out);
        EXPECT_EQ(at.state().result.title, "Check model");
        EXPECT_TRUE(at.state().resultShown);
        EXPECT_EQ(at.state().message, "cotan lint " + model);
        results.push_back(at.lines());
    }
    EXPECT_NE(results[0], results[1]);
}

TEST(ViewerTasks, saveFixedMapsBesideTheMapUnderFreeNamesAndShowThem)
{
    TaskSession at;
    for (const bool up : {false, true}) {
        const std::string name = up ? "up" : "down";
        ASSERT_TRUE(writeImage(at.folder / (name + ".png"), waves(up, 0.5)));
        const std::string before = test::readWhole(at.folder / (name + ".png"));
        for (const char* number : {"", "-2"})
            for (const std::string target : {"opengl", "directx"}) {
                at.state().a.normalMap = at.in(name + ".png");
                at.state().a.convention = "gltf";
                at.perform("fix-" + target);
                const std::string file = at.in(name + "-" + target + number + ".png");
                EXPECT_EQ(at.state().a.normalMap, file) << at.lines();
                EXPECT_EQ(at.state().a.convention, target == "opengl" ? "" : "directx");
                const auto image = readImage(file);
                ASSERT_TRUE(image) << file;
                const Image wanted = waves(target == "opengl", 0.5);
                EXPECT_EQ(maps::greenOf(*image).green, maps::greenOf(wanted).green);
                // 128 is zero, so that green is reversed exactly.
                EXPECT_TRUE(std::equal(image->bytes8(), image->bytes8() + 96 * 64 * 4, wanted.bytes8()));
            }
        EXPECT_TRUE(test::readWhole(at.folder / (name + ".png")) == before);
    }
}

TEST(ViewerTasks, saveBlocksAsTheCommandDoesAndShowThem)
{
    TaskSession at;
    ASSERT_TRUE(writeImage(at.folder / "up.png", waves(true, 0.2)));
    for (const std::string device : {"desktop", "mobile", "web"}) {
        at.state().a.normalMap = at.in("up.png");
        at.perform("blocks-" + device);
        const std::string file = at.in("up-" + device + ".ktx2"), again = at.in("again.ktx2");
        ASSERT_EQ(at.state().a.normalMap, file) << at.lines();
        const test::ToolRun run =
            test::runTool({"map", "convert", at.in("up.png"), "--from", "opengl", "--to", "opengl", "--max-degrees",
                           "0.5", "--for", device, "--mips", "--overwrite", "-o", again},
                          at.folder.path());
        EXPECT_EQ(run.code, 0) << run.err;
        EXPECT_TRUE(test::readWhole(file) == test::readWhole(again)) << device;
    }
}

TEST(ViewerTasks, bakeTheOpenPairAndShowTheMap)
{
    TaskSession at;
    test::write(test::quad(2), at.folder.path());
    for (const auto& [tilt, rise] : {std::pair("0.1", 0.1), {"0.3", 0.3}}) {
        const std::string high = at.in(std::string("high") + tilt + ".obj");
        std::ofstream(high) << fmt::format("v 0 0 0\nv 2 0 {0}\nv 2 1 {0}\nv 0 1 0\nf 1 2 3\nf 1 3 4\n", tilt);
        at.load(at.in("quad.gltf"));
        at.state().high = {high};
        at.state().a.normalMap.clear();
        at.perform("bake");
        ASSERT_NE(at.state().a.normalMap, "") << at.lines();
        const auto map = readImage(at.state().a.normalMap);
        ASSERT_TRUE(map);
        const std::size_t middle = 4 * std::size_t(map->width * (map->height / 2) + map->width / 2);
        const double slope = rise / 2; // the plane rises by the tilt over 2 units
        const double x = -slope / std::sqrt(1 + slope * slope);
        EXPECT_NEAR(double(map->bytes8()[middle]), 128 + 127 * x, 1.01) << at.lines(); // rounding of 8 bits
    }
    EXPECT_TRUE(fs::exists(at.folder / "quad-normal.png") && fs::exists(at.folder / "quad-normal-2.png"));
    at.perform("bake-maps");
    for (const char* name : {"normal.png", "ao.png", "height.png"})
        EXPECT_TRUE(fs::exists(at.folder / "quad-maps" / name)) << name << at.lines();
}

TEST(ViewerTasks, thatFailShowTheErrorAndChangeNothing)
{
    TaskSession at;
    at.state().a.normalMap = at.in("missing.png");
    at.perform("fix-opengl");
    EXPECT_EQ(at.state().result.title, "Save fixed map for OpenGL: exit code 2");
    EXPECT_EQ(at.state().result.lines.front().find("error: "), 0u) << at.lines();
    EXPECT_NE(at.lines().find("missing.png"), std::string::npos);
    EXPECT_EQ(at.state().a.normalMap, at.in("missing.png"));
    EXPECT_FALSE(fs::exists(at.folder / "missing-opengl.png"));
}

TEST(ViewerTasks, runOneAtATimeAndStopWhenAsked)
{
    TaskSession at;
    at.options.program = "/bin/sh"; // `sh lint FILE` runs a script named "lint"
    const fs::path before = fs::current_path();
    fs::current_path(at.folder.path());
    std::ofstream("lint") << "echo begun; sleep 60 & wait\n";
    at.state().picture.model = "model.glb";
    EXPECT_TRUE(at.ask(request::RunTask{"check-model"}));
    EXPECT_FALSE(at.ask(request::RunTask{"check-model"}));
    EXPECT_EQ(at.state().problem, "run: expected no other task; found 'Check model'");
    EXPECT_TRUE(at.ask(request::StopTask{}));
    for (int i = 0; i < 1000 && at.parts.tool.running(); ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        (void)carryOutRequests(at.parts);
    }
    fs::current_path(before);
    EXPECT_FALSE(at.parts.tool.running());
    EXPECT_EQ(at.state().result.title, "Check model: ended");
}

// Also a child that ignores the request.
TEST(ToolProcesses, endWithTheirChildrenWhenTheWindowDoes)
{
    test::TemporaryFolder folder;
    pid_t child = 0;
    {
        ToolProcess tool;
        ASSERT_TRUE(tool.start(
            "/bin/sh", {"-c", "trap '' TERM; sleep 60 & echo $! > \"$0\"; wait; wait", (folder / "child").string()}));
        for (int i = 0; i < 1000 && child == 0; ++i) {
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
            std::ifstream(folder / "child") >> child;
        }
        ASSERT_GT(child, 0);
        EXPECT_EQ(::kill(child, 0), 0);
        EXPECT_FALSE(tool.take());
    }
    // A killed process whose parent is gone is reaped soon after.
    for (int i = 0; i < 1000 && ::kill(child, 0) == 0; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_NE(::kill(child, 0), 0);
}

TEST(ToolProcesses, keepTheFirstOfALongOutput)
{
    ToolProcess tool;
    ASSERT_TRUE(tool.start("/bin/sh", {"-c", "yes no | head -c 1000000; exit 3"}));
    std::optional<ToolProcess::End> end;
    for (int i = 0; i < 1000 && !end; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        end = tool.take();
    }
    ASSERT_TRUE(end);
    EXPECT_EQ(end->code, 3);
    EXPECT_EQ(end->output.size(), kMaxToolOutput);
    EXPECT_FALSE(tool.running());
    EXPECT_FALSE(ToolProcess().start("/no/such/program", {}));
}

} // namespace
} // namespace cotan::viewer
