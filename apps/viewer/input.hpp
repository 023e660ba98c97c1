// Events of the pointer and the keys, as changes of the state.
#pragma once

#include "event.hpp"
#include "state.hpp"

namespace cotan::viewer {

// What it cannot do becomes state.problem.
void apply(State& state, const Event& event);

// What goes on by itself: flying, playing. seconds: since the last call.
void goOn(State& state, double seconds);

} // namespace cotan::viewer
