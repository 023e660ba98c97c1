#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "terminal/command.hpp"
#include "terminal/command_words.hpp"

namespace cotan::app {

namespace {

constexpr std::size_t kMaxLetters = 100; // of an unknown word that is compared with names, and repeated in messages

bool isFlag(const Argument::Option& option) { return option.help.value.empty(); }

// "--high FILE", or only the name of a flag or positional argument.
std::string withValue(const Argument::Option& option)
{
    return nameOf(option) + (option.help.positional || isFlag(option) ? "" : " " + option.help.value);
}

// "map convert"; the tool itself gives its name.
std::string wordsOf(const Command& command)
{
    const std::string path = command.path();
    return command.parent ? path.substr(path.find(' ') + 1) : path;
}

std::vector<std::string> namesOf(const std::list<Command>& commands)
{
    std::vector<std::string> names;
    for (const Command& command : commands)
        names.push_back(command.help.name);
    return names;
}

struct Nearest {
    std::string name;
    std::size_t distance = SIZE_MAX;
};

// The name that is nearest to a word. A word of at least `prefix` letters that begins a name has the distance 1.
Nearest nearestOf(const std::vector<std::string>& names, const std::string& word, std::size_t prefix)
{
    Nearest nearest;
    for (const std::string& name : names) {
        const bool begins = word.size() >= prefix && name.starts_with(word);
        if (const std::size_t distance = begins ? 1 : editDistance(word, name); distance < nearest.distance)
            nearest = {name, distance};
    }
    return nearest;
}

Error unknownCommand(const Command& command, const std::string& word)
{
    const std::string before = command.parent ? wordsOf(command) + " " : "";
    if (word.size() > kMaxLetters)
        return usageError(fmt::format("unknown {}command of {} letters", before, word.size()));
    const std::vector<std::string> names = namesOf(command.commands);
    const auto [nearest, distance] = nearestOf(names, word, 2);
    const bool near = distance <= std::max<std::size_t>(1, nearest.size() / 3);
    return usageError(fmt::format("unknown {}command '{}'; {}", before, word,
                                  near ? fmt::format("did you mean {}?", nearest)
                                       : fmt::format("expected one of {}", fmt::join(names, ", "))));
}

std::string unknownOption(const Command& command, const std::string& word)
{
    const std::string name = word.substr(0, word.find('='));
    if (name.size() > kMaxLetters)
        return fmt::format("unknown option of {} letters", name.size());
    std::vector<std::string> names;
    for (const Argument::Option& option : command.options)
        for (const std::string& one : option.help.names)
            if (option.listed && one.starts_with("--"))
                names.push_back(one);
    const auto [nearest, distance] = nearestOf(names, name, 5);
    const bool near = !nearest.empty() && distance <= 1 + (nearest.size() - 2) / 4;
    return "unknown option " + name + (near ? "; did you mean " + nearest + "?" : "");
}

bool startsLikeOption(const std::string& word) { return word.size() > 1 && word[0] == '-'; }

// Goes through the words, and gives the options their values.
class Reader {
public:
    Reader(Command& tool, std::vector<std::string> words) : words_(std::move(words)) { enter(tool); }

    Result<ParsedWords> read()
    {
        if (asksForHelp()) {
            words_.erase(words_.begin());
            words_.emplace_back("--help");
        }
        for (; at_ < words_.size(); ++at_) {
            const std::string& word = words_[at_];
            if (word == "--" && !afterDashes_)
                afterDashes_ = true;
            else if (startsLikeOption(word) && !afterDashes_)
                readOption(word);
            else if (Command* const inner = command().find(word))
                enter(*inner);
            else if (!command().commands.empty() && !optionSeen_)
                return unknownCommand(command(), word);
            else
                readPositional(word);
        }
        ParsedWords parsed{path_, answer()};
        if (const std::string wrong = parsed.answer.empty() ? problem() : ""; !wrong.empty())
            return usageError(wrong + " (see " + command().path() + " --help)");
        return parsed;
    }

private:
    Command& command() const { return *path_.back(); }

    void enter(Command& command)
    {
        path_.push_back(&command);
        optionSeen_ = false;
        for (Argument::Option& option : command.options)
            option.values.clear();
    }

    // "help" or "help render", if the tool has a command help; "help --help" asks about that one.
    bool asksForHelp() const
    {
        return !words_.empty() && words_[0] == "help" && command().find("help")
            && (words_.size() == 1 || !words_[1].starts_with('-'));
    }

    void readPositional(const std::string& word)
    {
        for (Argument::Option& option : command().options)
            if (option.help.positional && (option.values.empty() || option.help.repeated))
                return option.values.push_back(word);
        unknown_.push_back(word);
    }

    // --name, --name VALUE, --name=VALUE, -n VALUE, -nVALUE, -n=VALUE
    void readOption(const std::string& word)
    {
        optionSeen_ = true;
        const std::size_t end = word.starts_with("--") ? std::min(word.find('='), word.size()) : 2;
        Argument::Option* const option = command().option(word.substr(0, end));
        const bool attached = end < word.size();
        if (!option)
            unknown_.push_back(word);
        else if (isFlag(*option))
            readFlag(*option, attached ? word.substr(end) : "=true");
        else if (attached)
            option->values.push_back(word.substr(end + (word[end] == '=')));
        else
            readValues(*option);
    }

