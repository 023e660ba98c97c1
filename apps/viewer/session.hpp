// A viewer session, from opening the window to the last event.
#pragma once

#include <filesystem>
#include <vector>

#include "event.hpp"
#include "state.hpp"

namespace cotan::viewer {

struct SessionOptions {
    app::CommonOptions common;
    std::vector<Event> played; // replaces pointer and keys; played as fast as possible
    bool plays = false;        // also if there are no events
    std::filesystem::path record;
    std::filesystem::path program; // that runs tasks: this very program
    std::filesystem::path memory;  // where the state is kept between runs; empty: nowhere
};

// Runs until the user quits or all events are played. Errors: those of reading the first model if events are played or
// there is no window (otherwise the window shows them); those of openWindow; ErrorKind::input for the first played
// command that fails; ErrorKind::output if the recording cannot be written.
Status runSession(State state, const SessionOptions& options);

// Formats the interface settings, the light and the recent files as lines, and restores them from these lines unless
// options already differ from their defaults.
std::string memoryOf(const State& state);
void remember(const std::string& text, State& state);

// cotan/view.txt in the folder XDG_STATE_HOME or ~/.local/state; empty if there is no home folder.
std::filesystem::path memoryFile();

} // namespace cotan::viewer
