// Geometry compressed with Draco and meshoptimizer by their own encoders, compared with the uncompressed numbers.
#include <algorithm>
#include <random>

#include "cotan/scene.hpp"
#include "gltf_edit_maker.hpp"
#include "gltf_packed_maker.hpp"

namespace {

using namespace cotan;
using namespace cotan::test;

// ---- Draco ------------------------------------------------------------------------------------

class DracoGeometryIs : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Methods, DracoGeometryIs, testing::ValuesIn(kMethods),
                         [](const auto& at) { return at.param == 0 ? "sequential" : "edgebreaker"; });

// Draco reorders triangles and vertices: each is identified by its position in the sheet.
TEST_P(DracoGeometryIs, decodedUpToQuantisation)
{
    const Sheet s = sheet(20);
    const auto scene = dracoModel(s, dracoStream(s, GetParam())).load();
    ASSERT_TRUE(scene) << scene.error().message;
    ASSERT_EQ(scene->warnings.size(), 1u); // missing normals
    ASSERT_EQ(scene->meshes.size(), 1u);
    const Mesh& mesh = scene->meshes[0];
    ASSERT_EQ(mesh.triangleCount(), 800u);
    std::vector<int> met(20 * 20, 0);
    for (std::size_t f = 0; f < mesh.triangleCount(); ++f) {
        glm::vec3 middle(0);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t v = mesh.indices[3 * f + k];
            const glm::vec3 p = mesh.positions[v];
            middle += p / 3.0f;
            // Half a quantisation step, on a box of 1, of the texture coordinates and the positions.
            EXPECT_LT(std::abs(p.z - 0.1f * std::sin(5 * p.x + 3 * p.y)), 1.6f / (1 << kPositionBits));
            EXPECT_LT(std::abs(mesh.texcoords[0][v].x - p.x), 0.65f / (1 << kTexcoordBits));
            EXPECT_LT(std::abs(mesh.texcoords[0][v].y - (1 - p.y)), 0.65f / (1 << kTexcoordBits));
        }
        ++met[std::size_t(middle.y * 20) * 20 + std::size_t(middle.x * 20)];
    }
    for (const int triangles : met)
        EXPECT_EQ(triangles, 2);
}

TEST_P(DracoGeometryIs, writtenUnchangedIfNotEdited)
{
    const TemporaryFolder folder;
    const Sheet s = sheet(4);
    const std::string stream = dracoStream(s, GetParam());
    const Gltf g = dracoModel(s, stream);
    auto document = openGltfDocument(folder.write("in.gltf", g.text()));
    ASSERT_TRUE(document) << document.error().message;
    const auto written = writeGltf(*document, folder.path / "out.glb");
    ASSERT_TRUE(written) << written.error().message;
    EXPECT_TRUE(written->notes.empty());
    const ReadBack out = readBack(folder.path / "out.glb");
    EXPECT_EQ(out.root["meshes"], g.root["meshes"]);
    EXPECT_EQ(out.root["accessors"], g.root["accessors"]);
    EXPECT_EQ(out.root["extensionsRequired"], g.root["extensionsRequired"]);
    EXPECT_EQ(out.buffer.substr(0, stream.size()), stream);
    EXPECT_LT(out.buffer.size(), stream.size() + 4); // and nothing else
    EXPECT_EQ(loadGltf(folder.path / "out.glb")->meshes[0].positions, g.load()->meshes[0].positions);
}

