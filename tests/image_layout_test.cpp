// Picture files made by hand, in every layout that a reader has to get right, and cut short.
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>
#include <jpeglib.h>
#include <unistd.h>

#include "cotan/image/file.hpp"
#include "cotan/image/rows.hpp"

namespace cotan {
namespace {

namespace fs = std::filesystem;

template<class T> std::string messageOf(const Result<T>& result)
{
    return result ? "accepted" : result.error().message;
}

std::span<const std::byte> bytesOf(const std::string& text) { return std::as_bytes(std::span(text)); }

// ---- TIFF from first principles (TIFF 6.0) ------------------------------------------------------

struct Tiff {
    int width = 1, height = 1, channels = 3, bits = 8;
    bool bigEndian = false;
    int rowsPerStrip = 0;                    // 0: tiles of 16 x 16
    bool planes = false;                     // each channel on its own
    std::vector<std::uint16_t> palette = {}; // reds, greens, blues

    // What channel c has at (x, y): every bit of 16 is of use, and x and y differ.
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
        const std::size_t known = 10 + (tiled ? 1 : 0) + (indexed ? 1 : 0); // entries
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
            add(258, 3, 1, std::uint32_t(t_.bits)); // a short: the first half of its place
        add(259, 3, 1, 1);
        add(262, 3, 1, indexed ? 3 : t_.channels >= 3 ? 2 : 1);
        const bool single = count == 1; // then the value stands in the entry
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

int component(const Image& image, int x, int y, int c)
{
    const std::size_t at = (std::size_t(y) * std::size_t(image.width) + std::size_t(x)) * 4 + std::size_t(c);
    return image.type == PixelType::unorm16 ? image.words()[at] : image.bytes8()[at];
}

// A file for one test.
class PictureFile : public testing::Test {
protected:
    fs::path folder = fs::temp_directory_path()
        / ("cotan_layout_test_" + std::to_string(::getpid()) + "_"
           + testing::UnitTest::GetInstance()->current_test_info()->name());
    void SetUp() override { fs::create_directories(folder); }
    void TearDown() override { fs::remove_all(folder); }

    fs::path write(const std::string& name, const std::string& bytes) const
    {
        fs::remove(folder / name);
        std::ofstream(folder / name, std::ios::binary) << bytes;
        return folder / name;
    }

    // The picture by rows, `strip` at a time; nothing where that fails.
    std::optional<Image> byRows(const fs::path& file, int strip) const
    {
        auto rows = openRows(file);
        if (!rows)
            return std::nullopt;
        Image whole = makeImage((*rows)->width, (*rows)->height, (*rows)->type);
        const std::size_t rowBytes = std::size_t(whole.width) * whole.bytesPerPixel();
        for (int y = 0; y < whole.height; y += strip) {
            Image part = makeImage(whole.width, std::min(strip, whole.height - y), whole.type);
            if (!(*rows)->read(part))
                return std::nullopt;
            std::memcpy(whole.data.data() + std::size_t(y) * rowBytes, part.data.data(), part.data.size());
        }
        return whole;
    }

