// Words, and tables of words that stand for values; each word occurs once.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cotan {

template<class Value> struct Named {
    std::string_view word;
    Value value;
};

template<class Value, std::size_t count> std::vector<std::string> wordsOf(const Named<Value> (&all)[count])
{
    std::vector<std::string> words;
    for (const Named<Value>& one : all)
        words.emplace_back(one.word);
    return words;
}

// Returns an empty string for a value without a word, such as an empty optional.
template<class Value, std::size_t count> std::string wordOf(const Named<Value> (&all)[count], const auto& value)
{
    for (const Named<Value>& one : all)
        if (value == one.value)
            return std::string(one.word);
    return {};
}

// Returns nothing for an unknown word.
template<class Value, std::size_t count>
std::optional<Value> valueOf(const Named<Value> (&all)[count], std::string_view word)
{
    for (const Named<Value>& one : all)
        if (word == one.word)
            return one.value;
    return std::nullopt;
}

// Returns the text of an enumerator; texts[otherwise] if the number is out of range.
template<class Text, std::size_t count>
constexpr Text textAt(const Text (&texts)[count], auto enumerator, std::size_t otherwise = count - 1)
{
    return texts[std::size_t(enumerator) < count ? std::size_t(enumerator) : otherwise];
}

// ASCII letters and digits, whatever the locale of a host program; <cctype> depends on it.
constexpr bool isDigit(char c) { return c >= '0' && c <= '9'; }
constexpr bool isLower(char c) { return c >= 'a' && c <= 'z'; }
constexpr bool isUpper(char c) { return c >= 'A' && c <= 'Z'; }
constexpr bool isLetter(char c) { return isLower(c) || isUpper(c); }
constexpr bool isSpace(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
constexpr char lowerLetter(char c) { return isUpper(c) ? char(c + 32) : c; }
constexpr char upperLetter(char c) { return isLower(c) ? char(c - 32) : c; }

// Converts ASCII letters only.
inline std::string lowerCase(std::string text)
{
    std::ranges::transform(text, text.begin(), lowerLetter);
    return text;
}
inline std::string upperCase(std::string text)
{
    std::ranges::transform(text, text.begin(), upperLetter);
    return text;
}

// Returns "a, b or c".
inline std::string eitherOf(const std::vector<std::string>& words)
{
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i)
        text += (i == 0 ? "" : i + 1 == words.size() ? " or " : ", ") + words[i];
    return text;
}

} // namespace cotan
