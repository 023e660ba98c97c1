// Looking up elements in the JSON of a model; tangents of a whole file: rows, counts, names and reasons.
#include "gltf_edit_maker.hpp"

namespace cotan::test {
namespace {

gltf::Json parsed(const char* text) { return gltf::Json::parse(text); }

// ---- materials and textures -----------------------------------------------------------------

TEST(GltfLookup, materialsOfAPrimitiveIncludeVariantsOnce)
{
    const gltf::Json root = parsed(R"({"materials":[{},{},{},{}]})");
    const std::pair<const char*, std::vector<std::size_t>> cases[] = {
        {R"({})", {}},
        {R"({"material":3})", {3}},
        {R"({"material":4})", {}},
        {R"({"material":2,"extensions":{"KHR_materials_variants":{"mappings":[{"material":1},{"material":2},
             {"material":4},{"material":"0"},{"material":3},{"material":1},5]}}})",
         {2, 1, 3}},
        {R"({"extensions":{"KHR_materials_variants":{"mappings":[{"material":0}]}}})", {0}},
        {R"({"material":1,"extensions":{"KHR_materials_variants":{"mappings":7}}})", {1}},
        {R"({"material":1,"extensions":{"KHR_materials_variants":[]}})", {1}}};
    for (const auto& [text, materials] : cases)
        EXPECT_EQ(materialsOf(root, parsed(text)), materials) << text;
    EXPECT_EQ(primitiveField(3, 1), "meshes[3].primitives[1]");
}

// In glTF every texture slot has a name that ends in "Texture", with the texture's number as "index".
TEST(GltfLookup, texturesInAllSlotsBelowAnObjectAreFound)
{
    const gltf::Json material = parsed(R"({
        "normalTexture":{"index":1},"texture":{"index":2},"exture":{"index":90},"pictures":{"index":91},
        "oneTexture":{"index":-3},"twoTexture":{"index":"4"},"threeTexture":7,
        "pbrMetallicRoughness":{"baseColorTexture":{"index":5},
                                "list":[{"aTexture":{"index":6}},[{"bTexture":{"index":8}}]]},
        "extensions":{"KHR_materials_clearcoat":{"clearcoatNormalTexture":{"index":9},
                                                 "clearcoatTexture":{"index":10}}}})");
    EXPECT_EQ(texturesReadBy(material), (std::set<std::size_t>{1, 2, 5, 6, 8, 9, 10}));
    EXPECT_EQ(texturesBesideNormalMaps(material), (std::set<std::size_t>{2, 5, 6, 8, 10}));
    gltf::Json root;
    root["materials"] = gltf::Json::array({gltf::Json::object(), material});
    EXPECT_EQ(normalMapOf(root, 1).texture, 1);
    EXPECT_EQ(normalMapOf(root, 1, NormalSlot::coat).texture, 9);
    EXPECT_EQ(normalMapOf(root, 0).texture, -1);
    EXPECT_EQ(normalMapOf(root, 0, NormalSlot::coat).texture, -1);
    normalSlotOf(root, 1, NormalSlot::coat)["index"] = 2;
    EXPECT_EQ(normalMapOf(root, 1, NormalSlot::coat).texture, 2);
    EXPECT_EQ(normalMapOf(root, 1).texture, 1);
}

TEST(GltfLookup, aSamplerIsThatOfTheTextureOrTheDefault)
{
    const gltf::Json root = parsed(R"({"images":[{},{}],"samplers":[{},{"wrapS":33071,"wrapT":33648,"magFilter":9728}],
        "textures":[{"source":1},{"sampler":1,"source":0}]})");
    EXPECT_EQ(textureAt(root, 0).image, 1);
    EXPECT_EQ(textureAt(root, 1).image, 0);
    const Sampler plain = samplerOf(root, textureAt(root, 0)), own = samplerOf(root, textureAt(root, 1));
    EXPECT_EQ(plain.wrapU, Wrap::repeat);
    EXPECT_EQ(plain.magnify, Filter::linear);
    EXPECT_EQ(own.wrapU, Wrap::clamp);
    EXPECT_EQ(own.wrapV, Wrap::mirror);
    EXPECT_EQ(own.magnify, Filter::nearest);
}

