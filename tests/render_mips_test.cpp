// Mip chains average the values that texels stand for, not their codes.
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>

#include <glm/gtc/packing.hpp>

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
    // Half the light is sRGB 187.5, not 127.5; alpha is linear. The table may be off by one step.
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
    // 60 degrees and upright: the mean vector is tilted by 30 degrees, sin 30 = 0.5.
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

TEST(RenderMips, nanTexelsDoNotSpread)
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
    // sRGB 0.5 is 0.2140 of linear light (IEC 61966-2-1); alpha is unchanged.
    EXPECT_NEAR(words[0] / 65535.0, 0.21404, 1e-4);
    EXPECT_EQ(words[3], 32768);
}

// Storage of each image type: at full precision if the device can filter that, otherwise as floats.
TEST(RenderMips, formatHasThePrecisionThatTheDeviceCanFilter)
{
    using enum TexelFormat;
    struct Row {
        PixelType type;
        bool filterable16, filterable32;
        TexelFormat color, data;
    };
    for (const Row& row : {Row{PixelType::unorm8, true, true, srgb8, unorm8},
                           {PixelType::unorm8, false, false, srgb8, unorm8},
                           {PixelType::unorm16, true, true, unorm16, unorm16},
                           {PixelType::unorm16, true, false, unorm16, unorm16},
                           {PixelType::unorm16, false, true, float32, float32},
                           {PixelType::unorm16, false, false, float16, float16},
                           {PixelType::float32, true, true, float32, float32},
                           {PixelType::float32, true, false, float16, float16}}) {
        const auto formatOf = [&](TextureKind kind) {
            return texelFormat(row.type, kind, row.filterable16, row.filterable32);
        };
        EXPECT_EQ(formatOf(TextureKind::color), row.color);
        EXPECT_EQ(formatOf(TextureKind::data), row.data);
        EXPECT_EQ(formatOf(TextureKind::normal), row.data);
    }
    for (const auto& [format, bytes] :
         {std::pair(srgb8, 4u), {unorm8, 4u}, {unorm16, 8u}, {float16, 8u}, {float32, 16u}})
        EXPECT_EQ(bytesPerTexel(format), bytes);
}

// The finest level refers to the image's own bytes if these are stored unchanged; otherwise it is converted.
TEST(RenderMips, finestLevelIsTheImageIfItsCodesAreStored)
{
    using enum TexelFormat;
    struct Row {
        PixelType type;
        TextureKind kind;
        TexelFormat format;
        bool opaque, own;
    };
    for (const Row& row : {Row{PixelType::unorm8, TextureKind::color, srgb8, false, true},
                           {PixelType::unorm8, TextureKind::data, unorm8, false, true},
                           {PixelType::unorm8, TextureKind::normal, unorm8, true, true},
                           {PixelType::unorm8, TextureKind::normal, unorm8, false, false},
                           {PixelType::unorm8, TextureKind::data, float16, true, false},
                           {PixelType::unorm16, TextureKind::data, unorm16, false, true},
                           {PixelType::unorm16, TextureKind::normal, unorm16, true, true},
                           {PixelType::unorm16, TextureKind::normal, unorm16, false, false},
                           {PixelType::unorm16, TextureKind::color, unorm16, true, false},
                           {PixelType::unorm16, TextureKind::data, float32, true, false},
                           {PixelType::float32, TextureKind::data, float32, true, false},
                           {PixelType::float32, TextureKind::data, float16, true, false}}) {
        Image image = makeImage(2, 3, row.type);
        for (std::size_t i = 0; i < 4 * image.pixelCount(); ++i) {
            const bool full = i % 4 == 3 && (row.opaque || i > 4); // only the first texel is transparent
            if (row.type == PixelType::unorm8)
                image.bytes8()[i] = full ? 255 : std::uint8_t(40 + 5 * i);
            else if (row.type == PixelType::unorm16)
                image.words()[i] = full ? 65535 : std::uint16_t(10000 + 1000 * i);
            else
                image.floats()[i] = full ? 1 : float(i) / 32;
        }
        MipRequest request;
        request.image = &image;
        request.kind = row.kind;
        request.format = row.format;
        const MipChain chain = buildMips(request);
        const MipLevel& finest = chain.levels.at(0);
        const std::string of = ::testing::PrintToString(int(row.type)) + " " + ::testing::PrintToString(int(row.kind));
        EXPECT_EQ(finest.width, 2) << of;
        EXPECT_EQ(finest.height, 3) << of;
        EXPECT_EQ(finest.data.size(), 6 * bytesPerTexel(row.format)) << of;
        EXPECT_EQ(finest.data.data() == image.data.data(), row.own) << of;
        ASSERT_EQ(chain.levels.size(), 2u) << of; // 2 x 3, 1 x 1
        EXPECT_EQ(chain.levels[1].data.size(), bytesPerTexel(row.format)) << of;
        const auto half = [&](std::size_t i) {
            std::uint16_t word = 0;
            std::memcpy(&word, finest.data.data() + 2 * i, 2);
            return glm::unpackHalf1x16(word);
        };
        const auto number = [&](std::size_t i) {
            float value = 0;
            std::memcpy(&value, finest.data.data() + 4 * i, 4);
            return value;
        };
        for (std::size_t i = 0; i < 24; ++i) { // every component of every texel
            const double value = row.type == PixelType::unorm8 ? image.bytes8()[i] / 255.0
                : row.type == PixelType::unorm16               ? image.words()[i] / 65535.0
                                                               : double(image.floats()[i]);
            const double expected = row.kind == TextureKind::normal && i % 4 == 3 ? 1 : value;
            const double found = row.format == float16 ? double(half(i))
                : row.format == float32                ? double(number(i))
                : row.format == unorm8                 ? byteAt(finest, i) / 255.0
                                                       : expected; // not compared again if it is the image itself
            EXPECT_NEAR(found, expected, row.format == float16 ? 5e-4 : 1e-6) << of << " " << i;
        }
    }
}

