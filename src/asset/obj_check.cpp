#include "obj_check.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <optional>
#include <string_view>

#include <fmt/format.h>

namespace cotan {

namespace {

using Problem = std::optional<std::string>; // expected and found, without file and line

constexpr std::array<std::string_view, 3> kAttributeName = {"position", "texture coordinate",
                                                            "normal"};

// The largest index of each attribute that a face names, and where, to be compared with the totals
// at the end: a face may stand before what it refers to.
struct HighestIndex {
    std::int64_t value = 0;
    std::size_t offset = 0;
};

struct Check {
    std::string& text;
    const LoadLimits& limits;
    ObjFacts facts;
    std::array<std::int64_t, 3> counts{}; // positions, texture coordinates, normals so far
    std::array<HighestIndex, 3> highest{};
    std::vector<std::size_t> joined; // offsets where a continued line was joined
};

// How many bytes at `i` are a line end that a backslash before it would undo: 0, 1 or 2.
std::size_t lineEndAt(const std::string& text, std::size_t i)
{
    if (i < text.size() && text[i] == '\n')
        return 1;
    if (i < text.size() && text[i] == '\r')
        return i + 1 < text.size() && text[i + 1] == '\n' ? 2 : 1;
    return 0;
}

// Joins continued lines, makes all white space ' ' or '\n' and leaves none around a line.
void unifySpace(Check& check)
{
    std::string& text = check.text;
    std::size_t out = 0;
    std::size_t in = text.starts_with("\xef\xbb\xbf") ? 3 : 0; // a byte order mark
    const auto put = [&](char c) {
        if (c == '\n')
            while (out > 0 && text[out - 1] == ' ')
                --out;
        if (c != ' ' || (out > 0 && text[out - 1] != '\n'))
            text[out++] = c;
    };
    while (in < text.size()) {
        const char c = text[in];
        if (const std::size_t end = lineEndAt(text, in)) {
            put('\n');
            in += end;
        } else if (const std::size_t undone = c == '\\' ? lineEndAt(text, in + 1) : 0) {
            put(' ');
            check.joined.push_back(out);
            in += 1 + undone;
        } else {
            put(c == '\t' || c == '\v' || c == '\f' ? ' ' : c);
            ++in;
        }
    }
    text.resize(out);
}

std::size_t lineNumber(const Check& check, std::size_t offset)
{
    const auto before = check.text.begin() + std::ptrdiff_t(offset);
    return 1 + std::size_t(std::count(check.text.begin(), before, '\n'))
        + std::size_t(std::ranges::upper_bound(check.joined, offset) - check.joined.begin());
}

// Walks over the words of a line.
struct Words {
    std::string_view rest;

