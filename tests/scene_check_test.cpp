// Scenes with invalid indices, sizes or numbers are refused with an error that names the fault.
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <utility>

#include "cotan/bake.hpp"
#include "cotan/gltf.hpp"
#include "cotan/lint.hpp"
#include "cotan/render.hpp"
#include "cotan/scene.hpp"
#include "scene/geometry.hpp"
#include "scene/scene_check.hpp"

namespace cotan {
namespace {

// A plane with a normal map and every optional vertex attribute.
Scene soundScene()
{
    Scene scene;
    scene.images.push_back(makeReliefMap(Relief::waves, 16));
    scene.materials.resize(1);
    scene.materials[0].normalMap.image = 0;
    Mesh mesh = makePlane(2, 2, 3);
    mesh.tangents.assign(mesh.vertexCount(), glm::vec4(1, 0, 0, 1));
    mesh.texcoords[1] = mesh.texcoords[0];
    scene.meshes.push_back(std::move(mesh));
    scene.instances.push_back({"plane", 0, glm::mat4(1)});
    return scene;
}

View smallView(const Scene& scene)
{
    View view;
    view.width = view.height = 16;
    view.camera = fitCamera(bounds(scene), view.width, view.height);
    view.frame = Frame::mikktspace;
    view.output = Output::normal;
    return view;
}

BakeModelOptions smallBake()
{
    BakeModelOptions options;
    options.bake.width = options.bake.height = 8;
    options.bake.frame = Frame::mikktspace;
    options.ownMaps = true;
    return options;
}

struct Fault {
    void (*make)(Scene&);
    std::string where; // the start of the expected message, after the name of the scene
};

const Fault kBroken[] = {
    {[](Scene& s) { s.images[0].data.resize(7); }, "image 0: expected the bytes of 16 x 16 pixels, found 7"},
    {[](Scene& s) { s.images[0].width = 1 << 30; }, "image 0: expected the bytes"},
    {[](Scene& s) { s.materials[0].normalMap.image = 1; },
     "material 0: normal map: expected an image below 1, found 1"},
    {[](Scene& s) { s.materials[0].specular.map.image = 9; },
     "material 0: specular: expected an image below 1, found 9"},
    {[](Scene& s) { s.materials[0].specular.colorMap.image = 1; }, "material 0: specular colour: expected an image"},
    {[](Scene& s) { s.materials[0].sheen.colorMap.image = -2; }, "material 0: sheen colour: expected an image"},
    {[](Scene& s) { s.materials[0].sheen.roughnessMap.texcoord = -1; }, "material 0: sheen roughness: expected uv set"},
    {[](Scene& s) { s.materials[0].transmission.map.image = 1; }, "material 0: transmission: expected an image"},
    {[](Scene& s) { s.materials[0].heightMap.map.image = 1; }, "material 0: height map: expected an image"},
    {[](Scene& s) { s.materials[0].normalMap.texcoord = 2; },
     "material 0: normal map: expected uv set 0 or 1, found 2"},
    {[](Scene& s) { s.materials[0].normalFormat.channels = Channels(77); }, "material 0: expected a normal encoding"},
    {[](Scene& s) { s.materials.clear(); }, "mesh 0: expected a material below 0, found 0"},
    {[](Scene& s) { s.meshes[0].material = -1; }, "mesh 0: expected a material below 1, found -1"},
    {[](Scene& s) { s.meshes[0].indices[4] = 1u << 31; },
     "mesh 0: triangle 1: expected an index below 9, found 2147483648"},
    {[](Scene& s) { s.meshes[0].indices.pop_back(); }, "mesh 0: expected three indices per triangle"},
    {[](Scene& s) { s.meshes[0].positions.resize(2); }, "mesh 0: normals: expected 2 entries, one per vertex, found 9"},
    {[](Scene& s) { s.meshes[0].normals.clear(); }, "mesh 0: normals: expected 9 entries, one per vertex, found 0"},
    {[](Scene& s) { s.meshes[0].texcoords[0].resize(1); }, "mesh 0: uv set 0: expected 9 entries"},
    {[](Scene& s) { s.meshes[0].tangents.resize(1); }, "mesh 0: tangent: expected 9 entries"},
    {[](Scene& s) { s.instances[0].mesh = 1; }, "instance 0: expected a mesh below 1, found 1"},
    {[](Scene& s) { s.instances[0].mesh = -1; }, "instance 0: expected a mesh below 1, found -1"},
};

template<class T>
void expectRefused(const Result<T>& result, const std::string& line, ErrorKind kind = ErrorKind::input)
{
    ASSERT_FALSE(result) << line;
    EXPECT_EQ(result.error().kind, kind);
    EXPECT_TRUE(result.error().message.starts_with(line)) << result.error().message;
}

TEST(SceneCheck, validScenesAreAcceptedEverywhere)
{
    const Scene scene = soundScene();
    EXPECT_TRUE(checkScene(scene));
    EXPECT_TRUE(drawView(scene, smallView(scene), "reference"));
    EXPECT_EQ(lintScene(scene).primitives.size(), 1u);
    EXPECT_TRUE(gltfDocumentOf(scene));
    const auto baked = bakeModel(scene, {.scenes = {scene}, .maps = {}}, smallBake());
    EXPECT_TRUE(baked) << baked.error().message;
}

TEST(SceneCheck, indicesAndSizesOutOfRangeAreRefusedEverywhere)
{
    const Scene sound = soundScene();
    const View view = smallView(sound);
    for (const auto& [make, where] : kBroken) {
        Scene scene = soundScene();
        make(scene);
        expectRefused(checkScene(scene), "scene: " + where);
        expectRefused(drawView(scene, view, "reference"), "scene: " + where);
        const auto renderer = openRenderer("reference", 1);
        ASSERT_TRUE(renderer);
        expectRefused((*renderer)->load(scene), "scene: " + where);
        expectRefused(gltfDocumentOf(scene), "scene: " + where);
        expectRefused(bakeModel(scene, {.scenes = {sound}, .maps = {}}, smallBake()), "low: " + where);
        expectRefused(bakeModel(sound, {.scenes = {sound, scene}, .maps = {}}, smallBake()),
                      "high.scenes[1]: " + where);
        BakeModelOptions caged = smallBake();
        caged.cage = &scene;
        expectRefused(bakeModel(sound, {.scenes = {sound}, .maps = {}}, caged), "options.cage: " + where);
        const LintReport report = lintScene(scene);
        EXPECT_TRUE(report.primitives.empty());
        EXPECT_TRUE(report.defects.starts_with("Nothing was checked: scene: " + where)) << report.defects;
        EXPECT_EQ(report.recommendation, report.defects);
    }
}

TEST(SceneCheck, nonFiniteNumbersAreDrawnAndLintedButNotBaked)
{
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        Scene scene = soundScene();
        scene.meshes[0].positions[4].x = bad;
        EXPECT_TRUE(drawView(scene, smallView(soundScene()), "reference"));
        EXPECT_EQ(lintScene(scene).primitives.size(), 1u);
        expectRefused(checkScene(scene, "mine"), "mine: mesh 0: position 4: expected finite numbers");
        expectRefused(bakeModel(scene, {.scenes = {soundScene()}, .maps = {}}, smallBake()), "low: mesh 0: position 4");
    }
}

TEST(SceneCheck, invalidViewsAreRefusedByBothRenderers)
{
    const Scene scene = soundScene();
    const float bad = std::numeric_limits<float>::quiet_NaN();
    const std::pair<void (*)(View&, float), std::string> wrong[] = {
        {[](View& v, float) { v.frame = Frame(99); },
         "view.frame: expected 0 to " + std::to_string(kFrameCount - 1) + "; found 99"},
        {[](View& v, float) { v.samples = 3; }, "view.samples: expected 1, 4 or 16; found 3"},
        {[](View& v, float n) { v.exposure = n; }, "view.exposure: expected a finite number; found nan"},
        {[](View& v, float n) { v.camera.eye.y = n; }, "view.camera: expected finite numbers"},
        {[](View& v, float) { v.camera.target = v.camera.eye; },
         "view.camera: the eye and the target are the same point"},
        {[](View& v, float) { v.camera.up = v.camera.target - v.camera.eye; },
         "view.camera: expected an up direction across the line of sight; found one along it, or zero"},
        {[](View& v, float) { v.camera.verticalFieldOfView = 0; },
         "view.camera: expected a verticalFieldOfView above 0 and below pi; found 0.000000"},
    };
    EXPECT_TRUE(checkView(smallView(scene)));
    View empty = smallView(scene);
    empty.width = 0;
    expectRefused(checkView(empty), "view: expected a width and a height of at least 1; found 0x16", ErrorKind::usage);
    for (const auto& [make, message] : wrong) {
        View view = smallView(scene);
        make(view, bad);
        expectRefused(checkView(view), message, ErrorKind::usage);
        for (const char* device : {"reference", "auto"})
            expectRefused(drawView(scene, view, device), message, ErrorKind::usage);
    }
}

TEST(SceneCheck, emptyImagesAreAcceptedIfPixelsAreNotRequired)
{
    Scene scene = soundScene();
    scene.images[0] = {};
    EXPECT_FALSE(checkScene(scene));
    EXPECT_TRUE(checkScene(scene, "scene", {.pixels = false}));
    for (const glm::ivec2 size : {glm::ivec2(0, 5), {5, 0}, {5, 5}}) {
        scene.images[0].width = size.x;
        scene.images[0].height = size.y;
        EXPECT_FALSE(checkScene(scene, "scene", {.pixels = false})) << size.x << " x " << size.y;
    }
}

} // namespace
} // namespace cotan
