// Nodes, materials, textures, lights and cameras.
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "gltf_maker.hpp"
#include "ktx2_maker.hpp"
#include "webp_maker.hpp"

using namespace cotan;
using namespace cotan::test;

namespace {

glm::vec3 moved(const Instance& instance, const glm::vec3& p) { return glm::vec3(instance.toWorld * glm::vec4(p, 1)); }

// ---- nodes ----------------------------------------------------------------------------------

TEST(GltfNodes, scaleThenRotateThenTranslate)
{
    Gltf g = square();
    const double h = std::sqrt(0.5); // 90 degrees about z: x goes to y
    g.root["nodes"][0]["translation"] = {10, 0, 0};
    g.root["nodes"][0]["rotation"] = {0, 0, h, h};
    g.root["nodes"][0]["scale"] = {2, 3, 1};
    COTAN_LOADED(scene, g.load());
    expectNear(moved(scene.instances[0], {1, 0, 0}), {10, 2, 0});
    expectNear(moved(scene.instances[0], {0, 1, 0}), {7, 0, 0});
}

TEST(GltfNodes, aRotationOfZeroLengthIsIgnored)
{
    Gltf g = square();
    g.root["nodes"][0]["rotation"] = {0, 0, 0, 0};
    COTAN_LOADED(scene, g.load());
    EXPECT_EQ(scene.instances[0].toWorld, glm::mat4(1));
}

TEST(GltfNodes, matricesAreStoredByColumns)
{
    Gltf g = square();
    g.root["nodes"][0]["matrix"] = {1, 2, 3, 0, 4, 5, 7, 0, 7, 8, 10, 0, 11, 12, 13, 1};
    COTAN_LOADED(scene, g.load());
    EXPECT_EQ(moved(scene.instances[0], {1, 0, 0}), glm::vec3(12, 14, 16));
}

TEST(GltfNodes, childrenFollowTheirParents)
{
    Gltf g = square();
    g.root["nodes"][0]["translation"] = {1, 0, 0};
    g.add("nodes", {{"children", {0}}, {"scale", {-2, 1, 1}}});
    g.root["scenes"][0]["nodes"] = {1};
    COTAN_LOADED(scene, g.load());
    ASSERT_EQ(scene.instances.size(), 1u);
    EXPECT_EQ(moved(scene.instances[0], {1, 1, 0}), glm::vec3(-4, 1, 0));
}

TEST(GltfNodes, instancesShareTheirMesh)
{
    Gltf g = square();
    g.add("nodes", {{"mesh", 0}, {"name", "copy"}, {"translation", {5, 0, 0}}});
    g.root["scenes"][0]["nodes"] = {0, 1};
    COTAN_LOADED(scene, g.load());
    EXPECT_EQ(scene.meshes.size(), 1u);
    ASSERT_EQ(scene.instances.size(), 2u);
    EXPECT_EQ(scene.instances[0].mesh, scene.instances[1].mesh);
    EXPECT_EQ(scene.instances[1].name, "copy");
}

TEST(GltfNodes, everyPrimitiveIsAMesh)
{
    Gltf g = square();
    g.root["meshes"][0]["primitives"].push_back(primitive(g));
    COTAN_LOADED(scene, g.load());
    EXPECT_EQ(scene.meshes.size(), 2u);
    EXPECT_EQ(scene.instances.size(), 2u);
    EXPECT_EQ(scene.materials.size(), 1u);
}

TEST(GltfNodes, theDefaultSceneIsShown)
{
    Gltf g = square();
    g.add("nodes", {{"mesh", 0}, {"name", "second"}});
    g.add("scenes", {{"nodes", {1}}});
    COTAN_LOADED(first, g.load());
    ASSERT_EQ(first.instances.size(), 1u);
    EXPECT_EQ(first.instances[0].name, "square");
    g.root["scene"] = 1;
    COTAN_LOADED(chosen, g.load());
    EXPECT_EQ(chosen.instances.at(0).name, "second");
    g.root.erase("scene");
    g.root.erase("scenes");
    COTAN_LOADED(all, g.load());
    EXPECT_EQ(all.instances.size(), 2u) << "without scenes, all roots";
}

TEST(GltfNodes, gpuInstancingPlacesCopies)
{
    Gltf g = square();
    const int translations = g.floats({0, 0, 0, 0, 7, 0}, "VEC3");
    const int scales = g.floats({1, 1, 1, 2, 2, 2}, "VEC3");
    g.root["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
    g.root["nodes"][0]["translation"] = {1, 0, 0};
    g.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"TRANSLATION", translations},
                                                                                 {"SCALE", scales}};
    COTAN_LOADED(scene, g.load());
    ASSERT_EQ(scene.instances.size(), 2u);
    EXPECT_EQ(moved(scene.instances[0], {1, 1, 0}), glm::vec3(2, 1, 0));
    EXPECT_EQ(moved(scene.instances[1], {1, 1, 0}), glm::vec3(3, 9, 0));
}

