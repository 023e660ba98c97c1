// Blended maps against maps of the summed heights, and the settings of blends.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "cotan/maps.hpp"
#include "maps/texels.hpp"

namespace cotan::maps {
namespace {

constexpr Convention kSigned{.expansion = Expansion::signedValues};

template<class Slopes> Image mapOf(int width, int height, Slopes slopes)
{
    Image image = makeImage(width, height, PixelType::float32);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const glm::vec2 s = slopes(x, y);
            const glm::vec3 n = glm::normalize(glm::vec3(-s, 1));
            std::copy_n(&n.x, 3, image.floats() + 4 * (y * width + x));
            image.floats()[4 * (y * width + x) + 3] = 1;
        }
    return image;
}

Image flat(int width, int height)
{
    return mapOf(width, height, [](int, int) { return glm::vec2(0); });
}

double largestAngle(const Image& a, const Image& b)
{
    const auto degrees = anglesBetween(a, kSigned, b, kSigned);
    return *std::ranges::max_element(degrees);
}

Image blended(const Image& base, const Image& detail, BlendSettings s)
{
    std::size_t invalid = 0;
    s.base = s.detail = s.to = kSigned;
    s.type = PixelType::float32;
    return blend(base, detail, s, invalid);
}

constexpr double kRounding = 1e-4; // degrees: a few float operations on unit vectors
constexpr BlendMode kModes[] = {BlendMode::reoriented, BlendMode::whiteout, BlendMode::udn, BlendMode::slopes};

const auto kHills = [](int x, int y) {
    return glm::vec2(0.5f * std::sin(0.3f * float(x)), 0.4f * std::cos(0.2f * float(y)));
};
const auto kGrain = [](int x, int y) {
    return glm::vec2(0.2f * std::cos(1.1f * float(x + y)), 0.3f * std::sin(0.7f * float(x)));
};

TEST(Blend, flat_details_change_nothing)
{
    const Image base = mapOf(20, 12, kHills);
    for (BlendMode mode : kModes)
        EXPECT_LT(largestAngle(blended(base, flat(20, 12), {.mode = mode}), base), kRounding) << int(mode);
}

TEST(Blend, a_flat_base_keeps_the_detail_except_with_udn_and_linear)
{
    const Image detail = mapOf(20, 12, kGrain);
    for (BlendMode mode : {BlendMode::reoriented, BlendMode::whiteout, BlendMode::slopes})
        EXPECT_LT(largestAngle(blended(flat(20, 12), detail, {.mode = mode}), detail), kRounding) << int(mode);
    EXPECT_GT(largestAngle(blended(flat(20, 12), detail, {.mode = BlendMode::linear}), detail), 1);
}

TEST(Blend, slopes_equals_the_sum_of_heights)
{
    const Image sum = mapOf(20, 12, [](int x, int y) { return kHills(x, y) + 0.5f * kGrain(x, y); });
    EXPECT_LT(
        largestAngle(
            blended(mapOf(20, 12, kHills), mapOf(20, 12, kGrain), {.mode = BlendMode::slopes, .strength = 0.5f}), sum),
        kRounding);
}

TEST(Blend, reoriented_keeps_the_angle_between_details)
{
    // The base rotates the detail: 30 degrees from flat become 30 degrees from the base.
    const Image base = mapOf(1, 1, [](int, int) { return glm::vec2(0.7f, -0.2f); });
    const Image detail = mapOf(1, 1, [](int, int) { return glm::vec2(std::tan(0.5235988f), 0); });
    EXPECT_NEAR(largestAngle(blended(base, detail, {}), base), 30, 1e-3);
}

TEST(Blend, strength_zero_and_a_black_mask_leave_the_base)
{
    const Image base = mapOf(20, 12, kHills), detail = mapOf(20, 12, kGrain);
    const Image black = makeImage(3, 5, PixelType::unorm8);
    for (BlendMode mode : {BlendMode::reoriented, BlendMode::linear}) {
        EXPECT_LT(largestAngle(blended(base, detail, {.mode = mode, .strength = 0}), base), kRounding);
        EXPECT_LT(largestAngle(blended(base, detail, {.mode = mode, .mask = &black}), base), kRounding);
    }
    Image half = makeImage(2, 1, PixelType::unorm8); // white on the right
    half.bytes8()[4] = 255;
    const Image out = blended(base, detail, {.mask = &half});
    const Image full = blended(base, detail, {});
    for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 20; ++x)
            EXPECT_NEAR(out.floats()[4 * (y * 20 + x)], (x < 10 ? base : full).floats()[4 * (y * 20 + x)], 1e-6);
}

TEST(Blend, tiles_repeat_the_detail)
{
    const Image detail = mapOf(8, 6, kGrain);
    const Image tiled = mapOf(24, 12, [](int x, int y) { return kGrain(x % 8, y % 6); });
    EXPECT_LT(largestAngle(blended(flat(24, 12), detail, {.tilesX = 3, .tilesY = 2}), tiled), kRounding);
}

TEST(Blend, details_smaller_than_a_texel_are_averaged_as_vectors)
{
    // Opposite slopes side by side, two for each texel of the base, cancel out.
    const Image detail = mapOf(16, 4, [](int x, int) { return glm::vec2(x % 2 == 0 ? 1.0f : -1.0f, 0); });
    EXPECT_LT(largestAngle(blended(flat(8, 4), detail, {}), flat(8, 4)), kRounding);
}

TEST(Blend, texels_without_direction_keep_the_other_map)
{
    Image base = mapOf(4, 1, kHills);
    base.floats()[0] = std::numeric_limits<float>::quiet_NaN();
    const Image detail = mapOf(4, 1, kGrain);
    std::size_t invalid = 0;
    const Image out =
        blend(base, detail, {.base = kSigned, .detail = kSigned, .to = kSigned, .type = PixelType::float32}, invalid);
    EXPECT_EQ(invalid, 1u);
    EXPECT_NEAR(out.floats()[0], detail.floats()[0], 1e-6);
}

TEST(Blend, a_strength_beyond_floats_leaves_the_base)
{
    const Image base = mapOf(20, 12, kHills), detail = mapOf(20, 12, kGrain);
    const float infinite = std::numeric_limits<float>::infinity();
    EXPECT_LT(largestAngle(blended(base, detail, {.strength = infinite}), base), kRounding);
}

} // namespace
} // namespace cotan::maps
