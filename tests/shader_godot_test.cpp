// The complete shaders that `cotan shader --lang godot` prints, checked without Godot; godot_test runs them in Godot.
#include <gtest/gtest.h>

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
    for (const auto& [file, frame] :
         {std::pair<std::string, std::string>("cotan", "cotangent"), {"triangle", "triangle"}}) {
        const ToolRun printed = runTool({"shader", "--lang", "godot", "--frame", frame, "--two-sided"}, folder.path());
        ASSERT_EQ(printed.code, 0) << printed.err;
        EXPECT_EQ(readWhole(COTAN_SOURCE_DIR "/examples/godot/" + file + ".shader"), printed.out)
            << "cotan shader --lang godot --frame " << frame << " --two-sided -o examples/godot/" << file << ".shader";
    }
}

// Godot's importer may drop the blue channel, so its own preset, with two channels, is the default.
TEST(ShaderGodot, mapsHaveTwoChannelsByDefault)
{
    TemporaryFolder folder;
    const std::string plain = runTool({"shader", "--lang", "godot"}, folder.path()).out;
    EXPECT_EQ(plain, runTool({"shader", "--lang", "godot", "--preset", "godot"}, folder.path()).out);
    EXPECT_NE(plain, runTool({"shader", "--lang", "godot", "--preset", "gltf"}, folder.path()).out);
    EXPECT_NE(plain.find("cotan_orthographic_z(xy)"), std::string::npos);
}

} // namespace
} // namespace cotan::test
