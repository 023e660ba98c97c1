// What the menu "Check and fix" does: commands of the tool with their defaults, which run beside the window.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "state.hpp"

namespace cotan::viewer {

// A task as it starts.
struct Task {
    std::string title;                // "Check model"
    std::vector<std::string> words;   // of the tool's command line, after its name
    std::vector<std::string> shows{}; // commands that show what it made, once it has succeeded
};

struct TaskEntry {
    const char *name, *label;           // in `run NAME`, and in the menu; both null: a separator
    const char* needs;                  // what must be open, for the error
    bool (*usable)(const State& state); // whether it is
    Task (*make)(const State& state);   // looks for a free name of the output, beside the file that it comes from
    const char* submenu = "";           // empty: in the menu itself
};

// In menu order.
std::span<const TaskEntry> taskEntries();

// Errors: ErrorKind::usage for an unknown name, and if what the task needs is not open, or another one runs.
Result<Task> taskNamed(const State& state, const std::string& name);

// "cotan lint model.glb"
std::string commandLine(const Task& task);

} // namespace cotan::viewer
