// What happens in the window, as a value that is written to a file and read from one.
#pragma once

#include <string>
#include <vector>

#include "cotan/result.hpp"

namespace cotan::viewer {

enum class EventKind {
    move,    // the pointer: x, y in pixels of the window from its top left corner
    press,   // word: left, right or middle, with what is held before it: "shift+left"
    release, // likewise
    scroll,  // x, y: steps to the right and up
    key,     // word: "a", "1", "f12", "tab", "ctrl+c": pressed, or repeated
    keyUp,   // word: the same
    text,    // word: what was typed
    drop,    // word: the path of a file
    resize,  // x, y: pixels of the window
    close,   // the window's own button
    command, // word: a command of the viewer (commands.hpp)
    wait,    // played only: until all that was asked for is drawn
};

struct Event {
    double seconds = 0; // from the start; below 0: of a command that was chosen in the interface
    EventKind kind = EventKind::wait;
    float x = 0, y = 0;
    std::string word;

    friend bool operator==(const Event&, const Event&) = default;
};

// One line, such as "0.250 move 120 80", "0.5 do frame smooth" (a command) or "1 wait".
std::string toText(const Event& event);

// Events of lines like these; empty lines and those that begin with # count as nothing. A line without a time happens
// at that of the line before. Errors: ErrorKind::input with name, the number of the line, expected, found.
Result<std::vector<Event>> eventsOf(const std::string& text, const std::string& name);

// What is held is told before the name: "ctrl+shift+left" has "ctrl" and "shift".
bool holds(const Event& event, const char* modifier);
std::string bareWord(const Event& event); // "left" of it

} // namespace cotan::viewer
