// The properties that are detected in a map, on maps whose properties are known by construction.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "cotan/maps.hpp"
#include "cotan/scene.hpp"
#include "maps/texels.hpp"

namespace cotan::maps {
namespace {

constexpr Convention kGreenUp{};

// A map from a function of (x right, y up) in [0,1] that returns (dh/dx, dh/dy).
template<class Slopes>
Image mapOf(int width, int height, Slopes slopes, const Convention& c = kGreenUp, PixelType type = PixelType::unorm8)
{
    Image image = makeImage(width, height, type);
    std::vector<glm::vec4> row(std::size_t(width), glm::vec4(0));
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const glm::vec2 s = slopes((float(x) + 0.5f) / float(width), 1 - (float(y) + 0.5f) / float(height));
            row[std::size_t(x)] = encodeTexel(glm::vec3(-s.x, -s.y, 1), c, type);
        }
        storeRow(image, y, row);
    }
    return image;
}

template<class Change> Image changed(Image image, Change change)
{
    for (std::size_t i = 0; i < image.pixelCount(); ++i)
        change(image.bytes8() + 4 * i);
    return image;
}

Image greenNegated(const Image& image)
{
    return changed(image, [](std::uint8_t* p) { p[1] = std::uint8_t(p[1] == 0 ? 255 : 256 - p[1]); });
}

Image exchanged(const Image& image)
{
    return changed(image, [](std::uint8_t* p) { std::swap(p[0], p[1]); });
}

GreenVerdict verdict(const Image& image) { return greenOf(image); }

// A model's map is surveyed in up to 256 small parts, and starting a thread takes longer than one of them.
TEST(RowBands, of_few_texels_are_worked_on_by_the_caller)
{
    const auto here = std::this_thread::get_id();
    std::vector<int> calls(64, 0);
    for (const auto& [width, height] : {std::pair(17, 17), std::pair(64, 64), std::pair(4096, 1), std::pair(1, 64)}) {
        std::fill(calls.begin(), calls.end(), 0);
        forRowBands(width, height, [&](int first, int last) {
            EXPECT_EQ(std::this_thread::get_id(), here) << width << " x " << height;
            for (int y = first; y < last; ++y)
                ++calls[std::size_t(y)];
        });
        for (int y = 0; y < 64; ++y)
            EXPECT_EQ(calls[std::size_t(y)], y < height ? 1 : 0) << width << " x " << height;
    }
}

TEST(Detect, names_the_green_of_analytic_reliefs)
{
    for (Relief kind : {Relief::domes, Relief::bricks, Relief::waves}) {
        const Image up = makeReliefMap(kind, 256); // glTF: green up
        EXPECT_EQ(verdict(up).green, Green::up) << int(kind);
        EXPECT_EQ(verdict(up).confidence, Confidence::certain) << int(kind);
        EXPECT_EQ(verdict(greenNegated(up)).green, Green::down) << int(kind);
    }
}

TEST(Detect, answers_the_same_for_bumps_and_dents)
{
    const Image up = makeReliefMap(Relief::domes, 128);
    const Image dents = changed(up, [](std::uint8_t* p) {
        p[0] = std::uint8_t(p[0] == 0 ? 255 : 256 - p[0]);
        p[1] = std::uint8_t(p[1] == 0 ? 255 : 256 - p[1]);
    });
    EXPECT_EQ(verdict(dents).green, Green::up);
    EXPECT_NEAR(verdict(dents).agreement, verdict(up).agreement, 1e-3); // no texel of this map stores 0
}

TEST(Detect, finds_exchanged_channels)
{
    const GreenVerdict v = verdict(exchanged(makeReliefMap(Relief::domes, 256)));
    EXPECT_EQ(v.swapped, Swapped::yes);
    EXPECT_EQ(v.green, Green::up);
    EXPECT_EQ(verdict(makeReliefMap(Relief::domes, 256)).swapped, Swapped::no);
}

TEST(Detect, a_relief_along_one_axis_is_undecidable)
{
    const Image ridges = mapOf(128, 96, [](float x, float) { return glm::vec2(0.4f * std::sin(40 * x), 0.0f); });
    EXPECT_EQ(verdict(ridges).green, Green::undecidable);
    const Image across = mapOf(128, 96, [](float, float y) { return glm::vec2(0.0f, 0.4f * std::sin(40 * y)); });
    EXPECT_EQ(verdict(across).green, Green::undecidable);
}

TEST(Detect, slanted_ridges_decide_green_but_not_exchange)
{
    // h = f(x + y): both slopes are equal, so exchanging them changes nothing.
    const Image slanted = mapOf(128, 128, [](float x, float y) { return glm::vec2(0.4f * std::sin(30 * (x + y))); });
    EXPECT_EQ(verdict(slanted).green, Green::up);
    EXPECT_EQ(verdict(slanted).swapped, Swapped::undecidable);
}

TEST(Detect, noise_without_a_relief_is_undecidable)
{
    unsigned state = 1;
    const auto next = [&] {
        state = state * 1664525u + 1013904223u;
        return float(state >> 8) / 16777216.0f - 0.5f;
    };
    const Image noise = mapOf(256, 256, [&](float, float) { return glm::vec2(next(), next()); });
    EXPECT_EQ(verdict(noise).green, Green::undecidable);
}

