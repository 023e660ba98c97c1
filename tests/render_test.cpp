// Devices, bad input, and the validation layer.
#include <cstring>
#include <limits>

#include "render_scene.hpp"

namespace cotan {

using namespace rendertest;

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

constexpr Output kOutputs[] = {Output::shaded,    Output::normal, Output::tangent,
                               Output::bitangent, Output::uv,     Output::depth};

// A single opaque material: every further alpha mode compiles another pipeline.
Scene opaqueOnly(Scene scene)
{
    for (Material& material : scene.materials) {
        material.alphaMode = AlphaMode::opaque;
        material.coat = {};
        material.anisotropy = {};
        material.specular = {};
        material.sheen = {};
        material.transmission = {};
    }
    return scene;
}

// Every kind of material and light at once.
Scene everything()
{
    Scene scene = sceneOf(sphere(6), flatImage(texelOf({0.3f, 0.1f, 1})));
    scene.materials.resize(5, scene.materials[0]);
    scene.materials[1].alphaMode = AlphaMode::mask;
    scene.materials[1].baseColorMap.image = 0;
    scene.materials[2].alphaMode = AlphaMode::blend;
    scene.materials[2].baseColor.w = 0.5f;
    scene.materials[2].occlusionMap.image = 0;
    scene.materials[2].metallicRoughnessMap.image = 0;
    scene.materials[2].emissiveMap.image = 0;
    scene.materials[3].unlit = true;
    Material& layered = scene.materials[4];
    layered.alphaMode = AlphaMode::mask;
    layered.coat.strength = layered.anisotropy.strength = layered.transmission.strength = 0.5f;
    layered.specular.ior = 1.3f;
    layered.sheen.color = {0.5f, 0.5f, 0.5f};
    for (Texture* const map :
         {&layered.coat.map, &layered.coat.roughnessMap, &layered.coat.normalMap, &layered.anisotropy.map,
          &layered.specular.map, &layered.specular.colorMap, &layered.sheen.colorMap, &layered.sheen.roughnessMap,
          &layered.transmission.map, &layered.heightMap.map})
        map->image = 0;
    layered.heightMap.depth = 0.1f;
    for (int i = 1; i < 5; ++i) {
        scene.meshes.push_back(scene.meshes[0]);
        scene.meshes.back().material = i;
        glm::mat4 m(0.5f);
        m[3] = {float(i) - 2, 0, 1, 1};
        scene.instances.push_back({"", i, m});
    }
    Mesh& mesh = scene.meshes[1];
    mesh.tangents.assign(mesh.vertexCount(), {1, 0, 0, 1});
    mesh.colors.assign(mesh.vertexCount(), {1, 0.5f, 0.5f, 1});
    mesh.cotangentsU.assign(mesh.vertexCount(), {1, 0, 0});
    mesh.cotangentsV.assign(mesh.vertexCount(), {0, 1, 0});
    return scene;
}

std::vector<Light> testLights()
{
    Light point;
    point.kind = LightKind::point;
    Light spot;
    spot.kind = LightKind::spot;
    return {Light{}, point, spot};
}

// Meshes that no file should contain.
Scene hostile()
{
    Scene scene = everything();
    scene.materials[2].alphaMode = AlphaMode::opaque;
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        Mesh& mesh = scene.meshes[m];
        mesh.tangents.assign(mesh.vertexCount(), {kNan, 0, kInfinity, kNan});
        mesh.cotangentsU.assign(mesh.vertexCount(), {kNan, 1e38f, 0});
        mesh.cotangentsV.assign(mesh.vertexCount(), {0, -kInfinity, 0});
        for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
            const std::size_t k = i * 7 + m;
            if (k % 5 == 0)
                mesh.normals[i] = k % 2 ? glm::vec3(0) : glm::vec3(kNan, kInfinity, 1e38f);
            if (k % 7 == 0)
                mesh.texcoords[0][i] = k % 2 ? glm::vec2(kInfinity, kNan) : glm::vec2(1e38f, -3e38f);
            if (k % 11 == 0)
                mesh.positions[i] = k % 2 ? glm::vec3(kNan) : glm::vec3(1e30f, -1e38f, 3e38f);
        }
        mesh.indices.insert(mesh.indices.end(), {0, 0, 0, 1, 1, 2});
    }
    glm::mat4 flat(1);
    flat[2] = glm::vec4(0);
    scene.instances.push_back({"flattened", 0, flat});
    scene.instances.push_back({"vanished", 0, glm::mat4(0)});
    scene.instances.push_back({"not a number", 0, glm::mat4(kNan)});
    scene.images.push_back(Image{});
    scene.materials[3].baseColorMap.image = 1; // an image without pixels
    return scene;
}

} // namespace

