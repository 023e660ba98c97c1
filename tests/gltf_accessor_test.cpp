// Every way to store numbers, read by the loader and by the editor. Expected values come from the formulas of glTF 2.0,
// section 3.6.2, and of its extensions.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <type_traits>

#include <glm/gtc/matrix_transform.hpp>

#include "gltf/json/views.hpp"
#include "gltf_edit_maker.hpp"
#include "scene/texture_sample.hpp"

using namespace cotan;
using namespace cotan::test;

namespace {

// What both readers return for a corner; corners are in order.
struct Corner {
    glm::vec3 position{0}, normal{0};
    glm::vec4 tangent{0};
    glm::vec2 uv{0}; // transformed for the normal map
};

std::vector<Corner> loaded(const Gltf& g)
{
    std::vector<Corner> corners;
    auto scene = g.load();
    EXPECT_TRUE(scene) << scene.error().message;
    if (!scene)
        return corners;
    const Mesh& mesh = scene->meshes.at(0);
    const Texture& map = scene->materials.at(std::size_t(mesh.material)).normalMap;
    for (const std::uint32_t i : mesh.indices) {
        Corner& c = corners.emplace_back();
        c.position = mesh.positions[i];
        c.normal = mesh.normals[i];
        c.tangent = mesh.tangents.empty() ? glm::vec4(0) : mesh.tangents[i];
        const auto& uv = mesh.texcoords[std::size_t(map.texcoord)];
        c.uv = uv.empty() ? glm::vec2(0) : textureUv(map, uv[i]);
    }
    return corners;
}

std::vector<Corner> edited(const Gltf& g)
{
    const TemporaryFolder folder;
    std::vector<Corner> corners;
    auto document = openText(folder, g.text());
    EXPECT_TRUE(document) << document.error().message;
    if (!document)
        return corners;
    const auto geometry = gltfGeometry(*document, 0, 0);
    EXPECT_TRUE(geometry) << geometry.error().message;
    for (const std::uint32_t i : geometry->indices) {
        Corner& c = corners.emplace_back();
        c.position = geometry->positions[i];
        c.normal = geometry->normals.empty() ? glm::vec3(0) : geometry->normals[i];
        c.tangent = geometry->tangents.empty() ? glm::vec4(0) : geometry->tangents[i];
        c.uv = geometry->texcoords.empty() ? glm::vec2(0) : geometry->texcoords[i];
    }
    return corners;
}

// The corners, after checking that both readers agree on them.
std::vector<Corner> both(const Gltf& g)
{
    const auto a = loaded(g), b = edited(g);
    EXPECT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
        EXPECT_EQ(a[i].position, b[i].position) << i;
        EXPECT_EQ(a[i].normal, b[i].normal) << i;
        EXPECT_EQ(a[i].tangent, b[i].tangent) << i;
        EXPECT_LT(glm::length(a[i].uv - b[i].uv), 1e-5f) << i; // of numbers up to 40
    }
    return a;
}

// A view of numbers with this stride and offset; the gaps have a value that would be noticed.
template<class T>
int stridedView(Gltf& g, const std::vector<T>& values, std::size_t components, std::size_t offset, std::size_t stride)
{
    std::vector<std::uint8_t> bytes(offset + values.size() / components * stride, 0x55);
    for (std::size_t i = 0; i < values.size(); ++i)
        std::memcpy(bytes.data() + offset + i / components * stride + i % components * sizeof(T), &values[i],
                    sizeof(T));
    return g.view(bytes);
}

