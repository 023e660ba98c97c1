// Work in a process of its own, so that a driver that crashes takes nothing with it.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace cotan::cost {

// One line to the parent, at once. Line breaks in it become blanks.
using LineWriter = std::function<void(std::string_view)>;

// Runs `work` in a child and hands each line that it writes to `line`. What the child prints to standard error is
// dropped: drivers speak there. Returns how the child ended: empty where it ended well, else words that follow a name,
// such as "crashed (signal 11)". A child that writes no line for `seconds` is ended.
std::string inChild(int seconds, const std::function<void(const LineWriter&)>& work,
                    const std::function<void(std::string_view)>& line);

} // namespace cotan::cost
