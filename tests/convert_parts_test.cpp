// The parts of convert: a texel shared by several samples, the sample that a padding texel follows, statistics, and
// texels under mirrored and clamped uv. x and y never play the same role.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <span>

#include "bake/convert/reencode.hpp"
#include "bake/surface/nearest_texels.hpp"
#include "cotan/convention.hpp"
#include "judgement_cases.hpp"
#include "point_finder.hpp"

namespace cotan {
namespace {

using namespace test;

// ---- one texel ------------------------------------------------------------------------------

TEST(SolveTexel, oneDemandIsSolvedExactlyInAnyFrame)
{
    const glm::dmat3 skew({2, 0.3, 0.1}, {-0.5, 0.7, 0}, {0.2, 0, 0.9});
    const glm::dvec3 target = glm::normalize(glm::dvec3(0.3, -0.2, 1));
    const Demand demand{skew, glm::normalize(skew * target)};
    const glm::dvec3 solved = solveTexel({&demand, 1}, {0, 0, 1});
    EXPECT_LT(angleBetween(solved, target), 1e-6);
    EXPECT_NEAR(glm::length(solved), 1, 1e-12);
    EXPECT_LT(degreesOff(demand, solved), 1e-6);
}

TEST(SolveTexel, twoDemandsAreAveragedInAnyOrder)
{
    const glm::dvec3 a = glm::normalize(glm::dvec3(0.6, 0.1, 1)), b = glm::normalize(glm::dvec3(-0.2, 0.5, 1));
    const Demand there[] = {{glm::dmat3(1), a}, {glm::dmat3(1), b}}, back[] = {there[1], there[0]};
    EXPECT_LT(angleBetween(solveTexel(there, {0, 0, 1}), a + b), 1e-5); // equal frames: halfway between
    EXPECT_LT(angleBetween(solveTexel(back, {0, 0, 1}), a + b), 1e-5);
    const Demand three[] = {there[0], there[1], there[1]}; // the sum of the targets
    EXPECT_LT(angleBetween(solveTexel(three, {0, 0, 1}), a + 2.0 * b), 1e-5);
}

// What solveTexel minimises: the sum of squared distances of all normals from their targets.
double costOf(std::span<const Demand> demands, glm::dvec3 texel)
{
    double sum = 0;
    for (const Demand& d : demands) {
        const glm::dvec3 r = glm::normalize(d.frame * texel) - d.target;
        sum += glm::dot(r, r);
    }
    return sum;
}

TEST(SolveTexel, theLeastSquaresSolutionIsNotTheMeanTexel)
{
    // The first sample scales slopes along x by a tenth and is hardly affected; the second decides.
    const Demand demands[] = {{glm::dmat3({0.1, 0, 0}, {0, 1, 0}, {0, 0, 1}), glm::normalize(glm::dvec3(0.06, 0.2, 1))},
                              {glm::dmat3(1), glm::normalize(glm::dvec3(0, 0.2, 1))}};
    const auto cost = [&](glm::dvec3 m) { return costOf(demands, m); };
    const glm::dvec3 solved = solveTexel(demands, {0, 0, 1});
    EXPECT_LT(solved.x / solved.z, 0.02); // the mean of the texels alone would be 0.3
    for (double x : {-1e-3, 1e-3})
        for (double y : {-1e-3, 1e-3})
            EXPECT_GT(cost(solved + glm::dvec3(x, y, 0)), cost(solved));
}

TEST(SolveTexel, skewedFramesReachALocalMinimum)
{
    const Demand demands[] = {
        {glm::dmat3({1, 0.8, 0}, {-0.1, 0.5, 0.2}, {0, 0, 1}), glm::normalize(glm::dvec3(0.5, 0.2, 1))},
        {glm::dmat3({0.3, 0, 0.1}, {0.9, 1, 0}, {0.2, 0, 1}), glm::normalize(glm::dvec3(-0.3, 0.6, 1))},
        {glm::dmat3({0.2, 1, 0}, {1, 0.1, -0.3}, {0, 0.1, 1}), glm::normalize(glm::dvec3(0.1, -0.4, 1))}};
    const auto cost = [&](glm::dvec3 m) { return costOf(demands, m); };
    const glm::dvec3 solved = solveTexel(demands, {0, 0, 1});
    constexpr double kStep = 1e-5; // 0.0006 degrees; the cost rises by its square, 1e-10, and is accurate to 1e-15
    for (const glm::dvec3 step : {glm::dvec3(kStep, 0, 0), {-kStep, 0, 0}, {0, kStep, 0}, {0, -kStep, 0}})
        EXPECT_GT(cost(solved + step), cost(solved));
}

TEST(SolveTexel, singularFramesDemandNothing)
{
    const auto flat = [](double third) { return glm::dmat3({1, 0, 0}, {0, third, 0}, {0, 0, 1}); };
    EXPECT_TRUE(invertible(flat(1e-8)));
    EXPECT_TRUE(invertible(glm::dmat3({1e-3, 0, 0}, {0, 1e-3, 0}, {0, 0, 1})));
    EXPECT_FALSE(invertible(flat(0)));
    EXPECT_FALSE(invertible(glm::dmat3({1, 0, 0}, {1, 1e-10, 0}, {0, 0, 1}))); // t and b are collinear
    EXPECT_TRUE(invertible(glm::dmat3({1, 0, 0}, {1, 1e-8, 0}, {0, 0, 1})));
    EXPECT_FALSE(invertible(glm::dmat3({NAN, 0, 0}, {0, 1, 0}, {0, 0, 1})));
    EXPECT_FALSE(invertible(glm::dmat3({1e-7, 0, 0}, {0, 1e-7, 0}, {0, 0, 1})));
    const Demand none{flat(0), {0.6, 0, 0.8}}, sound{glm::dmat3(1), {0, 0.6, 0.8}};
    const Demand both[] = {none, sound};
    EXPECT_LT(angleBetween(solveTexel(both, {0, 0, 1}), sound.target), 1e-6);
    EXPECT_EQ(solveTexel({&none, 1}, {0.1, 0.2, 0.9}), glm::dvec3(0.1, 0.2, 0.9));
    EXPECT_EQ(solveTexel({}, {0.1, 0.2, 0.9}), glm::dvec3(0.1, 0.2, 0.9));
}

TEST(SolveTexel, degreesAreBetweenTargetAndPerturbedNormal)
{
    const Demand d{glm::dmat3({0.5, 0, 0}, {0, 2, 0}, {0, 0, 1}), {0, 0, 1}};
    EXPECT_NEAR(degreesOff(d, {2, 0, 1}), 45, 1e-9);
    EXPECT_NEAR(degreesOff(d, {0, 0.5, 1}), 45, 1e-9);
    EXPECT_NEAR(degreesOff(d, {0, 0, -1}), 180, 1e-9);
}

// ---- padding --------------------------------------------------------------------------------

std::vector<std::uint32_t> nearestCoveredOf(std::vector<std::uint32_t> covered, int width, int height,
                                            TieBreak first = TieBreak::beside)
{
    std::vector<std::uint32_t> owner(std::size_t(width * height), kNoTexel);
    for (std::uint32_t i : covered)
        owner[i] = i;
    propagateNearest(owner, width, height, first);
    return owner;
}

TEST(Padding, everyTexelFollowsTheNearestCoveredOne)
{
    // 7 by 3; covered: (1,0) and (5,2). Between them the nearer one counts, in x and in y.
    const auto owner = nearestCoveredOf({1, 2 * 7 + 5}, 7, 3);
    for (std::size_t i = 0; i < owner.size(); ++i) {
        const auto d2 = [&](std::uint32_t o) {
            const int dx = int(o % 7) - int(i % 7), dy = int(o / 7) - int(i / 7);
            return dx * dx + dy * dy;
        };
        EXPECT_EQ(d2(owner[i]), std::min(d2(1), d2(19))) << i;
    }
    EXPECT_EQ(owner[0], 1u);
    EXPECT_EQ(owner[20], 19u);
}

TEST(Padding, tiesAreBrokenByTheSearchOrder)
{
    // 2 by 2; covered: (1,0) and (0,1), each one texel from both others.
    EXPECT_EQ(nearestCoveredOf({1, 2}, 2, 2, TieBreak::above)[3], 1u);
    EXPECT_EQ(nearestCoveredOf({1, 2}, 2, 2, TieBreak::beside)[3], 2u);
    // Going up, the opposite neighbours are tried in the same order: below, or to the right.
    EXPECT_EQ(nearestCoveredOf({1, 2}, 2, 2, TieBreak::above)[0], 1u); // set by the backward pass of the sweep down
}

TEST(Padding, isNearlyTheNearestAndDoesNotWrap)
{
    constexpr int kWidth = 23, kHeight = 11;
    std::vector<std::uint32_t> covered;
    for (std::uint32_t i = 0, state = 1; i < kWidth * kHeight; ++i) {
        state = state * 1664525u + 1013904223u;
        if (state >> 28 == 0)
            covered.push_back(i);
    }
    ASSERT_GT(covered.size(), 5u);
    const auto owner = nearestCoveredOf(covered, kWidth, kHeight);
    for (std::uint32_t i = 0; i < kWidth * kHeight; ++i) {
        const auto distance = [&](std::uint32_t o) {
            return std::hypot(double(o % kWidth) - double(i % kWidth), double(o / kWidth) - double(i / kWidth));
        };
        double nearest = 1e9;
        for (std::uint32_t c : covered)
            nearest = std::min(nearest, distance(c));
        ASSERT_NE(owner[i], kNoTexel);
        EXPECT_NE(std::find(covered.begin(), covered.end(), owner[i]), covered.end());
        EXPECT_LT(distance(owner[i]), nearest + 0.5) << i;
    }
    EXPECT_EQ(nearestCoveredOf({}, 3, 2), std::vector<std::uint32_t>(6, kNoTexel));
    EXPECT_EQ(nearestCoveredOf({4}, 5, 1), std::vector<std::uint32_t>(5, 4));
    EXPECT_EQ(nearestCoveredOf({0}, 1, 5), std::vector<std::uint32_t>(5, 0));
    EXPECT_EQ(nearestCoveredOf({4}, 1, 5), std::vector<std::uint32_t>(5, 4)); // upwards
    EXPECT_EQ(nearestCoveredOf({0}, 5, 1), std::vector<std::uint32_t>(5, 0));
}

// ---- samples of a texel ---------------------------------------------------------------------

// A map of 4 by 2 under a rectangle, one unit of space per unit of uv: positions of the samples of a row's texels.
std::vector<std::vector<glm::dvec2>> pointsUnder(glm::vec2 low, glm::vec2 high, Wrap wrapU, Wrap wrapV, int row)
{
    MapUse use{surfaceOf(rectangle({low.x, -high.y}, high - low, low, high)), kUnconverted, 1, wrapU, wrapV};
    MapUse flat = use;
    flat.strength = 0;
    const MapUse uses[] = {flat, use}; // the first has no strength and no samples
    const convert::PointFinder finder(uses, 4, 2);
    std::vector<std::vector<glm::dvec2>> uv(4);
    finder.rows(row, row, [&](int y, const SamplesOfRow<convert::SurfacePoint>& points) {
        EXPECT_EQ(y, row);
        for (int x = 0; x < 4; ++x)
            for (const convert::SurfacePoint& p : points.of(std::size_t(x)))
                if (p.covers) {
                    EXPECT_EQ(p.use, 1u);
                    uv[std::size_t(x)].push_back(uvAt(use.surface, p.triangle, p.barycentric));
                }
    });
    return uv;
}

void expectAt(const std::vector<glm::dvec2>& found, std::vector<glm::dvec2> expected)
{
    ASSERT_EQ(found.size(), expected.size());
    const auto less = [](glm::dvec2 a, glm::dvec2 b) { return std::pair(a.x, a.y) < std::pair(b.x, b.y); };
    std::vector<glm::dvec2> sorted = found;
    std::sort(sorted.begin(), sorted.end(), less);
    std::sort(expected.begin(), expected.end(), less);
    for (std::size_t i = 0; i < sorted.size(); ++i)
        EXPECT_LT(glm::length(sorted[i] - expected[i]), 1e-5);
}

TEST(PointFinder, aTexelIsFoundAtItsCentreInEachRepetition)
{
    const auto once = pointsUnder({0, 0}, {1, 1}, Wrap::repeat, Wrap::repeat, 1);
    expectAt(once[0], {{0.125, 0.75}});
    expectAt(once[3], {{0.875, 0.75}});
    const auto repeated = pointsUnder({0, 0}, {2, 1}, Wrap::repeat, Wrap::repeat, 0);
    expectAt(repeated[1], {{0.375, 0.25}, {1.375, 0.25}});
}

TEST(PointFinder, mirroredAxesReverseInEverySecondRepetition)
{
    const auto u = pointsUnder({0, 0}, {2, 1}, Wrap::mirror, Wrap::repeat, 0);
    expectAt(u[1], {{0.375, 0.25}, {1.625, 0.25}});
    const auto v = pointsUnder({0, 0}, {1, 2}, Wrap::repeat, Wrap::mirror, 0);
    expectAt(v[1], {{0.375, 0.25}, {0.375, 1.75}});
    const auto both = pointsUnder({0, 0}, {2, 2}, Wrap::mirror, Wrap::mirror, 1);
    expectAt(both[0], {{0.125, 0.75}, {1.875, 0.75}, {0.125, 1.25}, {1.875, 1.25}});
}

TEST(PointFinder, nothingIsFoundBeyondAClampedAxis)
{
    expectAt(pointsUnder({0, 0}, {2, 1}, Wrap::clamp, Wrap::repeat, 0)[1], {{0.375, 0.25}});
    expectAt(pointsUnder({0, 0}, {1, 2}, Wrap::repeat, Wrap::clamp, 0)[1], {{0.375, 0.25}});
    expectAt(pointsUnder({0, 0}, {2, 1}, Wrap::repeat, Wrap::clamp, 0)[1], {{0.375, 0.25}, {1.375, 0.25}});
    expectAt(pointsUnder({-1, -1}, {1, 1}, Wrap::clamp, Wrap::clamp, 1)[2], {{0.625, 0.75}});
}

// ---- whole maps -----------------------------------------------------------------------------

constexpr FramePair kPartsToCotangent{Frame::mikktspace, Frame::cotangent, TangentOrigin::generated,
                                      TangentOrigin::generated};
// Like glTF, but with green along v.
constexpr Convention kUnorm{.greenUp = false};
const auto kUnorm16 = toFormat<f64::cotan_normal_format>(kUnorm, 1, 16);

Image unormMap(int width, int height, const std::function<glm::dvec3(int, int)>& texel)
{
    Image image = makeImage(width, height, PixelType::unorm16, "map");
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const glm::dvec3 stored = f64::cotan_encode_texel(glm::normalize(texel(x, y)), kUnorm16);
            std::uint16_t* p = image.words() + 4 * (y * width + x);
            for (int k = 0; k < 3; ++k)
                p[k] = std::uint16_t(std::lround(65535 * stored[k]));
            p[3] = std::uint16_t(1000 * x + 10 * y);
        }
    return image;
}

MapUse unormUse(const std::vector<Corner>& corners)
{
    MapUse use{surfaceOf(corners), kUnorm};
    return use;
}

glm::dvec3 unormTexel(const Image& image, int x, int y)
{
    return glm::normalize(f64::cotan_decode(storedTexel(image, x, y), kUnorm16));
}

TEST(Reencode, aPatchOfTwiceTheHeightDoublesTheSlopeAlongV)
{
    const auto texel = [](int x, int y) { return glm::dvec3(0.1 + 0.05 * x, 0.3 - 0.1 * y, 1); };
    const Image map = unormMap(4, 2, texel);
    const MapUse use = unormUse(rectangle({0, 0}, {1, 2}, {0, 0}, {1, 1}));
    const Reencoded r = reencode(map, {&use, 1}, kPartsToCotangent, 16);
    ASSERT_EQ(r.image.width, 4);
    ASSERT_EQ(r.image.height, 2);
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 4; ++x) {
            const glm::dvec3 m = texel(x, y);
            EXPECT_LT(angleBetween(unormTexel(r.image, x, y), {m.x, 2 * m.y, 1}), 0.01) << x << " " << y;
            EXPECT_EQ(r.image.words()[4 * (y * 4 + x) + 3], 1000 * x + 10 * y); // alpha
        }
    EXPECT_EQ(r.covered, 8u);
    EXPECT_EQ(r.belowHorizon, 0u);
    EXPECT_LT(r.error.maximum, 0.01);
    EXPECT_GT(r.unconverted.mean, 1);
    EXPECT_EQ(r.moved.count, 8u);
    EXPECT_EQ(r.disagreement.count, 0u); // an empty set has no figure
    EXPECT_TRUE(std::isnan(r.disagreement.mean));
}

