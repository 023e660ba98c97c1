// A scene written as glTF and read again.
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "cotan/scene.hpp"
#include "cotan/tangents.hpp"
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
    // A rotation by 0.3, scales 2 and 3, an offset: as in KHR_texture_transform.
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

TEST(GltfFromScene, roundTripsGeometryAndTransforms)
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

TEST(GltfFromScene, roundTripsMaterialsAndTextures)
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

TEST(GltfFromScene, warnsThatShearsCannotBeStored)
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

TEST(GltfFromScene, refusesFloatImages)
{
    Scene scene = twoPatches();
    scene.images[0] = makeImage(2, 2, PixelType::float32, "light.exr");
    const auto document = gltfDocumentOf(scene);
    ASSERT_FALSE(document);
    EXPECT_NE(document.error().message.find("light.exr"), std::string::npos);
}

json jsonOf(const Scene& scene)
{
    const auto document = gltfDocumentOf(scene);
    EXPECT_TRUE(document) << (document ? "" : document.error().message);
    return document ? json::parse(rootOf(*document).dump()) : json();
}

// Values equal to glTF's defaults are omitted, all others are written under the specification's names.
TEST(GltfFromScene, writesOnlyNonDefaultValues)
{
    Scene scene;
    scene.meshes = {makePatch(1, 0.25f, false, 2)};
    scene.meshes[0].name = "sheet";
    scene.meshes[0].positions[0] = {-3, 5, 0.5f};
    scene.meshes[0].positions[1] = {7, -2, 4};
    scene.materials.resize(1);
    scene.instances = {{"", 0, glm::mat4(1)}, {"moved", 0, glm::translate(glm::mat4(1), {1, 2, 3})}};
    json root = jsonOf(scene);
    EXPECT_EQ(root["asset"], (json{{"version", "2.0"}, {"generator", "cotan"}}));
    EXPECT_EQ(root["scene"], 0);
    EXPECT_EQ(root["scenes"], (json{{{"nodes", {0, 1}}}}));
    EXPECT_EQ(root["nodes"],
              (json{{{"mesh", 0}},
                    {{"mesh", 0}, {"name", "moved"}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 2, 3, 1}}}}));
    EXPECT_FALSE(root.contains("extensionsUsed"));
    EXPECT_EQ(root["meshes"][0]["name"], "sheet");
    const json attributes = root["meshes"][0]["primitives"][0]["attributes"];
    const json& positions = root["accessors"][attributes["POSITION"].get<int>()];
    glm::vec3 low = scene.meshes[0].positions[0], high = low;
    for (const glm::vec3& p : scene.meshes[0].positions)
        low = glm::min(low, p), high = glm::max(high, p);
    EXPECT_EQ(positions["min"], (json{low.x, low.y, low.z}));
    EXPECT_EQ(positions["max"], (json{high.x, high.y, high.z}));
    for (const char* const absent : {"COLOR_0", "TEXCOORD_1"})
        EXPECT_FALSE(attributes.contains(absent)) << absent;
    const json plain = {
        {"name", ""},
        {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 1}}, {"metallicFactor", 1}, {"roughnessFactor", 1}}}};
    json material = root["materials"][0];
    EXPECT_EQ(material, plain);
    Material& m = scene.materials[0];
    m.emissive = {0.25f, 0.5f, 1}; // the maximum of glTF's own factor
    m.alphaMode = AlphaMode::blend;
    m.alphaCutoff = 0.25f; // applies only to masks
    m.normalScale = 0.5f;  // applies only to maps
    m.occlusionStrength = 0.5f;
    m.normalFrame = Frame::smooth;
    material = jsonOf(scene)["materials"][0];
    EXPECT_EQ(material["emissiveFactor"], (json{0.25, 0.5, 1}));
    EXPECT_EQ(material["alphaMode"], "BLEND");
    EXPECT_EQ(material["extras"]["cotanFrame"], "smooth");
    for (const char* const absent : {"extensions", "alphaCutoff", "normalTexture", "occlusionTexture", "doubleSided"})
        EXPECT_FALSE(material.contains(absent)) << absent;
    for (int k = 0; k < 3; ++k) { // any of them may be the brightest
        m.emissive = glm::vec3(0.5f);
        m.emissive[k] = 8;
        root = jsonOf(scene);
        material = root["materials"][0];
        json factor = {0.0625, 0.0625, 0.0625};
        factor[std::size_t(k)] = 1;
        EXPECT_EQ(material["emissiveFactor"], factor);
        EXPECT_EQ(material["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"], 8);
        EXPECT_EQ(root["extensionsUsed"], json{"KHR_materials_emissive_strength"});
    }
    m.unlit = m.doubleSided = true;
    m.alphaMode = AlphaMode::mask;
    m.emissive = glm::vec3(0);
    material = jsonOf(scene)["materials"][0];
    EXPECT_EQ(material["extensions"], (json{{"KHR_materials_unlit", json::object()}}));
    EXPECT_EQ(material["alphaMode"], "MASK");
    EXPECT_EQ(material["alphaCutoff"], 0.25);
    EXPECT_EQ(material["doubleSided"], true);
    EXPECT_FALSE(material.contains("emissiveFactor"));
}

