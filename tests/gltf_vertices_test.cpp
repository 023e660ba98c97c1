// Vertices of glTF beyond gltf_mesh_test.cpp: both sides of each tolerance, several sets of joints, morphed normals and
// tangents; the order of nodes; clamping of cameras, lights and factors to their ranges.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "gltf_maker.hpp"

namespace {

using namespace cotan;
using namespace cotan::test;

// ---- tolerances -----------------------------------------------------------------------------

// Normals of unit length up to rounding keep their bits; others get exactly unit length. Triangles without area have no
// normals.
TEST(GltfVertices, unitNormalsKeepTheirBits)
{
    for (const auto& [length, kept] :
         {std::pair(1 + 1e-6f, true), {1 - 1e-6f, true}, {1 + 4e-6f, false}, {1 - 4e-6f, false}}) {
        Gltf g = square();
        primitive(g)["attributes"]["NORMAL"] = g.floats({0, 0, length, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
        COTAN_LOADED(scene, g.load());
        EXPECT_EQ(scene.meshes.at(0).normals[0].z, kept ? length : 1.0f);
        EXPECT_TRUE(scene.warnings.empty());
    }
    Gltf flat = square();
    primitive(flat)["attributes"].erase("NORMAL");
    primitive(flat)["attributes"]["POSITION"] = flat.floats({0, 0, 0, 2, 0, 0, 1, 0, 0, 0, 3, 0}, "VEC3");
    COTAN_LOADED(scene, flat.load()); // 0, 1, 2 are collinear
    EXPECT_EQ(scene.meshes.at(0).normals[2], glm::vec3(0));
    EXPECT_EQ(scene.meshes.at(0).normals[3], glm::vec3(0, 0, 1));
}

TEST(GltfVertices, tangentsWithinOneHundredthAreUnchanged)
{
    Gltf g = square();
    const std::vector<float> stored = {1.009f, 0, 0, 1, 0.991f, 0, 0, 0.995f, 0, 2, 0, 0.5f, 0, 0, 0, -0.25f};
    primitive(g)["attributes"]["TANGENT"] = g.floats(stored, "VEC4");
    COTAN_LOADED(scene, g.load());
    const std::vector<glm::vec4> expected = {{1.009f, 0, 0, 1}, {0.991f, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 0, -1}};
    EXPECT_EQ(scene.meshes.at(0).tangents, expected);
    const std::string at = "meshes[0].primitives[0].TANGENT: ";
    for (const char* line : {"zero length (vertices: 1)", "not of unit length; normalised (vertices: 1)",
                             "w is not +-1; only its sign is used (vertices: 2)"})
        EXPECT_TRUE(warns(scene, at + line)) << line;
}

// Signs contradict the uv if more than half of the triangles that can be judged do, by the sum of their corners.
TEST(GltfVertices, theMajorityOfTrianglesDecidesIfSignsContradictTheUv)
{
    // Three triangles of six vertices; the uv of the third have no area if `flat`.
    const auto warned = [](const std::vector<float>& signs, bool flat) {
        Gltf g = square();
        std::vector<float> positions, normals, uv, tangents;
        for (int t = 0; t < 3; ++t)
            for (int k = 0; k < 3; ++k) {
                const float x = float(k == 1), y = float(k == 2);
                positions.insert(positions.end(), {x + 2 * float(t), y, 0});
                normals.insert(normals.end(), {0, 0, 1});
                uv.insert(uv.end(), {x, flat && t == 2 ? 0 : 1 - y});
                tangents.insert(tangents.end(), {1, 0, 0, signs[std::size_t(3 * t + k)]});
            }
        primitive(g) = {{"attributes",
                         {{"POSITION", g.floats(positions, "VEC3")},
                          {"NORMAL", g.floats(normals, "VEC3")},
                          {"TEXCOORD_0", g.floats(uv, "VEC2")},
                          {"TANGENT", g.floats(tangents, "VEC4")}}}};
        const auto scene = g.load();
        EXPECT_TRUE(scene);
        return scene->warnings.empty() ? "" : scene->warnings[0];
    };
    const auto against = [](int triangles) {
        return "meshes[0].primitives[0]: TANGENT.w inverted: its sign contradicts the texture coordinates (triangles: "
            + std::to_string(triangles) + ")";
    };
    EXPECT_EQ(warned({1, 1, 1, 1, 1, 1, 1, 1, 1}, false), "");
    EXPECT_EQ(warned({-1, -1, -1, 1, 1, 1, 1, 1, 1}, false), "");
    EXPECT_EQ(warned({-1, -1, -1, 1, 1, 1, 1, 1, 1}, true), ""); // one of two
    EXPECT_EQ(warned({-1, -1, -1, -1, -1, -1, 1, 1, 1}, false), against(2));
    EXPECT_EQ(warned({-1, -1, -1, -1, -1, -1, 1, 1, 1}, true), against(2));
    EXPECT_EQ(warned({1, -1, -1, -1, 1, -1, -1, -1, 1}, false), against(3));
    EXPECT_EQ(warned({-1, 1, 1, 1, -1, 1, 1, 1, -1}, false), "");
}

// ---- morph targets and skins ----------------------------------------------------------------

TEST(GltfVertices, targetsMoveNormalsAndTangentsToo)
{
    Gltf g = square();
    const auto all = [](std::vector<float> one) {
        std::vector<float> values;
        for (int i = 0; i < 4; ++i)
            values.insert(values.end(), one.begin(), one.end());
        return values;
    };
    primitive(g)["attributes"]["TANGENT"] = g.floats(all({1, 0, 0, -1}), "VEC4");
    primitive(g)["targets"] = {
        {{"POSITION", g.floats(all({2, 4, 8}), "VEC3")}},
        {{"NORMAL", g.floats(all({0.4f, 0.8f, -2}), "VEC3")}, {"TANGENT", g.floats(all({-2, 0.6f, 1.4f}), "VEC3")}},
        {{"POSITION", g.floats(all({50, 50, 50}), "VEC3")}}};
    g.root["meshes"][0]["weights"] = {0.25, 0.5}; // no weight for the third: 0
    COTAN_LOADED(scene, g.load());
    const Mesh& mesh = scene.meshes.at(0);
    expectNear(mesh.positions[2], {1.5f, 2, 2});
    expectNear(mesh.normals[2], glm::normalize(glm::vec3(0.2f, 0.4f, 0)));
    expectNear(glm::vec3(mesh.tangents[2]), glm::normalize(glm::vec3(0, 0.3f, 0.7f)));
    EXPECT_EQ(mesh.tangents[2].w, -1);
}

// Four joints a set and two sets. Vertices without weight stay, and only mirroring all vertices reverses the winding.
TEST(GltfVertices, followAllSetsOfJoints)
{
    Gltf g = square();
    const std::vector<std::uint8_t> first = {0, 0, 0, 0, 9, 9, 1, 9, 0, 0, 0, 0, 9, 9, 9, 9};
    const std::vector<float> weights = {0.5f, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0.25f, 0, 0, 0, 0};
    const std::vector<std::uint16_t> second = {2, 0, 0, 0, 9, 9, 9, 9, 0, 1, 0, 0, 9, 9, 9, 9};
    const std::vector<float> more = {0.5f, 0, 0, 0, 0, 0, 0, 0, 0, 0.75f, 0, 0, 0, 0, 0, 0};
    json& attributes = primitive(g)["attributes"];
    attributes["JOINTS_0"] = g.accessor(first, "VEC4", kUByte);
    attributes["WEIGHTS_0"] = g.floats(weights, "VEC4");
    attributes["JOINTS_1"] = g.accessor(second, "VEC4", kUShort);
    attributes["WEIGHTS_1"] = g.floats(more, "VEC4");
    attributes["TANGENT"] = g.floats({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, "VEC4");
    g.add("nodes", {{"translation", {8, 0, 0}}});
    g.add("nodes", {{"translation", {0, 4, 0}}, {"scale", {-1, 1, 1}}});
    g.add("nodes", {{"translation", {0, 0, 2}}});
    g.add("skins", {{"joints", {1, 2, 3}}});
    g.root["nodes"][0]["skin"] = 0;
    g.root["scenes"][0]["nodes"] = {0, 1, 2, 3};
    COTAN_LOADED(scene, g.load());
    const Mesh& mesh = scene.meshes.at(0);
    expectNear(mesh.positions[0], {4, 0, 1});  // halfway from (8, 0, 0) to (0, 0, 2)
    expectNear(mesh.positions[1], {-1, 4, 0}); // mirrored
    // A quarter of (1 + 8, 1, 0) and three quarters of (-1, 1 + 4, 0).
    expectNear(mesh.positions[2], {0.25f * 9 - 0.75f, 0.25f * 1 + 0.75f * 5, 0});
    EXPECT_EQ(mesh.positions[3], glm::vec3(0, 1, 0)); // not moved
    EXPECT_EQ(mesh.tangents[0], glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(mesh.tangents[1], glm::vec4(-1, 0, 0, -1));
    EXPECT_EQ(mesh.tangents[2], glm::vec4(-1, 0, 0, -1)); // 0.25 - 0.75 along x
    EXPECT_EQ(mesh.indices, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
    EXPECT_TRUE(warns(scene, "meshes[0].primitives[0]: skinned without weights; not moved (vertices: 1)"));
    Gltf high = g;
    high.root["accessors"][primitive(g)["attributes"]["WEIGHTS_1"].get<std::size_t>()]["bufferView"] =
        high.view(std::vector<float>{0.5f, 0, 0, 0, 0, 0, 0, 0, 0, 0.75f, 0, 0, 0, 0, 1, 0});
    COTAN_REFUSED(high.load(), "meshes[0].primitives[0].JOINTS_1: vertex 3 refers to joint 9, but the skin has 3");
}

// One mesh with two skins becomes two meshes; a skin is ignored for a primitive without joints.
TEST(GltfVertices, aMeshIsMadeOnceForEachSkin)
{
    Gltf g = square();
    json bare = primitive(g);
    primitive(g)["attributes"]["JOINTS_0"] = g.accessor(std::vector<std::uint8_t>(16, 0), "VEC4", kUByte);
    primitive(g)["attributes"]["WEIGHTS_0"] = g.floats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
    g.add("meshes", {{"name", "mixed"}, {"primitives", {primitive(g), bare}}});
    g.root["nodes"] = {{{"mesh", 0}, {"skin", 0}},  {{"mesh", 0}, {"skin", 1}, {"name", "own"}},
                       {{"mesh", 0}, {"skin", 0}},  {{"mesh", 0}, {"translation", {0, 0, 7}}},
                       {{"mesh", 1}, {"skin", 1}},  {{"translation", {3, 0, 0}}},
                       {{"translation", {0, 5, 0}}}};
    g.root["skins"] = {{{"joints", {5}}}, {{"joints", {6}}}};
    g.root["scenes"][0]["nodes"] = {0, 1, 2, 3, 4, 5, 6};
    COTAN_LOADED(scene, g.load());
    ASSERT_EQ(scene.instances.size(), 6u);
    ASSERT_EQ(scene.meshes.size(), 5u);
    const auto of = [&](std::size_t i) { return scene.meshes.at(std::size_t(scene.instances[i].mesh)).positions[0]; };
    EXPECT_EQ(scene.instances[0].mesh, scene.instances[2].mesh);
    EXPECT_EQ(of(0), glm::vec3(3, 0, 0));
    EXPECT_EQ(of(1), glm::vec3(0, 5, 0));
    EXPECT_EQ(of(3), glm::vec3(0, 0, 0));
    EXPECT_EQ(scene.instances[3].toWorld[3], glm::vec4(0, 0, 7, 1));
    EXPECT_EQ(of(4), glm::vec3(0));
    EXPECT_EQ(scene.instances[1].name, "own");
    EXPECT_EQ(scene.instances[0].name, "square"); // its mesh's name
    EXPECT_EQ(scene.instances[5].name, "mixed/1");
    EXPECT_EQ(scene.warnings, std::vector<std::string>{"nodes[4]: its mesh lacks JOINTS_0, so its skin is ignored"});
}

// ---- nodes ----------------------------------------------------------------------------------

// Parents first, then their children in the order of the file's lists.
TEST(GltfVertices, nodesKeepTheOrderOfTheirLists)
{
    Gltf g = square();
    const auto named = [](const char* name, json children) {
        return json{{"mesh", 0}, {"name", name}, {"children", std::move(children)}};
    };
    g.root["nodes"] = {named("a", {3, 1}), named("b", {4}), named("c", json::array()), named("d", json::array()),
                       named("e", json::array())};
    g.root["scenes"][0]["nodes"] = {2, 0, 2};
    COTAN_LOADED(scene, g.load());
    std::string order;
    for (const Instance& instance : scene.instances)
        order += instance.name;
    EXPECT_EQ(order, "cadbe");
}

// Rounding in the last row of a matrix is accepted: deviations of 1e-4 in total.
TEST(GltfVertices, lastRowsOfMatricesMayBeRounded)
{
    for (const int index : {3, 7, 11, 15})
        for (const double error : {0.9e-4, -0.9e-4, 1.1e-4, -1.1e-4}) {
            Gltf g = square();
            std::vector<double> matrix = {2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 4, 0, 5, 6, 7, 1};
            matrix[std::size_t(index)] += error;
            g.root["nodes"][0]["matrix"] = matrix;
            const auto scene = g.load();
            ASSERT_EQ(bool(scene), std::abs(error) < 1e-4) << index;
            if (scene) {
                glm::mat4 exact(1);
                exact[0].x = 2, exact[1].y = 3, exact[2].z = 4;
                exact[3] = {5, 6, 7, 1};
                EXPECT_EQ(scene->instances.at(0).toWorld, exact);
            }
        }
}

// ---- cameras, lights and factors ------------------------------------------------------------

TEST(GltfVertices, camerasThatWouldShowNothingAreClamped)
{
    for (const auto& [yfov, expected] :
         {std::pair(0.5, 0.5f), {0.0, 0.001f}, {-1.0, 0.001f}, {3.0, 3.0f}, {3.1, 3.1f}, {4.0, 3.1f}, {0.002, 0.002f}})
        for (const auto& [ymag, extent] : {std::pair(3.0, 6.0f), {-3.0, 6.0f}, {0.0, 1e-6f}, {1e-6, 2e-6f}}) {
            Gltf g = square();
            g.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", yfov}, {"znear", 0.1}}}});
            g.add("cameras",
                  {{"name", "flat"},
                   {"type", "orthographic"},
                   {"orthographic", {{"xmag", 4}, {"ymag", ymag}, {"znear", 0}, {"zfar", 9}}}});
            g.add("nodes", {{"camera", 1}, {"name", "one"}, {"scale", {2, 5, 3}}, {"translation", {1, 2, 3}}});
            g.add("nodes", {{"camera", 0}, {"name", "two"}});
            g.root["scenes"][0]["nodes"] = {0, 1, 2};
            COTAN_LOADED(scene, g.load());
            ASSERT_EQ(scene.cameras.size(), 2u);
            EXPECT_TRUE(scene.cameras[0].orthographic);
            EXPECT_EQ(scene.cameras[0].verticalExtent, extent);
            EXPECT_EQ(scene.cameras[0].name, "flat");
            EXPECT_EQ(scene.cameras[0].eye, glm::vec3(1, 2, 3));
            expectNear(scene.cameras[0].target, {1, 2, 2});
            expectNear(scene.cameras[0].up, {0, 1, 0});
            EXPECT_FALSE(scene.cameras[1].orthographic);
            EXPECT_EQ(scene.cameras[1].verticalFieldOfView, expected);
            EXPECT_EQ(scene.cameras[1].name, "two");
        }
}

// Defaults and ranges are those of KHR_lights_punctual.
TEST(GltfVertices, lightsHaveDefaultsAndNestedCones)
{
    const float quarter = float(std::numbers::pi / 4), half = float(std::numbers::pi / 2);
    struct Row {
        json light;
        LightKind kind;
        float inner, outer;
    };
    for (const Row& row :
         {Row{{{"type", "point"}}, LightKind::point, 0, quarter},
          {{{"type", "directional"}}, LightKind::directional, 0, quarter},
          {{{"type", "spot"}, {"spot", json::object()}}, LightKind::spot, 0, quarter},
          {{{"type", "spot"}, {"spot", {{"outerConeAngle", 3}}}}, LightKind::spot, 0, half},
          {{{"type", "spot"}, {"spot", {{"outerConeAngle", -1}}}}, LightKind::spot, 0, 0},
          {{{"type", "spot"}, {"spot", {{"innerConeAngle", 1}}}}, LightKind::spot, quarter, quarter},
          {{{"type", "spot"}, {"spot", {{"innerConeAngle", -1}, {"outerConeAngle", 0.5}}}}, LightKind::spot, 0, 0.5f},
          {{{"type", "point"}, {"spot", {{"innerConeAngle", 0.1}}}}, LightKind::point, 0, quarter}}) {
        Gltf g = square();
        g.root["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"intensity", 7}}, row.light};
        g.add("nodes", {{"translation", {1, 2, 3}}, {"extensions", {{"KHR_lights_punctual", {{"light", 1}}}}}});
        g.root["scenes"][0]["nodes"] = {0, 1};
        COTAN_LOADED(scene, g.load());
        ASSERT_EQ(scene.lights.size(), 1u);
        const Light& light = scene.lights[0];
        EXPECT_EQ(light.kind, row.kind);
        EXPECT_EQ(light.color, glm::vec3(1));
        EXPECT_EQ(light.intensity, 1);
        EXPECT_EQ(light.range, 0); // infinite
        EXPECT_EQ(light.innerCone, row.inner) << row.light;
        EXPECT_EQ(light.outerCone, row.outer) << row.light;
        EXPECT_EQ(light.position, glm::vec3(1, 2, 3));
    }
}

TEST(GltfVertices, factorsOfMaterialsAreClamped)
{
    for (const double k : {-1.0, 0.25, 3.0}) {
        const float in = float(std::clamp(k, 0.0, 1.0));
        Gltf g = square();
        addNormalMap(g);
        g.root["materials"][0] = {
            {"pbrMetallicRoughness",
             {{"baseColorFactor", {0.5, k, 0.75, k}}, {"metallicFactor", k}, {"roughnessFactor", k}}},
            {"emissiveFactor", {0.5, 0.75, k}},
            {"occlusionTexture", {{"index", 0}, {"strength", k}}},
            {"alphaMode", "BLEND"},
            {"extensions",
             {{"KHR_materials_clearcoat", {{"clearcoatFactor", k}, {"clearcoatRoughnessFactor", k}}},
              {"KHR_materials_anisotropy", {{"anisotropyStrength", k}, {"anisotropyRotation", 2 * k}}},
              {"KHR_materials_ior", {{"ior", k}}}}}};
        COTAN_LOADED(scene, g.load());
        const Material& m = scene.materials.at(0);
        EXPECT_EQ(m.baseColor, glm::vec4(0.5f, in, 0.75f, in));
        EXPECT_EQ(m.metallic, in);
        EXPECT_EQ(m.roughness, in);
        EXPECT_EQ(m.emissive, glm::vec3(0.5f, 0.75f, in));
        EXPECT_EQ(m.occlusionStrength, in);
        EXPECT_EQ(m.alphaMode, AlphaMode::blend);
        EXPECT_EQ(m.coat.strength, in);
        EXPECT_EQ(m.coat.roughness, in);
        EXPECT_EQ(m.anisotropy.strength, in);
        EXPECT_EQ(m.anisotropy.rotation, float(2 * k)); // any angle
        EXPECT_EQ(m.specular.ior, float(std::max(k, 1.0)));
    }
}

} // namespace
