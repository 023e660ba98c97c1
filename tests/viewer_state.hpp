// States of the viewer for tests, without a window.
#pragma once

#include <gtest/gtest.h>

#include "commands.hpp"
#include "event.hpp"
#include "input.hpp"
#include "scene/geometry.hpp"
#include "state.hpp"

namespace cotan::viewer {

// A state with the built-in scene.
inline State withModel()
{
    State state;
    auto model = std::make_shared<Model>();
    auto scene = openModel(state.picture);
    model->scene = std::move(*scene);
    model->box = bounds(model->scene);
    model->number = 1;
    state.model = std::move(model);
    resetCamera(state);
    return state;
}

// A state with the built-in scene, which is loaded once.
inline State builtIn()
{
    static const State state = withModel();
    return state;
}

// A state with the built-in scene and a surface under the pointer, all of whose numbers differ.
inline State probed()
{
    State s = builtIn();
    PickedPoint hit;
    hit.mesh = 3;
    hit.triangle = 17;
    hit.position = s.camera.target;
    hit.depth = glm::length(s.camera.target - s.camera.eye);
    s.probe.hit = hit;
    Probed& p = s.probe.surface;
    p.normal = {0, 0, 1};
    p.t = {2, 0, 0};
    p.b = {0, 0.5f, 0};
    p.storedTangent = {0.6f, 0.8f, 0};
    p.w = -1;
    p.hasUv = true;
    p.uv = {0.25f, 0.75f};
    p.texel = {5, 9};
    s.probe.degrees = 12.345f;
    s.statisticsOf = "triangle against exact";
    s.pointer = {100, 60};
    return s;
}

// Applies events that are given as text.
inline void send(State& state, const std::string& text)
{
    const auto events = eventsOf(text, "text");
    ASSERT_TRUE(events) << events.error().message;
    for (const Event& event : *events)
        apply(state, event);
}

} // namespace cotan::viewer
