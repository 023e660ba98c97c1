// Bytes and references of a file after something is no longer used. Expected offsets are counted by hand from the sizes
// of the elements.
#include "gltf_edit_maker.hpp"

namespace cotan::test {
namespace {

const std::vector<float> kTangents = {1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 1, 1, 1, 0, 0, -1};

struct Dropped {
    ReadBack out;
    std::vector<std::string> notes;
};

// Removes the tangents of the first primitive, writes the model and reads it back.
Dropped withoutTangents(const Gltf& g)
{
    const TemporaryFolder folder;
    auto document = openText(folder, g.text());
    EXPECT_TRUE(document) << document.error().message;
    EXPECT_TRUE(dropGltfTangents(*document, 0, 0));
    const auto written = writeGltf(*document, folder.path / "out.glb");
    EXPECT_TRUE(written) << written.error().message;
    const auto loaded = loadGltf(folder.path / "out.glb");
    EXPECT_TRUE(loaded) << loaded.error().message;
    return {readBack(folder.path / "out.glb"), written->notes};
}

json inView(int view, std::size_t offset, int componentType, const char* type, std::size_t count)
{
    return {{"bufferView", view},
            {"byteOffset", offset},
            {"componentType", componentType},
            {"type", type},
            {"count", count}};
}

// ---- views that shrink ----------------------------------------------------------------------

// One view without stride: 6 bytes of indices, tangents, positions partly shared with a second accessor, normals.
TEST(GltfLayout, partsOfAViewAreCompactedIfOneIsRemoved)
{
    Gltf g;
    std::vector<float> words = {0, 0}; // indices 0 1 2, and 2 unused bytes
    const std::uint16_t order[] = {0, 1, 2};
    std::memcpy(words.data(), order, sizeof order);
    words.insert(words.end(), kTangents.begin(), kTangents.end()); // from byte 8
    std::vector<float> squares(12);
    for (std::size_t i = 0; i < 12; ++i)
        squares[i] = float(i * i);
    words.insert(words.end(), squares.begin(), squares.end());               // from byte 72
    words.insert(words.end(), kSquareNormals.begin(), kSquareNormals.end()); // from byte 120
    words.insert(words.end(), {0, 0});                                       // shorts from byte 170
    const std::uint16_t late[] = {7, 8};
    std::memcpy(reinterpret_cast<char*>(words.data()) + 170, late, sizeof late);
    const int view = g.view(words);
    g.root["bufferViews"][0]["name"] = "all";
    const int indices = g.accessor(inView(view, 0, kUShort, "SCALAR", 3));
    const int tangents = g.accessor(inView(view, 8, kFloat, "VEC4", 4));
    const int positions = g.accessor(inView(view, 72, kFloat, "VEC3", 4));
    const int parts = g.accessor(inView(view, 84, kFloat, "SCALAR", 4));
    const int normals = g.accessor(inView(view, 120, kFloat, "VEC3", 4));
    const json attributes = {{"POSITION", positions}, {"NORMAL", normals}, {"TANGENT", tangents}, {"_PART", parts}};
    const int shorts = g.accessor(inView(view, 170, kUShort, "SCALAR", 2));
    json made = {{"attributes", attributes}, {"indices", indices}};
    g.add("meshes", {{"primitives", {made}}});
    // Keys and values of an animation need not be at multiples of four.
    g.root["animations"] = {{{"samplers", {{{"input", shorts}, {"output", shorts}}}}, {"channels", json::array()}}};
    g.add("nodes", {{"mesh", 0}});
    const Dropped done = withoutTangents(g);
    const json& p = done.out.root["meshes"][0]["primitives"][0];
    EXPECT_EQ(shortsOf(done.out, p["indices"]), (std::vector<std::uint16_t>{0, 1, 2}));
    EXPECT_EQ(floatsOf(done.out, p["attributes"]["POSITION"], 3), squares);
    EXPECT_EQ(floatsOf(done.out, p["attributes"]["_PART"], 1),
              std::vector<float>(squares.begin() + 3, squares.begin() + 7));
    EXPECT_EQ(floatsOf(done.out, p["attributes"]["NORMAL"], 3), kSquareNormals);
    ASSERT_EQ(done.out.root["bufferViews"].size(), 1u);
    EXPECT_EQ(done.out.root["bufferViews"][0]["name"], "all");
    EXPECT_EQ(shortsOf(done.out, shorts - 1), (std::vector<std::uint16_t>{7, 8}));
    EXPECT_EQ(done.out.root["bufferViews"][0]["byteLength"], 8 + 48 + 48 + 2 + 4);
    EXPECT_EQ(done.out.buffer.size(), 8u + 48 + 48 + 2 + 4);
    const auto offset = [&](const json& accessor) {
        return done.out.root["accessors"][accessor.get<int>()].value("byteOffset", 0);
    };
    EXPECT_EQ(offset(p["indices"]), 0);
    EXPECT_EQ(offset(p["attributes"]["POSITION"]), 8);
    EXPECT_EQ(offset(p["attributes"]["_PART"]), 20);
    EXPECT_EQ(offset(p["attributes"]["NORMAL"]), 56);
    EXPECT_EQ(offset(shorts - 1), 106); // the offset modulo four is unchanged
    EXPECT_TRUE(done.notes.empty());
}

// Rows of 36 bytes from offset 8: position, tangent, two shorts in one word, and three or four bytes at the end of the
// view. The rows of another primitive, which keeps its tangents, follow directly.
void checkColumns(std::size_t width)
{
    SCOPED_TRACE(width);
    Gltf g;
    constexpr std::size_t kStride = 36;
    std::string bytes(8 + 8 * kStride + width - 4, 'g'); // the last row may lack one unused byte
    for (std::size_t row = 0; row < 8; ++row) {
        const auto put = [&](std::size_t at, const void* from, std::size_t size) {
            std::memcpy(bytes.data() + 8 + row * kStride + at, from, size);
        };
        const std::uint16_t pair[] = {std::uint16_t(100 + row), std::uint16_t(200 + row)};
        const std::uint8_t last[] = {std::uint8_t(row), std::uint8_t(10 + row), std::uint8_t(20 + row),
                                     std::uint8_t(30 + row)};
        put(0, &kSquare[3 * (row % 4)], 12);
        put(12, &kTangents[4 * (row % 4)], 16);
        put(28, pair, 4);
        put(32, last, width);
    }
    const int view = g.view(std::vector<char>(bytes.begin(), bytes.end()));
    g.root["bufferViews"][0]["byteStride"] = kStride;
    for (const std::size_t start : {std::size_t(8), 8 + 4 * kStride}) {
        const json attributes = {
            {"POSITION", g.accessor(inView(view, start, kFloat, "VEC3", 4))},
            {"TANGENT", g.accessor(inView(view, start + 12, kFloat, "VEC4", 4))},
            {"_LOW", g.accessor(inView(view, start + 28, kUShort, "SCALAR", 4))},
            {"_HIGH", g.accessor(inView(view, start + 30, kUShort, "SCALAR", 4))},
            {"_LAST", g.accessor(inView(view, start + 32, kUByte, width == 3 ? "VEC3" : "VEC4", 4))}};
        g.add("meshes", {{"primitives", {{{"attributes", attributes}}}}});
    }
    g.add("nodes", {{"mesh", 0}, {"children", {1}}});
    g.add("nodes", {{"mesh", 1}});
    const Dropped done = withoutTangents(g);
    for (std::size_t m = 0; m < 2; ++m) {
        const json& a = done.out.root["meshes"][m]["primitives"][0]["attributes"];
        EXPECT_EQ(floatsOf(done.out, a["POSITION"], 3), kSquare);
        EXPECT_EQ(a.contains("TANGENT"), m == 1);
        const auto low = shortsOf(done.out, a["_LOW"]), high = shortsOf(done.out, a["_HIGH"]);
        const auto last = elements(done.out, a["_LAST"], width);
        for (std::size_t i = 0; i < 4; ++i) {
            const int row = int(4 * m + i);
            EXPECT_EQ(low[i], 100 + row);
            EXPECT_EQ(high[i], 200 + row);
            const std::string bytesOfRow = {char(row), char(10 + row), char(20 + row), char(30 + row)};
            EXPECT_EQ(last[i], bytesOfRow.substr(0, width));
        }
        const json& accessor = done.out.root["accessors"][a["_HIGH"].get<int>()];
        const json& rows = done.out.root["bufferViews"][accessor["bufferView"].get<int>()];
        EXPECT_EQ(rows["byteStride"], m == 0 ? 20 : 36);
    }
    EXPECT_EQ(floatsOf(done.out, done.out.root["meshes"][1]["primitives"][0]["attributes"]["TANGENT"], 4), kTangents);
    // Four rows of 20 bytes, and four unchanged ones that may lack the last byte: gaps only for alignment to four.
    EXPECT_LE(done.out.buffer.size(), 4 * 20 + 4 * kStride);
    EXPECT_GE(done.out.buffer.size(), 4 * 20 + 4 * kStride + width - 4);
}

TEST(GltfLayout, interleavedColumnsAreRemovedAndTheOthersCompacted)
{
    checkColumns(3);
    checkColumns(4);
}

// A view that an image or sparse values also use cannot be split.
TEST(GltfLayout, viewsWithOtherReadersAreNotSplit)
{
    for (const bool image : {true, false}) {
        Gltf g = square();
        std::vector<float> words = kTangents;
        words.insert(words.end(), kSquare.begin(), kSquare.end());
        const int view = g.view(words);
        primitive(g)["attributes"]["TANGENT"] = g.accessor(inView(view, 0, kFloat, "VEC4", 4));
        primitive(g)["attributes"]["POSITION"] = g.accessor(inView(view, 64, kFloat, "VEC3", 4));
        if (image) {
            g.add("images", {{"bufferView", view}, {"mimeType", "image/png"}});
            g.add("textures", {{"source", 0}});
        } else {
            const int sparseIndices = g.view(std::vector<std::uint16_t>{2});
            primitive(g)["targets"] = {
                {{"POSITION",
                  g.accessor({{"componentType", kFloat},
                              {"count", 4},
                              {"type", "VEC3"},
                              {"sparse",
                               {{"count", 1},
                                {"indices", {{"bufferView", sparseIndices}, {"componentType", kUShort}}},
                                {"values", {{"bufferView", view}, {"byteOffset", 16}}}}}})}}};
        }
        const Dropped done = withoutTangents(g);
        const json& p = done.out.root["meshes"][0]["primitives"][0];
        const json& a = done.out.root["accessors"][p["attributes"]["POSITION"].get<int>()];
        EXPECT_EQ(a["byteOffset"], 64) << image;
        EXPECT_EQ(done.out.root["bufferViews"][a["bufferView"].get<int>()]["byteLength"], 112) << image;
        EXPECT_EQ(floatsOf(done.out, p["attributes"]["POSITION"], 3), kSquare);
        const json& reader = image
            ? done.out.root["images"][0]
            : done.out.root["accessors"][p["targets"][0]["POSITION"].get<int>()]["sparse"]["values"];
        EXPECT_EQ(reader["bufferView"], a["bufferView"]) << image;
    }
}

// Only what the edit stopped using is removed, and what was added in vain. What the file never used stays.
TEST(GltfLayout, initiallyUnusedDataIsKeptAndUnusedAdditionsAreRemoved)
{
    Gltf g = square();
    addNormalMap(g);
    const int unused = g.floats({3, 1, 4}, "SCALAR");
    g.root["bufferViews"].push_back({{"buffer", 0}, {"byteLength", 4}, {"name", "of nobody"}});
    g.add("images", {{"uri", "data:image/png;base64," + base64(flatPng())}, {"name", "spare"}});
    primitive(g)["attributes"]["TANGENT"] = g.floats(kTangents, "VEC4");
    const TemporaryFolder folder;
    auto document = openText(folder, g.text());
    ASSERT_TRUE(document) << document.error().message;
    ASSERT_TRUE(dropGltfTangents(*document, 0, 0));
    EXPECT_FALSE(dropGltfTangents(*document, 0, 0)); // already removed
    EXPECT_EQ(addGltfImage(*document, std::vector<std::byte>(20), "image/png", "in vain"), 2u);
    ASSERT_TRUE(writeGltf(*document, folder.path / "out.glb"));
    const ReadBack out = readBack(folder.path / "out.glb");
    EXPECT_EQ(floatsOf(out, unused, 1), (std::vector<float>{3, 1, 4}));
    EXPECT_EQ(out.root["accessors"].size(), g.root["accessors"].size() - 1);
    EXPECT_EQ(out.root["bufferViews"].size(), g.root["bufferViews"].size() - 1);
    EXPECT_EQ(out.root["bufferViews"][5]["name"], "of nobody");
    ASSERT_EQ(out.root["images"].size(), 2u);
    EXPECT_EQ(out.root["images"][1]["name"], "spare");
    EXPECT_EQ(out.buffer.size(), g.bytes.size() - 64);
}

// Views in any order of the JSON, one around two others, one without an offset: each keeps its bytes.
TEST(GltfLayout, viewsWithinAViewMoveWithIt)
{
    Gltf g;
    for (int i = 0; i < 40; ++i)
        g.bytes += word(std::uint32_t(i));
    const auto view = [&](std::size_t first, std::size_t words) {
        json v = {{"buffer", 0}, {"byteLength", 4 * words}};
        if (first > 0)
            v["byteOffset"] = 4 * first;
        g.root["bufferViews"].push_back(v);
    };
    view(30, 2), view(10, 18), view(12, 3), view(20, 8), view(0, 3); // 3 to 9, 28, 29 and 32 to 39 are unused
    for (int v = 0; v < 5; ++v)
        g.accessor({{"bufferView", v}, {"componentType", kUInt}, {"type", "SCALAR"}, {"count", 2}});
    const TemporaryFolder folder;
    const auto document = openText(folder, g.text());
    ASSERT_TRUE(document) << document.error().message;
    ASSERT_TRUE(writeGltf(*document, folder.path / "out.gltf"));
    const ReadBack out = readBack(folder.path / "out.gltf");
    const std::size_t offsets[] = {3 + 18, 3, 3 + 2, 3 + 10, 0};
    for (std::size_t v = 0; v < 5; ++v) {
        EXPECT_EQ(out.root["bufferViews"][v].value("byteOffset", 0u), 4 * offsets[v]) << v;
        EXPECT_EQ(out.root["bufferViews"][v]["byteLength"], g.root["bufferViews"][v]["byteLength"]) << v;
    }
    EXPECT_FALSE(out.root["bufferViews"][4].contains("byteOffset"));
    EXPECT_EQ(out.buffer, g.bytes.substr(0, 12) + g.bytes.substr(40, 72) + g.bytes.substr(120, 8));
}

// ---- references -----------------------------------------------------------------------------

// Accessor 0, its view and, if requested, an image are removed: all references to later ones must be adjusted.
TEST(GltfReferences, ofEveryKindFollowIndexChanges)
{
    Gltf g;
    const int tangents = g.floats(kTangents, "VEC4");
    const json attributes = {{"POSITION", g.floats(kSquare, "VEC3")}, {"NORMAL", g.floats(kSquareNormals, "VEC3")}};
    const int order = g.accessor(kSquareIndices, "SCALAR", kUShort), morph = g.floats(std::vector<float>(12), "VEC3");
    const int inverse = g.floats({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, "MAT4");
    const int times = g.floats({0, 1}, "SCALAR"), rotations = g.floats({0, 0, 0, 1, 0, 0, 1, 0}, "VEC4");
    const int moves = g.floats({1, 2, 3}, "VEC3");
    const int sparseIndices = g.view(std::vector<std::uint16_t>{1}), values = g.view(std::vector<float>{7, 8, 9});
    const int sparse = g.accessor({{"componentType", kFloat},
                                   {"count", 4},
                                   {"type", "VEC3"},
                                   {"sparse",
                                    {{"count", 1},
                                     {"indices", {{"bufferView", sparseIndices}, {"componentType", kUShort}}},
                                     {"values", {{"bufferView", values}}}}}});
    const std::string png = flatPng();
    const int imageView = g.view(std::vector<char>(png.begin(), png.end()));
    g.add("meshes",
          {{"primitives",
            {{{"attributes", attributes},
              {"indices", order},
              {"targets", {{{"POSITION", morph}}, {{"POSITION", sparse}}}}}}}});
    g.root["meshes"][0]["primitives"][0]["attributes"]["TANGENT"] = tangents;
    g.add("nodes", {{"mesh", 0}, {"skin", 0}, {"children", {1}}});
    g.add("nodes",
          {{"mesh", 0}, {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", moves}}}}}}}});
    g.add("skins", {{"joints", {1}}, {"inverseBindMatrices", inverse}});
    const std::size_t behind = g.root["accessors"].size(); // one past the end: animations are not checked
    g.root["animations"] = {
        {{"samplers", {{{"input", times}, {"output", rotations}}, {{"input", behind}, {"output", -1}}, 5}}},
        {{"samplers", 3}}};
    g.root["images"] = {{{"bufferView", imageView}, {"mimeType", "image/png"}}};
    g.root["textures"] = {{{"source", 0}},
                          {{"extensions", {{"EXT_texture_webp", {{"source", 0}}}, {"KHR_texture_x", 2}}}}};
    const Dropped done = withoutTangents(g);
    EXPECT_TRUE(done.notes.empty()) << done.notes[0];
    const json &root = done.out.root, &p = root["meshes"][0]["primitives"][0];
    EXPECT_EQ(root["accessors"].size(), behind - 1);
    const std::pair<const json&, int> moved[] = {
        {p["attributes"]["POSITION"], 1},
        {p["attributes"]["NORMAL"], 2},
        {p["indices"], order},
        {p["targets"][0]["POSITION"], morph},
        {p["targets"][1]["POSITION"], sparse},
        {root["skins"][0]["inverseBindMatrices"], inverse},
        {root["animations"][0]["samplers"][0]["input"], times},
        {root["animations"][0]["samplers"][0]["output"], rotations},
        {root["nodes"][1]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"], moves},
        {root["accessors"][1]["bufferView"], 2},
        {root["accessors"][sparse - 1]["sparse"]["indices"]["bufferView"], sparseIndices},
        {root["accessors"][sparse - 1]["sparse"]["values"]["bufferView"], values},
        {root["images"][0]["bufferView"], imageView}};
    for (const auto& [reference, before] : moved)
        EXPECT_EQ(reference, before - 1) << before;
    EXPECT_EQ(root["animations"][0]["samplers"][1]["input"], behind);
    EXPECT_EQ(root["animations"][0]["samplers"][1]["output"], -1);
    EXPECT_EQ(root["animations"][1], g.root["animations"][1]);
    EXPECT_EQ(root["textures"], g.root["textures"]);
    EXPECT_EQ(floatsOf(done.out, moves - 1, 3), (std::vector<float>{1, 2, 3}));
}

TEST(GltfReferences, toImagesFollowInTexturesAndTheirExtensions)
{
    Gltf g = square();
    for (int i = 0; i < 3; ++i)
        g.add("images", {{"uri", "data:image/png;base64," + base64(flatPng())}, {"name", std::to_string(i)}});
    g.root["textures"] = {{{"source", 0}}, {{"source", 2}}, {{"extensions", {{"EXT_texture_webp", {{"source", 1}}}}}}};
    const TemporaryFolder folder;
    auto document = openText(folder, g.text());
    ASSERT_TRUE(document) << document.error().message;
    rootOf(*document)["textures"][0]["source"] = 2u;
    ASSERT_TRUE(writeGltf(*document, folder.path / "out.glb"));
    const ReadBack out = readBack(folder.path / "out.glb");
    ASSERT_EQ(out.root["images"].size(), 2u);
    EXPECT_EQ(out.root["images"][0]["name"], "1");
    EXPECT_EQ(out.root["textures"],
              json({{{"source", 1}}, {{"source", 1}}, {{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}}}));
}

// Known extensions and families hold no references. For any other extension all data are kept, with a note.
TEST(GltfReferences, ofUnknownExtensionsKeepAllData)
{
    const std::pair<const char*, bool> names[] = {{"KHR_lights_punctual", true},
                                                  {"KHR_mesh_quantization", true},
                                                  {"KHR_animation_pointer", true},
                                                  {"MSFT_texture_dds", true},
                                                  {"MSFT_lod", true},
                                                  {"FB_ngon_encoding", true},
                                                  {"KHR_materials_any", true},
                                                  {"KHR_texture_any", true},
                                                  {"EXT_texture_any", true},
                                                  {"KHR_xmp_json_ld", true},
                                                  {"KHR_node_any", true},
                                                  {"EXT_materials_any", true},
                                                  {"MSFT_lods", false},
                                                  {"MSFT_lo", false},
                                                  {"KHR_any", false},
                                                  {"EXT_KHR_materials_x", false}};
    for (const auto& [name, known] : names) {
        Gltf g = square();
        primitive(g)["attributes"]["TANGENT"] = g.floats(kTangents, "VEC4");
        g.root["scenes"][0]["extensions"][name] = json::object();
        // Contents of extras are not extensions.
        g.root["scenes"][0]["extras"] = {{"extensions", {{"ACME_in_extras", 1}}}};
        const Dropped done = withoutTangents(g);
        EXPECT_EQ(done.out.buffer.size(), g.bytes.size() - (known ? 64 : 0)) << name;
        EXPECT_EQ(done.notes.size(), known ? 0u : 1u) << name;
    }
    // In lists and within another extension; listed in order, each once.
    Gltf g = square();
    primitive(g)["attributes"]["TANGENT"] = g.floats(kTangents, "VEC4");
    g.root["scenes"][0]["extensions"]["KHR_xmp"] = {{"list", {{{"extensions", {{"ZZZ_late", 1}}}}}}};
    g.root["nodes"][0]["extensions"] = {{"ZZZ_late", 2}, {"ACME_early", 3}};
    const Dropped done = withoutTangents(g);
    ASSERT_EQ(done.notes.size(), 1u);
    EXPECT_EQ(done.notes[0], "unused data is kept, because unknown extensions may refer to it (ACME_early, ZZZ_late)");
}

TEST(GltfReferences, ofUnknownExtensionsForbidJoiningBuffers)
{
    const TemporaryFolder folder;
    Gltf g = square();
    g.root["extensions"] = {{"ZZZ_b", 1}, {"ACME_a", 2}};
    g.root["buffers"] = {{{"byteLength", g.bytes.size()}, {"uri", "one.bin"}}, {{"byteLength", 4}, {"uri", "two.bin"}}};
    folder.write("one.bin", g.bytes);
    folder.write("two.bin", "four");
    const auto document = openText(folder, g.root.dump());
    ASSERT_TRUE(document) << document.error().message;
    const auto written = writeGltf(*document, folder.path / "out.glb");
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().kind, ErrorKind::input);
    EXPECT_EQ(written.error().message,
              (folder.path / "model.gltf").string()
                  + ": buffers: expected one, since an unknown extension (ACME_a) may refer to them, found 2");
}

} // namespace
} // namespace cotan::test
