// Both sides of each limit of a glTF model, and the text and counts of its warnings.
#include <map>

#include "gltf_edit_maker.hpp"

namespace {

using namespace cotan::test;
using cotan::LoadLimits;

std::string refusalOf(const Gltf& g, const LoadLimits& limits)
{
    const auto scene = g.load(limits);
    return scene ? "" : scene.error().message;
}

// Two squares in one mesh that two nodes show, and a third node without a mesh.
Gltf squares()
{
    Gltf g = square();
    g.root["meshes"][0]["primitives"].push_back(primitive(g));
    g.add("nodes", {{"mesh", 0}, {"name", "again"}});
    g.add("nodes", {{"name", "empty"}});
    g.root["scenes"][0]["nodes"] = {0, 1, 2};
    return g;
}

TEST(GltfBounds, limitsAreInclusive)
{
    const Gltf g = squares();
    ASSERT_EQ(refusalOf(g, {}), "");
    struct Row {
        std::size_t LoadLimits::*field;
        std::size_t enough;
        const char* message;
    };
    const std::size_t bytes = g.text().size();
    for (const Row& row :
         {Row{&LoadLimits::vertices, 8, "meshes[0].primitives[1]: the limit is 7 vertices in total, this one adds 4"},
          {&LoadLimits::triangles, 4, "meshes[0].primitives[1]: the limit is 3 triangles in total, this one adds 2"},
          {&LoadLimits::nodes, 4, "the limit is 3 instances in total"}, // two primitives in two nodes
          {&LoadLimits::fileBytes, bytes, "the limit is"}}) {
        LoadLimits limits;
        limits.*row.field = row.enough;
        EXPECT_EQ(refusalOf(g, limits), "");
        limits.*row.field = row.enough - 1;
        EXPECT_NE(refusalOf(g, limits).find(row.message), std::string::npos) << refusalOf(g, limits);
    }
    LoadLimits limits;
    limits.nodes = 2; // fewer than the listed nodes
    EXPECT_NE(refusalOf(g, limits).find("nodes: the limit is 2, found 3"), std::string::npos);
}

// For indices of each width: the last vertex is valid, the number of vertices is not.
TEST(GltfBounds, anIndexIsBelowTheNumberOfVertices)
{
    for (const int type : {kUByte, kUShort, kUInt})
        for (const int index : {3, 4}) {
            Gltf g = square();
            const std::vector<std::uint32_t> order = {0, 1, 2, 0, 2, std::uint32_t(index)};
            primitive(g)["indices"] = type == kUInt ? g.accessor(order, "SCALAR", kUInt)
                : type == kUShort
                ? g.accessor(std::vector<std::uint16_t>(order.begin(), order.end()), "SCALAR", kUShort)
                : g.accessor(std::vector<std::uint8_t>(order.begin(), order.end()), "SCALAR", kUByte);
            const std::string message = refusalOf(g, {});
            if (index < 4) {
                EXPECT_EQ(message, "") << type;
            } else {
                EXPECT_NE(message.find("meshes[0].primitives[0].indices: index 5 is 4, but there are 4 vertices"),
                          std::string::npos)
                    << type << message;
            }
        }
}

// Vertices of zeros, which need no bytes in the file: one accessor per type serves all attributes of that type.
struct Zeros {
    explicit Zeros(std::size_t vertices) : count(vertices)
    {
        g.add("meshes", {{"primitives", {{{"attributes", {{"POSITION", of("VEC3")}}}}}}});
        g.add("nodes", {{"mesh", 0}});
        g.add("scenes", {{"nodes", {0}}});
    }
    int of(const char* type, int componentType = kFloat)
    {
        const auto [accessor, isNew] = made.try_emplace(type + std::to_string(componentType), 0);
        if (isNew)
            accessor->second = g.accessor({{"componentType", componentType}, {"type", type}, {"count", count}});
        return accessor->second;
    }
    void give(const char* name, const char* type, int componentType = kFloat)
    {
        primitive(g)["attributes"][name] = of(type, componentType);
    }

