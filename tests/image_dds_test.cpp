// Hand-made DDS files: forms that are read and forms that are refused.
#include <algorithm>
#include <cstring>
#include <string>

#include <gtest/gtest.h>

#include "image_io.hpp"

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

TEST_F(ImageIo, ddsWithDx10HeaderRequiresAllBlocks)
{
    // BC5, 5 x 7 pixels: 2 x 2 blocks of two BC4 halves. All indices are 0: each channel is its first endpoint.
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

// One block of zeros. Its alpha of 0 would make the library divide by 0 for DXT2 and DXT4; as DXT5 the block is valid.
TEST_F(ImageIo, ddsWithPremultipliedAlphaIsRefused)
{
    for (const std::string& name : {std::string("DXT2"), std::string("DXT4"), std::string("DXT5")}) {
        const std::string file = dx10(4, 4, 0).substr(0, 128).replace(84, 4, name) + std::string(16, '\0');
        const auto image = decodeImage(bytesOf(file), "a.dds");
        EXPECT_EQ(bool(image), name == "DXT5") << name;
        EXPECT_EQ(bool(openRows(write("a.dds", file))), name == "DXT5") << name;
    }
}

TEST_F(ImageIo, ddsWithTooManyLevelsIsRefused)
{
    const std::string file = dx10(4, 4, 83) + std::string(16, '\0');
    EXPECT_TRUE(decodeImage(bytesOf(std::string(file).replace(28, 1, 1, '\x03')), "a.dds"));
    const auto image = decodeImage(bytesOf(std::string(file).replace(28, 4, 4, '\x47')), "a.dds");
    ASSERT_FALSE(image);
    EXPECT_NE(image.error().message.find("it has 1195853639 levels"), std::string::npos) << image.error().message;
}

TEST_F(ImageIo, ddsOfNormalsInOneChannelIsRefused)
{
    for (const std::string& name : {std::string("ATI1"), std::string("BC4U"), std::string("ATI2")}) {
        const std::string plain = dx10(4, 4, 0).substr(0, 128).replace(84, 4, name) + std::string(16, '\x10');
        const std::string normals = std::string(plain).replace(83, 1, 1, '\x80'); // the flag 0x80000000
        EXPECT_TRUE(decodeImage(bytesOf(plain), "a.dds")) << name;
        EXPECT_EQ(bool(decodeImage(bytesOf(normals), "a.dds")), name == "ATI2") << name;
    }
}

TEST_F(ImageIo, ddsWithEmptyMasksOrUnknownKindIsRefused)
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
    // Alpha alone, palettes, YUV: OpenImageIO reads them as colours whatever their masks are.
    for (const std::uint32_t flags : {0u, 1u, 2u, 0x20u, 0x21u, 0x200u, 0x20040u})
        EXPECT_FALSE(ofKind(flags)) << flags;
}

TEST_F(ImageIo, uncompressedDdsRequiresAllPixels)
{
    std::string file = dx10(4, 4, 0).substr(0, 128);
    file.replace(80, 28, words({0x41, 0, 32, 0xff0000, 0xff00, 0xff, 0xff000000}));
    EXPECT_TRUE(decodeImage(bytesOf(file + std::string(64, 'x')), "a.dds"));
    EXPECT_NE(
        messageOf(decodeImage(bytesOf(file + std::string(63, 'x')), "a.dds")).find("16 times 4 bytes, the file has 63"),
        std::string::npos);
}

