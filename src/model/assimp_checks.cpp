// Checks PLY and COLLADA files before a parser that trusts them.
#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "assimp_convert.hpp"
#include "core/named_values.hpp"
#include "core/one_line.hpp"
#include "core/parse_number.hpp"

namespace cotan {

namespace {

// ---- PLY: the header -------------------------------------------------------------------------

constexpr Named<std::size_t> kTypeSizes[] = {{"char", 1},  {"uchar", 1},   {"int8", 1},   {"uint8", 1},
                                             {"short", 2}, {"ushort", 2},  {"int16", 2},  {"uint16", 2},
                                             {"int", 4},   {"uint", 4},    {"int32", 4},  {"uint32", 4},
                                             {"float", 4}, {"float32", 4}, {"double", 8}, {"float64", 8}};

// Size in bytes; 0 for an unknown type.
std::size_t typeSize(std::string_view name) { return valueOf(kTypeSizes, name).value_or(0); }

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

struct Property {
    std::string_view countType; // empty: not a list
    std::string_view type;
};

struct Element {
    std::uint64_t count = 0;
    std::vector<Property> properties;
};

// The header lines read so far.
struct Header {
    bool ascii = false;
    bool bigEndian = false;
    bool hasFormat = false;
    bool ended = false;
    std::vector<Element> elements;
    std::string unknownRows; // the first element that has rows and a name that Assimp does not know
};

void checkElement(Header& header, std::string_view name, std::string_view word, std::size_t fileBytes,
                  const LoadLimits& limits)
{
    // Assimp reads the count of an unknown element from its name. For a name with letters that gives 0, and the rows
    // are not skipped, so that the following elements are read at wrong offsets.
    if (name.front() >= '0' && name.front() <= '9')
        failModel("expected a name that starts with a letter, found \"{}\"", name.substr(0, 40));
    const bool geometry = name == "vertex" || name == "face" || name == "tristrips";
    if (geometry && !header.unknownRows.empty())
        failModel("expected the element \"{}\" before the element \"{}\"", name, header.unknownRows);
    std::uint64_t count = 0;
    if (!parseNumber(word, count))
        failModel("expected a count at the end");
    if (count > fileBytes || count > limits.vertices)
        failModel("{} elements exceed the file size or the limit", count);
    constexpr std::array<std::string_view, 5> kRead = {"vertex", "face", "tristrips", "edge", "material"};
    if (count > 0 && header.unknownRows.empty() && std::ranges::find(kRead, name) == kRead.end())
        header.unknownRows = name.substr(0, 40);
    header.elements.push_back({count, {}});
}

void checkProperty(Header& header, const std::vector<std::string_view>& words)
{
    const bool list = words.size() == 5 && words[1] == "list";
    const bool known =
        list ? typeSize(words[2]) > 0 && typeSize(words[3]) > 0 : words.size() == 3 && typeSize(words[1]) > 0;
    if (!known || header.elements.empty())
        failModel("expected a type and a name, after an element");
    if (list && (words[2].starts_with("float") || words[2].starts_with("double")))
        failModel("expected an integer type for the count of a list");
    header.elements.back().properties.push_back(list ? Property{words[2], words[3]} : Property{{}, words[1]});
}

void checkLine(Header& header, std::string_view line, std::size_t fileBytes, const LoadLimits& limits)
{
    const std::vector<std::string_view> words = split(line);
    if (words.empty())
        failModel("expected a header line, found none");
    const std::string_view keyword = words[0];
    if (keyword == "comment" || keyword == "obj_info")
        return;
    if (keyword == "format") {
        header.hasFormat = words.size() == 3
            && (words[1] == "ascii" || words[1] == "binary_little_endian" || words[1] == "binary_big_endian");
        header.ascii = header.hasFormat && words[1] == "ascii";
        header.bigEndian = header.hasFormat && words[1] == "binary_big_endian";
        if (!header.hasFormat || !header.elements.empty())
            failModel("expected ascii, binary_little_endian or binary_big_endian and a version");
        return;
    }
    if (!header.hasFormat)
        failModel("expected the format line first");
    if (keyword == "element" && words.size() == 3)
        return checkElement(header, words[1], words[2], fileBytes, limits);
    if (keyword == "property")
        return checkProperty(header, words);
    if (line == "end_header") {
        header.ended = true;
        return;
    }
    // Old exporters omit the word "comment" before their name.
    if (!header.elements.empty() || keyword.starts_with("e"))
        failModel("expected element, property, comment or end_header");
}

// ---- PLY: after the header -------------------------------------------------------------------

// Reads the count of a list. A negative count gives a value larger than any file.
std::uint64_t readCount(std::string_view bytes, std::string_view type, bool bigEndian)
{
    const std::size_t size = typeSize(type);
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < size; ++i)
        value = value << 8 | static_cast<unsigned char>(bytes[bigEndian ? i : size - 1 - i]);
    const bool isSigned = !type.starts_with('u');
    return isSigned && value >> (8 * size - 1) ? ~std::uint64_t(0) : value;
}

// Skips an element's rows; `rest` is the remainder of the file.
void walkBinary(const Element& element, bool bigEndian, std::string_view& rest)
{
    for (std::uint64_t row = 0; row < element.count; ++row) {
        for (const Property& property : element.properties) {
            std::uint64_t values = 1;
            if (!property.countType.empty()) {
                const std::size_t size = typeSize(property.countType);
                if (size > rest.size())
                    failModel("the file ends in the middle of its elements");
                values = readCount(rest, property.countType, bigEndian);
                rest.remove_prefix(size);
            }
            const std::size_t size = typeSize(property.type);
            if (values > rest.size() / size)
                failModel("expected {} values, but the file has only {} bytes left", values, rest.size());
            rest.remove_prefix(values * size);
        }
        if (element.properties.empty())
            break;
    }
}

// Skips rows of text, one per line.
void walkText(const Element& element, std::string_view& rest)
{
    for (std::uint64_t row = 0; row < element.count && !element.properties.empty(); ++row) {
        std::vector<std::string_view> words;
        while (words.empty()) {
            if (rest.empty())
                failModel("the file ends in the middle of its elements");
            const std::size_t end = std::min(rest.find_first_of("\r\n"), rest.size());
            words = split(rest.substr(0, end));
            rest.remove_prefix(std::min(end + 1, rest.size()));
        }
        std::size_t at = 0;
        for (const Property& property : element.properties) {
            std::uint64_t values = 1;
            if (!property.countType.empty() && at < words.size()) {
                const std::string_view word = words[at++];
                if (std::from_chars(word.data(), word.data() + word.size(), values).ec != std::errc{})
                    failModel("expected the count of a list, found \"{}\"", word.substr(0, 40));
            }
            if (values > words.size() - at)
                failModel("expected {} values, found {} on their line", values, words.size() - at);
            at += values;
        }
    }
}

// Calls check() and prefixes its errors with the part and its number.
void checkPart(const char* part, std::size_t number, const auto& check)
try {
    check();
} catch (const Error& problem) {
    failModel("{} {}: {}", part, number, problem.message);
}

// ---- COLLADA ---------------------------------------------------------------------------------

bool space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

void checkAttribute(std::string_view text, std::string_view attribute)
{
    for (std::size_t at = text.find(attribute); at != text.npos; at = text.find(attribute, at)) {
        at = text.find_first_of("\"'", at + attribute.size());
        if (at == text.npos)
            return;
        const std::string_view digits = text.substr(at + 1, 20);
        std::uint64_t count = 0;
        const auto error = std::from_chars(digits.begin(), digits.end(), count).ec;
        if (error == std::errc::result_out_of_range || count > text.size())
            failModel("expected a {} that fits the file, found {}", attribute,
                      digits.substr(0, digits.find_first_of("\"' >\n")));
    }
}

// The value of an attribute in the text of a tag; empty if it is missing.
std::string_view attributeOf(std::string_view tag, std::string_view attribute)
{
    for (std::size_t at = tag.find(attribute); at != tag.npos; at = tag.find(attribute, at + 1)) {
        const std::size_t equals = tag.find_first_not_of(" \t\r\n", at + attribute.size());
        if (at == 0 || !space(tag[at - 1]) || equals == tag.npos || tag[equals] != '=')
            continue; // part of another attribute
        const std::size_t quote = tag.find_first_of("\"'", equals);
        if (quote != tag.npos)
            return tag.substr(quote + 1, tag.find(tag[quote], quote + 1) - quote - 1);
    }
    return {};
}

std::uint64_t numberOf(std::string_view tag, std::string_view attribute, std::uint64_t fallback)
{
    const std::string_view digits = attributeOf(tag, attribute);
    std::uint64_t number = fallback; // checkAttribute has refused values that do not fit
    std::from_chars(digits.data(), digits.data() + digits.size(), number);
    return number;
}

// Calls f for every tag with this name, with the text from the name to the end of the tag and the offset of its end.
// Tags without an end are left to the parser, which reports them.
template<class F> void eachTag(std::string_view text, std::string_view name, F f)
{
    const std::string open = fmt::format("<{}", name);
    for (std::size_t at = text.find(open); at != text.npos; at = text.find(open, at)) {
        at += open.size();
        if (at < text.size() && text[at] != '>' && !space(text[at]))
            continue; // a longer name
        const std::size_t end = text.find('>', at);
        if (end == text.npos)
            return;
        f(text.substr(at, end - at), end);
        at = end; // keeps the scan linear
    }
}

void checkNumbers(std::string_view text, std::string_view element)
{
    eachTag(text, element, [&](std::string_view, std::size_t close) {
        const std::size_t end = text.find_first_not_of("0123456789+- \t\r\n", close + 1);
        if (text[close - 1] != '/' && (end == text.npos || !text.substr(end).starts_with("</")))
            failModel("expected only integers in <{}>", element);
    });
}

// Checks that accessors stay within the float arrays that they read.
void checkAccessors(std::string_view text)
{
    std::map<std::string_view, std::uint64_t> counts;
    eachTag(text, "float_array", [&](std::string_view tag, std::size_t) {
        if (tag.empty())
            return;
        const std::uint64_t count = numberOf(tag, "count", 0);
        const auto entry = counts.try_emplace(attributeOf(tag, "id"), count).first;
        entry->second = std::min(entry->second, count);
    });
    eachTag(text, "accessor", [&](std::string_view tag, std::size_t end) {
        const std::string_view source = attributeOf(tag, "source");
        const auto array = counts.find(source.substr(std::min<std::size_t>(source.size(), 1)));
        const std::uint64_t count = numberOf(tag, "count", 0);
        if (array == counts.end() || count == 0)
            return;
        std::uint64_t params = 0;
        const std::string_view inside = text.substr(end, text.find("</accessor", end) - end);
        for (std::size_t at = inside.find("<param"); at != inside.npos; at = inside.find("<param", at + 1))
            ++params;
        const std::uint64_t needed =
            numberOf(tag, "offset", 0) + (count - 1) * numberOf(tag, "stride", 1) + std::max<std::uint64_t>(params, 1);
        if (needed > array->second)
            failModel("accessor of {}: expected an array of at least {} numbers, found {}", oneLine(source), needed,
                      array->second);
    });
}

} // namespace

