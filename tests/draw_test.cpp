// Drawing one image with one call, and several with a renderer, as programs do.
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

// A square quad whose map is tilted everywhere.
Scene mappedQuad()
{
    Scene scene = sceneOf(meshOf(Patch{}));
    addNormalMap(scene, kTilted);
    return scene;
}

// On a square every frame is the same rotation, so all must give the same normal.
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
        EXPECT_LT(worst, 0.02) << name(frame); // float differences; on GPUs, texture filters with 8 fractional bits
    }
}

TEST(DrawView, drawsTheMapsNormalInEveryFrameWithoutPreparation) { expectTiltedNormals("reference"); }

TEST(DrawView, drawsTheSameOnAVulkanDevice)
{
    const auto renderer = openRenderer("auto");
    ASSERT_TRUE(renderer);
    if (!(*renderer)->note.empty())
        GTEST_SKIP() << (*renderer)->note;
    expectTiltedNormals("auto");
}

TEST(DrawView, storedTangentsAreKept)
{
    Scene scene = mappedQuad();
    scene.meshes[0].tangents.assign(4, {0, 1, 0, 1}); // rotated by 90 degrees from those of its uv
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

TEST(Renderer, unpreparedScenesAreRefusedOnEveryDevice)
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

TEST(Renderer, autoAlwaysOpensAndExplainsTheReferenceRenderer)
{
    const auto renderer = openRenderer();
    ASSERT_TRUE(renderer) << renderer.error().message;
    EXPECT_EQ((*renderer)->device() == "reference", !(*renderer)->note.empty());
    const auto named = openRenderer("reference");
    ASSERT_TRUE(named);
    EXPECT_EQ((*named)->device(), "reference");
    EXPECT_EQ((*named)->note, "");
}

TEST(Renderer, drawsOnlyTheLoadedScene)
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

TEST(Renderer, progressRunsFromZeroToOneForEachImage)
{
    const auto renderer = openRenderer("reference", 1);
    ASSERT_TRUE(renderer);
    const Scene quad = mappedQuad();
    ASSERT_TRUE((*renderer)->load(quad));
    std::vector<double> fractions;
    (*renderer)->progress = [&](double fraction) {
        fractions.push_back(fraction);
        return true;
    };
    for (int imageNumber = 1; imageNumber <= 2; ++imageNumber) {
        ASSERT_TRUE((*renderer)->draw(viewOf(Output::normal)));
        EXPECT_EQ(std::count(fractions.begin(), fractions.end(), 0.0), imageNumber);
        EXPECT_EQ(fractions.back(), 1.0);
    }
}

TEST(Renderer, aStopByItsProgressDoesNotAffectTheNextImage)
{
    const auto renderer = openRenderer("reference", 1);
    ASSERT_TRUE(renderer);
    const Scene quad = mappedQuad();
    ASSERT_TRUE((*renderer)->load(quad));
    for (const double limit : {-1.0, 0.0}) { // before the image, and while it is drawn
        (*renderer)->progress = [=](double fraction) { return fraction <= limit; };
        const auto imageNumber = (*renderer)->draw(viewOf(Output::normal));
        ASSERT_FALSE(imageNumber) << limit;
        EXPECT_EQ(imageNumber.error().kind, ErrorKind::stopped);
    }
    (*renderer)->progress = {};
    EXPECT_TRUE((*renderer)->draw(viewOf(Output::normal)));
}

} // namespace
} // namespace cotan
