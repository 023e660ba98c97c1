// Errors for invalid cameras and sizes, and the bounds of valid ones.
#include <gtest/gtest.h>

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "cotan/picture.hpp"
#include "cotan/render.hpp"
#include "cotan/scene.hpp"
#include "picture/option_words.hpp"

namespace cotan {
namespace {

// A scene with two cameras and points from (-1, -2, -3) to (1, 2, 3).
Scene boxScene()
{
    Scene scene;
    scene.materials.resize(1);
    Mesh mesh;
    mesh.positions = {{-1, -2, -3}, {1, 2, 3}, {-1, 2, 3}, {1, -2, -3}, {1, -2, 3}, {-1, 2, -3}};
    mesh.normals.assign(6, {0, 0, 1});
    mesh.indices = {0, 1, 2, 3, 4, 5};
    scene.meshes = {mesh};
    scene.instances = {{"", 0, glm::mat4(1)}};
    scene.cameras.resize(2);
    return scene;
}

TEST(CameraArguments, wrongOnesAreRefusedWithTheRule)
{
    const Scene scene = boxScene();
    const auto errorOf = [&](const std::string& words) {
        const auto camera = parseCamera(words, scene, 20, 10);
        return camera ? "" : camera.error().message;
    };
    const std::string orbit =
        "expected orbit:AZ,EL, degrees around (-360 to 360) and above the horizon (-90 to 90); found '";
    for (const char* words : {"orbit:", "orbit:1", "orbit:1,2,3", "orbit:a,0", "orbit:0,b", "orbit:360.1,0",
                              "orbit:-360.1,0", "orbit:0,90.1", "orbit:0,-90.1"})
        EXPECT_EQ(errorOf(words), orbit + words + "'");
    for (const char* words : {"orbit:360,0", "orbit:-360,0", "orbit:0,90", "orbit:0,-90"})
        EXPECT_EQ(errorOf(words), "") << words;
    EXPECT_EQ(errorOf("2"), "expected a camera number below 2; found 2");
    EXPECT_EQ(errorOf("-1"), "expected a camera number below 2; found -1");
    EXPECT_EQ(errorOf("1"), "");
    EXPECT_EQ(errorOf("1,2,3,1,2,3"), "the eye and the target are the same point");
    EXPECT_EQ(errorOf("0,0,0,0,0,2,45,0,0,1"), "the up direction is parallel to the view direction, or zero");
    EXPECT_EQ(errorOf("0,0,0,0,0,2,45,0,0,0"), "the up direction is parallel to the view direction, or zero");
    for (const char* words :
         {"", "side", "1,2,3,4,5", "1,2,3,4,5,6,7,8", "1,2,3,4,5,6,7,8,9", "1,2,3,4,5,6,7,8,9,10,11"})
        EXPECT_EQ(errorOf(words),
                  "expected front, left, right, top, bottom, back, fit, orbit:AZ,EL, the number of a "
                  "camera, or ex,ey,ez,tx,ty,tz, optionally followed by a field of view and an up direction; found '"
                      + std::string(words) + "'");
}

// An up direction nearly parallel to the view is ignored; if none was given, z replaces the default.
TEST(CameraArguments, upIsIgnoredIfNearlyParallelToTheView)
{
    const auto upOf = [](const std::string& words) {
        const auto camera = parseCamera(words, {}, 20, 10);
        return camera ? camera->up : glm::vec3(7);
    };
    EXPECT_EQ(upOf("0,0,0,0.00009,1,0"), glm::vec3(0, 0, -1));
    EXPECT_EQ(upOf("0,0,0,0.00011,1,0"), glm::vec3(0, 1, 0));
    EXPECT_EQ(upOf("0,0,0,0.0009,-10,0,h2"), glm::vec3(0, 0, -1));
    EXPECT_EQ(upOf("0,0,0,0.0011,-10,0,h2"), glm::vec3(0, 1, 0));
    EXPECT_EQ(upOf("0,0,0,10,0,0,45,2000,0,0.22"), glm::vec3(2000, 0, 0.22f));
    EXPECT_EQ(upOf("0,0,0,10,0,0,45,2000,0,0.18"), glm::vec3(7));
    // Formatted with as few numbers as possible; the up direction is left out if it is the default.
    const auto words = [](glm::vec3 target, glm::vec3 up, bool orthographic) {
        Camera camera;
        camera.eye = {0, 0, 0};
        camera.target = target;
        camera.up = up;
        camera.orthographic = orthographic;
        camera.verticalExtent = 2.5f;
        camera.verticalFieldOfView = 1;
        const std::string text = formatCamera(camera);
        return orthographic ? text : text.substr(0, text.find("57.29")) + "..."; // degrees in a radian
    };
    EXPECT_EQ(words({0.5f, 3, 2}, {0, 1, 0}, true), "0,0,0,0.5,3,2,h2.5");
    EXPECT_EQ(words({0.5f, 3, 2}, {0, 1, 0}, false), "0,0,0,0.5,3,2,...");
    EXPECT_EQ(words({0, 3, 0}, {0, 0, -1}, true), "0,0,0,0,3,0,h2.5");
    EXPECT_EQ(words({0, 3, 0}, {0, 0, 1}, true), "0,0,0,0,3,0,h2.5,0,0,1");
    EXPECT_EQ(words({1, 0, 0}, {0, 0, -1}, true), "0,0,0,1,0,0,h2.5,0,0,-1");
    EXPECT_EQ(words({0.00018f, 2, 0}, {0, 0, -1}, true).find(",0,0,-1"), std::string::npos);
    EXPECT_NE(words({0.00022f, 2, 0}, {0, 0, -1}, true).find(",0,0,-1"), std::string::npos);
}

// Degrees are as few digits as give the same camera, of cameras in radians.
TEST(CameraArguments, fieldsOfViewHaveAsFewDigitsAsTheyNeed)
{
    const auto degreesOf = [](float degrees) {
        Camera camera;
        camera.target = {0, 0, -1};
        camera.verticalFieldOfView = glm::radians(degrees);
        const std::string text = formatCamera(camera);
        return text.substr(text.rfind(',') + 1);
    };
    EXPECT_EQ(degreesOf(45), "45");
    EXPECT_EQ(degreesOf(30), "30");
    EXPECT_EQ(degreesOf(19.5f), "19.5");
    EXPECT_TRUE(formatCamera({}).ends_with(",45")) << formatCamera({});
}

// Side views look along an axis at the centre of the model; a wide image is as high as needed.
TEST(CameraArguments, sidesLookAtTheCentreOfTheModel)
{
    Scene scene = boxScene();
    scene.instances[0].toWorld[3] = {10, 20, 30, 1};
    for (const auto& [word, back] : {std::pair("left", glm::vec3(-1, 0, 0)),
                                     {"right", {1, 0, 0}},
                                     {"top", {0, 1, 0}},
                                     {"bottom", {0, -1, 0}},
                                     {"back", {0, 0, -1}},
                                     {"orbit:0,0", {0, 0, 1}},
                                     {"orbit:-270,0", {1, 0, 0}},
                                     {"orbit:360,0", {0, 0, 1}}}) {
        const auto camera = parseCamera(word, scene, 40, 10);
        ASSERT_TRUE(camera) << word;
        const glm::vec3 away = camera->eye - camera->target;
        EXPECT_LT(glm::length(away / glm::length(away) - back), 1e-6f) << word;
        const glm::vec3 beside =
            camera->eye - glm::vec3(10, 20, 30) - glm::dot(camera->eye - glm::vec3(10, 20, 30), back) * back;
        EXPECT_LT(glm::length(beside), 1e-4f) << word;
    }
    EXPECT_EQ(parseCamera("fit", scene, 40, 10)->name, "fit");
    EXPECT_EQ(parseCamera("front", scene, 40, 10)->name, "front");
}

TEST(PictureOptionValues, everySizeNameHasItsSize)
{
    const std::pair<const char*, PictureSize> sizes[] = {{"thumbnail", {320, 180}}, {"720p", {1280, 720}},
                                                         {"1080p", {1920, 1080}},   {"1440p", {2560, 1440}},
                                                         {"2160p", {3840, 2160}},   {"square", {1024, 1024}}};
    for (const auto& [word, size] : sizes)
        EXPECT_EQ(*parsePictureSize(word), size) << word;
}

TEST(PictureOptionValues, memoryLimitsEachImageAndTheirTotal)
{
    const LoadLimits none;
    for (const int memory : {1, 100, kDefaultMemory, kDefaultMemory + 1, 4000}) {
        const LoadLimits limits = limitsFor(memory, Pixels::none);
        const std::size_t bytes = std::size_t(memory) * 1024 * 1024;
        EXPECT_EQ(limits.imageBytes, bytes) << memory;
        EXPECT_EQ(limits.allImageBytes, std::max(bytes, none.allImageBytes)) << memory;
        EXPECT_EQ(limits.imageBytesBeyond, memory > kDefaultMemory ? bytes : none.imageBytesBeyond) << memory;
        EXPECT_TRUE(limits.pixels == Pixels::none);
    }
}

TEST(PictureOptionValues, optionsForModelsAreRefusedWithoutOne)
{
    const auto errorOf = [](void (*set)(PictureOptions&)) {
        PictureOptions options;
        set(options);
        const auto scene = openModel(options);
        return scene ? "" : scene.error().message;
    };
    using O = PictureOptions;
    EXPECT_EQ(errorOf([](O& o) { o.model = "a.glb", o.shape = "plane"; }),
              "--shape: expected no model with it; found a.glb");
    EXPECT_EQ(errorOf([](O& o) { o.variant = "2"; }), "--variant: expected a model; found the built-in scene");
    EXPECT_EQ(errorOf([](O& o) { o.up = Up::z; }), "--up: expected a model; found the built-in scene");
    EXPECT_EQ(errorOf([](O& o) { o.animation = "run"; }), "--animation: expected a model; found the built-in scene");
    EXPECT_EQ(errorOf([](O& o) { o.time = 0.5; }), "--time: expected --animation with it; found none");
    EXPECT_EQ(errorOf([](O& o) { o.model = "gone.glb", o.time = 0.5; }),
              "--time: expected --animation with it; found none");
    EXPECT_EQ(errorOf([](O& o) { o.shape = "torus"; }), "");
    EXPECT_EQ(errorOf([](O&) {}), "");
}

TEST(PictureOptionValues, exposureIsMeteredIfNoneIsGivenAndLightIsDisplayed)
{
    // Exposure is metered if none is given and light is displayed.
    for (const auto& [use, given, metered] : {std::tuple(PictureUse::shown, false, true),
                                              {PictureUse::shown, true, false},
                                              {PictureUse::radiance, false, false},
                                              {PictureUse::data, false, false}}) {
        PictureOptions o;
        o.use = use;
        if (given)
            o.exposure = 1.0f;
        EXPECT_EQ(meters(o), metered);
    }
    const Scene scene = boxScene(); // no normal map
    EXPECT_EQ(chosenFrame(Frame::unit, {}, scene), Frame::unit);
    Scene mapped = scene;
    mapped.materials[0].normalMap.image = 0;
    PictureOptions model, own;
    model.model = own.model = "a.glb";
    own.maps.normal = "n.png";
    for (const auto& [wide, whole] : {std::pair(1.0f, Frame::orthonormal), {3.0f, Frame::cotangent}}) {
        mapped.meshes[0].texcoords[0].assign(6, {0, 0});
        mapped.meshes[0].texcoords[0][5] = {wide, 1};
        EXPECT_EQ(chosenFrame({}, {}, mapped), Frame::cotangent); // a built-in shape
        EXPECT_EQ(chosenFrame({}, model, mapped), Frame::orthonormal);
        EXPECT_EQ(chosenFrame({}, own, mapped), whole); // whether the uv repeat the map
        EXPECT_EQ(chosenFrame({}, own, scene), Frame::cotangent);
    }
}

} // namespace
} // namespace cotan
