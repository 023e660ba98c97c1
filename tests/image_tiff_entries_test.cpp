// TIFF files of one strip or tile, whose directory is made by hand: what its entries may say.
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "deflate.hpp"
#include "picture_file.hpp"
#include "webp_maker.hpp" // little()

namespace cotan::test {
namespace {

// One strip or tile behind the header, 8 bytes or BigTIFF's 16, then a directory of these entries alone: tag, type,
// count, value.
constexpr std::uint64_t kShort = 3, kLong = 4;

std::string tiffOf(const std::vector<std::array<std::uint64_t, 4>>& entries, const std::string& pixels,
                   bool large = false)
{
    const int word = large ? 8 : 4;
    std::string file = large ? "II" + little(43, 2) + little(8, 2) + little(0, 2) : "II" + little(42, 2);
    const std::size_t padded = (pixels.size() + 7) / 8 * 8;
    file += little((large ? 16 : 8) + padded, word) + pixels + std::string(padded - pixels.size(), '\0');
    file += little(entries.size(), large ? 8 : 2);
    for (const auto& [tag, type, count, value] : entries)
        file += little(tag, 2) + little(type, 2) + little(count, word) + little(value, word);
    return file + little(0, word);
}

// What the directory of a picture in one strip, at 8, says. bytes: of the strip.
struct OneStrip {
    std::uint64_t width, height, bytes;
    std::uint64_t bits = 8, compression = 1, photometric = 1, channels = 1;

