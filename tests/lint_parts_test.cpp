// The parts of lint on a few triangles each, with expected figures derived by hand. u and v never have equal roles.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "judgement_cases.hpp"
#include "lint_parts.hpp"

namespace cotan {
namespace {

using namespace test;

constexpr double kFloats = 1e-5; // positions and uv are floats; ratios and angles of differences are good to 1e-6

// One unit of uv over 1 by `height`: the gradient of v is 1/height of that of u.
MappedSurface tall(float height) { return surfaceOf(rectangle({0, 0}, {1, height}, {0, 0}, {1, 1})); }

TEST(UvQuality, gradientIsTheAreaMedianOfTheLongerOne)
{
    EXPECT_NEAR(lint::uvQuality(tall(4)).gradient, 1, kFloats);     // of u; v has a quarter
    EXPECT_NEAR(lint::uvQuality(tall(0.25f)).gradient, 4, kFloats); // of v
    const auto small = rectangle({0, 0}, {1, 1}, {0, 0}, {3, 3}), other = rectangle({2, 0}, {1, 1}, {0, 0}, {3, 3}),
               third = rectangle({4, 0}, {1, 1}, {0, 0}, {7, 7});
    EXPECT_NEAR(lint::uvQuality(surfaceOf(small + third + other)).gradient, 3, kFloats);
}

TEST(UvQuality, stretchCountsFrom1Point2AndShearFrom10Degrees)
{
    EXPECT_NEAR(lint::uvQuality(tall(1.19f)).stretch.mean, 1.19, kFloats);
    EXPECT_EQ(lint::uvQuality(tall(1.19f)).stretched, 0);
    EXPECT_EQ(lint::uvQuality(tall(1.21f)).stretched, 1);
    EXPECT_EQ(lint::uvQuality(tall(1 / 1.21f)).stretched, 1);
    for (const auto& [angle, share] : {std::pair(9.0, 0.0), {11.0, 1.0}, {-9.0, 0.0}, {-11.0, 1.0}}) {
        auto corners = rectangle({0, 0}, {1, 1}, {0, 0}, {1, 1});
        for (Corner& c : corners) // u + s v: its gradient tilts towards that of v
            c.uv.x += float(std::tan(glm::radians(angle))) * c.uv.y;
        const UvQuality q = lint::uvQuality(surfaceOf(corners));
        EXPECT_NEAR(q.shear.mean, std::abs(angle), 1e-4);
        EXPECT_EQ(q.sheared, share) << angle;
    }
}

TEST(UvQuality, fractionsAreWeightedByArea)
{
    // Areas: 1 mirrored, 3 stretched threefold along v, 4 a line in uv, 8 square; 16 in total.
    const auto mirrored = rectangle({0, 0}, {1, 1}, {1, 0}, {0, 1}),
               stretched = rectangle({2, 0}, {1, 3}, {0, 0}, {1, 1}),
               line = rectangle({4, 0}, {2, 2}, {0.5f, 0}, {0.5f, 1}),
               square = rectangle({8, 0}, {2, 4}, {0, 0}, {2, 4});
    const UvQuality q = lint::uvQuality(surfaceOf(mirrored + stretched + line + square));
    EXPECT_NEAR(q.area, 16, kFloats);
    EXPECT_NEAR(q.mirrored, 1.0 / 16, kFloats);
    EXPECT_NEAR(q.stretched, 3.0 / 16, kFloats);
    EXPECT_NEAR(q.degenerate, 4.0 / 16, kFloats);
    EXPECT_NEAR(q.stretch.mean, (1 + 3 * 3 + 8) / 12.0, kFloats); // the line has no stretch
    EXPECT_NEAR(q.stretch.maximum, 3, kFloats);
    EXPECT_EQ(q.stretch.count, 6u); // triangles
    EXPECT_EQ(q.largestUv, 4);
}

TEST(UvQuality, uvAreDegenerateFromAStretchOf10000)
{
    EXPECT_EQ(lint::uvQuality(tall(9000)).degenerate, 0);
    EXPECT_NEAR(lint::uvQuality(tall(9000)).stretch.mean, 9000, 1);
    EXPECT_EQ(lint::uvQuality(tall(11000)).degenerate, 1);
}

TEST(UvQuality, withoutAreaFractionsAreNaN)
{
    const UvQuality none = lint::uvQuality(surfaceOf(rectangle({0, 0}, {1, 0}, {0, 0}, {1, 1})));
    EXPECT_EQ(none.area, 0);
    EXPECT_TRUE(std::isnan(none.mirrored) && std::isnan(none.degenerate) && std::isnan(none.stretched));
    EXPECT_EQ(none.stretch.count, 0u);
    EXPECT_TRUE(std::isnan(none.stretch.mean) && std::isnan(none.shear.maximum));
    EXPECT_EQ(none.largestUv, 1);
}

// ---- edges ----------------------------------------------------------------------------------

// Two triangles that meet in x = 0, y from 0 to 1; v runs down along both. On the left u = x; on the right u = x times
// `across`, and v gains `along` times x.
std::vector<Corner> adjacentTriangles(float across, float along, float right = 1)
{
    return {{{0, 0, 0}, {0, 1}},
            {{0, 1, 0}, {0, 0}},
            {{-1, 0, 0}, {-1, 1}},
            {{0, 0, 0}, {0, 1}},
            {{right, 0, 0}, {right * across, 1 + right * along}},
            {{0, 1, 0}, {0, 0}}};
}

constexpr double kExact = 1e-10; // degrees: these positions and uv are exact as floats

// Angles by which a texel tilted by 35 degrees changes, in eight directions, when its slopes are scaled by u and v.
std::vector<double> expectedSteps(double u, double v)
{
    std::vector<double> steps;
    for (int k = 0; k < 8; ++k) {
        const double s = std::tan(glm::radians(35.0)), a = glm::radians(45.0 * k);
        steps.push_back(
            angleBetween({s * std::cos(a), s * std::sin(a), 1}, {u * s * std::cos(a), v * s * std::sin(a), 1}));
    }
    return steps;
}

double meanOf(const std::vector<double>& values)
{
    double sum = 0;
    for (double v : values)
        sum += v;
    return sum / double(values.size());
}

TEST(EdgeSteps, halvedUvDensityHalvesTheSlopes)
{
    const EdgeSteps s = lint::edgeSteps(surfaceOf(adjacentTriangles(0.5f, 0)));
    const std::vector<double> expected = expectedSteps(0.5, 1); // the gradient of v is the longer one on both sides
    EXPECT_EQ(s.edges, 1u);
    EXPECT_EQ(s.cotangent.count, 8u);
    EXPECT_NEAR(s.cotangent.mean, meanOf(expected), kExact);
    EXPECT_NEAR(s.cotangent.maximum, *std::max_element(expected.begin(), expected.end()), kExact);
    EXPECT_NEAR(s.orthonormal.maximum, 0, 1e-4); // ignores lengths
}

TEST(EdgeSteps, denserUvScaleTheOtherTriangle)
{
    const EdgeSteps s = lint::edgeSteps(surfaceOf(adjacentTriangles(2, 0))); // there, v has half the gradient
    EXPECT_NEAR(s.cotangent.mean, meanOf(expectedSteps(1, 0.5)), kExact);
}

TEST(EdgeSteps, areWeightedByTheAreasOnBothSides)
{
    // Two separate pairs, of areas 1/2 + 1/2 and 1/2 + 3/2; only the second has steps.
    auto far = adjacentTriangles(0.5f, 0, 3);
    for (Corner& c : far)
        c.position.y += 10;
    const EdgeSteps s = lint::edgeSteps(surfaceOf(adjacentTriangles(1, 0) + far));
    EXPECT_EQ(s.edges, 2u);
    EXPECT_NEAR(s.cotangent.mean, meanOf(expectedSteps(0.5, 1)) * 2 / 3, kExact);
}

TEST(EdgeSteps, orthonormalHasStepsWhereLinesOfEqualVBend)
{
    // u = y and v = x along this edge; u = y + x beyond it: lines of equal v, and t along them, do not change.
    EXPECT_NEAR(lint::edgeSteps(surfaceOf({{{0, 0, 0}, {0, 0}},
                                           {{0, 1, 0}, {1, 0}},
                                           {{-1, 0, 0}, {0, -1}},
                                           {{0, 0, 0}, {0, 0}},
                                           {{1, 0, 0}, {1, 1}},
                                           {{0, 1, 0}, {1, 0}}}))
                    .orthonormal.maximum,
                0, 1e-4);
    // v gains x beyond the edge: its lines, and with them the frame, rotate by 45 degrees.
    const EdgeSteps s = lint::edgeSteps(surfaceOf(adjacentTriangles(1, 1)));
    const double c = std::cos(glm::radians(35.0)),
                 expected = glm::degrees(std::acos(c * c + (1 - c * c) * std::sqrt(0.5)));
    EXPECT_EQ(s.edges, 1u);
    EXPECT_NEAR(s.orthonormal.mean, expected, kExact);
    EXPECT_NEAR(s.orthonormal.maximum, expected, kExact);
}

TEST(EdgeSteps, onlyInteriorEdgesOfOneOrientationCount)
{
    EXPECT_EQ(lint::edgeSteps(surfaceOf(adjacentTriangles(-1, 0))).edges, 0u); // mirrored beyond the edge: a seam
    auto apart = adjacentTriangles(1, 0), hard = apart, split = apart;
    apart[3].position.y = -1e-3f;
    EXPECT_EQ(lint::edgeSteps(surfaceOf(apart)).edges, 0u);
    hard[3].normal = glm::normalize(glm::vec3(0.1f, 0, 1));
    EXPECT_EQ(lint::edgeSteps(surfaceOf(hard)).edges, 0u);
    split[3].uv.y = 1.25f;
    EXPECT_EQ(lint::edgeSteps(surfaceOf(split)).edges, 0u);
    // With a third triangle at the edge, the neighbour is ambiguous.
    auto third = adjacentTriangles(1, 0);
    third.insert(third.end(), {{{0, 0, 0}, {0, 1}}, {{0.5f, 0, 1}, {0.5f, 1}}, {{0, 1, 0}, {0, 0}}});
    EXPECT_EQ(lint::edgeSteps(surfaceOf(third)).edges, 0u);
    EXPECT_EQ(lint::edgeSteps(surfaceOf(third)).cotangent.count, 0u);
}

// ---- stored tangents ------------------------------------------------------------------------

// Areas 1 and 3; stored tangents are those of the uv, except that `change` modifies those of the first rectangle.
template<class Change> StoredTangents storedWith(const Change& change, bool mirroredUv = false)
{
    const float left = mirroredUv ? 1.0f : 0.0f;
    Mesh mesh = meshOf(rectangle({0, 0}, {1, 1}, {left, 0}, {1 - left, 1})
                       + rectangle({2, 0}, {1, 3}, {left, 0}, {1 - left, 3}));
    mesh.tangents.assign(mesh.vertexCount(), mirroredUv ? glm::vec4(-1, 0, 0, -1) : glm::vec4(1, 0, 0, 1));
    for (std::size_t i = 0; i < 6; ++i)
        change(mesh.tangents[i]);
    return lint::storedTangents(makeSurface(mesh, Texture{}));
}

TEST(StoredTangents, fractionsAreByAreaAndMirroredUvRequireNegativeW)
{
    for (bool mirrored : {false, true}) {
        const StoredTangents right = storedWith([](glm::vec4&) {}, mirrored);
        EXPECT_TRUE(right.present);
        EXPECT_EQ(right.reversedW, 0) << mirrored;
        EXPECT_NEAR(right.angle.maximum, 0, kFloats) << mirrored;
        const StoredTangents reversed = storedWith([](glm::vec4& t) { t.w = -t.w; }, mirrored);
        EXPECT_NEAR(reversed.reversedW, 0.25, kFloats) << mirrored;
        EXPECT_EQ(reversed.rotated, 0);
    }
}

TEST(StoredTangents, mirroringNodeFlipsWAndUv)
{
    Mesh mesh = meshOf(rectangle({0, 0}, {1, 1}, {0, 0}, {1, 1}));
    mesh.tangents.assign(mesh.vertexCount(), glm::vec4(1, 0, 0, 1));
    for (const glm::dvec3 scale : {glm::dvec3(-1, 1, 1), {1, -2, 1}, {1, 1, -1}, {-3, -1, -1}}) {
        const MappedSurface s = makeSurface(mesh, Texture{}, {{scale.x, 0, 0}, {0, scale.y, 0}, {0, 0, scale.z}});
        const StoredTangents stored = lint::storedTangents(s);
        EXPECT_EQ(stored.reversedW, 0) << scale.x << " " << scale.y << " " << scale.z;
        EXPECT_NEAR(stored.angle.maximum, 0, kFloats);
        EXPECT_NEAR(lint::uvQuality(s).mirrored, 1, kFloats);
    }
}

TEST(StoredTangents, rotatedMeansByOver45Degrees)
{
    for (const auto& [degrees, share] : {std::pair(44.0, 0.0), {46.0, 0.25}, {-46.0, 0.25}, {180.0, 0.25}}) {
        const auto turn = [d = degrees](glm::vec4& t) {
            t = {float(std::cos(glm::radians(d))), float(std::sin(glm::radians(d))), 0, t.w};
        };
        const StoredTangents s = storedWith(turn);
        EXPECT_NEAR(s.rotated, share, kFloats) << degrees;
        EXPECT_NEAR(s.angle.mean, std::abs(degrees) / 4, 1e-4);
        EXPECT_NEAR(s.angle.maximum, std::abs(degrees), 1e-4);
    }
    EXPECT_NEAR(storedWith([](glm::vec4& t) { t = {0, 0, 0, 1}; }).rotated, 0.25, kFloats); // no direction at all
    // The component along the normal does not count.
    EXPECT_NEAR(storedWith([](glm::vec4& t) { t = {0.5f, 0, 0.8f, 1}; }).angle.maximum, 0, kFloats);
}

TEST(StoredTangents, uvWithoutAreaAreNotCompared)
{
    Mesh mesh = meshOf(rectangle({0, 0}, {1, 1}, {0.5f, 0.5f}, {0.5f, 0.5f}));
    mesh.tangents.assign(mesh.vertexCount(), glm::vec4(1, 0, 0, 1));
    const StoredTangents s = lint::storedTangents(makeSurface(mesh, Texture{}));
    EXPECT_TRUE(s.present);
    EXPECT_EQ(s.angle.count, 0u);
    EXPECT_TRUE(std::isnan(s.reversedW) && std::isnan(s.rotated));
}

// ---- readings -------------------------------------------------------------------------------

TEST(Readings, tallPatchHalvesTheSlopeAlongVOnly)
{
    const glm::dvec3 m(0.4, 0.3, 1);
    Material material;
    material.normalMap.image = 0;
    material.normalFormat = {.expansion = Expansion::signedValues, .greenUp = false};
    const Image map = floatMap(4, 4, [&](int, int) { return m; });
    const auto readBy = [&] {
        return lint::readings(tall(2), pointsOver(tall(2), kPointsOfSurface), Frame::mikktspace, material, map);
    };
    const auto read = readBy();
    ASSERT_EQ(read.size(), 6u);
    EXPECT_EQ(read[5].name, "area-weighted"); // equal to mikktspace on one rectangle
    EXPECT_NEAR(read[5].error.maximum, 0, 1e-4);
    EXPECT_EQ(read[0].name, "cotangent");
    EXPECT_NEAR(read[0].error.mean, angleBetween(m, {0.4, 0.15, 1}), 1e-4);
    EXPECT_EQ(read[4].name, "triangle");
    EXPECT_NEAR(read[4].error.mean, angleBetween(m, {0.4, 0.15, 1}), 1e-4);
    EXPECT_EQ(read[1].name, "orthonormal");
    EXPECT_NEAR(read[1].error.maximum, 0, 1e-4);
    EXPECT_EQ(read[1].error.count, 4096u);
    material.normalScale = 2; // scales the slopes that are read
    EXPECT_NEAR(readBy()[0].error.mean, angleBetween({0.8, 0.6, 1}, {0.8, 0.3, 1}), 1e-4);
}

TEST(Readings, storedTangentsAreComparedWithGeneratedOnes)
{
    Mesh mesh = meshOf(rectangle({0, 0}, {1, 1}, {0, 0}, {1, 1}));
    mesh.tangents.assign(mesh.vertexCount(), glm::vec4(1, 0, 0, -1)); // green reversed
    Material material;
    material.normalFormat = {.expansion = Expansion::signedValues, .greenUp = false};
    const MappedSurface surface = makeSurface(mesh, Texture{});
    const auto read = lint::readings(surface, pointsOver(surface, kPointsOfSurface), Frame::mikktspace, material,
                                     floatMap(2, 2, [](int, int) { return glm::dvec3(0.4, 0.3, 1); }));
    ASSERT_EQ(read.size(), 7u);
    EXPECT_EQ(read[6].name, "stored");
    EXPECT_NEAR(read[6].error.mean, angleBetween({0.4, 0.3, 1}, {0.4, -0.3, 1}), 1e-4);
}

// ---- overlap --------------------------------------------------------------------------------

// A bent grid of 2 * 40 * 40 triangles: 4,720 edges. The steps of every tenth edge estimate those of all.
TEST(EdgeSteps, manyEdgesAreSampledEvenly)
{
    const int n = 40;
    const auto at = [](int i) { return float(i * i) / 1600; };
    std::vector<Corner> corners;
    for (int x = 0; x < n; ++x)
        for (int y = 0; y < n; ++y) // v runs down
            corners = corners + rectangle({float(x), float(y)}, {1, 1}, {at(x), at(n - y - 1)}, {at(x + 1), at(n - y)});
    const MappedSurface s = surfaceOf(corners);
    const EdgeSteps all = lint::edgeSteps(s), some = lint::edgeSteps(s, 480);
    EXPECT_EQ(all.edges, 4720u);
    EXPECT_EQ(some.edges, all.edges);
    EXPECT_EQ(all.cotangent.count, 8 * all.edges);
    EXPECT_EQ(some.cotangent.count, 8 * all.edges / 10);
    EXPECT_GT(all.cotangent.mean, 0.01);
    EXPECT_NEAR(some.cotangent.mean / all.cotangent.mean, 1, 0.2); // 472 values, deviation near their mean
}

// Overlap of surfaces at 64 texels a side, exact for uv in 64ths.
std::vector<UvQuality> overlapsOf(const std::vector<MappedSurface>& surfaces, int side = 64)
{
    std::vector<UvQuality> qualities(surfaces.size());
    std::vector<const MappedSurface*> in;
    std::vector<UvQuality*> out;
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        qualities[i] = lint::uvQuality(surfaces[i]);
        in.push_back(&surfaces[i]);
        out.push_back(&qualities[i]);
    }
    lint::countOverlaps(in, out, side);
    return qualities;
}

TEST(Overlap, isTheFractionOfAreaOnSharedTexels)
{
    // A covers v from 0 to 1, B from 3/4 to 5/4, whose lower half wraps to the top: all of B and half of A overlap.
    const MappedSurface a = surfaceOf(rectangle({0, 0}, {1, 1}, {0, 0}, {1, 1})),
                        b = surfaceOf(rectangle({5, 0}, {1, 1}, {0, 0.75f}, {1, 1.25f})),
                        c = surfaceOf(rectangle({9, 0}, {1, 1}, {0, 0}, {1, 0.25f})), // A's uppermost quarter
        flipped = surfaceOf(rectangle({9, 0}, {1, 1}, {1, 0}, {0, 0.25f}));
    const auto ab = overlapsOf({a, b}), ac = overlapsOf({a, c}), at = overlapsOf({a, flipped}), alone = overlapsOf({a});
    EXPECT_NEAR(ab[0].overlapping, 0.5, kFloats);
    EXPECT_NEAR(ab[1].overlapping, 1, kFloats);
    EXPECT_EQ(ab[0].overlappingMirrored, 0);
    // A's two triangles have 2016 and 2080 texels: a quarter to 0.3 %.
    EXPECT_NEAR(ac[0].overlapping, 0.25, 0.005);
    EXPECT_NEAR(ac[1].overlapping, 1, kFloats);
    EXPECT_NEAR(at[0].overlapping, 0.25, 0.005);
    EXPECT_NEAR(at[0].overlappingMirrored, 0.25, 0.005);
    EXPECT_NEAR(at[1].overlappingMirrored, 1, kFloats);
    EXPECT_EQ(alone[0].overlapping, 0);
}

TEST(Overlap, isWeightedByAreaOnTheSurface)
{
    // Two rectangles of one surface on the same quarter of the map, of areas 1 and 7, and a third of area 8 elsewhere.
    const auto corners = rectangle({0, 0}, {1, 1}, {0, 0}, {0.5f, 0.5f})
        + rectangle({2, 0}, {1, 7}, {0, 0}, {0.5f, 0.5f}) + rectangle({4, 0}, {1, 8}, {0.5f, 0}, {1, 1});
    EXPECT_NEAR(overlapsOf({surfaceOf(corners)})[0].overlapping, 0.5, kFloats);
}

TEST(Overlap, repeatedUvCountAsOverlapping)
{
    const auto often = [](float copies) {
        return overlapsOf({surfaceOf(rectangle({0, 0}, {1, 1}, {0, 0}, {copies, copies}))}, 2)[0].overlapping;
    };
    EXPECT_EQ(often(1), 0);
    EXPECT_NEAR(often(2), 1, 1e-9); // repeated: each texel four times
    EXPECT_NEAR(often(3000), 1, 1e-9);
    EXPECT_EQ(often(1e7f), 0); // out of range: not drawn at all
}

// Strips too thin to cover a texel. Each has two triangles over 64 by 64 copies of the image, with 17 rows per copy on
// the coarsest raster. If that exceeds ten million rows, everything counts as overlapping, otherwise nothing.
TEST(Overlap, overTenMillionRowsCountAsOverlapping)
{
    for (const auto& [strips, share] : {std::pair(2, 0.0), {72, 1.0}}) {
        std::vector<Corner> corners;
        for (int i = 0; i < strips; ++i) {
            auto strip = rectangle({0, 0}, {1, 1}, {0, 0}, {1, 1});
            for (Corner& c : strip) // along the diagonal, past the centres of its texels
                c.uv = glm::vec2(64 * c.uv.x) + glm::vec2(0, 0.0006f + 1e-4f * c.uv.y);
            corners = corners + strip;
        }
        const UvQuality q = overlapsOf({surfaceOf(corners)}, 32)[0];
        EXPECT_EQ(q.overlapping, share) << strips;
        EXPECT_EQ(q.overlappingMirrored, 0);
    }
}

TEST(Overlap, manyStackedTrianglesUseACoarserRaster)
{
    // At 512 rows these are 10 times the limit.
    Mesh mesh = *surfaceOf(rectangle({0, 0}, {1, 1}, {0, 0}, {1, 1})).shared->mesh;
    const std::vector<std::uint32_t> once = mesh.indices;
    for (int i = 0; i < 100'000; ++i)
        mesh.indices.insert(mesh.indices.end(), once.begin(), once.end());
    const MappedSurface surface = makeSurface(mesh, Texture{}, glm::dmat3(1), {});
    EXPECT_GT(rowsUnder(surface, 512), 1e8);
    EXPECT_NEAR(overlapsOf({surface}, 512)[0].overlapping, 1, 1e-9);
}

} // namespace
} // namespace cotan
