// What JPEG has cost a normal map, as estimated from the coefficients of its file.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <random>

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

#include "cotan/gltf.hpp"
#include "cotan/image.hpp"
#include "cotan/scene.hpp"
#include "image/codecs.hpp"
#include "jpeg_maker.hpp"
#include "map_files/choose.hpp"
#include "map_files/jpeg_cost.hpp"
#include "run_tool.hpp"
#include "scene_of_maps.hpp"
#include "test_data.hpp"

namespace cotan::test {
namespace {

// The mean angle between two maps, in degrees.
double meanAngle(const Image& a, const Image& b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.pixelCount(); ++i) {
        const auto vector = [i](const Image& map) {
            const std::uint8_t* const t = map.bytes8() + 4 * i;
            return glm::normalize(glm::dvec3(t[0], t[1], t[2]) / 127.5 - 1.0);
        };
        const glm::dvec3 n = vector(a), m = vector(b);
        sum += std::atan2(glm::length(glm::cross(n, m)), glm::dot(n, m));
    }
    return glm::degrees(sum / double(a.pixelCount()));
}

Image decoded(const std::vector<std::byte>& file, bool keeps = true)
{
    LoadLimits limits;
    limits.keepsJpeg = keeps;
    auto image = decodeImage(file, "map.jpg", limits);
    EXPECT_TRUE(image);
    return image ? *image : Image();
}

// A square of at most `most` texels a side. whole: of type unorm8.
Image middleOf(const Image& whole, int most)
{
    const int side = std::min({most, whole.width, whole.height});
    Image map = makeImage(side, side, whole.type);
    const int left = (whole.width - side) / 2, top = (whole.height - side) / 2;
    for (int y = 0; y < side; ++y)
        std::copy_n(whole.bytes8() + 4 * ((top + y) * whole.width + left), 4 * side, map.bytes8() + 4 * y * side);
    return map;
}

// Directions of a rough surface: each texel leans by itself.
Image noiseMap(int side)
{
    Image map = makeImage(side, side, PixelType::unorm8);
    std::mt19937 random(7);
    std::normal_distribution<double> slope(0, 0.25);
    for (std::size_t i = 0; i < map.pixelCount(); ++i) {
        const double x = slope(random), y = slope(random);
        const glm::dvec3 n = glm::normalize(glm::dvec3(x, y, 1));
        for (int c = 0; c < 3; ++c)
            map.bytes8()[4 * i + std::size_t(c)] = std::uint8_t(std::lround((n[c] + 1) * 127.5));
        map.bytes8()[4 * i + 3] = 255;
    }
    return map;
}

// The truth is the angle to the map before it was compressed, which the estimate does not see. On ten real maps the
// estimate is within two fifths of it with whole chroma, and within a half with halved chroma, at qualities from
// 75 on, but for a map that had halved chroma before; nearly flat maps may be 0.2 degrees off
// (docs/explanation/compression.md). What is left is the shape of the distributions, which are not quite Laplace's.
TEST(JpegCost, isEstimatedFromTheCoefficients)
{
    std::vector<std::pair<std::string, Image>> maps{{"waves", makeReliefMap(Relief::waves, 256)},
                                                    {"domes", makeReliefMap(Relief::domes, 256)},
                                                    {"noise", noiseMap(256)}};
    for (const char* const name : {"cube_normal_gl", "scratched_gold_normal_dx", "sofa_normal_gl"})
        if (const std::string file = std::string("textures/") + name + ".png"; hasData(file))
            maps.emplace_back(name, middleOf(*readImage(dataFile(file)), 512));
    for (const auto& [name, map] : maps) {
        for (const JpegSettings& settings : {JpegSettings{.quality = 75},
                                             {.quality = 90},
                                             {.quality = 95, .progressive = true},
                                             {.quality = 90, .rgb = true},
                                             {.quality = 75, .halved = true},
                                             {.quality = 90, .halved = true},
                                             {.quality = 90, .halvedAcross = true}}) {
            const Image image = decoded(jpegOf(map, settings));
            const auto found = app::costBefore(image, {.expansion = Expansion::biased});
            ASSERT_TRUE(found) << name;
            EXPECT_EQ(found->format, "jpeg");
            const double truth = meanAngle(map, image), off = found->meanDegrees / truth;
            const double most = settings.halved || settings.halvedAcross ? 1.5 : 1.4;
            EXPECT_TRUE((off > 1 / most && off < most) || std::abs(found->meanDegrees - truth) < 0.2)
                << name << ' ' << settings.quality << settings.halved << settings.halvedAcross << settings.rgb << ": "
                << found->meanDegrees << " instead of " << truth;
        }
    }
}

TEST(JpegCost, isUnknownWhereTheFileDoesNotShowIt)
{
    const Image map = makeReliefMap(Relief::waves, 64);
    ASSERT_TRUE(app::jpegCost(decoded(jpegOf(map))));
    EXPECT_FALSE(app::jpegCost(decoded(jpegOf(map, {.grey = true})))) << "holds no directions";
    EXPECT_FALSE(app::jpegCost(decoded(jpegOf(map), /*keeps*/ false)));
    EXPECT_FALSE(app::jpegCost(map)) << "no file";
    EXPECT_FALSE(app::jpegCost(decoded(jpegOf(makeReliefMap(Relief::waves, 24))))) << "nine blocks";
    EXPECT_TRUE(app::jpegCost(decoded(jpegOf(makeReliefMap(Relief::waves, 39))))) << "16 whole blocks";
    Image other = map; // the file of a larger map
    other.jpeg = jpegOf(makeReliefMap(Relief::waves, 128));
    EXPECT_FALSE(app::jpegCost(other));
}

// Any file gives a number, or nothing.
TEST(JpegCost, damagedFilesGiveNothingOrANumber)
{
    const Image map = makeReliefMap(Relief::domes, 64);
    std::mt19937 random(1);
    std::size_t numbers = 0;
    for (const bool progressive : {false, true}) {
        const std::vector<std::byte> sound = jpegOf(map, {.halved = true, .progressive = progressive});
        for (int i = 0; i < 400; ++i) {
            Image image = map;
            image.jpeg = sound;
            if (i % 2 == 0)
                image.jpeg.resize(random() % sound.size());
            else
                for (int n = 0; n < 3; ++n)
                    image.jpeg[random() % sound.size()] = std::byte(random() & 0xff);
            if (const auto cost = app::jpegCost(image)) {
                EXPECT_TRUE(*cost >= 0 && *cost <= 3600) << i << ' ' << *cost; // and not NaN
                ++numbers;
            }
        }
    }
    EXPECT_GT(numbers, 0u) << "a changed coefficient is no damage";
}

// 64 x 64 coefficients of three components take 24,576 bytes, also where the pixels are decoded row by row.
TEST(JpegCost, coefficientsCountAgainstTheLimit)
{
    const std::vector<std::byte> file = jpegOf(makeReliefMap(Relief::waves, 64));
    LoadLimits limits;
    limits.imageBytes = 24575;
    EXPECT_FALSE(readJpegBlocks(file, limits, 100));
    limits.imageBytes = 24576;
    EXPECT_TRUE(readJpegBlocks(file, limits, 100));
}

TEST(JpegCost, blocksAreThoseOfTheirPlaceInTheImage)
{
    // Each block has a grey of its own, which its first coefficient is: eight times the difference to 128.
    Image map = makeImage(160, 96, PixelType::unorm8);
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x)
            std::fill_n(map.bytes8() + 4 * (y * map.width + x), 4, std::uint8_t(y / 8 * 20 + x / 8));
    for (const bool halved : {false, true})
        for (const std::size_t most : {std::size_t(1000), std::size_t(7)}) {
            const auto blocks = readJpegBlocks(jpegOf(map, {.quality = 100, .halved = halved}), {}, most);
            ASSERT_TRUE(blocks);
            const int across = halved ? 2 : 1;
            EXPECT_EQ(blocks->unitWidth, 8 * across);
            EXPECT_EQ(blocks->units.size(), std::min<std::size_t>(most, std::size_t(20 * 12 / (across * across))));
            const JpegBlocks::Component& luma = blocks->components[0];
            ASSERT_EQ(luma.coefficients.size(), blocks->units.size() * std::size_t(64 * across * across));
            const std::int16_t* block = luma.coefficients.data();
            for (const auto& [left, top] : blocks->units)
                for (int y = 0; y < across; ++y)
                    for (int x = 0; x < across; ++x, block += 64)
                        EXPECT_NEAR(block[0] * luma.steps[0], 8 * ((top / 8 + y) * 20 + left / 8 + x - 128), 4)
                            << left << ' ' << top;
        }
}

