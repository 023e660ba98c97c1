// Completion for fish.
#include "help/help_files.hpp"

#include "terminal/command_walk.hpp"

namespace cotan::app {

namespace {

constexpr const char* kFishBegin = R"(# Completion of TOOL for fish; made from the same table as `TOOL --help`.
function __TOOL_at -d 'Whether the words so far name this command'
    set -l at ''
    for word in (commandline -opc)[2..]
        contains -- "$at/$word" COMMANDS; or break
        set at (string trim -- "$at $word")
    end
    test "$at" = "$argv[1]"
end
complete -c TOOL -f
)";

std::string quotedForFish(const std::string& text) { return inQuotes(replaced(text, "\\", "\\\\"), "\\'"); }

std::string optionLine(const std::string& start, const OptionHelp& option)
{
    std::string line = start;
    for (const std::string& name : option.names)
        line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    const std::string words = joined(option.words, " ");
    switch (option.kind) {
    case ValueKind::none: break;
    case ValueKind::word: line += words.empty() ? " -x" : " -x -a '" + words + "'"; break;
    case ValueKind::list:
        line += " -x -a '(__fish_complete_list , \"string split \\' \\' \\'" + words + "\\'\")'";
        break;
    case ValueKind::file: line += words.empty() ? " -r -F" : " -r -F -a '" + words + "'"; break;
    case ValueKind::folder: line += " -x -a '(__fish_complete_directories)'"; break;
    }
    return line + " -d " + quotedForFish(shortHelp(option.help)) + "\n";
}

} // namespace

std::string fishCompletion(const CommandHelp& tool)
{
    std::vector<std::string> commands;
    std::string text;
    walk(tool, [&](const std::string& path, const CommandHelp& command) {
        const std::string start = "complete -c TOOL -n '__TOOL_at \"" + path + "\"'";
        for (const CommandHelp& inner : command.commands) {
            commands.push_back(quotedForFish(path + "/" + inner.name));
            text += start + " -a " + inner.name + " -d " + quotedForFish(shortHelp(inner.summary)) + "\n";
        }
        for (const OptionHelp& option : command.options)
            text += !option.positional ? optionLine(start, option)
                : option.words.empty() ? start + " -F\n"
                                       : start + " -a '" + joined(option.words, " ") + "'\n";
    });
    return replaced(replaced(kFishBegin, "COMMANDS", joined(commands, " ")) + text, "TOOL", tool.name);
}

} // namespace cotan::app
