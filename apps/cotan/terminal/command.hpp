// A command and its options as declared by Arguments, which parseWords finds in a command line.
#pragma once

#include <functional>
#include <list>
#include <string>

#include "terminal/arguments.hpp"

namespace cotan::app {

struct Command {
    CommandHelp help; // without options and commands
    Command* parent = nullptr;
    std::list<Argument::Option> options; // in the order of their declaration; the first is --help
    std::list<Command> commands;
    HelpGroup group = HelpGroup::general; // of the options declared next
    std::string nextHeading;              // of the commands added next
    bool takesAnything = false;
    std::function<Status()> work;

    CommandHelp describe() const;
    Command* find(const std::string& name);            // null: no such command
    Argument::Option* option(const std::string& name); // null: no such option
    std::string path() const;                          // "cotan map convert"
};

// The name of an option in messages: "--output", "MODEL".
std::string nameOf(const Argument::Option& option);

// A parsed command line.
struct ParsedWords {
    std::vector<Command*> path; // the tool and the given commands, whose options have their values
    std::string answer;         // text to print instead of running the command
};

// Parses the words after the program's name. Errors: ErrorKind::usage.
Result<ParsedWords> parseWords(Command& tool, std::vector<std::string> words);

} // namespace cotan::app
