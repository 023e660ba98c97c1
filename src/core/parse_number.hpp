// Parsing of numbers.
#pragma once

#include <charconv>
#include <string_view>
#include <system_error>
#include <type_traits>

#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 200000 && !defined(__EMSCRIPTEN__)
#define COTAN_REAL_FROM_CHARS
#include "core/real_from_chars.hpp"
#endif

namespace cotan {

// std::from_chars, also where the C++ library has it for integers only.
template<class Number> std::from_chars_result fromChars(const char* first, const char* last, Number& value)
{
#ifdef COTAN_REAL_FROM_CHARS
    if constexpr (std::is_floating_point_v<Number>)
        return realFromChars(first, last, value);
    else
#endif
        return std::from_chars(first, last, value);
}

// Parses a number that fills the whole text: no spaces, no '+'. Returns false, with `value` unspecified, if the text is
// no number or does not fit the type. Accepts "nan" and "inf" if Number is a floating-point type.
template<class Number> bool parseNumber(std::string_view text, Number& value)
{
    const auto [end, error] = fromChars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size();
}

} // namespace cotan
