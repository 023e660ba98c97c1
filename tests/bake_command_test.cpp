// `cotan bake` as a user runs it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>

#include <nlohmann/json.hpp>

#include "cotan/image.hpp"
#include "run_tool.hpp"
#include "test_data.hpp"
#include "truth/quad.hpp"

namespace cotan::test {
namespace {

std::filesystem::path waves(const char* file) { return dataFile(std::string("bake/synthetic_waves/") + file); }

glm::dvec3 decoded(const Image& image, std::size_t i, bool green)
{
    auto component = [&](std::size_t k) {
        return image.type == PixelType::unorm16 ? (image.words()[4 * i + k] - 32768.0) / 32767
                                                : (image.bytes8()[4 * i + k] - 128.0) / 127;
    };
    return {component(0), component(1) * (green ? 1 : -1), component(2)};
}

// A plane that leans by 0.6 along x and 0.64 along y, over a square: every texel has one direction, whose codes are
// arithmetic. Engines decode them with 2c - 1; the neutral words mean 128 + 127 x.
TEST(BakeCommand, presetsOfEnginesWriteWhatTheirShadersExpand)
{
    TemporaryFolder folder;
    const char* const triangles = "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n";
    std::ofstream low(folder / "low.obj"), high(folder / "high.obj");
    for (std::ofstream* file : {&low, &high}) {
        const bool leans = file == &high;
        for (const auto& [x, y] : {std::pair(0.0, 0.0), {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}})
            *file << "v " << x << " " << y << " " << (leans ? -(0.6 * x + 0.64 * y) / 0.48 : 0.0) << "\nvt " << x << " "
                  << y << "\n";
        *file << triangles;
        file->close();
    }
    const auto bytes = [&](const std::vector<std::string>& words) {
        EXPECT_EQ(runTool(words, folder.path()).code, 0);
        const auto map = readImage(folder / "map.png");
        return std::vector<int>{map->bytes8()[0], map->bytes8()[1]};
    };
    const auto baked = [&](const std::string& convention) {
        return bytes({"bake", "--high", "high.obj", "--low", "low.obj", "--size", "4", "--max-distance", "9",
                      "--convention", convention, "--overwrite", "-o", "map.png"});
    };
    const auto engine = [](double x) { return int(std::lround(255 * (0.5 + 0.5 * x))); };
    const auto neutral = [](double x) { return int(std::lround(128 + 127 * x)); };
    const std::vector<int> up{engine(0.6), engine(0.64)}, down{up[0], engine(-0.64)};
    for (const char* preset : {"gltf", "unity", "blender", "godot", "opengl,biased"})
        EXPECT_EQ(baked(preset), up) << preset;
    EXPECT_EQ(baked("unreal"), down);
    const std::vector<int> exact{neutral(0.6), neutral(0.64)};
    for (const char* preset : {"opengl", "maya", "unity,exact"})
        EXPECT_EQ(baked(preset), exact) << preset;
    ASSERT_NE(down[1], neutral(-0.64));
    baked("opengl");
    std::filesystem::rename(folder / "map.png", folder / "neutral.png");
    for (const auto& [to, codes] : {std::pair("unreal", down), {"blender", up}, {"opengl", exact}})
        EXPECT_EQ(
            bytes({"map", "convert", "neutral.png", "--from", "opengl", "--to", to, "--overwrite", "-o", "map.png"}),
            codes)
            << to;
}

// The high mesh is a grid of 128 cells with analytic normals at its vertices. Texel centres of a 64 x 64 map coincide
// with vertices, so the answer is exact there.
TEST(BakeCommand, syntheticWavesComeOutExactInBothGreenConventions)
{
    COTAN_NEEDS_DATA("bake/synthetic_waves/high.obj");
    std::vector<glm::dvec3> normals;
    std::istringstream lines(readWhole(waves("high.obj")));
    for (std::string line; std::getline(lines, line);)
        if (glm::dvec3 n; std::sscanf(line.c_str(), "vn %lf %lf %lf", &n.x, &n.y, &n.z) == 3)
            normals.push_back(n);
    ASSERT_EQ(normals.size(), 129u * 129u);
    TemporaryFolder folder;
    for (const char* convention : {"opengl", "directx"})
        for (const char* bits : {"8", "16"}) {
            const ToolRun r = runTool({"bake", "--high", waves("high.obj").string(), "--low", waves("low.obj").string(),
                                       "--size", "64x64", "--samples", "1", "--bits", bits, "--convention", convention,
                                       "--frame", "cotangent", "-o", "map.png", "--quiet"},
                                      folder.path());
            ASSERT_EQ(r.code, 0) << r.err;
            const auto map = readImage(folder / "map.png");
            ASSERT_TRUE(map);
            double mean = 0;
            for (std::size_t j = 0; j < 64; ++j)
                for (std::size_t i = 0; i < 64; ++i)
                    mean += degreesBetween(decoded(*map, j * 64 + i, convention == std::string("opengl")),
                                           normals[(128 - (2 * j + 1)) * 129 + 2 * i + 1])
                        / 4096;
            EXPECT_LT(mean, bits == std::string("8") ? 0.2 : 0.01) << convention << ", " << bits;
        }
}

// Mean angle to the exact map of the same size, 256 x 256: each cell of the high mesh has four texels.
double degreesFromWaves(const char* normals, const char* convention, const char* bits)
{
    const auto truth = readImage(waves("normal_gl16.png"));
    TemporaryFolder folder;
    const ToolRun r = runTool({"bake", "--high", waves("high.obj").string(), "--low", waves("low.obj").string(),
                               "--size", "256x256", "--samples", "1", "--bits", bits, "--convention", convention,
                               "--high-normals", normals, "-o", "map.png", "--quiet"},
                              folder.path());
    EXPECT_EQ(r.code, 0) << r.err;
    const auto map = readImage(folder / "map.png");
    if (!truth || !map || map->pixelCount() != truth->pixelCount())
        return 180;
    double mean = 0;
    for (std::size_t i = 0; i < truth->pixelCount(); ++i) {
        const glm::dvec3 t(truth->words()[4 * i] / 32767.5 - 1, truth->words()[4 * i + 1] / 32767.5 - 1,
                           truth->words()[4 * i + 2] / 32767.5 - 1); // stored as n/2 + 1/2
        mean += degreesBetween(decoded(*map, i, convention == std::string("opengl")), t) / double(truth->pixelCount());
    }
    return mean;
}

TEST(BakeCommand, syntheticWavesComeOutExactBetweenTheVerticesOfACurvedSurface)
{
    COTAN_NEEDS_DATA("bake/synthetic_waves/high.obj");
    for (const char* convention : {"opengl", "directx"}) {
        EXPECT_LT(degreesFromWaves("curved", convention, "8"), 0.2) << convention;
        EXPECT_LT(degreesFromWaves("curved", convention, "16"), 0.01) << convention;
    }
    // The error of linear interpolation: an eighth of the squared cell size times the normal's second derivative.
    EXPECT_GT(degreesFromWaves("smooth", "opengl", "16"), 0.1);
}

TEST(BakeCommand, bunnyIsDrawnLikeItsHighMesh)
{
    COTAN_NEEDS_DATA("bake/bunny/bunny_high.obj");
    const std::filesystem::path bunny = dataFile("bake/bunny");
    TemporaryFolder folder;
    const ToolRun r = runTool({"bake", "--high", (bunny / "bunny_high.obj").string(), "--low",
                               (bunny / "bunny_low.obj").string(), "--size", "1024x1024", "--frame", "smooth", "-o",
                               "map.png", "--verify", "views", "--json", "r.json", "--quiet"},
                              folder.path(), 240);
    ASSERT_EQ(r.code, 0) << r.err;
    const auto report = nlohmann::json::parse(readWhole(folder / "r.json"));
    // The mean measured at this size is 0.6: filtering of the map, and more where rays of neighbouring texels diverge.
    EXPECT_LT(report["verify"]["all"]["mean_degrees"].get<double>(), 1.0);
    EXPECT_LT(report["verify"]["all"]["median_degrees"].get<double>(), 0.6);
    EXPECT_LT(report["bake"]["missed"].get<double>(), 0.01 * report["bake"]["covered"].get<double>());
    for (const char* file : {"error-0.png", "low-3.png", "high-2.png"})
        EXPECT_TRUE(std::filesystem::exists(folder / "views" / file)) << file;
}

TEST(BakeCommand, warnsOnlyOfTexelsBelowTheHorizon)
{
    TemporaryFolder folder;
    const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
    std::ofstream(folder / "low.obj") << square << "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n";
    for (const bool below : {true, false}) {
        std::ofstream(folder / "high.obj")
            << square << "vn 0 0.6 " << (below ? "-0.8" : "0.8") << "\nf 1//1 2//1 3//1 4//1\n";
        const ToolRun r =
            runTool({"bake", "--high", "high.obj", "--low", "low.obj", "--size", "4", "-o", "m.png", "--overwrite"},
                    folder.path());
        EXPECT_EQ(r.code, 0) << r.err;
        EXPECT_EQ(
            r.err.find(
                "16 of 16 covered texels, most of them around texel 1, 1, point below the frame's horizon, by 53 ")
                != std::string::npos,
            below)
            << r.err;
    }
}

// Low and high planes in z = 0, with a tilted slab over the middle of the high one: from outside the slab is seen.
void writeSlab(const std::filesystem::path& folder)
{
    std::ofstream(folder / "low.obj") << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                                         "f 1/1 2/2 3/3 4/4\n";
    std::ofstream(folder / "high.obj") << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"
                                          "v 0.3 0.3 0.03\nv 0.7 0.3 0.09\nv 0.7 0.7 0.09\nv 0.3 0.7 0.03\nf 5 6 7 8\n";
}

TEST(BakeCommand, verifyFailsIfTheFrontSurfaceIsNotInTheMap)
{
    TemporaryFolder folder;
    writeSlab(folder.path());
    const auto verified = [&](const std::vector<std::string>& more, ToolRun& run) {
        std::vector<std::string> words{"bake",    "--high",      "high.obj", "--low",    "low.obj",  "--size",
                                       "128x128", "-o",          "m.png",    "--verify", "views",    "--json",
                                       "r.json",  "--overwrite", "--frame",  "smooth",   "--device", "reference"};
        words.insert(words.end(), more.begin(), more.end());
        run = runTool(words, folder.path(), 240);
        EXPECT_EQ(run.code, 0) << run.err;
        return nlohmann::json::parse(readWhole(folder / "r.json"))["verify"];
    };
    ToolRun run;
    const auto right = verified({}, run);
    EXPECT_EQ(run.err.find("do not show"), std::string::npos) << run.err;
    EXPECT_TRUE(right["shows_the_high_surface"]);
    EXPECT_LT(right["all"]["median_degrees"].get<double>(), 0.3); // 8 bits
    // The older rule takes the plane below: a sixth of the square, an error of 8.5 degrees.
    const auto wrong = verified({"--search", "nearest"}, run);
    EXPECT_NE(run.err.find("do not show the surface that the high mesh shows"), std::string::npos) << run.err;
    EXPECT_FALSE(wrong["shows_the_high_surface"]);
    const double fraction = wrong["all"]["another_surface"].get<double>() / wrong["all"]["surface_known"].get<double>();
    EXPECT_NEAR(fraction, 0.16, 0.02);
    EXPECT_NEAR(wrong["all"]["mean_degrees"].get<double>(), fraction * 8.53, 0.2);
    // The image of the high mesh shows its tilted slab, whatever the map contains.
    const auto high = readImage(folder / "views" / "high-0.png"), error = readImage(folder / "views" / "error-0.png");
    ASSERT_TRUE(high && error);
    const std::size_t middle =
        4 * (std::size_t(high->height) / 2 * std::size_t(high->width) + std::size_t(high->width) / 2);
    EXPECT_NEAR(double(high->bytes8()[middle]), (1 - std::sin(0.1489)) * 127.5, 1.5); // a slope of 0.15
    EXPECT_EQ(int(error->bytes8()[middle]), 255);                                     // magenta
    EXPECT_EQ(int(error->bytes8()[middle + 1]), 0);
    EXPECT_EQ(int(error->bytes8()[middle + 2]), 255);
}

TEST(BakeCommand, warningsBlameTheDistanceOnlyIfItIsTheCause)
{
    TemporaryFolder folder;
    writeSlab(folder.path());
    const auto bake = [&](const std::string& high, const std::vector<std::string>& more) {
        std::vector<std::string> words{"bake",  "--high", high,    "--low",       "low.obj", "--size",
                                       "64x64", "-o",     "m.png", "--overwrite", "--frame", "smooth"};
        words.insert(words.end(), more.begin(), more.end());
        const ToolRun r = runTool(words, folder.path());
        EXPECT_EQ(r.code, 0) << r.err;
        return r.err;
    };
    EXPECT_EQ(bake("high.obj", {}).find("nearest"), std::string::npos); // a slab that floats is no problem
    // A gap under five columns of texels: the warning must blame no distance and give no percentage.
    std::ofstream(folder / "hole.obj") << "v 0 0 0\nv 0.43 0 0\nv 0.43 1 0\nv 0 1 0\nv 0.501 0 0\nv 1 0 0\nv 1 1 0\n"
                                          "v 0.501 1 0\nf 1 2 3 4\nf 5 6 7 8\n";
    const std::string hole = bake("hole.obj", {});
    EXPECT_NE(hole.find("have no high surface in front or behind at any distance"), std::string::npos) << hole;
    EXPECT_EQ(hole.find("further away"), std::string::npos) << hole;
    EXPECT_EQ(hole.find('%'), std::string::npos) << hole;
    // Too far away under a rule that names its search distance.
    std::ofstream(folder / "far.obj") << "v 0 0 0.5\nv 1 0 0.5\nv 1 1 0.5\nv 0 1 0.5\nf 1 2 3 4\n";
    const std::string far = bake("far.obj", {"--max-distance", "0.2"});
    EXPECT_NE(far.find(" found no high surface within 0.2 units; there is one further away"), std::string::npos) << far;
    EXPECT_EQ(far.find("at any distance"), std::string::npos) << far;
}

struct Files {
    TemporaryFolder folder;
    Files()
    {
        const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
        std::ofstream(folder / "low.obj") << square << "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n";
        std::ofstream(folder / "bare.obj") << square << "f 1 2 3\nf 1 3 4\n";
        std::ofstream(folder / "one.obj") << square << "f 1 2 3\n";
        std::ofstream(folder / "empty.obj") << "v 0 0 0\n";
    }
};

TEST(BakeCommand, badInputGetsOneLineAndItsExitCode)
{
    Files files;
    const std::pair<std::vector<std::string>, int> runs[] = {
        {{"--high", "bare.obj", "--low", "bare.obj", "-o", "m.png"}, 2}, // no uv
        {{"--high", "empty.obj", "--low", "low.obj", "-o", "m.png"}, 2}, // nothing to hit
        {{"--high", "missing.obj", "--low", "low.obj", "-o", "m.png"}, 2},
        {{"--high", "bare.obj", "--low", "low.obj", "-o", "m.png", "--cage", "one.obj"}, 2}, // another topology
        {{"--high", "bare.obj", "--low", "low.obj", "-o", "no/folder/m.png"}, 4},
        {{"--high", "bare.obj", "--low", "low.obj"}, 1},
        {{"--high", "bare.obj", "--low", "low.obj", "-o", "m.png", "--size", "100000x100000"}, 1},
        {{"--high", "bare.obj", "--low", "low.obj", "-o", "m.png", "--size", "0x8"}, 1},
        {{"--high", "bare.obj", "--low", "low.obj", "-o", "m.png", "--frame", "nonperspective"}, 1},
        {{"--high", "bare.obj", "--low", "low.obj", "-o", "m.png", "--convention", "mine"}, 1},
        {{"--high", "bare.obj", "--low", "low.obj", "-o", "m.png", "--search", "last"}, 1},
        {{"--high", "bare.obj", "--low", "low.obj", "-o", "m.png", "--extrusion", "-1"}, 1},
        {{"--high", "bare.obj", "--low", "low.obj", "-o", "m.png", "--extrusion", "1", "--search", "nearest"}, 1},
        {{"--high", "bare.obj", "--low", "low.obj", "-o", "m.png", "--extrusion", "1", "--cage", "low.obj"}, 1},
        {{"--high", "bare.obj", "--low", "low.obj", "-o", "m.png", "--search", "nearest", "--cage", "low.obj"}, 1},
        {{"--high", "bare.obj", "--low", "low.obj", "-o", "m.xyz", "--size", "8x8"}, 1},
    };
    for (auto [words, code] : runs) {
        words.insert(words.begin(), {"bake", "--quiet"});
        const ToolRun r = runTool(words, files.folder.path());
        EXPECT_EQ(r.code, code) << words.back() << r.err;
        EXPECT_EQ(std::count(r.err.begin(), r.err.end(), '\n'), 1) << r.err;
        EXPECT_FALSE(std::filesystem::exists(files.folder / "m.png")) << words.back();
    }
}

TEST(BakeCommand, aFlatBakeIsFlatAndCreasesAreWarnedOf)
{
    Files files;
    const ToolRun r = runTool({"bake", "--high", "bare.obj", "--low", "low.obj", "-o", "m.png", "--size", "5x3",
                               "--frame", "cotangent", "--mask", "mask.png"},
                              files.folder.path());
    ASSERT_EQ(r.code, 0) << r.err;
    EXPECT_NE(r.err.find("bake and draw with smooth"), std::string::npos);
    const auto map = readImage(files.folder / "m.png");
    ASSERT_TRUE(map);
    EXPECT_EQ(map->width, 5);
    EXPECT_EQ(map->height, 3);
    for (std::size_t i = 0; i < 15; ++i) {
        EXPECT_EQ(int(map->bytes8()[4 * i]), 128);
        EXPECT_EQ(int(map->bytes8()[4 * i + 2]), 255);
    }
    EXPECT_TRUE(std::filesystem::exists(files.folder / "mask.png"));
}

} // namespace
} // namespace cotan::test
