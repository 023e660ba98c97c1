// Rasterisation in uv: which triangles cover or touch a texel.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <span>

#include "bake/surface/uv_raster.hpp"
#include "truth/random.hpp"

namespace cotan {
namespace {

struct Layout {
    std::vector<glm::vec2> texcoords;
    std::vector<std::uint32_t> indices;
    UvTriangles view() const { return {texcoords, indices}; }
};

// The unit square as a fan around an inner point: every texel is covered once.
Layout fan(glm::vec2 centre)
{
    return {{{0, 0}, {1, 0}, {1, 1}, {0, 1}, centre}, {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4}};
}

// Triangles of both windings that cover the unit square; inner grid points are random.
Layout jitteredGrid(int n)
{
    Layout l;
    Random random(5);
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) {
            const bool inner = i > 0 && j > 0 && i < n && j < n;
            const double dx = inner ? random.range(-0.3, 0.3) : 0, dy = inner ? random.range(-0.3, 0.3) : 0;
            l.texcoords.emplace_back(float((i + dx) / n), float((j + dy) / n));
        }
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const auto a = std::uint32_t(j * (n + 1) + i), b = a + 1, d = a + std::uint32_t(n) + 1, c = d + 1;
            for (std::uint32_t k : {a, b, c, a, d, c}) // the second is mirrored
                l.indices.push_back(k);
        }
    return l;
}

// Counts over a whole layout.
struct Coverage {
    std::size_t covered = 0;     // texels whose centre is in at least one triangle
    std::size_t overlapping = 0; // texels whose centre is in several
};

Coverage coverageOf(const UvTriangles& triangles, int side, glm::ivec2 tile = {0, 0}, bool wrap = false)
{
    Coverage c;
    const std::size_t width = std::size_t(side) + 1;
    // Difference between the number of triangles over a texel and over the one before it.
    std::vector<int> begins(width * std::size_t(side));
    UvRaster(triangles, side, side, tile, wrap).eachSpan([&](const UvSpan& span) {
        int* const row = &begins[std::size_t(span.y) * width];
        ++row[span.first];
        --row[span.last + 1];
    });
    int n = 0; // returns to 0 after each row
    for (const int begin : begins) {
        n += begin;
        c.covered += n > 0;
        c.overlapping += n > 1;
    }
    return c;
}

TEST(UvRaster, texelsOnSharedEdgesBelongToExactlyOneTriangle)
{
    // Edges through texel centres: (0.5, 0.5) of an odd image, and diagonals of the square.
    for (int side : {1, 2, 7, 16, 33})
        for (const Layout& l : {fan({0.5f, 0.5f}), fan({0.25f, 0.625f}), jitteredGrid(5)}) {
            const Coverage c = coverageOf(l.view(), side);
            EXPECT_EQ(c.covered, std::size_t(side) * std::size_t(side)) << side;
            EXPECT_EQ(c.overlapping, 0u) << side;
        }
}

TEST(UvRaster, barycentricsReproduceTheTexelCentre)
{
    const Layout l = jitteredGrid(4);
    const UvRaster raster(l.view(), 37, 23);
    UvRow row;
    for (int y = 0; y < 23; ++y) {
        raster.row(y, row);
        for (int x = 0; x < 37; ++x) {
            ASSERT_EQ(row.of(std::size_t(x)).size(), 1u);
            const UvSample& p = row.of(std::size_t(x)).front();
            const std::uint32_t* v = &l.indices[3 * std::size_t(p.triangle)];
            const glm::vec2 uv =
                l.texcoords[v[0]] * (1 - p.b1 - p.b2) + l.texcoords[v[1]] * p.b1 + l.texcoords[v[2]] * p.b2;
            EXPECT_NEAR(uv.x * 37, float(x) + 0.5f, 1e-4f);
            EXPECT_NEAR(uv.y * 23, float(y) + 0.5f, 1e-4f);
        }
    }
}

TEST(UvRaster, trianglesThatOnlyTouchATexelGiveTheirNearestPoint)
{
    // A sliver that contains no texel centre of a 4 x 4 image.
    const Layout l{{{0.26f, 0.26f}, {0.34f, 0.26f}, {0.3f, 0.3f}}, {0, 1, 2}};
    const UvRaster raster(l.view(), 4, 4);
    UvRow row;
    raster.row(1, row);
    ASSERT_EQ(row.of(1).size(), 1u); // texel (1, 1), whose centre is (0.375, 0.375)
    const UvSample& p = row.of(1).front();
    EXPECT_FALSE(p.covers);
    EXPECT_NEAR(p.b1 * 0.08f + p.b2 * 0.04f + 0.26f, 0.32f, 0.021f); // on the edge from (0.34, 0.26) to (0.3, 0.3)
}

