// Commands and what they take on the command line: each option is declared once, with its name, help, unit, range and
// default. CLI11 reads them; only arguments.cpp and parse_errors.cpp see it.
#pragma once

#include <functional>
#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

#include "core/named_values.hpp"
#include "cotan/result.hpp"
#include "terminal/command_help.hpp"
#include "terminal/help_text.hpp"

namespace CLI {
class App;
class Option;
} // namespace CLI

namespace cotan {

// What a command does with the files that an option names.
enum class FileUse { none, reads, writes };

// An option of a command line that was read, and its values.
struct GivenOption {
    std::string name; // "output", "MODEL"
    std::vector<std::string> values;
    FileUse use = FileUse::none;
};

struct GivenCommand {
    std::string name; // "map convert"
    std::vector<GivenOption> options;
};

// One option, flag or positional argument. Its default is what its variable holds when it is declared; the help shows
// it unless it is an empty text.
class Argument {
public:
    // What CLI11 does not keep of it.
    struct Facts {
        FileUse use = FileUse::none;
        std::vector<std::string> words; // that it offers
        bool closed = false;            // and takes no other
        HelpGroup group = HelpGroup::general;
        bool needed = false;
    };
    Argument(CLI::Option& option, Facts& facts) : option_(&option), facts_(&facts) {}

    Argument& in(const std::string& unit); // the word for its value in the help: "FILE", "WxH"; see valueKind
    Argument& from(std::initializer_list<std::string> words);
    Argument& from(const std::vector<std::string>& words);
    Argument& from(std::initializer_list<int> numbers);
    // Words that a shell offers for it; what else it takes is the command's affair.
    Argument& offers(std::vector<std::string> words);
    Argument& within(int least, int most);
    Argument& within(double least, double most);
    Argument& above0(); // and at most 1e6
    Argument& above0Or(const std::string& word);
    Argument& reads();                // names files that are read, or words that stand for one
    Argument& writes();               // names files or folders that are written
    Argument& under(HelpGroup group); // in the help, whatever group it is declared in
    Argument& main();                 // stands first there
    Argument& required();
    Argument& needed(); // required, but it is the command that refuses to go on without it
    Argument& separatedByCommas();
    Argument& withoutDefault(); // what the variable holds means that nothing was given
    Argument& unlisted();       // works, but the help leaves it out
    // With this option given the command line is wrong where `why` returns a message.
    Argument& refused(std::function<std::string()> why);
    int count() const; // how often it was given

private:
    CLI::Option* option_;
    Facts* facts_;
};

// A command, or the tool as a whole.
class Arguments {
public:
    // The tool; --version prints `version`.
    Arguments(const std::string& name, const std::string& summary, const std::string& version);

    // A command of this one, which then needs one of its commands.
    Arguments command(const std::string& name, const std::string& summary);

    // "-o,--output" are names of one option; "MODEL" is a positional argument. A value is a std::string, a
    // std::filesystem::path, an int, float or double, an optional double, or several strings in a vector.
    template<class Value> Argument option(const std::string& names, Value& value, const std::string& help);
    // One whose text `take` makes a value of. What that refuses is what `run` returns in place of the command's work.
    // usual: the text of the default; empty: none.
    Argument option(const std::string& names, const std::string& usual,
                    std::function<Status(const std::string& text)> take, const std::string& help);
    // One whose words, and no others, stand for values.
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
    // An option that prints a text and does nothing else, such as a list.
    void answers(const std::string& name, const std::string& help, std::function<std::string()> text);
    // The group of the options that are declared next; at first general.
    void group(HelpGroup group);
    // The heading of the commands that are added next.
    void heading(const std::string& heading);
    Argument find(const std::string& name);

    // Words that nobody declared are no error.
    void takesAnything();

    // Ends the help with command lines that work, and a sentence.
    void examples(std::vector<std::string> lines, const std::string& closing);
    // What the command does; called by run.
    void does(std::function<Status()> work);

    std::string name() const;
    // All that the help says, of this command and those that it has.
    CommandHelp describe() const;

    // Reads the words (without the program's name) and does what they ask for: runs a command, or hands the text of
    // --help (-h: the main options alone), --version and what answers() added to `print`. "help map convert" is
    // "map convert --help". Errors: ErrorKind::usage, those of the command.
    Status run(std::vector<std::string> words, const std::function<void(const std::string&)>& print);

    // Reads the words and runs nothing. Errors: ErrorKind::usage, for --help and --version, too.
    Result<GivenCommand> parse(std::vector<std::string> words) const;

private:
    struct Tool;
    Argument added(CLI::Option& option);
    Status read(std::vector<std::string> words, std::string& answer) const;
    std::vector<const CLI::App*> given() const; // the tool and the commands that the words named
    std::string help(HelpLength length) const;  // of the last of those
    Arguments(std::shared_ptr<Tool> tool, CLI::App& app) : tool_(std::move(tool)), app_(&app) {}

    std::shared_ptr<Tool> tool_;
    CLI::App* app_;
};

} // namespace cotan
