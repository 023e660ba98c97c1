// Messages about glTF files, word for word with their numbers: each error once, about something other than the first
// mesh and primitive, and each warning with its count.
#include <cmath>
#include <limits>

#include "gltf_maker.hpp"

namespace {

using namespace cotan::test;
using cotan::LoadLimits;

// The error message after the file name; "" if the model is read.
std::string loadError(const Gltf& g, const LoadLimits& limits = {})
{
    const auto scene = g.load(limits);
    if (scene)
        return "";
    const std::string& message = scene.error().message;
    const std::string name = "model.gltf: ";
    return message.substr(message.find(name) + name.size());
}

// Two meshes, the second of two primitives; cases damage the last. Accessors: positions, normals, uv, indices.
Gltf threeSquares()
{
    Gltf g = square();
    const json p = primitive(g);
    g.add("meshes", {{"primitives", {p, p}}});
    g.add("nodes", {{"mesh", 1}});
    g.root["scenes"][0]["nodes"] = {0, 1};
    return g;
}

json& last(Gltf& g) { return g.root["meshes"][1]["primitives"][1]; }
json& lastOf(Gltf& g, const char* attribute) { return last(g)["attributes"][attribute]; }

struct Damage {
    void (*make)(Gltf&);
    std::string message;
};

constexpr float kInf = std::numeric_limits<float>::infinity();

TEST(GltfMessages, errorsAboutVerticesNameFieldExpectedAndFound)
{
    const std::string at = "meshes[1].primitives[1]";
    const auto shorts = [](Gltf& g, const char* type, int component, std::size_t count) {
        return g.accessor({{"componentType", component}, {"type", type}, {"count", count}});
    };
    ASSERT_EQ(loadError(threeSquares()), "");
    const Damage cases[] = {
        {[](Gltf& g) { lastOf(g, "POSITION") = 2; }, ".POSITION: expected accessors[2] of type VEC3, found VEC2"},
        {[](Gltf& g) { lastOf(g, "NORMAL") = 2; }, ".NORMAL: expected accessors[2] of type VEC3, found VEC2"},
        {[](Gltf& g) { lastOf(g, "TANGENT") = 1; }, ".TANGENT: expected accessors[1] of type VEC4, found VEC3"},
        {[](Gltf& g) { lastOf(g, "COLOR_0") = 2; }, ".COLOR_0: expected accessors[2] of type VEC4, found VEC2"},
        {[](Gltf& g) {
             lastOf(g, "COLOR_0") = g.floats({1, 2, 3}, "VEC3");
         },
         ".COLOR_0: expected accessors[4] with 4 elements, found 1"},
        {[](Gltf& g) { lastOf(g, "TEXCOORD_0") = 0; }, ".TEXCOORD_0: expected accessors[0] of type VEC2, found VEC3"},
        {[](Gltf& g) { lastOf(g, "TEXCOORD_1") = 1; }, ".TEXCOORD_1: expected accessors[1] of type VEC2, found VEC3"},
        {[](Gltf& g) { lastOf(g, "TEXCOORD_0") = g.accessor(std::vector<std::uint32_t>(8, 1), "VEC2", kUInt); },
         ".TEXCOORD_0: expected floats, bytes or shorts in accessors[4], found unsigned integers"},
        {[](Gltf& g) { last(g)["indices"] = 2; }, ".indices: expected accessors[2] of type SCALAR, found VEC2"},
        {[](Gltf& g) {
             last(g)["indices"] = g.floats({0, 1, 2}, "SCALAR");
         },
         ".indices: expected unsigned integers in accessors[4], found floats"},
        {[](Gltf& g) {
             last(g)["indices"] = g.accessor(std::vector<std::int16_t>{0, 1, 2}, "SCALAR", kShort);
         },
         ".indices: expected unsigned integers in accessors[4], found signed shorts"},
        {[](Gltf& g) {
             last(g)["indices"] = g.accessor(std::vector<std::int8_t>{0, 1, 2}, "SCALAR", kByte);
         },
         ".indices: expected unsigned integers in accessors[4], found signed bytes"},
        {[](Gltf& g) {
             last(g)["indices"] = g.accessor(std::vector<std::uint8_t>{0, 1, 255}, "SCALAR", kUByte);
         },
         ".indices: index 2 is 255, the primitive restart value, which glTF forbids"},
        {[](Gltf& g) {
             last(g)["indices"] = g.accessor(std::vector<std::uint16_t>{0, 65535, 1}, "SCALAR", kUShort);
         },
         ".indices: index 1 is 65535, the primitive restart value, which glTF forbids"},
        {[](Gltf& g) {
             last(g)["indices"] = g.accessor(std::vector<std::uint32_t>{4294967295u, 0, 1}, "SCALAR", kUInt);
         },
         ".indices: index 0 is 4294967295, the primitive restart value, which glTF forbids"},
        {[](Gltf& g) {
             last(g)["indices"] = g.accessor(std::vector<std::uint16_t>{0, 255, 1}, "SCALAR", kUShort);
         },
         ".indices: index 1 is 255, but there are 4 vertices"},
        {[](Gltf& g) {
             last(g)["targets"] = {{{"POSITION", 0}}, {{"NORMAL", 2}}};
         },
         ".targets[1].NORMAL: expected accessors[2] of type VEC3, found VEC2"},
        {[](Gltf& g) {
             last(g)["targets"] = {{{"POSITION", 0}}, {{"TANGENT", 2}}};
             lastOf(g, "TANGENT") = g.floats(std::vector<float>(16, 1.0f), "VEC4");
         },
         ".targets[1].TANGENT: expected accessors[2] of type VEC3, found VEC2"},
        {[](Gltf& g) { lastOf(g, "JOINTS_0") = 0; }, ": expected JOINTS_0 and WEIGHTS_0 together"},
        {[](Gltf& g) { lastOf(g, "WEIGHTS_0") = 0; }, ": expected JOINTS_0 and WEIGHTS_0 together"},
        {[](Gltf& g) { lastOf(g, "JOINTS_0") = lastOf(g, "WEIGHTS_0") = 0; },
         ".JOINTS_0: expected accessors[0] of type VEC4, found VEC3"},
    };
    for (const Damage& damage : cases) {
        Gltf g = threeSquares();
        damage.make(g);
        EXPECT_EQ(loadError(g), at + damage.message);
    }
    // Joints of each invalid type, and in sets after the first.
    for (const auto& [component, name] : {std::pair{kFloat, "floats"},
                                          {kUInt, "unsigned integers"},
                                          {kByte, "signed bytes"},
                                          {kShort, "signed shorts"}}) {
        Gltf g = threeSquares();
        lastOf(g, "JOINTS_0") = shorts(g, "VEC4", component, 4);
        lastOf(g, "WEIGHTS_0") = shorts(g, "VEC4", kFloat, 4);
        EXPECT_EQ(loadError(g), at + ".JOINTS_0: expected bytes or shorts in accessors[4], found " + name);
    }
    Gltf g = threeSquares();
    lastOf(g, "JOINTS_0") = shorts(g, "VEC4", kUByte, 4);
    lastOf(g, "WEIGHTS_0") = shorts(g, "VEC4", kFloat, 4);
    EXPECT_EQ(loadError(g), "");
    lastOf(g, "WEIGHTS_1") = 5;
    EXPECT_EQ(loadError(g), at + ": expected JOINTS_1 and WEIGHTS_1 together");
    lastOf(g, "JOINTS_1") = shorts(g, "VEC4", kUShort, 3);
    EXPECT_EQ(loadError(g), at + ".JOINTS_1: expected accessors[6] with 4 elements, found 3");
    lastOf(g, "JOINTS_1") = 4;
    lastOf(g, "WEIGHTS_1") = 2;
    EXPECT_EQ(loadError(g), at + ".WEIGHTS_1: expected accessors[2] of type VEC4, found VEC2");
}

TEST(GltfMessages, errorsAboutNodesSkinsCamerasLightsAndVariants)
{
    const auto instanced = [](Gltf& g, json attributes) {
        g.root["nodes"][1]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = std::move(attributes);
    };
    static const auto instance = instanced;
    const std::string instancing = "nodes[1].extensions.EXT_mesh_gpu_instancing";
    const Damage cases[] = {
        {[](Gltf& g) {
             g.add("nodes", {{"children", {1}}});
             g.add("nodes", {{"children", {1}}});
         },
         "nodes[1]: expected one parent, found nodes[2] and nodes[3]"},
        {[](Gltf& g) {
             g.add("nodes", {{"children", {3}}});
             g.add("nodes", {{"children", {2}}});
         },
         "nodes[2]: it is its own descendant"},
        {[](Gltf& g) { g.root["nodes"][1]["matrix"] = {1, 0, 0, 0.5, 0, 1, 0, 0.25, 0, 0, 1, 0.125, 0, 0, 0, 2}; },
         "nodes[1].matrix: expected the last row 0 0 0 1, found 0.5 0.25 0.125 2"},
        {[](Gltf& g) {
             g.root["nodes"][1]["scale"] = {1, 1e30, 1};
             g.root["nodes"][1]["children"] = {2};
             g.add("nodes", {{"scale", {1, 1e30, 1}}});
         },
         "nodes[2]: its transform is beyond the range of float"},
        {[](Gltf& g) {
             instance(g, {{"SCALE", 2}});
         },
         instancing + ".SCALE: expected accessors[2] of type VEC3, found VEC2"},
        {[](Gltf& g) {
             instance(g, {{"ROTATION", 1}});
         },
         instancing + ".ROTATION: expected accessors[1] of type VEC4, found VEC3"},
        {[](Gltf& g) {
             instance(g, {{"TRANSLATION", 2}});
         },
         instancing + ".TRANSLATION: expected accessors[2] of type VEC3, found VEC2"},
        {[](Gltf& g) {
             const int two = g.floats({1, 1, 1, 2, 2, 2}, "VEC3"),
                       three = g.floats(std::vector<float>(9, 1.0f), "VEC3");
             instance(g, {{"SCALE", three}, {"TRANSLATION", two}});
         },
         instancing + ".TRANSLATION: expected accessors[4] with 3 elements, found 2"},
        {[](Gltf& g) {
             g.root["nodes"][1]["scale"] = {1, 1, 1e30};
             instance(g, {{"SCALE", g.floats({1, 1, 1e30f}, "VEC3")}});
         },
         instancing + ": a transform is beyond the range of float"},
        {[](Gltf& g) {
             g.root["skins"] = {{{"joints", {0}}}, {{"joints", {0, 1}}, {"inverseBindMatrices", 0}}};
         },
         "skins[1].inverseBindMatrices: expected MAT4 of floats in accessors[0], found VEC3 of floats"},
        {[](Gltf& g) {
             const int shorts = g.accessor({{"componentType", kShort}, {"type", "MAT4"}, {"count", 2}});
             g.root["skins"] = {{{"joints", {0}}}, {{"joints", {0, 1}}, {"inverseBindMatrices", shorts}}};
         },
         "skins[1].inverseBindMatrices: expected MAT4 of floats in accessors[4], found MAT4 of signed shorts"},
        {[](Gltf& g) {
             const int one = g.floats(std::vector<float>(16, 1.0f), "MAT4");
             g.root["skins"] = {{{"joints", {0}}}, {{"joints", {0, 1}}, {"inverseBindMatrices", one}}};
         },
         "skins[1].inverseBindMatrices: expected 2 matrices in accessors[4], found 1"},
        {[](Gltf& g) {
             const json good = {{"yfov", 1}, {"znear", 1}};
             g.root["cameras"] = {{{"type", "perspective"}, {"perspective", good}},
                                  {{"type", "orthographic"}, {"perspective", good}}};
         },
         "cameras[1].orthographic: missing, although the type is \"orthographic\""},
        {[](Gltf& g) {
             g.root["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}, {{"type", "spot"}}};
         },
         "extensions.KHR_lights_punctual.lights[1].spot: missing, although the type is \"spot\""},
        {[](Gltf& g) {
             g.root["meshes"][1]["weights"] = {1e30},
             last(g)["targets"] = {{{"POSITION", g.floats(std::vector<float>(12, 1e30f), "VEC3")}}};
         },
         "meshes[1].primitives[1]: a position is beyond the range of float after morphing and skinning"},
        // A mesh without a node is read, too.
        {[](Gltf& g) {
             json p = primitive(g);
             p["indices"] = g.accessor(std::vector<std::uint16_t>{0, 1, 9}, "SCALAR", kUShort);
             g.add("meshes", {{"primitives", {primitive(g), p}}});
         },
         "meshes[2].primitives[1].indices: index 2 is 9, but there are 4 vertices"},
        // Numbers used only as uv may be NaN or infinite; these have another use as well.
        {[](Gltf& g) {
             lastOf(g, "TEXCOORD_1") = lastOf(g, "_OWN") = g.floats({0, 0, 0, kInf, 0, 0, 0, 0}, "VEC2");
         },
         "accessors[4]: expected finite numbers, found inf in element 1"},
    };
    for (const Damage& damage : cases) {
        Gltf g = threeSquares();
        damage.make(g);
        EXPECT_EQ(loadError(g), damage.message);
    }
    Gltf g = threeSquares();
    g.root["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "red"}}, {{"name", 7}}, {{"name", "red"}}};
    last(g)["extensions"]["KHR_materials_variants"]["mappings"] = {{{"variants", {1, 2}}, {"material", 0}},
                                                                   {{"variants", {0}}, {"material", 1}}};
    LoadLimits limits;
    limits.variant = "2";
    EXPECT_EQ(loadError(g, limits), "");
    limits.variant = "red"; // the first of that name
    EXPECT_EQ(loadError(g, limits),
              "meshes[1].primitives[1].extensions.KHR_materials_variants: expected an index below 1, the number of "
              "materials, found 1");
    limits.variant = "3";
    EXPECT_EQ(loadError(g, limits), "expected one of its 3 variants by number or name (red, , red), found \"3\"");
    EXPECT_EQ(loadError(square(), limits), "expected a model with variants for \"3\", found none");
}

TEST(GltfMessages, warningsNameTheFieldAndCount)
{
    const std::string at = "meshes[1].primitives[1]";
    const auto uv = [](Gltf& g, const std::vector<float>& values) {
        lastOf(g, "TEXCOORD_0") = g.floats(values, "VEC2");
    };
    static const auto setUv = uv;
    const Damage cases[] = {
        {[](Gltf& g) { last(g)["attributes"].erase("POSITION"); }, at + ": no POSITION, nothing to draw"},
        {[](Gltf& g) { last(g)["attributes"].erase("NORMAL"); }, at + ": no NORMAL; flat normals are generated"},
        {[](Gltf& g) { last(g)["mode"] = 0; }, at + ": points and lines are not drawn"},
        {[](Gltf& g) { last(g)["mode"] = 3; }, at + ": points and lines are not drawn"},
        {[](Gltf& g) {
             last(g)["indices"] = g.accessor(std::vector<std::uint8_t>{0, 1, 2, 0, 2}, "SCALAR", kUByte);
         },
         at + ": the number of corners is not a multiple of 3; the incomplete triangle is ignored"},
        {[](Gltf& g) { lastOf(g, "TEXCOORD_2") = 2; }, at + ": TEXCOORD_2 is ignored: only two uv sets are supported"},
        {[](Gltf& g) {
             setUv(g, {0, 1, 1, kInf, 1, 0, NAN, NAN});
         },
         at + ".TEXCOORD_0: not a finite number; replaced by 0 (vertices: 2)"},
        {[](Gltf& g) {
             lastOf(g, "NORMAL") = g.floats({0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
         },
         at + ".NORMAL: zero length, so the direction is unknown (vertices: 1)"},
        {[](Gltf& g) {
             lastOf(g, "NORMAL") = g.floats({0, 0, 1, 0, 0, 2, 0, 0, 1.02f, 0, 0, 0.98f}, "VEC3");
         },
         at + ".NORMAL: not of unit length; normalised (vertices: 3)"},
        {[](Gltf& g) {
             lastOf(g, "TANGENT") = g.floats({0, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 1}, "VEC4");
         },
         at + ".TANGENT: zero length (vertices: 2)"},
        {[](Gltf& g) {
             lastOf(g, "TANGENT") = g.floats({1, 0, 0, 1, 3, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, "VEC4");
         },
         at + ".TANGENT: not of unit length; normalised (vertices: 1)"},
        {[](Gltf& g) {
             lastOf(g, "TANGENT") = g.floats({1, 0, 0, 0, 1, 0, 0, 2, 1, 0, 0, .98f, 1, 0, 0, 1}, "VEC4");
         },
         at + ".TANGENT: w is not +-1; only its sign is used (vertices: 3)"},
        {[](Gltf& g) {
             lastOf(g, "TANGENT") = g.floats({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, "VEC4"),
                       last(g)["attributes"].erase("NORMAL");
         },
         at + ": TANGENT without NORMAL, ignored|" + at + ": no NORMAL; flat normals are generated"},
        {[](Gltf& g) {
             g.root["materials"] = {json::object(), {{"normalTexture", {{"index", 0}}}}};
             g.add("images", {{"uri", "data:image/png;base64," + base64(flatPng())}});
             g.add("textures", {{"source", 0}});
             last(g)["material"] = 1;
             setUv(g, {0, 1, 1, 1, 0.5, 1, 0, 0}); // the first triangle has no uv area
         },
         at + ": no area in the texture coordinates of the normal map: undefined frame (triangles: 1)"},
        {[](Gltf& g) {
             g.root["materials"] = {json::object(), {{"normalTexture", {{"index", 1}}}}};
             g.root["textures"] = {json::object(), json::object()};
             last(g)["material"] = 1;
         },
         "textures[1]: no PNG or JPEG image; the texture is ignored"},
        {[](Gltf& g) {
             g.root["materials"] = {json::object(), {{"emissiveTexture", {{"index", 0}, {"texCoord", 2}}}}};
             g.add("images", {{"uri", "data:image/png;base64," + base64(flatPng())}});
             g.add("textures", {{"source", 0}});
             last(g)["material"] = 1;
         },
         "materials[1].emissiveTexture: requires TEXCOORD_2, which a mesh with this material lacks; it is ignored "
         "there"},
        {[](Gltf& g) {
             g.root["materials"] = {json::object(), {{"extras", {{"cotanFrame", "sideways"}}}}};
             last(g)["material"] = 1;
         },
         "materials[1].extras.cotanFrame: expected the name of a frame, found 'sideways'; ignored"},
        {[](Gltf& g) {
             g.root["nodes"][1]["rotation"] = {0, 0, 0, 1.02};
         },
         "nodes[1].rotation: not a unit quaternion; normalised"},
        {[](Gltf& g) {
             g.root["nodes"][1]["rotation"] = {0, 0, 0, 0.98};
         },
         "nodes[1].rotation: not a unit quaternion; normalised"},
        {[](Gltf& g) {
             g.root["nodes"][1]["rotation"] = {0, 0, 0, 1.008};
         },
         ""},
        {[](Gltf& g) {
             g.root["nodes"][1]["rotation"] = {0, 0, 0, 0.992};
         },
         ""},
        {[](Gltf& g) { // ignored next to a matrix
             g.root["nodes"][1]["rotation"] = {0, 0, 0, 5};
             g.root["nodes"][1]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
         },
         ""},
        // Two nearly parallel axes, relative to their lengths: 1e-8 is not singular, 1e-10 is.
        {[](Gltf& g) { g.root["nodes"][1]["matrix"] = {1, 0, 0, 0, 1, 1e-8, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}; }, ""},
        {[](Gltf& g) { g.root["nodes"][1]["matrix"] = {1, 0, 0, 0, 1, 1e-10, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}; },
         "nodes[1]: its transform is singular (a scale of zero)"},
        {[](Gltf& g) { g.root["scenes"][0]["nodes"] = json::array(); }, "scene: nothing to draw: no triangles"},
        // A mesh without a node is checked once, and the meshes of nodes are not checked again.
        {[](Gltf& g) {
             json p = primitive(g);
             p["attributes"]["NORMAL"] = g.floats({0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
             lastOf(g, "TEXCOORD_2") = 2;
             g.add("meshes", {{"primitives", {primitive(g), p}}});
         },
         at
             + ": TEXCOORD_2 is ignored: only two uv sets are supported|meshes[2].primitives[1].NORMAL: zero length, "
               "so the direction is unknown (vertices: 1)"},
    };
    for (const Damage& damage : cases) {
        Gltf g = threeSquares();
        damage.make(g);
        const auto scene = g.load();
        ASSERT_TRUE(scene) << scene.error().message;
        std::string lines;
        for (const std::string& line : scene->warnings)
            lines += (lines.empty() ? "" : "|") + line;
        EXPECT_EQ(lines, damage.message);
    }
}

} // namespace
