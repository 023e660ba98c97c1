// Hand-made TIFF files in every layout that a reader has to support, and truncated files.
#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "image_io.hpp"

namespace cotan::test {
namespace {

// Parameters of a file written from first principles (TIFF 6.0).
struct Tiff {
    int width = 1, height = 1, channels = 3, bits = 8;
    bool bigEndian = false;
    int rowsPerStrip = 0;                    // 0: tiles of 16 x 16
    bool planes = false;                     // each channel separately
    std::vector<std::uint16_t> palette = {}; // all reds, then greens, then blues

    // The value of channel c at (x, y): uses all 16 bits and depends differently on x and y.
    std::uint16_t value(int x, int y, int c) const
    {
        return std::uint16_t((4129 * x + 8221 * y + 16411 * c + 259) & (bits == 16 ? 0xffff : 0xff));
    }
};

class TiffWriter {
public:
    explicit TiffWriter(const Tiff& tiff) : t_(tiff) {}

    std::string make()
    {
        const std::string parts = makeParts();
        const std::size_t count = offsets_.size();
        std::vector<std::array<std::uint32_t, 4>> entries; // tag, type, count, value
        const auto add = [&](std::uint32_t tag, std::uint32_t type, std::uint32_t n, std::uint32_t value) {
            entries.push_back({tag, type, n, value});
        };
        const bool tiled = t_.rowsPerStrip == 0, indexed = !t_.palette.empty();
        const std::size_t known = 10 + (tiled ? 1 : 0) + (indexed ? 1 : 0); // number of entries
        std::size_t at = 8 + 2 + 12 * known + 4;
        const auto offsetsAt = std::uint32_t(at), countsAt = std::uint32_t(at + 4 * count);
        at += 8 * count;
        const auto bitsAt = std::uint32_t(at), paletteAt = std::uint32_t(at + 2 * std::size_t(t_.channels));
        at += 2 * std::size_t(t_.channels) + 2 * t_.palette.size();
        add(256, 4, 1, std::uint32_t(t_.width));
        add(257, 4, 1, std::uint32_t(t_.height));
        if (t_.channels > 2)
            add(258, 3, std::uint32_t(t_.channels), bitsAt);
        else
            add(258, 3, 1, std::uint32_t(t_.bits)); // a short: the first half of the value field
        add(259, 3, 1, 1);
        add(262, 3, 1, indexed ? 3 : t_.channels >= 3 ? 2 : 1);
        const bool single = count == 1; // the value is then stored in the entry
        const auto list = [&](std::uint32_t tag, std::uint32_t value, const std::vector<std::uint32_t>& values) {
            add(tag, 4, std::uint32_t(count), single ? values[0] : value);
        };
        for (std::uint32_t& offset : offsets_)
            offset += std::uint32_t(at);
        if (!tiled)
            list(273, offsetsAt, offsets_);
        add(277, 3, 1, std::uint32_t(t_.channels));
        if (!tiled) {
            add(278, 4, 1, std::uint32_t(t_.rowsPerStrip));
            list(279, countsAt, counts_);
        }
        add(284, 3, 1, t_.planes ? 2 : 1);
        if (indexed)
            add(320, 3, std::uint32_t(t_.palette.size()), paletteAt);
        if (tiled) {
            add(322, 4, 1, 16);
            add(323, 4, 1, 16);
            list(324, offsetsAt, offsets_);
            list(325, countsAt, counts_);
        }
        EXPECT_EQ(entries.size(), known);

        std::string file = t_.bigEndian ? "MM" : "II";
        file += number(42, 2) + number(8, 4) + number(entries.size(), 2);
        for (const auto& [tag, type, n, value] : entries)
            file += number(tag, 2) + number(type, 2) + number(n, 4)
                + (type == 3 && n == 1 ? number(value, 2) + std::string(2, '\0') : number(value, 4));
        file += number(0, 4);
        for (const std::uint32_t offset : offsets_)
            file += number(offset, 4);
        for (const std::uint32_t n : counts_)
            file += number(n, 4);
        for (int c = 0; c < t_.channels; ++c)
            file += number(std::uint64_t(t_.bits), 2);
        for (const std::uint16_t entry : t_.palette)
            file += number(entry, 2);
        EXPECT_EQ(file.size(), at);
        return file + parts;
    }

private:
    std::string number(std::uint64_t value, int bytes) const
    {
        std::string text;
        for (int i = 0; i < bytes; ++i)
            text += char(value >> (8 * (t_.bigEndian ? bytes - 1 - i : i)));
        return text;
    }

    std::string makeParts()
    {
        const bool tiled = t_.rowsPerStrip == 0;
        const int w = tiled ? 16 : t_.width, h = tiled ? 16 : t_.rowsPerStrip;
        std::string parts;
        for (int plane = 0; plane < (t_.planes ? t_.channels : 1); ++plane)
            for (int top = 0; top < t_.height; top += h)
                for (int left = 0; left < t_.width; left += w) {
                    offsets_.push_back(std::uint32_t(parts.size()));
                    const int rows = tiled ? h : std::min(h, t_.height - top);
                    for (int y = top; y < top + rows; ++y)
                        for (int x = left; x < left + w; ++x)
                            for (int c = 0; c < (t_.planes ? 1 : t_.channels); ++c)
                                parts += number(t_.value(x, y, t_.planes ? plane : c), t_.bits / 8);
                    counts_.push_back(std::uint32_t(parts.size()) - offsets_.back());
                }
        return parts;
    }