// Texture coordinates of one type, with an offset and a stride, must match the formula.
template<class T> void checkTexcoords(int componentType, bool normalized)
{
    SCOPED_TRACE(testing::Message() << componentType << (normalized ? " normalised" : ""));
    const T maximum = std::numeric_limits<T>::max(), minimum = std::numeric_limits<T>::lowest();
    const std::vector<T> stored = std::is_same_v<T, float>
        ? std::vector<T>{T(0.25f), T(3), T(1), T(2), T(5), T(7), T(11), T(13)}
        : std::vector<T>{T(1), maximum, minimum, T(3), T(0), T(maximum / 2), T(7), T(100)};
    const std::size_t size = 2 * sizeof(T), stride = (size + 4 + 3) / 4 * 4;
    Gltf g = square();
    addNormalMap(g);
    const int view = stridedView(g, stored, 2, 12, stride);
    g.root["bufferViews"][std::size_t(view)]["byteStride"] = stride;
    primitive(g)["attributes"]["TEXCOORD_0"] = g.accessor({{"bufferView", view},
                                                           {"byteOffset", 12},
                                                           {"componentType", componentType},
                                                           {"type", "VEC2"},
                                                           {"count", 4},
                                                           {"normalized", normalized}});
    const auto corners = both(g);
    ASSERT_EQ(corners.size(), 6u);
    const auto expected = [&](T value) {
        const double c = double(value);
        return float(normalized ? std::max(c / double(maximum), -1.0) : c);
    };
    for (std::size_t i = 0; i < 6; ++i) {
        const std::size_t v = kSquareIndices[i];
        EXPECT_FLOAT_EQ(corners[i].uv.x, expected(stored[2 * v])) << v;
        EXPECT_FLOAT_EQ(corners[i].uv.y, expected(stored[2 * v + 1])) << v;
    }
}

TEST(GltfAccessor, everyComponentTypeIsReadWithOffsetAndStride)
{
    for (const bool normalized : {false, true}) {
        checkTexcoords<std::int8_t>(kByte, normalized);
        checkTexcoords<std::uint8_t>(kUByte, normalized);
        checkTexcoords<std::int16_t>(kShort, normalized);
        checkTexcoords<std::uint16_t>(kUShort, normalized);
    }
    checkTexcoords<float>(kFloat, false);
}

template<class Index> void checkSparse(int indexType, bool base)
{
    SCOPED_TRACE(testing::Message() << indexType << (base ? "" : " without view"));
    Gltf g = square();
    // Shorts, three in each element of eight bytes; the replacements are packed, after an offset of 8.
    const int view = stridedView(g, std::vector<std::int16_t>{10, 11, 12, 20, 21, 22, 30, 31, 32, 40, 41, 42}, 3, 0, 8);
    g.root["bufferViews"][std::size_t(view)]["byteStride"] = 8;
    const int indices = g.view(std::vector<Index>{9, 9, 9, 9, 0, 2, 3});
    const int values = g.view(std::vector<std::int16_t>{9, 9, 9, 9, 1, 2, 3, 4, 5, 6, 7, 8, 9});
    json accessor = {
        {"componentType", kShort},
        {"type", "VEC3"},
        {"count", 4},
        {"sparse",
         {{"count", 3},
          {"indices", {{"bufferView", indices}, {"byteOffset", 4 * sizeof(Index)}, {"componentType", indexType}}},
          {"values", {{"bufferView", values}, {"byteOffset", 8}}}}}};
    if (base)
        accessor["bufferView"] = view;
    primitive(g)["attributes"]["POSITION"] = g.accessor(accessor);
    const std::vector<glm::vec3> expected = {
        {1, 2, 3}, base ? glm::vec3(20, 21, 22) : glm::vec3(0), {4, 5, 6}, {7, 8, 9}};
    for (const auto& order :
         {kSquareIndices, std::vector<std::uint16_t>{3, 1, 1}, std::vector<std::uint16_t>{2, 3, 3}}) {
        primitive(g)["indices"] = g.accessor(order, "SCALAR", kUShort);
        const auto corners = both(g);
        ASSERT_EQ(corners.size(), order.size());
        for (std::size_t i = 0; i < order.size(); ++i)
            EXPECT_EQ(corners[i].position, expected[order[i]]) << "corner " << i << " of " << order.size();
    }
}

TEST(GltfAccessor, sparseValuesReplaceThoseOfTheView)
{
    for (const bool base : {true, false}) {
        checkSparse<std::uint8_t>(kUByte, base);
        checkSparse<std::uint16_t>(kUShort, base);
        checkSparse<std::uint32_t>(kUInt, base);
    }
}