    // Both ways of reading refuse what `cut` leaves of the file, in one line and without a word besides.
    void expectCutsRefused(const std::string& name, const std::string& whole, std::size_t first) const
    {
        ASSERT_TRUE(decodeImage(bytesOf(whole), name));
        testing::internal::CaptureStderr();
        for (std::size_t length = first; length < whole.size(); length += 1 + whole.size() / 60) {
            const std::string cut = whole.substr(0, length);
            const auto image = decodeImage(bytesOf(cut), name);
            EXPECT_FALSE(image) << name << " cut to " << length << " of " << whole.size();
            if (!image) {
                EXPECT_EQ(image.error().message.find('\n'), std::string::npos) << image.error().message;
            }
            EXPECT_FALSE(byRows(write(name, cut), 2)) << name << " by rows, cut to " << length;
        }
        EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    }
};

TEST_F(PictureFile, tiffOfEveryLayoutHasItsValuesInTheirPlaces)
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

TEST_F(PictureFile, tiffPaletteBecomesColours)
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
TEST_F(PictureFile, tiffOfTwoChannelsIsGreyAndAlpha)
{
    const Tiff t{.width = 5, .height = 3, .channels = 2, .bits = 16, .bigEndian = true, .rowsPerStrip = 2};
    const auto image = decodeImage(bytesOf(TiffWriter(t).make()), "a.tif");
    ASSERT_TRUE(image) << image.error().message;
    for (int c = 0; c < 4; ++c)
        EXPECT_EQ(component(*image, 4, 2, c), t.value(4, 2, c == 3 ? 1 : 0)) << c;
}

TEST_F(PictureFile, tiffCutAnywhereIsRefused)
{
    for (const Tiff& t : tiffs())
        if (t.bits == 16 || t.bigEndian)
            expectCutsRefused("a.tif", TiffWriter(t).make(), 8);
}

TEST_F(PictureFile, compressedTiffAndExrCutAnywhereAreRefused)
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

TEST_F(PictureFile, exrAttributesLargerThanTheFileAreRefused)
{
    const std::string start("\x76\x2f\x31\x01\2\0\0\0", 8);
    for (const std::string& size : {std::string("\xff\xff\xff\x7f", 4), std::string("\xff\xff\xff\xff", 4)}) {
        const std::string file = start + std::string("a\0string\0", 9) + size;
        const auto image = decodeImage(bytesOf(file), "a.exr");
        ASSERT_FALSE(image);
        EXPECT_NE(image.error().message.find("an attribute of its header takes"), std::string::npos)
            << image.error().message;
        EXPECT_FALSE(openRows(write("a.exr", file)));
    }
    EXPECT_FALSE(decodeImage(bytesOf(start + std::string(1000, 'n')), "a.exr"));
    EXPECT_FALSE(decodeImage(bytesOf(start), "a.exr"));
}

// A file of OpenEXR that has only a header: attributes of (name, type, size as stored, bytes).
std::string exrHeader(const std::vector<std::tuple<std::string, std::string, std::uint32_t, std::string>>& attributes)
{
    std::string header;
    for (const auto& [name, type, size, bytes] : attributes) {
        header += name + '\0' + type + '\0';
        for (int i = 0; i < 4; ++i)
            header += char(size >> (8 * i));
        header += bytes;
    }
    return header + '\0';
}

std::string words(const std::vector<std::uint32_t>& numbers)
{
    std::string bytes;
    for (const std::uint32_t n : numbers)
        for (int i = 0; i < 4; ++i)
            bytes += char(n >> (8 * i));
    return bytes;
}

TEST_F(PictureFile, exrBlocksLargerThanTheLimitsAreRefusedBeforeMemoryIsTaken)
{
    const std::string magic("\x76\x2f\x31\x01\2\0\0\0", 8);
    const std::string channels = std::string("R\0", 2) + words({1, 0, 1, 1}) + '\0';
    const auto refused = [&](std::uint32_t right, std::uint32_t bottom, char compression, const std::string& tiles) {
        std::vector<std::tuple<std::string, std::string, std::uint32_t, std::string>> attributes = {
            {"channels", "chlist", 19, channels},
            {"compression", "compression", 1, std::string(1, compression)},
            {"dataWindow", "box2i", 16, words({0, 0, right, bottom})},
            {"displayWindow", "box2i", 16, words({0, 0, right, bottom})},
            {"lineOrder", "lineOrder", 1, std::string(1, '\0')}};
        if (!tiles.empty())
            attributes.emplace_back("tiles", "tiledesc", 9, tiles);
        const std::string file = magic + exrHeader(attributes) + std::string(64, '\0');
        for (const auto& message :
             {messageOf(decodeImage(bytesOf(file), "a.exr", {})), messageOf(openRows(write("a.exr", file)))})
            EXPECT_NE(message.find("the limit is"), std::string::npos) << message;
    };
    refused(0x1000000, 0, 0, ""); // 16.8 million pixels beside each other
    refused(0, 0x1000000, 0, "");
    refused(3, 3, 0, words({0x4000, 0x8000}) + '\0');               // tiles of 2 GB
    refused(16383, 255, 9, words({0xffffffff, 0xffffffff}) + '\0'); // beyond 64 bits, were it not stopped
}

// 2 x 2 of one channel of floats, in blocks of a row; or in one tile, level 0. Parts: two of the same.
std::string makeExr(bool tiled, bool parts, char compression)
{
    std::vector<std::tuple<std::string, std::string, std::uint32_t, std::string>> attributes = {
        {"channels", "chlist", 19, std::string("R\0", 2) + words({2, 0, 1, 1}) + '\0'},
        {"compression", "compression", 1, std::string(1, compression)},
        {"dataWindow", "box2i", 16, words({0, 0, 1, 1})},
        {"displayWindow", "box2i", 16, words({0, 0, 1, 1})},
        {"lineOrder", "lineOrder", 1, std::string(1, '\0')},
        {"pixelAspectRatio", "float", 4, words({0x3f800000})},
        {"screenWindowCenter", "v2f", 8, words({0, 0})},
        {"screenWindowWidth", "float", 4, words({0x3f800000})}};
    if (tiled)
        attributes.emplace_back("tiles", "tiledesc", 9, words({2, 2}) + '\0');
    const std::uint32_t blocks = tiled ? 1 : 2;
    std::string header;
    for (const char* const name : {"a", "b"}) {
        auto all = attributes;
        if (parts) {
            all.emplace_back("name", "string", 1, name);
            const std::string type = tiled ? "tiledimage" : "scanlineimage";
            all.emplace_back("type", "string", std::uint32_t(type.size()), type);
            all.emplace_back("chunkCount", "int", 4, words({blocks}));
        }
        if (name == std::string("a") || parts)
            header += exrHeader(all);
    }
    header += parts ? std::string(1, '\0') : "";
    const std::uint32_t version = 2u | (parts ? 0x1000u : tiled ? 0x200u : 0u);
    const std::string start = words({0x01312f76, version}) + header;
    std::string table, pixels;
    for (std::uint32_t part = 0; part < (parts ? 2u : 1u); ++part)
        for (std::uint32_t y = 0; y < blocks; ++y) {
            const std::size_t tables = 8 * blocks * (parts ? 2 : 1);
            table += words({std::uint32_t(start.size() + tables + pixels.size()), 0});
            pixels += (parts ? words({part}) : "") + (tiled ? words({0, 0, 0, 0, 16}) : words({y, 8}));
            for (std::uint32_t i = 0; i < (tiled ? 4u : 2u); ++i)
                pixels += words({0x3f000000});
        }
    return start + table + pixels;
}

TEST_F(PictureFile, exrBlocksThatAreNotThereOrTooShortAreRefusedWholeAndByRows)
{
    for (const bool tiled : {false, true})
        for (const bool parts : {false, true}) {
            const std::string sound = makeExr(tiled, parts, 0);
            const auto image = decodeImage(bytesOf(sound), "a.exr");
            ASSERT_TRUE(image) << tiled << parts << image.error().message;
            EXPECT_EQ(image->floats()[0], 0.5f);
            const std::size_t blocks = tiled ? 1 : 2, before = (parts ? 4 : 0) + (tiled ? 16 : 4);
            const std::size_t first =
                sound.size() - blocks * (parts ? 2 : 1) * (before + 4 + (tiled ? 16 : 8)); // behind the tables
            const std::size_t table = first - 8 * blocks * (parts ? 2 : 1);
            const auto refused = [&](std::size_t at, std::uint32_t value, const std::string& why, char compression) {
                std::string file = makeExr(tiled, parts, compression);
                file.replace(at, 4, words({value}));
                for (const auto& message :
                     {messageOf(decodeImage(bytesOf(file), "a.exr")), messageOf(openRows(write("a.exr", file)))})
                    EXPECT_NE(message.find(why), std::string::npos) << tiled << parts << ": " << message;
            };
            refused(table, 0, "block 0 of " + std::to_string(blocks) + " is not in the file", 0);
            refused(table, 100000, "block 0 of " + std::to_string(blocks) + " is not in the file", 0);
            refused(first + before, 7, "block 0 has 7 bytes, expected " + std::to_string(tiled ? 16 : 8), 0);
            refused(first + before, 0, "block 0 has 0 bytes, expected 1", 2); // once whatever the memory held
            refused(first + before, 100000, "block 0 takes 100000 bytes from ", 2);
        }
}

// The size says that the header ends before what the reader of the type goes on to, an attribute of 1.7 GB.
TEST_F(PictureFile, exrAttributesThatAreNotAsLongAsTheirTypeAreRefused)
{
    const std::string scanLines("\x76\x2f\x31\x01\2\0\0\0", 8), tiles("\x76\x2f\x31\x01\2\2\0\0", 8),
        parts("\x76\x2f\x31\x01\2\x10\0\0", 8);
    const std::string channel("B\0\1\0\0\0\0\0\0\0\1\0\0\0\1\0\0\0", 18);
    const std::string text("\4\0\0\0text", 8), preview = std::string("\1\0\0\0\2\0\0\0", 8) + std::string(8, 'p');
    const std::string huge = exrHeader({{"x", "none", 0x657c6974, ""}});
    const std::vector<std::tuple<std::string, std::string>> values = {
        {"chlist", channel + channel + '\0'}, {"stringvector", text + text},  {"preview", preview},
        {"floatvector", std::string(8, 'f')}, {"float", std::string(4, 'f')}, {"tiledesc", std::string(9, 't')},
        {"v2f", std::string(8, 'v')},         {"m44d", std::string(128, 'm')}};
    for (const auto& [type, bytes] : values) {
        const auto size = std::uint32_t(bytes.size());
        for (const std::string& start : {scanLines, tiles, parts}) {
            const std::string before = start == parts ? exrHeader({{"first", "unknown", 3, "abc"}}) : "";
            for (const std::uint32_t stored : {size - 1, size + 1, size}) {
                const std::string file = start + before
                    + exrHeader({{"u", "unknown", 2, "ab"}, {"a", type, stored, bytes}}) + std::string(4, '\0') + huge;
                const auto image = decodeImage(bytesOf(file), "a.exr");
                ASSERT_FALSE(image);
                // A true size passes the check, and what is missing is OpenEXR's to say.
                EXPECT_EQ(image.error().message.find("which its type does not take") != std::string::npos,
                          stored != size)
                    << type << ' ' << stored << ": " << image.error().message;
                EXPECT_FALSE(openRows(write("a.exr", file)));
            }
        }
    }
}

TEST_F(PictureFile, tiffThatDoesNotStateItsBitsIsRefusedWholeAndByRows)
{
    // By the format these are 1 bit; OpenImageIO takes them for 8 and finds other pixels by rows than whole.
    std::string file = TiffWriter({.width = 2, .height = 2, .rowsPerStrip = 2}).make();
    const std::size_t bits = file.find(std::string("\x02\x01\x03\0", 4)); // tag 258, a short
    ASSERT_NE(bits, std::string::npos);
    file[bits] = '\xff'; // tag 511, which nobody knows
    const auto image = decodeImage(bytesOf(file), "a.tif");
    ASSERT_FALSE(image);
    EXPECT_NE(image.error().message.find("bits per sample"), std::string::npos) << image.error().message;
    const auto rows = openRows(write("a.tif", file));
    ASSERT_FALSE(rows);
    EXPECT_EQ(rows.error().message.substr(rows.error().message.find("broken")),
              image.error().message.substr(image.error().message.find("broken")));
}

TEST_F(PictureFile, tiffOfAnUnknownCompressionOrOfEndlessStripsIsRefusedWholeAndByRows)
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
         "compression 14337"); // once zeros, or whatever was there
    with(std::string("\x16\x01\x04\0", 4), std::string("\0\0\0\x1d", 4), "strips have 486539264 rows"); // once 3.9 GB
    with(std::string("\x16\x01\x04\0", 4), std::string("\xff\xff\xff\xff", 4), "accepted"); // one strip, however high
}

TEST_F(PictureFile, tiffWhoseStripsCannotBeDecodedIsRefusedWholeAndInAnyNumberOfRows)
{
    const std::string sound = TiffWriter({.width = 2, .height = 2, .rowsPerStrip = 2}).make();
    const std::size_t entry = sound.find(std::string("\x03\x01\x03\0", 4)); // the tag of the compression
    ASSERT_NE(entry, std::string::npos);
    for (const char compression : {'\2', '\3', '\4', '\5', '\7', '\x08'}) { // faxes, LZW, JPEG, zip
        std::string file = sound;
        file[entry + 8] = compression;
        EXPECT_NE(messageOf(decodeImage(bytesOf(file), "a.tif")).find("a.tif: broken tiff image"), std::string::npos)
            << int(compression); // once zeros, or whatever was there
        for (const int rows : {1, 2}) {
            auto reader = openRows(write("a.tif", file));
            ASSERT_TRUE(reader) << reader.error().message;
            Image strip = makeImage(2, rows, (*reader)->type);
            EXPECT_FALSE((*reader)->read(strip)) << int(compression) << ' ' << rows;
        }
    }
}

TEST_F(PictureFile, tiffOfStripsWithoutBytesIsRefusedWholeAndByRows)
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
    std::string taller = sound; // 7 rows are four strips; the list has three
    const std::size_t height = taller.find(std::string("\x01\x01\x04\0\1\0\0\0\6", 9));
    ASSERT_NE(height, std::string::npos);
    taller[height + 8] = 7;
    refused(taller, "its directory lists 3 strips, expected 4");
}

