// Material extensions, as they arrive in the scene.
#include <tuple>

#include "gltf_maker.hpp"

using namespace cotan;
using namespace cotan::test;

namespace {

TEST(GltfMaterial, coatAndAnisotropyAreRead)
{
    Gltf g = square();
    addNormalMap(g);
    const json moved = {{"index", 0},
                        {"scale", 0.5},
                        {"extensions", {{"KHR_texture_transform", {{"scale", {2, 3}}, {"offset", {0.5, 0}}}}}}};
    g.root["extensionsUsed"] = {"KHR_materials_clearcoat", "KHR_materials_anisotropy", "KHR_texture_transform"};
    g.root["materials"][0]["extensions"] = {
        {"KHR_materials_clearcoat",
         {{"clearcoatFactor", 0.75},
          {"clearcoatRoughnessFactor", 0.25},
          {"clearcoatTexture", {{"index", 0}}},
          {"clearcoatNormalTexture", moved}}},
        {"KHR_materials_anisotropy",
         {{"anisotropyStrength", 0.5}, {"anisotropyRotation", 1.25}, {"anisotropyTexture", {{"index", 0}}}}}};
    COTAN_LOADED(scene, g.load());
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
    const Material& m = scene.materials.at(0);
    EXPECT_EQ(m.coat.strength, 0.75f);
    EXPECT_EQ(m.coat.roughness, 0.25f);
    EXPECT_EQ(m.coat.normalScale, 0.5f);
    EXPECT_TRUE(m.coat.map.present());
    EXPECT_FALSE(m.coat.roughnessMap.present());
    EXPECT_EQ(m.coat.normalMap.uRow, glm::vec3(2, 0, 0.5));
    EXPECT_EQ(m.coat.normalMap.vRow, glm::vec3(0, 3, 0));
    EXPECT_EQ(m.anisotropy.strength, 0.5f);
    EXPECT_EQ(m.anisotropy.rotation, 1.25f);
    EXPECT_TRUE(m.anisotropy.map.present());
}

TEST(GltfMaterial, extrasSayHowTheNormalMapIsStored)
{
    for (const auto& [stored, expected] : {std::pair<json, Expansion>("biased", Expansion::biased),
                                           {"exact", Expansion::exact},
                                           {"other", Expansion::exact},
                                           {7, Expansion::exact}}) {
        Gltf g = square();
        addNormalMap(g);
        g.root["materials"][0]["extras"]["cotanUnsigned"] = stored;
        COTAN_LOADED(scene, g.load());
        EXPECT_EQ(scene.materials.at(0).normalFormat.expansion, expected) << stored;
    }
}

TEST(GltfMaterial, specularSheenAndTransmissionAreRead)
{
    Gltf g = square();
    addNormalMap(g);
    const auto moved = [](double u) {
        return json{{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"offset", {u, 0}}}}}}};
    };
    g.root["extensionsUsed"] = {"KHR_materials_ior", "KHR_materials_specular", "KHR_materials_sheen",
                                "KHR_materials_transmission", "KHR_texture_transform"};
    g.root["extensionsRequired"] = g.root["extensionsUsed"];
    g.root["materials"][0]["extensions"] = {
        {"KHR_materials_ior", {{"ior", 1.33}}},
        {"KHR_materials_specular",
         {{"specularFactor", 0.75},
          {"specularColorFactor", {0.5, 1, 2}},
          {"specularTexture", moved(0.1)},
          {"specularColorTexture", moved(0.2)}}},
        {"KHR_materials_sheen",
         {{"sheenColorFactor", {0.25, 0.5, 1}},
          {"sheenRoughnessFactor", 0.6},
          {"sheenColorTexture", moved(0.3)},
          {"sheenRoughnessTexture", moved(0.4)}}},
        {"KHR_materials_transmission", {{"transmissionFactor", 0.9}, {"transmissionTexture", moved(0.5)}}}};
    COTAN_LOADED(scene, g.load());
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
    const Material& m = scene.materials.at(0);
    EXPECT_EQ(m.specular.ior, 1.33f);
    EXPECT_EQ(m.specular.strength, 0.75f);
    EXPECT_EQ(m.specular.color, glm::vec3(0.5f, 1, 2));
    EXPECT_EQ(m.sheen.color, glm::vec3(0.25f, 0.5f, 1));
    EXPECT_EQ(m.sheen.roughness, 0.6f);
    EXPECT_EQ(m.transmission.strength, 0.9f);
    EXPECT_TRUE(m.translucent() && m.glossy());
    const Texture* const maps[] = {&m.specular.map, &m.specular.colorMap, &m.sheen.colorMap, &m.sheen.roughnessMap,
                                   &m.transmission.map};
    for (int i = 0; i < 5; ++i) {
        EXPECT_TRUE(maps[i]->present()) << i;
        EXPECT_FLOAT_EQ(maps[i]->uRow.z, 0.1f * float(i + 1));
    }
    // An unlit material ignores these extensions.
    g.root["materials"][0]["extensions"]["KHR_materials_unlit"] = json::object();
    COTAN_LOADED(unlit, g.load());
    EXPECT_FALSE(unlit.materials.at(0).translucent() || unlit.materials.at(0).glossy());
    EXPECT_FALSE(unlit.materials.at(0).sheen.present());
}

