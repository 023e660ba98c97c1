// Materials, limits and oddities of models in OBJ, COLLADA and PLY: each statement alone, both sides of each bound.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <unistd.h>

#include "cotan/image/file.hpp"
#include "cotan/model/load.hpp"
#include "cotan/scene/geometry.hpp"

namespace cotan {
namespace {

class ModelFile : public testing::Test {
protected:
    std::filesystem::path folder = std::filesystem::temp_directory_path()
        / ("cotan_model_test_" + std::to_string(::getpid()) + "_"
           + testing::UnitTest::GetInstance()->current_test_info()->name());
    void SetUp() override { std::filesystem::create_directories(folder); }
    void TearDown() override { std::filesystem::remove_all(folder); }

    std::filesystem::path put(const std::string& name, const std::string& text) const
    {
        std::ofstream(folder / name, std::ios::binary) << text;
        return folder / name;
    }

    // An image of one colour.
    void paint(const std::string& name, std::array<int, 3> colour, int width = 4, int height = 4) const
    {
        Image image = makeImage(width, height, PixelType::unorm8);
        for (std::size_t i = 0; i < image.pixelCount(); ++i)
            for (std::size_t c = 0; c < 4; ++c)
                image.bytes8()[4 * i + c] = c < 3 ? std::uint8_t(colour[c]) : 255;
        ASSERT_TRUE(writeImage(folder / name, image));
    }

    Scene get(const std::string& name, const std::string& text, const LoadLimits& limits = {}) const
    {
        auto scene = loadScene(put(name, text), limits);
        if (!scene) {
            ADD_FAILURE() << scene.error().message;
            return {};
        }
        return *std::move(scene);
    }
    std::string refusal(const std::string& name, const std::string& text, const LoadLimits& limits = {}) const
    {
        const auto scene = loadScene(put(name, text), limits);
        return scene ? "" : scene.error().message;
    }

    // A triangle whose material has these lines.
    Scene paintedBy(const std::string& lines, const LoadLimits& limits = {}) const
    {
        put("m.mtl", "newmtl m\n" + lines);
        return get("model.obj",
                   "mtllib m.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n",
                   limits);
    }
    Material materialBy(const std::string& lines) const
    {
        const Scene scene = paintedBy(lines);
        return scene.meshes.empty() ? Material{} : scene.materials.at(std::size_t(scene.meshes[0].material));
    }
};

bool says(const Scene& scene, const std::string& text)
{
    return std::ranges::any_of(scene.warnings, [&](const std::string& s) { return s.find(text) != std::string::npos; });
}

const std::string kPlainTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

// ---- MTL ------------------------------------------------------------------------------------------

TEST_F(ModelFile, aMaterialWithoutStatementsIsGreyRoughAndNoMetal)
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

TEST_F(ModelFile, eachMapIsThatOfItsOwnStatement)
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

// Exporters leave a factor at black where the map alone is meant; any other colour is a factor.
TEST_F(ModelFile, aBlackFactorBesideItsMapIsWhite)
{
    paint("a.png", {10, 20, 200});
    EXPECT_EQ(materialBy("Kd 0 0 0\nmap_Kd a.png\n").baseColor, glm::vec4(1));
    EXPECT_EQ(materialBy("Kd 0 0 0\n").baseColor, glm::vec4(0, 0, 0, 1));
    EXPECT_EQ(materialBy("Kd 0 0 0\nmap_Kd gone.png\n").baseColor, glm::vec4(0, 0, 0, 1));
    EXPECT_EQ(materialBy("Kd 0 0.25 0\nmap_Kd a.png\n").baseColor, glm::vec4(0, 0.25f, 0, 1));
    EXPECT_EQ(materialBy("map_Ke a.png\n").emissive, glm::vec3(1));
    EXPECT_EQ(materialBy("Ke 0 0 0.5\nmap_Ke a.png\n").emissive, glm::vec3(0, 0, 0.5f));
    EXPECT_EQ(materialBy("Ke 3 0 0.5\n").emissive, glm::vec3(3, 0, 0.5f)); // brighter than white is light, too
    EXPECT_EQ(materialBy("map_Ke gone.png\n").emissive, glm::vec3(0));
}

TEST_F(ModelFile, opacityBlendsBelowOneAndZeroIsAMistakeThatIsSaid)
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
        EXPECT_EQ(says(scene, "material m: its opacity is 0; taken as opaque"), row.said) << row.line;
    }
    paint("a.png", {10, 20, 200});
    paint("b.png", {10, 20, 200});
    EXPECT_EQ(materialBy("map_Kd a.png\nmap_d a.png\n").alphaMode, AlphaMode::mask);
    const Scene other = paintedBy("map_Kd a.png\nmap_d b.png\n");
    EXPECT_EQ(other.materials.at(0).alphaMode, AlphaMode::opaque);
    EXPECT_TRUE(says(other, "material m: the opacity map b.png is left out"));
}

