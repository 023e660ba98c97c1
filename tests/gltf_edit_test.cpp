// What the glTF editor preserves and what it removes.
#include "gltf_edit_maker.hpp"

namespace {

using namespace cotan::test;

// A square with members that mean nothing to Cotan.
Gltf richSquare()
{
    Gltf g = square();
    g.root["asset"]["copyright"] = "(c) somebody";
    g.root["asset"]["generator"] = "a tool";
    g.root["extras"] = {{"note", {1, 2.5, "three"}}};
    g.root["nodes"][0]["extras"] = {{"accessor", 3}};
    g.root["materials"][0]["extensions"]["KHR_materials_sheen"] = {{"sheenRoughnessFactor", 0.25}};
    g.root["extensionsUsed"] = {"KHR_materials_sheen"};
    const int times = g.floats({0, 1}, "SCALAR");
    g.root["accessors"][times]["min"] = {0};
    g.root["accessors"][times]["max"] = {1};
    const int rotations = g.floats({0, 0, 0, 1, 0, 0, 0, 1}, "VEC4");
    g.root["animations"] = {{{"samplers", {{{"input", times}, {"output", rotations}}}},
                             {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "rotation"}}}}}}}};
    return g;
}

// Removes the members that describe the location of bytes.
json withoutBytes(json root)
{
    for (const char* const part : {"buffers", "bufferViews"})
        root.erase(part);
    for (json& a : root["accessors"])
        for (const char* const part : {"bufferView", "byteOffset"})
            a.erase(part);
    return root;
}

class GltfUnchanged : public testing::TestWithParam<const char*> {};

TEST_P(GltfUnchanged, keepsTheJsonAndTheBytes)
{
    const Gltf g = richSquare();
    const TemporaryFolder folder;
    const auto document = openText(folder, g.text());
    ASSERT_TRUE(document) << document.error().message;
    const auto written = cotan::writeGltf(*document, folder.path / GetParam());
    ASSERT_TRUE(written) << written.error().message;
    EXPECT_TRUE(written->notes.empty());
    const ReadBack out = readBack(folder.path / GetParam());
    EXPECT_EQ(out.buffer, g.bytes);
    EXPECT_EQ(out.root["bufferViews"], g.root["bufferViews"]);
    EXPECT_EQ(withoutBytes(out.root), withoutBytes(g.root));
}

INSTANTIATE_TEST_SUITE_P(Formats, GltfUnchanged, testing::Values("out.glb", "out.gltf"), [](const auto& name) {
    return std::filesystem::path(name.param).extension().string().substr(1);
});

TEST(GltfEdit, membersKeepTheirOrder)
{
    const TemporaryFolder folder;
    std::string text = R"({"scenes":[{}],"asset":{"version":"2.0","copyright":"me"},"extras":{"b":1,"a":2}})";
    const auto document = openText(folder, text);
    ASSERT_TRUE(document) << document.error().message;
    ASSERT_TRUE(cotan::writeGltf(*document, folder.path / "out.gltf"));
    const auto out = nlohmann::ordered_json::parse(wholeFile(folder.path / "out.gltf"));
    EXPECT_EQ(out.dump(), text);
}

