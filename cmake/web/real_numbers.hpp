// Texts of real numbers as C++17 reads and writes them, which libc++ 13 lacks. The preset `web-tool` includes this file
// before every source. With newer libraries, which have these functions, it is empty.
#pragma once
#include <version>
#if defined(_LIBCPP_VERSION) && !defined(__cpp_lib_bit_cast) && __cplusplus > 201703L
#define COTAN_REAL_NUMBERS

#include <cctype>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <system_error>
#include <type_traits>

namespace std {

template<class Real>
requires std::is_floating_point_v<Real> std::from_chars_result from_chars(const char* first, const char* last,
                                                                          Real& value)
{
    const char* at = first + (first != last && *first == '-');
    const auto digits = [&] {
        const char* const begin = at;
        while (at != last && std::isdigit(static_cast<unsigned char>(*at)))
            ++at;
        return at - begin;
    };
    const auto isWord = [&](const char* word, std::size_t size) {
        for (std::size_t i = 0; i < size; ++i)
            if (std::size_t(last - at) <= i || std::tolower(static_cast<unsigned char>(at[i])) != word[i])
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

// General is printf's %g.
template<class Real>
requires std::is_floating_point_v<Real> std::to_chars_result to_chars(char* first, char* last, Real value, chars_format,
                                                                      int digits)
{
    char text[512];
    const int size = std::snprintf(text, sizeof text, "%.*g", digits, double(value));
    if (size > last - first)
        return {last, std::errc::value_too_large};
    std::memcpy(first, text, std::size_t(size));
    return {first + size, std::errc()};
}

// The shortest text that is read as the same number; without an exponent if that is as short.
template<class Real>
requires std::is_floating_point_v<Real> std::to_chars_result to_chars(char* first, char* last, Real value)
{
    char scientific[64] = "", fixed[512] = "";
    for (int digits = 0; digits < 17; ++digits) {
        std::snprintf(scientific, sizeof scientific, "%.*e", digits, double(value));
        const double back =
            std::is_same_v<Real, float> ? double(std::strtof(scientific, nullptr)) : std::strtod(scientific, nullptr);
        if (back != double(value))
            continue;
        const char* const exponent = std::strchr(scientific, 'e');
        const int decimals = digits - (exponent != nullptr ? std::atoi(exponent + 1) : 0);
        std::snprintf(fixed, sizeof fixed, "%.*f", decimals > 0 ? decimals : 0, double(value));
        break;
    }
    const bool isFixed = fixed[0] != '\0' && std::strlen(fixed) <= std::strlen(scientific);
    const char* const text = isFixed ? fixed : scientific;
    const auto size = std::ptrdiff_t(std::strlen(text));
    if (size > last - first)
        return {last, std::errc::value_too_large};
    std::memcpy(first, text, std::size_t(size));
    return {first + size, std::errc()};
}

} // namespace std

#endif
