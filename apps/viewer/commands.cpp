#include "commands.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bake/name_pairs.hpp"
#include "command_words.hpp"
#include "core/try.hpp"
#include "cotan/convention.hpp"
#include "cotan/render.hpp"
#include "files.hpp"
#include "image/format_table.hpp"
#include "parse.hpp"
#include "settings.hpp"

namespace cotan::viewer {

namespace {

Status ask(State& state, Request request)
{
    state.requests.push_back(std::move(request));
    return Done{};
}

Status openHigh(State& state, const std::string& file)
{
    if (!file.empty())
        return ask(state, request::LoadHigh{{file}});
    closeHigh(state);
    return Done{};
}

Status openFile(State& state, const std::string& file)
{
    if (file.empty())
        return expected("open", "a file", "");
    if (isImageFile(file)) {
        const ImageFormat& format = *imageFormatOf(file);
        // HDR images become the environment; if the format has negative values and there is no model, a normal map.
        const bool light = format.floats && !format.bits8;
        if (light && (!format.negative || !state.picture.model.empty())) {
            state.picture.environment = file;
            state.metered = 0;
            return Done{};
        }
        state.a.normalMap = file; // a normal map
        if (state.picture.model.empty() && state.picture.shape.empty()) {
            state.picture.shape = "plane";
            return ask(state, request::Load{});
        }
        return Done{};
    }
    return ask(state, request::Load{file});
}

// Opens a file that a folder or the clipboard hands over. Detail that by its name belongs to the open model is shown
// beside it.
Status dropFile(State& state, const std::string& file)
{
    const std::string model = std::filesystem::path(state.picture.model).stem().string();
    const std::string other = std::filesystem::path(file).stem().string();
    if (!isModel(file) || model.empty() || roleOfName(other) != NameRole::high || roleOfName(model) == NameRole::high)
        return openFile(state, file);
    const NamePairs pairs = pairNames({model}, {other});
    return pairs.low[0] >= 0 && pairs.low[0] == pairs.high[0] ? openHigh(state, file) : openFile(state, file);
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
    COTAN_CHECK(parseFrameChoice(name));
    side.frame = name;
    side.high = false;
    return Done{};
}

Status setSide(Side& side, const std::string& what, const std::string& value)
{
    if (what == "frame")
        return setFrame(side, value);
    if (what == "tangents") {
        const auto known = cotan::valueOf(kTangentOrigins, value);
        if (!known)
            return expected("tangents", "stored or generated", value);
        side.tangents = *known;
    } else if (what == "normal-map") {
        side.normalMap = value;
    } else if (what == "convention") {
        if (!value.empty())
            COTAN_CHECK(parseStatedConvention(value));
        side.convention = value;
    } else if (what == "high") {
        if (value != "on" && value != "off")
            return expected("second high", "on or off", value);
        side.high = value == "on";
    } else {
        return expected("second", "frame, tangents, normal-map, convention or high", what);
    }
    return Done{};
}

Status toggle(State& state, const std::string& name)
{
    const std::map<std::string, bool State::*> switches = {{"interface", &State::interfaceShown},
                                                           {"help", &State::cheatSheet},
                                                           {"settings", &State::settingsShown},
                                                           {"hot-spots", &State::problemAreasShown},
                                                           {"card", &State::cardShown},
                                                           {"statistics", &State::statisticsShown},
                                                           {"result", &State::resultShown},
                                                           {"look", &State::dark},
                                                           {"loop", &State::loops},
                                                           {"turntable", &State::turning},
                                                           {"pin-light", &State::lightPinned}};
    const auto known = switches.find(name);
    if (known != switches.end()) {
        state.*known->second = !(state.*known->second);
        state.pinnedAt = azimuthOf(state.camera);
        if (name == "hot-spots" && state.problemAreasShown && !state.problemAreas)
            state.requests.push_back(request::FindProblemAreas{});
        if (name == "hot-spots" && !state.problemAreasShown)
            state.problemArea.reset();
        return Done{};
    }
    std::string names;
    for (const auto& [word, field] : switches)
        names += (names.empty() ? "one of " : ", ") + word;
    return expected("toggle", names, name);
}

Status setCompare(State& state, const std::string& mode)
{
    const auto known = cotan::valueOf(kCompares, mode);
    if (!known)
        return expected("compare", eitherOf(wordsOf(kCompares)), mode);
    state.compare = *known;
    state.second = false;
    return Done{};
}

Result<glm::ivec2> sizeFrom(Words words, const std::string& command)
{
    COTAN_TRY(width, words.number(command.c_str()), height = words.number(command.c_str()));
    if (!height)
        return height.error();
    if (*width < 1 || *height < 1 || *width > 16384 || *height > 16384)
        return expected(command, "1 to 16384 pixels", fmt::format("{} {}", *width, *height)).error();
    return glm::ivec2(*width, *height);
}

Status resize(State& state, const Words& words)
{
    COTAN_TRY(size, sizeFrom(words, "size"));
    return ask(state, request::Resize{*size});
}

// Parses FILE [W H]. File names may contain spaces: only two numbers at the end are a size.
Status writePicture(State& state, const std::string& rest)
{
    const std::size_t height = rest.rfind(' '), width = height == 0 ? rest.npos : rest.rfind(' ', height - 1);
    const Words size{width == rest.npos || height == rest.npos ? "" : rest.substr(width + 1)};
    Words tried = size;
    const bool sized = tried.number("picture") && tried.number("picture");
    COTAN_TRY(pixels, sized ? sizeFrom(size, "picture") : Result<glm::ivec2>(state.size));
    return ask(state, request::WriteImage{sized ? rest.substr(0, width) : rest, *pixels});
}

Status flip(State& state)
{
    if (state.compare != Compare::flip) {
        state.compare = Compare::flip;
        state.second = false;
    }
    state.second = !state.second;
    return Done{};
}

Status play(State& state)
{
    if (state.picture.animation.empty() && state.model && !state.model->animations.empty())
        state.picture.animation = "0";
    if (state.picture.animation.empty())
        return expected("play", "a model with animations", "none");
    state.playing = !state.playing;
    const GltfAnimation* animation = animationOf(state);
    if (state.playing && animation && state.picture.time >= animation->seconds)
        state.picture.time = 0;
    return ask(state, request::Pose{});
}

Status copy(State& state, const std::string& what)
{
    if (what == "camera")
        return ask(state, request::Copy{formatCamera(state.camera)});
    if (what == "command")
        return ask(state, request::Copy{commandLine(state, "picture.png", state.size)});
    if (what == "result")
        return ask(state, request::Copy{fmt::format("{}", fmt::join(state.result.lines, "\n"))});
    return expected("copy", "command, camera or result", what);
}

Status show(State& state, const std::string& name)
{
    if (std::ranges::find(showNames(), name) == showNames().end())
        return expected("show", fmt::format("one of {}", fmt::join(showNames(), ", ")), name);
    if (name == "mask" && state.picture.maps.mask.empty())
        return expected("show mask", "a mask of bake (set mask FILE)", "none");
    state.show = name;
    return Done{};
}

Status performSet(State& state, Words& words)
{
    const std::string name = words.next();
    const Setting* setting = findSetting(name);
    if (!setting)
        return expected("set", "a setting of the view", name);
    COTAN_CHECK(setValue(*setting, words.rest, state.picture));
    if (setting->after == Setting::After::metering)
        state.metered = 0;
    if (name == "exposure")
        state.meteredFrom = state.cameraMoved ? formatCamera(state.camera) : "";
    if (name == "animation")
        state.picture.time = 0;
    if (name == "mask")
        state.show = state.picture.maps.mask.empty() ? "shaded" : "mask";
    if (state.picture.animation.empty())
        state.playing = false;
    if (setting->after == Setting::After::loading)
        state.requests.push_back(request::Load{state.picture.model});
    if (setting->after == Setting::After::posing)
        state.requests.push_back(request::Pose{});
    return Done{};
}

template<class Write> Status writeTo(State& state, const char* command, const std::string& file)
{
    return file.empty() ? expected(command, "a file", "") : ask(state, Write{file});
}

template<class Set> Status withNumber(Words& words, const char* command, const Set& set)
{
    COTAN_TRY(value, words.number(command));
    set(*value);
    return Done{};
}

template<class What> Status requested(State& state, Words&) { return ask(state, What{}); }

using Perform = Status (*)(State&, Words&);

// Commands by name; performCamera has those of the camera.
const std::map<std::string, Perform>& commandTable()
{
    static const Perform open = [](State& s, Words& w) { return openFile(s, w.rest); };
    static const std::map<std::string, Perform> all = {
        {"open", open},
        {"drop", [](State& s, Words& w) { return dropFile(s, w.rest); }},
        {"high", [](State& s, Words& w) { return openHigh(s, w.rest); }},
        {"reload", [](State& s, Words&) { return ask(s, request::Load{s.picture.model}); }},
        {"next", [](State& s, Words&) { return neighbour(s, 1); }},
        {"previous", [](State& s, Words&) { return neighbour(s, -1); }},
        {"paste", requested<request::Paste>},
        {"choose", [](State& s, Words& w) { return ask(s, request::ChooseFile{w.rest.empty() ? "open" : w.rest}); }},
        {"find-hot-spots", requested<request::FindProblemAreas>},
        {"lose-surface", requested<request::LoseSurface>},
        {"run", [](State& s, Words& w) { return ask(s, request::RunTask{w.next()}); }},
        {"stop", requested<request::StopTask>},
        {"quit", requested<request::Quit>},
        {"set", performSet},
        {"show", [](State& s, Words& w) { return show(s, w.rest); }},
        {"frame", [](State& s, Words& w) { return setSide(s.a, "frame", w.rest); }},
        {"tangents", [](State& s, Words& w) { return setSide(s.a, "tangents", w.rest); }},
        {"normal-map", [](State& s, Words& w) { return setSide(s.a, "normal-map", w.rest); }},
        {"convention", [](State& s, Words& w) { return setSide(s.a, "convention", w.rest); }},
        {"second",
         [](State& s, Words& w) {
             const std::string what = w.next();
             if (what == "high" && !s.highModel)
                 return expected("second high", "a high model (high FILE)", "none");
             return setSide(s.b, what, w.rest);
         }},
        {"swap",
         [](State& s, Words&) {
             std::swap(s.a, s.b);
             return Status(Done{});
         }},
        {"flip", [](State& s, Words&) { return flip(s); }},
        {"compare", [](State& s, Words& w) { return setCompare(s, w.rest); }},
        {"divider",
         [](State& s, Words& w) {
             return withNumber(w, "divider", [&](float fraction) { s.divider = std::clamp(fraction, 0.0f, 1.0f); });
         }},
        {"scale",
         [](State& s, Words& w) {
             return withNumber(w, "scale", [&](float x) { s.scale = x <= 0 ? 0.0f : std::clamp(x, 0.5f, 4.0f); });
         }},
        {"toggle", [](State& s, Words& w) { return toggle(s, w.rest); }},
        {"play", [](State& s, Words&) { return play(s); }},
        {"size", [](State& s, Words& w) { return resize(s, w); }},
        {"picture", [](State& s, Words& w) { return writePicture(s, w.rest); }},
        {"window", [](State& s, Words& w) { return writeTo<request::WriteWindow>(s, "window", w.rest); }},
        {"report", [](State& s, Words& w) { return writeTo<request::WriteReport>(s, "report", w.rest); }},
        {"copy", [](State& s, Words& w) { return copy(s, w.next()); }},
    };
    return all;
}

// Resets options that are refused without an environment.
void resetWithoutEnvironment(PictureOptions& o)
{
    if (o.environment != "none")
        return;
    o.environmentRotation = 0;
    o.environmentIntensity = 1;
    if (o.background == Background::sharp || o.background == Background::blurred)
        o.background.reset();
}

Status performOne(State& state, const std::string& line)
{
    Words words{line};
    const std::string command = words.next();
    if (const auto moved = performCamera(state, command, words))
        return *moved;
    const auto known = commandTable().find(command);
    return known == commandTable().end() ? usageError(fmt::format("expected a viewer command; found '{}'", command))
                                         : known->second(state, words);
}

} // namespace

Status perform(State& state, const std::string& line)
{
    Status done = performOne(state, line);
    resetWithoutEnvironment(state.picture);
    return done;
}

} // namespace cotan::viewer
