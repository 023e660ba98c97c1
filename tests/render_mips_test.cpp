// Mip chains: what is averaged is what the texels mean.
#include <array>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>

#include "cotan/portable.hpp"
#include "texture_mips.hpp"

namespace cotan {

namespace {

Image image8(int width, int height, std::initializer_list<std::array<int, 4>> texels)
{
    Image image = makeImage(width, height, PixelType::unorm8);
    std::uint8_t* p = image.bytes8();
    for (const std::array<int, 4>& t : texels)
        for (const int c : t)
            *p++ = std::uint8_t(c);
    return image;
}

MipChain chainOf(const Image& image, TextureKind kind, Convention format = {})
{
    MipRequest request;
    request.image = &image;
    request.kind = kind;
    request.normalFormat = format;
    request.format = texelFormat(image.type, kind, /*filterable16*/ true, /*filterable32*/ true);
    return buildMips(request);
}

int byteAt(const MipLevel& level, std::size_t i) { return int(level.data[i]); }

} // namespace

TEST(RenderMips, colourIsAveragedInLinearLight)
{
    const Image image = image8(2, 1, {{{0, 0, 0, 0}}, {{255, 255, 255, 255}}});
    const MipChain chain = chainOf(image, TextureKind::color);
    ASSERT_EQ(chain.levels.size(), 2u);
    EXPECT_EQ(chain.format, TexelFormat::srgb8);
    // Half the light is sRGB 187.5, not 127.5; alpha is linear. One step for the table.
    EXPECT_NEAR(byteAt(chain.levels[1], 0), 188, 1);
    EXPECT_NEAR(byteAt(chain.levels[1], 3), 128, 1);
}

TEST(RenderMips, dataIsAveragedAsNumbers)
{
    const Image image = image8(2, 1, {{{0, 10, 200, 0}}, {{255, 20, 100, 255}}});
    const MipChain chain = chainOf(image, TextureKind::data);
    EXPECT_NEAR(byteAt(chain.levels[1], 0), 128, 1);
    EXPECT_EQ(byteAt(chain.levels[1], 1), 15);
    EXPECT_EQ(byteAt(chain.levels[1], 2), 150);
}

TEST(RenderMips, oppositeTiltsAverageToAUnitNormalStraightUp)
{
    // 45 degrees to either side: the plain mean of z would be 0.707.
    const Image image = image8(2, 1, {{{128 + 90, 128, 128 + 90, 255}}, {{128 - 90, 128, 128 + 90, 255}}});
    const MipChain chain = chainOf(image, TextureKind::normal);
    EXPECT_EQ(byteAt(chain.levels[1], 0), 128);
    EXPECT_EQ(byteAt(chain.levels[1], 1), 128);
    EXPECT_EQ(byteAt(chain.levels[1], 2), 255);
}

TEST(RenderMips, twoChannelNormalsAreAveragedAsVectors)
{
    Convention format;
    format.channels = Channels::orthographic;
    // 60 degrees and upright: the mean vector leans 30 degrees, sin 30 = 0.5.
    const Image image = image8(2, 1, {{{128 + 110, 128, 0, 255}}, {{128, 128, 0, 255}}});
    const MipChain chain = chainOf(image, TextureKind::normal, format);
    EXPECT_NEAR(byteAt(chain.levels[1], 0), 128 + 127 * 0.5, 1.0);
}

TEST(RenderMips, oddSizesAreAveragedByArea)
{
    const Image image = image8(3, 1, {{{30, 0, 0, 0}}, {{60, 0, 0, 0}}, {{120, 0, 0, 0}}});
    const MipChain chain = chainOf(image, TextureKind::data);
    ASSERT_EQ(chain.levels.size(), 2u);
    EXPECT_EQ(byteAt(chain.levels[1], 0), 70);

    const Image five =
        image8(5, 1, {{{10, 0, 0, 0}}, {{20, 0, 0, 0}}, {{30, 0, 0, 0}}, {{40, 0, 0, 0}}, {{50, 0, 0, 0}}});
    const MipChain halves = chainOf(five, TextureKind::data);
    ASSERT_EQ(halves.levels.size(), 3u);
    EXPECT_EQ(halves.levels[1].width, 2);
    EXPECT_EQ(byteAt(halves.levels[1], 0), 18); // (10 + 20 + 30/2) / 2.5
    EXPECT_EQ(byteAt(halves.levels[1], 4), 42);
    EXPECT_EQ(byteAt(halves.levels[2], 0), 30);
}

TEST(RenderMips, levelsAboveTheLimitAreLeftOut)
{
    const Image image = makeImage(16, 4, PixelType::unorm8);
    MipRequest request;
    request.image = &image;
    request.largest = 4;
    const MipChain chain = buildMips(request);
    ASSERT_FALSE(chain.levels.empty());
    EXPECT_EQ(chain.levels[0].width, 4);
    EXPECT_EQ(chain.levels[0].height, 1);
    EXPECT_EQ(chain.levels.size(), 3u);
}

TEST(RenderMips, texelsThatAreNotNumbersDoNotSpread)
{
    Image image = makeImage(2, 1, PixelType::float32);
    image.floats()[0] = std::numeric_limits<float>::quiet_NaN();
    image.floats()[4] = 1.0f;
    const MipChain chain = chainOf(image, TextureKind::data);
    float value = 0;
    std::memcpy(&value, chain.levels[1].data.data(), sizeof value);
    EXPECT_FLOAT_EQ(value, 0.5f);
}

TEST(RenderMips, sixteenBitColourIsStoredLinear)
{
    Image image = makeImage(1, 1, PixelType::unorm16);
    for (int c = 0; c < 4; ++c)
        image.words()[c] = 32768;
    const MipChain chain = chainOf(image, TextureKind::color);
    ASSERT_EQ(chain.format, TexelFormat::unorm16);
    std::uint16_t words[4];
    std::memcpy(words, chain.levels[0].data.data(), sizeof words);
    // sRGB 0.5 is 0.2140 of the light (IEC 61966-2-1); alpha stays.
    EXPECT_NEAR(words[0] / 65535.0, 0.21404, 1e-4);
    EXPECT_EQ(words[3], 32768);
}

} // namespace cotan
