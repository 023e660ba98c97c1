#include "collada_check.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>

#include <fmt/format.h>

namespace cotan {

namespace {

using Problem = std::optional<std::string>;

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
    return Done{};
}

} // namespace cotan
