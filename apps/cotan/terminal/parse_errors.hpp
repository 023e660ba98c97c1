// Rewords CLI11's errors in reading order: what is wrong, then with which option.
#pragma once

#include <string>

namespace CLI {
class App;
class ParseError;
} // namespace CLI

namespace cotan::app {

// Returns a message of one line. command: the one being parsed.
std::string messageOf(const CLI::ParseError& error, const CLI::App& command);

} // namespace cotan::app
