// The pages of examples/ in headless Chromium, all in one launch: the pasted text equals the tool's present output, and
// normals are those of the analytic surface.
#include <gtest/gtest.h>

#include "examples_browser.hpp"

namespace cotan::test {
namespace {

using nlohmann::json;

const std::string kSources = COTAN_SOURCE_DIR;

// Error of float differences: a pixel is at least 2e-3 of the distance to the eye. The text's own introduction promises
// 0.002 degrees at 1e-3; times five for slopes of up to 53 degrees.
constexpr double kDegrees = 0.01;

// Writes tests/examples_NAME.html.in with its addresses filled in, for an example that uses an npm package.
void writeNpmPage(const TemporaryFolder& folder, const std::string& name, const std::string& example,
                  const std::string& library)
{
    std::string page = readWhole(kSources + "/tests/examples_" + name + ".html.in");
    put(page, "COTAN;", json(readWhole(kSources + "/examples/" + example + "/cotan.glsl")).dump() + ";");
    put(page, "LIBRARY_URL", "file://" + library);
    put(page, "TESTS_URL", "file://" + kSources + "/tests");
    put(page, "EXAMPLE_URL", "file://" + kSources + "/examples/" + example);
    write(folder / (name + ".html"), page);
}

// The reports of all pages, by page; or a string with the reason if they cannot run.
json measure()
{
    TemporaryFolder folder;
    write(folder / "webgl2.html",
          readWhole(kSources + "/examples/webgl2/index.html") + "<script>\n"
              + readWhole(kSources + "/tests/examples_webgl2.js") + "</script>\n");
    std::vector<std::string> pages = {"webgl2.html"};
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
    const ToolRun printed = runTool({"shader", "--lang", "essl", "--frame", "cotangent"}, folder.path());
    ASSERT_EQ(printed.code, 0) << printed.err;
    EXPECT_NE(readWhole(kSources + "/examples/webgl2/index.html").find("id=\"cotan\">\n" + printed.out + "</script>"),
              std::string::npos)
        << "paste the output of `cotan shader --lang essl --frame cotangent` into examples/webgl2/index.html again";
}

TEST(ExampleWebGl2, normalsMatchTheSheetOnBothSidesAndUpsideDown)
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

// The text in the file beside an example whose material uses only the frame.
void expectPrintedToday(const std::string& example)
{
    TemporaryFolder folder;
    const ToolRun printed =
        runTool({"shader", "--lang", "essl", "--frame", "cotangent", "--form", "total"}, folder.path());
    ASSERT_EQ(printed.code, 0) << printed.err;
    EXPECT_EQ(readWhole(kSources + "/examples/" + example + "/cotan.glsl"), printed.out)
        << "cotan shader --lang essl --frame cotangent --form total -o examples/" + example + "/cotan.glsl";
}

// Cotan's frame is right in every scene, the library's own in those that are not flipped.
void expectRightWhereTheirsIsAndFlipped(const json& page)
{
    ASSERT_TRUE(page.contains("cotan")) << page;
    for (const auto& [scene, ours] : page["cotan"].items()) {
        expectRight(scene, ours);
        const json& stock = page["stock"][scene];
        // Their frames have no handedness of their own, so they reverse t and b where y points down; in mirrors Babylon
        // reverses its frame twice. The domes' mean slope is about twenty degrees, and the error twice that. If they
        // fix it, this line and the page's note can go.
        if (scene.starts_with("flipped"))
            EXPECT_GT(stock["mean"].get<double>(), 20) << scene;
        else
            expectRight("their own frame, " + scene, stock);
    }
}

TEST(ExampleBabylon, thePastedTextIsWhatTheToolPrintsToday) { expectPrintedToday("babylon"); }

TEST(ExampleBabylon, cotansFrameIsRightEvenInFlippedTargetsAndMirrors)
{
    if (measured().is_string())
        GTEST_SKIP() << measured().get<std::string>();
    if (!std::filesystem::exists(COTAN_NPM "/node_modules/babylonjs"))
        GTEST_SKIP() << "babylonjs is not installed (see the test npm_packages)";
    ASSERT_TRUE(measured().contains("babylon")) << measured();
    expectRightWhereTheirsIsAndFlipped(measured()["babylon"]);
    EXPECT_EQ(measured()["babylon"]["two materials"].size(), 4u);
    for (const auto& [way, halves] : measured()["babylon"]["two materials"].items())
        for (const json& degrees : halves)
            EXPECT_LT(degrees.get<double>(), kDegrees) << way << ": each half shows its own map: " << halves;
}

} // namespace

} // namespace cotan::test
