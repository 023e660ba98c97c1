#include "core/value_checks.hpp"

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <utility>

#include "core/named_values.hpp"

namespace cotan {

namespace {

// CLI11's own range checks let NaN pass.
std::string aboveZero(const std::string& text)
{
    char* end = nullptr;
    const float value = std::strtof(text.c_str(), &end);
    const bool good = end != text.c_str() && *end == '\0' && value > 0 && value <= 1e6f;
    return good ? "" : "expected a number above 0 and at most 1e6; found '" + text + "'";
}

std::string textOf(double value)
{
    std::ostringstream text;
    text << value;
    return text.str();
}

// what: "a whole number from 0 to 8"
ValueCheck wholeNumber(const std::string& what, std::function<bool(long long)> isGood)
{
    return [what, isGood = std::move(isGood)](const std::string& text) -> std::string {
        char* end = nullptr;
        const long long value = std::strtoll(text.c_str(), &end, 0);
        const bool good = end != text.c_str() && *end == '\0' && isGood(value);
        return good ? std::string() : "expected " + what + "; found '" + text + "'";
    };
}

} // namespace

ValueCheck numberAbove0() { return aboveZero; }

ValueCheck numberAbove0Or(const std::string& word)
{
    return [word](const std::string& text) {
        const std::string wrong = text == word ? "" : aboveZero(text);
        return wrong.empty() ? "" : "expected " + word + " or " + wrong.substr(wrong.find(' ') + 1);
    };
}

ValueCheck numberWithin(double least, double most)
{
    return [least, most](const std::string& text) -> std::string {
        char* end = nullptr;
        const double value = std::strtod(text.c_str(), &end);
        if (end != text.c_str() && *end == '\0' && value >= least && value <= most)
            return {};
        return "expected a number from " + textOf(least) + " to " + textOf(most) + "; found '" + text + "'";
    };
}

ValueCheck wholeNumberWithin(long long least, long long most)
{
    return wholeNumber("a whole number from " + std::to_string(least) + " to " + std::to_string(most),
                       [=](long long value) { return value >= least && value <= most; });
}

ValueCheck wholeNumberOf(const std::vector<long long>& numbers)
{
    std::vector<std::string> words;
    for (const long long number : numbers)
        words.push_back(std::to_string(number));
    return wholeNumber(eitherOf(words),
                       [numbers](long long value) { return std::ranges::find(numbers, value) != numbers.end(); });
}

ValueCheck wordOf(const std::vector<std::string>& words)
{
    return [words](const std::string& text) -> std::string {
        if (std::ranges::find(words, text) != words.end())
            return {};
        return "expected " + eitherOf(words) + "; found '" + text + "'";
    };
}

} // namespace cotan
