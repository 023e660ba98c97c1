// `cotan convert` with layers that use the surface's frame: a clear coat's normal map and the direction of anisotropy.
#include <gtest/gtest.h>

#include <cmath>

#include <nlohmann/json.hpp>

#include "cotan/image.hpp"
#include "cotan/model.hpp"
#include "quad_model.hpp"
#include "run_tool.hpp"
#include "test_data.hpp"

namespace cotan {
namespace {

using namespace test;
using nlohmann::json;

json converted(const std::filesystem::path& folder, const std::string& frame, const std::string& out = "out.glb")
{
    const ToolRun run = runTool(
        {"convert", "quad.gltf", "--to-frame", frame, "--unsigned", "exact", "-o", out, "--json", "-", "--quiet"},
        folder, 120);
    EXPECT_EQ(run.code, 0) << run.err;
    return json::parse(run.out, nullptr, false);
}

Scene loaded(const std::filesystem::path& file)
{
    auto scene = loadScene(file);
    EXPECT_TRUE(scene) << (scene ? "" : scene.error().message);
    return scene ? std::move(*scene) : Scene{};
}

Image imageOf(const Scene& scene, const Texture& texture) { return scene.images.at(std::size_t(texture.image)); }

bool hasTangents(const std::filesystem::path& file) { return !loaded(file).meshes.at(0).tangents.empty(); }

TEST(ConvertCoat, itsMapIsConvertedLikeTheBaseMap)
{
    const json moves = {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"scale", {0.5, 0.75}}}}}}};
    for (const char* frame : {"cotangent", "orthonormal", "smooth"})
        for (const json& how : {json{{"index", 0}}, json{{"index", 0}, {"scale", 0.5}}, moves}) {
            TemporaryFolder own, coated;
            Made plain = quad(2);
            plain.root["extensionsUsed"] = {"KHR_texture_transform"};
            plain.root["materials"][0]["normalTexture"] = how;
            write(plain, own.path());
            converted(own.path(), frame);
            Made m = quad(2);
            json coat = how;
            coat["index"] = 1;
            addCoat(m, coat);
            write(m, coated.path());
            const json r = converted(coated.path(), frame);
            ASSERT_EQ(r["maps"].size(), 2u);
            // A surface with the new frame reads its own map like its coat does, whatever the uv of both. Only for
            // `smooth`, a coat with other uv reads as `cotangent`; on a flat patch the two are equal.
            const Scene a = loaded(own / "out.glb"), b = loaded(coated / "out.glb");
            EXPECT_EQ(imageOf(a, a.materials[0].normalMap).data, imageOf(b, b.materials[0].coat.normalMap).data)
                << frame << how;
            EXPECT_TRUE(b.meshes[0].tangents.empty());
            EXPECT_EQ(b.materials[0].coat.normalScale, how.value("scale", 1.0f));
        }
}

// The mean difference of two images over all channels, in 8-bit steps.
double stepsApart(const std::filesystem::path& a, const std::filesystem::path& b)
{
    const auto one = readImage(a), other = readImage(b);
    EXPECT_TRUE(one && other);
    double sum = 0;
    for (std::size_t i = 0; one && other && i < 4 * one->pixelCount(); ++i)
        sum += std::abs(int(one->bytes8()[i]) - int(other->bytes8()[i]));
    return one ? sum / double(4 * one->pixelCount()) : 255;
}

void drawn(const std::filesystem::path& folder, const std::string& model, const std::string& frame,
           const std::string& image)
{
    const ToolRun run =
        runTool({"render",        model,      "-o",           image,      "--frame",    frame,      "--size",
                 "120x60",        "--device", "reference",    "--ground", "off",        "--camera", "fit",
                 "--environment", "none",     "--background", "none",     "--exposure", "1",        "--quiet"},
                folder, 60);
    EXPECT_EQ(run.code, 0) << run.err;
}

