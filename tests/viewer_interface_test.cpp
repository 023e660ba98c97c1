// The viewer's interface beside the image: every line and value, each with an input of its own.
#include <gtest/gtest.h>

#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "camera.hpp"
#include "inspect/angles.hpp"
#include "scene/geometry.hpp"
#include "viewer_state.hpp"

namespace cotan::viewer {
namespace {

TEST(ViewerInterface, theCardListsTheAvailableValuesAtThePointer)
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

// Seen from the front, x points right and y up in the image; z points to the eye and is a point in the centre.
TEST(ViewerInterface, arrowsAre60PixelsLongAlongTheirDirections)
{
    for (const bool orthographic : {false, true}) {
        State s = probed();
        s.camera.up = {0, 1, 0};
        ASSERT_TRUE(viewFrom(s.camera, "front"));
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
        s.probe.surface.t = glm::vec3(0); // no arrow without a frame
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
    s.message = "copied";
    s.compare = Compare::divider;
    EXPECT_EQ(interfaceOf(s).status, "copied\njar.glb   " + triangles + "   shaded, smooth | exact   a card");
    s.message.clear();
    s.compare = Compare::angle;
    s.statisticsOf = "first against second";
    s.statistics = angleStatistics({1, 2, 6});
    const std::string degrees = fmt::format(
        "first against second: mean 3.00\xc2\xb0, 95 % {:.2f}\xc2\xb0, max 6.00\xc2\xb0", s.statistics.percentile95);
    EXPECT_EQ(interfaceOf(s).status,
              "jar.glb   " + triangles + "   shaded, smooth against exact   " + degrees + "   a card");
    s.statistics = {};
    EXPECT_NE(interfaceOf(s).status.find("first against second: no normal map is visible"), std::string::npos);
    s.statisticsShown = false;
    EXPECT_EQ(interfaceOf(s).status.find("first against second"), std::string::npos);
    s.compare = Compare::flip;
    s.second = true;
    EXPECT_EQ(interfaceOf(s).status, "jar.glb   " + triangles + "   shaded, exact   a card");
    State bare;
    EXPECT_EQ(interfaceOf(bare).status, "built-in scene   shaded, auto   ");
    bare.picture.shape = "torus";
    EXPECT_EQ(interfaceOf(bare).status, "torus   shaded, auto   ");
    State chosen = builtIn(); // "auto" is followed by the frame that it stands for, unless another normal map is used
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
    s.picture.exposure = 0.25f;
    rows[0].value = 0.25;
    s.picture.shadowSoftness.reset(); // default: the lamp's softness, which is smaller for the evening
    rows[3].value = 10;
    expectRows(s, rows);
    s.picture.environment = "evening";
    rows[3].value = 3;
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
    model->animations[0].seconds = 0; // a pose has no duration
    rows.pop_back();
    expectRows(s, rows);
}

TEST(ViewerInterface, viewsOfDegreesHaveAColourScale)
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
            const Image one = heatMap({float(stops[k])}, 1, 1); // the colour of these degrees in the view
            for (int c = 0; c < 3; ++c)
                EXPECT_EQ(std::lround(255 * bar[k].second[c]), one.bytes8()[c]) << k << " " << c;
        }
        shown.interfaceShown = false;
        EXPECT_TRUE(interfaceOf(shown).scaleBar.empty());
    }
}

TEST(ViewerInterface, theDividerIsAtItsFractionWithBothNames)
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

TEST(ViewerInterface, switchesAndLoadingProgressFollowTheState)
{
    State s = builtIn();
    s.problemAreas = std::vector<ProblemArea>(2);
    (*s.problemAreas)[0].text = "one";
    (*s.problemAreas)[1].text = "two";
    for (const bool on : {false, true}) {
        s.interfaceShown = on;
        s.dark = !on;
        s.cheatSheet = on;
        s.settingsShown = !on;
        s.problemAreasShown = on;
        s.scale = on ? 1.5f : 0.0f;
        s.loading = on ? "a.glb" : "";
        s.progress = on ? 0.5f : -1.0f;
        s.problem = on ? "wrong" : "";
        const Interface i = interfaceOf(s);
        EXPECT_EQ(i.shown, on);
        EXPECT_EQ(i.dark, !on);
        EXPECT_EQ(i.cheatSheet, on);
        EXPECT_EQ(i.slidersShown, !on);
        EXPECT_EQ(i.problemAreasShown, on);
        EXPECT_EQ(i.scale, s.scale);
        EXPECT_EQ(i.doing, on ? "loading a.glb" : "");
        EXPECT_EQ(i.progress, s.progress);
        EXPECT_EQ(i.problem, s.problem);
        ASSERT_EQ(i.problemAreas.size(), 2u);
        EXPECT_EQ(i.problemAreas[1].text, "two");
        EXPECT_EQ(i.problemAreas[1].command, "hot-spot 1");
    }
}

TEST(ViewerInterface, trianglesBehindTheEyeOrWhilePlayingHaveNoOutline)
{
    State s = builtIn();
    s.problemAreas = std::vector<ProblemArea>(1);
    const glm::vec3 forward = glm::normalize(s.camera.target - s.camera.eye);
    (*s.problemAreas)[0].corners = {s.camera.target, s.camera.target + s.camera.up, s.camera.eye + 2.0f * forward};
    EXPECT_TRUE(interfaceOf(s).lines.empty()); // no area is selected
    s.problemArea = 0;
    const std::vector<Line2D> lines = interfaceOf(s).lines;
    ASSERT_EQ(lines.size(), 3u);
    for (std::size_t k = 0; k < 3; ++k)
        EXPECT_EQ(lines[k].to, lines[(k + 1) % 3].from); // closed
    for (std::size_t corner = 0; corner < 3; ++corner) {
        State behind = s;
        (*behind.problemAreas)[0].corners[corner] = s.camera.eye - forward;
        EXPECT_TRUE(interfaceOf(behind).lines.empty()) << corner;
    }
    s.playing = true;
    EXPECT_TRUE(interfaceOf(s).lines.empty());
    s.playing = false;
    s.interfaceShown = false;
    EXPECT_TRUE(interfaceOf(s).lines.empty());
}

} // namespace
} // namespace cotan::viewer
