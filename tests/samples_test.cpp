// Sample patterns, shading of every sample, and dithering of 8-bit output against banding.
#include "scene/sample_positions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <set>

#include "cotan/inspect.hpp"
#include "cotan/view.hpp"
#include "ground_scene.hpp"

namespace cotan {
namespace {

using namespace test;

TEST(SamplePositions, formANetInEveryDivision)
{
    for (int columns = 1; columns <= 16; columns *= 2) {
        std::set<std::pair<int, int>> parts;
        for (int i = 0; i < kSampleCount; ++i) {
            const glm::dvec2 p = samplePosition(i) + 0.5;
            parts.insert({int(p.x * columns), int(p.y * 16 / columns)});
        }
        EXPECT_EQ(parts.size(), 16u) << columns;
    }
    double nearest = 1;
    for (int i = 0; i < kSampleCount; ++i)
        for (int k = 0; k < i; ++k) {
            const glm::dvec2 apart = samplePosition(i) - samplePosition(k);
            nearest = std::min(nearest, glm::length(apart - glm::round(apart))); // or of neighbours
        }
    EXPECT_NEAR(nearest, 0.198, 0.001);
}

// An unlit scene without background or environment, in linear output.
View flatView(int samples)
{
    View view;
    view.width = view.height = 64;
    view.samples = samples;
    view.background = false;
    view.linearOutput = true;
    view.environment = false;
    view.camera.orthographic = true;
    view.camera.verticalExtent = 3;
    return view;
}

Scene tiltedSquare(float radians)
{
    Scene scene;
    const float c = std::cos(radians), s = std::sin(radians);
    add(scene, makePlane(2, 1, 1), glm::mat4({c, s, 0, 0}, {0, 0, 1, 0}, {s, -c, 0, 0}, {0, 0, 0, 1}));
    scene.materials[0].unlit = true;
    scene.materials[0].doubleSided = true;
    return scene;
}

// Maximum difference between the alpha of a pixel and the area of the square in it, which 32 x 32 points estimate.
double worstCoverage(const Image& image, float radians)
{
    const double c = std::cos(radians), s = std::sin(radians);
    double worst = 0;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            int inside = 0;
            for (int i = 0; i < 32 * 32; ++i) {
                const double px = (x + (i % 32 + 0.5) / 32 - 32) * 3 / 64;
                const double py = -(y + (i / 32 + 0.5) / 32 - 32) * 3 / 64;
                inside += std::abs(px * c + py * s) < 1 && std::abs(px * s - py * c) < 1;
            }
            const double alpha = image.floats()[4 * (64 * y + x) + 3];
            worst = std::max(worst, std::abs(alpha - inside / 1024.0));
        }
    return worst;
}

// The coverage that a net of 16 samples gives errs by below 2/16 for a half-plane, and by below 4/16 for a corner.
TEST(Samples, sixteenApproximateTheCoveredArea)
{
    for (const auto& renderer : renderers())
        for (const float radians : {0.0f, 0.1f, 0.4f, 0.785f}) {
            const Scene scene = tiltedSquare(radians);
            ASSERT_TRUE(renderer->load(scene));
            const auto sixteen = renderer->draw(flatView(16)), one = renderer->draw(flatView(1));
            ASSERT_TRUE(sixteen && one);
            EXPECT_LT(worstCoverage(*sixteen, radians), 0.14) << renderer->device() << " " << radians;
            EXPECT_GT(worstCoverage(*one, radians), 0.3) << renderer->device() << " " << radians;
        }
}

// A polished metal ball with fine grooves, similar to the BoomBox model.
Scene groovedBall()
{
    Scene scene;
    add(scene, makeSphere(1, 96), glm::mat4(1));
    scene.images.push_back(makeReliefMap(Relief::waves, 512));
    Material& material = scene.materials[0];
    material.normalMap.image = 0;
    material.normalMap.uRow = {12, 0, 0};
    material.normalMap.vRow = {0, 6, 0};
    material.metallic = 1;
    material.roughness = 0.08f;
    return scene;
}

View studioView(int side, int samples)
{
    static const auto studio = std::make_shared<const EnvironmentMap>(makeEnvironment(*builtinRadiance("studio"), 1));
    View view = sunnyView();
    view.environment = true;
    view.environmentMap = studio;
    view.width = view.height = side;
    view.samples = samples;
    view.linearOutput = true;
    view.backdrop = Backdrop::paper;
    view.shadowSoftness = 0.08f;
    view.camera.eye = {0, 0.6f, 4};
    view.camera.verticalFieldOfView = 0.6f;
    return view;
}

// RMS difference of sRGB values clamped to [0,1]; in linear light a few bright edges would dominate.
double displayedDifference(const Image& a, const Image& b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.pixelCount() * 4; ++i) {
        const auto displayed = [](float x) { return f32::cotan_linear_to_srgb(f32::cotan_saturate(x)); };
        const double d = displayed(a.floats()[i]) - displayed(b.floats()[i]);
        sum += d * d;
    }
    return std::sqrt(sum / (double(a.pixelCount()) * 3));
}

