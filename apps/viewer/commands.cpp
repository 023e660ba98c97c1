#include "commands.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <sstream>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "camera.hpp"
#include "cotan/convention_words.hpp"
#include "cotan/draw/camera_words.hpp"
#include "cotan/files/extension.hpp"
#include "cotan/parse_number.hpp"
#include "files.hpp"
#include "parse.hpp"
#include "settings.hpp"

namespace cotan::viewer {

namespace {

constexpr float kRadians = 0.017453293f;

struct Words {
    std::string rest;

    std::string next()
    {
        const std::size_t start = std::min(rest.find_first_not_of(' '), rest.size());
        const std::size_t end = std::min(rest.find(' ', start), rest.size());
        std::string word = rest.substr(start, end - start);
        rest = rest.substr(std::min(end + 1, rest.size()));
        return word;
    }
    Result<float> number(const char* what)
    {
        const std::string word = next();
        float value = 0;
        if (!parseNumber(std::string_view(word), value) || !std::isfinite(value))
            return usageError(fmt::format("{}: expected a number; found '{}'", what, word));
        return value;
    }
};

Status expected(const std::string& command, const std::string& what, const std::string& found)
{
    return usageError(fmt::format("{}: expected {}; found '{}'", command, what, found));
}

void wish(State& state, Wish::Kind kind, std::string text = {}, glm::ivec2 size = {0, 0})
{
    state.wishes.push_back({kind, std::move(text), size});
}

void moveCamera(State& state) { state.cameraMoved = true; }

// The light goes with the camera where it is pinned to it.
float azimuthOf(const Camera& camera)
{
    const glm::vec3 back = camera.eye - camera.target;
    return std::atan2(back.x, back.z) / kRadians;
}

double wrapped(double degrees) { return std::remainder(degrees, 360.0); }

void followCamera(State& state)
{
    if (!state.lightPinned)
        return;
    const float azimuth = azimuthOf(state.camera);
    state.picture.environmentRotation =
        std::round(wrapped(state.picture.environmentRotation + double(azimuth - state.pinnedAt)) * 1000) / 1000;
    state.pinnedAt = azimuth;
}

Status openFile(State& state, const std::string& file)
{
    if (file.empty())
        return expected("open", "a file", "");
    if (isPicture(file)) {
        const std::string ending = lowerExtension(file);
        if (ending == ".hdr" || (ending == ".exr" && !state.picture.model.empty())) {
            state.picture.environment = file;
            state.metered = 0;
            return Done{};
        }
        state.a.normalMap = file; // a map
        if (state.picture.model.empty() && state.picture.shape.empty()) {
            state.picture.shape = "plane";
            wish(state, Wish::Kind::load, "");
        }
        return Done{};
    }
    wish(state, Wish::Kind::load, file);
    return Done{};
}

Status neighbour(State& state, int step)
{
    const std::string file = neighbourOf(state.picture.model, step);
    if (file.empty())
        return expected(step > 0 ? "next" : "previous", "another model in the folder", "none");
    return openFile(state, file);
}

Status setFrame(Side& side, const std::string& name)
{
    if (const auto frame = app::parseFrame(name); !frame)
        return frame.error();
    side.frame = name;
    return Done{};
}

Status setSide(Side& side, const std::string& what, const std::string& value)
{
    if (what == "frame")
        return setFrame(side, value);
    if (what == "tangents") {
        if (value != "stored" && value != "generated")
            return expected("tangents", "stored or generated", value);
        side.tangents = value;
    } else if (what == "normal-map") {
        side.normalMap = value;
    } else if (what == "convention") {
        if (!value.empty())
            if (const auto known = conventionFromWords(value); !known)
                return known.error();
        side.convention = value;
    } else {
        return expected("second", "frame, tangents, normal-map or convention", what);
    }
    return Done{};
}

Status setCamera(State& state, const std::string& words)
{
    if (!state.model)
        return expected("camera", "a model", "none");
    const auto camera = cameraFromWords(words, state.model->scene, state.size.x, state.size.y);
    if (!camera)
        return camera.error();
    state.camera = *camera;
    moveCamera(state);
    return Done{};
}

Status toggle(State& state, const std::string& name)
{
    const std::map<std::string, bool State::*> switches = {{"interface", &State::interfaceShown},
                                                           {"help", &State::cheatSheet},
                                                           {"settings", &State::settingsShown},
                                                           {"hot-spots", &State::hotSpotsShown},
                                                           {"card", &State::cardShown},
                                                           {"statistics", &State::statisticsShown},
                                                           {"look", &State::dark},
                                                           {"pin-light", &State::lightPinned}};
    const auto known = switches.find(name);
    if (known != switches.end()) {
        state.*known->second = !(state.*known->second);
        state.pinnedAt = azimuthOf(state.camera);
        if (name == "hot-spots" && state.hotSpotsShown && !state.hotSpots)
            wish(state, Wish::Kind::findHotSpots);
        return Done{};
    }
    std::string names;
    for (const auto& [word, field] : switches)
        names += (names.empty() ? "one of " : ", ") + word;
    return expected("toggle", names, name);
}

Status setCompare(State& state, const std::string& mode)
{
    const std::map<std::string, Compare> modes = {
        {"off", Compare::off}, {"divider", Compare::divider}, {"flip", Compare::flip}, {"angle", Compare::angle}};
    const auto known = modes.find(mode);
    if (known == modes.end())
        return expected("compare", "off, divider, flip or angle", mode);
    state.compare = known->second;
    state.second = false;
    return Done{};
}

Status sized(State& state, Wish::Kind kind, const std::string& command, Words words)
{
    const auto width = words.number(command.c_str()), height = words.number(command.c_str());
    if (!width)
        return width.error();
    if (!height)
        return height.error();
    if (*width < 1 || *height < 1 || *width > 16384 || *height > 16384)
        return expected(command, "1 to 16384 pixels", fmt::format("{} {}", *width, *height));
    wish(state, kind, {}, {int(*width), int(*height)});
    return Done{};
}

// FILE [W H]; a file may have spaces where no size follows.
Status writePicture(State& state, const std::string& rest)
{
    Words words{rest};
    const std::string first = words.next();
    if (words.rest.empty() || first.empty()) {
        wish(state, Wish::Kind::writeFile, rest, state.size);
        return Done{};
    }
    Words numbers = words;
    if (Status done = sized(state, Wish::Kind::writeFile, "picture", numbers); !done)
        return done;
    state.wishes.back().text = first;
    return Done{};
}

using Numbers = std::vector<float>;

Result<Numbers> numbersOf(Words& words, const char* command, int count)
{
    Numbers all;
    for (int i = 0; i < count; ++i) {
        const auto number = words.number(command);
        if (!number)
            return number.error();
        all.push_back(*number);
    }
    return all;
}

// Commands of the camera that take numbers.
struct Motion {
    const char* name;
    int count;
    void (*move)(State&, const Numbers&);
};

constexpr Motion kMotions[] = {
    {"orbit", 2, [](State& s, const Numbers& n) { orbit(s.camera, n[0] * kRadians, n[1] * kRadians); }},
    {"look", 2, [](State& s, const Numbers& n) { look(s.camera, n[0] * kRadians, n[1] * kRadians); }},
    {"pan", 2,
     [](State& s, const Numbers& n) {
         pan(s.camera, {n[0], n[1]}, s.size);
     }},
    {"zoom", 1, [](State& s, const Numbers& n) { zoomTo(s.camera, n[0], glm::vec2(s.size) * 0.5f, s.size); }},
    {"fly", 3,
     [](State& s, const Numbers& n) {
         fly(s.camera, {n[0], n[1], n[2]});
     }},
};

Status performSwitch(State& state, const std::string& command, Words& words)
{
    if (command == "reset") {
        resetCamera(state);
    } else if (command == "orthographic") {
        setOrthographic(state.camera, !state.camera.orthographic);
        moveCamera(state);
    } else if (command == "flip") {
        if (state.compare != Compare::flip) {
            state.compare = Compare::flip;
            state.second = false;
        }
        state.second = !state.second;
    } else if (command == "swap") {
        std::swap(state.a, state.b);
    } else if (command == "play") {
        if (state.picture.animation.empty())
            return expected("play", "an animation", "none");
        state.playing = !state.playing;
    } else if (command == "reload") {
        wish(state, Wish::Kind::load, state.picture.model);
    } else if (command == "next" || command == "previous") {
        return neighbour(state, command == "next" ? 1 : -1);
    } else if (command == "paste") {
        wish(state, Wish::Kind::paste);
    } else if (command == "choose") {
        wish(state, Wish::Kind::chooseFile);
    } else if (command == "find-hot-spots") {
        wish(state, Wish::Kind::findHotSpots);
    } else if (command == "lose-surface") {
        wish(state, Wish::Kind::loseSurface);
    } else if (command == "quit") {
        wish(state, Wish::Kind::quit);
    } else if (command == "copy") {
        const std::string what = words.next();
        if (what != "command" && what != "camera")
            return expected("copy", "command or camera", what);
        wish(state, Wish::Kind::copy,
             what == "camera" ? cameraWords(state.camera) : commandLine(state, "picture.png", state.size));
    } else {
        return usageError(fmt::format("expected a command of the viewer; found '{}'", command));
    }
    return Done{};
}

Status performSet(State& state, Words& words)
{
    const std::string name = words.next();
    const Setting* setting = findSetting(name);
    if (!setting)
        return expected("set", "an option of the picture", name);
    if (Status set = setValue(*setting, words.rest, state.picture); !set)
        return set;
    if (setting->meters)
        state.metered = 0;
    if (name == "exposure")
        state.meteredFrom = state.cameraMoved ? cameraWords(state.camera) : "";
    if (setting->loads)
        wish(state, Wish::Kind::load, state.picture.model);
    return Done{};
}

// Options that are refused without surroundings go with them.
void settle(PictureOptions& o)
{
    if (o.environment != "none")
        return;
    o.environmentRotation = 0;
    o.environmentIntensity = 1;
    if (o.background == "environment" || o.background == "blur")
        o.background.clear();
}

Status performOne(State& state, const std::string& line)
{
    Words words{line};
    const std::string command = words.next();
    for (const Motion& motion : kMotions)
        if (command == motion.name) {
            const auto numbers = numbersOf(words, motion.name, motion.count);
            if (!numbers)
                return numbers.error();
            motion.move(state, *numbers);
            moveCamera(state);
            followCamera(state);
            return Done{};
        }
    if (command == "open" || command == "drop")
        return openFile(state, words.rest);
    if (command == "set")
        return performSet(state, words);
    if (command == "frame" || command == "tangents" || command == "normal-map" || command == "convention")
        return setSide(state.a, command, words.rest);
    if (command == "second") {
        const std::string what = words.next();
        return setSide(state.b, what, words.rest);
    }
    if (command == "show") {
        if (std::ranges::find(showNames(), words.rest) == showNames().end())
            return expected("show", fmt::format("one of {}", fmt::join(showNames(), ", ")), words.rest);
        state.show = words.rest;
        return Done{};
    }
    if (command == "camera")
        return setCamera(state, words.rest);
    if (command == "see") {
        if (!seeFrom(state.camera, words.rest))
            return expected("see", "front, back, left, right, top or bottom", words.rest);
        moveCamera(state);
        followCamera(state);
        return Done{};
    }
    if (command == "turn-light") {
        const auto degrees = words.number("turn-light");
        if (!degrees)
            return degrees.error();
        state.picture.environmentRotation =
            std::round(wrapped(state.picture.environmentRotation + double(*degrees)) * 1000) / 1000;
        return Done{};
    }
    if (command == "compare")
        return setCompare(state, words.rest);
    if (command == "divider" || command == "scale") {
        const auto value = words.number(command.c_str());
        if (!value)
            return value.error();
        if (command == "divider")
            state.divider = std::clamp(*value, 0.0f, 1.0f);
        else
            state.scale = *value <= 0 ? 0.0f : std::clamp(*value, 0.5f, 4.0f);
        return Done{};
    }
    if (command == "toggle")
        return toggle(state, words.rest);
    if (command == "size")
        return sized(state, Wish::Kind::resize, "size", words);
    if (command == "picture")
        return writePicture(state, words.rest);
    if (command == "window" || command == "report") {
        if (words.rest.empty())
            return expected(command, "a file", "");
        wish(state, command == "window" ? Wish::Kind::writeWindow : Wish::Kind::writeReport, words.rest);
        return Done{};
    }
    if (command == "hot-spot") {
        const auto number = words.number("hot-spot");
        if (!number)
            return number.error();
        const std::size_t count = state.hotSpots ? state.hotSpots->size() : 0;
        if (*number < 0 || std::size_t(*number) >= count)
            return expected("hot-spot", count > 0 ? fmt::format("0 to {}", count - 1) : "hot spots to have been found",
                            fmt::format("{}", *number));
        state.camera = (*state.hotSpots)[std::size_t(*number)].camera;
        moveCamera(state);
        return Done{};
    }
    return performSwitch(state, command, words);
}

} // namespace

Status perform(State& state, const std::string& line)
{
    Status done = performOne(state, line);
    settle(state.picture);
    return done;
}

} // namespace cotan::viewer