// The coat's map is for its own uv, as if they had been transformed beforehand: TANGENT, for the uv of the surface,
// does not count.
TEST(ConvertCoat, theCoatLooksTheSameWithRotatedAndStretchedUv)
{
    for (const auto& [frame, stored] :
         {std::pair("cotangent", true), {"cotangent", false}, {"smooth", true}, {"smooth", false}}) {
        TemporaryFolder folder;
        Made m = quad(2);
        if (!stored) // then generated from the surface's uv
            m.root["meshes"][0]["primitives"][0]["attributes"].erase("TANGENT");
        addCoat(m,
                {{"index", 1},
                 {"extensions",
                  {{"KHR_texture_transform", {{"rotation", 0.6}, {"scale", {1.0, 2.0}}, {"offset", {0.3, 0.1}}}}}}});
        m.root["materials"][0].erase("normalTexture");
        m.root["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {0, 0, 0, 1}; // only the coat is visible
        write(m, folder.path());
        const json r = converted(folder.path(), frame);
        EXPECT_LT(r["maps"][0]["degrees_after_rounding"]["mean"].get<double>(), 2.0) << r;
        drawn(folder.path(), "quad.gltf", "mikktspace", "before.png");
        drawn(folder.path(), "out.glb", frame, "after.png");
        drawn(folder.path(), "quad.gltf", frame, "unconverted.png");
        const double difference = stepsApart(folder / "before.png", folder / "after.png"),
                     unconverted = stepsApart(folder / "before.png", folder / "unconverted.png");
        EXPECT_GT(unconverted, 1.2) << frame;
        EXPECT_LT(difference, 0.25 * unconverted) << frame;
        EXPECT_EQ(hasTangents(folder / "out.glb"), stored) << "glTF requires them without a normalTexture";
    }
}

// A coat's map or anisotropy requires TANGENT or, for readers to derive it from, a normalTexture.
TEST(ConvertCoat, tangentsStayWhereGltfRequiresThem)
{
    for (const bool bumps : {false, true})
        for (const std::string layer : {"", "coat", "coat without a map", "anisotropy"})
            for (const std::vector<std::string>& how :
                 {std::vector<std::string>{"--keep-maps"}, {"--to-frame", "cotangent"}, {"--to-frame", "smooth"}}) {
                TemporaryFolder folder;
                Made m = quad(2);
                m.root["meshes"].push_back(m.root["meshes"][0]); // the same vertices with another material
                m.root["meshes"][1]["primitives"][0]["material"] = 1;
                m.root["materials"].push_back(m.root["materials"][0]);
                m.root["nodes"].push_back({{"mesh", 1}});
                m.root["scenes"][0]["nodes"].push_back(m.root["nodes"].size() - 1);
                if (layer.starts_with("coat"))
                    addCoat(m, {{"index", 1}});
                if (layer == "coat without a map")
                    m.root["materials"][0]["extensions"]["KHR_materials_clearcoat"].erase("clearcoatNormalTexture");
                if (layer == "anisotropy") {
                    m.root["extensionsUsed"] = {"KHR_materials_anisotropy"};
                    m.root["materials"][0]["extensions"]["KHR_materials_anisotropy"] = {{"anisotropyStrength", 0.5}};
                }
                if (!bumps)
                    m.root["materials"][0].erase("normalTexture");
                write(m, folder.path());
                std::vector<std::string> words = {"convert", "quad.gltf", "-o", "out.glb", "--json", "-", "--quiet"};
                words.insert(words.end(), how.begin(), how.end());
                const ToolRun run = runTool(words, folder.path(), 120);
                ASSERT_EQ(run.code, 0) << run.err;
                const bool required = !bumps && (layer == "coat" || layer == "anisotropy");
                const std::string what = layer + (bumps ? ", bumps, " : ", ") + how[0];
                const Scene scene = loaded(folder / "out.glb");
                ASSERT_EQ(scene.meshes.size(), 2u);
                EXPECT_EQ(!scene.meshes[0].tangents.empty(), required) << what;
                EXPECT_TRUE(scene.meshes[1].tangents.empty()) << what;
                EXPECT_EQ(run.out.find("glTF requires TANGENT for KHR_materials_") != std::string::npos, required)
                    << what << run.out;
                if (how[0] != "--keep-maps")
                    continue;
                // lint says the same beforehand.
                const ToolRun lint = runTool({"lint", "quad.gltf"}, folder.path(), 120);
                EXPECT_EQ(lint.out.find("are kept for them") != std::string::npos, required) << what << lint.out;
            }
}

// One image in both slots, with different uv: they need different maps, and the report counts the conflicts.
TEST(ConvertCoat, anImageInBothSlotsIsOneMapWithReportedConflicts)
{
    TemporaryFolder folder;
    Made m = quad(2);
    addCoat(m, {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"rotation", 1.5708}}}}}});
    write(m, folder.path());
    const json r = converted(folder.path(), "cotangent");
    ASSERT_EQ(r["maps"].size(), 1u);
    EXPECT_EQ(r["maps"][0]["surfaces"], 2);
    EXPECT_GT(r["maps"][0]["texels_that_disagree"].get<int>(), 1000);
    EXPECT_NE(r["notes"].dump().find("No single map fits"), std::string::npos) << r["notes"];
    const Scene scene = loaded(folder / "out.glb");
    EXPECT_EQ(scene.materials[0].normalMap.image, scene.materials[0].coat.normalMap.image);
}