// The stream still contains it under an id that nothing names, so no decoder requests it.
TEST_P(DracoGeometryIs, writtenUnchangedWithoutADroppedAttribute)
{
    const TemporaryFolder folder;
    const Sheet s = sheet(4);
    std::vector<float> tangents;
    for (std::size_t v = 0; v < s.vertices(); ++v)
        tangents.insert(tangents.end(), {1, 0, 0, 1});
    const std::string stream = dracoStream(s, GetParam(), tangents);
    Gltf g = dracoModel(s, stream);
    primitive(g)["attributes"]["TANGENT"] =
        g.accessor(json{{"componentType", kFloat}, {"type", "VEC4"}, {"count", s.vertices()}});
    primitive(g)["extensions"]["KHR_draco_mesh_compression"]["attributes"]["TANGENT"] = 3;
    auto document = openGltfDocument(folder.write("in.gltf", g.text()));
    ASSERT_TRUE(document) << document.error().message;
    ASSERT_TRUE(dropGltfTangents(*document, 0, 0));
    const auto written = writeGltf(*document, folder.path / "out.glb");
    ASSERT_TRUE(written) << written.error().message;
    const ReadBack out = readBack(folder.path / "out.glb");
    const json& after = out.root["meshes"][0]["primitives"][0];
    EXPECT_EQ(after["extensions"]["KHR_draco_mesh_compression"]["attributes"],
              json({{"POSITION", 0}, {"TEXCOORD_0", 1}, {"_NUMBERS", 2}}));
    EXPECT_FALSE(after["attributes"].contains("TANGENT"));
    EXPECT_EQ(out.root["accessors"].size(), g.root["accessors"].size() - 1);
    EXPECT_EQ(out.buffer.substr(0, stream.size()), stream);
    ASSERT_EQ(written->notes.size(), 1u);
    EXPECT_NE(written->notes[0].find("1 of 1 streams are unchanged and still contain the removed tangents"),
              std::string::npos)
        << written->notes[0];
}

// A morph target has no stream of its own: the accessor it uses needs bytes.
TEST_P(DracoGeometryIs, decodedIfSomethingElseReadsItsAccessors)
{
    const TemporaryFolder folder;
    const Sheet s = sheet(4);
    Gltf g = dracoModel(s, dracoStream(s, GetParam()));
    const json positions = primitive(g)["attributes"]["POSITION"];
    primitive(g)["targets"] = {{{"POSITION", positions}}};
    auto document = openGltfDocument(folder.write("in.gltf", g.text()));
    ASSERT_TRUE(document) << document.error().message;
    const auto written = writeGltf(*document, folder.path / "out.glb");
    ASSERT_TRUE(written) << written.error().message;
    const ReadBack out = readBack(folder.path / "out.glb");
    const json& after = out.root["meshes"][0]["primitives"][0];
    EXPECT_TRUE(after["extensions"].contains("KHR_draco_mesh_compression"));
    const auto accessor = [&](const char* name) {
        return out.root["accessors"][after["attributes"][name].get<std::size_t>()];
    };
    EXPECT_TRUE(accessor("POSITION").contains("bufferView"));
    EXPECT_FALSE(accessor("TEXCOORD_0").contains("bufferView"));
    const auto scene = loadGltf(folder.path / "out.glb");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->meshes[0].positions, g.load()->meshes[0].positions);
}

