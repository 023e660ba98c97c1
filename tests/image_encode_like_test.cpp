// Images encoded in the format and with the settings of another file.
#include "cotan/image.hpp"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

#include <gtest/gtest.h>
#include <webp/encode.h>

#include "cotan/scene.hpp"
#include "jpeg_maker.hpp"
#include "webp_maker.hpp"

namespace cotan::test {
namespace {

using namespace std::string_literals;

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

// An image decoded from a JPEG is encoded with the same tables again at almost no loss.
TEST(EncodeLike, jpegKeepsTablesSamplingAndScans)
{
    for (const int quality : {30, 75, 90, 100})
        for (const bool halved : {false, true}) {
            const auto old = jpegOf(mapOf(128), {.quality = quality, .halved = halved, .progressive = halved});
            const auto image = decodeImage(old, "old.jpg");
            const auto made = encodeLike(*image, old);
            ASSERT_TRUE(made) << made.error().message;
            EXPECT_EQ(made->format, "JPEG");
            EXPECT_EQ(made->mime, "image/jpeg");
            EXPECT_EQ(made->reason, "");
            EXPECT_NEAR(made->quality, quality, 1); // libjpeg rounds each step
            EXPECT_LE(made->bytes.size(), old.size() + old.size() / 50) << quality;
            const auto again = decodeImage(made->bytes, "new.jpg");
            ASSERT_TRUE(again) << again.error().message;
            EXPECT_LT(meanDifference(*image, *again), 1) << quality; // colours are rounded again
        }
}

TEST(EncodeLike, webpKeepsLosslessModeOrNearlyTheQuality)
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
        EXPECT_NEAR(made->quality, quality, 10); // regions of an image have their own quantisers
        EXPECT_GT(made->quality, last);
        last = made->quality;
        EXPECT_LT(meanDifference(*decodeImage(made->bytes, "new.webp"), image), 8) << quality;
    }
}

TEST(EncodeLike, otherFormatsBecomePngWithAReason)
{
    Image image = mapOf(16);
    const auto jpeg = jpegOf(image, {.quality = 80});
    const auto formatOf = [&](std::span<const std::byte> old) {
        const auto made = encodeLike(image, old);
        return made->format + ": " + made->reason;
    };
    EXPECT_EQ(formatOf(*encodePng(image)), "PNG: ");
    EXPECT_EQ(formatOf({}), "PNG: ");
    image.bytes8()[3] = 254;
    EXPECT_EQ(formatOf(jpeg), "PNG: JPEG has no alpha");
    image = makeImage(16, 16, PixelType::unorm16);
    EXPECT_EQ(formatOf(jpeg), "PNG: JPEG has 8 bits, but 16 are required");
}

// Truncated headers do not state a quality; the image is written all the same.
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

// Contents of all segments of a JPEG file with the given marker, without their length fields.
std::string segments(std::span<const std::byte> file, unsigned char marker)
{
    const std::string text(reinterpret_cast<const char*>(file.data()), file.size());
    const auto at = [&](std::size_t i) { return std::size_t(static_cast<unsigned char>(text[i])); };
    std::string found;
    for (std::size_t i = 2; i + 4 <= text.size() && at(i + 1) != 0xda;) {
        const std::size_t length = at(i + 2) << 8 | at(i + 3);
        if (at(i + 1) == marker)
            found += text.substr(i + 4, length - 2);
        i += 2 + length;
    }
    return found;
}

// The frame header has precision, height, width, then number, sampling and table of each component (ITU-T T.81).
TEST(EncodeLike, jpegKeepsQuantisationAndSamplingByteForByte)
{
    Image image = makeImage(37, 21, PixelType::unorm8);
    for (std::size_t i = 0; i < 4 * image.pixelCount(); ++i)
        image.bytes8()[i] = i % 4 == 3 ? 255 : std::uint8_t(i * 7);
    for (const JpegSettings& settings : {JpegSettings{.quality = 40},
                                         {.quality = 40, .halved = true},
                                         {.quality = 85, .halvedAcross = true},
                                         {.quality = 85, .halvedAcross = true, .progressive = true},
                                         {.quality = 60, .rgb = true}}) {
        const auto old = jpegOf(image, settings);
        const auto made = encodeLike(image, old);
        ASSERT_TRUE(made) << made.error().message;
        const unsigned char frame = settings.progressive ? 0xc2 : 0xc0, other = settings.progressive ? 0xc0 : 0xc2;
        ASSERT_EQ(segments(made->bytes, frame).size(), 15u);
        EXPECT_EQ(segments(made->bytes, frame), segments(old, frame));
        EXPECT_EQ(segments(made->bytes, other), "");
        EXPECT_EQ(segments(made->bytes, 0xdb), segments(old, 0xdb));
        const auto again = decodeImage(made->bytes, "new.jpg");
        ASSERT_TRUE(again);
        EXPECT_EQ(again->channels, 3);
    }
    for (const int quality : {25, 49, 50, 51, 97}) // below 25 libjpeg clamps some steps to 255
        EXPECT_NEAR(encodeLike(image, jpegOf(image, {.quality = quality}))->quality, quality, 1);
}

// Boolean encoder of RFC 6386, 7.3, for flags with a probability of one half.
class FlagsOut {
public:
    void flag(bool value)
    {
        const std::uint32_t split = 1 + (((range_ - 1) * 128) >> 8);
        bottom_ += value ? split : 0;
        range_ = value ? range_ - split : split;
        for (; range_ < 128; range_ *= 2) {
            if (bottom_ >> 31 != 0)
                carry();
            bottom_ <<= 1;
            if (--left_ == 0) {
                bytes_ += char(bottom_ >> 24);
                bottom_ &= 0xffffff;
                left_ = 8;
            }
        }
    }

