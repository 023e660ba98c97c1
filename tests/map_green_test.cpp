// Figures of green on reliefs with constant second derivatives: h = (p x^2 + 2 q x y + r y^2) / 2 has the slopes (p x +
// q y, q x + r y), so da/dx, da/dy and db/dx, db/dy are p, q and q, r.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cotan/maps.hpp"
#include "maps/patches.hpp"
#include "maps/texels.hpp"

namespace cotan::maps {
namespace {

struct Quadric {
    double p, q, r;
};

// x to the right and y up, both in texels from the centre, divided by the width.
Image mapOf(const Quadric& h, int width, int height, PixelType type = PixelType::float32)
{
    Image image = makeImage(width, height, type);
    std::vector<glm::vec4> row(static_cast<std::size_t>(width));
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const double right = (x + 0.5 - 0.5 * width) / width, up = (0.5 * height - y - 0.5) / width;
            const glm::vec3 n(-(h.p * right + h.q * up), -(h.q * right + h.r * up), 1);
            row[std::size_t(x)] = encodeTexel(n, {}, type);
        }
        storeRow(image, y, row);
    }
    return image;
}

// Correlations: 2 q q / (q^2 + q^2) as stored, 2 p r / (p^2 + r^2) for exchanged channels; reversed green negates both.
TEST(GreenFigures, areTheCorrelationsOfTheDerivatives)
{
    for (const Quadric& h : {Quadric{0.4, 0.3, 0.2}, {0.1, -0.4, 0.6}, {0.5, 0.2, -0.15}})
        for (const bool up : {true, false}) {
            Image image = mapOf(h, 96, 64);
            if (!up)
                for (std::size_t i = 0; i < image.pixelCount(); ++i)
                    image.floats()[4 * i + 1] = 1 - image.floats()[4 * i + 1];
            const GreenVerdict v = greenOf(image);
            const double sign = up ? 1 : -1;
            EXPECT_NEAR(v.agreement, sign, 1e-3);
            EXPECT_NEAR(v.exchanged, sign * 2 * h.p * h.r / (h.p * h.p + h.r * h.r), 1e-3);
            EXPECT_EQ(v.green, up ? Green::up : Green::down) << v.reason;
            EXPECT_EQ(v.confidence, Confidence::certain);
            EXPECT_EQ(v.swapped, Swapped::no);
            EXPECT_NEAR(v.votes, 1, 1e-9);
            EXPECT_NEAR(v.used, 1, 1e-9);
            EXPECT_EQ(v.sampled, 1);
            EXPECT_GT(v.deviations, 500); // the patches agree
            EXPECT_GT(v.residualRatio, 1000);
            EXPECT_LE(v.residualRatio, 20000); // 2 over the smallest residual that counts
            EXPECT_LE(v.deviations, 1000);
        }
}

TEST(GreenFigures, areThoseOfExchangedChannelsIfTheyExplainMore)
{
    for (const bool up : {true, false}) {
        Image image = mapOf({0.5, 0.3, 0.1}, 96, 64); // 2 p r / (p^2 + r^2): 0.38
        for (std::size_t i = 0; i < image.pixelCount(); ++i) {
            float* const texel = image.floats() + 4 * i;
            std::swap(texel[0], texel[1]);
            if (!up)
                texel[1] = 1 - texel[1];
        }
        const GreenVerdict v = greenOf(image);
        const double sign = up ? 1 : -1;
        EXPECT_NEAR(v.agreement, sign * 2 * 0.5 * 0.1 / (0.25 + 0.01), 1e-3);
        EXPECT_NEAR(v.exchanged, sign, 1e-3);
        EXPECT_EQ(v.swapped, Swapped::yes) << v.reason;
        EXPECT_NEAR(v.votes, 1, 1e-9);
    }
    // Undecidable: both orders explain the relief equally, or it has no slope across.
    EXPECT_EQ(greenOf(mapOf({0.3, 0.2, 0.3}, 96, 64)).swapped, Swapped::undecidable);
    const GreenVerdict along = greenOf(mapOf({0.5, 0, 0.2}, 96, 64));
    EXPECT_EQ(along.green, Green::undecidable);
    EXPECT_EQ(along.reason, "the relief runs along the rows and columns only: both directions of green explain it");
}

// A change within rounding is not a relief.
TEST(GreenFigures, needAReliefAboveTheRoundingOfItsType)
{
    // Slopes change by about 0.0004 per texel; the steps of 8 bits are 1/127, of 16 bits 1/32767.
    const Quadric weak{0.04, 0.03, 0.02};
    EXPECT_EQ(greenOf(mapOf(weak, 96, 64, PixelType::unorm8)).green, Green::undecidable);
    EXPECT_EQ(greenOf(mapOf(weak, 96, 64, PixelType::unorm16)).green, Green::up);
    EXPECT_EQ(greenOf(mapOf(weak, 96, 64)).green, Green::up);
    EXPECT_EQ(greenOf(mapOf({0.4, 0.3, 0.2}, 96, 64, PixelType::unorm16)).green, Green::up);
}

// Images up to 2048 a side are sampled whole, larger ones by 128 x 128 squares at the centres of a grid of 16 a side.
TEST(GreenFigures, stateTheSampledFractionOfTheImage)
{
    EXPECT_EQ(PatchSampler(2048, 3, PixelType::unorm8).coveredFraction(), 1);
    EXPECT_EQ(PatchSampler(3, 2048, PixelType::unorm8).coveredFraction(), 1);
    EXPECT_NEAR(PatchSampler(4096, 512, PixelType::unorm8).coveredFraction(), 0.25, 1e-9); // of each square of 256
    EXPECT_NEAR(PatchSampler(512, 4096, PixelType::unorm8).coveredFraction(), 0.25, 1e-9);
    EXPECT_NEAR(PatchSampler(4096, 100, PixelType::unorm8).coveredFraction(), 0.5 * 36 / 100, 1e-9); // from row 64 on
    // Strips of any height give the same result as the whole image.
    const Image image = mapOf({0.5, 0.3, 0.1}, 90, 70);
    const GreenVerdict whole = greenOf(image);
    for (const int height : {1, 7, 69}) {
        PatchSampler sampler(image.width, image.height, image.type);
        for (int y = 0; y < image.height; y += height) {
            Image strip = makeImage(image.width, std::min(height, image.height - y), image.type);
            const std::size_t row = std::size_t(image.width) * image.bytesPerPixel();
            std::copy_n(image.data.begin() + std::ptrdiff_t(std::size_t(y) * row), strip.data.size(),
                        strip.data.begin());
            sampler.add(strip, y);
        }
        const GreenVerdict v = greenOf(sampler);
        EXPECT_EQ(v.agreement, whole.agreement);
        EXPECT_EQ(v.exchanged, whole.exchanged);
        EXPECT_EQ(v.deviations, whole.deviations);
    }
}

} // namespace
} // namespace cotan::maps