TEST(GltfFromScene, roundTripsBothUvSetsAndTangents)
{
    for (const bool reversed : {false, true}) { // tangents read with reversed green are written unchanged
        Scene scene = twoPatches();
        Mesh& mesh = scene.meshes[1];
        mesh.texcoords[1] = mesh.texcoords[0];
        for (glm::vec2& uv : mesh.texcoords[1])
            uv = {3 * uv.y + 1, 2 * uv.x};
        mesh.tangents.assign(mesh.vertexCount(), glm::vec4(1, 0, 0, 1));
        mesh.tangents[0].w = -1;
        scene.materials[1].greenReversed = reversed;
        const cotan::test::TemporaryFolder folder;
        const auto document = gltfDocumentOf(scene);
        ASSERT_TRUE(document);
        ASSERT_TRUE(writeGltf(*document, folder.path / "scene.glb"));
        const ReadBack file = readBack(folder.path / "scene.glb");
        const json& attributes = file.root["meshes"][1]["primitives"][0]["attributes"];
        const auto uv = floatsOf(file, attributes["TEXCOORD_1"].get<int>(), 2);
        const auto tangents = floatsOf(file, attributes["TANGENT"].get<int>(), 4);
        ASSERT_EQ(uv.size(), 2 * mesh.vertexCount());
        ASSERT_EQ(tangents.size(), 4 * mesh.vertexCount());
        for (std::size_t v = 0; v < mesh.vertexCount(); ++v) {
            EXPECT_EQ(glm::vec2(uv[2 * v], uv[2 * v + 1]), mesh.texcoords[1][v]);
            EXPECT_EQ(tangents[4 * v + 3], mesh.tangents[v].w * (reversed ? -1.0f : 1.0f)) << v;
            EXPECT_EQ(tangents[4 * v], 1);
        }
        EXPECT_EQ(file.root["meshes"][0]["primitives"][0]["material"], 0);
        EXPECT_EQ(file.root["meshes"][1]["primitives"][0]["material"], 1);
    }
}

