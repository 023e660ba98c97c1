// Conversions from one convention to another and back, within the rounding of the stored values.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "core/loops.hpp"
#include "cotan/maps.hpp"
#include "cotan/scene.hpp"
#include "maps/texels.hpp"
#include "quantisation.hpp"

namespace cotan::maps {
namespace {

constexpr Convention kGltf{}; // xyz, green up, exact

Image recoded(const Image& map, const Convention& from, const Convention& to, PixelType type, bool dither = false)
{
    RecodeCounts counts;
    return recode(map, {.from = from, .to = to, .type = type, .dither = dither}, counts);
}

double largestAngle(const Image& a, const Convention& conventionA, const Image& b, const Convention& conventionB)
{
    const auto degrees = anglesBetween(a, conventionA, b, conventionB);
    EXPECT_EQ(std::ranges::count(degrees, -1.0f), 0);
    return *std::ranges::max_element(degrees);
}

double steepestDegrees(const Image& map)
{
    Image flat = makeImage(map.width, map.height, PixelType::float32);
    for (std::size_t i = 0; i < flat.pixelCount(); ++i)
        flat.floats()[4 * i + 2] = 1;
    Convention asStored;
    asStored.expansion = Expansion::signedValues;
    return largestAngle(map, kGltf, flat, asStored);
}

TEST(Recode, every_convention_round_trips_within_its_rounding)
{
    const Image map = makeReliefMap(Relief::waves, 64);
    const double tilt = steepestDegrees(map);
    ASSERT_LT(tilt, 45); // slope maps store at most 45 degrees
    for (Channels channels : {Channels::xyz, Channels::orthographic, Channels::stereographic, Channels::slope})
        for (Expansion expansion : {Expansion::exact, Expansion::biased})
            for (bool greenUp : {true, false})
                for (PixelType type : {PixelType::unorm8, PixelType::unorm16}) {
                    const Convention c{.expansion = expansion, .channels = channels, .greenUp = greenUp};
                    const Image there = recoded(map, kGltf, c, type);
                    // First order of the rounding, and 5 % for the higher orders.
                    const double bits = type == PixelType::unorm8 ? 8 : 16;
                    EXPECT_LT(largestAngle(map, kGltf, there, c), 1.05 * quantisationDegrees(c, int(bits), tilt))
                        << describe(c) << " " << bits;
                }
}

TEST(Recode, presets_of_one_zero_differ_in_green_only)
{
    const Image map = makeReliefMap(Relief::domes, 32);
    for (const ConventionPreset& p : conventionPresets()) {
        const bool exact = p.convention.expansion == Expansion::exact;
        const Convention from{.expansion = p.convention.expansion};
        const Image there = recoded(map, from, p.convention, PixelType::unorm8);
        for (std::size_t i = 0; i < map.pixelCount(); ++i) {
            const std::uint8_t *a = map.bytes8() + 4 * i, *b = there.bytes8() + 4 * i;
            EXPECT_EQ(a[0], b[0]);
            EXPECT_EQ(a[2], b[2]);
            EXPECT_EQ(int(b[1]), p.convention.greenUp ? int(a[1]) : (exact ? 256 : 255) - a[1]) << p.name;
        }
    }
}

TEST(Recode, reversing_green_twice_restores_every_byte)
{
    Image map = makeReliefMap(Relief::bricks, 32);
    for (std::size_t i = 0; i < map.pixelCount(); ++i)
        for (int c = 0; c < 3; ++c) // lengths well below 1, as in filtered maps
            map.bytes8()[4 * i + c] = std::uint8_t(128 + (map.bytes8()[4 * i + c] - 128) / 2);
    map.bytes8()[3] = 17;
    Convention down = kGltf;
    down.greenUp = false;
    const Image back = recoded(recoded(map, kGltf, down, PixelType::unorm8), down, kGltf, PixelType::unorm8);
    EXPECT_EQ(back.data, map.data);
}

TEST(Recode, component_tables_of_8_bits_equal_whole_texels)
{
    Image map = makeImage(256, 3, PixelType::unorm8); // every code in every channel; three texels have no length
    for (std::size_t i = 0; i < map.pixelCount(); ++i)
        for (std::size_t c = 0; c < 4; ++c)
            map.bytes8()[4 * i + c] = std::uint8_t(c == i / 256 ? i % 256 : 128);
    for (Expansion expansion : {Expansion::exact, Expansion::biased})
        for (bool greenUp : {true, false}) {
            const Convention to{.expansion = expansion, .greenUp = greenUp};
            RecodeCounts counts, whole;
            const Image a = recode(map, {.from = kGltf, .to = to, .type = PixelType::unorm8}, counts);
            const Image b = recode(map, {.from = kGltf, .to = to, .type = PixelType::float32}, whole); // texel by texel
            EXPECT_EQ(counts.invalid, whole.invalid);
            EXPECT_EQ(counts.invalid, 3u);
            for (std::size_t i = 0; i < map.pixelCount() * 4; ++i) {
                if (i % 4 == 3)
                    continue;
                const float value = std::clamp(b.floats()[i], 0.0f, 1.0f) * 2 - 1; // zero of floats is 0.5
                const float code = expansion == Expansion::exact ? 128 + 127 * value : 127.5f + 127.5f * value;
                EXPECT_EQ(int(a.bytes8()[i]), int(code + 0.5f + (expansion == Expansion::exact ? 0 : 1e-4f)))
                    << i; // floats miss 127.5, the zero of 2c - 1, by 1e-5: it is rounded up
            }
        }
}

TEST(Recode, flat_stays_flat_in_the_exact_form_even_with_dither)
{
    Image flat = makeImage(16, 16, PixelType::unorm8);
    for (std::size_t i = 0; i < flat.pixelCount(); ++i) {
        const std::uint8_t texel[4] = {128, 128, 255, 255};
        std::copy_n(texel, 4, flat.bytes8() + 4 * i);
    }
    EXPECT_EQ(recoded(flat, kGltf, kGltf, PixelType::unorm8, true).data, flat.data);
    const Image deep = recoded(flat, kGltf, kGltf, PixelType::unorm16);
    EXPECT_EQ(deep.words()[0], 32768);
}

TEST(Recode, dither_keeps_the_mean_that_rounding_changes)
{
    // x = 0.3 of a step above zero at 8 bits: rounding stores 0 everywhere.
    Image map = makeImage(128, 128, PixelType::float32);
    for (std::size_t i = 0; i < map.pixelCount(); ++i) {
        map.floats()[4 * i] = 0.3f / 127;
        map.floats()[4 * i + 2] = 1;
        map.floats()[4 * i + 3] = 1;
    }
    Convention stored;
    stored.expansion = Expansion::signedValues;
    const Image plain = recoded(map, stored, kGltf, PixelType::unorm8);
    const Image noisy = recoded(map, stored, kGltf, PixelType::unorm8, true);
    double plainMean = 0, noisyMean = 0;
    for (std::size_t i = 0; i < map.pixelCount(); ++i) {
        plainMean += plain.bytes8()[4 * i] - 128.0;
        noisyMean += noisy.bytes8()[4 * i] - 128.0;
    }
    EXPECT_EQ(plainMean, 0);
    // 16384 draws with probability 0.3: standard deviation 0.0036; five of them.
    EXPECT_NEAR(noisyMean / double(map.pixelCount()), 0.3, 0.018);
}

TEST(Recode, texels_without_direction_become_flat_and_are_counted)
{
    Image map = makeImage(3, 1, PixelType::float32);
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    const float values[12] = {nan, 0, 1, 1, 0, infinity, 1, 1, 0, 0, 0, 1};
    std::copy_n(values, 12, map.floats());
    Convention stored;
    stored.expansion = Expansion::signedValues;
    RecodeCounts counts;
    const Image out = recode(map, {.from = stored, .to = kGltf, .type = PixelType::unorm8}, counts);
    EXPECT_EQ(counts.invalid, 3u);
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(out.bytes8()[4 * i], 128);
        EXPECT_EQ(out.bytes8()[4 * i + 2], 255);
    }
}

TEST(Recode, strength_multiplies_slopes)
{
    Image map = makeImage(1, 1, PixelType::float32);
    const float tilted[4] = {0.6f, 0, 0.8f, 1}; // slope 0.75
    std::copy_n(tilted, 4, map.floats());
    Convention stored;
    stored.expansion = Expansion::signedValues;
    RecodeCounts counts;
    const Image out = recode(map, {.from = stored, .to = stored, .type = PixelType::float32, .strength = 2}, counts);
    EXPECT_NEAR(out.floats()[0] / out.floats()[2], 1.5, 1e-6); // float rounding
    EXPECT_NEAR(glm::length(glm::vec3(out.floats()[0], out.floats()[1], out.floats()[2])), 1, 1e-6);
}

TEST(Recode, clamped_slopes_are_counted)
{
    Image map = makeImage(2, 1, PixelType::float32);
    const float texels[8] = {0.8f, 0, 0.6f, 1, 0.6f, 0, 0.8f, 1};
    std::copy_n(texels, 8, map.floats());
    Convention stored, slope;
    stored.expansion = Expansion::signedValues;
    slope.channels = Channels::slope;
    RecodeCounts counts;
    recode(map, {.from = stored, .to = slope, .type = PixelType::unorm16}, counts);
    EXPECT_EQ(counts.clamped, 1u);
}

TEST(Recode, threads_do_not_change_a_byte)
{
    const Image map = makeReliefMap(Relief::waves, 200);
    const Convention to{.expansion = Expansion::biased, .channels = Channels::stereographic, .greenUp = false};
    const Image many = recoded(map, kGltf, to, PixelType::unorm8, true);
    withThreads(1, [&] { EXPECT_EQ(recoded(map, kGltf, to, PixelType::unorm8, true).data, many.data); });
}

TEST(Diff, angle_between_tilted_maps_is_their_tilt)
{
    Image a = makeImage(1, 1, PixelType::float32), b = a;
    a.floats()[2] = 1;
    b.floats()[0] = float(std::sin(0.01)), b.floats()[2] = float(std::cos(0.01));
    Convention stored;
    stored.expansion = Expansion::signedValues;
    EXPECT_NEAR(anglesBetween(a, stored, b, stored)[0], 0.01 * 180 / 3.14159265358979, 1e-5); // float rounding
}

// Values that C++ callers may cast to the enumerations.
TEST(Descriptions, invalidEnumeratorsAreDescribedAsValidOnes)
{
    EXPECT_EQ(describe(Content(99)), describe(Content::other));
    EXPECT_STREQ(name(Fault::Kind(-1)), "no_normals");
    const Convention none{.kind = MapKind(9), .expansion = Expansion(9), .channels = Channels(9)};
    EXPECT_EQ(describe(none), "height, slopes, green up, v down, signed");
}

TEST(Heights, spectralKernelFallsBackToScharr)
{
    const Image height = makeReliefMap(Relief::waves, 20);
    std::size_t invalid = 0;
    FromHeightSettings settings;
    settings.kernel = Kernel::scharr;
    const Image scharr = normalsFromHeight(height, settings, invalid);
    settings.kernel = Kernel::spectral;
    EXPECT_EQ(normalsFromHeight(height, settings, invalid).data, scharr.data);
}

} // namespace
} // namespace cotan::maps