// If few vertices of a large accessor are used, another code path reads them.
TEST(GltfAccessor, aFewVerticesOfALargeAccessorKeepTheirValues)
{
    Gltf g = square();
    std::vector<float> positions, normals, uv;
    for (int i = 0; i < 1000; ++i) {
        positions.insert(positions.end(), {float(i), float(i * i % 7), 0});
        normals.insert(normals.end(), {0, 0, i % 2 ? 1.0f : -1.0f});
        uv.insert(uv.end(), {float(i) / 8, float(-i)});
    }
    primitive(g)["attributes"] = {{"POSITION", g.floats(positions, "VEC3")},
                                  {"NORMAL", g.floats(normals, "VEC3")},
                                  {"TEXCOORD_0", g.floats(uv, "VEC2")}};
    for (const int mode : {4, 5}) {
        primitive(g)["mode"] = mode;
        const std::vector<std::uint16_t> order = {998, 3, 512};
        primitive(g)["indices"] = g.accessor(order, "SCALAR", kUShort);
        const auto corners = both(g);
        ASSERT_EQ(corners.size(), 3u);
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_EQ(corners[i].position.x, float(order[i]));
            EXPECT_EQ(corners[i].normal.z, order[i] % 2 ? 1 : -1);
            EXPECT_EQ(corners[i].uv, glm::vec2(float(order[i]) / 8, -float(order[i])));
        }
        COTAN_LOADED(scene, g.load());
        EXPECT_EQ(scene.meshes.at(0).vertexCount(), 3u);
    }
}

// KHR_texture_transform: translation * rotation * scale, in the extension's order; u and v differ in everything.
TEST(GltfAccessor, uvAreScaledThenRotatedThenShifted)
{
    Gltf g = square();
    addNormalMap(g);
    const double theta = 0.4;
    primitive(g)["attributes"]["TEXCOORD_1"] = g.floats({0.1f, 0.7f, 0.9f, 0.3f, 5, -2, 0, 1}, "VEC2");
    g.root["materials"][0]["normalTexture"]["texCoord"] = 0; // the extension's texCoord takes precedence
    g.root["materials"][0]["normalTexture"]["extensions"]["KHR_texture_transform"] = {
        {"offset", {0.25, -0.5}}, {"rotation", theta}, {"scale", {2, 3}}, {"texCoord", 1}};
    // The matrices in the extension's text, by columns.
    const glm::dmat3 translation(1, 0, 0, 0, 1, 0, 0.25, -0.5, 1);
    const glm::dmat3 rotation(std::cos(theta), -std::sin(theta), 0, std::sin(theta), std::cos(theta), 0, 0, 0, 1);
    const glm::dmat3 scale(2, 0, 0, 0, 3, 0, 0, 0, 1);
    const std::vector<glm::dvec2> uv = {{0.1, 0.7}, {0.9, 0.3}, {5, -2}, {0, 1}};
    const auto corners = both(g);
    for (std::size_t i = 0; i < 6; ++i) {
        const glm::dvec3 expected = translation * rotation * scale * glm::dvec3(uv[kSquareIndices[i]], 1);
        EXPECT_NEAR(corners[i].uv.x, expected.x, 1e-5);
        EXPECT_NEAR(corners[i].uv.y, expected.y, 1e-5);
    }
}

TEST(GltfAccessor, stripsAndFansOfBothReadersAgree)
{
    for (const int mode : {5, 6}) {
        Gltf g = square();
        primitive(g)["mode"] = mode;
        primitive(g)["indices"] = g.accessor(std::vector<std::uint16_t>{0, 1, 3, 2, 2, 0, 1}, "SCALAR", kUShort);
        EXPECT_GE(both(g).size(), 6u) << mode;
    }
}