TEST(GltfLookup, removingExtrasAndExtensionsRemovesEmptyParents)
{
    gltf::Json material = parsed(R"({"name":"m","extras":{"other":1}})");
    setExtra(material, "key", "text");
    EXPECT_EQ(material.dump(), R"({"name":"m","extras":{"other":1,"key":"text"}})");
    setExtra(material, "key", "");
    EXPECT_EQ(material.dump(), R"({"name":"m","extras":{"other":1}})");
    setExtra(material, "other", "");
    EXPECT_EQ(material.dump(), R"({"name":"m"})");
    setExtra(material, "other", "");
    EXPECT_EQ(material.dump(), R"({"name":"m"})");
    material["extras"] = 5; // a number cannot hold it
    takeOut(material, "extras", "key");
    EXPECT_EQ(material["extras"], 5);
    setExtra(material, "key", "text");
    EXPECT_EQ(material.dump(), R"({"name":"m","extras":{"key":"text"}})");
    setExtra(material, "key", "");
    setExpansion(material, Expansion::biased);
    EXPECT_EQ(gltf::expansionOf(material), Expansion::biased);
    EXPECT_EQ(material["extras"].begin().value(), "biased");
    setExpansion(material, Expansion::exact);
    EXPECT_EQ(material.dump(), R"({"name":"m"})");

    gltf::Json root = parsed(R"({"extensionsUsed":["a","b","a"],"extensionsRequired":["a"]})");
    takeOffExtension(root, "c");
    EXPECT_EQ(root.size(), 2u);
    takeOffExtension(root, "a");
    EXPECT_EQ(root.dump(), R"({"extensionsUsed":["b"]})");
    takeOffExtension(root, "b");
    EXPECT_EQ(root.dump(), "{}");
}

