// Events, commands, settings and files of the viewer, without a window.
#include <gtest/gtest.h>

#include <fstream>
#include <map>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "camera.hpp"
#include "files.hpp"
#include "interface.hpp"
#include "run_tool.hpp"
#include "session.hpp"
#include "settings.hpp"
#include "viewer_state.hpp"

namespace cotan::viewer {
namespace {

namespace fs = std::filesystem;

// ---- events ----------------------------------------------------------------------------------

TEST(ViewerEvents, everyKindRoundTripsAsText)
{
    const std::vector<Event> all = {{0, EventKind::move, 1.5f, -2, ""},
                                    {0.25, EventKind::press, 0, 0, "shift+left"},
                                    {0.25, EventKind::release, 0, 0, "left"},
                                    {1, EventKind::scroll, 0, -1, ""},
                                    {1, EventKind::key, 0, 0, "ctrl+shift+c"},
                                    {1, EventKind::keyUp, 0, 0, "c"},
                                    {1, EventKind::text, 0, 0, "\xc3\xa4 b"},
                                    {2, EventKind::drop, 0, 0, "/a folder/b.glb"},
                                    {2, EventKind::resize, 640, 480, ""},
                                    {2, EventKind::command, 0, 0, "set exposure 2"},
                                    {2, EventKind::wait, 0, 0, ""},
                                    {3, EventKind::close, 0, 0, ""}};
    std::string text = "# a comment\n\n";
    for (const Event& event : all)
        text += toText(event) + "\n";
    const auto back = eventsOf(text, "file");
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(*back, all);
}

TEST(ViewerEvents, errorsNameTheLine)
{
    for (const char* line :
         {"0 mvoe 1 2", "0 move 1", "0 move 1 x", "0 press", "-1 wait", "nan wait", "0 wait 3", "0 move 1 2 3"}) {
        const auto events = eventsOf(std::string("0 wait\n") + line + "\n", "session.txt");
        ASSERT_FALSE(events) << line;
        EXPECT_EQ(events.error().kind, ErrorKind::input);
        EXPECT_NE(events.error().message.find("session.txt: line 2: "), std::string::npos) << events.error().message;
    }
}

TEST(ViewerEvents, linesWithoutATimeTakeThePreviousOne)
{
    const auto events = eventsOf("0.5 wait\nkey h\n", "x");
    ASSERT_TRUE(events);
    EXPECT_EQ((*events)[1].seconds, 0.5);
}

TEST(ViewerEvents, modifierKeysAreParsed)
{
    const Event event{0, EventKind::key, 0, 0, "ctrl+shift++"};
    EXPECT_TRUE(holds(event, "ctrl"));
    EXPECT_TRUE(holds(event, "shift"));
    EXPECT_FALSE(holds(event, "alt"));
    EXPECT_EQ(bareWord(event), "+");
    EXPECT_EQ(bareWord({0, EventKind::key, 0, 0, "+"}), "+");
    EXPECT_EQ(bareWord({0, EventKind::key, 0, 0, "f12"}), "f12");
}

// ---- pointer and keys --------------------------------------------------------------------------

TEST(ViewerInput, draggingOrbitsUntilReleased)
{
    State state = withModel();
    const Camera before = state.camera;
    send(state, "0 move 100 100\npress left\nmove 150 100\n");
    EXPECT_TRUE(state.moving);
    EXPECT_TRUE(state.cameraMoved);
    EXPECT_NE(state.camera.eye, before.eye);
    EXPECT_EQ(state.camera.target, before.target);
    send(state, "0 release left\nmove 300 300\n");
    EXPECT_FALSE(state.moving);
    const Camera after = state.camera;
    send(state, "0 move 10 10\n");
    EXPECT_EQ(state.camera.eye, after.eye);
}

TEST(ViewerInput, aClickWithASmallTremorSetsThePivot)
{
    State state = withModel();
    const glm::vec3 eye = state.camera.eye, pivot = state.camera.target;
    send(state, "0 move 640 500\npress left\nmove 642 500\nrelease left\n");
    EXPECT_EQ(state.camera.eye, eye);
    EXPECT_NE(state.camera.target, pivot);
    const glm::vec3 seen = projectToImage(state.camera, state.camera.target, state.size);
    EXPECT_NEAR(seen.x, 640, 1);
}

TEST(ViewerInput, theDividerIsDraggedOnlyFromItsPosition)
{
    State state = withModel();
    send(state, "0 do compare divider\nmove 643 200\npress left\nmove 900 200\nrelease left\n");
    EXPECT_NEAR(state.divider, 900.0f / 1280, 1e-6f);
    EXPECT_FALSE(state.cameraMoved);
    send(state, "0 move 100 200\npress left\nmove 200 200\nrelease left\n");
    EXPECT_NEAR(state.divider, 900.0f / 1280, 1e-6f);
    EXPECT_TRUE(state.cameraMoved);
    send(state, "0 move 900 200\npress left\nmove 5000 200\nrelease left\n");
    EXPECT_EQ(state.divider, 1.0f);
}

TEST(ViewerInput, shiftDragRotatesOnlyTheLight)
{
    State state = withModel();
    const Camera before = state.camera;
    send(state, "0 move 100 100\npress shift+left\nmove 200 100\nrelease left\n");
    EXPECT_NEAR(state.picture.environmentRotation, 35, 1e-3);
    EXPECT_EQ(state.camera.eye, before.eye);
}

TEST(ViewerInput, aPinnedLightRotatesWithTheCamera)
{
    State state = withModel();
    send(state, "0 do toggle pin-light\ndo orbit 30 0\n");
    EXPECT_NEAR(state.picture.environmentRotation, 30, 1e-3);
    send(state, "0 do toggle pin-light\ndo orbit 30 0\n");
    EXPECT_NEAR(state.picture.environmentRotation, 30, 1e-3);
}

TEST(ViewerInput, flyingContinuesWhileAKeyIsDown)
{
    State state = withModel();
    const glm::vec3 eye = state.camera.eye, to = glm::normalize(state.camera.target - eye);
    send(state, "0 move 10 10\npress right\nkey w\n");
    advance(state, 0.5);
    const glm::vec3 went = state.camera.eye - eye;
    EXPECT_GT(glm::dot(went, to), 0.99f * glm::length(went));
    EXPECT_GT(glm::length(went), 0.0f);
    send(state, "0 keyup w\n");
    const glm::vec3 stands = state.camera.eye;
    advance(state, 0.5);
    EXPECT_EQ(state.camera.eye, stands);
}

TEST(ViewerInput, invalidCommandsAreReportedAndChangeNothing)
{
    State state = withModel();
    const std::string before = reportOf(state);
    // The error begins with the command or the option, and ends with what was found.
    for (const auto& [line, about, found] : {std::tuple("frame none", "frame: ", "'none'"),
                                             {"show heat", "show: ", "'heat'"},
                                             {"set exposure -1", "exposure: ", "'-1'"},
                                             {"set nothing 1", "set: ", "'nothing'"},
                                             {"compare all", "compare: ", "'all'"},
                                             {"see behind", "see: ", "'behind'"},
                                             {"camera 7", "", "7"},
                                             {"toggle x", "toggle: ", "'x'"},
                                             {"size 0 0", "size: ", "'0 0'"},
                                             {"copy", "copy: ", "''"},
                                             {"zoom", "zoom: ", "''"},
                                             {"orbit 1", "orbit: ", "''"},
                                             {"second x y", "second: ", "'x'"},
                                             {"nonsense", "", "'nonsense'"},
                                             {"set environment-rotation 1000", "environment-rotation: ", "'1000'"},
                                             {"picture a.png 0 0", "picture: ", "'0 0'"},
                                             {"turn-light nan", "turn-light: ", "'nan'"},
                                             {"next", "next: ", "'none'"},
                                             {"play", "play: ", "'none'"},
                                             {"hot-spot 3", "hot-spot: ", "'3'"},
                                             {"convention green", "", "'green'"},
                                             {"window", "window: ", "''"}}) {
        state.problem.clear();
        send(state, std::string("0 do ") + line + "\n");
        EXPECT_TRUE(state.problem.starts_with(std::string(about) + "expected ")) << line << ": " << state.problem;
        EXPECT_TRUE(state.problem.ends_with(std::string("; found ") + found)) << line << ": " << state.problem;
        state.problem.clear();
        state.message.clear();
        EXPECT_EQ(reportOf(state), before) << line;
        EXPECT_TRUE(state.requests.empty()) << line;
    }
    state.problem.clear();
    send(state, "0 do  \n");
    EXPECT_EQ(state.problem, "expected a viewer command; found ''");
}

TEST(ViewerInput, problemAreasAreOutlinedInTheirView)
{
    State state = withModel();
    state.problemAreas = problemAreas(state.model->scene);
    ASSERT_FALSE(state.problemAreas->empty());
    for (std::size_t i = 0; i < state.problemAreas->size(); ++i) {
        state.compare = Compare::angle;
        send(state, "0 do hot-spot " + std::to_string(i) + "\n");
        EXPECT_EQ(state.show, (*state.problemAreas)[i].view);
        EXPECT_EQ(state.compare, Compare::off);
        const std::vector<Line2D> lines = interfaceOf(state).lines;
        ASSERT_EQ(lines.size(), 3u);
        for (const Line2D& line : lines) {
            EXPECT_TRUE(line.from.x > 0 && line.from.x < float(state.size.x)) << line.from.x;
            EXPECT_TRUE(line.from.y > 0 && line.from.y < float(state.size.y)) << line.from.y;
        }
    }
    send(state, "0 do toggle hot-spots\n0 do toggle hot-spots\n");
    EXPECT_TRUE(interfaceOf(state).lines.empty());
}

TEST(ViewerInput, theNamedCameraIsUsedUntilItMoves)
{
    State state = withModel();
    state.picture.camera = "left";
    EXPECT_EQ(optionsOf(state, false).camera, "left");
    state.cameraMoved = true;
    EXPECT_EQ(optionsOf(state, false).camera, formatCamera(state.camera));
    EXPECT_EQ(optionsOf(state, true).camera, formatCamera(state.camera));
}

// Without an environment `render` refuses a rotation of it.
TEST(ViewerInput, lightIsNotRotatedWithoutAnEnvironment)
{
    State state = withModel();
    send(state, "0 do turn-light 30\ndo set background blur\ndo set environment none\ndo turn-light 30\n");
    EXPECT_EQ(state.picture.environmentRotation, 0);
    EXPECT_FALSE(state.picture.background);
    EXPECT_TRUE(viewOf(optionsOf(state, false), state.model->scene));
}

// ---- the command line ---------------------------------------------------------------------------

TEST(ViewerCommandLine, writesAndQuotesOnlyChangedOptions)
{
    State state = withModel();
    EXPECT_EQ(commandLine(state, "a.png", {640, 360}), "cotan render -o a.png --size 640x360");
    state.picture.model = "my model's.glb";
    state.a.frame = "smooth";
    state.show = "normal";
    state.picture.environment = "evening";
    state.picture.noShadows = true;
    EXPECT_EQ(commandLine(state, "a b.png", {64, 36}),
              "cotan render 'my model'\\''s.glb' -o 'a b.png' --size 64x36 --frame smooth --view normal "
              "--environment evening --no-shadows");
    state.compare = Compare::angle;
    EXPECT_NE(commandLine(state, "d", {64, 36}).find("cotan compare"), std::string::npos);
}

// ---- settings -----------------------------------------------------------------------------------

TEST(ViewerSettings, acceptTheirOwnValueAndRefuseNonsense)
{
    PictureOptions options;
    for (const Setting& setting : settings()) {
        EXPECT_TRUE(setValue(setting, valueOf(setting, options), options)) << setting.option.name;
        if (setting.option.check || setting.option.flag) {
            EXPECT_FALSE(setValue(setting, "nonsense", options)) << setting.option.name;
        }
    }
    EXPECT_TRUE(setValue(*findSetting("exposure"), "2.5", options));
    EXPECT_EQ(options.exposure, 2.5f);
    EXPECT_FALSE(setValue(*findSetting("exposure"), "0", options));
    options.shadowSoftness = 7;
    EXPECT_FALSE(setValue(*findSetting("shadow-softness"), "-1", options));
    EXPECT_EQ(valueOf(*findSetting("shadow-softness"), options), "7");
    EXPECT_TRUE(setValue(*findSetting("shadow-softness"), "", options)); // that of the lamp
    EXPECT_FALSE(options.shadowSoftness);
    EXPECT_EQ(valueOf(*findSetting("shadow-softness"), options), "");
    EXPECT_FALSE(setValue(*findSetting("ground"), "", options)); // it has a default
    EXPECT_TRUE(setValue(*findSetting("no-shadows"), "toggle", options));
    EXPECT_TRUE(options.noShadows);
}

TEST(ViewerMemory, restoresWhatTheCommandLineDoesNotSet)
{
    State kept;
    kept.dark = false;
    kept.scale = 1.5f;
    kept.size = {900, 500};
    kept.picture.environment = "evening";
    kept.picture.toneMapping = ToneMapping::agx;
    kept.recent = {"/a/b c.glb", "/d.obj"};
    State back;
    back.picture.toneMapping = ToneMapping::aces; // set on the command line
    remember(memoryOf(kept), back);
    EXPECT_FALSE(back.dark);
    EXPECT_EQ(back.scale, 1.5f);
    EXPECT_EQ(back.size, kept.size);
    EXPECT_EQ(back.picture.environment, "evening");
    EXPECT_EQ(back.picture.toneMapping, ToneMapping::aces);
    EXPECT_EQ(back.recent, kept.recent);
}

TEST(ViewerMemory, ignoresABrokenFile)
{
    const State before;
    State state;
    remember("size\nsize -1 9\nset\nset exposure 9\nset ground maybe\nscale x\nrecent\n\xff\xfe\ndark", state);
    EXPECT_EQ(state.size, before.size);
    EXPECT_FALSE(state.picture.exposure);
    EXPECT_TRUE(state.picture.ground);
    EXPECT_TRUE(state.recent.empty());
}

// ---- files --------------------------------------------------------------------------------------

TEST(ViewerFiles, pathsArePastedInEveryForm)
{
    EXPECT_EQ(pathOf("  /a/b.glb \n"), "/a/b.glb");
    EXPECT_EQ(pathOf("'/a/b c.glb'"), "/a/b c.glb");
    EXPECT_EQ(pathOf("file:///a/b%20c%C3%A4.glb\r\nfile:///other"), "/a/b c\xc3\xa4.glb");
    EXPECT_EQ(pathOf("file://machine/a%2"), "/a%2");
    EXPECT_EQ(pathOf("file:"), "file:");
    EXPECT_EQ(pathOf(""), "");
}

TEST(ViewerFiles, neighboursAreTheModelsOfTheFolderInTheirOrder)
{
    test::TemporaryFolder folder;
    for (const char* name : {"b.glb", "a.obj", "c.PLY", "map.png", "notes.txt"})
        std::ofstream(folder / name) << "x";
    const auto at = [&](const char* name) { return (folder / name).string(); };
    EXPECT_EQ(neighbourOf(at("a.obj"), 1), at("b.glb"));
    EXPECT_EQ(neighbourOf(at("c.PLY"), 1), at("a.obj"));
    EXPECT_EQ(neighbourOf(at("a.obj"), -1), at("c.PLY"));
    EXPECT_EQ(neighbourOf(at("gone.glb"), 1), at("a.obj"));
    EXPECT_EQ(neighbourOf("", 1), "");
    EXPECT_EQ(neighbourOf("/nowhere/a.glb", 1), "");
}

TEST(ViewerFiles, aChangeIsReportedOnceAndOnlyAtRest)
{
    test::TemporaryFolder folder;
    const fs::path file = folder / "a.glb";
    std::ofstream(file) << "one";
    Watch watch;
    watch.on({file});
    EXPECT_FALSE(watch.changed(0));
    EXPECT_FALSE(watch.changed(1));
    std::ofstream(file) << "longer";
    EXPECT_FALSE(watch.changed(2)); // noticed, but perhaps still being written
    EXPECT_TRUE(watch.changed(3));
    EXPECT_FALSE(watch.changed(4));
    fs::remove(file);
    EXPECT_FALSE(watch.changed(5));
    EXPECT_FALSE(watch.changed(6));
    std::ofstream(file) << "back again";
    EXPECT_FALSE(watch.changed(7));
    EXPECT_TRUE(watch.changed(8));
}

TEST(ViewerFiles, imagesOfModelsAreWatchedEvenIfReplacedByRenaming)
{
    test::TemporaryFolder folder;
    std::ofstream(folder / "a.gltf") << R"({"images": [{"uri": "a%20map.png"}, {"uri": "data:image/png;base64,AA"}],
                                            "buffers": [{"uri": "a.bin"}, {"uri": "gone.bin"}]})";
    for (const char* name : {"a map.png", "a.bin", "b.obj", "b.mtl", "b.png"})
        std::ofstream(folder / name) << "one";
    const std::vector<fs::path> files = filesOf(folder / "a.gltf", {});
    EXPECT_EQ(files, (std::vector{folder / "a.gltf", folder / "a.bin", folder / "a map.png"}));
    EXPECT_EQ(filesOf(folder / "b.obj", {"b.png", "gone.png"}),
              (std::vector{folder / "b.obj", folder / "b.png", folder / "b.mtl"}));
    Watch watch;
    watch.on(files);
    EXPECT_FALSE(watch.changed(0));
    std::ofstream(folder / "a map.png.part") << "another";
    fs::rename(folder / "a map.png.part", folder / "a map.png");
    EXPECT_FALSE(watch.changed(1));
    watch.on(files); // the model was reloaded meanwhile: the change is not forgotten
    EXPECT_TRUE(watch.changed(2));
    EXPECT_FALSE(watch.changed(3));
}

} // namespace
} // namespace cotan::viewer
