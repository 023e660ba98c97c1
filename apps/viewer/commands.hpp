// Every command of the viewer as one line of text. Keys, menus, sliders, the command line's --do and played sessions
// all use these.
#pragma once

#include <string>
#include <vector>

#include "cotan/result.hpp"
#include "interface.hpp"
#include "state.hpp"

namespace cotan::viewer {

// Performs the command in `line`. Anything slower than a change of the state becomes a request. Errors:
// ErrorKind::usage, with what was expected and found; the state stays unchanged.
//
//   open FILE | drop FILE | high [FILE] | reload | next | previous | normal-map FILE | orthographic | reset
//   frame NAME | show NAME | set OPTION VALUE | camera front|fit|N|WORDS | see front|back|left|right|top|bottom
//   orbit X Y, look X Y (degrees) | pan X Y (pixels) | zoom FACTOR | fly X Y Z | turn, turn-light DEGREES
//   compare off|divider|flip|angle | flip | divider FRACTION | swap | toggle NAME | scale X | size W H | play
//   second frame|tangents|normal-map|convention|high VALUE | tangents NAME | convention WORDS | picture [FILE [W H]]
//   window FILE | report FILE | copy command|camera | paste | choose [COMMAND] | find-hot-spots | hot-spot N
//   lose-surface | run TASK (tasks.hpp) | stop | quit
Status perform(State& state, const std::string& line);

// A command offered by a menu, by a key, or by both.
struct Entry {
    std::string menu, label, key, command; // an empty command is a separator
    bool on = false, usable = true;
    std::string submenu; // submenu of this and adjacent entries with the same name; empty: none
};

// Maximum lines of a menu or submenu: as many fit into 720 pixels at a text scale of 200 %.
inline constexpr std::size_t kMaxLines = 17;

// In menu order.
std::vector<Entry> entriesOf(const State& state);

// "high: statue_high.obj", with the number of further files.
std::string highName(const State& state);

// Formats a key as it is labelled on keyboards: "Ctrl+O" for "ctrl+o", "Num 1" for "kp1".
std::string keyLabel(const std::string& key);

// The command of a key, such as "ctrl+c"; empty if there is none.
std::string commandOfKey(const State& state, const std::string& key);

// Everything that the window shows besides the image.
Interface interfaceOf(const State& state);

} // namespace cotan::viewer
