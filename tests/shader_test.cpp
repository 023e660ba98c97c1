// The printed shader text: the same normals in every language, the same bytes every time, and it
// compiles as it stands.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "cotan/truth/patch.hpp"
#include "shader_run.hpp"

namespace cotan::test {
namespace {

using shader_text::Choice;
using shader_text::Form;
using shader_text::Language;

// Some thirty roundings of 6e-8 each (square roots and their inverses count as two), amplified by
// the conditioning of the vectors: 1/sin 30 degrees for positions and again for uv, 1/cos 50 for n,
// 1/cos 55 for m; 30 * 6e-8 * 2 * 2 * 1.6 * 1.7 rad = 1.1e-3 degrees if all conspired.
constexpr double kFloatDegrees = 1.2e-3;
// The text in C++ double is the same operations as the portable text, but for GLM's order of sums;
// the 1e-16 that fused.h adds to m.z is 1e-11 radians beside a determinant of 1e-5.
constexpr double kDoubleDegrees = 1e-9;

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

// WGSL lets an implementation assume that no number is NaN or infinite; GLSL ES 3.00 likewise
// requires neither. The text says so; nothing is promised there.
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
    double most = 0;
    for (std::size_t s = 0; s < allSamples().size(); ++s)
        if (allSamples()[s].kind <= hardest(c, r.language))
            most = std::max(most, degreesApart(r.values[index][s], c.expected(allSamples()[s].v)));
    return most;
}

void expectParity(const Results& r)
{
    if (!r.skipped.empty())
        GTEST_SKIP() << r.language << ": " << r.skipped;
    ASSERT_EQ(r.values.size(), allCases().size());
    const double limit = r.language == "cpp double" ? kDoubleDegrees : kFloatDegrees;
    for (std::size_t k = 0; k < allCases().size(); ++k) {
        const Case& c = allCases()[k];
        const double most = worst(c, r, k);
        fmt::print("| {:24} | {:10} | {:.1e} |\n", c.name, r.language, most);
        EXPECT_LT(most, limit) << r.language << ", " << c.name;
    }
}

TEST(ShaderParity, cppFloat) { expectParity(runCpp(allCases(), allSamples(), false)); }
TEST(ShaderParity, cppDouble) { expectParity(runCpp(allCases(), allSamples(), true)); }
TEST(ShaderParity, metalTextAsCpp) { expectParity(runMsl(allCases(), allSamples())); }
#ifdef COTAN_WITH_VULKAN
TEST(ShaderParity, glslOnVulkan) { expectParity(runVulkan(allCases(), allSamples(), false)); }
TEST(ShaderParity, hlslOnVulkan) { expectParity(runVulkan(allCases(), allSamples(), true)); }
#endif
TEST(ShaderParity, webGl2AndWebGpu)
{
    const auto [essl, wgsl] = runBrowser(allCases(), allSamples());
    expectParity(essl);
    expectParity(wgsl);
}

TEST(ShaderText, theSameChoiceGivesTheSameBytesInEveryLanguage)
{
    for (Language l : shader_text::kLanguages)
        for (const FrameInfo& f : frames()) {
            Choice choice;
            choice.language = l;
            choice.frame = f.frame;
            choice.gradients = choice.blends = choice.lights = true;
            const std::string text = makeShaderText(choice)->text;
            EXPECT_EQ(text, makeShaderText(choice)->text);
            // No macro of the portable text is left, no line is too wide for a page.
            EXPECT_EQ(text.find("COTAN_"), std::string::npos) << text.substr(text.find("COTAN_"), 60);
            EXPECT_EQ(text.find("\n#define"), std::string::npos);
        }
}

TEST(ShaderText, onlyWhatIsNeededIsPrinted)
{
    Choice choice;
    const auto fused = makeShaderText(choice);
    ASSERT_TRUE(fused);
    EXPECT_EQ(fused->functions,
              (std::vector<std::string>{"cotan_copy_sign", "cotan_expand", "cotan_decode", "cotan_perturb_cotangent",
                                        "cotan_perturb_normal_from_differences", "cotan_perturb_normal"}));
    choice.callerDifferences = true;
    EXPECT_EQ(makeShaderText(choice)->text.find("dFdx("), std::string::npos);
}

TEST(ShaderText, whatAFrameDoesNotHaveIsRefused)
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

// Every set with every frame, as a fragment shader that calls the function with derivatives.
TEST(ShaderText, everySetCompilesAsAFragmentShader)
{
    TemporaryFolder folder;
    const std::string f = folder.path().string();
    for (Language l : {Language::glsl, Language::essl, Language::hlsl})
        for (const FrameInfo& frame : frames()) {
            Choice choice;
            choice.language = l;
            choice.frame = frame.frame;
            choice.gradients = choice.blends = choice.lights = true;
            const bool screen = frame.source == FrameSource::differences;
            const bool hlsl = l == Language::hlsl;
            std::string text = makeShaderText(choice)->text;
            const std::string value = screen ? "cotan_perturb_normal(n, p, uv, n)" : "n";
            if (hlsl)
                text += "float4 main(float3 n : A, float3 p : B, float2 uv : C) : SV_Target { return float4(" + value
                    + ", 1.0); }\n";
            else
                text = (l == Language::glsl ? "#version 330\n" : "#version 300 es\nprecision highp float;\n") + text
                    + "in vec3 n; in vec3 p; in vec2 uv; out vec4 o;\nvoid main() { o = vec4(" + value + ", 1.0); }\n";
            writeText(folder / "a.frag", text);
            const bool compiled =
                shell(COTAN_GLSLANG_PATH " " + std::string(hlsl ? "-D -V -e main -o '" + f + "/spv' " : "") + "'" + f
                          + "/a.frag'",
                      folder / "log");
            EXPECT_TRUE(compiled) << name(l) << ", " << frame.name << ": " << readWhole(folder / "log");
        }
}

TEST(ShaderCommand, badWordsGetOneLineAndExitCode1)
{
    TemporaryFolder folder;
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"shader"},
          {"shader", "--lang", "cg"},
          {"shader", "--lang", "glsl", "--frame", "nothing"},
          {"shader", "--lang", "glsl", "--frame", "unit", "--form", "fused"},
          {"shader", "--lang", "glsl", "--preset", "quake"},
          {"shader", "--lang", "glsl", "--green", "up"},
          {"shader", "--lang", "glsl", "--channels", "4"},
          {"shader", "--lang", "glsl", "--uv-sets", "9"},
          {"shader", "--lang", "glsl", "--set", "nothing"}}) {
        const ToolRun run = runTool(words, folder.path());
        EXPECT_EQ(run.code, 1) << words.back();
        EXPECT_EQ(lines(run.err), 1) << run.err;
        EXPECT_EQ(run.out, "");
    }
}

TEST(ShaderCommand, writesTheTextWholeAndListsItsFunctions)
{
    TemporaryFolder folder;
    const ToolRun printed = runTool({"shader", "--lang", "wgsl"}, folder.path());
    EXPECT_EQ(printed.code, 0) << printed.err;
    const ToolRun written = runTool({"shader", "--lang", "wgsl", "-o", "a.wgsl", "--json", "-"}, folder.path());
    EXPECT_EQ(written.code, 0) << written.err;
    EXPECT_EQ(readWhole(folder / "a.wgsl"), printed.out);
    EXPECT_NE(written.out.find("\"cotan_perturb_cotangent\""), std::string::npos);
    EXPECT_EQ(runTool({"shader", "--lang", "wgsl", "-o", "no/such/folder/a.wgsl"}, folder.path()).code, 4);
}

} // namespace
} // namespace cotan::test
