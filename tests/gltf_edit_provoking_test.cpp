// Gives every triangle of a glTF model its own provoking vertex: drawing must stay bitwise the same.
#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <tuple>

#include "cotan/gpu_meshes.hpp"
#include "gltf_edit_maker.hpp"

namespace cotan::test {
namespace {

// The bytes of each element of an accessor, including sparse values; zeros if it has no view.
std::vector<std::string> bytesOf(const ReadBack& model, int accessor)
{
    const json& a = model.root["accessors"][accessor];
    static const std::map<std::string, std::size_t> widths = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}};
    static const std::map<int, std::size_t> sizes = {{kByte, 1},   {kUByte, 1}, {kShort, 2},
                                                     {kUShort, 2}, {kUInt, 4},  {kFloat, 4}};
    const std::size_t size = widths.at(a["type"]) * sizes.at(a["componentType"]);
    std::vector<std::string> out(a["count"], std::string(size, '\0'));
    if (a.contains("bufferView"))
        out = elements(model, accessor, size);
    if (!a.contains("sparse"))
        return out;
    const json& sparse = a["sparse"];
    const auto at = [&](const char* part, std::size_t i, std::size_t step) {
        const json& view = model.root["bufferViews"][sparse[part]["bufferView"].get<int>()];
        return model.buffer.substr(view.value("byteOffset", 0u) + sparse[part].value("byteOffset", 0u) + i * step,
                                   step);
    };
    for (std::size_t i = 0; i < sparse["count"]; ++i) {
        const std::string index = at("indices", i, sizes.at(sparse["indices"]["componentType"]));
        std::uint32_t element = 0;
        std::memcpy(&element, index.data(), index.size());
        out.at(element) = at("values", i, size);
    }
    return out;
}

// The corners of a primitive's triangles, from an independent implementation of strips and fans.
std::vector<std::uint32_t> cornersOf(const ReadBack& model, const json& primitive)
{
    std::vector<std::uint32_t> order;
    if (primitive.contains("indices")) {
        for (const std::string& bytes : bytesOf(model, primitive["indices"])) {
            order.push_back(0);
            std::memcpy(&order.back(), bytes.data(), bytes.size());
        }
    } else {
        const std::size_t count = model.root["accessors"][primitive["attributes"]["POSITION"].get<int>()]["count"];
        for (std::uint32_t i = 0; i < count; ++i)
            order.push_back(i);
    }
    const int mode = primitive.value("mode", 4);
    if (mode == 5)
        return trianglesOfStrip(order);
    if (mode == 6)
        return trianglesOfFan(order);
    order.resize(order.size() / 3 * 3);
    return order;
}

// For each triangle: the bytes that its three corners have in an accessor.
using Corners = std::vector<std::array<std::string, 3>>;

Corners heldBy(const ReadBack& model, const json& primitive, int accessor)
{
    const std::vector<std::string> held = bytesOf(model, accessor);
    const std::vector<std::uint32_t> corners = cornersOf(model, primitive);
    Corners out;
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
        out.push_back({held.at(corners[i]), held.at(corners[i + 1]), held.at(corners[i + 2])});
    return out;
}

// Concatenates the attributes of each corner, so that one rotation applies to all of them.
void add(Corners& all, const Corners& more)
{
    all.resize(more.size());
    for (std::size_t f = 0; f < more.size(); ++f)
        for (std::size_t k = 0; k < 3; ++k)
            all[f][k] += more[f][k];
}

Corners everything(const ReadBack& model, const json& primitive)
{
    Corners all;
    for (const auto& item : primitive["attributes"].items())
        add(all, heldBy(model, primitive, item.value()));
    for (const json& target : primitive.value("targets", json::array()))
        for (const auto& item : target.items())
            add(all, heldBy(model, primitive, item.value()));
    return all;
}

void expectSameDrawn(const ReadBack& before, const ReadBack& after, const json& old, const json& made, bool last)
{
    const Corners expected = everything(before, old), found = everything(after, made);
    ASSERT_EQ(found.size(), expected.size());
    const std::vector<std::uint32_t> corners = cornersOf(after, made);
    for (std::size_t f = 0; f < found.size(); ++f) {
        EXPECT_EQ(corners[3 * f + (last ? 2 : 0)], f) << "triangle " << f << " owns its vertex";
        const auto& [a, b, c] = expected[f];
        const bool same = found[f] == expected[f] || found[f] == std::array{b, c, a} || found[f] == std::array{c, a, b};
        EXPECT_TRUE(same) << "triangle " << f;
    }
    EXPECT_EQ(made.value("mode", 4), 4);
}

