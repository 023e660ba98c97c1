// Lines of words, as OBJ and MTL files have them.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cotan {

// A text whose continued lines (a backslash at the end) are joined, whose white space is ' ' or
// '\n', with none around a line; line ends may be LF, CR LF or CR.
class TextLines {
public:
    explicit TextLines(std::string text);

    const std::string& text() const { return text_; }

    // The line of the file, from 1, that an offset into text() comes from.
    std::size_t number(std::size_t offset) const;

private:
    std::string text_;
    std::vector<std::size_t> joined_; // offsets where a continued line was joined
};

// Walks over the words of a line.
struct Words {
    std::string_view rest;

    // Empty: there are no more.
    std::string_view next();

    // The next word without taking it.
    std::string_view peek() const { return Words{rest}.next(); }

    // What is left, without the spaces around it: a name that may hold spaces.
    std::string_view all() const;
};

// The number that a whole word is, in any of the usual spellings: 1 -.5 +2. 3e-4. Nothing where it
// is something else or not finite as a float.
std::optional<float> finiteNumber(std::string_view word);

// Spaces for line breaks: for messages of one line.
std::string withoutBreaks(std::string text);

// Part of a file in quotes for a message: short, no control characters.
std::string quotedWord(std::string_view word);

} // namespace cotan
