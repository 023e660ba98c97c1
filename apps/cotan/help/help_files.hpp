// The help of a tool as the files that an installed one comes with: the manual's pages, and what shells complete.
#pragma once

#include <string>
#include <vector>

#include "terminal/command_help.hpp"

namespace cotan {

struct HelpFile {
    std::string path; // below share/
    std::string text;
};

// All of them: man/man1/TOOL.1 and a page for each command, TOOL-COMMAND.1, and the completion of bash, zsh and fish.
// version: "1.2.3".
std::vector<HelpFile> helpFiles(const CommandHelp& tool, const std::string& version);

// The manual's page for a command. path: the commands from the tool to it; the first is the tool.
std::string manPage(const std::vector<const CommandHelp*>& path, const std::string& version);

std::string bashCompletion(const CommandHelp& tool);
std::string zshCompletion(const CommandHelp& tool);
std::string fishCompletion(const CommandHelp& tool);

} // namespace cotan
