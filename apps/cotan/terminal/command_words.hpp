// Words of a command line: those that name a command, looked at before anything else, and paths.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cotan/result.hpp"

namespace cotan {

// A command and those that it has.
struct CommandNames {
    std::string name;
    std::vector<CommandNames> commands;
};

// Whether the words at the beginning, such as `map convert`, name a command, as far as they are there. words: those of
// the command line, without the program. Errors: ErrorKind::usage with the word and the nearest that there is.
Status checkCommandWords(const CommandNames& tool, std::span<const std::string> words);

// "help", "help render" of a tool with that command; but "help --help" is about the command help.
bool asksForHelp(const CommandNames& tool, std::span<const std::string> words);

// "-o=a.png" as "-o" and "a.png", which CLI11 takes for the beginning of a name.
std::vector<std::string> withoutEquals(std::vector<std::string> words);

// Letters to insert, leave out, exchange with another or with their neighbour until one word is the other.
std::size_t editDistance(std::string_view a, std::string_view b);

// A path as a word of a shell's command line.
std::string quoted(const std::string& path);

} // namespace cotan
