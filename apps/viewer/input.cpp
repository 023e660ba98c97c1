#include "input.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "camera.hpp"
#include "commands.hpp"
#include "cotan/inspect.hpp"

namespace cotan::viewer {

namespace {

constexpr float kClick = 4;             // maximum pointer motion of a click, pixels
constexpr float kDegreesAPixel = 0.35f; // of rotation
constexpr float kGrip = 8;              // pixels beside the divider that grab it
constexpr const char* kFlyKeys = "wasdqe";
constexpr double kTurntable = 24; // degrees per second

void run(State& state, const std::string& command)
{
    const Status done = perform(state, command);
    if (!done)
        state.problem = done.error().message;
    if (!done || command.starts_with("report ") || command.starts_with("window ")) // they write the current messages
        return;
    state.problem.clear();
    state.message.clear();
}

bool flying(const State& state) { return state.held == "right" && !state.keysDown.empty(); }

void drag(State& state, glm::vec2 delta)
{
    Event held;
    held.word = state.held;
    const std::string button = bareWord(held);
    if (state.holdsDivider) {
        state.divider = std::clamp(state.pointer.x / float(std::max(1, state.size.x)), 0.0f, 1.0f);
        return;
    }
    state.turning = false;
    if (button == "left" && holds(held, "shift"))
        run(state, fmt::format("turn-light {}", delta.x * kDegreesAPixel));
    else if (flying(state))
        run(state, fmt::format("look {} {}", delta.x * kDegreesAPixel, -delta.y * kDegreesAPixel));
    else if (button == "left" && !holds(held, "ctrl"))
        run(state, fmt::format("orbit {} {}", -delta.x * kDegreesAPixel, delta.y * kDegreesAPixel));
    else
        run(state, fmt::format("pan {} {}", delta.x, delta.y));
    state.moving = true;
}

void press(State& state, const Event& event)
{
    state.held = event.word;
    state.pressedAt = state.pointer;
    state.dragged = false;
    state.holdsDivider = state.compare == Compare::divider && bareWord(event) == "left"
        && std::abs(state.pointer.x - state.divider * float(state.size.x)) <= kGrip;
}

void release(State& state)
{
    const bool clicked = state.held == "left" && !state.dragged && !state.holdsDivider;
    state.held.clear();
    state.holdsDivider = false;
    state.moving = false;
    if (!clicked || !state.model)
        return;
    if (const auto hit = pick(state.model->scene, state.camera, state.size, state.pointer)) {
        setPivot(state.camera, hit->position);
        state.cameraMoved = true;
    }
}

void playOn(State& state, double seconds)
{
    double& time = state.picture.time;
    time += seconds * double(state.rate);
    if (const GltfAnimation* animation = animationOf(state)) {
        const double length = animation->seconds;
        if (state.loops)
            time = length > 0 ? std::fmod(time, length) : 0;
        else if (time >= length) {
            time = length;
            state.playing = false;
        }
    }
    state.requests.push_back(request::Pose{});
}

} // namespace

void apply(State& state, const Event& event)
{
    switch (event.kind) {
    case EventKind::move: {
        const glm::vec2 to{event.x, event.y}, delta = to - state.pointer;
        state.pointer = to;
        if (state.held.empty())
            break;
        state.dragged = state.dragged || glm::length(to - state.pressedAt) > kClick;
        if (state.dragged || state.holdsDivider)
            drag(state, delta);
        break;
    }
    case EventKind::press: press(state, event); break;
    case EventKind::release: release(state); break;
    case EventKind::scroll:
        zoomTo(state.camera, std::pow(0.85f, std::clamp(event.y, -20.0f, 20.0f)), state.pointer, state.size);
        state.cameraMoved = true;
        break;
    case EventKind::key: {
        const std::string bare = bareWord(event);
        if (state.held == "right" && bare.size() == 1 && std::string(kFlyKeys).find(bare) != std::string::npos) {
            if (std::ranges::find(state.keysDown, bare) == state.keysDown.end())
                state.keysDown.push_back(bare);
            break;
        }
        const std::string command = commandOfKey(state, event.word);
        if (!command.empty())
            run(state, command);
        break;
    }
    case EventKind::keyUp: std::erase(state.keysDown, bareWord(event)); break;
    case EventKind::drop: run(state, "drop " + event.word); break;
    case EventKind::resize: state.size = glm::ivec2(int(event.x), int(event.y)); break;
    case EventKind::close: run(state, "quit"); break;
    case EventKind::command: run(state, event.word); break;
    case EventKind::text:
    case EventKind::wait: break;
    }
}

void advance(State& state, double seconds)
{
    if (flying(state) && state.model && !state.model->box.empty()) {
        glm::vec3 by{0};
        const auto down = [&](const char* key) {
            return std::ranges::find(state.keysDown, key) != state.keysDown.end();
        };
        by.x = float(down("d")) - float(down("a"));
        by.y = float(down("e")) - float(down("q"));
        by.z = float(down("w")) - float(down("s"));
        const float size = glm::length(state.model->box.high - state.model->box.low);
        fly(state.camera, by * size * state.speed * float(seconds));
        state.cameraMoved = true;
        state.moving = true;
    }
    if (state.turning && seconds > 0)
        (void)perform(state, fmt::format("turn {}", seconds * kTurntable)); // nothing to turn is no error
    if (state.playing && seconds > 0)
        playOn(state, seconds);
}

} // namespace cotan::viewer
