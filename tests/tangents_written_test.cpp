// Models written by `cotan tangents` are valid, have no unnecessary vertices, and are otherwise unchanged.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cotan/gltf.hpp"
#include "cotan/view.hpp"
#include "gltf/json/lookup.hpp"
#include "run_tool.hpp"
#include "test_data.hpp"

namespace cotan {
namespace {

using namespace test;
using nlohmann::json;

class TangentsWritten : public ::testing::TestWithParam<const char*> {
protected:
    void SetUp() override
    {
        COTAN_NEEDS_DATA(GetParam());
        for (const char* const name : {"out.glb", "out.gltf"}) {
            const ToolRun run = runTool({"tangents", model().string(), "--replace", "-o", name}, folder.path(), 60);
            ASSERT_EQ(run.code, 0) << run.err;
        }
    }
    std::filesystem::path model() const { return dataFile(GetParam()); }

    TemporaryFolder folder;
};

TEST_P(TangentsWritten, passKhronosValidator)
{
    const std::filesystem::path npm = COTAN_NPM;
    if (!std::filesystem::exists(npm / "installed-lock.json"))
        GTEST_SKIP() << "scripts/npm-packages could not install gltf-validator in " << npm;
    const std::string command = "node '" COTAN_SOURCE_DIR "/tests/npm/validate.mjs' '" + (npm / "node_modules").string()
        + "' '" + (folder / "out.glb").string() + "' '" + (folder / "out.gltf").string() + "' > '"
        + (folder / "log").string() + "' 2>&1";
    const int code = std::system(command.c_str());
    const std::string log = readWhole(folder / "log");
    EXPECT_EQ(code, 0) << log;
    EXPECT_NE(log.find("out.glb: 0 errors"), std::string::npos) << log;
    EXPECT_NE(log.find("out.gltf: 0 errors"), std::string::npos) << log;
}

// Position, normal and uv of each corner and the generated tangents survive writing. The number of vertices is that of
// distinct pairs (vertex, tangent) plus that of unused vertices.
TEST_P(TangentsWritten, keepTheGeometryAndAddNoNeedlessVertex)
{
    const auto before = openGltfDocument(model());
    const auto after = openGltfDocument(folder / "out.glb");
    ASSERT_TRUE(before && after);
    const auto& meshes = rootOf(*before)["meshes"];
    // Primitives that share their vertices are counted together.
    std::map<std::string, std::set<std::vector<float>>> pairs;
    std::map<std::string, std::pair<std::size_t, std::size_t>> counts;
    for (std::size_t m = 0; m < meshes.size(); ++m)
        for (std::size_t p = 0; p < meshes[m]["primitives"].size(); ++p) {
            const auto a = gltfGeometry(*before, m, p), b = gltfGeometry(*after, m, p);
            ASSERT_TRUE(a && b);
            ASSERT_EQ(a->indices.size(), b->indices.size());
            auto attributes = meshes[m]["primitives"][p]["attributes"];
            attributes.erase("TANGENT");
            auto& set = pairs[attributes.dump()];
            counts[attributes.dump()] = {a->positions.size(), b->positions.size()};
            for (std::size_t c = 0; c < a->indices.size(); ++c) {
                const std::uint32_t i = a->indices[c], j = b->indices[c];
                ASSERT_EQ(a->positions[i], b->positions[j]);
                ASSERT_EQ(a->normals[i], b->normals[j]);
                if (b->tangents.empty())
                    continue;
                ASSERT_EQ(a->texcoords[i], b->texcoords[j]);
                const glm::vec4 t = b->tangents[j];
                set.insert({float(i), t.x, t.y, t.z, t.w});
            }
        }
    for (const auto& [key, count] : counts) {
        std::set<float> used;
        for (const auto& pair : pairs[key])
            used.insert(pair[0]);
        if (!used.empty()) {
            EXPECT_EQ(count.second, count.first + pairs[key].size() - used.size());
        }
    }
}

// Returns the JSON without geometry and without the locations of bytes.
json unrelated(const nlohmann::ordered_json& root)
{
    json j = root;
    for (const char* const part : {"accessors", "bufferViews", "buffers"})
        j.erase(part);
    for (json& mesh : j["meshes"])
        for (json& p : mesh["primitives"])
            for (const char* const part : {"attributes", "indices"})
                p.erase(part);
    for (const char* const list : {"animations", "skins"})
        if (j.contains(list))
            for (json& item : j[list]) {
                item.erase("inverseBindMatrices");
                item.erase("samplers");
            }
    if (j.contains("images"))
        for (json& image : j["images"])
            for (const char* const part : {"uri", "bufferView", "mimeType"})
                image.erase(part);
    return j;
}

TEST_P(TangentsWritten, keepAllOtherJson)
{
    const auto before = openGltfDocument(model());
    ASSERT_TRUE(before);
    for (const char* const name : {"out.glb", "out.gltf"}) {
        const auto after = openGltfDocument(folder / name);
        ASSERT_TRUE(after);
        EXPECT_EQ(json::diff(unrelated(rootOf(*before)), unrelated(rootOf(*after))), json::array()) << name;
    }
}

// The written tangents equal newly generated ones: writing and loading lose nothing.
TEST_P(TangentsWritten, areEqualToMikktspace)
{
    const ToolRun run = runTool({"tangents", "out.glb", "--json", "-"}, folder.path());
    ASSERT_EQ(run.code, 0) << run.err;
    const json report = json::parse(run.out);
    ASSERT_TRUE(report.contains("whole"));
    EXPECT_EQ(report["whole"]["verdict"], "equal");
    EXPECT_EQ(report["whole"]["directions"]["max_degrees"], 0.0);
}

INSTANTIATE_TEST_SUITE_P(Models, TangentsWritten,
                         ::testing::Values("models/NormalTangentMirrorTest/NormalTangentMirrorTest.glb",
                                           "models/FlightHelmet/FlightHelmet.gltf",
                                           "models/GlamVelvetSofa/GlamVelvetSofa.glb", "models/SketchfabCat/scene.gltf",
                                           "models/SunglassesKhronos/SunglassesKhronos.glb",
                                           "models/VertexColorTest/VertexColorTest.glb",
                                           "models/AnisotropyStrengthTest/AnisotropyStrengthTest.glb"),
                         [](const auto& m) {
                             return std::filesystem::path(m.param).parent_path().filename().string();
                         });

// Engines make tangents when they load a model, before bones move it. The tool's come from the same mesh, by other
// code.
TEST(SkinnedFrames, tangentsMadeAtLoadMoveWithTheBonesLikeThoseOfTheFile)
{
    COTAN_NEEDS_DATA("animated/lumberjack.glb");
    TemporaryFolder folder;
    const std::filesystem::path model = dataFile("animated/lumberjack.glb");
    const ToolRun run = runTool({"tangents", model.string(), "--replace", "-o", "with.glb"}, folder.path(), 60);
    ASSERT_EQ(run.code, 0) << run.err;
    for (const double seconds : {0.0, 0.5}) {
        LoadLimits limits;
        limits.pixels = Pixels::none;
        limits.pose = {"0", seconds};
        const auto stored = loadGltf(folder / "with.glb", limits);
        auto made = loadGltf(model, limits);
        ASSERT_TRUE(stored && made);
        deriveVertexFrames(*made, Frame::mikktspace, TangentOrigin::generated);
        const Mesh &a = stored->meshes.at(0), &b = made->meshes.at(0);
        ASSERT_EQ(a.indices.size(), b.indices.size());
        std::size_t compared = 0;
        for (std::size_t i = 0; i < a.indices.size(); ++i) {
            const glm::vec4 expected = a.tangents[a.indices[i]], found = b.tangents[b.indices[i]];
            compared += glm::length(glm::vec3(expected)) > 0.5f;
            // Rounding of float in the matrices; the normal of the file is not exactly a unit vector.
            ASSERT_LT(glm::length(glm::vec3(expected - found)), 1e-4f) << seconds << " corner " << i;
        }
        EXPECT_GT(compared, 4000u);
    }
}

// Bones of this model are rigid where one of them alone moves a vertex, and rotations keep lengths.
TEST(SkinnedFrames, cotangentsOfRigidPartsKeepTheirLengthsInEveryPose)
{
    COTAN_NEEDS_DATA("animated/lumberjack.glb");
    std::vector<Mesh> poses;
    for (const double seconds : {0.0, 0.5}) {
        LoadLimits limits;
        limits.pixels = Pixels::none;
        limits.pose = {"0", seconds};
        auto scene = loadGltf(dataFile("animated/lumberjack.glb"), limits);
        ASSERT_TRUE(scene);
        deriveVertexFrames(*scene, Frame::smooth, TangentOrigin::generated);
        poses.push_back(scene->meshes.at(0));
    }
    ASSERT_EQ(poses[0].cotangentsU.size(), poses[1].cotangentsU.size());
    std::size_t rigid = 0;
    for (std::size_t i = 0; i < poses[0].vertexCount(); ++i) {
        const auto isRigid = [&](const Mesh& m) {
            return std::ranges::all_of(m.skin, [&](const auto& column) {
                return std::abs(glm::length(column[i]) - glm::length(m.skin[0][i])) < 1e-5f * glm::length(column[i]);
            });
        };
        if (!isRigid(poses[0]) || !isRigid(poses[1]))
            continue;
        const float scale = glm::length(poses[1].skin[0][i]) / glm::length(poses[0].skin[0][i]);
        const float before = glm::length(poses[0].cotangentsU[i]), after = glm::length(poses[1].cotangentsU[i]);
        if (before > 0) {
            ASSERT_NEAR(after * scale / before, 1, 1e-3) << i;
            ++rigid;
        }
    }
    EXPECT_GT(rigid, 300u);
}

} // namespace
} // namespace cotan
