#include "obj_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "core/real_number.hpp"
#include "source_material.hpp"

namespace cotan {

namespace {

// The length of a line end at `i` that a preceding backslash would continue: 0, 1 or 2 bytes.
std::size_t lineEndAt(const std::string& text, std::size_t i)
{
    if (i < text.size() && text[i] == '\n')
        return 1;
    if (i < text.size() && text[i] == '\r')
        return i + 1 < text.size() && text[i + 1] == '\n' ? 2 : 1;
    return 0;
}

// Quotes text from a file for a message: at most 40 characters, without control characters.
std::string quotedWord(std::string_view word)
{
    std::string shown(word.substr(0, 40));
    std::ranges::replace_if(
        shown, [](unsigned char c) { return c < 32 || c > 126; }, '?');
    return fmt::format("\"{}\"", shown);
}

constexpr std::array<std::string_view, 3> kAttributeName = {"position", "texture coordinate", "normal"};

// Budget of tests while polygons are cut, one or two seconds. A star, a comb or a spiral of 20,000 corners takes up to
// 30 million.
constexpr std::size_t kCuttingSteps = 100'000'000;

// The largest index of an attribute in faces and its location. It is compared with the totals at the end, because a
// face may precede the elements it refers to.
struct HighestIndex {
    std::int64_t value = 0;
    std::size_t offset = 0;
};

struct Polygon {
    std::size_t part = 0;
    std::size_t corners = 0;
    std::size_t offset = 0; // of its line
};

struct Parser {
    const LoadLimits& limits;
    ObjText out;
    std::array<std::int64_t, 3> counts{}; // numbers of positions, texture coordinates and normals so far
    std::array<HighestIndex, 3> highest{};
    std::string name, material; // of the next face
    std::optional<std::size_t> part;
    std::map<std::pair<std::string, std::string>, std::size_t> parts;
    std::vector<Polygon> polygons;
    std::vector<ObjCorner> corners; // of all polygons, concatenated
    std::size_t triangles = 0;
    std::size_t offset = 0; // of the current line
};

// Adds x y z, optionally with a weight, with a colour, or with a colour and alpha.
void addPosition(ObjText& out, const std::array<float, 7>& n, std::size_t count)
{
    if (count != 3 && count != 4 && count != 6 && count != 7)
        failModel("expected 3, 4, 6 or 7 numbers, found {}", count);
    glm::vec3 position(n[0], n[1], n[2]);
    if (count == 4) {
        if (n[3] == 0)
            failModel("expected a weight other than 0");
        position /= n[3];
        if (!(glm::abs(position.x) + glm::abs(position.y) + glm::abs(position.z) < 1e38f))
            failModel("expected a position within the range of float");
    }
    if (count >= 6 || !out.colors.empty()) {
        out.colors.resize(out.positions.size(), glm::vec4(1));
        out.colors.push_back(count >= 6 ? glm::vec4(n[3], n[4], n[5], count == 7 ? n[6] : 1.0f) : glm::vec4(1));
    }
    out.positions.push_back(position);
}

// attribute: 0 position, 1 texture coordinate, 2 normal.
void readAttribute(Parser& parser, std::size_t attribute, Words words)
{
    std::array<float, 7> n{};
    std::size_t count = 0;
    for (std::string_view word = words.next(); !word.empty(); word = words.next(), ++count) {
        const auto number = finiteNumber(word);
        if (!number)
            failModel("expected a finite number, found {}", quotedWord(word));
        if (count < n.size())
            n[count] = *number;
    }
    if (attribute == 0) {
        addPosition(parser.out, n, count);
    } else if (attribute == 1) {
        if (count < 1 || count > 3)
            failModel("expected 1 to 3 numbers, found {}", count);
        parser.out.texcoords.emplace_back(n[0], n[1]);
    } else {
        if (count != 3)
            failModel("expected 3 numbers, found {}", count);
        parser.out.normals.emplace_back(n[0], n[1], n[2]);
    }
    if (std::size_t(++parser.counts[attribute]) > parser.limits.vertices)
        failModel("over the limit of {} vertices", parser.limits.vertices);
}

// Returns the array index. Indices above the totals are refused at the end, before use.
std::uint32_t readIndex(Parser& parser, std::size_t attribute, std::int64_t index)
{
    if (index == 0)
        failModel("expected a positive or negative index, found 0");
    if (index < 0 && index + parser.counts[attribute] < 0)
        failModel("expected a {} index of at least -{}, found {}", kAttributeName[attribute], parser.counts[attribute],
                  index);
    if (index < 0)
        index += parser.counts[attribute] + 1;
    HighestIndex& highest = parser.highest[attribute];
    if (index > highest.value)
        highest = {index, parser.offset};
    return std::uint32_t(index - 1);
}

// Parses v, v/vt, v//vn or v/vt/vn.
ObjCorner readCorner(Parser& parser, std::string_view text)
{
    ObjCorner corner;
    const std::array<std::uint32_t*, 3> indices = {&corner.position, &corner.texcoord, &corner.normal};
    const char* at = text.data();
    const char* const end = at + text.size();
    for (std::size_t attribute = 0; at != end; ++attribute) {
        std::int64_t index = 0;
        if (attribute > 2)
            failModel("expected a corner v/vt/vn, found {}", quotedWord(text));
        if (*at != '/') {
            if (*at == '+')
                ++at;
            const auto [after, error] = std::from_chars(at, end, index);
            if (error != std::errc{} || (after != end && *after != '/'))
                failModel("expected a corner v/vt/vn, found {}", quotedWord(text));
            *indices[attribute] = readIndex(parser, attribute, index);
            at = after;
        }
        if (at != end) // skips the slash
            ++at;
    }
    if (corner.position == kObjNone)
        failModel("expected a corner with a position, found {}", quotedWord(text));
    return corner;
}

std::size_t currentPart(Parser& parser)
{
    if (!parser.part) {
        const auto [entry, isNew] = parser.parts.try_emplace({parser.name, parser.material}, parser.out.parts.size());
        if (isNew)
            parser.out.parts.push_back({parser.name, parser.material, {}});
        parser.part = entry->second;
    }
    return *parser.part;
}

void readFace(Parser& parser, Words words)
{
    const std::size_t before = parser.corners.size();
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
        const ObjCorner corner = readCorner(parser, word);
        const ObjCorner& first = parser.corners.size() > before ? parser.corners[before] : corner;
        if ((corner.texcoord == kObjNone) != (first.texcoord == kObjNone)
            || (corner.normal == kObjNone) != (first.normal == kObjNone))
            failModel("expected all corners of a face to have the same attributes, found a mixture");
        parser.corners.push_back(corner);
    }
    const std::size_t corners = parser.corners.size() - before;
    if (corners == 0)
        failModel("expected the corners of a face, found none");
    if (corners < 3) { // a line or a point
        parser.corners.resize(before);
        return;
    }
    ++parser.out.polygons;
    parser.out.polygonsWithoutUv += parser.corners[before].texcoord == kObjNone ? 1 : 0;
    parser.triangles += corners - 2;
    if (parser.triangles > parser.limits.triangles)
        failModel("over the limit of {} triangles", parser.limits.triangles);
    parser.polygons.push_back({currentPart(parser), corners, parser.offset});
    if (parser.out.parts.size() > parser.limits.nodes)
        failModel("over the limit of {} nodes, one per group and material", parser.limits.nodes);
}

void readLine(Parser& parser, std::string_view line)
{
    Words words{line};
    const std::string_view keyword = words.next();
    const Words data{words.rest.substr(0, words.rest.find('#'))};
    if (keyword == "v")
        return readAttribute(parser, 0, data);
    if (keyword == "vt")
        return readAttribute(parser, 1, data);
    if (keyword == "vn")
        return readAttribute(parser, 2, data);
    if (keyword == "f" || keyword == "fo") // "fo" is obsolete
        return readFace(parser, data);
    if (keyword == "mtllib" && !words.all().empty())
        parser.out.libraries.emplace_back(words.all());
    if (keyword == "g" || keyword == "o")
        parser.name = words.all();
    if (keyword == "usemtl")
        parser.material = words.all();
    if (keyword == "g" || keyword == "o" || keyword == "usemtl")
        parser.part.reset();
}

void readLines(Parser& parser, const std::string& text)
{
    if (const std::size_t zero = text.find('\0'); zero != std::string::npos) {
        parser.offset = zero;
        failModel("expected text, found a zero byte");
    }
    while (parser.offset < text.size()) {
        const std::size_t end = std::min(text.find('\n', parser.offset), text.size());
        readLine(parser, std::string_view(text).substr(parser.offset, end - parser.offset));
        parser.offset = end + 1;
    }
    for (std::size_t attribute = 0; attribute < 3; ++attribute) {
        const HighestIndex& highest = parser.highest[attribute];
        if (highest.value > parser.counts[attribute]) {
            parser.offset = highest.offset;
            failModel("expected a {} index up to {}, found {}", kAttributeName[attribute], parser.counts[attribute],
                      highest.value);
        }
    }
}

void cutPolygons(Parser& parser)
{
    std::size_t stepsLeft = kCuttingSteps, first = 0;
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> triangles;
    for (const Polygon& polygon : parser.polygons) {
        const ObjCorner* const corners = parser.corners.data() + first;
        first += polygon.corners;
        positions.clear();
        triangles.clear();
        for (std::size_t i = 0; i < polygon.corners; ++i)
            positions.push_back(parser.out.positions[corners[i].position]);
        if (!cutPolygon(positions, triangles, stepsLeft)) {
            parser.offset = polygon.offset;
            failModel("over the limit of {} triangulation steps, at a polygon of {} corners", kCuttingSteps,
                      polygon.corners);
        }
        for (const std::uint32_t corner : triangles)
            parser.out.parts[polygon.part].corners.push_back(corners[corner]);
    }
}

} // namespace

