// Models read through Assimp. Expected values come from the text of the models, not from the reader.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <sstream>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include "cotan/image.hpp"
#include "cotan/model.hpp"
#include "cotan/portable.hpp"
#include "expected_list.hpp"
#include "scene/geometry.hpp"

namespace cotan {
namespace {

namespace fs = std::filesystem;

const std::string kQuad = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                          "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\n";
const std::string kQuadFace = "f 1/1/1 2/2/1 3/3/1 4/4/1\n";

// Checks the invariants of every scene that a reader returns.
void expectSound(const Scene& scene)
{
    for (const Mesh& mesh : scene.meshes) {
        ASSERT_LT(std::size_t(mesh.material), scene.materials.size());
        ASSERT_EQ(mesh.indices.size() % 3, 0u);
        for (const std::uint32_t i : mesh.indices)
            ASSERT_LT(i, mesh.vertexCount());
        ASSERT_EQ(mesh.normals.size(), mesh.vertexCount());
        for (const glm::vec3& n : mesh.normals)
            ASSERT_NEAR(glm::length(n), 1, 1e-5); // a float division
        for (const auto& texcoords : mesh.texcoords) {
            ASSERT_TRUE(texcoords.empty() || texcoords.size() == mesh.vertexCount());
        }
    }
    for (const Instance& instance : scene.instances)
        ASSERT_LT(std::size_t(instance.mesh), scene.meshes.size());
    for (const Material& m : scene.materials)
        for (const Texture* t : {&m.baseColorMap, &m.normalMap, &m.metallicRoughnessMap})
            ASSERT_LT(t->image, int(scene.images.size()));
}

bool mentions(const std::vector<std::string>& lines, const std::string& text)
{
    return std::ranges::any_of(lines, [&](const std::string& s) { return s.find(text) != std::string::npos; });
}

// A folder "outer" that contains a folder "model", for one test.
class AssimpFile : public testing::Test {
protected:
    fs::path outer = fs::temp_directory_path()
        / ("cotan_assimp_test_" + std::to_string(::getpid()) + "_"
           + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::path folder = outer / "model";
    void SetUp() override { fs::create_directories(folder); }
    void TearDown() override { fs::remove_all(outer); }

    fs::path write(const std::string& name, const std::string& text) const
    {
        std::ofstream(folder / name, std::ios::binary) << text;
        return folder / name;
    }

    // Loads `text` as a model; fails the test if loading fails.
    Scene load(const std::string& name, const std::string& text) const
    {
        auto scene = loadScene(write(name, text));
        if (!scene) {
            ADD_FAILURE() << scene.error().message;
            return {};
        }
        expectSound(*scene);
        return *std::move(scene);
    }

    std::string problem(const std::string& name, const std::string& text, const LoadLimits& limits = {}) const
    {
        const auto scene = loadScene(write(name, text), limits);
        return scene ? "" : scene.error().message;
    }

    // Loads a quad with one material made of these lines.
    Scene loadMaterial(const std::string& lines) const
    {
        write("m.mtl", "newmtl m\n" + lines);
        Scene scene = load("m.obj", "mtllib m.mtl\n" + kQuad + "usemtl m\n" + kQuadFace);
        EXPECT_EQ(scene.meshes.size(), 1u);
        return scene;
    }

    void writeColour(const fs::path& file, int r, int g, int b) const
    {
        Image image = makeImage(4, 4, PixelType::unorm8);
        for (std::size_t i = 0; i < 16; ++i) {
            const std::uint8_t rgba[4] = {std::uint8_t(r), std::uint8_t(g), std::uint8_t(b), 255};
            std::memcpy(image.bytes8() + 4 * i, rgba, 4);
        }
        ASSERT_TRUE(writeImage(file, image));
    }
};

const Material& materialOf(const Scene& scene) { return scene.materials[std::size_t(scene.meshes[0].material)]; }

TEST_F(AssimpFile, quadBecomesTwoTrianglesWithVRunningDown)
{
    const Scene scene = load("q.obj", kQuad + kQuadFace);
    ASSERT_EQ(scene.meshes.size(), 1u);
    const Mesh& mesh = scene.meshes[0];
    EXPECT_EQ(mesh.triangleCount(), 2u);
    EXPECT_EQ(mesh.vertexCount(), 4u);
    for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
        // In the file, v is the height y; in a scene v counts from the top.
        EXPECT_EQ(mesh.texcoords[0][i], glm::vec2(mesh.positions[i].x, 1 - mesh.positions[i].y));
        EXPECT_EQ(mesh.normals[i], glm::vec3(0, 0, 1));
    }
    EXPECT_TRUE(materialOf(scene).doubleSided);
}

TEST_F(AssimpFile, negativeObjIndicesMeanTheSame)
{
    const Scene forwards = load("a.obj", kQuad + kQuadFace);
    const Scene backwards = load("b.obj", kQuad + "f -4/-4/-1 -3/-3/-1 -2/-2/-1 -1/-1/-1\n");
    ASSERT_EQ(backwards.meshes.size(), 1u);
    EXPECT_EQ(backwards.meshes[0].positions, forwards.meshes[0].positions);
    EXPECT_EQ(backwards.meshes[0].indices, forwards.meshes[0].indices);
}

TEST_F(AssimpFile, objLineEndsTabsContinuationsAndCommentsChangeNothing)
{
    const Scene plain = load("a.obj", kQuad + kQuadFace);
    std::string odd = "# a comment that goes on \\\nand on\n" + kQuad
        + "f 1/1/1\t2/2/1 \\\n 3/3/1 \\\n4/4/1 # behind\nl 1 2\np 3\nfoo bar\n";
    for (const std::string end : {"\n", "\r\n", "\r"}) {
        std::string text;
        for (const char c : odd)
            text += c == '\n' ? end : std::string(1, c);
        const Scene scene = load("b.obj", text);
        ASSERT_EQ(scene.meshes.size(), 1u);
        EXPECT_EQ(scene.meshes[0].positions, plain.meshes[0].positions);
        EXPECT_EQ(scene.meshes[0].texcoords, plain.meshes[0].texcoords);
        EXPECT_EQ(scene.meshes[0].indices, plain.meshes[0].indices);
    }
}

TEST_F(AssimpFile, objByteOrderMarkIsSkipped)
{
    EXPECT_EQ(load("a.obj", "\xef\xbb\xbf" + kQuad + kQuadFace).meshes.at(0).vertexCount(), 4u);
}

TEST_F(AssimpFile, brokenObjIsRefusedWithItsLine)
{
    const std::pair<std::string, std::string> cases[] = {
        {"v 0 0\n", "line 1: expected 3, 4, 6 or 7 numbers, found 2"},
        {"v 0 0 0\r\nv 0 \\\r\n0 0\r\nv 1 2 x\r\n", "line 4: expected a finite number, found \"x\""},
        {"v 0 0 inf\n", "found \"inf\""},
        {"v 0 0 1e39\n", "found \"1e39\""},
        {kQuad + "f 1 2 5\n", "line 10: expected a position index up to 4, found 5"},
        {kQuad + "f 1/1 2/2 3/9\n", "texture coordinate index up to 4, found 9"},
        {kQuad + "f 1//1 2//1 3//2\n", "normal index up to 1, found 2"},
        {kQuad + "f 1 2 -5\n", "expected a position index of at least -4, found -5"},
        {kQuad + "f 1 2 0\n", "found 0"},
        {kQuad + "f 1 2 99999999999999999999\n", "expected a corner v/vt/vn"},
        {kQuad + "f 1 2 3/1/1/1\n", "expected a corner v/vt/vn"},
        {kQuad + "f /1 /2 /3\n", "expected a corner with a position"},
        {kQuad + "f\n", "expected the corners of a face, found none"},
        {kQuad + "f 1 2/2 3\n", "found a mixture"},
        {kQuad + "l 1 2\n", "expected faces, found none"},
        {kQuad + std::string(1, '\0') + kQuadFace, "found a zero byte"},
    };
    for (const auto& [text, expected] : cases) {
        const std::string found = problem("a.obj", text);
        EXPECT_NE(found.find(expected), std::string::npos) << text << "\n-> " << found;
        EXPECT_EQ(found.find('\n'), std::string::npos) << found;
    }
}

TEST_F(AssimpFile, limitsAreEnforced)
{
    LoadLimits limits;
    limits.triangles = 1;
    EXPECT_NE(problem("a.obj", kQuad + kQuadFace, limits).find("limit of 1 triangles"), std::string::npos);
    limits = {};
    limits.vertices = 3;
    EXPECT_NE(problem("a.obj", kQuad + kQuadFace, limits).find("limit of 3 vertices"), std::string::npos);
    limits = {};
    limits.fileBytes = 10;
    EXPECT_NE(problem("a.obj", kQuad + kQuadFace, limits).find("the limit is 10"), std::string::npos);
    limits = {};
    limits.nodes = 1;
    EXPECT_NE(problem("a.obj", "o a\n" + kQuad + kQuadFace + "o b\n" + kQuadFace, limits).find("1 nodes"),
              std::string::npos);
}

// Assimp's time is quadratic in a polygon's corners: 150,000 self-intersecting ones took 4 s in each command.
TEST_F(AssimpFile, polygonsMayHave70000CornersTogether)
{
    const auto withPolygons = [](const std::vector<int>& corners) {
        std::string text = fmt::format("ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                                       "property float z\nelement face {}\n"
                                       "property list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n",
                                       corners.size());
        for (const int count : corners) {
            text += fmt::format("{}", count);
            for (int i = 0; i < count; ++i)
                text += fmt::format(" {}", i % 4);
            text += '\n';
        }
        return text;
    };
    for (const auto& corners : {std::vector{71'000}, {50'000, 50'100}})
        EXPECT_NE(problem("a.ply", withPolygons(corners)).find("expected triangles, found "), std::string::npos);
    EXPECT_EQ(problem("a.ply", withPolygons({20'000, 20'000})), "");
}

TEST_F(AssimpFile, concavePolygonKeepsItsArea)
{
    // An arrow head: a fan from its first corner would cover the notch twice.
    const Scene scene = load("a.obj", "v 0 0 0\nv 4 -2 0\nv 1 0 0\nv 4 2 0\nf 2 3 4 1\n");
    double area = 0, doubled = 0;
    const Mesh& mesh = scene.meshes.at(0);
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
        const glm::vec3 a = mesh.positions[mesh.indices[3 * t]];
        const glm::vec3 b = mesh.positions[mesh.indices[3 * t + 1]];
        const glm::vec3 c = mesh.positions[mesh.indices[3 * t + 2]];
        area += glm::length(glm::cross(b - a, c - a)) / 2;
        doubled += glm::cross(b - a, c - a).z;
    }
    EXPECT_NEAR(area, 2, 1e-6);                  // 8 of the triangle less 6 of the notch
    EXPECT_NEAR(std::abs(doubled) / 2, 2, 1e-6); // all have the same orientation
}

TEST_F(AssimpFile, missingNormalsAreSmoothUpToSixtyDegrees)
{
    // A ridge between two quads: smooth if their normals are 40 degrees apart, sharp at 80.
    for (const double degrees : {40.0, 80.0}) {
        const double slope = std::tan(degrees / 2 * 3.14159265 / 180);
        std::ostringstream text;
        text << "v -1 " << -slope << " 0\nv 0 0 0\nv 1 " << -slope << " 0\nv -1 " << -slope << " -1\nv 0 0 -1\nv 1 "
             << -slope << " -1\nf 1 2 5 4\nf 2 3 6 5\n";
        const Scene scene = load("a.obj", text.str());
        EXPECT_EQ(scene.meshes.at(0).vertexCount(), degrees < 60 ? 6u : 8u);
    }
}

TEST_F(AssimpFile, mtlColourShininessAndOpacity)
{
    const Scene scene = loadMaterial("Kd 0.25 0.5 0.75\nNs 30\nd 0.5\nillum 2\n");
    const Material& material = materialOf(scene);
    EXPECT_EQ(material.baseColor, glm::vec4(0.25f, 0.5f, 0.75f, 0.5f));
    EXPECT_EQ(material.alphaMode, AlphaMode::blend);
    EXPECT_EQ(material.metallic, 0);
    EXPECT_NEAR(material.roughness, 0.5, 1e-6); // (2/(30 + 2))^(1/4)
}

TEST_F(AssimpFile, mtlRoughnessAndMetalnessWithTheirMaps)
{
    EXPECT_NEAR(materialOf(loadMaterial("Pr 0.3\nPm 0.9\n")).roughness, 0.3, 1e-6);
    EXPECT_NEAR(materialOf(loadMaterial("Pr 0.3\nPm 0.9\n")).metallic, 0.9, 1e-6);

    writeColour(folder / "rough.png", 40, 0, 0);
    writeColour(folder / "metal.png", 200, 0, 0);
    const Scene scene = loadMaterial("map_Pr rough.png\nmap_Pm metal.png\n");
    const Material& material = materialOf(scene);
    ASSERT_TRUE(material.metallicRoughnessMap.present());
    const Image& image = scene.images[std::size_t(material.metallicRoughnessMap.image)];
    EXPECT_EQ(image.bytes8()[1], 40);
    EXPECT_EQ(image.bytes8()[2], 200);
}

// Roughness goes to green and metalness to blue, each from the nearest texel of its own image.
TEST_F(AssimpFile, mtlRoughnessAndMetalnessOfDifferentSizesAreMerged)
{
    Image rough = makeImage(4, 2, PixelType::unorm8), metal = makeImage(2, 6, PixelType::unorm8);
    for (Image* image : {&rough, &metal})
        for (std::size_t i = 0; i < image->pixelCount(); ++i) {
            const std::uint8_t value = std::uint8_t(10 * (1 + i));
            const std::uint8_t rgba[4] = {value, 0, 0, 255};
            std::memcpy(image->bytes8() + 4 * i, rgba, 4);
        }
    ASSERT_TRUE(writeImage(folder / "rough.png", rough));
    ASSERT_TRUE(writeImage(folder / "metal.png", metal));
    const Scene scene = loadMaterial("map_Pr rough.png\nmap_Pm metal.png\n");
    const Image& image = scene.images.at(std::size_t(materialOf(scene).metallicRoughnessMap.image));
    ASSERT_EQ(image.width, 4);
    ASSERT_EQ(image.height, 6);
    for (int y = 0; y < 6; ++y)
        for (int x = 0; x < 4; ++x) {
            const std::uint8_t* texel = image.bytes8() + 4 * (y * 4 + x);
            EXPECT_EQ(texel[1], 10 * (1 + x + 4 * (y / 3))) << x << y;
            EXPECT_EQ(texel[2], 10 * (1 + x / 2 + 2 * y)) << x << y;
        }
}

TEST_F(AssimpFile, imagesBeyondTheTotalLimitAreOmittedWithAWarning)
{
    writeColour(folder / "a.png", 1, 2, 3);
    writeColour(folder / "b.png", 4, 5, 6);
    write("m.mtl", "newmtl m\nmap_Kd a.png\nmap_Ke b.png\n");
    LoadLimits limits;
    limits.allImageBytes = 64; // one image of 4 x 4
    const auto scene = loadScene(write("m.obj", "mtllib m.mtl\n" + kQuad + "usemtl m\n" + kQuadFace), limits);
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->images.size(), 1u);
    EXPECT_TRUE(mentions(scene->warnings, "the images are over the limit of 64 bytes; left out"));
}

TEST_F(AssimpFile, mtlNormalMapsAreReadUnderEveryName)
{
    writeColour(folder / "n.png", 128, 128, 255);
    for (const std::string line :
         {"norm n.png", "map_Bump n.png", "map_bump n.png", "bump n.png", "map_Kn n.png", "map_Bump -bm 0.5 n.png"}) {
        const Scene scene = loadMaterial(line + "\n");
        const Material& material = materialOf(scene);
        ASSERT_TRUE(material.normalMap.present()) << line;
        EXPECT_TRUE(material.normalFormat.greenUp) << line;
        EXPECT_EQ(material.normalScale, line.find("-bm") != std::string::npos ? 0.5f : 1.0f) << line;
        EXPECT_TRUE(scene.warnings.empty()) << line << ": " << scene.warnings[0];
    }
}

TEST_F(AssimpFile, normalMapNamedDirectXHasGreenAlongV)
{
    const std::pair<std::string, bool> names[] = {
        {"wall_normal_dx.png", true},  {"Wall_NormalDX.png", true}, {"dx.png", true},
        {"wall-DirectX-2k.png", true}, {"normal_dx8.png", true},    {"wall_gl.png", false},
        {"deluxdx_n.png", false},      {"dxfoo.png", false}};
    for (const auto& [name, along] : names) {
        writeColour(folder / name, 128, 128, 255);
        EXPECT_EQ(greenAlongV(materialOf(loadMaterial("norm " + name + "\n")).normalFormat), along) << name;
    }
}

TEST_F(AssimpFile, greyBumpMapBecomesTheNormalMapOfItsSlopes)
{
    // Height sin(2 pi x / 64) along u and half of that along v: the slopes are known and continue across the border.
    const int side = 64;
    Image heights = makeImage(side, side, PixelType::unorm16);
    const double step = 2 * 3.14159265358979 / side;
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const double h = 0.5 + 0.25 * std::sin(x * step) + 0.125 * std::sin(y * step);
            for (int c = 0; c < 3; ++c)
                heights.words()[4 * (y * side + x) + c] = std::uint16_t(h * 65535 + 0.5);
            heights.words()[4 * (y * side + x) + 3] = 65535;
        }
    }
    ASSERT_TRUE(writeImage(folder / "h.png", heights));
    for (const double strength : {1.0, 3.0}) {
        const Scene scene = loadMaterial(strength == 1 ? "map_Bump h.png\n" : "map_Bump -bm 3 h.png\n");
        const Material& material = materialOf(scene);
        ASSERT_TRUE(material.normalMap.present());
        EXPECT_TRUE(mentions(scene.warnings, "height map"));
        EXPECT_EQ(material.normalScale, 1);
        EXPECT_TRUE(material.normalFormat.greenUp);
        const Image& map = scene.images[std::size_t(material.normalMap.image)];
        double worst = 0;
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) {
                const double depth = 0.01 * side * strength; // texels from black to white
                const glm::dvec3 expected = glm::normalize(glm::dvec3(-0.25 * step * std::cos(x * step) * depth,
                                                                      0.125 * step * std::cos(y * step) * depth, 1));
                const std::uint16_t* c = map.words() + 4 * (y * side + x);
                const glm::dvec3 found = glm::normalize((glm::dvec3(c[0], c[1], c[2]) - 32768.0) / 32767.0);
                worst = std::max(worst, glm::length(expected - found));
            }
        }
        // Central differences underestimate slopes up to 0.05 by step^2/6 = 0.16 %; 16-bit output and the rounding of
        // heights (2 x 8e-6 x depth) add 5e-5.
        EXPECT_LT(worst, 2e-4);
    }
}