TEST(GltfLookup, additionsGetTheLastIndexAndCopiedTexturesOneSource)
{
    Gltf g = square();
    addNormalMap(g);
    g.root["samplers"] = {{{"wrapS", 33071}}};
    g.root["textures"] = {
        {{"source", 0}},
        {{"source", 0}, {"sampler", 0}, {"name", "t"}, {"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}}};
    const TemporaryFolder folder;
    auto document = openText(folder, g.text());
    ASSERT_TRUE(document) << document.error().message;
    EXPECT_EQ(addGltfImage(*document, std::vector<std::byte>(3, std::byte(7)), "image/webp", ""), 1u);
    EXPECT_EQ(addGltfImage(*document, std::vector<std::byte>(4, std::byte(8)), "image/png", "named"), 2u);
    EXPECT_EQ(copyGltfTexture(*document, 1, 2), 2u);
    EXPECT_EQ(copyGltfMaterial(*document, 0), 1u);
    const auto& root = rootOf(*document);
    EXPECT_FALSE(root["images"][1].contains("name"));
    EXPECT_EQ(root["images"][1]["mimeType"], "image/webp");
    EXPECT_EQ(root["images"][2]["name"], "named");
    EXPECT_EQ(json::parse(root["textures"][2].dump()), json({{"source", 2}, {"sampler", 0}, {"name", "t"}}));
    EXPECT_EQ(root["materials"][1], root["materials"][0]);
    EXPECT_EQ(*gltfImageBytes(*document, 1), std::vector<std::byte>(3, std::byte(7)));
    EXPECT_EQ(*gltfImageBytes(*document, 2), std::vector<std::byte>(4, std::byte(8)));
    EXPECT_EQ(gltfImageBytes(*document, 0)->size(), flatPng().size());
}

// ---- transforms -----------------------------------------------------------------------------

TEST(GltfLookup, transformsMultiplyFromTheRootWithoutDuplicates)
{
    // Mesh 0 below a stretched node, twice with equal rotation; mesh 1 with a skin; mesh 2 without a node.
    const gltf::Json root = parsed(R"({"meshes":[{},{},{}],"nodes":[
        {"scale":[2,1,1],"children":[1,2]},
        {"mesh":0,"scale":[1,3,1],"translation":[9,9,9]},
        {"mesh":0,"scale":[1,3,1]},
        {"mesh":1,"skin":0,"scale":[5,1,1]},
        {"mesh":0,"scale":[1,1,4]}],"skins":[{"joints":[0]}]})");
    const auto placings = gltfMeshTransforms(root);
    ASSERT_EQ(placings.size(), 3u);
    ASSERT_EQ(placings[0].size(), 2u);
    const auto diagonal = [](const glm::dmat3& m) { return glm::dvec3(m[0][0], m[1][1], m[2][2]); };
    for (const glm::dvec3& expected : {glm::dvec3(2, 3, 1), glm::dvec3(1, 1, 4)})
        EXPECT_TRUE(diagonal(placings[0][0]) == expected || diagonal(placings[0][1]) == expected);
    EXPECT_EQ(placings[1], (std::vector<glm::dmat3>{glm::dmat3(1)}));
    EXPECT_EQ(placings[2], (std::vector<glm::dmat3>{glm::dmat3(1)}));
}

TEST(GltfLookup, aMeshHasUnitNormalsOrThoseOfItsTriangles)
{
    GltfGeometry geometry;
    geometry.positions = {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 4}};
    geometry.texcoords = {{0, 1}, {2, 3}, {4, 5}, {6, 7}};
    geometry.tangents = std::vector<glm::vec4>(4, {1, 0, 0, -1});
    geometry.indices = {0, 1, 2, 0, 2, 3, 1, 1, 3};
    GltfGeometry smooth = geometry;
    smooth.normals = {{0, 0, 2}, {0, 3, 4}, {0, 0, 0}, {0, -5, 0}};
    const Mesh with = gltfMesh(smooth), flat = gltfMesh(geometry);
    EXPECT_EQ(with.positions, geometry.positions);
    EXPECT_EQ(with.indices, geometry.indices);
    EXPECT_EQ(with.tangents, geometry.tangents);
    EXPECT_EQ(with.texcoords[0], geometry.texcoords);
    const std::vector<glm::vec3> unit = {{0, 0, 1}, {0, 0.6f, 0.8f}, {0, 0, 0}, {0, -1, 0}};
    for (std::size_t v = 0; v < 4; ++v)
        EXPECT_LT(glm::length(with.normals[v] - unit[v]), kRounding) << v;
    EXPECT_TRUE(flat.tangents.empty()); // they belong to other normals
    ASSERT_EQ(flat.positions.size(), 9u);
    ASSERT_EQ(flat.normals.size(), 9u);
    const glm::vec3 sides[] = {{0, 0, 1}, {1, 0, 0}, {0, 0, 0}}; // the last has no area
    for (std::size_t i = 0; i < 9; ++i) {
        EXPECT_EQ(flat.normals[i], sides[i / 3]) << i;
        EXPECT_EQ(flat.positions[flat.indices[i]], geometry.positions[geometry.indices[i]]) << i;
        EXPECT_EQ(flat.texcoords[0][flat.indices[i]], geometry.texcoords[geometry.indices[i]]) << i;
    }
}

// ---- tangents of a whole file ---------------------------------------------------------------

