// bakeModel, the one call that bakes a model, as a program uses it.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "bake/bake_surfaces.hpp"
#include "bake_scene.hpp"
#include "cotan/bake.hpp"
#include "cotan/convention.hpp"

namespace cotan {
namespace {

// A square spanned by `along` and +y from `corner`; its uv fill the unit square of uv with its corner at `tile`.
Mesh square(glm::vec3 corner, glm::vec3 along, glm::vec2 tile = {0, 0})
{
    Mesh mesh = rectangle(corner, along, {0, 1, 0});
    for (glm::vec2& uv : mesh.texcoords[0])
        uv += tile;
    return mesh;
}

HighModel highOf(Scene scene)
{
    HighModel high;
    high.scenes.push_back(std::move(scene));
    return high;
}

BakeModelOptions smallOptions(Frame frame = Frame::cotangent)
{
    BakeModelOptions options;
    options.bake.frame = frame;
    options.bake.width = 12;
    options.bake.height = 8;
    options.bake.maxDistance = 0.5f;
    options.bake.threads = 1;
    return options;
}

// Red, green and blue of an 8-bit texel.
glm::ivec3 codes(const Image& image, int x, int y)
{
    const std::uint8_t* p = image.bytes8() + 4 * (y * image.width + x);
    return {p[0], p[1], p[2]};
}

// The 8-bit code of a component; 128 is zero.
int code(double component) { return int(std::lround(128 + 127 * component)); }

std::string errorOf(const Result<BakedModel>& baked) { return baked ? "no error" : baked.error().message; }

TEST(BakeModel, aFlatSquareOnItselfIsFlatForEveryFrameThatDoesNotDependOnTheView)
{
    const Scene flat = sceneOfMeshes({square({0, 0, 0}, {1, 0, 0})});
    int baked = 0;
    for (const FrameInfo& frame : frames()) {
        const auto model = bakeModel(flat, highOf(flat), smallOptions(frame.frame));
        if (dependsOnView(frame.frame)) {
            ASSERT_FALSE(model) << frame.name;
            EXPECT_EQ(model.error().kind, ErrorKind::usage);
            continue;
        }
        ASSERT_TRUE(model) << frame.name << ": " << model.error().message;
        ASSERT_EQ(model->maps.size(), 1u);
        const BakedMap& map = model->maps.front();
        EXPECT_EQ(map.statistics.covered, 12u * 8u);
        EXPECT_EQ(map.statistics.missed, 0u);
        for (int y = 0; y < 8; ++y)
            for (int x = 0; x < 12; ++x)
                EXPECT_EQ(codes(map.image, x, y), glm::ivec3(128, 128, 255)) << frame.name << " " << x << " " << y;
        ++baked;
    }
    EXPECT_EQ(baked, std::ranges::count_if(frames(), [](const FrameInfo& f) { return !f.dependsOnView; }));
}

TEST(BakeModel, aTiltedSquareGivesItsNormalInTheStatedFormat)
{
    // z grows by 0.3 along x and u runs along x: the normal is (-0.3, 0, 1), normalised.
    const glm::dvec3 n = glm::normalize(glm::dvec3(-0.3, 0, 1));
    const Scene low = sceneOfMeshes({square({0, 0, 0}, {1, 0, 0})});
    const Scene high = sceneOfMeshes({square({0, 0, 0}, {1, 0, 0.3f})});
    const auto model = bakeModel(low, highOf(high), smallOptions());
    ASSERT_TRUE(model);
    EXPECT_EQ(codes(model->maps[0].image, 5, 3), glm::ivec3(code(n.x), 128, code(n.z)));
    EXPECT_FALSE(greenAlongV(model->maps[0].format));
    EXPECT_TRUE(model->warnings.empty());

    BakeModelOptions object = smallOptions();
    object.bake.kind = BakeKind::objectNormal;
    object.stored.format.channels = Channels::orthographic; // world axes need all three channels
    const auto world = bakeModel(low, highOf(high), object);
    ASSERT_TRUE(world);
    EXPECT_EQ(world->maps[0].format.channels, Channels::xyz);
    EXPECT_EQ(codes(world->maps[0].image, 5, 3), glm::ivec3(code(n.x), 128, code(n.z)));
}

TEST(BakeModel, aMeshWithoutUvIsRefusedWithOneLine)
{
    Scene low = sceneOfMeshes({square({0, 0, 0}, {1, 0, 0})});
    low.meshes[0].name = "lid";
    low.meshes[0].texcoords[0].clear();
    const auto model = bakeModel(low, highOf(low), smallOptions());
    ASSERT_FALSE(model);
    EXPECT_EQ(model.error().kind, ErrorKind::input);
    EXPECT_EQ(model.error().message, "scene: mesh 'lid' has no texture coordinates (uv set 0)");
}

TEST(BakeModel, everyTileIsAMapAndProgressRunsToOne)
{
    // Tile 1002 is to the right. Tile 1011 is above; v is negative there because v points down here.
    const Scene low = sceneOfMeshes({square({0, 0, 0}, {1, 0, 0}, {1, 0}), square({0, 2, 0}, {1, 0, 0}, {0, -1})});
    const Scene high = sceneOfMeshes({square({0, 0, 0}, {1, 0, 0.3f}), square({0, 2, 0}, {1, 0, -0.3f})});
    BakeModelOptions options = smallOptions();
    options.tiles = {1002, 1011};
    options.mask = true;
    std::vector<double> fractions;
    const auto model = bakeModel(low, highOf(high), options, [&](double fraction) {
        fractions.push_back(fraction);
        return true;
    });
    ASSERT_TRUE(model) << model.error().message;
    ASSERT_EQ(model->maps.size(), 2u);
    EXPECT_EQ(model->maps[0].tile, 1002);
    EXPECT_EQ(model->maps[1].tile, 1011);
    EXPECT_LT(codes(model->maps[0].image, 5, 3).x, 100);
    EXPECT_GT(codes(model->maps[1].image, 5, 3).x, 150);
    EXPECT_EQ(model->maps[0].mask.width, 12);
    EXPECT_EQ(fractions.size(), 2u * 8u); // rows
    EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
    EXPECT_GT(fractions.front(), 0);
    EXPECT_EQ(fractions.back(), 1);

    options.tiles = {1005};
    const auto empty = bakeModel(low, highOf(high), options);
    ASSERT_FALSE(empty);
    EXPECT_EQ(empty.error().kind, ErrorKind::input);
    EXPECT_EQ(errorOf(empty), "options.tiles: no triangle lies on tile 1005 of the texture coordinates");
}

TEST(BakeModel, endsWithAnErrorIfItsProgressCallbackStopsIt)
{
    const Scene low = sceneOfMeshes({square({0, 0, 0}, {1, 0, 0}), square({2, 0, 0}, {1, 0, 0}, {1, 0})});
    BakeModelOptions options = smallOptions();
    options.tiles = {1001, 1002};
    for (const double limit : {0.0, 0.3, 0.6, 0.99}) { // stops in the first tile, in the second, at the last row
        std::atomic<int> after = 0;
        const auto baked = bakeModel(low, highOf(low), options, [&](double fraction) {
            after += fraction > limit;
            return fraction <= limit;
        });
        ASSERT_FALSE(baked) << limit;
        EXPECT_EQ(baked.error().kind, ErrorKind::stopped) << baked.error().message;
        EXPECT_EQ(baked.error().message.find('\n'), std::string::npos);
        EXPECT_LE(after, 8) << "rows of one block at most go on";
    }
}

TEST(BakeModel, aCageReachesWhatTheDistanceDoesNot)
{
    const Scene low = sceneOfMeshes({square({0, 0, 0}, {1, 0, 0})}),
                cage = sceneOfMeshes({square({0, 0, 2}, {1, 0, 0})});
    const Scene high = sceneOfMeshes({square({0, 0, 1}, {1, 0, 0.3f})});
    BakeModelOptions options = smallOptions();
    const auto without = bakeModel(low, highOf(high), options);
    options.cage = &cage;
    const auto with = bakeModel(low, highOf(high), options);
    ASSERT_TRUE(without && with);
    EXPECT_EQ(without->maps[0].statistics.missed, 12u * 8u);
    EXPECT_EQ(with->maps[0].statistics.missed, 0u);
}

TEST(BakeModel, meshesAreMatchedByName)
{
    // Both high squares are in front of the low one; the outer is not its partner.
    Scene low = sceneOfMeshes({square({0, 0, 0}, {1, 0, 0})});
    Scene high = sceneOfMeshes({square({0, 0, 0.1f}, {1, 0, 0.3f}), square({0, 0, 0.06f}, {1, 0, -0.05f})});
    low.meshes[0].name = "Door_LOW";
    high.meshes[0].name = "wall_high";
    high.meshes[1].name = "door_high";
    BakeModelOptions options = smallOptions();
    const auto all = bakeModel(low, highOf(high), options);
    options.matchByName = true;
    const auto matched = bakeModel(low, highOf(high), options);
    ASSERT_TRUE(all && matched);
    EXPECT_LT(codes(all->maps[0].image, 0, 3).x, 128);
    EXPECT_GT(codes(matched->maps[0].image, 0, 3).x, 128);
    high.meshes[1].name = "gate_high";
    EXPECT_EQ(errorOf(bakeModel(low, highOf(high), options)),
              "options.matchByName: no high mesh matches the name of the low mesh 'Door_LOW'");
}

TEST(BakeModel, theNameOfAMeshCountsWhereOnlyItSaysWhatItIs)
{
    Scene low = sceneOfMeshes({square({0, 0, 0}, {1, 0, 0})});
    Scene high = sceneOfMeshes({square({0, 0, 0.1f}, {1, 0, 0.3f}), square({0, 0, 0.06f}, {1, 0, -0.05f})});
    low.instances[0].name = "Node 7"; // as a glTF has nodes and meshes
    low.meshes[0].name = "door_low";
    high.instances[0].name = "wall_high";
    high.meshes[0].name = "door_high"; // the node says what it is, so that its mesh does not count
    high.instances[1].name = "Node 8";
    high.meshes[1].name = "door_high";
    BakeModelOptions options = smallOptions();
    options.matchByName = true;
    const auto matched = bakeModel(low, highOf(high), options);
    ASSERT_TRUE(matched) << matched.error().message;
    EXPECT_GT(codes(matched->maps[0].image, 0, 3).x, 128);
    EXPECT_EQ(matched->warnings, std::vector<std::string>{"no low mesh has the name of 'wall_high': not baked"});
}

TEST(BakeModel, aMapForTheHighSceneIsApplied)
{
    // The same direction everywhere, with green as in DirectX: down the image.
    const glm::dvec3 m = glm::normalize(glm::dvec3(0.2, 0.4, 1));
    HighModel high = highOf(sceneOfMeshes({square({0, 0, 0}, {1, 0, 0})}));
    high.maps.push_back(makeImage(1, 1, PixelType::unorm8));
    const glm::ivec3 stored(code(m.x), code(-m.y), code(m.z));
    for (int k = 0; k < 3; ++k)
        high.maps[0].bytes8()[k] = std::uint8_t(stored[k]);
    BakeModelOptions options = smallOptions();
    options.ownMaps = true;
    options.highFrame = Frame::cotangent;
    options.highFormat = Convention{.greenUp = false};
    const auto model = bakeModel(sceneOfMeshes({square({0, 0, 0}, {1, 0, 0})}), std::move(high), options);
    ASSERT_TRUE(model) << model.error().message;
    const glm::ivec3 found = codes(model->maps[0].image, 5, 3);
    EXPECT_LE(std::abs(found.x - code(m.x)), 1); // rounded twice
    EXPECT_LE(std::abs(found.y - code(m.y)), 1);
    EXPECT_LE(std::abs(found.z - code(m.z)), 1);
}

TEST(BakeModel, withoutADistanceTenPercentOfTheLowDiagonalAreSearchedAndFiveOfTheHighOneByNearest)
{
    // The low square's diagonal is sqrt(2), the high rectangle's sqrt(10).
    const Scene low = sceneOfMeshes({square({0, 0, 0}, {1, 0, 0})}),
                high = sceneOfMeshes({rectangle({-1, 0, 0}, {3, 0, 0}, {0, 1, 0})});
    for (const auto& [search, distance] :
         {std::pair(BakeSearch::first, 0.1 * std::sqrt(2)), {BakeSearch::nearest, 0.05 * std::sqrt(10)}}) {
        BakeModelOptions options = smallOptions();
        options.bake.maxDistance = 0;
        options.bake.search = search;
        const auto baked = bakeModel(low, highOf(high), options);
        ASSERT_TRUE(baked) << baked.error().message;
        EXPECT_NEAR(baked->maps[0].statistics.rayDistance, distance, 1e-6);
    }
}

TEST(BakeModel, errorsOfOptionsBeginWithTheirNames)
{
    const Scene flat = sceneOfMeshes({square({0, 0, 0}, {1, 0, 0})});
    const Scene two = sceneOfMeshes({square({0, 0, 0}, {1, 0, 0}), square({0, 2, 0}, {1, 0, 0})});
    const auto errorWith = [&](const std::function<void(BakeModelOptions&, HighModel&)>& change) {
        BakeModelOptions options = smallOptions();
        HighModel high = highOf(flat);
        change(options, high);
        return errorOf(bakeModel(flat, std::move(high), options));
    };
    using O = BakeModelOptions;
    using H = HighModel;
    EXPECT_EQ(errorWith([](O& o, H&) { o.material = 1; }), "options.material: expected 0 to 0; found 1");
    EXPECT_EQ(errorWith([](O& o, H&) { o.bake.height = 0; }),
              "options.bake.width: expected a width and a height from 1 to 65535; found 12x0");
    EXPECT_EQ(errorWith([](O& o, H&) { o.bake.samples = 3; }),
              "options.bake.samples: expected 1, 2 or 4 samples per texel and axis; found 3");
    EXPECT_EQ(errorWith([](O& o, H&) { o.bake.frame = Frame(99); }),
              fmt::format("options.bake.frame: expected 0 to {}; found 99", kFrameCount - 1));
    EXPECT_EQ(errorWith([](O& o, H&) { o.highFrame = Frame(-1); }),
              fmt::format("options.highFrame: expected 0 to {}; found -1", kFrameCount - 1));
    EXPECT_EQ(errorWith([](O& o, H&) { o.bake.occlusionRays = 0; }),
              "options.bake.occlusionRays: expected 1 to 65536 rays for occlusion; found 0");
    EXPECT_EQ(errorWith([](O& o, H&) { o.bake.cageReach = NAN; }), "options.cageReach: expected 0 to 1e+17; found nan");
    EXPECT_EQ(errorWith([](O& o, H&) { o.types.resize(2); }),
              "options.types: expected none, or one for each of the maps; found 2");
    EXPECT_EQ(errorWith([](O& o, H&) { o.tiles = {1000}; }),
              "options.tiles: expected numbers of at least 1001; found 1000");
    EXPECT_EQ(errorWith([](O&, H& h) { h.maps.resize(2); }),
              "high.maps: expected none, one, or one for each of the 1 scenes; found 2");
    EXPECT_EQ(errorWith([](O& o, H&) { o.bake.extrusion = -1; }), "options.extrusion: expected 0 to 1e+17; found -1");
    EXPECT_EQ(errorWith([](O& o, H&) { o.bake.extrusion = 1, o.bake.search = BakeSearch::nearest; }),
              "options.extrusion: the search nearest already looks to both sides of the low surface");
    EXPECT_EQ(errorWith([&](O& o, H&) { o.cage = &flat, o.bake.search = BakeSearch::nearest; }),
              "options.search: a cage already defines where rays start, and the first surface that they hit counts");
    EXPECT_EQ(errorWith([&](O& o, H&) { o.cage = &flat, o.bake.extrusion = 1; }),
              "options.extrusion: a cage already defines where rays start, and the first surface that they hit counts");
    const auto mask = std::make_shared<const Image>(makeImage(2, 2, PixelType::unorm8));
    const char* const alone =
        "options.raysMask: expected neither a cage nor the search nearest nor options.rays with it";
    EXPECT_EQ(errorWith([&](O& o, H&) { o.bake.raysMask = mask, o.cage = &flat; }), alone);
    EXPECT_EQ(errorWith([&](O& o, H&) { o.bake.raysMask = mask, o.bake.search = BakeSearch::nearest; }), alone);
    EXPECT_EQ(errorWith([&](O& o, H&) { o.bake.raysMask = mask, o.bake.rays = BakeRays::straight; }), alone);
    EXPECT_EQ(errorWith([](O& o, H&) { o.bake.raysMask = std::make_shared<const Image>(); }),
              "options.raysMask: expected an image; found 0x0 texels in 0 bytes");
    EXPECT_EQ(errorWith([](O& o, H&) { o.bake.rays = BakeRays::vertexColor; }),
              "options.rays: expected vertex colours in the low mesh; found none");
    EXPECT_EQ(errorWith([&](O& o, H&) { o.cage = &two; }),
              "options.cage: expected a cage of 2 triangles, as the low mesh has; found 4");
}

TEST(BakeModel, positionsFromWhichNoRayCanStartAreRefused)
{
    // The positions are finite, but Embree would end the program.
    const Scene flat = sceneOfMeshes({square({0, 0, 0}, {1, 0, 0})}),
                far = sceneOfMeshes({square({0, 0, 1e20f}, {1, 0, 0})});
    EXPECT_EQ(errorOf(bakeModel(far, highOf(flat), smallOptions())),
              "low: expected positions up to 1e+17 from the origin; found 1e+20");
    EXPECT_EQ(errorOf(bakeModel(flat, highOf(far), smallOptions())),
              "high: expected positions up to 1e+17 from the origin; found 1e+20");
    BakeModelOptions options = smallOptions();
    options.cage = &far;
    EXPECT_EQ(errorOf(bakeModel(flat, highOf(flat), options)),
              "options.cage: expected positions up to 1e+17 from the origin; found 1e+20");
    options.cage = nullptr;
    options.bake.extrusion = 1e20f;
    EXPECT_EQ(errorOf(bakeModel(flat, highOf(flat), options)), "options.extrusion: expected 0 to 1e+17; found 1e+20");
    options.bake.extrusion = 0;
    options.bake.maxDistance = 1e20f;
    EXPECT_EQ(errorOf(bakeModel(flat, highOf(flat), options)), "options.maxDistance: expected 0 to 1e+17; found 1e+20");
    options.bake.maxDistance = -1;
    EXPECT_EQ(errorOf(bakeModel(flat, highOf(flat), options)), "options.maxDistance: expected 0 to 1e+17; found -1");
}

TEST(BakeModel, aTransformThatLeavesNoAreaIsRefused)
{
    const Scene high = sceneOfMeshes({square({0, 0, 0}, {1, 0, 0})});
    Scene low = high;
    low.instances[0].toWorld = glm::mat4(0);
    EXPECT_EQ(errorOf(bakeModel(low, highOf(high), smallOptions())),
              "low: expected a triangle with an area; all 2 have none in world space");
}

// Two simple models, two detailed ones beside each other, in other kinds and sizes: the first bake must not change the
// second. Names are matched by instance, so that each bake has groups of its own.
TEST(OpenDetailed, severalBakesGiveTheBytesOfSeparateOnes)
{
    const auto named = [](Scene scene, std::initializer_list<std::string> names) {
        for (std::size_t i = 0; i < names.size(); ++i)
            scene.instances[i].name = names.begin()[i];
        return scene;
    };
    const Scene high = named(sceneOfMeshes({square({0, 0, 0.1f}, {1, 0, 0.2f}), square({0, 0, 0.2f}, {1, 0, -0.2f})}),
                             {"a_high", "b_high"});
    const Scene lows[] = {named(sceneOfMeshes({square({0, 0, 0}, {1, 0, 0})}), {"a_low"}),
                          named(sceneOfMeshes({square({0, 0, 0}, {1, 0, 0})}), {"b_low"})};
    for (const bool matched : {false, true}) {
        BakeModelOptions options = smallOptions();
        options.matchByName = matched;
        options.bake.highNormals = HighNormals::curved;
        const auto open = openDetailed(highOf(high), options);
        ASSERT_TRUE(open) << open.error().message;
        std::vector<std::vector<std::byte>> maps;
        for (const Scene& low : lows)
            for (const BakeKind kind : {BakeKind::normal, BakeKind::height}) {
                options.bake.kind = kind;
                options.bake.width = kind == BakeKind::normal ? 12 : 20;
                const auto shared = bakeModel(low, *open, options), alone = bakeModel(low, highOf(high), options);
                ASSERT_TRUE(shared && alone) << errorOf(shared) << errorOf(alone);
                EXPECT_EQ(shared->maps[0].image.data, alone->maps[0].image.data) << matched << int(kind);
                EXPECT_EQ(shared->warnings, alone->warnings);
                maps.push_back(shared->maps[0].image.data);
            }
        EXPECT_EQ(maps[0] != maps[2], matched); // without names both see the upper surface
    }
    EXPECT_EQ(errorOf(bakeModel(Scene{}, *openDetailed(highOf(high), smallOptions()), smallOptions())),
              errorOf(bakeModel(Scene{}, highOf(high), smallOptions())));
}

// Both are prepared before either is baked.
TEST(OpenDetailed, preparedBakesDoNotShareTheirMatches)
{
    Scene high = sceneOfMeshes({square({0, 0, 0.1f}, {1, 0, 0.2f}), square({0, 0, 0.2f}, {1, 0, -0.2f})});
    high.instances[0].name = "a_high", high.instances[1].name = "b_high";
    BakeModelOptions options = smallOptions();
    options.matchByName = true;
    const auto open = openDetailed(highOf(high), options);
    ASSERT_TRUE(open);
    const auto lowNamed = [](const std::string& name) {
        Scene low = sceneOfMeshes({square({0, 0, 0}, {1, 0, 0})});
        low.instances[0].name = name;
        return low;
    };
    const auto a = prepareBake(lowNamed("a_low"), *open, options), b = prepareBake(lowNamed("b_low"), *open, options);
    ASSERT_TRUE(a && b);
    const int red = code(0.2 / std::sqrt(1.04)); // of the normal of a slope of 0.2
    EXPECT_EQ(codes(bakeTile(*a, 1001)->front().image, 6, 4).x, 256 - red);
    EXPECT_EQ(codes(bakeTile(*b, 1001)->front().image, 6, 4).x, red);
}

} // namespace
} // namespace cotan
