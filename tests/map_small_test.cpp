// Blends, mips and conversions on maps small enough for results by hand; x and y always differ.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "cotan/maps.hpp"
#include "map_cases.hpp"
#include "quantisation.hpp"

namespace cotan::maps {
namespace {

using namespace cases;

constexpr double kSingle = 2e-6; // a few float operations on numbers up to 1

Image blendOf(const Image& base, const Image& detail, BlendSettings s)
{
    std::size_t invalid = 0;
    s.base = s.detail = s.to = kFloats;
    s.type = PixelType::float32;
    return blend(base, detail, s, invalid);
}

void expectSlopes(const Image& map, int x, int y, glm::dvec2 expected)
{
    const glm::dvec2 found = slopesOf(texelAt(map, x, y));
    EXPECT_NEAR(found.x, expected.x, kSingle) << x << ' ' << y;
    EXPECT_NEAR(found.y, expected.y, kSingle) << x << ' ' << y;
}

const auto kFlat = [](int, int) { return ofSlopes(0, 0); };

TEST(SmallBlends, strength_multiplies_both_slopes_of_the_detail)
{
    const Image detail = floatMap(1, 1, [](int, int) { return ofSlopes(0.4, -0.8); });
    const Image base = floatMap(1, 1, [](int, int) { return ofSlopes(0.1, 0.3); });
    expectSlopes(blendOf(base, detail, {.mode = BlendMode::slopes, .strength = 0.5f}), 0, 0, {0.3, -0.1});
    expectSlopes(blendOf(base, detail, {.mode = BlendMode::slopes, .strength = -2}), 0, 0, {-0.7, 1.9});
}

TEST(SmallBlends, every_mode_follows_its_formula)
{
    const Image base = floatMap(1, 1, [](int, int) { return glm::vec3(0.48f, 0.6f, 0.64f); });
    const Image detail = floatMap(1, 1, [](int, int) { return glm::vec3(-0.36f, 0.48f, 0.8f); });
    const auto expectMode = [&](BlendMode mode, glm::vec3 expected) {
        EXPECT_LT(glm::length(texelAt(blendOf(base, detail, {.mode = mode}), 0, 0) - glm::normalize(expected)), 1e-6f)
            << int(mode);
    };
    expectMode(BlendMode::whiteout, {0.12f, 1.08f, 0.512f});
    expectMode(BlendMode::udn, {0.12f, 1.08f, 0.64f});
    expectMode(BlendMode::linear, {0.12f, 1.08f, 1.44f});
    expectMode(BlendMode::slopes, {0.3f, 1.5375f, 1});
    const glm::vec3 t(0.48f, 0.6f, 1.64f), u(0.36f, -0.48f, 0.8f);
    expectMode(BlendMode::reoriented, t * (glm::dot(t, u) / 1.64f) - u);
}

TEST(SmallBlends, tiles_and_masks_follow_columns_and_rows)
{
    // Slope 1 right in the left half of the detail, 0.5 up in its lower half: 2 x 2 texels, two tiles across, one down.
    const Image detail = floatMap(2, 2, [](int x, int y) { return ofSlopes(x == 0 ? 1 : 0, y == 1 ? 0.5 : 0); });
    Image mask = makeImage(4, 1, PixelType::unorm16); // 0, 1/3, 2/3, 1
    for (int x = 0; x < 4; ++x)
        mask.words()[4 * x] = std::uint16_t(21845 * x);
    const Image base = floatMap(4, 2, kFlat);
    const Image out = blendOf(base, detail, {.mode = BlendMode::slopes, .tilesX = 2, .tilesY = 1, .mask = &mask});
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 4; ++x)
            expectSlopes(out, x, y, {x % 2 == 0 ? x / 3.0 : 0, y == 1 ? 0.5 * x / 3.0 : 0});
    Image down = makeImage(1, 2, PixelType::unorm8); // the lower row only
    down.bytes8()[4] = 255;
    const Image lower = blendOf(base, detail, {.mode = BlendMode::slopes, .tilesX = 2, .mask = &down});
    expectSlopes(lower, 0, 0, {0, 0});
    expectSlopes(lower, 0, 1, {1, 0.5});
}

TEST(SmallBlends, a_small_detail_is_filtered_linearly_and_repeats)
{
    // Two columns over four: centres at 1/4, 3/4, 5/4, 7/4 of a column, so the neighbours weigh 3/4 and 1/4.
    const glm::vec3 a = ofSlopes(0.6, 0.2), b = ofSlopes(-0.3, 0.4);
    const Image detail = floatMap(2, 1, [&](int x, int) { return x == 0 ? a : b; });
    const Image out = blendOf(floatMap(4, 1, kFlat), detail, {.mode = BlendMode::slopes});
    const float weight[4] = {0.75f, 0.75f, 0.25f, 0.25f};
    for (int x = 0; x < 4; ++x)
        EXPECT_LT(glm::length(texelAt(out, x, 0) - glm::normalize(a * weight[x] + b * (1 - weight[x]))), 1e-6f) << x;
    // Likewise down the rows.
    const Image upright = floatMap(1, 2, [&](int, int y) { return y == 0 ? a : b; });
    const Image down = blendOf(floatMap(1, 4, kFlat), upright, {.mode = BlendMode::slopes});
    for (int y = 0; y < 4; ++y)
        EXPECT_LT(glm::length(texelAt(down, 0, y) - glm::normalize(a * weight[y] + b * (1 - weight[y]))), 1e-6f) << y;
}

TEST(SmallBlends, a_large_detail_is_averaged_by_texel_area)
{
    // Three columns over two: the first covers one and a half columns.
    const glm::vec3 n[3] = {ofSlopes(0.6, 0.2), ofSlopes(-0.3, 0.4), ofSlopes(0.1, -0.9)};
    const Image detail = floatMap(3, 1, [&](int x, int) { return n[x]; });
    const Image out = blendOf(floatMap(2, 1, kFlat), detail, {.mode = BlendMode::slopes});
    EXPECT_LT(glm::length(texelAt(out, 0, 0) - glm::normalize(n[0] * 2.0f + n[1])), 1e-6f);
    EXPECT_LT(glm::length(texelAt(out, 1, 0) - glm::normalize(n[1] + n[2] * 2.0f)), 1e-6f);
}

TEST(SmallBlends, strips_equal_the_whole)
{
    Noise noise(5);
    const auto rough = [&](int, int) { return ofSlopes(noise.next() - 0.5, 0.7 * noise.next()); };
    const Image base = floatMap(9, 40, rough), detail = floatMap(5, 7, rough);
    Image mask = makeImage(3, 4, PixelType::unorm8);
    for (std::size_t i = 0; i < mask.data.size(); ++i)
        mask.bytes8()[i] = std::uint8_t(255 * noise.next());
    BlendSettings s{.base = kFloats,
                    .detail = kFloats,
                    .to = {},
                    .strength = 0.7f,
                    .tilesX = 2,
                    .tilesY = 3,
                    .mask = &mask,
                    .type = PixelType::unorm8,
                    .dither = true,
                    .imageHeight = 40};
    std::size_t invalid = 0;
    const Image whole = blend(base, detail, s, invalid), top = blend(rowsBetween(base, 0, 13), detail, s, invalid);
    s.firstRow = 13;
    EXPECT_EQ(joined(top, blend(rowsBetween(base, 13, 40), detail, s, invalid)).data, whole.data);
}

TEST(SmallMips, an_impulse_is_weighted_by_area_in_odd_sizes)
{
    // 5 x 3 becomes 2 x 1: each texel covers 2.5 columns and 3 rows.
    const glm::vec3 up(0, 0, 1), tilted = ofSlopes(0.5, -1.5);
    const MipSettings s{.from = kFloats, .to = kFloats, .keepLengths = true, .type = PixelType::float32};
    const double left[5] = {1 / 7.5, 1 / 7.5, 0.5 / 7.5, 0, 0};
    for (int x = 0; x < 5; ++x)
        for (int y = 0; y < 3; ++y) {
            const auto chain =
                mipChain(floatMap(5, 3, [&](int i, int j) { return i == x && j == y ? tilted : up; }), s);
            for (int side = 0; side < 2; ++side) {
                const float weight = float(left[side == 0 ? x : 4 - x]);
                EXPECT_LT(glm::length(texelAt(chain[1].normals, side, 0) - (up * (1 - weight) + tilted * weight)),
                          1e-6f)
                    << x << ' ' << y;
            }
            // The last level is the mean of all 15.
            EXPECT_LT(glm::length(texelAt(chain[2].normals, 0, 0) - (up * 14.0f + tilted) / 15.0f), 1e-6f);
        }
    // Down the rows: 1 x 5 becomes 1 x 2.
    for (int y = 0; y < 5; ++y) {
        const auto chain = mipChain(floatMap(1, 5, [&](int, int j) { return j == y ? tilted : up; }), s);
        const float weight = float(3 * left[y]);
        EXPECT_LT(glm::length(texelAt(chain[1].normals, 0, 0) - (up * (1 - weight) + tilted * weight)), 1e-6f) << y;
    }
}

TEST(SmallMips, lean_adds_the_variances_of_both_slopes)
{
    // Right slopes 0.3 and -0.1, up slopes 0.5 and 1.1: variances 0.04 and 0.09.
    const Image map = floatMap(2, 2, [](int x, int y) { return ofSlopes(x == 0 ? 0.3 : -0.1, y == 0 ? 0.5 : 1.1); });
    const auto chain = mipChain(map, {.from = kFloats, .to = kFloats, .roughness = 0.4, .type = PixelType::float32});
    const double expected = std::pow(0.0256 + 0.04 + 0.09, 0.25);
    EXPECT_NEAR(chain[1].meanRoughness, expected, kSingle);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(double(chain[1].roughness.floats()[c]), expected, kSingle);
    EXPECT_NEAR(double(chain[0].roughness.floats()[0]), 0.4, kSingle);
}

TEST(SmallMips, toksvig_and_vmf_follow_the_length_of_the_mean)
{
    const Image map = floatMap(2, 1, [](int x, int) { return ofSlopes(x == 0 ? 0.9 : -0.4, x == 0 ? -0.2 : 0.5); });
    const double length = double(glm::length(texelAt(map, 0, 0) + texelAt(map, 1, 0))) / 2, alpha2 = std::pow(0.3, 4);
    const double exponent = 2 / alpha2 - 2,
                 shortened = exponent / (1 + exponent * (1 - length) / length); // exponent of Blinn-Phong
    const double kappa = (3 * length - length * length * length) / (1 - length * length);
    for (auto [model, expected] :
         {std::pair(VarianceModel::toksvig, 2 / (shortened + 2)), {VarianceModel::vmf, alpha2 + 2 / kappa}}) {
        const auto chain = mipChain(
            map, {.from = kFloats, .to = kFloats, .model = model, .roughness = 0.3, .type = PixelType::float32});
        EXPECT_NEAR(chain[1].meanRoughness, std::pow(expected, 0.25), kSingle) << int(model);
        EXPECT_NEAR(chain[1].meanLength, length, kSingle);
        EXPECT_NEAR(double(glm::length(texelAt(chain[1].normals, 0, 0))), 1, kSingle); // lengths are not kept
    }
}

TEST(SmallMips, texels_without_direction_are_ignored)
{
    const glm::vec3 tilted = ofSlopes(0.5, -1.5);
    const Image map = floatMap(2, 1, [&](int x, int) { return x == 0 ? glm::vec3(0) : tilted; });
    const auto chain = mipChain(map, {.from = kFloats, .to = kFloats, .roughness = 0.5, .type = PixelType::float32});
    EXPECT_LT(glm::length(texelAt(chain[1].normals, 0, 0) - tilted), 1e-6f);
    EXPECT_NEAR(chain[1].meanRoughness, 0.5, kSingle);
    EXPECT_NEAR(chain[0].meanLength, 1, kSingle);
}

Image recoded(const Image& map, RecodeSettings s)
{
    RecodeCounts counts;
    return recode(map, s, counts);
}

// 128 is no zero of 2c - 1, which keeps the 0.0039 that it means.
TEST(SmallConversions, flat_stays_flat_between_all_exact_conventions_and_depths)
{
    const auto exact = [](const ConventionPreset& p) { return p.convention.expansion == Expansion::exact; };
    for (const ConventionPreset& from : conventionPresets())
        for (const ConventionPreset& to : conventionPresets())
            for (PixelType type : {PixelType::unorm8, PixelType::unorm16}) {
                if (!exact(from) || !exact(to))
                    continue;
                Image flat = makeImage(1, 1, PixelType::unorm8);
                const std::uint8_t texel[4] = {128, 128, 255, 255};
                std::copy_n(texel, 4, flat.bytes8());
                const Image out = recoded(flat, {.from = from.convention, .to = to.convention, .type = type});
                const int middle = type == PixelType::unorm8 ? 128 : 32768;
                for (int c = 0; c < 2; ++c)
                    EXPECT_EQ(type == PixelType::unorm8 ? out.bytes8()[c] : out.words()[c], middle)
                        << from.name << " to " << to.name;
                const Image back =
                    recoded(out, {.from = to.convention, .to = from.convention, .type = PixelType::unorm8});
                EXPECT_EQ(int(back.bytes8()[1]), 128);
            }
}

TEST(SmallConversions, the_middle_code_is_flat_in_every_type)
{
    Image deep = makeImage(1, 1, PixelType::unorm16), floats = makeImage(1, 1, PixelType::float32);
    const std::uint16_t words[4] = {32768, 32768, 65535, 65535};
    const float half[4] = {0.5f, 0.5f, 1, 1};
    std::copy_n(words, 4, deep.words());
    std::copy_n(half, 4, floats.floats());
    for (const Image& map : {deep, floats}) {
        glm::vec3 n;
        decodeRow(map, 0, {}, {&n, 1});
        EXPECT_LT(glm::length(n - glm::vec3(0, 0, 1)), 1e-6f);
    }
    // Code 128 of the exact form in an engine that expands with 2c - 1: 1/255 in x and y instead of 0.
    const Convention biased{.expansion = Expansion::biased};
    const glm::vec3 seen = decodeTexel(glm::vec4(128 / 255.0f, 128 / 255.0f, 1, 1), biased, PixelType::unorm8);
    EXPECT_NEAR(double(seen.x), 1.0 / 255, 1e-7);
    EXPECT_NEAR(double(decodeTexel(glm::vec4(32768 / 65535.0f, 0.5f, 1, 1), biased, PixelType::unorm16).x), 1.0 / 65535,
                1e-7);
}

TEST(SmallConversions, strength_multiplies_both_slopes_and_makes_unit_again)
{
    const Image out = recoded(floatMap(1, 1, [](int, int) { return ofSlopes(0.4, -0.6); }),
                              {.from = kFloats, .to = kFloats, .type = PixelType::float32, .strength = 1.5f});
    expectSlopes(out, 0, 0, {0.6, -0.9});
    EXPECT_NEAR(double(glm::length(texelAt(out, 0, 0))), 1, kSingle);
}

TEST(SmallConversions, lengths_are_kept_unless_normalised)
{
    const Image map = floatMap(1, 1, [](int, int) { return 0.7f * ofSlopes(0.4, -0.6); });
    const RecodeSettings keep{.from = kFloats, .to = kFloats, .type = PixelType::float32};
    EXPECT_NEAR(double(glm::length(texelAt(recoded(map, keep), 0, 0))), 0.7, kSingle);
    RecodeSettings unit = keep;
    unit.normalise = true;
    EXPECT_NEAR(double(glm::length(texelAt(recoded(map, unit), 0, 0))), 1, kSingle);
}

TEST(SmallConversions, clamped_texels_are_counted_from_the_limit_on)
{
    const auto clampedIn = [](Channels channels, glm::vec3 n) {
        RecodeCounts counts;
        Convention to;
        to.channels = channels;
        recode(floatMap(1, 1, [&](int, int) { return n; }), {.from = kFloats, .to = to, .type = PixelType::unorm16},
               counts);
        return counts.clamped;
    };
    EXPECT_EQ(clampedIn(Channels::slope, ofSlopes(0.99, -0.99)), 0u);
    EXPECT_EQ(clampedIn(Channels::slope, ofSlopes(1.01, 0)), 1u);
    EXPECT_EQ(clampedIn(Channels::slope, ofSlopes(0, -1.01)), 1u);
    EXPECT_EQ(clampedIn(Channels::orthographic, {0.6f, 0.8f, 0.01f}), 0u);
    EXPECT_EQ(clampedIn(Channels::orthographic, {0.6f, 0.8f, -0.01f}), 1u);
    EXPECT_EQ(clampedIn(Channels::stereographic, {0.6f, 0.8f, 0.0f}), 0u);
    EXPECT_EQ(clampedIn(Channels::stereographic, {0.6f, 0.8f, -0.05f}), 1u);
    EXPECT_EQ(clampedIn(Channels::xyz, {0.6f, 0, -0.8f}), 0u);
}

TEST(SmallConversions, strips_equal_the_whole_with_dither)
{
    Noise noise(6);
    const Image map = floatMap(7, 40, [&](int, int) { return ofSlopes(noise.next() - 0.5, 0.7 * noise.next()); });
    RecodeSettings s{.from = kFloats, .to = {}, .type = PixelType::unorm8, .dither = true};
    const Image whole = recoded(map, s), top = recoded(rowsBetween(map, 0, 11), s);
    s.firstRow = 11;
    EXPECT_EQ(joined(top, recoded(rowsBetween(map, 11, 40), s)).data, whole.data);
}

TEST(SmallConversions, three_channels_keep_alpha_and_two_set_it_to_one)
{
    Image map = makeImage(1, 1, PixelType::unorm8);
    const std::uint8_t texel[4] = {150, 90, 240, 17};
    std::copy_n(texel, 4, map.bytes8());
    Convention two;
    two.channels = Channels::orthographic;
    EXPECT_EQ(recoded(map, {.from = {}, .to = {}, .type = PixelType::unorm16}).words()[3], 17 * 257);
    EXPECT_EQ(recoded(map, {.from = {}, .to = two, .type = PixelType::unorm8}).bytes8()[3], 255);
}

TEST(SmallConversions, non_finite_values_are_stored_as_zero)
{
    for (PixelType type : {PixelType::unorm8, PixelType::unorm16, PixelType::float32}) {
        Image image = makeImage(1, 1, type);
        std::ranges::fill(image.data, std::byte(77));
        const glm::vec4 bad(std::numeric_limits<float>::quiet_NaN(), -1e30f * 1e30f, 0, 1);
        storeRow(image, 0, {&bad, 1});
        glm::vec4 back(5);
        loadRow(image, 0, {&back, 1});
        EXPECT_EQ(back, glm::vec4(0, 0, 0, 1)) << int(type);
    }
}

TEST(SmallConversions, swizzles_put_x_and_y_into_red_and_green)
{
    const auto moved = [](Swizzle from) {
        Image image = makeImage(1, 1, PixelType::unorm8);
        const std::uint8_t texel[4] = {10, 20, 30, 40};
        std::copy_n(texel, 4, image.bytes8());
        unswizzle(image, from);
        return image;
    };
    EXPECT_EQ(int(moved(Swizzle::rg).bytes8()[2]), 30);
    const Image grey = moved(Swizzle::greyAlpha), dxt = moved(Swizzle::alphaGreen);
    EXPECT_EQ(int(grey.bytes8()[0]), 10);
    EXPECT_EQ(int(grey.bytes8()[1]), 40);
    EXPECT_EQ(int(dxt.bytes8()[0]), 40);
    EXPECT_EQ(int(dxt.bytes8()[1]), 20);
    EXPECT_EQ(int(grey.bytes8()[3]), 255);
    EXPECT_EQ(int(dxt.bytes8()[3]), 255);
}

TEST(SmallConversions, swizzles_are_detected_by_channels_varying_over_three_codes)
{
    const auto swizzle = [](int red, int green, int blue, int alpha) { // range of each channel from 100 upwards
        Image image = makeImage(2, 1, PixelType::unorm8);
        const int range[4] = {red, green, blue, alpha};
        for (int c = 0; c < 4; ++c) {
            image.bytes8()[c] = 100;
            image.bytes8()[4 + c] = std::uint8_t(100 + range[c]);
        }
        return swizzleOf(image);
    };
    EXPECT_EQ(swizzle(50, 50, 50, 4), Swizzle::greyAlpha);
    EXPECT_EQ(swizzle(50, 50, 50, 3), Swizzle::rg);
    EXPECT_EQ(swizzle(50, 50, 49, 50), Swizzle::rg); // not grey
    EXPECT_EQ(swizzle(3, 50, 0, 50), Swizzle::alphaGreen);
    EXPECT_EQ(swizzle(4, 50, 0, 50), Swizzle::rg);
    EXPECT_EQ(swizzle(0, 3, 1, 50), Swizzle::rg);
}

TEST(SmallConversions, angles_compare_directions_not_codes)
{
    Convention down;
    down.greenUp = false;
    Image a = makeImage(2, 1, PixelType::unorm8);
    const std::uint8_t texels[8] = {128, 128 + 76, 128 + 102, 255, 128, 128, 128, 255}; // (0, 0.6, 0.8), and flat
    std::copy_n(texels, 8, a.bytes8());
    const auto degrees = anglesBetween(a, {}, a, down);
    EXPECT_NEAR(double(degrees[0]), 2 * std::atan2(76, 102) * 180 / 3.14159265358979, 1e-4);
    EXPECT_EQ(degrees[1], -1);
}

TEST(SmallConversions, rounding_errors_match_the_documentation)
{
    const auto degrees = [](Channels channels, int bits, double tilt) {
        Convention c;
        c.channels = channels;
        return quantisationDegrees(c, bits, tilt);
    };
    EXPECT_NEAR(degrees(Channels::xyz, 8, 0), 0.39, 0.005); // sqrt(3) half steps of 1/127
    EXPECT_NEAR(degrees(Channels::xyz, 16, 60), 0.0015, 0.00005);
    EXPECT_NEAR(degrees(Channels::orthographic, 8, 0), 0.32, 0.005);
    EXPECT_NEAR(degrees(Channels::orthographic, 8, 60), 0.64, 0.005);
    EXPECT_NEAR(degrees(Channels::stereographic, 8, 60), 0.64, 0.005);
    EXPECT_NEAR(degrees(Channels::slope, 8, 0), 0.32, 0.005);
}

} // namespace
} // namespace cotan::maps
