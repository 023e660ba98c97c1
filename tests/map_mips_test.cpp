// Mip chains: directions are means of vectors, roughness is the variance of normals that averaging loses.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "cotan/maps.hpp"
#include "cotan/scene.hpp"
#include "maps/mip_rows.hpp"
#include "maps/texels.hpp"
#include "quantisation.hpp"

namespace cotan::maps {
namespace {

constexpr Convention kSigned{.expansion = Expansion::signedValues};

Image tilted(int width, int height, double degreesLeftAndRight)
{
    Image image = makeImage(width, height, PixelType::float32);
    const double a = degreesLeftAndRight * 3.14159265358979 / 180;
    for (int i = 0; i < width * height; ++i) {
        image.floats()[4 * i] = float((i % width) % 2 == 0 ? std::sin(a) : -std::sin(a));
        image.floats()[4 * i + 2] = float(std::cos(a));
    }
    return image;
}

TEST(Mips, halve_down_to_one_texel_also_for_odd_sizes)
{
    const auto chain = mipChain(tilted(13, 5, 10), {.from = kSigned, .to = kSigned, .type = PixelType::float32});
    const int sizes[][2] = {{13, 5}, {6, 2}, {3, 1}, {1, 1}};
    ASSERT_EQ(chain.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(chain[i].normals.width, sizes[i][0]);
        EXPECT_EQ(chain[i].normals.height, sizes[i][1]);
    }
    EXPECT_EQ(mipChain(tilted(1, 1, 10), {.from = kSigned, .to = kSigned}).size(), 1u);
}

TEST(Mips, rows_that_arrive_one_after_another_have_the_levels_of_the_chain)
{
    const Image relief = makeReliefMap(Relief::bricks, 96);
    for (const auto& [width, height] : {std::pair(96, 96), std::pair(37, 53), std::pair(1, 9), std::pair(13, 1)})
        for (const PixelType type : {PixelType::unorm8, PixelType::float32})
            for (const int atOnce : {1, 7, 64}) {
                const auto rowsOf = [&, width = width](int first, int count) {
                    Image rows = makeImage(width, count, relief.type);
                    for (int y = 0; y < count; ++y)
                        std::copy_n(relief.bytes8() + 4 * 96 * (first + y), 4 * width, rows.bytes8() + 4 * width * y);
                    return rows;
                };
                const MipSettings settings{.type = type};
                const auto chain = mipChain(rowsOf(0, height), settings);
                std::vector<std::vector<std::byte>> levels(chain.size());
                MipRows mips(width, height, settings, MipRows::averaged);
                for (int y = 0; y < height; y += atOnce)
                    mips.add(rowsOf(y, std::min(atOnce, height - y)),
                             [&](std::size_t level, const Image& rows, const Image&) {
                                 levels[level].insert(levels[level].end(), rows.data.begin(), rows.data.end());
                             });
                for (std::size_t i = 1; i < chain.size(); ++i)
                    EXPECT_EQ(levels[i], chain[i].normals.data) << width << " x " << height << ", " << i;
            }
}

TEST(Mips, alpha_is_the_mean_of_four_texels)
{
    Image map = makeImage(4, 2, PixelType::float32);
    for (int i = 0; i < 8; ++i)
        map.floats()[4 * i + 3] = float(i) / 8;
    std::vector<float> alphas;
    MipRows mips(4, 2, {.type = PixelType::float32}, MipRows::averaged);
    mips.add(map, [&](std::size_t, const Image& rows, const Image&) {
        for (std::size_t i = 0; i < rows.pixelCount(); ++i)
            alphas.push_back(rows.floats()[4 * i + 3]);
    });
    EXPECT_EQ(alphas, (std::vector<float>{2.5f / 8, 4.5f / 8, 3.5f / 8}));
}

TEST(Mips, opposite_tilts_average_to_flat_with_length_cosine)
{
    const auto chain =
        mipChain(tilted(16, 16, 30), {.from = kSigned, .to = kSigned, .keepLengths = true, .type = PixelType::float32});
    EXPECT_NEAR(chain[0].meanLength, 1, 1e-6);
    for (std::size_t level = 1; level < chain.size(); ++level) {
        EXPECT_NEAR(chain[level].normals.floats()[0], 0, 1e-6);
        EXPECT_NEAR(chain[level].normals.floats()[2], std::cos(3.14159265358979 / 6), 1e-6); // float sums
        EXPECT_NEAR(chain[level].meanLength, std::cos(3.14159265358979 / 6), 1e-6);
    }
}

TEST(Mips, two_channel_chains_equal_three_channel_chains)
{
    const Image map = makeReliefMap(Relief::bricks, 64);
    Convention two;
    two.channels = Channels::orthographic;
    const auto a = mipChain(map, {.type = PixelType::unorm16}),
               b = mipChain(map, {.to = two, .type = PixelType::unorm16});
    for (std::size_t level = 0; level < a.size(); ++level) {
        const auto degrees = anglesBetween(a[level].normals, {}, b[level].normals, two);
        for (float d : degrees) // rounding of both, at up to 60 degrees of tilt
            EXPECT_LE(double(d), quantisationDegrees({}, 16, 60) + quantisationDegrees(two, 16, 60)) << level;
        EXPECT_EQ(a[level].roughness.data, b[level].roughness.data);
    }
}

TEST(Mips, models_agree_for_small_isotropic_variance)
{
    // Slopes of variance s along each axis: R = 1 - s to first order, and all three models increase alpha^2 by 2s.
    const double roughness = 0.4, s = 0.001, truth = std::pow(std::pow(roughness, 4) + 2 * s, 0.25);
    EXPECT_NEAR(roughnessFromVariance(roughness, 2 * s), truth, 1e-12);
    EXPECT_NEAR(roughnessFromLength(roughness, 1 - s, VarianceModel::vmf), truth, 1e-4); // second order in s
    // Toksvig's model uses the exponent e = 2/alpha^2 - 2: it adds 2s (1 - alpha^2)^2, too little by a fraction of 2
    // alpha^2; the second order in s is allowed a tenth of that.
    EXPECT_NEAR(roughnessFromLength(roughness, 1 - s, VarianceModel::toksvig), truth,
                2.2 * std::pow(roughness, 4) * (truth - roughness));
}

TEST(Mips, roughness_never_decreases_and_stays_in_range)
{
    for (VarianceModel model : {VarianceModel::toksvig, VarianceModel::vmf})
        for (double roughness : {0.0, 0.05, 0.5, 1.0}) {
            double before = roughness - 1e-9;
            for (double length : {1.0, 0.999, 0.9, 0.5, 0.1, 0.0}) {
                const double r = roughnessFromLength(roughness, length, model);
                EXPECT_GE(r, before) << int(model) << " " << roughness << " " << length;
                EXPECT_LE(r, 1);
                before = r - 1e-9;
            }
        }
    EXPECT_NEAR(roughnessFromLength(0.5, 1, VarianceModel::toksvig), 0.5, 1e-9);
    EXPECT_NEAR(roughnessFromLength(0.5, 1, VarianceModel::vmf), 0.5, 1e-9);
}

TEST(Mips, lean_measures_the_variance_of_slopes)
{
    // Slopes +-tan(20): variance tan(20)^2 along x, none along y.
    const double variance = std::pow(std::tan(20 * 3.14159265358979 / 180), 2);
    const auto chain =
        mipChain(tilted(8, 8, 20), {.from = kSigned, .to = kSigned, .roughness = 0.5, .type = PixelType::float32});
    EXPECT_NEAR(chain[0].meanRoughness, 0.5, 1e-6);
    EXPECT_NEAR(chain[1].meanRoughness, std::pow(0.0625 + variance, 0.25), 1e-6);
}

TEST(Mips, texels_without_direction_are_ignored)
{
    Image map = tilted(2, 2, 0);
    map.floats()[0] = std::numeric_limits<float>::quiet_NaN();
    const auto chain = mipChain(map, {.from = kSigned, .to = kSigned, .keepLengths = true, .type = PixelType::float32});
    EXPECT_NEAR(chain[1].normals.floats()[2], 1, 1e-6);
}

} // namespace
} // namespace cotan::maps
