#include "terminal/command_walk.hpp"

#include <algorithm>

namespace cotan::app {

namespace {

void walkFrom(const std::string& path, const CommandHelp& command,
              const std::function<void(const std::string&, const CommandHelp&)>& visit)
{
    visit(path, command);
    for (const CommandHelp& inner : command.commands)
        walkFrom(path + (path.empty() ? "" : " ") + inner.name, inner, visit);
}

} // namespace

ValueKind valueKind(std::string_view word)
{
    if (word.empty())
        return ValueKind::none;
    if (word == "PATH" || word.find("FILE") != std::string_view::npos)
        return ValueKind::file;
    if (word == "FOLDER" || word == "DIR")
        return ValueKind::folder;
    return word == "A,B" || word == "WORDS" || word == "NAMES" ? ValueKind::list : ValueKind::word;
}

void walk(const CommandHelp& tool, const std::function<void(const std::string&, const CommandHelp&)>& visit)
{
    walkFrom("", tool, visit);
}

std::string shortHelp(std::string_view help)
{
    constexpr std::size_t kMin = 20, kMax = 70; // characters: enough to tell options apart, and a line
    std::size_t end = help.size();
    for (const std::string_view pause : {"; ", ": ", " (", ". "})
        end = std::min(end, help.find(pause, kMin));
    if (end > kMax)
        end = help.find_last_of(" ,", kMax);
    return std::string(help.substr(0, end));
}

std::string joined(const std::vector<std::string>& words, std::string_view between)
{
    std::string text;
    for (const std::string& word : words)
        text += (text.empty() ? "" : std::string(between)) + word;
    return text;
}

std::string replaced(std::string text, std::string_view from, std::string_view to)
{
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
        text.replace(at, from.size(), to);
    return text;
}

std::string inQuotes(const std::string& text, std::string_view escaped)
{
    return "'" + replaced(text, "'", escaped) + "'";
}

} // namespace cotan::app
