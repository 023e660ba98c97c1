// Each command of the viewer: what it changes, that nothing else changes, both sides of each limit, and menu ticks.
#include <gtest/gtest.h>

#include <map>
#include <vector>

#include <fmt/format.h>

#include "picture_options.hpp"
#include "session.hpp"
#include "settings.hpp"
#include "terminal/arguments.hpp"
#include "viewer_state.hpp"

namespace cotan::viewer {
namespace {

// The state with the built-in scene, which is loaded once.
State start()
{
    static const State state = withModel();
    return state;
}

// The state after a line is performed.
State after(const std::string& line, State state = start())
{
    const Status done = perform(state, line);
    EXPECT_TRUE(done) << line;
    return state;
}

bool refused(const std::string& line, State state = start()) { return !perform(state, line); }

TEST(ViewerCommands, sizesAreOneTo16384OnEachSide)
{
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 16384}, {16384, 1}, {640, 360}}) {
        const State s = after(fmt::format("size {} {}", width, height));
        ASSERT_EQ(s.requests.size(), 1u);
        EXPECT_EQ(std::get<request::Resize>(s.requests[0]).size, glm::ivec2(width, height));
        const State p = after(fmt::format("picture a.png {} {}", width, height));
        ASSERT_EQ(p.requests.size(), 1u);
        EXPECT_EQ(std::get<request::WriteImage>(p.requests[0]).size, glm::ivec2(width, height));
        EXPECT_EQ(std::get<request::WriteImage>(p.requests[0]).file, "a.png");
    }
    for (const char* wrong : {"0 1", "1 0", "16385 1", "1 16385", "-5 7", "7", "x 7", "7 x"})
        EXPECT_TRUE(refused(fmt::format("size {}", wrong))) << wrong;
    for (const char* wrong : {"0 1", "1 0", "16385 1", "1 16385", "-5 7"})
        EXPECT_TRUE(refused(fmt::format("picture a.png {}", wrong))) << wrong;
    State s = start();
    s.size = {300, 200};
    for (const char* file : {"my file.png", "a.png", "7.png", "a 7.png", "a b 7", "16 9 x.png"}) {
        const State written = after(std::string("picture ") + file, s);
        ASSERT_EQ(written.requests.size(), 1u) << file;
        EXPECT_EQ(std::get<request::WriteImage>(written.requests[0]).file, file);
        EXPECT_EQ(std::get<request::WriteImage>(written.requests[0]).size, glm::ivec2(300, 200));
    }
    const State both = after("picture my file.png 64 32", s);
    ASSERT_EQ(both.requests.size(), 1u);
    EXPECT_EQ(std::get<request::WriteImage>(both.requests[0]).file, "my file.png");
    EXPECT_EQ(std::get<request::WriteImage>(both.requests[0]).size, glm::ivec2(64, 32));
}

TEST(ViewerCommands, numbersAreClampedToTheirRange)
{
    for (const auto& [given, held] : {std::pair{-0.5f, 0.0f}, {0.0f, 0.0f}, {0.3f, 0.3f}, {1.0f, 1.0f}, {1.5f, 1.0f}})
        EXPECT_EQ(after(fmt::format("divider {}", given)).divider, held) << given;
    for (const auto& [given, held] :
         {std::pair{-1.0f, 0.0f}, {0.0f, 0.0f}, {0.25f, 0.5f}, {0.5f, 0.5f}, {3.5f, 3.5f}, {4.0f, 4.0f}, {9.0f, 4.0f}})
        EXPECT_EQ(after(fmt::format("scale {}", given)).scale, held) << given;
}

TEST(ViewerCommands, eachSwitchTogglesItsOwnField)
{
    const std::map<std::string, bool State::*> switches = {{"interface", &State::interfaceShown},
                                                           {"help", &State::cheatSheet},
                                                           {"settings", &State::settingsShown},
                                                           {"hot-spots", &State::problemAreasShown},
                                                           {"card", &State::cardShown},
                                                           {"statistics", &State::statisticsShown},
                                                           {"look", &State::dark},
                                                           {"loop", &State::loops},
                                                           {"pin-light", &State::lightPinned}};
    const State before = start();
    for (const auto& [name, field] : switches) {
        const State once = after("toggle " + name, before), twice = after("toggle " + name, once);
        for (const auto& [other, otherField] : switches) {
            EXPECT_EQ(once.*otherField != before.*otherField, other == name) << name << " and " << other;
            EXPECT_EQ(twice.*otherField, before.*otherField) << name << " and " << other;
        }
    }
    const State listed = after("toggle hot-spots", before);
    ASSERT_EQ(listed.requests.size(), 1u); // the areas are not known yet
    EXPECT_TRUE(std::holds_alternative<request::FindProblemAreas>(listed.requests[0]));
    State found = before;
    found.problemAreas.emplace();
    EXPECT_TRUE(after("toggle hot-spots", found).requests.empty());
    found.problemAreasShown = true;
    found.problemArea = 0;
    EXPECT_FALSE(after("toggle hot-spots", found).problemArea);
}

