// Files and processes of the tests that compare shading languages.
#pragma once

#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "run_tool.hpp"
#include "shader_cases.hpp"

namespace cotan::test {

template<class Item> void writeItems(const std::filesystem::path& file, const std::vector<Item>& items)
{
    std::ofstream stream(file, std::ios::binary);
    stream.write(reinterpret_cast<const char*>(items.data()),
                 static_cast<std::streamsize>(items.size() * sizeof(Item)));
}

inline void writeText(const std::filesystem::path& file, const std::string& text)
{
    std::ofstream(file, std::ios::binary) << text;
}

inline std::vector<Vectors> vectorsOf(const std::vector<Sample>& samples)
{
    std::vector<Vectors> all;
    for (const Sample& s : samples)
        all.push_back(s.v);
    return all;
}

// Runs a line of the shell; its output goes to the file `log`.
inline bool shell(const std::string& line, const std::filesystem::path& log)
{
    return std::system(("(" + line + ") > '" + log.string() + "' 2>&1").c_str()) == 0;
}

// Returns SPIR-V bytes by glslang. stage: glslang's name, such as `comp`. label: prefix of errors. Results are kept in
// and read from the folder COTAN_SPIRV, if set, which bench/on-gpu carries to machines without glslang.
std::string toSpirv(const std::string& shader, const std::string& stage, bool hlsl, const std::string& label);

// A case as a compute shader, in GLSL or HLSL: inputs at binding 0, outputs at binding 1.
std::string computeText(const Case& c, shader_text::Language language);
std::string computeSpirv(const Case& c, shader_text::Language language);

inline std::vector<std::uint32_t> wordsOf(const std::string& spirv)
{
    std::vector<std::uint32_t> words(spirv.size() / 4);
    std::memcpy(words.data(), spirv.data(), words.size() * 4);
    return words;
}

// Parses three numbers per sample, case by case; empty if the number of bytes is wrong.
template<class Real>
std::vector<std::vector<glm::dvec3>> valuesOf(const std::string& bytes, std::size_t caseCount, std::size_t sampleCount)
{
    std::vector<std::vector<glm::dvec3>> values;
    if (bytes.size() != caseCount * sampleCount * 3 * sizeof(Real))
        return values;
    const char* at = bytes.data();
    for (std::size_t c = 0; c < caseCount; ++c) {
        values.emplace_back();
        for (std::size_t s = 0; s < sampleCount; ++s, at += 3 * sizeof(Real)) {
            Real r[3];
            std::memcpy(r, at, sizeof r);
            values.back().push_back({double(r[0]), double(r[1]), double(r[2])});
        }
    }
    return values;
}

} // namespace cotan::test
