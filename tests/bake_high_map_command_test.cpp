// `cotan bake --high-normals` as a user runs it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "cotan/model.hpp"
#include "quad_model.hpp"
#include "run_tool.hpp"
#include "test_data.hpp"
#include "truth/quad.hpp"

namespace cotan::test {
namespace {

glm::dvec3 decodedAt(const Image& image, std::size_t i)
{
    glm::dvec3 m(0);
    for (int k = 0; k < 3; ++k)
        m[k] = (double(image.bytes8()[4 * i + std::size_t(k)]) - 128) / 127;
    return m;
}

class BakeHighMapCommand : public testing::Test {
protected:
    TemporaryFolder folder;

    ToolRun bake(std::vector<std::string> words)
    {
        words.insert(words.begin(), "bake");
        words.insert(words.end(), {"-o", "m.png"});
        return runTool(words, folder.path());
    }
    Image loadImage(const std::string& file)
    {
        auto image = readImage(folder / file);
        EXPECT_TRUE(image) << file;
        return image ? std::move(*image) : makeImage(1, 1, PixelType::unorm8);
    }
    // Expects that the bytes of two images of one size differ by at most one step.
    void expectSame(const Image& a, const Image& b, const std::string& what)
    {
        ASSERT_EQ(a.pixelCount(), b.pixelCount());
        int largest = 0;
        for (std::size_t i = 0; i < a.pixelCount() * 4; ++i)
            largest = std::max(largest, std::abs(int(a.bytes8()[i]) - int(b.bytes8()[i])));
        EXPECT_LE(largest, 1) << what;
    }
    // Writes an OBJ square with uv and one without.
    void writeSquares()
    {
        const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
        std::ofstream(folder / "square.obj")
            << square << "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n";
        std::ofstream(folder / "bare.obj") << square << "f 1 2 3\nf 1 3 4\n";
    }
};

// Normalising 8-bit texels moves them by up to sqrt(3)/2 steps: by one step when stored again.
TEST_F(BakeHighMapCommand, aGltfModelBakedOntoItselfGivesItsMapBack)
{
    write(quad(1), folder.path());
    const ToolRun r = bake({"--high", "quad.gltf", "--low", "quad.gltf", "--high-normals", "map", "--frame",
                            "mikktspace", "--size", "128x128", "--quiet", "--json", "r.json"});
    ASSERT_EQ(r.code, 0) << r.err;
    expectSame(loadImage("m.png"), loadImage("waves.png"), "glTF");
    EXPECT_EQ(json::parse(readWhole(folder / "r.json"))["high_normals"], "map");
}

TEST_F(BakeHighMapCommand, theConventionAppliesToAMapForAMeshWithoutMaterial)
{
    writeSquares();
    const Image map = makeReliefMap(Relief::waves, 64);
    ASSERT_TRUE(writeImage(folder / "map.png", map));
    const std::vector<std::string> words{"--high",  "square.obj",  "--low",   "square.obj", "--high-normals",
                                         "map",     "--high-map",  "map.png", "--size",     "64x64",
                                         "--frame", "orthonormal", "--quiet"};
    ASSERT_EQ(bake(words).code, 0);
    expectSame(loadImage("m.png"), map, "opengl");
    Image flipped = map; // Reading as DirectX and storing as OpenGL mirrors green about 128.
    for (std::size_t i = 0; i < flipped.pixelCount(); ++i)
        flipped.bytes8()[4 * i + 1] = std::uint8_t(std::min(255, 256 - int(flipped.bytes8()[4 * i + 1])));
    auto directx = words;
    directx.insert(directx.end(), {"--high-convention", "directx"});
    ASSERT_EQ(bake(directx).code, 0);
    expectSame(loadImage("m.png"), flipped, "directx");
}

TEST_F(BakeHighMapCommand, oneMapAppliesToEveryHighFile)
{
    write(quad(1), folder.path());
    writeSquares();
    std::ofstream(folder / "aside.obj")
        << "mtllib none.mtl\nv 5 0 0\nv 6 0 0\nv 6 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nf 1/1 2/2 3/3\n";
    const ToolRun r =
        bake({"--high", "square.obj", "--high", "aside.obj", "--low", "square.obj", "--high-normals", "map",
              "--high-map", "waves.png", "--high-convention", "gltf", "--frame", "orthonormal", "--size", "128x128"});
    ASSERT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(r.err.find("high meshes"), std::string::npos) << "each has a map: " << r.err;
    EXPECT_NE(r.err.find("material library none.mtl was not found"), std::string::npos) << r.err;
    expectSame(loadImage("m.png"), loadImage("waves.png"), "of the first");
}

TEST_F(BakeHighMapCommand, theFrameOfTheMapIsTheOneNamed)
{
    // Twice as wide as high under one square of uv: `cotangent` halves the slopes along u, `mikktspace` does not.
    write(quad(2), folder.path());
    const Image map = loadImage("waves.png");
    for (const char* frame : {"cotangent", "mikktspace"}) {
        const ToolRun r = bake({"--high", "quad.gltf", "--low", "quad.gltf", "--high-normals", "map", "--high-frame",
                                frame, "--kind", "object-normal", "--size", "128x128", "--samples", "1", "--quiet"});
        ASSERT_EQ(r.code, 0) << r.err;
        const Image baked = loadImage("m.png");
        const double u = frame == std::string("cotangent") ? 0.5 : 1;
        for (std::size_t i = 0; i < map.pixelCount(); ++i) {
            const glm::dvec3 m = decodedAt(map, i);                                            // green up is +y here
            ASSERT_LT(degreesBetween(decodedAt(baked, i), glm::dvec3(m.x * u, m.y, m.z)), 0.4) // half a step of 1/127
                << frame;                                                                      // in three components
        }
    }
}

TEST_F(BakeHighMapCommand, flatNormalsAreThoseOfTheTriangles)
{
    writeSquares();
    // A roof whose vertex normals all point up.
    std::ofstream(folder / "roof.obj") << "v 0 0 0\nv 0.5 0 0.05\nv 0.5 1 0.05\nv 0 1 0\nv 1 0 0\nv 1 1 0\nvn 0 0 1\n"
                                          "f 1//1 2//1 3//1\nf 1//1 3//1 4//1\nf 2//1 5//1 6//1\nf 2//1 6//1 3//1\n";
    for (const char* kind : {"smooth", "face"}) {
        ASSERT_EQ(bake({"--high", "roof.obj", "--low", "square.obj", "--high-normals", kind, "--kind", "object-normal",
                        "--size", "8x8", "--quiet", "--max-distance", "1"})
                      .code,
                  0);
        const Image baked = loadImage("m.png");
        for (std::size_t i = 0; i < 64; ++i) {
            const double slope = kind == std::string("smooth") ? 0 : i % 8 < 4 ? -0.1 : 0.1;      // 0.05 over 0.5
            EXPECT_LT(degreesBetween(decodedAt(baked, i), glm::dvec3(slope, 0, 1)), 0.4) << kind; // as above
        }
    }
}

TEST_F(BakeHighMapCommand, meshesWithoutMapAreSmoothAndCounted)
{
    write(quad(1), folder.path());
    writeSquares();
    const ToolRun r = bake(
        {"--high", "quad.gltf", "--high", "bare.obj", "--low", "square.obj", "--high-normals", "map", "--size", "8x8"});
    ASSERT_EQ(r.code, 0) << r.err;
    EXPECT_NE(r.err.find("1 of 2 high meshes"), std::string::npos) << r.err;
    const ToolRun ao =
        bake({"--high", "quad.gltf", "--low", "square.obj", "--high-normals", "map", "--kind", "ao", "--size", "2x2"});
    ASSERT_EQ(ao.code, 0) << ao.err;
    EXPECT_NE(ao.err.find("has no effect"), std::string::npos) << ao.err;
}

// Otherwise a bake would silently contain facets that were not modelled.
TEST_F(BakeHighMapCommand, highModelsAreWarnedOfWhetherTheirMapIsUsedOrNot)
{
    Made high = quad(1);
    high.root["meshes"][0]["primitives"][0]["attributes"].erase("NORMAL");
    write(high, folder.path());
    writeSquares();
    for (const char* const normals : {"smooth", "face", "map"}) {
        const ToolRun r =
            bake({"--high", "quad.gltf", "--low", "square.obj", "--high-normals", normals, "--size", "8x8"});
        ASSERT_EQ(r.code, 0) << r.err;
        EXPECT_NE(r.err.find("meshes[0].primitives[0]: no NORMAL; flat normals are generated"), std::string::npos)
            << r.err;
    }
}

TEST_F(BakeHighMapCommand, badInputGetsOneLineAndItsExitCode)
{
    write(quad(1), folder.path());
    writeSquares();
    std::ofstream(folder / "text.png") << "no image";
    const std::pair<std::vector<std::string>, int> runs[] = {
        {{"--high", "square.obj", "--high-normals", "map"}, 2},                          // no map anywhere
        {{"--high", "bare.obj", "--high-normals", "map", "--high-map", "waves.png"}, 2}, // no uv
        {{"--high", "square.obj", "--high-normals", "map", "--high-map", "text.png"}, 2},
        {{"--high", "square.obj", "--high-normals", "map", "--high-map", "missing.png"}, 2},
        {{"--high", "square.obj", "--high-normals", "map", "--high-map", "waves.png", "--high-map", "waves.png"},
         1}, // two maps for one mesh
        {{"--high", "quad.gltf", "--high-normals", "bumps"}, 1},
        {{"--high", "quad.gltf", "--high-map", "waves.png"}, 1}, // without --high-normals map
        {{"--high", "quad.gltf", "--high-normals", "face", "--high-frame", "cotangent"}, 1},
        {{"--high", "quad.gltf", "--high-normals", "map", "--high-frame", "nonsense"}, 1},
        {{"--high", "quad.gltf", "--high-normals", "map", "--high-frame", "nonperspective"}, 1},
        {{"--high", "quad.gltf", "--high-normals", "map", "--high-convention", "mine"}, 1},
    };
    for (auto [words, code] : runs) {
        words.insert(words.end(), {"--low", "square.obj", "--size", "8x8", "--quiet"});
        const ToolRun r = bake(words);
        EXPECT_EQ(r.code, code) << words[3] << r.err;
        EXPECT_EQ(lines(r.err), 1) << r.err;
        EXPECT_FALSE(std::filesystem::exists(folder / "m.png")) << r.err;
    }
}

TEST_F(BakeHighMapCommand, boomBoxBakedOntoItselfGivesItsMapBack)
{
    COTAN_NEEDS_DATA("models/BoomBox/BoomBox.gltf");
    const std::filesystem::path boomBox = dataFile("models/BoomBox/BoomBox.gltf");
    const ToolRun r =
        bake({"--high", boomBox.string(), "--low", boomBox.string(), "--high-normals", "map", "--frame", "mikktspace",
              "--size", "512x512", "--samples", "1", "--mask", "mask.png", "--max-distance", "1e-5", "--quiet"});
    ASSERT_EQ(r.code, 0) << r.err;
    const auto map = readImage(boomBox.parent_path() / "BoomBox_normal.png");
    ASSERT_TRUE(map);
    ASSERT_EQ(map->width % 1024, 0); // centres of the baked texels are corners of four of the map's
    const std::size_t step = std::size_t(map->width) / 512, width = std::size_t(map->width);
    const Image baked = loadImage("m.png"), mask = loadImage("mask.png");
    std::size_t compared = 0, differing = 0;
    double mean = 0;
    for (std::size_t y = 0; y < 512; ++y)
        for (std::size_t x = 0; x < 512; ++x) {
            const std::uint8_t* state = mask.bytes8() + 4 * (512 * y + x);
            if (state[0] != 0 || state[1] != 179 || state[2] != 0) // only green: one triangle, hit, above the horizon
                continue;
            glm::dvec3 m(0);
            for (std::size_t k = 0; k < 4; ++k)
                m += decodedAt(*map, (y * step + step / 2 - 1 + k / 2) * width + x * step + step / 2 - 1 + k % 2);
            const double degrees = degreesBetween(decodedAt(baked, 512 * y + x), m);
            mean += degrees;
            differing += degrees > 1;
            ++compared;
        }
    ASSERT_GT(compared, 100000u);
    EXPECT_LT(mean / double(compared), 0.25);               // 8 bits: see docs/explanation/baking.md, below 0.20
    EXPECT_LT(double(differing), 0.002 * double(compared)); // where two parts are within 1e-5 of each other
}

} // namespace
} // namespace cotan::test