TEST(RenderDevice, unknownNameIsRefusedWithTheKnownNames)
{
    COTAN_RENDERER_OR_SKIP(best);
    const auto renderer = openVulkanRenderer("no such device");
    ASSERT_FALSE(renderer);
    EXPECT_EQ(renderer.error().kind, ErrorKind::unavailable);
    EXPECT_NE(renderer.error().message.find("no such device"), std::string::npos);
    EXPECT_NE(renderer.error().message.find(best.device()), std::string::npos);
    EXPECT_EQ(renderer.error().message.find('\n'), std::string::npos);
}

TEST(RenderDevice, partOfTheNameInAnyCaseSelectsTheDevice)
{
    COTAN_RENDERER_OR_SKIP(best);
    std::string part = best.device().substr(0, 6);
    for (char& c : part)
        c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    COTAN_RENDERER_OR_SKIP(renderer, part);
    EXPECT_EQ(renderer.device().substr(0, 6), best.device().substr(0, 6));
}

TEST(RenderDevice, impossibleSizesAreUsageErrors)
{
    COTAN_RENDERER_OR_SKIP(renderer);
    load(renderer, Scene{});
    for (const auto& [width, height] : {std::pair(0, 10), {10, -1}, {1 << 30, 10}, {10, 2000000}}) {
        View view;
        view.width = width;
        view.height = height;
        const Result<Image> image = renderer.draw(view);
        ASSERT_FALSE(image);
        EXPECT_EQ(image.error().kind, ErrorKind::usage);
    }
}

TEST(RenderDevice, drawsOddAndTinySizes)
{
    COTAN_RENDERER_OR_SKIP(renderer);
    load(renderer, everything());
    for (const auto& [width, height] : {std::pair(1, 1), {3, 1}, {1, 7}, {333, 17}}) {
        View view;
        view.width = width;
        view.height = height;
        const Image image = drawn(renderer, view);
        EXPECT_EQ(image.width, width);
        EXPECT_EQ(image.height, height);
        EXPECT_EQ(image.data.size(), image.pixelCount() * 4);
    }
}

TEST(RenderDevice, loadReplacesThePreviousScene)
{
    COTAN_RENDERER_OR_SKIP(renderer);
    const View view = viewOf(Output::normal);
    EXPECT_FALSE(renderer.draw(view)); // no scene is loaded
    load(renderer, sceneOf(quad()));
    EXPECT_EQ(floatPixel(drawn(renderer, view), 32, 32).w, 1.0f);
    load(renderer, Scene{});
    EXPECT_EQ(floatPixel(drawn(renderer, view), 32, 32).w, 0.0f);
}

// The third scene has another image on purpose: with sameImages it must not be read.
TEST(RenderDevice, texturesOfTheSameImagesStayOnTheDevice)
{
    COTAN_RENDERER_OR_SKIP(renderer);
    const Scene still = sceneOf(sphere(6), flatImage(texelOf({0.3f, 0.1f, 1})));
    Scene moved = still;
    moved.instances[0].toWorld[3] = {0.3f, 0.2f, 0, 1};
    moved.materials[0].baseColorMap.image = 0; // another use of the image
    Scene other = moved;
    other.images[0] = flatImage(texelOf({-0.3f, 0.5f, 1}));
    const View view = viewOf(Output::normal);
    load(renderer, moved);
    const Image fresh = drawn(renderer, view);
    load(renderer, other);
    EXPECT_NE(drawn(renderer, view).data, fresh.data);
    load(renderer, still);
    EXPECT_NE(drawn(renderer, view).data, fresh.data);
    for (const Scene* scene : {&moved, &other}) {
        ASSERT_TRUE(renderer.load(*scene, /*sameImages*/ true));
        EXPECT_EQ(drawn(renderer, view).data, fresh.data);
    }
}

// Several threads reach a pixel in varying order. With four samples, some drivers also draw pixels just outside the
// scissor rectangle, which have no list of layers.
TEST(RenderDevice, renderingTwiceGivesTheSameBytes)
{
    COTAN_RENDERER_OR_SKIP(renderer);
    View view;
    view.width = 160;
    view.height = 90;
    view.lights = testLights();
    const auto differing = [&] {
        const Image a = drawn(renderer, view), b = drawn(renderer, view);
        std::size_t pixels = 0;
        for (std::size_t i = 0; i < a.pixelCount(); ++i)
            pixels += std::memcmp(a.bytes8() + 4 * i, b.bytes8() + 4 * i, 4) != 0;
        return pixels;
    };
    load(renderer, opaqueOnly(everything()));
    EXPECT_EQ(differing(), 0u);
    load(renderer, everything());
    for (int i = 0; i < 40; ++i) // the order of threads changes only sometimes
        EXPECT_EQ(differing(), 0u);
    view.samples = 1;
    EXPECT_EQ(differing(), 0u);
}