TEST(ConvertCoat, anImageThatAnotherSlotReadsIsKept)
{
    TemporaryFolder folder;
    Made m = quad(2);
    addCoat(m, {{"index", 1}});
    m.root["materials"][0]["occlusionTexture"] = {{"index", 1}};
    write(m, folder.path());
    converted(folder.path(), "cotangent");
    const Scene scene = loaded(folder / "out.glb");
    EXPECT_EQ(imageOf(scene, scene.materials[0].occlusionMap).data, makeReliefMap(Relief::waves, 128).data);
    EXPECT_NE(imageOf(scene, scene.materials[0].coat.normalMap).data, makeReliefMap(Relief::waves, 128).data);
}

TEST(ConvertCoat, itsMapIsKeptIfTheStrengthIsZero)
{
    TemporaryFolder folder;
    Made m = quad(2);
    addCoat(m, {{"index", 1}});
    m.root["materials"][0]["extensions"]["KHR_materials_clearcoat"].erase("clearcoatFactor");
    write(m, folder.path());
    const json r = converted(folder.path(), "cotangent");
    EXPECT_FALSE(r["maps"][0]["kept"].get<bool>());
    EXPECT_TRUE(r["maps"][1]["kept"].get<bool>());
    EXPECT_FALSE(hasTangents(folder / "out.glb"));
}

Made stretchedHighlights()
{
    Made m = quad(2);
    m.root["extensionsUsed"] = {"KHR_materials_anisotropy"};
    m.root["materials"][0]["extensions"]["KHR_materials_anisotropy"] = {{"anisotropyStrength", 0.9}};
    return m;
}

TEST(ConvertAnisotropy, tangentsAreDroppedIfTheFrameHasTheirDirection)
{
    for (const char* frame : {"cotangent", "orthonormal", "smooth"})
        for (const double degrees : {0.0, 4.0, 30.0}) {
            TemporaryFolder folder;
            Made m = stretchedHighlights();
            rotateTangents(m, degrees);
            write(m, folder.path());
            const json r = converted(folder.path(), frame);
            const json& turned = r["tangents"]["anisotropy"];
            ASSERT_EQ(turned.size(), 1u) << r;
            EXPECT_NEAR(turned[0]["rotated_degrees"]["mean"].get<double>(), degrees, 1e-4) << frame;
            EXPECT_EQ(turned[0]["tangents_stay"], degrees > 5) << frame;
            EXPECT_EQ(hasTangents(folder / "out.glb"), degrees > 5) << frame;
            EXPECT_EQ(r["notes"].dump().find("would rotate by 30.0 degrees") != std::string::npos, degrees > 5)
                << r["notes"];
        }
}

TEST(ConvertAnisotropy, tangentsAreKeptWithoutUvToDeriveADirectionFrom)
{
    TemporaryFolder folder;
    Made m = stretchedHighlights();
    m.root["meshes"][0]["primitives"][0]["attributes"].erase("TEXCOORD_0");
    write(m, folder.path());
    const json r = converted(folder.path(), "cotangent");
    EXPECT_TRUE(hasTangents(folder / "out.glb"));
    EXPECT_NE(r["notes"].dump().find("no uv to derive it from"), std::string::npos) << r["notes"];
}

// Images of Khronos' model before and after differ by at most one 8-bit step in the mean.
TEST(ConvertAnisotropy, aRealModelLooksTheSameWithoutTangents)
{
    COTAN_NEEDS_DATA("models/AnisotropyStrengthTest/AnisotropyStrengthTest.glb");
    const std::string model = dataFile("models/AnisotropyStrengthTest/AnisotropyStrengthTest.glb").string();
    for (const auto& [frame, bar] : {std::pair("smooth", 0.3), {"cotangent", 1.0}}) {
        TemporaryFolder folder;
        ASSERT_EQ(runTool({"convert", model, "--to-frame", frame, "-o", "out.glb", "--quiet"}, folder.path()).code, 0);
        drawn(folder.path(), model, "mikktspace", "before.png");
        drawn(folder.path(), "out.glb", frame, "after.png");
        const double difference = stepsApart(folder / "before.png", folder / "after.png");
        std::cout << frame << ": " << difference << " steps\n";
        EXPECT_LT(difference, bar) << frame;
    }
}

} // namespace
} // namespace cotan