// DXGI_FORMAT values and DDS_PIXELFORMAT FourCC codes by Microsoft, each with the bytes of a 4 x 4 block or of a pixel.
// 5 x 7 pixels are 2 x 2 blocks.
TEST_F(ImageIo, everyDdsFormatRequiresItsByteCount)
{
    const struct {
        std::uint32_t first, last;
        int block, pixel;
    } ranges[] = {{1, 4, 0, 16},  {5, 8, 0, 12},  {9, 18, 0, 8},   {23, 43, 0, 4},  {48, 59, 0, 2},
                  {60, 65, 0, 1}, {70, 72, 8, 0}, {73, 78, 16, 0}, {79, 81, 8, 0},  {82, 84, 16, 0},
                  {85, 86, 0, 2}, {87, 88, 0, 4}, {90, 93, 0, 4},  {94, 96, 16, 0}, {97, 99, 16, 0}};
    const auto expectHeld = [](const std::string& header, int block, int pixel) {
        const std::size_t each = std::size_t(block + pixel), count = block > 0 ? 4 : 35;
        const auto told = [&](std::size_t found) {
            return "a.dds: broken dds image: 5 x 7 pixels take " + std::to_string(count) + " times "
                + std::to_string(each) + " bytes, the file has " + std::to_string(found) + " after its header";
        };
        for (const std::size_t found : {std::size_t(0), each * count - 1})
            EXPECT_EQ(messageOf(decodeImage(bytesOf(header + std::string(found, '\0')), "a.dds")), told(found));
        const std::string all = header + std::string(each * count, '\0');
        EXPECT_EQ(messageOf(decodeImage(bytesOf(all), "a.dds")).find("after its header"), std::string::npos);
    };
    const std::string unknown = "a.dds: broken dds image: its pixel format is not supported";
    for (std::uint32_t format = 0; format < 120; ++format) {
        SCOPED_TRACE(format);
        const auto* const known = std::ranges::find_if(
            ranges, [&](const auto& range) { return format >= range.first && format <= range.last; });
        if (known == std::end(ranges))
            EXPECT_EQ(messageOf(decodeImage(bytesOf(dx10(5, 7, format) + std::string(999, '\0')), "a.dds")), unknown);
        else
            expectHeld(dx10(5, 7, format), known->block, known->pixel);
    }
    const std::string plain = dx10(5, 7, 0).substr(0, 128);
    for (const char* const letters : {"DXT1", "ATI1", "BC4U", "BC4S"})
        expectHeld(std::string(plain).replace(84, 4, letters), 8, 0);
    for (const char* const letters : {"DXT3", "DXT5", "ATI2", "BC5U", "BC5S"})
        expectHeld(std::string(plain).replace(84, 4, letters), 16, 0);
    for (const char* const letters : {"DXT2", "DXT4", "DX11", "BC6H"})
        EXPECT_EQ(messageOf(decodeImage(bytesOf(std::string(plain).replace(84, 4, letters) + std::string(999, '\0')),
                                        "a.dds")),
                  unknown);
    for (const std::uint32_t bits : {8u, 16u, 24u, 32u})
        expectHeld(std::string(plain).replace(80, 28, words({0x41, 0, bits, 0xc0, 0x30, 0x0c, 0x03})), 0,
                   int(bits) / 8);
}

TEST_F(ImageIo, ddsHeadersAreCompleteAndLevelsAreAtMost32)
{
    const std::string cut = "a.dds: broken dds image: its header extends past the end of the file";
    const std::string newer = dx10(5, 7, 83), older = std::string(newer).replace(84, 4, "DXT5").substr(0, 128);
    for (const std::string& header : {newer, older}) {
        EXPECT_EQ(messageOf(decodeImage(bytesOf(header.substr(0, header.size() - 1)), "a.dds")), cut);
        EXPECT_EQ(messageOf(decodeImage(bytesOf(header), "a.dds")),
                  "a.dds: broken dds image: 5 x 7 pixels take 4 times 16 bytes, the file has 0 after its header");
    }
    const std::string many = dx10(4, 4, 83) + std::string(16, '\0');
    EXPECT_EQ(messageOf(decodeImage(bytesOf(std::string(many).replace(28, 1, 1, '\x21')), "a.dds")),
              "a.dds: broken dds image: it has 33 levels, the limit is 32");
    EXPECT_EQ(messageOf(decodeImage(bytesOf(std::string(many).replace(28, 1, 1, '\x20')), "a.dds")).find("levels"),
              std::string::npos);
}

} // namespace
} // namespace cotan::test
