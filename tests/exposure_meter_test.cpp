// What automatic exposure requests from a renderer and computes from its image, and what all renderers have in common:
// tested with a renderer that returns a given image.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "cotan/render.hpp"
#include "cotan/view.hpp"

namespace cotan {
namespace {

struct FakeRenderer final : Renderer {
    std::string device() const override { return "painter"; }
    Image nextImage = makeImage(1, 1, PixelType::unorm8);
    Status loads = Done{};
    View requested; // by the last draw
    int draws = 0;
    std::vector<bool> sameImages; // of each load

private:
    Status loadScene(const Scene&, bool same) override
    {
        sameImages.push_back(same);
        return loads;
    }
    Result<Image> drawLoaded(const View& view) override
    {
        requested = view;
        ++draws;
        return nextImage;
    }
};

using Texel = std::array<int, 4>;

// An image with the given number of pixels of each colour.
Image pixels(const std::vector<std::pair<int, Texel>>& colors)
{
    int count = 0;
    for (const auto& [n, color] : colors)
        count += n;
    Image image = makeImage(count, 1, PixelType::unorm8);
    std::uint8_t* p = image.bytes8();
    for (const auto& [n, color] : colors)
        for (int i = 0; i < n; ++i)
            for (const int c : color)
                *p++ = std::uint8_t(c);
    return image;
}

float exposureOf(Image image)
{
    FakeRenderer painter;
    painter.nextImage = std::move(image);
    EXPECT_TRUE(painter.load(Scene()));
    View view;
    view.toneMapping = ToneMapping::none;
    const auto exposure = meterExposure(painter, view);
    EXPECT_TRUE(exposure);
    return exposure ? *exposure : 0;
}

// Light in front of a camera at exposure 1. The metering image has a quarter of it.
double lightOf(int code)
{
    const double c = code / 255.0;
    return 4 * (c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
}

// 35 % of the way from the mean to 0.2, in stops, within the limits for dark and bright scenes, and such that the
// brightest fiftieth is not clipped.
double expectedOf(double mean, double bright)
{
    const double target = std::clamp(std::pow(mean, 0.65) * std::pow(0.2, 0.35), 0.045, 0.45);
    return std::min(target / mean, 0.92 / bright);
}

// The exposure is rounded to 1/32 stop. Half a step is rounding, and a little more the table of the tone curve.
void expectExposure(const Image& image, double mean, double bright, const std::string& what)
{
    const double found = double(exposureOf(image)), steps = 32 * std::log2(found);
    EXPECT_NEAR(steps, std::round(steps), 1e-3) << what;
    EXPECT_NEAR(steps, 32 * std::log2(expectedOf(mean, bright)), 0.8) << what;
}

TEST(MeterExposure, isThatOfTheMeanUnlessTheBrightestTwoPercentClip)
{
    for (const int code : {2, 10, 30, 62, 90, 128, 180, 230, 254}) // from below the dark limit to above the bright one
        expectExposure(pixels({{10, {code, code, code, 255}}}), lightOf(code), lightOf(code), std::to_string(code));
    const double dark = lightOf(30), light = lightOf(220);
    const auto mean = [&](double fraction) { return std::pow(dark, 1 - fraction) * std::pow(light, fraction); };
    const Texel darkTexel{30, 30, 30, 255}, lightTexel{220, 220, 220, 255};
    expectExposure(pixels({{98, darkTexel}, {2, lightTexel}}), mean(0.02), light, "two of a hundred");
    expectExposure(pixels({{99, darkTexel}, {1, lightTexel}}), mean(0.01), dark, "one of a hundred");
    expectExposure(pixels({{3, lightTexel}, {97, darkTexel}}), mean(0.03), light, "in any order");
    // A pixel counts if the scene covers half of it.
    expectExposure(pixels({{50, {30, 30, 30, 128}}, {50, {220, 220, 220, 127}}}), dark, dark, "half covered");
    EXPECT_EQ(exposureOf(pixels({{50, {220, 220, 220, 127}}})), 1) << "nothing";
    // Black counts as 0.001.
    expectExposure(pixels({{50, {0, 0, 0, 255}}, {50, lightTexel}}), std::sqrt(1e-3 * light), light, "black");
}

TEST(MeterExposure, coloursAreWeightedByLuminance)
{
    const double full = lightOf(200);
    expectExposure(pixels({{9, {200, 0, 0, 255}}}), 0.2126 * full, 0.2126 * full, "red");
    expectExposure(pixels({{9, {0, 200, 0, 255}}}), 0.7152 * full, 0.7152 * full, "green");
    expectExposure(pixels({{9, {0, 0, 200, 255}}}), 0.0722 * full, 0.0722 * full, "blue");
}

// At most 20,000 pixels, with the aspect ratio of the image and nothing but the scene.
TEST(MeterExposure, rendersASmallImageOfTheSceneAlone)
{
    FakeRenderer painter;
    ASSERT_TRUE(painter.load(Scene()));
    for (const auto& [width, height, smallWidth, smallHeight] : {std::tuple(1280, 720, 188, 106),
                                                                 {200, 100, 200, 100},
                                                                 {201, 100, 200, 99},
                                                                 {1, 1, 1, 1},
                                                                 {16384, 2, 12800, 1},
                                                                 {2, 16384, 1, 12800}}) {
        View view;
        view.width = width;
        view.height = height;
        ASSERT_TRUE(meterExposure(painter, view));
        EXPECT_EQ(painter.requested.width, smallWidth) << width;
        EXPECT_EQ(painter.requested.height, smallHeight) << width;
    }
    for (const auto& [samples, requested] : {std::pair(1, 1), {4, 4}, {16, 4}}) {
        View view;
        view.samples = samples;
        view.output = Output::normal;
        view.linearOutput = view.dither = view.background = true;
        view.exposure = 7;
        view.ground = std::make_shared<GroundMap>();
        view.toneMapping = ToneMapping::agx;
        view.lights.resize(2);
        ASSERT_TRUE(meterExposure(painter, view));
        const View& small = painter.requested;
        EXPECT_EQ(small.samples, requested);
        EXPECT_EQ(small.output, Output::shaded);
        EXPECT_FALSE(small.linearOutput || small.dither || small.background || small.ground);
        EXPECT_EQ(small.exposure, 0.25f);
        EXPECT_EQ(small.toneMapping, ToneMapping::agx);
        EXPECT_EQ(small.lights.size(), 2u);
    }
}

TEST(Renderer, drawsOnlyALoadedSceneAndKeepsImagesOfSuccessfulLoads)
{
    FakeRenderer painter;
    const View view;
    const auto none = painter.draw(view);
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().kind, ErrorKind::usage);
    EXPECT_EQ(none.error().message, "draw: no scene is loaded");
    EXPECT_TRUE(painter.load(Scene(), true)); // there were no images to keep
    EXPECT_TRUE(painter.draw(view));
    EXPECT_TRUE(painter.load(Scene(), true));
    EXPECT_TRUE(painter.load(Scene()));
    painter.loads = unavailableError("no room");
    EXPECT_FALSE(painter.load(Scene(), true));
    EXPECT_FALSE(painter.draw(view));
    painter.loads = Done{};
    EXPECT_TRUE(painter.load(Scene(), true));
    EXPECT_EQ(painter.sameImages, (std::vector<bool>{false, true, false, true, false}));
    painter.forget();
    EXPECT_FALSE(painter.draw(view));
    EXPECT_TRUE(painter.load(Scene(), true));
    EXPECT_TRUE(painter.sameImages.back()) << "they are still there";
    Scene broken;
    broken.instances.push_back({"", 3, glm::mat4(1)});
    const Status refused = painter.load(broken);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().message, "scene: instance 0: expected a mesh below 0, found 3");
    EXPECT_EQ(painter.sameImages.size(), 6u) << "nobody was asked to load it";
    ASSERT_TRUE(painter.load(Scene()));
    const int before = painter.draws;
    std::vector<double> reported;
    painter.progress = [&](double fraction) {
        reported.push_back(fraction);
        return false;
    };
    const auto stopped = painter.draw(view);
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().kind, ErrorKind::stopped);
    EXPECT_EQ(reported, std::vector<double>{0});
    EXPECT_EQ(painter.draws, before);
}

} // namespace
} // namespace cotan
