// Text with gaps. Not fmt: this part builds with a compiler and GLM.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace cotan::shader_text {

inline std::string textOf(std::string_view text) { return std::string(text); }
inline std::string textOf(int number) { return std::to_string(number); }

// The pattern with its gaps filled: each "{}" by the next value, each "{N}" by value N below 10. "{{" and "}}" are
// braces.
template<class... Values> std::string fill(std::string_view pattern, const Values&... values)
{
    const std::vector<std::string> texts{textOf(values)...};
    std::string filled;
    std::size_t next = 0;
    for (std::size_t i = 0; i < pattern.size(); ++i) {
        const char c = pattern[i], after = i + 1 < pattern.size() ? pattern[i + 1] : '\0';
        if (c == '{' && after == '}') {
            filled += texts.at(next++);
            ++i;
        } else if (c == '{' && after >= '0' && after <= '9') {
            filled += texts.at(std::size_t(after - '0'));
            i += 2;
        } else {
            filled += c;
            i += (c == '{' || c == '}') && after == c;
        }
    }
    return filled;
}

} // namespace cotan::shader_text
