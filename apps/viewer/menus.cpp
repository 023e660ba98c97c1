// Menus and keys: one list of entries for both, and for the cheat sheet.
#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "commands.hpp"
#include "cotan/environment/environment.hpp"
#include "cotan/picture/words.hpp"
#include "files.hpp"
#include "parse.hpp"
#include "settings.hpp"

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
    // What is added next stands in a submenu; empty: no longer.
    void submenu(const char* title) { submenu_ = title; }
    void add(std::string label, std::string key, std::string command, bool on = false, bool usable = true)
    {
        all.push_back({menu_, std::move(label), std::move(key), std::move(command), on, usable, {}, submenu_});
    }
    void line() { all.push_back({menu_, {}, {}, {}, false, true, {}, submenu_}); }
    void standing(std::string text) { all.back().standing = std::move(text); }

    // An entry for each value of an option.
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

// Lists of a file's or a person's own, as submenus of no more than fit: "Cameras", "Cameras 2" and so on.
template<class Add> void addList(Entries& e, const std::string& title, std::size_t count, const Add& add)
{
    for (std::size_t i = 0; i < count; ++i) {
        if (i % kMostLines == 0)
            e.submenu((i == 0 ? title : fmt::format("{} {}", title, i / kMostLines + 1)).c_str());
        add(i);
    }
    e.submenu("");
}

void addFileEntries(Entries& e, const State& s)
{
    e.menu("File");
    e.add("Open...", "ctrl+o", "choose");
    e.add("Open the path that was copied", "ctrl+v", "paste");
    e.add("Reload", "f5", "reload", false, !s.picture.model.empty());
    e.add("Next in the folder", "pagedown", "next", false, !s.picture.model.empty());
    e.add("Previous in the folder", "pageup", "previous", false, !s.picture.model.empty());
    e.submenu("Shape of a map");
    for (const char* shape : {"plane", "sphere", "torus", "teapot"})
        e.add(fmt::format("Map on a {}", shape), "", fmt::format("set shape {}", shape), s.picture.shape == shape,
              s.picture.model.empty());
    e.submenu("");
    e.line();
    e.add("Write the picture", "f12", "picture");
    e.add("Write the picture, twice as large", "shift+f12",
          fmt::format("picture - {} {}", std::min(2 * s.size.x, 16384), std::min(2 * s.size.y, 16384)));
    e.add("Write the picture as EXR", "", "picture .exr");
    e.add("Copy the command that draws it", "ctrl+c", "copy command");
    e.add("Copy the camera", "ctrl+shift+c", "copy camera");
    addList(e, "Recent files", s.recent.size(),
            [&](std::size_t i) { e.add(s.recent[i], "", "open " + s.recent[i], s.recent[i] == s.picture.model); });
    e.line();
    e.add("Quit", "ctrl+q", "quit");
}

