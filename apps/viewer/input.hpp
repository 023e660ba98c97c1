// Applies pointer and key events to the state.
#pragma once

#include "event.hpp"
#include "state.hpp"

namespace cotan::viewer {

// Errors are stored in state.problem.
void apply(State& state, const Event& event);

// Advances continuous changes: flying, playing. seconds: since the last call.
void advance(State& state, double seconds);

} // namespace cotan::viewer
