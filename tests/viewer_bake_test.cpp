// What the viewer shows of a bake, without a window: the detailed model, masks, and the turntable.
#include <gtest/gtest.h>

#include <fstream>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "bake/bake_surfaces.hpp"
#include "camera.hpp"
#include "command_words.hpp"
#include "loader.hpp"
#include "render_thread.hpp"
#include "viewer_camera_cases.hpp"
#include "viewer_session.hpp"

namespace cotan::viewer {
namespace {

// ---- the turntable --------------------------------------------------------------------------------

// A model whose middle is neither the origin nor the pivot.
State besideTheOrigin()
{
    State s = builtIn();
    auto model = std::make_shared<Model>(*s.model);
    model->box = {{1, -1, 2}, {3, 1, 6}};
    s.model = model;
    s.camera = levelCamera();
    return s;
}

// A quarter of a turn takes 3.75 s. From above, z runs down and x right: the camera at +z of the middle goes to -x.
TEST(ViewerTurntable, aQuarterTakesAsLongInOneStepAsInMany)
{
    const glm::vec3 middle{2, 0, 4};
    for (const int steps : {1, 7, 1000}) {
        State s = besideTheOrigin();
        s.camera.eye = middle + glm::vec3(0, 1, 5);
        s.camera.target = middle + glm::vec3(1, 1, 0);
        const double rotation = s.picture.environmentRotation;
        send(s, "0 key t\n");
        EXPECT_TRUE(s.turning);
        for (int i = 0; i < steps; ++i)
            advance(s, 3.75 / steps);
        expectClose(s.camera.eye, middle + glm::vec3(-5, 1, 0), 1e-3f);
        expectClose(s.camera.target, middle + glm::vec3(0, 1, 1), 1e-3f);
        expectClose(s.camera.up, {0, 1, 0}, 1e-5f);
        EXPECT_TRUE(s.cameraMoved);
        EXPECT_EQ(s.picture.environmentRotation, rotation); // unless the light is pinned to the camera
        s.lightPinned = true;
        s.pinnedAt = azimuthOf(s.camera);
        advance(s, 3.75);
        EXPECT_NEAR(s.picture.environmentRotation, rotation - 90, 0.01);
    }
}

TEST(ViewerTurntable, onlyItsKeyAndDragsOfTheViewStopIt)
{
    State s = besideTheOrigin();
    const Camera before = s.camera;
    advance(s, 1);
    EXPECT_EQ(s.camera.eye, before.eye);
    EXPECT_FALSE(orderOf(s).draft);
    send(s, "0 key t\n");
    EXPECT_TRUE(orderOf(s).draft); // it may be drawn smaller
    advance(s, 0);
    EXPECT_EQ(s.camera.eye, before.eye);
    s.compare = Compare::divider;
    send(s, "0 move 640 100\npress left\nmove 700 100\nrelease left\nscroll 0 1\nkey 4\n");
    EXPECT_NE(s.divider, 0.5f);
    EXPECT_TRUE(s.turning);
    send(s, "0 key t\n");
    EXPECT_FALSE(s.turning);
    for (const char* button : {"left", "middle"}) {
        s.turning = true;
        send(s, fmt::format("0 move 100 100\npress {}\nmove 102 100\n", button));
        EXPECT_TRUE(s.turning); // so far it is a click
        send(s, fmt::format("0 move 140 120\nrelease {}\n", button));
        EXPECT_FALSE(s.turning) << button;
    }
    State empty; // nothing to turn yet
    empty.turning = true;
    advance(empty, 1);
    EXPECT_EQ(empty.problem, "");
    EXPECT_FALSE(perform(empty, "turn 5"));
}

TEST(ViewerTurntable, aStillWindowDrawsNothing)
{
    HeadlessSession at;
    at.load("");
    at.draw();
    const auto passes = [&] {
        const std::uint64_t before = at.state().pictures;
        advance(at.state(), 0.5);
        at.draw();
        return at.state().pictures - before;
    };
    EXPECT_EQ(passes(), 0u);
    send(at.state(), "0 key t\n");
    EXPECT_GT(passes(), 0u);
    send(at.state(), "0 key t\n");
    passes(); // the last image, no longer a draft
    EXPECT_EQ(passes(), 0u);
}

// ---- the detailed model -----------------------------------------------------------------------------

// A square of the side 2 in xy, at the depth z.
void writeSquare(const fs::path& file, double z)
{
    std::ofstream(file) << fmt::format(
        "v -1 -1 {0}\nv 1 -1 {0}\nv 1 1 {0}\nv -1 1 {0}\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
        "vn 0 0 1\nf 1/1/1 2/2/1 3/3/1\nf 1/1/1 3/3/1 4/4/1\n",
        z);
}

TEST(ViewerHighModel, isReadBesideTheModelAndABadFileChangesNothing)
{
    HeadlessSession at;
    writeSquare(at.folder / "low.obj", 0);
    writeSquare(at.folder / "high.obj", 0.25);
    writeSquare(at.folder / "bolt.obj", 0.5);
    std::ofstream(at.folder / "bad.obj") << "f 1 2 3\n";
    at.load(at.in("low.obj"));
    State& s = at.state();
    const auto high = [&](std::vector<std::string> files) {
        EXPECT_TRUE(at.ask(request::LoadHigh{std::move(files)}));
        EXPECT_EQ(s.progress, 0);
        at.work([&] { return !at.parts.loader.busy(); });
    };
    high({at.in("high.obj"), at.in("bolt.obj")});
    ASSERT_TRUE(s.highModel) << s.problem;
    EXPECT_EQ(s.high.size(), 2u);
    EXPECT_EQ(s.highModel->scene.meshes.size(), 2u);
    EXPECT_EQ(s.highModel->box.high.z, 0.5f);
    EXPECT_NE(s.highModel->number, s.model->number);
    EXPECT_TRUE(showsHigh(s, true));
    EXPECT_FALSE(showsHigh(s, false));
    EXPECT_EQ(s.compare, Compare::divider);
    EXPECT_EQ(s.loads, 1u); // models
    const std::string report = reportOf(s);
    for (const char* bad : {"bad.obj", "none.obj", "low.png"}) {
        high({at.in("high.obj"), at.in(bad)});
        EXPECT_NE(s.problem.find(bad), std::string::npos) << s.problem;
        EXPECT_EQ(s.problem.find('\n'), std::string::npos);
        s.problem.clear();
        EXPECT_EQ(reportOf(s), report);
    }
    s.compare = Compare::flip; // a file that has changed changes no comparison
    s.b.high = false;
    high(s.high);
    EXPECT_EQ(s.compare, Compare::flip);
    EXPECT_FALSE(showsHigh(s, true));
    high({at.in("bolt.obj")}); // another one is shown
    EXPECT_TRUE(showsHigh(s, true));
    EXPECT_EQ(s.compare, Compare::flip);
    at.load(at.in("bolt.obj")); // another model has other detail
    EXPECT_FALSE(s.highModel);
    EXPECT_TRUE(s.high.empty());
    EXPECT_FALSE(showsHigh(s, true));
}

TEST(ViewerHighModel, itsUpAxisIsTheModelsUnlessAnotherIsGiven)
{
    HeadlessSession at;
    writeSquare(at.folder / "low.obj", 0);
    writeSquare(at.folder / "high.obj", 0.25);
    State& s = at.state();
    const auto facing = [&](Up up, std::optional<Up> highUp) { // the axes along which both squares are thin
        s.picture.up = up;
        s.highUp = highUp;
        at.load(at.in("low.obj"));
        EXPECT_TRUE(at.ask(request::LoadHigh{{at.in("high.obj")}}));
        at.work([&] { return !at.parts.loader.busy(); });
        std::string axes;
        for (const Bounds& box : {s.model->box, s.highModel->box})
            axes += box.high.y - box.low.y == 0 ? "y" : box.high.z - box.low.z == 0 ? "z" : "-";
        return axes;
    };
    EXPECT_EQ(facing(Up::y, std::nullopt), "zz");
    EXPECT_EQ(facing(Up::z, std::nullopt), "yy");
    EXPECT_EQ(facing(Up::z, Up::y), "yz");
    EXPECT_EQ(optionsOf(s, true).up, Up::y);
    EXPECT_EQ(optionsOf(s, false).up, Up::z);
    EXPECT_NE(commandLine(s, "a.png", {7, 5}).find(" --high-up y "), std::string::npos);
    EXPECT_EQ(facing(Up::y, Up::z), "zy");
    EXPECT_EQ(s.highModel->box.high.y, 0.25f);
}

// The state of a model with its detail.
State withHigh()
{
    State s = builtIn();
    s.picture.model = "stone_low.obj";
    s.highModel = std::make_shared<Model>(*s.model);
    s.high = {"stone high.obj"};
    s.b.high = true;
    s.b.frame = "smooth"; // returns when the detail is closed
    s.a.normalMap = s.b.normalMap = "map.png";
    return s;
}

TEST(ViewerHighModel, hasTheViewAndLightOfTheModelButItsOwnMapsAndFrame)
{
    State s = withHigh();
    s.picture.maps.occlusion = "ao.png";
    s.picture.environmentRotation = 30;
    s.show = "gloss";
    const PictureOptions low = optionsOf(s, false), high = optionsOf(s, true);
    EXPECT_EQ(high.model, "stone high.obj");
    EXPECT_EQ(high.maps, OwnMaps());
    EXPECT_EQ(high.camera, formatCamera(s.camera));
    EXPECT_EQ(high.environmentRotation, 30);
    EXPECT_EQ(high.show, "gloss");
    EXPECT_EQ(low.maps.normal, "map.png");
    EXPECT_EQ(sideOf(s, true).frame, kAutoFrame);
    EXPECT_EQ(orderOf(s).b.frame, kAutoFrame);
    s.show = "mask"; // the detail has none
    EXPECT_EQ(optionsOf(s, false).show, "mask");
    EXPECT_EQ(optionsOf(s, true).show, "clay");
    ASSERT_TRUE(perform(s, "swap"));
    EXPECT_TRUE(showsHigh(s, false));
    EXPECT_EQ(optionsOf(s, true).model, "stone_low.obj");
    ASSERT_TRUE(perform(s, "high"));
    EXPECT_FALSE(s.highModel);
    EXPECT_EQ(s.a.frame, "smooth");
    EXPECT_FALSE(perform(s, "second high on"));
}

TEST(ViewerHighModel, aChosenFrameTakesItsPlaceUntilItIsChosenAgain)
{
    State s = withHigh();
    s.compare = Compare::divider;
    EXPECT_EQ(interfaceOf(s).rightName, "high: stone high.obj");
    ASSERT_TRUE(perform(s, "second frame exact"));
    EXPECT_EQ(interfaceOf(s).rightName, "exact");
    ASSERT_TRUE(perform(s, "second high on"));
    s.high.emplace_back("bolts.obj");
    EXPECT_EQ(interfaceOf(s).rightName, "high: stone high.obj + 1");
    for (const char* wrong : {"second high", "second high yes"})
        EXPECT_FALSE(perform(s, wrong)) << wrong;
}

TEST(ViewerHighModel, printedCommandsDrawItOrOpenTheWindow)
{
    State s = withHigh();
    s.highModel = std::make_shared<Model>(Model{.scene = {}, .box = {}, .read = {}, .animations = {}});
    auto unlit = std::make_shared<Model>(*s.model);
    unlit->scene.lights.clear();
    s.model = unlit;
    s.compare = Compare::flip;
    s.second = true;
    EXPECT_EQ(commandLine(s, "a.png", {7, 5}),
              "cotan render 'stone high.obj' -o a.png --size 7x5 --camera " + formatCamera(s.camera));
    s.high.emplace_back("bolts.obj"); // no command draws two files
    const std::string view = "cotan view stone_low.obj --size 7x5 --high 'stone high.obj' --high bolts.obj";
    EXPECT_EQ(commandLine(s, "a.png", {7, 5}), view + " --do flip --normal-map map.png");
    s.compare = Compare::divider;
    EXPECT_EQ(commandLine(s, "a.png", {7, 5}), view + " --normal-map map.png");
    s.compare = Compare::angle;
    EXPECT_EQ(commandLine(s, "a.png", {7, 5}), view + " --do 'compare angle' --normal-map map.png");
}

TEST(ViewerHighModel, aDroppedFileIsItIfTheNamesSaySo)
{
    struct Case {
        const char *model, *dropped;
        bool high;
    } cases[] = {{"a/stone_low.glb", "b/stone_high.obj", true},
                 {"stone.glb", "stone_hp.ply", true},
                 {"doorLow.obj", "doorHigh_bolts.obj", true},
                 {"stone_low.glb", "rock_high.obj", false},
                 {"stone_low.glb", "stone.obj", false},
                 {"stone_high.glb", "stone_high.obj", false},
                 {"", "stone_high.obj", false}};
    for (const Case& c : cases) {
        for (const char* command : {"drop", "open"}) {
            State s = builtIn();
            s.picture.model = c.model;
            ASSERT_TRUE(perform(s, fmt::format("{} {}", command, c.dropped)));
            ASSERT_EQ(s.requests.size(), 1u);
            const bool dropped = command == std::string("drop");
            EXPECT_EQ(std::holds_alternative<request::LoadHigh>(s.requests[0]), c.high && dropped) << c.dropped;
        }
    }
    State s = withHigh();
    ASSERT_TRUE(perform(s, "drop stone_high.png")); // an image is a map
    EXPECT_EQ(s.a.normalMap, "stone_high.png");
}

TEST(ViewerHighModel, theDialogOpensItOrAMask)
{
    HeadlessSession at;
    for (const char* command : {"high", "set mask"}) {
        at.window->answer = {FileAnswer::open, ""};
        ASSERT_TRUE(perform(at.state(), fmt::format("choose {}", command)));
        EXPECT_TRUE(carryOutRequests(at.parts));
        at.window->answer = {FileAnswer::closed, "/m/a b.png"};
        EXPECT_TRUE(carryOutRequests(at.parts));
        EXPECT_EQ(at.state().picture.maps.mask, command == std::string("high") ? "" : "/m/a b.png");
        if (command == std::string("high")) {
            ASSERT_EQ(at.state().requests.size(), 1u);
            const auto& files = std::get<request::LoadHigh>(at.state().requests[0]).files;
            EXPECT_EQ(files, (std::vector<std::string>{"/m/a b.png"}));
        }
    }
}

// ---- masks ----------------------------------------------------------------------------------------------

TEST(ViewerMask, theLegendHasTheColoursOfMasks)
{
    State s = builtIn();
    s.show = "mask";
    const auto legend = interfaceOf(s).legend;
    ASSERT_EQ(legend.size(), 5u);
    const std::pair<int, const char*> states[] = {{texelMissed | texelCovered, "no detail found"},
                                                  {texelNegative, "points into the surface"},
                                                  {texelOverlapped | texelCovered, "shared by triangles that differ"},
                                                  {texelCovered, "baked"},
                                                  {texelTouched, "baked, beside a chart"}};
    for (std::size_t i = 0; i < legend.size(); ++i) {
        Baked baked{.width = 1, .height = 1, .values = {}, .states = {std::uint8_t(states[i].first)}, .statistics = {}};
        const Image mask = maskOf(baked);
        EXPECT_EQ(legend[i].first, states[i].second);
        for (int c = 0; c < 3; ++c)
            EXPECT_EQ(mask.bytes8()[c], std::lround(255 * legend[i].second[c])) << i;
    }
    for (const auto& set : {+[](State& x) { x.show = "clay"; }, +[](State& x) { x.interfaceShown = false; },
                            +[](State& x) { x.compare = Compare::angle; }}) {
        State other = s;
        set(other);
        EXPECT_TRUE(interfaceOf(other).legend.empty());
    }
}

TEST(ViewerMask, isShownWhenItIsSetAndNotWithoutAFile)
{
    State s = builtIn();
    EXPECT_FALSE(perform(s, "show mask"));
    EXPECT_EQ(s.show, "shaded");
    s.show = "emissive"; // the view before it
    send(s, "0 key v\n");
    EXPECT_EQ(s.show, "clay");
    ASSERT_TRUE(perform(s, "set mask seen.png"));
    EXPECT_EQ(s.show, "mask");
    s.show = "emissive";
    send(s, "0 key v\n");
    EXPECT_EQ(s.show, "mask");
    EXPECT_EQ(commandLine(s, "a.png", {7, 5}), "cotan render -o a.png --size 7x5 --view mask --mask seen.png");
    s.show = "clay"; // a mask is not drawn with other views
    EXPECT_EQ(commandLine(s, "a.png", {7, 5}), "cotan render -o a.png --size 7x5 --view clay");
    s.show = "mask";
    ASSERT_TRUE(perform(s, "set mask "));
    EXPECT_EQ(s.show, "shaded");
}

} // namespace
} // namespace cotan::viewer