    const Tiff& t_;
    std::vector<std::uint32_t> offsets_, counts_;
};

std::vector<Tiff> tiffs()
{
    std::vector<Tiff> all;
    for (const int bits : {8, 16})
        for (const bool bigEndian : {false, true})
            for (const int rows : {0, 2, 5})
                for (const bool planes : {false, true})
                    for (const auto& [width, height] : {std::pair(19, 5), std::pair(3, 18)})
                        all.push_back({.width = width,
                                       .height = height,
                                       .channels = 3,
                                       .bits = bits,
                                       .bigEndian = bigEndian,
                                       .rowsPerStrip = rows,
                                       .planes = planes});
    all.push_back({.width = 7, .height = 3, .channels = 1, .bits = 16, .bigEndian = true, .rowsPerStrip = 3});
    return all;
}

TEST_F(ImageIo, everyTiffLayoutIsReadCorrectly)
{
    for (const Tiff& t : tiffs()) {
        SCOPED_TRACE(testing::Message() << t.width << " x " << t.height << ", " << t.bits << " bits, big-endian "
                                        << t.bigEndian << ", rows " << t.rowsPerStrip << ", planes " << t.planes);
        const std::string file = TiffWriter(t).make();
        const auto image = decodeImage(bytesOf(file), "a.tif");
        ASSERT_TRUE(image) << image.error().message;
        EXPECT_EQ(image->type, t.bits == 16 ? PixelType::unorm16 : PixelType::unorm8);
        ASSERT_EQ(image->width, t.width);
        ASSERT_EQ(image->height, t.height);
        for (int y = 0; y < t.height; ++y)
            for (int x = 0; x < t.width; ++x)
                for (int c = 0; c < 4; ++c)
                    ASSERT_EQ(component(*image, x, y, c),
                              c == 3 ? (t.bits == 16 ? 0xffff : 0xff) : t.value(x, y, t.channels == 1 ? 0 : c))
                        << x << ' ' << y << ' ' << c;
        for (const int strip : {1, 2, 7}) {
            const auto rows = byRows(write("a.tif", file), strip);
            ASSERT_TRUE(rows) << strip;
            EXPECT_EQ(rows->data, image->data) << "rows " << strip;
        }
    }
}

TEST_F(ImageIo, tiffPaletteBecomesColours)
{
    Tiff t{.width = 5, .height = 2, .channels = 1, .bits = 8, .rowsPerStrip = 2};
    for (int c = 0; c < 3; ++c)
        for (int i = 0; i < 256; ++i)
            t.palette.push_back(std::uint16_t(257 * ((i * (c + 2)) % 256)));
    const std::string file = TiffWriter(t).make();
    const auto image = decodeImage(bytesOf(file), "a.tif");
    ASSERT_TRUE(image) << image.error().message;
    for (int x = 0; x < 5; ++x)
        for (int c = 0; c < 3; ++c)
            EXPECT_EQ(component(*image, x, 1, c), t.value(x, 1, 0) * (c + 2) % 256) << x << ' ' << c;
}

// Grey and alpha, of odd width.
TEST_F(ImageIo, tiffOfTwoChannelsIsGreyAndAlpha)
{
    const Tiff t{.width = 5, .height = 3, .channels = 2, .bits = 16, .bigEndian = true, .rowsPerStrip = 2};
    const auto image = decodeImage(bytesOf(TiffWriter(t).make()), "a.tif");
    ASSERT_TRUE(image) << image.error().message;
    for (int c = 0; c < 4; ++c)
        EXPECT_EQ(component(*image, 4, 2, c), t.value(4, 2, c == 3 ? 1 : 0)) << c;
}

TEST_F(ImageIo, tiffCutAnywhereIsRefused)
{
    for (const Tiff& t : tiffs())
        if (t.bits == 16 || t.bigEndian)
            expectCutsRefused("a.tif", TiffWriter(t).make(), 8);
}

TEST_F(ImageIo, compressedTiffAndExrCutAnywhereAreRefused)
{
    Image image = makeImage(23, 9, PixelType::float32);
    for (std::size_t i = 0; i < image.pixelCount() * 4; ++i)
        image.floats()[i] = float(i * 7919 % 1000) / 1000;
    Image words = makeImage(23, 9, PixelType::unorm16);
    for (std::size_t i = 0; i < words.pixelCount() * 4; ++i)
        words.words()[i] = std::uint16_t(i * 7919);
    ASSERT_TRUE(writeImage(folder / "whole.exr", image));
    ASSERT_TRUE(writeImage(folder / "whole.tif", words));
    for (const char* const extension : {".exr", ".tif"}) {
        std::ifstream in(folder / (std::string("whole") + extension), std::ios::binary);
        const std::string whole{std::istreambuf_iterator<char>(in), {}};
        expectCutsRefused(std::string("a") + extension, whole, 8);
    }
}

TEST_F(ImageIo, tiffWithoutBitsPerSampleIsRefusedWholeAndByRows)
{
    // By the format these are 1 bit; OpenImageIO takes them for 8 and reads other pixels by rows than whole.
    std::string file = TiffWriter({.width = 2, .height = 2, .rowsPerStrip = 2}).make();
    const std::size_t bits = file.find(std::string("\x02\x01\x03\0", 4)); // tag 258, type short
    ASSERT_NE(bits, std::string::npos);
    file[bits] = '\xff'; // tag 511, which is undefined
    const auto image = decodeImage(bytesOf(file), "a.tif");
    ASSERT_FALSE(image);
    EXPECT_NE(image.error().message.find("bits per sample"), std::string::npos) << image.error().message;
    const auto rows = openRows(write("a.tif", file));
    ASSERT_FALSE(rows);
    EXPECT_EQ(rows.error().message.substr(rows.error().message.find("broken")),
              image.error().message.substr(image.error().message.find("broken")));
}

TEST_F(ImageIo, unknownCompressionOrEndlessTiffStripsAreRefused)
{
    const std::string sound = TiffWriter({.width = 2, .height = 2, .rowsPerStrip = 2}).make();
    const auto with = [&](const std::string& entry, const std::string& value, const std::string& why) {
        std::string file = sound;
        const std::size_t at = file.find(entry);
        ASSERT_NE(at, std::string::npos);
        file.replace(at + 8, value.size(), value);
        for (const auto& message :
             {messageOf(decodeImage(bytesOf(file), "a.tif")), messageOf(openRows(write("a.tif", file)))})
            EXPECT_NE(message.find(why), std::string::npos) << message;
    };
    with(std::string("\x03\x01\x03\0", 4), std::string("\x01\x38", 2),
         "compression 14337"); // once zeros or uninitialised memory
    with(std::string("\x16\x01\x04\0", 4), std::string("\0\0\0\x1d", 4), "strips have 486539264 rows"); // once 3.9 GB
    with(std::string("\x16\x01\x04\0", 4), std::string("\xff\xff\xff\xff", 4), "accepted"); // one strip of any height
}

TEST_F(ImageIo, undecodableTiffStripsAreRefusedWholeAndByRows)
{
    const std::string sound = TiffWriter({.width = 2, .height = 2, .rowsPerStrip = 2}).make();
    const std::size_t entry = sound.find(std::string("\x03\x01\x03\0", 4)); // the compression tag
    ASSERT_NE(entry, std::string::npos);
    for (const char compression : {'\2', '\3', '\4', '\5', '\7', '\x08'}) { // CCITT fax, LZW, JPEG, Deflate
        std::string file = sound;
        file[entry + 8] = compression;
        EXPECT_NE(messageOf(decodeImage(bytesOf(file), "a.tif")).find("a.tif: broken tiff image"), std::string::npos)
            << int(compression); // once zeros or uninitialised memory
        for (const int rows : {1, 2}) {
            auto reader = openRows(write("a.tif", file));
            ASSERT_TRUE(reader) << reader.error().message;
            Image strip = makeImage(2, rows, (*reader)->type);
            EXPECT_FALSE((*reader)->read(strip)) << int(compression) << ' ' << rows;
        }
    }
}

TEST_F(ImageIo, emptyTiffStripsAreRefusedWholeAndByRows)
{
    const Tiff t{.width = 5, .height = 6, .channels = 3, .bits = 8, .rowsPerStrip = 2};
    const std::string sound = TiffWriter(t).make();
    const auto refused = [&](const std::string& file, const std::string& why) {
        const auto image = decodeImage(bytesOf(file), "a.tif");
        ASSERT_FALSE(image) << why;
        EXPECT_NE(image.error().message.find(why), std::string::npos) << image.error().message;
        const auto rows = openRows(write("a.tif", file));
        ASSERT_FALSE(rows) << why;
        EXPECT_NE(rows.error().message.find(why), std::string::npos) << rows.error().message;
    };
    const std::size_t count =
        sound.find(std::string("\x1e\0\0\0\x1e\0\0\0\x1e\0\0\0", 12)); // 5 x 2 x 3 bytes, three times
    ASSERT_NE(count, std::string::npos);
    std::string none = sound;
    none.replace(count + 4, 4, 4, '\0');
    refused(none, "strip 1 has no bytes");
    std::string taller = sound; // 7 rows need four strips; the list has three
    const std::size_t height = taller.find(std::string("\x01\x01\x04\0\1\0\0\0\6", 9));
    ASSERT_NE(height, std::string::npos);
    taller[height + 8] = 7;
    refused(taller, "its directory lists 3 strips, expected 4");
}

} // namespace
} // namespace cotan::test
