// Attributes of glTF primitives: formats, sparse values, topology.
#include <cmath>
#include <limits>

#include "gltf_maker.hpp"

using namespace cotan;
using namespace cotan::test;

namespace {

TEST(Gltf, attributesAreReadAsStored)
{
    COTAN_LOADED(scene, square().load());
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
    ASSERT_EQ(scene.meshes.size(), 1u);
    const Mesh& mesh = scene.meshes[0];
    EXPECT_EQ(mesh.name, "square");
    ASSERT_EQ(mesh.vertexCount(), 4u);
    EXPECT_EQ(mesh.positions[2], glm::vec3(1, 1, 0));
    EXPECT_EQ(mesh.normals[3], glm::vec3(0, 0, 1));
    EXPECT_EQ(mesh.texcoords[0][2], glm::vec2(1, 0)) << "v runs down, as in the file";
    EXPECT_TRUE(mesh.texcoords[1].empty());
    EXPECT_TRUE(mesh.tangents.empty());
    EXPECT_TRUE(mesh.colors.empty());
    EXPECT_EQ(mesh.indices, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
}

TEST(Gltf, interleavedAttributesUseTheStride)
{
    Gltf g = square();
    // x y z and a number that must be skipped.
    const int view = g.view(std::vector<float>{0, 0, 0, 9, 1, 0, 0, 9, 1, 1, 0, 9, 0, 1, 0, 9});
    g.root["bufferViews"][view]["byteStride"] = 16;
    primitive(g)["attributes"]["POSITION"] =
        g.accessor({{"bufferView", view}, {"componentType", kFloat}, {"type", "VEC3"}, {"count", 4}});
    COTAN_LOADED(scene, g.load());
    EXPECT_EQ(scene.meshes[0].positions[3], glm::vec3(0, 1, 0));
}

TEST(Gltf, sparseAccessorOverridesValues)
{
    Gltf g = square();
    const int indices = g.view(std::vector<std::uint8_t>{1, 3});
    const int values = g.view(std::vector<float>{5, 6, 7, 8, 9, 10});
    const json sparse = {{"count", 2},
                         {"indices", {{"bufferView", indices}, {"componentType", kUByte}}},
                         {"values", {{"bufferView", values}}}};
    g.root["accessors"][0]["sparse"] = sparse;
    COTAN_LOADED(scene, g.load());
    const auto& p = scene.meshes[0].positions;
    EXPECT_EQ(p[0], glm::vec3(0, 0, 0));
    EXPECT_EQ(p[1], glm::vec3(5, 6, 7));
    EXPECT_EQ(p[2], glm::vec3(1, 1, 0));
    EXPECT_EQ(p[3], glm::vec3(8, 9, 10));
}

TEST(Gltf, sparseAccessorWithoutViewStartsFromZeros)
{
    Gltf g = square();
    const int indices = g.view(std::vector<std::uint16_t>{2});
    const int values = g.view(std::vector<float>{1, 2, 3});
    primitive(g)["attributes"]["POSITION"] =
        g.accessor({{"componentType", kFloat},
                    {"type", "VEC3"},
                    {"count", 4},
                    {"sparse",
                     {{"count", 1},
                      {"indices", {{"bufferView", indices}, {"componentType", kUShort}}},
                      {"values", {{"bufferView", values}}}}}});
    COTAN_LOADED(scene, g.load());
    EXPECT_EQ(scene.meshes[0].positions[1], glm::vec3(0));
    EXPECT_EQ(scene.meshes[0].positions[2], glm::vec3(1, 2, 3));
}

TEST(Gltf, accessorWithoutViewIsZeros)
{
    Gltf g = square();
    primitive(g)["attributes"]["TEXCOORD_0"] = g.accessor({{"componentType", kFloat}, {"type", "VEC2"}, {"count", 4}});
    COTAN_LOADED(scene, g.load());
    EXPECT_EQ(scene.meshes[0].texcoords[0], std::vector<glm::vec2>(4, glm::vec2(0)));
}

TEST(Gltf, normalizedIntegersBecomeFractions)
{
    Gltf g = square();
    json& attributes = primitive(g)["attributes"];
    // Signed bytes padded to four, as KHR_mesh_quantization requires: 127 is 1, and -128 is -1 like -127.
    const int view = g.view(std::vector<std::int8_t>{0, 0, 127, 0, 0, 0, -128, 0, 0, 127, 0, 0, -127, 0, 0, 0});
    g.root["bufferViews"][view]["byteStride"] = 4;
    attributes["NORMAL"] = g.accessor(
        {{"bufferView", view}, {"componentType", kByte}, {"type", "VEC3"}, {"count", 4}, {"normalized", true}});
    attributes["TEXCOORD_0"] =
        g.accessor(std::vector<std::uint16_t>{0, 65535, 13107, 0, 0, 0, 0, 0}, "VEC2", kUShort, true);
    attributes["TEXCOORD_1"] = g.accessor(std::vector<std::uint8_t>{255, 51, 0, 0, 0, 0, 0, 0}, "VEC2", kUByte, true);
    COTAN_LOADED(scene, g.load());
    const Mesh& mesh = scene.meshes[0];
    EXPECT_EQ(mesh.normals[0], glm::vec3(0, 0, 1));
    EXPECT_EQ(mesh.normals[1], glm::vec3(0, 0, -1));
    EXPECT_EQ(mesh.normals[3], glm::vec3(-1, 0, 0));
    EXPECT_EQ(mesh.texcoords[0][0], glm::vec2(0, 1));
    EXPECT_FLOAT_EQ(mesh.texcoords[0][1].x, 0.2f);
    EXPECT_EQ(mesh.texcoords[1][0].x, 1.0f);
    EXPECT_FLOAT_EQ(mesh.texcoords[1][0].y, 0.2f);
}

TEST(Gltf, quantizedPositionsKeepTheirIntegerValue)
{
    Gltf g = square();
    const int view = g.view(std::vector<std::int16_t>{0, 0, 0, 0, 1000, 0, 0, 0, 1000, 1000, 0, 0, 0, -32768, 0, 0});
    g.root["bufferViews"][view]["byteStride"] = 8;
    g.root["extensionsRequired"] = {"KHR_mesh_quantization"};
    g.root["extensionsUsed"] = {"KHR_mesh_quantization"};
    primitive(g)["attributes"]["POSITION"] =
        g.accessor({{"bufferView", view}, {"componentType", kShort}, {"type", "VEC3"}, {"count", 4}});
    COTAN_LOADED(scene, g.load());
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_EQ(scene.meshes[0].positions[2], glm::vec3(1000, 1000, 0));
    EXPECT_EQ(scene.meshes[0].positions[3], glm::vec3(0, -32768, 0));
}

TEST(Gltf, colorsMayHaveThreeComponentsOrFour)
{
    Gltf g = square();
    primitive(g)["attributes"]["COLOR_0"] = g.floats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0.5, 0.25, 0}, "VEC3");
    COTAN_LOADED(three, g.load());
    EXPECT_EQ(three.meshes[0].colors[3], glm::vec4(0.5, 0.25, 0, 1));
    primitive(g)["attributes"]["COLOR_0"] = g.accessor(std::vector<std::uint8_t>(16, 51), "VEC4", kUByte, true);
    COTAN_LOADED(four, g.load());
    EXPECT_FLOAT_EQ(four.meshes[0].colors[0].w, 0.2f);
}

