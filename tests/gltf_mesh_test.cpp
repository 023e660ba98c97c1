// Normals, tangents, morph targets and skins.
#include <cmath>

#include <glm/geometric.hpp>

#include "gltf_maker.hpp"

using namespace cotan;
using namespace cotan::test;

namespace {

TEST(GltfNormals, missingOnesAreFlatAndUnwelded)
{
    Gltf g = square();
    // The second triangle is folded up by 90 degrees about the shared edge.
    primitive(g)["attributes"]["POSITION"] = g.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3");
    primitive(g)["attributes"].erase("NORMAL");
    primitive(g)["indices"] = g.accessor(std::vector<std::uint16_t>{0, 1, 2, 0, 3, 1}, "SCALAR", kUShort);
    COTAN_LOADED(scene, g.load());
    const Mesh& mesh = scene.meshes[0];
    ASSERT_EQ(mesh.vertexCount(), 6u) << "a vertex a corner";
    EXPECT_EQ(mesh.texcoords[0].size(), 6u);
    for (std::size_t i = 0; i < 3; ++i) {
        expectNear(mesh.normals[mesh.indices[i]], {0, 0, 1});
        expectNear(mesh.normals[mesh.indices[i + 3]], {0, 1, 0});
    }
    expectNear(mesh.positions[mesh.indices[4]], {0, 0, 1});
}

TEST(GltfNormals, otherLengthsAreNormalised)
{
    Gltf g = square();
    primitive(g)["attributes"]["NORMAL"] = g.floats({0, 0, 2, 0, 0, 1, 0, 0, 0.5, 0, 0, 1}, "VEC3");
    COTAN_LOADED(scene, g.load());
    for (const glm::vec3& n : scene.meshes[0].normals)
        expectNear(n, {0, 0, 1});
    EXPECT_TRUE(warns(scene, "NORMAL: not of unit length; normalised (vertices: 2)"));
}

TEST(GltfNormals, zeroIsKeptWithAWarning)
{
    Gltf g = square();
    primitive(g)["attributes"]["NORMAL"] = g.floats(std::vector<float>(12, 0.0f), "VEC3");
    COTAN_LOADED(scene, g.load());
    EXPECT_EQ(scene.meshes[0].normals[0], glm::vec3(0));
    EXPECT_TRUE(warns(scene, "NORMAL: zero length"));
}

// The names of primitives in reports and messages.
TEST(GltfNames, ofPrimitivesAreThoseOfTheMeshAndAnIndex)
{
    for (const bool named : {true, false}) {
        Gltf g = square();
        g.root["meshes"][0]["name"] = "lid";
        if (!named)
            g.root["meshes"][0].erase("name");
        const std::string name = named ? "lid" : "mesh 0";
        COTAN_LOADED(one, g.load());
        ASSERT_EQ(one.meshes.size(), 1u);
        EXPECT_EQ(one.meshes[0].name, name);
        g.root["meshes"][0]["primitives"].push_back(primitive(g));
        COTAN_LOADED(two, g.load());
        ASSERT_EQ(two.meshes.size(), 2u);
        EXPECT_EQ(two.meshes[0].name, name + "/0");
        EXPECT_EQ(two.meshes[1].name, name + "/1");
    }
}

// ---- tangents -------------------------------------------------------------------------------

Gltf squareWithTangents(float w)
{
    Gltf g = square();
    std::vector<float> tangents;
    for (int i = 0; i < 4; ++i)
        tangents.insert(tangents.end(), {1, 0, 0, w});
    primitive(g)["attributes"]["TANGENT"] = g.floats(tangents, "VEC4");
    return g;
}

// u points along x and v against y; glTF's bitangent cross(n, t) * w points against v, so w = 1.
TEST(GltfTangents, uprightUvAgreeWithPlusOne)
{
    COTAN_LOADED(scene, squareWithTangents(1).load());
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
    EXPECT_EQ(scene.meshes[0].tangents[1], glm::vec4(1, 0, 0, 1));
}

TEST(GltfTangents, aSignAgainstTheUvIsWarnedOf)
{
    COTAN_LOADED(scene, squareWithTangents(-1).load());
    EXPECT_TRUE(warns(scene, "TANGENT.w inverted"));
    EXPECT_TRUE(warns(scene, "(triangles: 2)"));
    EXPECT_EQ(scene.meshes[0].tangents[0].w, -1.0f) << "kept as stored";
}

TEST(GltfTangents, mirroredUvAgreeWithMinusOne)
{
    Gltf g = squareWithTangents(-1);
    primitive(g)["attributes"]["TEXCOORD_0"] = g.floats({1, 1, 0, 1, 0, 0, 1, 0}, "VEC2");
    COTAN_LOADED(scene, g.load());
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
}

TEST(GltfTangents, theUvSetOfTheNormalMapDecides)
{
    Gltf g = squareWithTangents(-1);
    primitive(g)["attributes"]["TEXCOORD_1"] = g.floats({1, 1, 0, 1, 0, 0, 1, 0}, "VEC2");
    addNormalMap(g);
    g.root["materials"][0]["normalTexture"]["texCoord"] = 1;
    COTAN_LOADED(scene, g.load());
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
}

TEST(GltfTangents, areIgnoredWithoutNormals)
{
    Gltf g = squareWithTangents(1);
    primitive(g)["attributes"].erase("NORMAL");
    COTAN_LOADED(scene, g.load());
    EXPECT_TRUE(scene.meshes[0].tangents.empty());
    EXPECT_TRUE(warns(scene, "TANGENT without NORMAL"));
}

TEST(GltfTangents, wBecomesPlusOrMinusOne)
{
    COTAN_LOADED(scene, squareWithTangents(0.25f).load());
    EXPECT_EQ(scene.meshes[0].tangents[0].w, 1.0f);
    EXPECT_TRUE(warns(scene, "w is not +-1"));
}

// ---- morph targets --------------------------------------------------------------------------

Gltf squareWithTarget()
{
    Gltf g = square();
    const json target = {{"POSITION", g.floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3")}};
    primitive(g)["targets"] = json::array({target});
    return g;
}

TEST(GltfMorph, weightsOfTheMeshAreTheRestState)
{
    Gltf g = squareWithTarget();
    g.root["meshes"][0]["weights"] = {0.5};
    COTAN_LOADED(scene, g.load());
    EXPECT_EQ(scene.meshes[0].positions[2], glm::vec3(1, 1, 0.5));
}

TEST(GltfMorph, withoutWeightsTargetsHaveNoEffect)
{
    COTAN_LOADED(scene, squareWithTarget().load());
    EXPECT_EQ(scene.meshes[0].positions[2], glm::vec3(1, 1, 0));
}

TEST(GltfMorph, weightsOfANodeReplaceThoseOfTheMesh)
{
    Gltf g = squareWithTarget();
    g.root["meshes"][0]["weights"] = {0.5};
    g.add("nodes", {{"mesh", 0}, {"weights", {2.0}}});
    g.root["scenes"][0]["nodes"] = {0, 1};
    COTAN_LOADED(scene, g.load());
    ASSERT_EQ(scene.meshes.size(), 2u);
    EXPECT_EQ(scene.meshes[0].positions[0].z, 0.5f);
    EXPECT_EQ(scene.meshes[1].positions[0].z, 2.0f);
}

TEST(GltfMorph, aTargetOfAnotherSizeIsRefused)
{
    Gltf g = squareWithTarget();
    primitive(g)["targets"][0]["POSITION"] = g.floats({0, 0, 1}, "VEC3");
    COTAN_REFUSED(g.load(), "targets[0].POSITION");
}

// ---- skins ----------------------------------------------------------------------------------

// All vertices follow node 1, with this inverse bind matrix (by columns).
Gltf skinnedSquare(const std::vector<float>& inverseBind)
{
    Gltf g = square();
    primitive(g)["attributes"]["JOINTS_0"] = g.accessor(std::vector<std::uint8_t>(16, 0), "VEC4", kUByte);
    primitive(g)["attributes"]["WEIGHTS_0"] = g.floats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
    const int matrices = g.floats(inverseBind, "MAT4");
    g.add("skins", {{"joints", {1}}, {"inverseBindMatrices", matrices}});
    g.root["nodes"][0]["skin"] = 0;
    g.add("nodes", {{"name", "joint"}});
    g.root["scenes"][0]["nodes"] = {0, 1};
    return g;
}

const std::vector<float> kMovedBack = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -3, 0, 0, 1};

TEST(GltfSkin, verticesAreTransformedByJointTimesInverseBind)
{
    Gltf g = skinnedSquare(kMovedBack);
    g.root["nodes"][1]["translation"] = {3, 0, 5};
    COTAN_LOADED(scene, g.load());
    expectNear(scene.meshes[0].positions[2], {1, 1, 5});
}

TEST(GltfSkin, theTransformOfTheSkinnedNodeIsIgnored)
{
    Gltf g = skinnedSquare(kMovedBack);
    g.root["nodes"][0]["translation"] = {100, 0, 0};
    g.root["nodes"][1]["translation"] = {3, 0, 0};
    COTAN_LOADED(scene, g.load());
    EXPECT_EQ(scene.instances[0].toWorld, glm::mat4(1));
    expectNear(scene.meshes[0].positions[2], {1, 1, 0});
}

// A joint that scales x by 2: the inverse transpose moves the normal (1, 1, 0) to (1/2, 1, 0), and the tangent (1, -1,
// 0) follows the surface to (2, -1, 0). They stay perpendicular.
TEST(GltfSkin, normalsUseTheInverseTransposeAndTangentsTheMatrix)
{
    Gltf g = skinnedSquare({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
    const float h = std::sqrt(0.5f);
    primitive(g)["attributes"]["NORMAL"] = g.floats({h, h, 0, h, h, 0, h, h, 0, h, h, 0}, "VEC3");
    primitive(g)["attributes"]["TANGENT"] = g.floats({h, -h, 0, 1, h, -h, 0, 1, h, -h, 0, 1, h, -h, 0, 1}, "VEC4");
    g.root["nodes"][1]["scale"] = {2, 1, 1};
    COTAN_LOADED(scene, g.load());
    expectNear(scene.meshes[0].normals[0], glm::normalize(glm::vec3(0.5, 1, 0)));
    expectNear(glm::vec3(scene.meshes[0].tangents[0]), glm::normalize(glm::vec3(2, -1, 0)));
}

TEST(GltfSkin, aMirroringJointFlipsSignAndWinding)
{
    Gltf g = skinnedSquare({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
    primitive(g)["attributes"]["TANGENT"] = g.floats({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, "VEC4");
    g.root["nodes"][1]["scale"] = {-1, 1, 1};
    COTAN_LOADED(scene, g.load());
    const Mesh& mesh = scene.meshes[0];
    EXPECT_EQ(mesh.tangents[0], glm::vec4(-1, 0, 0, -1));
    ASSERT_EQ(mesh.indices.size(), 6u);
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::vec3 a = mesh.positions[mesh.indices[i]];
        const glm::vec3 face =
            glm::cross(mesh.positions[mesh.indices[i + 1]] - a, mesh.positions[mesh.indices[i + 2]] - a);
        EXPECT_GT(glm::dot(face, mesh.normals[0]), 0.0f) << "counter-clockwise seen from outside: " << i / 3;
    }
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
}

TEST(GltfSkin, jointsWithoutWeightsAreRefused)
{
    Gltf g = skinnedSquare(kMovedBack);
    primitive(g)["attributes"].erase("WEIGHTS_0");
    COTAN_REFUSED(g.load(), "meshes[0].primitives[0]: expected JOINTS_0 and WEIGHTS_0 together");
}

TEST(GltfSkin, aJointThatTheSkinLacksIsRefused)
{
    Gltf g = skinnedSquare(kMovedBack);
    primitive(g)["attributes"]["JOINTS_0"] = g.accessor(std::vector<std::uint8_t>(16, 1), "VEC4", kUByte);
    COTAN_REFUSED(g.load(), "refers to joint 1, but the skin has 1");
}

} // namespace
