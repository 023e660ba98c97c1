// Buffer views compressed by meshoptimizer: several in one file, each kept or replaced separately; strides, filters,
// messages and the limit on their size.
#include <algorithm>

#include "cotan/scene.hpp"
#include "gltf_edit_maker.hpp"
#include "gltf_packed_maker.hpp"

namespace cotan::test {
namespace {

constexpr const char* kEarlier = "EXT_meshopt_compression";
constexpr const char* kLater = "KHR_meshopt_compression";

// Moves views of a model, given with their compressed form, into a fallback buffer, at multiples of eight.
class PackedViews {
public:
    explicit PackedViews(const Gltf& g) : g_(g) {}

    // Returns the bytes of the stream.
    std::string pack(std::size_t view, const Packed& packed, const char* name)
    {
        g_.bytes.resize((g_.bytes.size() + 3) / 4 * 4);
        json& v = g_.root["bufferViews"][view];
        v["buffer"] = 1;
        v["byteOffset"] = fallback_;
        v["byteLength"] = packed.count * packed.stride;
        v["extensions"][name] = {{"buffer", 0},
                                 {"byteOffset", g_.bytes.size()},
                                 {"byteLength", packed.bytes.size()},
                                 {"byteStride", packed.stride},
                                 {"count", packed.count},
                                 {"mode", packed.mode}};
        fallback_ += (packed.count * packed.stride + 7) / 8 * 8;
        g_.bytes += packed.bytes;
        names_[name] = {{"fallback", true}};
        return packed.bytes;
    }

