// Metadata of copied vertices and new triangles: bounds, offsets, targets of views, notes and counts. Also refusals.
#include <limits>

#include "gltf_edit_maker.hpp"

namespace cotan::test {
namespace {

// Mesh 0: the square. Mesh 1: two primitives with their own vertices; the second is a triangle.
Gltf threeParts()
{
    Gltf g = square();
    const auto attributes = [&] {
        return json{{"POSITION", g.floats(kSquare, "VEC3")},
                    {"NORMAL", g.floats(kSquareNormals, "VEC3")},
                    {"TEXCOORD_0", g.floats(kSquareUv, "VEC2")}};
    };
    json first = {{"attributes", attributes()}, {"indices", g.accessor(kSquareIndices, "SCALAR", kUShort)}};
    json second = {{"attributes", attributes()},
                   {"indices", g.accessor(std::vector<std::uint16_t>{3, 1, 0}, "SCALAR", kUShort)}};
    g.add("meshes", {{"primitives", {first, second}}});
    g.root["nodes"][0]["children"] = {1};
    g.add("nodes", {{"mesh", 1}});
    return g;
}

TEST(GltfVertices, areCopiedPerGroupAndAllCopiesAreCounted)
{
    const TemporaryFolder folder;
    auto document = openText(folder, threeParts().text());
    ASSERT_TRUE(document) << document.error().message;
    const std::vector<GltfCornerTangents> tangents = {{0, 0, test::cornersOf({1, 1, 1, 1, -1, 1})},
                                                      {1, 0, test::cornersOf({1, 1, 1, -1, -1, 1})},
                                                      {1, 1, test::cornersOf({1, 1, -1})}};
    const auto added = setGltfTangents(*document, tangents);
    ASSERT_TRUE(added) << added.error().message;
    EXPECT_EQ(*added, 1u + 2 + 0);
    ASSERT_TRUE(writeGltf(*document, folder.path / "out.glb"));
    const ReadBack out = readBack(folder.path / "out.glb");
    const json &one = out.root["meshes"][0]["primitives"][0], &two = out.root["meshes"][1]["primitives"];
    EXPECT_EQ(shortsOf(out, one["indices"]), (std::vector<std::uint16_t>{0, 1, 2, 0, 4, 3}));
    EXPECT_EQ(shortsOf(out, two[0]["indices"]), (std::vector<std::uint16_t>{0, 1, 2, 4, 5, 3}));
    EXPECT_EQ(shortsOf(out, two[1]["indices"]), (std::vector<std::uint16_t>{3, 1, 0}));
    // Vertex 2 of the third group is in no triangle; its tangent is a unit vector nevertheless.
    EXPECT_EQ(floatsOf(out, two[1]["attributes"]["TANGENT"], 4),
              (std::vector<float>{1, 0, 0, -1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}));
    EXPECT_EQ(out.root["accessors"][two[1]["attributes"]["TANGENT"].get<int>()]["count"], 4);
}

TEST(GltfVertices, refuseTangentsWithoutChangesIfImpossible)
{
    const auto refused = [](Gltf g, const GltfCornerTangents& t, ErrorKind kind, const std::string& message) {
        const TemporaryFolder folder;
        auto document = openText(folder, g.text());
        ASSERT_TRUE(document) << document.error().message;
        const auto before = rootOf(*document);
        const auto set = setGltfTangents(*document, {&t, 1});
        ASSERT_FALSE(set);
        EXPECT_EQ(set.error().kind, kind);
        EXPECT_EQ(set.error().message, (folder.path / "model.gltf: ").string() + message);
        EXPECT_EQ(rootOf(*document), before);
    };
    const auto without = [](const char* name) {
        Gltf g = threeParts();
        g.root["meshes"][1]["primitives"][0]["attributes"].erase(name);
        return g;
    };
    const GltfCornerTangents six{1, 0, test::cornersOf({1, 1, 1, 1, 1, 1})};
    for (const char* const name : {"POSITION", "NORMAL"})
        refused(without(name), six, ErrorKind::input,
                "meshes[1].primitives[0]: expected " + std::string(name)
                    + ", without which glTF does not define TANGENT");
    refused(threeParts(), {1, 0, test::cornersOf({1, 1, 1, 1, 1})}, ErrorKind::usage,
            "meshes[1].primitives[0]: expected 6 corner tangents, found 5");
    refused(threeParts(), {1, 1, test::cornersOf({1, 1, 1, 1, 1, 1})}, ErrorKind::usage,
            "meshes[1].primitives[1]: expected 3 corner tangents, found 6");
}

// An extension that may store data per vertex is named in a note if vertices were copied, and only then.
TEST(GltfVertices, copiesUnderUnknownExtensionsGetANote)
{
    for (const float w : {1.0f, -1.0f}) {
        Gltf g = threeParts();
        json& p = g.root["meshes"][1]["primitives"][0];
        p["extensions"] = {{"ACME_hair", 1}, {"KHR_materials_variants", {{"mappings", json::array()}}}};
        const TemporaryFolder folder;
        auto document = openText(folder, g.text());
        ASSERT_TRUE(document) << document.error().message;
        const GltfCornerTangents t{1, 0, test::cornersOf({1, 1, 1, 1, w, 1})};
        ASSERT_TRUE(setGltfTangents(*document, {&t, 1}));
        std::vector<std::string> expected;
        if (w < 0)
            expected = {"meshes[1].primitives[0]: vertices were copied; its extension ACME_hair is unchanged"};
        EXPECT_EQ(document->notes, expected);
    }
}

// Bounds may be wider than the data. They stay while all vertices do, and become exact if some are removed.
TEST(GltfVertices, keepTheirBoundsIfNoneIsRemoved)
{
    for (const bool all : {true, false}) {
        Gltf g = square();
        const int positions = primitive(g)["attributes"]["POSITION"];
        g.root["accessors"][positions].update({{"min", {-2, -3, -4}}, {"max", {5, 6, 7}}});
        if (!all)
            primitive(g)["indices"] = g.accessor(std::vector<std::uint16_t>{0, 3, 0}, "SCALAR", kUShort);
        const TemporaryFolder folder;
        auto document = openText(folder, g.text());
        ASSERT_TRUE(document) << document.error().message;
        const auto rows = setGltfProvoking(*document, ProvokingVertex::first);
        ASSERT_TRUE(rows);
        const auto& root = rootOf(*document);
        const auto& made =
            root["accessors"][root["meshes"][0]["primitives"][0]["attributes"]["POSITION"].get<std::size_t>()];
        EXPECT_EQ(json::parse(made["min"].dump()), all ? json({-2, -3, -4}) : json({0, 0, 0}));
        EXPECT_EQ(json::parse(made["max"].dump()), all ? json({5, 6, 7}) : json({0, 1, 0}));
    }
}

// Sparse parts at offsets, and index accessors with every optional member: new ones start at 0 of their own view.
TEST(GltfVertices, newOnesAndNewTrianglesHaveTheirOwnViews)
{
    Gltf g = square();
    const int sparseIndices = g.view(std::vector<std::uint16_t>{9, 9, 0, 2});
    const int values = g.view(std::vector<float>{9, 9, 9, 1, 2, 3, 4, 5, 6});
    primitive(g)["targets"] = {
        {{"POSITION",
          g.accessor({{"componentType", kFloat},
                      {"count", 4},
                      {"type", "VEC3"},
                      {"sparse",
                       {{"count", 2},
                        {"indices", {{"bufferView", sparseIndices}, {"byteOffset", 4}, {"componentType", kUShort}}},
                        {"values", {{"bufferView", values}, {"byteOffset", 12}}}}}})}}};
    const int order = g.accessor({{"bufferView", g.view(std::vector<std::uint16_t>{7, 7, 1, 2, 0, 3})},
                                  {"byteOffset", 4},
                                  {"componentType", kUShort},
                                  {"type", "SCALAR"},
                                  {"count", 4},
                                  {"min", {0}},
                                  {"max", {3}},
                                  {"name", "order"}});
    primitive(g)["indices"] = order;
    primitive(g)["mode"] = 5;
    const TemporaryFolder folder;
    auto document = openText(folder, g.text());
    ASSERT_TRUE(document) << document.error().message;
    const GltfCornerTangents t{0, 0, test::cornersOf({1, 1, 1, -1, 1, 1})}; // of (1, 2, 0) and (2, 3, 0)
    ASSERT_TRUE(setGltfTangents(*document, {&t, 1}));
    ASSERT_TRUE(writeGltf(*document, folder.path / "out.glb"));
    const ReadBack out = readBack(folder.path / "out.glb");
    const json& p = out.root["meshes"][0]["primitives"][0];
    const auto accessor = [&](const json& index) { return out.root["accessors"][index.get<int>()]; };
    const auto view = [&](const json& index) { return out.root["bufferViews"][index.get<int>()]; };
    const json indices = accessor(p["indices"]);
    EXPECT_EQ(shortsOf(out, p["indices"]), (std::vector<std::uint16_t>{1, 2, 0, 4, 3, 0}));
    EXPECT_EQ(indices["count"], 6);
    EXPECT_EQ(indices["type"], "SCALAR");
    EXPECT_EQ(indices["name"], "order");
    for (const char* const gone : {"byteOffset", "min", "max", "sparse"})
        EXPECT_FALSE(indices.contains(gone)) << gone;
    EXPECT_EQ(view(indices["bufferView"])["target"], 34963); // ELEMENT_ARRAY_BUFFER
    EXPECT_FALSE(view(indices["bufferView"]).contains("byteStride"));
    for (const auto& [name, stride] : {std::pair("POSITION", 12), {"TEXCOORD_0", 8}, {"TANGENT", 16}}) {
        const json of = view(accessor(p["attributes"][name])["bufferView"]);
        EXPECT_EQ(of["target"], 34962) << name; // ARRAY_BUFFER
        EXPECT_EQ(of["byteStride"], stride) << name;
        EXPECT_EQ(of["byteLength"], 5 * stride) << name;
    }
    const json sparse = accessor(p["targets"][0]["POSITION"])["sparse"];
    EXPECT_EQ(sparse["count"], 3); // vertices 0, 2 and the copy of 2
    for (const char* const part : {"indices", "values"}) {
        EXPECT_FALSE(sparse[part].contains("byteOffset")) << part;
        EXPECT_FALSE(view(sparse[part]["bufferView"]).contains("target")) << part;
        EXPECT_FALSE(view(sparse[part]["bufferView"]).contains("byteStride")) << part;
    }
    EXPECT_EQ(sparse["indices"]["componentType"], kUByte); // five vertices
    EXPECT_EQ(out.buffer.substr(view(sparse["indices"]["bufferView"])["byteOffset"], 3), std::string("\0\2\4", 3));
    const std::size_t at = view(sparse["values"]["bufferView"])["byteOffset"];
    const std::vector<float> expected = {1, 2, 3, 4, 5, 6, 4, 5, 6};
    EXPECT_EQ(std::memcmp(out.buffer.data() + at, expected.data(), 36), 0);
}

// Equal strips share all that they draw, also morph targets; with other targets or triangles they do not.
TEST(GltfVertices, areSharedByEqualPrimitives)
{
    Gltf g = square();
    primitive(g)["indices"] = g.accessor(std::vector<std::uint16_t>{1, 2, 0, 3}, "SCALAR", kUShort);
    primitive(g)["mode"] = 5;
    const int up = g.floats(std::vector<float>(12, 1), "VEC3"), down = g.floats(std::vector<float>(12, -1), "VEC3");
    json& primitives = g.root["meshes"][0]["primitives"];
    primitives[0]["targets"] = {{{"POSITION", up}}};
    for (int i = 0; i < 2; ++i)
        primitives.push_back(primitives[0]);
    primitives[1]["targets"] = {{{"POSITION", down}}};
    json single = primitives[0];
    g.add("meshes", {{"primitives", {{{"attributes", {{"POSITION", up}}}, {"mode", 0}}, single}}});
    const TemporaryFolder folder;
    auto document = openText(folder, g.text());
    ASSERT_TRUE(document) << document.error().message;
    const auto rows = setGltfProvoking(*document, ProvokingVertex::last);
    ASSERT_TRUE(rows) << rows.error().message;
    ASSERT_EQ(rows->size(), 2u); // the first of each kind; points have no triangles
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(rows->at(i).mesh, 0u);
        EXPECT_EQ(rows->at(i).primitive, i);
        EXPECT_EQ(rows->at(i).triangles, 2u);
        EXPECT_EQ(rows->at(i).verticesBefore, 4u);
        EXPECT_EQ(rows->at(i).verticesAfter, 4u);
    }
    const auto& made = rootOf(*document)["meshes"][0]["primitives"];
    const auto& far = rootOf(*document)["meshes"][1]["primitives"];
    for (const char* const part : {"attributes", "indices", "targets"}) {
        EXPECT_EQ(made[2][part], made[0][part]) << part;
        EXPECT_EQ(far[1][part], made[0][part]) << part;
    }
    EXPECT_NE(made[1]["targets"], made[0]["targets"]);
    EXPECT_NE(made[1]["attributes"], made[0]["attributes"]);
    for (const auto* const p : {&made[0], &made[1], &made[2], &far[1]})
        EXPECT_FALSE(p->contains("mode"));
    EXPECT_EQ(far[0]["mode"], 0);
}

// In each target: only a target with nothing else becomes an explicit "no change".
TEST(GltfVertices, loseTangentsInEveryMorphTarget)
{
    Gltf g = square();
    const int change = g.floats(std::vector<float>(12, 0.5f), "VEC3");
    primitive(g)["attributes"]["TANGENT"] = g.floats({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, "VEC4");
    primitive(g)["targets"] = {{{"NORMAL", change}}, {{"TANGENT", change}}, {{"NORMAL", change}, {"TANGENT", change}}};
    const TemporaryFolder folder;
    auto document = openText(folder, g.text());
    ASSERT_TRUE(document) << document.error().message;
    ASSERT_TRUE(dropGltfTangents(*document, 0, 0));
    const auto& root = rootOf(*document);
    const json targets = json::parse(root["meshes"][0]["primitives"][0]["targets"].dump());
    ASSERT_EQ(root["accessors"].size(), g.root["accessors"].size() + 1);
    const std::size_t zero = g.root["accessors"].size();
    EXPECT_EQ(targets, json({{{"NORMAL", change}}, {{"POSITION", zero}}, {{"NORMAL", change}}}));
    EXPECT_EQ(
        json::parse(root["accessors"][zero].dump()),
        json({{"componentType", kFloat}, {"count", 4}, {"type", "VEC3"}, {"min", {0, 0, 0}}, {"max", {0, 0, 0}}}));
}

// ---- opening --------------------------------------------------------------------------------

// Also attributes that loadGltf ignores: unknown names, in any primitive and target.
TEST(GltfVertices, differentAttributeCountsAreRefused)
{
    for (const bool target : {false, true}) {
        Gltf g = threeParts();
        const int three = g.floats(std::vector<float>(9, 1), "VEC3");
        json& p = g.root["meshes"][1]["primitives"][1];
        (target ? p["targets"][0] : p["attributes"])["_ODD"] = three;
        const TemporaryFolder folder;
        COTAN_REFUSED(openText(folder, g.text()), "meshes[1].primitives[1]._ODD: expected 4 elements, found 3");
        p["attributes"].erase("POSITION"); // then none of it is read
        EXPECT_TRUE(openText(folder, g.text()));
    }
    Gltf g = threeParts();
    g.root["meshes"][1]["primitives"][1]["indices"] =
        g.accessor(std::vector<std::uint16_t>{0, 4, 1}, "SCALAR", kUShort);
    const TemporaryFolder folder;
    COTAN_REFUSED(openText(folder, g.text()),
                  "meshes[1].primitives[1].indices: index 1 is 4, but there are 4 vertices");
    g = threeParts();
    g.root["nodes"][1]["children"] = {0};
    COTAN_REFUSED(openText(folder, g.text()), "nodes[");
}

// NaN reads the map's first texel, transformed like all others.
TEST(GltfVertices, withoutUsableUvReadTheOriginOfTheMap)
{
    const float nan = std::numeric_limits<float>::quiet_NaN(), far = std::numeric_limits<float>::infinity();
    for (const bool moved : {false, true}) {
        Gltf g = square();
        addNormalMap(g);
        primitive(g)["attributes"]["TEXCOORD_0"] = g.floats({0.25f, 0.5f, nan, 0.5f, 0.25f, far, 1, 2}, "VEC2");
        if (moved)
            g.root["materials"][0]["normalTexture"]["extensions"]["KHR_texture_transform"] = {{"offset", {3, 5}},
                                                                                              {"scale", {2, 4}}};
        const TemporaryFolder folder;
        const auto document = openText(folder, g.text());
        ASSERT_TRUE(document) << document.error().message;
        const auto geometry = gltfGeometry(*document, 0, 0);
        ASSERT_TRUE(geometry);
        const std::vector<glm::vec2> read = {{0.25f, 0.5f}, {0, 0}, {0, 0}, {1, 2}};
        ASSERT_EQ(geometry->texcoords.size(), 4u);
        for (std::size_t v = 0; v < 4; ++v)
            EXPECT_EQ(geometry->texcoords[v], moved ? read[v] * glm::vec2(2, 4) + glm::vec2(3, 5) : read[v]) << v;
    }
}

// The uv set and transform are those of the requested slot and of the replacement material.
TEST(GltfVertices, haveTheUvOfTheRequestedMap)
{
    Gltf g = square();
    addNormalMap(g);
    primitive(g)["attributes"]["TEXCOORD_1"] = g.floats({1, 2, 3, 4, 5, 6, 7, 8}, "VEC2");
    primitive(g)["attributes"]["TEXCOORD_2"] = g.floats({9, 8, 7, 6, 5, 4, 3, 2}, "VEC2");
    g.root["materials"][0]["normalTexture"]["texCoord"] = 1;
    g.root["materials"][0]["extensions"]["KHR_materials_clearcoat"]["clearcoatNormalTexture"] = {{"index", 0},
                                                                                                 {"texCoord", 2}};
    g.add("materials", {{"name", "no map"}});
    const TemporaryFolder folder;
    const auto document = openText(folder, g.text());
    ASSERT_TRUE(document) << document.error().message;
    const std::tuple<NormalSlot, std::optional<std::size_t>, int, glm::vec2> cases[] = {
        {NormalSlot::surface, {}, 1, {1, 2}},
        {NormalSlot::coat, {}, 2, {9, 8}},
        {NormalSlot::coat, 0, 2, {9, 8}},
        {NormalSlot::surface, 1, 0, {0, 1}},
        {NormalSlot::coat, 1, 0, {0, 1}}};
    for (const auto& [slot, material, set, first] : cases) {
        const auto geometry = gltfGeometry(*document, 0, 0, slot, material);
        ASSERT_TRUE(geometry);
        EXPECT_EQ(geometry->texcoordSet, set);
        EXPECT_EQ(geometry->texcoords.at(0), first);
    }
}

} // namespace
} // namespace cotan::test
