// Makes text from file names and files safe to print on a terminal.
#pragma once

#include <string>
#include <string_view>

#include <fmt/format.h>

namespace cotan::app {

// Escapes control characters as in C, such as \x1b and \n, including those of C1, which are two bytes in UTF-8.
inline std::string printable(std::string_view text)
{
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto c = static_cast<unsigned char>(text[i]);
        const bool c1 = c == 0xc2 && i + 1 < text.size() && static_cast<unsigned char>(text[i + 1]) < 0xa0;
        if (c == '\n')
            result += "\\n";
        else if (c < 0x20 || c == 0x7f)
            result += fmt::format("\\x{:02x}", c);
        else if (c1)
            result += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[++i]));
        else
            result += text[i];
    }
    return result;
}

} // namespace cotan::app
