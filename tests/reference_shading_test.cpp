// Materials, light and shadow of the reference renderer.
#include <algorithm>

#include "reference_scene.hpp"

using namespace cotan;
using namespace cotan::testing;

namespace {

View shadedView()
{
    View view = viewOf(Output::shaded);
    view.linearOutput = true;
    view.background = false;
    view.environment = false;
    return view;
}

Scene litScene(Mesh mesh)
{
    Scene scene = sceneOf(std::move(mesh));
    scene.materials[0].metallic = 0;
    return scene;
}

} // namespace

TEST(ReferenceShading, unlitShowsFactorTimesDecodedTexelTimesVertexColour)
{
    Mesh mesh = meshOf(kSquare);
    mesh.colors.assign(4, {0.5f, 1, 1, 1});
    Scene scene = sceneOf(mesh);
    scene.images.push_back(solidImage({188, 255, 0, 255}, 4));
    scene.materials[0].unlit = true;
    scene.materials[0].baseColor = {0.5f, 0.25f, 1, 1};
    scene.materials[0].baseColorMap.image = 0;
    glm::vec4 value = pixelOf(rendered(scene, shadedView()), 32, 32);
    // IEC 61966-2-1: ((188/255 + 0.055) / 1.055)^2.4
    double decoded = std::pow((188.0 / 255 + 0.055) / 1.055, 2.4);
    EXPECT_NEAR(value.x, 0.25 * decoded, 1e-6);
    EXPECT_NEAR(value.y, 0.25, 1e-6);
    EXPECT_EQ(value.z, 0);
    EXPECT_EQ(value.w, 1);
}

TEST(ReferenceShading, roughWhiteReflectsOneOverPiPlusSpecular)
{
    // Light, eye and normal coincide in the centre: diffuse (1 - F) / pi with F = 0.04, specular D V F with D = 1/pi
    // (alpha 1) and V = 1/4.
    Scene scene = litScene(meshOf(kSquare));
    View view = shadedView();
    view.shadows = false;
    view.lights.push_back({});
    view.lights[0].direction = {0, 0, -1};
    view.lights[0].intensity = 1;
    view.width = view.height = 65; // puts a pixel in the exact centre
    double expected = (0.96 + 0.04 / 4) / 3.14159265358979;
    EXPECT_NEAR(pixelOf(rendered(scene, view), 32, 32).x, expected, 1e-5);
    view.exposure = 2;
    EXPECT_NEAR(pixelOf(rendered(scene, view), 32, 32).x, 2 * expected, 2e-5);
}

// Incoming light is intensity times colour in each channel; it stays below the range that tone mapping compresses.
TEST(ReferenceShading, lightIsItsIntensityTimesItsColour)
{
    Scene scene = litScene(meshOf(kSquare));
    View view = shadedView();
    view.shadows = false;
    view.lights.push_back({});
    view.lights[0].direction = {0, 0, -1};
    view.lights[0].intensity = 1;
    const glm::vec4 one = pixelOf(rendered(scene, view), 32, 32);
    view.lights[0].intensity = 3;
    view.lights[0].color = {1, 0.5f, 0.25f};
    const glm::vec4 three = pixelOf(rendered(scene, view), 32, 32);
    EXPECT_NEAR(three.x, 3 * one.x, 1e-6);
    EXPECT_NEAR(three.y, 1.5 * one.y, 1e-6);
    EXPECT_NEAR(three.z, 0.75 * one.z, 1e-6);
}

// glTF: blue is metallic, green is roughness. Metals have no diffuse part, so a black metal reflects nothing head-on.
TEST(ReferenceShading, blueOfTheMapIsMetallicAndGreenIsRough)
{
    Scene scene = sceneOf(meshOf(kSquare));
    scene.materials[0].baseColor = {0, 0, 0, 1};
    scene.materials[0].metallicRoughnessMap.image = 0;
    View view = shadedView();
    view.shadows = false;
    view.lights.push_back({});
    view.lights[0].direction = {0, 0, -1};
    scene.images.push_back(solidImage({0, 255, 255, 255}, 4)); // metallic, rough
    const float metal = pixelOf(rendered(scene, view), 32, 32).x;
    EXPECT_NEAR(metal, 0, 1e-4f);                      // F0 is the base colour
    scene.images[0] = solidImage({0, 255, 0, 255}, 4); // not metallic, rough
    const float rough = pixelOf(rendered(scene, view), 32, 32).x;
    EXPECT_GT(rough, 0.005f);                         // F0 is 0.04
    scene.images[0] = solidImage({0, 64, 0, 255}, 4); // not metallic, smoother: a narrow highlight
    EXPECT_GT(pixelOf(rendered(scene, view), 32, 32).x, 4 * rough);
}