    std::size_t count;
    Gltf g;
    std::map<std::string, int> made;
};

// A model needs the bytes of its arrays: 4 per index, and 12, 16 and 8 per vector of three, four and two. The allowance
// is the limit plus 16 times the size of the file.
TEST(GltfBounds, geometryCountsTheBytesOfItsArrays)
{
    constexpr std::size_t kCount = 6000, kOrder = 4, kPosition = 12, kNormal = 12;
    struct Row {
        const char* what;
        void (*add)(Zeros&);
        std::size_t bytes; // per vertex
    };
    const auto joints = [](Zeros& z) { z.give("JOINTS_0", "VEC4", kUByte), z.give("WEIGHTS_0", "VEC4"); };
    for (const Row& row :
         {Row{"positions and normals", [](Zeros&) {}, 0},
          {"tangents", [](Zeros& z) { z.give("TANGENT", "VEC4"); }, 16},
          {"uv", [](Zeros& z) { z.give("TEXCOORD_0", "VEC2"); }, 8},
          {"the second uv", [](Zeros& z) { z.give("TEXCOORD_0", "VEC2"), z.give("TEXCOORD_1", "VEC2"); }, 16},
          {"a third uv is not read", [](Zeros& z) { z.give("TEXCOORD_2", "VEC2"); }, 0},
          {"colours", [](Zeros& z) { z.give("COLOR_0", "VEC4"); }, 16},
          {"joints and weights", joints, 32},
          {"a strip: three indices a corner, and the corners", [](Zeros& z) { primitive(z.g)["mode"] = 5; }, 12},
          {"a fan", [](Zeros& z) { primitive(z.g)["mode"] = 6; }, 12},
          {"one morph target at a time",
           [](Zeros& z) {
               const json target = {{"POSITION", z.of("VEC3")}, {"NORMAL", z.of("VEC3")}};
               primitive(z.g)["targets"] = {target, target, target};
           },
           24},
          {"a vertex a corner for flat normals, two uv sets and a colour",
           [](Zeros& z) { primitive(z.g)["attributes"].erase("NORMAL"); }, 12 + 12 + 16 + 16 - kNormal}}) {
        Zeros z(kCount);
        z.give("NORMAL", "VEC3");
        row.add(z);
        const std::size_t bytes = kCount * (kOrder + kPosition + kNormal + row.bytes), ofFile = 16 * z.g.text().size();
        ASSERT_GT(bytes, ofFile);
        LoadLimits limits;
        limits.geometryBytes = bytes - ofFile;
        EXPECT_EQ(refusalOf(z.g, limits), "") << row.what;
        --limits.geometryBytes;
        EXPECT_NE(refusalOf(z.g, limits).find("meshes[0].primitives[0]"), std::string::npos) << row.what;
        EXPECT_NE(refusalOf(z.g, limits).find(": the geometry takes "), std::string::npos) << row.what;
    }
}

// The first set of joints is part of its vertices; further sets, morph targets and flat corners count again.
TEST(GltfBounds, eachUseOfVerticesCountsThem)
{
    struct Row {
        const char* what;
        void (*add)(Zeros&);
        std::size_t vertices, last; // in total, and of the last item
    };
    const auto joints = [](Zeros& z) {
        z.give("JOINTS_0", "VEC4", kUByte), z.give("WEIGHTS_0", "VEC4");
        z.give("JOINTS_1", "VEC4", kUByte), z.give("WEIGHTS_1", "VEC4");
    };
    for (const Row& row :
         {Row{"vertices alone", [](Zeros&) {}, 60, 60},
          {"joints", [](Zeros& z) { z.give("JOINTS_0", "VEC4", kUByte), z.give("WEIGHTS_0", "VEC4"); }, 60, 60},
          {"two sets of joints", joints, 120, 60},
          {"three sets of joints",
           [](Zeros& z) {
               for (const char* const set : {"0", "1", "2"}) {
                   z.give(("JOINTS_" + std::string(set)).c_str(), "VEC4", kUByte);
                   z.give(("WEIGHTS_" + std::string(set)).c_str(), "VEC4");
               }
           },
           180, 60},
          {"two targets",
           [](Zeros& z) {
               const json target = {{"POSITION", z.of("VEC3")}};
               primitive(z.g)["targets"] = {target, target};
           },
           180, 60},
          {"flat triangles of a strip",
           [](Zeros& z) { primitive(z.g)["attributes"].erase("NORMAL"), primitive(z.g)["mode"] = 5; }, 60 + 3 * 58,
           3 * 58}}) {
        Zeros z(60);
        z.give("NORMAL", "VEC3");
        row.add(z);
        LoadLimits limits;
        limits.vertices = row.vertices;
        EXPECT_EQ(refusalOf(z.g, limits), "") << row.what;
        --limits.vertices;
        const std::string message = refusalOf(z.g, limits), limit = std::to_string(limits.vertices);
        EXPECT_NE(
            message.find("the limit is " + limit + " vertices in total, this one adds " + std::to_string(row.last)),
            std::string::npos)
            << row.what << ": " << message;
    }
}

// Columns of matrices begin at multiples of four bytes (glTF 2.0, 3.6.2.4).
TEST(GltfBounds, elementsOfEachTypeHaveTheirSize)
{
    const std::tuple<const char*, int, std::size_t> cases[] = {
        {"SCALAR", kUByte, 1}, {"VEC3", kUByte, 3},  {"VEC4", kUShort, 8},  {"MAT2", kUByte, 8},   {"MAT2", kUShort, 8},
        {"MAT2", kFloat, 16},  {"MAT3", kUByte, 12}, {"MAT3", 5120, 12},    {"MAT3", kUShort, 24}, {"MAT3", 5122, 24},
        {"MAT3", kFloat, 36},  {"MAT4", kUByte, 16}, {"MAT4", kUShort, 32}, {"MAT4", kFloat, 64}};
    for (const auto& [type, component, bytes] : cases)
        for (const std::size_t missing : {0, 1}) {
            Gltf g = square();
            const int view = g.view(std::vector<std::uint8_t>(3 * bytes - missing, 0));
            g.accessor({{"bufferView", view}, {"componentType", component}, {"type", type}, {"count", 3}});
            const std::string message = refusalOf(g, {});
            EXPECT_EQ(message == "", missing == 0) << type << component << message;
        }
}

TEST(GltfBounds, imagesAreLimitedSinglyAndInTotal)
{
    Gltf g = square();
    addNormalMap(g);                                                                // 2 x 2 pixels: 16 bytes
    g.add("images", {{"uri", "data:image/png;base64," + base64(flatPng() + " ")}}); // the same with one more byte
    g.add("textures", {{"source", 1}});
    g.root["materials"][0]["emissiveTexture"] = {{"index", 1}};
    struct Row {
        std::size_t LoadLimits::*field;
        std::size_t enough;
    };
    for (const Row& row : {Row{&LoadLimits::allImageBytes, 32}, {&LoadLimits::imageBytes, 16}}) {
        LoadLimits limits;
        limits.*row.field = row.enough;
        EXPECT_EQ(refusalOf(g, limits), "") << row.enough;
        limits.*row.field = row.enough - 1;
        EXPECT_NE(refusalOf(g, limits), "") << row.enough;
        EXPECT_TRUE(g.load(limits).error().memory) << row.enough;
    }
    LoadLimits limits;
    limits.imageSide = 2;
    EXPECT_EQ(refusalOf(g, limits), "");
    limits.imageSide = 1;
    EXPECT_FALSE(g.load(limits).error().memory);
    EXPECT_NE(refusalOf(g, limits).find("images[0]"), std::string::npos);
    limits = {};
    limits.pixels = cotan::Pixels::none; // then no image is decoded
    limits.allImageBytes = 0;
    COTAN_LOADED(scene, g.load(limits));
    EXPECT_TRUE(scene.images.at(0).data.empty());
}

TEST(GltfBounds, theBudgetOfImagesGrowsWithTheirFilesUpToTheLimitOfAll)
{
    LoadLimits limits;
    limits.imageBytesBeyond = 1000;
    limits.allImageBytes = 5000;
    EXPECT_EQ(cotan::imageBudget(limits, 0), 1000u);
    EXPECT_EQ(cotan::imageBudget(limits, 10), 1000u + 1280);
    EXPECT_EQ(cotan::imageBudget(limits, 31), 1000u + 31 * 128);
    EXPECT_EQ(cotan::imageBudget(limits, 32), 5000u);
    EXPECT_EQ(cotan::imageBudget(limits, std::uint64_t(1) << 60), 5000u);
}

TEST(GltfBounds, instancesOfANodeCountAsNodes)
{
    Gltf g = square();
    g.root["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
    const int at = g.floats({0, 0, 0, 1, 2, 3, 4, 5, 6}, "VEC3");
    g.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"TRANSLATION", at}};
    LoadLimits limits;
    limits.nodes = 3;
    COTAN_LOADED(scene, g.load(limits));
    ASSERT_EQ(scene.instances.size(), 3u);
    EXPECT_EQ(glm::vec3(scene.instances[1].toWorld[3]), glm::vec3(1, 2, 3));
    limits.nodes = 2;
    EXPECT_NE(
        refusalOf(g, limits).find("nodes[0].extensions.EXT_mesh_gpu_instancing: the limit is 2 instances, found 3"),
        std::string::npos)
        << refusalOf(g, limits);
}

