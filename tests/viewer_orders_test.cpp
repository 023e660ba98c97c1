// Orders to the viewer's threads, and how their results enter the state; file dialogs, and names of files.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "cotan/inspect.hpp"
#include "files.hpp"
#include "loader.hpp"
#include "pointer_probe.hpp"
#include "render_thread.hpp"
#include "viewer_session.hpp"

namespace cotan::viewer {
namespace {

// ---- orders -------------------------------------------------------------------------------------

TEST(ViewerOrders, requestStatisticsForModelsAtRest)
{
    std::vector<std::string> shows = {"shaded", "normal"};
    for (const std::string_view name : inspectionNames())
        shows.emplace_back(name);
    for (int k = 0; k < 8; ++k)
        for (const std::string& show : shows) {
            State s;
            s.statisticsShown = (k & 1) != 0;
            s.moving = (k & 2) != 0;
            s.playing = (k & 4) != 0;
            s.show = show;
            const Order order = orderOf(s);
            EXPECT_EQ(order.draft, k > 1) << k;
            EXPECT_EQ(order.figures, k == 1 && (show == "shaded" || show == "normal")) << k << show;
        }
}

TEST(ViewerOrders, haveEachFieldOfTheState)
{
    State s = builtIn();
    s.a.frame = "unit";
    s.a.tangents = TangentOrigin::generated;
    s.a.normalMap = "a.png";
    s.b.frame = "gradient";
    s.b.convention = "green-down";
    s.show = "uv";
    s.compare = Compare::flip;
    s.second = true;
    s.metered = 2.5f;
    s.picture.camera = "left";
    Order order = orderOf(s);
    EXPECT_EQ(order.a, s.a);
    EXPECT_EQ(order.b, s.b);
    EXPECT_EQ(order.first.show, "uv");
    EXPECT_EQ(order.second.show, "uv");
    EXPECT_EQ(order.compare, Compare::flip);
    EXPECT_TRUE(order.flipped);
    EXPECT_EQ(order.model, s.model);
    EXPECT_EQ(order.exposure, 2.5f);
    EXPECT_EQ(order.meteredFrom, "left"); // unless meteredFrom is set
    EXPECT_EQ(order.number, 0u);
    EXPECT_EQ(order.first.maps.normal, "a.png");
    EXPECT_EQ(order.second.maps.normal, "");
    EXPECT_EQ(order.first.maps.convention, PictureOptions().maps.convention);
    EXPECT_EQ(order.second.maps.convention, "green-down");
    EXPECT_EQ(order.first.tangents, TangentOrigin::generated);
    EXPECT_EQ(order.second.tangents, TangentOrigin::stored);
    s.meteredFrom = "right";
    s.second = false;
    order = orderOf(s);
    EXPECT_EQ(order.meteredFrom, "right");
    EXPECT_FALSE(order.flipped);
}

// ---- loaded models ------------------------------------------------------------------------------

Loaded read(const char* file, const std::string& animation = "", double time = 0)
{
    Loaded loaded;
    auto model = std::make_shared<Model>(*builtIn().model);
    model->read.model = file;
    model->read.animation = animation;
    model->read.time = time;
    model->scene.warnings.clear();
    loaded.model = std::move(model);
    return loaded;
}

TEST(ViewerLoader, loadsUpdateTheStateAndErrorsStayUntilSuccess)
{
    State s;
    Loaded wrong;
    wrong.error = inputError("m.glb: broken");
    s.playing = true;
    s.picture.animation = "walk";
    take(s, wrong);
    EXPECT_EQ(s.problem, "m.glb: broken");
    EXPECT_EQ(s.loadProblem, "m.glb: broken");
    EXPECT_EQ(s.failedLoads, 1u);
    EXPECT_EQ(s.loads, 0u);
    EXPECT_FALSE(s.playing);
    EXPECT_EQ(s.picture.animation, "walk"); // there is no earlier model to restore
    EXPECT_FALSE(s.model);
    take(s, {}); // nothing
    EXPECT_EQ(s.loads, 0u);

    s.problemAreasShown = true;
    s.problemArea = 3;
    Loaded good = read("/f/m.glb", "run", 2);
    auto warned = std::make_shared<Model>(*good.model);
    warned->scene.warnings = {"first", "second"};
    warned->read.variant = "red";
    good.model = warned;
    take(s, good);
    EXPECT_EQ(s.problem, "");
    EXPECT_EQ(s.loads, 1u);
    EXPECT_EQ(s.failedLoads, 1u);
    EXPECT_EQ(s.message, "first");
    EXPECT_EQ(s.model, good.model);
    EXPECT_EQ(s.picture.model, "/f/m.glb");
    EXPECT_EQ(s.picture.variant, "red");
    EXPECT_EQ(s.picture.animation, "run");
    EXPECT_EQ(s.picture.time, 2);
    EXPECT_FALSE(s.problemArea);
    ASSERT_EQ(s.requests.size(), 1u);
    EXPECT_TRUE(std::holds_alternative<request::FindProblemAreas>(s.requests[0]));
    s.requests.clear();

    // Problems of another kind stay. Time goes on while an animation plays, and a reload of the same model does not
    // stop it.
    s.problem = "something else", s.loadProblem = "m.glb: broken";
    s.playing = true, s.picture.time = 7;
    take(s, read("/f/m.glb", "run", 3));
    EXPECT_EQ(s.problem, "something else");
    EXPECT_EQ(s.loadProblem, "");
    EXPECT_TRUE(s.playing);
    EXPECT_EQ(s.picture.time, 7);
    EXPECT_EQ(s.message, "first");
    Loaded shape = read("");
    auto torus = std::make_shared<Model>(*shape.model);
    torus->read.shape = "torus";
    shape.model = torus;
    take(s, shape);
    EXPECT_FALSE(s.playing);
    EXPECT_EQ(s.picture.shape, "torus");
    EXPECT_EQ(s.recent, std::vector<std::string>{"/f/m.glb"});

    Loaded faults;
    faults.faults = {"map a", "map b"};
    take(s, faults);
    EXPECT_EQ(s.message, "map a");
    Loaded areas;
    areas.problemAreas.emplace(2);
    const std::size_t loads = s.loads;
    take(s, areas);
    ASSERT_TRUE(s.problemAreas);
    EXPECT_EQ(s.problemAreas->size(), 2u);
    EXPECT_EQ(s.loads, loads);
}

TEST(ViewerLoader, posesKeepTheCameraAndOtherAnimationsAreFramed)
{
    State s;
    take(s, read("/f/m.glb", "run", 1));
    const glm::vec3 framed = s.camera.eye;
    const auto pose = [&](const char* animation, double time) {
        Loaded loaded = read("/f/m.glb", animation, time);
        loaded.posed = true;
        take(s, loaded);
        EXPECT_EQ(s.model, loaded.model);
    };
    const glm::vec3 away = framed + glm::vec3(1, 2, 3);
    s.camera.eye = away;
    s.problemAreas.emplace(1);
    s.playing = true;
    pose("run", 2);
    EXPECT_EQ(s.camera.eye, away);
    EXPECT_TRUE(s.problemAreas); // no search for new ones while it plays
    s.playing = false;
    pose("run", 3);
    EXPECT_FALSE(s.problemAreas);
    s.cameraMoved = true;
    pose("walk", 0);
    EXPECT_EQ(s.camera.eye, away);
    s.cameraMoved = false;
    pose("run", 0);
    EXPECT_EQ(s.camera.eye, framed);
    EXPECT_EQ(s.loads, 1u);
    Loaded wrong;
    wrong.posed = true;
    wrong.error = usageError("no such animation");
    s.picture.shape = "x", s.picture.variant = "y", s.picture.animation = "z", s.picture.time = 9;
    take(s, wrong);
    EXPECT_EQ(s.failedLoads, 0u);
    EXPECT_EQ(s.picture.shape, "");
    EXPECT_EQ(s.picture.variant, "");
    EXPECT_EQ(s.picture.animation, "run");
    EXPECT_EQ(s.picture.time, 0);
}

// ---- the pointer --------------------------------------------------------------------------------

TEST(ViewerPointer, isProbedOnlyForTheCardAndWithoutAHeldButton)
{
    State s = builtIn();
    s.size = {64, 48};
    PointerProbe probe([] {});
    const auto follow = [&] {
        for (int i = 0; i < 2000; ++i) {
            probe.follow(s);
            if (!probe.busy())
                return s.probe.hit.has_value();
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return false;
    };
    s.pointer = {32, 24};
    EXPECT_TRUE(follow());
    EXPECT_GT(glm::length(s.probe.surface.normal), 0.99f);
    const glm::vec3 middle = s.probe.hit->position;
    s.pointer = {30, 26};
    EXPECT_TRUE(follow());
    EXPECT_NE(s.probe.hit->position, middle);
    s.held = "left";
    EXPECT_FALSE(follow());
    s.held.clear();
    s.pointer.x = -1;
    EXPECT_FALSE(follow());
    s.pointer.x = 30;
    EXPECT_TRUE(follow());
    s.cardShown = false;
    EXPECT_FALSE(follow());
    s.cardShown = true;
    EXPECT_TRUE(follow());
    s.model = nullptr;
    EXPECT_FALSE(follow());
    State corner = builtIn(); // pixel (0, 0) belongs to the image
    corner.size = {64, 48};
    corner.pointer = {0, 0};
    probe.follow(corner);
    EXPECT_TRUE(probe.busy());
}

// ---- dialogs ------------------------------------------------------------------------------------

// Without a portal, the first program for file dialogs in PATH is run.
TEST(ViewerDialog, dialogProgramsStartInTheFolderAndReturnOnePath)
{
    const test::TemporaryFolder folder;
    const auto program = [&](const char* name, const std::string& says) {
        fs::create_directories(folder / name);
        const fs::path file = folder / name / name;
        std::ofstream(file) << "#!/bin/sh\nprintf '%s\\n' \"$@\" >" << (folder / "words").string() << "\nprintf '"
                            << says << "'\n";
        fs::permissions(file, fs::perms::owner_all);
        return (folder / name).string();
    };
    const std::string zenity = program("zenity", "/m/a b.glb\\nmore\\n"), kdialog = program("kdialog", "");
    std::ofstream(folder / "kdialog" / "zenity") << "no program";
    const std::string usual = std::getenv("PATH");
    WindowCalls calls;
    RecordingWindow window(calls);
    window.answer = {FileAnswer::refused, ""};
    const std::string beside = (folder / "sub" / "x.glb").string(), begin = (folder / "sub" / "").string();
    const auto choose = [&](const std::string& path) {
        ::setenv("PATH", path.c_str(), 1);
        Dialog dialog;
        dialog.ask(window, beside);
        Result<std::string> chosen = dialog.take(window);
        for (int i = 0; i < 2000 && chosen && chosen->empty() && dialog.open(); ++i) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            chosen = dialog.take(window);
        }
        EXPECT_FALSE(dialog.open());
        ::setenv("PATH", usual.c_str(), 1);
        return chosen ? *chosen : chosen.error().message;
    };
    EXPECT_EQ(choose("/nowhere:" + zenity + ":" + kdialog), "/m/a b.glb");
    EXPECT_EQ(test::readWhole(folder / "words"), "--file-selection\n--title=cotan view\n--filename=" + begin + "\n");
    EXPECT_EQ(calls.folder, begin);
    EXPECT_EQ(choose(kdialog), ""); // nothing was chosen
    EXPECT_EQ(test::readWhole(folder / "words"), "--getopenfilename\n" + begin + "\n");
    EXPECT_EQ(choose((folder / "none").string()),
              "open: no file dialog: install zenity; or drop a file, or paste its path");
}

// ---- names of files -----------------------------------------------------------------------------

TEST(ViewerFiles, uriEscapesAreTwoHexadecimalDigits)
{
    const std::string digits = "0123456789abcdef", capitals = "0123456789ABCDEF";
    for (int i = 1; i < 256; ++i) {
        const char c = char(i);
        if (c == '\n' || c == '%' || std::string(" \t\r'\"").find(c) != std::string::npos)
            continue;
        const std::size_t low = digits.find(c), value = low != std::string::npos ? low : capitals.find(c);
        const bool hexadecimal = value != std::string::npos;
        const std::string first = std::string("%") + c + "1", second = std::string("%4") + c;
        EXPECT_EQ(pathOf("file:///" + first), "/" + (hexadecimal ? std::string(1, char(16 * value + 1)) : first)) << i;
        EXPECT_EQ(pathOf("file:///" + second), "/" + (hexadecimal ? std::string(1, char(64 + value)) : second)) << i;
    }
    EXPECT_EQ(pathOf("file:///a%41"), "/aA"); // at the end
    EXPECT_EQ(pathOf("file:///a%4"), "/a%4");
    EXPECT_EQ(pathOf("file:///a%"), "/a%");
    EXPECT_EQ(pathOf("file:///%41%42%2e"), "/AB.");
    EXPECT_EQ(pathOf("/a%41"), "/a%41"); // no URI
    EXPECT_EQ(pathOf("file://"), "");
    EXPECT_EQ(pathOf("\t\"/a b\" "), "/a b");
    EXPECT_EQ(pathOf(" \t "), "");
}

TEST(ViewerFiles, modelsAndImagesAreRecognisedByTheirExtension)
{
    for (const char* const model : {".gltf", ".glb", ".obj", ".ply", ".stl", ".dae", ".fbx", ".3ds", ".GLB"})
        EXPECT_TRUE(isModel(std::string("a") + model) && !isImageFile(std::string("a") + model)) << model;
    for (const char* const picture :
         {".png", ".exr", ".tif", ".tiff", ".tga", ".jpg", ".jpeg", ".hdr", ".dds", ".ktx2", ".webp", ".bmp", ".PNG"})
        EXPECT_TRUE(isImageFile(std::string("a") + picture) && !isModel(std::string("a") + picture)) << picture;
    for (const char* const other : {"a.gif", "a.txt", "glb", ".glb", "a.glb.txt", "", "a."})
        EXPECT_FALSE(isImageFile(other) || isModel(other)) << other;
}

TEST(ViewerFiles, neighboursAreReachedByAnyNumberOfStepsInAnyFolder)
{
    const test::TemporaryFolder folder;
    const fs::path before = fs::current_path();
    fs::current_path(folder.path());
    for (const char* name : {"a.obj", "b.glb", "c.ply"})
        std::ofstream(folder / name) << "x";
    fs::create_directories(folder / "aa.glb"); // a folder is no model
    fs::create_directories(folder / "one");
    std::ofstream(folder / "one" / "only.glb") << "x";
    EXPECT_EQ(neighbourOf("a.obj", 1), "b.glb");
    EXPECT_EQ(neighbourOf("a.obj", 2), "c.ply");
    EXPECT_EQ(neighbourOf("a.obj", 5), "c.ply");
    EXPECT_EQ(neighbourOf("b.glb", -2), "c.ply");
    EXPECT_EQ(neighbourOf("b.glb", -4), "a.obj");
    EXPECT_EQ(neighbourOf("none.glb", -1), "a.obj"); // a file that is not among the models leads to the first
    EXPECT_EQ(neighbourOf("one/only.glb", 1), "");
    EXPECT_EQ(neighbourOf("one/other.glb", 1), "one/only.glb");
    EXPECT_EQ(neighbourOf("aa.glb/x.glb", 1), "");
    fs::current_path(before);
}

TEST(ViewerFiles, urisThatAreNotTextAreNotWatched)
{
    const test::TemporaryFolder folder;
    for (const char* name : {"b.bin", "i.png", "c.mtl"})
        std::ofstream(folder / name) << "x";
    const auto files = [&](const char* text) {
        std::ofstream(folder / "a.gltf") << text;
        const auto found = filesOf(folder / "a.gltf", {"i.png"});
        EXPECT_EQ(found.at(0), folder / "a.gltf");
        std::string names;
        for (const fs::path& file : found)
            names += file == folder / "a.gltf" ? "" : file.filename().string() + " ";
        return names;
    };
    EXPECT_EQ(files(R"({"buffers": [{"uri": "b.bin"}], "images": [{"uri": "i.png"}]})"), "b.bin i.png ");
    EXPECT_EQ(files(R"({"buffers": {"x": {"uri": "b.bin"}}, "images": [{"uri": "i.png"}]})"), "i.png ");
    EXPECT_EQ(files(R"({"buffers": [{"uri": 3}, {}, 4, {"uri": ""}, {"uri": "b.bin"}]})"), "b.bin ");
    EXPECT_EQ(files(R"({"images": [{"uri": "."}, {"uri": "data:b.bin"}, {"uri": "i%2Epng"}]})"), "i.png ");
    EXPECT_EQ(files(R"([{"buffers": [{"uri": "b.bin"}]}])"), "");
    EXPECT_EQ(files("no model"), "");
    std::ofstream(folder / "c.obj") << "x";
    EXPECT_EQ(filesOf(folder / "c.obj", {"", "i.png", "gone.png"}),
              (std::vector{folder / "c.obj", folder / "i.png", folder / "c.mtl"}));
    EXPECT_TRUE(filesOf("", {"i.png"}).empty());
}

// ---- events -------------------------------------------------------------------------------------

TEST(ViewerEvents, errorsNameWhatWasFound)
{
    const std::string kinds =
        "expected one of move, press, release, scroll, key, keyup, text, drop, resize, close, do, wait; found ";
    const std::pair<const char*, std::string> cases[] = {{"0.25 wait", "expected a time of at least 0.5; found '0.25'"},
                                                         {"nan wait", "expected a time of at least 0.5; found 'nan'"},
                                                         {"0.5 wait", ""},
                                                         {"move 1", "move: expected two numbers; found '1 '"},
                                                         {"scroll 1 b", "scroll: expected two numbers; found '1 b'"},
                                                         {"resize a 2", "resize: expected two numbers; found 'a 2'"},
                                                         {"move 1 2 3 4", "move: expected nothing more; found '3 4'"},
                                                         {"move  1  2  ", ""},
                                                         {"close now", "close: expected nothing more; found 'now'"},
                                                         {"wait  ", ""},
                                                         {"key", "key: expected a word after it; found none"},
                                                         {"do a b", ""},
                                                         {"1 jump", kinds + "'jump'"},
                                                         {"1", kinds + "''"}};
    for (const auto& [line, said] : cases) {
        const auto events = eventsOf("# first\r\n 0.5 wait\r\n\n" + std::string(line) + "\n", "s.txt");
        EXPECT_EQ(events ? "" : events.error().message, said.empty() ? "" : "s.txt: line 4: " + said) << line;
        EXPECT_EQ(events ? events->size() : 2u, 2u) << line;
    }
}

} // namespace
} // namespace cotan::viewer
