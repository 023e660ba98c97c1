// Text that the viewer writes: its report, the command line of its image, and the file that keeps its state.
#include <gtest/gtest.h>

#include <cstdlib>

#include <fmt/format.h>

#include "player.hpp"
#include "scene/geometry.hpp"
#include "session.hpp"
#include "settings.hpp"
#include "viewer_state.hpp"

namespace cotan::viewer {
namespace {

std::string lineOf(const std::string& report, const std::string& name)
{
    const std::size_t at = ("\n" + report).find("\n" + name + ": ");
    if (at == std::string::npos)
        return "no such line";
    const std::size_t from = at + name.size() + 2;
    return report.substr(from, report.find('\n', from) - from);
}

TEST(ViewerReport, hasALineForEachField)
{
    State s = probed();
    s.picture.model = "/a folder/b.glb";
    s.size = {640, 360};
    s.show = "shear";
    s.a = {"smooth", TangentOrigin::generated, "/maps/c.png", "directx"};
    s.b = {"exact", TangentOrigin::stored, "", ""};
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
    s.problemAreas = std::vector<ProblemArea>(2);
    (*s.problemAreas)[0].text = "first spot";
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
        {"pivot", "0.0000 0.5000 -1.0000"}, // not -0
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
        {"problem areas", "2"},
        {"problem area", "first spot"},
        {"loads", "4 failed 2"},
        {"problem", "a problem"}};
    for (const auto& [name, value] : lines)
        EXPECT_EQ(lineOf(report, name), value) << name;
    EXPECT_EQ(lineOf(report, "under the pointer").find("mesh 3 triangle 17 at "), 0u);
    for (const Setting& setting : settings())
        EXPECT_EQ(lineOf(report, setting.option.name), valueOf(setting, s.picture)) << setting.option.name;
    State other;
    other.camera.orthographic = true;
    other.camera.verticalExtent = 3.5f;
    const std::string bare = reportOf(other);
    const std::vector<std::pair<const char*, const char*>> empty = {{"model", "built-in"},
                                                                    {"triangles", "none"},
                                                                    {"compare", "off"},
                                                                    {"camera moved", "no"},
                                                                    {"lens", "orthographic 3.5000"},
                                                                    {"playing", "no"},
                                                                    {"light pinned", "no"},
                                                                    {"interface", "shown"},
                                                                    {"cheat sheet", "hidden"},
                                                                    {"look", "dark"},
                                                                    {"degrees", "none"},
                                                                    {"uv", "no such line"},
                                                                    {"problem areas", "no such line"},
                                                                    {"problem", "none"}};
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

// ---- the command line --------------------------------------------------------------------------------

// Each field on its own is written as its option, and not at all at its default.
TEST(ViewerCommandLine, writesEachFieldAsItsOption)
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
        {[](State& s) { s.a.tangents = TangentOrigin::generated; }, "--tangents generated"},
        {[](State& s) { s.picture.maps.baseColor = "c.png"; }, "--base-color c.png"},
        {[](State& s) { s.picture.maps.metallicRoughness = "r.png"; }, "--metallic-roughness r.png"},
        {[](State& s) { s.picture.maps.occlusion = "o.png"; }, "--occlusion o.png"},
        {[](State& s) { s.picture.maps.height = "h.png"; }, "--height-map h.png"},
        {[](State& s) {
             s.picture.maps.height = "h.png";
             s.picture.maps.heightDepth = 0.25f;
         },
         "--height-map h.png --height-depth 0.25"},
        {[](State& s) { s.picture.maps.material = 2; }, "--material 2"},
        {[](State& s) { s.picture.exposure = 2.0f; }, "--exposure 2"},
        {[](State& s) { s.metered = 0.5f; }, "--exposure 0.5"},
        {[](State& s) { s.picture.noNormalMaps = true; }, "--no-normal-maps"},
        {[](State& s) { s.picture.samples = 16; }, "--samples 16"},
        {[](State& s) { s.picture.device = "reference"; }, "--device reference"},
        {[](State& s) { s.picture.up = Up::z; }, "--up z"},
        {[](State& s) { s.picture.memory = 900; }, "--memory 900"},
        {[](State& s) { s.picture.maxDegrees = 1; }, "--max-degrees 1"},
    };
    for (const Row& row : rows) {
        State s;
        row.set(s);
        EXPECT_EQ(commandLine(s, "a.png", {7, 5}), std::string("cotan render -o a.png --size 7x5 ") + row.words);
    }
    State s;
    s.picture.maps.heightDepth = 0.25f; // refused without a height map, which may come later
    EXPECT_EQ(commandLine(s, "a.png", {7, 5}), "cotan render -o a.png --size 7x5");
    s = {};
    s.metered = 0.5f; // files of floats and views without light do not depend on the metered exposure
    EXPECT_EQ(commandLine(s, "a.exr", {7, 5}), "cotan render -o a.exr --size 7x5");
    s.show = "normal";
    EXPECT_EQ(commandLine(s, "a.png", {7, 5}), "cotan render -o a.png --size 7x5 --view normal");
    s = {};
    s.a.frame = "smooth";
    s.b = {"exact", TangentOrigin::generated, "", "directx"};
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

TEST(ViewerCommandLine, omitsTheMeteredExposureForAngles)
{
    State s;
    s.metered = 0.5f;
    s.compare = Compare::angle;
    EXPECT_EQ(commandLine(s, "a.png", {7, 5}).find("--exposure"), std::string::npos);
    s.compare = Compare::divider;
    EXPECT_NE(commandLine(s, "a.png", {7, 5}).find("--exposure 0.5"), std::string::npos);
}

// ---- played sessions -----------------------------------------------------------------------------------

TEST(ViewerPlayer, returnsTheSecondsSinceTheLastStep)
{
    const std::vector<Event> events = {{0.5, EventKind::key, 0, 0, "1"},
                                       {0.75, EventKind::key, 0, 0, "2"},
                                       {2, EventKind::wait, 0, 0, ""},
                                       {2, EventKind::key, 0, 0, "3"}};
    Player player(events);
    for (const double passed : {0.5, 0.25, 1.25, 0.0}) {
        const auto step = player.step(/*idle*/ true, 0);
        ASSERT_TRUE(step);
        EXPECT_EQ(step->passed, passed);
    }
    EXPECT_EQ(player.played(), 4u);
}

// ---- where the state is kept ---------------------------------------------------------------------------

TEST(ViewerMemory, isStoredInTheXdgStateFolder)
{
    const char* stateHome = std::getenv("XDG_STATE_HOME");
    const char* home = std::getenv("HOME");
    const std::optional<std::string> before[] = {stateHome ? std::optional<std::string>(stateHome) : std::nullopt,
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
