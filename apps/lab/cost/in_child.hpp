// Runs work in a child process, so that a crashing driver does not take the program with it.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace cotan::cost {

// Sends one line to the parent immediately. Line breaks in it become spaces.
using LineWriter = std::function<void(std::string_view)>;

// Runs `work` in a child process and passes each line it writes to `line`. The child's standard error, where drivers
// print messages, is discarded. Returns "" if the child succeeded, else a phrase that follows a name, such as "crashed
// (signal 11)". A child that writes no line for `seconds` is ended.
std::string inChild(int seconds, const std::function<void(const LineWriter&)>& work,
                    const std::function<void(std::string_view)>& line);

} // namespace cotan::cost
