// What the viewer shows beside the image and says in its report: every line and value, each with an input of its own.
#include <gtest/gtest.h>

#include <cstdlib>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "camera.hpp"
#include "cotan/report/angles.hpp"
#include "cotan/scene/bounds.hpp"
#include "session.hpp"
#include "settings.hpp"
#include "viewer_state.hpp"

namespace cotan::viewer {
namespace {

State builtIn()
{
    static const State state = withModel();
    return state;
}

std::string lineOf(const std::string& report, const std::string& name)
{
    const std::size_t at = ("\n" + report).find("\n" + name + ": ");
    if (at == std::string::npos)
        return "no such line";
    const std::size_t from = at + name.size() + 2;
    return report.substr(from, report.find('\n', from) - from);
}

// The built-in scene with something under the pointer; no two numbers of it are the same.
State probed()
{
    State s = builtIn();
    PickedPoint hit;
    hit.mesh = 3;
    hit.triangle = 17;
    hit.position = s.camera.target;
    hit.depth = glm::length(s.camera.target - s.camera.eye);
    s.probe.hit = hit;
    Probed& p = s.probe.surface;
    p.normal = {0, 0, 1};
    p.t = {2, 0, 0};
    p.b = {0, 0.5f, 0};
    p.storedTangent = {0.6f, 0.8f, 0};
    p.w = -1;
    p.hasUv = true;
    p.uv = {0.25f, 0.75f};
    p.texel = {5, 9};
    s.probe.degrees = 12.345f;
    s.statisticsOf = "triangle against exact";
    s.pointer = {100, 60};
    return s;
}

TEST(ViewerReport, hasTheValueOfEachFieldInTheLineOfItsName)
{
    State s = probed();
    s.picture.model = "/a folder/b.glb";
    s.size = {640, 360};
    s.show = "shear";
    s.a = {"smooth", "generated", "/maps/c.png", "directx"};
    s.b = {"exact", "stored", "", ""};
    s.compare = Compare::flip;
    s.second = true;
    s.divider = 0.125f;
    s.cameraMoved = s.lightPinned = s.cheatSheet = s.playing = true;
    s.interfaceShown = s.dark = false;
    s.camera.eye = {1, 2, 3.25f};
    s.camera.target = {-0.0f, 0.5f, -1};
    s.camera.verticalFieldOfView = 0.5235988f; // 30 degrees
    s.metered = 1.75f;
    s.statistics.mean = 3;
    s.loads = 4;
    s.failedLoads = 2;
    s.problem = "a problem";
    s.hotSpots = std::vector<HotSpot>(2);
    (*s.hotSpots)[0].text = "first spot";
    const std::string report = reportOf(s);
    const std::vector<std::pair<const char*, std::string>> lines = {
        {"model", "b.glb"},
        {"triangles", fmt::format("{}", trianglesDrawn(s.model->scene))},
        {"size", "640x360"},
        {"view", "shear"},
        {"first", "smooth generated c.png directx"},
        {"second", "exact stored - -"},
        {"compare", "flip second"},
        {"divider", "0.125"},
        {"camera moved", "yes"},
        {"eye", "1.0000 2.0000 3.2500"},
        {"pivot", "0.0000 0.5000 -1.0000"}, // and no -0
        {"lens", "30.00 degrees"},
        {"playing", "yes"},
        {"metered", "1.7500"},
        {"light pinned", "yes"},
        {"interface", "hidden"},
        {"cheat sheet", "shown"},
        {"look", "light"},
        {"degrees", "triangle against exact: " + toText(s.statistics)},
        {"uv", "0.2500 0.7500 texel 5 9"},
        {"t", "2.0000 0.0000 0.0000"},
        {"b", "0.0000 0.5000 0.0000"},
        {"n", "0.0000 0.0000 1.0000"},
        {"w", "-1"},
        {"stored tangent", "0.6000 0.8000 0.0000"},
        {"degrees there", "12.35"},
        {"hot spots", "2"},
        {"hot spot", "first spot"},
        {"loads", "4 failed 2"},
        {"problem", "a problem"}};
    for (const auto& [name, value] : lines)
        EXPECT_EQ(lineOf(report, name), value) << name;
    EXPECT_EQ(lineOf(report, "under the pointer").find("mesh 3 triangle 17 at "), 0u);
    for (const Setting& setting : settings())
        EXPECT_EQ(lineOf(report, setting.name), valueOf(setting, s.picture)) << setting.name;
    State other;
    other.camera.orthographic = true;
    other.camera.verticalExtent = 3.5f;
    const std::string bare = reportOf(other);
    const std::vector<std::pair<const char*, const char*>> empty = {
        {"model", "built-in"},           {"triangles", "none"}, {"compare", "off"},     {"camera moved", "no"},
        {"lens", "orthographic 3.5000"}, {"playing", "no"},     {"light pinned", "no"}, {"interface", "shown"},
        {"cheat sheet", "hidden"},       {"look", "dark"},      {"degrees", "none"},    {"uv", "no such line"},
        {"hot spots", "no such line"},   {"problem", "none"}};
    for (const auto& [name, value] : empty)
        EXPECT_EQ(lineOf(bare, name), value) << name;
    other.picture.shape = "torus";
    EXPECT_EQ(lineOf(reportOf(other), "model"), "torus");
    for (const auto& [mode, word] : {std::pair(Compare::divider, "divider"), {Compare::angle, "angle"}}) {
        other.compare = mode;
        EXPECT_EQ(lineOf(reportOf(other), "compare"), word);
    }
    State nothing = probed();
    nothing.probe.surface.storedTangent = glm::vec3(0);
    nothing.probe.degrees = -1;
    EXPECT_EQ(lineOf(reportOf(nothing), "stored tangent"), "none");
    EXPECT_EQ(lineOf(reportOf(nothing), "degrees there"), "none");
    nothing.probe.degrees = 0;
    EXPECT_EQ(lineOf(reportOf(nothing), "degrees there"), "0.00");
}

TEST(ViewerInterface, theCardHasALineForEachThingThatIsThereAndStandsAtThePointer)
{
    State s = probed();
    const Interface i = interfaceOf(s);
    EXPECT_EQ(i.card,
              (std::vector<std::string>{"12.35\xc2\xb0 triangle against exact", "mesh 3, triangle 17",
                                        "uv 0.2500 0.7500", "texel 5 9", "w -1", "t 2.00 0.00 0.00", "b 0.00 0.50 0.00",
                                        "n 0.00 0.00 1.00", "stored t 0.60 0.80 0.00"}));
    EXPECT_EQ(i.cardAt, s.pointer);
    Probed& p = s.probe.surface;
    p.hasUv = false;
    p.texel = {-1, -1};
    p.w = 0;
    p.storedTangent = glm::vec3(0);
    s.probe.degrees = -1;
    EXPECT_EQ(interfaceOf(s).card,
              (std::vector<std::string>{"mesh 3, triangle 17", "no uv", "t 2.00 0.00 0.00", "b 0.00 0.50 0.00",
                                        "n 0.00 0.00 1.00"}));
    for (const auto& hide : {+[](State& x) { x.cardShown = false; }, +[](State& x) { x.interfaceShown = false; },
                             +[](State& x) { x.probe.hit.reset(); }, +[](State& x) { x.held = "left"; }}) {
        State hidden = probed();
        hide(hidden);
        EXPECT_TRUE(interfaceOf(hidden).card.empty());
        EXPECT_TRUE(interfaceOf(hidden).lines.empty());
    }
}

// From the front x goes right, y up; z, towards the eye, is a point in the middle of the image.
TEST(ViewerInterface, arrowsAre60PixelsLongAlongTheirDirections)
{
    for (const bool orthographic : {false, true}) {
        State s = probed();
        s.camera.up = {0, 1, 0};
        ASSERT_TRUE(seeFrom(s.camera, "front"));
        setOrthographic(s.camera, orthographic);
        s.probe.hit->depth = glm::length(s.camera.target - s.camera.eye);
        const std::vector<Line2D> lines = interfaceOf(s).lines;
        ASSERT_EQ(lines.size(), 4u);
        const std::vector<std::pair<std::string, glm::vec2>> expected = {
            {"stored", {45, -60}}, {"t", {60, 0}}, {"b", {0, -60}}, {"n", {0, 0}}}; // stored: 75 along (0.6, 0.8)
        for (std::size_t k = 0; k < 4; ++k) {
            EXPECT_EQ(lines[k].label, expected[k].first);
            const glm::vec2 to = lines[k].to - lines[k].from;
            EXPECT_NEAR(glm::length(to - expected[k].second), 0, 0.05f) << lines[k].label << to.x << " " << to.y;
            EXPECT_NEAR(lines[k].from.x, float(s.size.x) / 2, 0.05f);
            EXPECT_NEAR(lines[k].from.y, float(s.size.y) / 2, 0.05f);
        }
        EXPECT_GT(lines[1].color.x, 2 * lines[1].color.y); // t red, b green, n blue
        EXPECT_GT(lines[2].color.y, 2 * lines[2].color.x);
        EXPECT_GT(lines[3].color.z, 2 * lines[3].color.x);
        s.probe.surface.t = glm::vec3(0); // where there is no frame there is no arrow
        EXPECT_EQ(interfaceOf(s).lines.size(), 3u);
    }
}

TEST(ViewerInterface, theStatusNamesTheModelTheFramesTheDegreesAndTheDevice)
{
    State s = builtIn();
    s.picture.model = "/x/jar.glb";
    s.show = "shaded";
    s.a.frame = "smooth";
    s.b.frame = "exact";
    s.device = "a card";
    const std::string triangles = fmt::format("{} triangles", trianglesDrawn(s.model->scene));
    EXPECT_EQ(interfaceOf(s).status, "jar.glb   " + triangles + "   shaded, smooth   a card");
    s.drawSeconds = 0.0123;
    EXPECT_EQ(interfaceOf(s).status, "jar.glb   " + triangles + "   shaded, smooth   a card (12 ms)");
    s.drawSeconds = 0;
    s.said = "copied";
    s.compare = Compare::divider;
    EXPECT_EQ(interfaceOf(s).status, "copied\njar.glb   " + triangles + "   shaded, smooth | exact   a card");
    s.said.clear();
    s.compare = Compare::angle;
    s.statisticsOf = "first against second";
    s.statistics = angleStatistics({1, 2, 6});
    const std::string degrees = fmt::format(
        "first against second: mean 3.00\xc2\xb0, 95 % {:.2f}\xc2\xb0, max 6.00\xc2\xb0", s.statistics.percentile95);
    EXPECT_EQ(interfaceOf(s).status,
              "jar.glb   " + triangles + "   shaded, smooth against exact   " + degrees + "   a card");
    s.statistics = {};
    EXPECT_NE(interfaceOf(s).status.find("first against second: no normal map is seen"), std::string::npos);
    s.statisticsShown = false;
    EXPECT_EQ(interfaceOf(s).status.find("first against second"), std::string::npos);
    s.compare = Compare::flip;
    s.second = true;
    EXPECT_EQ(interfaceOf(s).status, "jar.glb   " + triangles + "   shaded, exact   a card");
    State bare;
    EXPECT_EQ(interfaceOf(bare).status, "built-in scene   shaded, auto   ");
    bare.picture.shape = "torus";
    EXPECT_EQ(interfaceOf(bare).status, "torus   shaded, auto   ");
    State chosen = builtIn(); // of "auto" also what it is for the model's maps, unless another map is on it
    const std::string status = interfaceOf(chosen).status;
    EXPECT_NE(status.find("shaded, auto ("), std::string::npos) << status;
    chosen.a.normalMap = "m.png";
    EXPECT_EQ(interfaceOf(chosen).status.find("auto ("), std::string::npos);
}

TEST(ViewerInterface, slidersHaveTheValuesAndBoundsOfTheirSettings)
{
    State s = builtIn();
    s.metered = 1.5f;
    s.picture.environmentRotation = -33;
    s.picture.environmentIntensity = 2.5;
    s.picture.shadowSoftness = 7;
    struct Row {
        const char *label, *command, *unit;
        double value, low, high;
        bool logarithmic;
    };
    const auto expectRows = [](const State& state, const std::vector<Row>& rows) {
        const std::vector<Slider> sliders = interfaceOf(state).sliders;
        ASSERT_EQ(sliders.size(), rows.size());
        for (std::size_t k = 0; k < rows.size(); ++k) {
            const Slider& a = sliders[k];
            const Row& b = rows[k];
            EXPECT_EQ(a.label, b.label);
            EXPECT_EQ(a.command, b.command) << b.label;
            EXPECT_EQ(a.unit, b.unit) << b.label;
            EXPECT_NEAR(a.value, b.value, 1e-9) << b.label;
            EXPECT_EQ(a.low, b.low) << b.label;
            EXPECT_EQ(a.high, b.high) << b.label;
            EXPECT_EQ(a.logarithmic, b.logarithmic) << b.label;
        }
    };
    std::vector<Row> rows = {{"exposure", "set exposure", "", 1.5, 0.05, 20, true},
                             {"light rotation", "set environment-rotation", "degrees", -33, -180, 180, false},
                             {"light intensity", "set environment-intensity", "", 2.5, 0.05, 20, true},
                             {"shadow softness", "set shadow-softness", "degrees", 7, 0, 60, false}};
    expectRows(s, rows);
    s.picture.exposure = "0.25";
    rows[0].value = 0.25;
    s.picture.shadowSoftness = -1; // that of the lamp: the evening's is smaller
    rows[3].value = 10;
    expectRows(s, rows);
    s.picture.environment = "evening";
    rows[3].value = 3;
    s.picture.shadowSoftness = -0.5;
    expectRows(s, rows);
    s.picture.shadowSoftness = 0;
    rows[3].value = 0;
    s.compare = Compare::divider;
    s.divider = 0.75f;
    rows.push_back({"divider", "divider", "", 0.75, 0, 1, false});
    auto model = std::make_shared<Model>(*s.model);
    model->animations = {{"walk", 2.5}};
    s.model = model;
    s.picture.animation = "walk";
    s.picture.time = 0.5;
    rows.push_back({"time", "set time", "s", 0.5, 0, 2.5, false});
    expectRows(s, rows);
    model->animations[0].seconds = 0; // a pose has no time
    rows.pop_back();
    expectRows(s, rows);
}

TEST(ViewerInterface, degreesHaveAScaleOfColoursWhereTheyAreShown)
{
    State s = builtIn();
    EXPECT_TRUE(interfaceOf(s).scaleBar.empty());
    for (const auto& set : {+[](State& x) { x.compare = Compare::angle; }, +[](State& x) { x.show = "error"; },
                            +[](State& x) { x.show = "shear"; }}) {
        State shown = builtIn();
        set(shown);
        const auto bar = interfaceOf(shown).scaleBar;
        ASSERT_EQ(bar.size(), 6u);
        const double stops[] = {0, 0.5, 2, 5, 15, 45};
        for (std::size_t k = 0; k < 6; ++k) {
            EXPECT_EQ(bar[k].first, stops[k]);
            const Image one = heatMap({float(stops[k])}, 1, 1); // the colour that the view has there
            for (int c = 0; c < 3; ++c)
                EXPECT_EQ(std::lround(255 * bar[k].second[c]), one.bytes8()[c]) << k << " " << c;
        }
        shown.interfaceShown = false;
        EXPECT_TRUE(interfaceOf(shown).scaleBar.empty());
    }
}

TEST(ViewerInterface, theDividerStandsAtItsShareWithTheNamesOfBothSides)
{
    State s = builtIn();
    s.size = {800, 300};
    s.divider = 0.25f;
    s.a.frame = "smooth";
    s.b.frame = "exact";
    EXPECT_LT(interfaceOf(s).divider, 0);
    s.compare = Compare::divider;
    const Interface i = interfaceOf(s);
    EXPECT_EQ(i.divider, 200);
    EXPECT_EQ(i.leftName, "smooth");
    EXPECT_EQ(i.rightName, "exact");
    s.interfaceShown = false;
    EXPECT_LT(interfaceOf(s).divider, 0);
}

TEST(ViewerInterface, switchesAndWhatIsLoadingAreThoseOfTheState)
{
    State s = builtIn();
    s.hotSpots = std::vector<HotSpot>(2);
    (*s.hotSpots)[0].text = "one";
    (*s.hotSpots)[1].text = "two";
    for (const bool on : {false, true}) {
        s.interfaceShown = on;
        s.dark = !on;
        s.cheatSheet = on;
        s.settingsShown = !on;
        s.hotSpotsShown = on;
        s.scale = on ? 1.5f : 0.0f;
        s.loading = on ? "a.glb" : "";
        s.progress = on ? 0.5f : -1.0f;
        s.problem = on ? "wrong" : "";
        const Interface i = interfaceOf(s);
        EXPECT_EQ(i.shown, on);
        EXPECT_EQ(i.dark, !on);
        EXPECT_EQ(i.cheatSheet, on);
        EXPECT_EQ(i.slidersShown, !on);
        EXPECT_EQ(i.hotSpotsShown, on);
        EXPECT_EQ(i.scale, s.scale);
        EXPECT_EQ(i.doing, on ? "loading a.glb" : "");
        EXPECT_EQ(i.progress, s.progress);
        EXPECT_EQ(i.problem, s.problem);
        ASSERT_EQ(i.hotSpots.size(), 2u);
        EXPECT_EQ(i.hotSpots[1].text, "two");
        EXPECT_EQ(i.hotSpots[1].command, "hot-spot 1");
    }
}

TEST(ViewerInterface, aTriangleBehindTheEyeOrOfAMomentThatHasGoneHasNoOutline)
{
    State s = builtIn();
    s.hotSpots = std::vector<HotSpot>(1);
    const glm::vec3 forward = glm::normalize(s.camera.target - s.camera.eye);
    (*s.hotSpots)[0].corners = {s.camera.target, s.camera.target + s.camera.up, s.camera.eye + 2.0f * forward};
    EXPECT_TRUE(interfaceOf(s).lines.empty()); // nobody has gone to it
    s.hotSpot = 0;
    const std::vector<Line2D> lines = interfaceOf(s).lines;
    ASSERT_EQ(lines.size(), 3u);
    for (std::size_t k = 0; k < 3; ++k)
        EXPECT_EQ(lines[k].to, lines[(k + 1) % 3].from); // closed
    for (std::size_t corner = 0; corner < 3; ++corner) {
        State behind = s;
        (*behind.hotSpots)[0].corners[corner] = s.camera.eye - forward;
        EXPECT_TRUE(interfaceOf(behind).lines.empty()) << corner;
    }
    s.playing = true;
    EXPECT_TRUE(interfaceOf(s).lines.empty());
    s.playing = false;
    s.interfaceShown = false;
    EXPECT_TRUE(interfaceOf(s).lines.empty());
}

// ---- the command line --------------------------------------------------------------------------------

// One field at a time: each is said by its option, and where it is at its default nothing is.
TEST(ViewerCommandLine, saysEachFieldByItsOwnOption)
{
    struct Row {
        void (*set)(State&);
        const char* words;
    };
    const Row rows[] = {
        {[](State& s) { s.a.frame = "exact"; }, "--frame exact"},
        {[](State& s) { s.show = "error"; }, "--view error"},
        {[](State& s) { s.picture.camera = "left"; }, "--camera left"},
        {[](State& s) { s.a.normalMap = "n m.png"; }, "--normal-map 'n m.png'"},
        {[](State& s) { s.a.convention = "directx"; }, "--convention directx"},
        {[](State& s) { s.a.tangents = "generated"; }, "--tangents generated"},
        {[](State& s) { s.picture.maps.baseColor = "c.png"; }, "--base-color c.png"},
        {[](State& s) { s.picture.maps.metallicRoughness = "r.png"; }, "--metallic-roughness r.png"},
        {[](State& s) { s.picture.maps.occlusion = "o.png"; }, "--occlusion o.png"},
        {[](State& s) { s.picture.maps.material = 2; }, "--material 2"},
        {[](State& s) { s.picture.exposure = "2"; }, "--exposure 2"},
        {[](State& s) { s.metered = 0.5f; }, "--exposure 0.5"},
        {[](State& s) { s.picture.noNormalMaps = true; }, "--no-normal-maps"},
        {[](State& s) { s.picture.samples = 16; }, "--samples 16"},
        {[](State& s) { s.picture.device = "reference"; }, "--device reference"},
        {[](State& s) { s.picture.lighting = "x"; }, "--lighting x"},
        {[](State& s) { s.picture.rows = "x"; }, "--rows x"},
        {[](State& s) { s.picture.normalMapping = "x"; }, "--normal-mapping x"},
    };
    for (const Row& row : rows) {
        State s;
        row.set(s);
        EXPECT_EQ(commandLine(s, "a.png", {7, 5}), std::string("cotan render -o a.png --size 7x5 ") + row.words);
    }
    State s;
    s.metered = 0.5f; // what was metered is light, which a file of floats has without it, and other views do not have
    EXPECT_EQ(commandLine(s, "a.exr", {7, 5}), "cotan render -o a.exr --size 7x5");
    s.show = "normal";
    EXPECT_EQ(commandLine(s, "a.png", {7, 5}), "cotan render -o a.png --size 7x5 --view normal");
    s = {};
    s.a.frame = "smooth";
    s.b = {"exact", "generated", "", "directx"};
    s.compare = Compare::flip;
    EXPECT_EQ(commandLine(s, "a.png", {7, 5}), "cotan render -o a.png --size 7x5 --frame smooth");
    s.second = true;
    EXPECT_EQ(commandLine(s, "a.png", {7, 5}),
              "cotan render -o a.png --size 7x5 --frame exact --convention directx --tangents generated");
    s.show = "normal";
    for (const Compare mode : {Compare::divider, Compare::angle}) {
        s.compare = mode;
        EXPECT_EQ(commandLine(s, "", {7, 5}), "cotan compare -o '' --size 7x5 --frames smooth,exact");
    }
}

TEST(ViewerCommandLine, anExposureThatWasMeteredIsNotSaidWhereAnglesAreCompared)
{
    State s;
    s.metered = 0.5f;
    s.compare = Compare::angle;
    EXPECT_EQ(commandLine(s, "a.png", {7, 5}).find("--exposure"), std::string::npos);
    s.compare = Compare::divider;
    EXPECT_NE(commandLine(s, "a.png", {7, 5}).find("--exposure 0.5"), std::string::npos);
}

// ---- where the state is kept ---------------------------------------------------------------------------

TEST(ViewerMemory, isKeptInTheFolderForStateOfTheDesktop)
{
    const char* place = std::getenv("XDG_STATE_HOME");
    const char* home = std::getenv("HOME");
    const std::optional<std::string> before[] = {place ? std::optional<std::string>(place) : std::nullopt,
                                                 home ? std::optional<std::string>(home) : std::nullopt};
    const auto at = [](const char* state, const char* folder) {
        state ? ::setenv("XDG_STATE_HOME", state, 1) : ::unsetenv("XDG_STATE_HOME");
        folder ? ::setenv("HOME", folder, 1) : ::unsetenv("HOME");
        return memoryFile().string();
    };
    EXPECT_EQ(at("/s", "/h"), "/s/cotan/view.txt");
    EXPECT_EQ(at("relative", "/h"), "/h/.local/state/cotan/view.txt");
    EXPECT_EQ(at("", "/h"), "/h/.local/state/cotan/view.txt");
    EXPECT_EQ(at(nullptr, "/h"), "/h/.local/state/cotan/view.txt");
    EXPECT_EQ(at(nullptr, ""), "");
    EXPECT_EQ(at(nullptr, nullptr), "");
    EXPECT_EQ(at("/s", nullptr), "/s/cotan/view.txt");
    const char* const names[] = {"XDG_STATE_HOME", "HOME"};
    for (int k = 0; k < 2; ++k)
        before[k] ? ::setenv(names[k], before[k]->c_str(), 1) : ::unsetenv(names[k]);
}

} // namespace
} // namespace cotan::viewer
