// Values allowed in the JSON of a model, at each bound and one beyond, and the whole error message. Bounds are those of
// the glTF 2.0 specification and its extensions, and of src/gltf/schema.hpp.
#include <limits>

#include "gltf_edit_maker.hpp"

namespace cotan::test {
namespace {

// The error message after the file name, for a text or for a model with one member set; empty if it is read.
std::string jsonError(const std::string& text, const LoadLimits& limits = {})
{
    const TemporaryFolder folder;
    const auto scene = loadGltf(folder.write("model.gltf", text), limits);
    if (scene)
        return "";
    EXPECT_EQ(scene.error().kind, ErrorKind::input);
    const std::string before = (folder.path / "model.gltf: ").string();
    EXPECT_EQ(scene.error().message.find(before), 0u) << scene.error().message;
    return scene.error().message.substr(before.size());
}

std::string errorWith(const std::string& pointer, const json& value)
{
    Gltf g = square();
    addNormalMap(g);
    g.root[json::json_pointer(pointer)] = value;
    return jsonError(g.text());
}

TEST(GltfShape, boundsAreInclusive)
{
    const std::string strength = "/materials/0/extensions/KHR_materials_emissive_strength/emissiveStrength";
    const std::tuple<std::string, json, std::string> cases[] = {
        {strength, 1e12, ""},
        {strength, 0, ""},
        {strength, 1.001e12,
         "materials[0].extensions.KHR_materials_emissive_strength.emissiveStrength: expected a number from 0 to 1e+12, "
         "found 1001000000000.0"},
        {strength, -0.5,
         "materials[0].extensions.KHR_materials_emissive_strength.emissiveStrength: expected a number from 0 to 1e+12, "
         "found -0.5"},
        {strength, "1",
         "materials[0].extensions.KHR_materials_emissive_strength.emissiveStrength: expected a number, found \"1\""},
        {"/materials/0/normalTexture/scale", -1e6, ""},
        {"/materials/0/normalTexture/scale", 1e6, ""},
        {"/materials/0/normalTexture/scale", 1000001,
         "materials[0].normalTexture.scale: expected a number from -1e+06 to 1e+06, found 1000001"},
        {"/meshes/0/primitives/0/mode", 6, ""},
        {"/meshes/0/primitives/0/mode", 7, "meshes[0].primitives[0].mode: expected an integer from 0 to 6, found 7"},
        {"/meshes/0/primitives/0/mode", -1, "meshes[0].primitives[0].mode: expected an integer from 0 to 6, found -1"},
        {"/meshes/0/primitives/0/mode", 4.5, "meshes[0].primitives[0].mode: expected an integer, found 4.5"},
        {"/bufferViews/0/byteStride", 12, ""},
        {"/bufferViews/0/byteStride", 14, "bufferViews[0].byteStride: expected a multiple of 4, found 14"},
        {"/bufferViews/0/byteStride", 256, "bufferViews[0].byteStride: expected an integer from 0 to 252, found 256"},
        {"/accessors/3/componentType", 5124,
         "accessors[3].componentType: expected one of 5120, 5121, 5122, 5123, 5125, 5126, found 5124"},
        {"/accessors/3/type", "VEC5",
         "accessors[3].type: expected one of SCALAR, VEC2, VEC3, VEC4, MAT2, MAT3, MAT4, found \"VEC5\""},
        {"/materials/0/alphaMode", "MASK", ""},
        {"/materials/0/alphaMode", "CUT", "materials[0].alphaMode: expected one of OPAQUE, MASK, BLEND, found \"CUT\""},
        {"/materials/0/alphaMode", 1, "materials[0].alphaMode: expected a string, found 1"},
        {"/nodes/0/mesh", 1, "nodes[0].mesh: expected an index below 1, the number of meshes, found 1"},
        {"/nodes/0/mesh", -1, "nodes[0].mesh: expected an index below 1, the number of meshes, found -1"},
        {"/nodes/0/extensions/KHR_lights_punctual/light", 0,
         "nodes[0].extensions.KHR_lights_punctual.light: expected an index below 0, the number of lights, found 0"},
        {"/nodes/0/matrix", json::array({1, 2, 3}), "nodes[0].matrix: expected 16 numbers, found 3"},
        {"/nodes/0/translation", json::array({1, 2, 3}), ""},
        {"/nodes/0/translation", json::array({1, 2, 3, 4}), "nodes[0].translation: expected 3 numbers, found 4"},
        {"/nodes/0/translation", json::array({1, true, 3}), "nodes[0].translation[1]: expected a number, found true"},
        {"/nodes/0/children", json::object(), "nodes[0].children: expected an array, found an object"},
        {"/materials/0/doubleSided", "yes", "materials[0].doubleSided: expected true or false, found \"yes\""},
        {"/materials/0/normalTexture", json::array(), "materials[0].normalTexture: expected an object, found an array"},
        {"/materials/0/normalTexture", json::object(), "materials[0].normalTexture.index: missing"},
        {"/meshes/0/primitives/0/attributes", 3, "meshes[0].primitives[0].attributes: expected an object, found 3"},
        {"/meshes/0/primitives/0/attributes/_A\nB", 9,
         "meshes[0].primitives[0].attributes._A B: expected an index below 4, the number of accessors, found 9"}};
    for (const auto& [pointer, value, message] : cases)
        EXPECT_EQ(errorWith(pointer, value), message) << pointer << " = " << value.dump();
    // An existing light, one past the end, and lists of another type.
    Gltf g = square();
    g.root["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}, {{"type", "directional"}}};
    for (const int light : {1, 2}) {
        g.root["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = light;
        EXPECT_EQ(jsonError(g.text()),
                  light < 2 ? ""
                            : "nodes[0].extensions.KHR_lights_punctual.light: expected an index below 2, the number of "
                              "lights, found 2");
    }
}

// A value of 60 characters is quoted whole; of longer ones, the first 60 characters.
TEST(GltfShape, messagesQuoteTheFirstSixtyCharacters)
{
    for (const std::size_t length : {58, 59}) {
        const std::string text(length, 'x'), quoted = "\"" + text + "\"";
        EXPECT_EQ(errorWith("/nodes/0/mesh", text),
                  "nodes[0].mesh: expected an index below 1, the number of meshes, found "
                      + (length == 58 ? quoted : quoted.substr(0, 60) + "..."));
    }
}

TEST(GltfShape, onlyVersionTwoIsAccepted)
{
    const std::pair<const char*, const char*> cases[] = {
        {R"({"asset":{"version":"2.7","minVersion":"2.0"}})", ""},
        {R"({"asset":{"version":"2"}})", "asset.version: expected 2.x, found \"2\""},
        {R"({"asset":{"version":"20.0"}})", "asset.version: expected 2.x, found \"20.0\""},
        {R"({"asset":{"version":"2.1","minVersion":"2.1"}})", "asset.minVersion: expected 2.0, found \"2.1\""},
        {R"({"asset":{"version":true}})", "asset.version: expected a string, found true"},
        {R"({"asset":{}})", "asset.version: missing"},
        {R"({})", "asset: missing"},
        {R"([1])", "JSON: expected an object, found an array"},
        {R"(7)", "JSON: expected an object, found 7"}};
    for (const auto& [text, message] : cases)
        EXPECT_EQ(jsonError(text), message) << text;
    for (const char* const version : {"\"1\"", "\"1.0\"", "\"0.8\"", "1"})
        EXPECT_EQ(jsonError(R"({"asset":{"version":)" + std::string(version) + "}}")
                      .find("asset.version: glTF version 1 is not supported, expected 2.0;"),
                  0u)
            << version;
    for (const std::string collection : {"meshes", "nodes", "scenes", "accessors", "bufferViews"})
        EXPECT_EQ(jsonError("{\"" + collection + "\":{}}").find(collection + ": glTF version 1 is not supported"), 0u);
    EXPECT_EQ(jsonError(R"({"meshes":[],"images":{}})"), "asset: missing");
}

// Each supported extension may be required and gives no warning. Other extensions may be required if they leave shape
// and normal map alone; one warning names each once.
TEST(GltfShape, extensionsAreReadOrIgnoredOrRefused)
{
    for (const std::string name :
         {"KHR_texture_transform", "KHR_materials_unlit", "KHR_lights_punctual", "KHR_materials_emissive_strength",
          "KHR_mesh_quantization", "EXT_mesh_gpu_instancing", "KHR_draco_mesh_compression", "EXT_meshopt_compression",
          "KHR_meshopt_compression", "KHR_materials_clearcoat", "KHR_materials_anisotropy", "KHR_materials_ior",
          "KHR_materials_specular", "KHR_materials_sheen", "KHR_materials_transmission", "KHR_materials_variants",
          "EXT_texture_webp"}) {
        Gltf g = square();
        g.root["extensionsUsed"] = g.root["extensionsRequired"] = {name};
        COTAN_LOADED(scene, g.load());
        EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
    }
    Gltf g = square();
    g.root["extensionsUsed"] = {"KHR_materials_odd", "ACME_x", "KHR_texture_transform", "ACME_x"};
    g.root["extensionsRequired"] = {"KHR_materials_odd"};
    COTAN_LOADED(scene, g.load());
    EXPECT_EQ(scene.warnings, (std::vector<std::string>{"extensionsUsed: ignored: KHR_materials_odd, ACME_x"}));
    g.root["extensionsRequired"] = {"KHR_materials_odd", "ACME_x"};
    EXPECT_EQ(jsonError(g.text()), "extensionsRequired: \"ACME_x\" is not supported");
    // Unsupported image formats matter only if all pixels are needed.
    g.root["extensionsUsed"] = g.root["extensionsRequired"] = {"EXT_texture_avif"};
    EXPECT_EQ(jsonError(g.text()), "extensionsRequired: \"EXT_texture_avif\" is not supported");
    LoadLimits limits;
    limits.pixels = Pixels::none;
    EXPECT_EQ(jsonError(g.text(), limits), "");
}

// ---- accessors ------------------------------------------------------------------------------

json sparseOf(Gltf& g, const std::vector<std::uint16_t>& indices, std::size_t values)
{
    return {{"count", indices.size()},
            {"indices", {{"bufferView", g.view(indices)}, {"componentType", kUShort}}},
            {"values", {{"bufferView", g.view(std::vector<float>(3 * values, 0.5f))}}}};
}

// An accessor may end exactly where its view ends, but no byte later; messages have all their numbers.
TEST(GltfShape, elementsEndWithinTheirView)
{
    struct Row {
        const char* member;
        int value;
        const char* message;
    };
    for (const Row& row :
         {Row{"byteOffset", 8, ""},
          {"byteOffset", 12, "accessors[0]: 4 elements end at byte 72 of bufferViews[4], which has 68"},
          {"count", 5, "accessors[0]: 5 elements end at byte 84 of bufferViews[4], which has 68"}}) {
        Gltf g = square();
        const int view = g.view(std::vector<float>(17, 0)); // offset 8, rows of 16, the last of 12
        g.root["bufferViews"][std::size_t(view)]["byteStride"] = 16;
        g.root["accessors"][0].update({{"bufferView", view}, {"byteOffset", 8}});
        g.root["accessors"][0][row.member] = row.value;
        EXPECT_EQ(jsonError(g.text()), row.message);
    }
    EXPECT_EQ(errorWith("/bufferViews/0/byteStride", 8),
              "accessors[0]: expected a stride of at least 12 bytes, found 8");
    Gltf g = square();
    const Gltf plain = g;
    const auto with = [&](const std::vector<std::uint16_t>& indices, std::size_t values) {
        g = plain;
        g.root["accessors"][0]["sparse"] = sparseOf(g, indices, values);
        return jsonError(g.text());
    };
    EXPECT_EQ(with({0, 1, 2, 3}, 4), "");
    EXPECT_EQ(with({0, 1, 2, 3, 3}, 5), "accessors[0].sparse.count: expected at most 4, the accessor's count, found 5");
    EXPECT_EQ(with({0, 2}, 1), "accessors[0].sparse.values: 2 elements end at byte 24 of bufferViews[5], which has 12");
    EXPECT_EQ(with({0, 4}, 2), "accessors[0].sparse.indices[1]: expected an index below 4, found 4");
    EXPECT_EQ(with({1, 2, 2}, 3),
              "accessors[0].sparse.indices[2]: expected an index above 2, the previous one, found 2");
    with({0, 1}, 2);
    g.root["accessors"][0]["sparse"]["indices"]["byteOffset"] = 2;
    EXPECT_EQ(jsonError(g.text()),
              "accessors[0].sparse.indices: 2 elements end at byte 6 of bufferViews[4], which has 4");
}

// Every float of every element and every sparse value is checked.
TEST(GltfShape, floatsAreFinite)
{
    for (const std::size_t at : {0, 7, 11})
        for (const bool sparse : {false, true}) {
            Gltf g = square();
            std::vector<float> values(12, 0.5f);
            values[at] = -std::numeric_limits<float>::infinity();
            const int view = g.view(values);
            g.root["accessors"][0]["bufferView"] = sparse ? 0 : view;
            if (sparse) {
                g.root["accessors"][0]["sparse"] = sparseOf(g, {0, 1, 2, 3}, 4);
                g.root["accessors"][0]["sparse"]["values"]["bufferView"] = view;
            }
            EXPECT_EQ(jsonError(g.text()),
                      "accessors[0]: expected finite numbers, found -inf in element " + std::to_string(at / 3));
        }
}

// Accessors have the type and count that their use needs; indices are unsigned integers.
TEST(GltfShape, accessorsHaveTheTypeOfTheirRole)
{
    const std::string field = "meshes[0].primitives[0].";
    const std::tuple<const char*, json, std::string> cases[] = {
        {"/meshes/0/primitives/0/attributes/NORMAL", 2,
         field + "NORMAL: expected accessors[2] of type VEC3, found VEC2"},
        {"/accessors/1/count", 3, field + "NORMAL: expected accessors[1] with 4 elements, found 3"},
        {"/meshes/0/primitives/0/indices", 2, field + "indices: expected accessors[2] of type SCALAR, found VEC2"},
        {"/accessors/3/componentType", 5122,
         field + "indices: expected unsigned integers in accessors[3], found signed shorts"},
        {"/accessors/3/componentType", 5120,
         field + "indices: expected unsigned integers in accessors[3], found signed bytes"}};
    for (const auto& [pointer, value, message] : cases)
        EXPECT_EQ(errorWith(pointer, value), message);
    EXPECT_EQ(errorWith("/accessors/1/componentType", 5125),
              field + "NORMAL: expected floats, bytes or shorts in accessors[1], found unsigned integers");
}

} // namespace
} // namespace cotan::test
