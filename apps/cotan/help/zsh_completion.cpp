// Completion for zsh.
#include "help/help_files.hpp"

#include "terminal/command_walk.hpp"

namespace cotan::app {

namespace {

constexpr const char* kZshBegin = R"(#compdef TOOL
# Completion of TOOL for zsh; made from the same table as `TOOL --help`.

)";

std::string quotedForZsh(const std::string& text) { return inQuotes(text, "'\\''"); }

// Escapes characters that would end a part of an _arguments spec.
std::string escaped(std::string text)
{
    for (const char* c : {"\\", ":", "[", "]"})
        text = replaced(text, c, std::string("\\") + c);
    return text;
}

std::string functionOf(const std::string& path)
{
    return "_TOOL" + (path.empty() ? "" : "_" + replaced(path, " ", "_"));
}

std::string action(const OptionHelp& option)
{
    const std::string words = joined(option.words, " ");
    switch (option.kind) {
    case ValueKind::none: return "";
    case ValueKind::word: return words.empty() ? " " : "(" + words + ")";
    case ValueKind::list: return words.empty() ? " " : "_values -s , word " + words;
    case ValueKind::file: return words.empty() ? "_files" : "{compadd -- " + words + "; _files}";
    case ValueKind::folder: return "_files -/";
    }
    return "";
}

// One spec of _arguments for each name; a name excludes the others.
std::string specs(const OptionHelp& option)
{
    const std::string help = "[" + escaped(shortHelp(option.help)) + "]";
    const std::string value = option.kind == ValueKind::none ? "" : ":" + escaped(option.value) + ":" + action(option);
    std::string text;
    for (const std::string& name : option.names) {
        const std::string first = option.repeated ? "*"
            : option.names.size() > 1             ? "(" + joined(option.names, " ") + ")"
                                                  : "";
        text += " \\\n        "
            + quotedForZsh(first + name + (value.empty() || !name.starts_with("--") ? "" : "=") + help + value);
    }
    return text;
}

std::string operandSpec(const OptionHelp& option)
{
    const std::string what = option.words.empty() ? "_files" : "(" + joined(option.words, " ") + ")";
    const std::string first = option.repeated ? "*:" : option.required ? ":" : "::";
    return " \\\n        " + quotedForZsh(first + escaped(option.names[0]) + ":" + what);
}

// The function of a command with subcommands: completes their names, or calls the function of the one given.
std::string holder(const std::string& path, const CommandHelp& command, const std::string& arguments)
{
    std::string names, calls;
    for (const CommandHelp& inner : command.commands) {
        names += "                " + quotedForZsh(escaped(inner.name) + ":" + shortHelp(inner.summary)) + "\n";
        calls += "                " + inner.name + ") " + functionOf(path + (path.empty() ? "" : " ") + inner.name)
            + " ;;\n";
    }
    return functionOf(path)
        + "() {\n    local curcontext=\"$curcontext\" state line\n    local -a commands\n    _arguments -C" + arguments
        + " \\\n        ': :->command' '*:: :->words'\n    case $state in\n        command)\n            commands=(\n"
        + names + "            )\n            _describe -t commands command commands ;;\n        words)\n"
        + "            case $line[1] in\n" + calls + "            esac ;;\n    esac\n}\n\n";
}

} // namespace

std::string zshCompletion(const CommandHelp& tool)
{
    std::string text = kZshBegin;
    walk(tool, [&](const std::string& path, const CommandHelp& command) {
        std::string arguments;
        for (const OptionHelp& option : command.options)
            arguments += option.positional ? operandSpec(option) : specs(option);
        text += command.commands.empty() ? functionOf(path) + "() {\n    _arguments" + arguments + "\n}\n\n"
                                         : holder(path, command, arguments);
    });
    return replaced(text + "_TOOL \"$@\"\n", "TOOL", tool.name);
}

} // namespace cotan::app
