// Whether a map fits another frame, judged at surface points that may lie anywhere between texels.
#include <gtest/gtest.h>

#include <algorithm>

#include "judgement_cases.hpp"

namespace cotan {
namespace {

using namespace test;

MapUse fitUse(const std::vector<Corner>& corners, double scale = 1)
{
    MapUse use{surfaceOf(corners), kUnconverted};
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

TEST(MapFit, pointsAreDistributedByArea)
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
        EXPECT_NEAR(middle[k], 1.0 / 3, 0.01); // for random points the mean would be accurate to 0.008
    EXPECT_TRUE(pointsOver(surfaceOf(rectangle({4, 0}, {2, 2}, {0.5f, 0}, {0.5f, 1})), 10).empty());
}

TEST(MapFit, errorIsThatOfTheOtherFrame)
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
    // The exact result for the new frame, in a map of another size.
    const Image right = floatMap(2, 8, [](int, int) { return glm::dvec3(0.8, 0.3, 1); });
    EXPECT_NEAR(mapError(map, right, {&use, 1}, kFitCotangent).maximum, 0, 1e-4);
    EXPECT_GT(mapError(right, map, {&use, 1}, kFitCotangent).mean, 10);
}

TEST(MapFit, usesAreWeightedByAreaAndZeroStrengthIsIgnored)
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

TEST(MapFit, readsTheMapWithTheWrapModesOfTheUse)
{
    // Only the third of four columns is tilted. u from 1.5 to 1.75 reads it with repeat, not with mirror or clamp.
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

// No triangle covers a texel centre: v runs from 0.05 to 0.3 of a single row, whose centre is at 0.5.
TEST(MapFit, aRowBetweenTexelCentresIsJudged)
{
    const MapUse use = fitUse(rectangle({0, 0}, {4, 0.5f}, {0, 0.05f}, {1, 0.3f}));
    const Image row = floatMap(16, 1, [](int x, int) { return glm::dvec3(0.02 * x, 0.3, 1); });
    const ValueSummary s = mapError(row, row, {&use, 1}, kFitCotangent);
    EXPECT_EQ(s.count, 4096u);
    EXPECT_GT(s.mean, 1);
    EXPECT_FALSE(fitsAsItIs(s));
}

TEST(MapFit, mapOnNoAreaHasNoError)
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

TEST(MapFit, mapFitsUpTo0Point3DegreesAtThe95thPercentile)
{
    EXPECT_TRUE(fitsAsItIs({100, 0.1, 0.29, 5}));
    EXPECT_FALSE(fitsAsItIs({100, 0.1, 0.31, 0.4}));
    EXPECT_TRUE(fitsAsItIs({100, 0.5, 0.29, 5}));
    EXPECT_TRUE(fitsAsItIs({})); // not visible, so no other map is needed
}

TEST(MapFit, pointsInATriangleAreTheR2Sequence)
{
    double rho = 1.3; // rho^3 = rho + 1
    for (int i = 0; i < 50; ++i)
        rho = std::cbrt(rho + 1);
    const std::vector<MeshPoint> points =
        pointsOver(surfaceOf({{{0, 0, 0}, {0, 0}}, {{2, 0, 0}, {1, 0}}, {{0, 1, 0}, {0, 1}}}), 100);
    ASSERT_EQ(points.size(), 100u);
    for (int k = 0; k < 100; ++k) {
        double a = 0.5 + k / rho, b = 0.5 + k / (rho * rho);
        a -= std::floor(a);
        b -= std::floor(b);
        if (a + b > 1 + 1e-9) // in the other half of the square: rotated about its centre
            a = 1 - a, b = 1 - b;
        const glm::dvec3 found = points[std::size_t(k)].barycentric;
        EXPECT_NEAR(found.y, a, 1e-11) << k;
        EXPECT_NEAR(found.z, b, 1e-11) << k;
        EXPECT_NEAR(found.x, 1 - a - b, 1e-11) << k;
    }
}

TEST(MapFit, areaIsThatOfTrianglesWithUvArea)
{
    double area = -1;
    const MappedSurface some = surfaceOf(rectangle({0, 0}, {1, 3}, {0, 0}, {1, 1})
                                         + rectangle({4, 0}, {2, 2}, {0.5f, 0}, {0.5f, 1})); // no area in uv
    EXPECT_EQ(pointsOver(some, 5, &area).size(), 5u);
    EXPECT_NEAR(area, 3, 1e-6);
    EXPECT_TRUE(pointsOver(surfaceOf({}), 5, &area).empty());
    EXPECT_EQ(area, 0);
}

TEST(MapFit, surfacesShareThePointsOf128AndHaveAtLeast16)
{
    for (const auto& [surfaces, points] : {std::pair(0u, 4096u),
                                           {1u, 4096u},
                                           {128u, 4096u},
                                           {129u, 524288u / 129},
                                           {1000u, 524u},
                                           {32768u, 16u},
                                           {1000000u, 16u}})
        EXPECT_EQ(pointsOfEach(surfaces), points) << surfaces;
}

TEST(MapFit, usesShareThePointsOf16UpToAGivenLimit)
{
    const MapUse use = fitUse(rectangle({0, 0}, {2, 1}, {0, 0}, {1, 1}));
    const Image map = fitMap();
    const auto count = [&](std::size_t uses, std::size_t limit) {
        return mapErrors(map, map, std::vector(uses, use), {&kFitCotangent, 1}, {}, limit)[0].count;
    };
    EXPECT_EQ(count(1, 7), 7u);
    EXPECT_EQ(count(1, 5000), 4096u);
    EXPECT_EQ(count(64, 5000), 64u * 1024);
    EXPECT_EQ(count(64, 100), 6400u);
}

// Of more than 1,024 uses every second one is measured, starting with the first.
TEST(MapFit, manyUsesAreSampledEvenly)
{
    const Image map = fitMap();
    const MapUse good = fitUse(rectangle({0, 0}, {1, 1}, {0, 0}, {1, 1})),
                 bad = fitUse(rectangle({0, 0}, {4, 2}, {0, 0}, {1, 1}));
    std::vector<MapUse> uses;
    for (int i = 0; i < 1025; ++i)
        uses.push_back(i % 2 == 0 ? good : bad);
    const auto errorOf = [&] { return mapErrors(map, map, uses, {&kFitCotangent, 1}, {}, 3)[0]; };
    EXPECT_EQ(errorOf().count, 513u * 3);
    EXPECT_NEAR(errorOf().maximum, 0, 1e-4);
    uses.pop_back();
    EXPECT_EQ(errorOf().count, 1024u * 3);
    EXPECT_GT(errorOf().maximum, 1);
}

TEST(MapFit, strengthUpToAMillionthIsIgnored)
{
    const Image map = fitMap();
    for (const auto& [strength, counts] :
         {std::pair(1e-6, false), {1.001e-6, true}, {-1.001e-6, true}, {-1e-6, false}}) {
        const MapUse use = fitUse(rectangle({0, 0}, {2, 1}, {0, 0}, {1, 1}), strength);
        EXPECT_EQ(mapError(map, map, {&use, 1}, kFitCotangent).count > 0, counts) << strength;
    }
}

// The same normal stored signed and as codes about the middle; each map is read with its own expansion.
TEST(MapFit, convertedMapIsReadWithItsOwnExpansion)
{
    const MapUse use = fitUse(rectangle({0, 0}, {1, 1}, {0, 0}, {1, 1}));
    const glm::dvec3 m = glm::normalize(kTexel);
    const Image before = floatMap(4, 4, [&](int, int) { return m; }),
                after = floatMap(4, 4, [&](int, int) { return m * 0.5 + 0.5; });
    const FramePair same{Frame::mikktspace, Frame::orthonormal, TangentOrigin::generated, TangentOrigin::generated};
    EXPECT_NEAR(mapError(before, after, {&use, 1}, same, Expansion::exact).maximum, 0, 1e-4);
    EXPECT_NEAR(mapError(before, before, {&use, 1}, same, Expansion::exact).mean, angleBetween(m, m * 2.0 - 1.0), 1e-3);
    EXPECT_GT(mapError(before, after, {&use, 1}, same).mean, 1);
}

TEST(MapFit, directionsAreComparedAsUndirectedLines)
{
    Mesh mesh = meshOf(rectangle({0, 0}, {1, 1}, {0, 0}, {1, 1}));
    const auto turn = [&](double degrees) {
        const double a = glm::radians(degrees);
        mesh.tangents.assign(6, degrees == 999 ? glm::vec4(0, 0, 0, 1) : glm::vec4(std::cos(a), std::sin(a), 0, 1));
        const MappedSurface s = makeSurface(mesh, Texture{});
        return directionTurn(s, pointsOver(s, 10),
                             {Frame::mikktspace, Frame::mikktspace, TangentOrigin::stored, TangentOrigin::generated});
    };
    for (const auto& [degrees, expected] :
         {std::pair(0.0, 0.0), {30.0, 30.0}, {-50.0, 50.0}, {90.0, 90.0}, {100.0, 80.0}, {170.0, 10.0}, {180.0, 0.0}}) {
        const ValueSummary s = turn(degrees);
        EXPECT_EQ(s.count, 10u);
        EXPECT_NEAR(s.mean, expected, 1e-4) << degrees;
        EXPECT_NEAR(s.maximum, expected, 1e-4) << degrees;
    }
    EXPECT_EQ(turn(999).count, 0u);
}

TEST(MapFit, vertexFramesAreDerivedUnlessTheFileHasThem)
{
    using enum TangentOrigin;
    struct Case {
        FramePair frames;
        bool storedTangents;
        std::vector<Frame> derived;
    };
    const Case cases[] = {
        {{Frame::mikktspace, Frame::orthonormal, generated, generated}, true, {Frame::mikktspace}},
        {{Frame::mikktspace, Frame::orthonormal, stored, generated}, true, {}},
        {{Frame::mikktspace, Frame::orthonormal, stored, generated}, false, {Frame::mikktspace}},
        {{Frame::orthonormal, Frame::mikktspace, stored, generated}, true, {Frame::mikktspace}},
        {{Frame::orthonormal, Frame::mikktspace, generated, stored}, true, {}},
        {{Frame::smooth, Frame::mikktspace, stored, generated}, true, {Frame::smooth, Frame::mikktspace}},
        {{Frame::mikktspace, Frame::smooth, stored, stored}, true, {Frame::smooth}}, // no file has those of smooth
        {{Frame::cotangent, Frame::exact, stored, stored}, false, {}},
    };
    for (const Case& c : cases) {
        FrameSet expected;
        for (const Frame frame : c.derived)
            expected.set(std::size_t(frame));
        EXPECT_EQ(framesRead(c.frames, c.storedTangents), expected) << &c - cases;
    }
}

// ---- texels ---------------------------------------------------------------------------------

TEST(Texels, areReadByColumnAndRowInEveryType)
{
    Image bytes = makeImage(3, 2, PixelType::unorm8, ""), words = makeImage(3, 2, PixelType::unorm16, "");
    for (std::size_t i = 0; i < 24; ++i) {
        bytes.bytes8()[i] = std::uint8_t(10 * i);
        words.words()[i] = std::uint16_t(1000 * i);
    }
    EXPECT_EQ(storedTexel(bytes, 2, 1), glm::dvec3(200, 210, 220) / 255.0);
    EXPECT_EQ(storedTexel(bytes, 1, 0), glm::dvec3(40, 50, 60) / 255.0);
    EXPECT_EQ(storedTexel(words, 0, 1), glm::dvec3(12000, 13000, 14000) / 65535.0);
    const Image floats = floatMap(3, 2, [](int x, int y) { return glm::dvec3(x, y, 7); });
    EXPECT_EQ(storedTexel(floats, 2, 1), glm::dvec3(2, 1, 7));
    const auto asMeant = toFormat<f64::cotan_normal_format>(kUnconverted);
    EXPECT_EQ(decodedAt(floats, Wrap::repeat, Wrap::clamp, asMeant, {-0.1, 1.9}).x, 2); // repeats along u
    EXPECT_EQ(decodedAt(floats, Wrap::repeat, Wrap::clamp, asMeant, {-0.1, 1.9}).y, 1); // clamps to the last row
}

TEST(Texels, coordinatesFollowTheWrapMode)
{
    EXPECT_EQ(wrappedTexel(0.26, 4, Wrap::repeat), 1);
    EXPECT_EQ(wrappedTexel(1.26, 4, Wrap::repeat), 1);
    EXPECT_EQ(wrappedTexel(-0.1, 4, Wrap::repeat), 3);
    EXPECT_EQ(wrappedTexel(1.26, 4, Wrap::mirror), 2);
    EXPECT_EQ(wrappedTexel(-0.26, 4, Wrap::mirror), 1);
    EXPECT_EQ(wrappedTexel(1.26, 4, Wrap::clamp), 3);
    EXPECT_EQ(wrappedTexel(-5, 4, Wrap::clamp), 0);
    EXPECT_EQ(wrappedTexel(std::nan(""), 4, Wrap::repeat), 0);
}

TEST(Texels, imageWithMissingBytesHasNoPixels)
{
    Image image = makeImage(2, 2, PixelType::unorm8, "");
    EXPECT_TRUE(hasPixels(image));
    image.data.pop_back();
    EXPECT_FALSE(hasPixels(image));
    EXPECT_FALSE(hasPixels(Image{}));
}

} // namespace
} // namespace cotan
