// The commands and code of docs/how-to/engines.md, put together as a reader would.
#include <cstdlib>
#include <fstream>
#include <regex>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "run_tool.hpp"

namespace cotan::test {
namespace {

// The section of one engine.
std::string section(const std::string& engine)
{
    const std::string page = readWhole(std::filesystem::path(COTAN_SOURCE_DIR) / "docs/how-to/engines.md");
    const std::size_t start = page.find("\n## " + engine + "\n");
    if (start == std::string::npos)
        return {};
    return page.substr(start, page.find("\n## ", start + 1) - start);
}

// The section's first code block in `language` that begins with `first`.
std::string block(const std::string& engine, const std::string& language, const std::string& first = "")
{
    const std::string text = section(engine), fence = "```" + language + "\n";
    const std::size_t start = text.find(fence + first);
    if (start == std::string::npos)
        return {};
    return text.substr(start + fence.size(), text.find("```", start + fence.size()) - start - fence.size());
}

// The output of the section's `cotan shader` command.
std::string printed(const std::string& engine)
{
    const TemporaryFolder folder;
    std::istringstream command(block(engine, "sh", "cotan shader"));
    std::vector<std::string> words;
    std::string word;
    command >> word; // skips "cotan"
    while (command >> word)
        words.push_back(word);
    const ToolRun run = runTool(words, folder.path());
    EXPECT_EQ(run.code, 0) << run.err;
    return words.empty() ? std::string() : readWhole(folder / words.back());
}

std::string replaced(std::string text, const std::string& what, const std::string& by)
{
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return at == std::string::npos ? text : text.replace(at, what.size(), by);
}

// The messages of glslang; empty if it accepts the text.
std::string complaints(const std::string& text, const std::string& options, const std::string& extension)
{
    const TemporaryFolder folder;
    std::ofstream(folder / ("text" + extension)) << text;
    const std::string log = folder / "log";
    const int code = std::system(fmt::format("{} {} -S frag '{}' > '{}' 2>&1", COTAN_GLSLANG_PATH, options,
                                             (folder / ("text" + extension)).string(), log)
                                     .c_str());
    return code == 0 ? std::string() : readWhole(log) + text;
}

constexpr const char* kHlsl = "-D -V -e main -o /dev/null";

TEST(Engines, unitysCustomFunctionCompiles)
{
    const std::string main = R"(
float4 main(float3 n : A, float3 p : B, float2 uv : C) : SV_Target
{
    float3 result;
    Cotan_float(n, p, uv, float3(0, 0, 1), result);
    return float4(result, 1);
})";
    EXPECT_EQ(complaints(printed("Unity") + block("Unity", "hlsl") + main, kHlsl, ".hlsl"), "");
}

TEST(Engines, unrealsCustomNodeCompilesInBothStages)
{
    const std::string code = replaced(block("Unreal", "hlsl"), "    // the text of cotan.ush\n", printed("Unreal"));
    // Unreal puts the whole text into a function. glslang accepts member functions of a struct only outside of
    // functions; HLSL's own compiler accepts both.
    const std::string end = "} cotan;\n";
    const std::size_t body = code.find(end);
    ASSERT_NE(body, std::string::npos);
    const std::string text = code.substr(0, body) + "};\nfloat3 custom(float3 Normal, float3 Position, float2 UV, "
        + "float3 Texel)\n{\n    Cotan cotan;\n" + code.substr(body + end.size()) + R"(}
float4 main(float3 n : A, float3 p : B, float2 uv : C) : SV_Target { return float4(custom(n, p, uv, n), 1); })";
    EXPECT_EQ(complaints("#define PIXELSHADER 1\n" + text, kHlsl, ".hlsl"), "");
    EXPECT_EQ(complaints("#define PIXELSHADER 0\n" + text, kHlsl, ".hlsl"), "");
}

TEST(Engines, godotsShaderCompilesWithoutItsKeywords)
{
    std::string code = block("Godot", "glsl");
    code = replaced(code, "shader_type spatial;\n", "");
    code = std::regex_replace(code, std::regex(" : hint[^;]*;"), ";");
    code = replaced(code, "#include \"cotan.gdshaderinc\"\n", printed("Godot"));
    const std::string text =
        "#version 300 es\nprecision highp float;\nprecision highp int;\nin vec3 VERTEX;\nin vec2 UV;\n"
        "vec3 NORMAL;\nin vec3 given;\nout vec4 colour;\n"
        + code + "\nvoid main() { NORMAL = given; fragment(); colour = vec4(NORMAL, 1.0); }\n";
    EXPECT_EQ(complaints(text, "", ".frag"), "");
}

} // namespace
} // namespace cotan::test
