// WebP files, whole, cut short and lying.
#include "cotan/image.hpp"

#include <gtest/gtest.h>

#include "webp_maker.hpp"

namespace cotan {
namespace {

using test::little;
using test::makeWebp;
using test::riffChunk;
using test::riffWebp;

std::span<const std::byte> webpBytes(const std::string& text) { return std::as_bytes(std::span(text)); }

std::string refusal(const std::string& file, const LoadLimits& limits = {})
{
    const auto image = decodeImage(webpBytes(file), "a.webp", limits);
    return image ? "accepted" : image.error().message;
}

std::vector<std::array<int, 4>> webpTexels(int count)
{
    std::vector<std::array<int, 4>> texels;
    for (int i = 0; i < count; ++i)
        texels.push_back({i * 37 % 256, 255 - i * 5 % 256, i * 91 % 256, i % 3 == 0 ? 0 : 255 - i});
    return texels;
}

std::string hex(const std::string& digits)
{
    std::string bytes;
    for (std::size_t i = 0; i < digits.size(); i += 2)
        bytes += char(std::stoi(digits.substr(i, 2), nullptr, 16));
    return bytes;
}

// Google's samples for browsers that may know a part of the format: one pixel, lossy, and with alpha, and animated.
const std::string kLossy = hex("52494646220000005745425056503820160000003001009d012a010001000ec0fe25a400037000000000");
const std::string kAlpha =
    hex("524946464a00000057454250565038580a00000010000000000000000000414c50480c00000011071011fd0f44"
        "44ff03000056503820180000001401009d012a010001000000fe00000dc000fee6b5000000");
const std::string kAnimated =
    hex("524946465200000057454250565038580a00000012000000000000000000414e494d06000000ffffffff000041"
        "4e4d4626000000000000000000000000000000640000005650384c0d0000002f00000010071011118888fe0700");

TEST(Webp, losslessValuesComeBackAsTheyAreEvenWhereAlphaIsNone)
{
    const auto texels = webpTexels(15);
    const auto image = decodeImage(webpBytes(makeWebp(5, 3, texels)), "a.webp");
    ASSERT_TRUE(image) << image.error().message;
    ASSERT_EQ(image->width, 5);
    ASSERT_EQ(image->height, 3);
    ASSERT_EQ(image->type, PixelType::unorm8);
    for (std::size_t i = 0; i < texels.size(); ++i)
        for (std::size_t c = 0; c < 4; ++c)
            EXPECT_EQ(image->bytes8()[4 * i + c], texels[i][c]) << i << " " << c;
}

TEST(Webp, lossyAndExtendedFilesAreReadAndAnimationsAreNot)
{
    for (const std::string& file : {kLossy, kAlpha}) {
        const auto image = decodeImage(webpBytes(file), "a.webp");
        ASSERT_TRUE(image) << image.error().message;
        EXPECT_EQ(image->width, 1);
        EXPECT_EQ(image->height, 1);
    }
    EXPECT_EQ(refusal(kAnimated), "a.webp: broken webp image: expected one picture, found an animation");
}

TEST(Webp, filesThatEndTooSoonAreRefusedWhereverTheyEnd)
{
    for (const std::string& file : {makeWebp(5, 3, webpTexels(15)), kLossy, kAlpha})
        for (std::size_t size = 12; size < file.size(); ++size) {
            const std::string why = refusal(file.substr(0, size));
            EXPECT_TRUE(why.starts_with("a.webp: broken webp image: ")) << size << why;
            EXPECT_EQ(why.find('\n'), std::string::npos) << why;
        }
    // The header is right and the codes are not.
    const std::string data = test::losslessData(5, 3, webpTexels(15));
    for (std::size_t size = 0; size + 1 < data.size(); ++size)
        EXPECT_NE(refusal(riffWebp(riffChunk("VP8L", data.substr(0, size)))), "accepted") << size;
}

TEST(Webp, chunksThatLieAreRefused)
{
    const std::string data = test::losslessData(5, 3, webpTexels(15)), picture = riffChunk("VP8L", data);
    const auto canvas = [](int width, int height) {
        return riffChunk("VP8X",
                         std::string("\x10\0\0\0", 4) + little(std::uint64_t(width) - 1, 3)
                             + little(std::uint64_t(height) - 1, 3));
    };
    EXPECT_EQ(refusal(riffWebp(canvas(5, 3) + riffChunk("XXXX", "odd") + picture)), "accepted");
    EXPECT_NE(refusal(riffWebp(canvas(5, 4) + picture)).find("its canvas is 5 x 4, its picture 5 x 3"),
              std::string::npos);
    EXPECT_NE(refusal(riffWebp("VP8L" + little(0xfffffff0, 4) + data)).find("a chunk takes 4294967280 bytes"),
              std::string::npos);
    EXPECT_NE(refusal(riffWebp(riffChunk("VP8X", "short"))).find("its VP8X chunk has 5 bytes"), std::string::npos);
    EXPECT_NE(refusal(riffWebp(riffChunk("EXIF", "nothing"))).find("it has no picture"), std::string::npos);
    std::string lossy = kLossy;
    lossy[22] = '\x7f'; // the size of the first part
    EXPECT_NE(refusal(lossy).find("the first part of its picture takes"), std::string::npos) << refusal(lossy);
    lossy = kLossy;
    lossy[20] = '\x31'; // no key frame
    EXPECT_NE(refusal(lossy).find("does not begin with a key frame"), std::string::npos) << refusal(lossy);
}

// 16384 x 16384 pixels promised by some 300 bytes take a gibibyte.
TEST(Webp, sizesOverTheLimitAreRefusedBeforeTheyAreDecoded)
{
    EXPECT_NE(refusal(makeWebp(16384, 16384, webpTexels(1))).find("take 1073741824 bytes, the limit is"),
              std::string::npos);
    LoadLimits limits;
    limits.imageSide = 4;
    EXPECT_NE(refusal(makeWebp(5, 3, webpTexels(15)), limits).find("the limit is 4 a side"), std::string::npos);
    bool told = false;
    limits = {};
    limits.expect = [&](std::size_t bytes) { told = bytes == 60; };
    EXPECT_EQ(refusal(makeWebp(5, 3, webpTexels(15)), limits), "accepted");
    EXPECT_TRUE(told);
}

} // namespace
} // namespace cotan
