// JPEG files with many scans, and with inks instead of colours.
#include <array>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "image_io.hpp"
#include "jpeg_maker.hpp"

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

TEST_F(ImageIo, baselineAndProgressiveJpegOfOddSizeAreRead)
{
    for (const bool progressive : {false, true}) {
        const auto image = decodeImage(bytesOf(makeJpeg(37, 21, progressive)), "a.jpg");
        ASSERT_TRUE(image) << image.error().message;
        EXPECT_EQ(image->width, 37);
        EXPECT_EQ(image->height, 21);
        // A ramp survives quality 75 within a few codes.
        EXPECT_NEAR(component(*image, 10, 15, 0), 195, 12);
        EXPECT_EQ(component(*image, 36, 20, 3), 255);
    }
}

// A file of 16 x 8 pixels whose left and right block have these components, in the order of the file.
std::string makeInkJpeg(const std::array<std::array<int, 4>, 2>& blocks, J_COLOR_SPACE stored, bool adobe,
                        int components = 4)
{
    jpeg_compress_struct jpeg{};
    jpeg_error_mgr errors{};
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_compress(&jpeg);
    unsigned char* bytes = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&jpeg, &bytes, &size);
    jpeg.image_width = 16;
    jpeg.image_height = 8;
    jpeg.input_components = components;
    jpeg.in_color_space = stored == JCS_UNKNOWN ? JCS_UNKNOWN : JCS_CMYK;
    jpeg_set_defaults(&jpeg);
    jpeg_set_colorspace(&jpeg, stored);
    jpeg.write_Adobe_marker = boolean(adobe);
    jpeg_set_quality(&jpeg, 100, TRUE);
    for (int c = 0; c < components; ++c)
        jpeg.comp_info[c].h_samp_factor = jpeg.comp_info[c].v_samp_factor = 1;
    jpeg_start_compress(&jpeg, TRUE);
    std::vector<JSAMPLE> row;
    for (int x = 0; x < 16; ++x)
        for (int c = 0; c < components; ++c)
            row.push_back(JSAMPLE(blocks[std::size_t(x / 8)][std::size_t(c)]));
    JSAMPROW rows = row.data();
    while (jpeg.next_scanline < jpeg.image_height)
        jpeg_write_scanlines(&jpeg, &rows, 1);
    jpeg_finish_compress(&jpeg);
    jpeg_destroy_compress(&jpeg);
    std::string made(reinterpret_cast<char*>(bytes), size);
    std::free(bytes);
    return made;
}

// Each ink lets its fraction of one colour pass, and black its fraction of all: 200 of 255 under a black of 128 is 100.
// Pillow 9.4, ImageMagick 6.9 and Chromium 156 read such files so, with and without Adobe's marker. Of the codes, a
// flat block at quality 100 loses at most 1, and the change to luma and chroma and back at most 2 more.
TEST_F(ImageIo, cmykAndYcckJpegBecomeTheColourThatTheInksLetPass)
{
    const std::array<std::array<int, 4>, 2> inks = {{{200, 100, 50, 128}, {10, 240, 128, 255}}};
    const int colours[2][3] = {{100, 50, 25}, {10, 240, 128}};
    for (const auto& [stored, adobe] : {std::pair(JCS_CMYK, true), {JCS_CMYK, false}, {JCS_YCCK, true}}) {
        const auto image = decodeImage(bytesOf(makeInkJpeg(inks, stored, adobe)), "a.jpg");
        ASSERT_TRUE(image) << image.error().message;
        EXPECT_EQ(image->channels, 3);
        for (const int block : {0, 1})
            for (const int y : {0, 7})
                for (const int x : {0, 7}) {
                    for (int c = 0; c < 3; ++c)
                        EXPECT_NEAR(component(*image, 8 * block + x, y, c), colours[block][c],
                                    stored == JCS_YCCK ? 3 : 1)
                            << stored << " " << adobe << " block " << block << " channel " << c;
                    EXPECT_EQ(component(*image, 8 * block + x, y, 3), 255);
                }
    }
}

TEST_F(ImageIo, aJpegOfUnknownComponentsIsRefusedByTheirNumber)
{
    const auto refused = decodeImage(bytesOf(makeInkJpeg({}, JCS_UNKNOWN, false, 2)), "a.jpg");
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().kind, ErrorKind::input);
    EXPECT_EQ(refused.error().message,
              "a.jpg: expected a grey, colour or CMYK JPEG, found 2 components of unknown meaning");
}

// The message of libjpeg is quoted inside our own sentence.
TEST_F(ImageIo, brokenJpegErrorNamesFileExpectedAndFound)
{
    const std::string file = makeJpeg(37, 21, false);
    const auto refused = decodeImage(bytesOf(file.substr(0, file.size() / 2)), "a.jpg");
    ASSERT_FALSE(refused);
    EXPECT_TRUE(
        refused.error().message.starts_with("a.jpg: broken JPEG: expected data that libjpeg can read, it found: "))
        << refused.error().message;
}

TEST_F(ImageIo, jpegScansAreCountedBeforeTheyAreDecoded)
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
    // Ten scans of 30000 x 30000 pixels exceed the limit in total. The size follows the frame marker.
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
TEST_F(ImageIo, coefficientsOfAProgressiveJpegCountAgainstTheLimit)
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

// libjpeg would continue with grey or with wrongly decoded bits, and reports the latter only in progressive files.
TEST_F(ImageIo, jpegWithTruncatedOrInvalidCodesIsRefused)
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

// 100 scans are read and 101 are refused; bytes inside other segments that look like a scan marker do not count.
TEST_F(ImageIo, jpegScansAreLimitedTo100)
{
    const std::string file = makeJpeg(40, 24, true);
    std::size_t scans = 0;
    for (std::size_t at = file.find("\xff\xda"); at != std::string::npos; at = file.find("\xff\xda", at + 1))
        ++scans;
    // The first, coarse scan may be repeated before the others; it ends where the next Huffman table begins.
    const std::size_t first = file.find("\xff\xda"), behind = file.find("\xff\xc4", first);
    ASSERT_NE(behind, std::string::npos);
    const auto with = [&](std::size_t count) {
        std::string many = file.substr(0, behind);
        for (std::size_t i = scans; i < count; ++i)
            many += file.substr(first, behind - first);
        return many + file.substr(behind);
    };
    EXPECT_EQ(messageOf(decodeImage(bytesOf(with(100)), "a.jpg")), "accepted");
    EXPECT_EQ(messageOf(decodeImage(bytesOf(with(101)), "a.jpg")),
              "a.jpg: expected at most 100 scans and 4000000000 pixels in all, found 101 scans of 40 x 24 pixels");
    std::string comment;
    for (int i = 0; i < 150; ++i)
        comment += "\xff\xda";
    const std::string noted = file.substr(0, 2) + std::string("\xff\xfe\x01\x2e", 4) + comment + file.substr(2);
    EXPECT_EQ(messageOf(decodeImage(bytesOf(noted), "a.jpg")), "accepted");
    // Coefficients: 5 x 3 blocks of 64 in each of 3 components, two bytes each.
    LoadLimits limits;
    limits.imageBytes = 2 * 3 * 15 * 64 - 1;
    EXPECT_EQ(messageOf(decodeImage(bytesOf(file), "a.jpg", limits)),
              "a.jpg: its " + std::to_string(scans) + " scans of 40 x 24 pixels take 5760 bytes, the limit is 5759");
    limits.imageBytes += 1;
    EXPECT_EQ(messageOf(decodeImage(bytesOf(file), "a.jpg", limits)), "accepted");
}

} // namespace
} // namespace cotan::test
