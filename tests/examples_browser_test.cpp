// The pages of examples/ in headless Chromium: the pasted text is what the tool prints today, and the normals are
// those of the analytic surface. One launch shows all pages.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "run_tool.hpp"

namespace cotan::test {
namespace {

using nlohmann::json;

const std::string kSources = COTAN_SOURCE_DIR;

// Float differences of a pixel: the pixel is 4e-3 of the distance to the eye in every page, where the text's own
// introduction promises 0.002 degrees at 1e-3; times five for the slopes of up to 53 degrees.
constexpr double kDegrees = 0.01;

void write(const std::filesystem::path& file, const std::string& text)
{
    std::ofstream(file, std::ios::binary) << text;
}

// What the pages report, by page; a string that says why where they cannot run.
json measure()
{
    if (std::system("command -v chromium > /dev/null 2>&1") != 0)
        return "no chromium";
    TemporaryFolder folder;
    write(folder / "webgl2.html", readWhole(kSources + "/examples/webgl2/index.html") + "<script>\n"
              + readWhole(kSources + "/tests/examples_webgl2.js") + "</script>\n");
    const json pages{"webgl2.html"};
    std::string harness = readWhole(kSources + "/tests/examples_harness.html.in");
    harness.replace(harness.find("PAGES"), 5, pages.dump());
    write(folder / "all.html", harness);
    const std::string f = folder.path().string();
    const std::string line = "timeout 120 chromium --headless --no-sandbox --allow-file-access-from-files --user-data-dir='"
        + f + "/profile' --use-angle=swiftshader --enable-unsafe-swiftshader --dump-dom 'file://" + f + "/all.html' > '"
        + f + "/dom' 2> '" + f + "/log'";
    const int code = std::system(line.c_str());
    const std::string dom = readWhole(folder / "dom");
    const std::size_t begin = dom.find("\">RESULT"), end = dom.find("END<", begin);
    if (begin == std::string::npos || end == std::string::npos)
        return {{"error", "chromium printed no result, exit " + std::to_string(code) + ": " + dom.substr(0, 80)}};
    return json::parse(dom.substr(begin + 8, end - begin - 8));
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

} // namespace
} // namespace cotan::test