void addCameraEntries(Entries& e, const State& s)
{
    e.menu("Camera");
    e.add("Reset", "r", "reset");
    for (const auto& [key, side] : {std::pair("kp1", "front"),
                                    {"kp3", "right"},
                                    {"kp7", "top"},
                                    {"ctrl+kp1", "back"},
                                    {"ctrl+kp3", "left"},
                                    {"ctrl+kp7", "bottom"}})
        e.add(fmt::format("From the {}", side), key, fmt::format("see {}", side));
    e.add("Orthographic", "o", "orthographic", s.camera.orthographic);
    e.line();
    e.add("Nearer", "=", "zoom 0.8");
    e.add("Away", "-", "zoom 1.25");
    for (const auto& [key, label, command] : {std::tuple("left", "Turn left", "orbit -5 0"),
                                              {"right", "Turn right", "orbit 5 0"},
                                              {"up", "Turn up", "orbit 0 5"},
                                              {"down", "Turn down", "orbit 0 -5"}})
        e.add(label, key, command);
    const std::size_t cameras = s.model ? s.model->scene.cameras.size() : 0;
    addList(e, "Cameras of the file", cameras, [&](std::size_t i) {
        const std::string& name = s.model->scene.cameras[i].name;
        e.add(fmt::format("{} of the file{}", i, name.empty() ? "" : ": " + name), "", fmt::format("camera {}", i));
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
        e.menu(second ? "Second" : "Frame");
        const Side& side = sideOf(s, second);
        const std::string before = second ? "second " : "";
        for (std::size_t i = 0; i < names.size(); ++i) {
            if (i == kFirst.size())
                e.submenu("More frames");
            const std::string key = i < 9 ? fmt::format("{}{}", second ? "shift+" : "", i + 1) : "";
            e.add(names[i], key, before + "frame " + names[i], side.frame == names[i]);
        }
        e.submenu("");
        e.add("auto: what the maps mean", "", before + "frame auto", side.frame == kAutoFrame);
        e.submenu("Tangents");
        e.add("Tangents of the file", "", before + "tangents stored", side.tangents == "stored");
        e.add("Tangents generated", "", before + "tangents generated", side.tangents == "generated");
        e.submenu("Normal maps");
        e.add("Maps as the file says", "", before + "convention ", side.convention.empty());
        for (const auto& [label, words] : {std::pair("Green up (glTF, OpenGL)", "gltf"),
                                           {"Green down (DirectX)", "directx"},
                                           {"Decoded as 2c - 1", "gltf,biased"},
                                           {"Two channels, orthographic", "gltf,orthographic"}})
            e.add(label, "", before + "convention " + words, side.convention == words);
        e.add("The model's own map", "", before + "normal-map ", side.normalMap.empty());
        if (!side.normalMap.empty())
            e.add("Map: " + fileName(side.normalMap), "", before + "normal-map " + side.normalMap, true);
    }
    e.menu("Compare");
    e.add("One picture", "", "compare off", s.compare == Compare::off);
    e.add("Side by side", "d", s.compare == Compare::divider ? "compare off" : "compare divider",
          s.compare == Compare::divider);
    e.add("Flip between both", "f", "flip", s.compare == Compare::flip && s.second);
    e.add("Angle between them", "g", s.compare == Compare::angle ? "compare off" : "compare angle",
          s.compare == Compare::angle);
    e.add("Swap first and second", "x", "swap");
    e.line();
    e.add("Degrees of what is seen", "", "toggle statistics", s.statisticsShown);
    e.add("What is under the pointer", "i", "toggle card", s.cardShown);
    e.add("Hot spots of lint", "l", "toggle hot-spots", s.hotSpotsShown);
}

void addShowEntries(Entries& e, const State& s)
{
    e.menu("View");
    const std::vector<std::string>& names = showNames();
    addList(e, "Show", names.size(), [&](std::size_t i) {
        e.add(names[i], i < 9 ? fmt::format("alt+{}", i + 1) : "", "show " + names[i], s.show == names[i]);
    });
    const auto here = std::ranges::find(names, s.show) - names.begin();
    e.add("The next of these", "v", "show " + names[std::size_t(here + 1) % names.size()]);
    e.line();
    e.flag("Normal maps", "n", "no-normal-maps", true);
    e.flag("Nearest texels", "", "point-sampled");
    e.line();
    const std::string& edges = s.picture.edges;
    const bool triangles = edges == "triangles" || edges == "all", seams = edges == "seams" || edges == "all";
    const auto shown = [](bool t, bool m) { return t && m ? "all" : t ? "triangles" : m ? "seams" : "none"; };
    e.add("Edges of triangles", "w", std::string("set edges ") + shown(!triangles, seams), triangles);
    e.add("Seams", "m", std::string("set edges ") + shown(triangles, !seams), seams);
    e.line();
    e.add("Menus and panels", "tab", "toggle interface", s.interfaceShown);
    e.add("Settings", "s", "toggle settings", s.settingsShown);
    e.add("Keys", "h", "toggle help", s.cheatSheet);
    e.submenu("Look");
    e.add("Dark", "", "toggle look", s.dark);
    for (const auto& [label, value] : {std::pair("Text as the screen asks for", 0.0f),
                                       {"Text of 100 %", 1.0f},
                                       {"Text of 150 %", 1.5f},
                                       {"Text of 200 %", 2.0f}})
        e.add(label, "", fmt::format("scale {}", value), s.scale == value);
}

void addLightEntries(Entries& e, const State& s)
{
    e.menu("Light");
    e.submenu("Surroundings");
    for (const std::string& name : environmentNames())
        e.add(name, "", "set environment " + name, s.picture.environment == name);
    e.add("No surroundings", "", "set environment none", s.picture.environment == "none");
    const bool file = std::filesystem::path(s.picture.environment).has_extension();
    if (file)
        e.add(fileName(s.picture.environment), "", "set environment " + s.picture.environment, true);
    e.submenu("");
    e.add("Turn left", "[", "turn-light -15");
    e.add("Turn right", "]", "turn-light 15");
    e.add("Pinned to the camera", "p", "toggle pin-light", s.lightPinned);
    e.line();
    e.flag("Shadows", "", "no-shadows", true);
    e.add("Ground", "", s.picture.ground == "on" ? "set ground off" : "set ground on", s.picture.ground == "on");
    e.submenu("Background");
    e.choose("background",
             {{"Background as usual", ""},
              {"Paper", "paper"},
              {"Surroundings, blurred", "blur"},
              {"Surroundings", "environment"},
              {"Gradient", "gradient"},
              {"No background", "none"}});
    e.submenu("");
    e.line();
    e.add("Exposure by the picture", "e", "set exposure auto", s.picture.exposure == "auto");
    const float now = s.picture.exposure == "auto" ? s.metered : std::stof("0" + s.picture.exposure);
    e.add("Brighter", ".", fmt::format("set exposure {:.4g}", std::min((now > 0 ? now : 1) * 1.189207f, 1e6f)));
    e.add("Darker", ",", fmt::format("set exposure {:.4g}", std::max((now > 0 ? now : 1) / 1.189207f, 1e-6f)));
    e.submenu("Tones and shading");
    e.choose("tone-mapping",
             {{"Neutral tones", "neutral"}, {"ACES", "aces"}, {"AgX", "agx"}, {"Cut off at 1", "none"}});
    e.choose("shading", {{"Physically based", "pbr"}, {"Blinn-Phong", "blinn-phong"}});
    e.submenu("Samples");
    const bool four = s.picture.samples == 4;
    e.add("Four samples a pixel", "a", four ? "set samples 1" : "set samples 4", four);
    const bool sixteen = s.picture.samples == 16;
    e.add("Sixteen samples a pixel", "", sixteen ? "set samples 4" : "set samples 16", sixteen);
    e.flag("Highlights antialiased", "", "specular-antialiasing");
}

void addAnimationEntries(Entries& e, const State& s)
{
    e.menu("Animation");
    const std::size_t count = s.model ? s.model->animations.size() : 0;
    const GltfAnimation* const now = animationOf(s);
    e.add("The file's pose", "", "set animation ", s.picture.animation.empty());
    addList(e, "Animations of the file", count, [&](std::size_t i) {
        const GltfAnimation& a = s.model->animations[i];
        e.add(fmt::format("{}: {}, {:.3g} s", i, a.name.empty() ? "without a name" : a.name, a.seconds), "",
              fmt::format("set animation {}", i), &a == now);
    });
    e.line();
    e.add("Play", "space", "play", s.playing, count > 0);
    e.add("Over and over", "", "toggle loop", s.loops, count > 0);
    e.add("Start", "home", "set time 0", false, now != nullptr);
    e.add("End", "end", fmt::format("set time {}", now ? now->seconds : 0), false, now != nullptr);
}

} // namespace

std::vector<Entry> entriesOf(const State& state)
{
    Entries entries(state);
    addFileEntries(entries, state);
    addCameraEntries(entries, state);
    addFrameEntries(entries, state);
    addShowEntries(entries, state);
    addLightEntries(entries, state);
    addAnimationEntries(entries, state);
    return std::move(entries.all);
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
