// Compares MikkTSpace tangents of glTF models with those of another implementation.
#include "tangents_oracle.hpp"

#include "cotan/model.hpp"

namespace {

using namespace cotan::test;

class MikktspaceGltfOracle : public testing::TestWithParam<const char*> {};

// The oracle lists the corners of all primitives in file order, which for these models is the order of loaded meshes.
TEST_P(MikktspaceGltfOracle, agreesOnGltfModel)
{
    const std::filesystem::path model = dataFile(GetParam());
    const std::string oracle = oracleOf(model);
    COTAN_NEEDS_DATA(GetParam());
    COTAN_NEEDS_DATA(oracle);
    const cotan::Result<cotan::Scene> scene = cotan::loadScene(model);
    ASSERT_TRUE(scene) << scene.error().message;
    const std::vector<glm::vec4> expected = readOracle(dataFile(oracle));
    std::size_t first = 0, different = 0;
    for (const cotan::Mesh& mesh : scene->meshes) {
        const cotan::MeshView view{mesh.positions, mesh.normals, mesh.texcoords[0], mesh.indices};
        different += differingCorners(view, expected, first, mesh.name);
        first += mesh.indices.size();
    }
    EXPECT_EQ(first, expected.size());
    EXPECT_EQ(different, 0u);
}

INSTANTIATE_TEST_SUITE_P(Models, MikktspaceGltfOracle,
                         testing::Values("models/NormalTangentTest/NormalTangentTest.glb",
                                         "models/NormalTangentMirrorTest/NormalTangentMirrorTest.glb",
                                         "models/BoomBox/BoomBox.gltf", "synthetic/uv_cases.gltf"),
                         [](const auto& model) { return std::filesystem::path(model.param).stem().string(); });

} // namespace
