#include "text_lines.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>

#include <fmt/format.h>

namespace cotan {

namespace {

// How many bytes at `i` are a line end that a backslash before it would undo: 0, 1 or 2.
std::size_t lineEndAt(const std::string& text, std::size_t i)
{
    if (i < text.size() && text[i] == '\n')
        return 1;
    if (i < text.size() && text[i] == '\r')
        return i + 1 < text.size() && text[i + 1] == '\n' ? 2 : 1;
    return 0;
}

} // namespace

TextLines::TextLines(std::string source) : text_(std::move(source))
{
    std::size_t out = 0;
    std::size_t in = text_.starts_with("\xef\xbb\xbf") ? 3 : 0; // a byte order mark
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
        } else if (const std::size_t undone = c == '\\' ? lineEndAt(text_, in + 1) : 0) {
            put(' ');
            joined_.push_back(out);
            in += 1 + undone;
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
    if (word.starts_with('+'))
        word.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (end != word.data() + word.size() || word.empty() || word.starts_with('+'))
        return std::nullopt;
    if (error == std::errc::result_out_of_range) // too large, or so small that it is zero
        value = std::strtod(std::string(word).c_str(), nullptr);
    else if (error != std::errc{})
        return std::nullopt;
    if (!(std::abs(value) <= double(std::numeric_limits<float>::max())))
        return std::nullopt;
    return float(value);
}

std::string quotedWord(std::string_view word)
{
    std::string shown(word.substr(0, 40));
    std::ranges::replace_if(
        shown, [](unsigned char c) { return c < 32 || c > 126; }, '?');
    return fmt::format("\"{}\"", shown);
}

std::string withoutBreaks(std::string text)
{
    std::ranges::replace(text, '\n', ' ');
    return text;
}

} // namespace cotan