// Each map of a material is in its own slot, with its own image, uv set and sampler.
TEST(GltfFromScene, roundTripsEveryMapInItsSlot)
{
    Scene scene = twoPatches();
    scene.meshes[0].texcoords[1] = scene.meshes[0].texcoords[0];
    scene.images.push_back(makeReliefMap(Relief::domes, 16));
    Material& m = scene.materials[0];
    const auto use = [](int image, int set, Wrap u, Wrap v) {
        Texture t;
        t.image = image;
        t.texcoord = set;
        t.sampler.wrapU = u;
        t.sampler.wrapV = v;
        return t;
    };
    m.baseColorMap = use(2, 1, Wrap::clamp, Wrap::repeat);
    m.metallicRoughnessMap = use(1, 0, Wrap::mirror, Wrap::clamp);
    m.occlusionMap = use(0, 1, Wrap::repeat, Wrap::mirror);
    m.emissiveMap = use(1, 1, Wrap::repeat, Wrap::clamp);
    m.normalMap = use(2, 0, Wrap::mirror, Wrap::repeat);
    const Material back = written(scene).materials.at(0);
    for (const auto slot : {&Material::baseColorMap, &Material::metallicRoughnessMap, &Material::occlusionMap,
                            &Material::emissiveMap, &Material::normalMap}) {
        const Texture &made = back.*slot, &given = m.*slot;
        EXPECT_TRUE(made.present());
        EXPECT_EQ(made.texcoord, given.texcoord);
        EXPECT_EQ(made.sampler.wrapU, given.sampler.wrapU);
        EXPECT_EQ(made.sampler.wrapV, given.sampler.wrapV);
    }
    const json material = jsonOf(scene)["materials"][0];
    EXPECT_FALSE(material["normalTexture"].contains("texCoord")); // 0 is the default
    EXPECT_FALSE(material["normalTexture"].contains("extensions"));
    EXPECT_EQ(material["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"], 1);
}

// KHR_texture_transform: a rotation, a scale for each axis of uv, also negative or zero, and an offset. A shear beyond
// rounding gives a warning.
TEST(GltfFromScene, roundTripsUvTransformsAndWarnsOfShears)
{
    struct Row {
        double rotation, scaleU, scaleV, shear;
        bool warned;
    };
    for (const Row& row : {Row{0.5, 2, 3, 0, false},
                           {-2.5, 0.5, 4, 0, false},
                           {1, 2, -3, 0, false},
                           {3, 1, 1, 0, false},
                           {0, 0, 2, 0, false},
                           {0, 1, 0, 0, false},
                           {0.5, 2, 3, 2e-5, false}, // 1e-5 relative to the scales
                           {0.5, 2, -3, 8e-5, true},
                           {0.5, 2, 3, 8e-5, true},
                           {0, 0, 2, 1, true}}) {
        Scene scene = twoPatches();
        Texture& map = scene.materials[0].normalMap;
        const double c = std::cos(row.rotation), s = std::sin(row.rotation);
        map.uRow = {c * row.scaleU, s * row.scaleV + c * row.shear, 0.25f};
        map.vRow = {-s * row.scaleU, c * row.scaleV - s * row.shear, -0.75f};
        const auto document = gltfDocumentOf(scene);
        ASSERT_TRUE(document);
        const std::vector<std::string> notes = {
            "normalTexture: the shear of its texture coordinates cannot be stored in glTF"};
        EXPECT_EQ(document->notes, row.warned ? notes : std::vector<std::string>()) << row.rotation << " " << row.shear;
        const Texture back = written(scene).materials.at(0).normalMap;
        const auto near = [](const glm::vec3& a, double x, double y, double z) {
            EXPECT_LT(glm::distance(a, glm::vec3(x, y, z)), 1e-5f) << a.x << " " << a.y << " " << a.z;
        };
        near(back.uRow, c * row.scaleU, s * row.scaleV, 0.25);
        near(back.vRow, -s * row.scaleU, c * row.scaleV, -0.75);
    }
}