TEST(GltfNodes, longChainsOfNodesAreRead)
{
    constexpr int kLength = 20000; // far deeper than any hand-made hierarchy
    Gltf g = square();
    for (int i = 0; i < kLength; ++i)
        g.add("nodes", {{"children", {i}}, {"translation", {1, 0, 0}}});
    g.root["scenes"][0]["nodes"] = {kLength};
    COTAN_LOADED(scene, g.load());
    EXPECT_EQ(moved(scene.instances.at(0), {0, 0, 0}), glm::vec3(kLength, 0, 0));
}

// ---- materials ------------------------------------------------------------------------------

LoadLimits loadVariant(const std::string& variant)
{
    LoadLimits limits;
    limits.variant = variant;
    return limits;
}

// A red square, which is green in the variant "leaf".
Gltf leaf()
{
    Gltf g = square();
    g.root["materials"] = {{{"pbrMetallicRoughness", {{"baseColorFactor", {1, 0, 0, 1}}}}},
                           {{"pbrMetallicRoughness", {{"baseColorFactor", {0, 1, 0, 1}}}}}};
    g.root["meshes"][0]["primitives"][0]["material"] = 0;
    g.root["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"] = {
        {{"variants", {1}}, {"material", 1}}};
    g.root["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "bare"}}, {{"name", "leaf"}}};
    g.root["extensionsUsed"] = {"KHR_materials_variants"};
    return g;
}

TEST(GltfVariant, isSelectedByNameOrNumber)
{
    for (const auto& [variant, green] : {std::pair{"", 0.0f}, {"bare", 0.0f}, {"leaf", 1.0f}, {"1", 1.0f}}) {
        COTAN_LOADED(scene, leaf().load(loadVariant(variant)));
        EXPECT_EQ(scene.materials[std::size_t(scene.meshes[0].material)].baseColor.y, green) << variant;
    }
}

TEST(GltfVariant, missingOrDamagedOnesAreRefused)
{
    const auto none = leaf().load(loadVariant("bark"));
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().kind, ErrorKind::usage);
    EXPECT_NE(
        none.error().message.find("expected one of its 2 variants by number or name (bare, leaf), found \"bark\""),
        std::string::npos)
        << none.error().message;
    EXPECT_FALSE(square().load(loadVariant("leaf")));
    for (const json& broken : {json(2), json(-1), json("red"), json()}) {
        Gltf g = leaf();
        g.root["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"][0]["material"] =
            broken;
        EXPECT_TRUE(g.load()) << broken;
        const auto refused = g.load(loadVariant("leaf"));
        ASSERT_FALSE(refused) << broken;
        EXPECT_NE(refused.error().message.find("meshes[0].primitives[0].extensions.KHR_materials_variants"),
                  std::string::npos)
            << refused.error().message;
    }
    for (const json& odd : {json(3), json::array({1, "x", json::object()}), json::object()}) {
        Gltf g = leaf();
        g.root["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"] = odd;
        EXPECT_TRUE(g.load(loadVariant("leaf"))) << odd;
    }
}

TEST(GltfMaterial, defaultsAreThoseOfTheSpecification)
{
    Gltf g = square();
    primitive(g).erase("material");
    COTAN_LOADED(scene, g.load());
    const Material& m = scene.materials.at(std::size_t(scene.meshes[0].material));
    EXPECT_EQ(m.baseColor, glm::vec4(1));
    EXPECT_EQ(m.metallic, 1.0f);
    EXPECT_EQ(m.roughness, 1.0f);
    EXPECT_EQ(m.emissive, glm::vec3(0));
    EXPECT_EQ(m.alphaMode, AlphaMode::opaque);
    EXPECT_FALSE(m.doubleSided);
    EXPECT_FALSE(m.normalMap.present());
}

