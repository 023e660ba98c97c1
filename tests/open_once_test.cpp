// Commands that make several images or maps of one model: each file is read as often as for a single one, and the
// results are those of separate runs.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "commands.hpp"
#include "cotan/image.hpp"
#include "files/file_registry.hpp"
#include "run_tool.hpp"
#include "terminal/arguments.hpp"

namespace cotan::app {
namespace {

using test::TemporaryFolder;
using Names = std::vector<std::string>;

class OpenOnce : public ::testing::Test {
protected:
    // Runs a command in this process; returns the names of the files that it read, in order.
    Names readBy(const Names& words)
    {
        Arguments tool("cotan", "", "");
        addRenderCommand(tool);
        addBakeCommand(tool);
        addConvertCommand(tool);
        Names read;
        watchInputs([&](const std::filesystem::path& file) { read.push_back(file.filename().string()); });
        const Status done = tool.run(words, [](const std::string&) {});
        watchInputs({});
        guardInputs(/*overwrite*/ true);
        EXPECT_TRUE(done) << (done ? "" : done.error().message);
        return read;
    }
    std::string at(const std::string& name) const { return (folder / name).string(); }
    std::string bytes(const std::string& name) const { return test::readWhole(folder / name); }
    // How often a file is opened when its model is read once.
    std::ptrdiff_t openings(const std::string& model, const std::string& file)
    {
        const Names read = readBy({"render", at(model), "--size", "8x8", "--samples", "1", "--device", "reference",
                                   "--quiet", "--overwrite", "-o", at("once.png")});
        return std::ranges::count(read, file);
    }
    // An image of 2 x 2 texels with these red values.
    void writeTexels(const std::string& name, std::initializer_list<int> reds)
    {
        Image image = makeImage(2, 2, PixelType::unorm8, name);
        std::uint8_t* texel = image.bytes8();
        for (const int red : reds) {
            const int color[4] = {red, 128, 255, 255};
            texel = std::copy_n(color, 4, texel);
        }
        ASSERT_TRUE(writeImage(folder / name, image));
    }
    // A textured triangle that moves by 1 along x in one second.
    void writeMovingTriangle()
    {
        const std::vector<float> numbers = {0, 0, 0, 1,           0, 0,           0, 1, 0, /*uv*/ 0, 0, 1,
                                            0, 0, 1, /*times*/ 0, 1, /*moves*/ 0, 0, 0, 1, 0,        0};
        std::ofstream(folder / "m.bin", std::ios::binary)
            .write(reinterpret_cast<const char*>(numbers.data()), std::streamsize(numbers.size() * 4));
        writeTexels("base.png", {255, 0, 128, 64});
        writeTexels("bumps.png", {128, 200, 60, 128});
        std::ofstream(folder / "m.gltf") << R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
            "nodes":[{"mesh":0}],"buffers":[{"uri":"m.bin","byteLength":92}],
            "meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"material":0}]}],
            "materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],
            "textures":[{"source":0}],"images":[{"uri":"base.png"}],
            "bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":24},
                           {"buffer":0,"byteOffset":60,"byteLength":8},{"buffer":0,"byteOffset":68,"byteLength":24}],
            "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
                         {"bufferView":1,"componentType":5126,"count":3,"type":"VEC2"},
                         {"bufferView":2,"componentType":5126,"count":2,"type":"SCALAR","min":[0],"max":[1]},
                         {"bufferView":3,"componentType":5126,"count":2,"type":"VEC3"}],
            "animations":[{"name":"go","channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}],
                           "samplers":[{"input":2,"output":3}]}]})";
    }
    // Two squares with uv of the whole unit square; `slope` tilts them in opposite directions.
    void writeSquares(const std::string& file, double slope, const std::string& ending)
    {
        std::ofstream text(folder / file);
        for (const int k : {0, 1}) {
            text << "o " << (k ? "right" : "left") << ending << "\n";
            for (const auto& [u, v] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}})
                text << fmt::format("v {} {} {}\nvt {} {}\n", 3 * k + u, v, (k ? -1 : 1) * slope * (u - 0.5), u, v);
            text << fmt::format("f {0}/{0} {1}/{1} {2}/{2} {3}/{3}\n", 4 * k + 1, 4 * k + 2, 4 * k + 3, 4 * k + 4);
        }
    }

    TemporaryFolder folder;
};

