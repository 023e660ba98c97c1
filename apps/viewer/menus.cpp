// Menus and keys: one list of entries for both and for the cheat sheet.
#include <algorithm>
#include <array>
#include <map>

#include <fmt/format.h>

#include "commands.hpp"
#include "core/named_values.hpp"
#include "cotan/view.hpp"
#include "files.hpp"
#include "parse.hpp"
#include "picture/option_words.hpp"
#include "settings.hpp"
#include "tasks.hpp"

namespace cotan::viewer {

namespace {

class Entries {
public:
    explicit Entries(const State& state) : state_(state) {}

    void menu(const char* title)
    {
        menu_ = title;
        submenu_.clear();
    }
    // Puts the entries added next into a submenu; an empty title ends it.
    void submenu(const char* title) { submenu_ = title; }
    void add(std::string label, std::string key, std::string command, bool on = false, bool usable = true)
    {
        all.push_back({menu_, std::move(label), std::move(key), std::move(command), on, usable, submenu_});
    }
    void line() { all.push_back({menu_, {}, {}, {}, false, true, submenu_}); }

    // Adds an entry for each value of an option.
    void choose(const char* name, std::initializer_list<std::pair<const char*, const char*>> values)
    {
        const Setting& setting = *findSetting(name);
        const std::string now = valueOf(setting, state_.picture);
        for (const auto& [label, value] : values)
            add(label, {}, fmt::format("set {} {}", name, value), now == value);
    }
    void flag(const char* label, const char* key, const char* name, bool inverted = false)
    {
        const bool on = valueOf(*findSetting(name), state_.picture) == "on";
        add(label, key, fmt::format("set {} toggle", name), on != inverted);
    }