TEST(GltfAccessor, aPrimitiveWithoutPositionHasAnEmptyGeometry)
{
    Gltf g = square();
    primitive(g)["attributes"].erase("POSITION");
    primitive(g)["indices"] = g.accessor(std::vector<std::uint32_t>{4000000000u, 5, 6}, "SCALAR", kUInt);
    const TemporaryFolder folder;
    auto document = openText(folder, g.text());
    ASSERT_TRUE(document) << document.error().message;
    const auto geometry = gltfGeometry(*document, 0, 0);
    ASSERT_TRUE(geometry);
    EXPECT_TRUE(geometry->indices.empty());
    EXPECT_TRUE(geometry->normals.empty());
}

// The loader reads two uv sets and no others; the editor reads the one that the normal map names.
TEST(GltfAccessor, uvSetsBeyondTheSecondAreCheckedBeforeUse)
{
    Gltf g = square();
    addNormalMap(g);
    g.root["materials"][0]["normalTexture"]["texCoord"] = 2;
    primitive(g)["attributes"]["TEXCOORD_2"] = g.floats({0, 1, 2, 3}, "SCALAR");
    const TemporaryFolder folder;
    auto document = openText(folder, g.text());
    ASSERT_TRUE(document) << document.error().message;
    COTAN_REFUSED(gltfGeometry(*document, 0, 0),
                  "meshes[0].primitives[0].TEXCOORD_2: expected accessors[4] of type VEC2, found SCALAR");
}

// ---- materials and nodes ------------------------------------------------------------------------

TEST(GltfSampler, roundTrips)
{
    for (const Wrap u : {Wrap::repeat, Wrap::mirror, Wrap::clamp})
        for (const Wrap v : {Wrap::repeat, Wrap::mirror, Wrap::clamp})
            for (const Filter magnify : {Filter::nearest, Filter::linear})
                for (const Filter minify : {Filter::nearest, Filter::linear})
                    for (const MipFilter mip : {MipFilter::none, MipFilter::nearest, MipFilter::linear}) {
                        const Sampler written{u, v, magnify, minify, mip};
                        const Sampler read = gltf::readSampler(gltf::writeSampler(written));
                        EXPECT_EQ(read.wrapU, u);
                        EXPECT_EQ(read.wrapV, v);
                        EXPECT_EQ(read.magnify, magnify);
                        EXPECT_EQ(read.minify, minify);
                        EXPECT_EQ(read.mip, mip);
                    }
}

TEST(GltfSampler, everyWrapModeAndFilterIsDistinguished)
{
    const std::pair<int, Wrap> wraps[] = {{10497, Wrap::repeat}, {33071, Wrap::clamp}, {33648, Wrap::mirror}};
    const std::tuple<int, Filter, MipFilter> filters[] = {
        {9728, Filter::nearest, MipFilter::none},    {9729, Filter::linear, MipFilter::none},
        {9984, Filter::nearest, MipFilter::nearest}, {9985, Filter::linear, MipFilter::nearest},
        {9986, Filter::nearest, MipFilter::linear},  {9987, Filter::linear, MipFilter::linear}};
    for (const auto& [s, u] : wraps)
        for (const auto& [t, v] : wraps)
            for (const auto& [code, minify, mip] : filters) {
                Gltf g = square();
                addNormalMap(g);
                g.add("samplers", {{"minFilter", code}, {"wrapS", s}, {"wrapT", t}});
                g.root["textures"][0]["sampler"] = 0;
                COTAN_LOADED(scene, g.load());
                const Sampler& sampler = scene.materials.at(0).normalMap.sampler;
                EXPECT_EQ(sampler.wrapU, u);
                EXPECT_EQ(sampler.wrapV, v);
                EXPECT_EQ(sampler.minify, minify) << code;
                EXPECT_EQ(sampler.mip, mip) << code;
                EXPECT_EQ(sampler.magnify, Filter::linear);
            }
}

