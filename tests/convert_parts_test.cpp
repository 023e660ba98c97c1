// The parts of convert: the texel that several places share, which place a texel of the padding follows, tallies, and
// texels under mirrored and clamped uv. x and y never play the same role.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <span>

#include "bake/convert/reencode.hpp"
#include "bake/surface/nearest_texels.hpp"
#include "cotan/convention.hpp"
#include "judgement_cases.hpp"
#include "place_finder.hpp"

namespace cotan {
namespace {

using namespace test;

// ---- one texel ------------------------------------------------------------------------------

TEST(SolveTexel, onePlaceGetsExactlyWhatItWantsThroughAnyFrame)
{
    const glm::dmat3 skew({2, 0.3, 0.1}, {-0.5, 0.7, 0}, {0.2, 0, 0.9});
    const glm::dvec3 wanted = glm::normalize(glm::dvec3(0.3, -0.2, 1));
    const Demand demand{skew, glm::normalize(skew * wanted)};
    const glm::dvec3 solved = solveTexel({&demand, 1}, {0, 0, 1});
    EXPECT_LT(angleBetween(solved, wanted), 1e-6);
    EXPECT_NEAR(glm::length(solved), 1, 1e-12);
    EXPECT_LT(degreesOff(demand, solved), 1e-6);
}

TEST(SolveTexel, twoPlacesMeetInTheMiddleWhateverTheirOrder)
{
    const glm::dvec3 a = glm::normalize(glm::dvec3(0.6, 0.1, 1)), b = glm::normalize(glm::dvec3(-0.2, 0.5, 1));
    const Demand there[] = {{glm::dmat3(1), a}, {glm::dmat3(1), b}}, back[] = {there[1], there[0]};
    EXPECT_LT(angleBetween(solveTexel(there, {0, 0, 1}), a + b), 1e-5); // equal frames: half way between
    EXPECT_LT(angleBetween(solveTexel(back, {0, 0, 1}), a + b), 1e-5);
    const Demand three[] = {there[0], there[1], there[1]}; // the sum of squares on the sphere: the sum of the targets
    EXPECT_LT(angleBetween(solveTexel(three, {0, 0, 1}), a + 2.0 * b), 1e-5);
}

// What solveTexel makes least: the squared distances of all normals from what their places want.
double costOf(std::span<const Demand> demands, glm::dvec3 texel)
{
    double sum = 0;
    for (const Demand& d : demands) {
        const glm::dvec3 r = glm::normalize(d.frame * texel) - d.target;
        sum += glm::dot(r, r);
    }
    return sum;
}

TEST(SolveTexel, theLeastSumOfSquaresIsNotTheSumOfTheTexels)
{
    // The first place sees slopes along x a tenth: it hardly minds, the second decides.
    const Demand demands[] = {{glm::dmat3({0.1, 0, 0}, {0, 1, 0}, {0, 0, 1}), glm::normalize(glm::dvec3(0.06, 0.2, 1))},
                              {glm::dmat3(1), glm::normalize(glm::dvec3(0, 0.2, 1))}};
    const auto cost = [&](glm::dvec3 m) { return costOf(demands, m); };
    const glm::dvec3 solved = solveTexel(demands, {0, 0, 1});
    EXPECT_LT(solved.x / solved.z, 0.02); // the texels alone would give 0.3
    for (double x : {-1e-3, 1e-3})
        for (double y : {-1e-3, 1e-3})
            EXPECT_GT(cost(solved + glm::dvec3(x, y, 0)), cost(solved));
}

TEST(SolveTexel, throughSkewFramesNoNeighbourIsBetter)
{
    const Demand demands[] = {
        {glm::dmat3({1, 0.8, 0}, {-0.1, 0.5, 0.2}, {0, 0, 1}), glm::normalize(glm::dvec3(0.5, 0.2, 1))},
        {glm::dmat3({0.3, 0, 0.1}, {0.9, 1, 0}, {0.2, 0, 1}), glm::normalize(glm::dvec3(-0.3, 0.6, 1))},
        {glm::dmat3({0.2, 1, 0}, {1, 0.1, -0.3}, {0, 0.1, 1}), glm::normalize(glm::dvec3(0.1, -0.4, 1))}};
    const auto cost = [&](glm::dvec3 m) { return costOf(demands, m); };
    const glm::dvec3 solved = solveTexel(demands, {0, 0, 1});
    constexpr double kStep = 1e-5; // 0.0006 degrees; the cost rises by its square, 1e-10, and is good to 1e-15
    for (const glm::dvec3 step : {glm::dvec3(kStep, 0, 0), {-kStep, 0, 0}, {0, kStep, 0}, {0, -kStep, 0}})
        EXPECT_GT(cost(solved + step), cost(solved));
}

TEST(SolveTexel, framesThatCannotBeTurnedRoundAskForNothing)
{
    const auto flat = [](double third) { return glm::dmat3({1, 0, 0}, {0, third, 0}, {0, 0, 1}); };
    EXPECT_TRUE(invertible(flat(1e-8)));
    EXPECT_TRUE(invertible(glm::dmat3({1e-3, 0, 0}, {0, 1e-3, 0}, {0, 0, 1})));
    EXPECT_FALSE(invertible(flat(0)));
    EXPECT_FALSE(invertible(glm::dmat3({1, 0, 0}, {1, 1e-10, 0}, {0, 0, 1}))); // t and b along one line
    EXPECT_TRUE(invertible(glm::dmat3({1, 0, 0}, {1, 1e-8, 0}, {0, 0, 1})));
    EXPECT_FALSE(invertible(glm::dmat3({NAN, 0, 0}, {0, 1, 0}, {0, 0, 1})));
    EXPECT_FALSE(invertible(glm::dmat3({1e-7, 0, 0}, {0, 1e-7, 0}, {0, 0, 1})));
    const Demand none{flat(0), {0.6, 0, 0.8}}, sound{glm::dmat3(1), {0, 0.6, 0.8}};
    const Demand both[] = {none, sound};
    EXPECT_LT(angleBetween(solveTexel(both, {0, 0, 1}), sound.target), 1e-6);
    EXPECT_EQ(solveTexel({&none, 1}, {0.1, 0.2, 0.9}), glm::dvec3(0.1, 0.2, 0.9));
    EXPECT_EQ(solveTexel({}, {0.1, 0.2, 0.9}), glm::dvec3(0.1, 0.2, 0.9));
}

TEST(SolveTexel, degreesAreThoseBetweenWhatIsWantedAndWhatIsSeen)
{
    const Demand d{glm::dmat3({0.5, 0, 0}, {0, 2, 0}, {0, 0, 1}), {0, 0, 1}};
    EXPECT_NEAR(degreesOff(d, {2, 0, 1}), 45, 1e-9);
    EXPECT_NEAR(degreesOff(d, {0, 0.5, 1}), 45, 1e-9);
    EXPECT_NEAR(degreesOff(d, {0, 0, -1}), 180, 1e-9);
}

// ---- padding --------------------------------------------------------------------------------

std::vector<std::uint32_t> spreadFrom(std::vector<std::uint32_t> covered, int width, int height,
                                      AskFirst first = AskFirst::beside)
{
    std::vector<std::uint32_t> owner(std::size_t(width * height), kNoTexel);
    for (std::uint32_t i : covered)
        owner[i] = i;
    spreadNearest(owner, width, height, first);
    return owner;
}

TEST(Padding, everyTexelFollowsTheNearestCoveredOne)
{
    // 7 by 3; covered: (1,0) and (5,2). Between them the shorter way counts, in x and in y.
    const auto owner = spreadFrom({1, 2 * 7 + 5}, 7, 3);
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

TEST(Padding, ofTwoEquallyNearTheOneAskedFirstCounts)
{
    // 2 by 2, covered: (1,0) and (0,1), each one texel from both others.
    EXPECT_EQ(spreadFrom({1, 2}, 2, 2, AskFirst::above)[3], 1u);
    EXPECT_EQ(spreadFrom({1, 2}, 2, 2, AskFirst::beside)[3], 2u);
    // Upwards the opposite neighbours are asked in the same order: below, or to the right.
    EXPECT_EQ(spreadFrom({1, 2}, 2, 2, AskFirst::above)[0], 1u); // the way back of the sweep down has been there
    EXPECT_EQ(distance2(1, 2, 2), 2);
}

TEST(Padding, isWithinAFractionOfATexelOfTheNearestAndDoesNotJoinTheBorders)
{
    constexpr int kWidth = 23, kHeight = 11;
    std::vector<std::uint32_t> covered;
    for (std::uint32_t i = 0, state = 1; i < kWidth * kHeight; ++i) {
        state = state * 1664525u + 1013904223u;
        if (state >> 28 == 0)
            covered.push_back(i);
    }
    ASSERT_GT(covered.size(), 5u);
    const auto owner = spreadFrom(covered, kWidth, kHeight);
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
    EXPECT_EQ(spreadFrom({}, 3, 2), std::vector<std::uint32_t>(6, kNoTexel));
    EXPECT_EQ(spreadFrom({4}, 5, 1), std::vector<std::uint32_t>(5, 4));
    EXPECT_EQ(spreadFrom({0}, 1, 5), std::vector<std::uint32_t>(5, 0));
    EXPECT_EQ(spreadFrom({4}, 1, 5), std::vector<std::uint32_t>(5, 4)); // upwards
    EXPECT_EQ(spreadFrom({0}, 5, 1), std::vector<std::uint32_t>(5, 0));
}

// ---- which places show a texel --------------------------------------------------------------

// A map of 4 by 2 under a rectangle, one unit of space per unit of uv; where on it a texel's first place lies.
std::vector<std::vector<glm::dvec2>> placesUnder(glm::vec2 low, glm::vec2 high, Wrap wrapU, Wrap wrapV, int row)
{
    MapUse use{surfaceOf(rectangle({low.x, -high.y}, high - low, low, high)), kAsMeant, 1, wrapU, wrapV};
    MapUse flat = use;
    flat.strength = 0;
    const MapUse uses[] = {flat, use}; // the first shows nothing
    const convert::PlaceFinder finder(uses, 4, 2);
    std::vector<std::vector<glm::dvec2>> uv(4);
    finder.rows(row, row, [&](int y, const PlacesOfRow<convert::Place>& places) {
        EXPECT_EQ(y, row);
        for (int x = 0; x < 4; ++x)
            for (const convert::Place& p : places.of(std::size_t(x)))
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

TEST(PlaceFinder, aTexelIsSeenWhereItsCentreIsInEachCopy)
{
    const auto once = placesUnder({0, 0}, {1, 1}, Wrap::repeat, Wrap::repeat, 1);
    expectAt(once[0], {{0.125, 0.75}});
    expectAt(once[3], {{0.875, 0.75}});
    const auto repeated = placesUnder({0, 0}, {2, 1}, Wrap::repeat, Wrap::repeat, 0);
    expectAt(repeated[1], {{0.375, 0.25}, {1.375, 0.25}});
}

TEST(PlaceFinder, mirroredAxesRunBackInEverySecondCopy)
{
    const auto u = placesUnder({0, 0}, {2, 1}, Wrap::mirror, Wrap::repeat, 0);
    expectAt(u[1], {{0.375, 0.25}, {1.625, 0.25}});
    const auto v = placesUnder({0, 0}, {1, 2}, Wrap::repeat, Wrap::mirror, 0);
    expectAt(v[1], {{0.375, 0.25}, {0.375, 1.75}});
    const auto both = placesUnder({0, 0}, {2, 2}, Wrap::mirror, Wrap::mirror, 1);
    expectAt(both[0], {{0.125, 0.75}, {1.875, 0.75}, {0.125, 1.25}, {1.875, 1.25}});
}

TEST(PlaceFinder, beyondAClampedAxisThereIsNothing)
{
    expectAt(placesUnder({0, 0}, {2, 1}, Wrap::clamp, Wrap::repeat, 0)[1], {{0.375, 0.25}});
    expectAt(placesUnder({0, 0}, {1, 2}, Wrap::repeat, Wrap::clamp, 0)[1], {{0.375, 0.25}});
    expectAt(placesUnder({0, 0}, {2, 1}, Wrap::repeat, Wrap::clamp, 0)[1], {{0.375, 0.25}, {1.375, 0.25}});
    expectAt(placesUnder({-1, -1}, {1, 1}, Wrap::clamp, Wrap::clamp, 1)[2], {{0.625, 0.75}});
}

// ---- whole maps -----------------------------------------------------------------------------

constexpr FramePair kPartsToCotangent{Frame::mikktspace, Frame::cotangent, TangentOrigin::generated,
                                      TangentOrigin::generated};
// As glTF has it, but for green, which runs along v here.
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

TEST(Reencode, aTallPatchNeedsTwiceTheSlopeAlongVTexelByTexel)
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
    EXPECT_EQ(r.disagreement.count, 0u); // of none: no figure
    EXPECT_TRUE(std::isnan(r.disagreement.mean));
}

TEST(Reencode, greenAgainstVStaysAgainstV)
{
    const Image map = unormMap(4, 2, [](int, int) { return glm::dvec3(0.1, 0.3, 1); });
    MapUse use = unormUse(rectangle({0, 0}, {1, 2}, {0, 0}, {1, 1}));
    use.stored.greenUp = true;
    const Reencoded r = reencode(map, {&use, 1}, kPartsToCotangent, 16);
    EXPECT_LT(angleBetween(unormTexel(r.image, 1, 1), {0.1, 0.6, 1}), 0.01);
    EXPECT_LT(r.error.maximum, 0.01);
    // Without alike axes: the frame of the sheared copy mixes u and v, and a wrong sign would show.
    auto sheared = rectangle({0, 0}, {1, 2}, {0, 0}, {1, 1});
    for (Corner& c : sheared)
        c.position.x += 0.5f * c.position.y;
    MapUse leaning = unormUse(sheared);
    leaning.stored.greenUp = true;
    EXPECT_LT(reencode(map, {&leaning, 1}, kPartsToCotangent, 16).error.maximum, 0.02);
}

TEST(Reencode, placesDisagreeFromHalfADegreeOn)
{
    // Two copies, one taller by a little: the slope along v is wanted as it is and times that. At 0.5, a factor f asks
    // for angles apart by about (f - 1) * 0.5 / 1.25 radians, and each is off by half of that.
    const Image map = unormMap(4, 4, [](int, int) { return glm::dvec3(0.0, 0.5, 1); });
    const auto off = [&](float factor) {
        const MapUse uses[] = {unormUse(rectangle({0, 0}, {1, 1}, {0, 0}, {1, 1})),
                               unormUse(rectangle({0, 0}, {1, factor}, {0, 0}, {1, 1}))};
        return reencode(map, uses, kPartsToCotangent, 16);
    };
    const Reencoded little = off(1.035f), more = off(1.055f); // 0.4 and 0.63 degrees
    EXPECT_EQ(little.several, 16u);
    EXPECT_EQ(little.disagreeing, 0u);
    EXPECT_EQ(more.disagreeing, 16u);
    EXPECT_NEAR(more.disagreement.mean, 0.63, 0.05);
    EXPECT_GT(little.error.mean, 0.3); // seen on the surface all the same
}

TEST(Reencode, aRowBetweenTexelCentresIsConvertedAndJudged)
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

TEST(Reencode, paddingTakesTheNearestPlaceAndEmptyTexelsStay)
{
    // Left half: u stretched by two; lowest row of the right half: v by two. The texel at the right end of each row is
    // empty.
    const Image map =
        unormMap(8, 8, [](int x, int) { return x == 7 ? glm::dvec3(0.5, 0.5, -1) : glm::dvec3(0.2, 0.3, 1); });
    const MapUse use = unormUse(rectangle({0, 0}, {1, 1}, {0, 0}, {0.25f, 0.5f})
                                + rectangle({4, 0}, {1, 4}, {0.5f, 0.75f}, {0.75f, 1}));
    const Reencoded r = reencode(map, {&use, 1}, kPartsToCotangent, 16);
    EXPECT_EQ(r.covered, 2u * 4u + 2u * 2u);
    // Left chart: gradients u 1/4... a unit square holds a quarter of u and half of v: u is half as dense, slopes
    // double.
    const glm::dvec3 left(0.4, 0.3, 1), right(0.2, 0.3 * 4, 1);
    EXPECT_LT(angleBetween(unormTexel(r.image, 0, 0), left), 0.02);
    EXPECT_LT(angleBetween(unormTexel(r.image, 0, 5), left), 0.02); // padding below it
    EXPECT_LT(angleBetween(unormTexel(r.image, 4, 6), right), 0.02);
    EXPECT_LT(angleBetween(unormTexel(r.image, 6, 3), right), 0.02); // padding above it
    for (int k = 0; k < 4; ++k)
        EXPECT_EQ(r.image.words()[4 * (3 * 8 + 7) + k], map.words()[4 * (3 * 8 + 7) + k]);
    EXPECT_EQ(r.padded, 64u - 12u - 8u);
}

// Rows of a map of 64 under a rectangle of two triangles, in uv.
double rowsUnderRectangle(glm::vec2 low, glm::vec2 high)
{
    return rowsUnder(surfaceOf(rectangle({0, 0}, {1, 1}, low, high)), 64);
}

TEST(RowsUnder, areThoseOfEachTriangleAndCopy)
{
    // Two triangles of 32 rows, and one more each where a row is cut.
    EXPECT_EQ(rowsUnderRectangle({0.25f, 0.25f}, {0.75f, 0.75f}), 2 * (32 + 1));
    // Four columns of copies, each of two whole rows of them.
    EXPECT_EQ(rowsUnderRectangle({0, 0}, {4, 2}), 2 * 4 * (2 * 64 + 2));
    EXPECT_EQ(rowsUnderRectangle({0, 0}, {2e6f, 1}), 0); // not drawn
}

TEST(RowsUnder, ofATriangleWithRoomForWholeCopiesAreThoseOfSixteen)
{
    EXPECT_EQ(rowsUnderRectangle({0, 0}, {100, 100}), 2 * 4 * (4 * 64 + 4));
    EXPECT_EQ(rowsUnderRectangle({0, 0}, {3000, 3000}), 2 * 4 * (4 * 64 + 4));
}

TEST(PlaceFinder, placesAreNoMoreThanSixteenOfATexelHoweverManyTrianglesShowIt)
{
    std::vector<Corner> many;
    for (int i = 0; i < 300; ++i)
        many = many + rectangle({i, 0}, {1, 1}, {0, 0}, {1, 1});
    const MapUse use = unormUse(many);
    const convert::PlaceFinder finder({&use, 1}, 8, 8);
    int rows = 0;
    finder.rows(0, 7, [&](int y, const PlacesOfRow<convert::Place>& row) {
        EXPECT_EQ(y, rows++);
        for (int x = 0; x < 8; ++x) {
            const auto places = row.of(std::size_t(x));
            ASSERT_EQ(places.size(), kMaxPlaces);
            EXPECT_LT(places.front().triangle, 100u); // of 600: they are from all over the list
            EXPECT_GT(places.back().triangle, 500u);
            EXPECT_TRUE(std::ranges::is_sorted(places, {}, &convert::Place::triangle));
            EXPECT_TRUE(std::ranges::all_of(places, &convert::Place::covers));
        }
    });
    EXPECT_EQ(rows, 8);
}

} // namespace
} // namespace cotan