// Changed light makes the metered exposure stale. A setting of the file or the pose requires a new load or a new pose.
TEST(ViewerCommands, eachSettingRequestsItsLoadPoseOrMetering)
{
    const std::map<std::string, std::string> values = {{"exposure", "2"},
                                                       {"environment", "evening"},
                                                       {"variant", "red"},
                                                       {"animation", "turn"},
                                                       {"time", "1"},
                                                       {"height-map", "h m.png"},
                                                       {"height-depth", "0.1"},
                                                       {"mask", "m.png"},
                                                       {"environment-rotation", "20"},
                                                       {"environment-intensity", "2"},
                                                       {"shadow-softness", "5"}};
    State before = start();
    before.metered = 2;
    std::size_t metered = 0, loaded = 0, posed = 0;
    for (const Setting& setting : settings()) {
        const std::string name = setting.option.name;
        std::string value = setting.option.flag ? "on" : "";
        if (const auto chosen = values.find(name); chosen != values.end())
            value = chosen->second;
        for (const std::string& word : setting.option.closed ? setting.option.words : std::vector<std::string>())
            if (word != valueOf(setting, before.picture))
                value = word;
        const State s = after("set " + name + " " + value, before);
        EXPECT_NE(valueOf(setting, s.picture), valueOf(setting, before.picture)) << name;
        const bool light = name == "exposure" || name == "tone-mapping" || name == "environment";
        EXPECT_EQ(s.metered, light ? 0.0f : 2.0f) << name;
        metered += light;
        for (const Request& request : s.requests) {
            loaded += std::holds_alternative<request::Load>(request) && (name == "variant" || name == "shape");
            posed += std::holds_alternative<request::Pose>(request) && (name == "animation" || name == "time");
        }
        EXPECT_EQ(s.requests.size(), name == "variant" || name == "shape" || name == "animation" || name == "time")
            << name;
    }
    EXPECT_EQ(metered, 3u);
    EXPECT_EQ(loaded, 2u);
    EXPECT_EQ(posed, 2u);
}

TEST(ViewerCommands, sidesAreSetSeparatelyAndSwapped)
{
    const char* const lines[] = {"frame smooth", "tangents generated", "normal-map a b.png", "convention directx"};
    for (const char* line : lines) {
        const State first = after(line), second = after(std::string("second ") + line);
        EXPECT_EQ(first.b, Side()) << line;
        EXPECT_EQ(second.a, Side()) << line;
        EXPECT_FALSE(first.a == Side()) << line;
        EXPECT_EQ(first.a, second.b) << line;
        const State swapped = after("swap", first);
        EXPECT_EQ(swapped.b, first.a);
        EXPECT_EQ(swapped.a, Side());
    }
    State all = start();
    for (const char* line : lines)
        all = after(line, all);
    EXPECT_EQ(all.a.frame, "smooth");
    EXPECT_EQ(all.a.tangents, TangentOrigin::generated);
    EXPECT_EQ(all.a.normalMap, "a b.png");
    EXPECT_EQ(all.a.convention, "directx");
    EXPECT_EQ(after("convention ", all).a.convention, "");
    EXPECT_EQ(after("convention gltf,srgb", all).a.convention, "gltf,srgb"); // as --convention
    for (const char* wrong : {"frame x", "tangents x", "convention x", "second x", "second frame x"})
        EXPECT_TRUE(refused(wrong)) << wrong;
}

TEST(ViewerCommands, comparisonsBeginWithTheFirstSideAndFlipSwitches)
{
    for (const auto& [word, mode] : {std::pair("off", Compare::off),
                                     {"divider", Compare::divider},
                                     {"flip", Compare::flip},
                                     {"angle", Compare::angle}}) {
        State s = start();
        s.second = true;
        s = after(std::string("compare ") + word, s);
        EXPECT_TRUE(s.compare == mode) << word;
        EXPECT_FALSE(s.second) << word;
    }
    State s = start();
    s.second = true; // from an earlier comparison
    s = after("flip", s);
    EXPECT_TRUE(s.compare == Compare::flip);
    EXPECT_TRUE(s.second);
    EXPECT_FALSE(after("flip", s).second);
}

