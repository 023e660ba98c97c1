#include "state.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "camera.hpp"
#include "core/parse_number.hpp"
#include "cotan/render.hpp"
#include "files.hpp"
#include "image/format_table.hpp"
#include "picture/option_table.hpp"
#include "scene/geometry.hpp"
#include "settings.hpp"
#include "terminal/shell_words.hpp"

namespace cotan::viewer {

namespace {

// Whether only the window shows this image: it has both models, detail of several files, or the light of one model on
// the other.
bool needsWindow(const State& state, bool both, bool second)
{
    return (both && (showsHigh(state, false) || showsHigh(state, true)))
        || (showsHigh(state, second)
            && (state.high.size() > 1 || !state.model || !state.model->scene.lights.empty()
                || !state.highModel->scene.lights.empty()));
}

std::string textOf(const glm::vec3& v)
{
    return fmt::format("{:.4f} {:.4f} {:.4f}", v.x + 0.0f, v.y + 0.0f, v.z + 0.0f);
}

} // namespace

const GltfAnimation* animationOf(const State& state)
{
    const std::string& wanted = state.picture.animation;
    if (!state.model || wanted.empty())
        return nullptr;
    const auto& all = state.model->animations;
    const auto named = std::ranges::find(all, wanted, &GltfAnimation::name);
    if (named != all.end())
        return &*named;
    std::size_t number = 0;
    return parseNumber(std::string_view(wanted), number) && number < all.size() ? &all[number] : nullptr;
}

Up highUpOf(const State& state) { return state.highUp.value_or(state.picture.up); }

bool showsHigh(const State& state, bool second) { return (second ? state.b : state.a).high && state.highModel; }

Side sideOf(const State& state, bool second)
{
    Side side = second ? state.b : state.a;
    if (showsHigh(state, second)) {
        side = {};
        side.high = true;
    }
    return side;
}

void closeHigh(State& state)
{
    state.highModel.reset();
    state.high.clear();
    state.a.high = state.b.high = false;
}

PictureOptions optionsOf(const State& state, bool second)
{
    PictureOptions o = state.picture;
    o.size = {std::max(1, state.size.x), std::max(1, state.size.y)};
    if (state.cameraMoved)
        o.camera = formatCamera(state.camera);
    const Side side = sideOf(state, second);
    o.show = side.high && state.show == "mask" ? "clay" : state.show;
    o.use = showsLight(o.show) ? PictureUse::shown : PictureUse::data;
    if (state.compare == Compare::angle)
        o.use = PictureUse::data;
    if (side.high) {
        o.maps = {};
        o.model = state.high.front();
        o.up = highUpOf(state);
        for (std::string* word : {&o.shape, &o.variant, &o.animation})
            word->clear();
        o.time = 0;
        o.camera = formatCamera(state.camera); // others would frame this model
    }
    o.tangents = side.tangents;
    o.maps.normal = side.normalMap;
    o.maps.convention = side.convention;
    if (o.maps.height.empty()) // the depth is kept for the next height map
        o.maps.heightDepth.reset();
    return o;
}

void forgetProblemAreas(State& state)
{
    state.problemAreas.reset();
    state.problemArea.reset();
    if (state.problemAreasShown)
        state.requests.push_back(request::FindProblemAreas{});
}

void resetCamera(State& state)
{
    state.cameraMoved = false;
    if (!state.model)
        return;
    PictureOptions o = optionsOf(state, false);
    const auto view = viewOf(o, state.model->scene);
    if (!view)
        return;
    state.camera = view->camera;
    state.camera.name.clear();
    // The target of a file's camera may be outside the model, so the pivot is moved to the model's depth.
    const glm::vec3 forward = glm::normalize(state.camera.target - state.camera.eye);
    if (!state.model->box.empty()) {
        const float depth = glm::dot(state.model->box.centre() - state.camera.eye, forward);
        const bool own = !o.camera.empty() && !isLetter(o.camera[0]); // given by eye and target
        if (own && depth > 0)
            state.camera.target = state.camera.eye + forward * depth;
    }
}

std::string commandLine(const State& state, const std::string& file, glm::ivec2 size)
{
    const bool both = state.compare == Compare::angle || state.compare == Compare::divider;
    bool second = state.compare == Compare::flip && state.second;
    const bool views = needsWindow(state, both, second);
    if (views)
        second = state.a.high;
    const PictureOptions o = optionsOf(state, second), usual;
    const Side side = sideOf(state, second);
    const bool compares = both && !views;
    std::string text = views ? "cotan view" : compares ? "cotan compare" : "cotan render";
    const auto add = [&](const std::string& name, const std::string& value) {
        text += " --" + name + " " + app::quoted(value);
    };
    if (!o.model.empty())
        text += " " + app::quoted(o.model);
    if (!views)
        text += " -o " + app::quoted(file);
    text += fmt::format(" --size {}x{}", size.x, size.y);
    for (std::size_t i = 0; views && i < state.high.size(); ++i)
        add("high", state.high[i]);
    if (views && highUpOf(state) != state.picture.up)
        add("high-up", wordOf(kUps, highUpOf(state)));
    if (views && state.compare != Compare::divider)
        add("do", state.compare == Compare::flip ? "flip" : "compare " + wordOf(kCompares, state.compare));
    if (compares)
        add("frames", state.a.frame + "," + state.b.frame);
    else if (side.frame != kAutoFrame)
        add("frame", side.frame);
    if (!compares && o.show != "shaded")
        add("view", o.show);
    for (const PictureOption& option : pictureOptions()) {
        if (option.name == "mask" && (compares || o.show != "mask")) // it would be ignored
            continue;
        std::string value = option.name == "size" || option.name == "view" ? option.word(usual) : option.word(o);
        if (option.name == "exposure" && value == kAutoExposure && state.metered > 0 && o.use == PictureUse::shown
            && !keepsFloats(file))
            value = fmt::format("{}", state.metered);
        if (option.flag && value == "on")
            text += " --" + option.name;
        else if (value != option.word(usual))
            add(option.name, value);
    }
    return text;
}

std::string reportOf(const State& state)
{
    std::string text;
    const auto add = [&](const std::string& name, const std::string& value) {
        text += fmt::format("{}: {}\n", name, value);
    };
    add("model",
        !state.picture.model.empty()       ? fileName(state.picture.model)
            : !state.picture.shape.empty() ? state.picture.shape
                                           : "built-in");
    add("triangles", state.model ? fmt::format("{}", trianglesDrawn(state.model->scene)) : "none");
    add("size", fmt::format("{}x{}", state.size.x, state.size.y));
    add("view", state.show);
    for (const bool second : {false, true}) {
        const Side side = sideOf(state, second);
        add(second ? "second" : "first",
            fmt::format("{}{} {} {} {}", side.high ? "high " : "", side.frame, wordOf(kTangentOrigins, side.tangents),
                        side.normalMap.empty() ? "-" : fileName(side.normalMap),
                        side.convention.empty() ? "-" : side.convention));
    }
    add("high", state.highModel ? fmt::format("{} triangles", trianglesDrawn(state.highModel->scene)) : "none");
    add("compare", wordOf(kCompares, state.compare) + (state.second ? " second" : ""));
    add("divider", fmt::format("{:.3f}", state.divider));
    add("camera moved", state.cameraMoved ? "yes" : "no");
    add("eye", textOf(state.camera.eye));
    add("pivot", textOf(state.camera.target));
    add("lens",
        state.camera.orthographic ? fmt::format("orthographic {:.4f}", state.camera.verticalExtent)
                                  : fmt::format("{:.2f} degrees", state.camera.verticalFieldOfView * 57.2957795));
    for (const Setting& setting : settings())
        add(setting.option.name, valueOf(setting, state.picture));
    add("playing", state.playing ? "yes" : "no");
    add("turning", state.turning ? "yes" : "no");
    add("metered", fmt::format("{:.4f}", state.metered));
    add("light pinned", state.lightPinned ? "yes" : "no");
    add("interface", state.interfaceShown ? "shown" : "hidden");
    add("cheat sheet", state.cheatSheet ? "shown" : "hidden");
    add("look", state.dark ? "dark" : "light");
    add("degrees", state.statisticsOf.empty() ? "none" : state.statisticsOf + ": " + toText(state.statistics));
    if (const auto& hit = state.probe.hit) {
        const Probed& p = state.probe.surface;
        add("under the pointer",
            fmt::format("mesh {} triangle {} at {}", hit->mesh, hit->triangle, textOf(hit->position)));
        add("uv", fmt::format("{:.4f} {:.4f} texel {} {}", p.uv.x, p.uv.y, p.texel.x, p.texel.y));
        add("t", textOf(p.t));
        add("b", textOf(p.b));
        add("n", textOf(p.normal));
        add("w", fmt::format("{:+d}", p.w));
        add("stored tangent", p.storedTangent == glm::vec3(0) ? "none" : textOf(p.storedTangent));
        add("degrees there", state.probe.degrees < 0 ? "none" : fmt::format("{:.2f}", state.probe.degrees));
    }
    if (!state.result.title.empty())
        add("result", state.result.title);
    for (const std::string& line : state.result.lines)
        add("result line", line);
    if (state.problemAreas) {
        add("problem areas", fmt::format("{}", state.problemAreas->size()));
        for (const ProblemArea& area : *state.problemAreas)
            add("problem area", area.text);
    }
    add("loads", fmt::format("{} failed {}", state.loads, state.failedLoads));
    add("problem", state.problem.empty() ? "none" : state.problem);
    return text;
}

} // namespace cotan::viewer