// One line per kind, with the first occurrence, the number of others, and their total count.
TEST(GltfBounds, warningsOfOneKindAreOneLineThatCountsThem)
{
    Gltf g = square();
    const json flat = {{"mesh", 0}, {"scale", {1, 0, 1}}};
    for (int i = 0; i < 3; ++i)
        g.add("nodes", flat);
    g.root["scenes"][0]["nodes"] = {0, 1, 2, 3};
    COTAN_LOADED(scene, g.load());
    EXPECT_TRUE(warns(scene, "nodes[1] and 2 more: its transform is singular (a scale of zero)"));
    Gltf one = square();
    one.root["nodes"][0]["scale"] = {1, 0, 1};
    COTAN_LOADED(once, one.load());
    EXPECT_TRUE(warns(once, "nodes[0]: its transform is singular (a scale of zero)"));
    EXPECT_FALSE(warns(once, "more:"));
    one.root["nodes"][0]["scale"] = {1e-6, 1e-6, 1e-6}; // small is not singular
    COTAN_LOADED(small, one.load());
    EXPECT_FALSE(warns(small, "singular"));
}

TEST(GltfBounds, skinsWithoutJointsAreIgnoredAndNonRootNodesWarnedOf)
{
    Gltf g = square();
    g.add("nodes", {{"name", "joint"}});
    g.add("skins", {{"joints", {1}}});
    g.root["nodes"][0]["skin"] = 0;
    g.root["nodes"][0]["translation"] = {1, 2, 3};
    COTAN_LOADED(scene, g.load());
    EXPECT_TRUE(warns(scene, "nodes[0]: its mesh lacks JOINTS_0, so its skin is ignored"));
    EXPECT_EQ(glm::vec3(scene.instances.at(0).toWorld[3]), glm::vec3(1, 2, 3)); // the node's transform applies again
    Gltf child = square();
    child.add("nodes", {{"children", {0}}, {"translation", {0, 5, 0}}});
    COTAN_LOADED(listed, child.load()); // the scene lists only the child
    EXPECT_TRUE(warns(listed, "scenes[0]: it lists nodes that are not roots"));
    ASSERT_EQ(listed.instances.size(), 1u);
    EXPECT_EQ(listed.instances[0].toWorld[3].y, 5); // where its parent puts it
    child.root["scenes"][0]["nodes"] = {1};
    COTAN_LOADED(root, child.load());
    EXPECT_FALSE(warns(root, "roots"));
}

