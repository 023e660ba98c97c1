// The recipes of docs/how-to/sparkle.md, as they stand there: run in three.js and Godot 3, compiled for Bevy and
// Filament with the names that these declare.
#include <gtest/gtest.h>

#include <cmath>

#include "cotan/portable.hpp"
#include "examples_browser.hpp"
#include "godot_draw.hpp"

namespace cotan::test {
namespace {

// The block of the page in a language, and the text that the page's command for it prints.
std::string recipe(const std::string& language)
{
    const std::string page = readWhole(COTAN_SOURCE_DIR "/docs/how-to/sparkle.md"), mark = "```" + language + '\n';
    const std::size_t begin = page.find(mark);
    EXPECT_NE(begin, std::string::npos) << language;
    return page.substr(begin + mark.size(), page.find("```", begin + mark.size()) - begin - mark.size());
}

std::string printed(const std::string& language)
{
    const std::string page = readWhole(COTAN_SOURCE_DIR "/docs/how-to/sparkle.md"), start = "cotan shader --lang ";
    const std::size_t begin = page.find(start + language), end = page.find(" -o ", begin);
    EXPECT_NE(begin, std::string::npos) << language;
    std::istringstream line(page.substr(begin, end - begin));
    std::vector<std::string> words(std::istream_iterator<std::string>(line), {});
    words.erase(words.begin());
    TemporaryFolder folder;
    const ToolRun run = runTool(words, folder.path());
    EXPECT_EQ(run.code, 0) << run.err;
    return run.out;
}

// A filtered texel along z, so short that half of its directions are lost: (0, 0, 64) / 127.
constexpr int kTexel[] = {128, 128, 192};
constexpr double kLength = 64.0 / 127;

double roughnessOf(double curvature)
{
    return f64::cotan_roughness_of_variance(0.3, curvature + f64::cotan_variance_of_length(kLength));
}

TEST(Recipes, threeGetsTheVarianceOfTheMapAndOfTheSurfaceAndBevysTextCompiles)
{
    if (!std::filesystem::exists(COTAN_NPM "/node_modules/three"))
        GTEST_SKIP() << "three is not installed (see the test npm_packages)";
    TemporaryFolder folder;
    const std::string wgsl = printed("wgsl") + R"(
struct Inputs { @location(0) world_normal: vec3f, @location(1) uv: vec2f }
struct StandardMaterial { perceptual_roughness: f32 }
struct PbrInput { material: StandardMaterial }
@group(0) @binding(0) var normal_map_texture: texture_2d<f32>;
@group(0) @binding(1) var normal_map_sampler: sampler;
@fragment fn fragment(in: Inputs) -> @location(0) vec4f {
    var pbr_input = PbrInput(StandardMaterial(0.3));
)" + recipe("wgsl")
        + "    return vec4f(pbr_input.material.perceptual_roughness);\n}\n";
    std::string page = readWhole(COTAN_SOURCE_DIR "/tests/recipes_three.html.in");
    put(page, "MODULES_URL", "file://" COTAN_NPM "/node_modules");
    put(page, "TESTS_URL", "file://" COTAN_SOURCE_DIR "/tests");
    put(page, "RECIPE", recipe("js"));
    put(page, "TEXT", nlohmann::json(printed("essl")).dump());
    put(page, "TEXEL", nlohmann::json(kTexel).dump());
    put(page, "WGSL", nlohmann::json(wgsl).dump());
    write(folder / "recipes.html", page);
    const nlohmann::json all = showPages(folder, {"recipes.html"});
    if (all.is_string())
        GTEST_SKIP() << all.get<std::string>();
    const nlohmann::json found = all.value("recipes", all);
    ASSERT_TRUE(found.contains("sphere")) << found.dump();
    EXPECT_NEAR(found["plane"].get<double>(), roughnessOf(0), 1e-5);
    // A sphere of 128 pixels: normals change by 1 / 128 a pixel along x and y. 256 segments are 0.3 % off, and the
    // pixel beside the middle less.
    const double curvature = 2.0 / (128 * 128) / 12, added = roughnessOf(curvature) - roughnessOf(0);
    EXPECT_NEAR(found["sphere"].get<double>() - found["plane"].get<double>(), added, 0.03 * added + 1e-7);
    EXPECT_EQ(found["wgsl"].get<std::string>(), "");
}

TEST(Recipes, godotGetsTheVarianceOfTheMap)
{
    if (std::system("command -v godot3 > /dev/null && command -v xvfb-run > /dev/null") != 0)
        GTEST_SKIP() << "no godot3 or xvfb-run";
    GodotJobs jobs;
    const nlohmann::json map = jobs.texture({char(kTexel[0]), char(kTexel[1]), char(kTexel[2]), char(255)}, 1, 1);
    const nlohmann::json more = {{"textures", {{"normal_map", map}}}};
    const std::string whole = "shader_type spatial;\n" + printed("godot") + recipe("gdshader");
    jobs.add(whole, 8, 8, 1, more);
    std::string shown = whole; // the roughness as a colour
    put(shown, "shader_type spatial;\n", "shader_type spatial;\nrender_mode unshaded;\n");
    put(shown, "\tNORMAL = ", "\tALBEDO = vec3(ROUGHNESS);\n\tNORMAL = ");
    jobs.add(shown, 8, 8, 1, more);
    const std::vector<std::string> images = jobs.draw("GLES3");
    EXPECT_NEAR(double(static_cast<unsigned char>(images[1][3 * 36])), 255 * roughnessOf(0), 1); // rounding of colours
}

TEST(Recipes, filamentsTextCompiles)
{
    TemporaryFolder folder;
    write(folder / "filament.frag",
          "#version 310 es\nprecision highp float;\n" + printed("essl") + R"(
struct MaterialInputs { vec3 normal; float roughness; };
struct Parameters { float roughness; };
uniform highp sampler2D materialParams_normalMap;
layout(location = 0) uniform Parameters materialParams;
in highp vec2 vertex_uv01;
in highp vec3 vertex_worldNormal;
out vec4 color;
vec2 getUV0() { return vertex_uv01; }
vec3 getWorldGeometricNormalVector() { return normalize(vertex_worldNormal); }
void prepareMaterial(MaterialInputs material) {}
)" + recipe("glsl")
              + R"(
void main()
{
    MaterialInputs inputs = MaterialInputs(vec3(0.0), 0.0);
    material(inputs);
    color = vec4(inputs.normal, inputs.roughness);
}
)");
    const std::string log = (folder / "log").string();
    if (std::system("command -v glslangValidator > /dev/null") != 0)
        GTEST_SKIP() << "no glslangValidator";
    EXPECT_EQ(
        std::system(("glslangValidator '" + (folder / "filament.frag").string() + "' > '" + log + "' 2>&1").c_str()), 0)
        << readWhole(log);
}

} // namespace
} // namespace cotan::test
