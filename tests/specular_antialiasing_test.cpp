// Highlights that are smaller than a pixel: pictures of a sample a pixel, with and without, against 256 samples a
// pixel.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include <glm/geometric.hpp>

#include "cotan/portable.hpp"
#include "cotan/render.hpp"
#include "cotan/scene.hpp"
#include "scene/picture_text.hpp"
#include "truth/grain.hpp"

namespace cotan::test {
namespace {

constexpr int kSide = 64, kFiner = 16; // pixels, and samples a side of one

Scene shiny(Mesh mesh, float roughness, bool mapped)
{
    Scene scene;
    scene.materials.emplace_back();
    scene.materials[0].metallic = 1;
    scene.materials[0].roughness = roughness;
    scene.materials[0].baseColor = {0.9f, 0.9f, 0.9f, 1};
    if (mapped) {
        scene.images.push_back(makeGrain(0.45));
        scene.materials[0].normalMap.image = 0;
    }
    scene.meshes.push_back(std::move(mesh));
    scene.instances.push_back({"", 0, glm::mat4(1)});
    return scene;
}

View sunlit(int side)
{
    View view;
    view.width = view.height = side;
    view.samples = 1;
    view.linearOutput = true;
    view.background = false;
    view.camera.eye = {0.4f, 1.6f, 3};
    view.camera.target = {0, 0, 0};
    Light sun;
    sun.kind = LightKind::directional;
    sun.direction = glm::normalize(glm::vec3(-0.5f, -1, -0.6f));
    sun.intensity = 3;
    view.lights = {sun};
    view.shadows = false;
    return view;
}

Image drawn(const Scene& scene, const View& view)
{
    auto image = renderReference(scene, view);
    EXPECT_TRUE(image) << image.error().message;
    return std::move(*image);
}

glm::vec3 shown(glm::vec3 linear) { return f32::cotan_tone_of(int(ToneMapping::neutral), linear); }

// The mean of kFiner * kFiner pixels each.
Image averaged(const Image& fine)
{
    Image out = makeImage(kSide, kSide, PixelType::float32);
    for (int y = 0; y < fine.height; ++y)
        for (int x = 0; x < fine.width; ++x)
            for (int c = 0; c < 4; ++c)
                out.floats()[(std::size_t(y / kFiner) * kSide + std::size_t(x / kFiner)) * 4 + std::size_t(c)] +=
                    fine.floats()[(std::size_t(y) * std::size_t(fine.width) + std::size_t(x)) * 4 + std::size_t(c)]
                    / float(kFiner * kFiner);
    return out;
}

// Root of the mean square of what is shown, over pixels that are covered whole.
double error(const Image& picture, const Image& truth)
{
    double sum = 0;
    int count = 0;
    for (std::size_t i = 0; i < truth.pixelCount(); ++i) {
        const float* const a = picture.floats() + 4 * i;
        const float* const b = truth.floats() + 4 * i;
        if (b[3] < 0.999f)
            continue;
        const glm::vec3 d = shown({a[0], a[1], a[2]}) - shown({b[0], b[1], b[2]});
        sum += glm::dot(d, d) / 3;
        ++count;
    }
    EXPECT_GT(count, 500);
    return std::sqrt(sum / count);
}

struct Errors {
    double without = 0, with = 0;
};

Errors errorsOf(const Scene& scene, bool environment = true)
{
    View fine = sunlit(kSide * kFiner), view = sunlit(kSide);
    fine.environment = view.environment = environment;
    Scene finest = scene; // smaller levels of the map have lost the spread that is looked for
    for (Material& material : finest.materials)
        material.normalMap.sampler.mip = MipFilter::none;
    const Image truth = averaged(drawn(finest, fine));
    Errors e;
    e.without = error(drawn(scene, view), truth);
    view.specularAntialiasing = true;
    e.with = error(drawn(scene, view), truth);
    return e;
}

// What is measured is in docs/explanation/lighting.md, with what no method can do that knows only statistics.
TEST(SpecularAntialiasing, halvesTheErrorOfGrainAndDomesInSurroundings)
{
    for (const float repeat : {1.0f, 3.0f, 8.0f}) {
        const auto torus = [&] { return makeTorus(0.8f, 0.35f, 96, 4 * repeat, repeat); };
        const Errors grain = errorsOf(shiny(torus(), 0.35f, true));
        EXPECT_LT(grain.with, 0.5 * grain.without) << repeat;
        EXPECT_GT(grain.without, 0.05) << "there is nothing to see";
        Scene scene = shiny(torus(), 0.35f, true);
        scene.images[0] = makeReliefMap(Relief::domes, 256);
        const Errors domes = errorsOf(scene);
        EXPECT_LT(domes.with, 0.5 * domes.without) << repeat;
    }
}

TEST(SpecularAntialiasing, lightsTheMorePlacesTheSharperAndFourASideAtLeastAndSixteenAtMost)
{
    EXPECT_EQ(f32::cotan_places_of_roughness(1), 4);
    EXPECT_EQ(f32::cotan_places_of_roughness(0), 16);
    EXPECT_EQ(std::floor(f32::cotan_places_of_roughness(0.35f)), 4);
    EXPECT_EQ(std::floor(f32::cotan_places_of_roughness(0.2f)), 8);
    EXPECT_EQ(std::floor(f32::cotan_places_of_roughness(0.125f)), 12);
}

// What lies between few places: a highlight of half a degree. The ring turns by several degrees in a pixel, too.
TEST(SpecularAntialiasing, takesTwoThirdsOfTheErrorOfSharpHighlightsWhereSomeTexelsAreInAPixel)
{
    for (const bool domes : {false, true}) {
        Scene scene = shiny(makeTorus(0.8f, 0.35f, 96, 4, 1), 0.1f, true);
        scene.images[0] = domes ? makeReliefMap(Relief::domes, 256) : makeGrain(0.135);
        const Errors e = errorsOf(scene);
        EXPECT_LT(e.with, 0.33 * e.without) << domes;
        EXPECT_GT(e.without, 0.05) << "there is nothing to see";
    }
}

TEST(SpecularAntialiasing, takesAQuarterOfTheErrorOfASmallLampsGrainAtLeast)
{
    for (const float repeat : {3.0f, 8.0f}) {
        const Scene scene = shiny(makeTorus(0.8f, 0.35f, 96, 4 * repeat, repeat), 0.35f, true);
        const Errors e = errorsOf(scene, /*environment=*/false);
        EXPECT_LT(e.with, 0.75 * e.without) << repeat;
    }
}

// A ball that turns by 3 degrees a pixel needs next to nothing.
TEST(SpecularAntialiasing, leavesWhatIsWideEnoughAlone)
{
    EXPECT_LT(errorsOf(shiny(makeSphere(0.9f, 96), 0.35f, false)).with, 0.003); // less than a step of 8 bits
}

// Texels that lean by turns: seen from afar, every level but the first is one direction, of one length.
Image leaning()
{
    Image image = makeImage(256, 256, PixelType::unorm8);
    for (int i = 0; i < 256 * 256; ++i) {
        const int bytes[4] = {(i + i / 256) % 2 ? 178 : 78, 128, 128 + 117, 3}; // an alpha that means nothing
        for (int c = 0; c < 4; ++c)
            image.bytes8()[4 * i + c] = std::uint8_t(bytes[c]);
    }
    return image;
}

// Over all pixels, of what is shown.
double apart(const Image& a, const Image& b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.pixelCount(); ++i)
        for (std::size_t c = 0; c < 3; ++c)
            sum += std::abs(f32::cotan_tone(a.floats()[4 * i + c]) - f32::cotan_tone(b.floats()[4 * i + c]));
    return sum / double(3 * a.pixelCount());
}

TEST(SpecularAntialiasing, isTheSameOnTheDevice)
{
    auto device = openRenderer("auto");
    if (!device || !(*device)->note.empty())
        GTEST_SKIP() << "no Vulkan device";
    struct Case {
        bool mapped;
        MipFilter mip;
        double most; // of what the option changes
    };
    // With levels the reference filters along the longer side of a pixel, which Mesa's CPU driver is not asked to.
    for (const Case& c : {Case{false, MipFilter::linear, 0.001}, Case{true, MipFilter::none, 0.005},
                          Case{true, MipFilter::linear, 0.3}}) {
        Scene scene = shiny(makeTorus(0.8f, 0.35f, 96, 32, 8), 0.2f, c.mapped);
        if (c.mapped)
            scene.images[0] = leaning();
        scene.materials[0].normalMap.sampler.mip = c.mip;
        scene.materials[0].coat.strength = 0.5f;
        scene.materials[0].coat.roughness = 0.1f;
        scene.materials[0].coat.normalMap.image = c.mapped ? 0 : -1;
        View view = sunlit(128);
        ASSERT_TRUE((*device)->load(scene));
        const Image without = drawn(scene, view);
        view.specularAntialiasing = true;
        const Image ours = drawn(scene, view);
        auto theirs = (*device)->draw(view);
        ASSERT_TRUE(theirs) << theirs.error().message;
        EXPECT_GT(apart(ours, without), 0.001) << c.most;
        EXPECT_LT(apart(ours, *theirs), c.most * apart(ours, without)) << c.mapped;
    }
}

// Domes of some texels a pixel, and a highlight of half a degree: a place whose normal is turned the wrong way is seen.
TEST(SpecularAntialiasing, turnsEachPlaceWithTheSurfaceOnTheDeviceToo)
{
    auto device = openRenderer("auto");
    if (!device || !(*device)->note.empty())
        GTEST_SKIP() << "no Vulkan device";
    Scene scene = shiny(makeTorus(0.8f, 0.35f, 96, 4, 1), 0.1f, true);
    scene.images[0] = makeReliefMap(Relief::domes, 256);
    View view = sunlit(kSide);
    ASSERT_TRUE((*device)->load(scene));
    const Image without = drawn(scene, view);
    view.specularAntialiasing = true;
    const Image ours = drawn(scene, view);
    auto theirs = (*device)->draw(view);
    ASSERT_TRUE(theirs) << theirs.error().message;
    EXPECT_GT(apart(ours, without), 0.005) << "there is nothing to see";
    EXPECT_LT(apart(ours, *theirs), 0.05 * apart(ours, without)); // 0.009; turned along y only: 0.16
}

} // namespace
} // namespace cotan::test
