// Several maps of one trace: each equals the map alone, and each kind is compared with surfaces that are known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "bake/bake_surfaces.hpp"
#include "bake_scene.hpp"
#include "cotan/bake.hpp"

namespace cotan {
namespace {

constexpr BakeKind kAll[] = {BakeKind::normal,    BakeKind::objectNormal, BakeKind::height,
                             BakeKind::occlusion, BakeKind::bentNormal,   BakeKind::objectBentNormal,
                             BakeKind::thickness, BakeKind::curvature,    BakeKind::position,
                             BakeKind::baseColor, BakeKind::roughness,    BakeKind::metallic,
                             BakeKind::id,        BakeKind::emissive,     BakeKind::roughnessMetallic};

BakeModelOptions optionsFor(std::vector<BakeKind> kinds, PixelType type = PixelType::float32)
{
    BakeModelOptions options;
    options.bake.samples = 1; // a texel has the value at its centre
    options.kinds = std::move(kinds);
    options.bake.frame = Frame::smooth;
    options.bake.width = options.bake.height = 16;
    options.bake.threads = 2;
    options.stored.type = type;
    return options;
}

Result<BakedModel> bakeScene(const Scene& low, const Scene& high, const BakeModelOptions& options)
{
    HighModel model;
    model.scenes.push_back(high);
    return bakeModel(low, std::move(model), options);
}

// The values of a map of floats in a scalar kind, of texels that are covered in the middle of the map.
std::vector<float> scalars(const BakedMap& map, int border = 2)
{
    std::vector<float> values;
    for (int y = border; y < map.image.height - border; ++y)
        for (int x = border; x < map.image.width - border; ++x)
            values.push_back(map.image.floats()[4 * (y * map.image.width + x)]);
    return values;
}

BakedMap oneMap(const Scene& low, const Scene& high, BakeKind kind, BakeModelOptions options)
{
    options.kinds = {kind};
    auto baked = bakeScene(low, high, options);
    EXPECT_TRUE(baked) << (baked ? "" : baked.error().message);
    return std::move(baked->maps.front());
}

bool isEqual(const Image& a, const Image& b) { return a.type == b.type && a.data == b.data && a.frame == b.frame; }

TEST(BakeMaps, everyMapOfOneTraceIsTheMapAlone)
{
    // Two objects that share a map: a torus over the left half, a ball over the right one.
    Mesh torus = makeTorus(1, 0.4f, 24, 1, 1), ball = makeSphere(0.7f, 16);
    for (glm::vec2& uv : torus.texcoords[0])
        uv.x *= 0.5f;
    for (glm::vec2& uv : ball.texcoords[0])
        uv.x = 0.5f + 0.5f * uv.x;
    Scene high = sceneOfMeshes({torus, ball});
    Material& gold = high.materials.emplace_back();
    gold.name = "gold";
    gold.baseColor = {0.9f, 0.6f, 0, 1};
    gold.roughness = 0.3f;
    gold.emissive = {0, 0.1f, 2};
    high.meshes[1].material = 1;
    for (const auto& [type, samples] : {std::pair(PixelType::unorm8, 2), {PixelType::float32, 1}}) {
        BakeModelOptions options = optionsFor({std::begin(kAll), std::end(kAll)}, type);
        options.bake.samples = samples;
        options.bake.occlusionRays = 9;
        options.tiles = {1001};
        const auto together = bakeScene(high, high, options);
        ASSERT_TRUE(together) << together.error().message;
        ASSERT_EQ(together->maps.size(), std::size(kAll));
        for (std::size_t i = 0; i < std::size(kAll); ++i) {
            EXPECT_EQ(together->maps[i].kind, kAll[i]);
            EXPECT_TRUE(isEqual(together->maps[i].image, oneMap(high, high, kAll[i], options).image))
                << "map " << i << ", " << samples << " samples";
        }
    }
}

TEST(BakeMaps, mapsAreStoredWhileTheyAreBakedAsTheyWouldBeAfterwards)
{
    Mesh low = makeTorus(1, 0.4f, 24, 1, 1);
    for (glm::vec2& uv : low.texcoords[0])
        uv.x *= 0.6f; // the rest of the map is padding
    Scene high = sceneOfMeshes({low});
    high.meshes[0].indices.resize(high.meshes[0].indices.size() / 4 * 3); // rays miss elsewhere
    high.materials[0].baseColor = {0.9f, 0.6f, 0, 1};
    high.materials[0].roughness = 0.3f;
    high.materials[0].emissive = {0, 0.1f, 2};
    for (const auto& [type, samples, padding] :
         {std::tuple(PixelType::unorm8, 2, 0), {PixelType::unorm16, 1, 3}, {PixelType::float32, 2, -1}}) {
        BakeModelOptions options = optionsFor({std::begin(kAll), std::end(kAll)}, type);
        options.bake.samples = samples;
        options.bake.occlusionRays = 9;
        options.padding = padding;
        options.packed = {{"both", {BakeKind::height, BakeKind::roughness, {}, {}}, {}}};
        HighModel model;
        model.scenes.push_back(high);
        const auto setup = prepareBake(sceneOfMeshes({low}), std::move(model), options);
        ASSERT_TRUE(setup) << setup.error().message;
        const auto stored = bakeTile(*setup, 1001);
        auto baked = bakeMaps(setup->low, setup->high, setup->options.bake, options.kinds);
        ASSERT_TRUE(stored && baked);
        EXPECT_GT(baked->front().statistics.missed, 5u);
        if (padding >= 0)
            padCharts(*baked, padding);
        for (std::size_t i = 0; i < std::size(kAll); ++i)
            EXPECT_TRUE(stored->at(i).image.data == storeBaked(baked->at(i), kAll[i], setup->options.stored).data)
                << "map " << i << ", " << samples << " samples";
        EXPECT_TRUE(stored->back().image.data
                    == packMaps(*baked, options.kinds, options.packed[0], setup->options.stored).data);
    }
}

TEST(BakeMaps, raysThatFindTheSurfaceAreTracedOnceForAllMaps)
{
    const Scene scene = sceneOfMeshes({makeTorus(1, 0.4f, 32, 1, 1)});
    const BakeModelOptions options = optionsFor({});
    const std::size_t alone = oneMap(scene, scene, BakeKind::normal, options).statistics.rays;
    const auto several = bakeScene(scene, scene,
                                   optionsFor({BakeKind::normal, BakeKind::height, BakeKind::curvature,
                                               BakeKind::position, BakeKind::objectNormal}));
    ASSERT_TRUE(several);
    EXPECT_EQ(several->maps.back().statistics.rays, alone);
    // Occlusion and both bent normals share theirs: 64 a texel, as occlusion alone.
    const std::size_t occlusion = oneMap(scene, scene, BakeKind::occlusion, options).statistics.rays;
    const auto around =
        bakeScene(scene, scene, optionsFor({BakeKind::occlusion, BakeKind::bentNormal, BakeKind::objectBentNormal}));
    ASSERT_TRUE(around);
    EXPECT_EQ(around->maps.front().statistics.rays, occlusion);
    EXPECT_GT(occlusion, alone + 16 * 16 * 64 - 1);
}

TEST(BakeMaps, theSamplesOfATexelShareItsRaysForOcclusion)
{
    // The torus covers all 16 x 16 texels, and each sample hits it.
    const Scene scene = sceneOfMeshes({makeTorus(1, 0.4f, 32, 1, 1)});
    for (const auto& [rays, samples, each] : {std::tuple(64, 1, 64), {64, 2, 64}, {65, 2, 65}, {64, 4, 64}, {9, 4, 16}})
        for (const BakeKind kind : {BakeKind::occlusion, BakeKind::thickness}) {
            BakeModelOptions options = optionsFor({});
            options.bake.samples = samples;
            options.bake.occlusionRays = rays;
            const std::size_t alone = oneMap(scene, scene, BakeKind::normal, options).statistics.rays;
            EXPECT_EQ(oneMap(scene, scene, kind, options).statistics.rays - alone, std::size_t(16 * 16 * each))
                << rays << " rays, " << samples << " samples per axis";
        }
}

TEST(BakeMaps, curvatureOfABallIsOneOverItsRadiusAndThatOfAHollowIsNegative)
{
    for (const float radius : {0.5f, 3.0f}) {
        const Scene ball = sceneOfMeshes({makeSphere(radius, 64)});
        // The fit of 64 segments is within their angle squared over 4, 0.0024; poles are left out.
        for (const float k : scalars(oneMap(ball, ball, BakeKind::curvature, optionsFor({}))))
            EXPECT_NEAR(k * radius, 1, 3e-3);
        Mesh inside = makeSphere(radius, 64);
        for (glm::vec3& n : inside.normals)
            n = -n;
        for (std::size_t i = 0; i < inside.indices.size(); i += 3)
            std::swap(inside.indices[i], inside.indices[i + 1]);
        const Scene hollow = sceneOfMeshes({inside});
        for (const float k : scalars(oneMap(hollow, hollow, BakeKind::curvature, optionsFor({}))))
            EXPECT_NEAR(k * radius, -1, 3e-3);
    }
}

TEST(BakeMaps, curvatureOfATorusHasBothItsRadii)
{
    // H = (1 / r + cos a / (R + r cos a)) / 2 at the angle a around the tube.
    const double major = 1, minor = 0.4;
    const Scene torus = sceneOfMeshes({makeTorus(float(major), float(minor), 96, 1, 1)});
    BakeModelOptions options = optionsFor({BakeKind::curvature, BakeKind::position});
    options.bake.width = options.bake.height = 32;
    const auto baked = bakeScene(torus, torus, options);
    ASSERT_TRUE(baked);
    double lowest = 1e9, highest = -1e9;
    for (int i = 0; i < 32 * 32; ++i) {
        const float* p = baked->maps[1].image.floats() + 4 * i;
        const double fromAxis = std::hypot(p[0], p[2]), cosine = std::clamp((fromAxis - major) / minor, -1.0, 1.0);
        const double truth = (1 / minor + cosine / (major + minor * cosine)) / 2;
        EXPECT_NEAR(double(baked->maps[0].image.floats()[4 * i]), truth, 0.01 * truth) << i;
        lowest = std::min(lowest, truth);
        highest = std::max(highest, truth);
    }
    EXPECT_GT(highest, 1.7 * lowest); // both sides of the tube were seen
}

TEST(BakeMaps, integersStoreFlatAsAHalfAndABallOfTheRadiusAsOne)
{
    const Scene ball = sceneOfMeshes({makeSphere(2, 64)}),
                flat = sceneOfMeshes({rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0})});
    BakeModelOptions options = optionsFor({}, PixelType::unorm16);
    for (const auto& [radius, stored] : {std::pair(2.0f, 1.0), {1.0f, 0.75}, {8.0f, 1.0}}) {
        options.bake.curvatureRadius = radius;
        const BakedMap map = oneMap(ball, ball, BakeKind::curvature, options);
        EXPECT_EQ(map.unit, radius);
        EXPECT_NEAR(map.image.words()[4 * (8 * 16 + 8)] / 65535.0, stored, 1e-3);
        EXPECT_NEAR(oneMap(flat, flat, BakeKind::curvature, options).image.words()[4 * (8 * 16 + 8)] / 65535.0, 0.5,
                    1e-4);
    }
    options.bake.curvatureRadius = 0;
    EXPECT_NEAR(oneMap(ball, ball, BakeKind::curvature, options).unit, 0.01 * std::sqrt(3.0) * 4,
                1e-3); // 1 % of the diagonal
}