// Expects exact min and max of positions, as glTF requires.
void expectBounds(const ReadBack& model, const json& primitive)
{
    const int accessor = primitive["attributes"]["POSITION"];
    const json& a = model.root["accessors"][accessor];
    if (!a.contains("min"))
        return;
    const std::vector<float> values = floatsOf(model, accessor, 3);
    for (std::size_t c = 0; c < 3; ++c) {
        float low = values[c], high = values[c];
        for (std::size_t i = c; i < values.size(); i += 3) {
            low = std::min(low, values[i]);
            high = std::max(high, values[i]);
        }
        EXPECT_EQ(a["min"][c].get<float>(), low);
        EXPECT_EQ(a["max"][c].get<float>(), high);
    }
}

struct Provoked {
    std::vector<GltfProvoked> rows;
    ReadBack out;
};

// Writes the document, reads it back and compares it with the original.
Provoked expectProvoked(const Gltf& g, ProvokingVertex provoking = ProvokingVertex::first)
{
    Provoked provoked;
    const TemporaryFolder folder;
    auto document = openText(folder, g.text());
    EXPECT_TRUE(document) << document.error().message;
    if (!document)
        return provoked;
    const auto plain = writeGltf(*document, folder.path / "plain.glb");
    EXPECT_TRUE(plain) << plain.error().message;
    auto rows = setGltfProvoking(*document, provoking);
    EXPECT_TRUE(rows) << rows.error().message;
    const auto written = writeGltf(*document, folder.path / "out.glb");
    EXPECT_TRUE(written) << written.error().message;
    const auto loaded = loadGltf(folder.path / "out.glb");
    EXPECT_TRUE(loaded) << loaded.error().message;
    const ReadBack before = readBack(folder.path / "plain.glb");
    provoked.out = readBack(folder.path / "out.glb");
    provoked.rows = *rows;
    for (const GltfProvoked& row : *rows) {
        const auto primitiveOf = [&](const ReadBack& m) -> const json& {
            return m.root["meshes"][row.mesh]["primitives"][row.primitive];
        };
        const json& made = primitiveOf(provoked.out);
        expectSameDrawn(before, provoked.out, primitiveOf(before), made, provoking == ProvokingVertex::last);
        expectBounds(provoked.out, made);
        EXPECT_EQ(cornersOf(provoked.out, made).size(), 3 * row.triangles);
        EXPECT_EQ(provoked.out.root["accessors"][made["attributes"]["POSITION"].get<int>()]["count"],
                  row.verticesAfter);
    }
    return provoked;
}

json indexed(Gltf& g, const std::vector<std::uint32_t>& order, int type)
{
    if (type == kUByte)
        return g.accessor(std::vector<std::uint8_t>(order.begin(), order.end()), "SCALAR", type);
    if (type == kUShort)
        return g.accessor(std::vector<std::uint16_t>(order.begin(), order.end()), "SCALAR", type);
    return g.accessor(order, "SCALAR", type);
}

TEST(GltfProvoking, aSquareNeedsNoMoreVertices)
{
    for (const auto provoking : {ProvokingVertex::first, ProvokingVertex::last}) {
        const Provoked p = expectProvoked(square(), provoking);
        ASSERT_EQ(p.rows.size(), 1u);
        EXPECT_EQ(p.rows[0].triangles, 2u);
        EXPECT_EQ(p.rows[0].verticesBefore, 4u);
        EXPECT_EQ(p.rows[0].verticesAfter, 4u);
        EXPECT_EQ(p.out.root["accessors"].size(), 4u) << "the old ones are gone";
    }
}

// Vertices at zero, which need no bytes.
Gltf withoutViews()
{
    Gltf g = square();
    for (json& accessor : g.root["accessors"])
        accessor.erase("bufferView");
    g.root.erase("bufferViews");
    g.bytes.clear();
    primitive(g).erase("indices");
    return g;
}

