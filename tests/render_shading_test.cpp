// Light, alpha, textures and the orientation of the image.
#include "render_scene.hpp"

#include "cotan/portable.hpp"
#include "scene/render_text.hpp"

namespace cotan {

using namespace rendertest;

namespace {

// A view without environment and background that outputs linear floats.
View bareView()
{
    View view = viewOf(Output::shaded);
    view.environment = false;
    view.background = false;
    view.linearOutput = true;
    view.samples = 1;
    return view;
}

Scene unlitQuad(glm::vec4 color)
{
    Scene scene = sceneOf(quad());
    scene.materials[0].unlit = true;
    scene.materials[0].baseColor = color;
    return scene;
}

// Alternating black and white texels, like a chessboard.
Image chessboard(int size)
{
    Image image = makeImage(size, size, PixelType::unorm8);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            for (int c = 0; c < 4; ++c)
                image.bytes8()[4 * (y * size + x) + c] = (x + y) % 2 || c == 3 ? 255 : 0;
    return image;
}

} // namespace

TEST(RenderShading, imageIsUprightForBothRowDirections)
{
    COTAN_RENDERER_OR_SKIP(renderer);
    // A texture whose texels are red, green (top row), blue, white (bottom row).
    Scene scene = unlitQuad({1, 1, 1, 1});
    Image image = makeImage(2, 2, PixelType::unorm8);
    const int colors[4][3] = {{255, 0, 0}, {0, 255, 0}, {0, 0, 255}, {255, 255, 255}};
    for (int i = 0; i < 4; ++i)
        for (int c = 0; c < 4; ++c)
            image.bytes8()[4 * i + c] = std::uint8_t(c == 3 ? 255 : colors[i][c]);
    scene.images.push_back(image);
    scene.materials[0].baseColorMap.image = 0;
    load(renderer, scene);
    View view = bareView();
    view.pointSampled = true;
    for (const bool rowsUpward : {false, true}) {
        view.rowsUpward = rowsUpward;
        const Image output = drawn(renderer, view);
        EXPECT_EQ(glm::vec3(floatPixel(output, 24, 24)), glm::vec3(1, 0, 0));
        EXPECT_EQ(glm::vec3(floatPixel(output, 40, 24)), glm::vec3(0, 1, 0));
        EXPECT_EQ(glm::vec3(floatPixel(output, 24, 40)), glm::vec3(0, 0, 1));
        EXPECT_EQ(glm::vec3(floatPixel(output, 40, 40)), glm::vec3(1, 1, 1));
    }
}

TEST(RenderShading, depthIsTheDistanceAlongTheViewAxis)
{
    COTAN_RENDERER_OR_SKIP(renderer);
    load(renderer, sceneOf(quad()));
    for (const bool orthographic : {false, true}) {
        View view = viewOf(Output::depth);
        view.camera.orthographic = orthographic;
        view.camera.verticalExtent = 2.5f;
        const Image image = drawn(renderer, view);
        // Equal over the whole plane, not longer towards the corners.
        for (const int x : {20, 32, 44})
            EXPECT_NEAR(floatPixel(image, x, 22).x, 3.0f, 1e-5f);
        EXPECT_EQ(floatPixel(image, 1, 1), glm::vec4(0));
    }
}

TEST(RenderShading, uvOutputIsTheTransformedUvOfTheNormalMap)
{
    COTAN_RENDERER_OR_SKIP(renderer);
    Scene scene = sceneOf(quad(), flatImage(texelOf({0, 0, 1})));
    scene.meshes[0].texcoords[1].assign(4, {3, 7});
    scene.materials[0].normalMap.uRow = {0, 2, 0.25f};
    scene.materials[0].normalMap.vRow = {-1, 0, 0.5f};
    load(renderer, scene);
    const View view = viewOf(Output::uv);
    // uv = (0.5, 0.5) at the centre, which is 1/64 of the image's half-width from the nearest pixel centre.
    const glm::vec4 a = floatPixel(drawn(renderer, view), 32, 32);
    EXPECT_NEAR(a.x, 1.25f, 0.03f);
    EXPECT_NEAR(a.y, 0.0f, 0.03f);
    scene.materials[0].normalMap.texcoord = 1;
    load(renderer, scene);
    const glm::vec4 b = floatPixel(drawn(renderer, view), 32, 32);
    EXPECT_NEAR(b.x, 14.25f, 1e-4f);
    EXPECT_NEAR(b.y, -2.5f, 1e-4f);
}

TEST(RenderShading, lightsAddAsInThePortableText)
{
    COTAN_RENDERER_OR_SKIP(renderer);
    Scene scene = sceneOf(quad());
    scene.materials[0].baseColor = {0.8f, 0.5f, 0.2f, 1};
    scene.materials[0].metallic = 0.3f;
    scene.materials[0].roughness = 0.4f;
    scene.materials[0].emissive = {0.1f, 0.2f, 0.3f};
    load(renderer, scene);
    View view = bareView();
    view.width = view.height = 65; // puts a pixel centre at the image centre
    view.shadows = false;
    Light sun;
    sun.direction = glm::normalize(glm::vec3(0.3f, -0.4f, -1));
    Light lamp;
    lamp.kind = LightKind::point;
    lamp.position = {0.5f, 0.5f, 2};
    lamp.range = 9;
    Light spot = lamp;
    spot.kind = LightKind::spot;
    spot.position = {0, -0.5f, 2};
    spot.direction = glm::normalize(glm::vec3(0, 0.76f, -2));
    spot.innerCone = 0.02f;
    spot.outerCone = 0.2f;
    view.lights = {sun, lamp, spot};

    for (const Shading shading : {Shading::pbr, Shading::blinnPhong}) {
        view.shading = shading;
        f32::cotan_surface s{};
        s.base_color = {0.8f, 0.5f, 0.2f};
        s.metallic = 0.3f;
        s.roughness = 0.4f;
        s.n = {0, 0, 1};
        s.v = {0, 0, 1};
        const auto reflect = [&](glm::vec3 l) {
            return shading == Shading::pbr ? f32::cotan_reflect_pbr(s, l) : f32::cotan_reflect_blinn_phong(s, l);
        };
        glm::vec3 expected = glm::vec3(0.1f, 0.2f, 0.3f) + 3.0f * reflect(-sun.direction);
        const float lampDistance = glm::length(lamp.position);
        expected += 3.0f * f32::cotan_light_falloff(lampDistance, 9) * reflect(lamp.position / lampDistance);
        const float spotDistance = glm::length(spot.position);
        const glm::vec3 toSpot = spot.position / spotDistance;
        const float cone = f32::cotan_smooth(std::cos(0.2f), std::cos(0.02f), glm::dot(-toSpot, spot.direction));
        EXPECT_GT(cone, 0.1f); // the point is at the cone's edge
        EXPECT_LT(cone, 0.9f);
        expected += 3.0f * f32::cotan_light_falloff(spotDistance, 9) * cone * reflect(toSpot);
        const glm::vec3 color(floatPixel(drawn(renderer, view), 32, 32));
        // The same float formulas; GPU division, pow and rsqrt may differ by a few units of 1e-7.
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(color[c], expected[c], 1e-3f * expected[c]);
    }
}

TEST(RenderShading, shadedBytesAreToneMappedAndSrgbEncoded)
{
    COTAN_RENDERER_OR_SKIP(renderer);
    load(renderer, unlitQuad({0.5f, 0.18f, 2.0f, 1}));
    View view = bareView();
    view.linearOutput = false;
    view.exposure = 1.5f;
    for (const int samples : {1, 4}) {
        view.samples = samples;
        const Image image = drawn(renderer, view);
        ASSERT_EQ(image.type, PixelType::unorm8);
        const glm::vec3 linear(0.75f, 0.27f, 3.0f);
        for (int c = 0; c < 3; ++c) {
            const float expected = 255 * f32::cotan_linear_to_srgb(f32::cotan_tone(linear[c]));
            EXPECT_NEAR(bytePixel(image, 32, 32)[c], expected, 1.0f); // rounding to a byte
        }
        EXPECT_EQ(bytePixel(image, 32, 32)[3], 255);
        EXPECT_EQ(bytePixel(image, 1, 1)[3], 0);
    }
}

TEST(RenderShading, backgroundIsTheEnvironmentAlongTheRay)
{
    COTAN_RENDERER_OR_SKIP(renderer);
    load(renderer, Scene{});
    View view = bareView();
    view.background = true;
    for (const bool rowsUpward : {false, true}) {
        view.rowsUpward = rowsUpward;
        const Image image = drawn(renderer, view);
        const double half = std::tan(view.camera.verticalFieldOfView / 2.0);
        for (const int y : {3, 30, 60}) {
            const glm::dvec3 ray(half * ((10 + 0.5) / 32 - 1), half * (1 - (y + 0.5) / 32), -1);
            const glm::vec3 expected = f32::cotan_environment(glm::vec3(glm::normalize(ray)), 0.35f);
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(floatPixel(image, 10, y)[c], expected[c], 1e-4f);
        }
    }
}

TEST(RenderShading, farTexturesShowTheirMeanInLinearLight)
{
    COTAN_RENDERER_OR_SKIP(renderer);
    Scene scene = unlitQuad({1, 1, 1, 1});
    scene.images.push_back(chessboard(256)); // four texels per pixel and more
    scene.materials[0].baseColorMap.image = 0;
    load(renderer, scene);
    View view = bareView();
    view.camera.eye.z = 6;
    const glm::vec4 color = floatPixel(drawn(renderer, view), 32, 32);
    // One step of sRGB at 188 is 0.008 of linear light.
    EXPECT_NEAR(color.x, 0.5f, 0.01f);
}

TEST(RenderShading, sixteenBitAndFloatImagesKeepTheirValues)
{
    COTAN_RENDERER_OR_SKIP(renderer);
    View view = bareView();
    Scene scene = unlitQuad({1, 1, 1, 1});
    Image words = makeImage(2, 2, PixelType::unorm16);
    for (int i = 0; i < 16; ++i)
        words.words()[i] = 32768;
    scene.images = {words, flatImage({2.5f, 0.001f, 0.3f, 1})};
    scene.materials[0].baseColorMap.image = 0;
    load(renderer, scene);
    EXPECT_NEAR(floatPixel(drawn(renderer, view), 32, 32).x, 0.21404f, 1e-4f);
    scene.materials[0].baseColorMap.image = 1;
    load(renderer, scene);
    const glm::vec4 color = floatPixel(drawn(renderer, view), 32, 32);
    EXPECT_NEAR(color.x, 2.5f, 1e-3f); // half floats, if the device cannot filter floats
    EXPECT_NEAR(color.y, 0.001f, 1e-5f);
}

TEST(RenderShading, maskCutsAndBlendMixesFarToNear)
{
    COTAN_RENDERER_OR_SKIP(renderer);
    Scene scene;
    const glm::vec4 colors[] = {{0, 0, 1, 1}, {1, 0, 0, 0.5f}, {0, 1, 0, 0.25f}, {1, 1, 1, 0.3f}};
    for (int i = 0; i < 4; ++i) {
        Material material;
        material.unlit = true;
        material.baseColor = colors[i];
        material.alphaMode = i == 0 ? AlphaMode::opaque : AlphaMode::blend;
        if (i == 3)
            material.alphaMode = AlphaMode::mask; // 0.3 < 0.5: discarded
        scene.materials.push_back(material);
        scene.meshes.push_back(quad());
        scene.meshes.back().material = i;
        glm::mat4 m(1);
        m[3][2] = 0.2f * float(i);
        scene.instances.push_back({"", i, m});
    }
    std::swap(scene.instances[1], scene.instances[2]); // the order in the file is irrelevant
    load(renderer, scene);
    const glm::vec4 color = floatPixel(drawn(renderer, bareView()), 32, 32);
    EXPECT_NEAR(color.x, 0.5f * 0.75f, 1e-5f);
    EXPECT_NEAR(color.y, 0.25f, 1e-5f);
    EXPECT_NEAR(color.z, 0.5f * 0.75f, 1e-5f);
    EXPECT_NEAR(color.w, 1.0f, 1e-5f);
}

TEST(RenderShading, halfCoveredPixelsKeepTheirColourWithoutBackground)
{
    COTAN_RENDERER_OR_SKIP(renderer);
    Scene scene = unlitQuad({0.2f, 0.5f, 0.1f, 0.5f});
    load(renderer, scene);
    View view = bareView();
    view.linearOutput = false;
    scene.materials[0].alphaMode = AlphaMode::opaque;
    load(renderer, scene);
    const Image opaque = drawn(renderer, view);
    scene.materials[0].alphaMode = AlphaMode::blend;
    load(renderer, scene);
    const Image half = drawn(renderer, view);
    EXPECT_NEAR(bytePixel(half, 32, 32)[3], 128, 1);
    for (int c = 0; c < 3; ++c) // dividing by alpha doubles the rounding error
        EXPECT_NEAR(bytePixel(half, 32, 32)[c], bytePixel(opaque, 32, 32)[c], 2);
}

TEST(RenderShading, shadowIsWhereTheOccluderBlocksTheLight)
{
    COTAN_RENDERER_OR_SKIP(renderer);
    Scene scene = sceneOf(quad());
    scene.meshes.push_back(quad());
    glm::mat4 small(0.25f);
    small[3] = {0, 0, 1, 1};
    scene.instances.push_back({"blocker", 1, small});
    load(renderer, scene);
    View view = bareView();
    Light light;
    light.direction = glm::normalize(glm::vec3(-0.5f, 0, -1)); // the shadow is 0.5 to the left
    view.lights = {light};
    const auto at = [](const Image& image, float x, float y) {
        // Pixel of a world position on the plane z = 0.
        const float scale = 32.0f / (3.0f * std::tan(0.785398f / 2));
        return floatPixel(image, int(32 + x * scale), int(32 - y * scale)).x;
    };
    const Image shadowed = drawn(renderer, view);
    EXPECT_EQ(at(shadowed, -0.5f, 0.1f), 0.0f);
    EXPECT_GT(at(shadowed, -0.5f, 0.6f), 0.1f);
    EXPECT_GT(at(shadowed, 0.7f, 0.7f), 0.1f); // planes do not shadow themselves
    view.shadows = false;
    EXPECT_GT(at(drawn(renderer, view), -0.5f, 0.1f), 0.1f);
}

} // namespace cotan