    void readFlag(Argument::Option& option, const std::string& value)
    {
        if (value != "=true")
            note(fmt::format("{} takes no value; found '{}'", nameOf(option), value.substr(value.starts_with('='))));
        option.values = {"true"};
    }

    // One value, also if it begins with a hyphen, as negative numbers do; of a list all words up to the next option.
    void readValues(Argument::Option& option)
    {
        if (at_ + 1 == words_.size())
            return note(fmt::format("{} needs a value: {}", nameOf(option), withValue(option)));
        option.values.push_back(words_[++at_]);
        const auto needed = std::ranges::count_if(command().options, [](const Argument::Option& one) {
            return one.help.positional && one.help.required && one.values.empty();
        });
        while (option.help.repeated && words_.size() - at_ - 1 > std::size_t(needed)
               && !startsLikeOption(words_[at_ + 1]))
            option.values.push_back(words_[++at_]);
    }

    void note(const std::string& problem) { problem_ = problem_.empty() ? problem : problem_; }

    // The text of --help, --version or another option that prints one; empty: none of them is given.
    std::string answer() const
    {
        if (!command().options.front().values.empty()) {
            const CommandHelp tool = path_.front()->describe();
            std::vector<const CommandHelp*> path{&tool};
            for (std::size_t i = 1; i < path_.size(); ++i)
                path.push_back(&*std::ranges::find(path.back()->commands, path_[i]->help.name, &CommandHelp::name));
            const bool full = std::ranges::find(words_, "--help") != words_.end();
            return helpText(path, full ? HelpLength::full : HelpLength::brief, helpWidth());
        }
        for (const Command* command : path_)
            for (const Argument::Option& option : command->options)
                if (option.answer && !option.values.empty()) {
                    const std::string text = option.answer();
                    return text + (text.ends_with('\n') ? "" : "\n");
                }
        return {};
    }

    // The first thing that is wrong; empty: nothing is.
    std::string problem() const
    {
        if (!problem_.empty())
            return problem_;
        for (Command* const command : path_)
            for (Argument::Option& option : command->options)
                if (const std::string wrong = problemWith(option); !wrong.empty())
                    return wrong;
        if (!command().commands.empty())
            return wordsOf(command()) + " needs a command: " + eitherOf(namesOf(command().commands));
        for (const Argument::Option& option : command().options)
            if (option.help.required && !option.checkedByCommand && option.values.empty())
                return wordsOf(command()) + " needs " + withValue(option);
        if (unknown_.empty() || command().takesAnything)
            return {};
        const auto option = std::ranges::find_if(unknown_, [](const std::string& w) { return w.starts_with('-'); });
        return option == unknown_.end() ? "unexpected word '" + unknown_.front() + "'"
                                        : unknownOption(command(), *option);
    }

    // Also splits its values at commas, if it is declared so.
    static std::string problemWith(Argument::Option& option)
    {
        const std::string name = nameOf(option);
        if (option.values.empty() || isFlag(option))
            return {};
        if (option.values.size() > 1 && !option.help.repeated)
            return fmt::format("{} is given {} times; expected once", name, option.values.size());
        if (option.splitAtCommas)
            option.values = splitAtCommas(fmt::format("{}", fmt::join(option.values, ",")));
        for (const std::string& value : option.values)
            if (std::string wrong = option.check ? option.check(value) : ""; !wrong.empty()) {
                std::ranges::replace(wrong, '\n', ' ');
                return name + ": " + wrong;
            }
        return option.refused ? option.refused() : std::string();
    }

    std::vector<std::string> words_;
    std::size_t at_ = 0; // the word that is read
    std::vector<Command*> path_;
    bool afterDashes_ = false, optionSeen_ = false; // after "--"; an option of this command was read
    std::vector<std::string> unknown_;
    std::string problem_; // the first one of the form of the words
};

} // namespace

std::string nameOf(const Argument::Option& option)
{
    for (const std::string& name : option.help.names) // short ones come first
        if (name.starts_with("--"))
            return name;
    return option.help.names.front();
}

Command* Command::find(const std::string& name)
{
    const auto found = std::ranges::find(commands, name, [](const Command& command) { return command.help.name; });
    return found == commands.end() ? nullptr : &*found;
}

Argument::Option* Command::option(const std::string& name)
{
    const auto found = std::ranges::find_if(options, [&](const Argument::Option& one) {
        return name == one.olderName || std::ranges::find(one.help.names, name) != one.help.names.end();
    });
    return found == options.end() ? nullptr : &*found;
}

std::string Command::path() const { return (parent ? parent->path() + " " : "") + help.name; }

CommandHelp Command::describe() const
{
    CommandHelp all = help;
    for (const Argument::Option& one : options) {
        const bool namesFile = one.help.kind == ValueKind::file || one.help.kind == ValueKind::folder;
        if (namesFile && one.use == FileUse::none && !one.help.positional)
            throw std::logic_error(nameOf(one) + ": expected reads() or writes() for an option that names a file");
        if (one.listed)
            all.options.push_back(one.help);
    }
    std::ranges::stable_sort(all.options, {}, [](const OptionHelp& one) {
        return std::pair(one.group, !one.positional); // positional arguments come first
    });
    for (const Command& inner : commands)
        all.commands.push_back(inner.describe());
    return all;
}

Result<ParsedWords> parseWords(Command& tool, std::vector<std::string> words)
{
    return Reader(tool, std::move(words)).read();
}

} // namespace cotan::app