void checkPly(std::span<const std::byte> bytes, const LoadLimits& limits)
{
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    Header header;
    std::size_t at = 0;
    for (std::size_t number = 1; !header.ended; ++number) {
        const std::size_t end = text.find('\n', at);
        if (end == std::string_view::npos)
            failModel("expected end_header, found the end of the file");
        std::string_view line = text.substr(at, end - at);
        at = end + 1;
        while (!line.empty() && (line.back() == '\r' || line.back() == ' ' || line.back() == '\t'))
            line.remove_suffix(1);
        if (number == 1 && line != "ply")
            failModel("expected \"ply\" at the start, found other data");
        if (number > 1)
            checkPart("header line", number, [&] { checkLine(header, line, bytes.size(), limits); });
    }
    std::string_view rest = text.substr(at);
    // Assimp takes a zero byte as the end of the file, and leaves the remaining faces uninitialised.
    if (header.ascii && rest.find('\0') != std::string_view::npos)
        failModel("expected text, found a zero byte at {}", at + rest.find('\0'));
    for (std::size_t e = 0; e < header.elements.size(); ++e)
        checkPart("element", e, [&] {
            header.ascii ? walkText(header.elements[e], rest) : walkBinary(header.elements[e], header.bigEndian, rest);
        });
}

void checkCollada(std::span<const std::byte> bytes)
{
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (text.find('\0') != text.npos)
        failModel("expected UTF-8 text, found a zero byte");
    for (const std::string_view attribute : {"count", "offset", "stride"})
        checkAttribute(text, attribute);
    for (const std::string_view element : {"p", "h", "v", "vcount", "int_array"})
        checkNumbers(text, element);
    checkAccessors(text);
}

} // namespace cotan
