// Setting and removing TANGENT: which vertices are copied, and that nothing else changes.
#include "gltf_edit_maker.hpp"

namespace {

using namespace cotan::test;
using cotan::GltfCornerTangents;

// Sets tangents of corners and writes a .glb.
ReadBack withTangents(const TemporaryFolder& folder, const std::string& text,
                      const std::vector<GltfCornerTangents>& tangents, std::size_t added)
{
    auto document = openText(folder, text);
    EXPECT_TRUE(document) << document.error().message;
    const auto set = cotan::setGltfTangents(*document, tangents);
    EXPECT_TRUE(set) << set.error().message;
    EXPECT_EQ(*set, added);
    const auto written = cotan::writeGltf(*document, folder.path / "out.glb");
    EXPECT_TRUE(written) << written.error().message;
    const auto loaded = cotan::loadGltf(folder.path / "out.glb");
    EXPECT_TRUE(loaded) << loaded.error().message;
    return readBack(folder.path / "out.glb");
}

TEST(GltfTangents, copyNothingIfCornersAgree)
{
    const TemporaryFolder folder;
    const ReadBack out = withTangents(folder, square().text(), {{0, 0, cornersOf({1, 1, 1, 1, 1, 1})}}, 0);
    const json& p = out.root["meshes"][0]["primitives"][0];
    EXPECT_EQ(out.root["accessors"].size(), 5u); // one more
    EXPECT_EQ(shortsOf(out, p["indices"]), kSquareIndices);
    EXPECT_EQ(floatsOf(out, p["attributes"]["TANGENT"], 4),
              (std::vector<float>{1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}));
}

TEST(GltfTangents, copyOnlyTheVertexWhoseCornersDiffer)
{
    Gltf g = square();
    primitive(g)["mode"] = 4; // the default, stated explicitly: stays
    const TemporaryFolder folder;
    const ReadBack out = withTangents(folder, g.text(), {{0, 0, cornersOf({1, 1, 1, 1, -1, 1})}}, 1);
    const json& p = out.root["meshes"][0]["primitives"][0];
    EXPECT_EQ(shortsOf(out, p["indices"]), (std::vector<std::uint16_t>{0, 1, 2, 0, 4, 3}));
    std::vector<float> positions = kSquare;
    positions.insert(positions.end(), {1, 1, 0}); // copy of vertex 2
    EXPECT_EQ(floatsOf(out, p["attributes"]["POSITION"], 3), positions);
    EXPECT_EQ(out.root["accessors"].size(), 5u) << "the old ones are gone";
    EXPECT_EQ(p["mode"], 4);
}

// Two triangles on `vertices` vertices, one of which is copied because of its tangents.
void expectIndexType(std::size_t vertices, int before, int after)
{
    Gltf g;
    std::vector<float> positions, normals;
    for (std::size_t i = 0; i < vertices; ++i) {
        positions.insert(positions.end(), {float(i), float(i % 5), float(i * i % 3)});
        normals.insert(normals.end(), {0, 0, 1});
    }
    const std::vector<std::uint32_t> order = {0, 1, 2, 0, 2, std::uint32_t(vertices - 1)};
    int indices = 0;
    if (before == kUByte)
        indices = g.accessor(std::vector<std::uint8_t>(order.begin(), order.end()), "SCALAR", kUByte);
    else
        indices = g.accessor(std::vector<std::uint16_t>(order.begin(), order.end()), "SCALAR", kUShort);
    g.add("meshes",
          {{"primitives",
            {{{"attributes", {{"POSITION", g.floats(positions, "VEC3")}, {"NORMAL", g.floats(normals, "VEC3")}}},
              {"indices", indices}}}}});
    g.add("nodes", {{"mesh", 0}});
    const TemporaryFolder folder;
    const ReadBack out = withTangents(folder, g.text(), {{0, 0, cornersOf({1, 1, 1, -1, 1, 1})}}, 1);
    const json& p = out.root["meshes"][0]["primitives"][0];
    EXPECT_EQ(out.root["accessors"][p["indices"].get<int>()]["componentType"], after) << vertices;
}

// The largest value of an index type restarts primitives and is never an index.
TEST(GltfTangents, indicesGrowBeforeTheRestartValueIsMet)
{
    expectIndexType(254, kUByte, kUByte);
    expectIndexType(255, kUByte, kUShort);
    expectIndexType(65534, kUShort, kUShort);
    expectIndexType(65535, kUShort, kUInt);
}

// Floats at byte 2 of a view at byte 2: a moved view keeps its offset modulo four.
TEST(GltfTangents, viewsKeepTheirAlignment)
{
    Gltf g = square();
    std::vector<std::uint8_t> gap(6, 0x77); // 4 bytes of the view and 2 before it
    const int first = g.view(gap);
    const int positions = g.view(kSquare);
    json& view = g.root["bufferViews"][std::size_t(positions)];
    const std::size_t at = view["byteOffset"];
    view["byteOffset"] = at - 2;
    view["byteLength"] = kSquare.size() * 4 + 2;
    g.root["bufferViews"][std::size_t(first)]["byteLength"] = 2;
    primitive(g)["attributes"]["POSITION"] = g.accessor(
        {{"bufferView", positions}, {"byteOffset", 2}, {"componentType", kFloat}, {"type", "VEC3"}, {"count", 4}});
    const TemporaryFolder folder;
    const ReadBack out = withTangents(folder, g.text(), {{0, 0, cornersOf({1, 1, 1, 1, 1, 1})}}, 0);
    const json& accessor =
        out.root["accessors"][out.root["meshes"][0]["primitives"][0]["attributes"]["POSITION"].get<int>()];
    const std::size_t offset = out.root["bufferViews"][accessor["bufferView"].get<int>()].value("byteOffset", 0u)
        + accessor.value("byteOffset", 0u);
    EXPECT_EQ(offset % 4, 0u) << "floats begin at multiples of four bytes";
}

// Bytes and shorts with padding, joints, weights, an unknown attribute, a morph target and sparse values are all copied
// exactly.
TEST(GltfTangents, copyAttributesOfAnyType)
{
    Gltf g = square();
    json& p = primitive(g);
    p["attributes"]["_PART"] = g.accessor(std::vector<std::uint8_t>{7, 8, 9, 10}, "SCALAR", kUByte);
    g.root["bufferViews"].back()["byteLength"] = 4;
    p["attributes"]["JOINTS_0"] =
        g.accessor(std::vector<std::uint8_t>{0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0}, "VEC4", kUByte);
    p["attributes"]["WEIGHTS_0"] = g.floats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
    const int sparseIndices = g.view(std::vector<std::uint16_t>{1, 2});
    const int values = g.view(std::vector<float>{0, 0, 5, 0, 0, 6});
    const int target = g.accessor({{"componentType", kFloat},
                                   {"count", 4},
                                   {"type", "VEC3"},
                                   {"min", {0, 0, 0}},
                                   {"max", {0, 0, 6}},
                                   {"sparse",
                                    {{"count", 2},
                                     {"indices", {{"bufferView", sparseIndices}, {"componentType", kUShort}}},
                                     {"values", {{"bufferView", values}}}}}});
    p["targets"] = {{{"POSITION", target}}};

    const TemporaryFolder folder;
    const ReadBack out = withTangents(folder, g.text(), {{0, 0, cornersOf({1, 1, 1, 1, -1, 1})}}, 1);
    const json& made = out.root["meshes"][0]["primitives"][0];
    std::string parts;
    for (const std::string& e : elements(out, made["attributes"]["_PART"], 1))
        parts += e;
    EXPECT_EQ(parts, "\7\10\11\12\11");
    EXPECT_EQ(elements(out, made["attributes"]["JOINTS_0"], 4)[4], std::string("\1\0\0\0", 4));
    const json& sparse = out.root["accessors"][made["targets"][0]["POSITION"].get<int>()]["sparse"];
    EXPECT_EQ(sparse["count"], 3);
    const json& view = out.root["bufferViews"][sparse["values"]["bufferView"].get<int>()];
    const std::string bytes = out.buffer.substr(view["byteOffset"], view["byteLength"]);
    std::vector<float> moved(9);
    ASSERT_EQ(bytes.size(), moved.size() * 4);
    std::memcpy(moved.data(), bytes.data(), bytes.size());
    EXPECT_EQ(moved, (std::vector<float>{0, 0, 5, 0, 0, 6, 0, 0, 6}));
}

TEST(GltfTangents, primitivesThatShareAttributesStillShareThem)
{
    Gltf g = square();
    json second = primitive(g);
    second["indices"] = g.accessor(std::vector<std::uint16_t>{0, 2, 3}, "SCALAR", kUShort);
    g.root["meshes"][0]["primitives"].push_back(second);
    const TemporaryFolder folder;
    const ReadBack out =
        withTangents(folder, g.text(), {{0, 0, cornersOf({1, 1, 1, 1, 1, 1})}, {0, 1, cornersOf({1, -1, 1})}}, 1);
    const json& made = out.root["meshes"][0]["primitives"];
    EXPECT_EQ(made[0]["attributes"], made[1]["attributes"]);
    EXPECT_EQ(shortsOf(out, made[1]["indices"]), (std::vector<std::uint16_t>{0, 4, 3}));
}

TEST(GltfTangents, stripsBecomeLists)
{
    Gltf g = square();
    primitive(g)["indices"] = g.accessor(std::vector<std::uint16_t>{1, 2, 0, 3}, "SCALAR", kUShort);
    primitive(g)["mode"] = 5;
    const TemporaryFolder folder;
    const ReadBack out = withTangents(folder, g.text(), {{0, 0, cornersOf({1, 1, 1, 1, 1, 1})}}, 0);
    const json& p = out.root["meshes"][0]["primitives"][0];
    EXPECT_FALSE(p.contains("mode"));
    // The second triangle of a strip is reversed: (2, 3, 0), with the winding of (1, 2, 0) seen from +z.
    EXPECT_EQ(shortsOf(out, p["indices"]), (std::vector<std::uint16_t>{1, 2, 0, 2, 3, 0}));
}

TEST(GltfTangents, refusePrimitivesWithoutNormals)
{
    Gltf g = square();
    primitive(g)["attributes"].erase("NORMAL");
    const TemporaryFolder folder;
    auto document = openText(folder, g.text());
    ASSERT_TRUE(document);
    const GltfCornerTangents t{0, 0, cornersOf({1, 1, 1, 1, 1, 1})};
    const auto before = rootOf(*document);
    COTAN_REFUSED(cotan::setGltfTangents(*document, std::span(&t, 1)), "expected NORMAL");
    EXPECT_EQ(rootOf(*document), before);
}

// Tangents are interleaved with other attributes: the column is removed, and the file shrinks by its size.
TEST(GltfTangents, droppedOnesAreRemovedFromInterleavedVertices)
{
    Gltf g = square();
    std::vector<float> rows;
    for (std::size_t i = 0; i < 4; ++i) {
        rows.insert(rows.end(), {kSquare[3 * i], kSquare[3 * i + 1], kSquare[3 * i + 2]});
        rows.insert(rows.end(), {1, 0, 0, 1});
        rows.insert(rows.end(), {0, 0, 1});
    }
    const int view = g.view(rows);
    g.root["bufferViews"][view]["byteStride"] = 40;
    const auto column = [&](std::size_t offset, const char* type) {
        return g.accessor(
            {{"bufferView", view}, {"byteOffset", offset}, {"componentType", kFloat}, {"count", 4}, {"type", type}});
    };
    primitive(g)["attributes"]["POSITION"] = column(0, "VEC3");
    primitive(g)["attributes"]["TANGENT"] = column(12, "VEC4");
    primitive(g)["attributes"]["NORMAL"] = column(28, "VEC3");

    const TemporaryFolder folder;
    auto document = openText(folder, g.text());
    ASSERT_TRUE(document) << document.error().message;
    ASSERT_TRUE(cotan::dropGltfTangents(*document, 0, 0));
    ASSERT_TRUE(cotan::writeGltf(*document, folder.path / "out.glb"));
    const ReadBack out = readBack(folder.path / "out.glb");
    const json& attributes = out.root["meshes"][0]["primitives"][0]["attributes"];
    EXPECT_FALSE(attributes.contains("TANGENT"));
    EXPECT_EQ(floatsOf(out, attributes["POSITION"], 3), kSquare);
    EXPECT_EQ(floatsOf(out, attributes["NORMAL"], 3), kSquareNormals);
    EXPECT_EQ(out.buffer.size(), g.bytes.size() - 4 * 16);
}

TEST(GltfTangents, droppedOnesAreRemovedFromMorphTargetsToo)
{
    Gltf g = square();
    primitive(g)["attributes"]["TANGENT"] = g.floats({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, "VEC4");
    primitive(g)["targets"] = {{{"TANGENT", g.floats(std::vector<float>(12, 0), "VEC3")}}};
    const TemporaryFolder folder;
    auto document = openText(folder, g.text());
    ASSERT_TRUE(document) << document.error().message;
    ASSERT_TRUE(cotan::dropGltfTangents(*document, 0, 0));
    ASSERT_TRUE(cotan::writeGltf(*document, folder.path / "out.glb"));
    const ReadBack out = readBack(folder.path / "out.glb");
    const json& target = out.root["meshes"][0]["primitives"][0]["targets"][0];
    EXPECT_FALSE(target.contains("TANGENT"));
    EXPECT_EQ(target.size(), 1u) << "glTF asks for one attribute at least";
    EXPECT_TRUE(cotan::loadGltf(folder.path / "out.glb"));
}

TEST(GltfTangents, droppedOnesMayBeTheOnlyAttributes)
{
    Gltf g = square();
    primitive(g)["attributes"] = {{"TANGENT", g.floats(std::vector<float>(16, 1), "VEC4")}};
    primitive(g)["targets"] = {{{"TANGENT", g.floats(std::vector<float>(12, 0), "VEC3")}}};
    const TemporaryFolder folder;
    auto document = openText(folder, g.text());
    ASSERT_TRUE(document) << document.error().message;
    ASSERT_TRUE(cotan::dropGltfTangents(*document, 0, 0));
    const auto& target = rootOf(*document)["meshes"][0]["primitives"][0]["targets"][0];
    EXPECT_EQ(rootOf(*document)["accessors"][target.at("POSITION").get<std::size_t>()]["count"], 4);
}

} // namespace
