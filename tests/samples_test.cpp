// Samples that are lit one by one, and levels of 8 bits that do not band.
#include "scene/sample_places.hpp"

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

TEST(SamplePlaces, everySixteenthOfAPixelHasOneHoweverItIsCut)
{
    for (int columns = 1; columns <= 16; columns *= 2) {
        std::set<std::pair<int, int>> parts;
        for (int i = 0; i < kPlaces; ++i) {
            const glm::dvec2 p = samplePlace(i) + 0.5;
            parts.insert({int(p.x * columns), int(p.y * 16 / columns)});
        }
        EXPECT_EQ(parts.size(), 16u) << columns;
    }
    double nearest = 1;
    for (int i = 0; i < kPlaces; ++i)
        for (int k = 0; k < i; ++k) {
            const glm::dvec2 apart = samplePlace(i) - samplePlace(k);
            nearest = std::min(nearest, glm::length(apart - glm::round(apart))); // also to those of the pixels beside
        }
    EXPECT_NEAR(nearest, 0.198, 0.001);
}

// A square without light of its own that is brighter than black, tilted, before nothing.
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

// Alpha of a pixel against the area of the square in it, by 32 x 32 points.
double worstCoverage(const Image& picture, float radians)
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
            const double alpha = picture.floats()[4 * (64 * y + x) + 3];
            worst = std::max(worst, std::abs(alpha - inside / 1024.0));
        }
    return worst;
}

// A half-plane is off by less than two of the sixteen places of a net, and a corner by four.
TEST(Samples, sixteenCoverWhatATriangleCovers)
{
    for (const auto& renderer : painters())
        for (const float radians : {0.0f, 0.1f, 0.4f, 0.785f}) {
            const Scene scene = tiltedSquare(radians);
            ASSERT_TRUE(renderer->load(scene));
            const auto sixteen = renderer->draw(flatView(16)), one = renderer->draw(flatView(1));
            ASSERT_TRUE(sixteen && one);
            EXPECT_LT(worstCoverage(*sixteen, radians), 0.14) << renderer->device() << " " << radians;
            EXPECT_GT(worstCoverage(*one, radians), 0.3) << renderer->device() << " " << radians;
        }
}

// A polished metal ball with fine grooves, as BoomBox has.
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

// What is shown of the light: edges of bright places would count for all otherwise.
double shownDifference(const Image& a, const Image& b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.pixelCount() * 4; ++i) {
        const auto shown = [](float x) { return f32::cotan_linear_to_srgb(f32::cotan_saturate(x)); };
        const double d = shown(a.floats()[i]) - shown(b.floats()[i]);
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

// Against 256 samples a pixel: the same drawn four times as wide and high, where each pixel has 16.
TEST(Samples, sixteenDrawTheHighlightsOfNearMirrorsThatFourDot)
{
    const Scene scene = groovedBall();
    for (const auto& renderer : painters()) {
        ASSERT_TRUE(renderer->load(scene));
        const auto large = renderer->draw(studioView(256, 16));
        const auto four = renderer->draw(studioView(64, 4)), sixteen = renderer->draw(studioView(64, 16));
        ASSERT_TRUE(large && four && sixteen);
        const Image truth = quarter(*large);
        const double before = shownDifference(*four, truth), after = shownDifference(*sixteen, truth);
        EXPECT_GT(before, 0.05) << renderer->device();
        EXPECT_LT(after, 0.35 * before) << renderer->device() << " " << before << " " << after;
    }
}

TEST(Samples, bothRenderersDrawSixteenAlike)
{
    const auto all = painters();
    if (all.size() < 2)
        GTEST_SKIP() << "no Vulkan device";
    Scene scene = groovedBall();
    add(scene, makeTorus(0.9f, 0.2f, 48, 1, 1), placedAt({0, -0.3, 0.9}, glm::dvec3(1)));
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
            EXPECT_LT(sum / double(a->data.size()), 0.5) << orthographic << upward; // levels
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
    view.camera.verticalFieldOfView = 0.08f; // two levels or so from bottom to top
    return view;
}

// How far means of 16 x 16 pixels are from what they would be without levels, in levels.
double worstBlock(const Image& bytes, const Image& light)
{
    double worst = 0;
    for (int y = 0; y < 256; y += 16)
        for (int x = 0; x < 256; x += 16)
            for (int c = 0; c < 3; ++c) {
                double off = 0;
                for (int i = 0; i < 256; ++i) {
                    const int at = 4 * (256 * (y + i / 16) + x + i % 16) + c;
                    off += bytes.bytes8()[at] - 255.0 * f32::cotan_linear_to_srgb(light.floats()[at]);
                }
                worst = std::max(worst, std::abs(off) / 256);
            }
    return worst;
}

// The steps of 8 bits are half a level off over whole bands; dithered, blocks keep their brightness.
TEST(Levels, paperDoesNotBand)
{
    for (const auto& renderer : painters())
        for (const int samples : {1, 4, 16})
            for (const bool model : {false, true}) {
                Scene scene;
                // In the area of a model the paper is drawn with it, and else by itself.
                for (const double at : {-1.0, 1.0})
                    if (model)
                        add(scene, makeCube(1e-4f, 1), placedAt({at, at, 0}, glm::dvec3(1)));
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

TEST(Levels, ofTheSamePictureAreTheSameForAnyNumberOfThreads)
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

// Colours of 8 bits that a picture shows as they are stay what they are, and so do pictures that tell numbers.
TEST(Levels, flatColoursAndDataAreNotDithered)
{
    for (const auto& renderer : painters()) {
        Scene scene = tiltedSquare(0);
        const float level = f32::cotan_srgb_to_linear(77 / 255.0f);
        scene.materials[0].baseColor = {level, level, level, 1};
        ASSERT_TRUE(renderer->load(scene));
        View view = flatView(4);
        view.linearOutput = false;
        view.toneMapping = ToneMapping::none;
        const auto picture = renderer->draw(view);
        ASSERT_TRUE(picture);
        int covered = 0;
        for (std::size_t i = 0; i < picture->pixelCount(); ++i) {
            const std::uint8_t* p = picture->bytes8() + 4 * i;
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
