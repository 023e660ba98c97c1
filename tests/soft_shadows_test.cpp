// Soft shadows on the model, compared with rays to an area light.
#include <gtest/gtest.h>

#include <algorithm>

#include "cotan/render.hpp"
#include "cotan/view.hpp"
#include "ground_scene.hpp"

namespace cotan {
namespace {

using namespace test;
using glm::dvec3;
using glm::vec3;

// Percentage-closer filtering assumes one distance for all occluders, and one disc for the search for them. The bound
// is the resulting error on the floor under a ball and a box; the error of sharp shadows is about three times as large.
TEST(SoftShadows, matchRaysToTheLightsDisc)
{
    const Solids solids;
    Scene scene = sceneOf(solids);
    add(scene, makePlane(6, 1, 1), glm::mat4(1));
    View view = sunnyView();
    view.width = view.height = 96;
    view.camera.orthographic = true;
    view.camera.verticalExtent = 4;
    view.camera.eye = {0, 5, 0};
    view.camera.up = {0, 0, -1};
    view.linearOutput = true;
    view.samples = 1;
    view.shadowSoftness = 0.06f;
    const dvec3 toLight = -dvec3(view.lights[0].direction);
    for (const auto& renderer : renderers()) {
        ASSERT_TRUE(renderer->load(scene));
        const auto meanError = [&](const View& drawn) {
            View bare = drawn;
            bare.shadows = false;
            const auto with = renderer->draw(drawn), without = renderer->draw(bare);
            double sum = 0;
            int count = 0;
            for (int i = 0; with && without && i < 96 * 96; ++i) {
                const dvec3 p((i % 96 + 0.5) / 24 - 2, 0, (i / 96 + 0.5) / 24 - 2);
                if (solids.stop(p, {1e-9, 1, 1e-9}))
                    continue; // a solid covers the floor here
                const double lit = with->floats()[4 * i] / double(without->floats()[4 * i]);
                sum += std::abs(lit - tracedTransmittance(solids, p, toLight, view.shadowSoftness));
                ++count;
            }
            EXPECT_GT(count, 5000);
            return sum / count;
        };
        View sharp = view;
        sharp.shadowSoftness = 0;
        EXPECT_LT(meanError(view), 0.003) << renderer->device();
        EXPECT_GT(meanError(sharp), 0.007) << renderer->device();
    }
}

// The reference renderer draws a tile of the shadow map with many triangles in a different order.
TEST(SoftShadows, ofCoincidentOccludersEqualThoseOfOne)
{
    const auto floorBytes = [](int copies, int shaded) {
        Scene scene;
        add(scene, makePlane(6, 1, 1), glm::mat4(1));
        for (int i = 0; i < copies; ++i)
            add(scene, makePlane(1, 1, 1), translationScale({0, 0.8, 0}, dvec3(1)));
        for (int i = 0; i < shaded; ++i) // below the others, in their shadow
            add(scene, makePlane(0.5f, 1, 1), translationScale({0, 0.7 - 0.001 * i, 0}, dvec3(1)));
        View view = sunnyView();
        view.width = view.height = 48;
        view.camera.orthographic = true; // shows only the floor under them
        view.camera.verticalExtent = 0.3f;
        view.camera.eye = {0, 0.5f, 1};
        view.camera.target = {0, 0, 0};
        const auto drawn = renderReference(scene, view, 1);
        EXPECT_TRUE(drawn);
        return drawn ? drawn->data : std::vector<std::byte>();
    };
    EXPECT_EQ(floorBytes(1, 0), floorBytes(100, 0));
    EXPECT_EQ(floorBytes(1, 3), floorBytes(80, 3));
}

// The floor under a pane gets 1 - alpha of the light in both renderers, with sharp and soft shadows: the mean within
// 0.012, single pixels within a ninth (the granularity of nine texels), or 0.2 where 24 taps are spread over a disc.
TEST(SoftShadows, translucentPanesBlockLightByTheirAlpha)
{
    Scene scene;
    add(scene, makePlane(6, 1, 1), glm::mat4(1));
    add(scene, makePlane(1, 1, 1), translationScale({0, 0.8, 0}, dvec3(1)));
    scene.materials.resize(2);
    scene.materials[1].alphaMode = AlphaMode::blend;
    scene.meshes[1].material = 1;
    View view = sunnyView();
    view.lights[0].direction = glm::normalize(vec3(0.05f, -1, 0.03f));
    view.width = view.height = 48;
    view.camera.orthographic = true; // shows the floor under the pane, not the pane
    view.camera.verticalExtent = 0.3f;
    view.camera.eye = {0, 0.5f, 1};
    view.camera.target = {0, 0, 0};
    view.linearOutput = true;
    view.samples = 1;
    for (const auto& renderer : renderers())
        for (const float alpha : {0.0f, 0.1f, 0.35f, 0.5f, 0.8f, 1.0f}) {
            scene.materials[1].baseColor.w = alpha;
            ASSERT_TRUE(renderer->load(scene));
            for (const float softness : {0.0f, 0.06f}) {
                view.shadowSoftness = softness;
                View bare = view;
                bare.shadows = false;
                const auto with = renderer->draw(view), without = renderer->draw(bare);
                ASSERT_TRUE(with && without);
                double mean = 0, worst = 0;
                for (std::size_t i = 0; i < with->pixelCount(); ++i) {
                    const double lit = with->floats()[4 * i] / double(without->floats()[4 * i]);
                    mean += lit / double(with->pixelCount());
                    worst = std::max(worst, std::abs(lit - (1 - alpha)));
                }
                EXPECT_NEAR(mean, 1 - alpha, 0.012) << renderer->device() << " " << alpha << " " << softness;
                EXPECT_LT(worst, softness > 0 ? 0.2 : 0.112) << renderer->device() << " " << alpha << " " << softness;
            }
        }
}

TEST(SoftShadows, convexSolidsDoNotShadeTheirLitSides)
{
    Scene scene = sceneOf({});
    scene.instances.resize(1); // the ball
    View view = sunnyView();
    view.width = view.height = 128;
    view.camera.eye = vec3(-0.6f, 0.9f, 0.1f) - view.lights[0].direction * 2.0f;
    view.camera.target = {-0.6f, 0.9f, 0.1f};
    view.linearOutput = true;
    view.samples = 1;
    for (const auto& renderer : renderers()) {
        ASSERT_TRUE(renderer->load(scene));
        View bare = view;
        bare.shadows = false;
        const auto with = renderer->draw(view), without = renderer->draw(bare);
        ASSERT_TRUE(with && without);
        for (std::size_t i = 0; i < with->pixelCount(); ++i)
            ASSERT_NEAR(with->floats()[4 * i], without->floats()[4 * i], 0.004f) << renderer->device() << " " << i;
    }
}

TEST(SoftShadows, bothRenderersDrawTheSameOverEveryBackground)
{
    const auto all = renderers();
    if (all.size() < 2)
        GTEST_SKIP() << "no Vulkan device";
    Scene scene = sceneOf({});
    add(scene, makeTorus(0.3f, 0.1f, 48, 1, 1), translationScale({0, 0.4, 0.6}, dvec3(1)));
    scene.materials.resize(2);
    scene.materials[1].alphaMode = AlphaMode::blend;
    scene.materials[1].baseColor = {0.2f, 0.8f, 0.3f, 0.5f};
    scene.meshes.back().material = 1;
    View view = sunnyView();
    view.width = 240, view.height = 180;
    view.environment = true;
    view.environmentMap = std::make_shared<const EnvironmentMap>(makeEnvironment(*builtinRadiance("studio"), 1));
    auto ground = makeGround(scene, view);
    ASSERT_TRUE(ground);
    view.ground = std::make_shared<const GroundMap>(std::move(*ground));
    view.camera.eye = {1.5f, 1.6f, 4};
    view.camera.target = {0, 0.5f, 0};
    view.camera.verticalExtent = 3;
    for (const auto& renderer : all)
        ASSERT_TRUE(renderer->load(scene));
    for (const Backdrop backdrop : {Backdrop::gradient, Backdrop::blurred, Backdrop::sharp, Backdrop::paper})
        for (const bool background : {true, false})
            for (const bool orthographic : {false, true}) {
                view.backdrop = backdrop;
                view.background = background;
                view.camera.orthographic = orthographic;
                const auto a = all[0]->draw(view), b = all[1]->draw(view);
                ASSERT_TRUE(a && b);
                int large = 0;
                for (std::size_t i = 0; i < a->data.size(); ++i)
                    large += std::abs(int(a->bytes8()[i]) - int(b->bytes8()[i])) > 3;
                // Edges of shadows on the solids differ, because each renderer's shadow maps have their own texels.
                EXPECT_LT(large, int(a->data.size()) / 100) << int(backdrop) << background << orthographic;
                if (background)
                    continue;
                // Without a background only the shadow remains: black, with its darkness as alpha.
                const std::uint8_t* shadow = a->bytes8() + 4 * (240 * 170 + 120);
                EXPECT_EQ(shadow[0] + shadow[1] + shadow[2], 0);
                int half = 0;
                for (std::size_t i = 0; i < a->pixelCount(); ++i) {
                    const std::uint8_t* p = a->bytes8() + 4 * i;
                    half += p[0] + p[1] + p[2] == 0 && p[3] > 60 && p[3] < 240;
                }
                EXPECT_GT(half, 300);
            }
}

} // namespace
} // namespace cotan