TextLines::TextLines(std::string source) : text_(std::move(source))
{
    std::size_t out = 0;
    std::size_t in = text_.starts_with("\xef\xbb\xbf") ? 3 : 0; // byte order mark
    const auto put = [&](char c) {
        if (c == '\n')
            while (out > 0 && text_[out - 1] == ' ')
                --out;
        if (c != ' ' || (out > 0 && text_[out - 1] != '\n'))
            text_[out++] = c;
    };
    while (in < text_.size()) {
        const char c = text_[in];
        if (const std::size_t end = lineEndAt(text_, in)) {
            put('\n');
            in += end;
        } else if (const std::size_t skipped = c == '\\' ? lineEndAt(text_, in + 1) : 0) {
            put(' ');
            joined_.push_back(out);
            in += 1 + skipped;
        } else {
            put(c == '\t' || c == '\v' || c == '\f' ? ' ' : c);
            ++in;
        }
    }
    text_.resize(out);
}

std::size_t TextLines::number(std::size_t offset) const
{
    const auto before = text_.begin() + std::ptrdiff_t(offset);
    return 1 + std::size_t(std::count(text_.begin(), before, '\n'))
        + std::size_t(std::ranges::upper_bound(joined_, offset) - joined_.begin());
}

std::string_view Words::next()
{
    const std::size_t start = std::min(rest.find_first_not_of(' '), rest.size());
    const std::size_t end = std::min(rest.find(' ', start), rest.size());
    const std::string_view word = rest.substr(start, end - start);
    rest.remove_prefix(end);
    return word;
}

std::string_view Words::all() const
{
    const std::size_t start = std::min(rest.find_first_not_of(' '), rest.size());
    return rest.substr(start, rest.find_last_not_of(' ') + 1 - start);
}

std::optional<float> finiteNumber(std::string_view word)
{
    const auto value = parseReal(word);
    if (!value || !(std::abs(*value) <= double(std::numeric_limits<float>::max())))
        return std::nullopt;
    return float(*value);
}

Result<ObjText> parseObj(std::string text, const std::string& name, const LoadLimits& limits)
{
    const TextLines lines(std::move(text));
    Parser parser{limits, {}, {}, {}, {}, {}, {}, {}, {}, {}, 0, 0};
    try {
        readLines(parser, lines.text());
        if (parser.polygons.empty())
            return inputError(fmt::format("{}: expected faces, found none", name));
        cutPolygons(parser);
    } catch (const Error& problem) {
        return inputError(fmt::format("{}: line {}: {}", name, lines.number(parser.offset), problem.message));
    }
    return std::move(parser.out);
}

} // namespace cotan