// Adding the first view of a document once invalidated references to its primitives.
TEST(GltfProvoking, aModelWithoutViewsGetsItsFirst)
{
    const TemporaryFolder folder;
    auto document = openText(folder, withoutViews().text());
    ASSERT_TRUE(document) << document.error().message;
    const auto rows = setGltfProvoking(*document, ProvokingVertex::last);
    ASSERT_TRUE(rows) << rows.error().message;
    ASSERT_EQ(rows->size(), 1u);
    EXPECT_EQ(rows->at(0).triangles, 1u);
    ASSERT_TRUE(writeGltf(*document, folder.path / "out.glb"));
    const json out = readBack(folder.path / "out.glb").root;
    EXPECT_EQ(out["accessors"][out["meshes"][0]["primitives"][0]["indices"].get<int>()]["count"], 3);
}

TEST(GltfEdit, aModelWithoutViewsIsWrittenWithoutAny)
{
    const TemporaryFolder folder;
    auto document = openText(folder, withoutViews().text());
    ASSERT_TRUE(document) << document.error().message;
    ASSERT_TRUE(writeGltf(*document, folder.path / "out.glb"));
    EXPECT_FALSE(readBack(folder.path / "out.glb").root.contains("bufferViews"));
}

TEST(GltfProvoking, allIndexTypesStripsAndFansBecomeLists)
{
    const std::vector<std::uint32_t> strip = {0, 1, 3, 2}, fan = {0, 1, 2, 3}, list = {0, 1, 2, 0, 2, 3};
    for (const auto& [mode, order] : {std::pair{4, list}, {5, strip}, {6, fan}})
        for (const int type : {kUByte, kUShort, kUInt})
            for (const auto provoking : {ProvokingVertex::first, ProvokingVertex::last}) {
                SCOPED_TRACE(std::to_string(mode) + ", " + std::to_string(type));
                Gltf g = square();
                primitive(g)["mode"] = mode;
                primitive(g)["indices"] = indexed(g, order, type);
                EXPECT_EQ(expectProvoked(g, provoking).rows.at(0).triangles, 2u);
            }
    for (const auto& [mode, triangles] : {std::pair{4, 1u}, {5, 2u}, {6, 2u}}) { // a list of four is incomplete
        Gltf g = square();
        primitive(g)["mode"] = mode;
        primitive(g).erase("indices");
        EXPECT_EQ(expectProvoked(g).rows.at(0).triangles, triangles) << mode;
    }
}

TEST(GltfProvoking, degenerateTrianglesAreKeptInListsAndRemovedFromStrips)
{
    Gltf g = square();
    primitive(g)["indices"] = indexed(g, {0, 1, 2, 2, 2, 0, 1, 1, 1, 0, 2, 3, 0, 1, 2}, kUShort);
    EXPECT_EQ(expectProvoked(g).rows.at(0).triangles, 5u);
    primitive(g)["indices"] = indexed(g, {0, 1, 3, 3, 1, 1, 2, 3}, kUShort);
    primitive(g)["mode"] = 5;
    EXPECT_EQ(expectProvoked(g).rows.at(0).triangles, 2u);
    primitive(g)["indices"] = indexed(g, {0, 0, 0, 0}, kUShort); // no triangle remains
    EXPECT_TRUE(expectProvoked(g).rows.empty());
}

TEST(GltfProvoking, theRestartValueIsRefusedAndNeverWritten)
{
    for (const auto& [type, restart] : {std::pair{kUByte, 0xffu}, {kUShort, 0xffffu}, {kUInt, 0xffffffffu}}) {
        Gltf g = square();
        primitive(g)["mode"] = 5;
        primitive(g)["indices"] = indexed(g, {0, 1, 2, restart, 0, 2, 3}, type);
        const TemporaryFolder folder;
        const auto document = openText(folder, g.text());
        ASSERT_FALSE(document);
        EXPECT_NE(document.error().message.find("the primitive restart value"), std::string::npos);
    }
    // 255 vertices fit into bytes and 256 do not, because 255 means restart; likewise for shorts. Three vertices
    // provoke three triangles; a fourth needs a copy.
    for (const auto& [vertices, before, again, after] : {std::tuple{255u, kUByte, 2, kUByte},
                                                         {255u, kUByte, 3, kUShort},
                                                         {65535u, kUShort, 2, kUShort},
                                                         {65535u, kUShort, 3, kUInt}}) {
        Gltf g = square();
        primitive(g) = {{"attributes", {{"POSITION", g.floats(std::vector<float>(vertices * 3, 0.5f), "VEC3")}}}};
        std::vector<std::uint32_t> order(vertices);
        std::iota(order.begin(), order.end(), 0u);
        for (int i = 0; i < again; ++i)
            order.insert(order.end(), {0, 1, 2});
        primitive(g)["indices"] = indexed(g, order, before);
        const Provoked p = expectProvoked(g);
        const json& indices = p.out.root["meshes"][0]["primitives"][0]["indices"];
        EXPECT_EQ(p.out.root["accessors"][indices.get<int>()]["componentType"], after) << p.rows.at(0).verticesAfter;
    }
}

