// The key under which picture files say for which frame a normal map was made: text of PNG, an attribute of OpenEXR, a
// key of KTX2.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace cotan {

inline constexpr std::string_view kFrameKey = "cotanFrame";
inline constexpr std::size_t kMaxFrameText = 64;

// A value of that key as it may go into messages: up to 64 printable characters of ASCII, no spaces around. Others are
// empty: nothing is said.
inline std::string_view frameText(std::string_view value)
{
    const bool printable = std::ranges::all_of(value, [](char c) { return c > ' ' && c < 0x7f; });
    return printable && value.size() <= kMaxFrameText ? value : std::string_view{};
}

} // namespace cotan
