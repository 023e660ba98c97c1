// A scene written as glTF and read again.
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "cotan/scene.hpp"
#include "gltf_edit_maker.hpp"

namespace {

using namespace cotan;
using namespace cotan::test;

Scene written(const Scene& scene)
{
    const cotan::test::TemporaryFolder folder;
    const auto document = gltfDocumentOf(scene);
    EXPECT_TRUE(document);
    const auto done = writeGltf(*document, folder.path / "scene.glb");
    EXPECT_TRUE(done) << done.error().message;
    auto loaded = loadGltf(folder.path / "scene.glb");
    EXPECT_TRUE(loaded) << loaded.error().message;
    return loaded ? std::move(*loaded) : Scene{};
}

Scene twoPatches()
{
    Scene scene;
    scene.meshes = {makePatch(2, 0.5f, false, 2), makePatch(1, 0, true, 1)};
    scene.meshes[0].material = 0;
    scene.meshes[1].material = 1;
    scene.meshes[0].colors.assign(scene.meshes[0].vertexCount(), glm::vec4(0.25f, 0.5f, 0.75f, 0.125f));
    scene.images = {makeReliefMap(Relief::waves, 8), makeReliefMap(Relief::domes, 4)};
    Material& a = scene.materials.emplace_back();
    a.name = "a";
    a.baseColor = {0.1f, 0.2f, 0.3f, 0.4f};
    a.metallic = 0.25f;
    a.roughness = 0.75f;
    a.emissive = {1, 2, 4};
    a.alphaMode = AlphaMode::mask;
    a.alphaCutoff = 0.375f;
    a.doubleSided = true;
    a.normalMap.image = 1;
    a.normalScale = 0.5f;
    a.normalMap.sampler = {Wrap::clamp, Wrap::mirror, Filter::nearest, Filter::linear, MipFilter::nearest};
    // A turn by 0.3, scales 2 and 3, an offset: as KHR_texture_transform has them.
    const float c = std::cos(0.3f), s = std::sin(0.3f);
    a.normalMap.uRow = {c * 2, s * 3, 0.125f};
    a.normalMap.vRow = {-s * 2, c * 3, 0.25f};
    a.occlusionMap.image = 0;
    a.occlusionStrength = 0.625f;
    Material& b = scene.materials.emplace_back();
    b.name = "b";
    b.unlit = true;
    b.alphaMode = AlphaMode::blend;
    b.baseColorMap.image = 0;
    scene.instances = {{"first", 0, glm::mat4(1)},
                       {"mirrored", 1, glm::scale(glm::translate(glm::mat4(1), {1, 2, 3}), {-1, 2, 0.5f})}};
    return scene;
}

TEST(GltfFromScene, comesBackWithGeometryAndPlaces)
{
    const Scene scene = twoPatches(), back = written(scene);
    ASSERT_EQ(back.meshes.size(), 2u);
    ASSERT_EQ(back.instances.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        const Mesh& m = back.meshes[std::size_t(back.instances[i].mesh)];
        const Mesh& expected = scene.meshes[std::size_t(scene.instances[i].mesh)];
        EXPECT_EQ(m.positions, expected.positions);
        EXPECT_EQ(m.normals, expected.normals);
        EXPECT_EQ(m.texcoords[0], expected.texcoords[0]);
        EXPECT_EQ(m.colors, expected.colors);
        EXPECT_EQ(m.indices, expected.indices);
        EXPECT_EQ(back.instances[i].toWorld, scene.instances[i].toWorld);
    }
}

TEST(GltfFromScene, comesBackWithMaterialsAndTextures)
{
    const Scene scene = twoPatches(), back = written(scene);
    ASSERT_EQ(back.materials.size(), 2u);
    const Material &a = back.materials[0], &expected = scene.materials[0];
    EXPECT_EQ(a.name, "a");
    EXPECT_EQ(a.baseColor, expected.baseColor);
    EXPECT_EQ(a.metallic, expected.metallic);
    EXPECT_EQ(a.roughness, expected.roughness);
    EXPECT_LT(glm::distance(a.emissive, expected.emissive), 1e-6f);
    EXPECT_EQ(a.alphaMode, AlphaMode::mask);
    EXPECT_EQ(a.alphaCutoff, expected.alphaCutoff);
    EXPECT_TRUE(a.doubleSided);
    EXPECT_FALSE(a.unlit);
    EXPECT_EQ(a.normalScale, expected.normalScale);
    EXPECT_EQ(a.occlusionStrength, expected.occlusionStrength);
    EXPECT_EQ(back.images[std::size_t(a.normalMap.image)].data, scene.images[1].data);
    EXPECT_EQ(back.images[std::size_t(a.occlusionMap.image)].data, scene.images[0].data);
    EXPECT_EQ(a.normalMap.sampler.wrapU, Wrap::clamp);
    EXPECT_EQ(a.normalMap.sampler.wrapV, Wrap::mirror);
    EXPECT_EQ(a.normalMap.sampler.magnify, Filter::nearest);
    EXPECT_EQ(a.normalMap.sampler.minify, Filter::linear);
    EXPECT_EQ(a.normalMap.sampler.mip, MipFilter::nearest);
    EXPECT_LT(glm::distance(a.normalMap.uRow, expected.normalMap.uRow), 1e-6f);
    EXPECT_LT(glm::distance(a.normalMap.vRow, expected.normalMap.vRow), 1e-6f);
    EXPECT_TRUE(back.materials[1].unlit);
    EXPECT_EQ(back.materials[1].alphaMode, AlphaMode::blend);
    EXPECT_TRUE(back.materials[1].baseColorMap.present());
}

TEST(GltfFromScene, saysThatAShearHasNoPlace)
{
    Scene scene = twoPatches();
    EXPECT_TRUE(gltfDocumentOf(scene)->notes.empty());
    scene.materials[0].normalMap.uRow = {1, 0.5f, 0};
    scene.materials[0].normalMap.vRow = {0, 1, 0};
    const auto document = gltfDocumentOf(scene);
    ASSERT_TRUE(document);
    ASSERT_EQ(document->notes.size(), 1u);
    EXPECT_NE(document->notes[0].find("shear"), std::string::npos);
}

TEST(GltfFromScene, refusesPicturesOfFloats)
{
    Scene scene = twoPatches();
    scene.images[0] = makeImage(2, 2, PixelType::float32, "light.exr");
    const auto document = gltfDocumentOf(scene);
    ASSERT_FALSE(document);
    EXPECT_NE(document.error().message.find("light.exr"), std::string::npos);
}

} // namespace