TEST(GltfMaterial, factorsAreRead)
{
    Gltf g = square();
    g.root["materials"][0] = {
        {"name", "brass"},
        {"pbrMetallicRoughness",
         {{"baseColorFactor", {0.5, 0.25, 0.125, 0.75}}, {"metallicFactor", 0.5}, {"roughnessFactor", 0.25}}},
        {"emissiveFactor", {1, 0.5, 0}},
        {"alphaMode", "MASK"},
        {"alphaCutoff", 0.75},
        {"doubleSided", true},
        {"extensions",
         {{"KHR_materials_emissive_strength", {{"emissiveStrength", 4}}}, {"KHR_materials_unlit", json::object()}}}};
    COTAN_LOADED(scene, g.load());
    const Material& m = scene.materials.at(0);
    EXPECT_EQ(m.name, "brass");
    EXPECT_EQ(m.baseColor, glm::vec4(0.5, 0.25, 0.125, 0.75));
    EXPECT_EQ(m.metallic, 0.5f);
    EXPECT_EQ(m.roughness, 0.25f);
    EXPECT_EQ(m.emissive, glm::vec3(4, 2, 0));
    EXPECT_EQ(m.alphaMode, AlphaMode::mask);
    EXPECT_EQ(m.alphaCutoff, 0.75f);
    EXPECT_TRUE(m.doubleSided);
    EXPECT_TRUE(m.unlit);
}

TEST(GltfMaterial, normalMapsHaveGreenAgainstVAndExactZero)
{
    Gltf g = square();
    addNormalMap(g);
    g.root["materials"][0]["normalTexture"]["scale"] = 0.5;
    COTAN_LOADED(scene, g.load());
    const Material& m = scene.materials.at(0);
    ASSERT_TRUE(m.normalMap.present());
    EXPECT_EQ(m.normalScale, 0.5f);
    EXPECT_EQ(m.normalFormat, Convention());
    const Image& image = scene.images.at(std::size_t(m.normalMap.image));
    ASSERT_EQ(image.width, 2);
    ASSERT_EQ(image.height, 2);
    EXPECT_EQ(image.type, PixelType::unorm8);
    EXPECT_EQ(image.bytes8()[2], 255) << "blue of a flat texel";
}

TEST(GltfMaterial, samplersAreRead)
{
    Gltf g = square();
    addNormalMap(g);
    g.add("samplers", {{"magFilter", 9728}, {"minFilter", 9985}, {"wrapS", 33071}, {"wrapT", 33648}});
    g.root["textures"][0]["sampler"] = 0;
    COTAN_LOADED(scene, g.load());
    const Sampler& s = scene.materials.at(0).normalMap.sampler;
    EXPECT_EQ(s.magnify, Filter::nearest);
    EXPECT_EQ(s.minify, Filter::linear);
    EXPECT_EQ(s.mip, MipFilter::nearest);
    EXPECT_EQ(s.wrapU, Wrap::clamp);
    EXPECT_EQ(s.wrapV, Wrap::mirror);
}

// The example in the extension's text: an offset of (0,1), a rotation of 90 degrees and a scale of 1/2 show the lower
// left quadrant of the image, rotated clockwise.
TEST(GltfMaterial, textureTransformSelectsTheQuadrantOfItsExample)
{
    Gltf g = square();
    addNormalMap(g);
    g.root["materials"][0]["normalTexture"]["extensions"]["KHR_texture_transform"] = {
        {"offset", {0, 1}}, {"rotation", std::numbers::pi / 2}, {"scale", {0.5, 0.5}}};
    COTAN_LOADED(scene, g.load());
    const Texture& t = scene.materials.at(0).normalMap;
    const auto at = [&](float u, float v) {
        return glm::vec3(glm::dot(t.uRow, glm::vec3(u, v, 1)), glm::dot(t.vRow, glm::vec3(u, v, 1)), 0);
    };
    expectNear(at(0, 0), {0, 1, 0});
    expectNear(at(1, 0), {0, 0.5, 0});
    expectNear(at(0, 1), {0.5, 1, 0});
    expectNear(at(1, 1), {0.5, 0.5, 0});
}

TEST(GltfMaterial, textureTransformMayNameAnotherUvSet)
{
    Gltf g = square();
    addNormalMap(g);
    primitive(g)["attributes"]["TEXCOORD_1"] = g.floats(kSquareUv, "VEC2");
    g.root["materials"][0]["normalTexture"]["extensions"]["KHR_texture_transform"] = {{"texCoord", 1}};
    COTAN_LOADED(scene, g.load());
    EXPECT_EQ(scene.materials.at(0).normalMap.texcoord, 1);
}

TEST(GltfMaterial, texturesAreOmittedOnlyIfUvAreMissing)
{
    Gltf g = square();
    addNormalMap(g);
    json bare = primitive(g);
    bare["attributes"].erase("TEXCOORD_0");
    g.root["meshes"][0]["primitives"].push_back(bare);
    COTAN_LOADED(scene, g.load());
    ASSERT_EQ(scene.materials.size(), 2u);
    EXPECT_TRUE(scene.materials[std::size_t(scene.meshes[0].material)].normalMap.present());
    EXPECT_FALSE(scene.materials[std::size_t(scene.meshes[1].material)].normalMap.present());
    EXPECT_TRUE(warns(scene, "TEXCOORD_0"));
}

