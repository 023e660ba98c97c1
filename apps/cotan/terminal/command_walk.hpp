// Helpers shared by the completion generators: iteration over all commands, and short forms of help texts.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "terminal/command_help.hpp"

namespace cotan::app {

// Calls `visit` for the tool with "", and for each command with its words after the tool's name: "map convert".
void walk(const CommandHelp& tool, const std::function<void(const std::string&, const CommandHelp&)>& visit);

// The beginning of a help text, short enough for a completion list.
std::string shortHelp(std::string_view help);

std::string joined(const std::vector<std::string>& words, std::string_view between);
// Replaces all occurrences of `from` by `to`.
std::string replaced(std::string text, std::string_view from, std::string_view to);
// Puts single quotes of a shell around `text`; single quotes within become `escaped`.
std::string inQuotes(const std::string& text, std::string_view escaped);

} // namespace cotan::app
