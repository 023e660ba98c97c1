// Words of commands that messages suggest: quoted so that sh, or cmd.exe, passes exactly these words.
#include "terminal/shell_words.hpp"

#include <algorithm>
#include <cctype>
#include <random>

#include <gtest/gtest.h>

namespace cotan::app {
namespace {

using Words = std::vector<std::string>;

// How sh takes a line apart that has nothing but plain words, '...' and \'.
Words takenApartBySh(const std::string& line)
{
    Words words;
    bool inside = false, began = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (!inside && c == ' ') {
            began = false;
            continue;
        }
        if (!began)
            words.emplace_back();
        began = true;
        if (c == '\'')
            inside = !inside;
        else if (!inside && c == '\\')
            words.back() += line[++i];
        else if (!inside && std::string("\"$`&|;<>()*?[#~!{}\\\t\n").find(c) != std::string::npos)
            words.back() += " sh takes this character for its own: " + std::string(1, c);
        else
            words.back() += c;
    }
    return words;
}

// What cmd.exe hands to the program that it starts. All names of letters, digits and _ are variables.
std::string passedOnByCmd(const std::string& typed)
{
    const auto isVariable = [](const std::string& name) {
        return !name.empty() && std::ranges::all_of(name, [](unsigned char c) { return std::isalnum(c) || c == '_'; });
    };
    std::string line;
    for (std::size_t i = 0; i < typed.size(); ++i) {
        const std::size_t end = typed[i] == '%' ? typed.find('%', i + 1) : std::string::npos;
        const std::string name = end == std::string::npos ? "" : typed.substr(i + 1, end - i - 1);
        if (isVariable(name.substr(0, name.find(':')))) { // of NAME:~0,3 too
            line += "VALUE";
            i = end;
        } else {
            line += typed[i];
        }
    }
    std::string passed;
    bool inside = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (!inside && c == '^') {
            passed += line[++i];
            continue;
        }
        if (c == '"')
            inside = !inside;
        if (!inside && std::string("&|<>()").find(c) != std::string::npos)
            passed += " cmd.exe takes this character for its own: ";
        passed += c;
    }
    return passed;
}

// How the C runtime of a program for Windows takes its command line apart.
Words takenApartByRuntime(const std::string& line)
{
    Words words;
    bool inside = false, began = false;
    for (std::size_t i = 0; i < line.size();) {
        if (!inside && (line[i] == ' ' || line[i] == '\t')) {
            began = false;
            ++i;
            continue;
        }
        if (!began)
            words.emplace_back();
        began = true;
        std::size_t backslashes = 0;
        for (; i < line.size() && line[i] == '\\'; ++i)
            ++backslashes;
        const bool mark = i < line.size() && line[i] == '"';
        words.back().append(mark ? backslashes / 2 : backslashes, '\\');
        if (mark && backslashes % 2 == 1)
            words.back() += '"';
        else if (mark)
            inside = !inside;
        else if (backslashes == 0)
            words.back() += line[i];
        i += mark || backslashes == 0;
    }
    return words;
}

TEST(ShellWords, quotationMarksAreThoseOfTheShell)
{
    const struct {
        std::string word, posix, windows;
    } rows[] = {
        {"a-b_c/d.E9", "a-b_c/d.E9", "a-b_c/d.E9"},
        {"C:/a", "C:/a", "C:/a"},
        {"C:\\maps\\a.png", "'C:\\maps\\a.png'", "C:\\maps\\a.png"},
        {"", "''", "\"\""},
        {"a b", "'a b'", "\"a b\""},
        {"it's", "'it'\\''s'", "\"it's\""},
        {"öl.png", "'öl.png'", "\"öl.png\""},
        {"C:\\my maps\\", "'C:\\my maps\\'", "\"C:\\my maps\\\\\""},
        {"R&D (1)^.png", "'R&D (1)^.png'", "\"R&D (1)^.png\""},
        {"100%.png", "100%.png", "\"100%.png\""},
        {"%PATH%.png", "%PATH%.png", "^\"^%^PATH^%^.png^\""},
        {"a \"b\" & c", "'a \"b\" & c'", "^\"a \\^\"b\\^\" ^& c^\""},
        {"a,b=c;d@e+f", "'a,b=c;d@e+f'", "\"a,b=c;d@e+f\""},
    };
    for (const auto& row : rows) {
        EXPECT_EQ(quoted(row.word, Shell::posix), row.posix);
        EXPECT_EQ(quoted(row.word, Shell::windows), row.windows);
    }
}

TEST(ShellWords, anyWordsArriveAsTheyWere)
{
    std::mt19937 random(5);
    const std::vector<std::string> parts = {"a", "PATH", "%", "%", "\"", "\\", "\\", "^", "&", "|",
                                            "<", ">",    "(", ")", " ",  "!",  "'",  "$", ":", "~0,3",
                                            ",", ";",    "=", "ü", "`",  "*",  "{",  "-o"};
    for (int line = 0; line < 5000; ++line) {
        Words words(1 + random() % 3);
        for (std::string& word : words)
            for (auto count = random() % 9; count > 0; --count)
                word += parts[random() % parts.size()];
        const std::string sh = commandLine(words, Shell::posix), cmd = commandLine(words, Shell::windows);
        EXPECT_EQ(takenApartBySh(sh), words) << sh;
        ASSERT_EQ(takenApartByRuntime(passedOnByCmd(cmd)), words) << cmd;
    }
}

} // namespace
} // namespace cotan::app
