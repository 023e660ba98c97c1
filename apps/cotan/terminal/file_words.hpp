// Names of files, as a user types them and as std::filesystem splits them. They differ in one build: the C library of
// WebAssembly, which Node.js on Windows runs too, knows neither backslashes nor drives.
#pragma once

#include <string>

namespace cotan::app {

// Gives the name for std::filesystem: "C:/maps/a.png" for "C:\maps\a.png". Null: names are used as they are typed.
extern std::string (*systemFileOf)(const std::string& word);

// What an option names, for std::filesystem. Remembers the word.
std::string fileOfWord(const std::string& word);

// A text, or the text of JSON, with the names of files as they were typed, and with backslashes in names that begin in
// the same folder.
std::string asTyped(std::string text, bool json = false);

} // namespace cotan::app
