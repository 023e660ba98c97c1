// Everything that the viewer can be told to do, as one line of text each. Keys, menus, sliders, the command line's --do
// and played sessions all end here.
#pragma once

#include <string>
#include <vector>

#include "cotan/result.hpp"
#include "interface.hpp"
#include "state.hpp"

namespace cotan::viewer {

// Does what the line says. What takes longer than a change of the state becomes a request. Errors: ErrorKind::usage,
// with what was expected and found; the state stays as it was.
//
//   open FILE | reload | next | previous | normal-map FILE | environment FILE | material picture dropped: drop FILE
//   frame NAME | show NAME | set OPTION VALUE | camera front|fit|N|WORDS | see front|back|left|right|top|bottom
//   orthographic | reset | orbit X Y (degrees) | pan X Y (pixels) | zoom FACTOR | fly X Y Z | turn-light DEGREES
//   compare off|divider|flip|angle | flip | divider SHARE | second frame|tangents|normal-map|convention VALUE | swap
//   tangents NAME | convention WORDS | toggle NAME | scale X | size W H | play | picture [FILE [W H]] | window FILE
//   report FILE | copy command|camera | paste | choose | find-hot-spots | hot-spot N | lose-surface | quit
Status perform(State& state, const std::string& line);

// One thing that a key does or a menu offers.
struct Entry {
    std::string menu, label, key, command; // an empty command: a line between entries
    bool on = false, usable = true;
    std::string standing; // of what is neither on nor off: its value, for the cheat sheet
    std::string submenu;  // of the menu, where it stands with the entries beside it; empty: none
};

// Lines that a menu or submenu has at most: so many fit under each other in 720 pixels with text of 200 %.
inline constexpr std::size_t kMaxLines = 17;

// In the order of the menus.
std::vector<Entry> entriesOf(const State& state);

// A key as it is written on a keyboard: "Ctrl+O" of "ctrl+o", "Num 1" of "kp1".
std::string keyLabel(const std::string& key);

// The command of a key, such as "ctrl+c"; empty where it has none.
std::string commandOfKey(const State& state, const std::string& key);

// All that the window shows beside the picture.
Interface interfaceOf(const State& state);

} // namespace cotan::viewer
