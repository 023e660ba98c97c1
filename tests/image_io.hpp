// Image files that tests write, whole or truncated.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "cotan/image.hpp"

namespace cotan::test {

template<class T> std::string messageOf(const Result<T>& result)
{
    return result ? "accepted" : result.error().message;
}

inline std::span<const std::byte> bytesOf(const std::string& text) { return std::as_bytes(std::span(text)); }

// The numbers as little-endian bytes.
inline std::string words(const std::vector<std::uint32_t>& numbers)
{
    std::string bytes;
    for (const std::uint32_t n : numbers)
        for (int i = 0; i < 4; ++i)
            bytes += char(n >> (8 * i));
    return bytes;
}

inline int component(const Image& image, int x, int y, int c)
{
    const std::size_t at = (std::size_t(y) * std::size_t(image.width) + std::size_t(x)) * 4 + std::size_t(c);
    return image.type == PixelType::unorm16 ? image.words()[at] : image.bytes8()[at];
}

// A folder of image files for one test.
class ImageIo : public testing::Test {
protected:
    std::filesystem::path folder = std::filesystem::temp_directory_path()
        / ("cotan_layout_test_" + std::to_string(::getpid()) + "_"
           + testing::UnitTest::GetInstance()->current_test_info()->name());
    void SetUp() override { std::filesystem::create_directories(folder); }
    void TearDown() override { std::filesystem::remove_all(folder); }

    std::filesystem::path write(const std::string& name, const std::string& bytes) const
    {
        std::filesystem::remove(folder / name);
        std::ofstream(folder / name, std::ios::binary) << bytes;
        return folder / name;
    }

    // Reads the image `strip` rows at a time; nullopt if that fails.
    std::optional<Image> byRows(const std::filesystem::path& file, int strip) const
    {
        auto rows = openRows(file);
        if (!rows)
            return std::nullopt;
        Image whole = makeImage((*rows)->width, (*rows)->height, (*rows)->type);
        const std::size_t rowBytes = std::size_t(whole.width) * whole.bytesPerPixel();
        for (int y = 0; y < whole.height; y += strip) {
            Image part = makeImage(whole.width, std::min(strip, whole.height - y), whole.type);
            if (!(*rows)->read(part))
                return std::nullopt;
            std::memcpy(whole.data.data() + std::size_t(y) * rowBytes, part.data.data(), part.data.size());
        }
        return whole;
    }

    // Expects that reading whole and by rows refuses every truncation of the file, with a one-line error and no output.
    void expectCutsRefused(const std::string& name, const std::string& whole, std::size_t first) const
    {
        ASSERT_TRUE(decodeImage(bytesOf(whole), name));
        testing::internal::CaptureStderr();
        for (std::size_t length = first; length < whole.size(); length += 1 + whole.size() / 60) {
            const std::string cut = whole.substr(0, length);
            const auto image = decodeImage(bytesOf(cut), name);
            EXPECT_FALSE(image) << name << " cut to " << length << " of " << whole.size();
            if (!image) {
                EXPECT_EQ(image.error().message.find('\n'), std::string::npos) << image.error().message;
            }
            EXPECT_FALSE(byRows(write(name, cut), 2)) << name << " by rows, cut to " << length;
        }
        EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    }
};

} // namespace cotan::test