// Each slot has its own image, uv set and strength, so that mixing them up is noticed.
TEST(GltfSlots, everyMapIsReadIntoItsSlot)
{
    Gltf g = square();
    primitive(g)["attributes"]["TEXCOORD_1"] = g.floats(kSquareUv, "VEC2");
    for (int i = 0; i < 5; ++i) {
        const std::string row = std::string(1, '\0') + std::string(3, char(10 * i + 1));
        const Bytes png = makePng({.width = 1, .height = 1, .rows = row});
        g.add("images",
              {{"uri", "data:image/png;base64," + base64({reinterpret_cast<const char*>(png.data()), png.size()})}});
        g.add("textures", {{"source", i}});
    }
    g.root["materials"][0] = {
        {"pbrMetallicRoughness",
         {{"baseColorTexture", {{"index", 4}, {"texCoord", 1}}}, {"metallicRoughnessTexture", {{"index", 3}}}}},
        {"normalTexture", {{"index", 2}, {"scale", 0.75}, {"texCoord", 1}}},
        {"occlusionTexture", {{"index", 1}, {"strength", 0.25}}},
        {"emissiveTexture", {{"index", 0}, {"texCoord", 1}}}};
    COTAN_LOADED(scene, g.load());
    const Material& m = scene.materials.at(0);
    const auto value = [&](const Texture& t) { return int(scene.images.at(std::size_t(t.image)).bytes8()[0]); };
    EXPECT_EQ(value(m.baseColorMap), 41);
    EXPECT_EQ(value(m.metallicRoughnessMap), 31);
    EXPECT_EQ(value(m.normalMap), 21);
    EXPECT_EQ(value(m.occlusionMap), 11);
    EXPECT_EQ(value(m.emissiveMap), 1);
    EXPECT_EQ(m.baseColorMap.texcoord, 1);
    EXPECT_EQ(m.metallicRoughnessMap.texcoord, 0);
    EXPECT_EQ(m.normalMap.texcoord, 1);
    EXPECT_EQ(m.occlusionMap.texcoord, 0);
    EXPECT_EQ(m.emissiveMap.texcoord, 1);
    EXPECT_FLOAT_EQ(m.normalScale, 0.75f);
    EXPECT_FLOAT_EQ(m.occlusionStrength, 0.25f);
}

// world = parent * (translation * rotation * scale), checked against glm's own functions.
TEST(GltfTransforms, rotatedAndScaledNodesMultiplyFromTheRoot)
{
    Gltf g = square();
    const glm::dvec3 axis = glm::normalize(glm::dvec3(1, 2, 3));
    const auto quaternion = [&](double angle) {
        const glm::dvec3 v = axis * std::sin(angle / 2);
        return json{v.x, v.y, v.z, std::cos(angle / 2)};
    };
    g.root["nodes"][0] = {
        {"mesh", 0}, {"translation", {1, -2, 3}}, {"rotation", quaternion(0.7)}, {"scale", {2, -3, 5}}};
    g.add("nodes",
          {{"children", {0}}, {"translation", {-7, 11, 13}}, {"rotation", quaternion(-1.9)}, {"scale", {0.5, 4, 1.5}}});
    g.root["scenes"][0]["nodes"] = {1};
    COTAN_LOADED(scene, g.load());
    const auto local = [&](glm::dvec3 t, double angle, glm::dvec3 s) {
        return glm::scale(glm::rotate(glm::translate(glm::dmat4(1), t), angle, axis), s);
    };
    const glm::dmat4 world = local({-7, 11, 13}, -1.9, {0.5, 4, 1.5}) * local({1, -2, 3}, 0.7, {2, -3, 5});
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            EXPECT_NEAR(scene.instances.at(0).toWorld[column][row], world[column][row], 1e-5) << column << row;
}

// Instance transforms apply before the node's.
TEST(GltfTransforms, gpuInstancesAreRelativeToTheirNode)
{
    Gltf g = square();
    const float h = std::sqrt(0.5f);
    g.root["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
    g.root["nodes"][0]["scale"] = {1, 10, 1};
    g.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"ROTATION", g.floats({0, 0, h, h}, "VEC4")}, {"TRANSLATION", g.floats({3, 0, 0}, "VEC3")}};
    COTAN_LOADED(scene, g.load());
    const glm::vec3 p(scene.instances.at(0).toWorld * glm::vec4(1, 0, 0, 1)); // rotated to (0, 1), moved, scaled
    EXPECT_LT(glm::length(p - glm::vec3(3, 10, 0)), 1e-5f);
}

