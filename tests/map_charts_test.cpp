// Maps of charts: the direction of green on islands, whatever fills the space between them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <tuple>

#include "cotan/maps.hpp"
#include "map_cases.hpp"
#include "maps/patches.hpp"

namespace cotan::maps {
namespace {

using namespace cases;

enum class Between { flat, black, white, transparent, grey, padded };
constexpr Between kBetween[] = {Between::flat,        Between::black, Between::white,
                                Between::transparent, Between::grey,  Between::padded};

// Round charts with a separate relief each, which ends at the border, so that slopes jump there. covered: approximate
// fraction of the image that the charts cover.
struct Atlas {
    int side = 256, across = 4;
    double covered = 0.4;

    double radius() const { return std::sqrt(covered / 3.14159265358979) * side / across; }
    // The centre of the nearest chart and the distance to it.
    std::pair<glm::dvec2, double> nearest(double x, double y) const
    {
        const double step = double(side) / across;
        const glm::dvec2 middle((std::floor(x / step) + 0.5) * step, (std::floor(y / step) + 0.5) * step);
        return {middle, glm::length(glm::dvec2(x, y) - middle)};
    }
    // Waves in two directions that differ between charts, added to a tilt of the chart.
    glm::dvec2 slopes(glm::dvec2 p, glm::dvec2 middle) const
    {
        const double k = 0.013 * middle.x + 0.029 * middle.y;
        const glm::dvec2 d(std::cos(k), std::sin(k)), e(-0.6 * d.y, 0.9 * d.x),
            tilt(0.4 * std::sin(7 * k), 0.5 * std::cos(5 * k));
        return tilt + d * (0.5 * std::cos(0.33 * glm::dot(d, p) + k)) + e * (0.4 * std::cos(0.27 * glm::dot(e, p)));
    }
};

Image atlasMap(const Atlas& atlas, Between between, bool greenUp, PixelType type)
{
    Convention c;
    c.greenUp = greenUp;
    Image image = makeImage(atlas.side, atlas.side, type);
    std::vector<glm::vec4> row(std::size_t(atlas.side), glm::vec4(0));
    for (int y = 0; y < atlas.side; ++y) {
        for (int x = 0; x < atlas.side; ++x) {
            glm::dvec2 p(x + 0.5, y + 0.5);
            const auto [middle, distance] = atlas.nearest(p.x, p.y);
            const bool inside = distance <= atlas.radius();
            if (!inside && between == Between::padded) // the nearest texel of the chart
                p = glm::floor(middle + (p - middle) * (atlas.radius() / distance)) + 0.5;
            glm::dvec2 s = atlas.slopes({p.x, -p.y}, middle); // y up
            if (!inside && between == Between::flat)
                s = {0, 0};
            glm::vec4& t = row[std::size_t(x)] = encodeTexel(glm::vec3(float(-s.x), float(-s.y), 1), c, type);
            if (!inside && between != Between::padded && between != Between::flat)
                t = between == Between::white         ? glm::vec4(1)
                    : between == Between::grey        ? glm::vec4(0.5f, 0.5f, 0.5f, 1)
                    : between == Between::transparent ? glm::vec4(0.3f, 0.9f, 0.2f, 0)
                                                      : glm::vec4(0, 0, 0, 1);
        }
        storeRow(image, y, row);
    }
    return image;
}

TEST(Charts, green_is_detected_with_any_background)
{
    for (const auto& [covered, across, type] : {std::tuple(0.1, 2, PixelType::unorm8),
                                                {0.1, 5, PixelType::unorm16},
                                                {0.4, 5, PixelType::unorm8},
                                                {0.75, 2, PixelType::unorm8}})
        for (Between between : kBetween)
            for (bool up : {true, false}) {
                const GreenVerdict v = greenOf(atlasMap({256, across, covered}, between, up, type));
                const std::string which =
                    (testing::Message() << covered << ' ' << across << ' ' << int(between) << ' ' << up << ": "
                                        << v.agreement << ' ' << v.deviations << ' ' << v.reason)
                        .GetString();
                if (v.green == Green::undecidable) // only if padding covers most of the image
                    EXPECT_TRUE(between == Between::padded && covered < 0.2) << which;
                else
                    EXPECT_EQ(v.green, up ? Green::up : Green::down) << which;
                EXPECT_NE(v.swapped, Swapped::yes) << which;
            }
}

TEST(Charts, a_background_of_one_colour_changes_nothing)
{
    const double alone = greenOf(atlasMap({256, 5, 0.4}, Between::transparent, true, PixelType::unorm16)).agreement;
    for (Between between : {Between::flat, Between::black, Between::white, Between::grey})
        EXPECT_NEAR(greenOf(atlasMap({256, 5, 0.4}, between, true, PixelType::unorm16)).agreement, alone, 1e-6)
            << int(between);
}

// Waves along both axes, plus noise of amplitude noiseSize, plus a random tilt for each square.
Image noisyWaves(int side, double noiseSize, double tiltSize, int square, unsigned seed, bool up = true)
{
    Noise noise(seed);
    std::vector<glm::dvec2> tilts;
    for (int i = 0; i < 1024; ++i)
        tilts.push_back(tiltSize * glm::dvec2(noise.next() - 0.5, noise.next() - 0.5));
    return floatMap(side, side, [&](int x, int y) {
        glm::dvec2 s(0.1 * std::cos(0.4 * x) * std::cos(0.3 * y),
                     0.1 * 0.3 / 0.4 * std::sin(0.4 * x) * std::sin(0.3 * y));
        s += noiseSize * glm::dvec2(noise.next() - 0.5, noise.next() - 0.5)
            + tilts[std::size_t(y / square * 32 + x / square)];
        const glm::vec3 n = ofSlopes(s.x, s.y); // h = 0.25 sin 0.4x cos 0.3y, y down: h_up = 0.075 sin sin
        return glm::vec3(n.x, up ? n.y : -n.y, n.z);
    });
}

TEST(Charts, steps_at_chart_borders_do_not_hide_the_relief)
{
    const GreenVerdict plain = greenOf(noisyWaves(256, 0, 0, 16, 1)), stepped = greenOf(noisyWaves(256, 0, 1.2, 16, 1));
    EXPECT_GT(plain.agreement, 0.95);
    EXPECT_GT(stepped.agreement, 0.6); // the steps are ten times as high as the waves, on one texel in eight
    EXPECT_EQ(stepped.green, Green::up);
}

TEST(Charts, confidence_follows_the_agreement)
{
    for (bool up : {true, false}) {
        const GreenVerdict sure = greenOf(noisyWaves(256, 0.01, 0, 16, 1, up)),
                           likely = greenOf(noisyWaves(256, 0.06, 0, 16, 1, up));
        for (const GreenVerdict& v : {sure, likely}) {
            EXPECT_EQ(v.green, up ? Green::up : Green::down);
            const double size = std::abs(v.agreement);
            EXPECT_NEAR(v.residualRatio, (1 + size) / (1 - size), 1e-9 * v.residualRatio);
            EXPECT_GT(v.votes, 0.8);
            EXPECT_LE(v.votes, 1);
        }
        EXPECT_EQ(sure.confidence, Confidence::certain) << sure.agreement;
        EXPECT_EQ(likely.confidence, Confidence::likely) << likely.agreement; // between 0.12 and 0.5
    }
}

TEST(Charts, small_noise_is_undecidable_despite_chance_agreement)
{
    double largest = 0;
    for (unsigned seed = 1; seed <= 200; ++seed) {
        Noise noise(7919 * seed);
        const GreenVerdict v =
            greenOf(floatMap(12, 12, [&](int, int) { return ofSlopes(noise.next() - 0.5, noise.next() - 0.5); }));
        EXPECT_EQ(v.green, Green::undecidable) << seed << ' ' << v.agreement << ' ' << v.deviations;
        largest = std::max(largest, std::abs(v.agreement));
    }
    EXPECT_GT(largest, 0.12); // would suffice if uncertainty were ignored
}

TEST(Charts, noise_on_islands_is_undecidable)
{
    Noise noise(11);
    for (Between between : {Between::black, Between::white, Between::transparent}) {
        Image map = atlasMap({256, 3, 0.5}, between, true, PixelType::unorm8);
        for (std::size_t i = 0; i < map.pixelCount(); ++i) {
            std::uint8_t* p = map.bytes8() + 4 * i;
            if (outsideCharts({p[0] / 255.0f, p[1] / 255.0f, p[2] / 255.0f, p[3] / 255.0f}, true))
                continue;
            const glm::vec3 n = ofSlopes(noise.next() - 0.5, noise.next() - 0.5);
            for (int c = 0; c < 3; ++c)
                p[c] = std::uint8_t(std::lround(128 + 127 * n[c]));
        }
        EXPECT_EQ(greenOf(map).green, Green::undecidable) << int(between);
    }
}

TEST(Charts, figures_exclude_the_background)
{
    // Half background, half tilted by (0.6, 0, 0.8) rounded to 8 bits.
    for (const std::array<std::uint8_t, 4>& outside :
         {std::array<std::uint8_t, 4>{0, 0, 0, 255}, {255, 255, 255, 255}, {90, 200, 10, 0}, {128, 128, 128, 255}}) {
        Image map = makeImage(16, 16, PixelType::unorm8);
        for (std::size_t i = 0; i < map.pixelCount(); ++i) {
            const std::array<std::uint8_t, 4> tilted{std::uint8_t(128 + 76 + i % 2), std::uint8_t(128 + i % 5),
                                                     std::uint8_t(128 + 102 - i % 7), 255};
            std::ranges::copy(i % 16 < 8 ? outside : tilted, map.bytes8() + 4 * i);
        }
        const NormalStatistics s = statisticsOfMap(map);
        EXPECT_EQ(s.content, Content::tangentSpace) << int(outside[0]);
        EXPECT_NEAR(s.background, 0.5, 1.0 / 16) << int(outside[0]);
        EXPECT_EQ(s.invalid, 0);
        EXPECT_EQ(s.belowHorizon, 0);
        EXPECT_NEAR(s.meanTilt, 37.7, 0.3); // atan(76.5 / 99)
        EXPECT_NEAR(s.lowest[2], 224.0 / 255, 1e-6);
    }
}

TEST(Charts, background_is_detected_on_both_sides_of_its_limits)
{
    const auto texel = [](float c, float a) { return glm::vec4(c / 255, c / 255, c / 255, a); };
    EXPECT_TRUE(outsideCharts(texel(8, 1), true));
    EXPECT_FALSE(outsideCharts(texel(9, 1), true));
    EXPECT_TRUE(outsideCharts(texel(247, 1), true));
    EXPECT_FALSE(outsideCharts(texel(246, 1), true));
    EXPECT_TRUE(outsideCharts(texel(100, 0), true));
    EXPECT_FALSE(outsideCharts(texel(100, 1.0f / 255), true));
    EXPECT_FALSE(outsideCharts({0, 0, 1, 1}, true));    // black in two components only
    EXPECT_FALSE(outsideCharts({-1, -1, -1, 1}, true)); // signed
    EXPECT_FALSE(outsideCharts({1, 1, 0.5f, 1}, true));
}

// Alpha that is 0 everywhere separates no charts: such a map is judged like the same map without alpha. In a model
// alpha has no meaning at all.
TEST(Charts, alpha_that_is_zero_everywhere_is_ignored_and_mentioned)
{
    for (const bool up : {true, false})
        for (const PixelType type : {PixelType::unorm8, PixelType::unorm16}) {
            const Image opaque = atlasMap({128, 2, 0.75}, Between::flat, up, type);
            Image transparent = opaque;
            for (int y = 0; y < opaque.height; ++y) {
                std::vector<glm::vec4> row(std::size_t(opaque.width));
                loadRow(opaque, y, row);
                for (glm::vec4& t : row)
                    t.w = 0;
                storeRow(transparent, y, row);
            }
            const GreenVerdict expected = greenOf(opaque), found = greenOf(transparent);
            EXPECT_EQ(found.green, up ? Green::up : Green::down);
            EXPECT_EQ(found.agreement, expected.agreement);
            EXPECT_EQ(found.statistics.content, Content::tangentSpace);
            EXPECT_EQ(found.statistics.meanTilt, expected.statistics.meanTilt);
            EXPECT_EQ(noteOf(expected.statistics), "");
            EXPECT_NE(noteOf(found.statistics).find("alpha is 0 everywhere"), std::string::npos);
            EXPECT_NE(noteOf(statisticsOfMap(transparent)).find("alpha is 0 everywhere"), std::string::npos);
        }
    const Image masked = atlasMap({256, 5, 0.4}, Between::transparent, true, PixelType::unorm8);
    EXPECT_EQ(noteOf(statisticsOfMap(masked)), "");
    EXPECT_LT(greenOf(masked, AlphaUse::ignored).statistics.background, statisticsOfMap(masked).background);
}

TEST(Patches, cover_small_images_and_overlap_by_one_texel)
{
    Noise noise(13);
    Image image = makeImage(37, 21, PixelType::unorm8);
    for (std::byte& b : image.data)
        b = std::byte(int(256 * noise.next()));
    PatchSampler sampler(37, 21, PixelType::unorm8);
    sampler.add(image, 0);
    EXPECT_EQ(sampler.coveredFraction(), 1);
    EXPECT_EQ(sampler.patches().size(), 13u * 7u); // squares of 3
    std::vector<int> seen(37 * 21, 0);
    for (const Patch& p : sampler.patches()) {
        EXPECT_EQ(p.texels.width, std::min(4, 37 - p.x));
        EXPECT_EQ(p.texels.height, std::min(4, 21 - p.y));
        for (int y = 0; y < p.texels.height; ++y)
            for (int x = 0; x < p.texels.width; ++x) {
                seen[std::size_t((p.y + y) * 37 + p.x + x)] += x < 3 && y < 3;
                ASSERT_EQ(p.texels.bytes8()[4 * (y * p.texels.width + x) + 1],
                          image.bytes8()[4 * ((p.y + y) * 37 + p.x + x) + 1]);
            }
    }
    EXPECT_EQ(std::ranges::count(seen, 1), 37 * 21); // each texel once
}

TEST(Patches, do_not_depend_on_the_strips)
{
    Noise noise(14);
    Image image = makeImage(70, 100, PixelType::unorm16);
    for (std::byte& b : image.data)
        b = std::byte(int(256 * noise.next()));
    PatchSampler whole(70, 100, PixelType::unorm16), cut(70, 100, PixelType::unorm16);
    whole.add(image, 0);
    for (int y = 0; y < 100; y += 3)
        cut.add(rowsBetween(image, y, std::min(y + 3, 100)), y);
    for (std::size_t i = 0; i < whole.patches().size(); ++i)
        EXPECT_EQ(whole.patches()[i].texels.data, cut.patches()[i].texels.data) << i;
}

TEST(Patches, of_large_images_are_the_centres_of_squares)
{
    const PatchSampler whole(2048, 100, PixelType::unorm8), part(4096, 2048, PixelType::unorm8);
    EXPECT_EQ(whole.coveredFraction(), 1);
    EXPECT_EQ(part.patches().size(), 16u * 8u);
    EXPECT_EQ(part.patches()[17].x, 256 + 64);
    EXPECT_EQ(part.patches()[17].y, 256 + 64);
    EXPECT_EQ(part.patches()[17].texels.width, 129);
    EXPECT_NEAR(part.coveredFraction(), 0.25, 1e-12);
    EXPECT_LT(PatchSampler(2049, 2049, PixelType::unorm8).coveredFraction(), 1);
}

TEST(Surveys, one_colour_needs_one_pass)
{
    const auto survey = [](const Image& map, bool second) {
        MapSurvey s;
        for (int y = 0; y < map.height; y += 16)
            s.addFirstPass(rowsBetween(map, y, std::min(y + 16, map.height)));
        for (int y = 0; y < map.height && second; y += 16)
            s.addSecondPass(rowsBetween(map, y, std::min(y + 16, map.height)));
        return std::pair(s.oneColour(), s.finish());
    };
    Image map = makeImage(19, 40, PixelType::unorm8);
    for (std::size_t i = 0; i < map.pixelCount(); ++i) {
        const std::uint8_t tilted[4] = {128 + 76, 128 + 20, 128 + 100, 255};
        std::copy_n(tilted, 4, map.bytes8() + 4 * i);
    }
    const auto [one, quick] = survey(map, false);
    const auto [same, slow] = survey(map, true);
    EXPECT_TRUE(one && same);
    EXPECT_EQ(quick.content, Content::flat);
    EXPECT_EQ(quick.texels, 19u * 40u);
    EXPECT_EQ(quick.invalid, 0);
    EXPECT_NEAR(quick.meanTilt, slow.meanTilt, 1e-9);
    EXPECT_NEAR(quick.meanLength, slow.meanLength, 1e-9);
    EXPECT_NEAR(quick.mean[1], slow.mean[1], 1e-9);
    EXPECT_EQ(quick.tilt, slow.tilt);
    EXPECT_NEAR(quick.meanTilt, 38.15, 0.05); // atan(hypot(76, 20) / 100)
    // A texel that differs is noticed at the start, in the middle and at the end.
    for (std::size_t i : {std::size_t(0), map.pixelCount() / 2, map.pixelCount() - 1}) {
        Image other = map;
        other.bytes8()[4 * i + 1] = 90;
        EXPECT_FALSE(survey(other, true).first) << i;
        const NormalStatistics s = survey(other, true).second;
        EXPECT_NEAR(s.lowest[1], 90 / 255.0, 1e-6);
    }
}

NormalStatistics statisticsOf(double mistake, int bits, int seed, float (*curve)(float) = nullptr)
{
    // Unit vectors, stored with zero `mistake` codes below the middle code.
    Noise noise{unsigned(seed)};
    Image map = makeImage(64, 64, bits == 8 ? PixelType::unorm8 : PixelType::unorm16);
    for (std::size_t i = 0; i < map.pixelCount(); ++i) {
        const glm::vec3 n = ofSlopes(1.6 * noise.next() - 0.8, 1.4 * noise.next() - 0.5);
        for (std::size_t c = 0; c < 4; ++c) {
            const double top = bits == 8 ? 255 : 65535, middle = (top + 1) / 2 - mistake;
            double code = c == 3 ? top : middle + (top - middle) * double(n[int(c)]);
            if (curve && c < 3)
                code = top * double(curve(float(code / top)));
            if (bits == 8)
                map.bytes8()[4 * i + c] = std::uint8_t(std::lround(code));
            else
                map.words()[4 * i + c] = std::uint16_t(std::lround(code));
        }
    }
    return statisticsOfMap(map);
}

TEST(Surveys, distinguish_128_from_127_and_a_half)
{
    for (int seed : {1, 2, 3}) {
        EXPECT_EQ(statisticsOf(0, 8, seed).centre, Centre::exact);
        EXPECT_EQ(statisticsOf(0.5, 8, seed).centre, Centre::biased);
        EXPECT_LT(statisticsOf(0, 8, seed).rmsExact, statisticsOf(0, 8, seed).rmsBiased);
    }
    EXPECT_LT(statisticsOf(0, 16, 1).rmsExact, 2e-5); // 16-bit codes have their own middle
}

float encodeSrgb(float c) { return c <= 0.0031308f ? c * 12.92f : 1.055f * std::pow(c, 1 / 2.4f) - 0.055f; }
float decodeSrgb(float c) { return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f); }
float mildCurve(float c) { return std::pow(c, 0.95f); }

TEST(Surveys, detect_the_srgb_curve_and_its_inverse)
{
    EXPECT_EQ(statisticsOf(0, 8, 1, encodeSrgb).transfer, Transfer::srgb);
    EXPECT_EQ(statisticsOf(0, 8, 1, decodeSrgb).transfer, Transfer::linearised);
    EXPECT_EQ(statisticsOf(0, 16, 1, encodeSrgb).transfer, Transfer::srgb);
    EXPECT_EQ(statisticsOf(0, 8, 1, mildCurve).transfer, Transfer::linear);
    EXPECT_EQ(statisticsOf(0, 8, 1).transfer, Transfer::linear);
    EXPECT_NEAR(statisticsOf(0, 8, 1, encodeSrgb).meanLength, 1, 0.02); // the curve is undone before measuring
}

TEST(Surveys, count_fractions_on_both_sides_of_limits)
{
    // One row for each limit: just below the horizon or not, too short or not, outside the disc or not.
    const auto counted = [](glm::vec3 n, glm::vec3 rest) {
        return statisticsOfMap(floatMap(10, 1, [&](int x, int) { return x == 3 ? n : rest; }));
    };
    const glm::vec3 up(-0.6f, 0, 0.8f);
    EXPECT_NEAR(counted({0.6f, 0.8f, -0.03f}, up).belowHorizon, 0.1, 1e-9);
    EXPECT_EQ(counted({0.6f, 0.8f, -0.01f}, up).belowHorizon, 0);
    EXPECT_NEAR(counted({0, 0.5f, 0.73f}, up).shortened, 0.1, 1e-9);      // length 0.885
    EXPECT_EQ(counted({0, 0.55f, 0.75f}, up).shortened, 0);               // 0.93
    EXPECT_NEAR(counted({0.7f, 0.75f, 0.1f}, up).outsideDisc, 0.1, 1e-9); // 1.0525
    EXPECT_EQ(counted({0.71f, 0.71f, 0.1f}, up).outsideDisc, 0);          // 1.0082
    EXPECT_NEAR(counted({std::numeric_limits<float>::quiet_NaN(), 0, 1}, up).invalid, 0.1, 1e-9);
    const NormalStatistics s = counted({0, 0.6f, 0.8f}, up);
    EXPECT_NEAR(s.mean[0], -0.54, 1e-6);
    EXPECT_NEAR(s.mean[1], 0.06, 1e-6);
    EXPECT_NEAR(s.mean[2], 0.8, 1e-6);
    EXPECT_EQ(s.tilt[3], 1); // 36.87 degrees
    EXPECT_NEAR(s.lowest[0], -0.6, 1e-6);
    EXPECT_NEAR(s.highest[1], 0.6, 1e-6);
}

TEST(Surveys, detect_two_channels_by_a_constant_blue)
{
    const auto content = [](int blueRange) {
        Noise noise(8);
        Image map = makeImage(32, 32, PixelType::unorm8);
        for (std::size_t i = 0; i < map.pixelCount(); ++i) {
            const std::uint8_t t[4] = {std::uint8_t(60 + 130 * noise.next()), std::uint8_t(70 + 120 * noise.next()),
                                       std::uint8_t(255 - (i % 7 == 0 ? blueRange : 0)), 255};
            std::copy_n(t, 4, map.bytes8() + 4 * i);
        }
        return statisticsOfMap(map).content;
    };
    EXPECT_EQ(content(3), Content::twoChannel);
    EXPECT_NE(content(4), Content::twoChannel);
}

} // namespace
} // namespace cotan::maps
