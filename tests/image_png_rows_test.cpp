// PNG files that are written quickly: zlib and libpng judge what our own compression writes.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>

#include "core/loops.hpp"
#include "cotan/image.hpp"
#include "image/pixel_deflate.hpp"

namespace cotan {
namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::uint8_t>;

// Rows compressed in parts of `rowsOfPart`, as a stream of zlib.
Bytes packed(Bytes rows, std::size_t rowBytes, std::size_t pixelBytes, std::size_t rowsOfPart)
{
    const std::size_t size = rows.size(), part = rowsOfPart * rowBytes;
    uLong sum = adler32(adler32(0, nullptr, 0), rows.data(), uInt(size));
    rows.resize(size + kReadAhead, 0xa5);
    Bytes stream{0x78, 0x01};
    for (std::size_t at = 0; at < size; at += part)
        deflatePixels({&rows[at], std::min(part, size - at)}, rowBytes, pixelBytes, stream);
    stream.insert(stream.end(), {1, 0, 0, 0xff, 0xff});
    for (int shift = 24; shift >= 0; shift -= 8)
        stream.push_back(std::uint8_t(sum >> shift));
    return stream;
}

testing::AssertionResult comesBack(const Bytes& rows, std::size_t rowBytes, std::size_t pixelBytes,
                                   std::size_t rowsOfPart)
{
    const Bytes stream = packed(rows, rowBytes, pixelBytes, rowsOfPart);
    Bytes back(rows.size() + 1);
    uLongf got = back.size();
    const int done = uncompress(back.data(), &got, stream.data(), stream.size());
    back.resize(got);
    if (done == Z_OK && back == rows)
        return testing::AssertionSuccess();
    return testing::AssertionFailure() << "zlib: " << done << ", " << got << " bytes of " << rows.size()
                                       << ", pixels of " << pixelBytes << ", rows of " << rowBytes << ", parts of "
                                       << rowsOfPart;
}

TEST(PixelDeflate, zlibReadsBackWhatWasWritten)
{
    std::mt19937 random(1);
    for (int i = 0; i < 600; ++i) {
        const std::size_t pixelBytes = std::vector<std::size_t>{3, 4, 6, 8}[random() % 4];
        const std::size_t width = 1 + random() % (i % 10 == 0 ? 3000 : 60), height = 1 + random() % 40;
        Bytes rows((1 + width * pixelBytes) * height);
        const unsigned mask = std::vector<unsigned>{0, 1, 7, 31, 255}[random() % 5];
        for (std::uint8_t& b : rows)
            b = std::uint8_t(random() % 4 == 0 ? random() & mask : 0);
        if (i % 7 == 0) // repeats itself after some texels
            for (std::size_t at = 400; at < rows.size(); ++at)
                rows[at] = random() % 300 == 0 ? rows[at] : rows[at - 396];
        ASSERT_TRUE(comesBack(rows, 1 + width * pixelBytes, pixelBytes, 1 + random() % height)) << i;
    }
}

TEST(PixelDeflate, codesOfMoreThan15BitsAreShortened)
{
    // The Huffman codes of counts that are Fibonacci numbers are as long as there are symbols.
    Bytes row;
    for (std::size_t symbol = 0, count = 1, next = 1; symbol < 22; ++symbol) {
        row.insert(row.end(), count, std::uint8_t(7 * symbol));
        count = std::exchange(next, count + next);
    }
    row.resize(row.size() / 3 * 3);
    std::shuffle(row.begin(), row.end(), std::mt19937(1));
    row.insert(row.begin(), 2);
    EXPECT_TRUE(comesBack(row, row.size(), 3, 1));
}

TEST(PixelDeflate, longRowsOfOneColourAndLongDistancesAreReadBack)
{
    Bytes flat(1 + 3 * 400'000, 9);
    EXPECT_TRUE(comesBack(flat, flat.size(), 3, 1));
    EXPECT_LT(packed(flat, flat.size(), 3, 1).size(), 4000u);
    // Pixels that repeat after exactly 32768 bytes, the furthest that the format allows, and after more.
    std::mt19937 random(2);
    for (const std::size_t apart : {32768 - 8, 32768, 32768 + 8}) {
        Bytes row(1 + 8 * 20'000);
        std::generate(row.begin(), row.begin() + std::ptrdiff_t(1 + apart), random);
        std::copy(row.begin() + 1, row.end() - std::ptrdiff_t(apart), row.begin() + 1 + std::ptrdiff_t(apart));
        EXPECT_TRUE(comesBack(row, row.size(), 8, 1)) << apart;
    }
}

TEST(PixelDeflate, aSmoothMapIsNoLargerThanByTheSecondLevelOfZlib)
{
    constexpr std::size_t kWidth = 512;
    Bytes rows;
    std::vector<int> above(3 * kWidth);
    for (std::size_t y = 0; y < 256; ++y) {
        rows.push_back(2);
        for (std::size_t i = 0; i < above.size(); ++i) { // each row minus that above
            const double u = double(i / 3) / 20, v = double(y) / 17;
            const double texel = i % 3 == 0 ? std::sin(u + v) : i % 3 == 1 ? std::cos(u * v / 9) : 1 + std::sin(u) / 4;
            const int code = int(127.5 + 90 * texel);
            rows.push_back(std::uint8_t(code - std::exchange(above[i], code)));
        }
    }
    Bytes byZlib(compressBound(rows.size()));
    uLongf size = byZlib.size();
    ASSERT_EQ(compress2(byZlib.data(), &size, rows.data(), rows.size(), 2), Z_OK);
    EXPECT_LE(packed(rows, 1 + 3 * kWidth, 3, 64).size(), size);
}

std::string bytesOf(const fs::path& file)
{
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

TEST(PngRows, bytesDoNotDependOnThreadsAndLibpngReadsThem)
{
    const fs::path folder = fs::temp_directory_path() / ("cotan_png_rows_" + std::to_string(::getpid()));
    fs::create_directories(folder);
    std::mt19937 random(3);
    for (const PixelType type : {PixelType::unorm8, PixelType::unorm16})
        for (const bool alpha : {false, true}) {
            Image image = makeImage(301, 697, type); // several parts
            for (std::byte& b : image.data)
                b = std::byte(random() % 3 == 0 ? random() : 77);
            const std::size_t one = image.bytesPerPixel() / 4;
            for (std::size_t i = 0; i < image.pixelCount() && !alpha; ++i)
                std::memset(&image.data[(4 * i + 3) * one], 0xff, one);
            image.frame = "smooth";
            const fs::path file = folder / "a.png";
            ASSERT_TRUE(withThreads(1, [&] { return writeImage(file, image); }));
            const std::string bytes = bytesOf(file);
            ASSERT_TRUE(withThreads(3, [&] { return writeImage(file, image); }));
            EXPECT_TRUE(bytesOf(file) == bytes);
            const auto back = readImage(file);
            ASSERT_TRUE(back) << back.error().message;
            EXPECT_TRUE(back->data == image.data && back->type == type && back->frame == "smooth");
            EXPECT_EQ(back->channels, alpha ? 4 : 3);

            const auto rows = createRows(file, {image.width, image.height, type, alpha, false, "smooth"});
            ASSERT_TRUE(rows);
            const std::size_t rowBytes = std::size_t(image.width) * image.bytesPerPixel();
            for (int y = 0, height = 0; y < image.height; y += height) {
                height = std::min(1 + int(random() % 200), image.height - y);
                Image strip = makeImage(image.width, height, type);
                std::memcpy(strip.data.data(), &image.data[std::size_t(y) * rowBytes], strip.data.size());
                ASSERT_TRUE((*rows)->write(strip));
            }
            ASSERT_TRUE((*rows)->finish());
            const auto byStrips = readImage(file);
            ASSERT_TRUE(byStrips) << byStrips.error().message;
            EXPECT_TRUE(byStrips->data == image.data && byStrips->frame == "smooth");
        }
    fs::remove_all(folder);
}

} // namespace
} // namespace cotan
