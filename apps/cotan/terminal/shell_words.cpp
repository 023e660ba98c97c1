#include "terminal/shell_words.hpp"

#include <algorithm>
#include <string_view>

#include "files/system/system.hpp"

namespace cotan::app {

namespace {

constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./:";

Shell systemShell() { return onWindows() ? Shell::windows : Shell::posix; }

std::string quotedForPosix(const std::string& word)
{
    std::string text = "'";
    for (const char c : word)
        text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return text + "'";
}

// The C runtime of the program takes off the quotation marks:
// https://learn.microsoft.com/cpp/c-language/parsing-c-command-line-arguments
std::string quotedForRuntime(const std::string& word)
{
    std::string text = "\"";
    std::size_t backslashes = 0;
    for (const char c : word) {
        if (c == '"')
            text.append(backslashes + 1, '\\'); // doubles those before a quotation mark, and escapes it
        backslashes = c == '\\' ? backslashes + 1 : 0;
        text += c;
    }
    return text.append(backslashes, '\\') + "\"";
}

// Before that, cmd.exe takes every quotation mark for a beginning or an end, whatever is before it, and replaces %NAME%
// even between them. A ^ hides its characters, and makes NAME one that no variable has.
std::string quotedForWindows(const std::string& word)
{
    const std::string text = quotedForRuntime(word);
    if (word.find('"') == word.npos && std::count(word.begin(), word.end(), '%') < 2)
        return text;
    std::string hidden;
    for (const char c : text) {
        if (hidden.ends_with('%') || std::string_view("()%!^\"<>&|").find(c) != std::string_view::npos)
            hidden += '^';
        hidden += c;
    }
    return hidden;
}

} // namespace

std::string quoted(const std::string& word, Shell shell)
{
    const std::string_view others = shell == Shell::windows ? "\\" : "+@%,";
    const auto isPlain = [&](char c) {
        return kPlain.find(c) != std::string_view::npos || others.find(c) != std::string_view::npos;
    };
    if (!word.empty() && std::ranges::all_of(word, isPlain))
        return word;
    return shell == Shell::windows ? quotedForWindows(word) : quotedForPosix(word);
}

std::string quoted(const std::string& word) { return quoted(word, systemShell()); }

std::string commandLine(const std::vector<std::string>& words, Shell shell)
{
    std::string line;
    for (const std::string& word : words)
        line += (line.empty() ? "" : " ") + quoted(word, shell);
    return line;
}

std::string commandLine(const std::vector<std::string>& words) { return commandLine(words, systemShell()); }

} // namespace cotan::app