TEST_F(OpenOnce, imagesOfAnAnimationReadEveryFileOnceAndEqualThoseDrawnAlone)
{
    writeMovingTriangle();
    for (const std::string view : {"shaded", "base-color", "facing"}) {
        const auto draw = [&](const Names& more) {
            Names words = {"render",     at("m.gltf"),  "--normal-map",  at("bumps.png"),
                           "--view",     view,          "--camera",      "front",
                           "--exposure", "1",           "--size",        "24x16",
                           "--samples",  "1",           "--device",      "reference",
                           "--quiet",    "--overwrite", "--animation",   "go",
                           "--edges",    "all",         "--environment", "none"};
            words.insert(words.end(), more.begin(), more.end());
            return readBy(words);
        };
        const Names read = draw({"--frames", "1..3", "--rate", "4", "-o", at("f.png")});
        for (const int i : {1, 2, 3}) {
            EXPECT_EQ(draw({"--time", std::to_string(i / 4.0), "-o", at("alone.png")}), read) << view;
            EXPECT_EQ(bytes(fmt::format("f-000{}.png", i)), bytes("alone.png")) << view << i;
        }
        EXPECT_NE(bytes("f-0001.png"), bytes("f-0003.png")) << view;
    }
}

TEST_F(OpenOnce, mapsOfObjectsReadEveryMeshOnceAndEqualThoseBakedAlone)
{
    writeSquares("low.obj", 0, "_low");
    writeSquares("high.obj", 0.2, "_high");
    for (const std::string option : {"--search=first", "--match-by-name", "--high-normals=curved", "--kind=height"}) {
        const auto bake = [&](const Names& more) {
            Names words = {"bake",   "--high", at("high.obj"), "--low",       at("low.obj"),
                           "--size", "16",     "--quiet",      "--overwrite", option};
            words.insert(words.end(), more.begin(), more.end());
            return readBy(words);
        };
        EXPECT_EQ(bake({"--per-object", "-o", at("m.png")}), bake({"-o", at("all.png")})) << option;
        for (const std::string name : {"left_low", "right_low"}) {
            bake({"--object", name, "-o", at("alone.png")});
            EXPECT_EQ(bytes("m-" + name + ".png"), bytes("alone.png")) << option << name;
        }
        EXPECT_NE(bytes("m-left_low.png"), bytes("m-right_low.png")) << option;
    }
}

TEST_F(OpenOnce, aModelThatGetsItsMapIsReadBeforeTheHighMesh)
{
    writeMovingTriangle();
    writeSquares("high.obj", 0.2, "_high");
    for (const std::string output : {"out.glb", "out.gltf"}) {
        const Names read = readBy({"bake", "--high", at("m.gltf"), "--high", at("high.obj"), "--low", at("m.gltf"),
                                   "--size", "8", "--quiet", "-o", at(output)});
        EXPECT_EQ(std::ranges::find(std::ranges::find(read, "high.obj"), read.end(), "m.gltf"), read.end()) << output;
    }
}

TEST_F(OpenOnce, aModelThatGetsItsMapIsReadOnce)
{
    writeMovingTriangle();
    writeSquares("high.obj", 0.2, "_high");
    for (const std::string up : {"y", "z"}) {
        const Names read = readBy({"bake", "--high", at("high.obj"), "--low", at("m.gltf"), "--size", "8", "--up", up,
                                   "--quiet", "--overwrite", "-o", at("out.glb")});
        EXPECT_EQ(std::ranges::count(read, "m.gltf"), 1) << up;
        EXPECT_EQ(std::ranges::count(read, "m.bin"), openings("m.gltf", "m.bin")) << up;
    }
}

TEST_F(OpenOnce, aConvertedModelIsReadOnceToVerifyIt)
{
    writeMovingTriangle();
    const Names read = readBy({"convert", at("m.gltf"), "--to-frame", "orthonormal", "--verify", at("check"),
                               "--device", "reference", "--quiet", "-o", at("out.glb")});
    EXPECT_EQ(std::ranges::count(read, "out.glb"), openings("out.glb", "out.glb"));
}

} // namespace
} // namespace cotan::app
