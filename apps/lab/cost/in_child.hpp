// Runs a program in a child process, so that a crashing driver does not take this one with it.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "files/sandbox/child.hpp"

namespace cotan::cost {

// Runs the program and passes each line it sends (ParentConnection) to `line`. Its standard error, where drivers print
// messages, is discarded. Returns "" if it succeeded, else a phrase that follows a name, such as "crashed (signal 11,
// Segmentation fault)". A child that sends nothing for `seconds` is ended.
std::string inChild(int seconds, const ChildProgram& program, const std::function<void(std::string_view)>& line);

} // namespace cotan::cost