TEST(GltfMaterial, factorsOfExtensionsAreClamped)
{
    struct Case {
        json extension;
        glm::vec3 specular;
        float ior, strength, roughness, transmission;
    };
    const double huge = 3e38;
    const Case cases[] = {
        {{{"KHR_materials_ior", {{"ior", -3}}},
          {"KHR_materials_specular", {{"specularFactor", -1}, {"specularColorFactor", {-1, 0, huge}}}},
          {"KHR_materials_sheen", {{"sheenColorFactor", {-1, 2, huge}}, {"sheenRoughnessFactor", -2}}},
          {"KHR_materials_transmission", {{"transmissionFactor", -0.5}}}},
         {0, 0, 1e12f},
         1,
         0,
         0,
         0},
        {{{"KHR_materials_ior", {{"ior", 0}}},
          {"KHR_materials_specular", {{"specularFactor", huge}}},
          {"KHR_materials_sheen", {{"sheenColorFactor", {0, 1, 1}}, {"sheenRoughnessFactor", 7}}},
          {"KHR_materials_transmission", {{"transmissionFactor", huge}}}},
         {1, 1, 1},
         0,
         1,
         1,
         1}};
    for (const Case& c : cases) {
        Gltf g = square();
        g.root["materials"] = {{{"extensions", c.extension}}};
        g.root["meshes"][0]["primitives"][0]["material"] = 0;
        COTAN_LOADED(scene, g.load());
        const Material& m = scene.materials.at(0);
        EXPECT_EQ(m.specular.color, c.specular);
        EXPECT_EQ(m.specular.ior, c.ior);
        EXPECT_EQ(m.specular.strength, c.strength);
        EXPECT_EQ(m.sheen.color, glm::vec3(0, 1, 1));
        EXPECT_EQ(m.sheen.roughness, c.roughness);
        EXPECT_EQ(m.transmission.strength, c.transmission);
    }
    for (const auto& [name, member, value] :
         {std::tuple{"KHR_materials_ior", "ior", json("glass")},
          {"KHR_materials_specular", "specularColorFactor", json({1, 2})},
          {"KHR_materials_sheen", "sheenColorFactor", json({1, 2, nullptr})},
          {"KHR_materials_transmission", "transmissionTexture", json({{"index", 7}})}}) {
        Gltf g = square();
        g.root["materials"] = {{{"extensions", {{name, {{member, value}}}}}}};
        const auto refused = g.load();
        ASSERT_FALSE(refused) << name;
        EXPECT_NE(refused.error().message.find(std::string(name) + "." + member), std::string::npos)
            << refused.error().message;
    }
}

TEST(GltfMaterial, layersWithoutStrengthReadNoImages)
{
    Gltf g = square();
    addNormalMap(g);
    g.root["materials"][0].erase("normalTexture");
    g.root["materials"][0]["extensions"] = {
        {"KHR_materials_clearcoat", {{"clearcoatTexture", {{"index", 0}}}}},
        {"KHR_materials_anisotropy", {{"anisotropyTexture", {{"index", 0}}}}},
        {"KHR_materials_sheen", {{"sheenColorTexture", {{"index", 0}}}}},
        {"KHR_materials_transmission", {{"transmissionTexture", {{"index", 0}}}}},
        {"KHR_materials_specular", {{"specularFactor", 0}, {"specularTexture", {{"index", 0}}}}}};
    COTAN_LOADED(scene, g.load());
    EXPECT_TRUE(scene.images.empty());
    g.root["materials"][0]["extensions"]["KHR_materials_clearcoat"]["clearcoatFactor"] = "much";
    const auto refused = g.load();
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("KHR_materials_clearcoat.clearcoatFactor"), std::string::npos)
        << refused.error().message;
}

// A square whose base colour and normal map are two images with equal bytes in two views.
Gltf squareOfEqualImages()
{
    Gltf g = square();
    const std::string png = flatPng();
    for (int k = 0; k < 2; ++k) {
        g.add("images", {{"mimeType", "image/png"}, {"bufferView", g.view(std::vector<char>(png.begin(), png.end()))}});
        g.add("textures", {{"source", k}});
    }
    g.root["materials"][0]["normalTexture"] = {{"index", 0}};
    g.root["materials"][0]["pbrMetallicRoughness"] = {{"baseColorTexture", {{"index", 1}}}};
    return g;
}

TEST(GltfImages, equalOnesAreStoredOnce)
{
    COTAN_LOADED(scene, squareOfEqualImages().load());
    ASSERT_EQ(scene.images.size(), 1u);
    EXPECT_EQ(scene.materials.at(0).normalMap.image, 0);
    EXPECT_EQ(scene.materials.at(0).baseColorMap.image, 0);
    Gltf other = squareOfEqualImages();
    // The checksum of the second image's pixel data, before the 12 bytes of the last chunk, whose own checksum libpng
    // 1.6.48 ignores.
    char& checksum = other.bytes.at(other.bytes.size() - 13);
    checksum = char(checksum ^ 1);
    const auto refused = other.load();
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("images[1]"), std::string::npos) << refused.error().message;
}

TEST(GltfImages, shareABudgetThatGrowsWithTheFile)
{
    Gltf g = square();
    addNormalMap(g); // 16 bytes of pixels
    EXPECT_TRUE(g.load());
    LoadLimits none;
    none.imageBytesBeyond = 0; // 128 times its own size suffices
    EXPECT_TRUE(g.load(none));
    none.allImageBytes = 15;
    const auto refused = g.load(none);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("the limit is 15"), std::string::npos) << refused.error().message;
    EXPECT_EQ(imageBudget({}, 1'000'000), (std::size_t(192) << 20) + 128'000'000);
    EXPECT_EQ(imageBudget({}, std::uint64_t(1) << 40), LoadLimits{}.allImageBytes);
}

} // namespace
