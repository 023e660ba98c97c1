// Window events as values that can be written to and read from files.
#pragma once

#include <string>
#include <vector>

#include "cotan/result.hpp"

namespace cotan::viewer {

enum class EventKind {
    move,    // pointer: x, y in window pixels from the top left corner
    press,   // word: left, right or middle, after the modifiers held: "shift+left"
    release, // like press
    scroll,  // x, y: steps to the right and up
    key,     // word: "a", "1", "f12", "tab", "ctrl+c"; pressed or repeated
    keyUp,   // word: like key
    text,    // word: the text typed
    drop,    // word: the path of a file
    resize,  // x, y: window size in pixels
    close,   // the window's close button
    command, // word: a command of the viewer (commands.hpp)
    wait,    // only in played sessions: waits until everything requested is drawn
};

struct Event {
    double seconds = 0; // since the start; negative for a command chosen in the interface
    EventKind kind = EventKind::wait;
    float x = 0, y = 0;
    std::string word;

    friend bool operator==(const Event&, const Event&) = default;
};

// Formats a line, such as "0.250 move 120 80", "0.5 do frame smooth" (a command) or "1 wait".
std::string toText(const Event& event);

// Parses such lines; empty lines and lines that begin with # are ignored. A line without a time has the time of the
// line before. Errors: ErrorKind::input with `name`, the line number, what was expected and what was found.
Result<std::vector<Event>> eventsOf(const std::string& text, const std::string& name);

// Takes the first word, and the spaces around it, from `rest`; empty if there is none.
std::string nextWord(std::string& rest);

// Modifiers precede the name: "ctrl+shift+left" holds "ctrl" and "shift".
bool holds(const Event& event, const char* modifier);
std::string bareWord(const Event& event); // "left" in that example

} // namespace cotan::viewer
