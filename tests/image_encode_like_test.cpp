// Pictures in the format of another file.
#include "cotan/image.hpp"

#include <cstdlib>

#include <gtest/gtest.h>
#include <webp/encode.h>

#include "cotan/scene.hpp"
#include "jpeg_maker.hpp"

namespace cotan::test {
namespace {

std::vector<std::byte> webpOf(const Image& image, float quality)
{
    std::uint8_t* bytes = nullptr;
    const std::size_t size = quality > 0
        ? WebPEncodeRGBA(image.bytes8(), image.width, image.height, 4 * image.width, quality, &bytes)
        : WebPEncodeLosslessRGBA(image.bytes8(), image.width, image.height, 4 * image.width, &bytes);
    const auto* const first = reinterpret_cast<const std::byte*>(bytes);
    std::vector<std::byte> made(first, first + size);
    WebPFree(bytes);
    return made;
}

double meanDifference(const Image& a, const Image& b)
{
    double sum = 0;
    for (std::size_t i = 0; i < 4 * a.pixelCount(); ++i)
        sum += std::abs(int(a.bytes8()[i]) - int(b.bytes8()[i]));
    return sum / double(4 * a.pixelCount());
}

Image mapOf(int side) { return makeReliefMap(Relief::domes, side); }

// A picture that went through JPEG once goes through the same tables again with next to no loss.
TEST(EncodeLike, aJpegHasTheTablesTheSamplingAndTheScansOfTheOldOne)
{
    for (const int quality : {30, 75, 90, 100})
        for (const bool halved : {false, true}) {
            const auto old = jpegOf(mapOf(128), {.quality = quality, .halved = halved, .progressive = halved});
            const auto image = decodeImage(old, "old.jpg");
            const auto made = encodeLike(*image, old);
            ASSERT_TRUE(made) << made.error().message;
            EXPECT_EQ(made->format, "JPEG");
            EXPECT_EQ(made->mime, "image/jpeg");
            EXPECT_EQ(made->whyNot, "");
            EXPECT_NEAR(made->quality, quality, 1); // libjpeg rounds each step
            EXPECT_LE(made->bytes.size(), old.size() + old.size() / 50) << quality;
            const auto again = decodeImage(made->bytes, "new.jpg");
            ASSERT_TRUE(again) << again.error().message;
            EXPECT_LT(meanDifference(*image, *again), 1) << quality; // colours are rounded again
        }
}

TEST(EncodeLike, aWebpKeepsAllOrAboutTheQualityOfTheOldOne)
{
    const Image image = mapOf(128);
    const auto lossless = encodeLike(image, webpOf(image, 0));
    ASSERT_TRUE(lossless) << lossless.error().message;
    EXPECT_EQ(lossless->format, "WebP");
    EXPECT_EQ(lossless->quality, 0);
    EXPECT_EQ(decodeImage(lossless->bytes, "new.webp")->data, image.data);
    int last = 0;
    for (const int quality : {20, 50, 75, 90, 98}) {
        const auto made = encodeLike(image, webpOf(image, float(quality)));
        ASSERT_TRUE(made) << made.error().message;
        EXPECT_EQ(made->mime, "image/webp");
        EXPECT_NEAR(made->quality, quality, 10); // parts of a picture have their own
        EXPECT_GT(made->quality, last);
        last = made->quality;
        EXPECT_LT(meanDifference(*decodeImage(made->bytes, "new.webp"), image), 8) << quality;
    }
}

TEST(EncodeLike, allElseIsPngAndSaysWhy)
{
    Image image = mapOf(16);
    const auto jpeg = jpegOf(image, {.quality = 80});
    const auto formatOf = [&](std::span<const std::byte> old) {
        const auto made = encodeLike(image, old);
        return made->format + ": " + made->whyNot;
    };
    EXPECT_EQ(formatOf(*encodePng(image)), "PNG: ");
    EXPECT_EQ(formatOf({}), "PNG: ");
    image.bytes8()[3] = 254;
    EXPECT_EQ(formatOf(jpeg), "PNG: JPEG has no alpha");
    image = makeImage(16, 16, PixelType::unorm16);
    EXPECT_EQ(formatOf(jpeg), "PNG: JPEG has 8 bits, and 16 are wanted");
}

// Headers that end early say nothing of a quality; the picture is written all the same.
TEST(EncodeLike, brokenOldFilesDoNoHarm)
{
    const Image image = mapOf(16);
    for (const auto& old : {jpegOf(image, {.quality = 80, .halved = true, .progressive = true}), webpOf(image, 70)})
        for (std::size_t size = 0; size < old.size(); size += 1 + size / 40) {
            const auto made = encodeLike(image, std::span(old).first(size));
            ASSERT_TRUE(made) << size;
            ASSERT_TRUE(decodeImage(made->bytes, "new")) << size;
        }
}

} // namespace
} // namespace cotan::test
