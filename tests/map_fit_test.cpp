// Whether a map fits another frame: judged at places on the surface, wherever they lie between texels.
#include <gtest/gtest.h>

#include <algorithm>

#include "judgement_cases.hpp"

namespace cotan {
namespace {

using namespace test;

MapUse fitUse(const std::vector<Corner>& corners, double scale = 1)
{
    MapUse use{surfaceOf(corners), kAsMeant};
    use.strength = scale;
    return use;
}

constexpr FramePair kFitCotangent{Frame::mikktspace, Frame::cotangent, TangentOrigin::generated,
                                  TangentOrigin::generated};

const glm::dvec3 kTexel(0.4, 0.3, 1);
Image fitMap()
{
    return floatMap(4, 4, [](int, int) { return kTexel; });
}

TEST(MapFit, pointsAreSpreadByArea)
{
    // Areas 1 and 3 (two triangles each), and 4 without area in uv.
    const MappedSurface s =
        surfaceOf(rectangle({0, 0}, {1, 1}, {0, 0}, {1, 1}) + rectangle({2, 0}, {1, 3}, {0, 0}, {1, 1})
                  + rectangle({4, 0}, {2, 2}, {0.5f, 0}, {0.5f, 1}));
    std::size_t counts[6] = {};
    const auto points = pointsOver(s, 800);
    ASSERT_EQ(points.size(), 800u);
    glm::dvec3 middle(0);
    for (const MeshPoint& p : points) {
        ++counts[p.triangle];
        middle += p.barycentric / 800.0;
        EXPECT_NEAR(p.barycentric.x + p.barycentric.y + p.barycentric.z, 1, 1e-12);
        EXPECT_GE(std::min({p.barycentric.x, p.barycentric.y, p.barycentric.z}), -1e-12);
    }
    EXPECT_EQ(counts[0], 100u);
    EXPECT_EQ(counts[1], 100u);
    EXPECT_EQ(counts[2], 300u);
    EXPECT_EQ(counts[3], 300u);
    for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(middle[k], 1.0 / 3, 0.01); // of random points the mean would be good to 0.008
    EXPECT_TRUE(pointsOver(surfaceOf(rectangle({4, 0}, {2, 2}, {0.5f, 0}, {0.5f, 1})), 10).empty());
}

TEST(MapFit, theErrorIsThatOfTheOtherFrame)
{
    const MapUse use = fitUse(rectangle({0, 0}, {2, 1}, {0, 0}, {1, 1})); // u is half as dense as v
    const Image map = fitMap();
    const ValueSummary s = mapError(map, map, {&use, 1}, kFitCotangent);
    EXPECT_NEAR(s.mean, angleBetween(kTexel, {0.2, 0.3, 1}), 1e-4);
    EXPECT_NEAR(s.maximum, s.mean, 1e-4);
    EXPECT_EQ(s.count, 4096u);
    EXPECT_NEAR(mapError(map, map, {&use, 1},
                         {Frame::cotangent, Frame::mikktspace, TangentOrigin::generated, TangentOrigin::generated})
                    .mean,
                s.mean, 1e-4);
    EXPECT_NEAR(mapError(map, map, {&use, 1},
                         {Frame::mikktspace, Frame::orthonormal, TangentOrigin::generated, TangentOrigin::generated})
                    .mean,
                0, 1e-4);
    // The right answer for the new frame, in a map of another size.
    const Image right = floatMap(2, 8, [](int, int) { return glm::dvec3(0.8, 0.3, 1); });
    EXPECT_NEAR(mapError(map, right, {&use, 1}, kFitCotangent).maximum, 0, 1e-4);
    EXPECT_GT(mapError(right, map, {&use, 1}, kFitCotangent).mean, 10);
}

TEST(MapFit, usesWeighByTheirAreaAndFlattenedOnesDoNotCount)
{
    const MapUse good = fitUse(rectangle({0, 0}, {1, 1}, {0, 0}, {1, 1})),
                 bad = fitUse(rectangle({0, 0}, {4, 2}, {0, 0}, {1, 1}));
    const Image map = fitMap();
    const double alone = mapError(map, map, {&bad, 1}, kFitCotangent).mean;
    EXPECT_NEAR(mapError(map, map, std::vector{good, bad}, kFitCotangent).mean, alone * 8 / 9, 1e-4);
    const MapUse flattened = fitUse(rectangle({0, 0}, {4, 2}, {0, 0}, {1, 1}), 0),
                 negative = fitUse(rectangle({0, 0}, {4, 2}, {0, 0}, {1, 1}), -1);
    EXPECT_NEAR(mapError(map, map, std::vector{good, flattened}, kFitCotangent).mean, 0, 1e-4);
    EXPECT_EQ(mapError(map, map, {&flattened, 1}, kFitCotangent).count, 0u);
    EXPECT_NEAR(mapError(map, map, {&negative, 1}, kFitCotangent).mean, alone, 1e-4);
}

TEST(MapFit, readsTheMapAsTheUseSays)
{
    // Only the third column of four is not flat. u from 1.5 to 1.75 repeats it, mirrors the second, clamps to the last.
    const Image map = floatMap(4, 1, [](int x, int) { return x == 2 ? kTexel : glm::dvec3(0, 0, 1); });
    for (const auto& [wrap, seen] : {std::pair(Wrap::repeat, true), {Wrap::mirror, false}, {Wrap::clamp, false}}) {
        MapUse use = fitUse(rectangle({0, 0}, {2, 4}, {1.5f, 0}, {1.75f, 1}));
        use.wrapU = wrap;
        EXPECT_EQ(mapError(map, map, {&use, 1}, kFitCotangent).mean > 1, seen) << int(wrap);
        const Image column = floatMap(1, 4, [](int, int y) { return y == 2 ? kTexel : glm::dvec3(0, 0, 1); });
        MapUse alongV = fitUse(rectangle({0, 0}, {4, 2}, {0, 1.5f}, {1, 1.75f}));
        alongV.wrapV = wrap;
        EXPECT_EQ(mapError(column, column, {&alongV, 1}, kFitCotangent).mean > 1, seen) << int(wrap);
    }
}

// No triangle covers the centre of a texel: v runs from 0.05 to 0.3 of a single row, whose centre is at 0.5.
TEST(MapFit, aRowBetweenTexelCentresIsJudged)
{
    const MapUse use = fitUse(rectangle({0, 0}, {4, 0.5f}, {0, 0.05f}, {1, 0.3f}));
    const Image row = floatMap(16, 1, [](int x, int) { return glm::dvec3(0.02 * x, 0.3, 1); });
    const ValueSummary s = mapError(row, row, {&use, 1}, kFitCotangent);
    EXPECT_EQ(s.count, 4096u);
    EXPECT_GT(s.mean, 1);
    EXPECT_FALSE(fitsAsItIs(s));
}

TEST(MapFit, nothingIsSaidWhereNothingShowsTheMap)
{
    const MapUse line = fitUse(rectangle({0, 0}, {4, 1}, {0, 0.5f}, {1, 0.5f})), empty = fitUse({});
    const Image map = fitMap();
    for (const std::vector<MapUse>& uses : {std::vector<MapUse>{}, {line}, {empty}, {line, empty}}) {
        const ValueSummary s = mapError(map, map, uses, kFitCotangent);
        EXPECT_EQ(s.count, 0u);
        EXPECT_TRUE(std::isnan(s.mean));
    }
}

TEST(MapFit, manyUsesShareThePoints)
{
    const std::vector<MapUse> uses(100, fitUse(rectangle({0, 0}, {2, 1}, {0, 0}, {1, 1})));
    const Image map = fitMap();
    EXPECT_EQ(mapError(map, map, uses, kFitCotangent).count, 100u * (65536u / 100u));
}

TEST(MapFit, aMapFitsUpToThreeTenthsOfADegreeOn95PercentOfTheArea)
{
    EXPECT_TRUE(fitsAsItIs({100, 0.1, 0.29, 5}));
    EXPECT_FALSE(fitsAsItIs({100, 0.1, 0.31, 0.4}));
    EXPECT_TRUE(fitsAsItIs({100, 0.5, 0.29, 5}));
    EXPECT_TRUE(fitsAsItIs({})); // nothing shows it: nothing asks for another
}

} // namespace
} // namespace cotan
