// The samples of a map's texels in rows that cross blocks, compared with one row at a time and with a search over all
// triangles, copies and mirrored copies.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <random>
#include <span>
#include <tuple>

#include "judgement_cases.hpp"
#include "point_finder.hpp"

namespace cotan {
namespace {

using namespace test;
using convert::PointFinder;
using convert::SurfacePoint;

constexpr int kWide = 13, kHigh = 21; // neither is a multiple of a block

using RowsOfPoints = std::map<int, std::vector<std::vector<SurfacePoint>>>;

RowsOfPoints rowsFrom(const PointFinder& finder, int first, int last)
{
    RowsOfPoints rows;
    int next = first;
    finder.rows(first, last, [&](int y, const SamplesOfRow<convert::SurfacePoint>& row) {
        EXPECT_EQ(y, next++);
        for (std::size_t x = 0; x + 1 < row.first.size(); ++x)
            rows[y].emplace_back(row.of(x).begin(), row.of(x).end());
    });
    EXPECT_EQ(next, last + 1);
    return rows;
}

void expectEqual(const std::vector<std::vector<SurfacePoint>>& a, const std::vector<std::vector<SurfacePoint>>& b)
{
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t x = 0; x < a.size(); ++x) {
        ASSERT_EQ(a[x].size(), b[x].size()) << x;
        for (std::size_t i = 0; i < a[x].size(); ++i) {
            EXPECT_EQ(a[x][i].use, b[x][i].use);
            EXPECT_EQ(a[x][i].triangle, b[x][i].triangle);
            EXPECT_EQ(a[x][i].barycentric, b[x][i].barycentric);
            EXPECT_EQ(a[x][i].covers, b[x][i].covers);
        }
    }
}

// Position of a texel's centre in copy `k` along an axis of `size` texels, if that copy exists.
std::optional<double> centreIn(int k, int texel, int size, Wrap wrap)
{
    if (wrap == Wrap::clamp && k != 0)
        return std::nullopt;
    const bool back = wrap == Wrap::mirror && k % 2 != 0;
    const double within = (texel + 0.5) / size;
    return k + (back ? 1 - within : within);
}

// Triangles with uv up to two copies away, from a third of a copy to one copy in size.
std::vector<Corner> randomCorners(std::mt19937& random, int count)
{
    const auto range = [&](float low, float high) { return std::uniform_real_distribution(low, high)(random); };
    std::vector<Corner> corners;
    for (int i = 0; i < count; ++i) {
        const glm::vec2 at(range(-1.6f, 2.2f), range(-1.6f, 2.2f));
        for (int k = 0; k < 3; ++k) {
            const glm::vec2 uv = at + glm::vec2(range(0, 0.9f), range(0, 0.9f));
            corners.push_back({{uv.x, uv.y, 0}, uv});
        }
    }
    return corners;
}

// The samples (use, triangle, uv) that cover a texel's centre, and whether rounding could decide otherwise.
struct Found {
    std::vector<std::tuple<std::uint32_t, std::uint32_t, double, double>> points;
    bool close = false;
};

Found searchAll(std::span<const MapUse> uses, const std::vector<std::vector<Corner>>& corners, int x, int y)
{
    Found found;
    for (std::uint32_t use = 0; use < uses.size(); ++use)
        for (std::uint32_t t = 0; t < corners[use].size() / 3; ++t) {
            const glm::dvec2 a(corners[use][3 * t].uv), b(corners[use][3 * t + 1].uv), c(corners[use][3 * t + 2].uv);
            const auto cross = [](glm::dvec2 p, glm::dvec2 q) { return p.x * q.y - p.y * q.x; };
            const double area = cross(b - a, c - a);
            for (int j = -2; j <= 3; ++j)
                for (int i = -2; i <= 3; ++i) {
                    const auto u = centreIn(i, x, kWide, uses[use].wrapU), v = centreIn(j, y, kHigh, uses[use].wrapV);
                    if (!u || !v)
                        continue;
                    const glm::dvec2 p(*u, *v);
                    const double b1 = cross(p - a, c - a) / area, b2 = cross(b - a, p - a) / area,
                                 least = std::min({b1, b2, 1 - b1 - b2});
                    found.close = found.close || std::abs(least) < 1e-4;
                    if (least > 0)
                        found.points.emplace_back(use, t, p.x, p.y);
                }
        }
    return found;
}

TEST(PointFinder, severalBlocksGiveTheResultsOfABruteForceSearch)
{
    std::mt19937 random(7);
    std::size_t compared = 0, several = 0;
    for (const Wrap a : {Wrap::repeat, Wrap::mirror, Wrap::clamp})
        for (const Wrap b : {Wrap::repeat, Wrap::mirror, Wrap::clamp}) {
            // Two surfaces with exchanged wrap modes; the first has two instances.
            const std::vector<Corner> one = randomCorners(random, 10), two = randomCorners(random, 8);
            const MappedSurface first = surfaceOf(one);
            const MapUse uses[] = {{first, kUnconverted, 1, a, b},
                                   {placedBy(first, glm::dmat3(2)), kUnconverted, 1, a, b},
                                   {surfaceOf(two), kUnconverted, 1, b, a}};
            const std::vector<std::vector<Corner>> corners{one, one, two};
            const PointFinder finder(uses, kWide, kHigh);
            RowsOfPoints single;
            for (int y = 0; y < kHigh; ++y)
                single.merge(rowsFrom(finder, y, y));
            for (const auto& [from, to] : {std::pair(0, 20), {5, 18}, {7, 8}, {8, 15}, {16, 20}, {3, 4}})
                for (const auto& [y, texels] : rowsFrom(finder, from, to))
                    expectEqual(texels, single[y]);
            for (int y = 0; y < kHigh; ++y)
                for (int x = 0; x < kWide; ++x) {
                    const std::vector<SurfacePoint>& points = single[y][std::size_t(x)];
                    Found expected = searchAll(uses, corners, x, y);
                    if (expected.close)
                        continue;
                    ASSERT_LE(expected.points.size(), kMaxPointsPerTexel);
                    EXPECT_TRUE(std::ranges::is_sorted(points, {}, &SurfacePoint::use)) << x << " " << y;
                    if (expected.points.empty()) { // only touching samples
                        EXPECT_TRUE(std::ranges::none_of(points, &SurfacePoint::covers)) << x << " " << y;
                        continue;
                    }
                    ASSERT_EQ(points.size(), expected.points.size()) << int(a) << int(b) << " " << x << " " << y;
                    std::vector<std::tuple<std::uint32_t, std::uint32_t, double, double>> found;
                    for (const SurfacePoint& p : points) {
                        EXPECT_TRUE(p.covers);
                        const glm::dvec2 uv = uvAt(uses[p.use].surface, p.triangle, p.barycentric);
                        found.emplace_back(p.use, p.triangle, uv.x, uv.y);
                    }
                    const auto key = [](const auto& point) { // centres are 1 / 21 apart
                        const auto& [use, triangle, u, v] = point;
                        return std::tuple(use, triangle, std::lround(1000 * u), std::lround(1000 * v));
                    };
                    std::ranges::sort(found, {}, key);
                    std::ranges::sort(expected.points, {}, key);
                    for (std::size_t i = 0; i < found.size(); ++i) {
                        const auto& [use, triangle, u, v] = found[i];
                        const auto& [use2, triangle2, u2, v2] = expected.points[i];
                        EXPECT_EQ(use, use2);
                        EXPECT_EQ(triangle, triangle2);
                        EXPECT_NEAR(u, u2, 1e-5) << x << " " << y;
                        EXPECT_NEAR(v, v2, 1e-5) << x << " " << y;
                    }
                    ++compared;
                    several += found.size() > 1;
                }
        }
    EXPECT_GT(compared, 800u);
    EXPECT_GT(several, 400u);
}

TEST(PointFinder, texelsOfLargeMapsHaveFewerSamples)
{
    std::vector<Corner> many;
    for (int i = 0; i < 30; ++i)
        many = many + rectangle({i, 0}, {1, 1}, {0, 0}, {1, 1});
    const MapUse use{surfaceOf(many), kUnconverted};
    // At most 2^24 samples for all texels, with 4 to 16 for each; 30 triangles cover each texel.
    const std::tuple<int, int, std::size_t> cases[] = {
        {8, 1024, 16}, {1024, 1024, 16}, {1024, 2048, 8}, {2048, 2048, 4}, {2048, 4096, 4}};
    for (const auto& [width, height, maximum] : cases)
        for (const auto& [y, texels] : rowsFrom(PointFinder({&use, 1}, width, height), height / 2, height / 2))
            for (const std::vector<SurfacePoint>& points : texels)
                ASSERT_EQ(points.size(), maximum) << width << "x" << height;
}

TEST(PointFinder, usesWithoutUvOrStrengthHaveNoSamples)
{
    Mesh bare = meshOf(rectangle({0, 0}, {1, 1}, {0, 0}, {1, 1}));
    bare.texcoords[0].clear();
    const MappedSurface square = surfaceOf(rectangle({0, 0}, {1, 1}, {0, 0}, {1, 1}));
    const MapUse uses[] = {{makeSurface(bare, Texture{}), kUnconverted, 1},
                           {square, kUnconverted, 0},
                           {square, kUnconverted, -1}}; // inverted but visible
    for (const auto& [y, texels] : rowsFrom(PointFinder(uses, 3, 11), 6, 9))
        for (const auto& points : texels) {
            ASSERT_EQ(points.size(), 1u) << y;
            EXPECT_EQ(points[0].use, 2u);
        }
}

} // namespace
} // namespace cotan
