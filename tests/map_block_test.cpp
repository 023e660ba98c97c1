// BC5, BC4 and EAC, decoded by the definition of their blocks, and BC7, decoded by OpenImageIO.
#include "maps/blocks/block.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <random>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

#include "core/loops.hpp"
#include "cotan/image.hpp"
#include "image/dds.hpp"
#include "image/etc.hpp"
#include "maps/blocks/block_texels.hpp"

namespace cotan::maps {

namespace {

using Half = std::array<double, 16>;

std::array<double, 8> blockLevels(double a, double b)
{
    std::array<double, 8> levels{a, b};
    for (int i = 1; i < 7; ++i) // a > b in every block here
        levels[std::size_t(i) + 1] = ((7 - i) * a + i * b) / 7;
    return levels;
}

// Decoded codes, not rounded, as GPUs compute them.
Half decodedHalf(const std::byte* block)
{
    const auto levels = blockLevels(std::to_integer<int>(block[0]), std::to_integer<int>(block[1]));
    EXPECT_GT(block[0], block[1]) << "the other kind of block";
    std::uint64_t bits = 0;
    for (int i = 7; i >= 2; --i)
        bits = bits << 8 | std::to_integer<std::uint64_t>(block[i]);
    Half texels{};
    for (std::size_t i = 0; i < 16; ++i)
        texels[i] = levels[bits >> 3 * i & 7];
    return texels;
}

double angleError(glm::dvec2 codes, const glm::dvec3& normal)
{
    const glm::dvec2 xy = (codes - 128.0) / 127.0;
    const glm::dvec3 n = glm::normalize(glm::dvec3(xy, std::sqrt(std::max(0.0, 1 - glm::dot(xy, xy)))));
    return glm::degrees(std::atan2(glm::length(glm::cross(n, normal)), glm::dot(n, normal)));
}

Image blockOf(const std::vector<glm::dvec3>& normals, int width)
{
    Image image = makeImage(width, int(normals.size()) / width, PixelType::float32);
    for (std::size_t i = 0; i < normals.size(); ++i)
        for (int c = 0; c < 3; ++c)
            image.floats()[4 * i + std::size_t(c)] = float((normals[i][c] + 1) / 2);
    return image;
}

// A block of directions within `range` radians of one that is tilted by `tilt` degrees.
std::vector<glm::dvec3> tilted(double tilt, double range, std::mt19937& random)
{
    std::uniform_real_distribution<double> azimuth(0, glm::radians(360.0)), step(-range, range);
    const double around = azimuth(random);
    std::vector<glm::dvec3> normals;
    for (int i = 0; i < 16; ++i) {
        const double angle = glm::radians(tilt) + step(random), at = around + step(random);
        normals.emplace_back(std::sin(angle) * std::cos(at), std::sin(angle) * std::sin(at), std::cos(angle));
    }
    return normals;
}

Half codesOf(const std::vector<glm::dvec3>& normals, int axis)
{
    Half codes{};
    for (std::size_t i = 0; i < 16; ++i)
        codes[i] = 128 + 127 * normals[i][axis];
    return codes;
}

// The best fit of a single channel over all endpoint pairs, by the sum of squared code differences.
Half bestChannel(const Half& values)
{
    Half best{};
    double least = 1e30;
    for (int a = 1; a < 256; ++a)
        for (int b = 0; b < a; ++b) {
            const auto levels = blockLevels(a, b);
            Half picked{};
            double sum = 0;
            for (std::size_t i = 0; i < 16; ++i) {
                picked[i] = levels[0];
                for (const double level : levels)
                    if (std::abs(level - values[i]) < std::abs(picked[i] - values[i]))
                        picked[i] = level;
                sum += (picked[i] - values[i]) * (picked[i] - values[i]);
            }
            if (sum < least) {
                least = sum;
                best = picked;
            }
        }
    return best;
}

TEST(Block, constantBlocksAreKeptWithinAFractionOfACode)
{
    for (const glm::dvec3& n : {glm::dvec3(0, 0, 1), glm::normalize(glm::dvec3(0.3, -0.4, 0.7))}) {
        const auto bytes = encodeBc5(blockOf(std::vector<glm::dvec3>(16, n), 4), {});
        ASSERT_EQ(bytes.size(), 16u);
        const Half x = decodedHalf(bytes.data()), y = decodedHalf(bytes.data() + 8);
        for (std::size_t i = 0; i < 16; ++i) {
            EXPECT_NEAR(x[i], 128 + 127 * n.x, n.x == 0 ? 0 : 0.5 / 7 + 1e-3); // half a step of endpoints 1 apart
            EXPECT_NEAR(y[i], 128 + 127 * n.y, n.y == 0 ? 0 : 0.5 / 7 + 1e-3);
        }
    }
}

// The closest code of each channel is not the smallest angle: for steep normals, z multiplies the error of x and y.
TEST(Block, anglesAreSmallerThanThoseOfTheClosestCodes)
{
    std::mt19937 random(7);
    double ours = 0, closest = 0;
    for (int block = 0; block < 12; ++block) {
        const auto normals = tilted(65, 0.2, random);
        const auto bytes = encodeBc5(blockOf(normals, 4), {});
        const Half x = codesOf(normals, 0), y = codesOf(normals, 1);
        const Half ourX = decodedHalf(bytes.data()), ourY = decodedHalf(bytes.data() + 8), bestX = bestChannel(x),
                   bestY = bestChannel(y);
        for (std::size_t i = 0; i < 16; ++i) {
            ours += angleError({ourX[i], ourY[i]}, normals[i]) / (12 * 16);
            closest += angleError({bestX[i], bestY[i]}, normals[i]) / (12 * 16);
        }
    }
    EXPECT_LT(ours, 0.9 * closest) << ours << " degrees, " << closest;
}

// For gentle normals both criteria agree, and the exhaustive search over endpoints is optimal.
TEST(Block, endpointsOfGentleNormalsAreNearlyOptimal)
{
    std::mt19937 random(11);
    double ours = 0, best = 0;
    for (int block = 0; block < 12; ++block) {
        const auto normals = tilted(10, 0.1, random);
        const auto bytes = encodeBc5(blockOf(normals, 4), {});
        const Half x = codesOf(normals, 0);
        const Half got = decodedHalf(bytes.data()), all = bestChannel(x);
        for (std::size_t i = 0; i < 16; ++i) {
            ours += (got[i] - x[i]) * (got[i] - x[i]);
            best += (all[i] - x[i]) * (all[i] - x[i]);
        }
    }
    EXPECT_LT(ours, 1.1 * best);
}

TEST(Block, oddSizesRepeatTheirEdgesForAnyThreads)
{
    std::mt19937 random(3);
    std::vector<glm::dvec3> normals;
    for (int i = 0; i < 4; ++i)
        for (const glm::dvec3& n : tilted(30, 0.4, random))
            normals.push_back(n);
    normals.resize(7 * 9, {0, 0, 1});
    const Image odd = blockOf(normals, 7);
    Image whole = makeImage(8, 12, PixelType::float32);
    for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 8; ++x)
            for (int c = 0; c < 4; ++c)
                whole.floats()[(y * 8 + x) * 4 + c] = odd.floats()[(std::min(y, 8) * 7 + std::min(x, 6)) * 4 + c];
    const auto bytes = encodeBc5(odd, {});
    EXPECT_EQ(bytes.size(), 2u * 3 * 16);
    EXPECT_EQ(bytes, encodeBc5(whole, {}));
    std::vector<std::byte> one;
    withThreads(1, [&] { one = encodeBc5(odd, {}); });
    EXPECT_EQ(one, bytes);
}

// ---- BC7 ----

using Texel = std::array<int, 4>;

// Decodes blocks by OpenImageIO: 4 x 4 texels for each block of a row.
std::vector<Texel> decodedBc7(const std::vector<std::byte>& blocks, int width = 4, int height = 4)
{
    std::vector<std::byte> dds = ddsHeader({"DX10", 98, 16}, width, height, 1);
    dds.insert(dds.end(), blocks.begin(), blocks.end());
    const auto image = decodeImage(dds, "block.dds");
    std::vector<Texel> texels(std::size_t(width) * std::size_t(height));
    if (!image || image->pixelCount() != texels.size()) {
        ADD_FAILURE() << (image ? "another size" : image.error().message);
        return texels;
    }
    for (std::size_t i = 0; i < texels.size(); ++i)
        for (std::size_t c = 0; c < 4; ++c)
            texels[i][c] = image->bytes8()[4 * i + c];
    return texels;
}

// The mode of a block: the position of its lowest bit that is 1.
int modeOf(const std::byte* block) { return std::countr_zero(std::to_integer<unsigned>(*block)); }

double angleError(const Texel& codes, const glm::dvec3& normal)
{
    const glm::dvec3 n = glm::normalize((glm::dvec3(codes[0], codes[1], codes[2]) - 128.0) / 127.0);
    return glm::degrees(std::atan2(glm::length(glm::cross(n, normal)), glm::dot(n, normal)));
}

Image opaqueBlockOf(const std::vector<glm::dvec3>& normals, int width)
{
    Image image = blockOf(normals, width);
    for (std::size_t i = 0; i < normals.size(); ++i)
        image.floats()[4 * i + 3] = 1;
    return image;
}

TEST(Bc7, linearCodesAreKeptWithinHalfAStepAndAlphaOneStays)
{
    for (const bool falls : {false, true}) { // the first index has one bit less
        Image ramp = makeImage(4, 4, PixelType::float32);
        for (int i = 0; i < 16; ++i) {
            const float t = float(falls ? 15 - i : i);
            const float codes[] = {100 + 2 * t, 200 - 3 * t, 150 + t, 40 + 5 * t};
            for (int c = 0; c < 4; ++c)
                ramp.floats()[4 * i + c] = c < 3 ? ((codes[c] - 128) / 127 + 1) / 2 : codes[c] / 255;
        }
        const auto back = decodedBc7(encodeBc7(ramp, {}, true));
        for (int i = 0; i < 16; ++i) {
            const int t = falls ? 15 - i : i;
            // Endpoints differ by at most 1 if the lowest bit does not suit all channels.
            EXPECT_NEAR(back[std::size_t(i)][0], 100 + 2 * t, 2) << i;
            EXPECT_NEAR(back[std::size_t(i)][1], 200 - 3 * t, 2) << i;
            EXPECT_NEAR(back[std::size_t(i)][3], 40 + 5 * t, 2) << i;
        }
    }
    std::mt19937 random(5);
    for (int block = 0; block < 50; ++block)
        for (const Texel& texel : decodedBc7(encodeBc7(opaqueBlockOf(tilted(40, 0.5, random), 4), {})))
            EXPECT_EQ(texel[3], 255);
}

// Any channels may rise, fall or stay constant together: red alone does not determine the direction of the line.
TEST(Bc7, opposingChannelsAreKept)
{
    const float steps[][4] = {{0, 3, -3, 0}, {3, -3, 0, 0},  {0, 0, 4, -4}, {0, 5, -5, 5},
                              {3, 0, -3, 0}, {-2, 4, 0, -4}, {0, 3, 3, 0},  {0, 0, 0, 5}};
    for (const auto& step : steps) {
        Image ramp = makeImage(4, 4, PixelType::float32);
        const auto code = [&](int i, int c) { return 150 + step[c] * float(i - 8); };
        for (int i = 0; i < 16; ++i)
            for (int c = 0; c < 4; ++c)
                ramp.floats()[4 * i + c] = c < 3 ? ((code(i, c) - 128) / 127 + 1) / 2 : code(i, c) / 255;
        const auto back = decodedBc7(encodeBc7(ramp, {}, true));
        for (int i = 0; i < 16; ++i)
            for (int c = 0; c < 4; ++c)
                EXPECT_NEAR(float(back[std::size_t(i)][std::size_t(c)]), code(i, c), 2)
                    << step[0] << step[1] << step[2] << step[3] << ' ' << i << c;
    }
}

TEST(Bc7, flatNormalsStayFlat)
{
    const auto back = decodedBc7(encodeBc7(opaqueBlockOf(std::vector<glm::dvec3>(16, glm::dvec3(0, 0, 1)), 4), {}));
    for (const Texel& texel : back) {
        // With alpha 255 the lowest bit of every endpoint is set, so 128 is interpolated between 127 and 129.
        EXPECT_EQ(texel[0], 128);
        EXPECT_EQ(texel[1], 128);
    }
}

// The length of decoded vectors does not matter. In nearly constant blocks, slightly longer or shorter vectors have
// codes that are closer in direction.
TEST(Bc7, anglesAreSmallerThanThoseOfTheClosestVectors)
{
    std::mt19937 random(9);
    double ours = 0, closest = 0;
    for (int block = 0; block < 40; ++block) {
        const auto normals = tilted(30, 0.02, random);
        const Image map = opaqueBlockOf(normals, 4);
        const auto angles = decodedBc7(encodeBc7(map, {})), vectors = decodedBc7(encodeBc7(map, {}, true));
        for (std::size_t i = 0; i < 16; ++i) {
            ours += std::pow(angleError(angles[i], normals[i]), 2);
            closest += std::pow(angleError(vectors[i], normals[i]), 2);
        }
    }
    EXPECT_LT(ours, 0.85 * closest) << ours << ", " << closest;
}

TEST(Bc7, oddSizesRepeatTheirEdgesForAnyThreads)
{
    std::mt19937 random(3);
    std::vector<glm::dvec3> normals;
    for (int i = 0; i < 4; ++i)
        for (const glm::dvec3& n : tilted(30, 0.4, random))
            normals.push_back(n);
    normals.resize(7 * 9, {0, 0, 1});
    const Image odd = opaqueBlockOf(normals, 7);
    const auto bytes = encodeBc7(odd, {});
    EXPECT_EQ(bytes.size(), 2u * 3 * 16);
    std::vector<std::byte> one;
    withThreads(1, [&] { one = encodeBc7(odd, {}); });
    EXPECT_EQ(one, bytes);
    const auto corner = decodedBc7({bytes.begin() + 16 * 5, bytes.end()}); // texels 4..6 of row 8, then copies
    for (std::size_t i = 3; i < 16; ++i)
        EXPECT_EQ(corner[i], corner[i == 3 ? 2 : i % 4]);
}

// A row of blocks: of 2 degrees around a tilt, of 30, of two halves that are smooth, of three colors, and of noise.
std::vector<glm::dvec3> mixedRow(std::size_t blocks, std::mt19937& random)
{
    std::uniform_real_distribution<double> anywhere(-0.5, 0.5), near(-0.02, 0.02);
    std::vector<glm::dvec3> normals(16 * blocks);
    for (std::size_t b = 0; b < blocks; ++b) {
        const glm::dvec2 slopes[] = {{anywhere(random), anywhere(random)}, {anywhere(random), anywhere(random)}};
        const double range = b % 4 == 0 ? 0.02 : b % 4 == 1 ? 0.1 : b % 4 == 2 ? 0.3 : 1;
        for (std::size_t i = 0; i < 16; ++i) {
            glm::dvec2 at = slopes[b % 3 == 0 && i % 4 > 1] + range * glm::dvec2(anywhere(random), near(random));
            if (b % 5 == 4)
                at = range * glm::dvec2(anywhere(random), anywhere(random));
            normals[i / 4 * 4 * blocks + 4 * b + i % 4] = glm::normalize(glm::dvec3(at, 1));
        }
    }
    return normals;
}

// If a partition, an anchor or the order of a mode's fields were wrong, its texels would be off by tens of degrees.
TEST(Bc7, eachModeAndPartitionIsReadByAnotherDecoder)
{
    std::mt19937 random(13);
    constexpr std::size_t kBlocks = 3000;
    const auto normals = mixedRow(kBlocks, random);
    Image map = opaqueBlockOf(normals, 4 * int(kBlocks));
    for (const bool opaque : {true, false}) {
        std::uniform_real_distribution<float> alpha(0.2f, 0.9f);
        for (std::size_t i = 0; i < normals.size() && !opaque; ++i)
            map.floats()[4 * i + 3] = i / 4 % 2 == 0 ? 0.5f : alpha(random);
        const auto blocks = encodeBc7(map, {});
        const auto texels = decodedBc7(blocks, 4 * int(kBlocks));
        std::array<int, 8> modes{};
        std::array<bool, 64> partitions{};
        double worst = 0;
        for (std::size_t b = 0; b < kBlocks; ++b) {
            const int mode = modeOf(&blocks[16 * b]);
            ++modes.at(std::size_t(mode));
            const auto head =
                std::to_integer<std::size_t>(blocks[16 * b]) | std::to_integer<std::size_t>(blocks[16 * b + 1]) << 8;
            if (mode == 1 || mode == 3)
                partitions[head >> (mode + 1) & 63] = true;
        }
        for (std::size_t i = 0; i < normals.size(); ++i) {
            worst = std::max(worst, angleError(texels[i], normals[i]));
            EXPECT_NEAR(float(texels[i][3]), 255 * map.floats()[4 * i + 3], opaque ? 0 : 60) << i;
        }
        EXPECT_LT(worst, opaque ? 15 : 45);
        for (const int mode : opaque ? std::vector{0, 1, 3, 4, 5, 6} : std::vector{4, 5, 6, 7})
            EXPECT_GT(modes[std::size_t(mode)], 0) << mode;
        EXPECT_EQ(std::count(partitions.begin(), partitions.end(), true), opaque ? 64 : 0);
    }
}

// Where x and y are independent, one line for both is of no use. BC5 has eight values for x and eight for y; BC7 has
// four for one of them.
TEST(Bc7, independentSlopesAreNearlyAsExactAsInBc5)
{
    std::mt19937 random(17);
    std::uniform_real_distribution<double> slope(-0.5, 0.5);
    double three = 0, two = 0;
    for (int block = 0; block < 200; ++block) {
        std::vector<glm::dvec3> normals(16);
        for (glm::dvec3& n : normals)
            n = glm::normalize(glm::dvec3(slope(random), slope(random), 1));
        const Image map = opaqueBlockOf(normals, 4);
        const auto texels = decodedBc7(encodeBc7(map, {}));
        const auto bytes = encodeBc5(map, {});
        const Half x = decodedHalf(bytes.data()), y = decodedHalf(bytes.data() + 8);
        for (std::size_t i = 0; i < 16; ++i) {
            three += angleError(texels[i], normals[i]);
            two += angleError(glm::dvec2(x[i], y[i]), normals[i]);
        }
    }
    EXPECT_LT(three, 1.6 * two) << three / 3200 << " degrees, " << two / 3200;
}

TEST(Block, oneChannelIsKeptWithinHalfAStep)
{
    Image ramp = makeImage(4, 4, PixelType::float32);
    for (int i = 0; i < 16; ++i)
        ramp.floats()[4 * i] = float(i + 40) / 255;
    const auto bytes = encodeBc4(ramp);
    ASSERT_EQ(bytes.size(), 8u);
    const Half back = decodedHalf(bytes.data());
    for (int i = 0; i < 16; ++i)
        EXPECT_NEAR(back[std::size_t(i)], i + 40, 15.0 / 7 / 2 + 0.1) << i;
}

// ---- EAC ----

// The eight codes of a channel of EAC with 11 bits: Khronos Data Format 1.3, section 21.5.
std::array<int, 8> eacCodes(int base, int factor, int table)
{
    std::array<int, 8> codes{};
    for (std::size_t k = 0; k < 8; ++k)
        codes[k] =
            std::clamp(8 * base + 4 + kEacModifiers[std::size_t(table)][k] * (factor > 0 ? 8 * factor : 1), 0, 2047);
    return codes;
}

// Sum of the squared differences of the closest codes.
double squaresTo(const std::array<int, 8>& codes, const Half& values)
{
    double sum = 0;
    for (const double value : values) {
        double least = 1e30;
        for (const int code : codes)
            least = std::min(least, (code - value) * (code - value));
        sum += least;
    }
    return sum;
}

double leastOfAllEacBlocks(const Half& values)
{
    double least = 1e30;
    for (int table = 0; table < 16; ++table)
        for (int factor = 0; factor < 16; ++factor)
            for (int base = 0; base < 256; ++base)
                least = std::min(least, squaresTo(eacCodes(base, factor, table), values));
    return least;
}

TEST(Eac, levelsAreNearlyThoseOfTheBestBlockForEachRange)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(0, 1);
    for (const double range : {0.0, 12.0, 28.0, 45.0, 75.0, 120.0, 180.0, 250.0, 340.0, 500.0, 690.0, 1000.0, 2000.0}) {
        constexpr int kBlocks = 3;
        double ours = 0, best = 0;
        for (int block = 0; block < kBlocks; ++block) {
            const double low = (2047 - range) * unit(random);
            Half values{};
            Image image = makeImage(4, 4, PixelType::float32);
            for (std::size_t i = 0; i < 16; ++i) { // denser in the middle, as in maps
                values[i] = low + range * (unit(random) + unit(random)) / 2;
                image.floats()[4 * i] = float(values[i] / 2047);
            }
            const auto bytes = encodeEacR11(image);
            ASSERT_EQ(bytes.size(), 8u);
            std::uint64_t bits = 0;
            for (const std::byte byte : bytes)
                bits = bits << 8 | std::to_integer<std::uint64_t>(byte);
            const auto codes = eacCodes(int(bits >> 56), int(bits >> 52 & 15), int(bits >> 48 & 15));
            double stored = 0;
            for (std::size_t i = 0; i < 16; ++i) { // texels are numbered by columns
                const double off = codes[bits >> (45 - 3 * (i % 4 * 4 + i / 4)) & 7] - values[i];
                stored += off * off;
            }
            EXPECT_NEAR(stored, squaresTo(codes, values), 0.1) << "the closest codes are stored";
            ours += stored;
            best += leastOfAllEacBlocks(values);
        }
        EXPECT_LT(ours, 1.25 * best + 1) << range;
    }
}

#ifdef COTAN_EIGHT_LANES
TEST(Block, fourAndEightLanesGiveTheSameBytes)
{
    if (!eightLanes())
        GTEST_SKIP() << "this processor has no AVX2";
    std::mt19937 random(13);
    std::vector<glm::dvec3> normals;
    for (int block = 0; block < 64; ++block)
        for (const glm::dvec3& n : tilted(block, block < 32 ? 0.02 : 0.4, random))
            normals.push_back(n);
    const Image image = blockOf(normals, 32);
    const CodeScale eleven{1023.5f, 1023.5f};
    const auto all = [&] {
        return std::array{encodeBc5(image, {}),   encodeBc3(image, {}),         encodeBc7(image, {}), encodeBc4(image),
                          encodeUastc(image, {}), encodeEacRg11(image, eleven), encodeEacR11(image)};
    };
    const auto eight = all();
    eightLanes() = false;
    const auto four = all();
    eightLanes() = true;
    EXPECT_EQ(four, eight);
}
#endif

} // namespace
} // namespace cotan::maps