TEST(ReferenceShading, pointLightFallsOffWithTheSquareAndSpotsEndAtTheirCone)
{
    Scene scene = litScene(meshOf(kSquare));
    View view = shadedView();
    view.width = view.height = 65;
    view.lights.push_back({});
    Light& light = view.lights[0];
    light.kind = LightKind::point;
    light.direction = {0, 0, -1};
    light.position = {0, 0, 1};
    light.intensity = 1;
    float near = pixelOf(rendered(scene, view), 32, 32).x;
    light.position = {0, 0, 2};
    EXPECT_NEAR(pixelOf(rendered(scene, view), 32, 32).x, near / 4, 1e-5);
    light.kind = LightKind::spot;
    light.outerCone = 0.2f; // reaches 0.4 from the centre; 16 pixels are 0.83
    Image image = rendered(scene, view);
    EXPECT_NEAR(pixelOf(image, 32, 32).x, near / 4, 1e-5);
    EXPECT_EQ(pixelOf(image, 48, 32).x, 0);
    EXPECT_EQ(pixelOf(image, 48, 32).w, 1);
}

TEST(ReferenceShading, shadowIsExactlyWhereTheOccluderBlocksTheLight)
{
    Scene scene = litScene(meshOf({{-2, 2, 0}, {4, 0, 0}, {0, -4, 0}}));
    scene.meshes.push_back(meshOf({{-0.3, 0.3, 1}, {0.6, 0, 0}, {0, -0.6, 0}}));
    scene.instances.push_back({"", 1, glm::mat4(1)});
    scene.materials[0].doubleSided = true;
    View view = shadedView();
    view.width = view.height = 128;
    view.lights.push_back({});
    // Light from the right at 45 degrees: the shadow is one unit to the left.
    view.lights[0].direction = glm::normalize(glm::vec3(-1, 0, -1));
    Image with = rendered(scene, view);
    view.shadows = false;
    Image without = rendered(scene, view);
    double pixelsPerUnit = 64 / (4 * std::tan(0.5 * 0.785398));
    int dark = 0;
    forCovered(with, [&](int x, int y, glm::vec4 value) {
        double px = (x + 0.5 - 64) / pixelsPerUnit, py = (64 - y - 0.5) / pixelsPerUnit;
        // Excludes the occluder, which at z = 1 appears larger by 4/3.
        if (std::abs(px) < 0.45 && std::abs(py) < 0.45)
            return;
        double distance = std::max(std::abs(px + 1), std::abs(py)) - 0.3;
        float full = pixelOf(without, x, y).x;
        ASSERT_GT(full, 0);
        // The map has 2048 texels for 5.7 units; the filter is 4 wide: 0.011, and a pixel is 0.026.
        if (distance < -0.06) {
            ++dark;
            ASSERT_EQ(value.x, 0) << x << " " << y;
        }
        if (distance > 0.06) {
            ASSERT_EQ(value.x, full) << x << " " << y;
        }
    });
    EXPECT_GT(dark, 100);
}

TEST(ReferenceShading, planesDoNotShadowThemselvesAtAnyAngleOfLight)
{
    for (double degrees : {0.0, 30.0, 60.0, 75.0, 85.0}) {
        double a = degrees / 57.295779513;
        Scene scene = litScene(meshOf(kSquare));
        View view = shadedView();
        view.lights.push_back({});
        view.lights[0].direction = glm::vec3(-std::sin(a) * 0.8, std::sin(a) * 0.6, -std::cos(a));
        Image with = rendered(scene, view);
        view.shadows = false;
        EXPECT_EQ(with.data, rendered(scene, view).data) << degrees;
    }
}

TEST(ReferenceShading, maskDiscardsBelowItsCutoff)
{
    Scene scene = sceneOf(meshOf(kSquare));
    scene.materials[0].alphaMode = AlphaMode::mask;
    for (float alpha : {0.49f, 0.5f}) {
        scene.materials[0].baseColor.w = alpha;
        for (Output output : {Output::shaded, Output::normal}) {
            View view = shadedView();
            view.output = output;
            EXPECT_EQ(pixelOf(rendered(scene, view), 32, 32).w, alpha < 0.5f ? 0 : 1);
        }
    }
}

TEST(ReferenceShading, blendedPanesAreMixedBackToFront)
{
    // Green in front of red, both half transparent, listed in either order.
    for (bool redFirst : {false, true}) {
        Scene scene;
        scene.materials.resize(2);
        for (int i = 0; i < 2; ++i) {
            Material& m = scene.materials[std::size_t(i)];
            m.unlit = true;
            m.alphaMode = AlphaMode::blend;
            m.baseColor = i == 0 ? glm::vec4(1, 0, 0, 0.5f) : glm::vec4(0, 1, 0, 0.5f);
            Mesh mesh = meshOf({{-1, 1, i == 0 ? 0.0 : 1.0}, {2, 0, 0}, {0, -2, 0}});
            mesh.material = i;
            scene.meshes.push_back(mesh);
        }
        scene.instances.push_back({"", redFirst ? 0 : 1, glm::mat4(1)});
        scene.instances.push_back({"", redFirst ? 1 : 0, glm::mat4(1)});
        glm::vec4 value = pixelOf(rendered(scene, shadedView()), 32, 32);
        EXPECT_EQ(value, glm::vec4(0.25f, 0.5f, 0, 0.75f));
    }
}