TEST(UvRaster, touchingSamplesCountOnlyWithoutCoveringOnes)
{
    Layout l = jitteredGrid(6);
    l.indices.erase(l.indices.begin() + 3 * 20, l.indices.begin() + 3 * 29); // a hole in the middle
    const UvRaster raster(l.view(), 61, 43);
    std::vector<UvRaster> alone; // each triangle by itself
    for (std::size_t i = 0; i < l.indices.size(); i += 3)
        alone.emplace_back(UvTriangles{l.texcoords, std::span(l.indices).subspan(i, 3)}, 61, 43);
    std::size_t touched = 0;
    for (int y = 0; y < 43; ++y) {
        UvRow together;
        raster.row(y, together);
        std::vector<UvRow> rows(alone.size());
        for (std::size_t f = 0; f < alone.size(); ++f)
            alone[f].row(y, rows[f]);
        for (std::size_t x = 0; x < 61; ++x) {
            std::vector<UvSample> expected;
            for (bool covers : {true, false})
                for (std::size_t f = 0; f < rows.size() && (covers || expected.empty() || !expected[0].covers); ++f)
                    for (UvSample p : rows[f].of(x))
                        if (p.covers == covers) {
                            p.triangle = std::uint32_t(f);
                            expected.push_back(p);
                        }
            ASSERT_EQ(together.of(x).size(), expected.size());
            for (std::size_t i = 0; i < expected.size(); ++i) {
                const UvSample& p = together.of(x)[i];
                EXPECT_EQ(p.triangle, expected[i].triangle);
                EXPECT_EQ(p.b1, expected[i].b1);
                EXPECT_EQ(p.covers, expected[i].covers);
                touched += p.covers ? 0 : 1;
            }
        }
    }
    EXPECT_GT(touched, 0u);
}

TEST(UvRaster, firstsAreTheFirstSamplesOfEachTexel)
{
    const Layout l = jitteredGrid(6);
    Layout twice = l; // three copies of all triangles
    for (int i = 0; i < 2; ++i)
        twice.indices.insert(twice.indices.end(), l.indices.begin(), l.indices.end());
    const UvRaster raster(twice.view(), 61, 43); // not a multiple of a square or block
    std::map<std::pair<int, int>, UvSample> firsts;
    std::set<std::pair<int, int>> again;
    for (int block = 0; block < raster.blocks(); ++block) {
        UvFirsts found;
        raster.firsts(block, found);
        ASSERT_EQ(found.texels.size(), found.samples.size());
        for (std::size_t i = 0; i < found.texels.size(); ++i) {
            const glm::ivec2 t = found.texels[i];
            EXPECT_EQ(t.y / UvRaster::kBlockRows, block);
            EXPECT_TRUE(firsts.emplace(std::pair(t.x, t.y), found.samples[i]).second);
        }
        for (glm::ivec2 t : found.coveredTwice)
            EXPECT_TRUE(again.emplace(t.x, t.y).second); // once, however many triangles cover it
    }
    UvRow row;
    for (int y = 0; y < 43; ++y) {
        raster.row(y, row);
        for (int x = 0; x < 61; ++x) {
            const std::size_t i = row.first[std::size_t(x)], end = row.first[std::size_t(x) + 1];
            const auto found = firsts.find({x, y});
            ASSERT_EQ(found != firsts.end(), i < end);
            if (i == end)
                continue;
            EXPECT_EQ(found->second.triangle, row.samples[i].triangle);
            EXPECT_EQ(found->second.b1, row.samples[i].b1);
            EXPECT_EQ(found->second.b2, row.samples[i].b2);
            EXPECT_EQ(found->second.covers, row.samples[i].covers);
            EXPECT_EQ(again.count({x, y}) > 0, row.samples[i].covers);
        }
    }
}

// For each texel of a row: its samples.
using SamplesOfTexels = std::vector<std::vector<UvSample>>;

SamplesOfTexels samplesByTexel(const UvRow& row)
{
    SamplesOfTexels places;
    for (std::size_t x = 0; x + 1 < row.first.size(); ++x)
        places.emplace_back(row.of(x).begin(), row.of(x).end());
    return places;
}

void expectEqual(const SamplesOfTexels& a, const SamplesOfTexels& b)
{
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t x = 0; x < a.size(); ++x) {
        ASSERT_EQ(a[x].size(), b[x].size()) << x;
        for (std::size_t i = 0; i < a[x].size(); ++i) {
            EXPECT_EQ(a[x][i].triangle, b[x][i].triangle);
            EXPECT_EQ(a[x][i].b1, b[x][i].b1);
            EXPECT_EQ(a[x][i].b2, b[x][i].b2);
            EXPECT_EQ(a[x][i].covers, b[x][i].covers);
        }
    }
}

