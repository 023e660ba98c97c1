// The cost in degrees of each choice of the zero code: the table of docs/explanation/zero.md, which has published maps,
// and formulas that hold for any map.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <string>

#include <glm/geometric.hpp>

#include "cotan/image.hpp"
#include "cotan/maps.hpp"
#include "map_cases.hpp"
#include "test_data.hpp"

namespace cotan::maps {
namespace {

constexpr Convention kExact{}, kBiased{.expansion = Expansion::biased};

// Mean angles of texels below 2 degrees of tilt, and from 20 degrees on.
struct Means {
    double flats = 0, slopes = 0;
};

Means meansOf(const Image& truth, const std::vector<float>& degrees)
{
    std::array<double, 2> sum{}, count{};
    std::vector<glm::vec3> row(std::size_t(truth.width));
    for (int y = 0; y < truth.height; ++y) {
        decodeRow(truth, y, kExact, row);
        for (std::size_t x = 0; x < row.size(); ++x) {
            const double tilt = std::atan2(std::hypot(row[x].x, row[x].y), row[x].z) * 180 / 3.14159265358979;
            const float error = degrees[std::size_t(y) * row.size() + x];
            if (error < 0 || (tilt >= 2 && tilt < 20))
                continue;
            sum[tilt >= 20] += double(error);
            count[tilt >= 20] += 1;
        }
    }
    return {count[0] > 0 ? sum[0] / count[0] : 0, count[1] > 0 ? sum[1] / count[1] : 0};
}

Image stored8(const Image& map, const Convention& to)
{
    RecodeCounts counts;
    return recode(map, {.from = kExact, .to = to, .type = PixelType::unorm8}, counts);
}

Image texture(const std::string& name)
{
    auto image = readImage(test::dataFile("textures/" + name));
    return image ? *std::move(image) : Image{};
}

// The components of a direction as 8-bit codes, and the direction that such codes mean.
glm::dvec3 codesOf(const glm::dvec3& n, const Convention& c)
{
    glm::dvec3 codes;
    for (int k = 0; k < 3; ++k)
        codes[k] = std::floor((c.expansion == Expansion::biased ? 127.5 + 127.5 * n[k] : 128 + 127 * n[k]) + 0.5);
    return codes;
}
glm::dvec3 directionOf(const glm::dvec3& codes, const Convention& c)
{
    return c.expansion == Expansion::biased ? codes / 127.5 - 1.0 : glm::max((codes - 128.0) / 127.0, -1.0);
}

// The means that follow from these formulas, for a map whose texels are `texels` in the range of their type.
template<class Read> Means meansByFormula(const Image& map, Read read)
{
    std::array<double, 2> sum{}, count{};
    for (std::size_t i = 0; i < map.pixelCount(); ++i) {
        glm::dvec3 truth;
        for (std::size_t k = 0; k < 3; ++k)
            truth[int(k)] = map.type == PixelType::unorm16 ? std::max((map.words()[4 * i + k] - 32768.0) / 32767, -1.0)
                                                           : std::max((map.bytes8()[4 * i + k] - 128.0) / 127, -1.0);
        const double tilt = std::atan2(std::hypot(truth.x, truth.y), truth.z) * 180 / 3.14159265358979;
        if (tilt >= 2 && tilt < 20)
            continue;
        const glm::dvec3 found = read(truth);
        const double error = std::atan2(glm::length(glm::cross(truth, found)), glm::dot(truth, found));
        sum[tilt >= 20] += error * 180 / 3.14159265358979;
        count[tilt >= 20] += 1;
    }
    EXPECT_GT(std::min(count[0], count[1]), 500);
    return {sum[0] / count[0], sum[1] / count[1]};
}

// An engine that expands with 2c - 1 reads a map whose flat texel is 128; the error is equal the other way round.
TEST(Zero, reading_with_the_other_zero_costs_a_third_of_a_degree)
{
    COTAN_NEEDS_DATA("textures/noise16_normal_gl.png");
    const std::pair<const char*, Means> documented[] = {{"cube_normal_gl.png", {0.32, 0.31}},
                                                        {"scratched_gold_normal_dx.png", {0.32, 0.42}},
                                                        {"ornament_normal_gl.png", {0.32, 0.31}},
                                                        {"sofa_normal_gl.png", {0.32, 0.31}}};
    for (const auto& [name, expected] : documented) {
        const Image map = texture(name);
        ASSERT_GT(map.width, 0) << name;
        const Means error = meansOf(map, anglesBetween(map, kExact, map, kBiased));
        std::printf("%s: flats %.3f, slopes %.3f degrees\n", name, error.flats, error.slopes);
        const Means computed =
            meansByFormula(map, [](const glm::dvec3& n) { return directionOf(codesOf(n, kExact), kBiased); });
        EXPECT_NEAR(error.flats, computed.flats, 0.01) << name;
        EXPECT_NEAR(error.slopes, computed.slopes, 0.01) << name;
        if (!test::isOriginal(std::string("textures/") + name))
            continue;
        EXPECT_NEAR(error.flats, expected.flats, 0.01) << name;
        EXPECT_NEAR(error.slopes, expected.slopes, 0.01) << name;
    }
}

// A 16-bit map rounded to 8 bits: errors for either zero, read with the same and with the other zero.
TEST(Zero, only_the_exact_form_stores_flat_at_8_bits)
{
    COTAN_NEEDS_DATA("textures/noise16_normal_gl.png");
    const Image truth = texture("noise16_normal_gl.png");
    ASSERT_EQ(truth.type, PixelType::unorm16);
    struct Case {
        Convention stored, read;
        Means expected;
    };
    const Case cases[] = {{kExact, kExact, {0.00, 0.19}},
                          {kBiased, kBiased, {0.32, 0.16}},
                          {kExact, kBiased, {0.32, 0.34}},
                          {kBiased, kExact, {0.10, 0.33}}};
    for (const Case& c : cases) {
        const Image there = stored8(truth, c.stored);
        const Means error = meansOf(truth, anglesBetween(truth, kExact, there, c.read));
        std::printf("stored %s, read %s: flats %.3f, slopes %.3f degrees\n", describe(c.stored).c_str(),
                    describe(c.read).c_str(), error.flats, error.slopes);
        const Means computed =
            meansByFormula(truth, [&](const glm::dvec3& n) { return directionOf(codesOf(n, c.stored), c.read); });
        EXPECT_NEAR(error.flats, computed.flats, 0.01);
        EXPECT_NEAR(error.slopes, computed.slopes, 0.01);
        if (!test::isOriginal("textures/noise16_normal_gl.png"))
            continue;
        EXPECT_NEAR(error.flats, c.expected.flats, 0.01);
        EXPECT_NEAR(error.slopes, c.expected.slopes, 0.01);
    }
}

// 16 bits read with the zero of 8 bits, as a shader does that ignores the depth, or with 2c - 1.
TEST(Zero, sixteen_bits_read_as_8_tilt_by_a_third_of_a_degree)
{
    const glm::vec4 flat(32768 / 65535.0f, 32768 / 65535.0f, 1, 1);
    const auto lean = [](const glm::vec3& m) { return std::atan2(std::hypot(m.x, m.y), m.z) * 180 / 3.14159265358979; };
    EXPECT_LT(lean(decodeTexel(flat, kExact, PixelType::unorm16)), 1e-5);
    EXPECT_NEAR(lean(decodeTexel(flat, kBiased, PixelType::unorm16)), 0.0012, 1e-4);
    EXPECT_NEAR(lean(decodeTexel(flat, kExact, PixelType::unorm8)), 0.317, 1e-3);
}

} // namespace
} // namespace cotan::maps