TEST(GltfSkin, inverseBindMatricesMayHaveAnOffset)
{
    Gltf g = square();
    std::vector<float> matrices(4, 77.0f); // skipped by the offset
    for (const float shift : {100.0f, 5.0f})
        matrices.insert(matrices.end(), {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, shift, 0, 0, 1});
    const int bind = g.accessor({{"bufferView", g.view(matrices)},
                                 {"byteOffset", 16},
                                 {"componentType", kFloat},
                                 {"type", "MAT4"},
                                 {"count", 2}});
    primitive(g)["attributes"]["JOINTS_0"] =
        g.accessor(std::vector<std::uint16_t>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0}, "VEC4", kUShort);
    primitive(g)["attributes"]["WEIGHTS_0"] = g.accessor(
        std::vector<std::uint8_t>{255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0}, "VEC4", kUByte, true);
    g.add("nodes", {{"translation", {0, 1, 0}}});
    g.add("nodes", {{"translation", {0, 2, 0}}});
    g.add("skins", {{"joints", {1, 2}}, {"inverseBindMatrices", bind}});
    g.root["nodes"][0]["skin"] = 0;
    g.root["scenes"][0]["nodes"] = {0, 1, 2};
    COTAN_LOADED(scene, g.load());
    const Mesh& mesh = scene.meshes.at(0);
    EXPECT_EQ(mesh.positions[0], glm::vec3(5, 2, 0));
    EXPECT_EQ(mesh.positions[3], glm::vec3(100, 2, 0));
}

// Weights that do not add up to one are normalised.
TEST(GltfSkin, weightsAreNormalisedByTheirSum)
{
    Gltf g = square();
    primitive(g)["attributes"]["JOINTS_0"] =
        g.accessor(std::vector<std::uint8_t>{0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, "VEC4", kUByte);
    primitive(g)["attributes"]["WEIGHTS_0"] = g.floats({0.1f, 0.3f, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
    g.add("nodes", {{"translation", {8, 0, 0}}});
    g.add("nodes", {{"translation", {0, 4, 0}}});
    g.add("skins", {{"joints", {1, 2}}});
    g.root["nodes"][0]["skin"] = 0;
    g.root["scenes"][0]["nodes"] = {0, 1, 2};
    COTAN_LOADED(scene, g.load());
    EXPECT_LT(glm::length(scene.meshes.at(0).positions[0] - glm::vec3(2, 3, 0)), 1e-5f);
}

TEST(GltfMorph, eachTargetHasItsOwnWeight)
{
    Gltf g = square();
    const std::vector<float> right = {1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0}, up = {0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0};
    primitive(g)["targets"] = {{{"POSITION", g.floats(right, "VEC3")}}, {{"POSITION", g.floats(up, "VEC3")}}};
    g.root["meshes"][0]["weights"] = {0.5, 0.25};
    COTAN_LOADED(scene, g.load());
    EXPECT_EQ(scene.meshes.at(0).positions[2], glm::vec3(1.5f, 1.25f, 0));
}

// Lengths on a grid of signed bytes differ from one by up to 0.0069 and are not reported.
TEST(GltfNormals, lengthsWithinOneHundredthAreUnit)
{
    for (const auto& [length, warned] :
         {std::pair(1.008f, false), std::pair(0.992f, false), std::pair(1.05f, true), std::pair(0.95f, true)}) {
        Gltf g = square();
        std::vector<float> normals = kSquareNormals;
        normals[2] = length;
        primitive(g)["attributes"]["NORMAL"] = g.floats(normals, "VEC3");
        COTAN_LOADED(scene, g.load());
        EXPECT_EQ(warns(scene, "not of unit length"), warned) << length;
        EXPECT_EQ(scene.meshes.at(0).normals[0], glm::vec3(0, 0, 1));
    }
}

} // namespace
