// The printed HLSL as Microsoft's FXC compiles it, run by Direct3D 11 under Wine, and compiled by Microsoft's DXC: a
// door test (tests/direct3d/run), since it needs Wine, a mingw-w64 and an npm package for Windows. Exit code 77: they
// are missing.
#include <gtest/gtest.h>

#include <cstdlib>

#include <fmt/format.h>

#include "shader_parity.hpp"
#include "shader_run.hpp"

namespace cotan::test {
namespace {

using shader_text::Language;

std::string replaced(std::string text, const std::string& what, const std::string& by)
{
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
        text.replace(at, what.size(), by);
    return text;
}

// Runs jobs of tests/direct3d/host.cpp in a folder. Failed jobs are failures of the test.
void runJobs(const TemporaryFolder& folder, const std::string& jobs)
{
    writeText(folder / "jobs", jobs);
    const std::string f = folder.path().string();
    const int status = std::system(("'" COTAN_SOURCE_DIR "/tests/direct3d/run' '" COTAN_DIRECT3D "' '" + f + "' < '" + f
                                    + "/jobs' > '" + f + "/said' 2>&1")
                                       .c_str());
    const std::string said = readWhole(folder / "said");
    if (WEXITSTATUS(status) == 77) {
        fmt::print("{}", said);
        std::exit(77);
    }
    if (WEXITSTATUS(status) != 0 || said.find(" failed\n") != std::string::npos)
        throw std::runtime_error(said + "; the first messages: " + readWhole(folder / "0.txt"));
}

std::string job(const std::vector<std::string>& words) { return fmt::format("{}\n", fmt::join(words, "\t")); }

// FXC's results; DXC must compile the same text.
Results computeDirect3D(const std::vector<Case>& all, const std::vector<Sample>& samples)
{
    const TemporaryFolder folder;
    writeItems(folder / "in", vectorsOf(samples));
    const std::size_t floats = samples.size() * 3;
    std::string jobs;
    for (std::size_t k = 0; k < all.size(); ++k) {
        const std::string name = std::to_string(k);
        std::string text = replaced(computeText(all[k], Language::hlsl), "[[vk::binding(0)]] ", "");
        writeText(folder / (name + ".hlsl"), replaced(text, "[[vk::binding(1)]] ", ""));
        jobs += job({"dxc", "dxc" + name, name + ".hlsl", "main", "cs_6_0"})
            + job({"fxc", name, name + ".hlsl", "main", "cs_5_0"})
            + job({"compute", "run" + name, name + ".dxbc", "in", std::to_string(samples.size()),
                   std::to_string(floats)});
    }
    runJobs(folder, jobs);
    Results results{"hlsl, Direct3D", "", {}};
    for (std::size_t k = 0; k < all.size(); ++k)
        results.values.push_back(
            valuesOf<float>(readWhole(folder / ("run" + std::to_string(k) + ".bin")), 1, samples.size()).at(0));
    return results;
}

constexpr const char* kVertex = R"(StructuredBuffer<float> corners : register(t0);
struct Drawn { float4 at : SV_Position; float3 n : A; float3 p : B; float2 uv : C; float3 m : D; };
Drawn vertex(uint k, float y)
{
    uint i = k * 13;
    Drawn d;
    d.at = float4(corners[i], corners[i + 1] * y, 0.5, 1.0);
    d.n = float3(corners[i + 2], corners[i + 3], corners[i + 4]);
    d.p = float3(corners[i + 5], corners[i + 6], corners[i + 7]);
    d.uv = float2(corners[i + 8], corners[i + 9]);
    d.m = float3(corners[i + 10], corners[i + 11], corners[i + 12]);
    return d;
}
Drawn upright(uint k : SV_VertexID) { return vertex(k, 1.0); }
Drawn flipped(uint k : SV_VertexID) { return vertex(k, -1.0); }
)";

// change: what is done to each text before it is compiled.
Results drawDirect3D(const std::vector<Case>& drawn, const std::function<std::string(std::string)>& change)
{
    const TemporaryFolder folder;
    const std::vector<Corner> all = corners(tiles());
    writeItems(folder / "in", all);
    writeText(folder / "vertex.hlsl", kVertex);
    std::string jobs = job({"fxc", "upright", "vertex.hlsl", "upright", "vs_5_0"})
        + job({"fxc", "flipped", "vertex.hlsl", "flipped", "vs_5_0"});
    for (std::size_t k = 0; k < drawn.size(); ++k) {
        const std::string name = std::to_string(k), size = std::to_string(kTarget);
        writeText(
            folder / (name + ".hlsl"),
            change(drawn[k].text(Language::hlsl))
                + "float4 main(float4 at : SV_Position, float3 n : A, float3 p : B, float2 uv : C, float3 m : D) : "
                  "SV_Target\n{\n    return float4("
                + drawn[k].call + ", 1.0);\n}\n");
        jobs += job({"dxc", "dxc" + name, name + ".hlsl", "main", "ps_6_0"})
            + job({"fxc", name, name + ".hlsl", "main", "ps_5_0"});
        for (const std::string way : {"upright", "flipped"})
            jobs +=
                job({"draw", way + name, way + ".dxbc", name + ".dxbc", "in", std::to_string(all.size()), size, size});
    }
    runJobs(folder, jobs);
    Results results{"hlsl, Direct3D", "", {}};
    for (std::size_t k = 0; k < drawn.size(); ++k) {
        results.values.emplace_back();
        for (const std::string way : {"upright", "flipped"}) {
            const std::string bytes = readWhole(folder / (way + std::to_string(k) + ".bin"));
            std::vector<float> floats(bytes.size() / 4);
            std::memcpy(floats.data(), bytes.data(), bytes.size());
            for (std::size_t i = 0; i < std::size_t(kTarget * kTarget * 4); i += 4)
                results.values.back().push_back({floats.at(i), floats.at(i + 1), floats.at(i + 2)});
        }
    }
    return results;
}

TEST(Direct3D, computesWhatCppComputes) { expectParity(computeDirect3D(allCases(), allSamples())); }

TEST(Direct3D, drawsWithRowsDownAndUpsideDown)
{
    expectDrawn(drawDirect3D(drawnCases(), [](const std::string& text) { return text; }));
}

// A wrong sign of the derivative down the rows is seen wherever the frame depends on it: the test above can fail.
TEST(Direct3D, aWrongSignOfDdyIsSeen)
{
    const std::vector<Case> drawn = drawnCases();
    const Results wrong =
        drawDirect3D(drawn, [](const std::string& text) { return replaced(text, "ddy_fine(uv", "-ddy_fine(uv"); });
    int seen = 0;
    for (std::size_t k = 0; k < drawn.size(); ++k)
        seen += worstDrawn(drawn[k], wrong, k, false) > 10 && worstDrawn(drawn[k], wrong, k, true) > 10;
    EXPECT_GT(seen, 5);
}

} // namespace
} // namespace cotan::test
