// Declares commands and their command line options, each with its name, help, unit, range and default, and parses the
// command line.
#pragma once

#include <functional>
#include <list>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/named_values.hpp"
#include "core/real_number.hpp"
#include "core/value_checks.hpp"
#include "cotan/result.hpp"
#include "terminal/command_help.hpp"
#include "terminal/help_text.hpp"

namespace cotan::app {

struct Command; // a command and what is declared of it: terminal/command.hpp

// What a command does with the files named by an option.
enum class FileUse { none, reads, writes };

// An option of a parsed command line, with its values.
struct GivenOption {
    std::string name; // "output", "MODEL"
    std::vector<std::string> values;
    FileUse use = FileUse::none;
};

struct GivenCommand {
    std::string name; // "map convert"
    std::vector<GivenOption> options;
};

// One option, flag or positional argument. Its default is the value of its variable when it is declared; the help shows
// it unless it is an empty text.
class Argument {
public:
    // An option as it is declared, and what the last command line gives for it.
    struct Option {
        OptionHelp help;
        std::string olderName;
        FileUse use = FileUse::none;
        bool listed = true;
        bool checkedByCommand = false; // the parser accepts a command line without this required option
        bool splitAtCommas = false;
        ValueCheck check;
        std::function<Status(const std::vector<std::string>& values)> take; // sets the variable
        std::function<std::string()> refused;                               // why it is refused, if it is given
        std::function<std::string()> answer; // the text that it prints instead of running the command
        std::vector<std::string> values = {};
    };
    explicit Argument(Option& option) : option_(&option) {}

    Argument& in(const std::string& unit) // names the value in the help: "FILE", "WxH"; see valueKind
    {
        option_->help.kind = valueKind(unit);
        return with(option_->help.value, unit);
    }
    Argument& from(const std::vector<std::string>& words)
    {
        option_->help.closed = true;
        return checked(wordOf(words)).offers(words);
    }
    // Words for shell completion. Other values are possible; the command checks them.
    Argument& offers(std::vector<std::string> words) { return with(option_->help.words, std::move(words)); }
    Argument& within(int least, int most)
    {
        return checked(wholeNumberWithin(least, most)).shows(std::to_string(least), std::to_string(most));
    }
    Argument& within(double least, double most)
    {
        return checked(numberWithin(least, most)).shows(textOfReal(least), textOfReal(most));
    }
    Argument& above0() { return checked(numberAbove0()); } // at most 1e6
    Argument& checked(ValueCheck check)                    // replaces that of the variable's type
    {
        return with(option_->check, std::move(check));
    }
    Argument& shows(std::string minimum, std::string maximum) // in the help
    {
        option_->help.minimum = std::move(minimum);
        return with(option_->help.maximum, std::move(maximum));
    }
    // Names files that are read, or words that stand for a file; files or folders that are written.
    Argument& reads() { return with(option_->use, FileUse::reads); }
    Argument& writes() { return with(option_->use, FileUse::writes); }
    // In this group of the help, instead of the current one; in the first one.
    Argument& under(HelpGroup group) { return with(option_->help.group, group); }
    Argument& main() { return under(HelpGroup::main); }
    Argument& required() { return with(option_->help.required, true); }
    Argument& needed() // required, but checked by the command itself
    {
        option_->checkedByCommand = true;
        return required();
    }
    Argument& separatedByCommas() { return with(option_->splitAtCommas, true); }
    Argument& withoutDefault() { return with(option_->help.usual, ""); } // the variable's value means "not given"
    Argument& unlisted() { return with(option_->listed, false); }        // works, but is not in the help
    // Another name that still works, but is not in the help.
    Argument& olderName(std::string name) { return with(option_->olderName, std::move(name)); }
    // If the option is given and `why` returns a message, the command line is refused with this message.
    Argument& refused(std::function<std::string()> why) { return with(option_->refused, std::move(why)); }

private:
    template<class Value> Argument& with(Value& member, auto value)
    {
        member = std::move(value);
        return *this;
    }
    Option* option_;
};

// A command, or the whole tool.
class Arguments {
public:
    // The tool; --version prints `version`.
    Arguments(const std::string& name, const std::string& summary, const std::string& version);

    // Adds a subcommand. This command then requires one of its subcommands.
    Arguments command(const std::string& name, const std::string& summary);

    // "-o,--output" are names of one option; "MODEL" is a positional argument. Value: std::string,
    // std::filesystem::path, int, float, double, std::optional<double> or std::vector<std::string>.
    template<class Value> Argument option(const std::string& names, Value& value, const std::string& help);
    // An option whose text is parsed by `take`. If it fails, `run` returns its error instead of running the command.
    // usual: the text of the default; empty: none.
    Argument option(const std::string& names, const std::string& usual,
                    std::function<Status(const std::string& text)> take, const std::string& help);
    // An option whose value is one of `words`.
    template<class Value, std::size_t count>
    Argument choice(const std::string& names, auto& value, const Named<Value> (&words)[count], const std::string& help)
    {
        const auto take = [&value, &words](const std::string& word) -> Status {
            value = *valueOf(words, word);
            return Done{};
        };
        return option(names, wordOf(words, value), take, help).from(wordsOf(words)).in("NAME");
    }
    Argument flag(const std::string& name, bool& value, const std::string& help);
    // An option that prints a text, such as a list, and does nothing else.
    void answers(const std::string& name, const std::string& help, std::function<std::string()> text);
    // Sets the group of the options declared next; initially general.
    void group(HelpGroup group);
    // Sets the heading of the commands added next.
    void heading(const std::string& heading);
    Argument find(const std::string& name);

    // Allows words that are not declared.
    void takesAnything();

    // Ends the help with example command lines and a sentence.
    void examples(std::vector<std::string> lines, const std::string& closing);
    // Sets the function that run() calls for this command.
    void does(std::function<Status()> work);

    std::string name() const;
    // The contents of the help of this command and its subcommands.
    CommandHelp describe() const;

    // Parses the words (without the program's name) and runs their command, or passes the text of --help (-h: main
    // options only), --version and options added by answers() to `print`. "help map convert" is "map convert --help".
    // Errors: ErrorKind::usage, those of the command.
    Status run(std::vector<std::string> words, const std::function<void(const std::string&)>& print);

    // Parses the words, runs nothing and sets no variable. Errors: ErrorKind::usage, also for --help and --version.
    Result<GivenCommand> parse(std::vector<std::string> words) const;

private:
    Arguments(std::shared_ptr<Command> tool, Command& command) : tool_(std::move(tool)), command_(&command) {}
    Argument::Option& added(const std::string& names, const std::string& help);

    std::shared_ptr<Command> tool_;
    Command* command_;
};

} // namespace cotan::app
