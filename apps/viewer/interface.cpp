// Describes the state as plain values for the window.
#include "interface.hpp"

#include <array>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "bake/bake_surfaces.hpp"
#include "camera.hpp"
#include "commands.hpp"
#include "core/real_number.hpp"
#include "files.hpp"
#include "inspect/angles.hpp"
#include "picture/option_words.hpp"
#include "scene/geometry.hpp"
#include "settings.hpp"

namespace cotan::viewer {

namespace {

std::string degrees(double value) { return fmt::format("{:.2f}\xc2\xb0", value); }

// The name of a side's frame; for "auto", followed by the frame chosen for the model's own maps.
std::string frameLabel(const State& s, bool second)
{
    const Side side = sideOf(s, second);
    if (side.high)
        return highName(s);
    if (side.frame != kAutoFrame || !s.model || !side.normalMap.empty())
        return side.frame;
    const auto frame = chosenFrame({}, s.picture, s.model->scene);
    const std::string label = nameOfFrames(frame, s.model->scene);
    return frame ? side.frame + " (" + label + ")" : label;
}

std::string statusOf(const State& s)
{
    std::string text = !s.picture.model.empty() ? fileName(s.picture.model)
        : !s.picture.shape.empty()              ? s.picture.shape
                                                : "built-in scene";
    if (s.model)
        text += fmt::format("   {} triangles", trianglesDrawn(s.model->scene));
    text += "   " + s.show + ", " + frameLabel(s, s.compare == Compare::flip && s.second);
    if (s.compare == Compare::divider || s.compare == Compare::angle)
        text += (s.compare == Compare::angle ? " against " : " | ") + frameLabel(s, true);
    if (s.statisticsShown && !s.statisticsOf.empty())
        text += s.statistics.count > 0
            ? fmt::format("   {}: mean {}, 95 % {}, max {}", s.statisticsOf, degrees(s.statistics.mean),
                          degrees(s.statistics.percentile95), degrees(s.statistics.maximum))
            : fmt::format("   {}: no normal map is visible", s.statisticsOf);
    text += "   " + s.device;
    if (s.drawSeconds > 0)
        text += fmt::format(" ({:.0f} ms)", s.drawSeconds * 1000);
    return s.message.empty() ? text : s.message + "\n" + text;
}

std::vector<Slider> slidersOf(const State& s)
{
    const auto number = [&](const char* name) { return parseReal(valueOf(*findSetting(name), s.picture)).value_or(0); };
    std::vector<Slider> sliders = {
        {"exposure", "set exposure", "", s.picture.exposure.value_or(s.metered), 0.05, 20, true},
        {"light rotation", "set environment-rotation", "degrees", number("environment-rotation"), -180, 180},
        {"light intensity", "set environment-intensity", "", number("environment-intensity"), 0.05, 20, true},
        {"shadow softness", "set shadow-softness", "degrees", shadowSoftnessOf(s.picture), 0, 60},
    };
    if (s.compare == Compare::divider)
        sliders.push_back({"divider", "divider", "", s.divider, 0, 1});
    if (const GltfAnimation* animation = animationOf(s); animation && animation->seconds > 0)
        sliders.push_back({"time", "set time", "s", s.picture.time, 0, animation->seconds});
    return sliders;
}

std::string vectorText(const glm::vec3& v) { return fmt::format("{:.2f} {:.2f} {:.2f}", v.x, v.y, v.z); }

std::vector<std::string> cardOf(const State& s)
{
    const Probed& p = s.probe.surface;
    const PickedPoint& hit = *s.probe.hit;
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

// The axes of the frame on the surface, 60 pixels long.
std::vector<Line2D> arrowsOf(const State& s)
{
    const PickedPoint& hit = *s.probe.hit;
    const Probed& p = s.probe.surface;
    const float length = 60 * unitsOfPixel(s.camera, s.camera.orthographic ? 1 : hit.depth, s.size);
    const glm::vec2 from(projectToImage(s.camera, hit.position, s.size));
    std::vector<Line2D> lines;
    const auto add = [&](const glm::vec3& direction, const glm::vec3& color, const char* name, float fraction) {
        const float size = glm::length(direction);
        if (!(size > 0))
            return;
        const glm::vec3 to = projectToImage(s.camera, hit.position + direction / size * length * fraction, s.size);
        if (to.z > 0)
            lines.push_back({from, glm::vec2(to), color, name});
    };
    add(p.storedTangent, {0.95f, 0.85f, 0.2f}, "stored", 1.25f);
    add(p.t, {0.95f, 0.3f, 0.25f}, "t", 1);
    add(p.b, {0.35f, 0.85f, 0.3f}, "b", 1);
    add(p.normal, {0.4f, 0.6f, 1}, "n", 1);
    return lines;
}

// The outline of the selected problem area's triangle.
void addOutline(const State& s, std::vector<Line2D>& lines)
{
    const std::array<glm::vec3, 3>& corners = (*s.problemAreas)[*s.problemArea].corners;
    std::array<glm::vec3, 3> at;
    for (std::size_t k = 0; k < 3; ++k) {
        at[k] = projectToImage(s.camera, corners[k], s.size);
        if (!(at[k].z > 0)) // behind the eye
            return;
    }
    for (std::size_t k = 0; k < 3; ++k)
        lines.push_back({glm::vec2(at[k]), glm::vec2(at[(k + 1) % 3]), {1, 1, 1}, {}});
}

// The colour scale of angles in degrees.
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

// Adds a line to the list of keys, and the menu's title before its first key. Keys 1 to 9 of a menu share one line,
// which names the active entry.
void addToSheet(const Entry& entry, std::string& heading, std::vector<std::pair<std::string, std::string>>& sheet)
{
    if (entry.key.empty())
        return;
    if (heading != entry.menu)
        sheet.emplace_back("", entry.menu);
    heading = entry.menu;
    const std::string before = entry.key.substr(0, entry.key.size() - std::min<std::size_t>(entry.key.size(), 1));
    const bool digit = (before.empty() || before == "shift+" || before == "alt+") && entry.key.back() >= '1'
        && entry.key.back() <= '9';
    const std::string shared = entry.menu + ": ";
    if (digit && !sheet.back().second.starts_with(shared))
        sheet.emplace_back(keyLabel(before + "1") + " ... 9", shared);
    if (sheet.back().second == shared && entry.on)
        sheet.back().second += entry.label;
    else if (!digit)
        sheet.emplace_back(keyLabel(entry.key), entry.label + (entry.on ? ": on" : ""));
}

} // namespace

Interface interfaceOf(const State& s)
{
    Interface i;
    i.shown = s.interfaceShown;
    i.dark = s.dark;
    i.scale = s.scale;
    i.cheatSheet = s.cheatSheet;
    i.slidersShown = s.settingsShown;
    i.problemAreasShown = s.problemAreasShown;
    std::string heading;
    for (const Entry& entry : entriesOf(s)) {
        if (i.menus.empty() || i.menus.back().title != entry.menu)
            i.menus.push_back({entry.menu, {}});
        i.menus.back().items.push_back(
            {entry.label, keyLabel(entry.key), entry.command, entry.on, entry.usable, entry.submenu});
        addToSheet(entry, heading, i.sheet);
    }
    for (auto& [key, what] : i.sheet) // remove the colon if none of 1 to 9 is active
        if (what.ends_with(": "))
            what.resize(what.size() - 2);
    i.sheet.emplace_back("", "Mouse");
    for (const auto& [keys, what] : {std::pair("Left drag", "Orbit"),
                                     {"Middle or right drag", "Pan"},
                                     {"Wheel", "Zoom to the pointer"},
                                     {"Click", "Set the pivot"},
                                     {"Shift+drag", "Rotate the light"},
                                     {"Right button + W A S D Q E", "Fly"}})
        i.sheet.emplace_back(keys, what);
    i.sliders = slidersOf(s);
    i.status = statusOf(s);
    i.problem = s.problem;
    i.progress = s.task.empty() ? s.progress : 0;
    i.doing = !s.loading.empty() ? "loading " + s.loading : s.task.empty() ? "" : "running: " + s.task;
    i.resultShown = s.resultShown;
    i.resultTitle = s.result.title;
    i.resultLines = s.result.lines;
    if (s.cardShown && s.interfaceShown && s.probe.hit && s.held.empty()) {
        i.card = cardOf(s);
        i.cardAt = s.pointer;
        i.lines = arrowsOf(s);
    }
    if (s.interfaceShown && (s.compare == Compare::angle || s.show == "error" || s.show == "shear"))
        i.scaleBar = scaleOfDegrees();
    if (s.interfaceShown && s.show == "mask" && s.compare != Compare::angle)
        for (const MaskColor& c : maskColors())
            i.legend.emplace_back(c.meaning, c.color);
    if (s.problemAreas && s.problemArea && s.interfaceShown && !s.playing) // an animation moves away from the triangle
        addOutline(s, i.lines);
    if (s.problemAreas)
        for (std::size_t k = 0; k < s.problemAreas->size(); ++k)
            i.problemAreas.push_back({(*s.problemAreas)[k].text, fmt::format("hot-spot {}", k)});
    if (s.compare == Compare::divider && s.interfaceShown) {
        i.divider = s.divider * float(s.size.x);
        i.leftName = frameLabel(s, false);
        i.rightName = frameLabel(s, true);
    }
    return i;
}

} // namespace cotan::viewer
