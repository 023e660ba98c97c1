// Hand-made BMP files: palettes, run-length encoding, and headers that claim more than the file has.
#include <cstdint>
#include <string>

#include <gtest/gtest.h>

#include "image_io.hpp"

namespace cotan::test {
namespace {

// 2 x 2 pixels with palette entries 1, 2, 3 and 4; compression 1 is RLE8.
std::string makeBmp(std::uint32_t bits, std::uint32_t compression)
{
    const std::string rows = compression == 0 ? std::string("\1\2\0\0\3\4\0\0", 8) // rows are padded to 4 bytes
                                              : std::string("\1\1\1\2\0\0\1\3\1\4\0\1", 12);
    std::string file = "BM";
    const auto add = [&](std::uint32_t value, int bytes) {
        for (int i = 0; i < bytes; ++i)
            file += char(value >> 8 * i);
    };
    for (const std::uint32_t value : {std::uint32_t(1078 + rows.size()), 0u, 1078u, 40u, 2u, 2u})
        add(value, 4);
    add(1, 2);
    add(bits, 2);
    for (const std::uint32_t value : {compression, std::uint32_t(rows.size()), 2835u, 2835u, 0u, 0u})
        add(value, 4);
    for (std::uint32_t i = 0; i < 256; ++i)
        add(i * 0x010203, 4); // blue is three times red
    return file + rows;
}

TEST_F(ImageIo, runLengthBmpRequiresItsBitsPerPixel)
{
    for (const std::uint32_t compression : {0u, 1u}) {
        const auto image = decodeImage(bytesOf(makeBmp(8, compression)), "a.bmp");
        ASSERT_TRUE(image) << image.error().message;
        const int expected[] = {3, 4, 1, 2}; // rows are stored bottom-up
        for (int i = 0; i < 4; ++i) {
            EXPECT_EQ(image->bytes8()[4 * i], expected[i]) << compression;
            EXPECT_EQ(image->bytes8()[4 * i + 2], 3 * expected[i]) << compression;
        }
    }
    for (const std::uint32_t bits : {1u, 4u, 16u, 24u, 32u}) // 24 once read before the start of the rows and crashed
        EXPECT_FALSE(decodeImage(bytesOf(makeBmp(bits, 1)), "a.bmp")) << bits;
    for (const std::uint32_t bits : {1u, 8u, 16u, 24u, 32u})
        EXPECT_FALSE(decodeImage(bytesOf(makeBmp(bits, 2)), "a.bmp")) << bits;
    const std::string runs = makeBmp(24, 1);
    EXPECT_NE(messageOf(openRows(write("a.bmp", runs))).find("24 bits per pixel, compression 1 has 8"),
              std::string::npos);
    EXPECT_FALSE(decodeImage(bytesOf(runs.substr(0, 33)), "a.bmp"));
}

TEST_F(ImageIo, bmpOfAnUnknownHeaderIsRefused)
{
    for (const std::uint32_t size : {0u, 11u, 16u, 64u, 0xffffffffu}) // once the size came from uninitialised memory
        EXPECT_NE(messageOf(decodeImage(bytesOf(makeBmp(8, 0).replace(14, 4, words({size}))), "a.bmp"))
                      .find("headers of " + std::to_string(size) + " bytes are not supported"),
                  std::string::npos);
    EXPECT_NE(messageOf(decodeImage(bytesOf(makeBmp(8, 0).substr(0, 53)), "a.bmp")).find("its header extends past"),
              std::string::npos);
}

TEST_F(ImageIo, runLengthBmpOverTheLimitIsRefusedBeforeItIsRead)
{
    LoadLimits limits;
    limits.imageBytes = 16; // 2 x 2 pixels of 4 bytes
    EXPECT_TRUE(decodeImage(bytesOf(makeBmp(8, 1)), "a.bmp", limits));
    for (const std::string& height : {std::string("\0\1\0\0", 4), std::string("\0\xff\xff\xff", 4)}) { // 256, -256
        const std::string runs = makeBmp(8, 1).replace(22, 4, height);
        EXPECT_TRUE(decodeImage(bytesOf(runs), "a.bmp", limits).error().memory);
        EXPECT_NE(
            messageOf(decodeImage(bytesOf(runs), "a.bmp", limits)).find("2 x 256 pixels of one byte, the limit is 16"),
            std::string::npos)
            << messageOf(decodeImage(bytesOf(runs), "a.bmp", limits));
    }
}

// Header kinds differ only in their sizes: OS/2's 12 bytes, Windows' 40 bytes and its four extensions.
TEST_F(ImageIo, bmpHeaderSizesAreCheckedAndErrorsReported)
{
    const std::string sound = makeBmp(8, 0), broken = "a.bmp: broken bmp image: ";
    const auto messageFor = [](const std::string& file, const LoadLimits& limits = {}) {
        return messageOf(decodeImage(bytesOf(file), "a.bmp", limits));
    };
    for (const std::uint32_t size : {12u, 40u, 52u, 56u, 108u, 124u}) {
        const std::string file = std::string(sound).replace(14, 4, words({size}));
        EXPECT_EQ(messageFor(file).find("headers of"), std::string::npos) << size;
        EXPECT_EQ(messageFor(file.substr(0, 13 + size)), broken + "its header extends past the end of the file");
        EXPECT_EQ(messageFor(file.substr(0, 14 + size)).find("its header"), std::string::npos) << size;
        for (const std::uint32_t other : {size - 1, size + 1})
            EXPECT_EQ(messageFor(std::string(sound).replace(14, 4, words({other}))),
                      broken + "headers of " + std::to_string(other) + " bytes are not supported");
    }
    EXPECT_EQ(messageFor(makeBmp(24, 1)), broken + "it has 24 bits per pixel, compression 1 has 8");
    EXPECT_EQ(messageFor(makeBmp(8, 2)), broken + "it has 8 bits per pixel, compression 2 has 4");
    EXPECT_EQ(messageFor(makeBmp(8, 3)).find("its compression"), std::string::npos);
    // RLE pixels: 5 x 3 take 15 bytes, which are checked before anything else.
    LoadLimits limits;
    const std::string runs = makeBmp(8, 1).replace(18, 8, words({5, 3}));
    limits.imageBytes = 14;
    EXPECT_EQ(messageFor(runs, limits), broken + "5 x 3 pixels of one byte, the limit is 14 bytes");
    limits.imageBytes = 15;
    EXPECT_EQ(messageFor(runs, limits), "a.bmp: 5 x 3 pixels take 60 bytes, the limit is 15");
}

} // namespace
} // namespace cotan::test