Image quarter(const Image& large)
{
    Image small = makeImage(large.width / 4, large.height / 4, PixelType::float32, "quarter");
    for (int y = 0; y < large.height; ++y)
        for (int x = 0; x < large.width; ++x)
            for (int c = 0; c < 4; ++c)
                small.floats()[4 * (small.width * (y / 4) + x / 4) + c] +=
                    large.floats()[4 * (large.width * y + x) + c] / 16;
    return small;
}

// The reference is 256 samples a pixel: a render four times as wide and high with 16 samples in each pixel.
TEST(Samples, sixteenResolveHighlightsThatFourAlias)
{
    const Scene scene = groovedBall();
    for (const auto& renderer : renderers()) {
        ASSERT_TRUE(renderer->load(scene));
        const auto large = renderer->draw(studioView(256, 16));
        const auto four = renderer->draw(studioView(64, 4)), sixteen = renderer->draw(studioView(64, 16));
        ASSERT_TRUE(large && four && sixteen);
        const Image truth = quarter(*large);
        const double before = displayedDifference(*four, truth), after = displayedDifference(*sixteen, truth);
        EXPECT_GT(before, 0.05) << renderer->device();
        EXPECT_LT(after, 0.35 * before) << renderer->device() << " " << before << " " << after;
    }
}

TEST(Samples, bothRenderersAgreeAtSixteen)
{
    const auto all = renderers();
    if (all.size() < 2)
        GTEST_SKIP() << "no Vulkan device";
    Scene scene = groovedBall();
    add(scene, makeTorus(0.9f, 0.2f, 48, 1, 1), translationScale({0, -0.3, 0.9}, glm::dvec3(1)));
    scene.materials.resize(2);
    scene.materials[1].alphaMode = AlphaMode::blend;
    scene.materials[1].baseColor = {0.2f, 0.8f, 0.3f, 0.5f};
    scene.meshes.back().material = 1;
    for (const auto& renderer : all)
        ASSERT_TRUE(renderer->load(scene));
    for (const bool orthographic : {false, true})
        for (const bool upward : {false, true}) {
            View view = studioView(120, 16);
            view.camera.orthographic = orthographic;
            view.camera.verticalExtent = 3;
            view.linearOutput = false;
            view.rowsUpward = upward;
            const auto a = all[0]->draw(view), b = all[1]->draw(view);
            ASSERT_TRUE(a && b);
            double sum = 0;
            for (std::size_t i = 0; i < a->data.size(); ++i)
                sum += std::abs(int(a->bytes8()[i]) - int(b->bytes8()[i]));
            EXPECT_LT(sum / double(a->data.size()), 0.5) << orthographic << upward; // in 8-bit levels
        }
}

View paperView(bool dither)
{
    View view;
    view.width = view.height = 256;
    view.backdrop = Backdrop::paper;
    view.toneMapping = ToneMapping::none;
    view.dither = dither;
    view.camera.eye = {0, 0, 5};
    view.camera.verticalFieldOfView = 0.08f; // about two 8-bit levels from bottom to top
    return view;
}

