#pragma once

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>

namespace cotan {

// ".png" of "A.PNG".
inline std::string lowerExtension(const std::filesystem::path& file)
{
    std::string text = file.extension().string();
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
}

} // namespace cotan
