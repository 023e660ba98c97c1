// Runs the printed C++ and, compiled as C++ over a shim of Metal's types, the printed Metal text and the Metal text
// that SPIRV-Cross makes of the printed GLSL.
#include <regex>

#include "shader_run.hpp"

namespace cotan::test {

namespace {

using shader_text::Language;

std::string replaced(std::string text, const std::string& from, const std::string& to)
{
    const std::size_t at = text.find(from);
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

// Compiles `source` and runs it on the file of samples; returns the file that it writes.
std::string runSource(const std::string& label, const std::string& source, const std::vector<Sample>& samples,
                      const std::string& flags)
{
    TemporaryFolder folder;
    const std::string f = folder.path().string();
    writeText(folder / "main.cpp", source);
    writeItems(folder / "in", vectorsOf(samples));
    if (!shell(COTAN_CXX " -std=c++17 -ffp-contract=off -Wall -Wextra -Wno-unused -Wno-unused-parameter -Werror "
                   + flags + " -I" COTAN_SOURCE_DIR "/tests/metal_shim -o '" + f + "/main' '" + f + "/main.cpp' && '"
                   + f + "/main' '" + f + "/in' '" + f + "/out'",
               folder / "log"))
        throw std::runtime_error(label + ": " + readWhole(folder / "log"));
    return readWhole(folder / "out");
}

// Calls caseK::run(inputs, outputs) for every case and sample.
std::string mainOf(std::size_t cases, const std::string& real)
{
    std::string source = "int main(int, char** a)\n{\nstd::FILE* in = std::fopen(a[1], \"rb\");\n"
                         "std::FILE* out = std::fopen(a[2], \"wb\");\nstatic float v[16 * 4096];\n"
                         "const std::size_t n = std::fread(v, 64, 4096, in);\n"
        + real + " r[3];\n";
    for (std::size_t k = 0; k < cases; ++k)
        source += "for (std::size_t i = 0; i < n; ++i) { case" + std::to_string(k)
            + "::run(v + 16 * i, r); std::fwrite(r, sizeof r, 1, out); }\n";
    return source + "return std::fclose(out);\n}\n";
}

Results run(const std::string& label, const std::vector<Case>& cases, const std::vector<Sample>& samples,
            Language language, const std::string& real, const std::string& vec2, const std::string& vec3)
{
    std::string source = "#include <cmath>\n#include <cstdint>\n#include <cstdio>\n#include <cstring>\n";
    if (language == Language::msl)
        source += "#include <metal_stdlib>\n";
    for (std::size_t k = 0; k < cases.size(); ++k) {
        std::string text = cases[k].text(language);
        if (real == "double")
            text = replaced(text, "using cotan_real = float; // or double", "using cotan_real = double;");
        const std::string inner =
            language == Language::cpp ? "using namespace cotan_shader;\n" : "using namespace metal;\n";
        source += "namespace case" + std::to_string(k) + " {\n" + text + inner + "void run(const float* in, " + real
            + "* out)\n{\n" + vec3 + " n{in[0], in[1], in[2]}, dpdx{in[3], in[4], in[5]}, dpdy{in[6], in[7], in[8]};\n"
            + vec2 + " duvdx{in[9], in[10]}, duvdy{in[11], in[12]};\n" + vec3 + " m{in[13], in[14], in[15]};\n"
            + "(void)duvdx, (void)duvdy, (void)dpdx, (void)dpdy;\nconst " + vec3 + " r = " + cases[k].call
            + ";\nout[0] = r.x; out[1] = r.y; out[2] = r.z;\n}\n}\n";
    }
    const std::string bytes = runSource(label, source + mainOf(cases.size(), real), samples, "-O1");
    Results results{label, {}, {}};
    results.values = real == "double" ? valuesOf<double>(bytes, cases.size(), samples.size())
                                      : valuesOf<float>(bytes, cases.size(), samples.size());
    return results;
}

} // namespace

Results runCpp(const std::vector<Case>& cases, const std::vector<Sample>& samples, bool doubles)
{
    const std::string real = doubles ? "double" : "float";
    return run("cpp " + real, cases, samples, Language::cpp, real, "cotan_vec2", "cotan_vec3");
}

Results runMsl(const std::vector<Case>& cases, const std::vector<Sample>& samples)
{
    return run("msl", cases, samples, Language::msl, "float", "float2", "float3");
}

Results runSpirvCross(const std::vector<Case>& cases, const std::vector<Sample>& samples)
{
    Results results{"spirv-cross", {}, {}};
    TemporaryFolder folder;
    const std::string f = folder.path().string();
    if (!shell("command -v spirv-cross", folder / "log")) {
        results.skipped = "no spirv-cross";
        return results;
    }
    const std::regex number(R"((\d+\.\d+(e[+-]?\d+)?))");
    std::string source = "#include <cstdio>\n#include <metal_stdlib>\n";
    for (std::size_t k = 0; k < cases.size(); ++k) {
        std::ofstream(folder / "spv", std::ios::binary) << computeSpirv(cases[k], Language::glsl);
        if (!shell("spirv-cross --msl '" + f + "/spv' --output '" + f + "/metal'", folder / "log"))
            throw std::runtime_error(cases[k].name + ": " + readWhole(folder / "log"));
        // Metal's literals are floats, C++'s are doubles.
        source += "namespace case" + std::to_string(k) + " {\n"
            + std::regex_replace(readWhole(folder / "metal"), number, "$1f")
            + "void run(float* in, float* out)\n{\n"
              "main0(reinterpret_cast<In&>(*in), reinterpret_cast<Out&>(*out), uint3(0));\n}\n}\n";
    }
    results.values = valuesOf<float>(runSource(results.language, source + mainOf(cases.size(), "float"), samples,
                                               "-O1 -Wno-attributes -Wno-unknown-pragmas -Wno-array-bounds"),
                                     cases.size(), samples.size());
    return results;
}

} // namespace cotan::test
