// Commands that move the camera, and the light that is pinned to it.
#include <cmath>

#include "camera.hpp"
#include "command_words.hpp"
#include "core/try.hpp"
#include "cotan/render.hpp"
#include "scene/geometry.hpp"

namespace cotan::viewer {

namespace {

constexpr float kRadians = 0.017453293f;

void rotateLight(PictureOptions& o, double degrees)
{
    const double rotated = std::remainder(o.environmentRotation + degrees, 360.0);
    o.environmentRotation = std::round(rotated * 1000) / 1000;
}

// Called after each change of the camera. Rotates the light along if it is pinned to the camera.
Status afterCameraMove(State& state)
{
    state.cameraMoved = true;
    if (state.lightPinned) {
        const float azimuth = azimuthOf(state.camera);
        rotateLight(state.picture, double(azimuth - state.pinnedAt));
        state.pinnedAt = azimuth;
    }
    return Done{};
}

// Turns the model counter-clockwise, seen from above: the camera goes the other way about the middle of the model.
Status turnModel(State& state, Words& words)
{
    COTAN_TRY(degrees, words.number("turn"));
    if (!state.model || state.model->box.empty())
        return expected("turn", "a model", "none");
    const Scene& scene = state.model->scene;
    const Bounds box = scene.reach.empty() ? state.model->box : framedBounds(scene); // does not move with an animation
    turnAbout(state.camera, box.centre(), -*degrees * kRadians);
    return afterCameraMove(state);
}

Status setCamera(State& state, const std::string& words)
{
    if (!state.model)
        return expected("camera", "a model", "none");
    COTAN_TRY(camera, parseCamera(words, state.model->scene, state.size.x, state.size.y));
    state.camera = *camera;
    return afterCameraMove(state);
}

Status goToProblemArea(State& state, Words& words)
{
    COTAN_TRY(number, words.number("hot-spot"));
    const std::size_t count = state.problemAreas ? state.problemAreas->size() : 0;
    if (*number < 0 || std::size_t(*number) >= count)
        return expected("hot-spot",
                        count > 0 ? fmt::format("0 to {}", count - 1) : "a previous search for problem areas",
                        fmt::format("{}", *number));
    state.problemArea = std::size_t(*number);
    const ProblemArea& area = (*state.problemAreas)[*state.problemArea];
    state.camera = area.camera;
    state.show = std::string(area.view);
    state.compare = Compare::off; // comparisons would hide the view
    if (area.storedTangents) {
        state.a.frame = "mikktspace";
        state.a.tangents = TangentOrigin::stored;
    }
    return afterCameraMove(state);
}

using Numbers = std::vector<float>;

Result<Numbers> numbersOf(Words& words, const char* command, int count)
{
    Numbers all;
    for (int i = 0; i < count; ++i) {
        COTAN_TRY(number, words.number(command));
        all.push_back(*number);
    }
    return all;
}

// Camera commands with numeric arguments.
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

} // namespace

float azimuthOf(const Camera& camera)
{
    const glm::vec3 back = camera.eye - camera.target;
    return std::atan2(back.x, back.z) / kRadians;
}

std::optional<Status> performCamera(State& state, const std::string& command, Words& words)
{
    for (const Motion& motion : kMotions)
        if (command == motion.name) {
            COTAN_TRY(numbers, numbersOf(words, motion.name, motion.count));
            motion.move(state, *numbers);
            return afterCameraMove(state);
        }
    if (command == "reset") {
        resetCamera(state);
        return Done{};
    }
    if (command == "orthographic") {
        setOrthographic(state.camera, !state.camera.orthographic);
        return afterCameraMove(state);
    }
    if (command == "see")
        return viewFrom(state.camera, words.rest)
            ? afterCameraMove(state)
            : expected("see", "front, back, left, right, top or bottom", words.rest);
    if (command == "camera")
        return setCamera(state, words.rest);
    if (command == "hot-spot")
        return goToProblemArea(state, words);
    if (command == "turn")
        return turnModel(state, words);
    if (command == "turn-light") {
        COTAN_TRY(degrees, words.number("turn-light"));
        rotateLight(state.picture, double(*degrees));
        return Done{};
    }
    return std::nullopt;
}

} // namespace cotan::viewer
