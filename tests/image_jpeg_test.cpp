// JPEG files of many scans.
#include <string>

#include <gtest/gtest.h>

#include "jpeg_maker.hpp"
#include "picture_file.hpp"

namespace cotan::test {
namespace {

std::string makeJpeg(int width, int height, bool progressive)
{
    Image image = makeImage(width, height, PixelType::unorm8);
    for (std::size_t y = 0; y < std::size_t(height); ++y)
        for (std::size_t i = 0; i < std::size_t(width) * 3; ++i)
            image.bytes8()[4 * (y * std::size_t(width) + i / 3) + i % 3] = std::uint8_t(i * 5 + y * 3);
    const std::vector<std::byte> file = jpegOf(image, {.progressive = progressive, .rgb = true});
    return {reinterpret_cast<const char*>(file.data()), file.size()};
}

TEST_F(PictureFile, jpegOfOddSizeIsReadWithEveryNumberOfScans)
{
    for (const bool progressive : {false, true}) {
        const auto image = decodeImage(bytesOf(makeJpeg(37, 21, progressive)), "a.jpg");
        ASSERT_TRUE(image) << image.error().message;
        EXPECT_EQ(image->width, 37);
        EXPECT_EQ(image->height, 21);
        // A ramp survives quality 75 within a few steps.
        EXPECT_NEAR(component(*image, 10, 15, 0), 195, 12);
        EXPECT_EQ(component(*image, 36, 20, 3), 255);
    }
}

// The library's words stand in a sentence of ours.
TEST_F(PictureFile, aBrokenJpegIsToldByFileExpectedAndFound)
{
    const std::string file = makeJpeg(37, 21, false);
    const auto refused = decodeImage(bytesOf(file.substr(0, file.size() / 2)), "a.jpg");
    ASSERT_FALSE(refused);
    EXPECT_TRUE(
        refused.error().message.starts_with("a.jpg: broken JPEG: expected data that libjpeg can read, it found: "))
        << refused.error().message;
}

TEST_F(PictureFile, jpegScansAreCountedBeforeTheyAreDecoded)
{
    const std::string file = makeJpeg(64, 64, true);
    const std::size_t last = file.rfind("\xff\xda");
    ASSERT_NE(last, std::string::npos);
    const std::string scan = file.substr(last, file.size() - last - 2), end = file.substr(file.size() - 2);
    std::string many = file.substr(0, file.size() - 2);
    for (int i = 0; i < 200; ++i)
        many += scan;
    const auto refused = decodeImage(bytesOf(many + end), "a.jpg");
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("expected at most 100 scans"), std::string::npos) << refused.error().message;
    // Ten scans of 30000 x 30000 pixels: over the limit in all. The size stands behind the frame's marker.
    std::string large = file;
    const std::size_t frame = large.find("\xff\xc2");
    ASSERT_NE(frame, std::string::npos);
    large.replace(frame + 5, 4, "\x75\x30\x75\x30");
    LoadLimits limits;
    limits.imageSide = 65535;
    limits.imageBytes = std::size_t(1) << 40;
    const auto slow = decodeImage(bytesOf(large), "a.jpg", limits);
    ASSERT_FALSE(slow);
    EXPECT_NE(slow.error().message.find("scans of 30000 x 30000 pixels"), std::string::npos) << slow.error().message;
}

// Three components of 64 x 64 coefficients of two bytes are 24576 bytes; the pixels take 16384.
TEST_F(PictureFile, coefficientsOfAProgressiveJpegCountAgainstTheLimit)
{
    LoadLimits limits;
    limits.imageBytes = 20000;
    const auto progressive = decodeImage(bytesOf(makeJpeg(64, 64, true)), "a.jpg", limits);
    ASSERT_FALSE(progressive);
    EXPECT_TRUE(progressive.error().memory);
    EXPECT_TRUE(decodeImage(bytesOf(makeJpeg(64, 64, false)), "a.jpg", limits));
    limits.imageBytes = 24576;
    EXPECT_TRUE(decodeImage(bytesOf(makeJpeg(64, 64, true)), "a.jpg", limits));
}

// libjpeg would go on with grey, or with what it made of the bits. Of these it says so in progressive files.
TEST_F(PictureFile, jpegWhosePixelsEndEarlyOrAreNoCodesIsRefused)
{
    const struct {
        bool progressive;
        std::string bytes;
        std::string why;
    } cases[] = {{false, std::string("\xff\xd9", 2), "premature end of data segment"},
                 {true, std::string("\xff\xd9", 2), "premature end of data segment"},
                 {true, std::string("\xff\0\xff\0\xff\0\xff\0\xff\0\xff\0", 12), "bad Huffman code"}};
    for (const auto& c : cases) {
        const std::string sound = makeJpeg(64, 64, c.progressive);
        const std::size_t scan = sound.rfind("\xff\xda"), middle = (scan + sound.size()) / 2;
        const std::string message =
            messageOf(decodeImage(bytesOf(std::string(sound).replace(middle, c.bytes.size(), c.bytes)), "a.jpg"));
        EXPECT_NE(message.find(c.why), std::string::npos) << c.progressive << message;
    }
}

} // namespace
} // namespace cotan::test
