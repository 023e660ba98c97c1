#include "assimp_convert.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <map>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "text_lines.hpp"

namespace cotan {

namespace {

using Problem = std::optional<std::string>;

bool space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

Problem checkAttribute(std::string_view text, std::string_view attribute)
{
    for (std::size_t at = text.find(attribute); at != text.npos; at = text.find(attribute, at)) {
        at = text.find_first_of("\"'", at + attribute.size());
        if (at == text.npos)
            return std::nullopt;
        const std::string_view digits = text.substr(at + 1, 20);
        std::uint64_t count = 0;
        const auto error = std::from_chars(digits.begin(), digits.end(), count).ec;
        if (error == std::errc::result_out_of_range || count > text.size())
            return fmt::format("expected a {} that fits the file, found {}", attribute,
                               digits.substr(0, digits.find_first_of("\"' >\n")));
    }
    return std::nullopt;
}

Problem checkNumbers(std::string_view text, std::string_view element)
{
    const std::string open = fmt::format("<{}", element);
    for (std::size_t at = text.find(open); at != text.npos; at = text.find(open, at)) {
        at += open.size();
        if (at == text.size() || std::string_view("> \t\r\n").find(text[at]) == text.npos)
            continue; // a longer name
        const std::size_t begin = text.find('>', at);
        if (begin == text.npos)
            return std::nullopt; // no XML: the parser says so
        if (text[begin - 1] == '/')
            continue;
        const std::size_t end = text.find_first_not_of("0123456789+- \t\r\n", begin + 1);
        if (end == text.npos || !text.substr(end).starts_with("</"))
            return fmt::format("expected nothing but whole numbers in <{}>", element);
    }
    return std::nullopt;
}

// The value of an attribute in the text of a tag; empty if it is not there.
std::string_view attributeOf(std::string_view tag, std::string_view attribute)
{
    for (std::size_t at = tag.find(attribute); at != tag.npos; at = tag.find(attribute, at + 1)) {
        const std::size_t equals = tag.find_first_not_of(" \t\r\n", at + attribute.size());
        if (at == 0 || !space(tag[at - 1]) || equals == tag.npos || tag[equals] != '=')
            continue; // a part of another one
        const std::size_t quote = tag.find_first_of("\"'", equals);
        if (quote != tag.npos)
            return tag.substr(quote + 1, tag.find(tag[quote], quote + 1) - quote - 1);
    }
    return {};
}

std::uint64_t numberOf(std::string_view tag, std::string_view attribute, std::uint64_t fallback)
{
    const std::string_view digits = attributeOf(tag, attribute);
    std::uint64_t number = fallback; // checkAttribute has refused what does not fit
    std::from_chars(digits.data(), digits.data() + digits.size(), number);
    return number;
}

// Calls f with the text of every tag of that name, from behind the name, and with where the tag ends.
template<class F> void eachTag(std::string_view text, std::string_view name, F f)
{
    const std::string open = fmt::format("<{}", name);
    for (std::size_t at = text.find(open); at != text.npos; at = text.find(open, at)) {
        at += open.size();
        const std::size_t end = text.find('>', at);
        if (end == text.npos)
            return;
        if (space(text[at]))
            f(text.substr(at, end - at), end);
    }
}

// Accessors read from arrays of numbers; no further than these reach.
Problem checkAccessors(std::string_view text)
{
    std::map<std::string_view, std::uint64_t> counts;
    eachTag(text, "float_array", [&](std::string_view tag, std::size_t) {
        const auto [entry, isNew] = counts.try_emplace(attributeOf(tag, "id"), numberOf(tag, "count", 0));
        entry->second = std::min(entry->second, numberOf(tag, "count", 0));
    });
    Problem problem;
    eachTag(text, "accessor", [&](std::string_view tag, std::size_t end) {
        const std::string_view source = attributeOf(tag, "source");
        const auto array = counts.find(source.substr(std::min<std::size_t>(source.size(), 1)));
        const std::uint64_t count = numberOf(tag, "count", 0);
        if (problem || array == counts.end() || count == 0)
            return;
        std::uint64_t params = 0;
        const std::string_view inside = text.substr(end, text.find("</accessor", end) - end);
        for (std::size_t at = inside.find("<param"); at != inside.npos; at = inside.find("<param", at + 1))
            ++params;
        const std::uint64_t needed =
            numberOf(tag, "offset", 0) + (count - 1) * numberOf(tag, "stride", 1) + std::max<std::uint64_t>(params, 1);
        if (needed > array->second)
            problem = fmt::format("accessor of {}: expected an array of {} numbers or more, found {}",
                                  withoutBreaks(std::string(source)), needed, array->second);
    });
    return problem;
}

} // namespace

Status checkCollada(std::span<const std::byte> bytes, const std::string& name)
{
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (text.find('\0') != text.npos)
        return inputError(fmt::format("{}: expected UTF-8 text, found a zero byte", name));
    for (const std::string_view attribute : {"count", "offset", "stride"})
        if (Problem problem = checkAttribute(text, attribute))
            return inputError(fmt::format("{}: {}", name, *problem));
    for (const std::string_view element : {"p", "h", "v", "vcount", "int_array"})
        if (Problem problem = checkNumbers(text, element))
            return inputError(fmt::format("{}: {}", name, *problem));
    if (Problem problem = checkAccessors(text))
        return inputError(fmt::format("{}: {}", name, *problem));
    return Done{};
}

} // namespace cotan