TEST(GltfMaterial, imagesInBufferViewsAndFilesAreRead)
{
    const TemporaryFolder folder;
    const std::string png = flatPng();
    folder.write("maps/flat map.png", png);
    Gltf g = square();
    addNormalMap(g);
    g.root["images"][0]["uri"] = "maps/flat%20map.png";
    COTAN_LOADED(file, loadGltf(folder.write("model.gltf", g.text())));
    EXPECT_EQ(file.images.at(0).width, 2);
    for (const char* uri : {"maps/%66%6C%61%74%20map.png", "maps/fl%61t%20m%61p%2epng", "maps/flat%20map%2Epng"}) {
        g.root["images"][0]["uri"] = uri; // hexadecimal digits of both cases: RFC 3986, 2.1
        COTAN_LOADED(encoded, loadGltf(folder.write("encoded.gltf", g.text())));
        EXPECT_EQ(encoded.images.at(0).data, file.images.at(0).data) << uri;
        EXPECT_EQ(encoded.warnings, file.warnings) << uri;
    }
    const int view = g.view(std::vector<char>(png.begin(), png.end()));
    g.root["images"][0] = {{"bufferView", view}, {"mimeType", "image/png"}};
    COTAN_LOADED(embedded, g.load());
    EXPECT_EQ(embedded.images.at(0).data, file.images.at(0).data);
}

TEST(GltfMaterial, aWebpExtensionIsReadIfThereIsNoPlainSource)
{
    Gltf g = square();
    addNormalMap(g);
    const int webp =
        g.add("images", {{"uri", "data:image/webp;base64," + base64(makeWebp(1, 1, {{130, 120, 250, 255}}))}});
    g.root["extensionsUsed"] = g.root["extensionsRequired"] = {"EXT_texture_webp"};
    g.root["textures"][0]["extensions"]["EXT_texture_webp"]["source"] = webp;
    COTAN_LOADED(both, g.load());
    EXPECT_EQ(both.images.at(0).width, 2) << "the plain source";
    EXPECT_TRUE(both.warnings.empty());
    g.root["textures"][0].erase("source");
    COTAN_LOADED(scene, g.load());
    EXPECT_TRUE(scene.warnings.empty());
    const Image& image = scene.images.at(std::size_t(scene.materials.at(0).normalMap.image));
    ASSERT_EQ(image.pixelCount(), 1u);
    EXPECT_EQ(image.bytes8()[0], 130);
    EXPECT_EQ(image.bytes8()[2], 250);
}

// (0.6, 0, 0.8) to within one code: 128 + 127 * 0.6 is 204.2, so x is 76 / 127 and z 0.8012, which is 101.75 codes. The
// second file is UASTC of one colour (mode 8) whose descriptor says that y is in alpha.
TEST(GltfMaterial, aTwoChannelNormalMapGetsItsThird)
{
    std::uint64_t block = 0x17;
    const std::uint64_t color[] = {0xcc, 0xcc, 0xcc, 0x80};
    for (int c = 0; c < 4; ++c)
        block |= color[c] << (5 + 8 * c);
    const std::string files[] = {makeKtx2({.format = 16, .levels = {{"\xcc\x80"}}}),
                                 makeKtx2({.format = 0,
                                           .levels = {{test::little(block, 8) + std::string(8, '\0')}},
                                           .colourModel = 166,
                                           .channelTypes = {5}})};
    for (const std::string& file : files) {
        Gltf g = square();
        addNormalMap(g);
        g.root["images"][0] = {{"uri", "data:image/ktx2;base64," + base64(file)}};
        g.root["extensionsUsed"] = g.root["extensionsRequired"] = {"KHR_texture_basisu"};
        g.root["textures"][0] = {{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}};
        COTAN_LOADED(scene, g.load());
        EXPECT_TRUE(scene.warnings.empty());
        ASSERT_EQ(scene.images.at(0).pixelCount(), 1u);
        EXPECT_EQ(scene.images[0].bytes8()[0], 204);
        EXPECT_EQ(scene.images[0].bytes8()[1], 128);
        EXPECT_EQ(scene.images[0].bytes8()[2], 230);
    }
}

TEST(GltfMaterial, unusedImagesAreNotDecoded)
{
    Gltf g = square();
    g.add("images", {{"uri", "data:image/png;base64,aGVsbG8="}});
    COTAN_LOADED(scene, g.load());
    EXPECT_TRUE(scene.images.empty());
}