// Maximum error of the mean of a 16 x 16 block against the render that is not quantized, in 8-bit levels.
double worstBlock(const Image& bytes, const Image& light)
{
    double worst = 0;
    for (int y = 0; y < 256; y += 16)
        for (int x = 0; x < 256; x += 16)
            for (int c = 0; c < 3; ++c) {
                double error = 0;
                for (int i = 0; i < 256; ++i) {
                    const int at = 4 * (256 * (y + i / 16) + x + i % 16) + c;
                    error += bytes.bytes8()[at] - 255.0 * f32::cotan_linear_to_srgb(light.floats()[at]);
                }
                worst = std::max(worst, std::abs(error) / 256);
            }
    return worst;
}

// Quantization to 8 bits errs by half a level over whole bands. Dithering keeps the mean of every block.
TEST(Dithering, preventsBandingOfPaper)
{
    for (const auto& renderer : renderers())
        for (const int samples : {1, 4, 16})
            for (const bool model : {false, true}) {
                Scene scene;
                // Paper is drawn together with a model inside the model's area, and on its own elsewhere.
                for (const double at : {-1.0, 1.0})
                    if (model)
                        add(scene, makeCube(1e-4f, 1), translationScale({at, at, 0}, glm::dvec3(1)));
                ASSERT_TRUE(renderer->load(scene));
                View view = paperView(true), plain = paperView(false), light = paperView(true);
                view.samples = plain.samples = light.samples = samples;
                light.linearOutput = true;
                const auto dithered = renderer->draw(view), banded = renderer->draw(plain),
                           truth = renderer->draw(light);
                ASSERT_TRUE(dithered && banded && truth);
                EXPECT_LT(worstBlock(*dithered, *truth), 0.1) << renderer->device() << samples;
                EXPECT_GT(worstBlock(*banded, *truth), 0.25) << renderer->device() << samples;
            }
}

TEST(Dithering, doesNotDependOnTheNumberOfThreads)
{
    const auto one = openRenderer("reference", 1), two = openRenderer("reference", 2);
    ASSERT_TRUE(one && two);
    const Scene scene = sceneOf({});
    ASSERT_TRUE((*one)->load(scene) && (*two)->load(scene));
    for (const int samples : {4, 16}) {
        View view = paperView(true);
        view.samples = samples;
        const auto a = (*one)->draw(view), b = (*two)->draw(view);
        ASSERT_TRUE(a && b);
        EXPECT_EQ(a->data, b->data);
    }
}

// Flat colours that 8 bits represent exactly stay unchanged, and so do outputs that are data, such as normals.
TEST(Dithering, leavesFlatColoursAndDataUnchanged)
{
    for (const auto& renderer : renderers()) {
        Scene scene = tiltedSquare(0);
        const float level = f32::cotan_srgb_to_linear(77 / 255.0f);
        scene.materials[0].baseColor = {level, level, level, 1};
        ASSERT_TRUE(renderer->load(scene));
        View view = flatView(4);
        view.linearOutput = false;
        view.toneMapping = ToneMapping::none;
        const auto image = renderer->draw(view);
        ASSERT_TRUE(image);
        int covered = 0;
        for (std::size_t i = 0; i < image->pixelCount(); ++i) {
            const std::uint8_t* p = image->bytes8() + 4 * i;
            if (p[3] < 255)
                continue;
            ++covered;
            ASSERT_TRUE(p[0] == 77 && p[1] == 77 && p[2] == 77) << renderer->device() << int(p[0]);
        }
        EXPECT_GT(covered, 1000);
        View normals = flatView(4), still = normals;
        normals.output = still.output = Output::normal;
        still.dither = false;
        EXPECT_EQ(renderer->draw(normals)->data, renderer->draw(still)->data);
    }
    EXPECT_FALSE(inspectionView(View()).dither);
}

} // namespace
} // namespace cotan