    std::string text(const json& required) const
    {
        json whole = g_.root;
        whole["extensionsUsed"] = {kEarlier, "KHR_mesh_quantization", kLater};
        whole["extensionsRequired"] = required;
        whole["buffers"] = {
            {{"byteLength", g_.bytes.size()}, {"uri", "data:application/octet-stream;base64," + base64(g_.bytes)}},
            {{"byteLength", fallback_}, {"extensions", names_}}};
        return whole.dump();
    }

private:
    Gltf g_;
    json names_;
    std::size_t fallback_ = 0;
};

// Decoded views are stored one after another at multiples of four.
TEST(PackedViews, keepTheirStreamAndExtension)
{
    Gltf g = square();
    primitive(g)["indices"] = g.accessor(std::vector<std::uint16_t>{0, 1, 2}, "SCALAR", kUShort); // view 4
    PackedViews views(g);
    const std::string order = views.pack(4, packedIndices({0, 1, 2}, true), kLater);
    const std::string positionStream = views.pack(0, packedVertices(kSquare, 3), kEarlier);
    const TemporaryFolder folder;
    const auto document = openText(folder, views.text({kEarlier, kLater}));
    ASSERT_TRUE(document) << document.error().message;
    const auto written = writeGltf(*document, folder.path / "out.glb");
    ASSERT_TRUE(written) << written.error().message;
    EXPECT_TRUE(written->notes.empty());
    const ReadBack out = readBack(folder.path / "out.glb");
    EXPECT_EQ(out.root["extensionsUsed"], json({"KHR_mesh_quantization", kEarlier, kLater}));
    EXPECT_EQ(out.root["extensionsRequired"], json({kEarlier, kLater}));
    const json &positions = out.root["bufferViews"][0], &indices = out.root["bufferViews"][4];
    EXPECT_EQ(indices["byteOffset"], 0);
    EXPECT_EQ(indices["byteLength"], 6);
    EXPECT_EQ(positions["byteOffset"], 8);
    EXPECT_EQ(positions["byteLength"], 48);
    EXPECT_EQ(out.root["buffers"][1]["byteLength"], 56);
    EXPECT_EQ(out.root["buffers"][1]["extensions"],
              json({{kEarlier, {{"fallback", true}}}, {kLater, {{"fallback", true}}}}));
    EXPECT_FALSE(positions["extensions"].contains(kLater));
    EXPECT_FALSE(indices["extensions"].contains(kEarlier));
    const auto streamOf = [&](const json& view, const char* name) {
        const json& e = view["extensions"][name];
        return out.buffer.substr(e["byteOffset"], e["byteLength"]);
    };
    EXPECT_EQ(streamOf(positions, kEarlier), positionStream);
    EXPECT_EQ(streamOf(indices, kLater), order);
    COTAN_LOADED(again, loadGltf(folder.path / "out.glb"));
    EXPECT_EQ(again.meshes[0].positions, (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}));
    // Extensions are required only if the file requires them.
    const auto optional = openText(folder, views.text({kLater}));
    ASSERT_TRUE(optional);
    ASSERT_TRUE(writeGltf(*optional, folder.path / "out.glb"));
    const ReadBack second = readBack(folder.path / "out.glb");
    EXPECT_EQ(second.root["extensionsUsed"], json({"KHR_mesh_quantization", kEarlier, kLater}));
    EXPECT_EQ(second.root["extensionsRequired"], json({kLater}));
}

// Positions and the times of an animation are compressed: new vertices replace only the first. There is no note if a
// view is removed without a replacement, or one is added and none removed.
TEST(PackedViews, replacedByPlainOnesAreCounted)
{
    Gltf g = square();
    const int times = g.floats({0, 1}, "SCALAR"), rotations = g.floats({0, 0, 0, 1, 0, 0, 1, 0}, "VEC4");
    g.root["animations"] = {{{"samplers", {{{"input", times}, {"output", rotations}}}}, {"channels", json::array()}}};
    const auto open = [](const TemporaryFolder& folder, const PackedViews& views) {
        auto document = openText(folder, views.text({kEarlier}));
        EXPECT_TRUE(document) << document.error().message;
        return document;
    };
    PackedViews views(g);
    views.pack(0, packedVertices(kSquare, 3), kEarlier);
    views.pack(std::size_t(times), packedVertices(std::vector<float>{0, 1}, 1), kEarlier);
    const TemporaryFolder folder;
    const std::pair<std::vector<glm::vec4>, std::vector<std::string>> cases[] = {
        {cornersOf({1, 1, 1, 1, 1, 1}), {}},
        {cornersOf({1, 1, 1, 1, -1, 1}),
         {"1 of 2 compressed buffer views are replaced by uncompressed ones; \"gltf-transform meshopt\" compresses "
          "them again"}}};
    for (const auto& [corners, notes] : cases) {
        auto document = open(folder, views);
        const GltfCornerTangents t{0, 0, corners};
        ASSERT_TRUE(setGltfTangents(*document, {&t, 1}));
        const auto written = writeGltf(*document, folder.path / "out.glb");
        ASSERT_TRUE(written);
        EXPECT_EQ(written->notes, notes);
        EXPECT_TRUE(loadGltf(folder.path / "out.glb"));
    }
    const std::vector<float> four = {1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1};
    const int tangents = g.floats(four, "VEC4");
    primitive(g)["attributes"]["TANGENT"] = tangents;
    PackedViews more(g);
    more.pack(std::size_t(tangents), packedVertices(four, 4), kEarlier);
    auto document = open(folder, more);
    ASSERT_TRUE(dropGltfTangents(*document, 0, 0));
    const auto written = writeGltf(*document, folder.path / "out.glb");
    ASSERT_TRUE(written);
    EXPECT_TRUE(written->notes.empty());
    EXPECT_EQ(readBack(folder.path / "out.glb").root.dump().find("meshopt"), std::string::npos);
}

// Splitting it would require compressing it again.
TEST(PackedViews, keepInterleavedRowsIfAColumnIsRemoved)
{
    Gltf g = square();
    std::vector<float> rows;
    for (std::size_t i = 0; i < 4; ++i)
        rows.insert(rows.end(), {kSquare[3 * i], kSquare[3 * i + 1], kSquare[3 * i + 2], 1, 0, 0, 1});
    const int view = g.view(rows);
    g.root["bufferViews"][std::size_t(view)]["byteStride"] = 28;
    const json column = {{"bufferView", view}, {"componentType", kFloat}, {"count", 4}, {"type", "VEC3"}};
    primitive(g)["attributes"]["POSITION"] = g.accessor(column);
    json tangents = column;
    tangents.update({{"type", "VEC4"}, {"byteOffset", 12}});
    primitive(g)["attributes"]["TANGENT"] = g.accessor(tangents);
    PackedViews views(g);
    const std::string stream = views.pack(std::size_t(view), packedVertices(rows, 7), kLater);
    const TemporaryFolder folder;
    auto document = openText(folder, views.text({kLater}));
    ASSERT_TRUE(document) << document.error().message;
    ASSERT_TRUE(dropGltfTangents(*document, 0, 0));
    const auto written = writeGltf(*document, folder.path / "out.glb");
    ASSERT_TRUE(written);
    EXPECT_TRUE(written->notes.empty());
    const ReadBack out = readBack(folder.path / "out.glb");
    EXPECT_NE(out.buffer.find(stream), std::string::npos);
    COTAN_LOADED(scene, loadGltf(folder.path / "out.glb"));
    EXPECT_EQ(scene.meshes[0].positions[2], glm::vec3(1, 1, 0));
}

TEST(PackedViews, mayHaveFourByteIndicesAndNormals)
{
    for (const bool triangles : {true, false}) {
        Packed packed = packedIndices(kTwoTriangles, triangles);
        packed.stride = 4;
        Gltf g = square();
        g.root["accessors"][3]["componentType"] = kUInt;
        COTAN_LOADED(scene, loadText(packedModel(g, 3, packed)));
        std::vector<std::uint32_t> order = scene.meshes[0].indices;
        ASSERT_EQ(order.size(), 6u);
        std::rotate(order.begin(), std::min_element(order.begin(), order.begin() + 3), order.begin() + 3);
        std::rotate(order.begin() + 3, std::min_element(order.begin() + 3, order.end()), order.end());
        EXPECT_EQ(order, kTwoTriangles);
    }
    const glm::vec3 n = glm::normalize(glm::vec3(0.3f, -0.5f, -0.8f));
    std::vector<float> normals;
    for (int i = 0; i < 4; ++i)
        normals.insert(normals.end(), {n.x, n.y, n.z, 0.0f});
    std::vector<std::int8_t> octahedral(16);
    meshopt_encodeFilterOct(octahedral.data(), 4, 4, 8, normals.data());
    Packed packed = packedVertices(octahedral, 4);
    packed.filter = "OCTAHEDRAL";
    Gltf g = square();
    g.root["accessors"][1].update({{"componentType", kByte}, {"normalized", true}});
    g.root["bufferViews"][1]["byteStride"] = 4;
    COTAN_LOADED(scene, loadText(packedModel(g, 1, packed)));
    for (const glm::vec3& found : scene.meshes[0].normals)
        EXPECT_LT(glm::length(found - n), 0.025f); // bytes: half a step of 1/127 in each of two numbers, twice
}

// q and -q are the same rotation.
TEST(PackedViews, quaternionsKeepTheirRotation)
{
    std::vector<float> rotations = {0.1f, 0.2f, 0.3f, 0.9f, 0.9f,  0.1f, -0.3f, 0.2f,
                                    0,    0,    1,    0,    -0.5f, 0.5f, 0.5f,  0.5f};
    for (std::size_t q = 0; q < 16; q += 4) {
        const float length = glm::length(glm::vec4(rotations[q], rotations[q + 1], rotations[q + 2], rotations[q + 3]));
        for (std::size_t c = 0; c < 4; ++c)
            rotations[q + c] /= length;
    }
    std::vector<std::int16_t> encoded(16);
    meshopt_encodeFilterQuat(encoded.data(), 4, 8, 12, rotations.data());
    Packed packed = packedVertices(encoded, 4);
    packed.filter = "QUATERNION";
    Gltf g = square();
    const int tangents = g.accessor(encoded, "VEC4", kShort, true);
    primitive(g)["attributes"]["TANGENT"] = tangents;
    const TemporaryFolder folder;
    const auto document = openText(folder, packedModel(g, 4, packed));
    ASSERT_TRUE(document) << document.error().message;
    const auto geometry = gltfGeometry(*document, 0, 0);
    ASSERT_TRUE(geometry);
    for (std::size_t v = 0; v < 4; ++v) {
        const glm::vec4 q(rotations[4 * v], rotations[4 * v + 1], rotations[4 * v + 2], rotations[4 * v + 3]);
        // Half a step of 1/32767 in each of four numbers, whose absolute values sum to at most 2.
        EXPECT_GT(std::abs(glm::dot(geometry->tangents[v], q)), 1 - 4e-5f) << v;
    }
}

TEST(PackedViews, errorsNameTheWrongField)
{
    const Packed vertices = packedVertices(kSquare, 3), indices = packedIndices(kTwoTriangles, true);
    const auto with = [](Packed p, std::size_t count, std::size_t stride, const char* filter = "NONE",
                         const char* mode = nullptr) {
        p.count = count, p.stride = stride, p.filter = filter;
        p.mode = mode ? mode : p.mode;
        return p;
    };
    const std::tuple<std::size_t, Packed, std::string> cases[] = {
        {0, with(vertices, 8, 6), ".byteStride: expected a multiple of 4 up to 256, found 6"},
        {0, with(vertices, 4, 260), ".byteStride: expected an integer from 1 to 256, found 260"},
        {0, with(vertices, 4, 0), ".byteStride: expected an integer from 1 to 256, found 0"},
        {0, with(vertices, 4, 12, "OCTAHEDRAL"), ".byteStride: expected 4 or 8 for filter OCTAHEDRAL, found 12"},
        {0, with(vertices, 12, 4, "QUATERNION"), ".byteStride: expected 8 for filter QUATERNION, found 4"},
        {0, with(vertices, 16, 3, "NONE", "TRIANGLES"), ".byteStride: expected 2 or 4, found 3"},
        {0, with(vertices, 48, 1, "NONE", "INDICES"), ".byteStride: expected 2 or 4, found 1"},
        {3, with(indices, 5, 2), ".count: expected a multiple of 3, found 5"},
        {3, with(indices, 4, 2), ".count: expected a multiple of 3, found 4"},
        {3, with(indices, 6, 2, "EXPONENTIAL"), ".filter: expected none for mode TRIANGLES, found EXPONENTIAL"},
        {3, with(indices, 9, 2), ": the compressed bytes are damaged, or not 9 elements of 2 bytes"}};
    for (const auto& [view, packed, word] : cases)
        COTAN_REFUSED(loadPacked(view, packed),
                      "bufferViews[" + std::to_string(view) + "].extensions.EXT_meshopt_compression" + word);
    json wrong = json::parse(packedModel(square(), 0, vertices));
    wrong["bufferViews"][0]["byteLength"] = 49;
    COTAN_REFUSED(loadText(wrong.dump()),
                  "bufferViews[0].extensions.EXT_meshopt_compression: expected 49 bytes, as the view has, found 4 "
                  "elements of 12 bytes");
}

// 64 times the file's size plus geometryBytes may be decoded: the last byte is allowed, one more is not.
TEST(PackedViews, areLimitedToTheirAllowance)
{
    constexpr std::size_t kCount = 8192, kViews = 10;
    Gltf g = square();
    const std::string stream = packedVertices(std::vector<float>(3 * kCount, 0), 3).bytes;
    const std::size_t at = (g.bytes.size() + 3) / 4 * 4;
    g.bytes.resize(at);
    g.bytes += stream;
    const json packed = {{"buffer", 0},      {"byteOffset", at}, {"byteLength", stream.size()},
                         {"byteStride", 12}, {"count", kCount},  {"mode", "ATTRIBUTES"}};
    for (std::size_t v = 0; v < kViews; ++v)
        g.add("bufferViews", {{"buffer", 1}, {"byteLength", 12 * kCount}, {"extensions", {{kEarlier, packed}}}});
    json whole = json::parse(g.text());
    whole["buffers"].push_back({{"byteLength", 12 * kCount}, {"extensions", {{kEarlier, {{"fallback", true}}}}}});
    const std::string text = whole.dump();
    constexpr std::size_t kDecodedBytes = 12 * kCount * kViews;
    ASSERT_GT(kDecodedBytes, 64 * text.size());
    LoadLimits limits;
    limits.geometryBytes = kDecodedBytes - 64 * text.size();
    EXPECT_TRUE(loadText(text, "model.gltf", limits));
    --limits.geometryBytes;
    COTAN_REFUSED(
        loadText(text, "model.gltf", limits),
        "bufferViews[13].extensions.EXT_meshopt_compression: decoded geometry takes 983040 bytes in total, the limit "
        "is 983039 for a file of "
            + std::to_string(text.size()) + " bytes");
}

} // namespace
} // namespace cotan::test