    FlagsOut& number(int value, int bits)
    {
        while (bits-- > 0)
            flag((value >> bits & 1) != 0);
        return *this;
    }

    // A flag for presence, then magnitude and sign.
    FlagsOut& optional(int value, int bits)
    {
        number(1, 1).number(std::abs(value), bits).flag(value < 0);
        return *this;
    }

    // Pads with enough flags to flush all earlier ones into whole bytes.
    std::string done() { return number(0, 32).bytes_; }

private:
    void carry()
    {
        std::size_t i = bytes_.size();
        while (i > 0 && bytes_[i - 1] == '\xff')
            bytes_[--i] = '\0';
        if (i > 0)
            ++bytes_[i - 1];
    }

    std::string bytes_;
    std::uint32_t range_ = 255, bottom_ = 0;
    int left_ = 24;
};

// RFC 6386, 9.2 to 9.6, and libwebp's curve from quality to quantiser: 127 (1 - cbrt(linear)), where linear is two
// thirds of the fraction quality/100 up to 0.75 and twice the fraction less 1 above.
TEST(EncodeLike, webpQualityFollowsTheQuantiserInTheHeader)
{
    const Image image = mapOf(16);
    const auto expectQuality = [&](double quantiser, FlagsOut bits, const std::string& before) {
        const std::string data = "\x10\x02\0\x9d\x01\x2a\x10\0\x10\0"s + bits.done();
        const std::string file = riffWebp(before + riffChunk("VP8 ", data) + riffChunk("EXIF", "behind it"));
        const auto made = encodeLike(image, std::as_bytes(std::span(file)));
        ASSERT_TRUE(made) << made.error().message;
        const auto quantiserOf = [](double quality) {
            const double fraction = quality / 100;
            return 127 * (1 - std::cbrt(fraction < 0.75 ? fraction * 2 / 3 : 2 * fraction - 1));
        };
        // The nearest whole quality in the curve's argument; its neighbours are farther away.
        EXPECT_GE(made->quality, 1);
        EXPECT_LE(made->quality, 100);
        if (made->quality > 1) {
            EXPECT_GE(quantiserOf(made->quality - 0.51), quantiser);
        }
        if (made->quality < 100) {
            EXPECT_LE(quantiserOf(made->quality + 0.51), quantiser);
        }
    };
    for (const int quantiser : {0, 1, 2, 17, 26, 27, 60, 90, 126, 127})
        expectQuality(
            quantiser,
            FlagsOut().number(0, 2).number(0, 1).number(0x155, 10).number(0, 1).number(0, 2).number(quantiser, 7), "");
    // Segments with a map and data: each has an absolute or relative quantiser, and a loop filter.
    for (const bool map : {false, true})
        for (const bool absolute : {false, true}) {
            FlagsOut bits;
            bits.number(3, 2).number(1, 1).number(map, 1).number(1, 1).number(absolute, 1);
            bits.optional(44, 7).optional(absolute ? 12 : -20, 7).number(0, 1).optional(16, 7);
            bits.optional(-63, 6).number(0, 1).optional(5, 6).number(0, 1);
            if (map)
                bits.number(1, 1).number(0xa5, 8).number(0, 1).number(1, 1).number(0x3c, 8);
            bits.number(0x2aa, 10).number(1, 1).number(1, 1); // filter deltas by reference and mode
            for (int i = 0; i < 8; ++i)
                i % 3 == 0 ? bits.optional(i - 4, 6) : bits.number(0, 1);
            bits.number(2, 2).number(50, 7);
            expectQuality(absolute ? (44 + 12 + 0 + 16) / 4.0 : 50 + (44 - 20 + 0 + 16) / 4.0, bits,
                          riffChunk("ALPH", "odd"));
        }
    // Segments whose quantisers stay unchanged, and filter deltas without an update.
    expectQuality(33,
                  FlagsOut()
                      .number(0, 2)
                      .number(1, 1)
                      .number(1, 1)
                      .number(0, 1)
                      .number(0, 3)
                      .number(0x155, 10)
                      .number(1, 1)
                      .number(0, 1)
                      .number(3, 2)
                      .number(33, 7),
                  "");
}

TEST(EncodeLike, reasonForPngNamesTheOriginalFormat)
{
    const Image image = mapOf(16);
    const auto whyNot = [&](const std::string& old, const Image& source) {
        const auto made = encodeLike(source, std::as_bytes(std::span(old)));
        EXPECT_EQ(made->mime, "image/png");
        EXPECT_EQ(made->quality, 0);
        EXPECT_EQ(decodeImage(made->bytes, "new")->data, source.data);
        return made->reason;
    };
    EXPECT_EQ(whyNot("II*\0"s, image), "TIFF cannot be written");
    EXPECT_EQ(whyNot("GIF89a", image), "GIF cannot be written");
    EXPECT_EQ(whyNot("\xff\xd8\xff", image), "a grey or CMYK JPEG holds no normals, or this build has no libjpeg");
    EXPECT_EQ(whyNot("RIFF1234WEBP", makeImage(2, 3, PixelType::unorm16)), "WebP has 8 bits, but 16 are required");
    Image clear = image;
    clear.bytes8()[4 * 255 + 3] = 0;
    EXPECT_EQ(whyNot("\xff\xd8\xff", clear), "JPEG has no alpha");
    const std::string webp = riffWebp("");
    EXPECT_EQ(encodeLike(clear, std::as_bytes(std::span(webp)))->format, "WebP");
}

} // namespace
} // namespace cotan::test
