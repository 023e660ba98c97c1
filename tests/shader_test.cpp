// The printed shader text gives the same normals in every language, is deterministic, and compiles unchanged.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "shader_run.hpp"
#include "truth/patch.hpp"

namespace cotan::test {
namespace {

using shader_text::Choice;
using shader_text::Form;
using shader_text::Language;

// About thirty roundings of 6e-8 each (square roots and inverse square roots count twice), amplified by the
// conditioning of the vectors: 1/sin 30 degrees for positions and again for uv, 1/cos 50 for n, 1/cos 55 for m. In the
// worst case: 30 * 6e-8 * 2 * 2 * 1.6 * 1.7 rad = 1.1e-3 degrees.
constexpr double kFloatDegrees = 1.2e-3;
// The text in C++ double performs the operations of the portable text, except for GLM's order of sums.
constexpr double kDoubleDegrees = 1e-9;
// Fused forms add 1e-12 to m.z (fused.h), 6e-11 degrees; `gradient` adds 1e-15 to m.z times the area of the footprint,
// which is at least about 1e-5 here: 6e-9 degrees.
constexpr double kDoubleFusedDegrees = 1e-8;

// Maximum error in units of `Case::allowance`, the change by one rounding of the result and one of each input: a stable
// evaluation in float is exact for inputs a few roundings away. The loosest function is pow, if the driver computes it
// by exp2 and log2: Vulkan allows log2 an absolute error of 2^-21, 5.5 roundings of the base, and exp2(-9.28) an error
// of 22 units in the last place, 44 roundings. About twenty multiplications and additions follow.
constexpr double kFloatRoundings = 64;
constexpr double kDoubleRoundings = 1e-6; // 2^-29 of a float's roundings, with reserve for kinks

// Differences between interpolated values of drawn pixels. An interpolator that accumulates from the corner of the
// target adds up to 32 rounded differences: a relative error of 32 * 6e-8 for both of each pair. Amplified as above: 2
// * 1.9e-6 * 2 * 2 * 1.6 * 1.7 rad = 2.4e-3 degrees, in addition to kFloatDegrees.
constexpr double kDrawnDegrees = 3.6e-3;

const std::vector<Case>& allCases()
{
    static const std::vector<Case> all = cases();
    return all;
}

const std::vector<Sample>& allSamples()
{
    static const std::vector<Sample> all = samples();
    return all;
}

// WGSL may assume that no number is NaN or infinite, and GLSL ES 3.00 requires support for neither. The printed text
// says so; nothing is promised there.
Kind hardest(const Case& c, const std::string& language)
{
    const bool finiteOnly = language == "wgsl" || language == "essl";
    return finiteOnly && c.last == Kind::nonFinite ? Kind::degenerate : c.last;
}

double degreesApart(glm::dvec3 a, glm::dvec3 b)
{
    const double d = degreesBetween(a, b);
    const bool unit = std::abs(glm::length(a) - 1) < 1e-5; // a few roundings
    return std::isfinite(d) && unit ? d : 180;
}

double worst(const Case& c, const Results& r, std::size_t index)
{
    double largest = 0;
    for (std::size_t s = 0; s < allSamples().size(); ++s)
        if (allSamples()[s].kind <= hardest(c, r.language))
            largest = std::max(largest, degreesApart(r.values[index][s], c.expected(allSamples()[s].v)));
    return largest;
}

// The largest angle from the result before the transform, moved with the object.
double worstMoved(const Case& c, const Results& r, std::size_t index)
{
    double largest = 0;
    for (std::size_t k = 0; k < allSamples().size(); ++k) {
        const Sample& s = allSamples()[k];
        if (s.kind == Kind::moved && s.source == c.moves && (c.anyScale || s.scale == 1))
            largest = std::max(
                largest, degreesApart(r.values[index][k], glm::dvec3(s.mirrored ? -1 : 1, 1, 1) * c.expected(s.from)));
    }
    return largest;
}

struct LightError {
    double relative = 0;  // relative to the largest channel, for roughness of at least kRough
    double glossy = 0;    // the same for lower roughness, where highlights amplify the roundings of n and h
    double roundings = 0; // see kFloatRoundings
};
constexpr float kRough = 0.25f;

LightError worstLight(const Case& c, const Results& r, std::size_t index)
{
    LightError largest;
    for (std::size_t s = 0; s < allSamples().size(); ++s) {
        if (allSamples()[s].kind != Kind::light)
            continue;
        const glm::dvec3 expected = c.expected(allSamples()[s].v), allowed = c.allowance(allSamples()[s].v);
        for (int k = 0; k < 3; ++k) {
            const double error = std::abs(r.values[index][s][k] - expected[k]);
            const double size = std::max({std::abs(expected.x), std::abs(expected.y), std::abs(expected.z)});
            if (error == 0)
                continue;
            // The comparison makes a NaN count as large.
            double& relative = allSamples()[s].v.duvdx.y < kRough ? largest.glossy : largest.relative;
            relative = error / size <= relative ? relative : error / size;
            largest.roundings = error / allowed[k] <= largest.roundings ? largest.roundings : error / allowed[k];
        }
    }
    return largest;
}

void expectLight(const Case& c, const Results& r, std::size_t index)
{
    const LightError largest = worstLight(c, r, index);
    fmt::print("| {:24} | {:10} | {:.1e} relative, glossy {:.1e}, {:.1f} roundings |\n", c.name, r.language,
               largest.relative, largest.glossy, largest.roundings);
    EXPECT_LT(largest.roundings, r.language == "cpp double" ? kDoubleRoundings : kFloatRoundings)
        << r.language << ", " << c.name;
}

void expectParity(const Results& r, const std::vector<Case>& run = allCases())
{
    if (!r.skipped.empty())
        GTEST_SKIP() << r.language << ": " << r.skipped;
    ASSERT_EQ(r.values.size(), run.size());
    for (std::size_t k = 0; k < run.size(); ++k) {
        const Case& c = run[k];
        const bool fused = std::string(c.name).ends_with(", fused");
        const double limit = c.halfs     ? 0.03
            : r.language != "cpp double" ? kFloatDegrees
            : fused                      ? kDoubleFusedDegrees
                                         : kDoubleDegrees;
        if (c.light) {
            expectLight(c, r, k);
            continue;
        }
        const double largest = worst(c, r, k);
        fmt::print("| {:24} | {:10} | {:.1e} |\n", c.name, r.language, largest);
        EXPECT_LT(largest, limit) << r.language << ", " << c.name;
        EXPECT_LT(worstMoved(c, r, k), limit) << r.language << ", " << c.name << ": scaled or mirrored";
    }
}

// The samples above include such input, so all languages run it.
TEST(ShaderParity, framesWithoutTheirInputGiveTheInterpolatedNormal)
{
    int count = 0;
    for (const Case& c : frameCases())
        for (const Sample& s : allSamples())
            if (c.moves && s.kind == Kind::degenerate && s.v.dpdx == glm::vec3(0) && s.v.dpdy == glm::vec3(0)) {
                EXPECT_LT(degreesApart(c.expected(s.v), glm::normalize(glm::dvec3(s.v.n))), kDoubleDegrees) << c.name;
                ++count;
            }
    EXPECT_GE(count, 11 * 16);
}

TEST(ShaderParity, cppFloat) { expectParity(runCpp(allCases(), allSamples(), false)); }
TEST(ShaderParity, cppDouble) { expectParity(runCpp(allCases(), allSamples(), true)); }
TEST(ShaderParity, metalTextAsCpp) { expectParity(runMsl(allCases(), allSamples())); }

// Every frame in each form, and lighting with pow, exp2 and a struct; the remaining cases use nothing else.
TEST(ShaderParity, spirvCrossMetalTextOfTheGlslAsCpp)
{
    std::vector<Case> some = frameCases();
    for (Case& c : litCases())
        if (c.name == "reflect Blinn-Phong" || c.name == "reflect environment")
            some.push_back(std::move(c));
    ASSERT_GT(some.size(), frames().size() + 4);
    expectParity(runSpirvCross(some, allSamples()), some);
}

#ifdef COTAN_WITH_VULKAN
TEST(ShaderParity, glslOnVulkan) { expectParity(runVulkan(allCases(), allSamples(), Language::glsl)); }
TEST(ShaderParity, hlslOnVulkan) { expectParity(runVulkan(allCases(), allSamples(), Language::hlsl)); }
TEST(ShaderParity, godotOnVulkan)
{
    const std::vector<Case> some = godotCases();
    ASSERT_GT(some.size() + 12, allCases().size()); // all except those that pack bits
    expectParity(runVulkan(some, allSamples(), Language::godot), some);
}
#endif
// The y axes of window space and clip space agree in WebGL and Vulkan, and are opposite in WebGPU.
void expectDrawn(const Results& r)
{
    if (!r.skipped.empty())
        GTEST_SKIP() << r.language << ": " << r.skipped;
    const std::vector<Case> drawn = drawnCases();
    const std::vector<Vectors> drawnTiles = tiles();
    ASSERT_EQ(r.values.size(), drawn.size());
    for (std::size_t c = 0; c < drawn.size(); ++c)
        for (int flipped = 0; flipped < 2; ++flipped) {
            const bool along = (flipped == 0) != (r.language == "wgsl");
            double largest = 0;
            for (int row = 0; row < kTarget; ++row)
                for (int column = 0; column < kTarget; ++column) {
                    const int tileRow = (along ? row : kTarget - 1 - row) / kTile;
                    Vectors v = drawnTiles[static_cast<std::size_t>(tileRow * kTiles + column / kTile)];
                    v.dpdy = along ? v.dpdy : -v.dpdy;
                    v.duvdy = along ? v.duvdy : -v.duvdy;
                    const std::size_t pixel = static_cast<std::size_t>((flipped * kTarget + row) * kTarget + column);
                    largest = std::max(largest, degreesApart(r.values[c][pixel], drawn[c].expected(v)));
                }
            fmt::print("| {:24} | {:10} | {:.1e} | drawn, y {} |\n", drawn[c].name, r.language, largest,
                       along ? "along" : "against");
            EXPECT_LT(largest, kDrawnDegrees) << r.language << ", " << drawn[c].name << ", along: " << along;
        }
}

#ifdef COTAN_WITH_VULKAN
TEST(ShaderParity, glslDrawnWithVulkan) { expectDrawn(drawVulkan(drawnCases(), corners(tiles()), Language::glsl)); }
TEST(ShaderParity, hlslDrawnWithVulkan) { expectDrawn(drawVulkan(drawnCases(), corners(tiles()), Language::hlsl)); }
TEST(ShaderParity, godotDrawnWithVulkan) { expectDrawn(drawVulkan(drawnCases(), corners(tiles()), Language::godot)); }
#endif
TEST(ShaderParity, webGl2AndWebGpu)
{
    const BrowserResults r = runBrowser(allCases(), allSamples(), drawnCases(), corners(tiles()));
    expectParity(r.essl);
    expectParity(r.wgsl);
    expectDrawn(r.drawnEssl);
    expectDrawn(r.drawnWgsl);
}

// The cases above leave out no function of lighting, environment, shadow and tone mapping.
TEST(ShaderParity, everyFunctionOfLightIsRun)
{
    std::string run;
    for (const Case& c : litCases())
        run += c.text(Language::glsl);
    Choice choice;
    const std::vector<std::string> without = makeShaderText(choice)->functions;
    choice.sets = {shader_text::Set::light, shader_text::Set::environment, shader_text::Set::tone,
                   shader_text::Set::shadow};
    const std::vector<std::string> with = makeShaderText(choice)->functions;
    EXPECT_GE(with.size(), without.size() + 50);
    for (const std::string& function : with) {
        const bool light = std::find(without.begin(), without.end(), function) == without.end();
        EXPECT_TRUE(!light || run.find(" " + function + "(") != std::string::npos) << function;
    }
}

TEST(ShaderText, isDeterministicAndFreeOfMacros)
{
    for (Language l : shader_text::kLanguages)
        for (const FrameInfo& f : frames()) {
            Choice choice;
            choice.language = l;
            choice.frame = f.frame;
            for (const shader_text::Set set : shader_text::kSets)
                if (hasSet(l, set))
                    choice.sets.push_back(set);
            choice.functionsOnly = f.frame == Frame::exact; // Godot's shaders have no access to edges
            const std::string text = makeShaderText(choice)->text;
            EXPECT_EQ(text, makeShaderText(choice)->text);
            // No macro of the portable text is left.
            EXPECT_EQ(text.find("COTAN_"), std::string::npos) << text.substr(text.find("COTAN_"), 60);
            EXPECT_EQ(text.find("\n#define"), std::string::npos);
        }
}

TEST(ShaderText, onlyWhatIsNeededIsPrinted)
{
    Choice choice;
    choice.frame = Frame::cotangent;
    const auto fused = makeShaderText(choice);
    ASSERT_TRUE(fused);
    EXPECT_EQ(fused->functions,
              (std::vector<std::string>{"cotan_copy_sign", "cotan_expand", "cotan_decode", "cotan_perturb_cotangent",
                                        "cotan_perturb_normal_from_differences", "cotan_perturb_normal"}));
    choice.callerDifferences = true;
    EXPECT_EQ(makeShaderText(choice)->text.find("dFdx("), std::string::npos);
}

TEST(ShaderText, choicesThatAFrameDoesNotSupportAreRefused)
{
    Choice choice;
    choice.frame = Frame::unit;
    choice.form = Form::fused;
    EXPECT_EQ(makeShaderText(choice).error().kind, ErrorKind::usage);
    choice = {};
    choice.uvSets = 5;
    EXPECT_EQ(makeShaderText(choice).error().kind, ErrorKind::usage);
    choice.uvSets = 2;
    choice.frame = Frame::vertex;
    EXPECT_EQ(makeShaderText(choice).error().kind, ErrorKind::usage);
}

// Every set with every frame, in a fragment shader that calls the function that takes derivatives itself.
TEST(ShaderText, everySetCompilesAsAFragmentShader)
{
    TemporaryFolder folder;
    const std::string f = folder.path().string();
    for (Language l : {Language::glsl, Language::essl, Language::hlsl})
        for (const FrameInfo& frame : frames()) {
            Choice choice;
            choice.language = l;
            choice.frame = frame.frame;
            choice.sets = {std::begin(shader_text::kSets), std::end(shader_text::kSets)};
            const bool screen = frame.source == FrameSource::differences;
            const bool hlsl = l == Language::hlsl;
            std::string text = makeShaderText(choice)->text;
            const std::string value = screen ? "cotan_perturb_normal(n, p, uv, n)" : "n";
            if (hlsl)
                text += "float4 main(float3 n : A, float3 p : B, float2 uv : C) : SV_Target { return float4(" + value
                    + ", 1.0); }\n";
            else
                text = (l != Language::glsl                  ? "#version 300 es\nprecision highp float;\n"
                            : frame.frame == Frame::triangle ? "#version 420\n" // has packHalf2x16
                                                             : "#version 330\n")
                    + text + "in vec3 n; in vec3 p; in vec2 uv; out vec4 o;\nvoid main() { o = vec4(" + value
                    + ", 1.0); }\n";
            writeText(folder / "a.frag", text);
            const bool compiled =
                shell(COTAN_GLSLANG_PATH " " + std::string(hlsl ? "-D -V -e main -o '" + f + "/spv' " : "") + "'" + f
                          + "/a.frag'",
                      folder / "log");
            EXPECT_TRUE(compiled) << name(l) << ", " << frame.name << ": " << readWhole(folder / "log");
        }
}

TEST(ShaderCommand, badArgumentsGiveOneLineAndExitCode1)
{
    TemporaryFolder folder;
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"shader"},
          {"shader", "--lang", "cg", "--frame", "cotangent"},
          {"shader", "--lang", "glsl", "--frame", "nothing"},
          {"shader", "--lang", "glsl", "--frame", "unit", "--form", "fused"},
          {"shader", "--lang", "glsl", "--frame", "cotangent", "--preset", "quake"},
          {"shader", "--lang", "glsl", "--frame", "cotangent", "--green", "up"},
          {"shader", "--lang", "glsl", "--frame", "cotangent", "--channels", "4"},
          {"shader", "--lang", "glsl", "--frame", "cotangent", "--uv-sets", "9"},
          {"shader", "--lang", "glsl", "--frame", "cotangent", "--set", "tone,nothing"},
          {"shader", "--lang", "glsl", "--frame", "cotangent", "--functions"},
          {"shader", "--lang", "wgsl", "--frame", "cotangent", "--two-sided"},
          {"shader", "--lang", "godot", "--set", "shadow"},
          {"shader", "--lang", "godot", "--frame", "exact"},
          {"shader", "--lang", "godot", "--frame", "triangle", "--form", "total"},
          {"shader", "--lang", "godot", "--uv-sets", "3"},
          {"shader", "--lang", "godot", "--frame", "triangle", "--stage", "mesh"}}) {
        const ToolRun run = runTool(words, folder.path());
        EXPECT_EQ(run.code, 1) << words.back();
        EXPECT_EQ(lines(run.err), 1) << run.err;
        EXPECT_EQ(run.out, "");
    }
}