TEST_F(ModelFile, roughnessIsWhatIsSaidOrFromTheShininessAndIsClamped)
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
    EXPECT_EQ(materialBy("map_Pr a.png\n").roughness, 1); // a map has its factor at one
    EXPECT_EQ(materialBy("map_Pr a.png\n").metallic, 0);
    EXPECT_EQ(materialBy("map_Pm a.png\n").metallic, 1);
    EXPECT_EQ(materialBy("map_Pm a.png\n").roughness, 0.7f);
    EXPECT_EQ(materialBy("map_Pr a.png\nPr 0.5\n").roughness, 0.5f);
    EXPECT_EQ(materialBy("map_Pm a.png\nPm 0.5\n").metallic, 0.5f);
    // Alone, a map leaves the other channel white.
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

TEST_F(ModelFile, aNormalMapGoesBeforeABumpMapInAnyOrder)
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

// What is nearly grey is a height map: red and blue are at most 3 % of the range apart in the mean.
TEST_F(ModelFile, aBumpMapIsOfHeightsWhereRedIsNearlyBlue)
{
    for (const auto& [blue, height] : {std::pair(100, true), {107, true}, {108, false}, {92, false}, {93, true}}) {
        const std::string name = fmt::format("{}.png", blue);
        paint(name, {100, 30, blue});
        EXPECT_EQ(says(paintedBy("bump " + name + "\n"), "is grey: taken as a height map"), height) << blue;
    }
    // A hundredth of the width at white, and -bm scales it: a ramp of one step in 255 a texel.
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
        EXPECT_EQ(scene.materials.at(0).normalScale, 1); // the strength is in the conversion
        const Image& map = scene.images.at(std::size_t(scene.materials.at(0).normalMap.image));
        EXPECT_TRUE(map.name.ends_with(" (bump)")) << map.name;
        const std::uint8_t* texel = map.bytes8() + 4 * (4 * 64 + 30);
        const double slope = 2.0 / 255 * 0.01 * 64 * strength; // height over a texel, in texels
        EXPECT_NEAR((texel[0] / 127.5 - 1) / (texel[2] / 127.5 - 1), -slope, 0.01) << strength;
        EXPECT_NEAR(texel[1] / 127.5 - 1, 0, 0.01) << strength;
    }
}

TEST_F(ModelFile, aMapOnAMeshWithoutTextureCoordinatesIsSaidOnce)
{
    paint("a.png", {10, 20, 200});
    put("m.mtl", "newmtl m\nmap_Kd a.png\nmap_Ke a.png\n");
    const Scene scene = get("b.obj", "mtllib m.mtl\nusemtl m\no it\n" + kPlainTriangle);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_EQ(scene.warnings[0],
              "mesh it: it has no texture coordinates 0, which material m needs; textures and normal map cannot show");
    const Scene mixed = get("c.obj", kPlainTriangle + "vt 0 0\nf 1/1 2/1 3/1\n");
    EXPECT_TRUE(says(mixed, "1 of 2 faces have no texture coordinates; theirs are 0"));
}

TEST_F(ModelFile, imagesTakeWhatIsLeftOfTheBudgetOfAll)
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
    paint("g.png", {50, 50, 50}); // a height map and the normal map of it
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

TEST_F(ModelFile, limitsAreReachedAndNotPassed)
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
    for (const std::string word : {"vt 0 0\n", "vn 0 0 1\n"}) { // these are counted, too
        EXPECT_EQ(refusal("a.obj", word + word + word + two, limited(&LoadLimits::vertices, 3)), "") << word;
        EXPECT_NE(refusal("a.obj", word + word + word + word + two, limited(&LoadLimits::vertices, 3)), "") << word;
    }
}

