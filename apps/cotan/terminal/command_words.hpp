// Words of a command line: those that name a command, checked before all others.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cotan/result.hpp"

namespace cotan::app {

// A command and its subcommands.
struct CommandNames {
    std::string name;
    std::vector<CommandNames> commands;
};

// Checks that the first words, such as `map convert`, name a command. words: of the command line, without the program.
// Errors: ErrorKind::usage with the unknown word and the nearest command.
Status checkCommandWords(const CommandNames& tool, std::span<const std::string> words);

// Whether the words are "help" or "help render", if the tool has a command help; "help --help" asks about that one.
bool asksForHelp(const CommandNames& tool, std::span<const std::string> words);

// Splits "-o=a.png" into "-o" and "a.png". CLI11 would take "=a.png" for the value.
std::vector<std::string> withoutEquals(std::vector<std::string> words);

// Edit distance: letters to insert, delete, replace, or swap with a neighbour.
std::size_t editDistance(std::string_view a, std::string_view b);

} // namespace cotan::app