// glTF requires unit tangents; generators give zero where directions cancel, and callers give any.
TEST(GltfFromScene, givenTangentsOfAnyLengthAreWrittenWithUnitLength)
{
    Scene scene = twoPatches();
    Texture& map = scene.materials[0].normalMap; // without the transform that would turn the tangents
    map.uRow = {1, 0, 0};
    map.vRow = {0, 1, 0};
    Mesh& mesh = scene.meshes[0];
    const float almost = 1 + 1e-6f; // a rounding error, which stays
    mesh.tangents.assign(mesh.vertexCount(), glm::vec4(0, almost, 0, -1));
    mesh.tangents[0] = {0, 0, 0, 1};
    mesh.tangents[1] = {0, 0, -0.25f, -1};
    mesh.tangents[2] = {3, 0, 4, 1};
    const Scene back = written(scene);
    const std::vector<glm::vec4>& found = back.meshes[std::size_t(back.instances[0].mesh)].tangents;
    ASSERT_EQ(found.size(), mesh.vertexCount());
    EXPECT_EQ(found[0], glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(found[1], glm::vec4(0, 0, -1, -1));
    EXPECT_LT(glm::length(found[2] - glm::vec4(0.6f, 0, 0.8f, 1)), 1e-6f);
    EXPECT_EQ(found[3], glm::vec4(0, almost, 0, -1));
}

// At the origin opposite directions of u cancel; the triangle between them has no area in uv.
TEST(GltfFromScene, generatedTangentsAreWrittenWithUnitLengthWhereDirectionsCancel)
{
    Scene scene;
    Mesh& fan = scene.meshes.emplace_back();
    fan.positions = {{0, 0, 0}, {1, 0, 0}, {0.5f, 0.9f, 0}, {-0.5f, 0.9f, 0}, {-1, 0, 0}};
    fan.normals.assign(5, glm::vec3(0, 0, 1));
    fan.texcoords[0] = {{0, 0}, {1, 0}, {0, -1}, {0, 1}, {1, 0}};
    fan.indices = {0, 1, 2, 0, 2, 3, 0, 3, 4};
    fan.material = 0;
    scene.materials.emplace_back();
    scene.instances = {{"fan", 0, glm::mat4(1)}};
    auto document = gltfDocumentOf(scene);
    ASSERT_TRUE(document);
    const auto corners = mikktspaceTangents(MeshView{fan.positions, fan.normals, fan.texcoords[0], fan.indices});
    ASSERT_EQ(corners[3], glm::vec4(0, 0, 0, 1)) << "nothing cancels";
    const GltfCornerTangents given{0, 0, corners};
    ASSERT_TRUE(setGltfTangents(*document, {&given, 1}));
    const cotan::test::TemporaryFolder folder;
    ASSERT_TRUE(writeGltf(*document, folder.path / "fan.glb"));
    const auto loaded = loadGltf(folder.path / "fan.glb");
    ASSERT_TRUE(loaded) << loaded.error().message;
    ASSERT_FALSE(loaded->meshes[0].tangents.empty());
    for (const glm::vec4& tangent : loaded->meshes[0].tangents)
        EXPECT_NEAR(glm::length(glm::vec3(tangent)), 1, 1e-6f);
}

TEST(GltfFromScene, errorsOfDocumentsWithoutAFileBeginWithTheField)
{
    auto document = gltfDocumentOf(twoPatches());
    ASSERT_TRUE(document);
    rootOf(*document)["meshes"][1]["primitives"][0]["attributes"].erase("NORMAL");
    const GltfCornerTangents tangents{1, 0, {}};
    const auto set = setGltfTangents(*document, {&tangents, 1});
    ASSERT_FALSE(set);
    EXPECT_EQ(set.error().message,
              "meshes[1].primitives[0]: expected NORMAL, without which glTF does not define TANGENT");
}

TEST(GltfFromScene, refusesEmptyImagesByName)
{
    for (const bool floats : {false, true}) {
        Scene scene = twoPatches();
        scene.images[1] = floats ? makeImage(2, 2, PixelType::float32, "light.exr") : cotan::Image{};
        scene.images[1].name = "second";
        const auto document = gltfDocumentOf(scene);
        ASSERT_FALSE(document);
        EXPECT_EQ(document.error().message,
                  std::string("second: expected pixels of 8 or 16 bits, which glTF can hold; found ")
                      + (floats ? "floats" : "none"));
        EXPECT_EQ(document.error().kind, ErrorKind::input);
    }
}

} // namespace