TEST(JpegCost, lintNamesWhatTheJpegsOfAModelHaveCost)
{
    const TemporaryFolder folder;
    Scene scene;
    const std::vector<Image> maps{makeReliefMap(Relief::waves, 128), noiseMap(128), makeReliefMap(Relief::domes, 128)};
    for (const Image& map : maps)
        addPlaneWith(map, "map " + std::to_string(scene.images.size() + 1), scene);
    auto document = gltfDocumentOf(scene);
    ASSERT_TRUE(document);
    std::array<double, 2> truths{};
    for (const std::size_t i : {0u, 1u}) { // the last map stays PNG
        const std::vector<std::byte> file = jpegOf(maps[i], {.quality = 85, .halved = i == 1});
        truths[i] = meanAngle(maps[i], decoded(file));
        replaceGltfImage(*document, i, file, "image/jpeg");
    }
    ASSERT_TRUE(writeGltf(*document, folder / "three.glb"));
    const auto lint = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words{"lint", "three.glb", "--json", "report.json", "--overwrite"};
        words.insert(words.end(), more.begin(), more.end());
        const ToolRun run = runTool(words, folder.path());
        EXPECT_EQ(run.code, 0) << run.err;
        return std::pair(run.out, nlohmann::json::parse(readWhole(folder / "report.json")));
    };
    const auto [lines, report] = lint({"--details"});
    const nlohmann::json& lost = report["lost_before"];
    ASSERT_EQ(lost.size(), 2u);
    for (const std::size_t i : {0u, 1u}) {
        EXPECT_EQ(lost[i]["map"], "map " + std::to_string(i + 1));
        EXPECT_EQ(lost[i]["compress"], "jpeg");
        EXPECT_NEAR(lost[i]["mean_degrees"].get<double>(), truths[i], truths[i] / 3);
    }
    EXPECT_NE(lines.find("map 1: its file (jpeg) has already cost about "), std::string::npos) << lines;
    EXPECT_TRUE(lint({}).second["lost_before"].empty()) << "which takes time";
    // A map of the user's own is one of them.
    const std::vector<std::byte> file = jpegOf(maps[1], {.quality = 85});
    std::ofstream(folder / "own.jpg", std::ios::binary)
        .write(reinterpret_cast<const char*>(file.data()), std::streamsize(file.size()));
    EXPECT_EQ(lint({"--details", "--normal-map", "own.jpg"}).second["lost_before"].size(), 1u);
}

} // namespace
} // namespace cotan::test
