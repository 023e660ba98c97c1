// The FLIP measure itself, compared with what its authors state.
#include <gtest/gtest.h>

#include "flip.hpp"

namespace cotan::test {
namespace {

Image even(int r, int g, int b)
{
    Image image = makeImage(64, 48, PixelType::unorm8);
    for (std::size_t i = 0; i < image.pixelCount(); ++i) {
        image.data[4 * i] = std::byte(r);
        image.data[4 * i + 1] = std::byte(g);
        image.data[4 * i + 2] = std::byte(b);
        image.data[4 * i + 3] = std::byte(255);
    }
    return image;
}

double between(const Image& a, const Image& b) { return flipError(a, b, std::vector<bool>(a.pixelCount(), true)); }

TEST(Flip, isZeroForTheSameImage) { EXPECT_EQ(between(even(40, 90, 200), even(40, 90, 200)), 0); }

// The largest colour distance is between green and blue, by definition.
TEST(Flip, isOneFromGreenToBlue) { EXPECT_NEAR(between(even(0, 255, 0), even(0, 0, 255)), 1, 1e-6); }

// Black and white are 100 apart, green and blue 203.3 (L*a*b* with Hunt's factor, by hand: 87.73, -75.61, 72.98 and
// 32.30, 25.58, -34.84). To the power of 0.7 that is 25.12 of 41.28, above the knee of 0.4, so 0.95 + 0.05 * 8.61 /
// 24.77.
TEST(Flip, isNearlyOneFromBlackToWhite) { EXPECT_NEAR(between(even(0, 0, 0), even(255, 255, 255)), 0.9674, 1e-4); }

TEST(Flip, growsWithTheDifferenceAndToleratesFineNoise)
{
    Image noise = even(128, 128, 128), shifted = even(140, 140, 140);
    for (std::size_t i = 0; i < noise.pixelCount(); ++i)
        for (std::size_t c = 0; c < 3; ++c)
            noise.data[4 * i + c] = std::byte((i + i / 64) % 2 == 0 ? 116 : 140);
    const Image plain = even(128, 128, 128);
    EXPECT_LT(between(plain, even(132, 132, 132)), between(plain, shifted));
    EXPECT_LT(between(plain, noise), 0.5 * between(plain, shifted)); // the same steps, which blur into plain grey
}

} // namespace
} // namespace cotan::test
