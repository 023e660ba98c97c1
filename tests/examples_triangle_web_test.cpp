// examples/triangle-web in headless Chromium: the analytic sheets, and models written by `cotan convert --provoking`,
// compared with what Cotan's own renderer draws.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "cotan/gltf.hpp"
#include "cotan/image.hpp"
#include "cotan/model.hpp"
#include "cotan/scene.hpp"
#include "examples_browser.hpp"
#include "examples_odd_models.hpp"
#include "gltf/json/lookup.hpp"
#include "test_data.hpp"

namespace cotan::test {
namespace {

using nlohmann::json;

const std::string kWeb = std::string(COTAN_SOURCE_DIR) + "/examples/triangle-web";
constexpr const char* kBoomBox = "models/BoomBox/BoomBox.gltf";

// Writes NAME_first.glb and NAME_last.glb.
void writeProvoking(const TemporaryFolder& folder, const std::string& model)
{
    const std::string name = model.substr(0, model.find('.'));
    for (const std::string corner : {"first", "last"}) {
        const ToolRun run =
            runTool({"convert", model, "--provoking", corner, "-o", name + "_" + corner + ".glb"}, folder.path());
        ASSERT_EQ(run.code, 0) << run.err;
    }
}

// Writes NAME.glb with the map and the camera of the pages, the files of writeProvoking, and NAME.normals.
void writeModel(const TemporaryFolder& folder, const std::string& name, Mesh mesh, const Image& map)
{
    Scene scene;
    mesh.material = 0;
    mesh.tangents.clear();
    scene.meshes = {std::move(mesh)};
    scene.images = {map};
    scene.materials.resize(1);
    scene.materials[0].normalMap.image = 0;
    scene.materials[0].doubleSided = true;
    auto document = gltfDocumentOf(scene);
    ASSERT_TRUE(document) << document.error().message;
    auto& root = rootOf(*document);
    const auto positions = root["meshes"][0]["primitives"][0]["attributes"]["POSITION"].get<std::size_t>();
    const auto low = root["accessors"][positions]["min"].get<std::array<double, 3>>(),
               high = root["accessors"][positions]["max"].get<std::array<double, 3>>();
    // The pages scale the model into a box of 5 x 3 and look at its centre from a distance of 4.
    const double away = 4 / std::min(5 / (high[0] - low[0]), 3 / (high[1] - low[1]));
    root["cameras"] = {
        {{"type", "perspective"},
         {"perspective", {{"yfov", 2 * std::atan(1 / 2.2)}, {"aspectRatio", 2}, {"znear", away / 100}}}}};
    root["nodes"] = {
        {{"mesh", 0}},
        {{"camera", 0},
         {"translation", {(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2 + away}}}};
    root["scenes"] = {{{"nodes", {0, 1}}}};
    const auto written = writeGltf(*document, folder / (name + ".glb"));
    ASSERT_TRUE(written) << written.error().message;
    writeProvoking(folder, name + ".glb");
    const ToolRun drawn =
        runTool({"render", name + ".glb", "-o", name + ".exr", "--frame", "triangle", "--view", "normal", "--size",
                 "480x240", "--camera", "0", "--device", "reference", "--point-sampled", "--quiet"},
                folder.path());
    ASSERT_EQ(drawn.code, 0) << drawn.err;
    const Result<Image> normals = readImage(folder / (name + ".exr"));
    ASSERT_TRUE(normals) << normals.error().message;
    ASSERT_EQ(normals->bytesPerPixel(), 16u);
    write(folder / (name + ".normals"), rowsFromTheBottom(*normals));
}

// Writes the files that tests/examples_triangle_web.js loads; returns the names of the models.
json writeModels(const TemporaryFolder& folder)
{
    const Image map = makeReliefMap(Relief::domes, 128);
    write(folder / "map.bytes", std::string(reinterpret_cast<const char*>(map.data.data()), map.data.size()));
    json names = {"teapot"};
    writeModel(folder, "teapot", makeTeapot(12), map);
    if (hasData(kBoomBox)) {
        if (const auto scene = loadScene(dataFile(kBoomBox))) {
            writeModel(folder, "boombox", scene->meshes.at(0), map);
            names.push_back("boombox");
        }
    }
    for (std::size_t k = 0; k < oddModels().size(); ++k) {
        writeOddModel(folder / ("odd" + std::to_string(k) + ".gltf"), oddModels()[k]);
        writeProvoking(folder, "odd" + std::to_string(k) + ".gltf");
    }
    return names;
}

// The page's report, or the reason why there is none.
json reportOf(const std::string& page)
{
    TemporaryFolder folder;
    const json names = writeModels(folder);
    write(folder / "model.js", readWhole(kWeb + "/model.js"));
    write(folder / "page.html",
          readWhole(kWeb + "/" + page + ".html") + "<script>\nconst measuredPage = '" + page
              + "', modelNames = " + names.dump() + ", oddCount = " + std::to_string(oddModels().size()) + ";\n"
              + readWhole(COTAN_SOURCE_DIR "/tests/examples_triangle_web.js") + "</script>\n");
    const json found = showPages(folder, {"page.html"});
    return found.is_string() ? json{{"skipped", found}} : found.value(page, found);
}

void expectWebSheets(const json& page, const std::string& method)
{
    for (const char* side : {"front", "back"}) {
        ASSERT_TRUE(page.contains("sheets")) << page;
        const json& found = page["sheets"][method][side];
        EXPECT_GT(found["count"].get<int>(), 2000) << method;
        ASSERT_TRUE(found["worst"].is_number()) << method << ": a normal is not finite"; // JSON writes NaN as null
        // Rounding U and V to halfs may rotate a normal by 0.03 degrees.
        EXPECT_LT(found["worst"].get<double>(), 0.03) << method << ", " << side;
    }
}

void expectWebModels(const json& page, const std::string& method)
{
    for (const auto& [name, found] : page["models"].items()) {
        const json& errors = found[method];
        EXPECT_GT(errors["count"].get<int>(), 30000) << name;
        EXPECT_TRUE(errors["finite"].get<bool>()) << name;
        EXPECT_LT(errors["median"].get<double>(), 0.03) << name << ", " << method; // rounding to halfs
        // Corners are snapped to 1/16 of a pixel or finer, and interpolated normals rotate by about 2 degrees a pixel.
        // At no more than one pixel in twenty, another texel is nearest or another triangle is hit.
        EXPECT_LT(errors["most95"].get<double>(), 0.25) << name << ", " << method;
        EXPECT_NE(found["refused"].get<std::string>().find("cotan convert --provoking"), std::string::npos) << name;
    }
    EXPECT_EQ(page["models"].size(), hasData(kBoomBox) ? 2u : 1u);
}

void expectPage(const json& page, const std::vector<std::string>& methods)
{
    ASSERT_FALSE(page.contains("error")) << page;
    for (const std::string& method : methods) {
        expectWebSheets(page, method);
        expectWebModels(page, method);
    }
    ASSERT_EQ(page["odd"].size(), methods.size() * oddModels().size());
    for (std::size_t k = 0; k < page["odd"].size(); ++k) {
        const char* const name = oddModels()[k % oddModels().size()].name;
        EXPECT_GT(page["odd"][k]["pixels"].get<int>(), 20000) << name;
        EXPECT_LT(page["odd"][k]["apart"].get<int>(), 20) << name; // on the seam and the edges
    }
}

void expectCanvas(const json& page)
{
    // On the page's own canvas: the halfs of U and V and those of the canvas may each rotate a normal by 0.03 degrees.
    ASSERT_TRUE(page.contains("canvas")) << page;
    for (const char* side : {"front", "back"}) {
        const json& found = page["canvas"]["sheets"][side];
        EXPECT_GT(found["count"].get<int>(), 2000);
        ASSERT_TRUE(found["worst"].is_number());
        EXPECT_LT(found["worst"].get<double>(), 0.06) << side;
        ::testing::Test::RecordProperty(side, found["worst"].dump());
    }
    // The displayed image, in 8-bit steps: rounding is half a step.
    EXPECT_GT(page["canvas"]["picture"]["count"].get<int>(), 4000);
    EXPECT_LT(page["canvas"]["picture"]["worst"].get<double>(), 1);
    ::testing::Test::RecordProperty("steps", page["canvas"]["picture"]["worst"].dump());
}

TEST(ExampleTriangleWeb, thePastedTextIsWhatTheToolPrintsToday)
{
    TemporaryFolder folder;
    for (const auto& [page, lang] : {std::pair<std::string, std::string>{"webgl2", "essl"}, {"webgpu", "wgsl"}})
        for (const auto& [id, stage] :
             {std::pair<std::string, std::string>{"make", "vertex"}, {"perturb", "fragment"}}) {
            const ToolRun printed =
                runTool({"shader", "--lang", lang, "--frame", "triangle", "--stage", stage}, folder.path());
            ASSERT_EQ(printed.code, 0) << printed.err;
            EXPECT_NE(readWhole(kWeb + "/" + page + ".html").find("id=\"" + id + "\">\n" + printed.out + "</script>"),
                      std::string::npos)
                << "paste the output of `cotan shader --lang " << lang << " --frame triangle --stage " << stage
                << "` into examples/triangle-web/" << page << ".html again";
        }
}

TEST(ExampleTriangleWeb, webGl2NormalsAreRightFromFlatVaryingsAndDataTextures)
{
    const json page = reportOf("webgl2");
    if (page.contains("skipped"))
        GTEST_SKIP() << page["skipped"];
    expectPage(page, {"provoking", "read"});
}

TEST(ExampleTriangleWeb, webGpuNormalsAreRightFromProvokingVertexAndVisibilityBuffer)
{
    const json page = reportOf("webgpu");
    if (page.contains("skipped"))
        GTEST_SKIP() << page["skipped"];
    const std::vector<std::string> methods = page.value("ways", std::vector<std::string>{});
    EXPECT_GE(methods.size(), 2u); // and `read` if the browser supports the primitive index
    expectPage(page, methods);
    expectCanvas(page);
}

// Dawn without a browser: on Mesa 24 and newer it supports the primitive index, so no provoking vertex is needed.
TEST(ExampleTriangleWeb, dawnNormalsAreRightFromThePrimitiveIndex)
{
    TemporaryFolder folder;
    write(folder / "names.json", json{{"modelNames", writeModels(folder)}, {"oddCount", oddModels().size()}}.dump());
    const std::string command = "node '" COTAN_SOURCE_DIR "/tests/web/triangle_dawn.mjs' '" COTAN_NPM "/node_modules' '"
        + folder.path().string() + "' > '" + (folder / "out").string() + "' 2> '" + (folder / "err").string() + "'";
    const int status = std::system(command.c_str());
    if (WEXITSTATUS(status) == 77)
        GTEST_SKIP() << readWhole(folder / "out");
    ASSERT_EQ(status, 0) << readWhole(folder / "err");
    const json page = json::parse(readWhole(folder / "out"));
    const auto methods = page.value("ways", std::vector<std::string>{});
    ASSERT_EQ(methods, (std::vector<std::string>{"provoking", "visibility", "read"})) << page;
    expectPage(page, methods);
    expectCanvas(page);
}

} // namespace
} // namespace cotan::test