TEST_P(DracoGeometryIs, decodedIfTheVerticesChanged)
{
    const TemporaryFolder folder;
    const Sheet s = sheet(4);
    auto document = openGltfDocument(folder.write("in.gltf", dracoModel(s, dracoStream(s, GetParam())).text()));
    ASSERT_TRUE(document) << document.error().message;
    ASSERT_TRUE(setGltfProvoking(*document, ProvokingVertex::first));
    const auto written = writeGltf(*document, folder.path / "out.glb");
    ASSERT_TRUE(written) << written.error().message;
    ASSERT_EQ(written->notes.size(), 1u);
    EXPECT_NE(written->notes[0].find("1 of 1 primitives changed and are written uncompressed"), std::string::npos)
        << written->notes[0];
    const ReadBack out = readBack(folder.path / "out.glb");
    EXPECT_EQ(out.buffer.find(dracoStream(s, GetParam())), std::string::npos); // nothing uses it
    EXPECT_FALSE(out.root.contains("extensionsUsed"));
    EXPECT_FALSE(out.root.contains("extensionsRequired"));
    EXPECT_EQ(out.root.dump().find("draco"), std::string::npos);
    const json& bounds =
        out.root["accessors"][out.root["meshes"][0]["primitives"][0]["attributes"]["POSITION"].get<std::size_t>()];
    float lowest = 1; // of z, after quantisation
    const auto again = loadGltf(folder.path / "out.glb");
    ASSERT_TRUE(again) << again.error().message;
    for (const glm::vec3& p : again->meshes[0].positions)
        lowest = std::min(lowest, p.z);
    EXPECT_EQ(bounds["min"][2].get<float>(), lowest);
    EXPECT_EQ(bounds["max"][0], 1.0f);
    // The identifying bytes of each vertex match its position: three bytes, with the next vertex four bytes later.
    const json& primitive = out.root["meshes"][0]["primitives"][0];
    const json& numbers = out.root["accessors"][primitive["attributes"]["_NUMBERS"].get<std::size_t>()];
    const json& view = out.root["bufferViews"][numbers["bufferView"].get<std::size_t>()];
    EXPECT_EQ(view["byteStride"], 4);
    const json& stored = out.root["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()];
    const json& positionsView = out.root["bufferViews"][stored["bufferView"].get<std::size_t>()];
    for (std::size_t v = 0; v < s.vertices(); ++v) {
        float x = 0, y = 0;
        const std::size_t at = positionsView["byteOffset"].get<std::size_t>() + 12 * v;
        std::memcpy(&x, out.buffer.data() + at, 4);
        std::memcpy(&y, out.buffer.data() + at + 4, 4);
        const std::size_t mine = view["byteOffset"].get<std::size_t>() + 4 * v;
        EXPECT_EQ(int(out.buffer[mine]), int(std::lround(4 * x)));
        EXPECT_EQ(int(out.buffer[mine + 1]), int(std::lround(4 * y)));
        EXPECT_EQ(int(out.buffer[mine + 2]), 7);
    }
}

TEST_P(DracoGeometryIs, refusedIfTheModelContradictsIt)
{
    const Sheet s = sheet(4);
    const std::string stream = dracoStream(s, GetParam());
    const std::string draco = "/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression";
    const std::tuple<std::string, json, const char*> cases[] = {
        {"/accessors/3/count", 3, "expected 3 indices"},
        {"/accessors/3/count", 99, "expected 99 indices"},
        {"/accessors/3/count", 300'000'000, "the limit is"},
        {"/accessors/0/count", 24, "expected 24 elements, found 25"},
        {"/accessors/0/type", "VEC4", "expected 4 components"},
        {"/accessors/3/componentType", kFloat, "expected unsigned integers"},
        {draco + "/attributes/POSITION", 9, "no attribute with the id 9"},
        {draco + "/attributes/POSITION", -1, "expected the id"},
        {draco + "/attributes/COLOR_0", 1, "expected the id of an attribute that the primitive has"},
        {draco + "/bufferView", 7, "expected an index below 1"},
        {"/meshes/0/primitives/0/mode", 5, "expected mode 4"},
    };
    for (const auto& [where, value, word] : cases) {
        Gltf g = dracoModel(s, stream);
        g.root[json::json_pointer(where)] = value;
        COTAN_REFUSED(g.load(), word);
    }
    Gltf fewer = dracoModel(s, stream);
    for (int i = 0; i < 3; ++i)
        fewer.root["accessors"][std::size_t(i)]["count"] = 24;
    COTAN_REFUSED(fewer.load(), "expected 24 vertices");
    Gltf without = dracoModel(s, stream);
    primitive(without).erase("indices");
    COTAN_REFUSED(without.load(), "indices: missing");
}

TEST_P(DracoGeometryIs, refusedInOneLineOrReadIfDamaged)
{
    const Sheet s = sheet(6);
    const std::string stream = dracoStream(s, GetParam());
    for (std::size_t length = 1; length < stream.size(); length += 1 + stream.size() / 40)
        COTAN_REFUSED(dracoModel(s, stream.substr(0, length)).load(), "raco");
    std::mt19937 random(5);
    int refused = 0;
    for (int i = 0; i < 300; ++i) {
        std::string damaged = stream;
        damaged[random() % damaged.size()] ^= char(1 << random() % 8);
        const auto scene = dracoModel(s, damaged).load();
        refused += !scene;
        if (!scene) {
            EXPECT_EQ(scene.error().message.find('\n'), std::string::npos);
        }
    }
    EXPECT_GT(refused, 30); // flipped bits of coordinates are not noticed
}

// As written by exporters that merge equal uv sets: one accessor under two names, with an id for each.
TEST(DracoGeometry, mayHaveOneAccessorUnderTwoNames)
{
    const Sheet s = sheet(4);
    Gltf g = dracoModel(s, dracoStream(s, draco::MESH_EDGEBREAKER_ENCODING));
    primitive(g)["attributes"]["TEXCOORD_1"] = primitive(g)["attributes"]["TEXCOORD_0"];
    primitive(g)["extensions"]["KHR_draco_mesh_compression"]["attributes"]["TEXCOORD_1"] = 2;
    const auto scene = g.load();
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->meshes[0].texcoords[0], scene->meshes[0].texcoords[1]);
}