    std::vector<Entry> all;

private:
    const State& state_;
    std::string menu_, submenu_;
};

std::string capital(std::string word)
{
    word[0] = upperLetter(word[0]);
    return word;
}

// Adds a list of variable length as submenus of at most kMaxLines entries: "Cameras", "Cameras 2" and so on.
template<class Add> void addList(Entries& e, const std::string& title, std::size_t count, const Add& add)
{
    for (std::size_t i = 0; i < count; ++i) {
        if (i % kMaxLines == 0)
            e.submenu((i == 0 ? title : fmt::format("{} {}", title, i / kMaxLines + 1)).c_str());
        add(i);
    }
    e.submenu("");
}

void addFileEntries(Entries& e, const State& s)
{
    e.menu("File");
    e.add("Open...", "ctrl+o", "choose");
    e.add("Open high model...", "ctrl+shift+o", "choose high");
    e.add("Open copied path", "ctrl+v", "paste");
    e.add("Reload", "f5", "reload", false, !s.picture.model.empty());
    e.add("Next in folder", "pagedown", "next", false, !s.picture.model.empty());
    e.add("Previous in folder", "pageup", "previous", false, !s.picture.model.empty());
    e.submenu("Preview shape");
    for (const std::string& shape : wordsOf(kShapes))
        e.add(fmt::format("Map on a {}", shape), "", fmt::format("set shape {}", shape), s.picture.shape == shape,
              s.picture.model.empty());
    e.submenu("");
    e.line();
    e.add("Save image", "f12", "picture");
    e.add("Save image, twice as large", "shift+f12",
          fmt::format("picture - {} {}", std::min(2 * s.size.x, 16384), std::min(2 * s.size.y, 16384)));
    e.add("Save image as EXR", "", "picture .exr");
    e.add("Copy as command line", "ctrl+c", "copy command");
    e.add("Copy camera", "ctrl+shift+c", "copy camera");
    addList(e, "Recent files", s.recent.size(),
            [&](std::size_t i) { e.add(s.recent[i], "", "open " + s.recent[i], s.recent[i] == s.picture.model); });
    e.line();
    e.add("Quit", "ctrl+q", "quit");
}

void addTaskEntries(Entries& e, const State& s)
{
    e.menu("Check and fix");
    for (const TaskEntry& task : taskEntries()) {
        e.submenu(task.submenu);
        if (task.name)
            e.add(task.label, "", fmt::format("run {}", task.name), false, s.task.empty() && task.usable(s));
        else
            e.line();
    }
    e.submenu("");
    e.line();
    e.add("Result", "k", "toggle result", s.resultShown, !s.result.lines.empty());
    e.add("Copy result", "", "copy result", false, !s.result.lines.empty());
    e.add("Stop", "", "stop", false, !s.task.empty());
}

void addCameraEntries(Entries& e, const State& s)
{
    e.menu("Camera");
    e.add("Reset camera", "r", "reset");
    for (const auto& [key, side] : {std::pair("kp1", "front"),
                                    {"kp3", "right"},
                                    {"kp7", "top"},
                                    {"ctrl+kp1", "back"},
                                    {"ctrl+kp3", "left"},
                                    {"ctrl+kp7", "bottom"}})
        e.add(fmt::format("{} view", capital(side)), key, fmt::format("see {}", side));
    e.add("Orthographic", "o", "orthographic", s.camera.orthographic);
    e.add("Turntable", "t", "toggle turntable", s.turning);
    e.line();
    e.add("Zoom in", "=", "zoom 0.8");
    e.add("Zoom out", "-", "zoom 1.25");
    for (const auto& [key, label, command] : {std::tuple("left", "Orbit left", "orbit -5 0"),
                                              {"right", "Orbit right", "orbit 5 0"},
                                              {"up", "Orbit up", "orbit 0 5"},
                                              {"down", "Orbit down", "orbit 0 -5"}})
        e.add(label, key, command);
    const std::size_t cameras = s.model ? s.model->scene.cameras.size() : 0;
    addList(e, "Cameras in file", cameras, [&](std::size_t i) {
        const std::string& name = s.model->scene.cameras[i].name;
        e.add(fmt::format("Camera {}{}", i, name.empty() ? "" : ": " + name), "", fmt::format("camera {}", i));
    });
}

void addFrameEntries(Entries& e, const State& s)
{
    constexpr std::array<const char*, 9> kFirst = {"cotangent",   "mikktspace", "triangle", "smooth",    "exact",
                                                   "orthonormal", "vertex",     "gradient", "paper-full"};
    std::vector<std::string> names(kFirst.begin(), kFirst.end());
    for (const std::string& name : app::splitAtCommas(frameNames())) {
        const std::string word = name.substr(std::min(name.find_first_not_of(' '), name.size()));
        if (std::ranges::find(names, word) == names.end())
            names.push_back(word);
    }
    for (const bool second : {false, true}) {
        e.menu(second ? "Compare with" : "Frame");
        const Side side = sideOf(s, second);
        const std::string before = second ? "second " : "";
        for (std::size_t i = 0; i < names.size(); ++i) {
            if (i == kFirst.size())
                e.submenu("More frames");
            const std::string key = i < 9 ? fmt::format("{}{}", second ? "shift+" : "", i + 1) : "";
            e.add(names[i], key, before + "frame " + names[i], side.frame == names[i]);
        }
        e.submenu("");
        e.add("auto: as the maps say", "", before + "frame auto", side.frame == kAutoFrame && !side.high);
        if (second && s.highModel) {
            e.add(highName(s), "", side.high ? "second high off" : "second high on", side.high);
            e.add("Close high model", "", "high ");
        }
        e.submenu("Tangents");
        e.add("Tangents from file", "", before + "tangents stored", side.tangents == TangentOrigin::stored);
        e.add("Generated tangents", "", before + "tangents generated", side.tangents == TangentOrigin::generated);
        e.submenu("Normal maps");
        e.add("Convention from file", "", before + "convention ", side.convention.empty());
        for (const auto& [label, words] : {std::pair("Green up (glTF, OpenGL)", "opengl"),
                                           {"Green down (DirectX)", "directx"},
                                           {"Decoded as 2c - 1", "opengl,biased"},
                                           {"Two channels, orthographic", "opengl,orthographic"}})
            e.add(label, "", before + "convention " + words, side.convention == words);
        e.add("Normal map from file", "", before + "normal-map ", side.normalMap.empty());
        if (!side.normalMap.empty())
            e.add("Map: " + fileName(side.normalMap), "", before + "normal-map " + side.normalMap, true);
    }
    e.menu("Comparison");
    e.add("Off", "", "compare off", s.compare == Compare::off);
    e.add("Side by side", "d", s.compare == Compare::divider ? "compare off" : "compare divider",
          s.compare == Compare::divider);
    e.add("Flip between both", "f", "flip", s.compare == Compare::flip && s.second);
    e.add("Angle between them", "g", s.compare == Compare::angle ? "compare off" : "compare angle",
          s.compare == Compare::angle);
    e.add("Swap first and second", "x", "swap");
    e.line();
    e.add("Statistics", "", "toggle statistics", s.statisticsShown);
    e.add("Inspect under pointer", "i", "toggle card", s.cardShown);
    e.add("Problem areas", "l", "toggle hot-spots", s.problemAreasShown);
}

void addShowEntries(Entries& e, const State& s)
{
    e.menu("View");
    const std::vector<std::string>& names = showNames();
    const bool masked = !s.picture.maps.mask.empty();
    addList(e, "Show", names.size(), [&](std::size_t i) {
        e.add(names[i], i < 9 ? fmt::format("alt+{}", i + 1) : "", "show " + names[i], s.show == names[i],
              names[i] != "mask" || masked);
    });
    auto next = std::size_t(std::ranges::find(names, s.show) - names.begin() + 1) % names.size();
    next += names[next] == "mask" && !masked ? 1 : 0; // it is not the last one
    e.add("Next view", "v", "show " + names[next]);
    e.add("Open mask of a bake...", "", "choose set mask");
    e.line();
    e.flag("Normal maps", "n", "no-normal-maps", true);
    if (const std::string& heights = s.picture.maps.height; !heights.empty())
        e.add("Heights: " + fileName(heights), "", "set height-map ", true);
    e.flag("Nearest texels", "", "point-sampled");
    e.line();
    const bool all = s.picture.edges == Edges::all;
    const bool triangles = all || s.picture.edges == Edges::triangles, seams = all || s.picture.edges == Edges::seams;
    const auto shown = [](bool t, bool m) { return t && m ? "all" : t ? "triangles" : m ? "seams" : "none"; };
    e.add("Triangle edges", "w", std::string("set edges ") + shown(!triangles, seams), triangles);
    e.add("UV seams", "m", std::string("set edges ") + shown(triangles, !seams), seams);
    e.line();
    e.add("Menus and panels", "tab", "toggle interface", s.interfaceShown);
    e.add("Settings", "s", "toggle settings", s.settingsShown);
    e.add("Keys", "h", "toggle help", s.cheatSheet);
    e.submenu("Appearance");
    e.add("Dark", "", "toggle look", s.dark);
    for (const auto& [label, value] :
         {std::pair("Automatic text size", 0.0f), {"Text 100 %", 1.0f}, {"Text 150 %", 1.5f}, {"Text 200 %", 2.0f}})
        e.add(label, "", fmt::format("scale {}", value), s.scale == value);
}

void addLightEntries(Entries& e, const State& s)
{
    e.menu("Light");
    e.submenu("Environment");
    for (const std::string& name : environmentNames())
        e.add(name, "", "set environment " + name, s.picture.environment == name);
    e.add("No environment", "", "set environment none", s.picture.environment == "none");
    const bool file = std::filesystem::path(s.picture.environment).has_extension();
    if (file)
        e.add(fileName(s.picture.environment), "", "set environment " + s.picture.environment, true);
    e.submenu("");
    e.add("Rotate left", "[", "turn-light -15");
    e.add("Rotate right", "]", "turn-light 15");
    e.add("Pinned to the camera", "p", "toggle pin-light", s.lightPinned);
    e.line();
    e.flag("Shadows", "", "no-shadows", true);
    e.add("Ground", "", s.picture.ground ? "set ground off" : "set ground on", s.picture.ground);
    e.submenu("Background");
    e.choose("background",
             {{"Default background", ""},
              {"Paper", "paper"},
              {"Environment, blurred", "blur"},
              {"Environment", "environment"},
              {"Gradient", "gradient"},
              {"No background", "none"}});
    e.submenu("");
    e.line();
    e.add("Automatic exposure", "e", "set exposure auto", !s.picture.exposure);
    const float now = s.picture.exposure.value_or(s.metered);
    e.add("Brighter", ".", fmt::format("set exposure {:.4g}", std::min((now > 0 ? now : 1) * 1.189207f, 1e6f)));
    e.add("Darker", ",", fmt::format("set exposure {:.4g}", std::max((now > 0 ? now : 1) / 1.189207f, 1e-6f)));
    e.submenu("Tone mapping and shading");
    e.choose("tone-mapping", {{"Neutral", "neutral"}, {"ACES", "aces"}, {"AgX", "agx"}, {"Clamp to 1", "none"}});
    e.choose("shading", {{"Physically based", "pbr"}, {"Blinn-Phong", "blinn-phong"}});
    e.submenu("Samples");
    const bool four = s.picture.samples == 4;
    e.add("4 samples per pixel", "a", four ? "set samples 1" : "set samples 4", four);
    const bool sixteen = s.picture.samples == 16;
    e.add("16 samples per pixel", "", sixteen ? "set samples 4" : "set samples 16", sixteen);
    e.flag("Specular antialiasing", "", "specular-antialiasing");
}

void addAnimationEntries(Entries& e, const State& s)
{
    e.menu("Animation");
    const std::size_t count = s.model ? s.model->animations.size() : 0;
    const GltfAnimation* const now = animationOf(s);
    e.add("Pose from file", "", "set animation ", s.picture.animation.empty());
    addList(e, "Animations in file", count, [&](std::size_t i) {
        const GltfAnimation& a = s.model->animations[i];
        e.add(fmt::format("{}: {}, {:.3g} s", i, a.name.empty() ? "unnamed" : a.name, a.seconds), "",
              fmt::format("set animation {}", i), &a == now);
    });
    e.line();
    e.add("Play", "space", "play", s.playing, count > 0);
    e.add("Loop", "", "toggle loop", s.loops, count > 0);
    e.add("Start", "home", "set time 0", false, now != nullptr);
    e.add("End", "end", fmt::format("set time {}", now ? now->seconds : 0), false, now != nullptr);
}

} // namespace

std::string highName(const State& state)
{
    const std::size_t count = state.high.size();
    return count == 0 ? "" : "high: " + fileName(state.high[0]) + (count > 1 ? fmt::format(" + {}", count - 1) : "");
}

std::vector<Entry> entriesOf(const State& state)
{
    Entries entries(state);
    addFileEntries(entries, state);
    addTaskEntries(entries, state);
    addCameraEntries(entries, state);
    addFrameEntries(entries, state);
    addShowEntries(entries, state);
    addLightEntries(entries, state);
    addAnimationEntries(entries, state);
    return std::move(entries.all);
}

std::string keyLabel(const std::string& key)
{
    const std::size_t plus = key.rfind('+');
    if (plus != std::string::npos && plus > 0 && plus + 1 < key.size())
        return keyLabel(key.substr(0, plus)) + "+" + keyLabel(key.substr(plus + 1));
    static const std::map<std::string, std::string> kNames = {
        {"pageup", "Page Up"}, {"pagedown", "Page Down"}, {"escape", "Esc"}};
    if (const auto known = kNames.find(key); known != kNames.end())
        return known->second;
    if (key.starts_with("kp"))
        return "Num " + key.substr(2);
    return key.empty() ? key : capital(key);
}

std::string commandOfKey(const State& state, const std::string& key)
{
    if (key == "escape" && state.cheatSheet)
        return "toggle help";
    for (const Entry& entry : entriesOf(state))
        if (!entry.key.empty() && entry.key == key && entry.usable)
            return entry.command;
    return {};
}

} // namespace cotan::viewer
