// Broken Draco, meshoptimizer, WebP and KTX2 streams, made from the fuzzers' seeds, through every command that reads
// them: one clear line, no output, within seconds and one GiB.
#include <gtest/gtest.h>

#include <functional>

#include <nlohmann/json.hpp>

#include "run_tool.hpp"

namespace cotan {
namespace {

using namespace test;
using nlohmann::json;

std::string seed(const std::string& harness, const std::string& name)
{
    return readWhole(COTAN_SOURCE_DIR "/fuzz/corpus/" + harness + "/" + name);
}

void write(const std::filesystem::path& file, const std::string& bytes)
{
    std::ofstream(file, std::ios::binary) << bytes;
}

void expectRefused(const std::vector<std::string>& words, const std::filesystem::path& input, int code)
{
    TemporaryFolder folder;
    std::vector<std::string> all = words;
    for (std::string& w : all)
        if (w == "INPUT")
            w = input.string();
    const ToolRun run = runTool(all, folder.path(), 20);
    EXPECT_EQ(run.code, code) << words[0] << ": " << run.err;
    EXPECT_EQ(lines(run.err), 1) << words[0] << ": " << run.err;
    EXPECT_LT(run.seconds, 5) << words[0];
    EXPECT_LT(run.megabytes, 1024) << words[0];
    EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << words[0];
}

void expectModelRefused(const std::filesystem::path& model)
{
    SCOPED_TRACE(model.filename().string());
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"render", "INPUT", "-o", "out.png", "--device", "reference", "--size", "32x32"},
          {"lint", "INPUT", "--json", "report.json"},
          {"convert", "INPUT", "-o", "out.glb", "--from", "mikktspace", "--to", "cotangent"},
          {"tangents", "INPUT", "-o", "out.glb"}})
        expectRefused(words, model, 2);
}

using Change = std::function<void(json&)>;

// The extension object of the compressed buffer view, or else the first view.
json& stream(json& root)
{
    for (json& view : root["bufferViews"])
        if (view.contains("extensions"))
            return view["extensions"].begin().value();
    return root["bufferViews"][0];
}

const std::pair<const char*, Change> kChanges[] = {
    {"stream cut in half", [](json& g) { stream(g)["byteLength"] = stream(g)["byteLength"].get<int>() / 2; }},
    {"stream of no bytes", [](json& g) { stream(g)["byteLength"] = 0; }},
    {"stream beyond its buffer", [](json& g) { stream(g)["byteOffset"] = 1000000; }},
    {"stream that starts elsewhere", [](json& g) { stream(g)["byteOffset"] = 0; }},
    {"a million times the vertices",
     [](json& g) {
         for (json& accessor : g["accessors"])
             accessor["count"] = accessor["count"].get<std::uint64_t>() * 1000000;
         if (stream(g).contains("count")) {
             stream(g)["count"] = 4000000;
             for (json& view : g["bufferViews"])
                 if (view.contains("extensions"))
                     view["byteLength"] = 4000000 * stream(g)["byteStride"].get<std::uint64_t>();
             g["buffers"][1]["byteLength"] = 4000000 * stream(g)["byteStride"].get<std::uint64_t>();
         }
     }},
};

class PackedModel : public testing::TestWithParam<const char*> {};

TEST_P(PackedModel, everyCommandRefusesABrokenOne)
{
    TemporaryFolder folder;
    for (const auto& [name, change] : kChanges) {
        json root = json::parse(seed("gltf", GetParam()));
        change(root);
        const auto file = folder / (std::string(name) + ".gltf");
        write(file, root.dump());
        expectModelRefused(file);
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, PackedModel,
                         testing::Values("draco_sequential.gltf", "draco_edgebreaker.gltf", "meshopt_positions.gltf",
                                         "meshopt_triangles.gltf", "meshopt_exponential.gltf"),
                         [](const auto& i) {
                             const std::string name = i.param;
                             return name.substr(0, name.find('.'));
                         });

// Replaces the bytes from offset `at` on by `to`.
std::string changed(std::string bytes, std::size_t at, const std::string& to)
{
    return bytes.replace(at, to.size(), to);
}

TEST(PackedImage, everyCommandRefusesABrokenOne)
{
    const std::string large("\xff\xff\xff\x7f", 4),
        webp = seed("image", "lossy.webp"), zlib = seed("image", "zlib.ktx2"), zstd = seed("image", "zstd.ktx2");
    const std::pair<const char*, std::string> cases[] = {
        {"cut.webp", webp.substr(0, 60)},
        {"long.webp", changed(webp, 4, large)}, // size of the remaining file
        {"empty.webp", webp.substr(0, 12)},
        {"cut.ktx2", zstd.substr(0, zstd.size() - 8)},
        {"wide.ktx2", changed(zstd, 20, large)},
        {"levels.ktx2", changed(zstd, 40, large)},
        {"elsewhere.ktx2", changed(zstd, 80, large)},                  // offset of the first level
        {"bomb.ktx2", changed(zlib, 80 + 16, large)},                  // its uncompressed size
        {"bomb_that_lies.ktx2", seed("image", "zlib_that_lies.ktx2")}, // 100,000 bytes where 64 are declared
    };
    TemporaryFolder folder;
    for (const auto& [name, bytes] : cases) {
        SCOPED_TRACE(name);
        const auto file = folder / name;
        write(file, bytes);
        for (const std::vector<std::string>& words :
             {std::vector<std::string>{"map", "info", "INPUT", "--json", "report.json"},
              {"map", "convert", "INPUT", "--from", "gltf", "--to", "directx", "-o", "out.png"},
              {"map", "mips", "INPUT", "-o", "out.dds"}})
            expectRefused(words, file, 2);
    }
}

} // namespace
} // namespace cotan