TEST(DracoGeometry, isIgnoredIfPlainAccessorsExist)
{
    Gltf g = square();
    primitive(g)["extensions"]["KHR_draco_mesh_compression"] = {
        {"bufferView", 0}, {"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}}; // not a Draco stream
    const auto scene = g.load();
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->meshes[0].triangleCount(), 2u);
}

// ---- meshoptimizer ----------------------------------------------------------------------------

TEST(MeshoptGeometry, equalsThePlainFile)
{
    const auto plain = square().load();
    ASSERT_TRUE(plain);
    const std::pair<std::size_t, Packed> cases[] = {{0, packedVertices(kSquare, 3)},
                                                    {2, packedVertices(kSquareUv, 2)},
                                                    {3, packedIndices(kTwoTriangles, true)},
                                                    {3, packedIndices(kTwoTriangles, false)}};
    for (const auto& [view, packed] : cases)
        for (const char* const name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
            const auto scene = loadText(packedModel(square(), view, packed, name));
            ASSERT_TRUE(scene) << scene.error().message;
            EXPECT_TRUE(scene->warnings.empty()) << scene->warnings[0];
            EXPECT_EQ(scene->meshes[0].positions, plain->meshes[0].positions);
            EXPECT_EQ(scene->meshes[0].texcoords[0], plain->meshes[0].texcoords[0]);
            ASSERT_EQ(scene->meshes[0].indices.size(), 6u);
            // The codec may rotate a triangle's corners.
            for (std::size_t f = 0; f < 6; f += 3) {
                const auto& there = scene->meshes[0].indices;
                std::array<std::uint32_t, 3> a{there[f], there[f + 1], there[f + 2]};
                const std::array<std::uint32_t, 3> b{kTwoTriangles[f], kTwoTriangles[f + 1], kTwoTriangles[f + 2]};
                std::rotate(a.begin(), std::min_element(a.begin(), a.end()), a.end());
                EXPECT_EQ(a, b);
            }
        }
}

// Filters compared with their formulas in the extension. The library encodes; the truth is its input.
TEST(MeshoptGeometry, filtersReproduceTheirInput)
{
    const glm::vec3 n = glm::normalize(glm::vec3(0.3f, -0.5f, 0.8f));
    std::vector<float> normals;
    for (int i = 0; i < 4; ++i)
        normals.insert(normals.end(), {n.x, n.y, i < 2 ? n.z : -n.z, 0.0f});
    std::vector<std::int16_t> octahedral(16);
    meshopt_encodeFilterOct(octahedral.data(), 4, 8, 12, normals.data());
    Packed packed = packedVertices(octahedral, 4);
    packed.filter = "OCTAHEDRAL";
    Gltf g = square();
    g.root["accessors"][1].update({{"componentType", kShort}, {"normalized", true}});
    g.root["bufferViews"][1]["byteStride"] = 8;
    const auto scene = loadText(packedModel(g, 1, packed));
    ASSERT_TRUE(scene) << scene.error().message;
    for (std::size_t v = 0; v < 4; ++v) // 12 bits: half a step of 1/2047 in each of two numbers
        EXPECT_LT(glm::length(scene->meshes[0].normals[v] - glm::vec3(n.x, n.y, v < 2 ? n.z : -n.z)), 1.5e-3f) << v;

    std::vector<std::uint32_t> exponential(12);
    std::vector<float> stored = kSquare;
    for (float& x : stored)
        x = x * 3.7f - 1.1f;
#if MESHOPTIMIZER_VERSION >= 200 // 0.20
    meshopt_encodeFilterExp(exponential.data(), 4, 12, 15, stored.data(), meshopt_EncodeExpSharedVector);
#else
    meshopt_encodeFilterExp(exponential.data(), 4, 12, 15, stored.data());
#endif
    packed = packedVertices(exponential, 3);
    packed.filter = "EXPONENTIAL";
    const auto moved = loadPacked(0, packed);
    ASSERT_TRUE(moved) << moved.error().message;
    for (std::size_t v = 0; v < 4; ++v) // 15 bits with an exponent per vertex: numbers up to 4
        EXPECT_LT(
            glm::length(moved->meshes[0].positions[v] - glm::vec3(stored[3 * v], stored[3 * v + 1], stored[3 * v + 2])),
            4.0f / (1 << 13))
            << v;
}

TEST(MeshoptGeometry, isWrittenUnchangedIfNotEdited)
{
    for (const char* const name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
        const TemporaryFolder folder;
        const Packed packed = packedVertices(kSquare, 3);
        auto document = openGltfDocument(folder.write("in.gltf", packedModel(square(), 0, packed, name)));
        ASSERT_TRUE(document) << document.error().message;
        const auto written = writeGltf(*document, folder.path / "out.glb");
        ASSERT_TRUE(written) << written.error().message;
        EXPECT_TRUE(written->notes.empty());
        const ReadBack out = readBack(folder.path / "out.glb");
        EXPECT_EQ(out.root["extensionsRequired"], json({"KHR_mesh_quantization", name}));
        const json& view = out.root["bufferViews"][0];
        const json& extension = view["extensions"][name];
        EXPECT_EQ(extension["buffer"], 0);
        EXPECT_EQ(out.buffer.substr(extension["byteOffset"].get<std::size_t>(), packed.bytes.size()), packed.bytes);
        EXPECT_EQ(view["buffer"], 1);
        EXPECT_EQ(out.root["buffers"][1]["extensions"][name], json({{"fallback", true}}));
        EXPECT_GE(out.root["buffers"][1]["byteLength"], 48); // four positions of three floats
        const auto scene = loadGltf(folder.path / "out.glb");
        ASSERT_TRUE(scene) << scene.error().message;
        EXPECT_EQ(scene->meshes[0].positions, square().load()->meshes[0].positions);
    }
}

TEST(MeshoptGeometry, isDecodedIfTheVerticesChanged)
{
    const TemporaryFolder folder;
    auto document = openGltfDocument(folder.write("in.gltf", packedModel(square(), 0, packedVertices(kSquare, 3))));
    ASSERT_TRUE(document) << document.error().message;
    ASSERT_TRUE(setGltfProvoking(*document, ProvokingVertex::first));
    const auto written = writeGltf(*document, folder.path / "out.glb");
    ASSERT_TRUE(written) << written.error().message;
    ASSERT_EQ(written->notes.size(), 1u);
    EXPECT_NE(written->notes[0].find("1 of 1 compressed buffer views are replaced by uncompressed"), std::string::npos)
        << written->notes[0];
    const ReadBack out = readBack(folder.path / "out.glb");
    EXPECT_EQ(out.root["extensionsUsed"], json({"KHR_mesh_quantization"}));
    EXPECT_EQ(out.root["buffers"].size(), 1u);
    EXPECT_EQ(out.root.dump().find("meshopt"), std::string::npos);
    const auto scene = loadGltf(folder.path / "out.glb");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->meshes[0].triangleCount(), 2u);
}