TEST(Reencode, greenKeepsItsDirection)
{
    const Image map = unormMap(4, 2, [](int, int) { return glm::dvec3(0.1, 0.3, 1); });
    MapUse use = unormUse(rectangle({0, 0}, {1, 2}, {0, 0}, {1, 1}));
    use.stored.greenUp = true;
    const Reencoded r = reencode(map, {&use, 1}, kPartsToCotangent, 16);
    EXPECT_LT(angleBetween(unormTexel(r.image, 1, 1), {0.1, 0.6, 1}), 0.01);
    EXPECT_LT(r.error.maximum, 0.01);
    // Without equal axes: the frame of the sheared copy mixes u and v, so a wrong sign would be visible.
    auto sheared = rectangle({0, 0}, {1, 2}, {0, 0}, {1, 1});
    for (Corner& c : sheared)
        c.position.x += 0.5f * c.position.y;
    MapUse leaning = unormUse(sheared);
    leaning.stored.greenUp = true;
    EXPECT_LT(reencode(map, {&leaning, 1}, kPartsToCotangent, 16).error.maximum, 0.02);
}

TEST(Reencode, demandsConflictFromHalfADegree)
{
    // Two copies, one slightly taller: they need the slope along v unchanged and multiplied by `factor`. At slope 0.5,
    // a factor f separates the angles by about (f - 1) * 0.5 / 1.25 radians; each has half of that as its error.
    const Image map = unormMap(4, 4, [](int, int) { return glm::dvec3(0.0, 0.5, 1); });
    const auto reencodedWith = [&](float factor) {
        const MapUse uses[] = {unormUse(rectangle({0, 0}, {1, 1}, {0, 0}, {1, 1})),
                               unormUse(rectangle({0, 0}, {1, factor}, {0, 0}, {1, 1}))};
        return reencode(map, uses, kPartsToCotangent, 16);
    };
    const Reencoded little = reencodedWith(1.035f), more = reencodedWith(1.055f); // 0.4 and 0.63 degrees
    EXPECT_EQ(little.several, 16u);
    EXPECT_EQ(little.disagreeing, 0u);
    EXPECT_EQ(more.disagreeing, 16u);
    EXPECT_NEAR(more.disagreement.mean, 0.63, 0.05);
    EXPECT_GT(little.error.mean, 0.3); // still counted as an error on the surface
}

