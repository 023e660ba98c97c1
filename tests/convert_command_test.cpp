// `cotan convert` as a user runs it: what the files contain afterwards, and what --verify measures.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <map>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <sys/inotify.h>
#include <unistd.h>

#include "cotan/gltf.hpp"
#include "cotan/image.hpp"
#include "cotan/model.hpp"
#include "gltf/json/lookup.hpp"
#include "ktx2_maker.hpp"
#include "quad_model.hpp"
#include "run_tool.hpp"
#include "test_data.hpp"
#include "webp_maker.hpp"

namespace cotan {
namespace {

using namespace test;
using nlohmann::json;

json jsonOfGlb(const std::filesystem::path& file)
{
    const std::string bytes = readWhole(file);
    std::uint32_t length = 0;
    if (bytes.size() < 20)
        return {};
    std::memcpy(&length, bytes.data() + 12, 4);
    return json::parse(bytes.substr(20, length), nullptr, false);
}

json convertJson(const std::filesystem::path& folder, std::vector<std::string> words, int code = 0)
{
    words.insert(words.begin(), "convert");
    words.insert(words.end(), {"--json", "-", "--quiet"});
    const ToolRun run = runTool(words, folder, 120);
    EXPECT_EQ(run.code, code) << run.err;
    return json::parse(run.out, nullptr, false);
}

Image normalMapOf(const std::filesystem::path& file)
{
    auto scene = loadScene(file);
    if (!scene) {
        ADD_FAILURE() << scene.error().message;
        return {};
    }
    return scene->images.at(std::size_t(scene->materials.at(0).normalMap.image));
}

TEST(ConvertCommand, aStretchedQuadLooksTheSameAfterwards)
{
    TemporaryFolder folder;
    write(quad(2), folder.path());
    const json r = convertJson(
        folder.path(), {"quad.gltf", "--to", "cotangent", "-o", "out.glb", "--verify", "v", "--device", "reference"});
    // 8 bits cost 0.17 degrees mean. Filtering between texels differs between the two frames, which adds a little.
    EXPECT_LT(r["verify"]["degrees"]["mean_degrees"].get<double>(), 0.25);
    EXPECT_LT(r["verify"]["degrees"]["max_degrees"].get<double>(), 1.5);
    EXPECT_GT(r["verify"]["degrees"]["pixels"].get<std::size_t>(), 100000u);
    for (int k = 0; k < 5; ++k)
        for (const char* name : {"before", "after", "difference"})
            EXPECT_TRUE(std::filesystem::exists(folder / fmt::format("v/{}-{}.png", name, k)));
    // The control: read with cotangent but not converted, the error is large.
    const ToolRun lint = runTool({"lint", "quad.gltf", "--json", "-", "--quiet"}, folder.path());
    EXPECT_GT(json::parse(lint.out)["primitives"][0]["read_with"]["cotangent"]["mean"].get<double>(), 3);
}

TEST(ConvertCommand, onlyTangentsAreRemoved)
{
    TemporaryFolder folder;
    write(quad(2), folder.path());
    const json r = convertJson(folder.path(), {"quad.gltf", "--to", "smooth", "-o", "out.glb"});
    EXPECT_EQ(r["tangents"]["bytes_per_vertex"], 16);
    EXPECT_EQ(r["tangents"]["bytes"], 16 * 6);
    EXPECT_EQ(r["tangents"]["vertices"], 6);
    EXPECT_EQ(r["bytes_after"].get<std::size_t>(), std::filesystem::file_size(folder / "out.glb"));
    EXPECT_GT(r["bytes_before"].get<std::size_t>(), 0u);
    const json out = jsonOfGlb(folder / "out.glb");
    EXPECT_FALSE(out["meshes"][0]["primitives"][0]["attributes"].contains("TANGENT"));
    EXPECT_EQ(out["asset"]["extras"]["keep"], "me");
    EXPECT_EQ(out["materials"][0]["extras"]["mine"], 7);
    EXPECT_EQ(out["materials"][0]["name"], "relief");
    convertJson(folder.path(), {"quad.gltf", "--to", "smooth", "-o", "kept.glb", "--keep-tangents"});
    EXPECT_TRUE(jsonOfGlb(folder / "kept.glb")["meshes"][0]["primitives"][0]["attributes"].contains("TANGENT"));
}

TEST(ConvertCommand, towardsMikktspaceWritesTangents)
{
    TemporaryFolder folder;
    write(quad(2), folder.path());
    convertJson(folder.path(), {"quad.gltf", "--to", "cotangent", "--bits", "16", "-o", "there.glb"});
    convertJson(folder.path(),
                {"there.glb", "--from", "cotangent", "--to", "mikktspace", "--bits", "8", "-o", "back.glb"});
    EXPECT_TRUE(jsonOfGlb(folder / "back.glb")["meshes"][0]["primitives"][0]["attributes"].contains("TANGENT"));
    EXPECT_EQ(normalMapOf(folder / "there.glb").type, PixelType::unorm16);
    const Image before = normalMapOf(folder / "quad.gltf"), after = normalMapOf(folder / "back.glb");
    ASSERT_EQ(before.data.size(), after.data.size());
    int largest = 0;
    for (std::size_t i = 0; i < before.data.size(); ++i)
        largest = std::max(largest, std::abs(int(before.bytes8()[i]) - int(after.bytes8()[i])));
    EXPECT_LE(largest, 1); // to 16 bits and back: the old texels were not quite unit length
}

TEST(ConvertCommand, aTextureTransformEqualsTransformedUv)
{
    TemporaryFolder one, other;
    write(quad(2, 0.5f), one.path());
    Made transformed = quad(2);
    transformed.root["extensionsUsed"] = {"KHR_texture_transform"};
    transformed.root["materials"][0]["normalTexture"]["extensions"]["KHR_texture_transform"]["scale"] = {0.5, 0.5};
    write(transformed, other.path());
    convertJson(one.path(), {"quad.gltf", "--to", "cotangent", "-o", "out.glb"});
    convertJson(other.path(), {"quad.gltf", "--to", "cotangent", "-o", "out.glb"});
    EXPECT_EQ(normalMapOf(one / "out.glb").data, normalMapOf(other / "out.glb").data);
    EXPECT_EQ(
        jsonOfGlb(other
                  / "out.glb")["materials"][0]["normalTexture"]["extensions"]["KHR_texture_transform"]["scale"][0],
        0.5);
}

TEST(ConvertCommand, anImageThatAnotherSlotReadsIsKept)
{
    TemporaryFolder folder;
    Made m = quad(2);
    m.root["materials"][0]["occlusionTexture"] = {{"index", 0}};
    write(m, folder.path());
    convertJson(folder.path(), {"quad.gltf", "--to", "cotangent", "-o", "out.glb"});
    const auto scene = loadScene(folder / "out.glb");
    ASSERT_TRUE(scene);
    const Material& material = scene->materials[0];
    ASSERT_NE(material.normalMap.image, material.occlusionMap.image);
    EXPECT_EQ(scene->images[std::size_t(material.occlusionMap.image)].data, makeReliefMap(Relief::waves, 128).data);
    EXPECT_NE(scene->images[std::size_t(material.normalMap.image)].data, makeReliefMap(Relief::waves, 128).data);
}

// Adds a second material with its own map, which KHR_materials_variants may put in place of the first.
void addVariant(Made& m)
{
    m.root["extensionsUsed"] = {"KHR_materials_variants"};
    m.root["extensions"]["KHR_materials_variants"]["variants"] = json::array({{{"name", "other"}}});
    m.root["materials"].push_back({{"name", "variant"}, {"normalTexture", {{"index", 1}}}});
    m.root["textures"].push_back({{"source", 1}});
    m.root["images"].push_back({{"uri", "variant.png"}});
    m.root["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"] =
        json::array({{{"material", 1}, {"variants", {0}}}});
}

TEST(ConvertCommand, mapsOfVariantsAreConvertedToo)
{
    TemporaryFolder folder;
    Made m = quad(2);
    addVariant(m);
    write(m, folder.path());
    std::filesystem::copy_file(folder / "waves.png", folder / "variant.png");
    const json r = convertJson(folder.path(), {"quad.gltf", "--to", "cotangent", "-o", "out.glb"});
    ASSERT_EQ(r["maps"].size(), 2u);
    const auto before = openGltfDocument(folder / "quad.gltf"), after = openGltfDocument(folder / "out.glb");
    ASSERT_TRUE(before && after);
    const auto old = gltfImageBytes(*before, 1), own = gltfImageBytes(*after, 0), variant = gltfImageBytes(*after, 1);
    ASSERT_TRUE(old && own && variant);
    EXPECT_EQ(*own, *variant); // the same map on the same triangles
    EXPECT_NE(*variant, *old);
}

// Readers that know the extension would take its image, which is for the old frame.
TEST(ConvertCommand, alternativeImagesOfAConvertedMapAreRemoved)
{
    TemporaryFolder folder;
    Made m = quad(2);
    m.root["extensionsUsed"] = {"EXT_texture_webp"};
    m.root["textures"][0]["extensions"]["EXT_texture_webp"]["source"] = 1;
    m.root["textures"][0]["extensions"]["VENDOR_other"]["keep"] = 1;
    m.root["images"].push_back({{"uri", "waves.webp"}});
    write(m, folder.path());
    std::ofstream(folder / "waves.webp") << "RIFF\x10\x01\x01\x01WEBPVP8 ";
    const json r = convertJson(folder.path(), {"quad.gltf", "--to", "cotangent", "-o", "out.glb"});
    EXPECT_NE(r["notes"].dump().find("EXT_texture_webp removed"), std::string::npos) << r["notes"];
    const json extensions = jsonOfGlb(folder / "out.glb")["textures"][0]["extensions"];
    EXPECT_FALSE(extensions.contains("EXT_texture_webp"));
    EXPECT_FALSE(jsonOfGlb(folder / "out.glb").contains("extensionsUsed"));
    EXPECT_EQ(extensions["VENDOR_other"]["keep"], 1);
}

// The WebP extension is required here: the converted texture is WebP too, with the texels a PNG would have.
TEST(ConvertCommand, aMapInWebpBecomesLosslessWebp)
{
    TemporaryFolder folder;
    Made m = quad(2);
    write(m, folder.path());
    const auto waves = readImage(folder / "waves.png");
    ASSERT_TRUE(waves);
    std::vector<std::array<int, 4>> texels(waves->pixelCount());
    for (std::size_t i = 0; i < 4 * texels.size(); ++i)
        texels[i / 4][i % 4] = waves->bytes8()[i];
    std::ofstream(folder / "waves.webp", std::ios::binary) << makeWebp(waves->width, waves->height, texels);
    const json plain = convertJson(folder.path(), {"quad.gltf", "--to", "cotangent", "-o", "plain.glb"});
    m.root["extensionsUsed"] = m.root["extensionsRequired"] = {"EXT_texture_webp"};
    m.root["textures"][0].erase("source");
    m.root["textures"][0]["extensions"]["EXT_texture_webp"]["source"] = 0;
    m.root["images"][0]["uri"] = "waves.webp";
    write(m, folder.path());
    const json r = convertJson(folder.path(), {"quad.gltf", "--to", "cotangent", "-o", "out.glb"});
    EXPECT_FALSE(r["maps"][0]["kept"].get<bool>());
    EXPECT_EQ(r["notes"].dump().find(" removed: "), std::string::npos) << r["notes"];
    const json out = jsonOfGlb(folder / "out.glb");
    EXPECT_EQ(out["extensionsRequired"], json({"EXT_texture_webp"}));
    EXPECT_EQ(out["extensionsUsed"], json({"EXT_texture_webp"}));
    EXPECT_FALSE(out["textures"][0].contains("source"));
    EXPECT_EQ(out["textures"][0]["extensions"]["EXT_texture_webp"]["source"], 0);
    EXPECT_EQ(out["images"][0]["mimeType"], "image/webp");
    EXPECT_EQ(r["maps"][0]["format"], "WebP");
    EXPECT_EQ(r["maps"][0]["quality"], nullptr);
    EXPECT_EQ(r["maps"][0]["degrees_after_rounding"], plain["maps"][0]["degrees_after_rounding"]);
    EXPECT_EQ(normalMapOf(folder / "out.glb").data, normalMapOf(folder / "plain.glb").data);
    EXPECT_EQ(runTool({"render", "quad.gltf", "-o", "x.png", "--device", "reference", "--size", "8x8", "--quiet"},
                      folder.path())
                  .code,
              0);
}

TEST(ConvertCommand, aMapInJpegStaysJpegElseANoteStatesTheCost)
{
    TemporaryFolder folder;
    Made m = quad(2);
    write(m, folder.path());
    const auto waves = readImage(folder / "waves.png");
    ASSERT_TRUE(waves && writeImage(folder / "waves.jpg", *waves));
    m.root["images"][0]["uri"] = "waves.jpg";
    write(m, folder.path());
    const std::vector<std::string> words = {"quad.gltf", "--to", "cotangent", "-o", "out.gltf"};
    const json map = convertJson(folder.path(), words)["maps"][0];
    EXPECT_EQ(map["format"], "JPEG");
    EXPECT_GT(map["quality"], 1);
    EXPECT_LT(map["bytes_after"], 1.5 * map["bytes_before"].get<double>());
    EXPECT_LT(map["degrees_after_rounding"]["mean"], 2);
    const json out = json::parse(readWhole(folder / "out.gltf"));
    const std::string file = out["images"][0]["uri"];
    EXPECT_EQ(file, "out-waves.jpg");
    EXPECT_EQ(std::filesystem::file_size(folder / file), map["bytes_after"]);
    const json wide = convertJson(folder.path(), {"quad.gltf", "--to", "cotangent", "--bits", "16", "-o", "wide.glb"});
    EXPECT_EQ(wide["maps"][0]["format"], "PNG");
    EXPECT_NE(wide["notes"].dump().find("waves.jpg: JPEG has 8 bits, but 16 are required, so the new map is PNG"),
              std::string::npos)
        << wide["notes"];
}

TEST(ConvertCommand, tangentsAreKeptIfTheMapCannotBeConverted)
{
    TemporaryFolder folder;
    Made m = quad(2);
    m.root["extensionsUsed"] = {"KHR_texture_basisu"};
    m.root["textures"][0] = {{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}};
    m.root["images"][0] = {{"uri", "waves.ktx2"}};
    write(m, folder.path());
    std::ofstream(folder / "waves.ktx2", std::ios::binary)
        << makeKtx2({.format = 0, .levels = {{"some"}}, .colourModel = 167});
    const json r = convertJson(folder.path(), {"quad.gltf", "--to", "cotangent", "-o", "out.glb"});
    EXPECT_TRUE(r["maps"].empty());
    EXPECT_NE(r["notes"].dump().find("TANGENT is kept"), std::string::npos) << r["notes"];
    EXPECT_TRUE(jsonOfGlb(folder / "out.glb")["meshes"][0]["primitives"][0]["attributes"].contains("TANGENT"));
}

// With square uv, the new map would equal the old one except for rounding.
TEST(ConvertCommand, aMapThatFitsUnconvertedKeepsItsBytes)
{
    TemporaryFolder folder;
    write(quad(1), folder.path());
    const json r = convertJson(folder.path(), {"quad.gltf", "--to", "cotangent", "-o", "out.glb"});
    EXPECT_TRUE(r["maps"][0]["kept"].get<bool>());
    EXPECT_EQ(r["notes"].dump().find("shade them incorrectly"), std::string::npos) << r["notes"];
    const auto before = openGltfDocument(folder / "quad.gltf"), after = openGltfDocument(folder / "out.glb");
    ASSERT_TRUE(before && after);
    EXPECT_EQ(*gltfImageBytes(*before, 0), *gltfImageBytes(*after, 0));
    EXPECT_FALSE(jsonOfGlb(folder / "out.glb")["meshes"][0]["primitives"][0]["attributes"].contains("TANGENT"));
    EXPECT_FALSE(convertJson(folder.path(),
                             {"quad.gltf", "--to", "cotangent", "--bits", "16", "-o", "16.glb"})["maps"][0]["kept"]
                     .get<bool>());
}

TEST(ConvertCommand, aNoteSaysIfNoSingleMapFits)
{
    TemporaryFolder folder;
    Made m = quad(1);
    write(m, folder.path());
    EXPECT_EQ(convertJson(folder.path(), {"quad.gltf", "--to", "cotangent", "-o", "one.glb"})["notes"].dump().find(
                  "No single map"),
              std::string::npos);
    m.root["nodes"].push_back({{"mesh", 0}, {"scale", {4, 1, 1}}}); // the same texels, stretched in this instance
    m.root["scenes"][0]["nodes"] = {0, 1};
    write(m, folder.path());
    EXPECT_NE(convertJson(folder.path(), {"quad.gltf", "--to", "cotangent", "-o", "two.glb"})["notes"].dump().find(
                  "No single map"),
              std::string::npos);
}

TEST(ConvertCommand, reversedTangentsAreFollowedOrIgnoredAsRequested)
{
    TemporaryFolder folder;
    Made m = quad(1);
    for (std::size_t i = 0; i < 6; ++i) { // TANGENT follows positions and normals
        const float w = -1;
        std::memcpy(m.bytes.data() + (18 + 18 + 4 * i + 3) * sizeof(float), &w, sizeof w);
    }
    write(m, folder.path());
    convertJson(folder.path(), {"quad.gltf", "--to", "cotangent", "-o", "stored.glb"});
    convertJson(folder.path(), {"quad.gltf", "--to", "cotangent", "--tangents", "generated", "-o", "generated.glb"});
    const Image old = normalMapOf(folder / "quad.gltf"), stored = normalMapOf(folder / "stored.glb"),
                generated = normalMapOf(folder / "generated.glb");
    for (std::size_t i = 0; i < old.pixelCount(); ++i) {
        EXPECT_NEAR(stored.bytes8()[4 * i + 1], 256 - old.bytes8()[4 * i + 1], 1); // green is mirrored
        EXPECT_NEAR(generated.bytes8()[4 * i + 1], old.bytes8()[4 * i + 1], 1);
    }
}

TEST(ConvertCommand, realModelsLookTheSameWithoutTangents)
{
    const struct {
        const char* file;
        double mean; // degrees; 8-bit maps cost 0.17, the remainder is filtering across facets and shared texels
    } models[] = {{"models/FlightHelmet/FlightHelmet.gltf", 0.5}, {"models/SketchfabCat/scene.gltf", 0.5}};
    for (const auto& model : models) {
        COTAN_NEEDS_DATA(model.file);
        TemporaryFolder folder;
        const json r = convertJson(folder.path(),
                                   {dataFile(model.file).string(), "--to", "smooth", "-o", "out.glb", "--verify", "v"});
        EXPECT_LT(r["verify"]["degrees"]["mean_degrees"].get<double>(), model.mean) << model.file;
        EXPECT_GT(r["tangents"]["bytes"].get<std::size_t>(), 10000u);
        EXPECT_EQ(runTool({"render", "out.glb", "-o", "out.png", "--frame", "smooth", "--size", "64x64", "--quiet"},
                          folder.path())
                      .code,
                  0);
    }
}

// Bytes of a model and the files that it refers to.
std::uintmax_t bytesWithItsFiles(const std::filesystem::path& model)
{
    std::uintmax_t bytes = std::filesystem::file_size(model);
    if (model.extension() == ".glb")
        return bytes;
    const json root = json::parse(readWhole(model));
    for (const char* list : {"buffers", "images"})
        for (const json& named : root.value(list, json::array()))
            bytes += std::filesystem::file_size(model.parent_path() / named["uri"].get<std::string>());
    return bytes;
}

TEST(ConvertCommand, keepMapsDropsTangentsAndKeepsTheBytesOfMaps)
{
    std::size_t tried = 0, anyReversed = 0;
    for (const char* file :
         {"models/FlightHelmet/FlightHelmet.gltf", "models/SketchfabCat/scene.gltf", "models/BoomBox/BoomBox.gltf",
          "models/ClearCoatTest/ClearCoatTest.glb", "models/GlamVelvetSofa/GlamVelvetSofa.glb",
          "models/TwoSidedPlane/TwoSidedPlane.glb", "models/NormalTangentTest/NormalTangentTest.glb",
          "models/NormalTangentMirrorTest/NormalTangentMirrorTest.glb",
          "models/SunglassesKhronos/SunglassesKhronos.glb", "models/AnisotropyStrengthTest/AnisotropyStrengthTest.glb",
          "compressed/chess_board_draco.glb", "compressed/heart_draco.glb", "compressed/jet_fighter_draco_basisu.glb",
          "compressed/pirate_meshopt.glb"}) {
        const std::filesystem::path model = dataFile(file);
        if (!std::filesystem::exists(model))
            continue;
        ++tried;
        TemporaryFolder folder;
        const json r =
            convertJson(folder.path(), {model.string(), "--keep-maps", "--to-frame", "orthonormal", "-o", "out.glb"});
        EXPECT_EQ(r["to"], "orthonormal");
        std::set<std::size_t> reversed; // images whose green TANGENT reverses
        for (const json& map : r["maps"]) {
            if (map["green_reversed"]) {
                reversed.insert(map["image"].get<std::size_t>());
                EXPECT_LE(map["bytes_after"].get<double>(), 1.1 * map["bytes_before"].get<double>()) << file;
                // 0.5 degrees: what the format may lose of a map that is almost flat.
                EXPECT_LT(map["degrees_after_rounding"]["mean"],
                          std::max(0.2 * map["degrees_unconverted"]["mean"].get<double>(), 0.5))
                    << file;
            } else {
                EXPECT_EQ(map["bytes_after"], map["bytes_before"]) << file;
            }
        }
        // JSON text and padding may change size: 2 %.
        EXPECT_LT(double(std::filesystem::file_size(folder / "out.glb")), 1.02 * double(bytesWithItsFiles(model)))
            << file;
        anyReversed += reversed.size();
        const auto before = openGltfDocument(model), after = openGltfDocument(folder / "out.glb");
        ASSERT_TRUE(before && after) << file;
        const std::size_t images = rootOf(*before).value("images", json::array()).size();
        ASSERT_EQ(rootOf(*after).value("images", json::array()).size(), images);
        for (std::size_t i = 0; i < images; ++i)
            EXPECT_EQ(*gltfImageBytes(*after, i) == *gltfImageBytes(*before, i), !reversed.contains(i))
                << file << " image " << i;
    }
    if (tried == 0)
        GTEST_SKIP() << "no model is there: run scripts/test-data";
    if (isOriginal("models/SketchfabCat/scene.gltf")) {
        EXPECT_GE(anyReversed, 3u); // two maps of the cat, that of TwoSidedPlane
    }
}

// Kinds of errors that Khronos' validator finds in a file; empty if there are none.
std::set<std::string> validatorErrors(const std::filesystem::path& file, const std::filesystem::path& log)
{
    const std::string command = "node '" COTAN_SOURCE_DIR "/tests/npm/validate.mjs' '" COTAN_NPM "/node_modules' '"
        + file.string() + "' > '" + log.string() + "' 2>&1";
    EXPECT_LE(WEXITSTATUS(std::system(command.c_str())), 1) << readWhole(log);
    std::set<std::string> kinds;
    std::istringstream lines(readWhole(log));
    for (std::string severity, name, kind, rest; lines >> severity >> name >> kind && std::getline(lines, rest);)
        if (severity == "error")
            kinds.insert(kind);
    return kinds;
}

// MESH_PRIMITIVE_NO_TANGENT_SPACE among them, where a coat or anisotropy needs TANGENT.
TEST(ConvertCommand, conversionsMakeNoNewErrorsOfKhronosValidator)
{
    if (!std::filesystem::exists(COTAN_NPM "/installed-lock.json"))
        GTEST_SKIP() << "gltf-validator is not installed (see the test npm_packages)";
    std::size_t tried = 0;
    for (const char* const folder : {"models", "materials"})
        if (hasData(folder))
            for (const auto& entry : std::filesystem::recursive_directory_iterator(dataFile(folder))) {
                const std::filesystem::path& model = entry.path();
                if (model.extension() != ".glb" && model.extension() != ".gltf")
                    continue;
                TemporaryFolder place;
                const std::set<std::string> known = validatorErrors(model, place / "log");
                // Large maps take long to convert; their tangents are dropped in the same way.
                std::vector<std::vector<std::string>> ways = {{"--keep-maps"}};
                if (bytesWithItsFiles(model) < 500'000)
                    ways.push_back({"--to-frame", "smooth"});
                for (std::vector<std::string> words : ways) {
                    words.insert(words.begin(), {"convert", model.string(), "-o", "out.glb", "--overwrite", "--quiet"});
                    const ToolRun run = runTool(words, place.path(), 120);
                    ASSERT_EQ(run.code, 0) << model << run.err;
                    for (const std::string& kind : validatorErrors(place / "out.glb", place / "log"))
                        EXPECT_TRUE(known.contains(kind))
                            << model << ' ' << words.back() << ": " << readWhole(place / "log");
                    ++tried;
                }
            }
    if (tried == 0)
        GTEST_SKIP() << "no model is there";
}

TEST(ConvertCommand, keepMapsIsRefusedWithContradictoryOptions)
{
    TemporaryFolder folder;
    write(quad(2), folder.path());
    const std::pair<std::vector<std::string>, const char*> wrong[] = {
        {{"--keep-tangents"}, "--keep-tangents: --keep-maps drops only the tangents"},
        {{"--bits", "8"}, "--bits: --keep-maps drops only the tangents"},
        {{"--to-frame", "mikktspace"},
         "--to-frame: expected a frame that reads no tangents, since --keep-maps drops them; found mikktspace"},
    };
    for (const auto& [words, message] : wrong) {
        std::vector<std::string> all{"convert", "quad.gltf", "--keep-maps", "-o", "out.glb"};
        all.insert(all.end(), words.begin(), words.end());
        const ToolRun run = runTool(all, folder.path());
        EXPECT_EQ(run.code, 1);
        EXPECT_NE(run.err.find(message), std::string::npos) << run.err;
    }
    // The remaining error is reported: the quad is stretched 2:1, which cotangent follows.
    const json r = convertJson(folder.path(), {"quad.gltf", "--keep-maps", "--to-frame", "cotangent", "-o", "out.glb"});
    EXPECT_NE(r["notes"].dump().find("unchanged and read with cotangent, its error"), std::string::npos) << r["notes"];
}

TEST(ConvertCommand, badInputGetsOneClearLineAndLeavesNothing)
{
    TemporaryFolder folder;
    write(quad(2), folder.path());
    Made noUv = quad(2);
    noUv.root["meshes"][0]["primitives"][0]["attributes"].erase("TEXCOORD_0");
    std::filesystem::create_directory(folder / "no-uv");
    write(noUv, folder / "no-uv");
    Made broken = quad(2);
    std::filesystem::create_directory(folder / "broken");
    write(broken, folder / "broken");
    std::ofstream(folder / "broken/waves.png") << "not an image";
    const struct {
        std::vector<std::string> words;
        int code;
    } cases[] = {
        {{"quad.gltf"}, 1},
        {{"quad.gltf", "--bits", "8", "-o", "out.glb"}, 1},                             // the maps stay
        {{"quad.gltf", "--max-degrees", "1", "--to", "cotangent", "-o", "out.glb"}, 1}, // nothing is chosen
        {{"quad.gltf", "--max-degrees", "-1", "-o", "out.glb"}, 1},
        {{"quad.gltf", "--to", "cotangent"}, 1},
        {{"quad.gltf", "--to", "cotangent", "-o", "out.png"}, 1},
        {{"quad.gltf", "--to", "cotangent", "-o", "quad.gltf"}, 1},
        {{"quad.gltf", "--to", "nonperspective", "-o", "out.glb"}, 1},
        {{"quad.gltf", "--to", "nothing", "-o", "out.glb"}, 1},
        {{"quad.gltf", "--to", "cotangent", "--bits", "12", "-o", "out.glb"}, 1},
        {{"missing.gltf", "--to", "cotangent", "-o", "out.glb"}, 2},
        {{"broken/quad.gltf", "--to", "cotangent", "-o", "out.glb"}, 2},
        {{"quad.gltf", "--to", "cotangent", "-o", "no/such/folder/out.glb"}, 4},
        {{"quad.gltf", "--to", "cotangent", "-o", "out.glb", "--verify", "waves.png"}, 4},
        {{"quad.gltf", "--to", "cotangent", "-o", "out.glb", "--verify", "v", "--device", "no such device"}, 3},
    };
    for (const auto& c : cases) {
        std::vector<std::string> words = c.words;
        words.insert(words.begin(), "convert");
        words.push_back("--quiet");
        const ToolRun run = runTool(words, folder.path(), 20);
        EXPECT_EQ(run.code, c.code) << fmt::format("{}", fmt::join(words, " ")) << run.err;
        EXPECT_EQ(lines(run.err), 1) << run.err;
        EXPECT_FALSE(std::filesystem::exists(folder / "out.glb"));
    }
    const json r = convertJson(folder.path(), {"no-uv/quad.gltf", "--to", "cotangent", "-o", "no-uv.glb"});
    EXPECT_TRUE(r["maps"].empty());
    EXPECT_NE(r["notes"].dump().find("no uv"), std::string::npos);
}

// The number of times that the files are opened and closed again while `work` runs, by the names in the folder.
std::map<std::string, int> timesOpened(const std::filesystem::path& folder, const std::function<void()>& work)
{
    std::map<std::string, int> times;
    const int watch = ::inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
    EXPECT_GE(::inotify_add_watch(watch, folder.c_str(), IN_OPEN | IN_CLOSE_NOWRITE), 0);
    work();
    alignas(inotify_event) char events[65536];
    const ssize_t size = ::read(watch, events, sizeof events);
    for (ssize_t at = 0; at < size;) {
        const auto* const event = reinterpret_cast<const inotify_event*>(events + at);
        if (event->mask & IN_CLOSE_NOWRITE && event->len > 0)
            ++times[event->name];
        at += ssize_t(sizeof *event + event->len);
    }
    ::close(watch);
    return times;
}

TEST(ConvertCommand, theModelIsReadOnce)
{
    for (const std::vector<std::string>& words : {std::vector<std::string>{},
                                                  {"--to", "cotangent"},
                                                  {"--keep-maps", "--to", "smooth"},
                                                  {"--provoking", "last"}}) {
        TemporaryFolder folder;
        write(quad(2), folder.path());
        std::vector<std::string> all = {"quad.gltf", "-o", "out.glb"};
        all.insert(all.end(), words.begin(), words.end());
        auto times = timesOpened(folder.path(), [&] { convertJson(folder.path(), all); });
        EXPECT_EQ(times["quad.gltf"], 1) << fmt::format("{}", fmt::join(all, " "));
        EXPECT_EQ(times["quad.bin"], 1) << fmt::format("{}", fmt::join(all, " "));
    }
}

// A check that had registered its outputs would let another command fail; this one says what is wrong first.
TEST(ConvertCommand, aWrongCommandLineTouchesNoOutput)
{
    TemporaryFolder folder;
    write(quad(2), folder.path());
    const ToolRun run = runTool(
        {"convert", "quad.gltf", "--provoking", "first", "--bits", "8", "-o", "no/folder/out.glb"}, folder.path(), 20);
    EXPECT_EQ(run.code, 1);
    EXPECT_NE(run.err.find("--bits: applies to converted maps only"), std::string::npos) << run.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "no"));
}

} // namespace
} // namespace cotan
