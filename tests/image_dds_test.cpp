// DDS files made by hand: forms that are read, and those that are not.
#include <algorithm>
#include <cstring>
#include <string>

#include <gtest/gtest.h>

#include "picture_file.hpp"

namespace cotan::test {
namespace {

std::string dx10(int width, int height, std::uint32_t format)
{
    std::array<std::uint32_t, 37> header{};
    header[0] = 0x20534444, header[1] = 124, header[2] = 0x1007; // caps, height, width, pixel format
    header[3] = std::uint32_t(height), header[4] = std::uint32_t(width);
    header[19] = 32, header[20] = 0x4, header[21] = 0x30315844; // "DX10"
    header[27] = 0x1000;
    header[32] = format, header[33] = 3 /*2D*/, header[35] = 1;
    return {reinterpret_cast<const char*>(header.data()), sizeof header};
}

TEST_F(PictureFile, ddsWithTheNewerHeaderNeedsAllItsBlocks)
{
    // BC5, 5 x 7 pixels: 2 x 2 blocks of two BC4 halves, all indices 0: each channel its first endpoint.
    std::string file = dx10(5, 7, 83);
    for (const int red : {200, 40, 90, 10})
        file += std::string(1, char(red)) + std::string(7, '\0') + std::string(1, char(red / 2)) + std::string(7, '\0');
    const auto image = decodeImage(bytesOf(file), "a.dds");
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(component(*image, 0, 0, 0), 200);
    EXPECT_EQ(component(*image, 4, 3, 0), 40);
    EXPECT_EQ(component(*image, 0, 4, 1), 45);
    EXPECT_EQ(component(*image, 4, 6, 1), 5);
    for (const std::size_t length :
         {std::size_t(0), std::size_t(128), std::size_t(147), std::size_t(148), file.size() - 1}) {
        EXPECT_FALSE(decodeImage(bytesOf(file.substr(0, length)), "a.dds")) << length;
    }
    EXPECT_FALSE(decodeImage(bytesOf(dx10(4, 4, 999) + std::string(4096, '\0')), "a.dds"));
    EXPECT_FALSE(decodeImage(bytesOf(dx10(0x7fffffff, 0x7fffffff, 83) + std::string(4096, '\0')), "a.dds"));
}

// One block of zeros: alpha is 0, by which the library would divide. The same block is sound as DXT5.
TEST_F(PictureFile, ddsOfColoursMultipliedByAlphaIsRefused)
{
    for (const std::string& name : {std::string("DXT2"), std::string("DXT4"), std::string("DXT5")}) {
        const std::string file = dx10(4, 4, 0).substr(0, 128).replace(84, 4, name) + std::string(16, '\0');
        const auto image = decodeImage(bytesOf(file), "a.dds");
        EXPECT_EQ(bool(image), name == "DXT5") << name;
        EXPECT_EQ(bool(openRows(write("a.dds", file))), name == "DXT5") << name;
    }
}

TEST_F(PictureFile, ddsOfMoreLevelsThanAPictureCanHaveIsRefused)
{
    const std::string file = dx10(4, 4, 83) + std::string(16, '\0');
    EXPECT_TRUE(decodeImage(bytesOf(std::string(file).replace(28, 1, 1, '\x03')), "a.dds"));
    const auto image = decodeImage(bytesOf(std::string(file).replace(28, 4, 4, '\x47')), "a.dds");
    ASSERT_FALSE(image);
    EXPECT_NE(image.error().message.find("it has 1195853639 levels"), std::string::npos) << image.error().message;
}

TEST_F(PictureFile, ddsOfNormalsInOneChannelIsRefused)
{
    for (const std::string& name : {std::string("ATI1"), std::string("BC4U"), std::string("ATI2")}) {
        const std::string plain = dx10(4, 4, 0).substr(0, 128).replace(84, 4, name) + std::string(16, '\x10');
        const std::string normals = std::string(plain).replace(83, 1, 1, '\x80'); // the flag 0x80000000
        EXPECT_TRUE(decodeImage(bytesOf(plain), "a.dds")) << name;
        EXPECT_EQ(bool(decodeImage(bytesOf(normals), "a.dds")), name == "ATI2") << name;
    }
}

TEST_F(PictureFile, ddsOfChannelsWithoutBitsOrOfNoKnownKindIsRefused)
{
    std::string file = dx10(1, 1, 0).substr(0, 128);
    file.replace(80, 28,
                 std::string("\x41\0\0\0\0\0\0\0\x20\0\0\0"
                             "\0\0\xff\0"
                             "\0\xff\0\0"
                             "\xff\0\0\0"
                             "\0\0\0\xff",
                             28));
    file += "\1\2\3\4";
    ASSERT_TRUE(decodeImage(bytesOf(file), "a.dds"));
    for (const std::size_t mask : {92u, 96u, 100u, 104u})
        EXPECT_FALSE(decodeImage(bytesOf(std::string(file).replace(mask, 4, 4, '\0')), "a.dds")) << mask;
    const auto ofKind = [&](std::uint32_t flags) {
        std::string other = file;
        for (std::size_t i = 0; i < 4; ++i)
            other[80 + i] = char(flags >> 8 * i);
        return bool(decodeImage(bytesOf(other), "a.dds"));
    };
    EXPECT_TRUE(ofKind(0x40) && ofKind(0x20000) && ofKind(0x20001)) << "colours and brightness";
    // Alpha alone, palettes, YUV: read as colours whatever their masks are.
    for (const std::uint32_t flags : {0u, 1u, 2u, 0x20u, 0x21u, 0x200u, 0x20040u})
        EXPECT_FALSE(ofKind(flags)) << flags;
}

TEST_F(PictureFile, ddsOfPlainPixelsNeedsAllOfThem)
{
    std::string file = dx10(4, 4, 0).substr(0, 128);
    file.replace(80, 28, words({0x41, 0, 32, 0xff0000, 0xff00, 0xff, 0xff000000}));
    EXPECT_TRUE(decodeImage(bytesOf(file + std::string(64, 'x')), "a.dds"));
    EXPECT_NE(
        messageOf(decodeImage(bytesOf(file + std::string(63, 'x')), "a.dds")).find("16 times 4 bytes, the file has 63"),
        std::string::npos);
}

} // namespace
} // namespace cotan::test