TEST(Reencode, aRowBetweenTexelCentresIsConvertedAndMeasured)
{
    const Image row = unormMap(64, 1, [](int x, int) { return glm::dvec3(0.3, 0.004 * x, 1); });
    const MapUse use = unormUse(rectangle({0, 0}, {4, 0.5f}, {0, 0.05f}, {1, 0.3f})); // 1/4 and 1/2 of uv per unit
    const Reencoded r = reencode(row, {&use, 1}, kPartsToCotangent, 16);
    EXPECT_EQ(r.covered, 0u);
    EXPECT_EQ(r.padded, 64u);
    EXPECT_GT(r.unconverted.mean, 1);
    EXPECT_EQ(r.error.count, r.unconverted.count);
    EXPECT_GT(r.error.count, 0u);
    EXPECT_LT(r.error.maximum, 0.05);
}

TEST(Reencode, texelsThatPointBelowTheHorizonAreCounted)
{
    Mesh mesh = meshOf(rectangle({0, 0}, {1, 1}, {0, 0}, {1, 1}));
    const Image map = unormMap(2, 2, [](int x, int) { return glm::dvec3(x == 0 ? 0.9 : 0.1, 0.0, x == 0 ? -0.4 : 1); });
    const MapUse use{makeSurface(mesh, Texture{}), kUnorm, 1, Wrap::repeat, Wrap::repeat};
    EXPECT_EQ(reencode(map, {&use, 1}, kPartsToCotangent, 8).belowHorizon, 2u);
}

