// Manual pages, in the macros of man(7).
#include "help/help_files.hpp"

#include <algorithm>
#include <sstream>

#include "core/named_values.hpp"
#include "terminal/command_walk.hpp"

namespace cotan::app {

namespace {

// Escapes text to be copied literally: every hyphen becomes a minus sign.
std::string literal(const std::string& text)
{
    std::string page;
    for (const char c : text)
        switch (c) {
        case '\\': page += "\\e"; break;
        case '-': page += "\\-"; break;
        case '\'': page += "\\(aq"; break;
        case '`': page += "\\(ga"; break;
        case '^': page += "\\(ha"; break;
        case '~': page += "\\(ti"; break;
        default: page += c;
        }
    return page.starts_with('.') ? "\\&" + page : page;
}

// Escapes prose: only words that begin with a hyphen, options and numbers, become literal.
std::string prose(const std::string& text)
{
    std::istringstream words(text);
    std::string page;
    for (std::string word; words >> word;) {
        const std::size_t start = std::min(word.find_first_not_of("(\""), word.size());
        const bool option = start < word.size() && word[start] == '-';
        if (!page.empty())
            page += ' ';
        page += option ? literal(word) : replaced(replaced(word, "\\", "\\e"), "`", "\\(ga");
    }
    return page.starts_with('.') || page.starts_with('\'') ? "\\&" + page : page;
}

std::string sentence(std::string text)
{
    if (text.empty())
        return text;
    // A name keeps its case: "glTF".
    const std::size_t end = std::min(text.find_first_of(" :,"), text.size());
    if (std::all_of(text.begin(), text.begin() + std::ptrdiff_t(end), [](char c) { return isLower(c) || c == '-'; }))
        text[0] = upperLetter(text[0]);
    return text + (text.ends_with('.') || text.ends_with("...") ? "" : ".");
}

// Turns "Bake a map." into the style of apropos: "bake a map".
std::string withoutStop(std::string text)
{
    if (text.size() > 1 && isLower(text[1]))
        text[0] = lowerLetter(text[0]);
    if (text.ends_with('.'))
        text.pop_back();
    return text;
}

std::string bold(const std::string& text) { return "\\fB" + literal(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + literal(text) + "\\fR"; }

std::string heading(const std::string& text) { return ".SH " + text + "\n"; }

// The allowed words, unless the help text names them all.
std::string choices(const OptionHelp& option)
{
    const auto named = [&](const std::string& word) { return option.help.find(word) != std::string::npos; };
    return !option.closed || std::ranges::all_of(option.words, named) ? ""
                                                                      : " Words: " + joined(option.words, ", ") + ".";
}

std::string entry(const OptionHelp& option)
{
    std::string names;
    for (const std::string& name : option.names)
        names += (names.empty() ? "" : ", ") + (option.positional ? italic(name) : bold(name));
    if (!option.positional && !option.value.empty())
        names += " " + italic(option.value);
    std::string text = sentence(option.help) + choices(option);
    if (!option.minimum.empty())
        text += " From " + option.minimum + " to " + option.maximum + ".";
    if (!option.usual.empty())
        text += " Default: " + option.usual + ".";
    if (option.required && !option.positional)
        text += " Required.";
    if (option.repeated)
        text += " May be given several times.";
    return ".TP\n" + names + "\n" + prose(text) + "\n";
}

std::string entries(const CommandHelp& command, bool positional)
{
    std::string text;
    const OptionHelp* before = nullptr;
    for (const OptionHelp& option : command.options) {
        if (option.positional != positional)
            continue;
        if (!positional && (!before || before->group != option.group))
            text += ".SS " + std::string(headingOf(option.group)) + "\n";
        text += entry(option);
        before = &option;
    }
    return text;
}

std::string pageOf(const std::vector<const CommandHelp*>& path, std::size_t length, const std::string& last = "")
{
    std::string name = path[0]->name;
    for (std::size_t i = 1; i < length; ++i)
        name += "-" + path[i]->name;
    return name + (last.empty() ? "" : "-" + last);
}

} // namespace

std::string manPage(const std::vector<const CommandHelp*>& path, const std::string& version,
                    const std::string& repository)
{
    const CommandHelp& command = *path.back();
    const std::string name = pageOf(path, path.size());
    std::string words = path[0]->name;
    for (std::size_t i = 1; i < path.size(); ++i)
        words += " " + path[i]->name;

    std::string page = ".\\\" Made from the same table as \"" + words + " --help\".\n";
    page += ".TH " + literal(upperCase(name)) + " 1 \"\" \"" + path[0]->name + " " + version
        + "\" \"User Commands\"\n.nh\n.ad l\n";
    page += heading("NAME") + literal(name) + " \\- " + prose(withoutStop(replaced(command.summary, "\n", " "))) + "\n";
    page += heading("SYNOPSIS") + bold(words);
    page += command.commands.empty() ? "" : " " + italic("COMMAND");
    for (const OptionHelp& option : command.options)
        if (option.positional)
            page += option.required ? " " + italic(option.names[0]) : " [" + italic(option.names[0]) + "]";
    for (const OptionHelp& option : command.options)
        if (!option.positional && option.required)
            page += " " + bold(option.names[0]) + " " + italic(option.value);
    page += " [" + italic("OPTIONS") + "]\n";
    if (const std::string arguments = entries(command, true); !arguments.empty())
        page += heading("ARGUMENTS") + arguments;
    if (!command.commands.empty()) {
        page += heading("COMMANDS") + "Each has a page of its own.\n";
        std::string before;
        for (const CommandHelp& inner : command.commands) {
            if (inner.heading != before)
                page += ".SS \"" + inner.heading + "\"\n";
            before = inner.heading;
            page +=
                ".TP\n" + bold(pageOf(path, path.size(), inner.name)) + "(1)\n" + prose(sentence(inner.summary)) + "\n";
        }
    }
    page += heading("OPTIONS") + entries(command, false);
    if (!command.examples.empty()) {
        page += heading("EXAMPLES");
        for (const std::string& line : command.examples)
            page += ".PP\n.EX\n" + literal(line) + "\n.EE\n";
    }
    if (!command.closing.empty())
        page += heading("\"EXIT STATUS\"")
            + prose(command.closing.substr(
                std::min(command.closing.size(), command.closing.starts_with("Exit codes: ") ? std::size_t(12) : 0)))
            + "\n";
    if (path.size() == 1 && !repository.empty())
        page += heading("\"REPORTING BUGS\"") + literal(repository) + "\n";
    if (path.size() > 1)
        page += heading("\"SEE ALSO\"") + bold(pageOf(path, path.size() - 1)) + "(1)\n";
    return page;
}

} // namespace cotan::app
