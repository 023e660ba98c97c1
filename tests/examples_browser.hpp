// What the tests of pages share.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "cotan/scene.hpp"
#include "run_tool.hpp"

namespace cotan::test {

// Shows pages that lie in the folder, in one launch of Chromium. What they report, by the name that each gives itself;
// a string that says why where they cannot run. seconds: the browser is ended after that.
nlohmann::json showPages(const TemporaryFolder& folder, const std::vector<std::string>& pages, int seconds = 120);

// Puts `value` in the place of each `word`.
void put(std::string& text, const std::string& word, const std::string& value);

inline void write(const std::filesystem::path& file, const std::string& text)
{
    std::ofstream(file, std::ios::binary) << text;
}

// Rows from the bottom, as WebGL has them.
inline std::string rowsFromTheBottom(const Image& image)
{
    const std::size_t row = std::size_t(image.width) * image.bytesPerPixel();
    std::string bytes;
    for (int y = image.height - 1; y >= 0; --y)
        bytes.append(reinterpret_cast<const char*>(image.data.data()) + std::size_t(y) * row, row);
    return bytes;
}

} // namespace cotan::test
