// Texels to vectors and back.
#include <gtest/gtest.h>

#include <cmath>

#include "truth/patch.hpp"

namespace cotan {
namespace {

using Format = f64::cotan_normal_format;

Format format(int expansion, int channels, double green = 1, double strength = 1)
{
    Format f;
    f.expansion = expansion;
    f.channels = channels;
    f.green = green;
    f.strength = strength;
    return f;
}

double expandByte(int c, int expansion) { return f64::cotan_expand(c / 255.0, expansion); }

TEST(NormalTexel, exactExpansionMakes128ZeroAnd255One)
{
    EXPECT_NEAR(expandByte(128, COTAN_EXPAND_EXACT), 0, 1e-15);
    EXPECT_NEAR(expandByte(255, COTAN_EXPAND_EXACT), 1, 1e-15);
    EXPECT_NEAR(expandByte(1, COTAN_EXPAND_EXACT), -1, 1e-15);
    EXPECT_EQ(expandByte(0, COTAN_EXPAND_EXACT), -1); // would be -1.0079: clamped
}

TEST(NormalTexel, biasedExpansionTiltsAFlatTexelBy0Point32Degrees)
{
    const glm::dvec3 m = cotan_decode(glm::dvec3(128 / 255.0, 128 / 255.0, 1), format(COTAN_EXPAND_BIASED, 0));
    // each component is 1/255: atan(sqrt(2)/255)
    EXPECT_NEAR(degreesBetween(m, {0, 0, 1}), 0.3178, 1e-4);
    const glm::dvec3 e = cotan_decode(glm::dvec3(128 / 255.0, 128 / 255.0, 1), format(COTAN_EXPAND_EXACT, 0));
    EXPECT_LT(degreesBetween(e, {0, 0, 1}), 1e-12);
}

TEST(NormalTexel, twoChannelDecodeHasNoNanForAnyByte)
{
    for (int channels : {COTAN_CHANNELS_ORTHOGRAPHIC, COTAN_CHANNELS_STEREOGRAPHIC, COTAN_CHANNELS_SLOPE})
        for (int expansion : {COTAN_EXPAND_EXACT, COTAN_EXPAND_BIASED})
            for (int x = 0; x < 256; ++x)
                for (int y = 0; y < 256; ++y) {
                    const glm::vec3 m = cotan_decode(glm::vec3(float(x) / 255, float(y) / 255, 0),
                                                     f32::cotan_normal_format{expansion, channels, 1, 1});
                    ASSERT_TRUE(std::isfinite(glm::length(m)));
                    ASSERT_GT(glm::length(m), 0.5f);
                }
}

TEST(NormalTexel, decodeUndoesEncodeForEveryStorage)
{
    Random random(21);
    for (int expansion : {COTAN_EXPAND_EXACT, COTAN_EXPAND_BIASED, COTAN_EXPAND_SIGNED})
        for (int channels :
             {COTAN_CHANNELS_XYZ, COTAN_CHANNELS_ORTHOGRAPHIC, COTAN_CHANNELS_STEREOGRAPHIC, COTAN_CHANNELS_SLOPE})
            for (double green : {1.0, -1.0})
                for (double strength : {1.0, 2.0})
                    for (int i = 0; i < 50; ++i) {
                        const glm::dvec3 m = tiltedTexel(random, random.range(0, 44));
                        const Format f = format(expansion, channels, green, strength);
                        const glm::dvec3 back = cotan_decode(cotan_encode_texel(m, f), f);
                        EXPECT_LT(degreesBetween(back, m), 1e-6) << expansion << channels;
                    }
}

TEST(NormalTexel, strengthScalesTheSlope)
{
    const glm::dvec3 texel =
        cotan_encode_texel(glm::normalize(glm::dvec3(0.2, 0.1, 1)), format(COTAN_EXPAND_SIGNED, 0));
    const glm::dvec3 m = cotan_decode(texel, format(COTAN_EXPAND_SIGNED, 0, 1, 3));
    EXPECT_NEAR(m.x / m.z, 0.6, 1e-12);
    EXPECT_NEAR(m.y / m.z, 0.3, 1e-12);
}

TEST(NormalTexel, slopeMapStoresTheHeightsDerivatives)
{
    // dh/du = 0.5, dh/dv = -0.25: the normal tilts against the slope
    const glm::dvec3 m = cotan_decode(glm::dvec3(0.5, -0.25, 0), format(COTAN_EXPAND_SIGNED, COTAN_CHANNELS_SLOPE));
    EXPECT_EQ(m, glm::dvec3(-0.5, 0.25, 1));
}

TEST(NormalTexel, orthographicStorageMovesNormalsBelowTheHorizonOntoIt)
{
    const Format f = format(COTAN_EXPAND_SIGNED, COTAN_CHANNELS_ORTHOGRAPHIC);
    const glm::dvec3 back = cotan_decode(cotan_encode_texel(glm::normalize(glm::dvec3(0.6, 0, -0.8)), f), f);
    EXPECT_LT(glm::length(back - glm::dvec3(1, 0, 0)), 1e-9);
}

// The table of four in docs/reference/conventions.md: a dome drawn in an image, on a plane seen upright.
TEST(NormalTexel, greenFlagSetFromTheTableOfFourGivesNoError)
{
    Random random(22);
    for (bool vDown : {true, false})
        for (bool greenUp : {true, false})
            for (int i = 0; i < 200; ++i) {
                // slopes along the image's right and down; x right, y up in the world
                const double right = random.range(-0.4, 0.4), down = random.range(-0.4, 0.4);
                const glm::dvec3 truth = glm::normalize(glm::dvec3(-right, down, 1));
                AffinePatch p;
                p.gradU = {1, 0, 0};
                p.gradV = {0, vDown ? -1 : 1, 0};
                const glm::dvec3 stored(-right, greenUp ? down : -down, 1);
                const bool along = greenUp == !vDown;
                const glm::dvec3 m =
                    cotan_decode(glm::normalize(stored), format(COTAN_EXPAND_SIGNED, 0, along ? 1 : -1));
                const auto d =
                    screenDifferences(PixelCamera::lookAt({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 100), p, {0.1, 0.2, 0});
                EXPECT_LT(degreesBetween(shade(Frame::cotangent, p.normal, d, m), truth), 1e-9);
                const glm::dvec3 wrong(m.x, -m.y, m.z);
                if (std::abs(down) > 0.1) {
                    EXPECT_GT(degreesBetween(shade(Frame::cotangent, p.normal, d, wrong), truth), 5);
                }
            }
}

} // namespace
} // namespace cotan
