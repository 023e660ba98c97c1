// The reliefs and their normal maps against calculus.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "cotan/portable.hpp"
#include "cotan/scene.hpp"

namespace {

using cotan::HeightSample;
using cotan::Relief;
using cotan::relief;

constexpr Relief kReliefs[] = {Relief::domes, Relief::bricks, Relief::waves};

cotan::f64::cotan_vec3 decodedTexel(const cotan::Image& image, int x, int y)
{
    const std::uint8_t* p = image.bytes8() + (std::size_t(y) * std::size_t(image.width) + std::size_t(x)) * 4;
    const cotan::f64::cotan_normal_format gltf{COTAN_EXPAND_EXACT, COTAN_CHANNELS_XYZ, -1, 1};
    return cotan::f64::cotan_decode({p[0] / 255.0, p[1] / 255.0, p[2] / 255.0}, gltf);
}

TEST(Reliefs, derivativesEqualCentralDifferences)
{
    // The maximum second derivative is that of brick edges, 6 * 0.009 / 0.014^2 = 276. Where it jumps, a central
    // difference over +-1e-6 has an error of up to 276 * 1e-6 / 4 = 7e-5; rounding adds 1e-16 / 1e-6.
    const double step = 1e-6, tolerance = 1e-4;
    std::mt19937 random(1);
    std::uniform_real_distribution<double> coordinate(-2, 2);
    for (const Relief kind : kReliefs)
        for (int i = 0; i < 20000; ++i) {
            const double u = coordinate(random), v = coordinate(random);
            const HeightSample s = relief(kind, u, v);
            const double du = relief(kind, u + step, v).h - relief(kind, u - step, v).h;
            const double dv = relief(kind, u, v + step).h - relief(kind, u, v - step).h;
            ASSERT_NEAR(s.hu, du / (2 * step), tolerance) << int(kind) << " at " << u << ' ' << v;
            ASSERT_NEAR(s.hv, dv / (2 * step), tolerance) << int(kind) << " at " << u << ' ' << v;
        }
}

TEST(Reliefs, repeatWithTheUnitSquare)
{
    std::mt19937 random(2);
    std::uniform_real_distribution<double> coordinate(0, 1);
    for (const Relief kind : kReliefs)
        for (int i = 0; i < 1000; ++i) {
            const double u = coordinate(random), v = coordinate(random);
            const HeightSample a = relief(kind, u, v), b = relief(kind, u + 3, v - 2);
            // Rounding of u + 3 (2e-16 relative) times the maximum second derivative, 276.
            ASSERT_NEAR(a.h, b.h, 1e-12);
            ASSERT_NEAR(a.hu, b.hu, 1e-12);
            ASSERT_NEAR(a.hv, b.hv, 1e-12);
        }
}

TEST(Reliefs, haveAMaximumSlopeBetweenHalfAndOne)
{
    for (const Relief kind : kReliefs) {
        double steepest = 0;
        for (int y = 0; y < 400; ++y)
            for (int x = 0; x < 400; ++x) {
                const HeightSample s = relief(kind, x / 400.0, y / 400.0);
                steepest = std::max(steepest, std::hypot(s.hu, s.hv));
            }
        EXPECT_GT(steepest, 0.5) << int(kind);
        EXPECT_LT(steepest, 1.0) << int(kind);
    }
}

TEST(Reliefs, domesAreSteepestAtRadiusOverRootThree)
{
    // h = a (1 - r^2)^2 with a = 0.6 R: |dh/d(rR)| = 0.6 * 4 r (1 - r^2), at most 0.6 * 8/(3 sqrt 3).
    const double r = 0.1 / std::numbers::sqrt3;
    const HeightSample s = relief(Relief::domes, 0.125 + r, 0.125);
    EXPECT_NEAR(s.hu, -0.6 * 8 / (3 * std::numbers::sqrt3), 1e-12);
    EXPECT_NEAR(relief(Relief::domes, 0.125, 0.125).h, 0.06, 1e-15);
    EXPECT_EQ(relief(Relief::domes, 0.25, 0.25).h, 0);
}

TEST(Reliefs, everySecondCourseOfBricksIsShiftedByHalfABrick)
{
    for (double u = 0; u < 1; u += 1.0 / 64)
        EXPECT_NEAR(relief(Relief::bricks, u, 0.03).h, relief(Relief::bricks, u + 0.125, 0.155).h, 1e-15);
    EXPECT_EQ(relief(Relief::bricks, 0.0, 0.0625).h, 0);       // a joint
    EXPECT_GT(relief(Relief::bricks, 0.125, 0.0625).h, 0.008); // a brick
}

TEST(ReliefMaps, decodeToTheAnalyticNormal)
{
    // Rounding moves each component by at most 1/254, the vector by at most sqrt(3)/254 = 0.0068 = 0.39 degrees.
    const int side = 128;
    for (const Relief kind : kReliefs) {
        const cotan::Image map = cotan::makeReliefMap(kind, side);
        ASSERT_EQ(map.width, side);
        ASSERT_EQ(map.height, side);
        ASSERT_EQ(map.type, cotan::PixelType::unorm8);
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                const HeightSample s = relief(kind, (x + 0.5) / side, (y + 0.5) / side);
                const auto truth = glm::normalize(glm::dvec3(-s.hu, -s.hv, 1));
                const auto found = glm::normalize(decodedTexel(map, x, y));
                const double degrees =
                    std::atan2(glm::length(glm::cross(truth, found)), glm::dot(truth, found)) * 180 / std::numbers::pi;
                ASSERT_LT(degrees, 0.4) << int(kind) << " at " << x << ' ' << y;
            }
    }
}

TEST(ReliefMaps, flatTexelsAreExact)
{
    const cotan::Image map = cotan::makeReliefMap(Relief::domes, 64);
    const std::uint8_t* corner = map.bytes8();
    EXPECT_EQ(corner[0], 128);
    EXPECT_EQ(corner[1], 128);
    EXPECT_EQ(corner[2], 255);
    EXPECT_EQ(corner[3], 255);
}

TEST(ReliefMaps, greenIsBrightOnTheUpperSideOfADome)
{
    // The dome at (1/8, 1/8) of a 64 x 64 map is centred on the corner between texels 7 and 8.
    const cotan::Image map = cotan::makeReliefMap(Relief::domes, 64);
    const auto texel = [&](int x, int y) { return map.bytes8() + (y * 64 + x) * 4; };
    EXPECT_GT(texel(8, 4)[1], 200); // above the centre: faces up in the image, green against +v
    EXPECT_LT(texel(8, 11)[1], 55);
    EXPECT_LT(texel(4, 8)[0], 55); // left of the centre: faces left
    EXPECT_GT(texel(11, 8)[0], 200);
}

} // namespace