TEST(GltfBounds, theDefaultSceneIsShownElseAllRoots)
{
    Gltf g = square();
    g.add("nodes", {{"mesh", 0}, {"name", "second"}});
    g.add("scenes", {{"nodes", {1}}});
    COTAN_LOADED(first, g.load());
    ASSERT_EQ(first.instances.size(), 1u);
    EXPECT_EQ(first.instances[0].name, "square"); // the mesh's name, as the node has none
    g.root["scene"] = 1;
    COTAN_LOADED(second, g.load());
    ASSERT_EQ(second.instances.size(), 1u);
    EXPECT_EQ(second.instances[0].name, "second");
    g.root.erase("scene");
    g.root.erase("scenes");
    COTAN_LOADED(all, g.load());
    EXPECT_EQ(all.instances.size(), 2u);
}

// The extension announces the container; the first bytes must match.
TEST(GltfBounds, aGlbMustBeginWithItsMagic)
{
    const auto named = loadText(square().text(), "model.glb");
    ASSERT_FALSE(named);
    EXPECT_NE(named.error().message.find("GLB header: expected the file to begin with \"glTF\""), std::string::npos)
        << named.error().message;
    EXPECT_TRUE(loadText(square().text(), "model.gltf"));
}

// A camera or a light of a node whose axes have zero length keeps the untransformed directions.
TEST(GltfBounds, camerasOfNodesScaledToZeroLookAlongMinusZ)
{
    Gltf g = square();
    g.add("cameras", {{"type", "perspective"}, {"name", "own"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}});
    g.add("nodes", {{"camera", 0}, {"name", "node"}, {"translation", {0, 0, 9}}, {"scale", {0, 0, 0}}});
    g.root["scenes"][0]["nodes"] = {0, 1};
    COTAN_LOADED(scene, g.load());
    ASSERT_EQ(scene.cameras.size(), 1u);
    EXPECT_EQ(scene.cameras[0].name, "own"); // takes precedence over the node's
    expectNear(scene.cameras[0].target, {0, 0, 8});
    expectNear(scene.cameras[0].up, {0, 1, 0});
}

} // namespace