TEST_F(ModelFile, numbersReachToTheEndsOfFloat)
{
    const auto with = [&](const std::string& x) {
        return refusal("a.obj", "v " + x + " 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    };
    for (const char* good : {"3.4e37", "-3.4e37", "1e-400", "+1", "1e-45", ".5", "5."})
        EXPECT_EQ(with(good), "") << good;
    for (const char* bad : {"3.5e38", "-3.5e38", "1e400", "++1", "inf", "nan", "1x", "0x1"})
        EXPECT_NE(with(bad).find("line 1: expected a finite number"), std::string::npos) << bad << with(bad);
}

TEST_F(ModelFile, theLineOfAFaultCountsThoseThatAreJoined)
{
    const std::string joined = "v 0 0 \\\n0\nv 1 0 0\r\nv 0 \\\r\n1 0\n";
    EXPECT_NE(refusal("a.obj", joined + "f 1 2 x\n").find("line 6: "), std::string::npos)
        << refusal("a.obj", joined + "f 1 2 x\n");
    EXPECT_NE(refusal("a.obj", joined + "f 1 2 \\\n4\n").find("line 6: expected a position index up to 3, found 4"),
              std::string::npos)
        << refusal("a.obj", joined + "f 1 2 \\\n4\n");
    EXPECT_NE(refusal("a.obj", "v 0 0 \\\nx\n").find("line 1: "), std::string::npos);
}

TEST_F(ModelFile, verticesAreSharedWhereAllOfThemIsEqualAndApartWhereAnythingDiffers)
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

TEST_F(ModelFile, modelsWithZUpAreTurnedAndAnimationsAreOfGltfAlone)
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

// ---- COLLADA ----------------------------------------------------------------------------------------

struct Collada {
    std::string sampler;        // of the diffuse texture: MAYA's words
    std::string uvName = "UV0"; // that the texture reads
    std::string nodes = "<node id=\"n\"><instance_geometry url=\"#g\"><bind_material><technique_common>"
                        "<instance_material symbol=\"M\" target=\"#m\"><bind_vertex_input semantic=\"UV0\" "
                        "input_semantic=\"TEXCOORD\" input_set=\"0\"/><bind_vertex_input semantic=\"UV1\" "
                        "input_semantic=\"TEXCOORD\" input_set=\"1\"/></instance_material></technique_common>"
                        "</bind_material></instance_geometry></node>";
    std::string libraries;
    std::string positions = "0 0 0 1 0 0 0 1 0";
    int counted = 9; // numbers, as the array says

    std::string text() const
    {
        const auto source = [](const char* id, const std::string& numbers, int count, int stride) {
            std::string params;
            for (int i = 0; i < stride; ++i)
                params += fmt::format("<param name=\"{}\" type=\"float\"/>", "XYZ"[i]);
            return fmt::format("<source id=\"{0}\"><float_array id=\"{0}a\" count=\"{1}\">{2}</float_array>"
                               "<technique_common><accessor source=\"#{0}a\" count=\"3\" stride=\"{3}\">{4}</accessor>"
                               "</technique_common></source>",
                               id, count, numbers, stride, params);
        };
        return "<?xml version=\"1.0\"?><COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" "
               "version=\"1.4.1\"><asset><up_axis>Y_UP</up_axis></asset>"
               "<library_images><image id=\"i\"><init_from>a.png</init_from></image></library_images>"
               "<library_effects><effect id=\"e\"><profile_COMMON>"
               "<newparam sid=\"s\"><surface type=\"2D\"><init_from>i</init_from></surface></newparam>"
               "<newparam sid=\"t\"><sampler2D><source>s</source></sampler2D></newparam>"
               "<technique sid=\"c\"><lambert><diffuse><texture texture=\"t\" texcoord=\""
            + uvName + "\"><extra><technique profile=\"MAYA\">" + sampler
            + "</technique></extra></texture></diffuse></lambert></technique></profile_COMMON></effect>"
              "</library_effects><library_materials><material id=\"m\" name=\"m\"><instance_effect url=\"#e\"/>"
              "</material></library_materials>"
            + libraries + "<library_geometries><geometry id=\"g\" name=\"g\"><mesh>"
            + source("p", positions, counted, 3) + source("u", "0 0 1 0 0 1", 6, 2)
            + source("w", "0.5 0 1 0 0 0.25", 6, 2)
            + "<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/></vertices>"
              "<triangles count=\"1\" material=\"M\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/>"
              "<input semantic=\"TEXCOORD\" source=\"#u\" offset=\"0\" set=\"0\"/>"
              "<input semantic=\"TEXCOORD\" source=\"#w\" offset=\"0\" set=\"1\"/><p>0 1 2</p></triangles></mesh>"
              "</geometry></library_geometries><library_visual_scenes><visual_scene id=\"vs\">"
            + nodes
            + "</visual_scene></library_visual_scenes><scene><instance_visual_scene url=\"#vs\"/></scene></COLLADA>";
    }
};

TEST_F(ModelFile, colladaWrapsEachDirectionByItself)
{
    paint("a.png", {10, 20, 200});
    for (const auto& [words, u, v] :
         {std::tuple("<wrapU>1</wrapU><wrapV>1</wrapV>", Wrap::repeat, Wrap::repeat),
          {"<wrapU>0</wrapU><wrapV>1</wrapV>", Wrap::clamp, Wrap::repeat},
          {"<wrapU>1</wrapU><wrapV>0</wrapV>", Wrap::repeat, Wrap::clamp},
          {"<wrapU>1</wrapU><wrapV>1</wrapV><mirrorU>1</mirrorU>", Wrap::mirror, Wrap::repeat},
          {"<wrapU>1</wrapU><wrapV>1</wrapV><mirrorV>1</mirrorV>", Wrap::repeat, Wrap::mirror}}) {
        Collada collada;
        collada.sampler = words;
        const Scene scene = get("a.dae", collada.text());
        const Material& m = scene.materials.at(std::size_t(scene.meshes.at(0).material));
        ASSERT_TRUE(m.baseColorMap.present()) << words;
        EXPECT_EQ(m.baseColorMap.sampler.wrapU, u) << words;
        EXPECT_EQ(m.baseColorMap.sampler.wrapV, v) << words;
        EXPECT_EQ(m.name, "m");
    }
}

// Scaled, turned about the middle of the image, and shifted, with v up.
TEST_F(ModelFile, colladaTexturesAreScaledTurnedAndShifted)
{
    paint("a.png", {10, 20, 200});
    struct Row {
        glm::dvec2 scale, offset;
        double angle;
    };
    for (const Row& row : {Row{{1, 1}, {0, 0}, 0},
                           {{2, 3}, {0, 0}, 0},
                           {{1, 1}, {0.25, 0.125}, 0},
                           {{1, 1}, {0, 0}, 0.5},
                           {{2, 0.5}, {0.125, -0.25}, -1.25}}) {
        Collada collada;
        collada.sampler = fmt::format("<repeatU>{}</repeatU><repeatV>{}</repeatV><offsetU>{}</offsetU>"
                                      "<offsetV>{}</offsetV><rotateUV>{}</rotateUV>",
                                      row.scale.x, row.scale.y, row.offset.x, row.offset.y, row.angle);
        const Scene scene = get("a.dae", collada.text());
        const Texture& t = scene.materials.at(std::size_t(scene.meshes.at(0).material)).baseColorMap;
        for (const glm::dvec2 up : {glm::dvec2(0, 0), {1, 0}, {0.25, 0.75}}) {
            const glm::dvec2 from = up * row.scale - 0.5;
            const double c = std::cos(row.angle), s = std::sin(row.angle);
            const glm::dvec2 to = glm::dvec2(c * from.x - s * from.y, s * from.x + c * from.y) + 0.5 + row.offset;
            const glm::vec3 down(up.x, 1 - up.y, 1);
            EXPECT_NEAR(glm::dot(t.uRow, down), to.x, 1e-5) << collada.sampler;
            EXPECT_NEAR(glm::dot(t.vRow, down), 1 - to.y, 1e-5) << collada.sampler;
        }
    }
}

TEST_F(ModelFile, colladaTexturesReadTheSetOfCoordinatesThatTheyName)
{
    paint("a.png", {10, 20, 200});
    for (const int set : {0, 1}) {
        Collada collada;
        collada.uvName = fmt::format("UV{}", set);
        const Scene scene = get("a.dae", collada.text());
        const Mesh& mesh = scene.meshes.at(0);
        EXPECT_EQ(scene.materials.at(std::size_t(mesh.material)).baseColorMap.texcoord, set);
        ASSERT_EQ(mesh.texcoords[0].size(), 3u);
        ASSERT_EQ(mesh.texcoords[1].size(), 3u);
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::vec2 p(mesh.positions[i]);
            EXPECT_EQ(mesh.texcoords[0][i], glm::vec2(p.x, 1 - p.y));
            EXPECT_EQ(mesh.texcoords[1][i], glm::vec2(p.x + p.y == 0 ? 0.5f : p.x, 1 - p.y / 4));
        }
    }
}

TEST_F(ModelFile, colladaAccessorsReachToTheEndOfTheirArrayAndNoFurther)
{
    Collada collada;
    EXPECT_EQ(refusal("a.dae", collada.text()), "");
    collada.counted = 8;
    EXPECT_NE(refusal("a.dae", collada.text()).find("accessor of #pa: expected an array of 9 numbers or more, found 8"),
              std::string::npos);
    collada.counted = 10;
    collada.positions += " 0";
    EXPECT_EQ(refusal("a.dae", collada.text()), "");
    std::string text = Collada().text();
    const std::size_t at = text.find("stride=\"3\"");
    text.insert(at, "offset=\"1\" ");
    EXPECT_NE(refusal("a.dae", text).find("expected an array of 10 numbers or more, found 9"), std::string::npos);
    text = Collada().text();
    text.replace(text.find("stride=\"3\""), 10, "stride=\"4\"");
    EXPECT_NE(refusal("a.dae", text).find("expected an array of 11 numbers or more, found 9"), std::string::npos);
    EXPECT_NE(refusal("a.dae", std::string("<COLLADA>\0</COLLADA>", 20)).find("found a zero byte"), std::string::npos);
    for (const std::string element : {"p", "h", "v", "vcount", "int_array"}) {
        const auto fault = [&](const std::string& inside) {
            return refusal("a.dae", "<COLLADA><" + element + inside + "</" + element + "></COLLADA>");
        };
        const std::string words = "nothing but whole numbers in <" + element + ">";
        EXPECT_NE(fault(">0 1 x").find(words), std::string::npos) << element;
        EXPECT_NE(fault(" a='b'>0 1.5").find(words), std::string::npos) << element;
        EXPECT_EQ(fault(">0 -1 +2\t3\n").find(words), std::string::npos) << element;
        EXPECT_EQ(fault("x>abc").find(words), std::string::npos) << element; // a longer name
    }
    for (const std::string attribute : {"count", "offset", "stride"})
        for (const char quote : {'"', '\''}) {
            const std::string open = "<COLLADA><a " + attribute + "=" + quote,
                              close = std::string(1, quote) + "/></COLLADA>";
            const std::size_t size = (open + "99" + close).size(); // a count of that many bytes fits
            const std::string words = "expected a " + attribute + " that fits the file";
            EXPECT_EQ(refusal("a.dae", open + std::to_string(size) + close).find(words), std::string::npos)
                << attribute;
            EXPECT_NE(refusal("a.dae", open + std::to_string(size + 1) + close).find(words), std::string::npos)
                << attribute;
            EXPECT_NE(refusal("a.dae", open + "99999999999999999999" + close).find(words), std::string::npos);
        }
}

TEST_F(ModelFile, colladaNodesAreLimitedPlacedInOrderAndTheirLightsLeftOut)
{
    paint("a.png", {10, 20, 200});
    const std::string use = "<instance_geometry url=\"#g\"/>";
    Collada collada;
    collada.nodes = "<node id=\"a\" name=\"a\"><translate>1 2 3</translate>" + use
        + "<node id=\"b\" name=\"b\"><rotate>0 0 1 90</rotate>" + use + "</node></node><node id=\"c\" name=\"c\">" + use
        + "<instance_light url=\"#l\"/></node>";
    collada.libraries = "<library_lights><light id=\"l\"><technique_common><point><color>1 1 1</color></point>"
                        "</technique_common></light></library_lights>";
    LoadLimits limits;
    limits.nodes = 4; // with the root
    const Scene scene = get("a.dae", collada.text(), limits);
    limits.nodes = 3;
    EXPECT_NE(refusal("a.dae", collada.text(), limits).find("over the limit of 3 nodes"), std::string::npos);
    ASSERT_EQ(scene.instances.size(), 3u);
    EXPECT_EQ(scene.instances[0].name, "a");
    EXPECT_EQ(scene.instances[1].name, "b");
    EXPECT_EQ(scene.instances[2].name, "c");
    const auto at = [&](std::size_t i, const glm::vec3& p) {
        return glm::vec3(scene.instances[i].toWorld * glm::vec4(p, 1));
    };
    EXPECT_NEAR(glm::length(at(0, {1, 0, 0}) - glm::vec3(2, 2, 3)), 0, 1e-5);
    EXPECT_NEAR(glm::length(at(1, {1, 0, 0}) - glm::vec3(1, 3, 3)), 0, 1e-5); // x becomes y
    EXPECT_NEAR(glm::length(at(2, {1, 0, 0}) - glm::vec3(1, 0, 0)), 0, 1e-5);
    EXPECT_TRUE(says(scene, "1 lights are left out: this format gives them no unit"));
    EXPECT_EQ(scene.meshes.size(), 1u);
}

TEST_F(ModelFile, colladaCamerasWithoutAViewAreLeftOutAndSaid)
{
    const auto with = [&](const std::string& perspective, const std::string& transform) {
        Collada collada;
        collada.libraries = "<library_cameras><camera id=\"k\" name=\"k\"><optics><technique_common><perspective>"
            + perspective
            + "<znear>0.1</znear><zfar>100</zfar></perspective></technique_common></optics></camera></library_cameras>";
        collada.nodes += "<node id=\"k1\" name=\"k1\">" + transform + "<instance_camera url=\"#k\"/></node>";
        return get("a.dae", collada.text());
    };
    const Scene good = with("<yfov>30</yfov><aspect_ratio>1.5</aspect_ratio>", "<rotate>0 1 0 90</rotate>");
    ASSERT_EQ(good.cameras.size(), 1u);
    EXPECT_NEAR(good.cameras[0].verticalFieldOfView, 0.5235988, 1e-4);
    const glm::vec3 forward = glm::normalize(good.cameras[0].target - good.cameras[0].eye);
    EXPECT_NEAR(glm::length(forward - glm::vec3(-1, 0, 0)), 0, 1e-5); // -z, a quarter about y
    const Scene flat = with("<yfov>30</yfov><aspect_ratio>1.5</aspect_ratio>", "<scale>0 0 0</scale>");
    EXPECT_TRUE(flat.cameras.empty());
    EXPECT_TRUE(says(flat, "is degenerate; left out"));
    const Scene narrow = with("<xfov>0.01</xfov><aspect_ratio>1.5</aspect_ratio>", "");
    EXPECT_TRUE(narrow.cameras.empty());
}

// ---- PLY ------------------------------------------------------------------------------------------

TEST_F(ModelFile, plyHeadersAreReadWordByWordAndTheFaultIsNamedWithItsLine)
{
    const std::string numbers = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    const auto with = [&](const std::string& format, const std::string& vertex, const std::string& face) {
        return refusal("a.ply",
                       "ply\n" + format + vertex + "property float x\nproperty float y\nproperty float z\n" + face
                           + "property list uchar int vertex_indices\nend_header\n" + numbers);
    };
    const std::string format = "format ascii 1.0\n", vertex = "element vertex 3\n", face = "element face 1\n";
    EXPECT_EQ(with(format, vertex, face), "");
    EXPECT_EQ(with(format, "comment a b\nobj_info c\n" + vertex, face), "");
    EXPECT_NE(with("", vertex, face).find("line 2: expected the format line first"), std::string::npos);
    EXPECT_NE(with("format text 1.0\n", vertex, face).find("line 2: expected ascii"), std::string::npos);
    EXPECT_NE(with("format ascii\n", vertex, face).find("line 2: expected ascii"), std::string::npos);
    EXPECT_NE(with(format, vertex + format, face).find("line 4: expected ascii"), std::string::npos);
    EXPECT_NE(with(format, "\n" + vertex, face).find("line 3: expected a header line"), std::string::npos);
    EXPECT_NE(with(format, "element vertex x\n", face).find("line 3: expected a count at the end"), std::string::npos);
    EXPECT_NE(with(format, "element vertex 999999\n", face).find("it counts 999999 elements"), std::string::npos);
    EXPECT_NE(with(format, "element 3d 3\n", face).find("starts with a letter, found \"3d\""), std::string::npos);
    EXPECT_NE(with(format, "property float q\n" + vertex, face).find("line 3: expected a type and a name"),
              std::string::npos);
    EXPECT_NE(with(format, vertex + "property quad q\n", face).find("line 4: expected a type and a name"),
              std::string::npos);
    EXPECT_NE(with(format, vertex, face + "property list float int q\n").find("a whole number as the count of a list"),
              std::string::npos);
    LoadLimits limits;
    limits.vertices = 3;
    const std::string whole = "ply\n" + format + vertex + "property float x\nproperty float y\nproperty float z\n"
        + face + "property list uchar int vertex_indices\nend_header\n" + numbers;
    EXPECT_EQ(refusal("a.ply", whole, limits), "");
    limits.vertices = 2;
    EXPECT_NE(refusal("a.ply", whole, limits), "");
}

} // namespace
} // namespace cotan
