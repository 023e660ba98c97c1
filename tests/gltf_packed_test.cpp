// Compressed geometry: what a document keeps, writes and notes of each primitive and view, and the decoders'
// requirements on a stream.
#include <algorithm>

#include "cotan/scene.hpp"
#include "gltf/draco.hpp"
#include "gltf_edit_maker.hpp"
#include "gltf_packed_maker.hpp"

namespace cotan::test {
namespace {

constexpr const char* kDraco = "KHR_draco_mesh_compression";

// ---- Draco: several primitives --------------------------------------------------------------

// Mesh 0: a sheet whose stream has tangents. Mesh 1: a smaller one whose normals are not compressed.
Gltf twoStreams()
{
    const Sheet large = sheet(4), small = sheet(3);
    std::vector<float> tangents, normals;
    for (std::size_t v = 0; v < large.vertices(); ++v)
        tangents.insert(tangents.end(), {1, 0, 0, 1});
    for (std::size_t v = 0; v < small.vertices(); ++v)
        normals.insert(normals.end(), {0, 0, 1});
    Gltf g = dracoModel(large, dracoStream(large, draco::MESH_EDGEBREAKER_ENCODING, tangents));
    primitive(g)["attributes"]["TANGENT"] =
        g.accessor(json{{"componentType", kFloat}, {"type", "VEC4"}, {"count", large.vertices()}});
    primitive(g)["extensions"][kDraco]["attributes"]["TANGENT"] = 3;
    const std::string stream = dracoStream(small, draco::MESH_SEQUENTIAL_ENCODING);
    const int view = g.view(std::vector<char>(stream.begin(), stream.end()));
    const json attributes = {
        {"POSITION", g.accessor(json{{"componentType", kFloat}, {"type", "VEC3"}, {"count", small.vertices()}})},
        {"TEXCOORD_0", g.accessor(json{{"componentType", kFloat}, {"type", "VEC2"}, {"count", small.vertices()}})},
        {"NORMAL", g.floats(normals, "VEC3")}};
    const json order = {{"componentType", kUShort}, {"type", "SCALAR"}, {"count", small.indices.size()}};
    const json packed = {{"bufferView", view}, {"attributes", {{"POSITION", 0}, {"TEXCOORD_0", 1}}}};
    g.add("meshes",
          {{"primitives",
            {{{"attributes", attributes}, {"indices", g.accessor(order)}, {"extensions", {{kDraco, packed}}}}}}});
    g.root["nodes"][0]["children"] = {1};
    g.add("nodes", {{"mesh", 1}});
    return g;
}

TEST(DracoGeometry, isKeptOrDecodedPerPrimitive)
{
    for (const bool required : {true, false}) {
        Gltf g = twoStreams();
        if (!required)
            g.root.erase("extensionsRequired");
        const TemporaryFolder folder;
        auto document = openText(folder, g.text());
        ASSERT_TRUE(document) << document.error().message;
        ASSERT_TRUE(dropGltfTangents(*document, 0, 0));
        const auto geometry = gltfGeometry(*document, 1, 0);
        ASSERT_TRUE(geometry);
        GltfCornerTangents corners{1, 0, std::vector<glm::vec4>(geometry->indices.size(), {1, 0, 0, 1})};
        for (std::size_t i = 0; i < corners.corners.size(); ++i) // one corner of a shared vertex
            if (std::ranges::count(geometry->indices, geometry->indices[i]) > 1) {
                corners.corners[i].w = -1;
                break;
            }
        const auto added = setGltfTangents(*document, {&corners, 1});
        ASSERT_TRUE(added) << added.error().message;
        EXPECT_EQ(*added, 1u);
        const auto written = writeGltf(*document, folder.path / "out.glb");
        ASSERT_TRUE(written) << written.error().message;
        ASSERT_EQ(written->notes.size(), 2u);
        EXPECT_EQ(written->notes[0].find("KHR_draco_mesh_compression: 1 of 2 streams are unchanged"), 0u)
            << written->notes[0];
        EXPECT_EQ(written->notes[1].find("KHR_draco_mesh_compression: 1 of 2 primitives changed"), 0u)
            << written->notes[1];
        const ReadBack out = readBack(folder.path / "out.glb");
        EXPECT_EQ(out.root["extensionsUsed"], json({kDraco}));
        EXPECT_EQ(out.root.value("extensionsRequired", json()), required ? json({kDraco}) : json());
        const json &kept = out.root["meshes"][0]["primitives"][0], &plain = out.root["meshes"][1]["primitives"][0];
        EXPECT_EQ(kept["extensions"][kDraco]["attributes"],
                  json({{"POSITION", 0}, {"TEXCOORD_0", 1}, {"_NUMBERS", 2}}));
        EXPECT_FALSE(plain.contains("extensions"));
        for (const auto& item : kept["attributes"].items())
            EXPECT_FALSE(out.root["accessors"][item.value().get<std::size_t>()].contains("bufferView")) << item.key();
        for (const auto& item : plain["attributes"].items())
            EXPECT_EQ(out.root["accessors"][item.value().get<std::size_t>()]["count"], 17) << item.key();
        EXPECT_TRUE(loadGltf(folder.path / "out.glb"));
    }
}

TEST(DracoGeometry, sharedByTwoPrimitivesIsDecodedAndWrittenOnce)
{
    const Sheet s = sheet(4);
    const std::string stream = dracoStream(s, draco::MESH_EDGEBREAKER_ENCODING);
    Gltf g = dracoModel(s, stream);
    g.root["meshes"][0]["primitives"].push_back(primitive(g));
    const TemporaryFolder folder;
    const auto document = openText(folder, g.text());
    ASSERT_TRUE(document) << document.error().message;
    EXPECT_EQ(gltfGeometry(*document, 0, 1)->positions, gltfGeometry(*document, 0, 0)->positions);
    const auto written = writeGltf(*document, folder.path / "out.glb");
    ASSERT_TRUE(written);
    EXPECT_TRUE(written->notes.empty());
    const ReadBack out = readBack(folder.path / "out.glb");
    EXPECT_EQ(out.root["meshes"], g.root["meshes"]);
    EXPECT_EQ(out.root["accessors"], g.root["accessors"]);
    EXPECT_LT(out.buffer.size(), stream.size() + 4);
    // Two different streams must not fill the same accessor.
    json order = g.root["accessors"][3];
    g.root["meshes"][0]["primitives"][1]["indices"] = g.accessor(order);
    COTAN_REFUSED(g.load(),
                  "meshes[0].primitives[1].extensions.KHR_draco_mesh_compression: accessors[0] also belongs to another "
                  "compressed primitive");
}

// Attributes begin at multiples of four bytes, as glTF requires; indices do not. Other modes cannot use a stream.
TEST(DracoGeometry, isDecodedIntoPlainAccessors)
{
    const Sheet s = sheet(4); // 25 vertices, 96 indices
    for (const int method : kMethods) {
        const TemporaryFolder folder;
        auto document = openText(folder, dracoModel(s, dracoStream(s, method)).text());
        ASSERT_TRUE(document) << document.error().message;
        auto& root = rootOf(*document);
        const auto viewOf = [&](std::size_t accessor) {
            return root["bufferViews"][root["accessors"][accessor]["bufferView"].get<std::size_t>()];
        };
        const std::pair<std::size_t, std::size_t> sizes[] = {{0, 300}, {1, 200}, {2, 100}, {3, 192}};
        for (const auto& [accessor, bytes] : sizes) {
            EXPECT_EQ(viewOf(accessor)["byteLength"], bytes) << accessor;
            EXPECT_EQ(viewOf(accessor).value("byteStride", 0), accessor == 2 ? 4 : 0) << accessor;
        }
        root["meshes"][0]["primitives"][0]["mode"] = 0; // points from here on
        const auto written = writeGltf(*document, folder.path / "out.glb");
        ASSERT_TRUE(written);
        EXPECT_EQ(written->notes.size(), 1u);
        const ReadBack out = readBack(folder.path / "out.glb");
        EXPECT_EQ(out.root.dump().find("draco"), std::string::npos);
        const std::vector<float> positions = floatsOf(out, 0, 3), uv = floatsOf(out, 1, 2);
        const std::vector<std::string> numbers = elements(out, 2, 3);
        glm::vec3 low(9), high(-9);
        for (std::size_t v = 0; v < s.vertices(); ++v) {
            const glm::vec3 p(positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]);
            EXPECT_EQ(numbers[v], (std::string{char(std::lround(4 * p.x)), char(std::lround(4 * p.y)), char(7)})) << v;
            EXPECT_NEAR(uv[2 * v], p.x, 1e-3);
            EXPECT_NEAR(uv[2 * v + 1], 1 - p.y, 1e-3);
            low = glm::min(low, p), high = glm::max(high, p);
        }
        const json& bounds = out.root["accessors"][0];
        EXPECT_EQ(bounds["min"].get<std::vector<float>>(), (std::vector<float>{low.x, low.y, low.z}));
        EXPECT_EQ(bounds["max"].get<std::vector<float>>(), (std::vector<float>{high.x, high.y, high.z}));
        std::vector<int> used(25, 0);
        for (const std::uint16_t i : shortsOf(out, 3))
            ++used.at(i);
        EXPECT_EQ(*std::ranges::min_element(used), 1); // a corner of the sheet
        EXPECT_EQ(*std::ranges::max_element(used), 6);
    }
}

TEST(DracoGeometry, isDecodedIfAnyAccessorHasNoView)
{
    const Sheet s = sheet(4);
    Gltf g = dracoModel(s, dracoStream(s, draco::MESH_SEQUENTIAL_ENCODING));
    const auto whole = g.load();
    primitive(g)["mode"] = 4; // the default, stated explicitly
    g.root["accessors"][2]["bufferView"] = g.view(std::vector<std::uint8_t>(75, 1));
    const auto mixed = g.load();
    ASSERT_TRUE(mixed) << mixed.error().message;
    EXPECT_EQ(mixed->meshes[0].positions, whole->meshes[0].positions);
}

TEST(DracoGeometry, errorsNameTheWrongField)
{
    const Sheet s = sheet(4);
    const std::string stream = dracoStream(s, draco::MESH_SEQUENTIAL_ENCODING);
    const std::string at = "/meshes/0/primitives/0", packed = at + "/extensions/KHR_draco_mesh_compression";
    const std::string field = "meshes[0].primitives[0].extensions.KHR_draco_mesh_compression";
    const json sparse = {
        {"count", 1}, {"indices", {{"bufferView", 0}, {"componentType", kUShort}}}, {"values", {{"bufferView", 0}}}};
    const std::tuple<std::string, json, std::string> cases[] = {
        {at + "/mode", 3, field + ": expected mode 4, triangles, found 3"},
        {"/accessors/1/sparse", sparse, field + ": accessors[1] has sparse values"},
        {"/accessors/1/count", 24, field + ".attributes.TEXCOORD_0: expected 25 elements, found 24"},
        {packed + "/attributes", json::object(), field + ".attributes: expected at least one, with vertices"},
        {packed + "/attributes/POSITION", 4294967296, field + ".attributes.POSITION: expected the id"},
        {packed + "/attributes/POSITION", 4294967295,
         field + ": the Draco stream has no attribute with the id 4294967295"},
        {"/accessors/1/type", "VEC4", field + ": expected 4 components in the Draco attribute with the id 1, found 2"}};
    for (const auto& [where, value, word] : cases) {
        Gltf g = dracoModel(s, stream);
        g.root[json::json_pointer(where)] = value;
        COTAN_REFUSED(g.load(), word);
    }
    Gltf none = dracoModel(s, stream);
    for (std::size_t a = 0; a < 3; ++a)
        none.root["accessors"][a]["count"] = 0;
    COTAN_REFUSED(none.load(), field + ".attributes: expected at least one, with vertices");
}

// The number of the first index, and of the first vertex, that does not fit.
TEST(DracoGeometry, errorsNameTheFirstWrongIndexAndVertex)
{
    const Sheet s = sheet(20); // 441 vertices
    for (const int method : kMethods) {
        Gltf g = dracoModel(s, dracoStream(s, method));
        const TemporaryFolder folder;
        const auto document = openText(folder, g.text());
        ASSERT_TRUE(document) << document.error().message;
        const auto geometry = gltfGeometry(*document, 0, 0);
        ASSERT_TRUE(geometry);
        const auto index = std::ranges::find_if(geometry->indices, [](std::uint32_t i) { return i > 255; });
        ASSERT_NE(index, geometry->indices.end());
        g.root["accessors"][3]["componentType"] = kUByte;
        COTAN_REFUSED(g.load(),
                      "index " + std::to_string(index - geometry->indices.begin()) + " of the Draco stream is "
                          + std::to_string(*index) + ", but there are 441 vertices and an index has 1 bytes");
        g.root["accessors"][3]["componentType"] = kUShort;
        const auto below = std::ranges::find_if(geometry->positions, [](const glm::vec3& p) { return p.z < 0; });
        ASSERT_NE(below, geometry->positions.end());
        g.root["accessors"][0]["componentType"] = kUByte;
        COTAN_REFUSED(g.load(),
                      "vertex " + std::to_string(below - geometry->positions.begin())
                          + " of the Draco attribute with the id 0 cannot be converted to bytes");
    }
}

// ---- Draco: the header ----------------------------------------------------------------------

DracoJob jobOf(const Sheet& s, const std::string& stream)
{
    DracoJob job{"here", {}, s.vertices(), s.indices.size(), kUShort, {{0, kFloat, 3}, {2, kUByte, 3}}};
    for (const char c : stream)
        job.bytes.push_back(std::byte(c));
    return job;
}

std::string refusalOf(const DracoJob& job)
{
    const auto meshes = decodeDracoHere({job});
    if (meshes)
        return "";
    EXPECT_EQ(meshes.error().kind, ErrorKind::input);
    return meshes.error().message;
}

// Draco Bitstream Specification 2.2, section 4: "DRACO", version, kind, method, flags; then counts, each one byte here.
TEST(DracoHeader, mustMatchTheModel)
{
    const Sheet s = sheet(4); // 25 vertices, 32 triangles
    for (const int method : kMethods) {
        const DracoJob job = jobOf(s, dracoStream(s, method));
        EXPECT_EQ(refusalOf(job), "");
        const bool sequential = method == draco::MESH_SEQUENTIAL_ENCODING;
        const std::size_t faces = sequential ? 11 : 13, vertices = 12;
        const std::tuple<std::size_t, int, const char*> cases[] = {
            {0, 'd', "here: expected a Draco stream, found other data"},
            {4, 'o', "here: expected a Draco stream, found other data"},
            {5, 1, "here: expected Draco bitstream 2.2, found 1.2"},
            {5, 3, "here: expected Draco bitstream 2.2, found 3.2"},
            {6, 1, "here: expected Draco bitstream 2.2, found 2.1"},
            {6, 3, "here: expected Draco bitstream 2.2, found 2.3"},
            {7, 0, "here: expected a mesh of triangles, found another kind of Draco stream"},
            {7, 2, "here: expected a mesh of triangles, found another kind of Draco stream"},
            {8, 2, "here: expected a mesh of triangles, found another kind of Draco stream"},
            {10, 0x80, "here: the Draco stream has metadata, which is not supported"},
            {faces, 31, "here: expected 96 indices, as the accessor has, found 31 triangles in the Draco stream"},
            {faces, 33, "here: expected 96 indices, as the accessor has, found 33 triangles in the Draco stream"},
            {vertices, 26, "here: expected 25 vertices, as the accessors have, found 26 in the Draco stream"}};
        for (const auto& [at, value, message] : cases) {
            DracoJob wrong = job;
            wrong.bytes[at] = std::byte(value);
            EXPECT_EQ(refusalOf(wrong), message) << at << " in " << method;
        }
        const std::size_t header = sequential ? 13 : 14;
        for (std::size_t length = 11; length <= header; ++length) {
            DracoJob cut = job;
            cut.bytes.resize(length);
            EXPECT_EQ(refusalOf(cut) == "here: the Draco stream ends within its header", length < header) << length;
        }
        DracoJob other = job;
        other.indices = 97; // not a multiple of three
        EXPECT_EQ(refusalOf(other).find("here: expected 97 indices, as the accessor has, found 32 triangles"), 0u);
        other = job;
        other.vertices = 26;
        EXPECT_EQ(refusalOf(other).find("here: expected 26 vertices, as the accessors have, found 25"), 0u);
    }
}

// Each stream yields the data of its own job, and indices of each width are equal.
TEST(DracoHeader, isFollowedByDataOfTheRequestedTypes)
{
    const Sheet large = sheet(4), small = sheet(2);
    const std::string stream = dracoStream(large, draco::MESH_EDGEBREAKER_ENCODING);
    std::vector<DracoJob> jobs(3, jobOf(large, stream));
    jobs[0].indexType = kUByte, jobs[2].indexType = kUInt;
    jobs.push_back(jobOf(small, dracoStream(small, draco::MESH_SEQUENTIAL_ENCODING)));
    std::swap(jobs[3].attributes[0], jobs[3].attributes[1]);
    const auto meshes = decodeDracoHere(jobs);
    ASSERT_TRUE(meshes) << meshes.error().message;
    ASSERT_EQ(meshes->size(), 4u);
    const auto index = [&](std::size_t job, std::size_t i, std::size_t width) {
        std::uint32_t value = 0;
        std::memcpy(&value, meshes->at(job).indices.data() + i * width, width);
        return value;
    };
    ASSERT_EQ(meshes->at(0).indices.size(), 96u);
    ASSERT_EQ(meshes->at(1).indices.size(), 192u);
    ASSERT_EQ(meshes->at(2).indices.size(), 384u);
    for (std::size_t i = 0; i < 96; ++i) {
        EXPECT_EQ(index(0, i, 1), index(1, i, 2)) << i;
        EXPECT_EQ(index(2, i, 4), index(1, i, 2)) << i;
    }
    ASSERT_EQ(meshes->at(1).attributes.size(), 2u);
    EXPECT_EQ(meshes->at(1).attributes[0].size(), 300u);
    EXPECT_EQ(meshes->at(1).attributes[1].size(), 75u);
    EXPECT_EQ(meshes->at(3).indices.size(), 48u);
    EXPECT_EQ(meshes->at(3).attributes[0].size(), 27u);
    EXPECT_EQ(meshes->at(3).attributes[0][2], std::byte(7));
    EXPECT_EQ(meshes->at(3).attributes[1].size(), 108u);
}

} // namespace
} // namespace cotan::test
