// Parses words of the command line. Each error names the option, what it expects and what it found.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/try.hpp"
#include "cotan/frame.hpp"
#include "cotan/result.hpp"
#include "cotan/view.hpp"
#include "picture_options.hpp"

namespace cotan::app {

// The names of the convention presets.
std::vector<std::string> presetWords();

// The words between commas; none for an empty text.
std::vector<std::string> splitAtCommas(const std::string& text);

// Parses a frame name. The error begins with the option and lists all frames.
Result<Frame> parseFrame(const std::string& text, std::string_view option);

template<class Value> using Words = std::vector<std::pair<std::string_view, Value>>;

// The error for an unknown word: "--mode: expected a, b or c; found 'x'".
Error unknownWord(const std::string& option, const std::vector<std::string_view>& known, const std::string& word);
// The same for longer lists: "--mode: expected one of a, b, c; found 'x'".
Error notOneOf(const std::string& option, const std::vector<std::string_view>& known, const std::string& word);

// The value of a word; the error lists all words.
template<class Value>
Result<Value> valueOf(const std::string& option, const std::string& word, const Words<Value>& words,
                      decltype(unknownWord) error = unknownWord)
{
    std::vector<std::string_view> known;
    for (const auto& [name, value] : words) {
        if (name == word)
            return value;
        known.push_back(name);
    }
    return error(option, known, word);
}

template<class Value> Result<Value> oneOf(const std::string& option, const std::string& word, const Words<Value>& words)
{
    return valueOf(option, word, words, notOneOf);
}

// Sets `value` to that of the word; an empty word leaves it unchanged.
template<class Value>
Status choose(Value& value, const std::string& option, const std::string& word, const Words<Value>& words)
{
    if (word.empty())
        return Done{};
    COTAN_TRY(found, oneOf(option, word, words));
    value = *found;
    return Done{};
}

} // namespace cotan::app
