// The viewer from the first window to the last event.
#pragma once

#include <filesystem>
#include <vector>

#include "event.hpp"
#include "state.hpp"

namespace cotan::viewer {

struct SessionOptions {
    app::CommonOptions common;
    std::vector<Event> played; // instead of the pointer and the keys, as fast as they can be done
    bool plays = false;        // even where there are none
    std::filesystem::path record;
    std::filesystem::path memory; // where the state is kept between runs; empty: nowhere
    bool validation = false;      // messages of the validation layer are an error at the end
};

// Until someone quits, or all that is played is done. Errors: those of reading the first model where events are played
// or there is no window (else the window says them and stays); those of openWindow; ErrorKind::input for played
// commands that cannot be done, the first of them; ErrorKind::output where the recording cannot be written.
Status runSession(State state, const SessionOptions& options);

// The interface's part of the state, its light and the files that were opened, as lines; and back, as far as options
// are still at their defaults.
std::string memoryOf(const State& state);
void remember(const std::string& text, State& state);

// cotan/view.txt in the folder for state, XDG_STATE_HOME; empty without a home.
std::filesystem::path memoryFile();

} // namespace cotan::viewer