TEST(MeshoptGeometry, isRefusedIfItContradictsItself)
{
    const Packed vertices = packedVertices(kSquare, 3), indices = packedIndices(kTwoTriangles, true);
    const auto with = [](Packed p, const auto& change) {
        change(p);
        return p;
    };
    const std::tuple<std::size_t, Packed, const char*> cases[] = {
        {0, with(vertices, [](Packed& p) { p.bytes.resize(p.bytes.size() - 1); }), "damaged"},
        {0, with(vertices, [](Packed& p) { p.bytes = ""; }), "damaged"},
        {0, with(vertices, [](Packed& p) { p.bytes[0] = '\xa1'; }), "expected a stream that meshoptimizer 0.18 reads"},
        {0, with(vertices, [](Packed& p) { p.filter = "OCTAHEDRAL"; }), "expected 4 or 8 for filter OCTAHEDRAL"},
        {0, with(vertices, [](Packed& p) { p.filter = "QUATERNION"; }), "expected 8 for filter QUATERNION"},
        {0, with(vertices, [](Packed& p) { p.filter = "COLOR"; }), "COLOR is not supported"},
        {0, with(vertices, [](Packed& p) { p.filter = "MAGIC"; }), "expected one of NONE"},
        {0, with(vertices, [](Packed& p) { p.mode = "TRIANGLES"; }), "expected 2 or 4"},
        {0, with(vertices, [](Packed& p) { p.stride = 6, p.count = 8; }), "expected a multiple of 4 up to 256"},
        {3, with(indices, [](Packed& p) { p.count = 5; }), "expected a multiple of 3"},
        {3, with(indices, [](Packed& p) { p.count = 9; }), "damaged"},
        {3, with(indices, [](Packed& p) { p.filter = "EXPONENTIAL"; }), "expected none for mode TRIANGLES"},
        {0, with(vertices, [](Packed& p) { p.count = std::size_t(1) << 40; }), "the limit is"},
    };
    for (const auto& [view, packed, word] : cases)
        COTAN_REFUSED(loadPacked(view, packed), word);
    json wrong = json::parse(packedModel(square(), 0, vertices));
    wrong["bufferViews"][0]["byteLength"] = 44;
    COTAN_REFUSED(loadText(wrong.dump()), "expected 44 bytes");
    wrong = json::parse(packedModel(square(), 0, vertices));
    wrong["bufferViews"][0]["extensions"]["EXT_meshopt_compression"]["byteOffset"] = 100000;
    COTAN_REFUSED(loadText(wrong.dump()), "it ends at byte");
    wrong = json::parse(packedModel(square(), 0, vertices));
    wrong["bufferViews"][0].erase("extensions"); // the fallback has no bytes
    COTAN_REFUSED(loadText(wrong.dump()), "which has 0");
}

TEST(MeshoptGeometry, isRefusedInOneLineOrReadIfDamaged)
{
    std::mt19937 random(5);
    const Packed vertices = packedVertices(kSquare, 3), indices = packedIndices(kTwoTriangles, true);
    for (int i = 0; i < 300; ++i) {
        Packed p = i % 2 ? vertices : indices;
        p.bytes[random() % p.bytes.size()] ^= char(1 << random() % 8);
        const auto scene = loadPacked(i % 2 ? 0 : 3, p);
        if (!scene) {
            EXPECT_EQ(scene.error().message.find('\n'), std::string::npos);
        }
    }
}

TEST(MeshoptGeometry, isIgnoredIfPlainBytesExist)
{
    json whole = json::parse(packedModel(square(), 0, packedVertices(kSquare, 3)));
    whole["bufferViews"][0]["buffer"] = 0; // its first bytes are the positions
    whole["bufferViews"][0]["extensions"]["EXT_meshopt_compression"]["mode"] = "INDICES"; // would be refused
    const auto scene = loadText(whole.dump());
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->meshes[0].positions, square().load()->meshes[0].positions);
}

} // namespace