// ---- lights and cameras ---------------------------------------------------------------------

TEST(GltfLights, shineAlongTheirNodesMinusZ)
{
    Gltf g = square();
    const double h = std::sqrt(0.5); // -z rotated about x by -90 degrees points down
    g.root["extensionsUsed"] = {"KHR_lights_punctual"};
    g.root["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"},
         {"color", {1, 0.5, 0}},
         {"intensity", 40},
         {"range", 12},
         {"spot", {{"innerConeAngle", 0.25}, {"outerConeAngle", 0.5}}}},
        {{"type", "directional"}}};
    g.add("nodes",
          {{"translation", {1, 2, 3}},
           {"rotation", {-h, 0, 0, h}},
           {"scale", {3, 3, 3}},
           {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    g.root["scenes"][0]["nodes"] = {0, 1};
    COTAN_LOADED(scene, g.load());
    ASSERT_EQ(scene.lights.size(), 1u) << "only lights that a node places";
    const Light& light = scene.lights[0];
    EXPECT_EQ(light.kind, LightKind::spot);
    EXPECT_EQ(light.color, glm::vec3(1, 0.5, 0));
    EXPECT_EQ(light.intensity, 40.0f);
    EXPECT_EQ(light.range, 12.0f);
    EXPECT_EQ(light.innerCone, 0.25f);
    EXPECT_EQ(light.outerCone, 0.5f);
    EXPECT_EQ(light.position, glm::vec3(1, 2, 3));
    expectNear(light.direction, {0, -1, 0});
}

TEST(GltfCameras, lookAlongTheirNodesMinusZ)
{
    Gltf g = square();
    g.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}});
    g.add("cameras",
          {{"type", "orthographic"}, {"orthographic", {{"xmag", 4}, {"ymag", 3}, {"znear", 0}, {"zfar", 9}}}});
    g.add("nodes", {{"camera", 0}, {"name", "front"}, {"translation", {0, 0, 9}}});
    g.add("nodes", {{"camera", 1}, {"rotation", {0, 1, 0, 0}}}); // 180 degrees about y
    g.root["scenes"][0]["nodes"] = {0, 1, 2};
    COTAN_LOADED(scene, g.load());
    ASSERT_EQ(scene.cameras.size(), 2u);
    EXPECT_EQ(scene.cameras[0].name, "front");
    EXPECT_FALSE(scene.cameras[0].orthographic);
    EXPECT_EQ(scene.cameras[0].verticalFieldOfView, 0.5f);
    EXPECT_EQ(scene.cameras[0].eye, glm::vec3(0, 0, 9));
    expectNear(scene.cameras[0].target, {0, 0, 8});
    expectNear(scene.cameras[0].up, {0, 1, 0});
    EXPECT_TRUE(scene.cameras[1].orthographic);
    EXPECT_EQ(scene.cameras[1].verticalExtent, 6.0f) << "ymag is half the height";
    expectNear(scene.cameras[1].target, {0, 0, 1});
}

// The extensions listed in docs/reference/files.md.
TEST(GltfExtensions, supportedOnesAreNotReportedAsIgnored)
{
    for (const char* const name :
         {"KHR_draco_mesh_compression", "EXT_meshopt_compression",  "KHR_meshopt_compression",
          "KHR_mesh_quantization",      "EXT_mesh_gpu_instancing",  "KHR_texture_transform",
          "KHR_lights_punctual",        "KHR_materials_unlit",      "KHR_materials_emissive_strength",
          "KHR_materials_clearcoat",    "KHR_materials_anisotropy", "KHR_materials_ior",
          "KHR_materials_specular",     "KHR_materials_sheen",      "KHR_materials_transmission",
          "KHR_materials_variants",     "EXT_texture_webp",         "MSFT_texture_dds",
          "KHR_texture_basisu",         "EXT_texture_astc"}) {
        Gltf g = square();
        g.root["extensionsUsed"] = g.root["extensionsRequired"] = {name};
        COTAN_LOADED(scene, g.load());
        EXPECT_FALSE(warns(scene, "ignored")) << name;
    }
}

TEST(GltfExtensions, ignoredOnesAreWarnedOf)
{
    Gltf g = square();
    g.root["extensionsUsed"] = {"KHR_materials_iridescence", "KHR_texture_transform"};
    COTAN_LOADED(scene, g.load());
    EXPECT_TRUE(warns(scene, "ignored: KHR_materials_iridescence"));
    EXPECT_FALSE(warns(scene, "KHR_texture_transform"));
}

} // namespace