TEST(BakeMaps, thicknessOfABallAndOfASlabIsTheMeanLengthOfTheirChords)
{
    BakeModelOptions options = optionsFor({});
    options.bake.occlusionRays = 256;
    options.bake.thicknessDistance = 100;
    // Cosine-weighted chords 2 r c of a ball: 2 r * integral of 2 c^2 = 4 r / 3. 256 rays are within 0.3 % of it.
    const float radius = 1.5f;
    const Scene ball = sceneOfMeshes({makeSphere(radius, 96)});
    for (const float t : scalars(oneMap(ball, ball, BakeKind::thickness, options)))
        EXPECT_NEAR(t, 4 * radius / 3, 0.01 * radius);
    // Chords d / c of a slab, no longer than L: integral of min(d / c, L) 2 c = 2 d - d^2 / L.
    const double thick = 0.2, longest = 1;
    options.bake.thicknessDistance = float(longest);
    const Mesh front = rectangle({-50, -50, 0}, {100, 0, 0}, {0, 100, 0});
    const Mesh back = rectangle({-50, -50, float(-thick)}, {0, 100, 0}, {100, 0, 0});
    const Scene slab = sceneOfMeshes({front, back}),
                low = sceneOfMeshes({rectangle({-1, -1, 0}, {2, 0, 0}, {0, 2, 0})});
    for (const float t : scalars(oneMap(low, slab, BakeKind::thickness, options), 0))
        EXPECT_NEAR(t, 2 * thick - thick * thick / longest, 0.01);
}

