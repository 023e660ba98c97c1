// Every malformed or hostile glTF file of the test data gets the verdict in EXPECTED.tsv.
#include <ctime>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "cotan/model.hpp"
#include "expected_list.hpp"

using namespace cotan::test;
namespace fs = std::filesystem;

namespace {

std::vector<cotan::test::Expected> gltfCases()
{
    std::vector<cotan::test::Expected> cases = cotan::test::expectedFor(".glb");
    for (const auto& row : cotan::test::expectedFor(".gltf"))
        cases.push_back(row);
    return cases;
}

// Expects one line that names the file, as for every message about bad input.
void expectOneLine(const cotan::Error& error, const fs::path& file)
{
    EXPECT_EQ(error.kind, cotan::ErrorKind::input);
    EXPECT_TRUE(error.message.starts_with(file.string() + ": ")) << error.message;
    EXPECT_EQ(error.message.find('\n'), std::string::npos) << error.message;
}

void expectVerdict(const cotan::test::Expected& expected)
{
    SCOPED_TRACE(expected.file.string());
    const std::clock_t start = std::clock();
    const cotan::Result<cotan::Scene> scene = cotan::loadGltf(expected.file);
    EXPECT_LT(double(std::clock() - start) / CLOCKS_PER_SEC, cotan::test::kBadInputSeconds) << "of processor";
    if (!scene) {
        EXPECT_NE(expected.verdict, "accept") << scene.error().message;
        expectOneLine(scene.error(), expected.file);
        return;
    }
    EXPECT_NE(expected.verdict, "reject");
    if (expected.verdict == "warn") {
        EXPECT_FALSE(scene->warnings.empty());
    }
    if (expected.verdict == "accept") {
        EXPECT_TRUE(scene->warnings.empty()) << scene->warnings.front();
    }
}

TEST(GltfBad, everyFileIsAcceptedOrRefusedAsListed)
{
    COTAN_NEEDS_DATA("bad/EXPECTED.tsv");
    ASSERT_FALSE(gltfCases().empty());
    for (const auto& expected : gltfCases())
        expectVerdict(expected);
}

// The message must be about the fault, not about another oddity of the file.
TEST(GltfBad, messagesNameTheProblem)
{
    COTAN_NEEDS_DATA("bad/EXPECTED.tsv");
    const std::vector<std::pair<const char*, const char*>> words = {
        {"assimp/glTF2/RecursiveNodes/RecursiveNodes.gltf", "its own descendant"},
        {"assimp/glTF2/wrongTypes/badArray.gltf", "meshes[0].primitives: expected an array"},
        {"made/accessor_count_huge.glb", "accessors[0]: 4294967295 elements"},
        {"made/image_not_image.glb", "images[0]"},
        {"made/index_out_of_range.glb", "60000"},
        {"made/json_deep.gltf", "nested deeper"},
        {"made/json_number.gltf", "1e999"},
        {"made/nan_position.glb", "accessors[0]: expected finite numbers"},
        {"made/required_extension_unknown.glb", "VENDOR_unknown"},
        {"made/truncated.glb", "1224 bytes, found 1134"},
        {"made/uri_traversal.glb", "leads out of it"},
        {"made/view_past_end.glb", "bufferViews[0]"},
        {"validator/accessor_data/invalid_elements_float.gltf", "expected finite numbers"},
        {"validator/buffer/invalid_uri_data.gltf", "buffers[0].uri"},
        {"validator/glb/chunk_too_big.glb", "GLB"},
        {"validator/glb/empty_file.glb", "empty"},
        {"validator/glb/length_mismatch.glb", "49 bytes, found 48"},
        {"validator/image/png_eos.gltf", "images[0]"},
        {"validator/mesh/accessor_unequal_count.gltf", "with 3 elements, found 4"},
        {"validator/mesh_data/index_buffer_primitive_restart.gltf", "primitive restart"},
        {"validator/node/node_loop_scene.gltf", "nodes[4]: expected one parent"},
        {"validator/root/invalid_collection_type.gltf", "samplers: expected an array"},
    };
    std::size_t tried = 0;
    for (const auto& [file, word] : words) {
        const fs::path place = dataFile(std::string("bad/") + file);
        if (!fs::exists(place))
            continue; // a folder of data has its own list of files; those of Assimp cannot be made
        ++tried;
        const auto scene = cotan::loadGltf(place);
        ASSERT_FALSE(scene) << file;
        EXPECT_NE(scene.error().message.find(word), std::string::npos) << scene.error().message;
    }
    EXPECT_GE(tried, 20u);
}

TEST(GltfBad, warningsNameTheProblem)
{
    COTAN_NEEDS_DATA("bad/EXPECTED.tsv");
    const std::vector<std::pair<const char*, const char*>> words = {
        {"assimp/glTF2/BoxBadNormals-glTF-Binary/BoxBadNormals.glb", "NORMAL: zero length"},
        {"made/no_uvs.glb", "TEXCOORD_0"},
        {"made/node_scale_zero.glb", "singular"},
        {"made/tangent_w_inverted.glb", "TANGENT.w contradicts"},
        {"made/tangent_zero.glb", "TANGENT: zero length (vertices: 4)"},
        {"made/texcoord_missing.glb", "TEXCOORD_3"},
        {"made/uv_nan.glb", "TEXCOORD_0: not a finite number"},
        {"made/uv_one_point.glb", "no area in the texture coordinates"},
        {"made/zero_normals.glb", "NORMAL: zero length"},
        {"validator/mesh/invalid_tangent.gltf", "TANGENT without NORMAL"},
        {"validator/mesh_data/normals_tangents_non_unit_invalid_sign.gltf", "w is not +-1"},
    };
    std::size_t tried = 0;
    for (const auto& [file, word] : words) {
        const fs::path place = dataFile(std::string("bad/") + file);
        if (!fs::exists(place))
            continue;
        ++tried;
        const auto scene = cotan::loadGltf(place);
        ASSERT_TRUE(scene) << scene.error().message;
        std::string all;
        for (const std::string& warning : scene->warnings)
            all += warning + "\n";
        EXPECT_NE(all.find(word), std::string::npos) << file << ":\n" << all;
    }
    EXPECT_GE(tried, 10u);
}

} // namespace
