// Menus, keys and the cheat sheet: one list of entries for all three.
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "camera.hpp"
#include "commands.hpp"
#include "cotan/environment/environment.hpp"
#include "cotan/report/angles.hpp"
#include "cotan/scene/bounds.hpp"
#include "parse.hpp"
#include "settings.hpp"

namespace cotan::viewer {

namespace {

class Entries {
public:
    explicit Entries(const State& state) : state_(state) {}

    void menu(const char* title) { menu_ = title; }
    void add(std::string label, std::string key, std::string command, bool on = false, bool usable = true)
    {
        all.push_back({menu_, std::move(label), std::move(key), std::move(command), on, usable, {}});
    }
    void line() { all.push_back({menu_, {}, {}, {}, false, true, {}}); }
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
    std::string menu_;
};

std::string shortName(const std::string& file) { return std::filesystem::path(file).filename().string(); }

void addFileEntries(Entries& e, const State& s)
{
    e.menu("File");
    e.add("Open...", "ctrl+o", "choose");
    e.add("Open the path that was copied", "ctrl+v", "paste");
    e.add("Reload", "f5", "reload", false, !s.picture.model.empty());
    e.add("Next in the folder", "pagedown", "next", false, !s.picture.model.empty());
    e.add("Previous in the folder", "pageup", "previous", false, !s.picture.model.empty());
    e.line();
    for (const char* shape : {"plane", "sphere", "torus", "teapot"})
        e.add(fmt::format("Map on a {}", shape), "", fmt::format("set shape {}", shape), s.picture.shape == shape,
              s.picture.model.empty());
    e.line();
    e.add("Write the picture", "f12", "picture");
    e.add("Write the picture, twice as large", "shift+f12",
          fmt::format("picture - {} {}", std::min(2 * s.size.x, 16384), std::min(2 * s.size.y, 16384)));
    e.add("Write the picture as EXR", "", "picture .exr");
    e.add("Copy the command that draws it", "ctrl+c", "copy command");
    e.add("Copy the camera", "ctrl+shift+c", "copy camera");
    if (!s.recent.empty())
        e.line();
    for (const std::string& file : s.recent)
        e.add(file, "", "open " + file, file == s.picture.model);
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
    if (cameras > 0)
        e.line();
    for (std::size_t i = 0; i < cameras; ++i) {
        const std::string& name = s.model->scene.cameras[i].name;
        e.add(fmt::format("{} of the file{}", i, name.empty() ? "" : ": " + name), "", fmt::format("camera {}", i));
    }
}

void addFrameEntries(Entries& e, const State& s)
{
    constexpr std::array<const char*, 9> kFirst = {"cotangent",   "mikktspace", "triangle", "smooth",    "exact",
                                                   "orthonormal", "vertex",     "gradient", "paper-full"};
    std::vector<std::string> names(kFirst.begin(), kFirst.end());
    for (const std::string& name : app::splitAtCommas(app::frameNames())) {
        const std::string word = name.substr(std::min(name.find_first_not_of(' '), name.size()));
        if (std::ranges::find(names, word) == names.end())
            names.push_back(word);
    }
    for (const bool second : {false, true}) {
        e.menu(second ? "Second" : "Frame");
        const Side& side = sideOf(s, second);
        const std::string before = second ? "second " : "";
        for (std::size_t i = 0; i < names.size(); ++i) {
            const std::string key = i < 9 ? fmt::format("{}{}", second ? "shift+" : "", i + 1) : "";
            e.add(names[i], key, before + "frame " + names[i], side.frame == names[i]);
        }
        e.line();
        e.add("Tangents of the file", "", before + "tangents stored", side.tangents == "stored");
        e.add("Tangents generated", "", before + "tangents generated", side.tangents == "generated");
        e.line();
        e.add("Maps as the file says", "", before + "convention ", side.convention.empty());
        for (const auto& [label, words] : {std::pair("Green up (glTF, OpenGL)", "gltf"),
                                           {"Green down (DirectX)", "directx"},
                                           {"Decoded as 2c - 1", "gltf,biased"},
                                           {"Two channels, orthographic", "gltf,orthographic"}})
            e.add(label, "", before + "convention " + words, side.convention == words);
        e.add("The model's own map", "", before + "normal-map ", side.normalMap.empty());
        if (!side.normalMap.empty())
            e.add("Map: " + shortName(side.normalMap), "", before + "normal-map " + side.normalMap, true);
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
    const std::vector<std::string>& names = app::showNames();
    for (std::size_t i = 0; i < names.size(); ++i)
        e.add(names[i], i < 9 ? fmt::format("alt+{}", i + 1) : "", "show " + names[i], s.show == names[i]);
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
    for (const std::string& name : environmentNames())
        e.add(name, "", "set environment " + name, s.picture.environment == name);
    e.add("No surroundings", "", "set environment none", s.picture.environment == "none");
    const bool file = std::filesystem::path(s.picture.environment).has_extension();
    if (file)
        e.add(shortName(s.picture.environment), "", "set environment " + s.picture.environment, true);
    e.line();
    e.add("Turn left", "[", "turn-light -15");
    e.add("Turn right", "]", "turn-light 15");
    e.add("Pinned to the camera", "p", "toggle pin-light", s.lightPinned);
    e.line();
    e.flag("Shadows", "", "no-shadows", true);
    e.add("Ground", "", s.picture.ground == "on" ? "set ground off" : "set ground on", s.picture.ground == "on");
    e.choose("background",
             {{"Background as usual", ""},
              {"Paper", "paper"},
              {"Surroundings, blurred", "blur"},
              {"Surroundings", "environment"},
              {"Gradient", "gradient"},
              {"No background", "none"}});
    e.line();
    e.add("Exposure by the picture", "e", "set exposure auto", s.picture.exposure == "auto");
    const float now = s.picture.exposure == "auto" ? s.metered : std::stof("0" + s.picture.exposure);
    e.add("Brighter", ".", fmt::format("set exposure {:.4g}", std::min((now > 0 ? now : 1) * 1.189207f, 1e6f)));
    e.add("Darker", ",", fmt::format("set exposure {:.4g}", std::max((now > 0 ? now : 1) / 1.189207f, 1e-6f)));
    e.choose("tone-mapping",
             {{"Neutral tones", "neutral"}, {"ACES", "aces"}, {"AgX", "agx"}, {"Cut off at 1", "none"}});
    e.choose("shading", {{"Physically based", "pbr"}, {"Blinn-Phong", "blinn-phong"}});
    e.line();
    const bool four = s.picture.samples == 4;
    e.add("Four samples a pixel", "a", four ? "set samples 1" : "set samples 4", four);
    e.flag("Highlights antialiased", "", "specular-antialiasing");
}

void addAnimationEntries(Entries& e, const State& s)
{
    e.menu("Animation");
    e.add("The file's pose", "", "set animation ", s.picture.animation.empty());
    for (int i = 0; i < 8; ++i)
        e.add(fmt::format("Animation {}", i), "", fmt::format("set animation {}", i),
              s.picture.animation == fmt::format("{}", i), !s.picture.model.empty());
    e.add("Play", "space", "play", s.playing, !s.picture.animation.empty());
    e.add("Start", "home", "set time 0", false, !s.picture.animation.empty());
}

std::string degrees(double value) { return fmt::format("{:.2f}\xc2\xb0", value); }

std::string statusOf(const State& s)
{
    std::string text = !s.picture.model.empty() ? shortName(s.picture.model)
        : !s.picture.shape.empty()              ? s.picture.shape
                                                : "built-in scene";
    if (s.model)
        text += fmt::format("   {} triangles", trianglesDrawn(s.model->scene));
    const Side& side = sideOf(s, s.compare == Compare::flip && s.second);
    text += "   " + s.show + ", " + side.frame;
    if (s.compare == Compare::divider || s.compare == Compare::angle)
        text += (s.compare == Compare::angle ? " against " : " | ") + s.b.frame;
    if (s.statisticsShown && !s.statisticsOf.empty())
        text += s.statistics.count > 0
            ? fmt::format("   {}: mean {}, 95 % {}, most {}", s.statisticsOf, degrees(s.statistics.mean),
                          degrees(s.statistics.percentile95), degrees(s.statistics.maximum))
            : fmt::format("   {}: no normal map is seen", s.statisticsOf);
    text += "   " + s.device;
    if (s.drawSeconds > 0)
        text += fmt::format(" ({:.0f} ms)", s.drawSeconds * 1000);
    return s.said.empty() ? text : s.said + "\n" + text;
}

std::vector<Slider> slidersOf(const State& s)
{
    const auto number = [&](const char* name) { return std::atof(valueOf(*findSetting(name), s.picture).c_str()); };
    std::vector<Slider> sliders = {
        {"exposure", "set exposure", "", s.picture.exposure == "auto" ? s.metered : number("exposure"), 0.05, 20, true},
        {"light turned", "set environment-rotation", "degrees", number("environment-rotation"), -180, 180},
        {"light", "set environment-intensity", "", number("environment-intensity"), 0.05, 20, true},
        {"shadow softness", "set shadow-softness", "degrees", number("shadow-softness"), 0, 60},
    };
    if (s.picture.shadowSoftness < 0) // that of the lamp
        sliders.back().value = s.picture.environment == "evening" ? 3 : 10;
    if (s.compare == Compare::divider)
        sliders.push_back({"divider", "divider", "", s.divider, 0, 1});
    if (!s.picture.animation.empty())
        sliders.push_back({"time", "set time", "s", s.picture.time, 0, 10});
    return sliders;
}

std::string vectorText(const glm::vec3& v) { return fmt::format("{:.2f} {:.2f} {:.2f}", v.x, v.y, v.z); }

std::vector<std::string> cardOf(const State& s)
{
    const Probed& p = s.probe.surface;
    const Hit& hit = *s.probe.hit;
    std::vector<std::string> card;
    if (s.probe.degrees >= 0)
        card.push_back(degrees(s.probe.degrees) + " " + s.statisticsOf);
    card.push_back(fmt::format("mesh {}, triangle {}", hit.mesh, hit.triangle));
    card.push_back(p.hasUv ? fmt::format("uv {:.4f} {:.4f}", p.uv.x, p.uv.y) : "no uv");
    if (p.texel.x >= 0)
        card.push_back(fmt::format("texel {} {}", p.texel.x, p.texel.y));
    if (p.w != 0)
        card.push_back(fmt::format("w {:+d}", p.w));
    card.push_back("t " + vectorText(p.t));
    card.push_back("b " + vectorText(p.b));
    card.push_back("n " + vectorText(p.normal));
    if (p.storedTangent != glm::vec3(0))
        card.push_back("stored t " + vectorText(p.storedTangent));
    return card;
}

// The frame on the surface, 60 pixels long.
std::vector<Line2D> arrowsOf(const State& s)
{
    const Hit& hit = *s.probe.hit;
    const Probed& p = s.probe.surface;
    const float length = 60 * unitsOfPixel(s.camera, s.camera.orthographic ? 1 : hit.depth, s.size);
    const glm::vec2 from(onPicture(s.camera, hit.position, s.size));
    std::vector<Line2D> lines;
    const auto add = [&](const glm::vec3& direction, const glm::vec3& color, const char* name, float share) {
        const float size = glm::length(direction);
        if (!(size > 0))
            return;
        const glm::vec3 to = onPicture(s.camera, hit.position + direction / size * length * share, s.size);
        if (to.z > 0)
            lines.push_back({from, glm::vec2(to), color, name});
    };
    add(p.storedTangent, {0.95f, 0.85f, 0.2f}, "stored", 1.25f);
    add(p.t, {0.95f, 0.3f, 0.25f}, "t", 1);
    add(p.b, {0.35f, 0.85f, 0.3f}, "b", 1);
    add(p.normal, {0.4f, 0.6f, 1}, "n", 1);
    return lines;
}

// The false colours of degrees.
std::vector<std::pair<double, glm::vec3>> scaleOfDegrees()
{
    const std::vector<float> stops = {0, 0.5f, 2, 5, 15, 45};
    const Image heat = heatMap(stops, int(stops.size()), 1);
    std::vector<std::pair<double, glm::vec3>> scale;
    for (std::size_t i = 0; i < stops.size(); ++i) {
        const std::uint8_t* c = heat.bytes8() + 4 * i;
        scale.emplace_back(double(stops[i]), glm::vec3(c[0], c[1], c[2]) / 255.0f);
    }
    return scale;
}

// A line of the cheat sheet; the keys 1 to 9 of a menu share one, which says what is chosen.
void addToSheet(const Entry& entry, std::vector<std::pair<std::string, std::string>>& sheet)
{
    const std::string before = entry.key.substr(0, entry.key.size() - std::min<std::size_t>(entry.key.size(), 1));
    const bool digit = (before.empty() || before == "shift+" || before == "alt+") && !entry.key.empty()
        && entry.key.back() >= '1' && entry.key.back() <= '9';
    const std::string shared = entry.menu + ": ";
    if (digit && (sheet.empty() || !sheet.back().second.starts_with(shared)))
        sheet.emplace_back(before + "1 ... 9", shared);
    if (!sheet.empty() && sheet.back().second == shared && entry.on)
        sheet.back().second += entry.label;
    else if (!digit && !entry.key.empty())
        sheet.emplace_back(entry.key, entry.label + (entry.on ? ": on" : ""));
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

Interface interfaceOf(const State& s)
{
    Interface i;
    i.shown = s.interfaceShown;
    i.dark = s.dark;
    i.scale = s.scale;
    i.cheatSheet = s.cheatSheet;
    i.slidersShown = s.settingsShown;
    i.hotSpotsShown = s.hotSpotsShown;
    for (const Entry& entry : entriesOf(s)) {
        if (i.menus.empty() || i.menus.back().title != entry.menu)
            i.menus.push_back({entry.menu, {}});
        i.menus.back().items.push_back({entry.label, entry.key, entry.command, entry.on, entry.usable});
        addToSheet(entry, i.sheet);
    }
    for (const auto& [keys, what] : {std::pair("left drag", "turn"),
                                     {"middle, right drag", "move"},
                                     {"wheel", "zoom to the pointer"},
                                     {"click", "pivot"},
                                     {"shift drag", "turn the light"},
                                     {"w a s d q e + right", "fly"}})
        i.sheet.emplace_back(keys, what);
    i.sliders = slidersOf(s);
    i.status = statusOf(s);
    i.problem = s.problem;
    i.progress = s.progress;
    i.doing = s.loading.empty() ? "" : "loading " + s.loading;
    if (s.cardShown && s.interfaceShown && s.probe.hit && s.held.empty()) {
        i.card = cardOf(s);
        i.cardAt = s.pointer;
        i.lines = arrowsOf(s);
    }
    if (s.interfaceShown && (s.compare == Compare::angle || s.show == "error" || s.show == "shear"))
        i.scaleBar = scaleOfDegrees();
    if (s.hotSpots)
        for (std::size_t k = 0; k < s.hotSpots->size(); ++k)
            i.hotSpots.push_back({(*s.hotSpots)[k].text, fmt::format("hot-spot {}", k)});
    if (s.compare == Compare::divider && s.interfaceShown) {
        i.divider = s.divider * float(s.size.x);
        i.leftName = s.a.frame;
        i.rightName = s.b.frame;
    }
    return i;
}

} // namespace cotan::viewer
