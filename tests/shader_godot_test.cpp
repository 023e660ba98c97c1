// The complete shaders that `cotan shader --lang godot` prints, checked without Godot; godot_test runs them in Godot.
#include <gtest/gtest.h>

#include <map>
#include <regex>

#include "shader_run.hpp"

namespace cotan::test {
namespace {

using shader_text::Choice;
using shader_text::Language;

// With Godot's keywords removed or declared, a complete shader compiles as a single GLSL ES fragment stage.
TEST(ShaderGodot, wholeShadersCompile)
{
    constexpr char kGodot[] = R"(#version 300 es
precision highp float;
precision highp int;
in vec3 VERTEX; in vec2 UV, UV2; in vec4 COLOR;
in vec3 NORMAL_in, TANGENT, BINORMAL, VIEW, LIGHT, LIGHT_COLOR, ATTENUATION;
uniform mat4 MODELVIEW_MATRIX, PROJECTION_MATRIX; uniform bool FRONT_FACING;
vec3 NORMAL, ALBEDO, SPECULAR_LIGHT; float METALLIC, ROUGHNESS;
out vec4 colour;
)";
    TemporaryFolder folder;
    for (const FrameInfo& frame : frames())
        for (const bool all : {false, true}) {
            Choice choice;
            choice.language = Language::godot;
            choice.frame = frame.frame;
            choice.twoSided = all;
            choice.callerDifferences = all && frame.source != FrameSource::differences && frame.frame != Frame::exact;
            if (all)
                choice.sets = {shader_text::Set::gradient, shader_text::Set::blend, shader_text::Set::light};
            if (all && frame.source == FrameSource::differences)
                choice.uvSets = 2;
            if (frame.frame == Frame::exact) {
                EXPECT_EQ(makeShaderText(choice).error().kind, ErrorKind::usage);
                continue;
            }
            std::string text = makeShaderText(choice)->text;
            for (const auto& [own, plain] : {std::pair(R"(shader_type [^;]*;|render_mode [^;]*;)", ""),
                                             {R"( : hint[^;]*;)", ";"},
                                             {R"(\nvarying )", "\n"}})
                text = std::regex_replace(text, std::regex(own), plain);
            const bool vertex = text.find("void vertex()") != std::string::npos;
            text = kGodot + text + "void main()\n{\n    NORMAL = NORMAL_in;\n" + (vertex ? "    vertex();\n" : "")
                + "    fragment();\n" + (all ? "    light();\n" : "")
                + "    colour = vec4(NORMAL + SPECULAR_LIGHT, METALLIC);\n}\n";
            writeText(folder / "a.frag", text);
            EXPECT_TRUE(shell(COTAN_GLSLANG_PATH " '" + (folder / "a.frag").string() + "'", folder / "log"))
                << frame.name << ": " << readWhole(folder / "log") << text;
        }
}

TEST(ShaderGodot, theExampleEqualsTheToolsOutput)
{
    TemporaryFolder folder;
    for (const auto& [file, words] : std::map<std::string, std::vector<std::string>>{
             {"cotan", {"--frame", "cotangent"}}, {"triangle", {"--frame", "triangle", "--differences", "caller"}}}) {
        std::vector<std::string> all = {"shader", "--lang", "godot", "--two-sided"};
        all.insert(all.end(), words.begin(), words.end());
        const ToolRun printed = runTool(all, folder.path());
        ASSERT_EQ(printed.code, 0) << printed.err;
        EXPECT_TRUE(readWhole(COTAN_SOURCE_DIR "/examples/godot/" + file + ".shader") == printed.out)
            << file << ".shader: examples/godot/README.md has the command that prints it";
    }
}

// Godot's importer may drop the blue channel, so two channels, as in its own preset, are the default. Zero stays that
// of maps of unknown origin.
TEST(ShaderGodot, mapsHaveTwoChannelsByDefault)
{
    TemporaryFolder folder;
    const std::string plain = runTool({"shader", "--lang", "godot"}, folder.path()).out;
    EXPECT_EQ(plain,
              runTool({"shader", "--lang", "godot", "--preset", "godot", "--unsigned", "exact"}, folder.path()).out);
    EXPECT_NE(plain, runTool({"shader", "--lang", "godot", "--preset", "gltf"}, folder.path()).out);
    EXPECT_NE(plain.find("cotan_orthographic_z(xy)"), std::string::npos);
}

// The drivers without derivatives get the same shader without a function that takes them.
TEST(ShaderGodot, shadersForMeshDataTakeDerivativesOnlyForMeshesWithoutIt)
{
    for (const FrameInfo& frame : frames()) {
        if (!readsVertices(frame.frame) && !readsTriangleVectors(frame.frame))
            continue;
        Choice choice;
        choice.language = Language::godot;
        choice.frame = frame.frame;
        const std::string head = "Missing:\n", with = makeShaderText(choice)->text;
        EXPECT_NE(with.find("dFdx("), std::string::npos) << frame.name;
        EXPECT_NE(with.find(readsTangents(frame.frame) ? "`orthonormal`, from derivatives" : "`cotangent`, from"),
                  std::string::npos);
        choice.callerDifferences = true;
        const std::string without = makeShaderText(choice)->text;
        EXPECT_EQ(without.find("dFdx("), std::string::npos) << frame.name;
        for (const std::string& text : {with, without}) {
            EXPECT_LT(text.find(head), text.find("shader_type spatial")) << frame.name;
            EXPECT_NE(text.find("void fragment()"), std::string::npos) << frame.name;
        }
        EXPECT_NE(without.find("has no bumps"), std::string::npos) << frame.name;
    }
}

} // namespace
} // namespace cotan::test
