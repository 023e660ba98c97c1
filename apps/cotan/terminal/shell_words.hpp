// Words of a command line as a user types them: in messages that show a command to run.
#pragma once

#include <string>
#include <vector>

namespace cotan::app {

enum class Shell { posix, windows }; // sh and its relatives; cmd.exe

// The word, in quotation marks if the shell needs them. Then the program gets exactly this word. For cmd.exe it must be
// a word without line breaks, which none can pass. At its prompt, not in a batch file, where percent signs count twice.
std::string quoted(const std::string& word, Shell shell);

// The same for the shell of the system, also of the one that runs this program as WebAssembly.
std::string quoted(const std::string& word);

// The words, quoted and with spaces between them.
std::string commandLine(const std::vector<std::string>& words, Shell shell);
std::string commandLine(const std::vector<std::string>& words);

} // namespace cotan::app
