// PNG files whose rows are compressed in parts: libpng reads what was written.
#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

#include "core/loops.hpp"
#include "cotan/image.hpp"

namespace cotan {
namespace {

namespace fs = std::filesystem;

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
