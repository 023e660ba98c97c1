// The models of the test data, compared with independent facts: their JSON, read here without the reader under test,
// and their known traits.
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cotan/model.hpp"
#include "test_data.hpp"

using namespace cotan;
using namespace cotan::test;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

json readJson(const fs::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    std::string text((std::istreambuf_iterator<char>(stream)), {});
    if (text.starts_with("glTF")) {
        std::uint32_t length = 0;
        std::memcpy(&length, text.data() + 12, 4);
        text = text.substr(20, length);
    }
    return json::parse(text);
}

// Triangles of the file. All these models have indexed triangle lists and show each mesh exactly once.
std::size_t trianglesInFile(const json& root)
{
    std::size_t corners = 0;
    for (const json& mesh : root["meshes"])
        for (const json& primitive : mesh["primitives"])
            corners += root["accessors"][primitive["indices"].get<std::size_t>()]["count"].get<std::size_t>();
    return corners / 3;
}

std::size_t trianglesDrawn(const Scene& scene)
{
    std::size_t triangles = 0;
    for (const Instance& instance : scene.instances)
        triangles += scene.meshes[std::size_t(instance.mesh)].triangleCount();
    return triangles;
}

std::vector<fs::path> models()
{
    std::vector<fs::path> files;
    for (const char* const folder : {"models", "synthetic"})
        if (hasData(folder))
            for (const auto& entry : fs::recursive_directory_iterator(dataFile(folder)))
                if (entry.path().extension() == ".glb" || entry.path().extension() == ".gltf")
                    files.push_back(entry.path());
    return files;
}

bool warns(const Scene& scene, const std::string& word)
{
    for (const std::string& warning : scene.warnings)
        if (warning.find(word) != std::string::npos)
            return true;
    return false;
}

// Checks the invariants of every loaded scene (cotan/scene.hpp).
void expectSound(const Scene& scene)
{
    for (const Mesh& mesh : scene.meshes) {
        const std::size_t n = mesh.vertexCount();
        EXPECT_EQ(mesh.normals.size(), n);
        for (const glm::vec3& normal : mesh.normals)
            // Normalised in double, rounded to float.
            EXPECT_TRUE(std::abs(glm::length(normal) - 1) < 1e-6f || normal == glm::vec3(0));
        EXPECT_TRUE(mesh.tangents.empty() || mesh.tangents.size() == n);
        for (const glm::vec4& tangent : mesh.tangents)
            EXPECT_EQ(std::abs(tangent.w), 1.0f);
        for (const auto& set : mesh.texcoords)
            EXPECT_TRUE(set.empty() || set.size() == n);
        for (const std::uint32_t index : mesh.indices)
            ASSERT_LT(index, n);
        ASSERT_LT(std::size_t(mesh.material), scene.materials.size());
    }
    for (const Material& m : scene.materials)
        for (const Texture* t :
             {&m.baseColorMap, &m.metallicRoughnessMap, &m.normalMap, &m.occlusionMap, &m.emissiveMap})
            EXPECT_LT(t->image, int(scene.images.size()));
    for (const Image& image : scene.images)
        EXPECT_EQ(image.data.size(), image.pixelCount() * image.bytesPerPixel());
}

class GltfModels : public testing::Test {
protected:
    void SetUp() override { COTAN_NEEDS_DATA("models/FlightHelmet/FlightHelmet.gltf"); }

    Scene load(const char* file)
    {
        Result<Scene> scene = loadGltf(dataFile(file));
        EXPECT_TRUE(scene) << scene.error().message;
        return scene ? std::move(*scene) : Scene{};
    }
};

TEST_F(GltfModels, everyModelLoadsWithAllItsTriangles)
{
    for (const fs::path& file : models()) {
        SCOPED_TRACE(file.string());
        const Result<Scene> scene = loadGltf(file);
        ASSERT_TRUE(scene) << scene.error().message;
        EXPECT_EQ(trianglesDrawn(*scene), trianglesInFile(readJson(file)));
        expectSound(*scene);
    }
}

TEST_F(GltfModels, flightHelmetIsComplete)
{
    const Scene scene = load("models/FlightHelmet/FlightHelmet.gltf");
    if (isOriginal("models/FlightHelmet/FlightHelmet.gltf")) {
        EXPECT_EQ(trianglesDrawn(scene), 94722u);
    }
    EXPECT_EQ(scene.images.size(), 15u);
    EXPECT_TRUE(scene.warnings.empty());
    for (const Mesh& mesh : scene.meshes)
        EXPECT_FALSE(mesh.tangents.empty());
    for (const Image& image : scene.images)
        EXPECT_LE(image.width, 512);
}

TEST_F(GltfModels, normalTangentTestHasNoTangents)
{
    const Scene scene = load("models/NormalTangentTest/NormalTangentTest.glb");
    for (const Mesh& mesh : scene.meshes)
        EXPECT_TRUE(mesh.tangents.empty());
    EXPECT_TRUE(scene.materials.at(0).normalMap.present());
}

TEST_F(GltfModels, sofaTransformsItsNormalMapOnly)
{
    const Scene scene = load("models/GlamVelvetSofa/GlamVelvetSofa.glb");
    int transformed = 0;
    for (const Material& m : scene.materials) {
        if (m.normalMap.present())
            transformed += m.normalMap.uRow != glm::vec3(1, 0, 0);
        for (const Texture* t : {&m.baseColorMap, &m.metallicRoughnessMap, &m.occlusionMap})
            EXPECT_EQ(t->uRow, glm::vec3(1, 0, 0));
    }
    EXPECT_GT(transformed, 0);
    EXPECT_EQ(scene.lights.size(), 1u);
}

TEST_F(GltfModels, invertedTangentSignsAreFoundAndOnlyThose)
{
    EXPECT_TRUE(
        warns(load("models/SketchfabCat/scene.gltf"), "TANGENT.w contradicts the texture coordinates on 100 %"));
    EXPECT_TRUE(warns(load("models/TwoSidedPlane/TwoSidedPlane.glb"),
                      "TANGENT.w contradicts the texture coordinates on 100 %"));
    for (const char* const good :
         {"models/NormalTangentMirrorTest/NormalTangentMirrorTest.glb", "models/ClearCoatTest/ClearCoatTest.glb",
          "models/AnisotropyStrengthTest/AnisotropyStrengthTest.glb", "synthetic/uv_cases_tangents.gltf"})
        EXPECT_FALSE(warns(load(good), "inverted")) << good;
}

TEST_F(GltfModels, multiUvTestHasTwoSets)
{
    const Scene scene = load("models/MultiUVTest/MultiUVTest.glb");
    EXPECT_FALSE(scene.meshes.at(0).texcoords[1].empty());
    EXPECT_EQ(scene.cameras.size(), 1u);
}

TEST_F(GltfModels, vertexColorsAreKept)
{
    std::size_t colored = 0;
    for (const Mesh& mesh : load("models/VertexColorTest/VertexColorTest.glb").meshes)
        colored += !mesh.colors.empty();
    EXPECT_GT(colored, 0u);
}

TEST_F(GltfModels, negativeScalesOfNodesAreKept)
{
    const Scene scene = load("synthetic/uv_cases.gltf");
    std::set<std::string> mirrored;
    for (const Instance& instance : scene.instances)
        if (glm::determinant(glm::mat3(instance.toWorld)) < 0)
            mirrored.insert(instance.name);
    EXPECT_EQ(mirrored, (std::set<std::string>{"node_negative_x", "node_negative_xyz"}));
}

} // namespace
