// WebP files: whole, truncated, and with false headers.
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

// Google's samples for detecting browser support: one pixel, lossy, with alpha, and animated.
const std::string kLossy = hex("52494646220000005745425056503820160000003001009d012a010001000ec0fe25a400037000000000");
const std::string kAlpha =
    hex("524946464a00000057454250565038580a00000010000000000000000000414c50480c00000011071011fd0f44"
        "44ff03000056503820180000001401009d012a010001000000fe00000dc000fee6b5000000");
const std::string kAnimated =
    hex("524946465200000057454250565038580a00000012000000000000000000414e494d06000000ffffffff000041"
        "4e4d4626000000000000000000000000000000640000005650384c0d0000002f00000010071011118888fe0700");

TEST(Webp, losslessValuesRoundTripEvenAtAlphaZero)
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

TEST(Webp, lossyAndExtendedFilesAreReadAndAnimationsRefused)
{
    for (const std::string& file : {kLossy, kAlpha}) {
        const auto image = decodeImage(webpBytes(file), "a.webp");
        ASSERT_TRUE(image) << image.error().message;
        EXPECT_EQ(image->width, 1);
        EXPECT_EQ(image->height, 1);
    }
    EXPECT_EQ(refusal(kAnimated), "a.webp: broken webp image: expected one image, found an animation");
}

TEST(Webp, truncatedFilesAreRefusedAtEveryLength)
{
    for (const std::string& file : {makeWebp(5, 3, webpTexels(15)), kLossy, kAlpha})
        for (std::size_t size = 12; size < file.size(); ++size) {
            const std::string why = refusal(file.substr(0, size));
            EXPECT_TRUE(why.starts_with("a.webp: broken webp image: ")) << size << why;
            EXPECT_EQ(why.find('\n'), std::string::npos) << why;
        }
    // The header is valid but the codes are truncated.
    const std::string data = test::losslessData(5, 3, webpTexels(15));
    for (std::size_t size = 0; size + 1 < data.size(); ++size)
        EXPECT_NE(refusal(riffWebp(riffChunk("VP8L", data.substr(0, size)))), "accepted") << size;
}

TEST(Webp, inconsistentChunksAreRefused)
{
    const std::string data = test::losslessData(5, 3, webpTexels(15)), picture = riffChunk("VP8L", data);
    const auto canvas = [](int width, int height) {
        return riffChunk("VP8X",
                         std::string("\x10\0\0\0", 4) + little(std::uint64_t(width) - 1, 3)
                             + little(std::uint64_t(height) - 1, 3));
    };
    EXPECT_EQ(refusal(riffWebp(canvas(5, 3) + riffChunk("XXXX", "odd") + picture)), "accepted");
    EXPECT_NE(refusal(riffWebp(canvas(5, 4) + picture)).find("its canvas is 5 x 4, its image 5 x 3"),
              std::string::npos);
    EXPECT_NE(refusal(riffWebp("VP8L" + little(0xfffffff0, 4) + data)).find("a chunk takes 4294967280 bytes"),
              std::string::npos);
    EXPECT_NE(refusal(riffWebp(riffChunk("VP8X", "short"))).find("its VP8X chunk has 5 bytes"), std::string::npos);
    EXPECT_NE(refusal(riffWebp(riffChunk("EXIF", "nothing"))).find("it has no image"), std::string::npos);
    std::string lossy = kLossy;
    lossy[22] = '\x7f'; // the size of the first partition
    EXPECT_NE(refusal(lossy).find("the first part of its image takes"), std::string::npos) << refusal(lossy);
    lossy = kLossy;
    lossy[20] = '\x31'; // not a key frame
    EXPECT_NE(refusal(lossy).find("does not begin with a key frame"), std::string::npos) << refusal(lossy);
}

// 16384 x 16384 pixels, claimed by about 300 bytes, take 1 GiB.
TEST(Webp, sizesOverTheLimitAreRefusedBeforeDecoding)
{
    EXPECT_NE(refusal(makeWebp(16384, 16384, webpTexels(1))).find("take 1073741824 bytes, the limit is"),
              std::string::npos);
    LoadLimits limits;
    limits.imageSide = 4;
    EXPECT_NE(refusal(makeWebp(5, 3, webpTexels(15)), limits).find("the limit is 4 per side"), std::string::npos);
    bool announced = false;
    limits = {};
    limits.expect = [&](std::size_t bytes) { announced = bytes == 60; };
    EXPECT_EQ(refusal(makeWebp(5, 3, webpTexels(15)), limits), "accepted");
    EXPECT_TRUE(announced);
}

