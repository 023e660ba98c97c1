// normal.h against results by hand: one texel with different x, y and z through every storage, both ways.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "cotan/portable.hpp"

namespace cotan {
namespace {

f64::cotan_normal_format stored(int expansion, int channels, double green = 1, double strength = 1)
{
    f64::cotan_normal_format f;
    f.expansion = expansion;
    f.channels = channels;
    f.green = green;
    f.strength = strength;
    return f;
}

void expectNear(glm::dvec3 found, glm::dvec3 expected, const char* what)
{
    EXPECT_NEAR(found.x, expected.x, 1e-12) << what;
    EXPECT_NEAR(found.y, expected.y, 1e-12) << what;
    EXPECT_NEAR(found.z, expected.z, 1e-12) << what;
}

TEST(NormalCodec, expansionsFollowTheirFormulasAndClampAtMinusOne)
{
    EXPECT_NEAR(f64::cotan_expand(200 / 255.0, COTAN_EXPAND_EXACT), 72 / 127.0, 1e-12);
    EXPECT_NEAR(f64::cotan_expand(90 / 255.0, COTAN_EXPAND_EXACT), -38 / 127.0, 1e-12);
    EXPECT_NEAR(f64::cotan_expand(200 / 255.0, COTAN_EXPAND_BIASED), 145 / 255.0, 1e-12);
    EXPECT_NEAR(f64::cotan_expand(90 / 255.0, COTAN_EXPAND_BIASED), -75 / 255.0, 1e-12);
    EXPECT_EQ(f64::cotan_expand(-0.25, COTAN_EXPAND_SIGNED), -0.25);
    EXPECT_EQ(f64::cotan_expand(-128 / 127.0, COTAN_EXPAND_SIGNED), -1); // snorm's lowest value
    EXPECT_EQ(f64::cotan_expand(0, COTAN_EXPAND_BIASED), -1);
}

TEST(NormalCodec, compressionIsTheInverseAndClampsAtBothEnds)
{
    for (const int expansion : {COTAN_EXPAND_EXACT, COTAN_EXPAND_BIASED, COTAN_EXPAND_SIGNED}) {
        for (const double x : {-1.0, -0.3, 0.0, 0.45, 1.0})
            EXPECT_NEAR(f64::cotan_expand(f64::cotan_compress(x, expansion), expansion), x, 1e-12) << expansion;
        EXPECT_EQ(f64::cotan_compress(1.5, expansion), f64::cotan_compress(1, expansion));
        EXPECT_EQ(f64::cotan_compress(-1.5, expansion), f64::cotan_compress(-1, expansion));
    }
    EXPECT_NEAR(f64::cotan_compress(-0.5, COTAN_EXPAND_BIASED), 0.25, 1e-12);
    EXPECT_NEAR(f64::cotan_compress(-1, COTAN_EXPAND_EXACT), 1 / 255.0, 1e-12);
}

TEST(NormalCodec, everyStorageEncodesAKnownNormal)
{
    // (2, -3, 6)/7: z from x and y; over 1 + z = 13/7; slopes are the negative of x/z and y/z.
    const glm::dvec3 m(2 / 7.0, -3 / 7.0, 6 / 7.0);
    struct Storage {
        const char* name;
        int channels;
        glm::dvec3 texel, decoded;
    };
    const std::array<Storage, 4> storages = {{
        {"xyz", COTAN_CHANNELS_XYZ, m, m},
        {"orthographic", COTAN_CHANNELS_ORTHOGRAPHIC, {m.x, m.y, 0}, m},
        {"stereographic", COTAN_CHANNELS_STEREOGRAPHIC, {2 / 13.0, -3 / 13.0, 0}, m},
        {"slope", COTAN_CHANNELS_SLOPE, {-1 / 3.0, 0.5, 0}, {1 / 3.0, -0.5, 1}},
    }};
    for (const Storage& s : storages) {
        const auto f = stored(COTAN_EXPAND_SIGNED, s.channels);
        expectNear(f64::cotan_encode_texel(m, f), s.texel, s.name);
        expectNear(f64::cotan_decode(s.texel, f), s.decoded, s.name);
        // Reversed green negates y alone; in two-channel maps z is the code of zero.
        const auto down = stored(COTAN_EXPAND_SIGNED, s.channels, -1);
        expectNear(f64::cotan_encode_texel(m, down), {s.texel.x, -s.texel.y, s.texel.z}, s.name);
        expectNear(f64::cotan_decode(s.texel, down), {s.decoded.x, -s.decoded.y, s.decoded.z}, s.name);
        // Strength multiplies x and y after decoding.
        expectNear(f64::cotan_decode(s.texel, stored(COTAN_EXPAND_SIGNED, s.channels, 1, 3)),
                   {3 * s.decoded.x, 3 * s.decoded.y, s.decoded.z}, s.name);
        expectNear(f64::cotan_decode(s.texel, stored(COTAN_EXPAND_SIGNED, s.channels, -1, 0)), {0, 0, s.decoded.z},
                   s.name);
        const glm::dvec3 middle = f64::cotan_encode_texel(m, stored(COTAN_EXPAND_EXACT, s.channels));
        if (s.channels != COTAN_CHANNELS_XYZ) {
            EXPECT_NEAR(middle.z, 128 / 255.0, 1e-12) << s.name;
        }
        EXPECT_NEAR(middle.y, s.texel.y * 127 / 255 + 128 / 255.0, 1e-12) << s.name;
    }
}

TEST(NormalCodec, strengthIsDividedOutOfTheStoredSlopes)
{
    // Slopes (1/3, -1/2) at strength 2 are stored as (1/6, -1/4).
    const glm::dvec3 m(2 / 7.0, -3 / 7.0, 6 / 7.0), half = glm::normalize(glm::dvec3(1, -1.5, 6));
    expectNear(f64::cotan_encode_texel(m, stored(COTAN_EXPAND_SIGNED, COTAN_CHANNELS_XYZ, 1, 2)), half, "xyz");
    expectNear(f64::cotan_encode_texel(m, stored(COTAN_EXPAND_SIGNED, COTAN_CHANNELS_SLOPE, -1, 2)),
               {-1 / 6.0, -0.25, 0}, "slope");
}

TEST(NormalCodec, unstorableNormalsAreMovedToTheRim)
{
    // Below the horizon, x to y as 3:4.
    const glm::dvec3 below = glm::normalize(glm::dvec3(0.6, -0.8, -0.5));
    expectNear(f64::cotan_encode_texel(below, stored(COTAN_EXPAND_SIGNED, COTAN_CHANNELS_ORTHOGRAPHIC)), {0.6, -0.8, 0},
               "orthographic");
    expectNear(f64::cotan_encode_texel(below, stored(COTAN_EXPAND_SIGNED, COTAN_CHANNELS_SLOPE)), {-1, 1, 0}, "slope");
    // Steeper than 45 degrees along y only.
    expectNear(f64::cotan_encode_texel(glm::normalize(glm::dvec3(0.2, -3, 1)),
                                       stored(COTAN_EXPAND_SIGNED, COTAN_CHANNELS_SLOPE)),
               {-0.2, 1, 0}, "slope");
    // xyz and stereographic store everything except (0,0,-1).
    expectNear(f64::cotan_encode_texel(below, stored(COTAN_EXPAND_SIGNED, COTAN_CHANNELS_XYZ)), below, "xyz");
    const glm::dvec2 p = f64::cotan_to_stereographic({0, 0, -1});
    EXPECT_EQ(p, glm::dvec2(0));
    EXPECT_NEAR(f64::cotan_to_stereographic({0.6, -0.8, -1}).y, -800, 1e-6); // z is clamped to -0.999
    EXPECT_EQ(f64::cotan_orthographic_z({0.8, -0.9}), 0);                    // longer than one: no NaN
    EXPECT_NEAR(f64::cotan_orthographic_z({0.48, -0.64}), 0.6, 1e-12);
    expectNear(f64::cotan_from_stereographic({2, -1}), glm::dvec3(4, -2, -4) / 6.0, "outside the unit circle");
    expectNear(f64::cotan_from_stereographic({0.5, -0.25}), glm::dvec3(16, -8, 11) / 21.0, "inside");
}

} // namespace
} // namespace cotan
