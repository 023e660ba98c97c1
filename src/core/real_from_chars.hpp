// Reads real numbers as std::from_chars of C++17 does, for libc++, which has that function from version 20 on.
#pragma once

#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <system_error>
#include <type_traits>

#include "locale_of_c.hpp"

namespace cotan {

// As std::from_chars(first, last, value) in general format, in any locale of the program.
template<class Real> std::from_chars_result realFromChars(const char* first, const char* last, Real& value)
{
    const char* at = first + (first != last && *first == '-');
    const auto digits = [&] {
        const char* const begin = at;
        while (at != last && *at >= '0' && *at <= '9')
            ++at;
        return at - begin;
    };
    const auto isWord = [&](const char* word, std::size_t size) {
        for (std::size_t i = 0; i < size; ++i)
            if (std::size_t(last - at) <= i || (at[i] | 0x20) != word[i]) // lower case
                return false;
        return true;
    };
    bool finite = false;
    if (isWord("infinity", 8))
        at += 8;
    else if (isWord("inf", 3) || isWord("nan", 3))
        at += 3;
    else {
        finite = true;
        std::ptrdiff_t count = digits();
        if (at != last && *at == '.') {
            ++at;
            count += digits();
        }
        if (count == 0)
            return {first, std::errc::invalid_argument};
        if (at != last && (*at == 'e' || *at == 'E')) {
            const char* const mantissa = at++;
            at += at != last && (*at == '+' || *at == '-');
            if (digits() == 0)
                at = mantissa;
        }
    }
    const LocaleOfC plain;
    const std::string text(first, at);
    const Real number = std::is_same_v<Real, float> ? Real(std::strtof(text.c_str(), nullptr))
                                                    : Real(std::strtod(text.c_str(), nullptr));
    const bool tooSmall =
        number == 0 && text.substr(0, text.find_first_of("eE")).find_first_of("123456789") < text.size();
    if (finite && (std::isinf(number) || tooSmall))
        return {at, std::errc::result_out_of_range};
    value = number;
    return {at, std::errc()};
}

} // namespace cotan