TEST(Gltf, indicesOfEverySizeMeanTheSame)
{
    Gltf g = square();
    primitive(g)["indices"] = g.accessor(std::vector<std::uint8_t>{0, 1, 2, 0, 2, 3}, "SCALAR", kUByte);
    COTAN_LOADED(bytes, g.load());
    primitive(g)["indices"] = g.accessor(std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}, "SCALAR", kUInt);
    COTAN_LOADED(words, g.load());
    EXPECT_EQ(bytes.meshes[0].indices, words.meshes[0].indices);
}

TEST(Gltf, withoutIndicesVerticesCountInOrder)
{
    Gltf g = square();
    primitive(g).erase("indices");
    COTAN_LOADED(scene, g.load());
    EXPECT_EQ(scene.meshes[0].indices, (std::vector<std::uint32_t>{0, 1, 2}));
    EXPECT_TRUE(warns(scene, "not a multiple of 3"));
}

TEST(Gltf, stripsKeepTheWindingOfTheSpecification)
{
    Gltf g = square();
    primitive(g)["mode"] = 5;
    primitive(g)["indices"] = g.accessor(std::vector<std::uint16_t>{0, 1, 3, 2}, "SCALAR", kUShort);
    COTAN_LOADED(scene, g.load());
    EXPECT_EQ(scene.meshes[0].indices, (std::vector<std::uint32_t>{0, 1, 3, 1, 2, 3}));
}

TEST(Gltf, degenerateTrianglesOfStripsAreRemoved)
{
    Gltf g = square();
    primitive(g)["mode"] = 5;
    // Two strips joined by repeated corners: only triangles with three distinct corners remain.
    primitive(g)["indices"] = g.accessor(std::vector<std::uint16_t>{0, 1, 3, 3, 1, 1, 2, 3}, "SCALAR", kUShort);
    COTAN_LOADED(scene, g.load());
    EXPECT_EQ(scene.meshes[0].triangleCount(), 2u);
}

TEST(Gltf, fansShareTheirFirstVertex)
{
    Gltf g = square();
    primitive(g)["mode"] = 6;
    primitive(g)["indices"] = g.accessor(std::vector<std::uint16_t>{0, 1, 2, 3}, "SCALAR", kUShort);
    COTAN_LOADED(scene, g.load());
    EXPECT_EQ(scene.meshes[0].indices, (std::vector<std::uint32_t>{1, 2, 0, 2, 3, 0}));
}

TEST(Gltf, pointsAndLinesAreSkippedWithAWarning)
{
    for (const int mode : {0, 1, 2, 3}) {
        Gltf g = square();
        primitive(g)["mode"] = mode;
        COTAN_LOADED(scene, g.load());
        EXPECT_TRUE(scene.instances.empty());
        EXPECT_TRUE(warns(scene, "points and lines"));
    }
}

TEST(Gltf, aThirdUvSetIsWarnedOf)
{
    Gltf g = square();
    primitive(g)["attributes"]["TEXCOORD_1"] = g.floats(kSquareUv, "VEC2");
    primitive(g)["attributes"]["TEXCOORD_2"] = g.floats(kSquareUv, "VEC2");
    COTAN_LOADED(scene, g.load());
    EXPECT_EQ(scene.meshes[0].texcoords[1].size(), 4u);
    EXPECT_TRUE(warns(scene, "TEXCOORD_2"));
}

TEST(Gltf, unusableTexcoordsBecomeZero)
{
    Gltf g = square();
    primitive(g)["attributes"]["TEXCOORD_0"] =
        g.floats({0, 1, std::numeric_limits<float>::quiet_NaN(), 1, 1, 0, 0, 0}, "VEC2");
    COTAN_LOADED(scene, g.load());
    EXPECT_EQ(scene.meshes[0].texcoords[0][1], glm::vec2(0));
    EXPECT_TRUE(warns(scene, "(vertices: 1)"));
}

} // namespace