TEST(BakeMaps, bentNormalsAtTheFootOfAWallLeanAwayFromIt)
{
    // An endless wall at x = 0 hides half of the floor's hemisphere. The mean of the open half, cosine weighted, is
    // proportional to (2/3, pi/3): 32.48 degrees from the floor's normal; half is open.
    const Mesh floor = rectangle({-900, -900, 0}, {1800, 0, 0}, {0, 1800, 0});
    const Mesh wall = rectangle({0, -900, 0}, {0, 1800, 0}, {0, 0, 900});
    const Scene high = sceneOfMeshes({floor, wall});
    const Scene low = sceneOfMeshes({rectangle({0.01f, -0.01f, 0}, {0.01f, 0, 0}, {0, 0.01f, 0})});
    BakeModelOptions options = optionsFor({BakeKind::objectBentNormal, BakeKind::bentNormal, BakeKind::occlusion});
    options.bake.occlusionRays = 1024;
    options.bake.maxDistance = 0.001f;
    options.stored.format.expansion = Expansion::signedValues;
    const auto baked = bakeScene(low, high, options);
    ASSERT_TRUE(baked) << baked.error().message;
    const double angle = std::atan2(2.0 / 3, std::numbers::pi / 3);
    for (int i = 0; i < 16 * 16; ++i) {
        const float *world = baked->maps[0].image.floats() + 4 * i, *inFrame = baked->maps[1].image.floats() + 4 * i;
        // Rays of a spiral: the mean of 1024 is within 0.02.
        EXPECT_NEAR(world[0], std::sin(angle), 0.02);
        EXPECT_NEAR(world[1], 0, 0.02);
        EXPECT_NEAR(world[2], std::cos(angle), 0.02);
        for (int c = 0; c < 3; ++c) // the frame of the low square is that of the world
            EXPECT_NEAR(inFrame[c], world[c], 1e-4) << c;
        EXPECT_NEAR(baked->maps[2].image.floats()[4 * i], 0.5, 0.02);
    }
    EXPECT_EQ(baked->maps[1].image.frame, "smooth");
    EXPECT_EQ(baked->maps[0].format.kind, MapKind::objectSpace);
}