// ---- DDS ----------------------------------------------------------------------------------------

std::string dx10(int width, int height, std::uint32_t format)
{
    std::array<std::uint32_t, 37> header{};
    header[0] = 0x20534444, header[1] = 124, header[2] = 0x1007; // caps, height, width, pixel format
    header[3] = std::uint32_t(height), header[4] = std::uint32_t(width);
    header[19] = 32, header[20] = 0x4, header[21] = 0x30315844; // "DX10"
    header[27] = 0x1000;
    header[32] = format, header[33] = 3 /*2D*/, header[35] = 1;
    return {reinterpret_cast<const char*>(header.data()), sizeof header};
}

TEST_F(PictureFile, ddsWithTheNewerHeaderNeedsAllItsBlocks)
{
    // BC5, 5 x 7 pixels: 2 x 2 blocks of two BC4 halves, all indices 0: each channel its first endpoint.
    std::string file = dx10(5, 7, 83);
    for (const int red : {200, 40, 90, 10})
        file += std::string(1, char(red)) + std::string(7, '\0') + std::string(1, char(red / 2)) + std::string(7, '\0');
    const auto image = decodeImage(bytesOf(file), "a.dds");
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(component(*image, 0, 0, 0), 200);
    EXPECT_EQ(component(*image, 4, 3, 0), 40);
    EXPECT_EQ(component(*image, 0, 4, 1), 45);
    EXPECT_EQ(component(*image, 4, 6, 1), 5);
    for (const std::size_t length :
         {std::size_t(0), std::size_t(128), std::size_t(147), std::size_t(148), file.size() - 1}) {
        EXPECT_FALSE(decodeImage(bytesOf(file.substr(0, length)), "a.dds")) << length;
    }
    EXPECT_FALSE(decodeImage(bytesOf(dx10(4, 4, 999) + std::string(4096, '\0')), "a.dds"));
    EXPECT_FALSE(decodeImage(bytesOf(dx10(0x7fffffff, 0x7fffffff, 83) + std::string(4096, '\0')), "a.dds"));
}

