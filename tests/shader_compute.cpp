// Compiles a case as a compute shader to SPIR-V.
#include "shader_run.hpp"

namespace cotan::test {

using shader_text::Language;

std::string computeText(const Case& c, Language language)
{
    const bool hlsl = language == Language::hlsl;
    auto in = [](int i) { return "inputs[i * 16u + " + std::to_string(i) + "u]"; };
    auto vec = [&](const std::string& type, int i, int n) {
        std::string text = type + "(";
        for (int k = 0; k < n; ++k)
            text += (k ? ", " : "") + in(i + k);
        return text + ")";
    };
    const std::string v2 = hlsl ? "float2" : "vec2", v3 = hlsl ? "float3" : "vec3";
    const std::string body = "    " + v3 + " n = " + vec(v3, 0, 3) + ";\n    " + v3 + " dpdx = " + vec(v3, 3, 3)
        + ";\n    " + v3 + " dpdy = " + vec(v3, 6, 3) + ";\n    " + v2 + " duvdx = " + vec(v2, 9, 2) + ";\n    " + v2
        + " duvdy = " + vec(v2, 11, 2) + ";\n    " + v3 + " m = " + vec(v3, 13, 3) + ";\n    " + v3 + " r = " + c.call
        + ";\n    outputs[i * 3u] = r.x;\n    outputs[i * 3u + 1u] = r.y;\n    outputs[i * 3u + 2u] = r.z;\n}\n";
    if (hlsl)
        return "[[vk::binding(0)]] StructuredBuffer<float> inputs;\n[[vk::binding(1)]] RWStructuredBuffer<float> "
               "outputs;\n"
            + c.text(Language::hlsl)
            + "[numthreads(1, 1, 1)]\nvoid main(uint3 id : SV_DispatchThreadID)\n{\n    uint i = id.x;\n" + body;
    return "#version 450\nlayout(local_size_x = 1) in;\nlayout(std430, binding = 0) buffer In { float inputs[]; };\n"
           "layout(std430, binding = 1) buffer Out { float outputs[]; };\n"
        + c.text(language) + "void main()\n{\n    uint i = gl_GlobalInvocationID.x;\n" + body;
}

std::string toSpirv(const std::string& shader, const std::string& stage, bool hlsl, const std::string& label)
{
    const char* keep = std::getenv("COTAN_SPIRV");
    const std::string kept = keep ? std::string(keep) + "/"
            + std::to_string(std::hash<std::string>()((hlsl ? "hlsl " : "glsl ") + stage + shader))
                                  : "";
    if (std::filesystem::exists(kept))
        return readWhole(kept);
    TemporaryFolder folder;
    const std::string f = folder.path().string();
    writeText(folder / "a", shader);
    if (!shell(COTAN_GLSLANG_PATH + std::string(hlsl ? " -D -V -e main" : " -V") + " -S " + stage + " -o '" + f
                   + "/spv' '" + f + "/a'",
               folder / "log"))
        throw std::runtime_error(label + ": " + readWhole(folder / "log"));
    const std::string spirv = readWhole(folder / "spv");
    if (keep)
        writeText(kept, spirv);
    return spirv;
}

std::string computeSpirv(const Case& c, Language language)
{
    return toSpirv(computeText(c, language), "comp", language == Language::hlsl, c.name);
}

} // namespace cotan::test