TEST(ViewerCommands, commandsIssueTheirRequest)
{
    State s = start();
    s.picture.model = "here.glb";
    const auto issued = [&](const char* line) {
        const State done = after(line, s);
        EXPECT_EQ(done.requests.size(), 1u) << line;
        return done.requests.at(0);
    };
    EXPECT_EQ(std::get<request::Load>(issued("open a b.glb")).model, "a b.glb");
    EXPECT_EQ(std::get<request::Load>(issued("drop c.obj")).model, "c.obj");
    EXPECT_EQ(std::get<request::Load>(issued("reload")).model, "here.glb");
    EXPECT_TRUE(std::holds_alternative<request::Paste>(issued("paste")));
    EXPECT_TRUE(std::holds_alternative<request::ChooseFile>(issued("choose")));
    EXPECT_TRUE(std::holds_alternative<request::FindProblemAreas>(issued("find-hot-spots")));
    EXPECT_TRUE(std::holds_alternative<request::LoseSurface>(issued("lose-surface")));
    EXPECT_TRUE(std::holds_alternative<request::Quit>(issued("quit")));
    EXPECT_EQ(std::get<request::WriteWindow>(issued("window w.png")).file, "w.png");
    EXPECT_EQ(std::get<request::WriteReport>(issued("report r.txt")).file, "r.txt");
    for (const char* wrong : {"open", "drop", "window", "report"})
        EXPECT_TRUE(refused(wrong, s)) << wrong;
    const std::string command = std::get<request::Copy>(issued("copy command")).text;
    EXPECT_EQ(command.rfind("cotan render here.glb", 0), 0u) << command;
    const State there = after("camera " + std::get<request::Copy>(issued("copy camera")).text, after("orbit 40 10", s));
    EXPECT_EQ(there.camera.eye, s.camera.eye);
    EXPECT_EQ(there.camera.target, s.camera.target);
}

TEST(ViewerCommands, droppedImagesAreMapsOrEnvironments)
{
    State s = start();
    s.picture.model = "here.glb";
    s.metered = 2;
    State map = after("open m.png", s);
    EXPECT_EQ(map.a.normalMap, "m.png");
    EXPECT_EQ(map.picture.shape, "");
    EXPECT_TRUE(map.requests.empty());
    EXPECT_EQ(map.metered, 2);
    State light = after("open sky.hdr", s);
    EXPECT_EQ(light.picture.environment, "sky.hdr");
    EXPECT_EQ(light.a.normalMap, "");
    EXPECT_EQ(light.metered, 0); // the new light requires new metering
    map = after("open m.png", start());
    EXPECT_EQ(map.picture.shape, "plane"); // a map without a model is put on a plane
    ASSERT_EQ(map.requests.size(), 1u);
    EXPECT_EQ(std::get<request::Load>(map.requests[0]).model, "");
    State shaped = start();
    shaped.picture.shape = "torus";
    map = after("open m.png", shaped);
    EXPECT_EQ(map.picture.shape, "torus");
    EXPECT_TRUE(map.requests.empty());
}

TEST(ViewerCommands, removingTheEnvironmentResetsItsOptions)
{
    State s = start();
    s = after("set environment-rotation 30", s);
    s = after("set environment-intensity 2", s);
    EXPECT_EQ(s.picture.environmentRotation, 30);
    EXPECT_EQ(s.picture.environmentIntensity, 2);
    for (const char* background : {"environment", "blur", "paper"}) {
        State bare = after(fmt::format("set background {}", background), s);
        bare = after("set environment none", bare);
        EXPECT_EQ(bare.picture.environmentRotation, 0);
        EXPECT_EQ(bare.picture.environmentIntensity, 1);
        EXPECT_EQ(bare.picture.background,
                  std::string(background) == "paper" ? std::optional(Background::paper) : std::nullopt);
    }
}

TEST(ViewerSettings, haveTheBoundsOfTheCommandLine)
{
    for (const auto& [name, maximum] : {std::pair("environment-rotation", 360.0),
                                        {"shadow-softness", 60},
                                        {"time", 1e6},
                                        {"exposure", 1e6},
                                        {"environment-intensity", 1e6}}) {
        PictureOptions o;
        EXPECT_TRUE(setValue(*findSetting(name), fmt::format("{}", maximum), o)) << name;
        for (const std::string& wrong :
             {fmt::format("{}", maximum * 1.000001), std::string("-400"), std::string("nan")})
            EXPECT_FALSE(setValue(*findSetting(name), wrong, o)) << name << " " << wrong;
    }
    for (const char* name : {"exposure", "environment-intensity"}) { // above 0
        PictureOptions o;
        EXPECT_FALSE(setValue(*findSetting(name), "0", o)) << name;
    }
}

