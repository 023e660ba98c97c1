// Text of files, users and libraries in messages, which are one line.
#pragma once

#include <string>
#include <string_view>

namespace cotan {

// The text with spaces for control characters and none at its end. Longer text ends after `maxBytes` with "...".
inline std::string oneLine(std::string_view text, std::size_t maxBytes = 500)
{
    std::string line(text.substr(0, maxBytes));
    for (char& c : line)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
            c = ' ';
    while (!line.empty() && line.back() == ' ')
        line.pop_back();
    return text.size() > maxBytes ? line + "..." : line;
}

} // namespace cotan
