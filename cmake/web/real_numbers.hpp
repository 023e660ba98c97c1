// Texts of real numbers as C++17 reads and writes them, which libc++ 13 lacks. The preset `web-tool` includes this file
// before every source. With newer libraries, which have these functions, it is empty.
#pragma once
#include <version>
#if defined(_LIBCPP_VERSION) && !defined(__cpp_lib_bit_cast) && __cplusplus > 201703L
#define COTAN_REAL_NUMBERS

#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <system_error>
#include <type_traits>

#include "../../src/core/real_from_chars.hpp"

namespace std {

template<class Real>
requires std::is_floating_point_v<Real> std::from_chars_result from_chars(const char* first, const char* last,
                                                                          Real& value)
{
    return cotan::realFromChars(first, last, value);
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
