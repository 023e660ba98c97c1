// Draws maps and compares them through the C++ interface; the expected degrees follow from geometry.
#include "reference_scene.hpp"

#include <algorithm>
#include <cmath>

#include "bake_cases.hpp"
#include "cotan/inspect.hpp"
#include "verify_bake.hpp"

namespace cotan {
namespace {

using namespace cotan::testing;

using app::kBakeViews, app::verifyBake;

constexpr int kPixels = 96; // width and height of the images

// A square quad, visible from both sides, with a map of one colour.
Scene quadWith(glm::ivec3 texel)
{
    Scene scene = sceneOf(meshOf(Patch{}));
    addNormalMap(scene, texel);
    scene.materials[0].doubleSided = true;
    return scene;
}

const glm::ivec3 kFlatTexel{128, 128, 255};

std::unique_ptr<Renderer> reference()
{
    auto renderer = openRenderer("reference");
    return renderer ? std::move(*renderer) : nullptr;
}

TEST(VerifyConversion, equalModelsDifferByZeroDegrees)
{
    const auto renderer = reference();
    const Scene scene = quadWith({168, 98, 240});
    const auto compared = verifyConversion(*renderer, {scene, Frame::cotangent}, {scene, Frame::cotangent}, kPixels);
    ASSERT_TRUE(compared) << compared.error().message;
    EXPECT_TRUE(compared->mapped);
    EXPECT_GT(compared->all.count, 1000u);
    EXPECT_EQ(compared->all.maximum, 0);
    ASSERT_EQ(compared->views.size(), std::size_t(kConversionViews));
    std::size_t count = 0;
    for (const ComparedView& v : compared->views) {
        count += v.degrees.count;
        for (const Image* image : {&v.expected, &v.drawn, &v.difference}) {
            EXPECT_EQ(image->width, kPixels);
            EXPECT_EQ(image->height, kPixels);
            EXPECT_EQ(image->type, PixelType::unorm8);
        }
    }
    EXPECT_EQ(count, compared->all.count);
    EXPECT_FALSE(renderer->draw(viewOf(Output::normal))); // the renderer no longer has a scene
}

TEST(VerifyConversion, aFlatMapErrsByTheTiltOfTheOriginal)
{
    const auto renderer = reference();
    const double tilt = std::atan2(std::hypot(40, 30), 112) * 57.295779513;
    // All frames of a square are one rotation. Frames at vertices are derived without a request.
    const auto compared = verifyConversion(*renderer, {quadWith({168, 98, 240}), Frame::mikktspace},
                                           {quadWith(kFlatTexel), Frame::smooth}, kPixels);
    ASSERT_TRUE(compared) << compared.error().message;
    EXPECT_GT(compared->views[0].degrees.count, 1000u); // from the front
    EXPECT_GT(compared->views[2].degrees.count, 1000u); // from behind
    for (std::size_t side : {1, 3, 4})                  // the quad is a line from the sides and from above
        EXPECT_EQ(compared->views[side].degrees.count, 0u) << side;
    EXPECT_NEAR(compared->all.mean, tilt, 1e-3); // rounding of float
    EXPECT_NEAR(compared->all.maximum, tilt, 1e-2);
}

TEST(VerifyConversion, theSecondModelIsDrawnWithTheCamerasOfTheFirst)
{
    const auto renderer = reference();
    const Scene here = quadWith(kFlatTexel);
    Scene there = here;
    there.instances[0].toWorld[3][0] = 10; // out of sight
    const auto compared = verifyConversion(*renderer, {here, Frame::cotangent}, {there, Frame::cotangent}, kPixels);
    ASSERT_TRUE(compared) << compared.error().message;
    EXPECT_TRUE(compared->mapped);
    EXPECT_EQ(compared->all.count, 0u);
}

TEST(VerifyConversion, modelsWithoutMapsAreNotCompared)
{
    const auto renderer = reference();
    const Scene plain = sceneOf(meshOf(Patch{}));
    const auto compared = verifyConversion(*renderer, {plain, Frame::cotangent}, {plain, Frame::smooth}, kPixels);
    ASSERT_TRUE(compared) << compared.error().message;
    EXPECT_FALSE(compared->mapped);
    EXPECT_EQ(compared->all.count, 0u);
    EXPECT_TRUE(std::isnan(compared->all.mean));
}

TEST(VerifyConversion, oneMappedModelIsEnoughToCompare)
{
    const auto renderer = reference();
    const Scene plain = sceneOf(meshOf(Patch{})), mapped = quadWith({168, 98, 240});
    for (const bool first : {true, false}) {
        const auto compared = verifyConversion(*renderer, {first ? mapped : plain, Frame::cotangent},
                                               {first ? plain : mapped, Frame::cotangent}, kPixels);
        ASSERT_TRUE(compared) << compared.error().message;
        EXPECT_TRUE(compared->mapped) << first;
        EXPECT_GT(compared->all.count, 1000u) << first;
        EXPECT_GT(compared->all.mean, 5) << first; // degrees by which the only map tilts
    }
}

TEST(VerifyConversion, imagesOfADifferentNumberOrSizeAreRefused)
{
    const auto renderer = reference();
    const Scene scene = quadWith(kFlatTexel);
    const auto all = drawSides(*renderer, {scene, Frame::cotangent}, {}, kPixels);
    ASSERT_TRUE(all) << all.error().message;
    const auto few = drawSides(*renderer, {scene, Frame::cotangent}, {all->cameras[0]}, kPixels);
    const auto small = drawSides(*renderer, {scene, Frame::cotangent}, all->cameras, kPixels / 2);
    ASSERT_TRUE(few && small);
    for (const auto& [other, expected] : {std::pair(&*few, "expected as many images after as before, 5; found 1"),
                                          {&*small, "expected images of the same size, 96 x 96; found 48 x 48"}}) {
        const auto compared = compareSides(*all, *other);
        ASSERT_FALSE(compared);
        EXPECT_EQ(compared.error().kind, ErrorKind::usage);
        EXPECT_EQ(compared.error().message, "verify: " + std::string(expected));
    }
    DrawnSides upright, level;
    upright.normals = {makeImage(2, 3, PixelType::float32)};
    for (const auto& [width, height] : {std::pair(2, 4), {4, 3}, {3, 2}}) {
        level.normals = {makeImage(width, height, PixelType::float32)};
        const auto compared = compareSides(upright, level);
        ASSERT_FALSE(compared);
        EXPECT_EQ(compared.error().message,
                  "verify: expected images of the same size, 2 x 3; found " + std::to_string(width) + " x "
                      + std::to_string(height));
    }
    level.normals = upright.normals;
    EXPECT_TRUE(compareSides(upright, level));
}

// Cameras in front, at three quarter turns, and above, all at the same distance and aimed at the centre of the model.
TEST(VerifyConversion, camerasAreFourAroundAndOneAbove)
{
    const auto renderer = reference();
    Scene scene = quadWith(kFlatTexel);
    scene.instances[0].toWorld[2][2] = 3;
    scene.instances[0].toWorld[3] = {5, 6, 7, 1};
    Instance behind = scene.instances[0]; // gives the model depth
    behind.toWorld[3] = {5, 6, 9, 1};
    scene.instances.push_back(behind);
    const auto sides = drawSides(*renderer, {scene, Frame::cotangent}, {}, 16);
    ASSERT_TRUE(sides);
    ASSERT_EQ(sides->cameras.size(), 5u);
    ASSERT_EQ(sides->normals.size(), 5u);
    const auto from = [&](std::size_t k) { return glm::normalize(sides->cameras[k].eye - sides->cameras[k].target); };
    const float away = glm::length(sides->cameras[0].eye - sides->cameras[0].target);
    for (std::size_t k = 0; k < 5; ++k) {
        EXPECT_LT(glm::length(sides->cameras[k].target - glm::vec3(5, 6, 8)), 1e-5f) << k;
        EXPECT_NEAR(glm::length(sides->cameras[k].eye - sides->cameras[k].target), away, 1e-4f) << k;
        EXPECT_EQ(sides->normals[k].width, 16) << k;
        EXPECT_EQ(sides->normals[k].height, 16) << k;
    }
    for (std::size_t k = 1; k < 4; ++k) { // z to x, x to -z: counter-clockwise from above
        EXPECT_NEAR(from(k).x, from(k - 1).z, 1e-5f) << k;
        EXPECT_NEAR(from(k).y, from(0).y, 1e-5f) << k;
        EXPECT_NEAR(from(k).z, -from(k - 1).x, 1e-5f) << k;
    }
    EXPECT_GT(from(0).z, 0.5f);
    EXPECT_NEAR(from(4).y, 1, 1e-5f);
    EXPECT_EQ(sides->cameras[4].up, glm::vec3(0, 0, -1));
}

// Instances of a quad in one place, none of which a renderer leaves out.
Scene stackOf(std::size_t sheets)
{
    Scene scene = quadWith(kFlatTexel);
    scene.instances.assign(sheets, scene.instances[0]);
    return scene;
}

// A conversion of a model of 1 MB once took over a minute.
TEST(VerifyConversion, excessiveOverdrawIsRefusedBeforeDrawing)
{
    const auto renderer = reference();
    const auto few = drawSides(*renderer, {stackOf(20), Frame::cotangent}, {}, 32);
    EXPECT_TRUE(few) << few.error().message;
    const auto many = drawSides(*renderer, {stackOf(300), Frame::cotangent}, {}, 32);
    ASSERT_FALSE(many);
    EXPECT_EQ(many.error().kind, ErrorKind::input);
    EXPECT_NE(many.error().message.find("its triangles cover the image"), std::string::npos) << many.error().message;
    Scene aside = stackOf(300); // lines from the front
    for (Instance& sheet : aside.instances)
        std::swap(sheet.toWorld[0], sheet.toWorld[2]);
    Scene one = aside;
    one.instances.resize(1);
    const auto around = drawSides(*renderer, {one, Frame::cotangent}, {}, 256);
    ASSERT_TRUE(around) << around.error().message;
    EXPECT_TRUE(drawSides(*renderer, {aside, Frame::cotangent}, {around->cameras[0]}, 256));
    EXPECT_FALSE(drawSides(*renderer, {aside, Frame::cotangent}, around->cameras, 256));
}

TEST(VerifyConversion, modelsTooLargeForSquaresInFloatAreDrawn)
{
    const auto renderer = reference();
    Scene scene = quadWith(kFlatTexel);
    for (int axis = 0; axis < 3; ++axis)
        scene.instances[0].toWorld[axis][axis] = 1e23f;
    const auto sides = drawSides(*renderer, {scene, Frame::cotangent}, {}, 32);
    ASSERT_TRUE(sides) << sides.error().message;
    for (const Camera& camera : sides->cameras)
        EXPECT_NEAR(glm::length(glm::dvec3(camera.eye - camera.target))
                        / glm::length(glm::dvec3(sides->cameras[0].eye - sides->cameras[0].target)),
                    1, 1e-5); // rounding of float
}

// A quad at z = 0, and above it one that rises by `slope` along x.
struct Pair {
    Scene low, high;
};

Pair tiltedPair(double slope)
{
    Patch rising;
    rising.origin = {-1, 1, -slope};
    rising.alongU = {2, 0, 2 * slope};
    return {sceneOf(meshOf(Patch{})), sceneOf(meshOf(rising))};
}

TEST(VerifyBake, bakedMapsMatchAndFlatMapsErrByTheSlope)
{
    const double slope = 0.2;
    const Pair pair = tiltedPair(slope);
    BakeOptions options;
    options.frame = Frame::smooth;
    options.width = options.height = 32;
    options.maxDistance = 1;
    const auto low = makeLowSurface(pair.low, -1, options.frame, TangentOrigin::generated);
    const auto high = HighSurface::make({pair.high}, 0);
    ASSERT_TRUE(low && high);
    const auto baked = bake(*low, *high, options);
    ASSERT_TRUE(baked) << baked.error().message;
    const StoredAs stored{};
    const Image map = storeBaked(*baked, BakeKind::normal, stored), flat = solidImage({kFlatTexel, 255});
    const auto renderer = reference();

    const auto fits = verifyBake(*renderer, {pair.low, *low, *high, options, map, stored.format}, kPixels);
    ASSERT_TRUE(fits) << fits.error().message;
    ASSERT_EQ(fits->views.size(), std::size_t(kBakeViews));
    EXPECT_GT(fits->views[0].degrees.count, 1000u);
    EXPECT_LT(fits->views[0].degrees.maximum, 0.45); // worst case of rounding to 8 bits

    const auto wrong = verifyBake(*renderer, {pair.low, *low, *high, options, flat, stored.format}, kPixels);
    ASSERT_TRUE(wrong) << wrong.error().message;
    EXPECT_NEAR(wrong->views[0].degrees.mean, std::atan(slope) * 57.295779513, 1e-3);
    EXPECT_EQ(wrong->views[0].degrees.count, fits->views[0].degrees.count);
    for (std::size_t side : {1, 3}) // the low quad is a line from there
        EXPECT_EQ(wrong->views[side].degrees.count, 0u) << side;
}

// Bakes a map and compares it.
ComparedViews bakedAndCompared(const Mesh& simple, const Mesh& detailed, const BakeOptions& given)
{
    BakeOptions options = given;
    options.frame = Frame::smooth;
    options.highNormals = HighNormals::face;
    const Scene scene = sceneOfMeshes({simple});
    const auto low = makeLowSurface(scene, -1, options.frame, TangentOrigin::generated);
    const auto high = HighSurface::make({sceneOfMeshes({detailed})}, 0);
    const auto baked = low && high ? bake(*low, *high, options) : Result<Baked>(usageError("no surface"));
    if (!baked)
        return ADD_FAILURE() << baked.error().message, ComparedViews();
    const StoredAs stored{};
    const Image map = storeBaked(*baked, BakeKind::normal, stored);
    const auto compared = verifyBake(*reference(), {scene, *low, *high, options, map, stored.format}, kPixels);
    EXPECT_TRUE(compared);
    return compared ? *compared : ComparedViews();
}

TEST(VerifyBake, boltsThatLeanCount)
{
    const BakeCase pair = bolts();
    BakeOptions options;
    options.width = options.height = 256;
    const ComparedViews straight = bakedAndCompared(pair.low, pair.high, options);
    options.rays = BakeRays::averaged;
    const ComparedViews leaning = bakedAndCompared(pair.low, pair.high, options);
    for (const ComparedViews* all : {&straight, &leaning})
        EXPECT_TRUE(app::showsHighSurface(*all));
    // Bolts 0.06 in radius are off by 0.04: rims that show the side walls or the wrong surface, 90 degrees off.
    EXPECT_GT(leaning.all.mean, 1.5 * straight.all.mean);
    EXPECT_GT(leaning.all.over5, straight.all.over5 + 0.01);
}

TEST(VerifyBake, moreSamplesScoreBetterOnDetailFinerThanATexel)
{
    // Ridges with slopes of 1/2: 2.3 in a texel, and more than one in a pixel.
    constexpr int kMapSide = 48, kRidges = 111;
    Mesh low, high;
    addSquare(low, kUpwards, glm::vec3(0), {0.5f, 0.5f}, Atlas{1}.cell());
    const float half = 0.5f / kRidges;
    for (int i = 0; i < kRidges; ++i) {
        const float x = -0.5f + 2 * half * float(i);
        for (const float s : {1.0f, -1.0f}) {
            const glm::vec3 foot(s > 0 ? x : x + 2 * half, 0, 0), top(x + half, 0, half / 2), y(0, 0.5f, 0);
            std::vector<glm::vec3> points{foot - y, top - y, top + y, foot + y};
            if (s < 0)
                std::reverse(points.begin(), points.end());
            addPolygon(high, points, {glm::normalize(glm::vec3(-s, 0, 2))});
        }
    }
    const auto meanOf = [&](int samples) {
        BakeOptions options;
        options.width = options.height = kMapSide;
        options.samples = samples;
        return bakedAndCompared(low, high, options).all.mean;
    };
    EXPECT_LT(meanOf(4), 0.7 * meanOf(1)); // a single one shows one of the slopes, 27 degrees off the mean
}

// Compares a flat map for a tilted pair, drawn on `scene`.
Result<ComparedViews> verifiedFlat(const Scene& scene, int material, int side)
{
    const Pair pair = tiltedPair(0.1);
    const BakeOptions options;
    const auto low = makeLowSurface(pair.low, -1, options.frame, TangentOrigin::generated);
    const auto high = HighSurface::make({pair.high}, 0);
    if (!low || !high)
        return (low ? high.error() : low.error());
    const Image map = solidImage({kFlatTexel, 255});
    return verifyBake(*reference(), {scene, *low, *high, options, map, {}, material}, side);
}

TEST(VerifyBake, excessiveOverdrawIsRefusedBeforeDrawing)
{
    EXPECT_TRUE(verifiedFlat(stackOf(20), -1, 32));
    const auto compared = verifiedFlat(stackOf(300), -1, 32);
    ASSERT_FALSE(compared);
    EXPECT_EQ(compared.error().kind, ErrorKind::input);
    EXPECT_NE(compared.error().message.find("its triangles cover the image"), std::string::npos);
}

TEST(VerifyBake, aMaterialThatTheSceneDoesNotHaveIsRefused)
{
    for (int material : {-2, 1}) {
        const auto compared = verifiedFlat(tiltedPair(0.1).low, material, kPixels);
        ASSERT_FALSE(compared);
        EXPECT_EQ(compared.error().kind, ErrorKind::usage);
        const std::string found = "expected a material from -1 to 0; found " + std::to_string(material);
        EXPECT_NE(compared.error().message.find(found), std::string::npos) << compared.error().message;
    }
}

} // namespace
} // namespace cotan
