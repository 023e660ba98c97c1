// Automatic exposure, judged by the resulting image.
#include <algorithm>

#include "cotan/render.hpp"

#include <gtest/gtest.h>

#include "cotan/view.hpp"
#include "ground_scene.hpp"

namespace cotan {
namespace {

using namespace test;

// A ball of clay or rubber in the studio, as displayed.
struct DisplayedBall {
    float exposure = 0, mean = 0, maximum = 0; // of 255
};

DisplayedBall drawBall(Renderer& renderer, float color, float lamp)
{
    Scene scene;
    add(scene, makeSphere(1, 64), glm::mat4(1));
    scene.materials[0].baseColor = {color, color, color, 1};
    EXPECT_TRUE(renderer.load(scene));
    View view = sunnyView();
    view.width = view.height = 120;
    view.environment = true;
    static const auto studio = std::make_shared<const EnvironmentMap>(makeEnvironment(*builtinRadiance("studio"), 1));
    view.environmentMap = studio;
    view.lights[0].intensity = lamp;
    view.camera.eye = {0, 0.5f, 4};
    view.toneMapping = ToneMapping::neutral;
    DisplayedBall result;
    result.exposure = *meterExposure(renderer, view);
    view.exposure = result.exposure;
    view.background = false;
    const auto image = renderer.draw(view);
    int count = 0;
    for (std::size_t i = 0; image && i < image->pixelCount(); ++i) {
        const std::uint8_t* p = image->bytes8() + 4 * i;
        if (p[3] < 255)
            continue;
        result.mean += p[1];
        result.maximum = std::max(result.maximum, float(p[1]));
        ++count;
    }
    result.mean /= float(count);
    return result;
}

TEST(Exposure, whiteClayIsBrightWithoutClippingAndRubberIsBlack)
{
    std::vector<float> exposures;
    for (const auto& renderer : renderers()) {
        const DisplayedBall clay = drawBall(*renderer, 0.9f, 3), grey = drawBall(*renderer, 0.2f, 3),
                            rubber = drawBall(*renderer, 0.02f, 3);
        EXPECT_LT(clay.maximum, 252) << renderer->device();
        EXPECT_GT(clay.mean, 165) << renderer->device();
        EXPECT_LT(rubber.mean, 75) << renderer->device();
        EXPECT_GT(rubber.mean, 25) << renderer->device();
        EXPECT_LT(clay.exposure, grey.exposure);
        EXPECT_LT(grey.exposure, rubber.exposure);
        // A thousand times the light gives a similar image; at a hundredth, the light of the studio remains.
        const DisplayedBall flooded = drawBall(*renderer, 0.9f, 3000);
        EXPECT_LT(flooded.maximum, 255) << renderer->device();
        EXPECT_GT(flooded.mean, 60) << renderer->device();
        exposures.push_back(clay.exposure);
    }
    EXPECT_NEAR(exposures.front(), exposures.back(), 0.023f * exposures.front()); // 1/32 stop
}

TEST(Exposure, ofAnEmptySceneIsOne)
{
    const Scene nothing;
    for (const auto& renderer : renderers()) {
        ASSERT_TRUE(renderer->load(nothing));
        EXPECT_EQ(*meterExposure(*renderer, sunnyView()), 1);
    }
}

} // namespace
} // namespace cotan