TEST(Reencode, paddingTakesTheNearestSampleAndEmptyTexelsAreKept)
{
    // The left half stretches u by two; the lowest row of the right half stretches v by two. The right texel of each
    // row is empty.
    const Image map =
        unormMap(8, 8, [](int x, int) { return x == 7 ? glm::dvec3(0.5, 0.5, -1) : glm::dvec3(0.2, 0.3, 1); });
    const MapUse use = unormUse(rectangle({0, 0}, {1, 1}, {0, 0}, {0.25f, 0.5f})
                                + rectangle({4, 0}, {1, 4}, {0.5f, 0.75f}, {0.75f, 1}));
    const Reencoded r = reencode(map, {&use, 1}, kPartsToCotangent, 16);
    EXPECT_EQ(r.covered, 2u * 4u + 2u * 2u);
    // Left chart: a unit square spans a quarter of u and half of v. u is half as dense, so its slopes double.
    const glm::dvec3 left(0.4, 0.3, 1), right(0.2, 0.3 * 4, 1);
    EXPECT_LT(angleBetween(unormTexel(r.image, 0, 0), left), 0.02);
    EXPECT_LT(angleBetween(unormTexel(r.image, 0, 5), left), 0.02); // padding below it
    EXPECT_LT(angleBetween(unormTexel(r.image, 4, 6), right), 0.02);
    EXPECT_LT(angleBetween(unormTexel(r.image, 6, 3), right), 0.02); // padding above it
    for (int k = 0; k < 4; ++k)
        EXPECT_EQ(r.image.words()[4 * (3 * 8 + 7) + k], map.words()[4 * (3 * 8 + 7) + k]);
    EXPECT_EQ(r.padded, 64u - 12u - 8u);
}