// One block of zeros: alpha is 0, by which the library would divide. The same block is sound as DXT5.
TEST_F(PictureFile, ddsOfColoursMultipliedByAlphaIsRefused)
{
    for (const std::string& name : {std::string("DXT2"), std::string("DXT4"), std::string("DXT5")}) {
        const std::string file = dx10(4, 4, 0).substr(0, 128).replace(84, 4, name) + std::string(16, '\0');
        const auto image = decodeImage(bytesOf(file), "a.dds");
        EXPECT_EQ(bool(image), name == "DXT5") << name;
        EXPECT_EQ(bool(openRows(write("a.dds", file))), name == "DXT5") << name;
    }
}

TEST_F(PictureFile, ddsOfMoreLevelsThanAPictureCanHaveIsRefused)
{
    const std::string file = dx10(4, 4, 83) + std::string(16, '\0');
    EXPECT_TRUE(decodeImage(bytesOf(std::string(file).replace(28, 1, 1, '\x03')), "a.dds"));
    const auto image = decodeImage(bytesOf(std::string(file).replace(28, 4, 4, '\x47')), "a.dds");
    ASSERT_FALSE(image);
    EXPECT_NE(image.error().message.find("it has 1195853639 levels"), std::string::npos) << image.error().message;
}

TEST_F(PictureFile, ddsOfNormalsInOneChannelIsRefused)
{
    for (const std::string& name : {std::string("ATI1"), std::string("BC4U"), std::string("ATI2")}) {
        const std::string plain = dx10(4, 4, 0).substr(0, 128).replace(84, 4, name) + std::string(16, '\x10');
        const std::string normals = std::string(plain).replace(83, 1, 1, '\x80'); // the flag 0x80000000
        EXPECT_TRUE(decodeImage(bytesOf(plain), "a.dds")) << name;
        EXPECT_EQ(bool(decodeImage(bytesOf(normals), "a.dds")), name == "ATI2") << name;
    }
}

