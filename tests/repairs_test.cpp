// The repairs of web engines in examples/, run in headless Chromium beside the engines' own code from their npm
// packages.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "examples_browser.hpp"

namespace cotan::test {
namespace {

using nlohmann::json;

const std::string kRepairSources = COTAN_SOURCE_DIR;
const std::filesystem::path kModules = COTAN_NPM "/node_modules";

// As for the examples: float differences of a pixel of at least 2e-3 of the distance to the eye.
constexpr double kRepaired = 0.01;

// Copies the files that the patch changes to folder/node_modules and applies the patch there.
void applyPatch(const TemporaryFolder& folder, const std::string& patch)
{
    std::istringstream lines(readWhole(patch));
    for (std::string line; std::getline(lines, line);) {
        const std::string head = "--- a/node_modules/";
        if (!line.starts_with(head))
            continue;
        const std::filesystem::path file = line.substr(head.size()), copy = folder / ("node_modules/" + file.string());
        std::filesystem::create_directories(copy.parent_path());
        std::filesystem::copy_file(kModules / file, copy);
    }
    const std::string line = "patch --batch --silent -p1 -d '" + folder.path().string() + "' < '" + patch + "' > '"
        + (folder / "said").string() + "'";
    ASSERT_EQ(std::system(line.c_str()), 0) << patch << ": " << readWhole(folder / "said");
}

// The report of tests/NAME.html.in, or a string with the reason why it cannot run.
json repairPage(const std::string& name, const std::vector<std::string>& packages,
                const std::vector<std::string>& patches)
{
    for (const std::string& package : packages)
        if (!std::filesystem::exists(kModules / package))
            return package + " is not installed (see the test npm_packages)";
    if (!patches.empty() && std::system("command -v patch > /dev/null 2>&1") != 0)
        return "no patch";
    TemporaryFolder folder;
    for (const std::string& patch : patches)
        applyPatch(folder, kRepairSources + "/examples/" + patch);
    std::string page = readWhole(kRepairSources + "/tests/" + name + ".html.in");
    put(page, "MODULES_URL", "file://" + kModules.string());
    put(page, "FIXED_URL", "file://" + (folder / "node_modules").string());
    put(page, "SOURCES_URL", "file://" + kRepairSources);
    put(page, "TESTS_URL", "file://" + kRepairSources + "/tests");
    write(folder / (name + ".html"), page);
    const json found = showPages(folder, {name + ".html"});
    return found.value(name, found);
}

// Expects that stock has a mean error above the degrees in `wrong` in those scenes (0: not finite) and is right in the
// others; that fixed is right except in the scenes of `left`.
void expectRepair(const std::string& label, const json& stock, const json& fixed,
                  const std::map<std::string, double>& wrong, const std::set<std::string>& left = {})
{
    ASSERT_FALSE(stock.empty()) << label;
    ASSERT_EQ(stock.size(), fixed.size()) << label;
    for (const auto& [scene, found] : stock.items()) {
        const std::string what = label + ", " + scene;
        ASSERT_TRUE(found.contains("count")) << what << ": " << found;
        EXPECT_GT(found["count"].get<int>(), 5000) << what;
        const bool finite = found["mean"].is_number();
        if (!wrong.contains(scene)) {
            ASSERT_TRUE(finite) << what << ", stock";
            EXPECT_LT(found["worst"].get<double>(), kRepaired) << what << ", stock";
        } else if (wrong.at(scene) == 0) {
            EXPECT_FALSE(finite) << what << ", stock";
        } else {
            ASSERT_TRUE(finite) << what << ", stock";
            EXPECT_GT(found["mean"].get<double>(), wrong.at(scene)) << what << ", stock";
        }
        const json& ours = fixed[scene];
        ASSERT_TRUE(ours["worst"].is_number()) << what << ", fixed: a normal is not finite";
        if (!left.contains(scene)) {
            EXPECT_LT(ours["worst"].get<double>(), kRepaired) << what << ", fixed";
        }
    }
    for (const auto& [scene, degrees] : wrong)
        EXPECT_TRUE(stock.contains(scene)) << label << ": " << scene;
}

// Each half of the image of two materials shows its own map.
void expectTwoMaps(const json& page, const std::string& what)
{
    ASSERT_TRUE(page.contains(what)) << what;
    for (const json& degrees : page[what]) {
        ASSERT_TRUE(degrees.is_number()) << what;
        EXPECT_LT(degrees.get<double>(), kRepaired) << what << ": " << page[what];
    }
}

TEST(Repairs, playCanvasPatchFixesMirroringAndOneSidedBackFaces)
{
    const json page = repairPage("repair_playcanvas", {"playcanvas"}, {});
    if (page.is_string())
        GTEST_SKIP() << page.get<std::string>();
    ASSERT_TRUE(page.contains("webgl2 stock")) << page;
    const std::string coat = "coat on uv set 1, bumps on set 0"; // both use one frame: not fixed
    for (const std::string device : {"webgl2", "webgpu"})
        if (page.contains(device + " stock")) { // not in a Chromium without WebGPU
            expectTwoMaps(page, device + " two materials, stock");
            expectTwoMaps(page, device + " two materials, cotan");
            expectRepair(device, page[device + " stock"], page[device + " cotan"],
                         {{"back, one-sided lighting", 30},
                          {"projection with y down", 30},
                          {"projection with y down, back", 30},
                          {coat, 20}},
                         {coat});
        }
}

TEST(Repairs, patchesFixCesiumLumaAndPex)
{
    const json page = repairPage("repair_functions", {"@cesium/engine", "@luma.gl/shadertools", "pex-renderer"},
                                 {"cesium/@cesium+engine+26.3.0.patch", "luma/@luma.gl+shadertools+9.4.2.patch",
                                  "pex/pex-renderer+3.0.0-44.patch"});
    if (page.is_string())
        GTEST_SKIP() << page.get<std::string>();
    ASSERT_TRUE(page.contains("cesium stock")) << page;
    // Half of the sheet is mirrored and has reversed bitangents, so the mean error is halved.
    const std::map<std::string, double> mirrored = {
        {"mirrored half", 20}, {"mirrored transform", 10}, {"back", 10},   {"stretched", 10},
        {"sheared", 10},       {"seen at 60 degrees", 10}, {"y down", 10}, {"constant texture coordinates", 0}};
    const auto repaired = [&](const std::string& what, const std::map<std::string, double>& wrong) {
        ASSERT_TRUE(page.contains(what + " stock")) << page;
        expectRepair(what, page[what + " stock"], page[what + " fixed"], wrong);
    };
    for (const char* what : {"cesium", "cesium, anisotropy", "cesium, clear coat", "luma"})
        repaired(what, mirrored);
    if (page.contains("luma on WebGPU stock"))
        repaired("luma on WebGPU", mirrored);
    for (const char* what : {"cesium", "cesium, anisotropy", "cesium, clear coat", "luma", "pex", "pex, clear coat"})
        expectTwoMaps(page, std::string("two maps, ") + what);
    // pex normalises the view vector before it takes differences: wrong everywhere, most at grazing angles. Unit
    // lengths fail if uv are stretched; y down reverses t and b.
    for (const char* what : {"pex", "pex, clear coat"})
        repaired(what,
                 {{"plain half", 1},
                  {"plain half, back", 0.5},
                  {"plain half, y down", 30},
                  {"mirrored half", 0.5},
                  {"mirrored transform", 0.5},
                  {"back", 0.5},
                  {"stretched", 5},
                  {"sheared", 1},
                  {"seen at 60 degrees", 4},
                  {"y down", 30},
                  {"constant texture coordinates", 0}});
}

} // namespace

} // namespace cotan::test
