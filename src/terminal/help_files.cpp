#include "cotan/terminal/help_files.hpp"

#include <algorithm>

#include "command_walk.hpp"

namespace cotan {

namespace {

void addPages(std::vector<const CommandHelp*>& path, const std::string& version, std::vector<HelpFile>& files)
{
    std::string name = path[0]->name;
    for (std::size_t i = 1; i < path.size(); ++i)
        name += "-" + path[i]->name;
    files.push_back({"man/man1/" + name + ".1", manPage(path, version)});
    const CommandHelp& last = *path.back();
    for (const CommandHelp& command : last.commands) {
        path.push_back(&command);
        addPages(path, version, files);
        path.pop_back();
    }
}

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

std::vector<HelpFile> helpFiles(const CommandHelp& tool, const std::string& version)
{
    std::vector<HelpFile> files{
        {"bash-completion/completions/" + tool.name, bashCompletion(tool)},
        {"zsh/vendor-completions/_" + tool.name, zshCompletion(tool)},
        {"fish/vendor_completions.d/" + tool.name + ".fish", fishCompletion(tool)},
    };
    std::vector<const CommandHelp*> path{&tool};
    addPages(path, version, files);
    return files;
}

void walk(const CommandHelp& tool, const std::function<void(const std::string&, const CommandHelp&)>& visit)
{
    walkFrom("", tool, visit);
}

std::string shortHelp(std::string_view help)
{
    constexpr std::size_t kLeast = 20, kMost = 70; // characters: enough to know it by, and a line
    std::size_t end = help.size();
    for (const std::string_view pause : {"; ", ": ", " (", ". "})
        end = std::min(end, help.find(pause, kLeast));
    if (end > kMost)
        end = help.find_last_of(" ,", kMost);
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

} // namespace cotan