    std::string_view next()
    {
        const std::size_t start = std::min(rest.find_first_not_of(' '), rest.size());
        const std::size_t end = std::min(rest.find(' ', start), rest.size());
        const std::string_view word = rest.substr(start, end - start);
        rest.remove_prefix(end);
        return word;
    }
};

std::string quoted(std::string_view word)
{
    std::string shown(word.substr(0, 40));
    std::ranges::replace_if(
        shown, [](unsigned char c) { return c < 32 || c > 126; }, '?');
    return fmt::format("\"{}\"", shown);
}

// Whether the word is a number that a float can hold.
bool isFiniteNumber(std::string_view word)
{
    if (word.starts_with('+'))
        word.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (end != word.data() + word.size() || word.empty() || word.starts_with('+'))
        return false;
    if (error == std::errc::result_out_of_range) // too large, or so small that it is zero
        value = std::strtod(std::string(word).c_str(), nullptr);
    else if (error != std::errc{})
        return false;
    return std::abs(value) <= double(std::numeric_limits<float>::max());
}

Problem checkNumbers(Words words, int atLeast, int atMost)
{
    int count = 0;
    for (std::string_view word = words.next(); !word.empty(); word = words.next(), ++count)
        if (!isFiniteNumber(word))
            return fmt::format("expected a finite number, found {}", quoted(word));
    if (count < atLeast || count > atMost)
        return fmt::format("expected {} to {} numbers, found {}", atLeast, atMost, count);
    return std::nullopt;
}

// Bit k: the corner names attribute k.
using Named = unsigned;

Problem checkIndex(Check& check, std::size_t attribute, std::int64_t index, std::size_t offset)
{
    if (index == 0)
        return "expected an index from 1 or a negative one, found 0";
    if (index < 0 && index + check.counts[attribute] < 0)
        return fmt::format("expected a {} index down to -{}, found {}", kAttributeName[attribute],
                           check.counts[attribute], index);
    HighestIndex& highest = check.highest[attribute];
    if (index > highest.value)
        highest = {index, offset};
    return std::nullopt;
}

// A corner is v, v/vt, v//vn or v/vt/vn.
Problem checkCorner(Check& check, std::string_view corner, std::size_t offset, Named& named)
{
    named = 0;
    const char* at = corner.data();
    const char* const end = at + corner.size();
    for (std::size_t attribute = 0; at != end; ++attribute) {
        std::int64_t index = 0;
        if (attribute > 2)
            return fmt::format("expected a corner v/vt/vn, found {}", quoted(corner));
        if (*at != '/') {
            if (*at == '+')
                ++at;
            const auto [after, error] = std::from_chars(at, end, index);
            if (error != std::errc{} || (after != end && *after != '/'))
                return fmt::format("expected a corner v/vt/vn, found {}", quoted(corner));
            if (Problem problem = checkIndex(check, attribute, index, offset))
                return problem;
            named |= 1u << attribute;
            at = after;
        }
        if (at != end) // the slash
            ++at;
    }
    if (!(named & 1u))
        return fmt::format("expected a corner with a position, found {}", quoted(corner));
    return std::nullopt;
}

Problem checkFace(Check& check, Words words, std::size_t offset)
{
    std::size_t corners = 0;
    Named first = 0;
    for (std::string_view word = words.next(); !word.empty(); word = words.next(), ++corners) {
        Named named = 0;
        if (Problem problem = checkCorner(check, word, offset, named))
            return problem;
        if (corners == 0)
            first = named;
        if (named != first)
            return "expected every corner of a face to name the same attributes, found a mixture";
    }
    if (corners == 0)
        return "expected the corners of a face, found none";
    if (corners >= 3) {
        ++check.facts.polygons;
        check.facts.triangles += corners - 2;
        check.facts.polygonsWithoutUv += first & 2u ? 0 : 1;
        if (check.facts.triangles > check.limits.triangles)
            return fmt::format("over the limit of {} triangles", check.limits.triangles);
    }
    return std::nullopt;
}

void blankComment(Check& check, std::size_t begin, std::size_t end)
{
    const auto last = check.text.begin() + std::ptrdiff_t(end);
    std::fill(std::find(check.text.begin() + std::ptrdiff_t(begin), last, '#'), last, ' ');
}

Problem countAttribute(Check& check, std::size_t attribute)
{
    if (std::size_t(++check.counts[attribute]) > check.limits.vertices)
        return fmt::format("over the limit of {} vertices", check.limits.vertices);
    return std::nullopt;
}

// One line, [begin, end) of the text.
Problem checkLine(Check& check, std::size_t begin, std::size_t end)
{
    const auto view = [&] { return std::string_view(check.text).substr(begin, end - begin); };
    Words words{view()};
    const std::string_view keyword = words.next();
    if (keyword.empty() || keyword.front() == '#')
        return std::nullopt;

    const bool data = keyword == "v" || keyword == "vt" || keyword == "vn" || keyword == "f";
    if (data) {
        blankComment(check, begin, end);
        if (keyword == "f")
            return checkFace(check, words, begin);
        const std::size_t attribute = keyword == "v" ? 0 : keyword == "vt" ? 1 : 2;
        if (Problem problem = countAttribute(check, attribute))
            return problem;
        return attribute == 0 ? checkNumbers(words, 3, 7)
            : attribute == 1  ? checkNumbers(words, 2, 3)
                              : checkNumbers(words, 3, 3);
    }
    if (keyword == "mtllib") {
        const std::size_t start = words.rest.find_first_not_of(' ');
        if (start != std::string_view::npos) {
            std::string_view library = words.rest.substr(start);
            library.remove_suffix(library.size() - 1 - library.find_last_not_of(' '));
            check.facts.libraries.emplace_back(library);
        }
        return std::nullopt;
    }
    if (keyword != "g" && keyword != "o" && keyword != "s" && keyword != "usemtl")
        check.text[std::size_t(keyword.data() - check.text.data())] = '#';
    return std::nullopt;
}

Problem checkLines(Check& check, std::size_t& offset)
{
    if (const std::size_t zero = check.text.find('\0'); zero != std::string::npos) {
        offset = zero;
        return "expected text, found a zero byte";
    }
    for (offset = 0; offset < check.text.size();) {
        const std::size_t end = std::min(check.text.find('\n', offset), check.text.size());
        if (Problem problem = checkLine(check, offset, end))
            return problem;
        offset = end + 1;
    }
    for (std::size_t attribute = 0; attribute < 3; ++attribute) {
        const HighestIndex& highest = check.highest[attribute];
        if (highest.value > check.counts[attribute]) {
            offset = highest.offset;
            return fmt::format("expected a {} index up to {}, found {}", kAttributeName[attribute],
                               check.counts[attribute], highest.value);
        }
    }
    return std::nullopt;
}

} // namespace

Result<ObjFacts> checkObj(std::string& text, const std::string& name, const LoadLimits& limits)
{
    Check check{text, limits, {}, {}, {}, {}};
    unifySpace(check);
    std::size_t offset = 0;
    if (Problem problem = checkLines(check, offset))
        return inputError(
            fmt::format("{}: line {}: {}", name, lineNumber(check, offset), *problem));
    if (check.facts.polygons == 0)
        return inputError(fmt::format("{}: expected faces, found none", name));
    check.facts.positions = std::size_t(check.counts[0]);
    check.facts.texcoords = std::size_t(check.counts[1]);
    check.facts.normals = std::size_t(check.counts[2]);
    return std::move(check.facts);
}

} // namespace cotan