TEST_F(AssimpFile, missingOrBrokenTexturesAreOmittedWithAWarning)
{
    write("broken.png", "not a picture");
    for (const std::string name : {"missing.png", "broken.png"}) {
        const Scene scene = loadMaterial("map_Kd " + name + "\nnorm " + name + "\n");
        EXPECT_FALSE(materialOf(scene).baseColorMap.present());
        EXPECT_FALSE(materialOf(scene).normalMap.present());
        EXPECT_TRUE(mentions(scene.warnings, name)) << name;
    }
}

TEST_F(AssimpFile, nothingOutsideTheFolderIsOpened)
{
    writeColour(outer / "secret.png", 1, 2, 3);
    std::ofstream(outer / "secret.mtl") << "newmtl m\nKd 0.1 0.2 0.3\n";
    fs::create_symlink(outer / "secret.png", folder / "link.png");
    fs::create_directory_symlink(outer, folder / "up");
    const std::string absolute = (outer / "secret.png").string();
    for (const std::string& name : std::vector<std::string>{"../secret.png", "..\\secret.png", "link.png",
                                                            "up/secret.png", absolute, "sub/../../secret.png"}) {
        const Scene scene = loadMaterial("map_Kd " + name + "\n");
        EXPECT_FALSE(materialOf(scene).baseColorMap.present()) << name;
        EXPECT_TRUE(scene.images.empty()) << name;
        EXPECT_TRUE(mentions(scene.warnings, "outside the model's folder")) << name;
    }
    const Scene scene = load("a.obj", "mtllib ../secret.mtl\n" + kQuad + "usemtl m\n" + kQuadFace);
    EXPECT_NE(glm::vec3(materialOf(scene).baseColor), glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_TRUE(mentions(scene.warnings, "../secret.mtl is outside the model's folder"));
}

TEST_F(AssimpFile, filesInSubfoldersAndWithPathsOfOtherMachinesAreFound)
{
    fs::create_directory(folder / "maps");
    writeColour(folder / "maps" / "c.png", 9, 9, 9);
    writeColour(folder / "d.png", 9, 9, 9);
    for (const std::string name :
         {"maps/c.png", "maps\\c.png", "./maps/../maps/c.png", "C:\\Users\\someone\\d.png", "/home/someone/d.png"}) {
        const Scene scene = loadMaterial("map_Kd " + name + "\n");
        EXPECT_TRUE(materialOf(scene).baseColorMap.present()) << name;
    }
}

TEST_F(AssimpFile, oneImageUsedTwiceIsReadOnce)
{
    writeColour(folder / "c.png", 128, 128, 255);
    EXPECT_EQ(loadMaterial("map_Kd c.png\nnorm ./c.png\n").images.size(), 1u);
}

TEST_F(AssimpFile, missingUvAndLibrariesAreWarnedOf)
{
    writeColour(folder / "c.png", 1, 2, 3);
    write("m.mtl", "newmtl m\nmap_Kd c.png\n");
    const Scene noUv = load("a.obj", "mtllib m.mtl\n" + kQuad + "usemtl m\nf 1//1 2//1 3//1\n");
    EXPECT_TRUE(mentions(noUv.warnings, "no texture coordinates"));
    const Scene noLibrary = load("b.obj", "mtllib gone.mtl\r\n" + kQuad + kQuadFace);
    EXPECT_TRUE(mentions(noLibrary.warnings, "gone.mtl was not found"));
}

TEST_F(AssimpFile, materialLibraryWithDosLineEndsIsFound)
{
    write("m.mtl", "newmtl m\r\nKd 0.5 0.25 1\r\n");
    const Scene scene = load("a.obj", "mtllib m.mtl\r\n" + kQuad + "usemtl m\r\n" + kQuadFace);
    EXPECT_EQ(materialOf(scene).baseColor, glm::vec4(0.5f, 0.25f, 1, 1));
    EXPECT_TRUE(scene.warnings.empty());
}

TEST_F(AssimpFile, plyKeepsColoursAsLinearLight)
{
    const Scene scene = load("a.ply",
                             "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                             "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
                             "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                             "0 0 0 255 0 188\n1 0 0 255 0 188\n0 1 0 255 0 188\n3 0 1 2\n");
    ASSERT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(scene.meshes[0].triangleCount(), 1u);
    EXPECT_EQ(scene.meshes[0].normals[0], glm::vec3(0, 0, 1));
    ASSERT_EQ(scene.meshes[0].colors.size(), 3u);
    // sRGB 188 is 0.5029 in linear light (IEC 61966-2-1).
    EXPECT_NEAR(glm::length(scene.meshes[0].colors[0] - glm::vec4(1, 0, 0.5029f, 1)), 0, 1e-4);
}

TEST_F(AssimpFile, nonFinitePositionsAreRefusedOnEachAxis)
{
    for (const std::string wrong : {"nan", "inf", "-inf"})
        for (int axis = 0; axis < 3; ++axis) {
            std::string numbers[3] = {"1", "1", "0"};
            const auto file = [&] {
                return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                       "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
                       "0 0 0\n1 0 0\n"
                    + numbers[0] + " " + numbers[1] + " " + numbers[2] + "\n3 0 1 2\n";
            };
            EXPECT_EQ(problem("a.ply", file()), "");
            numbers[axis] = wrong;
            EXPECT_NE(problem("a.ply", file()), "") << wrong << ' ' << axis;
        }
}

TEST_F(AssimpFile, plyWithTooLargeACountIsRefusedAtOnce)
{
    for (const std::string count : {"4294967295", "100000000000", "-1", "x"}) {
        const std::string text = "ply\nformat binary_little_endian 1.0\nelement vertex " + count
            + "\nproperty float x\nproperty float y\nproperty float z\n"
              "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
        EXPECT_NE(problem("a.ply", text), "") << count;
    }
    EXPECT_NE(problem("a.ply", "ply\nformat ascii 1.0\n"), "");
    EXPECT_NE(problem("a.ply", "hello"), "");
}

std::string plyHeader(const std::string& format, const std::string& rest)
{
    return "ply\nformat " + format + " 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        + rest + "end_header\n";
}

// The number in `bytes` bytes, least significant byte first or last.
std::string plyNumber(std::uint64_t value, int bytes, bool bigEndian)
{
    std::string text;
    for (int i = 0; i < bytes; ++i)
        text += char(value >> (8 * (bigEndian ? bytes - 1 - i : i)));
    return text;
}

TEST_F(AssimpFile, unknownPlyElementsAreAllowedOnlyAfterTheGeometry)
{
    const std::string geometry =
        "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
        "property list uchar int vertex_indices\n";
    const std::string camera = "element camera 1\nproperty float a\n", rows = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    const std::string start = "ply\nformat ascii 1.0\n", end = "end_header\n";
    EXPECT_EQ(problem("a.ply", start + geometry + camera + end + rows + "9\n"), "");
    EXPECT_NE(problem("b.ply", start + camera + geometry + end + "9\n" + rows)
                  .find("\"vertex\" before the element \"camera\""),
              std::string::npos);
    EXPECT_EQ(problem("c.ply", start + "element camera 0\nproperty float a\n" + geometry + end + rows), ""); // no rows
    // Assimp took the name for the count and allocated 103 GB.
    EXPECT_NE(problem("d.ply", start + geometry + "element 9999999999face 1\nproperty float a\n" + end + rows + "9\n")
                  .find("starts with a letter"),
              std::string::npos);
}

// Each type name has its size in the file; one byte less is too little.
TEST_F(AssimpFile, plyNumbersOfEveryTypeHaveTheirSize)
{
    const std::vector<std::pair<std::string, std::size_t>> types = {
        {"char", 1},  {"uchar", 1},   {"int8", 1},   {"uint8", 1},  {"short", 2}, {"ushort", 2},
        {"int16", 2}, {"uint16", 2},  {"int", 4},    {"uint", 4},   {"int32", 4}, {"uint32", 4},
        {"float", 4}, {"float32", 4}, {"double", 8}, {"float64", 8}};
    for (const auto& [type, bytes] : types) {
        std::string text = plyHeader("binary_little_endian",
                                     "property " + type
                                         + " quality\nelement face 1\nproperty list uchar int "
                                           "vertex_indices\n");
        for (const auto& [x, y] : {std::pair(0.0f, 0.0f), {1.0f, 0.0f}, {0.0f, 1.0f}}) {
            const float row[3] = {x, y, 0};
            text.append(reinterpret_cast<const char*>(row), sizeof row);
            text += std::string(bytes, '\0');
        }
        text += char(3);
        for (const std::uint64_t i : {0u, 1u, 2u})
            text += plyNumber(i, 4, false);
        const Scene scene = load("a.ply", text);
        ASSERT_EQ(scene.meshes.size(), 1u) << type;
        EXPECT_EQ(scene.meshes[0].triangleCount(), 1u) << type;
        text.pop_back();
        EXPECT_NE(problem("a.ply", text), "") << type;
    }
}

TEST_F(AssimpFile, plyListsAreCheckedBeforeMemoryIsAllocated)
{
    const std::string faces = "element face 2\nproperty uchar flags\nproperty list uint int vertex_indices\n";
    for (const bool big : {false, true}) {
        const std::string format = big ? "binary_big_endian" : "binary_little_endian";
        std::string vertices;
        for (const float f : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) {
            std::uint32_t bits = 0;
            std::memcpy(&bits, &f, 4);
            vertices += plyNumber(bits, 4, big);
        }
        const auto face = [&](std::uint64_t count) {
            return "x" + plyNumber(count, 4, big) + plyNumber(0, 4, big) + plyNumber(1, 4, big) + plyNumber(2, 4, big);
        };
        const std::string head = plyHeader(format, faces) + vertices;
        EXPECT_EQ(problem("a.ply", head + face(3) + face(3)), "") << format;
        EXPECT_NE(problem("b.ply", head + face(3) + face(1'500'000'000)).find("expected 1500000000 values, but"),
                  std::string::npos);
        EXPECT_NE(problem("c.ply", head + face(3) + face(4)).find("values, but the file has only"), std::string::npos);
        EXPECT_NE(problem("d.ply", head + face(3) + face(3).substr(0, 16)).find("values, but the file has only"),
                  std::string::npos);
        EXPECT_NE(problem("e.ply", head + face(3) + "x").find("the file ends"), std::string::npos);
        const std::string small =
            plyHeader(format, "element face 1\nproperty list char int vertex_indices\n") + vertices;
        // A count of -1 is refused even if the file has 255 values.
        EXPECT_NE(problem("f.ply", small + "\xff" + std::string(1020, '\0')).find("values, but the file has only"),
                  std::string::npos);
    }
    const std::string text = plyHeader("ascii", faces) + "0 0 0\n1 0 0\r\n\n0 1 0\n";
    EXPECT_EQ(problem("g.ply", text + "7 3 0 1 2\n7 3 2 1 0"), "");
    EXPECT_NE(problem("h.ply", text + "7 3 0 1 2\n7 1500000000 0 1 2\n").find("found 3 on their"), std::string::npos);
    EXPECT_NE(problem("i.ply", text + "7 3 0 1\n2 7 3 2 1 0\n").find("expected 3 values, found 2 on their line"),
              std::string::npos);
    EXPECT_NE(problem("j.ply", text + "7 -3 0 1 2\n7 3 0 1 2\n").find("expected the count of a list"),
              std::string::npos);
    EXPECT_NE(problem("k.ply", text + "7 3 0 1 2\n").find("the file ends"), std::string::npos);
    EXPECT_NE(
        problem("m.ply", text + "7 3" + std::string(8, '\0') + " 0 1 2\n7 3 2 1 0\n").find("found a zero byte at"),
        std::string::npos);
    const std::string floats = plyHeader("ascii", "element face 1\nproperty list float int vertex_indices\n");
    EXPECT_NE(problem("l.ply", floats + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n").find("an integer type for the count"),
              std::string::npos);
    LoadLimits limits;
    limits.vertices = 2;
    EXPECT_NE(problem("n.ply", text + "7 3 0 1 2\n7 3 2 1 0", limits).find("3 elements exceed"), std::string::npos);
}

std::string stlTriangles(std::uint32_t claimed, const std::vector<float>& numbers)
{
    std::string text(80, ' ');
    text.append(reinterpret_cast<const char*>(&claimed), 4);
    for (std::size_t i = 0; i < numbers.size(); i += 9) {
        text.append(12, '\0'); // the facet's normal: zero, unknown
        text.append(reinterpret_cast<const char*>(&numbers[i]), 36);
        text.append(2, '\0');
    }
    return text;
}

TEST_F(AssimpFile, stlWeldsItsCornersAndMakesNormals)
{
    const std::vector<float> quad = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0};
    const Scene scene = load("a.stl", stlTriangles(2, quad));
    ASSERT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(scene.meshes[0].triangleCount(), 2u);
    EXPECT_EQ(scene.meshes[0].vertexCount(), 4u);
    EXPECT_EQ(scene.meshes[0].normals[0], glm::vec3(0, 0, 1));
    EXPECT_NE(problem("b.stl", stlTriangles(3'000'000'000u, quad)), "");
    EXPECT_NE(problem("c.stl", stlTriangles(1, {0, 0, 0, 1, 0, 0, 0, std::nanf(""), 0})), "");
}

TEST_F(AssimpFile, colladaNodesBecomeInstancesOfOneMesh)
{
    const std::string floats = "<source id=\"p\"><float_array id=\"pa\" count=\"9\">0 0 0 1 0 0 0 1 0"
                               "</float_array><technique_common><accessor source=\"#pa\" count=\"3\" "
                               "stride=\"3\"><param name=\"X\" type=\"float\"/><param name=\"Y\" "
                               "type=\"float\"/><param name=\"Z\" type=\"float\"/></accessor>"
                               "</technique_common></source>";
    const std::string use = "<instance_geometry url=\"#g\"/>";
    const Scene scene = load("a.dae",
                             "<?xml version=\"1.0\"?><COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" "
                             "version=\"1.4.1\"><asset><up_axis>Y_UP</up_axis></asset><library_geometries><geometry "
                             "id=\"g\">"
                             "<mesh>"
                                 + floats
                                 + "<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/></vertices>"
                                   "<triangles count=\"1\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>0 "
                                   "1 2</p>"
                                   "</triangles></mesh></geometry></library_geometries><library_visual_scenes>"
                                   "<visual_scene id=\"s\"><node id=\"a\"><translate>10 0 0</translate>"
                                 + use + "<node id=\"b\"><scale>2 -3 1</scale>" + use
                                 + "</node></node></visual_scene>"
                                   "</library_visual_scenes><scene><instance_visual_scene "
                                   "url=\"#s\"/></scene></COLLADA>");
    EXPECT_EQ(scene.meshes.size(), 1u);
    ASSERT_EQ(scene.instances.size(), 2u);
    const Bounds box = bounds(scene);
    EXPECT_EQ(box.low, glm::vec3(10, -3, 0));
    EXPECT_EQ(box.high, glm::vec3(12, 1, 0));
}

// 60 degrees horizontally in an image twice as wide as high.
TEST_F(AssimpFile, colladaCamerasTakeTheirNodesTransformAndHorizontalAngle)
{
    const Scene scene = load(
        "a.dae",
        "<?xml version=\"1.0\"?><COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">"
        "<asset><up_axis>Y_UP</up_axis></asset><library_cameras><camera id=\"c\" name=\"c\"><optics><technique_common>"
        "<perspective><xfov>60</xfov><aspect_ratio>2</aspect_ratio><znear>0.1</znear><zfar>100</zfar></perspective>"
        "</technique_common></optics></camera></library_cameras><library_geometries><geometry id=\"g\"><mesh>"
        "<source id=\"p\"><float_array id=\"pa\" count=\"9\">0 0 0 1 0 0 0 1 0</float_array><technique_common>"
        "<accessor source=\"#pa\" count=\"3\" stride=\"3\"><param name=\"X\" type=\"float\"/>"
        "<param name=\"Y\" type=\"float\"/><param name=\"Z\" type=\"float\"/></accessor></technique_common></source>"
        "<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/></vertices><triangles count=\"1\">"
        "<input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>0 1 2</p></triangles></mesh></geometry>"
        "</library_geometries><library_visual_scenes><visual_scene id=\"s\"><node id=\"a\">"
        "<instance_geometry url=\"#g\"/></node><node id=\"n\"><translate>0.25 0.5 5</translate>"
        "<instance_camera url=\"#c\"/></node></visual_scene></library_visual_scenes><scene>"
        "<instance_visual_scene url=\"#s\"/></scene></COLLADA>");
    ASSERT_EQ(scene.cameras.size(), 1u);
    const Camera& camera = scene.cameras[0];
    EXPECT_FALSE(camera.orthographic);
    EXPECT_EQ(camera.eye, glm::vec3(0.25f, 0.5f, 5));
    EXPECT_NEAR(glm::length(glm::normalize(camera.target - camera.eye) - glm::vec3(0, 0, -1)), 0, 1e-5);
    EXPECT_NEAR(glm::length(glm::normalize(camera.up) - glm::vec3(0, 1, 0)), 0, 1e-5);
    EXPECT_NEAR(camera.verticalFieldOfView, 2 * std::atan(std::tan(3.14159265 / 6) / 2), 1e-5);
}

TEST_F(AssimpFile, faceIndicesAndCountsOfOtherFormatsAreCheckedBeforeUse)
{
    const std::string head = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float "
                             "y\nproperty float z\nelement face 1\nproperty list uchar int "
                             "vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n";
    EXPECT_EQ(problem("a.ply", head + "3 0 1 2\n"), "");
    EXPECT_NE(problem("b.ply", head + "3 0 1 3\n").find("expected an index below 3, found 3"), std::string::npos);
    // These two lines made the parser loop forever.
    EXPECT_NE(problem("c.ply",
                      "ply\nformat ascii 1.0\nelement vertex 8\nformat perty float32 x\n"
                      "end_header*0 0 0\n0 0 1\n"),
              "");
    EXPECT_NE(problem("d.dae", "<COLLADA><float_array count=\"8589934592\">1</float_array></COLLADA>")
                  .find("found 8589934592"),
              std::string::npos);
    // A stray character in a list of indices filled the memory.
    EXPECT_NE(problem("e.dae", "<COLLADA><p>0 1 2; 3</p></COLLADA>").find("only integers in <p>"), std::string::npos);
}

// Next to points and polygons, Assimp wrote before the start of its table; next to triangles only, it lost these faces.
TEST_F(AssimpFile, onlyFacesWithoutCornersAreOmitted)
{
    const auto ply = [](const std::vector<std::string>& faces) {
        std::string text = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                           "property float z\nelement face "
            + std::to_string(faces.size())
            + "\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
        for (const std::string& face : faces)
            text += face + "\n";
        return text;
    };
    const std::string triangle = "3 0 1 2", quad = "4 0 1 2 3", point = "1 0", none = "0";
    const std::pair<std::vector<std::string>, std::size_t> cases[] = {{{triangle, none}, 1},
                                                                      {{none, triangle, none, point}, 1},
                                                                      {{point, quad, none, none}, 2},
                                                                      {{none, quad, triangle}, 3}};
    for (const auto& [faces, triangles] : cases) {
        const Scene scene = load("a.ply", ply(faces));
        ASSERT_EQ(scene.meshes.size(), 1u) << faces.front();
        EXPECT_EQ(scene.meshes[0].triangleCount(), triangles) << faces.front();
        const std::string left = std::to_string(std::ranges::count(faces, none)) + " of " + std::to_string(faces.size())
            + " faces have no corners";
        EXPECT_TRUE(mentions(scene.warnings, left)) << left;
    }
    for (const std::vector<std::string>& faces : {std::vector{none}, std::vector{none, point, none}})
        EXPECT_NE(problem("b.ply", ply(faces)).find("expected triangles, found none"), std::string::npos);
}

TEST_F(AssimpFile, garbageUnderEveryExtensionIsRefused)
{
    for (const char* extension : {".obj", ".ply", ".stl", ".dae", ".fbx", ".3ds"}) {
        for (const std::string& text :
             {std::string("garbage"), std::string(1000, 'x'), std::string(1000, '\0'), std::string(5000, '\xff')}) {
            const std::string found = problem(std::string("a") + extension, text);
            EXPECT_NE(found, "") << extension;
            EXPECT_EQ(found.find('\n'), std::string::npos) << found;
        }
    }
}

TEST_F(AssimpFile, loadSceneReportsABrokenFileInOneLine)
{
    fs::create_directory(folder / "d.obj");
    const std::pair<fs::path, std::string> cases[] = {{folder / "none.obj", "no such file"},
                                                      {folder / "d.obj", "found a folder"},
                                                      {write("e.obj", ""), "the file is empty"},
                                                      {write("f.xyz", "x"), "found \".xyz\""},
                                                      {write("g", "x"), "found \"\""}};
    for (const auto& [file, expected] : cases) {
        const auto scene = loadScene(file);
        ASSERT_FALSE(scene) << file;
        EXPECT_EQ(scene.error().kind, ErrorKind::input);
        EXPECT_TRUE(scene.error().message.starts_with(file.string())) << scene.error().message;
        EXPECT_NE(scene.error().message.find(expected), std::string::npos) << scene.error().message;
    }
    EXPECT_EQ(load("Upper.OBJ", kQuad + kQuadFace).meshes.size(), 1u);
}

// Counts of an OBJ file from reading its text word by word, the slow and obvious way.
struct Counted {
    std::size_t triangles = 0;
    Bounds box; // of positions that faces use
};

Counted countText(const fs::path& file)
{
    Counted counted;
    std::vector<glm::vec3> positions;
    std::ifstream in(file);
    for (std::string line, word; std::getline(in, line);) {
        std::istringstream words(line);
        words >> word;
        if (!words)
            continue;
        if (word == "v") {
            glm::vec3 p;
            words >> p.x >> p.y >> p.z;
            positions.push_back(p);
        }
        if (word == "f") {
            std::size_t corners = 0;
            for (; words >> word; ++corners) {
                const int index = std::stoi(word);
                const std::size_t at = index > 0 ? std::size_t(index) - 1 : positions.size() - std::size_t(-index);
                counted.box.low = glm::min(counted.box.low, positions[at]);
                counted.box.high = glm::max(counted.box.high, positions[at]);
            }
            counted.triangles += corners - 2;
        }
    }
    return counted;
}

TEST(ObjModels, everyModelHasTheTrianglesAndBoundsOfItsText)
{
    COTAN_NEEDS_DATA("bake/bunny");
    std::size_t models = 0;
    for (const char* part : {"classic", "bake"}) {
        for (const auto& entry : fs::recursive_directory_iterator(test::dataFile(part))) {
            if (entry.path().extension() != ".obj")
                continue;
            const auto start = std::chrono::steady_clock::now();
            const auto scene = loadScene(entry.path());
            const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
            ASSERT_TRUE(scene) << scene.error().message;
            EXPECT_LT(took.count(), 5.0) << entry.path();
            expectSound(*scene);
            const Counted counted = countText(entry.path());
            std::size_t triangles = 0;
            for (const Instance& instance : scene->instances)
                triangles += scene->meshes[std::size_t(instance.mesh)].triangleCount();
            EXPECT_EQ(triangles, counted.triangles) << entry.path();
            const Bounds box = bounds(*scene);
            // Two decimal parsers may differ in the last bit of a float.
            const float slack = 2e-7f * glm::length(counted.box.high - counted.box.low);
            EXPECT_LT(glm::length(box.low - counted.box.low), slack) << entry.path();
            EXPECT_LT(glm::length(box.high - counted.box.high), slack) << entry.path();
            ++models;
        }
    }
    EXPECT_GE(models, 11u);
}

TEST(BadData, everyObjIsAcceptedOrRefusedWithinTimeAndMemory)
{
    COTAN_NEEDS_DATA("bad/EXPECTED.tsv");
    const auto rows = test::expectedFor(".obj");
    ASSERT_FALSE(rows.empty());
    for (const auto& row : rows) {
        testing::internal::CaptureStderr();
        const auto start = std::chrono::steady_clock::now();
        const auto scene = loadScene(row.file);
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
        EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << row.file;
        EXPECT_LT(took.count(), 5.0) << row.file;
        if (row.verdict == "reject") {
            EXPECT_FALSE(scene) << row.file;
        }
        if (row.verdict == "accept") {
            EXPECT_TRUE(scene) << row.file;
        }
        if (row.verdict == "warn") {
            EXPECT_TRUE(!scene || !scene->warnings.empty()) << row.file;
        }
        if (scene)
            expectSound(*scene);
        else
            EXPECT_EQ(scene.error().message.find('\n'), std::string::npos) << scene.error().message;
    }
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    EXPECT_LT(usage.ru_maxrss, 1 << 20) << "KB";
}

} // namespace
} // namespace cotan
