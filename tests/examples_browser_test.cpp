// The pages of examples/ in headless Chromium: the pasted text is what the tool prints today, and the normals are
// those of the analytic surface. One launch shows all pages.
#include <gtest/gtest.h>

#include "examples_browser.hpp"
#include "examples_sheet_model.hpp"

namespace cotan::test {
namespace {

using nlohmann::json;

const std::string kSources = COTAN_SOURCE_DIR;

// Float differences of a pixel: a pixel is at least 2e-3 of the distance to the eye; the text's own
// introduction promises 0.002 degrees at 1e-3; times five for the slopes of up to 53 degrees.
constexpr double kDegrees = 0.01;

// The normals that our own renderer draws of the sheet of examples/three from both sides, the map on it, and the sheet
// with stored tangents.
void writeOwnNormals(const TemporaryFolder& folder)
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

// tests/examples_NAME.html.in with its addresses put in, about an example that takes an npm package.
void writeNpmPage(const TemporaryFolder& folder, const std::string& name, const std::string& example,
                  const std::string& library)
{
    std::string page = readWhole(kSources + "/tests/examples_" + name + ".html.in");
    put(page, "COTAN;", json(readWhole(kSources + "/examples/" + example + "/cotan.glsl")).dump() + ";");
    put(page, "LIBRARY_URL", "file://" + library);
    put(page, "ADDONS_URL", "file://" COTAN_NPM "/node_modules/three/examples/jsm");
    put(page, "TESTS_URL", "file://" + kSources + "/tests");
    put(page, "EXAMPLE_URL", "file://" + kSources + "/examples/" + example);
    put(page, "FOLDER_URL", "file://" + folder.path().string());
    write(folder / (name + ".html"), page);
}

// What the pages report, by page; a string that says why where they cannot run.
json measure()
{
    TemporaryFolder folder;
    write(folder / "webgl2.html",
          readWhole(kSources + "/examples/webgl2/index.html") + "<script>\n"
              + readWhole(kSources + "/tests/examples_webgl2.js") + "</script>\n");
    std::vector<std::string> pages = {"webgl2.html"};
    const std::string three = COTAN_NPM "/node_modules/three/build/three.module.js";
    if (std::filesystem::exists(three)) {
        writeNpmPage(folder, "three", "three", three);
        writeNpmPage(folder, "three_pictures", "three", three);
        writeOwnNormals(folder);
        pages.insert(pages.end(), {"three.html", "three_pictures.html"});
    }
    const std::string babylon = COTAN_NPM "/node_modules/babylonjs/babylon.js";
    if (std::filesystem::exists(babylon)) {
        writeNpmPage(folder, "babylon", "babylon", babylon);
        pages.push_back("babylon.html");
    }
    return showPages(folder, pages);
}

const json& measured()
{
    static const json found = measure();
    return found;
}

void expectRight(const std::string& label, const json& side)
{
    ASSERT_TRUE(side.contains("worst")) << label << ": " << side;
    EXPECT_GT(side["count"].get<int>(), 5000) << label;
    ASSERT_TRUE(side["worst"].is_number()) << label << ": a normal is not finite"; // JSON writes NaN as null
    EXPECT_LT(side["worst"].get<double>(), kDegrees) << label;
}

TEST(ExampleWebGl2, thePastedTextIsWhatTheToolPrintsToday)
{
    TemporaryFolder folder;
    const ToolRun printed = runTool({"shader", "--lang", "essl"}, folder.path());
    ASSERT_EQ(printed.code, 0) << printed.err;
    EXPECT_NE(readWhole(kSources + "/examples/webgl2/index.html").find("id=\"cotan\">\n" + printed.out + "</script>"),
              std::string::npos)
        << "paste the output of `cotan shader --lang essl` into examples/webgl2/index.html again";
}

TEST(ExampleWebGl2, normalsAreTheSheetsOnBothSidesBothHalvesAndUpsideDown)
{
    if (measured().is_string())
        GTEST_SKIP() << measured().get<std::string>();
    ASSERT_TRUE(measured().contains("webgl2")) << measured();
    const json& page = measured()["webgl2"];
    if (page.contains("skipped"))
        GTEST_SKIP() << page["skipped"];
    for (const char* target : {"upright", "flipped"})
        for (const char* side : {"front", "back"}) {
            ASSERT_TRUE(page.contains(target)) << page;
            expectRight(std::string("webgl2 ") + target + " " + side, page[target][side]);
        }
}

// The text in the file beside an example whose material takes the frame alone.
void expectPrintedToday(const std::string& example)
{
    TemporaryFolder folder;
    const ToolRun printed = runTool({"shader", "--lang", "essl", "--form", "total"}, folder.path());
    ASSERT_EQ(printed.code, 0) << printed.err;
    EXPECT_EQ(readWhole(kSources + "/examples/" + example + "/cotan.glsl"), printed.out)
        << "cotan shader --lang essl --form total -o examples/" + example + "/cotan.glsl";
}

// A frame that is wrong on purpose shows: u reversed turns the domes' slopes, some twenty degrees in the mean, along u.
void expectBroken(const std::string& label, const json& side)
{
    ASSERT_TRUE(side.contains("mean")) << label << ": " << side;
    EXPECT_GT(side["mean"].get<double>(), 10) << label;
}

// Ours is right in every scene, the library's own in those that are not flipped.
void expectRightWhereTheirsIsAndFlipped(const json& page)
{
    ASSERT_TRUE(page.contains("cotan")) << page;
    for (const auto& [scene, ours] : page["cotan"].items()) {
        expectRight(scene, ours);
        const json& stock = page["stock"][scene];
        // Their frames have no sign of their own, so they reverse t and b where y runs down; in mirrors Babylon turns
        // its frame round twice. The domes' mean slope is some twenty degrees, and the error twice that. Should they
        // mend it, the page and this line can go.
        if (scene.starts_with("flipped"))
            EXPECT_GT(stock["mean"].get<double>(), 20) << scene;
        else
            expectRight("their own frame, " + scene, stock);
    }
}

TEST(ExampleThree, thePastedTextIsWhatTheToolPrintsToday) { expectPrintedToday("three"); }

TEST(ExampleThree, cotansFrameIsRightWhereverThreesOwnIsAndInFlippedTargetsToo)
{
    if (measured().is_string())
        GTEST_SKIP() << measured().get<std::string>();
    if (!std::filesystem::exists(COTAN_NPM "/node_modules/three"))
        GTEST_SKIP() << "three is not installed (see the test npm_packages)";
    ASSERT_TRUE(measured().contains("three")) << measured();
    expectRightWhereTheirsIsAndFlipped(measured()["three"]);
    for (const auto& [scene, side] : measured()["three"]["broken"].items()) // with tangents too
        expectBroken("broken, " + scene, side);
    EXPECT_EQ(measured()["three"]["broken"].size(), measured()["three"]["cotan"].size());
}

TEST(ExampleThree, picturesWithCotansFrameAreThreesOwnAndDoNotChangeInFlippedTargets)
{
    if (measured().is_string())
        GTEST_SKIP() << measured().get<std::string>();
    if (!std::filesystem::exists(COTAN_NPM "/node_modules/three"))
        GTEST_SKIP() << "three is not installed (see the test npm_packages)";
    ASSERT_TRUE(measured().contains("three_pictures")) << measured();
    for (const char* side : {"front", "back"}) {
        const json& found = measured()["three_pictures"];
        ASSERT_TRUE(found.contains(side)) << found;
        const json& page = found[side];
        const auto worst = [&](const char* what) { return page[what]["worst"].get<double>(); };
        EXPECT_GT(page["stock and cotan"]["count"].get<int>(), 30000)
            << side;                                    // the sheet covers more than half of 256 x 256
        EXPECT_LE(worst("stock and cotan"), 1) << side; // a colour may lie at the edge between two steps
        EXPECT_LE(worst("cotan upright and y down"), 2)
            << side; // so may it in both; interpolation rounds otherwise there
        // The domes are lit from the other side, or are dents; between them nothing changes.
        EXPECT_GT(page["stock upright and y down"]["mean"].get<double>(), 15) << side;
        EXPECT_GT(page["stock and broken"]["mean"].get<double>(), 3) << side; // less light falls on the back
        expectRight(std::string("three and Cotan's own renderer, ") + side, page["normals"]);
        // A model with tangents, through three's loader.
        for (const char* loaded : {"loaded, stock", "loaded, cotan", "loaded, cotan, y down"})
            expectRight(std::string(loaded) + ", " + side, page[loaded]);
        expectBroken(std::string("loaded, broken, ") + side, page["loaded, broken"]);
    }
}

TEST(ExampleBabylon, thePastedTextIsWhatTheToolPrintsToday) { expectPrintedToday("babylon"); }

TEST(ExampleBabylon, cotansFrameIsRightWhereverBabylonsOwnIsAndInFlippedTargetsAndMirrorsToo)
{
    if (measured().is_string())
        GTEST_SKIP() << measured().get<std::string>();
    if (!std::filesystem::exists(COTAN_NPM "/node_modules/babylonjs"))
        GTEST_SKIP() << "babylonjs is not installed (see the test npm_packages)";
    ASSERT_TRUE(measured().contains("babylon")) << measured();
    expectRightWhereTheirsIsAndFlipped(measured()["babylon"]);
}

} // namespace

} // namespace cotan::test
