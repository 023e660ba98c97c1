// Completion for bash. The package bash-completion finds the file, but none of its functions are used.
#include "help/help_files.hpp"

#include "terminal/command_walk.hpp"

namespace cotan::app {

namespace {

constexpr const char* kBashBegin = R"(# Completion of TOOL for bash; made from the same table as `TOOL --help`.
_TOOL()
{
    # Bash takes --name=value apart at the sign.
    local current="${COMP_WORDS[COMP_CWORD]}" before="${COMP_WORDS[COMP_CWORD-1]}" command="" i
    if [[ $current == = ]]; then
        current=""
    elif [[ $before == = ]]; then
        before="${COMP_WORDS[COMP_CWORD-2]}"
    fi
    for ((i = 1; i < COMP_CWORD; i++)); do
        case "$command/${COMP_WORDS[i]}" in
            COMMANDS) command+="${command:+ }${COMP_WORDS[i]}" ;;
            *) break ;;
        esac
    done
    COMPREPLY=()
    local words="" list="" takes="" value="" options="" commands=""
    case "$command $before" in
)";

constexpr const char* kBashPlaces = R"(    esac
    [[ -n $value ]] || case "$command" in
)";

constexpr const char* kBashEnd = R"(    esac
    if [[ -z $value && -n $commands && $current != -* ]]; then
        words="$commands"
    elif [[ -z $value && ( -z $takes || $current == -* ) ]]; then
        takes=""
        words="$options"
    fi
    if [[ -n $list ]]; then
        local head=""
        [[ $current != *,* ]] || head="${current%,*},"
        compopt -o nospace 2>/dev/null
        mapfile -t COMPREPLY < <(compgen -P "$head" -W "$words" -- "${current##*,}")
        return
    fi
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
    if [[ $takes == file ]]; then
        compopt -o filenames 2>/dev/null
        mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(compgen -f -- "$current")
    elif [[ $takes == folder ]]; then
        compopt -o filenames 2>/dev/null
        mapfile -t COMPREPLY < <(compgen -d -- "$current")
    fi
}
complete -F _TOOL TOOL
)";

// Cases that set how to complete the value of each option of a command.
std::string valueCases(const std::string& path, const CommandHelp& command)
{
    std::string text;
    for (const OptionHelp& option : command.options) {
        if (option.positional || option.kind == ValueKind::none)
            continue;
        std::vector<std::string> patterns;
        for (const std::string& name : option.names)
            patterns.push_back("\"" + path + " " + name + "\"");
        text += "        " + joined(patterns, " | ") + ") value=yes";
        if (!option.words.empty())
            text += " words=\"" + joined(option.words, " ") + "\"";
        if (option.kind == ValueKind::list)
            text += " list=yes";
        if (option.kind == ValueKind::file || option.kind == ValueKind::folder)
            text += option.kind == ValueKind::file ? " takes=file" : " takes=folder";
        text += " ;;\n";
    }
    return text;
}

} // namespace

std::string bashCompletion(const CommandHelp& tool)
{
    std::vector<std::string> commands;
    std::string values, paths;
    walk(tool, [&](const std::string& path, const CommandHelp& command) {
        values += valueCases(path, command);
        std::vector<std::string> options, inner;
        std::string operand;
        for (const OptionHelp& option : command.options)
            if (!option.positional)
                options.insert(options.end(), option.names.begin(), option.names.end());
            else
                operand =
                    option.words.empty() ? " takes=file" : " takes=word words=\"" + joined(option.words, " ") + "\"";
        for (const CommandHelp& one : command.commands) {
            inner.push_back(one.name);
            commands.push_back("\"" + path + "/" + one.name + "\"");
        }
        paths += "        \"" + path + "\") options=\"" + joined(options, " ") + "\"" + operand;
        paths += (inner.empty() ? std::string() : " commands=\"" + joined(inner, " ") + "\"") + " ;;\n";
    });
    std::string text =
        replaced(kBashBegin, "COMMANDS", joined(commands, " | ")) + values + kBashPlaces + paths + kBashEnd;
    return replaced(text, "TOOL", tool.name);
}

} // namespace cotan::app
