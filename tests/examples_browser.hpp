// What the tests of pages share: one launch of Chromium shows all of them.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "cotan/scene/image.hpp"
#include "run_tool.hpp"

namespace cotan::test {

// What the pages report, by page; a string that says why where they cannot run.
const nlohmann::json& measuredPages();

// The pages of examples/triangle-web with what measures them, and the models that they draw. Returns their file names.
std::vector<std::string> writeTriangleWebPages(const TemporaryFolder& folder);

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
