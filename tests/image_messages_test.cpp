// Messages of image readers and writers, with their numbers, on both sides of each limit.
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "cotan/image.hpp"
#include "image/component_types.hpp"
#include "image_io.hpp"
#include "ktx2_maker.hpp"
#include "png_maker.hpp"
#include "webp_maker.hpp"

namespace cotan::test {
namespace {

using namespace std::string_literals;

std::string textOf(const Bytes& bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

std::string textOf(Status status) { return status ? "done" : status.error().message; }

// 8-bit grey pixels, all 0.
std::string greyPng(std::uint32_t width, std::uint32_t height)
{
    return textOf(
        makePng({.width = width, .height = height, .colour = 0, .rows = std::string((width + 1) * height, '\0')}));
}

std::string pngMessage(const std::string& file, const LoadLimits& limits)
{
    return messageOf(decodeImage(bytesOf(file), "a.png", limits));
}

// PNG colour types and the transparent colour: channels and alpha as stored, read whole and by rows.
TEST_F(ImageIo, pngReportsChannelsAndAlphaWholeAndByRows)
{
    const std::string colours = chunk("PLTE", "\x0a\x14\x1e\x28\x32\x3c"s);
    const struct {
        int colour;
        std::string row, before;
        int channels;
        std::array<int, 4> texel;
    } cases[] = {{0, "\0\7"s, "", 1, {7, 7, 7, 255}},
                 {0, "\0\7"s, chunk("tRNS", "\0\7"s), 2, {7, 7, 7, 0}},
                 {0, "\0\7"s, chunk("tRNS", "\0\6"s), 2, {7, 7, 7, 255}},
                 {2, "\0\1\2\3"s, "", 3, {1, 2, 3, 255}},
                 {2, "\0\1\2\3"s, chunk("tRNS", "\0\1\0\2\0\3"s), 4, {1, 2, 3, 0}},
                 {3, "\0\1"s, colours, 3, {40, 50, 60, 255}},
                 {3, "\0\1"s, colours + chunk("tRNS", "\x09\x08"s), 4, {40, 50, 60, 8}},
                 {4, "\0\7\5"s, "", 2, {7, 7, 7, 5}},
                 {6, "\0\1\2\3\4"s, "", 4, {1, 2, 3, 4}}};
    for (const auto& c : cases) {
        SCOPED_TRACE(c.colour);
        const std::string file = textOf(makePng({.colour = c.colour, .rows = c.row, .before = c.before}));
        const auto image = decodeImage(bytesOf(file), "a.png");
        ASSERT_TRUE(image) << image.error().message;
        const auto path = write("a.png", file);
        const auto rows = openRows(path);
        ASSERT_TRUE(rows) << rows.error().message;
        EXPECT_EQ(image->channels, c.channels);
        EXPECT_EQ((*rows)->channels, c.channels);
        EXPECT_EQ((*rows)->alpha, c.channels == 2 || c.channels == 4);
        EXPECT_FALSE((*rows)->whole);
        EXPECT_EQ((*rows)->name, path.string());
        EXPECT_EQ(byRows(path, 1)->data, image->data);
        for (int i = 0; i < 4; ++i)
            EXPECT_EQ(component(*image, 0, 0, i), c.texel[std::size_t(i)]) << i;
    }
    const auto interlaced =
        openRows(write("b.png", textOf(makePng({.colour = 4, .interlaced = true, .rows = "\0\7\5"s}))));
    ASSERT_TRUE(interlaced);
    EXPECT_TRUE((*interlaced)->whole);
    EXPECT_TRUE((*interlaced)->alpha);
    EXPECT_EQ((*interlaced)->channels, 2);
}

TEST_F(ImageIo, errorsForSizesOverALimitStateBoth)
{
    LoadLimits limits;
    limits.imageSide = 4;
    EXPECT_EQ(pngMessage(greyPng(5, 3), limits), "a.png: the image size is 5 x 3, the limit is 4 per side");
    EXPECT_EQ(pngMessage(greyPng(3, 5), limits), "a.png: the image size is 3 x 5, the limit is 4 per side");
    EXPECT_EQ(pngMessage(greyPng(4, 4), limits), "accepted");
    const std::string name = (folder / "a.png").string();
    EXPECT_EQ(messageOf(openRows(write("a.png", greyPng(5, 3)), limits)),
              name + ": the image size is 5 x 3, the limit is 4 per side");
    EXPECT_EQ(messageOf(openRows(write("a.png", greyPng(3, 5)), limits)),
              name + ": the image size is 3 x 5, the limit is 4 per side");
    EXPECT_EQ(messageOf(openRows(write("a.png", greyPng(4, 4)), limits)), "accepted");

    limits = {};
    limits.imageBytes = 59;
    std::size_t expected = 0;
    limits.expect = [&](std::size_t bytes) { expected = bytes; };
    const auto refused = decodeImage(bytesOf(greyPng(5, 3)), "a.png", limits);
    ASSERT_FALSE(refused);
    EXPECT_TRUE(refused.error().memory);
    EXPECT_EQ(refused.error().message, "a.png: 5 x 3 pixels take 60 bytes, the limit is 59");
    EXPECT_EQ(expected, 0u);
    limits.imageBytes = 60;
    EXPECT_EQ(pngMessage(greyPng(5, 3), limits), "accepted");
    EXPECT_EQ(expected, 60u);
    const std::string wide = textOf(makePng({.width = 2, .bits = 16, .colour = 0, .rows = "\0\1\2\3\4"s}));
    limits.imageBytes = 15;
    EXPECT_EQ(pngMessage(wide, limits), "a.png: 2 x 1 pixels take 16 bytes, the limit is 15");
    limits.imageBytes = 16;
    EXPECT_EQ(pngMessage(wide, limits), "accepted");

    // The limit grows with the file: 128 bytes for each of its bytes, plus a constant.
    limits = {};
    const std::string file = greyPng(300, 200);
    limits.imageBytesBeyond = 240'000 - 128 * file.size() - 1;
    EXPECT_EQ(pngMessage(file, limits), "a.png: 300 x 200 pixels take 240000 bytes, the limit is 239999");
    limits.imageBytesBeyond += 1;
    EXPECT_EQ(pngMessage(file, limits), "accepted");
    // The same limit applies to a single image that is read by rows.
    const auto path = write("a.png", file);
    limits = {};
    limits.imageBytes = 240'000 - 128 * file.size() - 1;
    EXPECT_EQ(messageOf(openRows(path, limits)),
              name + ": 300 x 200 pixels take 240000 bytes, the limit is 239999 for a file of "
                  + std::to_string(file.size()) + " bytes");
    limits.imageBytes += 1;
    EXPECT_EQ(messageOf(openRows(path, limits)), "accepted");
    limits = {};
    limits.fileBytes = file.size() - 1;
    EXPECT_EQ(messageOf(readImage(path, limits)),
              name + ": the file has " + std::to_string(file.size()) + " bytes, the limit is "
                  + std::to_string(file.size() - 1));
    limits.fileBytes += 1;
    EXPECT_EQ(messageOf(readImage(path, limits)), "accepted");
}

TEST_F(ImageIo, errorsForUnknownFormatsListTheKnownOnes)
{
    const std::string name = (folder / "a").string();
    EXPECT_EQ(messageOf(decodeImage(bytesOf("this is text, not an image"), "a.png")),
              "a.png: expected an image (PNG, EXR, TIFF, TGA, JPEG, HDR, DDS, KTX2, WebP, BMP), found other data");
    EXPECT_EQ(messageOf(decodeImage(bytesOf("\0\0\0\x1c"
                                            "ftypavif"s),
                                    "a.png")),
              "a.png: AVIF images are not supported");
    EXPECT_EQ(messageOf(readImage(folder)), folder.string() + ": expected a file, found a folder");
    EXPECT_EQ(messageOf(openRows(name)), name + ": no such file");
    EXPECT_EQ(messageOf(readImage(name)), name + ": no such file");
    EXPECT_EQ(messageOf(openRows(write("a", ""))), name + ": the file is empty");
    EXPECT_EQ(messageOf(openRows("/dev/null")), "/dev/null: expected a regular file");
    const Image image = makeImage(3, 2, PixelType::unorm8);
    const std::string endings = ": expected the extension .png .exr .tif .tga .jpg or .hdr, found \".xyz\"";
    EXPECT_EQ(textOf(writeImage(folder / "a.xyz", image)), name + ".xyz" + endings);
    EXPECT_EQ(messageOf(createRows(folder / "a.xyz", {3, 2})), name + ".xyz" + endings);
    EXPECT_EQ(messageOf(createRows(folder / "a.png", {3, 2, PixelType::float32})),
              name + ".png: PNG files cannot hold floats");
    for (const auto& [width, height] : {std::pair(0, 7), {7, 0}, {-1, 7}}) {
        Image none;
        none.width = width, none.height = height;
        EXPECT_EQ(textOf(writeImage(folder / "a.png", none)),
                  name + ".png: there is no image to write (" + std::to_string(width) + " x " + std::to_string(height)
                      + ", 0 bytes)");
    }
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1); // the empty file
}

TEST(ImageFormat, isDetectedBySignatureAndUnsupportedFormatsAreNamed)
{
    const struct {
        std::string head;
        const char* format;
        const char* foreign;
    } cases[] = {{"\x89PNG\r\n\x1a\n"s, "PNG", ""},
                 {"\xff\xd8\xff"s, "JPEG", ""},
                 {"RIFF1234WEBP", "WebP", ""},
                 {"\xabKTX 20\xbb"s, "KTX2", ""},
                 {"DDS 1234", "DDS", ""},
                 {"\0\0\0\x1c"
                  "ftypavif"s,
                  "AVIF", "AVIF"},
                 {"\0\0\1\0ftypavis"s, "AVIF", "AVIF"},
                 {"\0\1\0\0ftypavif"s, "", ""},
                 {"\0\0\0\x1c"
                  "ftypheic"s,
                  "", ""},
                 {"BM1234", "", ""},
                 {"II*\0"s, "", ""},
                 {"GIF89a", "", ""},
                 {"\x89PNG\r\n\x1a"s, "", ""},
                 {"", "", ""}};
    for (const auto& c : cases) {
        EXPECT_EQ(imageFormatName(bytesOf(c.head)), c.format) << c.head;
        EXPECT_EQ(unreadableFormat(bytesOf(c.head)), c.foreign) << c.head;
        EXPECT_EQ(isPng(bytesOf(c.head)), c.format == "PNG"s);
    }
}

// Sizes and rates that WebP and GIF can hold, on both sides of each limit.
TEST_F(ImageIo, animationSizesAndRatesAreCheckedAgainstTheFormat)
{
    const auto messageFor = [&](const char* file, int width, int height, double rate) {
        return messageOf(createAnimation(folder / file, {width, height, 1, rate}));
    };
    for (const auto& [file, most, fastest] : {std::tuple("a.webp", 16383, 1000.0), {"a.gif", 65535, 50.0}}) {
        const std::string sides = (folder / file).string() + ": expected an image of 1 to " + std::to_string(most)
            + " pixels per side; found ",
                          one = std::to_string(most + 1);
        EXPECT_EQ(messageFor(file, most, 1, fastest), "accepted");
        EXPECT_EQ(messageFor(file, 1, most, 0.5), "accepted");
        EXPECT_EQ(messageFor(file, most + 1, 1, 24), sides + one + " x 1");
        EXPECT_EQ(messageFor(file, 1, most + 1, 24), sides + "1 x " + one);
        EXPECT_EQ(messageFor(file, 0, 8, 24), sides + "0 x 8");
        EXPECT_EQ(messageFor(file, 8, 0, 24), sides + "8 x 0");
        const std::string rates = (folder / file).string() + ": expected at most " + std::to_string(int(fastest))
            + " images per second in such a file; found ";
        EXPECT_EQ(messageFor(file, 8, 9, fastest + 0.5), rates + std::to_string(int(fastest)) + ".5");
        EXPECT_EQ(messageFor(file, 8, 9, 0), rates + "0");
        EXPECT_EQ(messageFor(file, 8, 9, -24), rates + "-24");
        EXPECT_NE(messageFor(file, 8, 9, std::numeric_limits<double>::quiet_NaN()), "accepted");
    }
    for (const auto& [rate, stored] : {std::pair(24.0, 4), {30.0, 3}, {50.0, 2}, {1000.0, 1}, {0.5, 200}, {40.0, 3}})
        EXPECT_DOUBLE_EQ(animationRate("a.gif", rate), 100.0 / stored) << rate; // whole hundredths of a second
    auto writer = createAnimation(folder / "a.gif", {8, 9, 1, 24});
    ASSERT_TRUE(writer) << writer.error().message;
    const std::string name = (folder / "a.gif").string();
    EXPECT_EQ(textOf((*writer)->add(makeImage(9, 9, PixelType::unorm8))),
              name + ": expected images of 8 x 9; found 9 x 9");
    EXPECT_EQ(textOf((*writer)->add(makeImage(8, 8, PixelType::unorm8))),
              name + ": expected images of 8 x 9; found 8 x 8");
    EXPECT_EQ(textOf((*writer)->add(makeImage(8, 9, PixelType::float32))), "done");
    EXPECT_EQ(textOf((*writer)->add(makeImage(8, 9, PixelType::unorm8))),
              name + ": expected no more images than announced");
}

// A full device: the message is the writer's, and no file remains. Small files fail when the buffer is flushed at the
// end, larger ones while they are written.
TEST_F(ImageIo, everyWriterReportsAFullDevice)
{
    for (const char* const ending : {".png", ".exr", ".tif", ".tga", ".jpg", ".hdr"}) {
        const auto file = folder / ("a"s + ending);
        std::filesystem::create_symlink("/dev/full", file);
        const bool png = ending == ".png"s;
        const std::string full = file.string()
            + (png ? ": writing failed" : ": expected to write the image, OpenImageIO found: No space left on device");
        for (const int side : {2, 300}) {
            Image image = makeImage(side, side, png ? PixelType::unorm8 : PixelType::float32);
            std::uint32_t state = 7;
            for (std::size_t i = 0; i < 4 * image.pixelCount(); ++i) { // noise, which does not compress
                state = state * 1664525u + 1013904223u;
                if (png)
                    image.bytes8()[i] = std::uint8_t(state >> 24);
                else
                    image.floats()[i] = float(state >> 8) / 16777216.0f;
            }
            const Status whole = writeImage(file, image);
            EXPECT_EQ(textOf(whole), full) << side;
            EXPECT_TRUE(!whole && whole.error().kind == ErrorKind::output);
            auto rows = createRows(file, {side, side, image.type});
            ASSERT_TRUE(rows) << rows.error().message;
            Status written = (*rows)->write(image);
            if (written)
                written = (*rows)->finish();
            EXPECT_FALSE(written) << side;
            EXPECT_TRUE(textOf(written).starts_with(file.string() + ": ")) << textOf(written);
            EXPECT_TRUE(!written && written.error().kind == ErrorKind::output);
        }
        EXPECT_TRUE(std::filesystem::is_symlink(file));
    }
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 6);
}

// The end chunk of a PNG is written last; if only its bytes do not fit, finishing the file reports that.
TEST_F(ImageIo, fullDeviceAtTheEndOfAPngIsReported)
{
    const auto full = folder / "full.png", whole = folder / "whole.png";
    std::filesystem::create_symlink("/dev/full", full);
    int tried = 0;
    for (int width = 1320; width < 1366; ++width) {
        Image image = makeImage(width, 1, PixelType::unorm8);
        std::uint32_t state = 7;
        for (std::size_t i = 0; i < 4 * image.pixelCount(); ++i) // noise, which does not compress
            image.bytes8()[i] = std::uint8_t((state = state * 1664525u + 1013904223u) >> 24);
        const auto writeTo = [&](const std::filesystem::path& file) {
            auto rows = createRows(file, {width, 1});
            if (!rows)
                return Status(rows.error());
            const Status written = (*rows)->write(image);
            return written ? (*rows)->finish() : written;
        };
        ASSERT_TRUE(writeTo(whole));
        const auto size = std::filesystem::file_size(whole);
        if (size <= 4096 || size > 4096 + 12) // the size of the buffer, and of the final chunk
            continue;
        ++tried;
        const Status ended = writeTo(full);
        EXPECT_EQ(textOf(ended), full.string() + ": writing failed");
        EXPECT_TRUE(!ended && ended.error().kind == ErrorKind::output);
    }
    EXPECT_GT(tried, 0);
}

// 8-bit formats round as toUnorm8 does; NaN becomes 0.
TEST_F(ImageIo, eightBitFormatsRoundToNearest)
{
    Image floats = makeImage(64, 9, PixelType::float32), wide = makeImage(64, 9, PixelType::unorm16);
    for (std::size_t i = 0; i < 4 * floats.pixelCount(); ++i) {
        floats.floats()[i] = (float(i % 1021) - 200) / 600;
        wide.words()[i] = std::uint16_t(i * 28); // up to 64484
    }
    floats.floats()[5] = std::numeric_limits<float>::quiet_NaN();
    floats.floats()[9] = std::numeric_limits<float>::infinity();
    for (const Image& image : {floats, wide}) {
        ASSERT_TRUE(writeImage(folder / "a.tga", image));
        const auto found = readImage(folder / "a.tga");
        ASSERT_TRUE(found);
        EXPECT_EQ(found->type, PixelType::unorm8);
        EXPECT_EQ(found->data, toUnorm8(image).data);
    }
}

// In images that are read whole, every texel counts for alpha: 8 bits and floats, the first and the last.
TEST_F(ImageIo, rowsOfAWholeImageHaveAlphaIfAnyTexelHas)
{
    const auto alphaOf = [&](std::uint32_t format, const std::string& texels) {
        const std::string file = makeKtx2({.format = format, .width = 3, .height = 1, .levels = {{texels}}});
        const auto rows = openRows(write("a.ktx2", file));
        EXPECT_TRUE(rows && (*rows)->whole && (*rows)->width == 3 && (*rows)->height == 1);
        return rows && (*rows)->alpha;
    };
    for (int changed = -1; changed < 12; ++changed) {
        std::string bytes(12, '\xff');
        std::vector<std::uint32_t> floats(12, 0x3f800000);
        if (changed >= 0)
            bytes[std::size_t(changed)] = '\xfe', floats[std::size_t(changed)] = 0x3f000000;
        EXPECT_EQ(alphaOf(37, bytes), changed % 4 == 3) << changed;
        EXPECT_EQ(alphaOf(109, words(floats)), changed % 4 == 3) << changed;
    }
}

// 65535 is 255 times 257; halves are rounded up.
TEST(EightBits, areRoundedFrom16BitsAndFloats)
{
    Image wide = makeImage(16384, 1, PixelType::unorm16, "w");
    for (int i = 0; i < 65536; ++i)
        wide.words()[i] = std::uint16_t(i);
    wide.frame = "smooth", wide.channels = 2;
    const Image narrow = toUnorm8(wide);
    EXPECT_EQ(narrow.name, "w");
    EXPECT_EQ(narrow.frame, "smooth");
    EXPECT_EQ(narrow.channels, 2);
    int wrongCodes = 0;
    for (int i = 0; i < 65536; ++i)
        wrongCodes += narrow.bytes8()[i] != std::lround(i / 257.0);
    EXPECT_EQ(wrongCodes, 0);
    Image floats = makeImage(2, 3, PixelType::float32, "f");
    const float nan = std::numeric_limits<float>::quiet_NaN(), half = 0.5f / 255;
    const float values[] = {nan, -1,   0,        half * 0.99f, half * 1.01f, 0.5f, 1 - half * 1.01f, 1 - half * 0.99f,
                            1,   1.5f, INFINITY, -INFINITY};
    const int expected[] = {0, 0, 0, 0, 1, 128, 254, 255, 255, 255, 255, 0};
    std::copy(std::begin(values), std::end(values), floats.floats());
    const Image bytes = toUnorm8(floats);
    for (std::size_t i = 0; i < std::size(values); ++i)
        EXPECT_EQ(bytes.bytes8()[i], expected[i]) << i;
}

// A unit normal and one that is too long, whose blue becomes 0, in all types: the rounded middle code for each type.
TEST(ConvertImage, missingBlueIsReconstructedInEveryType)
{
    const double x = 0.6, y = -0.48, z = 0.64; // of length 1
    Image words = makeImage(2, 1, PixelType::unorm16), floats = makeImage(2, 1, PixelType::float32);
    const auto store = [&](std::size_t at, double red, double green) {
        const double values[] = {red, green, 0, 1};
        for (std::size_t c = 0; c < 4; ++c) {
            words.words()[4 * at + c] = std::uint16_t(std::lround(32768 + 32767 * values[c]));
            floats.floats()[4 * at + c] = float(0.5 + 0.5 * values[c]);
        }
    };
    store(0, x, y);
    store(1, -0.9, 0.8);
    completeNormals(words);
    completeNormals(floats);
    EXPECT_NEAR(words.words()[2], 32768 + 32767 * z, 1); // red and green are rounded
    EXPECT_NEAR(floats.floats()[2], 0.5 + 0.5 * z, 1e-6);
    EXPECT_EQ(words.words()[6], 32768);
    EXPECT_EQ(floats.floats()[6], 0.5f);
    EXPECT_EQ(words.words()[0], std::lround(32768 + 32767 * x));
    EXPECT_EQ(words.words()[3], 65535);
    EXPECT_EQ(floats.floats()[5], float(0.5 + 0.5 * 0.8));
}

} // namespace
} // namespace cotan::test
