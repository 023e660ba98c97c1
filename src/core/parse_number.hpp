// A number as text.
#pragma once

#include <charconv>
#include <string_view>
#include <system_error>

namespace cotan {

// Reads a number that fills the whole text: no space, no '+'. False, and `value` is of no use, where the text is not
// one or does not fit the type. Reads "nan" and "inf" where Number is a floating-point type.
template<class Number> bool parseNumber(std::string_view text, Number& value)
{
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size();
}

} // namespace cotan