// A seam where u is mirrored and both sides share vertices: each triangle has its own U and V.
TEST(GltfProvoking, mirroredSeamsStillShareVertices)
{
    Gltf g = square();
    primitive(g)["attributes"]["POSITION"] =
        g.floats({-1, 1, 0, -1, -1, 0, 0, 1, 0, 0, -1, 0, 1, 1, 0, 1, -1, 0}, "VEC3");
    primitive(g)["attributes"]["NORMAL"] = g.floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    primitive(g)["attributes"]["TEXCOORD_0"] = g.floats({1, 0, 1, 2, 0, 0, 0, 2, 1, 0, 1, 2}, "VEC2");
    primitive(g)["indices"] = indexed(g, {0, 1, 2, 2, 1, 3, 2, 3, 4, 4, 3, 5}, kUByte);
    const Provoked p = expectProvoked(g, ProvokingVertex::last);
    EXPECT_EQ(p.rows.at(0).verticesBefore, 6u);
    EXPECT_EQ(p.rows.at(0).verticesAfter, 6u); // four provoke, two do not
}

// Joints, weights, colours of bytes, an unknown attribute, a sparse morph target, bounds, and an unused vertex.
TEST(GltfProvoking, attributesOfAnyTypeFollowAndBoundsAreRecomputed)
{
    Gltf g = square();
    json& p = primitive(g);
    p["indices"] = indexed(g, {0, 1, 3, 1, 3, 0, 3, 0, 1}, kUShort); // vertex 2 is unused
    p["attributes"]["_PART"] = g.accessor(std::vector<std::uint8_t>{7, 8, 9, 10}, "SCALAR", kUByte);
    p["attributes"]["COLOR_0"] =
        g.accessor(std::vector<std::uint8_t>{1, 2, 3, 0, 4, 5, 6, 0, 7, 8, 9, 0, 1, 1, 1, 0}, "VEC4", kUByte, true);
    p["attributes"]["JOINTS_0"] =
        g.accessor(std::vector<std::uint8_t>{0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0}, "VEC4", kUByte);
    p["attributes"]["WEIGHTS_0"] = g.floats({1, 0, 0, 0, .5f, .5f, 0, 0, 1, 0, 0, 0, .25f, .75f, 0, 0}, "VEC4");
    p["attributes"]["TANGENT"] = g.floats({1, 0, 0, 1, 1, 0, 0, -1, 0, 1, 0, 1, 1, 0, 0, 1}, "VEC4");
    const int sparseIndices = g.view(std::vector<std::uint16_t>{1, 2});
    const int values = g.view(std::vector<float>{0, 0, 5, 0, 0, 6});
    const auto target = [&](int count) {
        return g.accessor({{"componentType", kFloat},
                           {"count", 4},
                           {"type", "VEC3"},
                           {"min", {0, 0, 0}},
                           {"max", {0, 0, 6}},
                           {"sparse",
                            {{"count", count},
                             {"indices", {{"bufferView", sparseIndices}, {"componentType", kUShort}}},
                             {"values", {{"bufferView", values}}}}}});
    };
    p["targets"] = {{{"POSITION", target(2)}}, {{"NORMAL", target(1)}}};
    p["attributes"]["POSITION"] = g.accessor({{"bufferView", g.view(kSquare)},
                                              {"componentType", kFloat},
                                              {"type", "VEC3"},
                                              {"count", 4},
                                              {"min", {0, 0, 0}},
                                              {"max", {1, 1, 0}}});
    const Provoked done = expectProvoked(g);
    EXPECT_EQ(done.rows.at(0).verticesBefore, 3u);
    const json& made = done.out.root["meshes"][0]["primitives"][0];
    const json& morph = done.out.root["accessors"][made["targets"][0]["POSITION"].get<int>()];
    EXPECT_EQ(morph["max"], json({0, 0, 5})) << "6 was at the vertex that is gone";
}

