// Parsing of numbers.
#pragma once

#include <charconv>
#include <string_view>
#include <system_error>

namespace cotan {

// Parses a number that fills the whole text: no spaces, no '+'. Returns false, with `value` unspecified, if the text is
// no number or does not fit the type. Accepts "nan" and "inf" if Number is a floating-point type.
template<class Number> bool parseNumber(std::string_view text, Number& value)
{
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size();
}

} // namespace cotan
