// Expected output for small texts and single options, written by hand. The parity tests compile and run everything, but
// are slow and miss an error that all languages share.
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <string>

#include "cotan/shader_text.hpp"
#include "languages.hpp"
#include "syntax.hpp"

namespace cotan::shader_text {
namespace {

bool has(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

std::string textOf(const Choice& choice)
{
    const auto text = makeShaderText(choice);
    EXPECT_TRUE(text) << (text ? "" : text.error().message);
    return text ? text->text : "";
}

// ---- forms of cotangent -----------------------------------------------------------------------

TEST(ShaderForms, seenTakesTheSideAsAnArgument)
{
    for (const Language language : kLanguages) {
        Choice choice;
        choice.language = language;
        choice.frame = Frame::cotangent;
        choice.form = Form::seen;
        const auto made = makeShaderText(choice);
        ASSERT_EQ(bool(made), language != Language::godot) << name(language);
        if (!made)
            continue;
        EXPECT_EQ(std::ranges::count(made->functions, "cotan_perturb_cotangent_seen"), 1) << name(language);
        EXPECT_TRUE(has(made->text, ", side)")) << name(language);
        EXPECT_TRUE(has(made->text, "-1 where rows of pixels run down (Vulkan, Direct3D, Metal, WebGPU)"));
        EXPECT_FALSE(has(made->text, "no uniform and no front-face flag"));
    }
}

TEST(ShaderForms, areaHasTheArgumentsOfTheFrame)
{
    Choice choice;
    choice.frame = Frame::cotangent;
    choice.form = Form::area;
    EXPECT_TRUE(has(textOf(choice), "cotan_perturb_cotangent_area(normal, dpdx, dpdy, duvdx, duvdy, m)"));
    EXPECT_FALSE(has(textOf(choice), "side)"));
}

TEST(ShaderForms, seenAndAreaRequireCotangentOverOneUvSet)
{
    for (const Form form : {Form::seen, Form::area})
        for (const auto& [frame, sets] : {std::pair{Frame::gradient, 1}, {Frame::triangle, 1}, {Frame::cotangent, 2}}) {
            Choice choice;
            choice.frame = frame;
            choice.uvSets = sets;
            choice.form = form;
            const auto made = makeShaderText(choice);
            ASSERT_FALSE(made);
            EXPECT_TRUE(has(made.error().message, "the form " + std::string(name(form)))) << made.error().message;
        }
}

TEST(ShaderForms, theErrorOnASphereIsStatedOnlyForCotangent)
{
    Choice choice;
    choice.frame = Frame::cotangent;
    EXPECT_TRUE(has(textOf(choice), "1.1 degrees in the mean"));
    choice.frame = Frame::gradient;
    EXPECT_FALSE(has(textOf(choice), "1.1 degrees"));
    EXPECT_TRUE(has(textOf(choice), "it steps at"));
}

// ---- the preprocessor -----------------------------------------------------------------------

TEST(PreprocessedText, oneBranchOfAChainIsRead)
{
    const char* const text =
        "#if defined(COTAN_LANG_GLSL)\nglsl\n#elif defined(COTAN_LANG_CPP)\ncpp\n#else\nother\n#endif\nall\n";
    EXPECT_EQ(preprocess(text, "COTAN_LANG_GLSL").text, "glsl\nall\n");
    EXPECT_EQ(preprocess(text, "COTAN_LANG_CPP").text, "cpp\nall\n");
    EXPECT_EQ(preprocess(text, "COTAN_LANG_HLSL").text, "other\nall\n");
}

TEST(PreprocessedText, branchesInsideSkippedOnesAreSkipped)
{
    const char* const text = "#ifndef GUARD\n#if defined(COTAN_LANG_CPP)\n#if "
                             "defined(COTAN_LANG_GLSL)\ninner\n#endif\n#else\nouter\n#endif\n#endif\n";
    EXPECT_EQ(preprocess(text, "COTAN_LANG_GLSL").text, "outer\n");
}

TEST(PreprocessedText, constantsHaveTheCotanPrefixAndAValue)
{
    const auto found =
        preprocess("#define COTAN_HUGE cotan_real(1e37) // why\n#define COTAN_FUNCTION inline\n#define COTAN_ON\n"
                   "#define cotan_mix mix\n",
                   "COTAN_LANG_GLSL");
    ASSERT_EQ(found.constants.size(), 1u);
    EXPECT_EQ(found.constants.begin()->first, "COTAN_HUGE");
    EXPECT_EQ(found.constants.begin()->second.substr(0, 16), "cotan_real(1e37)");
}

// ---- one small function in each language ----------------------------------------------------

const char* const kSmall = "COTAN_FUNCTION cotan_real half_or_less(cotan_real x, cotan_real y)\n{\n"
                           "    x = x * cotan_real(0.5);\n"
                           "    cotan_vec2 v = cotan_vec2(x, y);\n"
                           "    return x < y ? v.x : v.y;\n}\n";

TEST(PrintedText, glslHlslAndMetalDifferInSpelling)
{
    EXPECT_TRUE(has(translate(Language::glsl, kSmall),
                    "float half_or_less(float x, float y)\n{\n    x = x * 0.5;\n"
                    "    vec2 v = vec2(x, y);\n    return x < y ? v.x : v.y;\n}\n"));
    EXPECT_TRUE(has(translate(Language::hlsl, kSmall), "    float2 v = float2(x, y);\n"));
    EXPECT_TRUE(
        has(translate(Language::msl, kSmall), "inline float half_or_less(float x, float y)\n{\n    x = x * 0.5f;\n"));
}

TEST(PrintedText, wgslCopiesAssignedParametersAndReversesSelect)
{
    const std::string text = translate(Language::wgsl, kSmall);
    EXPECT_TRUE(has(text,
                    "fn half_or_less(x_in: f32, y: f32) -> f32 {\n    var x = x_in;\n    x = x * 0.5;\n"
                    "    let v = vec2f(x, y);\n    return select(v.y, v.x, x < y);\n}\n"))
        << text;
}

TEST(PrintedText, structsAreIncludedOnlyIfUsed)
{
    const char* const text =
        "struct cotan_two {\n    cotan_real a; // first\n    cotan_real b; // second\n};\n"
        "COTAN_FUNCTION cotan_real first_of(cotan_real x)\n{\n    cotan_two t;\n    t.a = x;\n    return t.a;\n}\n";
    EXPECT_TRUE(has(translate(Language::glsl, text), "struct cotan_two"));
    EXPECT_FALSE(has(translate(Language::glsl, kSmall), "struct")) << "one that nothing uses";
}

// ---- without structs ------------------------------------------------------------------------

const char* const kPair = "struct cotan_two {\n    cotan_real a;\n    cotan_vec3 b;\n};\n";

TEST(WithoutStructs, resultsBecomeOutParametersAndFieldsBecomeVariables)
{
    const std::string text = std::string(kPair)
        + "COTAN_FUNCTION cotan_two two_of(cotan_real x)\n{\n    // first\n    cotan_two t;\n    t.a = x;\n"
          "    t.b = cotan_vec3(x, x, x);\n    return t;\n}\n"
          "COTAN_FUNCTION cotan_real sum_of(cotan_two t)\n{\n    return t.a + t.b.x;\n}\n"
          "COTAN_FUNCTION cotan_real both(cotan_real x)\n{\n    return sum_of(two_of(x)) + two_of(x * x).b.y;\n}\n"
          "COTAN_FUNCTION cotan_two again(cotan_real x)\n{\n    if (x < cotan_real(0.0))\n        return two_of(-x);\n"
          "    cotan_two s = two_of(x);\n    cotan_two u = s;\n    u = two_of(u.a);\n    return u;\n}\n";
    EXPECT_EQ(translate(Language::godot, text),
              "void two_of(float x, out float t_a, out vec3 t_b)\n{\n"
              "    t_a = x;\n    t_b = vec3(x, x, x);\n}\n\n"
              "float sum_of(float t_a, vec3 t_b)\n{\n    return t_a + t_b.x;\n}\n\n"
              "float both(float x)\n{\n    float two_a;\n    vec3 two_b;\n    two_of(x, two_a, two_b);\n"
              "    float two_too_a;\n    vec3 two_too_b;\n    two_of(x * x, two_too_a, two_too_b);\n"
              "    return sum_of(two_a, two_b) + two_too_b.y;\n}\n\n"
              "void again(float x, out float result_a, out vec3 result_b)\n{\n"
              "    if (x < 0.0) {\n        two_of(-x, result_a, result_b);\n        return;\n    }\n"
              "    float s_a;\n    vec3 s_b;\n    two_of(x, s_a, s_b);\n"
              "    float u_a;\n    vec3 u_b;\n    u_a = s_a;\n    u_b = s_b;\n    two_of(u_a, u_a, u_b);\n"
              "    result_a = u_a;\n    result_b = u_b;\n}\n");
}

// A local variable that is returned early is also replaced by the output parameters.
TEST(WithoutStructs, earlyReturnsEndTheFunction)
{
    const std::string text = std::string(kPair)
        + "COTAN_FUNCTION cotan_two early(cotan_real x)\n{\n    cotan_two t;\n    t.a = x;\n    t.b = cotan_vec3(x, x, "
          "x);\n"
          "    if (x < cotan_real(0.0))\n        return t;\n    t.a = x * x;\n    return t;\n}\n";
    EXPECT_TRUE(
        has(translate(Language::godot, text), "    if (x < 0.0) {\n        return;\n    }\n    t_a = x * x;\n}\n"));
}

TEST(WithoutStructs, nameClashesAndConditionalStructsAreRefused)
{
    const std::string start =
        std::string(kPair) + "COTAN_FUNCTION cotan_real f(cotan_two t, cotan_two s, cotan_real x)\n{\n";
    EXPECT_THROW(translate(Language::godot, start + "    cotan_real t_a = x;\n    return t_a;\n}\n"),
                 std::runtime_error);
    EXPECT_THROW(
        translate(Language::godot, start + "    cotan_two u = x < cotan_real(0.0) ? t : s;\n    return u.a;\n}\n"),
        std::runtime_error);
}

// ---- options --------------------------------------------------------------------------------

TEST(ChosenText, containsOnlyTheChosenStoredForm)
{
    Choice choice;
    choice.frame = Frame::unit;
    choice.convention.greenUp = true;
    choice.convention.v = VDirection::up;
    choice.convention.expansion = Expansion::biased;
    std::string text = textOf(choice);
    EXPECT_TRUE(
        has(text, "float cotan_expand(float c)\n{\n    float x = c * 2.0 - 1.0;\n    return max(x, -1.0);\n}\n"))
        << text;
    EXPECT_TRUE(has(text, "    vec3 m = vec3(x, y, z);\n    return vec3(m.x, m.y, m.z);\n}\n"));
    choice.convention.expansion = Expansion::signedValues;
    EXPECT_TRUE(has(textOf(choice), "float cotan_expand(float c)\n{\n    float x = c;\n"));
    choice.convention.channels = Channels::slope;
    text = textOf(choice);
    EXPECT_TRUE(has(text,
                    "    float x = cotan_expand(texel.x);\n    float y = cotan_expand(texel.y);\n"
                    "    vec3 m = vec3(-x, -y, 1.0);\n    return vec3(m.x, m.y, m.z);\n}\n"))
        << text;
    EXPECT_FALSE(has(text, "if (")) << text;
    choice.convention.channels = Channels::orthographic;
    EXPECT_TRUE(has(textOf(choice), "    vec3 m = vec3(x, y, cotan_orthographic_z(xy));\n"));
    choice.convention.channels = Channels::stereographic;
    EXPECT_TRUE(has(textOf(choice), "    vec3 m = cotan_from_stereographic(xy);\n"));
}

TEST(ChosenText, greenIsInvertedIfItPointsAgainstV)
{
    for (const bool greenUp : {true, false})
        for (const VDirection v : {VDirection::up, VDirection::down}) {
            Choice choice;
            choice.convention.greenUp = greenUp;
            choice.convention.v = v;
            const bool against = greenUp == (v == VDirection::down);
            EXPECT_EQ(has(textOf(choice), "return vec3(m.x, -m.y, m.z);"), against) << greenUp << int(v);
            EXPECT_EQ(has(textOf(choice), "return vec3(m.x, m.y, m.z);"), !against) << greenUp << int(v);
        }
}

TEST(ChosenText, uvSetsAreSummedAndLimitedToFour)
{
    Choice choice;
    choice.frame = Frame::gradient;
    for (int sets = 2; sets <= 4; ++sets) {
        choice.uvSets = sets;
        std::string sum = "gradient0";
        for (int k = 1; k < sets; ++k)
            sum += " + gradient" + std::to_string(k);
        EXPECT_TRUE(has(textOf(choice), "(frame0.n, " + sum + ");")) << sets;
    }
    for (const int wrong : {-1, 0, 5}) {
        choice.uvSets = wrong;
        ASSERT_FALSE(makeShaderText(choice)) << wrong;
        EXPECT_EQ(makeShaderText(choice).error().kind, ErrorKind::usage);
    }
    choice.uvSets = 2;
    choice.form = Form::fused;
    EXPECT_FALSE(makeShaderText(choice)) << "gradient has no fused form over several";
    choice.frame = Frame::cotangent;
    choice.form = {};
    EXPECT_TRUE(has(textOf(choice), "return cotan_perturb_footprint(footprint, slope0 + slope1);"));
    choice.form = Form::total;
    EXPECT_TRUE(has(textOf(choice), "(frame0.n, gradient0 + gradient1);"));
    choice.form = {};
    for (const Frame from : {Frame::exact, Frame::smooth, Frame::vertex, Frame::mikktspace}) {
        choice.frame = from;
        EXPECT_FALSE(makeShaderText(choice)) << name(from);
    }
}

TEST(ChosenText, framesThatNeedAUnitNormalGetOne)
{
    for (const FrameInfo& f : frames()) {
        if (f.source != FrameSource::differences)
            continue;
        Choice choice;
        choice.frame = f.frame;
        choice.form = Form::total;
        EXPECT_EQ(has(textOf(choice), "normal * inversesqrt(dot(normal, normal))"), !f.total) << f.name;
    }
}

TEST(ChosenText, screenDerivativesAreUsedIfLanguageAndFrameHaveThem)
{
    for (const Language language : kLanguages)
        for (const bool caller : {false, true}) {
            Choice choice;
            choice.language = language;
            choice.callerDifferences = caller;
            const auto text = makeShaderText(choice);
            ASSERT_TRUE(text);
            const auto taken = [](const ShaderText& t) {
                return std::ranges::count(t.functions, "cotan_perturb_normal");
            };
            EXPECT_EQ(taken(*text), !caller && language != Language::cpp) << name(language);
            choice.frame = Frame::exact; // made from edges
            choice.functionsOnly = true;
            EXPECT_EQ(taken(*makeShaderText(choice)), 0) << name(language);
        }
}

// No language can tell an attribute that a mesh lacks, so each text says what it gives.
TEST(ChosenText, theHeadSaysWhatMissingVertexDataGives)
{
    for (const Language language : kLanguages)
        for (const FrameInfo& f : frames()) {
            Choice choice;
            choice.language = language;
            choice.frame = f.frame;
            choice.functionsOnly = true;
            choice.stage = readsTriangleVectors(f.frame) ? Stage::fragment : Stage::all;
            const std::string text = textOf(choice), head = text.substr(0, text.find("\n\n"));
            const bool fromMesh = readsVertices(f.frame) || readsTriangleVectors(f.frame);
            EXPECT_EQ(has(head, "// Missing:\n"), fromMesh) << name(language) << ", " << f.name;
            EXPECT_TRUE(!fromMesh || has(head, readsTangents(f.frame) ? "`orthonormal`" : "`cotangent`")) << f.name;
        }
}

TEST(ChosenText, functionSetsAreIncludedOnlyOnRequest)
{
    // For each set, a function that no other set includes.
    const std::map<Set, std::string> exclusive = {{Set::gradient, "cotan_gradient_triplanar("},
                                                  {Set::blend, "cotan_blend_udn("},
                                                  {Set::space, "cotan_to_texture_space("},
                                                  {Set::mapping, "cotan_frame_projected("},
                                                  {Set::parallax, "cotan_relief_shadow("},
                                                  {Set::light, "cotan_reflect_coat("},
                                                  {Set::environment, "cotan_environment_texel("},
                                                  {Set::tone, "cotan_tone_agx("},
                                                  {Set::shadow, "cotan_penumbra("}};
    for (const Set set : kSets) {
        Choice with, others;
        with.sets = {set};
        std::ranges::copy_if(kSets, std::back_inserter(others.sets), [&](Set s) { return s != set; });
        EXPECT_TRUE(has(textOf(with), exclusive.at(set))) << name(set);
        EXPECT_FALSE(has(textOf(others), exclusive.at(set))) << name(set);
    }
}

// GLSL ES and WGSL have no implicit conversion from integers.
TEST(ChosenText, integersAreConvertedExplicitly)
{
    const char* const text = "COTAN_FUNCTION cotan_real half(int i)\n{\n"
                             "    return cotan_real(i) * cotan_real(3) + cotan_real(0.5);\n}\n";
    EXPECT_TRUE(has(translate(Language::essl, text), "return float(i) * 3.0 + 0.5;"));
    EXPECT_TRUE(has(translate(Language::wgsl, text), "return f32(i) * 3.0 + 0.5;"));
    EXPECT_TRUE(has(translate(Language::msl, text), "return float(i) * 3.0f + 0.5f;"));
}

TEST(Stages, unknownNumbersAreNamedAll)
{
    EXPECT_EQ(name(Stage(9)), "all");
    EXPECT_EQ(name(Stage::compute), "compute");
}

} // namespace
} // namespace cotan::shader_text
