// The contents of a command's help, from which the help, manual pages and shell completions are generated.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/help_group.hpp"

namespace cotan::app {

// The kind of value of an option, by the value's word in the help.
enum class ValueKind {
    none,   // a flag
    word,   // a word or a number
    list,   // words separated by commas: A,B, WORDS, NAMES
    file,   // PATH, or FILE, also as an alternative: NAME|FILE
    folder, // FOLDER, DIR
};
ValueKind valueKind(std::string_view valueWord);

std::string_view headingOf(HelpGroup group);

struct OptionHelp {
    HelpGroup group = HelpGroup::general;
    std::vector<std::string> names; // with hyphens, short ones first; for a positional argument its word
    std::string value;              // word for the value: "FILE"; empty: a flag
    ValueKind kind = ValueKind::none;
    std::string help;
    std::string usual;              // default; empty: not shown
    std::string minimum, maximum;   // range of a number; empty: none
    std::vector<std::string> words; // suggested or allowed values; may be empty
    bool closed = false;            // only `words` are allowed
    bool positional = false, required = false, repeated = false;
};

struct CommandHelp {
    std::string name, summary;
    std::string heading;             // of the list that the command is in; may be empty
    std::vector<OptionHelp> options; // ordered by group; positional arguments in declaration order
    std::vector<CommandHelp> commands;
    std::vector<std::string> examples; // command lines
    std::string closing;               // a sentence on exit codes
};

} // namespace cotan::app
