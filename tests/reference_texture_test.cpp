// Texture reads of the reference renderer, through unlit materials.
#include <algorithm>

#include "reference_scene.hpp"

using namespace cotan;
using namespace cotan::testing;

namespace {

// An orthographic view in which the unit square of uv covers exactly 64 x 64 pixels.
View squareView()
{
    View view = viewOf(Output::shaded);
    view.camera.orthographic = true;
    view.camera.verticalExtent = 2;
    view.linearOutput = true;
    view.background = false;
    view.samples = 1;
    return view;
}

// The image on an unlit square. Float images are linear, so their values are output unchanged.
Scene textured(Image image)
{
    Scene scene = sceneOf(meshOf(kSquare));
    scene.images.push_back(std::move(image));
    scene.materials[0].unlit = true;
    scene.materials[0].baseColorMap.image = 0;
    return scene;
}

Image ramp(int width, int height)
{
    Image image = makeImage(width, height, PixelType::float32);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            float* p = image.floats() + 4 * (y * width + x);
            p[0] = float(x);
            p[1] = float(y);
            p[3] = 1;
        }
    return image;
}

Image checker(int size)
{
    Image image = makeImage(size, size, PixelType::unorm8);
    for (int i = 0; i < size * size; ++i)
        for (int c = 0; c < 4; ++c)
            image.bytes8()[4 * i + c] = (c == 3 || (i % size + i / size) % 2) ? 255 : 0;
    return image;
}

} // namespace

TEST(ReferenceTexture, pointSamplingReadsTheTexelUnderThePixel)
{
    Scene scene = textured(ramp(32, 16));
    View view = squareView();
    view.pointSampled = true;
    int count = forCovered(rendered(scene, view),
                           [](int x, int y, glm::vec4 value) { ASSERT_EQ(value, glm::vec4(x / 2, y / 4, 0, 1)); });
    EXPECT_EQ(count, 64 * 64);
}

TEST(ReferenceTexture, bilinearFilterInterpolatesBetweenTexelCentres)
{
    Scene scene = textured(ramp(8, 8));
    scene.materials[0].baseColorMap.sampler.wrapU = Wrap::clamp;
    scene.materials[0].baseColorMap.sampler.wrapV = Wrap::clamp;
    forCovered(rendered(scene, squareView()), [](int x, int y, glm::vec4 value) {
        // Texel centres are at half-integers of an 8-texel image.
        ASSERT_NEAR(value.x, std::clamp((x + 0.5) / 8 - 0.5, 0.0, 7.0), 1e-5);
        ASSERT_NEAR(value.y, std::clamp((y + 0.5) / 8 - 0.5, 0.0, 7.0), 1e-5);
    });
}

TEST(ReferenceTexture, wrapModesRepeatMirrorAndClamp)
{
    for (Wrap wrap : {Wrap::repeat, Wrap::mirror, Wrap::clamp}) {
        Scene scene = textured(ramp(8, 8));
        Texture& texture = scene.materials[0].baseColorMap;
        texture.sampler.wrapU = wrap;
        texture.uRow = {4, 0, -2}; // u from -2 to 2: sixteen pixels for each unit
        View view = squareView();
        view.pointSampled = true;
        Image image = rendered(scene, view);
        for (int x = 0; x < 64; ++x) {
            int texel = x / 2, in = texel % 8; // texel -16 .. 15, counted from 0
            int expected = wrap == Wrap::repeat ? in
                : wrap == Wrap::mirror          ? (texel / 8 % 2 ? 7 - in : in)
                                                : std::clamp(texel - 16, 0, 7);
            EXPECT_EQ(pixelOf(image, x, 20).x, float(expected)) << x;
        }
    }
}

TEST(ReferenceTexture, minifiedCheckerAveragesLightNotBytes)
{
    // 512 texels on 64 pixels: level 3, where black and white were averaged in linear light.
    Scene scene = textured(checker(512));
    forCovered(rendered(scene, squareView()), [](int, int, glm::vec4 value) {
        ASSERT_NEAR(value.x, 0.5f, 0.003f); // the levels are bytes: half a step of sRGB at 0.5
    });
}

TEST(ReferenceTexture, withoutMipsMinificationAliases)
{
    Scene scene = textured(checker(512));
    scene.materials[0].baseColorMap.sampler.mip = MipFilter::none;
    scene.materials[0].baseColorMap.sampler.minify = Filter::nearest;
    forCovered(rendered(scene, squareView()),
               [](int, int, glm::vec4 value) { ASSERT_TRUE(value.x == 0 || value.x == 1); });
}

TEST(ReferenceTexture, oddSizesKeepTheirMeanInTheMipChain)
{
    // 45 -> 22 -> 11 -> 5 -> 2 -> 1: each level weights every texel by the area that it covers.
    Scene scene = textured(ramp(45, 45));
    scene.materials[0].baseColorMap.uRow = {6400, 0, 0};
    scene.materials[0].baseColorMap.vRow = {0, 6400, 0};
    forCovered(rendered(scene, squareView()), [](int, int, glm::vec4 value) {
        ASSERT_NEAR(value.x, 22, 1e-3);
        ASSERT_NEAR(value.y, 22, 1e-3);
    });
}

TEST(ReferenceTexture, anisotropicFootprintsStaySharpAcrossTheNarrowSide)
{
    // Stripes along v, with v compressed eightfold: one texel per pixel across, eight along. An isotropic filter would
    // average the stripes away.
    Image stripes = makeImage(64, 512, PixelType::float32);
    for (int i = 0; i < 64 * 512; ++i) {
        stripes.floats()[4 * i] = float(i % 64 % 2);
        stripes.floats()[4 * i + 3] = 1;
    }
    forCovered(rendered(textured(stripes), squareView()),
               [](int x, int, glm::vec4 value) { ASSERT_NEAR(value.x, float(x % 2), 1e-4); });
}

TEST(ReferenceTexture, normalMapLevelsAverageVectorsAndStayUnit)
{
    // Texels tilted by 45 degrees to either side average to the plain normal.
    Scene scene = sceneOf(meshOf(kSquare));
    Image map = makeImage(512, 512, PixelType::unorm8);
    for (int i = 0; i < 512 * 512; ++i) {
        const int bytes[4] = {i % 2 ? 218 : 38, 128, 218, 255};
        for (int c = 0; c < 4; ++c)
            map.bytes8()[4 * i + c] = std::uint8_t(bytes[c]);
    }
    scene.images.push_back(map);
    scene.materials[0].normalMap.image = 0;
    View view = squareView();
    view.output = Output::normal;
    forCovered(rendered(scene, view), [](int, int, glm::vec4 value) {
        ASSERT_LT(degreesBetween(glm::vec3(value), {0, 0, 1}), 0.25); // half a byte of x
    });
    view.pointSampled = true;
    forCovered(rendered(scene, view),
               [](int, int, glm::vec4 value) { ASSERT_NEAR(std::abs(value.x), std::sqrt(0.5), 1e-6); });
}

TEST(ReferenceTexture, sixteenBitColoursAreDecodedFromSrgb)
{
    Image image = makeImage(2, 2, PixelType::unorm16);
    for (int i = 0; i < 16; ++i)
        image.words()[i] = i % 4 == 3 ? 65535 : 30000;
    double expected = std::pow((30000.0 / 65535 + 0.055) / 1.055, 2.4);
    EXPECT_NEAR(pixelOf(rendered(textured(image), squareView()), 30, 30).x, expected, 1e-6);
}