TEST(Detect, one_small_dome_in_a_large_flat_map_decides_green)
{
    const auto dome = [](float x, float y) {
        const glm::vec2 d(x - 0.3f, y - 0.6f);
        const float inside = std::max(0.0f, 1 - glm::dot(d, d) / (0.04f * 0.04f));
        return -2.0f * inside * d / 0.04f;
    };
    EXPECT_EQ(verdict(mapOf(512, 512, dome)).green, Green::up);
}

TEST(Detect, two_channel_and_slope_maps_are_decided_too)
{
    const auto bumps = [](float x, float y) {
        return glm::vec2(0.8f * std::cos(25 * x) * std::sin(19 * y), 0.6f * std::sin(25 * x) * std::cos(19 * y));
    };
    Convention down = kGreenUp;
    down.greenUp = false;
    for (Channels channels : {Channels::orthographic, Channels::slope}) {
        down.channels = channels;
        EXPECT_EQ(verdict(mapOf(128, 128, bumps, down)).green, Green::down) << int(channels);
    }
}

TEST(Detect, degenerate_images_are_undecidable_with_a_reason)
{
    for (const Image& image : {makeImage(1, 1, PixelType::unorm8), makeImage(1, 64, PixelType::unorm8),
                               makeImage(64, 64, PixelType::unorm16), makeImage(2, 2, PixelType::float32)}) {
        EXPECT_EQ(verdict(image).green, Green::undecidable);
        EXPECT_FALSE(verdict(image).reason.empty());
    }
    Image nan = makeImage(32, 32, PixelType::float32);
    std::fill_n(nan.floats(), nan.pixelCount() * 4, std::numeric_limits<float>::quiet_NaN());
    EXPECT_EQ(verdict(nan).green, Green::undecidable);
    EXPECT_EQ(statisticsOfMap(nan).invalid, 1);
}

TEST(Info, detects_the_zero_code)
{
    const auto waves = [](float x, float y) {
        const HeightSample s = relief(Relief::waves, x, 1 - y);
        return glm::vec2(s.hu, -s.hv);
    };
    Convention c = kGreenUp;
    c.expansion = Expansion::exact;
    EXPECT_EQ(statisticsOfMap(mapOf(128, 128, waves, c)).centre, Centre::exact);
    c.expansion = Expansion::biased;
    EXPECT_EQ(statisticsOfMap(mapOf(128, 128, waves, c)).centre, Centre::biased);
}

TEST(Info, detects_the_srgb_curve)
{
    const Image map = makeReliefMap(Relief::waves, 64);
    EXPECT_EQ(statisticsOfMap(map).transfer, Transfer::linear);
    const Image bent = changed(map, [](std::uint8_t* p) {
        for (int c = 0; c < 3; ++c)
            p[c] = std::uint8_t(std::lround(255 * (1.055 * std::pow(p[c] / 255.0, 1 / 2.4) - 0.055)));
    });
    EXPECT_EQ(statisticsOfMap(bent).transfer, Transfer::srgb);
}

TEST(Info, distinguishes_contents)
{
    const Image tangent = makeReliefMap(Relief::bricks, 64);
    EXPECT_EQ(statisticsOfMap(tangent).content, Content::tangentSpace);
    EXPECT_EQ(statisticsOfMap(changed(tangent, [](std::uint8_t* p) { p[2] = 128; })).content, Content::twoChannel);
    EXPECT_EQ(statisticsOfMap(changed(tangent, [](std::uint8_t* p) { p[0] = p[1] = p[2]; })).content, Content::grey);
    EXPECT_EQ(statisticsOfMap(changed(tangent, [](std::uint8_t* p) { p[0] = p[1] = 128, p[2] = 255; })).content,
              Content::flat);
    // Two-channel files are read as grey and alpha.
    const Image grey = changed(tangent, [](std::uint8_t* p) { p[3] = p[1], p[1] = p[2] = p[0]; });
    EXPECT_EQ(statisticsOfMap(grey).swizzle, Swizzle::greyAlpha);
    EXPECT_EQ(statisticsOfMap(grey).content, Content::twoChannel);
    // A ball seen from all sides: both signs of every component.
    Image ball = tangent;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            const double a = x * 0.098, b = y * 0.049;
            const glm::dvec3 n(std::cos(a) * std::sin(b), std::cos(b), std::sin(a) * std::sin(b));
            for (int c = 0; c < 3; ++c)
                ball.bytes8()[4 * (y * 64 + x) + c] = std::uint8_t(std::lround(128 + 127 * n[c]));
        }
    EXPECT_EQ(statisticsOfMap(ball).content, Content::objectSpace);
}

TEST(Info, counts_tilt_by_tens_of_degrees)
{
    // Half the map flat, half tilted by 45 degrees.
    const Image half = mapOf(64, 64, [](float x, float) { return glm::vec2(x < 0.5f ? 0.0f : 1.0f, 0.0f); });
    const NormalStatistics s = statisticsOfMap(half);
    EXPECT_DOUBLE_EQ(s.tilt[0], 0.5);
    EXPECT_DOUBLE_EQ(s.tilt[4], 0.5);
    EXPECT_NEAR(s.meanTilt, 22.5, 0.2);  // half a step of 1/127 at length 1 is 0.23 degrees
    EXPECT_NEAR(s.meanLength, 1, 0.004); // sqrt(3)/2 steps at most: 0.0068; half the texels are exact
}

} // namespace
} // namespace cotan::maps