TEST(BakeMaps, directionsAreUnitHoweverManySamplesATexelHas)
{
    const Scene ball = sceneOfMeshes({makeSphere(1, 8)}); // its bent normals differ within a texel
    const auto low = makeLowSurface(ball, -1, Frame::smooth, TangentOrigin::stored);
    const auto high = HighSurface::make({ball}, 1);
    ASSERT_TRUE(low && high);
    BakeOptions options = optionsFor({}).bake;
    options.width = options.height = 4;
    options.samples = 4;
    options.occlusionRays = 4;
    const auto maps =
        bakeMaps(*low, *high, options, {BakeKind::objectBentNormal, BakeKind::bentNormal, BakeKind::objectNormal});
    ASSERT_TRUE(maps) << maps.error().message;
    for (const Baked& map : *maps)
        for (const glm::vec3& v : map.values)
            EXPECT_NEAR(glm::length(v), 1, 1e-5);
}

TEST(BakeMaps, eachMapIsPaddedFromTexelsThatHaveAValueInIt)
{
    // Three texels in a row are covered. The second map has no value in the middle one, as where directions cancel out.
    Baked first{3, 1, std::vector(3, glm::vec3(1, 0, 1)), std::vector<std::uint8_t>(3, texelCovered), {}};
    Baked second = first;
    second.values = {glm::vec3(0, 0, 1), glm::vec3(0), glm::vec3(1, 0, 0)};
    std::vector<Baked> maps{first, second, first};
    padCharts(maps, 0);
    EXPECT_EQ(maps[0].values, first.values);
    EXPECT_EQ(maps[1].values[1], glm::vec3(0, 0, 1)); // of equally near ones the left
    EXPECT_EQ(maps[2].values, first.values);
    maps = {second, first}; // also if it is the first
    padCharts(maps, 0);
    EXPECT_EQ(maps[0].values[1], glm::vec3(0, 0, 1));
    EXPECT_EQ(maps[1].values, first.values);
}

