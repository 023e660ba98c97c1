#include "ply_check.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace cotan {

namespace {

using Problem = std::optional<std::string>; // expected and found, without file and line

struct TypeSize {
    std::string_view name;
    std::size_t bytes;
};

constexpr std::array<TypeSize, 16> kTypes = {{{"char", 1},
                                              {"uchar", 1},
                                              {"int8", 1},
                                              {"uint8", 1},
                                              {"short", 2},
                                              {"ushort", 2},
                                              {"int16", 2},
                                              {"uint16", 2},
                                              {"int", 4},
                                              {"uint", 4},
                                              {"int32", 4},
                                              {"uint32", 4},
                                              {"float", 4},
                                              {"float32", 4},
                                              {"double", 8},
                                              {"float64", 8}}};

std::size_t typeSize(std::string_view name)
{
    for (const TypeSize& type : kTypes)
        if (type.name == name)
            return type.bytes;
    return 0;
}

std::vector<std::string_view> split(std::string_view line)
{
    std::vector<std::string_view> words;
    for (std::size_t at = 0;;) {
        at = line.find_first_not_of(" \t", at);
        if (at == std::string_view::npos)
            return words;
        const std::size_t end = std::min(line.find_first_of(" \t", at), line.size());
        words.push_back(line.substr(at, end - at));
        at = end;
    }
}

// The header as far as it has been read.
struct Header {
    bool ascii = false;
    bool hasFormat = false;
    bool ended = false;
    std::uint64_t leastBytes = 0; // of the elements so far, but the last
    std::uint64_t count = 0;      // of the last element
    std::uint64_t rowBytes = 0;   // of one of it, at least
    bool hasElement = false;
};

// Counts are at most the size of the file and rows short, so nothing here overflows 64 bits.
void closeElement(Header& header)
{
    header.leastBytes += header.count * header.rowBytes;
    header.count = header.rowBytes = 0;
}

Problem checkElement(Header& header, std::string_view word, std::size_t fileBytes,
                     const LoadLimits& limits)
{
    closeElement(header);
    header.hasElement = true;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), header.count);
    if (error != std::errc{} || end != word.data() + word.size())
        return "expected a count at the end";
    if (header.count > fileBytes || header.count > limits.vertices)
        return fmt::format("it counts {} elements, more than the file can hold or the limit allows",
                           header.count);
    return std::nullopt;
}

Problem checkProperty(Header& header, const std::vector<std::string_view>& words)
{
    const bool list = words.size() == 5 && words[1] == "list";
    const bool known = list ? typeSize(words[2]) > 0 && typeSize(words[3]) > 0
                            : words.size() == 3 && typeSize(words[1]) > 0;
    if (!known || !header.hasElement)
        return "expected a type and a name, behind an element";
    // In text a value takes a digit and a space or line end.
    header.rowBytes += header.ascii ? 2 : typeSize(words[list ? 2 : 1]);
    return std::nullopt;
}

Problem checkLine(Header& header, std::string_view line, std::size_t fileBytes,
                  const LoadLimits& limits)
{
    const std::vector<std::string_view> words = split(line);
    if (words.empty())
        return "expected a header line, found none";
    const std::string_view keyword = words[0];
    if (keyword == "comment" || keyword == "obj_info")
        return std::nullopt;
    if (keyword == "format") {
        header.hasFormat = words.size() == 3
            && (words[1] == "ascii" || words[1] == "binary_little_endian"
                || words[1] == "binary_big_endian");
        header.ascii = header.hasFormat && words[1] == "ascii";
        if (!header.hasFormat || header.hasElement)
            return "expected ascii, binary_little_endian or binary_big_endian and a version";
        return std::nullopt;
    }
    if (!header.hasFormat)
        return "expected the format line first";
    if (keyword == "element" && words.size() == 3)
        return checkElement(header, words[2], fileBytes, limits);
    if (keyword == "property")
        return checkProperty(header, words);
    if (line == "end_header") {
        header.ended = true;
        closeElement(header);
        return std::nullopt;
    }
    // Old exporters forget the word "comment" in front of their name.
    if (header.hasElement || keyword.starts_with("e"))
        return "expected element, property, comment or end_header";
    return std::nullopt;
}

} // namespace

Status checkPly(std::span<const std::byte> bytes, const std::string& name, const LoadLimits& limits)
{
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    Header header;
    std::size_t at = 0;
    for (std::size_t number = 1; !header.ended; ++number) {
        const std::size_t end = text.find('\n', at);
        if (end == std::string_view::npos)
            return inputError(
                fmt::format("{}: expected end_header, found the end of the file", name));
        std::string_view line = text.substr(at, end - at);
        at = end + 1;
        while (!line.empty() && (line.back() == '\r' || line.back() == ' ' || line.back() == '\t'))
            line.remove_suffix(1);
        if (number == 1 && line != "ply")
            return inputError(
                fmt::format("{}: expected \"ply\" at the start, found other data", name));
        if (number == 1)
            continue;
        if (Problem problem = checkLine(header, line, bytes.size(), limits))
            return inputError(fmt::format("{}: header line {}: {}", name, number, *problem));
    }
    // The last line of a text need not end.
    if (text.size() - at + 1 < header.leastBytes)
        return inputError(
            fmt::format("{}: the header's counts take at least {} bytes, the file has {} after it",
                        name, header.leastBytes, text.size() - at));
    return Done{};
}

} // namespace cotan
