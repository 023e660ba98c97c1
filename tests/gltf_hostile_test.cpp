// Hostile input that the shared data lack: made here, each file with one fault.
#include <chrono>
#include <filesystem>
#include <limits>

#include "gltf_edit_maker.hpp"

using namespace cotan;
using namespace cotan::test;
namespace fs = std::filesystem;

namespace {

std::string glb(const std::string& text, const std::string& binary = {})
{
    std::string chunks = word(std::uint32_t(text.size())) + "JSON" + text;
    if (!binary.empty())
        chunks += word(std::uint32_t(binary.size())) + std::string("BIN\0", 4) + binary;
    return "glTF" + word(2) + word(std::uint32_t(12 + chunks.size())) + chunks;
}

// The square as GLB, with its buffer in the BIN chunk.
std::string squareGlb()
{
    Gltf g = square();
    g.root["buffers"] = {{{"byteLength", g.bytes.size()}}};
    std::string text = g.root.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    return glb(text, g.bytes);
}

TEST(GltfHostile, aGlbIsRead)
{
    COTAN_LOADED(scene, loadText(squareGlb(), "model.glb"));
    EXPECT_EQ(scene.meshes.at(0).positions[2], glm::vec3(1, 1, 0));
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
}

// For the address sanitizer: URIs of images are views into the JSON, only a part of which is kept.
TEST(GltfHostile, imagesOfFilesWithoutMaterialsAreCheckedByUri)
{
    const auto scene = loadText(R"({"asset":{"version":"2.0"},"images":[{"uri":"../a-name-that-is-not-short.png"}]})");
    if (scene) {
        ASSERT_EQ(scene->warnings.size(), 1u);
        EXPECT_NE(scene->warnings[0].find("../a-name-that-is-not-short.png"), std::string::npos) << scene->warnings[0];
    } else {
        EXPECT_NE(scene.error().message.find("../a-name-that-is-not-short.png"), std::string::npos)
            << scene.error().message;
    }
}

// A GLB cut at any byte gives an error and no crash, whether or not the header's length is corrected.
TEST(GltfHostile, aGlbCutAnywhereIsRefused)
{
    const std::string whole = squareGlb();
    for (std::size_t length = 0; length < whole.size(); length += 7) {
        std::string cut = whole.substr(0, length);
        EXPECT_FALSE(loadText(cut, "model.glb")) << length;
        if (cut.size() >= 12)
            cut.replace(8, 4, word(std::uint32_t(cut.size())));
        EXPECT_FALSE(loadText(cut, "model.glb")) << length;
    }
}

// Sets every byte of the GLB to 0, 255 and '9' in turn: any result is allowed except a crash.
TEST(GltfHostile, anyByteOfAGlbMayBeWrong)
{
    const TemporaryFolder folder;
    const std::string whole = squareGlb();
    for (std::size_t i = 0; i < whole.size(); ++i) {
        for (const char value : {'\0', '\xff', '9'}) {
            std::string changed = whole;
            changed[i] = value;
            const auto scene = loadGltf(folder.write("model.glb", changed));
            if (!scene) {
                EXPECT_EQ(scene.error().message.find('\n'), std::string::npos);
            }
        }
    }
}

TEST(GltfHostile, deepJsonIsRefusedWithoutRecursion)
{
    for (const char* const open : {"[", "{\"a\":", "{\"extras\":["}) {
        std::string text = "{\"asset\":{\"version\":\"2.0\"},\"extras\":";
        for (int i = 0; i < 200000; ++i)
            text += open;
        COTAN_REFUSED(loadText(text), "nested deeper");
    }
}

TEST(GltfHostile, bracketsInStringsAreNotNesting)
{
    Gltf g = square();
    g.root["materials"][0]["name"] = std::string(1000, '[') + "\\\"{{{";
    COTAN_LOADED(scene, g.load());
    EXPECT_EQ(scene.meshes.size(), 1u);
}

// JSON does not define duplicate names; here the last one counts, in small and in large objects.
TEST(GltfHostile, theLastDuplicateMemberWins)
{
    for (const int others : {0, 100}) {
        std::string members;
        for (int i = 0; i < others; ++i)
            members += "\"extra" + std::to_string(i) + "\":" + std::to_string(i) + ",";
        std::string text = square().text();
        const std::string node = "{\"mesh\":0}";
        ASSERT_NE(text.find(node), std::string::npos);
        text.replace(text.find(node), node.size(), "{\"name\":\"first\"," + members + "\"mesh\":0,\"name\":\"last\"}");
        COTAN_LOADED(scene, loadText(text));
        EXPECT_EQ(scene.instances.at(0).name, "last") << others;
    }
}

// Comparing each new member with all previous ones would take minutes here.
TEST(GltfHostile, aMillionMembersOfAnObjectAreReadQuickly)
{
    std::string text = square().text();
    std::string extras;
    for (int i = 0; i < 1000000; ++i)
        extras += ",\"" + std::to_string(i) + "\":0";
    text.insert(text.size() - 1, ",\"extras\":{" + extras.substr(1) + "}");
    const TemporaryFolder folder;
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_TRUE(openText(folder, text));
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    EXPECT_LT(seconds.count(), 60); // about 1 s, and ten times that with sanitizers
}

// Readers search all members of an object for a name: 50,000 in the root made a conversion take 10 s.
TEST(GltfHostile, objectsHaveAtMost4096MembersOutsideExtras)
{
    const auto membersOf = [](int count) {
        std::string members;
        for (int i = 0; i < count; ++i)
            members += "\"other" + std::to_string(i) + "\":[],";
        return members;
    };
    const auto withNode = [](const std::string& members) {
        std::string text = square().text();
        const std::string node = "{\"mesh\":0}";
        return text.replace(text.find(node), node.size(), "{" + members + "\"mesh\":0}");
    };
    COTAN_LOADED(scene, loadText(withNode(membersOf(4095))));
    EXPECT_EQ(scene.instances.size(), 1u);
    COTAN_REFUSED(loadText(withNode(membersOf(4096))), "expected at most 4096 members in an object outside extras");
    const std::string large = "{" + membersOf(5000) + "\"last\":0}";
    COTAN_LOADED(extra, loadText(withNode("\"extras\":{\"list\":[1,[" + large + "]]},")));
    EXPECT_EQ(extra.instances.size(), 1u);
    COTAN_REFUSED(loadText(withNode("\"extras\":{},\"list\":[" + large + "],")), "expected at most 4096 members");
    COTAN_REFUSED(loadText(withNode("\"list\":[{\"extras\":{\"a\":0}}," + large + "],")),
                  "expected at most 4096 members");
    COTAN_REFUSED(loadText(withNode("\"extras\":{\"list\":[0]},\"other\":" + large + ",")),
                  "expected at most 4096 members");
}

// ---- types ----------------------------------------------------------------------------------

struct Wrong {
    const char* pointer;
    json value;
    const char* message;
};

TEST(GltfHostile, wrongTypesAndRangesAreNamed)
{
    const double huge = 1e300;
    const std::vector<Wrong> cases = {
        {"/asset/version", 2, "asset.version: expected a string"},
        {"/asset/version", "3.0", "asset.version: expected 2.x"},
        {"/scene", 7, "scene: expected an index below 1"},
        {"/scene", -1, "scene: expected an index"},
        {"/scene", 0.5, "scene: expected an index"},
        {"/scenes", 3, "scenes: expected an array"},
        {"/scenes/0/nodes/0", 99, "scenes[0].nodes[0]"},
        {"/nodes/0", json::array(), "nodes[0]: expected an object"},
        {"/nodes/0/mesh", "0", "nodes[0].mesh: expected an index"},
        {"/nodes/0/mesh", 18446744073709551615u, "nodes[0].mesh: expected an index"},
        {"/nodes/0/matrix", {1, 2, 3}, "nodes[0].matrix: expected 16 numbers, found 3"},
        {"/nodes/0/scale", {1, 1, huge}, "nodes[0].scale[2]: expected a number from"},
        {"/nodes/0/translation", {"1", 0, 0}, "nodes[0].translation[0]: expected a number"},
        {"/meshes/0/primitives/0/attributes", json::array(), "attributes: expected an object"},
        {"/meshes/0/primitives/0/attributes/POSITION", 50, "attributes.POSITION"},
        {"/meshes/0/primitives/0/mode", 7, "primitives[0].mode"},
        {"/meshes/0/primitives/0/material", 1, "primitives[0].material"},
        {"/accessors/0/count", -4, "accessors[0].count"},
        {"/accessors/0/count", 1e18, "accessors[0].count"},
        {"/accessors/0/count", 9223372036854775807, "accessors[0].count"},
        {"/accessors/0/count", 5, "accessors[0]"},
        {"/accessors/0/byteOffset", 9007199254740991, "accessors[0]"},
        {"/accessors/0/byteOffset", 4, "accessors[0]"},
        {"/accessors/0/componentType", 5130, "accessors[0].componentType: expected one of"},
        {"/accessors/0/type", "VEC9", "accessors[0].type: expected one of"},
        {"/accessors/0/type", "VEC4", "accessors[0]"},
        {"/bufferViews/0/buffer", 1, "bufferViews[0].buffer"},
        {"/bufferViews/0/byteOffset", 9007199254740991, "bufferViews[0]"},
        {"/bufferViews/0/byteLength", 9007199254740991, "bufferViews[0]"},
        {"/bufferViews/0/byteStride", 8, "expected a stride of at least 12 bytes"},
        {"/bufferViews/0/byteStride", 252, "accessors[0]"},
        {"/bufferViews/0/byteStride", 13, "bufferViews[0].byteStride: expected a multiple of 4, found 13"},
        {"/cameras", {{{"type", "perspective"}}}, "cameras[0].perspective: missing"},
        {"/cameras",
         {{{"type", "orthographic"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}},
         "cameras[0].orthographic: missing"},
        {"/extensions/KHR_lights_punctual/lights",
         {{{"type", "spot"}}},
         "extensions.KHR_lights_punctual.lights[0].spot: missing"},
        {"/materials/0/alphaMode", "SOLID", "materials[0].alphaMode"},
        {"/materials/0/normalTexture", {{"index", 0}}, "normalTexture.index"},
        {"/materials/0/doubleSided", 1, "materials[0].doubleSided: expected true or false"},
        {"/extensions/KHR_lights_punctual/lights", 1, "lights: expected an array"},
        {"/extensionsRequired", "KHR_texture_transform", "extensionsRequired: expected an array"},
        {"/animations", 1, "animations: expected an array"},
    };
    for (const Wrong& wrong : cases) {
        Gltf g = square();
        g.root[json::json_pointer(wrong.pointer)] = wrong.value;
        SCOPED_TRACE(std::string(wrong.pointer) + " = " + wrong.value.dump());
        COTAN_REFUSED(g.load(), wrong.message);
    }
}

// Checked before the structure, which is different in version 1.
TEST(GltfHostile, versionOneIsRefusedWithAConverterNamed)
{
    const std::vector<json> files = {
        {{"asset", {{"version", "1.0"}}}, {"meshes", {{"m", json::object()}}}},
        {{"asset", {{"version", "1.0.1"}}}},
        {{"asset", {{"version", 1.0}}}},
        {{"asset", {{"version", "0.8"}}}},
        {{"nodes", {{"n", json::object()}}}},
        {{"asset", {{"premultipliedAlpha", true}}}, {"accessors", json::object()}},
    };
    for (const json& root : files) {
        SCOPED_TRACE(root.dump());
        COTAN_REFUSED(loadText(root.dump()), "glTF version 1 is not supported");
        COTAN_REFUSED(loadText(root.dump()), "npx gltf-pipeline");
    }
    // GLB of version 1: 20 bytes of header with the length and format of the JSON instead of chunks.
    const std::string text = "{\"asset\":{\"version\":\"1.0\"}}  ";
    COTAN_REFUSED(loadText("glTF" + word(1) + word(std::uint32_t(20 + text.size())) + word(std::uint32_t(text.size()))
                               + word(0) + text,
                           "model.glb"),
                  "glTF version 1 is not supported");
}

TEST(GltfHostile, infinityInAnyVertexAttributeIsRefused)
{
    for (const char* const name : {"POSITION", "NORMAL", "TANGENT", "COLOR_0"}) {
        Gltf g = square();
        const bool four = std::string(name) == "TANGENT";
        std::vector<float> values(four ? 16 : 12, 0.5f);
        values[5] = std::numeric_limits<float>::infinity();
        primitive(g)["attributes"][name] = g.floats(values, four ? "VEC4" : "VEC3");
        COTAN_REFUSED(g.load(), "expected finite numbers, found inf");
    }
}

TEST(GltfHostile, sparseIndicesAreChecked)
{
    Gltf g = square();
    const int indices = g.view(std::vector<std::uint8_t>{4});
    const int values = g.view(std::vector<float>{5, 6, 7});
    json sparse = {{"count", 1},
                   {"indices", {{"bufferView", indices}, {"componentType", kUByte}}},
                   {"values", {{"bufferView", values}}}};
    g.root["accessors"][0]["sparse"] = sparse;
    COTAN_REFUSED(g.load(), "sparse.indices[0]: expected an index below 4, found 4");
    sparse["count"] = 2;
    g.root["accessors"][0]["sparse"] = sparse;
    COTAN_REFUSED(g.load(), "accessors[0].sparse");
    sparse["count"] = 5;
    g.root["accessors"][0]["sparse"] = sparse;
    COTAN_REFUSED(g.load(), "accessors[0].sparse.count");
}

// The specification requires it; reading parts of an accessor relies on it.
TEST(GltfHostile, sparseIndicesHaveToRise)
{
    for (const auto& order : {std::vector<std::uint8_t>{1, 1}, std::vector<std::uint8_t>{3, 2}}) {
        Gltf g = square();
        g.root["accessors"][0]["sparse"] = {{"count", 2},
                                            {"indices", {{"bufferView", g.view(order)}, {"componentType", kUByte}}},
                                            {"values", {{"bufferView", g.view(std::vector<float>(6, 1.0f))}}}};
        COTAN_REFUSED(g.load(), "sparse.indices[1]: expected an index above " + std::to_string(order[0]));
    }
}

TEST(GltfHostile, attributesOfTheWrongKindAreRefused)
{
    Gltf g = square();
    primitive(g)["attributes"]["POSITION"] = g.floats(kSquareUv, "VEC2");
    COTAN_REFUSED(g.load(), "POSITION: expected accessors[4] of type VEC3, found VEC2");
    g = square();
    primitive(g)["attributes"]["TEXCOORD_0"] = g.floats({0, 0, 1, 1}, "VEC2");
    COTAN_REFUSED(g.load(), "with 4 elements, found 2");
    g = square();
    primitive(g)["indices"] = g.floats({0, 1, 2}, "SCALAR");
    COTAN_REFUSED(g.load(), "expected unsigned integers");
}

// The specification says zeros, but no triangle has three corners at vertex 0.
TEST(GltfHostile, indicesWithoutDataAreRefused)
{
    Gltf g = square();
    primitive(g)["indices"] = g.accessor({{"componentType", kUShort}, {"type", "SCALAR"}, {"count", 6}});
    COTAN_REFUSED(g.load(), "meshes[0].primitives[0].indices: expected accessors[4] with a bufferView, found none");
}

TEST(GltfHostile, projectiveMatricesAreRefused)
{
    Gltf g = square();
    g.root["nodes"][0]["matrix"] = {1, 0, 0, 0.5, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    COTAN_REFUSED(g.load(), "expected the last row 0 0 0 1");
}

TEST(GltfHostile, transformsThatOverflowAreRefused)
{
    Gltf g = square();
    g.root["nodes"][0]["scale"] = {1e30, 1, 1};
    g.add("nodes", {{"children", {0}}, {"scale", {1e30, 1, 1}}});
    COTAN_REFUSED(g.load(), "nodes[0]: its transform is beyond the range of float");
}

// ---- limits ---------------------------------------------------------------------------------

TEST(GltfHostile, limitsAreKept)
{
    LoadLimits limits;
    limits.vertices = 3;
    COTAN_REFUSED(square().load(limits), "the limit is 3 vertices");
    limits = {};
    limits.triangles = 1;
    COTAN_REFUSED(square().load(limits), "the limit is");
    limits = {};
    limits.nodes = 0;
    COTAN_REFUSED(square().load(limits), "nodes: the limit is 0, found 1");
    limits = {};
    limits.fileBytes = 10;
    COTAN_REFUSED(square().load(limits), "the limit is 10");
    Gltf g = square();
    addNormalMap(g);
    limits = {};
    limits.imageSide = 1;
    COTAN_REFUSED(g.load(limits), "images[0]");
    limits = {};
    limits.allImageBytes = 15; // 2 x 2 pixels take 16
    COTAN_REFUSED(g.load(limits), "images[0]");
}

// A few bytes may request any number of zeros.
TEST(GltfHostile, accessorsWithoutViewCannotTakeAllMemory)
{
    Gltf g = square();
    primitive(g)["attributes"] = {
        {"POSITION", g.accessor({{"componentType", kFloat}, {"type", "VEC3"}, {"count", 4000000000u}})}};
    COTAN_REFUSED(g.load(), "the limit is");
    // 30 million of them are below every limit on counts.
    g.root["accessors"].back()["count"] = 30'000'000;
    COTAN_REFUSED(g.load(), "accessors[4]: the accessors take 360");
    // So are morph targets, skins and instances that are not drawn.
    g = square();
    g.accessor({{"componentType", kFloat}, {"type", "MAT4"}, {"count", 30'000'000}});
    COTAN_REFUSED(g.load(), "the accessors take");
}

// The limit grows with the file: 16 times its size plus geometryBytes.
TEST(GltfHostile, zerosWithinTheAllowanceAreRead)
{
    Gltf g = square();
    primitive(g)["attributes"]["COLOR_0"] = g.accessor({{"componentType", kFloat}, {"type", "VEC4"}, {"count", 4}});
    LoadLimits limits;
    limits.geometryBytes = 0;
    COTAN_LOADED(scene, g.load(limits));
    EXPECT_EQ(scene.meshes.at(0).colors.at(0), glm::vec4(0));
}

// A mesh of many parts with one set of vertices: each part loads only its own vertices.
TEST(GltfHostile, primitivesThatShareAnAccessorLoadOnlyTheirPart)
{
    constexpr std::uint32_t kParts = 2000;
    Gltf g;
    std::vector<float> positions, normals;
    for (std::uint32_t i = 0; i < 3 * kParts; ++i) {
        positions.insert(positions.end(), {float(i), float(i % 3 == 1), float(i % 3 == 2)});
        normals.insert(normals.end(), {0, 0, 1});
    }
    const json attributes = {{"POSITION", g.floats(positions, "VEC3")}, {"NORMAL", g.floats(normals, "VEC3")}};
    std::vector<std::uint32_t> indices;
    for (std::uint32_t i = 0; i < 3 * kParts; ++i)
        indices.push_back(3 * kParts - 1 - i);
    const int view = g.view(indices);
    json primitives = json::array();
    for (std::uint32_t part = 0; part < kParts; ++part)
        primitives.push_back({{"attributes", attributes},
                              {"indices",
                               g.accessor({{"bufferView", view},
                                           {"byteOffset", 12 * part},
                                           {"componentType", kUInt},
                                           {"type", "SCALAR"},
                                           {"count", 3}})}});
    g.add("meshes", {{"primitives", primitives}});
    g.add("nodes", {{"mesh", 0}});
    LoadLimits limits;
    limits.geometryBytes = 0; // copies of all vertices would take 144 KB a part
    COTAN_LOADED(scene, g.load(limits));
    ASSERT_EQ(scene.meshes.size(), kParts);
    for (std::uint32_t part = 0; part < kParts; part += 333) {
        const Mesh& mesh = scene.meshes[part];
        ASSERT_EQ(mesh.vertexCount(), 3u);
        for (std::uint32_t corner = 0; corner < 3; ++corner)
            EXPECT_EQ(mesh.positions[mesh.indices[corner]].x, float(3 * kParts - 1 - 3 * part - corner));
    }
    // Without indices, each part is a copy of all vertices, and all copies count.
    for (json& p : g.root["meshes"][0]["primitives"])
        p.erase("indices");
    COTAN_REFUSED(g.load(limits), "the geometry takes");
}

TEST(GltfHostile, aPrimitiveWithoutPositionIsOmitted)
{
    Gltf g = square();
    json second = primitive(g);
    second["attributes"].erase("POSITION");
    second["indices"] = g.accessor(std::vector<std::uint32_t>{4000000000u, 5, 6}, "SCALAR", kUInt);
    g.root["meshes"][0]["primitives"].push_back(second);
    COTAN_LOADED(scene, g.load());
    EXPECT_EQ(scene.meshes.size(), 1u);
    EXPECT_TRUE(warns(scene, "meshes[0].primitives[1]: no POSITION"));
}

// ---- images ---------------------------------------------------------------------------------

TEST(GltfHostile, brokenUnusedImagesAreOnlyWarnedOf)
{
    const std::vector<std::pair<json, std::string>> images = {
        {{{"uri", "../secret.png"}}, "leads out of it"},
        {{{"uri", "http://localhost/a.png"}}, "http://localhost/a.png"},
        {{{"uri", "data:image/png;base64,*"}}, "not valid base64"},
        {{{"uri", "data:image/png;base64,iVBORw0KGgo="}}, "ends within its header"},
        {json{{"name", "none"}}, "either uri or bufferView"},
    };
    for (const auto& [image, problem] : images) {
        Gltf g = square();
        addNormalMap(g);
        g.add("images", image);
        g.add("textures", {{"source", 1}}); // no material reads it
        SCOPED_TRACE(image.dump());
        COTAN_LOADED(scene, g.load());
        EXPECT_EQ(scene.images.size(), 1u);
        EXPECT_TRUE(warns(scene, "images[1]")) << scene.warnings.size();
        EXPECT_TRUE(warns(scene, problem));
        EXPECT_TRUE(warns(scene, "this unused image is ignored"));
        g.root["materials"][0]["normalTexture"]["index"] = 1;
        COTAN_REFUSED(g.load(), "images[1]");
    }
}

// ---- files ----------------------------------------------------------------------------------

TEST(GltfHostile, nothingOutsideTheFolderIsOpened)
{
    const TemporaryFolder folder;
    Gltf g = square();
    const std::string buffer = g.bytes;
    g.bytes.clear();
    folder.write("secret.bin", buffer);
    fs::create_directories(folder.path / "model");
    fs::create_symlink("../secret.bin", folder.path / "model" / "link.bin");
    fs::create_directory_symlink("..", folder.path / "model" / "up");
    for (const std::string& uri :
         {std::string("../secret.bin"), std::string("%2e%2e/secret.bin"), std::string("..%2Fsecret.bin"),
          std::string("x/../../secret.bin"), std::string("link.bin"), std::string("up/secret.bin"),
          (folder.path / "secret.bin").string(), "file://" + (folder.path / "secret.bin").string(),
          std::string("http://localhost/secret.bin"), std::string("..\\secret.bin")}) {
        g.root["buffers"] = {{{"byteLength", buffer.size()}, {"uri", uri}}};
        SCOPED_TRACE(uri);
        COTAN_REFUSED(loadGltf(folder.write("model/model.gltf", g.text())), "buffers[0].uri");
    }
}

TEST(GltfHostile, buffersMayBeLongerButNotShorter)
{
    const TemporaryFolder folder;
    Gltf g = square();
    const std::string buffer = g.bytes;
    g.bytes.clear();
    g.root["buffers"] = {{{"byteLength", buffer.size()}, {"uri", "sub/data.bin"}}};
    const fs::path model = folder.write("model.gltf", g.text());
    COTAN_REFUSED(loadGltf(model), "no file \"sub/data.bin\"");
    folder.write("sub/data.bin", buffer + "more");
    EXPECT_TRUE(loadGltf(model));
    folder.write("sub/data.bin", buffer.substr(1));
    COTAN_REFUSED(loadGltf(model), "buffers[0].byteLength");
}

TEST(GltfHostile, missingEmptyAndForeignFilesAreAnErrorOfOneLine)
{
    const TemporaryFolder folder;
    COTAN_REFUSED(loadGltf(folder.path / "missing.gltf"), "missing.gltf");
    COTAN_REFUSED(loadGltf(folder.path), folder.path.string());
    COTAN_REFUSED(loadText(""), "empty");
    COTAN_REFUSED(loadText("hello"), "JSON");
    COTAN_REFUSED(loadText("[]"), "expected an object");
    COTAN_REFUSED(loadText("{}"), "asset: missing");
    COTAN_REFUSED(loadText("{\"asset\":{\"version\":\"2.0\",\"generator\":\"\xff\"}}"), "JSON");
}

TEST(GltfHostile, dataUrisThatDoNotDecodeAreRefused)
{
    for (const char* const uri : {"data:application/octet-stream;base64,A", "data:application/octet-stream;base64,A*==",
                                  "data:application/octet-stream,AAAA", "data:", "data:;;base64,AAAA"}) {
        const json root = {{"asset", {{"version", "2.0"}}}, {"buffers", {{{"byteLength", 1}, {"uri", uri}}}}};
        COTAN_REFUSED(loadText(root.dump()), "buffers[0].uri");
    }
}

} // namespace
