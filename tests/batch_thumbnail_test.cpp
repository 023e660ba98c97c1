// Thumbnails of large images, of all kinds of pixels.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "batch/record.hpp"
#include "cotan/image.hpp"
#include "run_tool.hpp"

namespace cotan {
namespace {

using namespace app;
using namespace test;

class BatchThumbnail : public ::testing::Test {
protected:
    // Decodes the thumbnail of a file; returns an empty image if there is no thumbnail.
    Image of(const std::string& file)
    {
        const auto thumbnail = thumbnailOf(folder / file);
        if (!thumbnail)
            return {};
        std::ofstream(folder / "base64") << thumbnail->jpeg;
        const std::string f = folder.path().string();
        EXPECT_EQ(std::system(("base64 -d " + f + "/base64 > " + f + "/read.jpg").c_str()), 0);
        bytes = readWhole(folder / "read.jpg").size();
        auto image = readImage(folder / "read.jpg");
        EXPECT_TRUE(image);
        EXPECT_EQ(image->width, thumbnail->width);
        EXPECT_EQ(image->height, thumbnail->height);
        return std::move(*image);
    }

    // The thumbnail's colour for a uniform image of this type; `color` is red, green, blue and alpha.
    glm::ivec3 colorOf(const std::string& file, PixelType type, std::array<float, 4> color)
    {
        Image image = makeImage(16, 16, type);
        for (std::size_t i = 0; i < 4 * image.pixelCount(); ++i) {
            const float c = color[i % 4];
            if (type == PixelType::unorm8)
                image.bytes8()[i] = std::uint8_t(std::lround(c * 255));
            else if (type == PixelType::unorm16)
                image.words()[i] = std::uint16_t(std::lround(c * 65535));
            else
                image.floats()[i] = c;
        }
        EXPECT_TRUE(writeImage(folder / file, image));
        return colorAt(of(file), 8, 8);
    }

    static glm::ivec3 colorAt(const Image& image, int x, int y)
    {
        if (!hasPixels(image))
            return {};
        const std::uint8_t* p = image.bytes8() + 4 * (y * image.width + x);
        return {p[0], p[1], p[2]};
    }

    static void expectNear(glm::ivec3 found, glm::ivec3 expected)
    {
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(found[c], expected[c], 3) << c; // error of JPEG compression
    }

    TemporaryFolder folder;
    std::size_t bytes = 0;
};

TEST_F(BatchThumbnail, fitsInto64PixelsAndKeepsTheAspectRatio)
{
    for (const auto& [from, to] : {std::pair(glm::ivec2(64, 64), glm::ivec2(64, 64)),
                                   {{65, 13}, {64, 13}},
                                   {{256, 64}, {64, 16}},
                                   {{50, 200}, {16, 64}},
                                   {{3, 2}, {3, 2}},
                                   {{1, 300}, {1, 64}},
                                   {{300, 1}, {64, 1}}}) {
        ASSERT_TRUE(writeImage(folder / "a.png", makeImage(from.x, from.y, PixelType::unorm8)));
        const Image image = of("a.png");
        EXPECT_EQ(glm::ivec2(image.width, image.height), to) << from.x << " " << from.y;
    }
    std::ofstream(folder / "text.png") << "no picture";
    EXPECT_FALSE(hasPixels(of("text.png")));
    EXPECT_FALSE(hasPixels(of("missing.png")));
}

TEST_F(BatchThumbnail, averagesThePixelsThatFallOnEachPixel)
{
    // Four quarters; the last one has stripes that are averaged.
    Image image = makeImage(256, 128, PixelType::unorm8);
    for (int y = 0; y < 128; ++y)
        for (int x = 0; x < 256; ++x) {
            std::uint8_t* p = image.bytes8() + 4 * (y * 256 + x);
            const bool right = x >= 128, below = y >= 64;
            const glm::ivec3 c = right && below ? glm::ivec3(x % 2 ? 240 : 40)
                : right                         ? glm::ivec3(200, 180, 160)
                : below                         ? glm::ivec3(60, 80, 100)
                                                : glm::ivec3(90, 90, 120);
            for (int k = 0; k < 3; ++k)
                p[k] = std::uint8_t(c[k]);
            p[3] = 255;
        }
    ASSERT_TRUE(writeImage(folder / "a.png", image));
    const Image small = of("a.png");
    ASSERT_EQ(small.width, 64);
    ASSERT_EQ(small.height, 32);
    expectNear(colorAt(small, 8, 4), {90, 90, 120});
    expectNear(colorAt(small, 56, 4), {200, 180, 160});
    expectNear(colorAt(small, 8, 28), {60, 80, 100});
    expectNear(colorAt(small, 56, 28), glm::ivec3(140));
    // A JPEG of one colour takes 623 bytes with the standard's tables, and less with optimised ones.
    expectNear(colorOf("even.png", PixelType::unorm8, {0.4f, 0.4f, 0.4f, 1}), glm::ivec3(102));
    EXPECT_LT(bytes, 400u);
}

TEST_F(BatchThumbnail, showsTransparencyOverGreyAndNonColoursAsBlack)
{
    expectNear(colorOf("a.png", PixelType::unorm8, {1, 1, 1, 0.25f}), glm::ivec3(159)); // 0.25 + 0.75 / 2
    expectNear(colorOf("b.png", PixelType::unorm16, {0, 0, 0, 0.5f}), glm::ivec3(64));
    expectNear(colorOf("c.png", PixelType::unorm16, {0.7f, 0.6f, 0.5f, 1}), {179, 153, 128});
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();
    expectNear(colorOf("d.exr", PixelType::float32, {0.5f, 0.5f, 0.5f, 1}), glm::ivec3(128));
    expectNear(colorOf("e.exr", PixelType::float32, {7, 7, 7, 1}), glm::ivec3(255));
    expectNear(colorOf("f.exr", PixelType::float32, {-7, -7, -7, 1}), glm::ivec3(0));
    expectNear(colorOf("g.exr", PixelType::float32, {nan, infinite, -infinite, 1}), glm::ivec3(0));
}

} // namespace
} // namespace cotan
