#include "terminal/help_text.hpp"

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <string_view>

#include "command_walk.hpp"
#include "core/parse_number.hpp"
#include "terminal/screen.hpp"

namespace cotan::app {

namespace {

constexpr std::size_t kMinWidth = 40, kMaxWidth = 120, kUsualWidth = 80;
constexpr std::size_t kIndent = 2, kColumn = 26,
                      kNarrowColumn = 8; // columns of the help text; the second for narrow terminals

// Wraps words into lines from `column` to `width`. at: the column where the first line starts.
std::string wrapped(const std::string& text, std::size_t at, std::size_t column, std::size_t width)
{
    std::istringstream words(text);
    std::string lines;
    bool first = true;
    for (std::string word; words >> word; first = false) {
        if (first) {
            lines += word;
        } else if (at + 1 + word.size() > width) {
            lines += "\n" + std::string(column, ' ') + word;
            at = column;
        } else {
            lines += " " + word;
            ++at;
        }
        at += word.size();
    }
    return lines;
}

// A name, with its description in a column of its own.
std::string entry(const std::string& names, const std::string& text, std::size_t width)
{
    const std::size_t column = width < 60 ? kNarrowColumn : kColumn;
    std::string line = std::string(kIndent, ' ') + names;
    if (text.empty())
        return line + "\n";
    if (line.size() + 2 > column)
        line += "\n" + std::string(column, ' ');
    else
        line.resize(column, ' ');
    return line + wrapped(text, column, column, width) + "\n";
}

std::string namesOf(const OptionHelp& option)
{
    return joined(option.names, ", ") + (option.positional || option.value.empty() ? "" : " " + option.value);
}

// Allowed values and default in parentheses, appended to the help of an option.
std::string limitsOf(const OptionHelp& option)
{
    std::vector<std::string> limits;
    const auto named = [&](const std::string& word) { return option.help.find(word) != std::string::npos; };
    if (option.closed && !std::ranges::all_of(option.words, named))
        limits.push_back(joined(option.words, ", "));
    if (!option.minimum.empty())
        limits.push_back(option.minimum + " to " + option.maximum);
    if (!option.usual.empty())
        limits.push_back("default: " + option.usual);
    if (option.required && !option.positional)
        limits.emplace_back("required");
    return limits.empty() ? "" : " (" + joined(limits, "; ") + ")";
}

std::string optionEntry(const OptionHelp& option, std::size_t width)
{
    return entry(namesOf(option), option.help + limitsOf(option), width);
}

// "cotan bake --high FILE --low FILE -o PATH [OPTIONS]": required options by name, others as [OPTIONS].
std::string usage(const std::vector<const CommandHelp*>& path, std::size_t width)
{
    const CommandHelp& command = *path.back();
    std::string text;
    for (const CommandHelp* one : path)
        text += (text.empty() ? "" : " ") + one->name;
    if (!command.commands.empty())
        text += " COMMAND";
    for (const OptionHelp& option : command.options)
        if (option.positional)
            text += (option.required ? " " : " [") + option.names[0] + (option.repeated ? "..." : "")
                + (option.required ? "" : "]");
    for (const OptionHelp& option : command.options)
        if (!option.positional && option.required)
            text += " " + option.names[0] + " " + option.value;
    constexpr std::string_view kStart = "Usage: ";
    return std::string(kStart) + wrapped(text + " [OPTIONS]", kStart.size(), kStart.size(), width) + "\n";
}

std::string commandLists(const CommandHelp& command, std::size_t width)
{
    std::string text, heading;
    for (const CommandHelp& inner : command.commands) {
        if (const std::string own = inner.heading.empty() ? "Commands" : inner.heading; own != heading) {
            text += "\n" + own + ":\n";
            heading = own;
        }
        text += entry(inner.name, inner.summary, width);
    }
    return text;
}

std::string optionLists(const CommandHelp& command, HelpLength length, std::size_t width)
{
    std::string text;
    const OptionHelp* before = nullptr;
    for (const OptionHelp& option : command.options) {
        if (length == HelpLength::brief && option.group != HelpGroup::main)
            break;
        if (!before || before->group != option.group)
            text += "\n" + std::string(headingOf(option.group)) + ":\n";
        text += optionEntry(option, width);
        before = &option;
    }
    return text;
}

std::string moreHelpHint(const std::vector<const CommandHelp*>& path, HelpLength length, std::size_t width)
{
    const CommandHelp& command = *path.back();
    std::string words;
    for (std::size_t i = 1; i < path.size(); ++i)
        words += " " + path[i]->name;
    const std::string tool = path[0]->name;
    const auto more = std::ranges::count_if(command.options,
                                            [](const OptionHelp& option) { return option.group != HelpGroup::main; });
    if (!command.commands.empty())
        return "\n" + wrapped("\"" + tool + " help" + words + " COMMAND\" shows the options of a command.", 0, 0, width)
            + "\n";
    if (length == HelpLength::brief)
        return "\n"
            + wrapped("\"" + tool + " help" + words + "\" shows " + std::to_string(more) + " more options.", 0, 0,
                      width)
            + "\n";
    return "";
}

} // namespace

std::string_view headingOf(HelpGroup group)
{
    switch (group) {
    case HelpGroup::main: return "Main options";
    case HelpGroup::input: return "Input";
    case HelpGroup::output: return "Output";
    case HelpGroup::rays: return "Rays";
    case HelpGroup::camera: return "Camera";
    case HelpGroup::light: return "Light";
    case HelpGroup::frame: return "Frame";
    case HelpGroup::look: return "Look";
    case HelpGroup::jobs: return "Jobs";
    case HelpGroup::diagnostics: return "Diagnostics";
    case HelpGroup::general: return "General";
    }
    return "";
}

std::string helpText(const std::vector<const CommandHelp*>& path, HelpLength length, std::size_t width)
{
    width = std::max(width, kMinWidth);
    const CommandHelp& command = *path.back();
    std::string text = wrapped(command.summary, 0, 0, width) + "\n\n" + usage(path, width);
    text += commandLists(command, width) + optionLists(command, length, width);
    text += moreHelpHint(path, length, width);
    if (!command.examples.empty())
        text += "\nExamples:\n";
    for (const std::string& line : command.examples) // for copying, so not wrapped
        text += std::string(kIndent, ' ') + line + "\n";
    if (!command.closing.empty())
        text += "\n" + wrapped(command.closing, 0, 0, width) + "\n";
    return text;
}

std::size_t helpWidth()
{
    std::size_t columns = kUsualWidth;
    if (const std::size_t width = terminalWidth(stdout); width > 0)
        columns = width;
    else if (const char* text = std::getenv("COLUMNS"))
        if (int given = 0; parseNumber(std::string_view(text), given) && given > 0)
            columns = std::size_t(given);
    return std::clamp(columns, kMinWidth, kMaxWidth);
}

} // namespace cotan::app
