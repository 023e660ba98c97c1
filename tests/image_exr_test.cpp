// Hand-made OpenEXR files whose attributes and blocks contradict the header.
#include <algorithm>
#include <bit>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "image_io.hpp"

namespace cotan::test {
namespace {

TEST_F(ImageIo, exrAttributesLargerThanTheFileAreRefused)
{
    const std::string start("\x76\x2f\x31\x01\2\0\0\0", 8);
    for (const std::string& size : {std::string("\xff\xff\xff\x7f", 4), std::string("\xff\xff\xff\xff", 4)}) {
        const std::string file = start + std::string("a\0string\0", 9) + size;
        const auto image = decodeImage(bytesOf(file), "a.exr");
        ASSERT_FALSE(image);
        EXPECT_NE(image.error().message.find("an attribute of its header takes"), std::string::npos)
            << image.error().message;
        EXPECT_FALSE(openRows(write("a.exr", file)));
    }
    EXPECT_FALSE(decodeImage(bytesOf(start + std::string(1000, 'n')), "a.exr"));
    EXPECT_FALSE(decodeImage(bytesOf(start), "a.exr"));
}

// An OpenEXR file that has only a header. Attributes are (name, type, size as stored, bytes).
using ExrAttributes = std::vector<std::tuple<std::string, std::string, std::uint32_t, std::string>>;

std::string exrHeader(const ExrAttributes& attributes)
{
    std::string header;
    for (const auto& [name, type, size, bytes] : attributes) {
        header += name + '\0' + type + '\0';
        for (int i = 0; i < 4; ++i)
            header += char(size >> (8 * i));
        header += bytes;
    }
    return header + '\0';
}

// The attributes that every single-channel image needs. type: 1 half, 2 float.
ExrAttributes exrAttributes(const std::string& window, std::uint32_t type, char compression, std::uint32_t sampling = 1)
{
    return {{"channels", "chlist", 19, std::string("R\0", 2) + words({type, 0, sampling, sampling}) + '\0'},
            {"compression", "compression", 1, std::string(1, compression)},
            {"dataWindow", "box2i", 16, window},
            {"displayWindow", "box2i", 16, window},
            {"lineOrder", "lineOrder", 1, std::string(1, '\0')},
            {"pixelAspectRatio", "float", 4, words({0x3f800000})},
            {"screenWindowCenter", "v2f", 8, words({0, 0})},
            {"screenWindowWidth", "float", 4, words({0x3f800000})}};
}

TEST_F(ImageIo, exrBlocksOverTheLimitsAreRefusedBeforeAllocation)
{
    const std::string magic("\x76\x2f\x31\x01\2\0\0\0", 8);
    const std::string channels = std::string("R\0", 2) + words({1, 0, 1, 1}) + '\0';
    const auto refused = [&](std::uint32_t right, std::uint32_t bottom, char compression, const std::string& tiles) {
        ExrAttributes attributes = {{"channels", "chlist", 19, channels},
                                    {"compression", "compression", 1, std::string(1, compression)},
                                    {"dataWindow", "box2i", 16, words({0, 0, right, bottom})},
                                    {"displayWindow", "box2i", 16, words({0, 0, right, bottom})},
                                    {"lineOrder", "lineOrder", 1, std::string(1, '\0')}};
        if (!tiles.empty())
            attributes.emplace_back("tiles", "tiledesc", 9, tiles);
        const std::string file = magic + exrHeader(attributes) + std::string(64, '\0');
        const auto whole = decodeImage(bytesOf(file), "a.exr", {});
        const auto rows = openRows(write("a.exr", file));
        ASSERT_TRUE(!whole && !rows);
        for (const Error& error : {whole.error(), rows.error()}) {
            EXPECT_NE(error.message.find("the limit is"), std::string::npos) << error.message;
            EXPECT_TRUE(error.memory) << error.message;
        }
    };
    refused(0x1000000, 0, 0, ""); // 16.8 million pixels in one row
    refused(0, 0x1000000, 0, "");
    refused(3, 3, 0, words({0x4000, 0x8000}) + '\0');               // tiles of 2 GB
    refused(16383, 255, 9, words({0xffffffff, 0xffffffff}) + '\0'); // overflows 64 bits unless checked
}

// 2 x 2 pixels of one float channel, in blocks of one row or in one tile of level 0. `parts` makes two equal parts.
std::string makeExr(bool tiled, bool parts, char compression)
{
    ExrAttributes attributes = exrAttributes(words({0, 0, 1, 1}), 2, compression);
    if (tiled)
        attributes.emplace_back("tiles", "tiledesc", 9, words({2, 2}) + '\0');
    const std::uint32_t blocks = tiled ? 1 : 2;
    std::string header;
    for (const char* const name : {"a", "b"}) {
        auto all = attributes;
        if (parts) {
            all.emplace_back("name", "string", 1, name);
            const std::string type = tiled ? "tiledimage" : "scanlineimage";
            all.emplace_back("type", "string", std::uint32_t(type.size()), type);
            all.emplace_back("chunkCount", "int", 4, words({blocks}));
        }
        if (name == std::string("a") || parts)
            header += exrHeader(all);
    }
    header += parts ? std::string(1, '\0') : "";
    const std::uint32_t version = 2u | (parts ? 0x1000u : tiled ? 0x200u : 0u);
    const std::string start = words({0x01312f76, version}) + header;
    std::string table, pixels;
    for (std::uint32_t part = 0; part < (parts ? 2u : 1u); ++part)
        for (std::uint32_t y = 0; y < blocks; ++y) {
            const std::size_t tables = 8 * blocks * (parts ? 2 : 1);
            table += words({std::uint32_t(start.size() + tables + pixels.size()), 0});
            pixels += (parts ? words({part}) : "") + (tiled ? words({0, 0, 0, 0, 16}) : words({y, 8}));
            for (std::uint32_t i = 0; i < (tiled ? 4u : 2u); ++i)
                pixels += words({0x3f000000});
        }
    return start + table + pixels;
}

TEST_F(ImageIo, missingOrShortExrBlocksAreRefusedWholeAndByRows)
{
    for (const bool tiled : {false, true})
        for (const bool parts : {false, true}) {
            const std::string sound = makeExr(tiled, parts, 0);
            const auto image = decodeImage(bytesOf(sound), "a.exr");
            ASSERT_TRUE(image) << tiled << parts << image.error().message;
            EXPECT_EQ(image->floats()[0], 0.5f);
            const std::size_t blocks = tiled ? 1 : 2, before = (parts ? 4 : 0) + (tiled ? 16 : 4);
            const std::size_t first =
                sound.size() - blocks * (parts ? 2 : 1) * (before + 4 + (tiled ? 16 : 8)); // after the tables
            const std::size_t table = first - 8 * blocks * (parts ? 2 : 1);
            const auto refused = [&](std::size_t at, std::uint32_t value, const std::string& why, char compression) {
                std::string file = makeExr(tiled, parts, compression);
                file.replace(at, 4, words({value}));
                for (const auto& message :
                     {messageOf(decodeImage(bytesOf(file), "a.exr")), messageOf(openRows(write("a.exr", file)))})
                    EXPECT_NE(message.find(why), std::string::npos) << tiled << parts << ": " << message;
            };
            for (const char* const name :
                 {"dataWindow", "compression", "channels"}) // once an image of 64 x 64 uninitialised pixels
                refused(sound.find(name + std::string(1, '\0')), 0x78787878, "lacks a data window", 0);
            refused(table, 0, "block 0 of " + std::to_string(blocks) + " is not in the file", 0);
            refused(table, 100000, "block 0 of " + std::to_string(blocks) + " is not in the file", 0);
            refused(first + before, 7, "block 0 has 7 bytes, expected " + std::to_string(tiled ? 16 : 8), 0);
            refused(first + before, 0, "block 0 has 0 bytes, expected 1", 2); // once uninitialised memory
            refused(first + before, 100000, "block 0 takes 100000 bytes from ", 2);
        }
}

// A reader that ignores a wrong size loses its position and next finds an attribute of 1.7 GB.
TEST_F(ImageIo, exrAttributesOfWrongSizeAreRefused)
{
    const std::string scanLines("\x76\x2f\x31\x01\2\0\0\0", 8), tiles("\x76\x2f\x31\x01\2\2\0\0", 8),
        parts("\x76\x2f\x31\x01\2\x10\0\0", 8);
    const std::string channel("B\0\1\0\0\0\0\0\0\0\1\0\0\0\1\0\0\0", 18);
    const std::string text("\4\0\0\0text", 8), preview = std::string("\1\0\0\0\2\0\0\0", 8) + std::string(8, 'p');
    const std::string huge = exrHeader({{"x", "none", 0x657c6974, ""}});
    const std::vector<std::tuple<std::string, std::string>> values = {
        {"chlist", channel + channel + '\0'}, {"stringvector", text + text},  {"preview", preview},
        {"floatvector", std::string(8, 'f')}, {"float", std::string(4, 'f')}, {"tiledesc", std::string(9, 't')},
        {"v2f", std::string(8, 'v')},         {"m44d", std::string(128, 'm')}};
    for (const auto& [type, bytes] : values) {
        const auto size = std::uint32_t(bytes.size());
        for (const std::string& start : {scanLines, tiles, parts}) {
            const std::string before = start == parts ? exrHeader({{"first", "unknown", 3, "abc"}}) : "";
            for (const std::uint32_t stored : {size - 1, size + 1, size}) {
                const std::string file = start + before
                    + exrHeader({{"u", "unknown", 2, "ab"}, {"a", type, stored, bytes}}) + std::string(4, '\0') + huge;
                const auto image = decodeImage(bytesOf(file), "a.exr");
                ASSERT_FALSE(image);
                // A true size passes this check; OpenEXR itself reports what else is missing.
                EXPECT_EQ(image.error().message.find("which do not fit its type") != std::string::npos, stored != size)
                    << type << ' ' << stored << ": " << image.error().message;
                EXPECT_FALSE(openRows(write("a.exr", file)));
            }
        }
    }
}

// Uncompressed scan lines or square tiles of one channel. type: 1 half, 2 float. The value of pixel (x, y) of the data
// window is 1 + x + 4 y, or 0.5 for half.
std::string plainExr(std::uint32_t left, std::uint32_t top, std::uint32_t width, std::uint32_t height,
                     std::uint32_t type, std::uint32_t tile)
{
    const std::string window = words({left, top, left + width - 1, top + height - 1});
    ExrAttributes attributes = exrAttributes(window, type, '\0');
    if (tile > 0)
        attributes.emplace_back("tiles", "tiledesc", 9, words({tile, tile}) + '\0');
    const std::string start = words({0x01312f76, 2u | (tile > 0 ? 0x200u : 0u)}) + exrHeader(attributes);
    const std::uint32_t wide = tile > 0 ? tile : width, high = tile > 0 ? tile : 1;
    const std::size_t blocks = std::size_t((width + wide - 1) / wide) * ((height + high - 1) / high);
    std::string table, body;
    for (std::uint32_t y = 0; y < height; y += high)
        for (std::uint32_t x = 0; x < width; x += wide) {
            table += words({std::uint32_t(start.size() + 8 * blocks + body.size()), 0});
            std::string pixels;
            for (std::uint32_t j = y; j < std::min(y + high, height); ++j)
                for (std::uint32_t i = x; i < std::min(x + wide, width); ++i)
                    pixels += type == 1 ? std::string("\0\x38", 2)
                                        : words({std::bit_cast<std::uint32_t>(float(1 + i + 4 * j))});
            body += (tile > 0 ? words({x / tile, y / tile, 0, 0}) : words({top + y}))
                + words({std::uint32_t(pixels.size())}) + pixels;
        }
    return start + table + body;
}

TEST_F(ImageIo, everyExrLayoutIsReadCorrectly)
{
    const struct {
        std::uint32_t left, top, width, height, type, tile;
    } cases[] = {{0, 0, 3, 2, 2, 0}, {7, 5, 3, 2, 2, 0}, {0, 0, 3, 3, 2, 2},
                 {7, 5, 3, 5, 2, 2}, {0, 0, 3, 2, 1, 0}, {0, 0, 3, 3, 1, 2}};
    for (const auto& c : cases) {
        SCOPED_TRACE(testing::Message() << c.left << ' ' << c.height << ' ' << c.type << ' ' << c.tile);
        const std::string file = plainExr(c.left, c.top, c.width, c.height, c.type, c.tile);
        const auto image = decodeImage(bytesOf(file), "a.exr");
        ASSERT_TRUE(image) << image.error().message;
        ASSERT_EQ(image->width, int(c.width));
        ASSERT_EQ(image->height, int(c.height));
        for (std::uint32_t y = 0; y < c.height; ++y)
            for (std::uint32_t x = 0; x < c.width; ++x)
                EXPECT_EQ(image->floats()[4 * (y * c.width + x)], c.type == 1 ? 0.5f : float(1 + x + 4 * y)) << x << y;
        for (const int strip : {1, 2}) {
            const auto rows = byRows(write("a.exr", file), strip);
            ASSERT_TRUE(rows) << strip;
            EXPECT_EQ(rows->data, image->data) << strip;
        }
        EXPECT_NE(messageOf(decodeImage(bytesOf(file.substr(0, file.size() - 1)), "a.exr")).find("block "),
                  std::string::npos);
    }
}

// OpenImageIO's messages for these files are clearer than a message about their blocks could be.
TEST_F(ImageIo, deepOrSubsampledExrIsRefusedByName)
{
    const auto file = [](std::uint32_t version, std::uint32_t sampling, const std::string& type, std::uint32_t bytes) {
        ExrAttributes attributes = exrAttributes(words({0, 0, 1, 1}), 2, '\0', sampling);
        if (!type.empty()) {
            attributes.emplace_back("type", "string", std::uint32_t(type.size()), type);
            attributes.emplace_back("name", "string", 1, "a");
            attributes.emplace_back("version", "int", 4, words({1}));
            attributes.emplace_back("maxSamplesPerPixel", "int", 4, words({1}));
            attributes.emplace_back("chunkCount", "int", 4, words({2}));
        }
        const std::string start = words({0x01312f76, version}) + exrHeader(attributes);
        const auto at = std::uint32_t(start.size() + 16);
        return start + words({at, 0, at + 8 + bytes, 0, 0, bytes}) + std::string(bytes, '\0') + words({1, bytes})
            + std::string(bytes, '\0');
    };
    const auto deep = file(0x802, 1, "deepscanline", 4), subsampled = file(2, 2, "", 4);
    for (const auto& [bytes, why] : {std::pair(deep, "found a volume"), std::pair(subsampled, "Subsampled channels")})
        for (const auto& message :
             {messageOf(decodeImage(bytesOf(bytes), "a.exr")), messageOf(openRows(write("a.exr", bytes)))})
            EXPECT_NE(message.find(why), std::string::npos) << message;
}

std::string exrMessage(const std::string& file, const LoadLimits& limits = {})
{
    return messageOf(decodeImage(bytesOf(file), "a.exr", limits));
}

const std::string kExrStart("\x76\x2f\x31\x01\2\0\0\0", 8);
const std::string kBrokenExr = "a.exr: broken openexr image: ";
const std::string kLacking = kBrokenExr + "its header lacks a data window, a compression or channels";

// Predefined attribute types of "OpenEXR File Layout" with their sizes in bytes.
TEST_F(ImageIo, exrAttributesOfEveryTypeAreCheckedForSize)
{
    const std::pair<const char*, std::uint32_t> types[] = {{"box2i", 16},         {"box2f", 16}, {"chromaticities", 32},
                                                           {"compression", 1},    {"double", 8}, {"envmap", 1},
                                                           {"float", 4},          {"int", 4},    {"keycode", 28},
                                                           {"lineOrder", 1},      {"m33f", 36},  {"m44f", 64},
                                                           {"m33d", 72},          {"m44d", 128}, {"rational", 8},
                                                           {"tiledesc", 9},       {"v2i", 8},    {"v2f", 8},
                                                           {"v2d", 16},           {"v3i", 12},   {"v3f", 12},
                                                           {"deepImageState", 1}, {"v3d", 24},   {"timecode", 8}};
    for (const auto& [type, size] : types)
        for (const std::uint32_t stored : {size - 1, size, size + 1})
            EXPECT_EQ(exrMessage(kExrStart + exrHeader({{"a", type, stored, std::string(stored, '\1')}})),
                      stored == size ? kLacking
                                     : kBrokenExr + "an attribute of its header has " + std::to_string(stored)
                              + " bytes, which do not fit its type")
                << type;
    for (const std::uint32_t stored : {0u, 1u, 7u}) // for these types, any size is valid
        EXPECT_EQ(exrMessage(kExrStart
                             + exrHeader({{"a", "string", stored, std::string(stored, 's')},
                                          {"b", "somebody's", stored, std::string(stored, 's')}})),
                  kLacking);
    const auto open = [](std::uint32_t size) { return kExrStart + std::string("a\0string\0", 9) + words({size}); };
    EXPECT_EQ(exrMessage(open(5) + "abcd"),
              kBrokenExr + "an attribute of its header takes 5 bytes, the file has 4 left");
    EXPECT_EQ(exrMessage(open(4) + "abcd"), kBrokenExr + "its header extends past the end of the file");
    EXPECT_EQ(exrMessage(kExrStart + exrHeader({{std::string(255, 'n'), std::string(255, 't'), 1, "x"}})), kLacking);
    EXPECT_EQ(exrMessage(kExrStart + exrHeader({{std::string(256, 'n'), "int", 4, "1234"}})),
              kBrokenExr + "an attribute of its header has a name without an end");
    EXPECT_NE(exrMessage(kExrStart + exrHeader({{"n", std::string(256, 't'), 4, "1234"}}))
                  .find("an attribute of its header takes"),
              std::string::npos);
}

// Rows of a block by compression: none, RLE, ZIPS, ZIP, PIZ, PXR24, B44, B44A, DWAA, DWAB. The offset table is zero.
TEST_F(ImageIo, exrBlockCountsFollowRowsOrTilesAndLimits)
{
    const auto file = [](std::uint32_t width, std::uint32_t height, char compression, std::uint32_t across = 0,
                         std::uint32_t down = 0) {
        ExrAttributes attributes = exrAttributes(words({3, 4, 3 + width - 1, 4 + height - 1}), 2, compression);
        if (across > 0)
            attributes.emplace_back("tiles", "tiledesc", 9, words({across, down}) + '\0');
        return kExrStart + exrHeader(attributes) + std::string(8, '\0');
    };
    const auto missing = [](std::uint32_t count) {
        return kBrokenExr + "block 0 of " + std::to_string(count) + " is not in the file";
    };
    const std::uint32_t rows[] = {1, 1, 1, 16, 32, 16, 32, 32, 32, 256};
    for (char compression = 0; compression < 10; ++compression) {
        const std::uint32_t each = rows[std::size_t(compression)];
        for (const std::uint32_t height : {1u, 256u, 257u, 300u})
            EXPECT_EQ(exrMessage(file(3, height, compression)), missing((height + each - 1) / each))
                << int(compression) << ' ' << height;
        // 3 pixels of 4 bytes in each row of a block.
        LoadLimits limits;
        limits.imageBytes = 12 * each - 1;
        const auto refused = decodeImage(bytesOf(file(3, 300, compression)), "a.exr", limits);
        ASSERT_FALSE(refused);
        EXPECT_TRUE(refused.error().memory);
        EXPECT_EQ(refused.error().message,
                  kBrokenExr + "its blocks have " + std::to_string(3 * each) + " pixels of 4 bytes, the limit is "
                      + std::to_string(12 * each - 1) + " bytes");
        limits.imageBytes = 12 * each;
        EXPECT_EQ(exrMessage(file(3, 300, compression), limits), missing((300 + each - 1) / each));
    }
    EXPECT_EQ(exrMessage(file(3, 9, 10)), missing(9)); // unknown compression
    EXPECT_EQ(exrMessage(file(5, 7, 0, 2, 3)), missing(3 * 3));
    EXPECT_EQ(exrMessage(file(5, 7, 0, 3, 2)), missing(2 * 4));
    EXPECT_EQ(exrMessage(file(6, 7, 0, 3, 7)), missing(2 * 1));
    LoadLimits limits;
    limits.imageBytes = 4 * 30 * 20 - 1;
    EXPECT_EQ(exrMessage(file(5, 7, 0, 30, 20), limits),
              kBrokenExr + "its blocks have 600 pixels of 4 bytes, the limit is 2399 bytes");
    limits.imageBytes += 1;
    EXPECT_EQ(exrMessage(file(5, 7, 0, 30, 20), limits), missing(1));
    limits = {};
    limits.imageSide = 6;
    EXPECT_EQ(exrMessage(file(7, 5, 0), limits), kBrokenExr + "7 x 5 pixels, the limit is 6 per side");
    EXPECT_EQ(exrMessage(file(5, 7, 0), limits), kBrokenExr + "5 x 7 pixels, the limit is 6 per side");
    EXPECT_EQ(exrMessage(file(6, 6, 0), limits), missing(6));
}

// Every block, also at the edges, must have the bytes of its pixels: 2 for each half, 4 for each float.
TEST_F(ImageIo, exrBlocksOneByteTooShortAreReportedByNumber)
{
    for (const std::uint32_t type : {1u, 2u})
        for (const std::uint32_t tile : {0u, 2u}) {
            const std::uint32_t width = 3, height = 5, bytes = type == 1 ? 2 : 4;
            const std::string file = plainExr(7, 5, width, height, type, tile);
            ASSERT_TRUE(decodeImage(bytesOf(file), "a.exr"));
            const std::uint32_t across = tile > 0 ? 2 : 1, count = across * (tile > 0 ? 3 : height);
            const std::size_t before = tile > 0 ? 16 : 4;
            std::size_t at = file.size() - width * height * bytes - count * (before + 4);
            for (std::uint32_t i = 0; i < count; ++i) {
                const std::uint32_t pixels = tile == 0 ? width : (i % across == 0 ? 2 : 1) * (i / across < 2 ? 2 : 1);
                const std::string wrongSize = "block " + std::to_string(i) + " has "
                    + std::to_string(pixels * bytes - 1) + " bytes, expected " + std::to_string(pixels * bytes);
                EXPECT_EQ(exrMessage(std::string(file).replace(at + before, 4, words({pixels * bytes - 1}))),
                          kBrokenExr + wrongSize);
                const std::string beyond = "block " + std::to_string(i) + " takes 99999 bytes from "
                    + std::to_string(at + before + 4) + ", the file has " + std::to_string(file.size());
                EXPECT_EQ(exrMessage(std::string(file).replace(at + before, 4, words({99999}))), kBrokenExr + beyond);
                at += before + 4 + pixels * bytes;
            }
            EXPECT_EQ(at, file.size());
        }
}

} // namespace
} // namespace cotan::test
