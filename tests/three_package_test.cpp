// Tests bindings/js/three, the package for three.js, in headless Chromium against three.js itself. Each test launches
// one page.
#include <gtest/gtest.h>

#include <map>

#include "examples_browser.hpp"
#include "examples_sheet_model.hpp"
#include "test_data.hpp"

namespace cotan::test {
namespace {

using nlohmann::json;

const std::string kSourceFolder = COTAN_SOURCE_DIR;
constexpr const char* kMirrored = "models/NormalTangentMirrorTest/NormalTangentMirrorTest.glb";
constexpr const char* kCoats = "models/ClearCoatTest/ClearCoatTest.glb";

// Maximum error in degrees, as for the examples: float differences of a pixel of 2e-3 or more of the eye's distance.
constexpr double kRight = 0.01;
// Minimum mean error of a frame with a wrong sign, axis or length: the domes have slopes of about twenty degrees.
constexpr double kWrong = 4;

// Writes the normals that our renderer draws of the sheet of examples/three from both sides, its map, and the sheet
// with stored tangents.
void writeSheetNormals(const TemporaryFolder& folder)
{
    const Image map = makeReliefMap(Relief::domes, 128);
    write(folder / "map.bytes", rowsFromTheBottom(map));
    for (const auto& [side, angle] : {std::pair{"front", 0.4}, std::pair{"back", 3.14159265358979 - 0.4}}) {
        const std::string name = side;
        writeSheet(folder.path(), name, angle, map);
        const ToolRun drawn =
            runTool({"render", name + ".gltf", "-o", name + ".exr", "--view", "normal", "--size", "256x256", "--camera",
                     "0", "--device", "reference", "--point-sampled", "--quiet"},
                    folder.path());
        ASSERT_EQ(drawn.code, 0) << drawn.err;
        const ToolRun stored = runTool({"tangents", name + ".gltf", "-o", name + "_tangents.glb"}, folder.path());
        ASSERT_EQ(stored.code, 0) << stored.err;
        const Result<Image> normals = readImage(folder / (name + ".exr"));
        ASSERT_TRUE(normals) << normals.error().message;
        ASSERT_EQ(normals->type, PixelType::float32);
        write(folder / (name + ".normals"), rowsFromTheBottom(*normals));
    }
}

// Writes tests/NAME.html.in with its placeholders replaced; returns the file name.
std::string writePackagePage(const TemporaryFolder& folder, const std::string& name)
{
    std::string page = readWhole(kSourceFolder + "/tests/" + name + ".html.in");
    put(page, "MODULES_URL", "file://" COTAN_NPM "/node_modules");
    put(page, "SOURCES_URL", "file://" + kSourceFolder);
    put(page, "TESTS_URL", "file://" + kSourceFolder + "/tests");
    const auto url = [](const char* file) { return "file://" + dataFile(file).string(); };
    put(page, "MODELS",
        json::array({json::array({"mirrored", url(kMirrored), true}), json::array({"coats", url(kCoats), false})})
            .dump());
    put(page, "FOLDER_URL", "file://" + folder.path().string());
    write(folder / (name + ".html"), page);
    return name + ".html";
}

// Report of one page; a string with the reason if it cannot run. Each test is a program of its own.
json packagePage(const std::string& name)
{
    if (!std::filesystem::exists(COTAN_NPM "/node_modules/three"))
        return "three is not installed (see the test npm_packages)";
    TemporaryFolder folder;
    if (name == "three_pictures")
        writeSheetNormals(folder);
    const json found = showPages(folder, {writePackagePage(folder, name)});
    return found.value(name, found);
}

void expectDrawnRight(const std::string& label, const json& found)
{
    ASSERT_TRUE(found.contains("worst")) << label << ": " << found;
    EXPECT_GT(found["count"].get<int>(), 10000) << label;
    ASSERT_TRUE(found["worst"].is_number())
        << label << ": not finite, or not of unit length"; // JSON writes NaN as null
    EXPECT_LT(found["worst"].get<double>(), kRight) << label;
}

void expectDrawnWrong(const std::string& label, const json& found)
{
    ASSERT_TRUE(found.contains("worst")) << label << ": " << found;
    if (found["mean"].is_number()) { // otherwise a direction is not finite, or not of unit length
        EXPECT_GT(found["mean"].get<double>(), kWrong) << label;
    }
}

// Cases that three.js itself gets wrong, and the reason. An entry can be removed once three.js is fixed.
const std::map<std::string, const char*> kWrongInThree = {
    {"y down", "its frame has no sign of its own"},
    {"y down, back", "the same"},
    {"y down, wound for it", "the same"},
    {"coat, y down", "the same"},
    {"anisotropy along u, y down", "the same"},
    {"tangents, mirrored transform", "bitangents are made of a tangent that is mirrored and a normal that is not"},
    {"anisotropy along u, sheared", "directions lie along gradients, not along the surface's u"},
    {"anisotropy across, stretched", "directions are as long as the gradients"},
};
// Wrong only with WebGLRenderer.
const std::map<std::string, const char*> kWrongOnWebGl = {
    {"coat, tangents against v",
     "tangents are used where there is a map of bumps, and the coat's scale counts on them"},
};
// Wrong only with WebGPURenderer.
const std::map<std::string, const char*> kWrongInNodes = {
    {"uv set 1", "the frame is made over getUV(), which is set 0"},
    {"rotated texture", "and is not transformed"},
    {"coat on uv set 1, bumps on set 0", "the coat has the frame of the bumps"},
    {"anisotropy along u", "directions are turned by the bumps"},
    {"anisotropy along u, stretched", "the same"},
    {"anisotropy across, tangents against v", "the same"},
};

void expectStock(const std::string& label, const json& scenes, std::map<std::string, const char*> wrong)
{
    wrong.insert(kWrongInThree.begin(), kWrongInThree.end());
    for (const auto& [scene, found] : scenes.items()) {
        const auto& expect = wrong.contains(scene) ? expectDrawnWrong : expectDrawnRight;
        expect(label + scene, found);
    }
}

// Each half of an image of two materials shows its own map. A one-texel map has no derivatives to round; 8 bits decode
// to the expected normal exactly.
void expectTwoMaterials(const json& page, const std::string& prefix, std::size_t kinds)
{
    for (const char* const frame : {"stock", "auto", "cotangent", "orthonormal", "smooth", "triangle"}) {
        const std::string label = prefix + "two materials, " + frame;
        ASSERT_TRUE(page.contains(label)) << label;
        EXPECT_EQ(page[label].size(), kinds) << label;
        for (const auto& [kind, halves] : page[label].items()) {
            if (kind == "two matrices" && std::string(frame) == "stock" && !prefix.empty())
                continue; // three's nodes take the frame from texture coordinates that are not transformed
            for (const json& degrees : halves) {
                ASSERT_TRUE(degrees.is_number()) << label << ", " << kind;
                EXPECT_LT(degrees.get<double>(), kRight) << label << ", " << kind << ": " << halves;
            }
        }
    }
}

void expectOurs(const std::string& label, const json& scenes, std::size_t count)
{
    EXPECT_EQ(scenes.size(), count) << label;
    for (const auto& [scene, found] : scenes.items())
        expectDrawnRight(label + scene, found);
}

TEST(ThreePackage, shaderTextEqualsTheToolsOutput)
{
    TemporaryFolder folder;
    for (const auto& [what, file] : {std::pair{"frames", "shader_text.js"}, std::pair{"relief", "relief_text.js"}}) {
        const std::string line = "'" + kSourceFolder + "/scripts/three-shader-text' '" COTAN_TOOL "' " + what + " > '"
            + (folder / "text").string() + "'";
        ASSERT_EQ(std::system(line.c_str()), 0);
        EXPECT_EQ(readWhole(kSourceFolder + "/bindings/js/three/" + file), readWhole(folder / "text"))
            << "scripts/three-shader-text TOOL " << what << " > bindings/js/three/" << file;
    }
}

TEST(ThreePackage, drawsEverySceneRightWithWebGLRenderer)
{
    const json page = packagePage("three_webgl");
    if (page.is_string())
        GTEST_SKIP() << page.get<std::string>();
    ASSERT_TRUE(page.contains("stock")) << page;
    expectStock("stock, ", page["stock"], kWrongOnWebGl);
    EXPECT_GT(page["stock"].size(), 25u);
    for (const char* method : {"untangled", "smooth", "triangle"})
        expectOurs(std::string(method) + ", ", page[method], page["stock"].size());
    for (const char* method : {"cotangent", "orthonormal"})
        expectOurs(std::string(method) + ", ", page[method], 9);
    for (const auto& [scene, found] : page["broken"].items())
        expectDrawnWrong("broken, " + scene, found);
    expectTwoMaterials(page, "", 5);
}

TEST(ThreePackage, drawsEverySceneRightWithWebGPURenderer)
{
    const json page = packagePage("three_webgpu");
    if (page.is_string())
        GTEST_SKIP() << page.get<std::string>();
    ASSERT_TRUE(page.contains("webgl stock")) << page;
    for (const std::string backend : {"webgpu ", "webgl "}) {
        if (!page.contains(backend + "stock"))
            continue; // a Chromium without WebGPU
        expectStock(backend + "stock, ", page[backend + "stock"], kWrongInNodes);
        EXPECT_GT(page[backend + "stock"].size(), 22u);
        for (const std::string method : {"untangled", "triangle"})
            expectOurs(backend + method + ", ", page[backend + method], page[backend + "stock"].size());
        for (const std::string method : {"orthonormal", "smooth"})
            expectOurs(backend + method + ", ", page[backend + method], 9);
        expectDrawnWrong(backend + "reversed", page[backend + "broken"]["front"]);
        expectTwoMaterials(page, backend, 7);
        EXPECT_EQ(page[backend + "lit"].size(), 5u);
        for (const auto& [scene, render] : page[backend + "lit"].items()) {
            EXPECT_GT(render["covered"].get<int>(), 30000) << scene;
            EXPECT_LE(render["worst"].get<int>(), 1)
                << backend << scene << ": a colour may lie at the edge between two steps";
            if (!scene.starts_with("anisotropy")) { // which has no bumps in this test
                EXPECT_GT(render["reversed"].get<int>(), 10) << backend << scene;
            }
        }
    }
    EXPECT_EQ(page["plugin"], json({{"tangents", false}, {"node", true}, {"scale", -1}}));
    EXPECT_NE(page["refused"].get<std::string>().find("expected a renderer"), std::string::npos);
}

TEST(ThreePackage, warnsOfKeptTangentsSharesMaterialsAndReadsAnisotropy)
{
    const json page = packagePage("three_calls");
    if (page.is_string())
        GTEST_SKIP() << page.get<std::string>();
    ASSERT_TRUE(page.contains("unwatched")) << page;
    EXPECT_EQ(page["unwatched"]["before"], 1);
    EXPECT_EQ(page["unwatched"]["after"], 1) << "untangled, nothing more is said";
    EXPECT_NE(page["unwatched"]["text"].get<std::string>().find("\"bumps\" has tangents"), std::string::npos);
    EXPECT_EQ(page["sharing"]["scales"], json({1, -1, 1, -1}))
        << "along v, against v, and none, of one material; then again";
    EXPECT_EQ(page["sharing"]["materials"], 3);
    EXPECT_EQ(page["sharing"]["own"], 3) << "what the user did in onBeforeCompile stays";
    // A mesh that is added later gets the triangles of the material that it shares.
    EXPECT_EQ(page["sharing"]["triangles"], json::parse("[[false, false], [true, true], [true, true]]"));
    expectDrawnRight("loaded", page["loaded"]["cotan"]);
    EXPECT_GT(page["loaded"]["stock"]["mean"].get<double>(), 179)
        << "three's bitangents run along v, glTF's against it";
    EXPECT_NE(page["refused"][0].get<std::string>().find("expected an Object3D"), std::string::npos);
    EXPECT_EQ(
        page["refused"][1],
        "CotanError usage: options.frame: expected auto, cotangent, orthonormal, smooth, triangle, found 'mikktspace'");
    EXPECT_EQ(page["refused"][2],
              "CotanError usage: options.fraem: expected one of frame, convention, note, maxDegrees, found fraem");
    EXPECT_EQ(page["refused"][3], "CotanError usage: options.convention: expected gltf, directx, found 'unity'");
    EXPECT_EQ(page["refused"][4], page["refused"][1]) << "before a model is loaded";
    EXPECT_EQ(page["refused"][5], page["refused"][1]);
}

TEST(ThreePackage, drawsAsThreeAlsoIntoFlippedTargets)
{
    const json found = packagePage("three_pictures");
    if (found.is_string())
        GTEST_SKIP() << found.get<std::string>();
    for (const char* side : {"front", "back"}) {
        ASSERT_TRUE(found.contains(side)) << found;
        const json& page = found[side];
        const auto worst = [&](const char* what) { return page[what]["worst"].get<double>(); };
        EXPECT_GT(page["stock and cotan"]["count"].get<int>(), 30000)
            << side;                                    // the sheet covers more than half of 256 x 256
        EXPECT_LE(worst("stock and cotan"), 1) << side; // a colour may lie at the edge between two steps
        EXPECT_LE(worst("cotan upright and y down"), 2)
            << side; // so may it in both renders, and interpolation rounds differently
        // The domes are lit from the opposite side or become dents; the flat area between them does not change.
        EXPECT_GT(page["stock upright and y down"]["mean"].get<double>(), 15) << side;
        EXPECT_GT(page["stock and broken"]["mean"].get<double>(), 3) << side; // less light falls on the back
        expectDrawnRight(std::string("three and Cotan's own renderer, ") + side, page["normals"]);
        // A model with tangents, loaded by three's GLTFLoader.
        for (const char* loaded : {"loaded, stock", "loaded, cotan", "loaded, cotan, y down"})
            expectDrawnRight(std::string(loaded) + ", " + side, page[loaded]);
        expectDrawnWrong(std::string("loaded, broken, ") + side, page["loaded, broken"]);
    }
}

// Models whose maps were baked for their tangents look the same if their maps are read as orthonormal. The bounds are
// about three times the measured values.
TEST(ThreePackage, modelsWithTangentsLookTheSameWithoutThem)
{
    COTAN_NEEDS_DATA(kMirrored);
    COTAN_NEEDS_DATA(kCoats);
    const json page = packagePage("three_models");
    if (page.is_string())
        GTEST_SKIP() << page.get<std::string>();
    for (const char* model : {"mirrored", "coats"}) {
        ASSERT_TRUE(page.contains(model)) << page;
        const json& found = page[model];
        EXPECT_EQ(found["tangents"], 0) << model;
        for (const char* method : {"default", "cotangent", "triangle"}) {
            if (!found.contains(method))
                continue; // `triangle` is drawn for one model only
            EXPECT_GT(found[method]["count"].get<int>(), 30000) << model;
            EXPECT_TRUE(found[method]["finite"].get<bool>()) << model << ", " << method;
        }
        EXPECT_LT(found["default"]["mean"].get<double>(), 0.05) << model;
        EXPECT_LT(found["default"]["worst"].get<double>(), 1) << model << ", 99 pixels in 100";
        EXPECT_LT(found["default"]["steps"].get<double>(), 0.1) << model << ", the lit picture";
        EXPECT_LT(found["default"]["mean"].get<double>(), found["cotangent"]["mean"].get<double>()) << model;
    }
    // The triangles of this model are flat or small: directions are those of `cotangent`.
    const json& mirrored = page["mirrored"];
    EXPECT_NEAR(mirrored["triangle"]["mean"].get<double>(), mirrored["cotangent"]["mean"].get<double>(), 0.01);
}

} // namespace

} // namespace cotan::test
