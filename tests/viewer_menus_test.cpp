// Menus, keys, the cheat sheet and animations of the viewer, without a window.
#include <gtest/gtest.h>

#include <map>

#include <fmt/format.h>

#include "player.hpp"
#include "session.hpp"
#include "viewer_state.hpp"

namespace cotan::viewer {
namespace {

// Everything that a switch can change.
std::string keyLike(const State& s) { return reportOf(s) + fmt::format("{} {}", s.settingsShown, s.cardShown); }

// ---- menus and keys ----------------------------------------------------------------------------

TEST(ViewerMenus, everyEntryWorksAndKeysAreUnique)
{
    std::map<std::string, std::string> keys;
    for (const Entry& entry : entriesOf(withModel())) {
        if (entry.command.empty())
            continue;
        EXPECT_FALSE(entry.label.empty());
        if (!entry.key.empty()) {
            EXPECT_TRUE(keys.emplace(entry.key, entry.label).second)
                << entry.key << ": " << keys[entry.key] << " and " << entry.label;
        }
        State state = withModel();
        state.picture.animation = "0";
        if (entry.usable) {
            const Status done = perform(state, entry.command);
            EXPECT_TRUE(done) << entry.command << ": " << done.error().message;
        }
    }
    for (const char* key : {"1", "9", "h", "f12", "tab", "ctrl+c", "f5", "r", "o", "d", "f", "g"})
        EXPECT_TRUE(keys.contains(key)) << key;
    for (std::size_t i = 0; i < 9; ++i) // alt+1 to alt+9 in the order of the views
        EXPECT_EQ(keys[fmt::format("alt+{}", i + 1)], showNames()[i]);
    EXPECT_FALSE(keys.contains("alt+0"));
}

// At a scale of 2 a line takes 40 of 720 pixels. The menu bar takes one line.
TEST(ViewerMenus, everyMenuAndSubmenuFitsASmallWindowWithLargeText)
{
    State state = withModel();
    for (int i = 0; i < 12; ++i)
        state.recent.push_back(fmt::format("/models/{}.glb", i));
    std::map<std::string, std::size_t> lines;
    std::string last;
    for (const Entry& entry : entriesOf(state)) {
        const std::string menuPath = entry.menu + "/" + entry.submenu;
        if (menuPath != last && !entry.submenu.empty())
            ++lines[entry.menu + "/"]; // its title
        last = menuPath;
        ++lines[menuPath];
    }
    EXPECT_GT(lines.size(), 12u);
    for (const auto& [menuPath, count] : lines)
        EXPECT_LE(count, kMaxLines) << menuPath;
}

TEST(ViewerMenus, theKeySheetListsEveryKeyAndItsState)
{
    State state = withModel();
    const auto lineOf = [&](const char* key) {
        for (const auto& [name, what] : interfaceOf(state).sheet)
            if (name == key)
                return what;
        return std::string();
    };
    const std::string before = lineOf("D");
    EXPECT_EQ(before.find("on"), std::string::npos);
    send(state, "0 key d\n");
    EXPECT_NE(lineOf("D").find("on"), std::string::npos);
    for (const Entry& entry : entriesOf(state)) {
        const bool digit = !entry.key.empty() && entry.key.back() >= '1' && entry.key.back() <= '9'
            && entry.key.find("kp") == std::string::npos && entry.key[0] != 'f'
            && entry.key.find("+f") == std::string::npos;
        if (!entry.key.empty() && !digit) {
            EXPECT_FALSE(lineOf(keyLabel(entry.key).c_str()).empty()) << entry.key;
        }
    }
    send(state, "0 key 4\n0 key shift+5\n");
    EXPECT_EQ(lineOf("1 ... 9"), "Frame: smooth");
    EXPECT_EQ(lineOf("Shift+1 ... 9"), "Compare with: exact");
}

TEST(ViewerMenus, theKeySheetHasATitlePerMenuAndOneForTheMouse)
{
    std::vector<std::string> titles;
    const auto sheet = interfaceOf(withModel()).sheet;
    for (const auto& [key, what] : sheet)
        if (key.empty())
            titles.push_back(what);
    EXPECT_EQ(titles,
              (std::vector<std::string>{"File", "Check and fix", "Camera", "Frame", "Compare with", "Comparison",
                                        "View", "Light", "Animation", "Mouse"}));
    EXPECT_TRUE(sheet.front().first.empty());
    EXPECT_FALSE(sheet.back().first.empty());
}

TEST(ViewerMenus, keysAreNamedAsOnAKeyboard)
{
    for (const auto& [key, label] : {std::pair("ctrl+o", "Ctrl+O"),
                                     {"kp1", "Num 1"},
                                     {"ctrl+kp7", "Ctrl+Num 7"},
                                     {"shift+f12", "Shift+F12"},
                                     {"pagedown", "Page Down"},
                                     {"ctrl+shift+c", "Ctrl+Shift+C"},
                                     {"space", "Space"},
                                     {"=", "="},
                                     {"-", "-"},
                                     {"", ""}})
        EXPECT_EQ(keyLabel(key), label);
    bool found = false;
    for (const Menu& menu : interfaceOf(withModel()).menus)
        for (const MenuItem& item : menu.items)
            if (item.command == "choose") {
                EXPECT_EQ(item.key, "Ctrl+O");
                found = true;
            }
    EXPECT_TRUE(found);
}

TEST(ViewerMenus, theFirstStartShowsTheHelpKey)
{
    State first = withModel(), later = first;
    remember("", first);
    EXPECT_TRUE(interfaceOf(first).status.starts_with("H: keys\n"));
    send(first, "0 key d\n");
    EXPECT_EQ(interfaceOf(first).status.find("H: keys"), std::string::npos);
    remember(memoryOf(later), later);
    EXPECT_EQ(interfaceOf(later).status.find("H: keys"), std::string::npos);
}

TEST(ViewerMenus, choosingASwitchTwiceRestoresTheState)
{
    State state = withModel();
    for (const char* key : {"d", "g", "o", "n", "tab", "h", "s", "i", "p", "a"}) {
        State other = state;
        send(other, std::string("0 key ") + key + "\n");
        EXPECT_NE(keyLike(other), keyLike(state)) << key;
        send(other, std::string("0 key ") + key + "\n");
        other.cameraMoved = false; // the other projection and back is a motion
        EXPECT_EQ(keyLike(other), keyLike(state)) << key;
    }
}

// ---- played events -----------------------------------------------------------------------------

TEST(ViewerPlayer, beginsWithTheFirstImageAndWaitsOnRequest)
{
    const std::vector<Event> events = {{0.5, EventKind::key, 0, 0, "3"},
                                       {1, EventKind::wait, 0, 0, ""},
                                       {2, EventKind::key, 0, 0, "4"},
                                       {2, EventKind::command, 0, 0, "window a.png"}};
    Player player(events);
    double now = 0;
    const auto step = [&](bool idle) {
        const auto done = player.step(idle, now++);
        return done && done->event ? toText(*done->event) : std::string("-");
    };
    EXPECT_EQ(step(false), "-");
    EXPECT_EQ(step(true), "0.500 key 3");
    EXPECT_EQ(step(false), "-"); // starts to wait
    EXPECT_EQ(step(false), "-");
    EXPECT_EQ(step(true), "2.000 key 4");
    EXPECT_EQ(step(false), "-"); // a window is written after it is drawn
    EXPECT_FALSE(player.ended());
    EXPECT_EQ(step(true), "2.000 do window a.png");
    EXPECT_TRUE(player.ended());
    EXPECT_EQ(step(false), "-");
    now += 1000;
    EXPECT_FALSE(player.step(false, now)); // waiting has a limit
}

// ---- animations --------------------------------------------------------------------------------

// The state of a model with two animations, of 2 s and of 4 s.
State withAnimations()
{
    State state = withModel();
    auto model = std::make_shared<Model>(*state.model);
    model->animations = {{"walk", 2}, {"", 4}};
    state.model = std::move(model);
    return state;
}

TEST(ViewerAnimation, playingLoopsOrStopsAtTheEnd)
{
    State state = withAnimations();
    send(state, "0 key space\n"); // starts the first one if none is chosen
    EXPECT_TRUE(state.playing);
    EXPECT_EQ(state.picture.animation, "0");
    advance(state, 1.5);
    EXPECT_DOUBLE_EQ(state.picture.time, 1.5);
    advance(state, 1);
    EXPECT_DOUBLE_EQ(state.picture.time, 0.5);
    send(state, "0 do toggle loop\n");
    advance(state, 7);
    EXPECT_DOUBLE_EQ(state.picture.time, 2);
    EXPECT_FALSE(state.playing);
    send(state, "0 key space\n"); // starts again from the end
    EXPECT_TRUE(state.playing);
    EXPECT_DOUBLE_EQ(state.picture.time, 0);
}

TEST(ViewerAnimation, theSliderIsAsLongAsTheAnimation)
{
    State state = withAnimations();
    const auto slider = [&]() -> double {
        for (const Slider& s : interfaceOf(state).sliders)
            if (s.label == "time")
                return s.high;
        return -1;
    };
    EXPECT_EQ(slider(), -1);
    for (const auto& [name, seconds] : {std::pair("walk", 2.0), {"0", 2}, {"1", 4}, {"2", -1}, {"", -1}}) {
        send(state, std::string("0 do set animation ") + name + "\n");
        EXPECT_EQ(slider(), seconds) << name;
    }
}

TEST(ViewerAnimation, theMenuListsAnimationsAndTicksTheCurrentOne)
{
    State state = withAnimations();
    ASSERT_TRUE(perform(state, "set animation walk"));
    int ticked = 0, listed = 0;
    for (const Entry& entry : entriesOf(state))
        if (entry.command.starts_with("set animation")) {
            ++listed;
            ticked += entry.on;
            EXPECT_EQ(entry.on, entry.label == "0: walk, 2 s") << entry.label;
        }
    EXPECT_EQ(listed, 3); // and the pose of the file
    EXPECT_EQ(ticked, 1);
    EXPECT_FALSE(perform(*std::make_unique<State>(withModel()), "play")); // a model without animations
}

TEST(ViewerAnimation, changingTheTimePosesWithoutReloading)
{
    State state = withAnimations();
    ASSERT_TRUE(perform(state, "set animation 1"));
    ASSERT_TRUE(perform(state, "set time 3"));
    ASSERT_EQ(state.requests.size(), 2u);
    for (const Request& request : state.requests)
        EXPECT_TRUE(std::holds_alternative<request::Pose>(request));
    EXPECT_EQ(state.picture.time, 3);
}

} // namespace
} // namespace cotan::viewer