TEST(BakeMaps, positionsAreThoseOfTheHighSurfaceAndInIntegersFractionsOfItsBox)
{
    // The high square is tilted: z = 1 + x / 4 above the low one at z = 1, which lies within it.
    const Scene high = sceneOfMeshes({rectangle({-1, -2, 0.75f}, {4, 0, 1}, {0, 4, 0})});
    const Scene low = sceneOfMeshes({rectangle({0, 0, 1}, {1, 0, 0}, {0, 1, 0})});
    BakeModelOptions options = optionsFor({});
    options.bake.maxDistance = 2;
    const BakedMap floats = oneMap(low, high, BakeKind::position, options);
    options.stored.type = PixelType::unorm16;
    const BakedMap words = oneMap(low, high, BakeKind::position, options);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            const glm::vec3 at((float(x) + 0.5f) / 16, 1 - (float(y) + 0.5f) / 16, 0);
            const glm::vec3 truth(at.x, at.y, 1 + at.x / 4);
            const int i = 4 * (16 * y + x);
            for (int c = 0; c < 3; ++c) {
                EXPECT_NEAR(floats.image.floats()[i + c], truth[c], 1e-5) << x << " " << y << " " << c;
                const float fraction = (truth[c] - words.box.low[c]) / (words.box.high[c] - words.box.low[c]);
                EXPECT_NEAR(words.image.words()[i + c] / 65535.0f, fraction, 2e-5);
            }
        }
    EXPECT_EQ(words.box.low, glm::vec3(-1, -2, 0.75f));
    EXPECT_EQ(words.box.high, glm::vec3(3, 2, 1.75f));
}

TEST(BakeMaps, anOpenHighSurfaceServesCurvatureOnlyIfItWasOpenedForIt)
{
    const Scene ball = sceneOfMeshes({makeSphere(1, 16)});
    const auto open = [&](std::vector<BakeKind> kinds) {
        HighModel model;
        model.scenes.push_back(ball);
        return openDetailed(std::move(model), optionsFor(std::move(kinds)));
    };
    const auto without = open({BakeKind::normal}), with = open({BakeKind::normal, BakeKind::curvature});
    ASSERT_TRUE(without && with);
    EXPECT_TRUE(bakeModel(ball, *with, optionsFor({BakeKind::curvature})));
    const auto refused = bakeModel(ball, *without, optionsFor({BakeKind::curvature}));
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().message, "options.kinds: the high surface was opened without curvature among the kinds");
    EXPECT_EQ(refused.error().kind, ErrorKind::usage);
}

