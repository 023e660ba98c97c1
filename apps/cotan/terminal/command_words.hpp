// Words of a command line: their distance, lists of them, and paths.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace cotan::app {

// Edit distance: letters to insert, delete, replace, or swap with a neighbour.
std::size_t editDistance(std::string_view a, std::string_view b);

// The words between commas; none for an empty text.
std::vector<std::string> splitAtCommas(const std::string& text);

// A path quoted as a word for a shell.
std::string quoted(const std::string& path);

} // namespace cotan::app