TEST_F(PictureFile, ddsOfChannelsWithoutBitsOrOfNoKnownKindIsRefused)
{
    std::string file = dx10(1, 1, 0).substr(0, 128);
    file.replace(80, 28,
                 std::string("\x41\0\0\0\0\0\0\0\x20\0\0\0"
                             "\0\0\xff\0"
                             "\0\xff\0\0"
                             "\xff\0\0\0"
                             "\0\0\0\xff",
                             28));
    file += "\1\2\3\4";
    ASSERT_TRUE(decodeImage(bytesOf(file), "a.dds"));
    for (const std::size_t mask : {92u, 96u, 100u, 104u})
        EXPECT_FALSE(decodeImage(bytesOf(std::string(file).replace(mask, 4, 4, '\0')), "a.dds")) << mask;
    const auto ofKind = [&](std::uint32_t flags) {
        std::string other = file;
        for (std::size_t i = 0; i < 4; ++i)
            other[80 + i] = char(flags >> 8 * i);
        return bool(decodeImage(bytesOf(other), "a.dds"));
    };
    EXPECT_TRUE(ofKind(0x40) && ofKind(0x20000) && ofKind(0x20001)) << "colours and brightness";
    // Alpha alone, palettes, YUV: read as colours whatever their masks are.
    for (const std::uint32_t flags : {0u, 1u, 2u, 0x20u, 0x21u, 0x200u, 0x20040u})
        EXPECT_FALSE(ofKind(flags)) << flags;
}