// Bounds of integers are integers, even if they are normalised.
TEST(GltfProvoking, boundsOfQuantisedPositionsAreThoseOfTheStoredIntegers)
{
    Gltf g = square();
    primitive(g)["indices"] = indexed(g, {0, 1, 3}, kUShort); // removes vertex 2
    const int view = g.view(std::vector<std::int16_t>{-5, 0, 0, 0, 100, 0, 0, 0, 32767, 32767, 0, 0, 0, 300, 0, 0});
    g.root["bufferViews"][std::size_t(view)]["byteStride"] = 8;
    primitive(g)["attributes"]["POSITION"] = g.accessor({{"bufferView", view},
                                                         {"componentType", kShort},
                                                         {"normalized", true},
                                                         {"type", "VEC3"},
                                                         {"count", 4},
                                                         {"min", {-5, 0, 0}},
                                                         {"max", {32767, 32767, 0}}});
    g.root["extensionsUsed"] = g.root["extensionsRequired"] = {"KHR_mesh_quantization"};
    const TemporaryFolder folder;
    auto document = openText(folder, g.text());
    ASSERT_TRUE(document) << document.error().message;
    ASSERT_TRUE(setGltfProvoking(*document, ProvokingVertex::first));
    const auto& root = rootOf(*document);
    const auto& made =
        root["accessors"][root["meshes"][0]["primitives"][0]["attributes"]["POSITION"].get<std::size_t>()];
    EXPECT_EQ(made["min"].dump(), "[-5,0,0]");
    EXPECT_EQ(made["max"].dump(), "[100,300,0]");
}

// A target whose only change was at a removed vertex: glTF forbids sparse accessors without values.
TEST(GltfProvoking, sparsePartsWithoutValuesAreRemoved)
{
    Gltf g = square();
    primitive(g)["indices"] = indexed(g, {0, 1, 3}, kUShort);
    const int sparseIndices = g.view(std::vector<std::uint16_t>{2}), values = g.view(std::vector<float>{0, 0, 5});
    primitive(g)["targets"] = {{{"POSITION",
                                 g.accessor({{"componentType", kFloat},
                                             {"count", 4},
                                             {"type", "VEC3"},
                                             {"sparse",
                                              {{"count", 1},
                                               {"indices", {{"bufferView", sparseIndices}, {"componentType", kUShort}}},
                                               {"values", {{"bufferView", values}}}}}})}}};
    const Provoked p = expectProvoked(g);
    EXPECT_EQ(p.out.root.dump().find("sparse"), std::string::npos);
}

// Two primitives with parts of the same arrays, and one that draws the same as the first.
TEST(GltfProvoking, onlyEqualPrimitivesStillShareVertices)
{
    Gltf g = square();
    json& primitives = g.root["meshes"][0]["primitives"];
    const json first = primitives[0];
    primitives.push_back(first);
    primitives[1]["indices"] = indexed(g, {0, 2, 3}, kUShort);
    primitives.push_back(first);
    primitives.push_back(first);
    primitives[3]["mode"] = 1; // lines are left unchanged
    const Provoked p = expectProvoked(g);
    ASSERT_EQ(p.rows.size(), 2u);
    EXPECT_EQ(p.rows[1].verticesAfter, 3u);
    const json& made = p.out.root["meshes"][0]["primitives"];
    EXPECT_EQ(made[2]["attributes"], made[0]["attributes"]);
    EXPECT_EQ(made[2]["indices"], made[0]["indices"]);
    EXPECT_EQ(made[3]["mode"], 1);
    EXPECT_EQ(floatsOf(p.out, made[3]["attributes"]["POSITION"], 3), kSquare);
}

} // namespace
} // namespace cotan::test
