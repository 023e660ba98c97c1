// Generates the help files of an installed tool: manual pages and shell completions.
#pragma once

#include <string>
#include <vector>

#include "terminal/command_help.hpp"

namespace cotan::app {

struct HelpFile {
    std::string path; // below share/
    std::string text;
};

// All files: man/man1/TOOL.1, a page TOOL-COMMAND.1 for each command, completions for bash, zsh and fish.
// version: "1.2.3". repository: URL that the tool's page names for reports of faults; empty: it names none.
std::vector<HelpFile> helpFiles(const CommandHelp& tool, const std::string& version,
                                const std::string& repository = {});

// The manual page of a command. path: the commands from the tool to this command; the first is the tool.
std::string manPage(const std::vector<const CommandHelp*>& path, const std::string& version,
                    const std::string& repository = {});

std::string bashCompletion(const CommandHelp& tool);
std::string zshCompletion(const CommandHelp& tool);
std::string fishCompletion(const CommandHelp& tool);

} // namespace cotan::app
