// What a command's help says, as values: the help, the manual's pages and the completion of shells are made of it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace cotan {

// What stands behind an option, by the word that its help has for it.
enum class ValueKind {
    none,   // a flag
    word,   // a word or a number
    list,   // words separated by commas: A,B, WORDS, NAMES
    file,   // PATH, or FILE, also among others: NAME|FILE
    folder, // FOLDER, DIR
};
ValueKind valueKind(std::string_view valueWord);

// The heading that an option stands under, in the order of the help. The main ones are the few that matter first.
enum class HelpGroup { main, input, output, rays, camera, light, frame, look, jobs, diagnostics, general };
std::string_view headingOf(HelpGroup group);

struct OptionHelp {
    HelpGroup group = HelpGroup::general;
    std::vector<std::string> names; // with their hyphens, short ones first; of a positional argument its word
    std::string value;              // the word for its value: "FILE"; empty: a flag
    ValueKind kind = ValueKind::none;
    std::string help;
    std::string usual;              // what it is if it is not given; empty: not told
    std::string least, most;        // of a number with a range
    std::vector<std::string> words; // to choose from, or to begin with; may be empty
    bool closed = false;            // it takes none but these words
    bool positional = false, required = false, repeated = false;
};

struct CommandHelp {
    std::string name, summary;
    std::string heading;             // of the list of commands that it stands in; may be empty
    std::vector<OptionHelp> options; // by their groups; positional arguments among them, in their order
    std::vector<CommandHelp> commands;
    std::vector<std::string> examples; // command lines
    std::string closing;               // a sentence on exit codes
};

} // namespace cotan
