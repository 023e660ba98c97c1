// One picture in one call, and a painter for several: as a program uses them.
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
    const auto painter = openPainter("auto");
    ASSERT_TRUE(painter);
    if (!(*painter)->note.empty())
        GTEST_SKIP() << (*painter)->note;
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

TEST(Painter, aSceneThatWasNotMadeReadyForTheFrameIsRefusedOnEveryDevice)
{
    for (const char* device : {"reference", "auto"}) {
        const auto painter = openPainter(device);
        ASSERT_TRUE(painter);
        Scene scene = mappedQuad();
        ASSERT_TRUE((*painter)->load(scene));
        for (const Frame frame : {Frame::smooth, Frame::vertex, Frame::mikktspace}) {
            const auto bare = (*painter)->draw(viewOf(Output::normal, frame));
            ASSERT_FALSE(bare) << device << ", " << name(frame);
            EXPECT_EQ(bare.error().kind, ErrorKind::usage) << bare.error().message;
            deriveVertexFrames(scene, frame, TangentOrigin::generated);
            ASSERT_TRUE((*painter)->load(scene));
            const auto ready = (*painter)->draw(viewOf(Output::normal, frame));
            EXPECT_TRUE(ready) << ready.error().message;
            scene = mappedQuad();
            ASSERT_TRUE((*painter)->load(scene));
        }
        EXPECT_TRUE((*painter)->draw(viewOf(Output::normal, Frame::cotangent)));
    }
}

TEST(Painter, autoAlwaysOpensAndSaysWhyTheReferenceRendererDraws)
{
    const auto painter = openPainter();
    ASSERT_TRUE(painter) << painter.error().message;
    EXPECT_EQ((*painter)->device() == "reference", !(*painter)->note.empty());
    const auto named = openPainter("reference");
    ASSERT_TRUE(named);
    EXPECT_EQ((*named)->device(), "reference");
    EXPECT_EQ((*named)->note, "");
}

TEST(Painter, drawsOnlyWhatIsLoadedNow)
{
    const auto painter = openPainter("reference");
    ASSERT_TRUE(painter);
    const View view = viewOf(Output::normal);
    ASSERT_FALSE((*painter)->draw(view));
    EXPECT_EQ((*painter)->draw(view).error().kind, ErrorKind::usage);
    const Scene empty, quad = mappedQuad();
    for (const auto& [scene, shows] : {std::pair(&quad, true), {&empty, false}}) {
        ASSERT_TRUE((*painter)->load(*scene));
        const auto image = (*painter)->draw(view);
        ASSERT_TRUE(image) << image.error().message;
        EXPECT_EQ(forCovered(*image, [](int, int, glm::vec4) {}) > 0, shows);
    }
    (*painter)->forget();
    EXPECT_FALSE((*painter)->draw(view));
}

TEST(Painter, progressGetsZeroBeforeEachPictureAndOneAtItsEnd)
{
    const auto painter = openPainter("reference", 1);
    ASSERT_TRUE(painter);
    const Scene quad = mappedQuad();
    ASSERT_TRUE((*painter)->load(quad));
    std::vector<double> shares;
    (*painter)->progress = [&](double share) {
        shares.push_back(share);
        return true;
    };
    for (int picture = 1; picture <= 2; ++picture) {
        ASSERT_TRUE((*painter)->draw(viewOf(Output::normal)));
        EXPECT_EQ(std::count(shares.begin(), shares.end(), 0.0), picture);
        EXPECT_EQ(shares.back(), 1.0);
    }
}

TEST(Painter, stopsWhereItsProgressSaysSoAndDrawsTheNextPicture)
{
    const auto painter = openPainter("reference", 1);
    ASSERT_TRUE(painter);
    const Scene quad = mappedQuad();
    ASSERT_TRUE((*painter)->load(quad));
    for (const double limit : {-1.0, 0.0}) { // before the picture, and within it
        (*painter)->progress = [=](double share) { return share <= limit; };
        const auto picture = (*painter)->draw(viewOf(Output::normal));
        ASSERT_FALSE(picture) << limit;
        EXPECT_EQ(picture.error().kind, ErrorKind::stopped);
    }
    (*painter)->progress = {};
    EXPECT_TRUE((*painter)->draw(viewOf(Output::normal)));
}

} // namespace
} // namespace cotan