// Rows of a map of height 64 under a rectangle of two triangles with these uv.
double rowsUnderRectangle(glm::vec2 low, glm::vec2 high)
{
    return rowsUnder(surfaceOf(rectangle({0, 0}, {1, 1}, low, high)), 64);
}

TEST(RowsUnder, sumsEachTriangleAndRepetition)
{
    // Two triangles of 32 rows, plus one row each where a row is cut.
    EXPECT_EQ(rowsUnderRectangle({0.25f, 0.25f}, {0.75f, 0.75f}), 2 * (32 + 1));
    // Four columns of copies, each with two copies of all rows.
    EXPECT_EQ(rowsUnderRectangle({0, 0}, {4, 2}), 2 * 4 * (2 * 64 + 2));
    EXPECT_EQ(rowsUnderRectangle({0, 0}, {2e6f, 1}), 0); // not drawn
}

TEST(RowsUnder, countsAtMostSixteenRepetitions)
{
    EXPECT_EQ(rowsUnderRectangle({0, 0}, {100, 100}), 2 * 4 * (4 * 64 + 4));
    EXPECT_EQ(rowsUnderRectangle({0, 0}, {3000, 3000}), 2 * 4 * (4 * 64 + 4));
}

TEST(PointFinder, aTexelHasAtMostSixteenSamples)
{
    std::vector<Corner> many;
    for (int i = 0; i < 300; ++i)
        many = many + rectangle({i, 0}, {1, 1}, {0, 0}, {1, 1});
    const MapUse use = unormUse(many);
    const convert::PointFinder finder({&use, 1}, 8, 8);
    int rows = 0;
    finder.rows(0, 7, [&](int y, const SamplesOfRow<convert::SurfacePoint>& row) {
        EXPECT_EQ(y, rows++);
        for (int x = 0; x < 8; ++x) {
            const auto points = row.of(std::size_t(x));
            ASSERT_EQ(points.size(), kMaxPointsPerTexel);
            EXPECT_LT(points.front().triangle, 100u); // of 600: samples are spread over the whole list
            EXPECT_GT(points.back().triangle, 500u);
            EXPECT_TRUE(std::ranges::is_sorted(points, {}, &convert::SurfacePoint::triangle));
            EXPECT_TRUE(std::ranges::all_of(points, &convert::SurfacePoint::covers));
        }
    });
    EXPECT_EQ(rows, 8);
}

} // namespace
} // namespace cotan
