// The printed C++, and the printed Metal text as C++ over a shim of its types.
#include "shader_run.hpp"

namespace cotan::test {

namespace {

using shader_text::Language;

std::string replaced(std::string text, const std::string& from, const std::string& to)
{
    const std::size_t at = text.find(from);
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

Results run(const std::string& label, const std::vector<Case>& cases, const std::vector<Sample>& samples,
            Language language, const std::string& real, const std::string& vec2, const std::string& vec3)
{
    TemporaryFolder folder;
    std::string source = "#include <cmath>\n#include <cstdio>\n";
    if (language == Language::msl)
        source += "#include <metal_stdlib>\n";
    for (std::size_t k = 0; k < cases.size(); ++k) {
        std::string text = cases[k].text(language);
        if (real == "double")
            text = replaced(text, "using cotan_real = float; // or double", "using cotan_real = double;");
        const std::string inner = language == Language::cpp ? "using namespace cotan_shader;\n" : "using namespace metal;\n";
        source += "namespace case" + std::to_string(k) + " {\n" + text + inner + "void run(const float* in, " + real
            + "* out)\n{\n" + vec3 + " n{in[0], in[1], in[2]}, dpdx{in[3], in[4], in[5]}, dpdy{in[6], in[7], in[8]};\n"
            + vec2 + " duvdx{in[9], in[10]}, duvdy{in[11], in[12]};\n" + vec3 + " m{in[13], in[14], in[15]};\n"
            + "(void)duvdx, (void)duvdy, (void)dpdx, (void)dpdy;\nconst " + vec3 + " r = " + cases[k].call
            + ";\nout[0] = r.x; out[1] = r.y; out[2] = r.z;\n}\n}\n";
    }
    source += "int main(int, char** a)\n{\nstd::FILE* in = std::fopen(a[1], \"rb\");\n"
              "std::FILE* out = std::fopen(a[2], \"wb\");\nstatic float v[16 * 4096];\n"
              "const std::size_t n = std::fread(v, 64, 4096, in);\n" + real + " r[3];\n";
    for (std::size_t k = 0; k < cases.size(); ++k)
        source += "for (std::size_t i = 0; i < n; ++i) { case" + std::to_string(k)
            + "::run(v + 16 * i, r); std::fwrite(r, sizeof r, 1, out); }\n";
    source += "return std::fclose(out);\n}\n";
    writeText(folder / "main.cpp", source);
    writeItems(folder / "in", vectorsOf(samples));
    const std::string f = folder.path().string();
    Results results{label, {}, {}};
    if (!shell(COTAN_CXX " -std=c++17 -O1 -ffp-contract=off -Wall -Wextra -Wno-unused -Wno-unused-parameter -Werror -I" COTAN_SOURCE_DIR
                         "/tests/metal_shim -o '" + f + "/main' '" + f + "/main.cpp' && '" + f + "/main' '" + f
                   + "/in' '" + f + "/out'",
               folder / "log"))
        throw std::runtime_error(label + ": " + readWhole(folder / "log"));
    const std::string bytes = readWhole(folder / "out");
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

} // namespace cotan::test