// The animation and the extras keep their references when accessors are renumbered.
TEST(GltfEdit, indicesFollowWhenSomethingIsRemoved)
{
    Gltf g = square();
    primitive(g)["attributes"]["TANGENT"] = g.floats({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, "VEC4");
    const int times = g.floats({0, 1}, "SCALAR");
    const int rotations = g.floats({0, 0, 0, 1, 0, 0, 1, 0}, "VEC4");
    g.root["animations"] = {{{"samplers", {{{"input", times}, {"output", rotations}}}}, {"channels", json::array()}}};
    const TemporaryFolder folder;
    auto document = openText(folder, g.text());
    ASSERT_TRUE(document) << document.error().message;
    ASSERT_TRUE(cotan::dropGltfTangents(*document, 0, 0));
    const auto written = cotan::writeGltf(*document, folder.path / "out.glb");
    ASSERT_TRUE(written);
    EXPECT_LT(written->bytesAfter, written->bytesBefore);
    const ReadBack out = readBack(folder.path / "out.glb");
    EXPECT_EQ(out.root["accessors"].size(), g.root["accessors"].size() - 1);
    EXPECT_EQ(out.buffer.size(), g.bytes.size() - 64);
    const json& sampler = out.root["animations"][0]["samplers"][0];
    EXPECT_EQ(floatsOf(out, sampler["input"], 1), (std::vector<float>{0, 1}));
    EXPECT_EQ(floatsOf(out, sampler["output"], 4), (std::vector<float>{0, 0, 0, 1, 0, 0, 1, 0}));
}

// References of an extension cannot be known, so all data are kept.
TEST(GltfEdit, unknownExtensionsKeepAllData)
{
    Gltf g = square();
    const int tangents = g.floats({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, "VEC4");
    primitive(g)["attributes"]["TANGENT"] = tangents;
    g.root["nodes"][0]["extensions"]["ACME_hair"] = {{"accessor", tangents}};
    g.root["extensionsUsed"] = {"ACME_hair"};
    const TemporaryFolder folder;
    auto document = openText(folder, g.text());
    ASSERT_TRUE(document) << document.error().message;
    ASSERT_TRUE(cotan::dropGltfTangents(*document, 0, 0));
    const auto written = cotan::writeGltf(*document, folder.path / "out.glb");
    ASSERT_TRUE(written);
    ASSERT_EQ(written->notes.size(), 1u);
    EXPECT_NE(written->notes[0].find("ACME_hair"), std::string::npos);
    const ReadBack out = readBack(folder.path / "out.glb");
    EXPECT_EQ(out.buffer, g.bytes);
    EXPECT_EQ(out.root["accessors"], g.root["accessors"]);
    EXPECT_EQ(out.root["nodes"], g.root["nodes"]);
}

TEST(GltfEdit, replacedImageIsReadBack)
{
    Gltf g = square();
    addNormalMap(g);
    g.root["images"][0]["name"] = "bumps";
    const std::string row = std::string(1, '\0') + "\xff\x80\x80";
    const Bytes red = makePng({.width = 1, .height = 1, .rows = row});
    const auto* const first = reinterpret_cast<const std::byte*>(red.data());
    const TemporaryFolder folder;
    auto document = openText(folder, g.text());
    ASSERT_TRUE(document) << document.error().message;
    cotan::replaceGltfImage(*document, 0, {first, first + red.size()}, "image/png");
    for (const char* const name : {"out.glb", "out.gltf"}) {
        ASSERT_TRUE(cotan::writeGltf(*document, folder.path / name));
        COTAN_LOADED(scene, cotan::loadGltf(folder.path / name));
        ASSERT_EQ(scene.images.size(), 1u);
        EXPECT_EQ(scene.images[0].width, 1);
        const ReadBack out = readBack(folder.path / name);
        EXPECT_EQ(out.root["images"][0]["name"], "bumps");
        // Embedded in the .glb, a separate file beside the .gltf.
        EXPECT_EQ(out.root["images"][0].value("uri", ""), std::string(name) == "out.gltf" ? "out-bumps.png" : "");
    }
}

TEST(GltfEdit, copiedMaterialReadsTheAddedImage)
{
    Gltf g = square();
    addNormalMap(g);
    const TemporaryFolder folder;
    auto document = openText(folder, g.text());
    ASSERT_TRUE(document) << document.error().message;
    const auto old = cotan::gltfImageBytes(*document, 0);
    ASSERT_TRUE(old);
    const std::size_t image = cotan::addGltfImage(*document, *old, "image/png", "again");
    const std::size_t texture = cotan::copyGltfTexture(*document, 0, image);
    const std::size_t material = cotan::copyGltfMaterial(*document, 0);
    rootOf(*document)["materials"][material]["normalTexture"]["index"] = texture;
    rootOf(*document)["meshes"][0]["primitives"][0]["material"] = material;
    ASSERT_TRUE(cotan::writeGltf(*document, folder.path / "out.glb"));
    COTAN_LOADED(scene, cotan::loadGltf(folder.path / "out.glb"));
    EXPECT_EQ(scene.images[0].width, 2);
    EXPECT_EQ(readBack(folder.path / "out.glb").root["images"].size(), 2u) << "material 0 uses the old one";
}

// The limits that make every reading of a file count in `read`.
cotan::LoadLimits countingLimits(const TemporaryFolder& folder, std::map<std::string, int>& read)
{
    cotan::LoadLimits limits;
    limits.readFile = [&](const std::string& name) -> cotan::Result<std::vector<std::byte>> {
        ++read[name];
        const std::string bytes = wholeFile(folder.path / name);
        const auto span = std::as_bytes(std::span(bytes));
        return std::vector(span.begin(), span.end());
    };
    return limits;
}

TEST(GltfEdit, anOpenModelReadsEachFileOnceForItsSceneAndItsDocument)
{
    Gltf g = richSquare();
    addNormalMap(g);
    const TemporaryFolder folder;
    folder.write("model.bin", g.bytes);
    g.root["buffers"] = {{{"byteLength", g.bytes.size()}, {"uri", "model.bin"}}};
    folder.write("model.gltf", g.root.dump());
    std::map<std::string, int> read;
    const auto opened = cotan::openGltf("model.gltf", countingLimits(folder, read));
    ASSERT_TRUE(opened) << opened.error().message;
    EXPECT_EQ(read, (std::map<std::string, int>{{"model.gltf", 1}, {"model.bin", 1}}));
    COTAN_LOADED(scene, cotan::loadGltf(folder.path / "model.gltf"));
    ASSERT_EQ(opened->scene.meshes.size(), scene.meshes.size());
    EXPECT_EQ(opened->scene.meshes[0].positions, scene.meshes[0].positions);
    EXPECT_EQ(opened->scene.images.at(0).data, scene.images.at(0).data);
    const auto alone = cotan::openGltfDocument(folder.path / "model.gltf");
    ASSERT_TRUE(alone);
    EXPECT_EQ(*cotan::glbBytes(opened->document), *cotan::glbBytes(*alone));
    read.clear();
    ASSERT_TRUE(cotan::gltfScene(opened->document));
    EXPECT_TRUE(read.empty());
}

TEST(GltfEdit, theSceneOfADocumentHasItsEdits)
{
    Gltf g = square();
    addNormalMap(g);
    primitive(g)["attributes"]["TANGENT"] = g.floats({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, "VEC4");
    g.root["meshes"].push_back(g.root["meshes"][0]);
    g.root["nodes"].push_back({{"mesh", 1}});
    g.root["scenes"][0]["nodes"].push_back(1);
    const TemporaryFolder folder;
    auto document = openText(folder, g.text());
    ASSERT_TRUE(document) << document.error().message;
    ASSERT_TRUE(cotan::dropGltfTangents(*document, 1, 0));
    const std::vector<cotan::GltfCornerTangents> mirrored = {{0, 0, cornersOf({-1, 1, 1, 1, 1, 1})}};
    ASSERT_TRUE(cotan::setGltfTangents(*document, mirrored));
    COTAN_LOADED(scene, cotan::gltfScene(*document));
    ASSERT_TRUE(cotan::writeGltf(*document, folder.path / "out.glb"));
    COTAN_LOADED(written, cotan::loadGltf(folder.path / "out.glb"));
    ASSERT_EQ(scene.meshes.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(scene.meshes[i].tangents, written.meshes[i].tangents) << i;
        EXPECT_EQ(scene.meshes[i].indices, written.meshes[i].indices) << i;
    }
    EXPECT_EQ(scene.meshes[0].vertexCount(), 5u); // one is copied, since the corners that share it differ
    EXPECT_TRUE(scene.meshes[1].tangents.empty());
}

TEST(GltfEdit, copiesOfADocumentShareTheBytesThatWereAdded)
{
    const TemporaryFolder folder;
    auto document = openText(folder, square().text());
    ASSERT_TRUE(document);
    for (const char* name : {"one", "two"})
        cotan::addGltfImage(*document, std::vector<std::byte>(9), "image/png", name);
    const cotan::GltfDocument copy = *document;
    ASSERT_EQ(copy.added.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i)
        EXPECT_EQ(copy.added[i]->data(), document->added[i]->data());
}

// The base colour is not decoded where only normal maps are read.
TEST(GltfEdit, openingForNormalMapsFindsADamagedImageOfAnotherSlot)
{
    Gltf g = square();
    addNormalMap(g);
    g.root["images"].push_back({{"uri", "data:image/png;base64,iVBORw0KGgo="}}); // a signature, nothing else
    g.root["textures"].push_back({{"source", 1}});
    g.root["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 1;
    const TemporaryFolder folder;
    cotan::LoadLimits limits;
    limits.pixels = cotan::Pixels::normalMaps;
    const auto opened = cotan::openGltf(folder.write("model.gltf", g.text()), limits);
    ASSERT_FALSE(opened);
    EXPECT_TRUE(opened.error().message.ends_with("images[1]: the PNG image 1 ends within its header"))
        << opened.error().message;
}

} // namespace
