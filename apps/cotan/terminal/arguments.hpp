// Declares commands and their command line options, each with its name, help, unit, range and default. CLI11 parses
// them; only arguments.cpp and parse_errors.cpp use it directly.
#pragma once

#include <functional>
#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

#include "core/named_values.hpp"
#include "core/value_checks.hpp"
#include "cotan/result.hpp"
#include "terminal/command_help.hpp"
#include "terminal/help_text.hpp"

namespace CLI {
class App;
class Option;
} // namespace CLI

namespace cotan::app {

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
    // Facts about the option that CLI11 does not store.
    struct Facts {
        FileUse use = FileUse::none;
        std::vector<std::string> words; // suggested or allowed values
        bool closed = false;            // only `words` are allowed
        std::string minimum, maximum;   // of a number, for the help; may be empty
        HelpGroup group = HelpGroup::general;
        bool needed = false;
    };
    Argument(CLI::Option& option, Facts& facts) : option_(&option), facts_(&facts) {}

    Argument& in(const std::string& unit); // names the value in the help: "FILE", "WxH"; see valueKind
    Argument& from(std::initializer_list<std::string> words);
    Argument& from(const std::vector<std::string>& words);
    Argument& from(std::initializer_list<int> numbers);
    // Words for shell completion. Other values are possible; the command checks them.
    Argument& offers(std::vector<std::string> words);
    Argument& within(int least, int most);
    Argument& within(double least, double most);
    Argument& above0(); // at most 1e6
    Argument& checked(ValueCheck check);
    Argument& shows(std::string minimum, std::string maximum); // in the help
    Argument& reads();                // names files that are read, or words that stand for a file
    Argument& writes();               // names files or folders that are written
    Argument& under(HelpGroup group); // for this option only, instead of the current group
    Argument& main();                 // in the first group of the help
    Argument& required();
    Argument& needed(); // required, but checked by the command itself
    Argument& separatedByCommas();
    Argument& withoutDefault(); // the variable's value means "not given"
    Argument& unlisted();       // works, but is not in the help
    // If the option is given and `why` returns a message, the command line is refused with this message.
    Argument& refused(std::function<std::string()> why);
    int count() const; // number of times the option was given

private:
    CLI::Option* option_;
    Facts* facts_;
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

    // Parses the words and runs nothing. Errors: ErrorKind::usage, also for --help and --version.
    Result<GivenCommand> parse(std::vector<std::string> words) const;

private:
    struct Tool;
    Argument added(CLI::Option& option);
    Status read(std::vector<std::string> words, std::string& answer) const;
    std::vector<const CLI::App*> given() const; // the tool and the parsed commands
    std::string help(HelpLength length) const;  // of the last parsed command
    Arguments(std::shared_ptr<Tool> tool, CLI::App& app) : tool_(std::move(tool)), app_(&app) {}

    std::shared_ptr<Tool> tool_;
    CLI::App* app_;
};

} // namespace cotan::app