// ---- BMP ----------------------------------------------------------------------------------------

// 2 x 2 of palette entries 1, 2, 3 and 4; runs are of 8 bits.
std::string makeBmp(std::uint32_t bits, std::uint32_t compression)
{
    const std::string rows = compression == 0 ? std::string("\1\2\0\0\3\4\0\0", 8) // a row has 4 bytes
                                              : std::string("\1\1\1\2\0\0\1\3\1\4\0\1", 12);
    std::string file = "BM";
    const auto add = [&](std::uint32_t value, int bytes) {
        for (int i = 0; i < bytes; ++i)
            file += char(value >> 8 * i);
    };
    for (const std::uint32_t value : {std::uint32_t(1078 + rows.size()), 0u, 1078u, 40u, 2u, 2u})
        add(value, 4);
    add(1, 2);
    add(bits, 2);
    for (const std::uint32_t value : {compression, std::uint32_t(rows.size()), 2835u, 2835u, 0u, 0u})
        add(value, 4);
    for (std::uint32_t i = 0; i < 256; ++i)
        add(i * 0x010203, 4); // blue three times red
    return file + rows;
}

TEST_F(PictureFile, bmpOfRunsIsReadOfTheirOwnBitsAPixelAndRefusedOfOthers)
{
    for (const std::uint32_t compression : {0u, 1u}) {
        const auto image = decodeImage(bytesOf(makeBmp(8, compression)), "a.bmp");
        ASSERT_TRUE(image) << image.error().message;
        const int expected[] = {3, 4, 1, 2}; // rows from below
        for (int i = 0; i < 4; ++i) {
            EXPECT_EQ(image->bytes8()[4 * i], expected[i]) << compression;
            EXPECT_EQ(image->bytes8()[4 * i + 2], 3 * expected[i]) << compression;
        }
    }
    for (const std::uint32_t bits : {1u, 4u, 16u, 24u, 32u}) // 24 once read in front of the rows, a crash
        EXPECT_FALSE(decodeImage(bytesOf(makeBmp(bits, 1)), "a.bmp")) << bits;
    for (const std::uint32_t bits : {1u, 8u, 16u, 24u, 32u})
        EXPECT_FALSE(decodeImage(bytesOf(makeBmp(bits, 2)), "a.bmp")) << bits;
    const std::string runs = makeBmp(24, 1);
    EXPECT_NE(messageOf(openRows(write("a.bmp", runs))).find("24 bits a pixel, its compression 1 has 8"),
              std::string::npos);
    EXPECT_FALSE(decodeImage(bytesOf(runs.substr(0, 33)), "a.bmp"));
}