TEST(UvRaster, severalRowsAtOnceEqualSingleRows)
{
    Layout l = jitteredGrid(7);
    for (int layer = 0; layer < 3; ++layer) // 4 layers of all triangles
        l.indices.insert(l.indices.end(), l.indices.begin(), l.indices.begin() + 7 * 7 * 6);
    for (std::size_t i = 0; i < l.texcoords.size();
         ++i) // covers only a part of the image: some texels are touched, some empty
        l.texcoords[i] = glm::vec2(0.1f, 0.2f) + l.texcoords[i] * glm::vec2(0.6f, 0.5f);
    const int width = 29, height = 43;
    const auto odd = [](const UvSample& p) { return p.triangle % 2 == 1; };
    for (const UvLimits& few : {UvLimits{}, UvLimits{.maxPerTexel = 1}, UvLimits{.maxPerTexel = 3},
                                UvLimits{.accepts = odd}, UvLimits{.maxPerTexel = 2, .accepts = odd}})
        for (const bool wrap : {false, true}) {
            const UvRaster raster(l.view(), width, height, {0, 0}, wrap);
            std::vector<SamplesOfTexels> single;
            UvRow row;
            std::size_t most = 0, touched = 0;
            for (int y = 0; y < height; ++y) {
                raster.row(y, row, few);
                single.push_back(samplesByTexel(row));
                for (const std::vector<UvSample>& places : single.back()) {
                    ASSERT_LE(places.size(), few.maxPerTexel);
                    if (!places.empty() && places[0].covers)
                        most = std::max(most, places.size());
                    touched += !places.empty() && !places[0].covers;
                    for (const UvSample& p : places) {
                        EXPECT_TRUE(!few.accepts || odd(p));
                        EXPECT_EQ(p.covers, places[0].covers);
                    }
                }
            }
            EXPECT_EQ(most, std::min<std::size_t>(few.maxPerTexel, 4));
            EXPECT_GT(touched, 0u);
            std::vector<UvRow> rows; // reused for other rows
            for (const auto& [first, count] :
                 {std::pair(0, height), {5, 20}, {7, 2}, {8, 8}, {15, 10}, {40, 3}, {42, 1}}) {
                rows.resize(std::size_t(count));
                raster.rows(first, rows, few);
                for (int k = 0; k < count; ++k)
                    expectEqual(samplesByTexel(rows[std::size_t(k)]), single[std::size_t(first + k)]);
            }
        }
}

TEST(UvRaster, spansAreTheTexelsWhoseCentresAreCovered)
{
    const Layout l = jitteredGrid(9);
    const UvRaster raster(l.view(), 61, 43);
    std::set<std::array<int, 3>> spanned, covered; // triangle, row, column
    raster.eachSpan([&](const UvSpan& s) {
        for (int x = s.first; x <= s.last; ++x)
            spanned.insert({int(s.triangle), s.y, x});
    });
    UvRow row;
    for (int y = 0; y < 43; ++y) {
        raster.row(y, row);
        for (int x = 0; x < 61; ++x)
            for (const UvSample& p : row.of(std::size_t(x)))
                if (p.covers)
                    covered.insert({int(p.triangle), y, x});
    }
    EXPECT_EQ(spanned, covered);
}

// Distance of a point to a segment.
double distanceTo(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b)
{
    const double along = std::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
    return glm::length(p - glm::mix(a, b, along));
}

TEST(UvRaster, texelsWithinHalfADiagonalOfTheTriangleAreTouched)
{
    constexpr int kWidth = 37, kHeight = 23;
    constexpr double kUnsure = 1e-4; // in texels of 1 / 37, for float rounding
    Random random(11);
    std::size_t touched = 0, covered = 0;
    for (int t = 0; t < 300; ++t) {
        Layout l{{}, {0, 1, 2}};
        const glm::dvec2 middle(random.range(0.1, 0.9), random.range(0.1, 0.9));
        const double size = t % 2 == 0 ? 0.15 : 0.01; // five texels, or less than one
        for (int k = 0; k < 3; ++k)
            l.texcoords.emplace_back(middle + glm::dvec2(random.range(-size, size), random.range(-size, size)));
        glm::dvec2 corner[3];
        for (int k = 0; k < 3; ++k)
            corner[k] = glm::dvec2(l.texcoords[std::size_t(k)]) * glm::dvec2(kWidth, kHeight);
        const UvRaster raster(l.view(), kWidth, kHeight);
        UvRow row;
        for (int y = 0; y < kHeight; ++y) {
            raster.row(y, row);
            for (int x = 0; x < kWidth; ++x) {
                const glm::dvec2 centre(x + 0.5, y + 0.5);
                int left = 0;
                double away = 1e9;
                for (int k = 0; k < 3; ++k) {
                    const glm::dvec2 a = corner[k], b = corner[(k + 1) % 3];
                    left += (b.x - a.x) * (centre.y - a.y) > (b.y - a.y) * (centre.x - a.x);
                    away = std::min(away, distanceTo(centre, a, b));
                }
                if (away < kUnsure || std::abs(away - std::sqrt(0.5)) < kUnsure)
                    continue;
                const bool inside = left % 3 == 0, touches = !inside && away < std::sqrt(0.5);
                ASSERT_EQ(row.of(std::size_t(x)).size(), inside || touches) << t << " " << x << " " << y << " " << away;
                if (!inside && !touches)
                    continue;
                const UvSample& p = row.of(std::size_t(x)).front();
                EXPECT_EQ(p.covers, inside);
                const glm::dvec2 point =
                    corner[0] * (1 - double(p.b1) - double(p.b2)) + corner[1] * double(p.b1) + corner[2] * double(p.b2);
                EXPECT_NEAR(glm::length(point - centre), inside ? 0 : away, 2e-3); // samples are moved inwards by 1e-4
                ++(inside ? covered : touched);
            }
        }
    }
    EXPECT_GT(covered, 500u);
    EXPECT_GT(touched, 500u);
}

