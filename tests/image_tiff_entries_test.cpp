// TIFF files of one strip or tile with hand-made directories: the entries that are accepted and refused.
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "deflate.hpp"
#include "image_io.hpp"
#include "webp_maker.hpp" // little()

namespace cotan::test {
namespace {

// One strip or tile after the header (8 bytes, or BigTIFF's 16), then a directory of exactly these entries: tag, type,
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

// Directory entries of an image in one strip at offset 8. `bytes` is the size of the strip.
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

TEST_F(ImageIo, bigTiffIsReadAndItsStripSizesAreChecked)
{
    const std::string pixels = "abcdefghijklmnopqr"; // 3 x 2 x 3 bytes
    const auto file = [&](std::uint64_t offset, std::uint64_t bytes) {
        return tiffOf({{256, kLong, 1, 3},
                       {257, kLong, 1, 2},
                       {258, kShort, 3, 0x000800080008}, // stored in the entry itself
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

// Nine 1-bit pixels take two bytes.
TEST_F(ImageIo, tiffRowsOfOddBitsTakeWholeBytes)
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

TEST_F(ImageIo, tiffStripsBeyondTheFileAreRefused)
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

TEST_F(ImageIo, rowReaderDerivesAlphaFromTheChannelCount)
{
    for (const std::uint64_t channels : {1u, 2u, 3u, 4u, 5u}) {
        const auto rows = openRows(write("a.tif", tiffOfChannels(channels)));
        ASSERT_TRUE(rows) << rows.error().message;
        EXPECT_EQ((*rows)->alpha, channels == 2 || channels >= 4) << channels;
    }
}

// Only four channels are read, but the limit applies to all stored channels and to whole tiles.
TEST_F(ImageIo, unreadChannelsAndWholeTilesCountAgainstTheLimit)
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

// Blocks of 2 x 2 luma samples share two chroma samples (TIFF 6.0, section 21): 24 bytes for 4 x 4 pixels, not 48.
TEST_F(ImageIo, chromaSubsampledTiffIsReadWholeAndByRows)
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

std::string tiffMessage(const std::string& file, const LoadLimits& limits = {})
{
    return messageOf(decodeImage(bytesOf(file), "a.tif", limits));
}

const std::string kBrokenTiff = "a.tif: broken tiff image: ";

// 3 x 3 pixels of one byte in strips of two rows, in one plane or two: rows 0 and 1, then row 2.
std::string tiffOfStrips(const std::vector<std::uint32_t>& counts, std::uint64_t planes = 1)
{
    std::vector<std::uint32_t> offsets;
    for (std::uint32_t at = 8; offsets.size() < counts.size(); at += offsets.size() % 2 == 1 ? 6 : 3)
        offsets.push_back(at);
    const std::uint64_t n = counts.size(), listed = 8 + 20;
    return tiffOf({{256, kLong, 1, 3},
                   {257, kLong, 1, 3},
                   {258, kShort, planes, planes == 1 ? 8u : 0x00080008u},
                   {259, kShort, 1, 1},
                   {262, kShort, 1, 1},
                   {273, kLong, n, listed},
                   {277, kShort, 1, planes},
                   {278, kLong, 1, 2},
                   {279, kLong, n, listed + 4 * n},
                   {284, kShort, 1, planes == 1 ? 1u : 2u}},
                  "abcdefghijklmnopqr__" + words(offsets) + words(counts));
}

TEST_F(ImageIo, eachTiffStripRequiresTheBytesOfItsRows)
{
    EXPECT_EQ(tiffMessage(tiffOfStrips({6, 3})), "accepted");
    EXPECT_EQ(tiffMessage(tiffOfStrips({5, 3})), kBrokenTiff + "strip 0 has 5 bytes, expected 6");
    EXPECT_EQ(tiffMessage(tiffOfStrips({6, 2})), kBrokenTiff + "strip 1 has 2 bytes, expected 3");
    EXPECT_EQ(tiffMessage(tiffOfStrips({6, 0})), kBrokenTiff + "strip 1 has no bytes");
    EXPECT_EQ(tiffMessage(tiffOfStrips({6, 3, 6, 3}, 2)), "accepted");
    EXPECT_EQ(tiffMessage(tiffOfStrips({6, 3, 5, 3}, 2)), kBrokenTiff + "strip 2 has 5 bytes, expected 6");
    EXPECT_EQ(tiffMessage(tiffOfStrips({6, 3, 6, 2}, 2)), kBrokenTiff + "strip 3 has 2 bytes, expected 3");
    EXPECT_EQ(tiffMessage(tiffOfStrips({6, 3, 6}, 2)), kBrokenTiff + "its directory lists 3 strips, expected 4");
    const auto image = decodeImage(bytesOf(tiffOfStrips({6, 3})), "a.tif");
    ASSERT_TRUE(image);
    for (int i = 0; i < 9; ++i)
        EXPECT_EQ(component(*image, i % 3, i / 3, 0), 'a' + i);
    // Tiles of 16 x 16 over 20 x 33 pixels, for each plane.
    const auto tiles = [](std::uint64_t planes) {
        return tiffMessage(tiffOf({{256, kLong, 1, 20},
                                   {257, kLong, 1, 33},
                                   {258, kShort, 1, 8},
                                   {259, kShort, 1, 1},
                                   {262, kShort, 1, 1},
                                   {277, kShort, 1, planes},
                                   {284, kShort, 1, planes == 1 ? 1u : 2u},
                                   {322, kLong, 1, 16},
                                   {323, kLong, 1, 16},
                                   {324, kLong, 1, 8},
                                   {325, kLong, 1, 256}},
                                  std::string(256, 'x')));
    };
    EXPECT_EQ(tiles(1), kBrokenTiff + "its directory lists 1 tiles, expected 6");
    EXPECT_EQ(tiles(3), kBrokenTiff + "its directory lists 1 tiles, expected 18");
}

// Without a list of strip sizes, they follow from the size of the image.
TEST_F(ImageIo, tiffStripsWithoutStatedSizeMustEndWithinTheFile)
{
    const auto file = [](std::uint64_t offset) {
        auto entries = OneStrip{.width = 3, .height = 2, .bytes = 6}.entries();
        entries.pop_back();
        entries[5][3] = offset;
        return tiffOf(entries, "abcdef");
    };
    const std::size_t size = file(8).size();
    EXPECT_EQ(tiffMessage(file(size - 5)),
              kBrokenTiff + "strip 0 takes 6 bytes from " + std::to_string(size - 5) + ", the file has "
                  + std::to_string(size));
    EXPECT_EQ(tiffMessage(file(size - 6)), "accepted");
    EXPECT_EQ(tiffMessage(file(8)), "accepted");
}

// TIFF 6.0, section 2: integers are BYTE, SHORT, LONG, SBYTE, SSHORT and SLONG; in BigTIFF LONG8 and SLONG8 too. The
// height, 2, has each type in turn; where it is understood, one strip of one row is too few.
TEST_F(ImageIo, tiffNumbersAreReadFromEveryIntegerType)
{
    const std::string few = kBrokenTiff + "its directory lists 1 strips, expected 2";
    const auto messageFor = [](std::uint64_t type, bool large) {
        auto entries = OneStrip{.width = 3, .height = 2, .bytes = 3}.entries();
        entries[1] = {257, type, 1, 2};
        entries[5][3] = large ? 16 : 8;
        entries[7][3] = 1;
        return tiffMessage(tiffOf(entries, "abcdef", large));
    };
    for (const std::uint64_t type : {1u, 3u, 4u, 6u, 8u, 9u}) {
        EXPECT_EQ(messageFor(type, false), few) << type;
        EXPECT_EQ(messageFor(type, true), few) << type;
    }
    for (const std::uint64_t type : {16u, 17u})
        EXPECT_EQ(messageFor(type, true), few) << type;
    for (const std::uint64_t type : {0u, 2u, 5u, 7u, 10u, 11u, 12u, 15u, 18u, 99u})
        EXPECT_EQ(messageFor(type, true).find("expected 2"), std::string::npos) << type;
}

TEST_F(ImageIo, onlyKnownTiffCompressionsReachTheReader)
{
    const auto messageFor = [](std::uint64_t compression) {
        return tiffMessage(
            tiffOf(OneStrip{.width = 3, .height = 2, .bytes = 6, .compression = compression}.entries(), "abcdef"));
    };
    const std::uint64_t known[] = {1, 2, 3, 4, 5, 7, 8, 32773, 32946, 34925, 50000, 50001};
    for (const std::uint64_t compression : known) {
        EXPECT_EQ(messageFor(compression).find("is not supported"), std::string::npos) << compression;
        for (const std::uint64_t other : {compression - 1, compression + 1})
            if (std::ranges::find(known, other) == std::end(known)) {
                EXPECT_EQ(messageFor(other),
                          kBrokenTiff + "its compression " + std::to_string(other) + " is not supported");
            }
    }
}

// The limit covers all rows of a strip at four channels: 3 pixels of 4 or 8 bytes in each of 100 rows.
TEST_F(ImageIo, tiffStripsTallerThanTheImageCountAgainstTheLimit)
{
    for (const std::uint64_t bits : {8u, 16u}) {
        auto entries = OneStrip{.width = 3, .height = 2, .bytes = 6 * bits / 8, .bits = bits}.entries();
        entries[7][3] = 100;
        const std::string file = tiffOf(entries, std::string(12, 'x'));
        LoadLimits limits;
        limits.imageBytes = 3 * 4 * bits / 8 * 100;
        EXPECT_EQ(tiffMessage(file, limits), "accepted");
        limits.imageBytes -= 1;
        EXPECT_EQ(tiffMessage(file, limits), kBrokenTiff + "its strips have 100 rows, the image 2");
    }
}

TEST_F(ImageIo, rowsOverALimitAreReportedWithSizeAndLimits)
{
    const auto file = [&](std::uint64_t width, std::uint64_t height) {
        return write("a.tif",
                     tiffOf(OneStrip{.width = width, .height = height, .bytes = 15}.entries(), std::string(15, 'x')));
    };
    const std::string name = (folder / "a.tif").string();
    LoadLimits limits;
    limits.imageSide = 4;
    limits.imageBytes = 1000;
    EXPECT_EQ(messageOf(openRows(file(5, 3), limits)),
              name + ": 5 x 3 pixels in rows of 80 bytes, the limit is 4 per side and 1000 bytes");
    EXPECT_EQ(messageOf(openRows(file(3, 5), limits)),
              name + ": 3 x 5 pixels in rows of 48 bytes, the limit is 4 per side and 1000 bytes");
    limits.imageSide = 5;
    std::size_t expected = 0;
    limits.expect = [&](std::size_t bytes) { expected = bytes; };
    EXPECT_TRUE(openRows(file(5, 3), limits));
    EXPECT_EQ(expected, 80u);
    EXPECT_TRUE(openRows(file(3, 5), limits));
    limits.imageBytes = 79;
    const auto refused = openRows(file(5, 3), limits);
    ASSERT_FALSE(refused);
    EXPECT_TRUE(refused.error().memory);
    EXPECT_EQ(refused.error().message,
              name + ": 5 x 3 pixels in rows of 80 bytes, the limit is 5 per side and 79 bytes");
    // Whole images: the stored bytes and the decoded bytes both count. 64 channels of 2 x 2 bytes are 256.
    limits = {};
    limits.imageBytes = 255;
    EXPECT_EQ(tiffMessage(tiffOfChannels(64), limits), "a.tif: the pixels take 256 bytes as stored, the limit is 255");
    limits.imageBytes = 59;
    EXPECT_EQ(
        tiffMessage(tiffOf(OneStrip{.width = 5, .height = 3, .bytes = 15}.entries(), std::string(15, 'x')), limits),
        "a.tif: 5 x 3 pixels take 60 bytes, the limit is 59");
}

} // namespace
} // namespace cotan::test
