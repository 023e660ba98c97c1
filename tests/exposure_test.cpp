// Automatic exposure, by the picture that it makes.
#include <algorithm>

#include "cotan/render.hpp"

#include <gtest/gtest.h>

#include "cotan/view.hpp"
#include "ground_scene.hpp"

namespace cotan {
namespace {

using namespace test;

// A ball of clay or rubber in the studio, as it is shown.
struct Shown {
    float exposure = 0, mean = 0, most = 0; // of 255
};

Shown shown(Renderer& renderer, float color, float lamp)
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
    Shown result;
    result.exposure = *meterExposure(renderer, view);
    view.exposure = result.exposure;
    view.background = false;
    const auto picture = renderer.draw(view);
    int count = 0;
    for (std::size_t i = 0; picture && i < picture->pixelCount(); ++i) {
        const std::uint8_t* p = picture->bytes8() + 4 * i;
        if (p[3] < 255)
            continue;
        result.mean += p[1];
        result.most = std::max(result.most, float(p[1]));
        ++count;
    }
    result.mean /= float(count);
    return result;
}

TEST(Exposure, whiteClayIsBrightAndNotBurntOutAndRubberStaysBlack)
{
    std::vector<float> exposures;
    for (const auto& renderer : painters()) {
        const Shown clay = shown(*renderer, 0.9f, 3), grey = shown(*renderer, 0.2f, 3),
                    rubber = shown(*renderer, 0.02f, 3);
        EXPECT_LT(clay.most, 252) << renderer->device();
        EXPECT_GT(clay.mean, 165) << renderer->device();
        EXPECT_LT(rubber.mean, 75) << renderer->device();
        EXPECT_GT(rubber.mean, 25) << renderer->device();
        EXPECT_LT(clay.exposure, grey.exposure);
        EXPECT_LT(grey.exposure, rubber.exposure);
        // A thousand times the light is no other picture; a hundredth is one of what the studio still gives.
        const Shown flooded = shown(*renderer, 0.9f, 3000);
        EXPECT_LT(flooded.most, 255) << renderer->device();
        EXPECT_GT(flooded.mean, 60) << renderer->device();
        exposures.push_back(clay.exposure);
    }
    EXPECT_NEAR(exposures.front(), exposures.back(), 0.023f * exposures.front()); // a 32nd of a stop
}

TEST(Exposure, ofNothingIsOne)
{
    const Scene nothing;
    for (const auto& renderer : painters()) {
        ASSERT_TRUE(renderer->load(nothing));
        EXPECT_EQ(*meterExposure(*renderer, sunnyView()), 1);
    }
}

} // namespace
} // namespace cotan