TEST(ReferenceShading, halfTransparentColourIsStoredUnpremultiplied)
{
    // Image files store colours without multiplied alpha.
    Scene scene = sceneOf(meshOf(kSquare));
    scene.materials[0].unlit = true;
    scene.materials[0].baseColor = {0.8f, 0.3f, 0.05f, 1};
    View view = shadedView();
    view.linearOutput = false;
    glm::vec4 opaque = pixelOf(rendered(scene, view), 32, 32);
    scene.materials[0].alphaMode = AlphaMode::blend;
    scene.materials[0].baseColor.w = 0.5f;
    glm::vec4 half = pixelOf(rendered(scene, view), 32, 32);
    EXPECT_EQ(glm::vec3(half), glm::vec3(opaque));
    EXPECT_NEAR(half.w, 0.5f, 0.51f / 255); // rounded to a byte
}

TEST(ReferenceShading, blendedSurfacesCountAsOpaqueInDataOutputs)
{
    Scene scene = sceneOf(meshOf(kSquare));
    scene.materials[0].alphaMode = AlphaMode::blend;
    scene.materials[0].baseColor.w = 0.1f;
    EXPECT_EQ(pixelOf(rendered(scene, viewOf(Output::normal)), 32, 32), glm::vec4(0, 0, 1, 1));
    scene.materials[0].baseColor.w = 0.003f;
    EXPECT_EQ(pixelOf(rendered(scene, viewOf(Output::normal)), 32, 32).w, 0);
}

TEST(ReferenceShading, occlusionDarkensTheEnvironmentOnly)
{
    Scene scene = litScene(meshOf(kSquare));
    scene.images.push_back(solidImage({0, 255, 255, 255}));
    scene.materials[0].occlusionMap.image = 0;
    View view = shadedView();
    view.environment = true;
    EXPECT_EQ(pixelOf(rendered(scene, view), 32, 32), glm::vec4(0, 0, 0, 1));
    scene.materials[0].emissive = {0.5f, 0.25f, 0};
    EXPECT_EQ(pixelOf(rendered(scene, view), 32, 32), glm::vec4(0.5f, 0.25f, 0, 1));
    scene.materials[0].occlusionStrength = 0;
    EXPECT_GT(pixelOf(rendered(scene, view), 32, 32).z, 0.1f);
}

TEST(ReferenceShading, imageIsToneMappedAndSrgbEncoded)
{
    Scene scene = sceneOf(meshOf(kSquare));
    scene.materials[0].unlit = true;
    scene.materials[0].baseColor = {0.5f, 0.01f, 8, 1};
    View view = shadedView();
    view.linearOutput = false;
    view.dither = false;
    Image image = rendered(scene, view);
    ASSERT_EQ(image.type, PixelType::unorm8);
    for (int c = 0; c < 3; ++c) {
        double x = double(scene.materials[0].baseColor[c]);
        double y = std::min(1.0, x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14));
        double srgb = y <= 0.0031308 ? 12.92 * y : 1.055 * std::pow(y, 1 / 2.4) - 0.055;
        EXPECT_NEAR(double(pixelOf(image, 32, 32)[c]) * 255, srgb * 255, 0.51); // rounded to a byte
    }
}

TEST(ReferenceShading, backgroundIsOpaqueAndUprightInBothRasterDirections)
{
    View view = shadedView();
    view.background = true;
    Image down = rendered({}, view);
    view.rowsUpward = true;
    Image up = rendered({}, view);
    for (int y = 0; y < 64; ++y) {
        EXPECT_EQ(pixelOf(down, 5, y).w, 1);
        // The same ray from the other end of the raster: only its direction is rounded differently.
        EXPECT_NEAR(pixelOf(down, 5, y).z, pixelOf(up, 5, y).z, 1e-6);
    }
    EXPECT_GT(pixelOf(down, 5, 0).z, pixelOf(down, 5, 63).z); // sky above, ground below
}

TEST(ReferenceShading, shadingModelsFollowTheirFormulasAt45Degrees)
{
    // Light at 45 degrees, eye along the normal, white, roughness 1 (alpha 1).
    Scene scene = litScene(meshOf(kSquare));
    View view = shadedView();
    view.width = view.height = 65;
    view.shadows = false;
    view.lights.push_back({});
    view.lights[0].intensity = 1;
    view.lights[0].direction = glm::normalize(glm::vec3(-1, 0, -1));
    const double pi = 3.14159265358979, nl = std::sqrt(0.5), nh = std::cos(pi / 8);
    double fresnel = 0.04 + 0.96 * std::pow(1 - nh, 5);
    double visibility = 0.5 / (nl + 1);
    double pbr = nl * ((1 - fresnel) + fresnel * visibility) / pi;
    double blinnPhong = nl * (1 + 0.04 * nh * 9 / 8) / pi;
    EXPECT_NEAR(pixelOf(rendered(scene, view), 32, 32).x, pbr, 1e-5);
    view.shading = Shading::blinnPhong;
    EXPECT_NEAR(pixelOf(rendered(scene, view), 32, 32).x, blinnPhong, 1e-5);
}
