// Real numbers as text. Nothing here, nor elsewhere in src and apps, depends on the locale of a host program, which may
// have decimal commas (a test checks it). Not for WebAssembly, whose library lacks these functions.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "core/parse_number.hpp"

namespace cotan {

// Parses a real number that fills the whole text: no spaces; a '+' and "nan" and "inf" are accepted. A number too large
// for a double is infinite, one too small is 0. Returns nothing if the text is no number.
inline std::optional<double> parseReal(std::string_view text)
{
    if (text.starts_with('+'))
        text.remove_prefix(text.starts_with("+-") ? text.size() : 1);
    double value = 0;
    const auto [end, error] = fromChars(text.data(), text.data() + text.size(), value);
    if (error == std::errc::invalid_argument || end != text.data() + text.size())
        return std::nullopt;
    if (error == std::errc())
        return value;
    const std::string_view digits = text.substr(0, text.find_first_of("eE"));
    std::string_view exponent = text.substr(std::min(digits.size() + 1, text.size()));
    if (exponent.starts_with('+'))
        exponent.remove_prefix(1);
    long power = 0; // of 10
    if (std::from_chars(exponent.data(), exponent.data() + exponent.size(), power).ec == std::errc::result_out_of_range)
        power = exponent[0] == '-' ? -1'000'000'000 : 1'000'000'000;
    power += long(std::min(digits.find('.'), digits.size())) - long(digits.find_first_of("123456789"));
    return std::copysign(power < 0 ? 0 : HUGE_VAL, text[0] == '-' ? -1.0 : 1.0);
}

// The shortest text with up to `digits` significant digits: "0.5", "1e+06".
inline std::string textOfReal(double value, int digits = 6)
{
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits).ptr};
}

} // namespace cotan
