// Materials and limits of OBJ models: each statement on its own, each limit from both sides.
#include <algorithm>
#include <cmath>
#include <cstring>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "model_file.hpp"
#include "scene/geometry.hpp"

namespace cotan {
namespace {

const std::string kPlainTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

// ---- MTL ------------------------------------------------------------------------------------------

TEST_F(ModelFile, defaultMaterialIsGreyRoughAndNotMetallic)
{
    const Scene none = get("a.obj", kPlainTriangle);
    ASSERT_EQ(none.materials.size(), 1u);
    for (const Material& m : {none.materials[0], materialBy("")}) {
        EXPECT_EQ(m.baseColor, glm::vec4(0.6f, 0.6f, 0.6f, 1));
        EXPECT_EQ(m.roughness, 0.7f);
        EXPECT_EQ(m.metallic, 0);
        EXPECT_EQ(m.emissive, glm::vec3(0));
        EXPECT_EQ(m.normalScale, 1);
        EXPECT_EQ(m.alphaMode, AlphaMode::opaque);
        EXPECT_TRUE(m.doubleSided);
        for (const Texture* t :
             {&m.baseColorMap, &m.metallicRoughnessMap, &m.normalMap, &m.occlusionMap, &m.emissiveMap})
            EXPECT_FALSE(t->present());
    }
    EXPECT_EQ(none.materials[0].name, "default");
    EXPECT_TRUE(none.warnings.empty());
    EXPECT_EQ(none.meshes[0].name, "a.obj");
    EXPECT_EQ(none.name, "a.obj");
}

TEST_F(ModelFile, eachMapComesFromItsStatement)
{
    paint("a.png", {10, 20, 200});
    struct Row {
        const char* line;
        Texture Material::*map;
    };
    for (const Row& row : {Row{"map_Kd a.png\n", &Material::baseColorMap},
                           {"map_Ke a.png\n", &Material::emissiveMap},
                           {"map_emissive a.png\n", &Material::emissiveMap},
                           {"map_Pr a.png\n", &Material::metallicRoughnessMap},
                           {"map_Pm a.png\n", &Material::metallicRoughnessMap},
                           {"norm a.png\n", &Material::normalMap}}) {
        const Material m = materialBy(row.line);
        for (const auto map : {&Material::baseColorMap, &Material::metallicRoughnessMap, &Material::normalMap,
                               &Material::occlusionMap, &Material::emissiveMap})
            EXPECT_EQ((m.*map).present(), map == row.map) << row.line;
    }
}

// Exporters write a black factor where they mean the map alone; any other colour is a factor.
TEST_F(ModelFile, blackFactorOfAMappedChannelBecomesWhite)
{
    paint("a.png", {10, 20, 200});
    EXPECT_EQ(materialBy("Kd 0 0 0\nmap_Kd a.png\n").baseColor, glm::vec4(1));
    EXPECT_EQ(materialBy("Kd 0 0 0\n").baseColor, glm::vec4(0, 0, 0, 1));
    EXPECT_EQ(materialBy("Kd 0 0 0\nmap_Kd gone.png\n").baseColor, glm::vec4(0, 0, 0, 1));
    EXPECT_EQ(materialBy("Kd 0 0.25 0\nmap_Kd a.png\n").baseColor, glm::vec4(0, 0.25f, 0, 1));
    EXPECT_EQ(materialBy("map_Ke a.png\n").emissive, glm::vec3(1));
    EXPECT_EQ(materialBy("Ke 0 0 0.5\nmap_Ke a.png\n").emissive, glm::vec3(0, 0, 0.5f));
    EXPECT_EQ(materialBy("Ke 3 0 0.5\n").emissive, glm::vec3(3, 0, 0.5f)); // light brighter than white is kept
    EXPECT_EQ(materialBy("map_Ke gone.png\n").emissive, glm::vec3(0));
}

TEST_F(ModelFile, opacityBelowOneBlendsAndZeroIsReported)
{
    struct Row {
        const char* line;
        float alpha;
        AlphaMode mode;
        bool said;
    };
    for (const Row& row : {Row{"d 1\n", 1, AlphaMode::opaque, false},
                           {"d 2\n", 1, AlphaMode::opaque, false},
                           {"d 0.999\n", 0.999f, AlphaMode::blend, false},
                           {"d 0.001\n", 0.001f, AlphaMode::blend, false},
                           {"d 0\n", 1, AlphaMode::opaque, true},
                           {"Tr 1\n", 1, AlphaMode::opaque, true},
                           {"Tr 0\n", 1, AlphaMode::opaque, false},
                           {"d -1\n", 1, AlphaMode::opaque, true}}) {
        const Scene scene = paintedBy(row.line);
        EXPECT_EQ(scene.materials.at(0).baseColor.w, row.alpha) << row.line;
        EXPECT_EQ(scene.materials.at(0).alphaMode, row.mode) << row.line;
        EXPECT_EQ(says(scene, "material m: its opacity is 0; treated as opaque"), row.said) << row.line;
    }
    paint("a.png", {10, 20, 200});
    paint("b.png", {10, 20, 200});
    EXPECT_EQ(materialBy("map_Kd a.png\nmap_d a.png\n").alphaMode, AlphaMode::mask);
    const Scene other = paintedBy("map_Kd a.png\nmap_d b.png\n");
    EXPECT_EQ(other.materials.at(0).alphaMode, AlphaMode::opaque);
    EXPECT_TRUE(says(other, "material m: the opacity map b.png is left out"));
}

TEST_F(ModelFile, roughnessIsStatedOrDerivedFromShininess)
{
    for (const auto& [line, roughness] : {std::pair("Ns 6\n", std::pow(2.0 / 8, 0.25)),
                                          {"Ns 0\n", 0.7},
                                          {"Ns -4\n", 0.7},
                                          {"Ns 30\nPr 0.125\n", 0.125},
                                          {"Pr 1.5\n", 1.0},
                                          {"Pr -1\n", 0.0},
                                          {"Pr 0\n", 0.0}})
        EXPECT_NEAR(materialBy(line).roughness, roughness, 1e-6) << line;
    for (const auto& [line, metallic] : {std::pair("Pm 1.5\n", 1.0f), {"Pm -1\n", 0.0f}, {"Pm 0.25\n", 0.25f}})
        EXPECT_EQ(materialBy(line).metallic, metallic) << line;
    paint("a.png", {10, 20, 200});
    EXPECT_EQ(materialBy("map_Pr a.png\n").roughness, 1); // a map has factor 1
    EXPECT_EQ(materialBy("map_Pr a.png\n").metallic, 0);
    EXPECT_EQ(materialBy("map_Pm a.png\n").metallic, 1);
    EXPECT_EQ(materialBy("map_Pm a.png\n").roughness, 0.7f);
    EXPECT_EQ(materialBy("map_Pr a.png\nPr 0.5\n").roughness, 0.5f);
    EXPECT_EQ(materialBy("map_Pm a.png\nPm 0.5\n").metallic, 0.5f);
    // A single map leaves the other channel white.
    for (const auto& [line, green, blue] : {std::tuple("map_Pr a.png\n", 10, 255), {"map_Pm a.png\n", 255, 10}}) {
        const Scene scene = paintedBy(line);
        const Image& image = scene.images.at(std::size_t(scene.materials.at(0).metallicRoughnessMap.image));
        EXPECT_EQ(image.bytes8()[0], 255) << line;
        EXPECT_EQ(image.bytes8()[1], green) << line;
        EXPECT_EQ(image.bytes8()[2], blue) << line;
        EXPECT_EQ(image.bytes8()[3], 255) << line;
        EXPECT_EQ(image.width, 4) << line;
    }
}

TEST_F(ModelFile, normalMapTakesPrecedenceOverBumpMap)
{
    paint("n.png", {128, 128, 255});
    paint("b.png", {120, 120, 255});
    for (const std::string lines : {"norm n.png\nbump b.png\n", "bump b.png\nnorm n.png\n"}) {
        const Scene scene = paintedBy(lines);
        const Material& m = scene.materials.at(0);
        EXPECT_EQ(scene.images.at(std::size_t(m.normalMap.image)).bytes8()[0], 128) << lines;
    }
    EXPECT_EQ(materialBy("norm -bm 0.25 n.png\n").normalScale, 0.25f);
    EXPECT_EQ(materialBy("norm -bm 0.25 gone.png\n").normalScale, 1);
}

// A nearly grey image is a height map: mean red and blue differ by at most 3 % of the range.
TEST_F(ModelFile, greyBumpMapIsAHeightMap)
{
    for (const auto& [blue, height] : {std::pair(100, true), {107, true}, {108, false}, {92, false}, {93, true}}) {
        const std::string name = fmt::format("{}.png", blue);
        paint(name, {100, 30, blue});
        EXPECT_EQ(says(paintedBy("bump " + name + "\n"), "is grey: treated as a height map"), height) << blue;
    }
    // White is a hundredth of the width high, and -bm scales that: a ramp of one step in 255 per texel.
    Image ramp = makeImage(64, 8, PixelType::unorm8);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 64; ++x) {
            const std::uint8_t v = std::uint8_t(2 * x);
            const std::uint8_t rgba[4] = {v, v, v, 255};
            std::memcpy(ramp.bytes8() + 4 * (y * 64 + x), rgba, 4);
        }
    ASSERT_TRUE(writeImage(folder / "ramp.png", ramp));
    for (const double strength : {1.0, 8.0}) {
        const Scene scene = paintedBy(fmt::format("bump -bm {} ramp.png\n", strength));
        EXPECT_EQ(scene.materials.at(0).normalScale, 1); // the conversion contains the strength
        const Image& map = scene.images.at(std::size_t(scene.materials.at(0).normalMap.image));
        EXPECT_TRUE(map.name.ends_with(" (bump)")) << map.name;
        const std::uint8_t* texel = map.bytes8() + 4 * (4 * 64 + 30);
        const double slope = 2.0 / 255 * 0.01 * 64 * strength; // rise over a texel, in texels
        EXPECT_NEAR((texel[0] / 127.5 - 1) / (texel[2] / 127.5 - 1), -slope, 0.01) << strength;
        EXPECT_NEAR(texel[1] / 127.5 - 1, 0, 0.01) << strength;
    }
}

TEST_F(ModelFile, mapOnAMeshWithoutUvIsReportedOnce)
{
    paint("a.png", {10, 20, 200});
    put("m.mtl", "newmtl m\nmap_Kd a.png\nmap_Ke a.png\n");
    const Scene scene = get("b.obj", "mtllib m.mtl\nusemtl m\no it\n" + kPlainTriangle);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_EQ(scene.warnings[0],
              "mesh it: it has no texture coordinates 0, which material m needs; its textures are not drawn");
    const Scene mixed = get("c.obj", kPlainTriangle + "vt 0 0\nf 1/1 2/1 3/1\n");
    EXPECT_TRUE(says(mixed, "1 of 2 faces have no texture coordinates; 0 is used"));
}

TEST_F(ModelFile, imagesShareOneMemoryBudget)
{
    paint("a.png", {1, 2, 200});
    paint("b.png", {4, 5, 200});
    const std::string lines = "map_Kd a.png\nmap_Ke b.png\n";
    for (const auto& [budget, images] : {std::pair(128, 2u), {127, 1u}, {64, 1u}, {63, 0u}}) {
        LoadLimits limits;
        limits.allImageBytes = std::size_t(budget);
        const Scene scene = paintedBy(lines, limits);
        EXPECT_EQ(scene.images.size(), images) << budget;
        EXPECT_EQ(scene.warnings.size(), 2 - images) << budget;
    }
    paint("g.png", {50, 50, 50}); // a height map and its normal map
    for (const auto& [budget, images] : {std::pair(128, 2u), {127, 1u}}) {
        LoadLimits limits;
        limits.allImageBytes = std::size_t(budget);
        const Scene scene = paintedBy("bump g.png\n", limits);
        EXPECT_EQ(scene.images.size(), images) << budget;
        EXPECT_EQ(scene.materials.at(0).normalMap.present(), images == 2u) << budget;
    }
}

TEST_F(ModelFile, oneHeightMapOfOneStrengthIsConvertedOnce)
{
    paint("g.png", {50, 50, 50});
    put("m.mtl", "newmtl a\nbump g.png\nnewmtl b\nbump g.png\nnewmtl c\nbump -bm 2 g.png\n");
    const std::string face = "f 1/1 2/1 3/1\n";
    const Scene scene = get("model.obj",
                            "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl a\n" + face + "usemtl b\n" + face
                                + "usemtl c\n" + face);
    ASSERT_EQ(scene.materials.size(), 3u);
    EXPECT_EQ(scene.images.size(), 3u); // heights, and two normal maps
    EXPECT_EQ(scene.materials[0].normalMap.image, scene.materials[1].normalMap.image);
    EXPECT_NE(scene.materials[0].normalMap.image, scene.materials[2].normalMap.image);
}

// ---- OBJ ------------------------------------------------------------------------------------------

TEST_F(ModelFile, limitsAreInclusive)
{
    const std::string two = kPlainTriangle + "o b\nf 1 3 2\n"; // 3 positions, 2 triangles, 2 parts
    const auto limited = [](auto field, std::size_t value) {
        LoadLimits limits;
        limits.*field = value;
        return limits;
    };
    EXPECT_EQ(refusal("a.obj", two, limited(&LoadLimits::triangles, 2)), "");
    EXPECT_NE(refusal("a.obj", two, limited(&LoadLimits::triangles, 1)), "");
    EXPECT_EQ(refusal("a.obj", two, limited(&LoadLimits::vertices, 3)), "");
    EXPECT_NE(refusal("a.obj", two, limited(&LoadLimits::vertices, 2)), "");
    EXPECT_EQ(refusal("a.obj", two, limited(&LoadLimits::nodes, 2)), "");
    EXPECT_NE(refusal("a.obj", two, limited(&LoadLimits::nodes, 1)), "");
    EXPECT_EQ(refusal("a.obj", two, limited(&LoadLimits::fileBytes, two.size())), "");
    EXPECT_NE(refusal("a.obj", two, limited(&LoadLimits::fileBytes, two.size() - 1)), "");
    for (const std::string word : {"vt 0 0\n", "vn 0 0 1\n"}) { // these count, too
        EXPECT_EQ(refusal("a.obj", word + word + word + two, limited(&LoadLimits::vertices, 3)), "") << word;
        EXPECT_NE(refusal("a.obj", word + word + word + word + two, limited(&LoadLimits::vertices, 3)), "") << word;
    }
}

TEST_F(ModelFile, onlyFiniteNumbersAreRead)
{
    const auto with = [&](const std::string& x) {
        return refusal("a.obj", "v " + x + " 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    };
    for (const char* good : {"3.4e37", "-3.4e37", "1e-400", "+1", "1e-45", ".5", "5."})
        EXPECT_EQ(with(good), "") << good;
    for (const char* bad : {"3.5e38", "-3.5e38", "1e400", "++1", "inf", "nan", "1x", "0x1"})
        EXPECT_NE(with(bad).find("line 1: expected a finite number"), std::string::npos) << bad << with(bad);
}

TEST_F(ModelFile, errorLinesCountContinuedLines)
{
    const std::string joined = "v 0 0 \\\n0\nv 1 0 0\r\nv 0 \\\r\n1 0\n";
    EXPECT_NE(refusal("a.obj", joined + "f 1 2 x\n").find("line 6: "), std::string::npos)
        << refusal("a.obj", joined + "f 1 2 x\n");
    EXPECT_NE(refusal("a.obj", joined + "f 1 2 \\\n4\n").find("line 6: expected a position index up to 3, found 4"),
              std::string::npos)
        << refusal("a.obj", joined + "f 1 2 \\\n4\n");
    EXPECT_NE(refusal("a.obj", "v 0 0 \\\nx\n").find("line 1: "), std::string::npos);
}

TEST_F(ModelFile, onlyIdenticalVerticesAreShared)
{
    const std::string head = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                             "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 0.5 0\nvn 0 0 1\nvn 0 1 0\n";
    const auto vertices = [&](const std::string& second) {
        return get("a.obj", head + "f 1/1/1 2/2/1 3/3/1\nf " + second + "\n").meshes.at(0).vertexCount();
    };
    EXPECT_EQ(vertices("1/1/1 3/3/1 4/4/1"), 4u);
    EXPECT_EQ(vertices("1/5/1 3/3/1 4/4/1"), 5u); // another uv
    EXPECT_EQ(vertices("1/1/2 3/3/1 4/4/1"), 5u); // another normal
    EXPECT_EQ(vertices("1/5/1 3/5/1 4/4/2"), 6u);
}

TEST_F(ModelFile, zUpIsConvertedAndAnimationsRequireGltf)
{
    LoadLimits limits;
    limits.up = Up::z;
    const Scene scene = get("a.obj", "v 0 0 0\nv 1 0 0\nv 0 0 2\nf 1 2 3\n", limits);
    const Bounds box = bounds(scene);
    EXPECT_NEAR(glm::length(box.high - glm::vec3(1, 2, 0)), 0, 1e-6);
    limits = {};
    limits.pose.animation = "walk";
    const auto posed = loadScene(put("a.obj", kPlainTriangle), limits);
    ASSERT_FALSE(posed);
    EXPECT_EQ(posed.error().kind, ErrorKind::usage);
    EXPECT_NE(refusal("a.xyz", kPlainTriangle).find(R"(found ".xyz")"), std::string::npos);
}

} // namespace
} // namespace cotan