// Frames affect their two vectors and the normal. Shading from the normal, and the outputs that use no frame, share one
// code: drawn with the first frame only.
TEST(RenderHostile, everyPixelOfEveryOutputAndFrameIsFinite)
{
    COTAN_RENDERER_OR_SKIP(renderer);
    for (const FrameInfo& info : frames()) {
        const bool first = info.frame == Frame::cotangent;
        load(renderer, first ? hostile() : opaqueOnly(hostile()));
        for (const Output output : kOutputs) {
            if (!first && (output == Output::shaded || output == Output::uv || output == Output::depth))
                continue;
            View view = viewOf(output, info.frame);
            view.linearOutput = true;
            view.lights = testLights();
            const Result<Image> image = renderer.draw(view);
            if (!image && info.source == FrameSource::triangle)
                continue; // not supported by the device
            ASSERT_TRUE(image) << image.error().message;
            EXPECT_TRUE(allFinite(*image)) << info.name << ", output " << int(output);
        }
    }
}

// The upload does not check again what Renderer::load has checked.
TEST(RenderHostile, inconsistentScenesAreRefused)
{
    COTAN_RENDERER_OR_SKIP(renderer);
    Scene noMesh = sceneOf(quad()), noImage = noMesh, noVertex = noMesh, shortArray = noMesh;
    noMesh.instances[0].mesh = 99;
    noImage.materials[0].normalMap.image = 12345;
    noVertex.meshes[0].indices.back() = 0xffffffffu;
    shortArray.meshes[0].tangents.resize(1);
    for (const Scene& scene : {noMesh, noImage, noVertex, shortArray}) {
        const Status refused = renderer.load(scene);
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().kind, ErrorKind::input);
        EXPECT_FALSE(renderer.draw(viewOf(Output::normal)));
    }
}

TEST(RenderHostile, degenerateCamerasAreRefused)
{
    COTAN_RENDERER_OR_SKIP(renderer);
    load(renderer, everything());
    Camera inside;
    inside.eye = inside.target = {0, 0, 0};
    Camera along;
    along.up = {0, 0, 1};
    Camera numberless;
    numberless.eye = {kNan, 0, 0};
    numberless.verticalFieldOfView = kNan;
    for (const Camera& camera : {inside, along, numberless}) {
        View view = viewOf(Output::shaded);
        view.camera = camera;
        const Result<Image> refused = renderer.draw(view);
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().kind, ErrorKind::usage);
    }
}

// Adds arbitrary tangents and cotangents, for the frames that read them.
Scene withAttributes(Scene scene)
{
    for (Mesh& mesh : scene.meshes) {
        mesh.tangents.assign(mesh.vertexCount(), {1, 0, 0, 1});
        mesh.cotangentsU.assign(mesh.vertexCount(), {1, 0, 0});
        mesh.cotangentsV.assign(mesh.vertexCount(), {0, 1, 0});
    }
    return scene;
}

TEST(RenderValidation, everyOutputAndFrameIsValid)
{
    COTAN_RENDERER_OR_SKIP(renderer, "", /*validation*/ true);
    if (!renderer.messages().empty())
        GTEST_SKIP() << renderer.messages().front();
    // Frames from differences give the driver the same buffers and stages, so one of them draws every output of both
    // scenes, the others one image of each scene, for their shader.
    for (const FrameInfo& info : frames()) {
        const bool first = info.frame == Frame::cotangent;
        const bool alike = !first && info.source == FrameSource::differences;
        for (const Scene& scene : {withAttributes(everything()), hostile()}) {
            load(renderer, first ? scene : opaqueOnly(scene));
            for (const Output output : kOutputs) {
                if (alike && output != Output::shaded)
                    continue;
                View view = viewOf(output, info.frame);
                view.width = view.height = 16;
                view.lights = testLights();
                view.linearOutput = int(info.frame) % 2 == 0;
                view.background = int(info.frame) % 3 != 0;
                view.samples = int(info.frame) % 4 == 1 ? 1 : 4;
                view.pointSampled = int(info.frame) % 2 == 1;
                view.rowsUpward = int(info.frame) % 5 == 0;
                view.shadows = int(info.frame) != 3;
                const Result<Image> image = renderer.draw(view);
                if (!image) {
                    EXPECT_EQ(info.source, FrameSource::triangle) << image.error().message;
                }
            }
        }
    }
    for (const std::string& message : renderer.messages())
        ADD_FAILURE() << message;
}

} // namespace cotan
