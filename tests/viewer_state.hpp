// A viewer's state to try things on, without a window.
#pragma once

#include <gtest/gtest.h>

#include "commands.hpp"
#include "event.hpp"
#include "input.hpp"
#include "scene/bounds.hpp"
#include "state.hpp"

namespace cotan::viewer {

// The built-in scene.
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

// Events as text.
inline void send(State& state, const std::string& text)
{
    const auto events = eventsOf(text, "text");
    ASSERT_TRUE(events) << events.error().message;
    for (const Event& event : *events)
        apply(state, event);
}

} // namespace cotan::viewer