TEST_F(PictureFile, bmpOfAnUnknownHeaderIsRefused)
{
    for (const std::uint32_t size : {0u, 11u, 16u, 64u, 0xffffffffu}) // once a size that the memory held
        EXPECT_NE(messageOf(decodeImage(bytesOf(makeBmp(8, 0).replace(14, 4, words({size}))), "a.bmp"))
                      .find("headers of " + std::to_string(size) + " bytes are not read here"),
                  std::string::npos);
    EXPECT_NE(messageOf(decodeImage(bytesOf(makeBmp(8, 0).substr(0, 53)), "a.bmp")).find("its header goes on behind"),
              std::string::npos);
}

TEST_F(PictureFile, bmpOfRunsOfMorePixelsThanTheLimitIsRefusedBeforeTheyAreRead)
{
    LoadLimits limits;
    limits.imageBytes = 16; // 2 x 2 pixels of 4 bytes
    EXPECT_TRUE(decodeImage(bytesOf(makeBmp(8, 1)), "a.bmp", limits));
    for (const std::string& height : {std::string("\0\1\0\0", 4), std::string("\0\xff\xff\xff", 4)}) { // 256, -256
        const std::string runs = makeBmp(8, 1).replace(22, 4, height);
        EXPECT_NE(
            messageOf(decodeImage(bytesOf(runs), "a.bmp", limits)).find("2 x 256 pixels of a byte, the limit is 16"),
            std::string::npos)
            << messageOf(decodeImage(bytesOf(runs), "a.bmp", limits));
    }
}

// ---- JPEG ---------------------------------------------------------------------------------------

std::string makeJpeg(int width, int height, bool progressive)
{
    jpeg_compress_struct jpeg{};
    jpeg_error_mgr errors{};
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_compress(&jpeg);
    unsigned char* bytes = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&jpeg, &bytes, &size);
    jpeg.image_width = JDIMENSION(width);
    jpeg.image_height = JDIMENSION(height);
    jpeg.input_components = 3;
    jpeg.in_color_space = JCS_RGB;
    jpeg_set_defaults(&jpeg);
    jpeg_set_colorspace(&jpeg, JCS_RGB);
    if (progressive)
        jpeg_simple_progression(&jpeg);
    jpeg_start_compress(&jpeg, TRUE);
    std::vector<JSAMPLE> row(std::size_t(width) * 3);
    for (int y = 0; y < height; ++y) {
        for (std::size_t i = 0; i < row.size(); ++i)
            row[i] = JSAMPLE(i * 5 + std::size_t(y) * 3);
        JSAMPROW rows = row.data();
        jpeg_write_scanlines(&jpeg, &rows, 1);
    }
    jpeg_finish_compress(&jpeg);
    jpeg_destroy_compress(&jpeg);
    std::string file(reinterpret_cast<const char*>(bytes), size);
    std::free(bytes);
    return file;
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
    EXPECT_FALSE(decodeImage(bytesOf(makeJpeg(64, 64, true)), "a.jpg", limits));
    EXPECT_TRUE(decodeImage(bytesOf(makeJpeg(64, 64, false)), "a.jpg", limits));
    limits.imageBytes = 24576;
    EXPECT_TRUE(decodeImage(bytesOf(makeJpeg(64, 64, true)), "a.jpg", limits));
}

} // namespace
} // namespace cotan