TEST(BakeMaps, distancesOutOfRangeAreRefused)
{
    const Scene ball = sceneOfMeshes({makeSphere(1, 16)});
    for (const float bad : {-1.0f, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
        BakeModelOptions options = optionsFor({BakeKind::thickness});
        options.bake.thicknessDistance = bad;
        EXPECT_FALSE(bakeScene(ball, ball, options)) << bad;
        options = optionsFor({BakeKind::curvature});
        options.bake.curvatureRadius = bad;
        EXPECT_FALSE(bakeScene(ball, ball, options)) << bad;
    }
}

// The tiles of a triangle with these corners, v upwards.
std::vector<int> tilesOfTriangle(const std::vector<glm::vec2>& corners, std::size_t* outside = nullptr)
{
    LowSurface low;
    for (const glm::vec2 c : corners)
        low.texcoords.emplace_back(c.x, 1 - c.y);
    low.indices = {0, 1, 2};
    return tilesOf(low, outside);
}

TEST(UdimTiles, areThoseThatATriangleOverlaps)
{
    using Tiles = std::vector<int>;
    EXPECT_EQ(tilesOfTriangle({{0, 0}, {1, 0}, {0, 1}}), Tiles({1001})); // touches 1002 and 1011 at corners
    EXPECT_EQ(tilesOfTriangle({{1, 1}, {2, 1}, {1, 2}}), Tiles({1012}));
    EXPECT_EQ(tilesOfTriangle({{9.2f, 0.1f}, {9.8f, 0.1f}, {9.2f, 0.8f}}), Tiles({1010}));
    EXPECT_EQ(tilesOfTriangle({{0.5f, 0.5f}, {1.5f, 0.5f}, {0.5f, 0.9f}}), Tiles({1001, 1002}));
    // A sliver along the diagonal is nearer than a ten-thousandth to the tiles beside it.
    EXPECT_EQ(tilesOfTriangle({{0.1f, 0.1f}, {2.9f, 2.9001f}, {2.9001f, 2.9f}}), Tiles({1001, 1012, 1023}));
    // Thinner than that: the tile of its middle.
    EXPECT_EQ(tilesOfTriangle({{3.5f, 0.1f}, {3.50001f, 0.1f}, {3.5f, 0.9f}}), Tiles({1004}));
    // No area, so that nothing is drawn.
    EXPECT_EQ(tilesOfTriangle({{0.2f, 0.2f}, {0.2f, 0.2f}, {0.2f, 0.2f}}), Tiles());
    EXPECT_EQ(tilesOfTriangle({{0.25f, 1.25f}, {0.5f, 1.5f}, {0.75f, 1.75f}}), Tiles());
    EXPECT_EQ(tilesOfTriangle({{0.25f, 0.25f}, {1e7f, 0.5f}, {0.75f, 1e7f}}), Tiles()); // too far to be drawn
}

TEST(UdimTiles, countTrianglesOutsideAndSurviveAnyCoordinates)
{
    using Corners = std::vector<glm::vec2>;
    for (const auto& [corners, away] : {std::pair<Corners, std::size_t>({{-1, 0}, {-0.5f, 0}, {-1, 1}}, 1),
                                        {{{10.1f, 0}, {10.5f, 0}, {10.1f, 1}}, 1},
                                        {{{0.1f, -3}, {0.2f, -3}, {0.1f, -2}}, 1},
                                        {{{0, 0}, {1, 0}, {0, 1}}, 0}}) {
        std::size_t outside = 7;
        tilesOfTriangle(corners, &outside);
        EXPECT_EQ(outside, away);
    }
    constexpr float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    for (const float bad : {nan, 3e38f, -3e38f, inf, -inf})
        for (const int tile : tilesOfTriangle({{0, 0}, {bad, 0}, {0, bad}}))
            EXPECT_TRUE(tile >= 1001 && tile <= 1999) << bad;
}

} // namespace
} // namespace cotan
