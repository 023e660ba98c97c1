// Helpers of the tests that open pages in a browser.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "cotan/scene.hpp"
#include "run_tool.hpp"

namespace cotan::test {

// Opens the pages of the folder in one Chromium process. Returns their reports by the names they give themselves, or a
// string with the reason if they cannot run. seconds: time limit of the browser.
nlohmann::json showPages(const TemporaryFolder& folder, const std::vector<std::string>& pages, int seconds = 300);

// Replaces each `word` by `value`.
void put(std::string& text, const std::string& word, const std::string& value);

inline void write(const std::filesystem::path& file, const std::string& text)
{
    std::ofstream(file, std::ios::binary) << text;
}

// The bytes of an image with its rows from the bottom, as in WebGL.
inline std::string rowsFromTheBottom(const Image& image)
{
    const std::size_t row = std::size_t(image.width) * image.bytesPerPixel();
    std::string bytes;
    for (int y = image.height - 1; y >= 0; --y)
        bytes.append(reinterpret_cast<const char*>(image.data.data()) + std::size_t(y) * row, row);
    return bytes;
}

} // namespace cotan::test
