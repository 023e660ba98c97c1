// What the writers of completion share: a tool's commands one by one, and short forms of what their help says.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "terminal/command_help.hpp"

namespace cotan {

// Calls `visit` for the tool, with "", and for each command with its words behind the tool's name: "map convert".
void walk(const CommandHelp& tool, const std::function<void(const std::string&, const CommandHelp&)>& visit);

// The beginning of a help text that fits beside a word in a list.
std::string shortHelp(std::string_view help);

std::string joined(const std::vector<std::string>& words, std::string_view between);
// With all of `from` replaced by `to`.
std::string replaced(std::string text, std::string_view from, std::string_view to);
// In single quotes of a shell; escaped: what stands for a single quote among them.
std::string inQuotes(const std::string& text, std::string_view escaped);

} // namespace cotan
