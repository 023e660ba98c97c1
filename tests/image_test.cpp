// Image files: stored values are read back, and broken files are refused.
#include "cotan/image.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <thread>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include "expected_list.hpp"
#include "image/component_types.hpp"
#include "png_maker.hpp"

namespace cotan {
namespace {

namespace fs = std::filesystem;
using namespace std::string_literals;
using test::Bytes;
using test::makePng;
using test::Png;

using Pixel = std::array<int, 4>;

Pixel pixel(const Image& image, int x, int y)
{
    const std::size_t at = (std::size_t(y) * std::size_t(image.width) + std::size_t(x)) * 4;
    Pixel p{};
    for (std::size_t c = 0; c < 4; ++c)
        p[c] = image.type == PixelType::unorm16 ? image.words()[at + c] : image.bytes8()[at + c];
    return p;
}

// Provides an own folder for each test, which is removed afterwards.
class ImageFile : public testing::Test {
protected:
    fs::path folder = fs::temp_directory_path()
        / ("cotan_image_test_" + std::to_string(::getpid()) + "_"
           + testing::UnitTest::GetInstance()->current_test_info()->name());
    void SetUp() override { fs::create_directories(folder); }
    void TearDown() override { fs::remove_all(folder); }

    std::size_t fileCount() const { return std::size_t(std::distance(fs::directory_iterator(folder), {})); }
};

std::string readAll(const fs::path& file)
{
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

Image pattern(PixelType type, int width, int height)
{
    Image image = makeImage(width, height, type, "pattern");
    for (std::size_t i = 0; i < image.pixelCount() * 4; ++i) {
        if (type == PixelType::unorm8)
            image.bytes8()[i] = std::uint8_t(i * 37 % 256);
        else if (type == PixelType::unorm16)
            image.words()[i] = std::uint16_t(i * 1237 % 65536);
        else
            image.floats()[i] = float(i) * 0.37f - 3.0f;
    }
    return image;
}

TEST(Png, greyOfFewBitsIsScaledToTheFullRange)
{
    const struct {
        int bits;
        std::string row;
        std::array<int, 4> grey;
    } cases[] = {
        {1, "\0\x50"s, {0, 255, 0, 255}}, {2, "\0\x1b"s, {0, 85, 170, 255}}, {4, "\0\x05\xaf"s, {0, 85, 170, 255}}};
    for (const auto& c : cases) {
        const auto image = decodeImage(makePng({.width = 4, .bits = c.bits, .colour = 0, .rows = c.row}), "grey");
        ASSERT_TRUE(image) << image.error().message;
        for (int x = 0; x < 4; ++x) {
            const int g = c.grey[std::size_t(x)];
            EXPECT_EQ(pixel(*image, x, 0), (Pixel{g, g, g, 255})) << c.bits << " bits";
        }
    }
}

TEST(Png, paletteBecomesColoursWithAlpha)
{
    const auto image = decodeImage(
        makePng({.width = 2,
                 .colour = 3,
                 .rows = "\0\1\0"s,
                 .before = test::chunk("PLTE", "\x0a\x14\x1e\x28\x32\x3c"s) + test::chunk("tRNS", "\x80"s)}),
        "palette");
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(pixel(*image, 0, 0), (Pixel{40, 50, 60, 255}));
    EXPECT_EQ(pixel(*image, 1, 0), (Pixel{10, 20, 30, 128}));
}

TEST(Png, sixteenBitsAreKept)
{
    const auto image = decodeImage(makePng({.bits = 16, .colour = 2, .rows = "\0\x12\x34\xab\xcd\0\1"s}), "wide");
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(image->type, PixelType::unorm16);
    EXPECT_EQ(pixel(*image, 0, 0), (Pixel{0x1234, 0xabcd, 1, 65535}));
}

TEST(Png, valuesAreNeitherPremultipliedNorGammaConverted)
{
    const auto image = decodeImage(
        makePng({.colour = 6, .rows = "\0\xc8\x64\x32\x0a"s, .before = test::chunk("gAMA", test::big32(100000))}),
        "alpha");
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(pixel(*image, 0, 0), (Pixel{200, 100, 50, 10}));
}

TEST(Png, interlacedPixelsAreReordered)
{
    // 3 x 3 in Adam7: pass 1 has (0,0), pass 4 (2,0), pass 5 row 2: (0,2) (2,2), pass 6 column 1 of rows 0 and 2, pass
    // 7 row 1. Every pixel holds 10 * x + y.
    const auto image = decodeImage(makePng({.width = 3,
                                            .height = 3,
                                            .colour = 0,
                                            .interlaced = true,
                                            .rows = "\0\x00\0\x14\0\x02\x16\0\x0a\0\x0c\0\x01\x0b\x15"s}),
                                   "adam7");
    ASSERT_TRUE(image) << image.error().message;
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 3; ++x)
            EXPECT_EQ(pixel(*image, x, y)[0], 10 * x + y) << x << ' ' << y;
}

TEST(Png, brokenFilesAreRefusedSilentlyWithOneLine)
{
    const Bytes good = makePng({.width = 2, .height = 2, .colour = 0, .rows = "\0\1\2\0\3\4"s});
    ASSERT_TRUE(decodeImage(good, "good"));
    std::vector<std::pair<std::string, Bytes>> broken;
    for (std::size_t length = 0; length < good.size(); ++length)
        broken.emplace_back("cut to " + std::to_string(length),
                            Bytes(good.begin(), good.begin() + std::ptrdiff_t(length)));
    for (const std::size_t at : {17u, 29u, 45u, 55u}) { // header, its checksum, pixels, their checksum
        broken.emplace_back("flipped bit at " + std::to_string(at), good);
        broken.back().second[at] ^= std::byte{4};
    }
    broken.emplace_back("filter 9", makePng({.width = 2, .height = 2, .colour = 0, .rows = "\0\1\2\x09\3\4"s}));
    broken.emplace_back("one row short", makePng({.width = 2, .height = 2, .colour = 0, .rows = "\0\1\2"s}));
    broken.emplace_back("width 0", makePng({.width = 0, .rows = "\0"s}));

    testing::internal::CaptureStderr();
    for (const auto& [what, bytes] : broken) {
        const auto image = decodeImage(bytes, "some.png");
        ASSERT_FALSE(image) << what;
        EXPECT_EQ(image.error().kind, ErrorKind::input) << what;
        EXPECT_TRUE(image.error().message.starts_with("some.png: ")) << image.error().message;
        EXPECT_EQ(image.error().message.find('\n'), std::string::npos) << image.error().message;
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(Png, claimedSizeOverALimitIsRefusedBeforeAllocation)
{
    // 16000 x 16000 RGBA would be 1 GB; the peak memory of this process must not rise by a tenth of it.
    const Bytes claim = makePng({.width = 16000, .height = 16000, .colour = 6, .rows = "\0"s});
    rusage before{}, after{};
    getrusage(RUSAGE_SELF, &before);
    const auto image = decodeImage(claim, "claim");
    getrusage(RUSAGE_SELF, &after);
    ASSERT_FALSE(image);
    EXPECT_NE(image.error().message.find("16000 x 16000"), std::string::npos);
    EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 100'000) << "KB";

    LoadLimits small;
    small.imageSide = 3;
    EXPECT_FALSE(decodeImage(makePng({.width = 4, .colour = 0, .rows = "\0abcd"s}), "wide", small));
    EXPECT_TRUE(decodeImage(makePng({.width = 3, .colour = 0, .rows = "\0abc"s}), "wide", small));
}

TEST(Decode, otherDataIsRefused)
{
    Bytes text;
    test::put(text, "this is text, not an image");
    for (const char* name : {"a.png", "b.jpg", "c.tga", "d"})
        EXPECT_FALSE(decodeImage(text, name)) << name;
    EXPECT_FALSE(decodeImage({}, "nothing.png"));
}

// Format signatures are compared only within the bytes that the file has.
TEST(Decode, filesOfAFewBytesAreRefused)
{
    for (const std::string& head :
         {"\0\0\0\x1c"
          "ftypavif"s,
          "RIFF\0\0\0\0WEBP"s, "\xabKTX 20\xbb\r\n\x1a\n"s, "\x89PNG\r\n\x1a\n\0\0\0\0"s, "DDS \0\0\0\0\0\0\0\0"s})
        for (std::size_t length = 0; length <= head.size(); ++length) {
            Bytes bytes;
            test::put(bytes, head.substr(0, length));
            EXPECT_FALSE(decodeImage(bytes, "x")) << head << " cut to " << length;
        }
}

TEST(Decode, bottomUpTgaIsFlipped)
{
    Bytes tga;
    test::put(tga, "\0\0\2\0\0\0\0\0\0\0\0\0\1\0\2\0\x18\0"s); // 1 x 2, 24 bits, bottom row first
    test::put(tga, "\x03\x02\x01\x06\x05\x04"s);               // blue green red
    const auto image = decodeImage(tga, "x.TGA");
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(pixel(*image, 0, 0), (Pixel{4, 5, 6, 255}));
    EXPECT_EQ(pixel(*image, 0, 1), (Pixel{1, 2, 3, 255}));
}

TEST(ReadImage, missingFileFolderAndEmptyFileAreRefused)
{
    EXPECT_FALSE(readImage("/nowhere/at/all.png"));
    EXPECT_FALSE(readImage(fs::temp_directory_path()));
    EXPECT_FALSE(readImage("/dev/zero"));
    EXPECT_FALSE(readImage("/dev/null"));
}

TEST_F(ImageFile, pngKeepsEightAndSixteenBits)
{
    for (const PixelType type : {PixelType::unorm8, PixelType::unorm16}) {
        const Image image = pattern(type, 33, 17);
        const auto status = writeImage(folder / "a.png", image);
        ASSERT_TRUE(status) << status.error().message;
        const auto back = readImage(folder / "a.png");
        ASSERT_TRUE(back) << back.error().message;
        EXPECT_EQ(back->type, type);
        EXPECT_EQ(back->data, image.data);
    }
    EXPECT_EQ(fileCount(), 1u);
}

TEST_F(ImageFile, opaquePngReadsBackWithAlphaOne)
{
    for (const PixelType type : {PixelType::unorm8, PixelType::unorm16}) {
        Image image = pattern(type, 9, 5);
        for (std::size_t i = 0; i < image.pixelCount(); ++i) {
            if (type == PixelType::unorm8)
                image.bytes8()[4 * i + 3] = 255;
            else
                image.words()[4 * i + 3] = 65535;
        }
        ASSERT_TRUE(writeImage(folder / "a.png", image));
        const auto back = readImage(folder / "a.png");
        ASSERT_TRUE(back);
        EXPECT_EQ(back->data, image.data);
    }
}

TEST_F(ImageFile, floatsAreClampedToEightBitsInPng)
{
    Image image = makeImage(2, 1, PixelType::float32);
    const float values[8] = {-1, 0.5f, 2, 1, std::numeric_limits<float>::quiet_NaN(), 0, 1, 1};
    std::copy(values, values + 8, image.floats());
    ASSERT_TRUE(writeImage(folder / "a.PNG", image));
    const auto back = readImage(folder / "a.PNG");
    ASSERT_TRUE(back);
    EXPECT_EQ(pixel(*back, 0, 0), (Pixel{0, 128, 255, 255}));
    EXPECT_EQ(pixel(*back, 1, 0), (Pixel{0, 0, 255, 255}));
}

TEST_F(ImageFile, imageWithWrongByteCountIsNotWritten)
{
    Image image = pattern(PixelType::unorm8, 7, 5);
    image.data.pop_back();
    const auto status = writeImage(folder / "a.png", image);
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().kind, ErrorKind::usage);
    EXPECT_NE(status.error().message.find("a.png: there is no image to write (7 x 5, 139 bytes)"), std::string::npos)
        << status.error().message;
    EXPECT_EQ(fileCount(), 0u);
}

TEST_F(ImageFile, exrKeepsFloatsExactly)
{
    Image image = pattern(PixelType::float32, 40, 30);
    image.floats()[3] = 0.0f; // colour under alpha 0 is kept
    const auto status = writeImage(folder / "a.exr", image);
    ASSERT_TRUE(status) << status.error().message;
    const auto back = readImage(folder / "a.exr");
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(back->type, PixelType::float32);
    EXPECT_EQ(back->data, image.data);
}

TEST_F(ImageFile, tiffAndTgaKeepColourUnderAlpha)
{
    for (const char* name : {"a.tif", "a.tga"}) {
        const Image image = pattern(PixelType::unorm8, 12, 7);
        const auto status = writeImage(folder / name, image);
        ASSERT_TRUE(status) << status.error().message;
        const auto back = readImage(folder / name);
        ASSERT_TRUE(back) << back.error().message;
        EXPECT_EQ(back->data, image.data) << name;
    }
    const Image wide = pattern(PixelType::unorm16, 12, 7);
    ASSERT_TRUE(writeImage(folder / "b.tif", wide));
    const auto back = readImage(folder / "b.tif");
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(back->data, wide.data);
}

TEST_F(ImageFile, jpegAndHdrRoundTripApproximatelyAndOpaque)
{
    Image image = makeImage(16, 16, PixelType::float32);
    for (std::size_t i = 0; i < image.pixelCount(); ++i) {
        image.floats()[4 * i] = image.floats()[4 * i + 1] = image.floats()[4 * i + 2] = 0.5f;
        image.floats()[4 * i + 3] = 0.25f;
    }
    ASSERT_TRUE(writeImage(folder / "a.jpg", image));
    ASSERT_TRUE(writeImage(folder / "a.hdr", image));
    const auto jpeg = readImage(folder / "a.jpg");
    const auto hdr = readImage(folder / "a.hdr");
    ASSERT_TRUE(jpeg) << jpeg.error().message;
    ASSERT_TRUE(hdr) << hdr.error().message;
    // A constant grey survives the transform up to its rounding; 0.5 is a power of two, exact in RGBE.
    EXPECT_NEAR(pixel(*jpeg, 5, 5)[0], 128, 1);
    EXPECT_EQ(pixel(*jpeg, 5, 5)[3], 255);
    EXPECT_EQ(hdr->floats()[0], 0.5f);
    EXPECT_EQ(hdr->floats()[3], 1.0f);
}

TEST_F(ImageFile, brokenJpegIsRefusedSilentlyWithOneLine)
{
    ASSERT_TRUE(writeImage(folder / "a.jpg", pattern(PixelType::unorm8, 64, 64)));
    Bytes good;
    test::put(good, readAll(folder / "a.jpg"));
    ASSERT_TRUE(decodeImage(good, "a.jpg"));
    testing::internal::CaptureStderr();
    for (const std::size_t length : {std::size_t(3), std::size_t(20), good.size() / 2, good.size() - 40}) {
        const auto image = decodeImage(std::span(good).first(length), "a.jpg");
        ASSERT_FALSE(image) << length;
        EXPECT_EQ(image.error().message.find('\n'), std::string::npos) << image.error().message;
    }
    LoadLimits small;
    small.imageSide = 63;
    EXPECT_FALSE(decodeImage(good, "a.jpg", small));
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_F(ImageFile, filesContainNoTimestamp)
{
    const Image bytes = pattern(PixelType::unorm8, 20, 20);
    const Image floats = pattern(PixelType::float32, 20, 20);
    const auto write = [&](const std::string& stem) {
        for (const char* extension : {".png", ".tif", ".tga", ".jpg"})
            EXPECT_TRUE(writeImage(folder / (stem + extension), bytes)) << extension;
        for (const char* extension : {".exr", ".hdr"})
            EXPECT_TRUE(writeImage(folder / (stem + extension), floats)) << extension;
    };
    write("a");
    std::this_thread::sleep_for(std::chrono::milliseconds(1100)); // time stamps count seconds
    write("b");
    for (const char* extension : {".png", ".tif", ".tga", ".jpg", ".exr", ".hdr"})
        EXPECT_EQ(readAll(folder / ("a"s + extension)), readAll(folder / ("b"s + extension))) << extension;
}

TEST_F(ImageFile, failedWriteLeavesNoFileAndKeepsTheOldOne)
{
    const Image image = pattern(PixelType::unorm8, 4, 4);
    const auto noFolder = writeImage(folder / "missing" / "a.png", image);
    ASSERT_FALSE(noFolder);
    EXPECT_EQ(noFolder.error().kind, ErrorKind::output);

    const auto noFormat = writeImage(folder / "a.xyz", image);
    ASSERT_FALSE(noFormat);
    EXPECT_EQ(noFormat.error().kind, ErrorKind::usage);

    fs::create_directory(folder / "taken.png");
    const auto taken = writeImage(folder / "taken.png", image);
    ASSERT_FALSE(taken);
    EXPECT_EQ(taken.error().kind, ErrorKind::output);

    std::ofstream(folder / "old.png") << "old";
    EXPECT_FALSE(writeImage(folder / "old.png", Image{}));
    EXPECT_EQ(readAll(folder / "old.png"), "old");
    EXPECT_EQ(fileCount(), 2u);
}

TEST(ConvertImage, sixteenBitsRoundToTheNearestOf8)
{
    Image words = makeImage(2, 1, PixelType::unorm16);
    const std::array<std::uint16_t, 8> values = {0, 128, 129, 385, 386, 65406, 65407, 65535}; // steps of 257
    std::ranges::copy(values, words.words());
    const Image bytes = toUnorm8(words);
    for (std::size_t i = 0; i < values.size(); ++i)
        EXPECT_EQ(bytes.bytes8()[i], std::lround(values[i] / 257.0)) << values[i];
}

// x = 100 / 127, y = 40 / 127 and z = 67.15 / 127 have length 1.
TEST(ConvertImage, missingBlueIsReconstructedInOpaqueImages)
{
    Image image = makeImage(2, 1, PixelType::unorm8);
    const std::array<std::uint8_t, 8> stored = {228, 88, 128, 255, 128, 128, 128, 255};
    std::ranges::copy(stored, image.bytes8());
    completeNormals(image);
    EXPECT_EQ(image.bytes8()[2], 128 + 67);
    EXPECT_EQ(image.bytes8()[6], 255);
    for (const std::size_t other : {2u, 3u}) { // another blue or another alpha in one texel
        Image kept = makeImage(2, 1, PixelType::unorm8);
        std::ranges::copy(stored, kept.bytes8());
        kept.bytes8()[4 + other] = 200;
        completeNormals(kept);
        EXPECT_EQ(kept.bytes8()[2], 128) << other;
    }
}

TEST(BadData, everyPngIsJudgedWithinTimeAndMemory)
{
    COTAN_NEEDS_DATA("bad/EXPECTED.tsv");
    const auto rows = test::expectedFor(".png");
    ASSERT_FALSE(rows.empty());
    for (const auto& row : rows) {
        testing::internal::CaptureStderr();
        const auto start = std::chrono::steady_clock::now();
        const auto image = readImage(row.file);
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
        EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << row.file;
        EXPECT_LT(took.count(), 5.0) << row.file;
        if (row.verdict == "reject") {
            EXPECT_FALSE(image) << row.file;
        }
        if (row.verdict == "accept") {
            EXPECT_TRUE(image) << row.file;
        }
        if (!image) {
            EXPECT_EQ(image.error().message.find('\n'), std::string::npos) << image.error().message;
        }
    }
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    EXPECT_LT(usage.ru_maxrss, 1 << 20) << "KB";
}

} // namespace
} // namespace cotan