    std::vector<std::array<std::uint64_t, 4>> entries() const
    {
        return {{256, kLong, 1, width},        {257, kLong, 1, height},       {258, kShort, 1, bits},
                {259, kShort, 1, compression}, {262, kShort, 1, photometric}, {273, kLong, 1, 8},
                {277, kShort, 1, channels},    {278, kLong, 1, height},       {279, kLong, 1, bytes}};
    }
};

TEST_F(PictureFile, tiffOfLargeOffsetsIsReadAndItsStripsAreHeldToTheirSize)
{
    const std::string pixels = "abcdefghijklmnopqr"; // 3 x 2 x 3 bytes
    const auto file = [&](std::uint64_t offset, std::uint64_t bytes) {
        return tiffOf({{256, kLong, 1, 3},
                       {257, kLong, 1, 2},
                       {258, kShort, 3, 0x000800080008}, // in the entry itself
                       {259, kShort, 1, 1},
                       {262, kShort, 1, 2},
                       {273, 16, 1, offset},
                       {277, kShort, 1, 3},
                       {278, kLong, 1, 2},
                       {279, 16, 1, bytes}},
                      pixels, true);
    };
    const auto image = decodeImage(bytesOf(file(16, 18)), "a.tif");
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(component(*image, 2, 0, 1), 'h');
    EXPECT_EQ(component(*image, 1, 1, 2), 'o');
    EXPECT_NE(messageOf(decodeImage(bytesOf(file(16, 17)), "a.tif")).find("strip 0 has 17 bytes, expected 18"),
              std::string::npos);
    const std::size_t size = file(16, 18).size();
    const std::string beyond =
        "strip 0 takes 18 bytes from " + std::to_string(size - 17) + ", the file has " + std::to_string(size);
    EXPECT_NE(messageOf(decodeImage(bytesOf(file(size - 17, 18)), "a.tif")).find(beyond), std::string::npos);
}

// Nine pixels of one bit take two bytes.
TEST_F(PictureFile, tiffRowsOfOddBitsTakeWholeBytes)
{
    const auto file = [](std::uint64_t bytes) {
        return tiffOf(OneStrip{.width = 9, .height = 2, .bytes = bytes, .bits = 1}.entries(),
                      std::string("\x80\x00\x00\x80", 4));
    };
    const auto image = decodeImage(bytesOf(file(4)), "a.tif");
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(component(*image, 0, 0, 0), 255);
    EXPECT_EQ(component(*image, 8, 1, 0), 255);
    EXPECT_EQ(component(*image, 0, 1, 0), 0);
    EXPECT_NE(messageOf(decodeImage(bytesOf(file(3)), "a.tif")).find("strip 0 has 3 bytes, expected 4"),
              std::string::npos);
}

TEST_F(PictureFile, tiffOfPackedStripsThatGoOnBehindTheFileIsRefused)
{
    const std::string packed = deflated(std::string(3 * 2, 'x'));
    const auto file = [&](std::uint64_t bytes) {
        return tiffOf(OneStrip{.width = 3, .height = 2, .bytes = bytes, .compression = 8}.entries(), packed);
    };
    EXPECT_TRUE(decodeImage(bytesOf(file(packed.size())), "a.tif"));
    EXPECT_NE(messageOf(decodeImage(bytesOf(file(5000)), "a.tif")).find("strip 0 takes 5000 bytes from 8, the file"),
              std::string::npos);
}

std::string tiffOfChannels(std::uint64_t channels)
{
    const OneStrip strip{
        .width = 2, .height = 2, .bytes = 4 * channels, .photometric = channels < 3 ? 1u : 2u, .channels = channels};
    return tiffOf(strip.entries(), std::string(4 * channels, 'x'));
}

TEST_F(PictureFile, rowsSayWhetherThereIsAlphaByTheNumberOfChannels)
{
    for (const std::uint64_t channels : {1u, 2u, 3u, 4u, 5u}) {
        const auto rows = openRows(write("a.tif", tiffOfChannels(channels)));
        ASSERT_TRUE(rows) << rows.error().message;
        EXPECT_EQ((*rows)->alpha, channels == 2 || channels >= 4) << channels;
    }
}

// What is read of a picture is four channels; what it takes is all.
TEST_F(PictureFile, channelsThatNobodyReadsAndTilesBesideThePictureCountAgainstTheLimit)
{
    LoadLimits limits;
    limits.imageBytes = 255;
    EXPECT_NE(messageOf(decodeImage(bytesOf(tiffOfChannels(64)), "a.tif", limits)).find("take 256 bytes as stored"),
              std::string::npos);
    limits.imageBytes = 256;
    EXPECT_TRUE(decodeImage(bytesOf(tiffOfChannels(64)), "a.tif", limits));

    const std::string tiled = tiffOf({{256, kLong, 1, 2},
                                      {257, kLong, 1, 2},
                                      {258, kShort, 1, 8},
                                      {259, kShort, 1, 8},
                                      {262, kShort, 1, 1},
                                      {277, kShort, 1, 1},
                                      {322, kLong, 1, 65536},
                                      {323, kLong, 1, 16},
                                      {324, kLong, 1, 8},
                                      {325, kLong, 1, 8}},
                                     std::string(8, 'x'));
    const auto file = write("a.tif", tiled);
    limits.imageBytes = 65536 * 16 * 16 - 1; // up to 16 bytes a pixel
    EXPECT_NE(messageOf(openRows(file, limits)).find("in rows of 16777216 bytes"), std::string::npos);
    limits.imageBytes += 1;
    EXPECT_TRUE(openRows(file, limits));
}

// Blocks of 2 x 2 brightnesses share two colours (TIFF 6.0, section 21): 24 bytes for 4 x 4 pixels, not 48.
TEST_F(PictureFile, tiffOfSharedColoursIsReadWholeAndByRows)
{
    std::string pixels;
    for (int block = 0; block < 4; ++block)
        pixels += little(0x40302010u + 0x01010101u * std::uint64_t(block), 4) + char(100) + char(150);
    auto entries = OneStrip{.width = 4, .height = 4, .bytes = 24, .photometric = 6, .channels = 3}.entries();
    entries.push_back({530, kShort, 2, 0x00020002});
    const std::string file = tiffOf(entries, pixels);
    const auto image = decodeImage(bytesOf(file), "a.tif");
    ASSERT_TRUE(image) << image.error().message;
    const auto rows = byRows(write("a.tif", file), 1);
    ASSERT_TRUE(rows);
    EXPECT_EQ(rows->data, image->data);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) {
            const double bright = 16 * (1 + x % 2 + 2 * (y % 2)) + x / 2 + 2 * (y / 2), cb = 100 - 128, cr = 150 - 128;
            // ITU-R BT.601; rounded twice.
            EXPECT_NEAR(component(*image, x, y, 0), bright + 1.402 * cr, 1.5) << x << y;
            EXPECT_NEAR(component(*image, x, y, 1), std::max(0.0, bright - 0.344 * cb - 0.714 * cr), 1.5) << x << y;
            EXPECT_NEAR(component(*image, x, y, 2), std::max(0.0, bright + 1.772 * cb), 1.5) << x << y;
        }
}

} // namespace
} // namespace cotan::test
