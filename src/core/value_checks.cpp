#include "core/value_checks.hpp"

#include <algorithm>
#include <cstdlib>
#include <optional>

#include "core/named_values.hpp"
#include "core/real_number.hpp"

namespace cotan {

namespace {

// Returns a check for numbers. expected: such as "a whole number from 0 to 8". read: returns an optional number.
// CLI11's own range checks accept NaN.
template<class Read, class IsGood> ValueCheck numberCheck(const std::string& expected, Read read, IsGood isGood)
{
    return [=](const std::string& text) -> std::string {
        const auto value = read(text);
        return value && isGood(*value) ? std::string() : "expected " + expected + "; found '" + text + "'";
    };
}

std::optional<long long> readWhole(const std::string& text)
{
    char* end = nullptr;
    const long long value = std::strtoll(text.c_str(), &end, 0);
    return !text.empty() && *end == '\0' ? std::optional(value) : std::nullopt;
}

} // namespace

ValueCheck numberAbove0()
{
    return numberCheck("a number above 0 and at most 1e6", parseReal,
                       [](double x) { return float(x) > 0 && float(x) <= 1e6f; });
}

ValueCheck numberAbove0Or(const std::string& word)
{
    return [word, number = numberAbove0()](const std::string& text) {
        const std::string wrong = text == word ? "" : number(text);
        return wrong.empty() ? "" : "expected " + word + " or " + wrong.substr(wrong.find(' ') + 1);
    };
}

ValueCheck numberWithin(double minimum, double maximum)
{
    return numberCheck("a number from " + textOfReal(minimum) + " to " + textOfReal(maximum), parseReal,
                       [=](double value) { return value >= minimum && value <= maximum; });
}

ValueCheck wholeNumberWithin(long long minimum, long long maximum)
{
    return numberCheck("a whole number from " + std::to_string(minimum) + " to " + std::to_string(maximum), readWhole,
                       [=](long long value) { return value >= minimum && value <= maximum; });
}

ValueCheck wholeNumberOf(const std::vector<long long>& numbers)
{
    std::vector<std::string> words;
    for (const long long number : numbers)
        words.push_back(std::to_string(number));
    return numberCheck(eitherOf(words), readWhole,
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