// The chosen entry of a choice is ticked, and was not before. A switch changes its tick each time.
TEST(ViewerMenus, onlyTheChosenEntryOfASubmenuIsTicked)
{
    const State beginning = start();
    std::size_t tried = 0;
    for (const Entry& entry : entriesOf(beginning)) {
        const bool choice = entry.menu == "Frame" || entry.menu == "Compare with" || entry.submenu == "Show"
            || entry.submenu == "Environment" || entry.submenu == "Background"
            || entry.submenu == "Tone mapping and shading" || entry.submenu == "Preview shape"
            || entry.submenu == "Appearance";
        if (!choice || entry.command.empty() || !entry.usable || entry.label == "Dark")
            continue;
        State chosen = beginning;
        ASSERT_TRUE(perform(chosen, entry.command)) << entry.command;
        bool found = false;
        for (const Entry& now : entriesOf(chosen))
            if (now.menu == entry.menu && now.label == entry.label) {
                EXPECT_TRUE(now.on) << entry.menu << ": " << entry.label;
                found = true;
            }
        EXPECT_TRUE(found) << entry.label;
        ++tried;
    }
    EXPECT_GT(tried, 50u);
    const auto ticked = [](const State& s, const std::string& label) {
        for (const Entry& entry : entriesOf(s))
            if (entry.label == label)
                return entry.on;
        ADD_FAILURE() << label;
        return false;
    };
    for (const char* label : {"Orthographic",
                              "Side by side",
                              "Angle between them",
                              "Flip between both",
                              "Statistics",
                              "Inspect under pointer",
                              "Problem areas",
                              "Normal maps",
                              "Nearest texels",
                              "Triangle edges",
                              "UV seams",
                              "Menus and panels",
                              "Settings",
                              "Keys",
                              "Dark",
                              "Pinned to the camera",
                              "Shadows",
                              "Ground",
                              "4 samples per pixel",
                              "Specular antialiasing"}) {
        State s = beginning;
        const bool before = ticked(s, label);
        for (const bool expected : {!before, before}) {
            std::string command;
            for (const Entry& entry : entriesOf(s))
                if (entry.label == label)
                    command = entry.command;
            ASSERT_TRUE(perform(s, command)) << command;
            EXPECT_EQ(ticked(s, label), expected) << label << ", " << command;
        }
    }
}

TEST(ViewerMenus, entriesAreDisabledWithoutWhatTheyNeed)
{
    const auto usable = [](const State& s, const std::string& label) {
        for (const Entry& entry : entriesOf(s))
            if (entry.label == label)
                return entry.usable;
        ADD_FAILURE() << label;
        return false;
    };
    State s = start(), file = s, moving = s;
    file.picture.model = "a.glb";
    auto model = std::make_shared<Model>(*s.model);
    model->animations = {{"walk", 2.5}};
    moving.model = std::move(model);
    moving.picture.animation = "0";
    for (const char* label : {"Reload", "Next in folder", "Previous in folder"}) {
        EXPECT_FALSE(usable(s, label)) << label;
        EXPECT_TRUE(usable(file, label)) << label;
    }
    EXPECT_TRUE(usable(s, "Map on a torus"));
    EXPECT_FALSE(usable(file, "Map on a torus"));
    for (const char* label : {"Play", "Loop", "Start", "End"}) {
        EXPECT_FALSE(usable(s, label)) << label;
        EXPECT_TRUE(usable(moving, label)) << label;
    }
    for (const Entry& entry : entriesOf(moving))
        if (entry.label == "End") {
            EXPECT_EQ(entry.command, "set time 2.5");
        }
}

TEST(ViewerMemory, keepsEachSwitchAndSizesFrom160x120To8192)
{
    const std::vector<bool State::*> kept = {&State::dark, &State::settingsShown, &State::cardShown,
                                             &State::statisticsShown};
    for (const auto field : kept) {
        State s;
        s.*field = !(s.*field);
        State back;
        remember(memoryOf(s), back);
        for (const auto other : kept)
            EXPECT_EQ(back.*other, s.*other);
    }
    for (const auto& [size, taken] : {std::pair(glm::ivec2(160, 120), true),
                                      {glm::ivec2(159, 120), false},
                                      {glm::ivec2(160, 119), false},
                                      {glm::ivec2(8192, 8192), true},
                                      {glm::ivec2(8193, 600), false},
                                      {glm::ivec2(600, 8193), false}}) {
        State s;
        remember(fmt::format("size {} {}\n", size.x, size.y), s);
        EXPECT_EQ(s.size == size, taken) << size.x << " " << size.y;
    }
    State s;
    for (int i = 0; i < 12; ++i)
        s.recent.push_back(fmt::format("/{}.glb", i));
    s.recent[3] = "/line\nbreak.glb";
    State back;
    remember(memoryOf(s), back);
    ASSERT_EQ(back.recent.size(), kMaxRecent);
    EXPECT_EQ(back.recent[3], "/4.glb"); // names that do not fit in a line are left out
}

} // namespace
} // namespace cotan::viewer