// Directions have equal weight whatever their alpha, and texels without a direction have none. The fourth channel of
// smaller levels is the length of the mean: 1 if all directions agree, less the more they differ.
TEST(RenderMips, lengthOfTheMeanNormalIsStored)
{
    const auto levelOf = [](std::initializer_list<std::array<int, 4>> texels) {
        const MipChain chain = chainOf(image8(int(texels.size()), 1, texels), TextureKind::normal);
        std::array<int, 4> last{};
        for (std::size_t c = 0; c < 4; ++c)
            last[c] = byteAt(chain.levels.back(), c);
        return last;
    };
    const auto same = levelOf({{{128 + 76, 128, 128 + 102, 10}}, {{128 + 76, 128, 128 + 102, 200}}});
    EXPECT_NEAR(same[0], 128 + 76, 1); // 3-4-5
    EXPECT_NEAR(same[2], 128 + 102, 1);
    EXPECT_EQ(same[3], 255);
    // Along x and along y: the mean is half way between and has length sqrt(0.5).
    const auto perpendicular = levelOf({{{255, 128, 128, 255}}, {{128, 255, 128, 255}}});
    EXPECT_NEAR(perpendicular[0], 128 + 127 * 0.7071, 1);
    EXPECT_NEAR(perpendicular[1], 128 + 127 * 0.7071, 1);
    EXPECT_NEAR(perpendicular[3], 255 * 0.7071, 1.5);
    // Floats, which have an exact zero.
    const auto meanOf = [](glm::vec3 a, glm::vec3 b) {
        Image image = makeImage(2, 1, PixelType::float32);
        for (int c = 0; c < 3; ++c) {
            image.floats()[c] = a[c];
            image.floats()[4 + c] = b[c];
        }
        Convention format;
        format.expansion = Expansion::signedValues;
        const MipChain chain = chainOf(image, TextureKind::normal, format);
        glm::vec4 mean(0);
        std::memcpy(&mean, chain.levels.at(1).data.data(), sizeof mean);
        return mean;
    };
    EXPECT_EQ(meanOf({2, 0, 0}, {-3, 0, 0}), glm::vec4(0, 0, 1, 0)); // opposite directions cancel: straight up
    EXPECT_EQ(meanOf({0, 5, 0}, {0, 0, 0}), glm::vec4(0, 1, 0, 1));  // the second has no direction
    EXPECT_EQ(meanOf({0, 0, 0}, {0, 0, 0}), glm::vec4(0, 0, 1, 1));
}

TEST(RenderMips, heightsAndWidthsAreHalvedEachByItself)
{
    Image image = makeImage(5, 3, PixelType::unorm8);
    for (std::size_t i = 0; i < image.pixelCount(); ++i)
        image.bytes8()[4 * i] = std::uint8_t(10 * (i % 5) + 60 * (i / 5));
    const MipChain chain = chainOf(image, TextureKind::data);
    ASSERT_EQ(chain.levels.size(), 3u);
    EXPECT_EQ(chain.levels[1].width, 2);
    EXPECT_EQ(chain.levels[1].height, 1);
    // Along a row (0 + 10 + 20 / 2) / 2.5 = 8 and (20 / 2 + 30 + 40) / 2.5 = 32; rows add their mean, 60.
    EXPECT_EQ(byteAt(chain.levels[1], 0), 68);
    EXPECT_EQ(byteAt(chain.levels[1], 4), 92);
    EXPECT_EQ(byteAt(chain.levels[2], 0), 80);
    const MipChain high = chainOf(makeImage(1, 4, PixelType::unorm8), TextureKind::data);
    ASSERT_EQ(high.levels.size(), 3u);
    EXPECT_EQ(high.levels[1].height, 2);
    EXPECT_EQ(high.levels[1].width, 1);
}

} // namespace cotan
