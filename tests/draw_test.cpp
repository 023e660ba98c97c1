// One picture in one call, and a renderer for several: as a program uses them.
#include "reference_scene.hpp"

#include <algorithm>

#include "cotan/render.hpp"
#include "cotan/view.hpp"

namespace cotan {
namespace {

using namespace cotan::testing;

// Bytes 128 + 127 x: m = (40, -30, 112) / 127, which is tilted along both axes.
constexpr glm::ivec3 kTilted{168, 98, 240};
const glm::dvec3 kTiltedTexel{40, -30, 112};

// A square quad, with a map that is tilted everywhere.
Scene mappedQuad()
{
    Scene scene = sceneOf(meshOf(Patch{}));
    addNormalMap(scene, kTilted);
    return scene;
}

// On a square every frame is the same rotation, so that all must show the same normal.
void expectTiltedNormals(const std::string& device)
{
    for (Frame frame : {Frame::cotangent, Frame::exact, Frame::smooth, Frame::vertex, Frame::mikktspace}) {
        const auto image = drawView(mappedQuad(), viewOf(Output::normal, frame), device);
        ASSERT_TRUE(image) << image.error().message;
        const glm::dvec3 expected = Patch{}.perturbed(kTiltedTexel);
        double worst = 0;
        const int covered = forCovered(*image, [&](int, int, glm::vec4 value) {
            worst = std::max(worst, degreesBetween(glm::dvec3(value), expected));
        });
        EXPECT_GT(covered, 400) << name(frame);
        EXPECT_LT(worst, 0.02) << name(frame); // float differences and, on devices, textures of 8 bits of fraction
    }
}

TEST(DrawView, aMappedQuadShowsTheMapsNormalInEveryFrameWithoutAnotherCall) { expectTiltedNormals("reference"); }

TEST(DrawView, aVulkanDeviceShowsTheSame)
{
    const auto renderer = openRenderer("auto");
    ASSERT_TRUE(renderer);
    if (!(*renderer)->note.empty())
        GTEST_SKIP() << (*renderer)->note;
    expectTiltedNormals("auto");
}

TEST(DrawView, tangentsOfTheSceneAreKept)
{
    Scene scene = mappedQuad();
    scene.meshes[0].tangents.assign(4, {0, 1, 0, 1}); // a quarter turn from those of its uv
    const auto kept = drawView(scene, viewOf(Output::tangent, Frame::mikktspace), "reference");
    ASSERT_TRUE(kept) << kept.error().message;
    const int covered = forCovered(*kept, [](int, int, glm::vec4 value) {
        EXPECT_NEAR(value.x, 0, 1e-5);
        EXPECT_NEAR(value.y, 1, 1e-5);
    });
    EXPECT_GT(covered, 400);
}

TEST(DrawView, unknownDevicesAndFramesAreRefused)
{
    const auto device = drawView(mappedQuad(), viewOf(Output::normal), "no device has this name");
    ASSERT_FALSE(device);
    EXPECT_EQ(device.error().kind, ErrorKind::unavailable);
    for (int frame : {-1, kFrameCount}) {
        View view = viewOf(Output::normal);
        view.frame = Frame(frame);
        const auto image = drawView(mappedQuad(), view, "reference");
        ASSERT_FALSE(image);
        EXPECT_EQ(image.error().kind, ErrorKind::usage);
    }
}

TEST(Renderer, aSceneThatWasNotMadeReadyForTheFrameIsRefusedOnEveryDevice)
{
    for (const char* device : {"reference", "auto"}) {
        const auto renderer = openRenderer(device);
        ASSERT_TRUE(renderer);
        Scene scene = mappedQuad();
        ASSERT_TRUE((*renderer)->load(scene));
        for (const Frame frame : {Frame::smooth, Frame::vertex, Frame::mikktspace}) {
            const auto bare = (*renderer)->draw(viewOf(Output::normal, frame));
            ASSERT_FALSE(bare) << device << ", " << name(frame);
            EXPECT_EQ(bare.error().kind, ErrorKind::usage) << bare.error().message;
            deriveVertexFrames(scene, frame, TangentOrigin::generated);
            ASSERT_TRUE((*renderer)->load(scene));
            const auto ready = (*renderer)->draw(viewOf(Output::normal, frame));
            EXPECT_TRUE(ready) << ready.error().message;
            scene = mappedQuad();
            ASSERT_TRUE((*renderer)->load(scene));
        }
        EXPECT_TRUE((*renderer)->draw(viewOf(Output::normal, Frame::cotangent)));
    }
}

TEST(Renderer, autoAlwaysOpensAndSaysWhyTheReferenceRendererDraws)
{
    const auto renderer = openRenderer();
    ASSERT_TRUE(renderer) << renderer.error().message;
    EXPECT_EQ((*renderer)->device() == "reference", !(*renderer)->note.empty());
    const auto named = openRenderer("reference");
    ASSERT_TRUE(named);
    EXPECT_EQ((*named)->device(), "reference");
    EXPECT_EQ((*named)->note, "");
}

TEST(Renderer, drawsOnlyWhatIsLoadedNow)
{
    const auto renderer = openRenderer("reference");
    ASSERT_TRUE(renderer);
    const View view = viewOf(Output::normal);
    ASSERT_FALSE((*renderer)->draw(view));
    EXPECT_EQ((*renderer)->draw(view).error().kind, ErrorKind::usage);
    const Scene empty, quad = mappedQuad();
    for (const auto& [scene, shows] : {std::pair(&quad, true), {&empty, false}}) {
        ASSERT_TRUE((*renderer)->load(*scene));
        const auto image = (*renderer)->draw(view);
        ASSERT_TRUE(image) << image.error().message;
        EXPECT_EQ(forCovered(*image, [](int, int, glm::vec4) {}) > 0, shows);
    }
    (*renderer)->forget();
    EXPECT_FALSE((*renderer)->draw(view));
}

TEST(Renderer, progressGetsZeroBeforeEachPictureAndOneAtItsEnd)
{
    const auto renderer = openRenderer("reference", 1);
    ASSERT_TRUE(renderer);
    const Scene quad = mappedQuad();
    ASSERT_TRUE((*renderer)->load(quad));
    std::vector<double> shares;
    (*renderer)->progress = [&](double share) {
        shares.push_back(share);
        return true;
    };
    for (int picture = 1; picture <= 2; ++picture) {
        ASSERT_TRUE((*renderer)->draw(viewOf(Output::normal)));
        EXPECT_EQ(std::count(shares.begin(), shares.end(), 0.0), picture);
        EXPECT_EQ(shares.back(), 1.0);
    }
}

TEST(Renderer, stopsWhereItsProgressSaysSoAndDrawsTheNextPicture)
{
    const auto renderer = openRenderer("reference", 1);
    ASSERT_TRUE(renderer);
    const Scene quad = mappedQuad();
    ASSERT_TRUE((*renderer)->load(quad));
    for (const double limit : {-1.0, 0.0}) { // before the picture, and within it
        (*renderer)->progress = [=](double share) { return share <= limit; };
        const auto picture = (*renderer)->draw(viewOf(Output::normal));
        ASSERT_FALSE(picture) << limit;
        EXPECT_EQ(picture.error().kind, ErrorKind::stopped);
    }
    (*renderer)->progress = {};
    EXPECT_TRUE((*renderer)->draw(viewOf(Output::normal)));
}

} // namespace
} // namespace cotan
