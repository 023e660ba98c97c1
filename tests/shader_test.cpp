// The printed shader text gives the same normals in every language, is deterministic, and compiles unchanged.
#include <gtest/gtest.h>

#include <algorithm>

#include "shader_parity.hpp"
#include "shader_run.hpp"

namespace cotan::test {
namespace {

using shader_text::Choice;
using shader_text::Form;
using shader_text::Language;

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
