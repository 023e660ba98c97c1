// What blocks of four colours have cost a map, as estimated from what they hold. The encoders are those of others, or
// simple ones of this file; the maps are not those that the factors of the estimate are from.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <span>
#include <utility>

#include <glm/glm.hpp>

#include "core/value_statistics.hpp"
#include "cotan/image.hpp"
#include "cotan/maps.hpp"
#include "ktx2_maker.hpp"
#include "map_files/choose.hpp"
#include "run_tool.hpp"
#include "test_data.hpp"

namespace cotan::test {
namespace {

constexpr Convention kRead{.expansion = Expansion::biased};

using Block = std::array<glm::ivec3, 16>; // in rows

int nearestSquares(const Block& block, std::span<const glm::ivec3> palette, std::array<int, 16>& indices)
{
    int error = 0;
    for (std::size_t i = 0; i < 16; ++i) {
        int least = 1 << 30;
        for (std::size_t k = 0; k < palette.size(); ++k) {
            const glm::ivec3 off = palette[k] - block[i];
            const int square = off.x * off.x + off.y * off.y + off.z * off.z;
            if (square < least) {
                least = square;
                indices[i] = int(k);
            }
        }
        error += least;
    }
    return error;
}

int nearestCode(int value, int most) { return (value * most + 127) / 255; }

// BC1: of all pairs of texels as ends of the line, the best.
std::string bc1Of(const Block& block)
{
    std::uint64_t best = 0;
    int least = 1 << 30;
    for (std::size_t i = 0; i < 16; ++i)
        for (std::size_t j = 0; j < 16; ++j) {
            const auto code = [](glm::ivec3 c) {
                return nearestCode(c.x, 31) << 11 | nearestCode(c.y, 63) << 5 | nearestCode(c.z, 31);
            };
            const auto colour = [](int c) {
                const int r = c >> 11, g = c >> 5 & 63, b = c & 31;
                return glm::ivec3(r << 3 | r >> 2, g << 2 | g >> 4, b << 3 | b >> 2);
            };
            const int first = code(block[i]), second = code(block[j]);
            if (first < second) // three colours
                continue;
            const glm::ivec3 a = colour(first), b = colour(second);
            const std::array<glm::ivec3, 4> palette{a, b, (2 * a + b) / 3, (a + 2 * b) / 3};
            std::array<int, 16> indices{};
            const int error = nearestSquares(block, std::span(palette).first(first == second ? 1 : 4), indices);
            if (error >= least)
                continue;
            least = error;
            best = std::uint64_t(first) | std::uint64_t(second) << 16;
            for (std::size_t k = 0; k < 16; ++k)
                best |= std::uint64_t(indices[k]) << (32 + 2 * k);
        }
    return little(best, 8);
}

// ETC1, which ETC2 has within it: the better pair of halves, each a colour and the best table of distances to it.
std::string etc1Of(const Block& block)
{
    constexpr int kTables[8][2] = {{2, 8}, {5, 17}, {9, 29}, {13, 42}, {18, 60}, {24, 80}, {33, 106}, {47, 183}};
    std::uint64_t best = 0;
    int least = 1 << 30;
    for (const bool lies : {false, true}) {
        const auto halfOf = [&](std::size_t i) { return lies ? i / 8 : i % 4 / 2; };
        std::array<glm::ivec3, 2> sum{}, code{}, base{};
        for (std::size_t i = 0; i < 16; ++i)
            sum[halfOf(i)] += block[i];
        bool near = true;
        for (int c = 0; c < 3; ++c) {
            for (std::size_t h = 0; h < 2; ++h)
                code[h][c] = nearestCode(sum[h][c] / 8, 31);
            near = near && code[1][c] - code[0][c] >= -4 && code[1][c] - code[0][c] <= 3;
        }
        std::uint64_t bits = std::uint64_t(near) << 33 | std::uint64_t(lies) << 32;
        for (int c = 0; c < 3; ++c) {
            for (std::size_t h = 0; h < 2; ++h) {
                const int four = nearestCode(sum[h][c] / 8, 15);
                base[h][c] = near ? code[h][c] << 3 | code[h][c] >> 2 : four * 17;
                if (!near)
                    bits |= std::uint64_t(four) << (60 - 8 * c - 4 * int(h));
            }
            if (near)
                bits |= std::uint64_t(code[0][c] << 3 | ((code[1][c] - code[0][c]) & 7)) << (56 - 8 * c);
        }
        int error = 0;
        for (std::size_t h = 0; h < 2; ++h) {
            int fewest = 1 << 30;
            std::uint64_t chosen = 0;
            for (std::uint64_t t = 0; t < 8; ++t) {
                std::uint64_t here = t << (37 - 3 * h);
                int off = 0;
                for (std::size_t i = 0; i < 16; ++i) {
                    if (halfOf(i) != h)
                        continue;
                    int nearest = 1 << 30;
                    std::uint64_t index = 0;
                    for (std::uint64_t k = 0; k < 4; ++k) { // small, large, -small, -large
                        const int by = kTables[t][k & 1] * (k & 2 ? -1 : 1);
                        int square = 0;
                        for (int c = 0; c < 3; ++c) {
                            const int d = std::clamp(base[h][c] + by, 0, 255) - block[i][c];
                            square += d * d;
                        }
                        if (square < nearest) {
                            nearest = square;
                            index = k;
                        }
                    }
                    off += nearest;
                    const std::size_t at = i % 4 * 4 + i / 4; // in columns
                    here |= (index & 1) << at | (index >> 1) << (16 + at);
                }
                if (off < fewest) {
                    fewest = off;
                    chosen = here;
                }
            }
            error += fewest;
            bits |= chosen;
        }
        if (error < least) {
            least = error;
            best = bits;
        }
    }
    std::string bytes = little(best, 8);
    std::reverse(bytes.begin(), bytes.end());
    return bytes;
}

std::string blocksOf(const Image& map, const std::string& before, std::string (*encode)(const Block&))
{
    std::string blocks;
    for (int y = 0; y < map.height; y += 4)
        for (int x = 0; x < map.width; x += 4) {
            Block block;
            for (int i = 0; i < 16; ++i) {
                const std::uint8_t* const t = map.bytes8() + 4 * ((y + i / 4) * map.width + x + i % 4);
                block[std::size_t(i)] = {t[0], t[1], t[2]};
            }
            blocks += before + encode(block);
        }
    return blocks;
}

// A relief, and squares of maps that the factors are not from. None is nearly flat: there a plain encoder rounds to 5
// bits what a good one does not, and the file does not show it.
std::vector<std::pair<std::string, Image>> heldOutMaps()
{
    std::vector<std::pair<std::string, Image>> maps{{"waves", makeReliefMap(Relief::waves, 128)}};
    for (const std::string name : {"FlightHelmet/FlightHelmet_Materials_LeatherPartsMat_Normal",
                                   "FlightHelmet/FlightHelmet_Materials_MetalPartsMat_Normal",
                                   "FlightHelmet/FlightHelmet_Materials_RubberWoodMat_Normal"}) {
        const std::string file = "models/" + name + ".png";
        if (!hasData(file))
            continue;
        const auto whole = readImage(dataFile(file));
        if (!whole || whole->type != PixelType::unorm8)
            continue;
        Image map = makeImage(160, 160, PixelType::unorm8);
        const int left = (whole->width - 160) / 2, top = (whole->height - 160) / 2;
        for (int y = 0; y < 160; ++y)
            std::copy_n(whole->bytes8() + 4 * ((top + y) * whole->width + left), 640, map.bytes8() + 640 * y);
        maps.emplace_back(name, map);
    }
    return maps;
}

void expectEstimate(const std::string& name, const Image& map, std::span<const std::byte> file, const char* blocks)
{
    const auto image = decodeImage(file, name);
    ASSERT_TRUE(image) << name << image.error().message;
    EXPECT_EQ(image->blocks, blocks);
    ValueStatistics degrees;
    for (const float angle : maps::anglesBetween(map, kRead, *image, kRead))
        degrees.add(double(angle));
    const auto found = app::costBefore(*image, kRead);
    ASSERT_TRUE(found) << name;
    const double truth = degrees.mean(), lost = found->meanDegrees;
    const double most = name == "waves" ? 1.5 : 1.34; // of lines, curved everywhere: no real map is
    EXPECT_TRUE((lost > 0.66 * truth && lost < most * truth) || std::abs(lost - truth) < 0.2)
        << name << ' ' << blocks << ": " << lost << " instead of " << truth;
}

TEST(MapChoice, whatBlocksOfFourColoursHaveCostIsEstimatedWithinAThird)
{
    for (const auto& [name, map] : heldOutMaps()) {
        const auto size = std::uint32_t(map.width);
        const std::string opaque = std::string(2, '\xff') + std::string(6, '\0');
        for (const auto& [blocks, file] :
             {std::pair("bc1", Ktx2File{.format = 131, .levels = {{blocksOf(map, "", bc1Of)}}, .colourModel = 128}),
              std::pair("bc3", Ktx2File{.format = 137, .levels = {{blocksOf(map, opaque, bc1Of)}}, .colourModel = 130}),
              std::pair("etc2",
                        Ktx2File{.format = 147, .levels = {{blocksOf(map, "", etc1Of)}}, .colourModel = 161})}) {
            Ktx2File whole = file;
            whole.width = whole.height = size;
            whole.channelTypes = {0};
            const std::string bytes = makeKtx2(whole);
            expectEstimate(name, map, std::as_bytes(std::span(bytes)), blocks);
        }
    }
}

// By the encoder of Basis Universal.
TEST(MapChoice, whatEtc1sHasCostIsEstimatedWithinAThird)
{
    if (!std::filesystem::exists(COTAN_NPM "/installed-lock.json"))
        GTEST_SKIP() << "scripts/npm-packages could not install the encoder in " << COTAN_NPM;
    const TemporaryFolder folder;
    const auto maps = heldOutMaps();
    std::string jobs;
    for (std::size_t i = 0; i < maps.size(); ++i) {
        const Image& map = maps[i].second;
        const std::string name = std::to_string(i), side = std::to_string(map.width);
        std::ofstream(folder / (name + ".raw"), std::ios::binary)
            .write(reinterpret_cast<const char*>(map.bytes8()), std::streamsize(map.data.size()));
        jobs += std::string(i > 0 ? "," : "[") + R"({"name":")" + name + R"(","width":)" + side + R"(,"height":)" + side
            + R"(,"options":{"isUASTC":false,"qualityLevel":255,"compressionLevel":2,"isNormalMap":true}})";
    }
    std::ofstream(folder / "jobs.json") << jobs << "]";
    const std::string line = "node '" COTAN_SOURCE_DIR "/tests/npm/basisu.mjs' '" COTAN_NPM "/node_modules' '"
        + folder.path().string() + "' > '" + (folder / "log.txt").string() + "'";
    ASSERT_EQ(std::system(line.c_str()), 0) << readWhole(folder / "log.txt");
    for (std::size_t i = 0; i < maps.size(); ++i) {
        const std::string file = readWhole(folder / (std::to_string(i) + ".ktx2"));
        expectEstimate(maps[i].first, maps[i].second, std::as_bytes(std::span(file)), "etc1s");
    }
}

// BC3 with x in alpha has few codes for y: what lay between them is not in the file.
TEST(MapChoice, whatBc3WithXInAlphaHasCostIsUnknown)
{
    Image map = makeReliefMap(Relief::waves, 64);
    map.blocks = "bc3";
    EXPECT_TRUE(app::costBefore(map, kRead)) << "three channels";
    for (std::size_t i = 0; i < map.pixelCount(); ++i) {
        std::uint8_t* const t = map.bytes8() + 4 * i;
        t[3] = std::exchange(t[0], std::uint8_t(255));
        t[2] = 255;
    }
    EXPECT_FALSE(app::costBefore(map, kRead));
    Image small = makeReliefMap(Relief::waves, 31);
    small.blocks = "bc1";
    EXPECT_FALSE(app::costBefore(small, kRead)) << "few blocks";
}

} // namespace
} // namespace cotan::test