TEST(UvRaster, limitedSamplesAreASubsetAndASingleOneIsTheFirst)
{
    Layout l = jitteredGrid(9);
    for (int layer = 0; layer < 5; ++layer) // 6 layers of all triangles
        l.indices.insert(l.indices.end(), l.indices.begin(), l.indices.begin() + 9 * 9 * 6);
    const UvRaster raster(l.view(), 61, 43);
    UvRow all, one, few, many;
    for (int y = 0; y < 43; ++y) {
        raster.row(y, all);
        raster.row(y, one, {.maxPerTexel = 1});
        raster.row(y, few, {.maxPerTexel = 4});
        raster.row(y, many, {.maxPerTexel = 20});
        for (std::size_t x = 0; x < 61; ++x) {
            const auto of = [&](const UvRow& row) {
                std::vector<std::uint32_t> triangles;
                for (const UvSample& p : row.of(x))
                    triangles.push_back(p.triangle);
                return triangles;
            };
            ASSERT_EQ(of(all).size(), 6u);
            EXPECT_EQ(of(one), std::vector(1, of(all).front()));
            ASSERT_EQ(of(few).size(), 4u);
            EXPECT_TRUE(std::ranges::includes(of(all), of(few)));
            EXPECT_EQ(of(many), of(all));
        }
    }
}

TEST(UvRaster, ofThousandsOfRepetitionsSixteenAreRasterised)
{
    const Layout l{{{0.3f, 0.1f}, {3000, 700}, {900, 2500}}, {0, 1, 2}};
    const Coverage c = coverageOf(l.view(), 16, {0, 0}, /*wrap*/ true);
    EXPECT_EQ(c.covered, 256u);
    UvRow row;
    const UvRaster raster(l.view(), 16, 16, {0, 0}, /*wrap*/ true);
    raster.row(5, row);
    EXPECT_EQ(row.samples.size(), 16u * 16u);
}

TEST(UvRaster, overlapsAreCounted)
{
    Layout l = fan({0.5f, 0.5f});
    const std::vector<std::uint32_t> again = l.indices;
    l.indices.insert(l.indices.end(), again.begin(), again.begin() + 3); // the top quarter twice
    const Coverage c = coverageOf(l.view(), 64);
    EXPECT_EQ(c.covered, 64u * 64u);
    EXPECT_EQ(c.overlapping, coverageOf({l.texcoords, std::span(l.indices).first(3)}, 64).covered);
}

TEST(UvRaster, tilesCoverTheirUnitSquareAndWrappingCoversAll)
{
    Layout l = fan({0.5f, 0.5f});
    for (glm::vec2& uv : l.texcoords)
        uv += glm::vec2(1, 0);
    EXPECT_EQ(coverageOf(l.view(), 8).covered, 0u);
    EXPECT_EQ(coverageOf(l.view(), 8, {1, 0}).covered, 64u);
    EXPECT_EQ(coverageOf(l.view(), 8, {0, 0}, true).covered, 64u);
}

TEST(UvRaster, nonFiniteOrDegenerateUvCoverNothing)
{
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    for (glm::vec2 bad : {glm::vec2(nan, 0), {inf, 0}, {1e30f, 0}, {0, 0}, {-3e38f, 3e38f}}) {
        const Layout l{{{0, 0}, {1, 1}, bad}, {0, 1, 2}};
        EXPECT_EQ(coverageOf(l.view(), 4).covered, 0u);
        EXPECT_EQ(coverageOf(l.view(), 4, {0, 0}, true).covered, 0u);
    }
}

} // namespace
} // namespace cotan
