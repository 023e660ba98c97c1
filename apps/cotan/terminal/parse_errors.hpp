// What CLI11 has against a command line, in the order in which people read: what is wrong, then with what.
#pragma once

#include <string>

namespace CLI {
class App;
class ParseError;
} // namespace CLI

namespace cotan {

// One line. command: the one that was being read.
std::string messageOf(const CLI::ParseError& error, const CLI::App& command);

} // namespace cotan
