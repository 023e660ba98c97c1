// Signed blocks of DDS and KTX2, and maps of two channels whose z is rebuilt.
#include <algorithm>
#include <cmath>
#include <string>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

#include "image/component_types.hpp"
#include "image/dds.hpp"
#include "image_io.hpp"
#include "ktx2_maker.hpp"

namespace cotan::test {
namespace {

std::string fileOf(const DdsCode& code, int width, int height, const std::string& blocks)
{
    const auto header = ddsHeader(code, width, height, 1);
    return std::string(reinterpret_cast<const char*>(header.data()), header.size()) + blocks;
}

// One channel: its ends, then the first eight of 16 indices are 0 to 7 and the others 0.
std::string halfBlock(int first, int second)
{
    std::uint64_t bits = 0;
    for (std::uint64_t i = 0; i < 8; ++i)
        bits |= i << 3 * i;
    return std::string{char(first), char(second)} + little(bits, 6);
}

// Microsoft's definition, in 127ths: six values between the ends, or four, -1 and 1. -128 is -127.
TEST_F(ImageIo, signedBlocksOfDdsKeepTheirSign)
{
    const struct {
        int first, second;
        double values[8];
    } blocks[] = {{127, -127, {127, -127, 635.0 / 7, 381.0 / 7, 127.0 / 7, -127.0 / 7, -381.0 / 7, -635.0 / 7}},
                  {127, -128, {127, -127, 635.0 / 7, 381.0 / 7, 127.0 / 7, -127.0 / 7, -381.0 / 7, -635.0 / 7}},
                  {-20, 30, {-20, 30, -10, 0, 10, 20, -127, 127}},
                  {0, 0, {0, 0, 0, 0, 0, 0, -127, 127}}};
    for (const auto& [first, second, values] : blocks) {
        const std::string half = halfBlock(first, second), other = halfBlock(second, first);
        for (const DdsCode& code :
             {DdsCode{"BC4S", 0, 8}, DdsCode{"DX10", 81, 8}, DdsCode{"BC5S", 0, 16}, DdsCode{"DX10", 84, 16}}) {
            const bool two = code.block == 16;
            const std::string file = fileOf(code, 4, 4, two ? half + other : half);
            const auto image = decodeImage(bytesOf(file), "a.dds");
            ASSERT_TRUE(image) << image.error().message;
            EXPECT_EQ(image->type, PixelType::unorm16);
            EXPECT_EQ(image->channels, two ? 2 : 1);
            for (int i = 0; i < 8; ++i) {
                const double wanted = 32768 + 32767 * values[i] / 127;
                EXPECT_NEAR(component(*image, i % 4, i / 4, 0), wanted, 0.5) << first << ' ' << i;
                EXPECT_EQ(component(*image, i % 4, i / 4, 2), two ? 32768 : component(*image, i % 4, i / 4, 0));
                EXPECT_EQ(component(*image, i % 4, i / 4, 3), 65535);
            }
            EXPECT_NEAR(component(*image, 0, 0, 1), 32768 + 32767 * (two ? values[1] : values[0]) / 127, 0.5);
            const auto rows = byRows(write("a.dds", file), 3);
            ASSERT_TRUE(rows);
            EXPECT_EQ(rows->data, image->data);
        }
    }
}

TEST_F(ImageIo, signedDdsIsCompleteFlatAndWithinLimits)
{
    const std::string file =
        fileOf({"DX10", 84, 16}, 5, 3, halfBlock(9, -9) + halfBlock(9, -9) + std::string(16, '\0'));
    EXPECT_TRUE(decodeImage(bytesOf(file), "a.dds"));
    EXPECT_EQ(messageOf(decodeImage(bytesOf(file.substr(0, file.size() - 1)), "a.dds")),
              "a.dds: broken dds image: 5 x 3 pixels take 2 times 16 bytes, the file has 31 after its header");
    LoadLimits limits;
    limits.imageSide = 4;
    EXPECT_EQ(messageOf(decodeImage(bytesOf(file), "a.dds", limits)),
              "a.dds: the image size is 5 x 3, the limit is 4 per side");
    EXPECT_EQ(messageOf(decodeImage(bytesOf(std::string(file).replace(16, 4, 4, '\0')), "a.dds")),
              "a.dds: the image size is 0 x 3");
    EXPECT_EQ(messageOf(decodeImage(bytesOf(std::string(file).replace(113, 1, 1, '\x02')), "a.dds")),
              "a.dds: expected a flat image, found a cube map or a volume");
}

// Khronos Data Format 1.3, signed R11 EAC, in 1023rds: 8 base + 8 factor modifier, or 8 base + modifier for a factor of
// 0. -128 is -127.
TEST_F(ImageIo, signedEacKeepsItsSign)
{
    const struct {
        int base, factor, wanted; // with modifier 14 of table 0, index 7
    } blocks[] = {{0, 0, 14}, {0, 1, 112}, {-10, 2, 144}, {127, 15, 1023}, {-128, 0, -1002}, {-127, 0, -1002}};
    for (const auto& [base, factor, wanted] : blocks) {
        std::string half{char(base), char(factor << 4)};
        half += std::string(6, '\xff');
        for (const bool two : {false, true}) {
            const std::string file = makeKtx2(
                {.format = two ? 156u : 154u, .width = 4, .height = 4, .levels = {{two ? half + half : half}}});
            const auto image = decodeImage(bytesOf(file), "a.ktx2");
            ASSERT_TRUE(image) << image.error().message;
            EXPECT_EQ(image->channels, two ? 2 : 1);
            for (int c = 0; c < 2; ++c)
                EXPECT_NEAR(component(*image, 3, 2, c), 32768 + 32767.0 * wanted / 1023, 0.5) << base << ' ' << factor;
            EXPECT_EQ(component(*image, 3, 2, 3), 65535);
        }
    }
}

// x is 0.5 and y is 0, stored as 0.75 and 0.5: 30 degrees. If z were computed of the stored values, it would be 0.43,
// and the angle 49 degrees or, after the expansion, more than 90.
TEST_F(ImageIo, zIsRebuiltOfExpandedValues)
{
    const std::string bc = halfBlock(191, 190), flat = halfBlock(128, 127), signedBc = halfBlock(64, 63);
    std::string eac{char(191), '\x00'}, middle{char(128), '\x00'}; // 8 x 191 + 4 + 2 of 2047
    eac += std::string("\x92\x49\x24\x92\x49\x24", 6);             // all indices are 4
    middle += std::string("\0\0\0\0\0\0", 6);
    std::string signedEac{char(64), '\x00'}, zero{'\0', '\x00'};
    signedEac += std::string("\x92\x49\x24\x92\x49\x24", 6);
    zero += std::string(6, '\0');
    Image map = makeImage(1, 1, PixelType::unorm16);
    const std::uint16_t stored[] = {49151, 32768, 32768, 65535};
    std::copy_n(stored, 4, map.words());
    const auto png = encodePng(map);
    ASSERT_TRUE(png);
    const std::string pngText(reinterpret_cast<const char*>(png->data()), png->size());
    const auto ktx2 = [](std::uint32_t format, const std::string& blocks) {
        return makeKtx2({.format = format, .width = 1, .height = 1, .levels = {{blocks}}});
    };
    const std::pair<const char*, std::string> files[] = {
        {"a.png", pngText},
        {"bc5.dds", fileOf({"DX10", 83, 16}, 1, 1, bc + flat)},
        {"bc5.ktx2", ktx2(141, bc + flat)},
        {"eac.ktx2", ktx2(155, eac + middle)},
        {"signed bc5.dds", fileOf({"BC5S", 0, 16}, 1, 1, signedBc + halfBlock(0, -1))},
        {"signed bc5.ktx2", ktx2(142, signedBc + halfBlock(0, -1))},
        {"signed eac.ktx2", ktx2(156, signedEac + zero)}};
    for (const auto& [name, file] : files) {
        auto image = decodeImage(bytesOf(file), name);
        ASSERT_TRUE(image) << image.error().message;
        completeNormals(*image);
        const double one = image->type == PixelType::unorm8 ? 127 : 32767, zeroCode = one + 1;
        const glm::dvec3 n =
            (glm::dvec3(component(*image, 0, 0, 0), component(*image, 0, 0, 1), component(*image, 0, 0, 2)) - zeroCode)
            / one;
        EXPECT_NEAR(glm::length(n), 1, 0.01) << name;
        EXPECT_NEAR(glm::degrees(std::acos(n.z / glm::length(n))), 30, 0.4) << name; // half a code of 8 bits
    }
}

} // namespace
} // namespace cotan::test