// kLossy is one chunk of 22 bytes after 20, of which 10 are the frame header; RFC 9649 and RFC 6386, 9.1.
TEST(Webp, errorsStateNumbersAndBeginBeyondEachBound)
{
    const std::string broken = "a.webp: broken webp image: ";
    const auto lossy = [](std::size_t bytes) { return riffWebp(riffChunk("VP8 ", kLossy.substr(20, bytes))); };
    EXPECT_EQ(refusal(lossy(9)), broken + "its VP8 chunk has 9 bytes, expected at least 10");
    EXPECT_EQ(refusal(lossy(10)),
              broken + "the first part of its image takes 9 bytes, its chunk has 0 after the header");
    EXPECT_EQ(refusal(lossy(18)),
              broken + "the first part of its image takes 9 bytes, its chunk has 8 after the header");
    EXPECT_EQ(refusal(lossy(19)).find("the first part"), std::string::npos);
    std::string file = kLossy;
    file[21] = '\x02'; // the first partition claims 9 + 8 bytes, 12 are present
    EXPECT_EQ(refusal(file), broken + "the first part of its image takes 17 bytes, its chunk has 12 after the header");
    for (const std::size_t mark : {23u, 24u, 25u}) {
        file = kLossy;
        file[mark] ^= 1;
        EXPECT_EQ(refusal(file), broken + "its VP8 chunk does not begin with a key frame") << mark;
    }
    file = kLossy; // two bits of each size give an upscaling hint, which readers ignore
    file[27] ^= '\x40', file[29] ^= '\x80';
    EXPECT_EQ(refusal(file), "accepted");

    const std::string data = test::losslessData(5, 3, webpTexels(15));
    EXPECT_EQ(refusal(riffWebp(riffChunk("VP8L", data.substr(0, 4)))),
              broken + "its VP8L chunk has 4 bytes, expected at least 5");
    EXPECT_EQ(refusal(riffWebp(riffChunk("VP8L", data.substr(0, 5)))).find("expected at least"), std::string::npos);
    for (const auto& [at, bit] : {std::pair(0, 1), {4, 0x20}, {4, 0x40}, {4, 0x80}}) {
        std::string other = data;
        other[std::size_t(at)] = char(other[std::size_t(at)] ^ bit);
        EXPECT_EQ(refusal(riffWebp(riffChunk("VP8L", other))),
                  broken + "its VP8L chunk has an unknown signature or version");
    }

    const std::string whole = riffWebp(riffChunk("VP8L", data));
    const auto count = [](std::size_t n) { return std::to_string(n); };
    EXPECT_EQ(refusal(whole + "and more"), "accepted");
    EXPECT_EQ(refusal(whole.substr(0, whole.size() - 1)),
              broken + "its header announces " + count(whole.size()) + " bytes, the file has "
                  + count(whole.size() - 1));
    const std::size_t left = whole.size() - 20; // after the name and size of the chunk
    std::string longer = whole;
    longer.replace(16, 4, little(left + 1, 4));
    EXPECT_EQ(refusal(longer),
              broken + "a chunk takes " + count(left + 1) + " bytes from 20, the file has " + count(whole.size()));
    longer.replace(16, 4, little(left, 4));
    EXPECT_EQ(refusal(longer), "accepted");

    const auto canvas = [&](std::size_t bytes, int width, int height) {
        return riffChunk("VP8X",
                         (std::string("\x10\0\0\0", 4) + little(std::uint64_t(width) - 1, 3)
                          + little(std::uint64_t(height) - 1, 3))
                             .substr(0, bytes))
            + riffChunk("VP8L", data);
    };
    EXPECT_EQ(refusal(riffWebp(canvas(10, 5, 3))), "accepted");
    EXPECT_EQ(refusal(riffWebp(canvas(9, 5, 3))), broken + "its VP8X chunk has 9 bytes, expected 10");
    EXPECT_EQ(refusal(riffWebp(canvas(10, 6, 3))), broken + "its canvas is 6 x 3, its image 5 x 3");
    EXPECT_EQ(refusal(riffWebp(canvas(10, 5, 70000))), broken + "its canvas is 5 x 70000, its image 5 x 3");
    LoadLimits limits;
    limits.imageBytes = 59;
    EXPECT_EQ(refusal(whole, limits), "a.webp: 5 x 3 pixels take 60 bytes, the limit is 59");
    limits.imageBytes = 60;
    EXPECT_EQ(refusal(whole, limits), "accepted");
}

} // namespace
} // namespace cotan