// A default would be the wrong frame for most maps, or for the maps of those who bake for it.
TEST(ShaderCommand, aMissingFrameIsAnErrorWithALineForEachKindOfMap)
{
    TemporaryFolder folder;
    const std::vector<std::string> words{"shader", "--lang", "wgsl", "--set", "light", "-o", "a.wgsl"};
    const ToolRun run = runTool(words, folder.path());
    EXPECT_EQ(run.code, 1);
    EXPECT_EQ(run.err,
              "cotan: error: --frame: expected the frame that the normal map was baked for; found none\n"
              "  --frame orthonormal: for maps that were baked for MikkTSpace, as most are\n"
              "  --frame smooth or cotangent: for maps that you bake for this shader\n");
    EXPECT_FALSE(std::filesystem::exists(folder / "a.wgsl"));
    // Godot's text is the material of a model.
    const ToolRun godot = runTool({"shader", "--lang", "godot"}, folder.path());
    EXPECT_EQ(godot.code, 0) << godot.err;
    EXPECT_EQ(godot.out, runTool({"shader", "--lang", "godot", "--frame", "orthonormal"}, folder.path()).out);
    // In C++ the default is the frame for most maps, and what the messages recommend can be printed.
    EXPECT_EQ(makeShaderText(Choice())->text,
              runTool({"shader", "--lang", "glsl", "--frame", "orthonormal"}, folder.path()).out);
}

TEST(ShaderCommand, writesTheCompleteTextAndListsItsFunctions)
{
    TemporaryFolder folder;
    const ToolRun printed = runTool({"shader", "--lang", "wgsl", "--frame", "cotangent"}, folder.path());
    EXPECT_EQ(printed.code, 0) << printed.err;
    const ToolRun written =
        runTool({"shader", "--lang", "wgsl", "--frame", "cotangent", "-o", "a.wgsl", "--json", "-"}, folder.path());
    EXPECT_EQ(written.code, 0) << written.err;
    EXPECT_EQ(readWhole(folder / "a.wgsl"), printed.out);
    EXPECT_NE(written.out.find("\"cotan_perturb_cotangent\""), std::string::npos);
    EXPECT_EQ(
        runTool({"shader", "--lang", "wgsl", "--frame", "cotangent", "-o", "no/such/folder/a.wgsl"}, folder.path())
            .code,
        4);
}

} // namespace
} // namespace cotan::test