// Mesh 0, "square", has a coat map on uv set 0. Mesh 1 has no name and four primitives: with tangents, without normals,
// points, and with a map that reads a missing uv set.
Gltf manyReasons()
{
    Gltf g = square();
    addNormalMap(g);
    const json use = g.root["materials"][0]["normalTexture"];
    g.root["materials"][0].erase("normalTexture");
    g.root["materials"][0]["extensions"]["KHR_materials_clearcoat"]["clearcoatNormalTexture"] = use;
    g.add("materials", {{"normalTexture", {{"index", 0}, {"texCoord", 3}}}});
    json plain = primitive(g);
    plain.erase("material");
    json stored = plain, bare = plain, points = plain, other = plain;
    stored["attributes"]["TANGENT"] = g.floats({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, "VEC4");
    bare["attributes"].erase("NORMAL");
    points["mode"] = 0;
    other["material"] = 1;
    g.add("meshes", {{"primitives", {stored, bare, points, other}}});
    g.root["nodes"][0]["children"] = {1};
    g.add("nodes", {{"mesh", 1}});
    return g;
}

TEST(GltfTangentsOfFiles, areCountedWithReasonsForEachPrimitive)
{
    const TemporaryFolder folder;
    auto document = openText(folder, manyReasons().text());
    ASSERT_TRUE(document) << document.error().message;
    std::vector<double> fractions;
    const auto progress = [&](double fraction) { return fractions.push_back(fraction), true; };
    const auto compared = compareTangents(*document, {.progress = progress});
    ASSERT_TRUE(compared) << compared.error().message;
    EXPECT_EQ(fractions, (std::vector<double>{0.2, 0.4, 0.6, 0.8, 1}));
    EXPECT_EQ(compared->without, 1u);
    EXPECT_EQ(compared->whole.corners, 6u);
    const auto given = giveTangents(*document, {});
    ASSERT_TRUE(given) << given.error().message;
    EXPECT_EQ(given->generated, 1u);
    EXPECT_EQ(given->kept, 1u);
    EXPECT_EQ(given->skipped, 3u);
    struct Row {
        std::size_t mesh, primitive;
        const char* name;
        std::size_t triangles;
        bool stored, generated;
        const char* reason;
    };
    const Row rows[] = {{0, 0, "square", 2, false, true, ""},
                        {1, 0, "mesh 1/0", 2, true, false, ""},
                        {1, 1, "mesh 1/1", 2, false, false, "no NORMAL"},
                        {1, 2, "mesh 1/2", 0, false, false, "no triangles"},
                        {1, 3, "mesh 1/3", 2, false, false, "no TEXCOORD_3"}};
    ASSERT_EQ(given->primitives.size(), 5u);
    ASSERT_EQ(compared->primitives.size(), 5u);
    const auto listed = gltfPrimitives(*document);
    ASSERT_TRUE(listed);
    ASSERT_EQ(listed->size(), 5u);
    for (std::size_t i = 0; i < 5; ++i) {
        const PrimitiveTangents &found = given->primitives[i], &before = compared->primitives[i];
        EXPECT_EQ(found.mesh, rows[i].mesh) << i;
        EXPECT_EQ(found.primitive, rows[i].primitive) << i;
        EXPECT_EQ(found.name, rows[i].name) << i;
        EXPECT_EQ(found.triangles, rows[i].triangles) << i;
        EXPECT_EQ(found.stored, rows[i].stored) << i;
        EXPECT_EQ(found.generated, rows[i].generated) << i;
        EXPECT_EQ(found.reason, rows[i].reason) << i;
        EXPECT_EQ(before.difference.has_value(), rows[i].stored) << i;
        EXPECT_FALSE(before.generated) << i;
        EXPECT_EQ(listed->at(i).name, rows[i].name) << i;
        EXPECT_EQ(listed->at(i).reason, rows[i].reason) << i;
    }
}

// A coat map counts, and so does a map of any variant's material.
TEST(GltfTangentsOfFiles, mayBeLimitedToMappedPrimitives)
{
    Gltf g = manyReasons();
    g.root["meshes"][1]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"] = {
        {{"material", 1}, {"variants", {0}}}};
    const TemporaryFolder folder;
    auto document = openText(folder, g.text());
    ASSERT_TRUE(document) << document.error().message;
    const auto given = giveTangents(*document, {.mappedOnly = true});
    ASSERT_TRUE(given) << given.error().message;
    std::vector<std::string> names;
    for (const PrimitiveTangents& row : given->primitives)
        names.push_back(row.name);
    EXPECT_EQ(names, (std::vector<std::string>{"square", "mesh 1/0", "mesh 1/3"}));
    const auto refused = giveTangents(*document, {.frame = Frame::smooth});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().message,
              "tangents: expected the frame mikktspace, area-weighted or vertex; found smooth");
}

// Where uv have no area MikkTSpace has no direction. glTF requires a unit vector, so any will do.
TEST(GltfTangentsOfFiles, areUnitIfUvHaveNoArea)
{
    Gltf g = square();
    primitive(g)["attributes"]["TEXCOORD_0"] = g.floats(std::vector<float>(8, 0.5f), "VEC2");
    const TemporaryFolder folder;
    auto document = openText(folder, g.text());
    ASSERT_TRUE(document) << document.error().message;
    for (const Frame frame : {Frame::mikktspace, Frame::vertex}) {
        ASSERT_TRUE(giveTangents(*document, {.frame = frame, .replace = true}));
        const auto geometry = gltfGeometry(*document, 0, 0);
        ASSERT_TRUE(geometry);
        ASSERT_FALSE(geometry->tangents.empty());
        for (const glm::vec4& t : geometry->tangents)
            EXPECT_NEAR(glm::length(glm::vec3(t)), 1, kRounding);
    }
}

} // namespace
} // namespace cotan::test
