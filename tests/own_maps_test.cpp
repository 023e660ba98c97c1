// --normal-map, --base-color and similar options: images applied to a model and read by the given convention; and bake
// -o MODEL, which stores the map in the model.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "cotan/image.hpp"
#include "cotan/model.hpp"
#include "quad_model.hpp"
#include "run_tool.hpp"

namespace cotan::test {
namespace {

// Writes a map with the same texel everywhere.
void writeMap(const std::filesystem::path& file, std::array<int, 4> texel)
{
    Image image = makeImage(4, 4, PixelType::unorm8);
    for (std::size_t i = 0; i < image.data.size(); ++i)
        image.bytes8()[i] = std::uint8_t(texel[i % 4]);
    ASSERT_TRUE(writeImage(file, image));
}

// Writes a unit square in xy that faces +z, u along x, the file's v along y.
void writeSquare(const std::filesystem::path& file, bool texcoords = true)
{
    std::ofstream obj(file);
    obj << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\n";
    if (texcoords)
        obj << "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1/1 2/2/1 3/3/1 4/4/1\n";
    else
        obj << "f 1//1 2//1 3//1 4//1\n";
}

glm::vec3 normalInTheMiddle(const std::filesystem::path& file)
{
    const auto image = readImage(file);
    EXPECT_TRUE(image);
    if (!image)
        return {};
    const std::size_t at =
        4 * (std::size_t(image->height / 2) * std::size_t(image->width) + std::size_t(image->width / 2));
    const std::uint8_t* c = image->bytes8() + at;
    return glm::vec3(c[0], c[1], c[2]) / 127.5f - 1.0f;
}

const std::vector<std::string> kView = {"--size",  "64x64", "--camera", "0.5,0.5,2,0.5,0.5,0", "--device", "reference",
                                        "--quiet", "-o",    "n.png"};

std::vector<std::string> drawn(std::vector<std::string> words)
{
    const bool views = std::find(words.begin(), words.end(), "--view") != words.end();
    words.insert(words.end(), kView.begin(), kView.end());
    if (!views)
        words.insert(words.end(), {"--view", "normal"});
    return words;
}

// The texel (0.6, 0.48, 0.64): x to the right, y up for green up, down for green down. A byte's step is 0.0079; half of
// it in three components moves a unit vector by at most 0.007. The render rounds once more.
TEST(OwnMaps, mapIsReadWithTheGivenConvention)
{
    TemporaryFolder folder;
    writeSquare(folder / "square.obj");
    const auto byte = [](double x) { return int(std::lround(x * 127 + 128)); };
    writeMap(folder / "xyz.png", {byte(0.6), byte(0.48), byte(0.64), 255});
    // The same direction in two channels: x and y as red and green.
    writeMap(folder / "rg.png", {byte(0.6), byte(0.48), 0, 255});
    const struct {
        const char* file;
        const char* convention;
        double green;
    } cases[] = {{"xyz.png", "gltf", 1},    {"xyz.png", "opengl", 1},           {"xyz.png", "directx", -1},
                 {"xyz.png", "3dsmax", -1}, {"rg.png", "gltf,orthographic", 1}, {"rg.png", "unreal,xy", -1}};
    for (const auto& c : cases) {
        const ToolRun r = runTool(drawn({"render", "square.obj", "--normal-map", c.file, "--convention", c.convention}),
                                  folder.path());
        ASSERT_EQ(r.code, 0) << r.err;
        const glm::vec3 n = normalInTheMiddle(folder / "n.png");
        EXPECT_LT(glm::distance(n, glm::vec3(0.6, 0.48 * c.green, 0.64)), 0.015) << c.file << " as " << c.convention;
    }
}

// The same texel in BC5, whose codes are 8 bits, and as red and green with the middle code in blue.
TEST(OwnMaps, twoChannelFilesAreReadAsTwoChannels)
{
    TemporaryFolder folder;
    writeSquare(folder / "square.obj");
    writeMap(folder / "xyz.png", {204, 189, 209, 255});
    writeMap(folder / "middle.png", {204, 189, 128, 255});
    for (const char* file : {"bc5.ktx2", "bc5.dds"})
        ASSERT_EQ(
            runTool({"map", "convert", "xyz.png", "--from", "gltf", "--to", "gltf", "--compress", "bc5", "-o", file},
                    folder.path())
                .code,
            0);
    for (const char* file : {"bc5.ktx2", "bc5.dds", "middle.png"}) {
        const ToolRun r = runTool(drawn({"render", "square.obj", "--normal-map", file}), folder.path());
        ASSERT_EQ(r.code, 0) << r.err;
        EXPECT_LT(glm::distance(normalInTheMiddle(folder / "n.png"), glm::vec3(0.6, 0.48, 0.64)), 0.015) << file;
    }
    const ToolRun wrong =
        runTool(drawn({"render", "square.obj", "--normal-map", "bc5.ktx2", "--convention", "gltf,xyz"}), folder.path());
    EXPECT_EQ(wrong.code, 1);
    EXPECT_EQ(lines(wrong.err), 1) << wrong.err;
    EXPECT_NE(wrong.err.find("--convention: bc5.ktx2 stores two channels"), std::string::npos) << wrong.err;
}

TEST(OwnMaps, errorsAreOneLine)
{
    TemporaryFolder folder;
    writeSquare(folder / "square.obj");
    writeSquare(folder / "bare.obj", false);
    writeMap(folder / "map.png", {128, 128, 255, 255});
    std::ofstream(folder / "text.png") << "not a picture";
    const struct {
        std::vector<std::string> words;
        int code;
        const char* says;
    } cases[] = {
        {{"render", "square.obj", "--convention", "directx"}, 1, "--convention: expected --normal-map"},
        {{"render", "square.obj", "--material", "0"}, 1, "--material: expected --normal-map"},
        {{"render", "square.obj", "--normal-map", "map.png", "--convention", "gltf,object"}, 1, "tangent-space map"},
        {{"render", "square.obj", "--normal-map", "map.png", "--convention", "left"}, 1, "found 'left'"},
        {{"render", "square.obj", "--normal-map", "map.png", "--material", "7"}, 1, "found 7"},
        {{"render", "square.obj", "--base-color", "map.png", "--material", "7"}, 1, "found 7"},
        {{"render", "square.obj", "--occlusion", "map.png", "--convention", "directx"}, 1, "expected --normal-map"},
        {{"render", "bare.obj", "--base-color", "map.png"}, 2, "expected a mesh with texture coordinates"},
        {{"render", "square.obj", "--metallic-roughness", "none.png"}, 2, "none.png"},
        {{"render", "bare.obj", "--normal-map", "map.png"}, 2, "expected a mesh with texture coordinates"},
        {{"render", "square.obj", "--normal-map", "none.png"}, 2, "none.png"},
        {{"render", "square.obj", "--normal-map", "text.png"}, 2, "text.png"},
        {{"render", "square.obj", "--height-map", "text.png"}, 2, "text.png"},
        {{"render", "square.obj", "--height-map", "none.png"}, 2, "none.png"},
        {{"render", "bare.obj", "--height-map", "map.png"}, 2, "expected a mesh with texture coordinates"},
        {{"render", "square.obj", "--height-map", "map.png", "--material", "7"}, 1, "found 7"},
        {{"render", "square.obj", "--height-map", "map.png", "--height-depth", "-1"}, 1, "found '-1'"},
        {{"render", "square.obj", "--height-map", "map.png", "--height-depth", "nan"}, 1, "found 'nan'"},
        {{"render", "square.obj", "--height-map", "map.png", "--height-depth", "deep"}, 1, "found 'deep'"},
        {{"render", "square.obj", "--view", "mask", "--mask", "text.png"}, 2, "text.png"},
        {{"render", "square.obj", "--view", "mask", "--mask", "none.png"}, 2, "none.png"},
        {{"render", "bare.obj", "--view", "mask", "--mask", "map.png"}, 2, "expected a mesh with texture coordinates"},
        {{"render", "square.obj", "--view", "mask"}, 1, "--view mask: expected --mask FILE"},
        {{"render", "square.obj", "--height-depth", "0.1"}, 1, "--height-depth: expected --height-map"}};
    for (const auto& c : cases) {
        const ToolRun r = runTool(drawn(c.words), folder.path());
        EXPECT_EQ(r.code, c.code) << c.says;
        EXPECT_NE(r.err.find(c.says), std::string::npos) << r.err;
        EXPECT_EQ(lines(r.err), 1) << r.err;
        EXPECT_FALSE(std::filesystem::exists(folder / "n.png"));
    }
}

// Heights of a step: `left` where u < 1/2, else `right`.
void writeStep(const std::filesystem::path& file, PixelType type, double left, double right)
{
    Image image = makeImage(64, 64, type);
    for (std::size_t i = 0; i < image.pixelCount() * 4; ++i) {
        const double h = i / 4 % 64 < 32 ? left : right;
        if (type == PixelType::float32)
            image.floats()[i] = float(h);
        else if (type == PixelType::unorm16)
            image.words()[i] = std::uint16_t(std::lround(h * 65535));
        else
            image.bytes8()[i] = std::uint8_t(std::lround(h * 255));
    }
    ASSERT_TRUE(writeImage(file, image));
}

// The u that the middle of an image of uv shows: 0.75 without heights. Seen from 45 degrees at the left, a right half
// that lies d lower moves it by d.
double seenU(const std::filesystem::path& folder, std::vector<std::string> words)
{
    words.insert(words.begin(), {"render", "square.obj"});
    words.insert(words.end(),
                 {"--size", "64x64", "--view", "uv", "--camera", "0.25,0.5,0.5,0.75,0.5,0,h0.3", "--device",
                  "reference", "--quiet", "-o", "n.png", "--overwrite"});
    const ToolRun r = runTool(words, folder);
    EXPECT_EQ(r.code, 0) << r.err;
    const auto image = readImage(folder / "n.png");
    EXPECT_TRUE(image);
    return image ? image->bytes8()[4 * (32 * 64 + 32)] / 255.0 : 0;
}

// A pixel is 0.007 of u wide, and 0.75 is half a pixel off the middle. A code of the image is 0.004.
TEST(OwnMaps, heightsLieBelowTheSurfaceByTheDepthOrByTheRangeOfFloats)
{
    TemporaryFolder folder;
    writeSquare(folder / "square.obj");
    writeStep(folder / "8.png", PixelType::unorm8, 1, 0);
    writeStep(folder / "16.png", PixelType::unorm16, 1, 0);
    writeStep(folder / "grey.png", PixelType::unorm16, 1, 0.5);
    writeStep(folder / "metres.exr", PixelType::float32, 3, 2.9);
    writeStep(folder / "flat.png", PixelType::unorm16, 0.5, 0.5);
    writeStep(folder / "flat.exr", PixelType::float32, 7, 7);
    writeStep(folder / "broken.exr", PixelType::float32, 7, std::nan(""));
    const double plain = seenU(folder.path(), {});
    EXPECT_NEAR(plain, 0.75, 0.008);
    const struct {
        const char *file, *depth;
        double moved;
    } cases[] = {{"8.png", "0.1", 0.1},     {"16.png", "0.1", 0.1},
                 {"grey.png", "0.1", 0.05}, {"8.png", "", 0.02 * std::sqrt(2.0)}, // 2 % of the square's diagonal
                 {"metres.exr", "", 0.1},   {"metres.exr", "0.2", 0.2},
                 {"8.png", "0", 0},         {"metres.exr", "0", 0},
                 {"flat.png", "0.1", 0},    {"flat.exr", "0.1", 0},
                 {"flat.exr", "", 0},       {"broken.exr", "0.1", 0}};
    for (const auto& c : cases) {
        std::vector<std::string> words = {"--height-map", c.file};
        if (*c.depth)
            words.insert(words.end(), {"--height-depth", c.depth});
        EXPECT_NEAR(seenU(folder.path(), words) - plain, c.moved, 0.005) << c.file << ' ' << c.depth;
    }
}

double meanOf(const std::filesystem::path& file)
{
    const auto image = readImage(file);
    EXPECT_TRUE(image);
    double sum = 0;
    for (std::size_t i = 0; image && i < image->data.size(); ++i)
        sum += i % 4 < 3 ? image->bytes8()[i] : 0;
    return sum;
}

TEST(OwnMaps, colourMapEqualsTheOneOfAMaterialFile)
{
    TemporaryFolder folder;
    writeSquare(folder / "plain.obj");
    std::ofstream(folder / "named.obj") << "mtllib m.mtl\nusemtl m\n" << readWhole(folder / "plain.obj");
    std::ofstream(folder / "m.mtl") << "newmtl m\nKd 1 1 1\nNs 0\nmap_Kd red.png\n";
    writeMap(folder / "red.png", {230, 20, 60, 255});
    const std::vector<std::string> seen = {"--size",   "64x64",    "--camera", "0.5,0.5,2,0.5,0.5,0",
                                           "--device", "reference"};
    const auto draw = [&](std::vector<std::string> words) {
        words.insert(words.end(), seen.begin(), seen.end());
        const ToolRun r = runTool(words, folder.path());
        EXPECT_EQ(r.code, 0) << r.err;
    };
    // The same material in another colour: the option replaces both Kd and map_Kd.
    draw({"render", "named.obj", "-o", "file.png"});
    std::ofstream(folder / "m.mtl") << "newmtl m\nKd 0.2 0.3 0.9\nNs 0\nmap_Kd blue.png\n";
    writeMap(folder / "blue.png", {0, 0, 255, 255});
    draw({"render", "named.obj", "-o", "other.png"});
    draw({"render", "named.obj", "--base-color", "red.png", "-o", "own.png"});
    EXPECT_NE(readWhole(folder / "file.png"), readWhole(folder / "other.png"));
    EXPECT_EQ(readWhole(folder / "file.png"), readWhole(folder / "own.png"));
}

TEST(OwnMaps, roughnessAndOcclusionMapsChangeLight)
{
    TemporaryFolder folder;
    writeSquare(folder / "square.obj");
    writeMap(folder / "black.png", {0, 0, 0, 255});
    writeMap(folder / "white.png", {255, 255, 255, 255});
    writeMap(folder / "dielectric.png", {0, 255, 0, 255}); // rough, not metallic
    const auto mean = [&](std::vector<std::string> words) {
        words.insert(words.begin(),
                     {"render", "square.obj", "--size", "64x64", "--camera", "0.5,0.5,2,0.5,0.5,0", "--device",
                      "reference", "-o", "n.png", "--overwrite"});
        const ToolRun r = runTool(words, folder.path());
        EXPECT_EQ(r.code, 0) << r.err;
        return meanOf(folder / "n.png");
    };
    const double plain = mean({});
    EXPECT_EQ(mean({"--occlusion", "white.png"}), plain);
    EXPECT_LT(mean({"--occlusion", "black.png"}), plain);
    // Metals have no diffuse light.
    EXPECT_LT(mean({"--metallic-roughness", "white.png"}), mean({"--metallic-roughness", "dielectric.png"}));
}

// A constant tilt is not a relief; lint's statements must be about the file given by the option.
TEST(OwnMaps, lintAndCompareReadOwnMaps)
{
    TemporaryFolder folder;
    writeSquare(folder / "square.obj");
    writeMap(folder / "leaning.png", {200, 128, 220, 255});
    const ToolRun lint = runTool({"lint", "square.obj", "--normal-map", "leaning.png", "--json", "-"}, folder.path());
    ASSERT_EQ(lint.code, 0) << lint.err;
    const auto report = nlohmann::json::parse(lint.out);
    ASSERT_EQ(report["maps"].size(), 1u);
    EXPECT_NE(report["maps"][0]["name"].get<std::string>().find("leaning.png"), std::string::npos);
    const ToolRun compare =
        runTool({"compare", "square.obj", "--normal-map", "leaning.png", "--frames", "cotangent,orthonormal", "--size",
                 "64x64", "--device", "reference", "-o", "out", "--json", "-"},
                folder.path());
    ASSERT_EQ(compare.code, 0) << compare.err;
    EXPECT_LT(nlohmann::json::parse(compare.out)["normals"]["max_degrees"].get<double>(),
              0.01); // square texels: the frames agree
}

// Writes a mesh with a bump between two flat squares.
void writeBump(const std::filesystem::path& file)
{
    std::ofstream obj(file);
    constexpr int kCells = 16;
    for (int j = 0; j <= kCells; ++j)
        for (int i = 0; i <= kCells; ++i) {
            const double x = double(i) / kCells, y = double(j) / kCells;
            obj << "v " << x << ' ' << y << ' ' << 0.05 * std::sin(6.28318530718 * x) * y << '\n';
        }
    for (int j = 0; j < kCells; ++j)
        for (int i = 0; i < kCells; ++i) {
            const int a = j * (kCells + 1) + i + 1, c = a + kCells + 1;
            obj << "f " << a << ' ' << a + 1 << ' ' << c + 1 << ' ' << c << '\n';
        }
}

class BakeIntoModel : public testing::TestWithParam<const char*> {};

// The model that bake writes renders the same, to the bit, as the low mesh with the map that bake writes to an image,
// for OBJ and glTF.
TEST_P(BakeIntoModel, drawsAsTheMapOnTheLowMesh)
{
    TemporaryFolder folder;
    writeSquare(folder / "low.obj");
    writeBump(folder / "high.obj");
    const std::string frame = GetParam();
    const auto bake = [&](const char* low, const char* out) {
        const ToolRun r = runTool({"bake", "--high", "high.obj", "--low", low, "--size", "64x64", "--max-distance",
                                   "0.2", "--frame", frame, "--unsigned", "exact", "--quiet", "-o", out},
                                  folder.path());
        EXPECT_EQ(r.code, 0) << r.err;
    };
    const auto renderData = [&](std::vector<std::string> words) {
        words.insert(words.end(), {"--frame", frame});
        const ToolRun r = runTool(drawn(words), folder.path());
        EXPECT_EQ(r.code, 0) << r.err;
        const auto image = readImage(folder / "n.png");
        return image ? image->data : std::vector<std::byte>();
    };
    bake("low.obj", "map.png");
    bake("low.obj", "first.glb");
    bake("first.glb", "second.gltf"); // replaces the map and finds the files of the .gltf
    const auto expected = renderData({"render", "low.obj", "--normal-map", "map.png", "--convention", "opengl"});
    ASSERT_FALSE(expected.empty());
    EXPECT_EQ(renderData({"render", "first.glb"}), expected);
    EXPECT_EQ(renderData({"render", "second.gltf"}), expected);
    const auto flat = renderData({"render", "low.obj"});
    EXPECT_NE(flat, expected); // the bump is visible
    const auto scene = loadGltf(folder / "second.gltf");
    ASSERT_TRUE(scene);
    EXPECT_EQ(nlohmann::json::parse(readWhole(folder / "second.gltf"))["images"].size(), 1u); // the first map is gone
    EXPECT_EQ(scene->meshes[0].tangents.empty(), frame != "mikktspace" && frame != "vertex");
}

// Green points up in the model's map; read as green down, every normal is mirrored in y.
TEST(OwnMaps, conventionAloneAppliesToTheMapsOfTheModel)
{
    TemporaryFolder folder;
    write(quad(1), folder.path());
    writeSquare(folder / "plain.obj");
    std::vector<Image> renders;
    for (const char* words : {"gltf,exact", "directx", "opengl"}) {
        const ToolRun r = runTool(drawn({"render", "quad.gltf", "--convention", words}), folder.path());
        ASSERT_EQ(r.code, 0) << r.err;
        renders.push_back(*readImage(folder / "n.png"));
    }
    int largest = 0;
    for (std::size_t i = 1; i < renders[0].data.size(); i += 4) {
        if (renders[0].bytes8()[i + 2] == 0) // background
            continue;
        const int up = renders[0].bytes8()[i], down = renders[1].bytes8()[i];
        EXPECT_NEAR(up + down, 255, 2);
        EXPECT_EQ(up, renders[2].bytes8()[i]);
        largest = std::max(largest, std::abs(up - down));
    }
    EXPECT_GT(largest, 40);
    const ToolRun none = runTool(drawn({"render", "plain.obj", "--convention", "directx"}), folder.path());
    EXPECT_EQ(none.code, 1);
}

INSTANTIATE_TEST_SUITE_P(Frames, BakeIntoModel, testing::Values("cotangent", "smooth", "mikktspace", "vertex"));

TEST(BakeIntoModelOptions, unsupportedMapOptionsAreRefused)
{
    TemporaryFolder folder;
    writeSquare(folder / "low.obj");
    writeBump(folder / "high.obj");
    const std::vector<std::vector<std::string>> wrong = {{"--kind", "height"},
                                                         {"--bits", "32"},
                                                         {"--udim", "1002"},
                                                         {"--convention", "directx"},
                                                         {"--convention", "unity,xy"}};
    for (const auto& words : wrong) {
        std::vector<std::string> all = {"bake",   "--high", "high.obj", "--low",  "low.obj",
                                        "--size", "16x16",  "-o",       "out.glb"};
        all.insert(all.end(), words.begin(), words.end());
        const ToolRun r = runTool(all, folder.path());
        EXPECT_EQ(r.code, 1) << words[0] << ' ' << words[1];
        EXPECT_EQ(lines(r.err), 1) << r.err;
        EXPECT_FALSE(std::filesystem::exists(folder / "out.glb"));
    }
}

} // namespace
} // namespace cotan::test
